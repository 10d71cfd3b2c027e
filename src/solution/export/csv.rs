//! Columns as CSV.

use super::{Column, ExportError};

/// A header of names with their units, `joint_position.elbow [rad]`, then a row a time, all digits.
///
/// # Errors
/// None that is expected: columns are of one length.
pub fn csv(columns: &[Column]) -> Result<String, ExportError> {
    let failed = |error: csv::Error| ExportError::Table(error.to_string());
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = columns
        .iter()
        .map(|column| format!("{} [{}]", column.name, column.unit));
    writer.write_record(header).map_err(failed)?;
    let rows = columns.first().map_or(0, |column| column.values.len());
    for k in 0..rows {
        let row: Vec<f64> = columns.iter().map(|column| column.values[k]).collect();
        writer.serialize(row).map_err(failed)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| ExportError::Table(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
