//! What keeps a data set from being written or read.

use parquet::errors::ParquetError;
use std::io;
use std::path::{Path, PathBuf};

/// What keeps a data set from being written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataSetError {
    /// A folder that cannot be made.
    #[error(
        "{}: cannot be made: {cause}; expected a folder to write the data set to",
        path.display()
    )]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A folder or file that cannot be written. What was written before is whole.
    #[error(
        "{}: cannot be written: {cause}; the rows before are kept, --resume goes on from there",
        path.display()
    )]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A file that cannot be made.
    #[error("{}: cannot be written as Parquet: {cause}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: ParquetError,
    },
    /// A folder or file that cannot be read.
    #[error("{}: cannot be read: {cause}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A part file that is none.
    #[error(
        "{}: is no part of this data set: {reason}; move it away, and --resume plans its rows again",
        path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A part file with a row that another has as well.
    #[error(
        "{}: has row {row}, which another part has as well; move the one that is a copy away",
        path.display()
    )]
    Twice {
        /// The file.
        path: PathBuf,
        /// The row.
        row: i64,
    },
    /// A folder without a data set.
    #[error("{}: holds no data set; expected a folder that batch --out wrote to", path.display())]
    Missing {
        /// The folder.
        path: PathBuf,
    },
    /// A folder that another run writes to.
    #[error("{}: another run writes to it; wait for its end, or choose another --out", path.display())]
    Locked {
        /// The folder.
        path: PathBuf,
    },
    /// A folder that has rows already.
    #[error(
        "{}: has {rows} rows of this batch already; --resume goes on with the rest, or choose another \
         --out",
        path.display()
    )]
    Begun {
        /// The folder.
        path: PathBuf,
        /// How many.
        rows: u64,
    },
    /// A folder or a part that has rows of something else.
    #[error("{}: has rows of another batch: {what} differ; choose another --out", path.display())]
    Other {
        /// The folder, or the file.
        path: PathBuf,
        /// What is not the same.
        what: &'static str,
    },
}

impl DataSetError {
    /// The file or folder that it is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::Folder { path, .. }
            | Self::Write { path, .. }
            | Self::Encode { path, .. }
            | Self::Read { path, .. }
            | Self::Damaged { path, .. }
            | Self::Twice { path, .. }
            | Self::Missing { path }
            | Self::Locked { path }
            | Self::Begun { path, .. }
            | Self::Other { path, .. } => path,
        }
    }
}

/// The failure of making the folder at `path`.
pub(super) fn folder(path: &Path) -> impl FnOnce(io::Error) -> DataSetError {
    let path = path.to_path_buf();
    |cause| DataSetError::Folder { path, cause }
}

/// The failure of writing at `path`.
pub(super) fn write(path: &Path) -> impl FnOnce(io::Error) -> DataSetError {
    let path = path.to_path_buf();
    |cause| DataSetError::Write { path, cause }
}

/// The failure of reading at `path`.
pub(super) fn read(path: &Path) -> impl FnOnce(io::Error) -> DataSetError {
    let path = path.to_path_buf();
    |cause| DataSetError::Read { path, cause }
}
