//! A part file, read: all columns or some.

use super::table::{Column, Data};
use parquet::basic::Type as Physical;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{FileReader, SerializedFileReader};
use std::fs::File;

/// What a file has in its metadata at `key`.
pub(super) fn metadata(file: File, key: &str) -> Result<Option<String>> {
    let reader = SerializedFileReader::new(file)?;
    let pairs = reader.metadata().file_metadata().key_value_metadata();
    let pair = pairs.and_then(|pairs| pairs.iter().find(|pair| pair.key == key));
    Ok(pair.and_then(|pair| pair.value.clone()))
}

/// The columns named `wanted` of a file, or all; those that it does not have are left out.
pub(super) fn read(file: File, wanted: Option<&[&str]>) -> Result<Vec<Column>> {
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata().clone();
    let schema = metadata.file_metadata().schema_descr();
    let mut columns = Vec::new();
    for (i, leaf) in schema.columns().iter().enumerate() {
        let name = leaf.path().parts()[0].clone();
        if wanted.is_some_and(|wanted| !wanted.contains(&name.as_str())) {
            continue;
        }
        let (definition, repetition) = (leaf.max_def_level(), leaf.max_rep_level());
        let mut data = match (leaf.physical_type(), repetition) {
            (Physical::BYTE_ARRAY, 0) => Data::Text(Vec::new()),
            (Physical::INT64, 0) => Data::Integer(Vec::new()),
            (Physical::DOUBLE, 0) => Data::Number(Vec::new()),
            (Physical::DOUBLE, 1) => Data::Numbers(Vec::new()),
            (Physical::DOUBLE, 2) => Data::Rows(Vec::new()),
            _ => return Err(unknown(&name)),
        };
        for group in 0..metadata.num_row_groups() {
            let group = reader.get_row_group(group)?;
            let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            match (&mut data, group.get_column_reader(i)?) {
                (Data::Text(values), ColumnReader::ByteArrayColumnReader(reader)) => {
                    let text = |bytes: &ByteArray| bytes.as_utf8().map(str::to_owned);
                    flat(reader, rows, definition, values, text)?;
                }
                (Data::Integer(values), ColumnReader::Int64ColumnReader(reader)) => {
                    flat(reader, rows, definition, values, |number| Ok(*number))?;
                }
                (Data::Number(values), ColumnReader::DoubleColumnReader(reader)) => {
                    flat(reader, rows, definition, values, |number| Ok(*number))?;
                }
                (Data::Numbers(values), ColumnReader::DoubleColumnReader(reader)) => {
                    let (all, levels) = taken(reader, rows, definition, true)?;
                    numbers(&all, &levels, values);
                }
                (Data::Rows(values), ColumnReader::DoubleColumnReader(reader)) => {
                    let (all, levels) = taken(reader, rows, definition, true)?;
                    lists(&all, &levels, values);
                }
                _ => return Err(unknown(&name)),
            }
        }
        columns.push(Column { name, data });
    }
    Ok(columns)
}

fn unknown(name: &str) -> ParquetError {
    ParquetError::General(format!("column {name:?} is of a type that no part has"))
}

/// Values with, for each place, how much of the way to one is there and which list goes on.
type Taken<T> = (Vec<T>, Vec<(i16, i16)>);

fn taken<D: DataType>(
    mut reader: ColumnReaderImpl<D>,
    rows: usize,
    definition: i16,
    repeated: bool,
) -> Result<Taken<D::T>> {
    let (mut values, mut defined, mut again) = (Vec::new(), Vec::new(), Vec::new());
    let mut left = rows;
    while left > 0 {
        let levels = (definition > 0).then_some(&mut defined);
        let lists = repeated.then_some(&mut again);
        let (records, ..) = reader.read_records(left, levels, lists, &mut values)?;
        if records == 0 {
            return Err(ParquetError::EOF("a column ends early".into()));
        }
        left -= records;
    }
    if definition == 0 {
        defined = vec![0; values.len()];
    }
    again.resize(defined.len(), 0);
    Ok((values, defined.into_iter().zip(again).collect()))
}

fn flat<D: DataType, T>(
    reader: ColumnReaderImpl<D>,
    rows: usize,
    definition: i16,
    to: &mut Vec<Option<T>>,
    of: impl Fn(&D::T) -> Result<T>,
) -> Result<()> {
    let (values, levels) = taken(reader, rows, definition, false)?;
    let mut values = values.iter();
    for (defined, _) in levels {
        let there = (defined == definition).then(|| values.next()).flatten();
        to.push(there.map(&of).transpose()?);
    }
    Ok(())
}

fn numbers(values: &[f64], levels: &[(i16, i16)], to: &mut Vec<Option<Vec<f64>>>) {
    let mut values = values.iter();
    for (defined, again) in levels {
        if *again == 0 {
            to.push((*defined > 0).then(Vec::new));
        }
        if let (2, Some(Some(list)), Some(value)) =
            (*defined, to.last_mut(), values.as_slice().first())
        {
            list.push(*value);
            values.next();
        }
    }
}

fn lists(values: &[f64], levels: &[(i16, i16)], to: &mut Vec<Option<Vec<Vec<f64>>>>) {
    let mut values = values.iter();
    for (defined, again) in levels {
        if *again == 0 {
            to.push((*defined > 0).then(Vec::new));
        }
        let Some(Some(list)) = to.last_mut() else {
            continue;
        };
        if *again < 2 && *defined > 1 {
            list.push(Vec::new());
        }
        if let (3, Some(row)) = (*defined, list.last_mut()) {
            row.extend(values.next());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::part_write::write;
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let column = |name: &str, data| Column {
            name: name.into(),
            data,
        };
        let columns = vec![
            column("row", Data::Integer(vec![Some(3), Some(1), Some(2)])),
            column(
                "a.b[0]",
                Data::Number(vec![Some(0.1), None, Some(f64::INFINITY)]),
            ),
            column("why", Data::Text(vec![None, Some("é".into()), None])),
            column(
                "t",
                Data::Numbers(vec![Some(vec![1.0, 2.0]), None, Some(vec![])]),
            ),
            column(
                "u",
                Data::Rows(vec![
                    Some(vec![vec![1.0, 2.0], vec![], vec![3.0]]),
                    None,
                    Some(vec![]),
                ]),
            ),
        ];
        let mut file = tempfile::tempfile().unwrap();
        let own = file.try_clone().unwrap();
        write(own, &columns, &["row"], &[("k", "v".into())]).unwrap();
        use std::io::Seek;
        file.rewind().unwrap();
        assert_eq!(read(file.try_clone().unwrap(), None).unwrap(), columns);
        let some = read(file, Some(&["u", "row", "other"])).unwrap();
        assert_eq!(some, [columns[0].clone(), columns[4].clone()]);
    }
}
