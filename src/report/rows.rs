//! Rows of results as CSV and JSON.

use super::{Build, to_json};
use crate::nlp::ipopt;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a, R> {
    schema: u32,
    version: &'static str,
    ipopt: &'static str,
    problem: &'a str,
    notes: &'a [String],
    rows: &'a [R],
}

/// `rows` about `problem` as one JSON document, with what made them.
///
/// # Errors
/// Where a row has a map whose keys are not strings.
pub(super) fn rows_json<R: Serialize>(
    problem: &str,
    rows: &[R],
    notes: &[String],
) -> serde_json::Result<String> {
    to_json(&Document {
        schema: 1,
        version: Build::VERSION,
        ipopt: ipopt::version(),
        problem,
        notes,
        rows,
    })
}

/// `rows` as CSV, the names of their fields first.
///
/// # Errors
/// Where a row is not flat.
pub(super) fn rows_csv(rows: &[impl Serialize]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
