//! Where the problems of a batch come from.

use super::RowStatus;
use crate::config::{BatchFile, Cell, ConfigError};
use crate::problem::Problem;

/// Many problems, each made when it is asked for, by any thread.
pub trait Tasks: Sync {
    /// How many there are.
    fn count(&self) -> u64;

    /// The key of the one at `position`, counted from 0.
    fn key(&self, position: u64) -> String;

    /// The one at `position`; always the same.
    ///
    /// # Errors
    /// [`Refusal`] where there is nothing to plan.
    fn task(&self, position: u64) -> Result<Task, Refusal>;
}

/// A problem to plan.
#[derive(Debug, Clone)]
pub struct Task {
    /// The problem.
    pub problem: Problem,
    /// What it has at the keys that vary, in their order.
    pub cells: Vec<Cell>,
}

/// Why there is nothing to plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// [`RowStatus::Malformed`] or [`RowStatus::Impossible`].
    pub status: RowStatus,
    /// Why, in one line.
    pub reason: String,
    /// Name of the problem, where there is one.
    pub name: String,
    /// What it has at the keys that vary; none where there is no problem.
    pub cells: Vec<Cell>,
}

impl Tasks for BatchFile {
    fn count(&self) -> u64 {
        Self::count(self)
    }

    fn key(&self, position: u64) -> String {
        Self::key(self, position)
    }

    fn task(&self, position: u64) -> Result<Task, Refusal> {
        let refusal = |status, error: ConfigError, name: &str, cells| Refusal {
            status,
            reason: error.to_string(),
            name: name.into(),
            cells,
        };
        let row = self.row(position);
        let row = row.map_err(|error| refusal(RowStatus::Malformed, error, "", Vec::new()))?;
        let (file, cells) = (row.file, row.cells);
        match file.possible() {
            Err(error) => {
                let name = &file.problem.name;
                Err(refusal(RowStatus::Impossible, error, name, cells))
            }
            Ok(()) => Ok(Task {
                problem: file.problem,
                cells,
            }),
        }
    }
}

/// Problems made in code; their positions are their keys.
impl Tasks for [Problem] {
    fn count(&self) -> u64 {
        self.len() as u64
    }

    fn key(&self, position: u64) -> String {
        format!("{position:08}")
    }

    fn task(&self, position: u64) -> Result<Task, Refusal> {
        Ok(Task {
            problem: self[position as usize].clone(),
            cells: Vec::new(),
        })
    }
}
