//! Many problems, planned side by side, each as if it were alone.
//!
//! One problem that fails, fails alone: it becomes a [`Record`] with its reason, and the rest goes on.
//! A record follows from its problem, whatever ran before or beside it.
//!
//! | file | does |
//! | --- | --- |
//! | `bits` | numbers that go from process to process without losing a bit |
//! | `engine` | rows to threads, records back |
//! | `error` | what keeps a batch from going on |
//! | `one` | a single row |
//! | `process` | a worker in a process of its own |
//! | `record` | what became of a row |
//! | `serve` | the other end of such a worker |
//! | `status` | how a row ended |
//! | `tasks` | where the problems come from |

mod bits;
mod engine;
mod error;
mod one;
mod process;
mod record;
mod serve;
mod status;
mod tasks;

pub use engine::{Engine, Event, Isolation};
pub use error::EngineError;
pub use one::RowPlanner;
pub use process::WorkerCommand;
pub use record::{Figures, Motion, Record};
pub use serve::{depend_on_batch, serve};
pub use status::RowStatus;
pub use tasks::{Refusal, Task, Tasks};
