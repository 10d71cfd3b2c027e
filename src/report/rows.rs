//! Rows of results about one problem, as CSV and JSON.

use crate::nlp::ipopt;
use crate::solution::{Build, to_json};
use serde::Serialize;

/// Rows of results about one problem, with what a reader should know of them.
#[derive(Debug, Clone)]
pub struct Rows<'a, R> {
    pub(super) name: &'a str,
    pub(super) rows: Vec<R>,
    pub(super) notes: &'a [String],
}

#[derive(Serialize)]
struct Document<'a, R> {
    schema: u32,
    version: &'static str,
    ipopt: &'static str,
    problem: &'a str,
    notes: &'a [String],
    rows: &'a [R],
}

impl<R: Serialize> Rows<'_, R> {
    /// One row a line, the names of their fields first.
    ///
    /// # Errors
    /// None that is expected: rows are flat.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.rows {
            writer.serialize(row)?;
        }
        let bytes = writer.into_inner().map_err(|error| error.into_error())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// One document, with what made them.
    ///
    /// # Errors
    /// None that is expected: all keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        to_json(&Document {
            schema: 1,
            version: Build::VERSION,
            ipopt: ipopt::version(),
            problem: self.name,
            notes: self.notes,
            rows: &self.rows,
        })
    }

    /// The notes as a list.
    pub(super) fn list(&self) -> String {
        self.notes
            .iter()
            .map(|note| format!("- {note}\n"))
            .collect()
    }

    /// What computed them.
    pub(super) fn origin() -> String {
        format!(
            "ffsm-ipopt {}, Ipopt {}.\n",
            Build::VERSION,
            ipopt::version()
        )
    }
}
