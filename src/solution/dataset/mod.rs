//! The data set of a batch: a folder of Parquet files, a row a plan.
//!
//! Part files are written beside their place and get their names once they are on the disk, so that
//! whatever reads the folder sees whole rows, and whatever ends the program costs no more than the
//! rows since the last part. Names that begin with `.` or `_` are no part of the data; readers of
//! data sets leave them aside.
//!
//! | file | does |
//! | --- | --- |
//! | `buffer` | records on their way to the next part |
//! | `columns` | records as columns |
//! | `error` | what keeps a data set from being written or read |
//! | `folder` | the folder: what is done, the next part |
//! | `lock` | one run at a time |
//! | `manifest` | what the rows follow from, in `_batch.json` |
//! | `part_read`, `part_write` | a part file |
//! | `run` | a batch planned into a folder |
//! | `run_error` | what keeps a batch from being planned into a folder |
//! | `start` | the saved solution that all rows of a batch start from |
//! | `table` | columns in memory |

mod buffer;
mod columns;
mod error;
mod folder;
mod lock;
mod manifest;
mod part_read;
mod part_write;
mod run;
mod run_error;
mod start;
mod table;

pub use error::DataSetError;
pub use folder::{DataSet, Done, Writer};
pub use lock::Shard;
pub use manifest::Manifest;
pub use run::{Run, RunOptions};
pub use run_error::RunError;
pub use start::start;
pub use table::{Column, Data};

pub(super) use part_write::write;
