//! Columns as a Parquet file.

use super::{Column, ExportError};
use crate::solution::Solution;
use crate::solution::dataset::{self, Data};
use std::collections::BTreeMap;

/// A file of `columns`, a row a time. Its metadata hold `units` (JSON: unit by column), `frames`, `name`,
/// `status` and `provenance` (JSON).
///
/// # Errors
/// [`ExportError::Table`], which is not expected.
pub fn parquet(columns: &[Column], solution: &Solution) -> Result<Vec<u8>, ExportError> {
    let failed = |error: String| ExportError::Table(error);
    let units: BTreeMap<&str, &str> = columns
        .iter()
        .map(|column| (column.name.as_str(), column.unit))
        .collect();
    let json =
        |value: Result<String, serde_json::Error>| value.map_err(|error| failed(error.to_string()));
    let metadata = [
        ("schema", "1".to_owned()),
        ("name", solution.name.clone()),
        ("status", solution.status.name().to_owned()),
        ("frames", super::FRAMES.to_owned()),
        ("units", json(serde_json::to_string(&units))?),
        (
            "provenance",
            json(serde_json::to_string(&solution.provenance))?,
        ),
    ];
    let columns: Vec<dataset::Column> = columns
        .iter()
        .map(|column| dataset::Column {
            name: column.name.clone(),
            data: Data::Number(column.values.iter().copied().map(Some).collect()),
        })
        .collect();
    let required: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    dataset::write(Vec::new(), &columns, &required, &metadata)
        .map_err(|error| failed(error.to_string()))
}
