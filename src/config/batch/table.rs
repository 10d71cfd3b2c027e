//! Columns of tables in other files: CSV with a header, or Parquet.

use super::Cell;
use super::vary::MOST_ROWS;
use crate::config::document::quoted;
use crate::config::item::{Item, hint};
use crate::config::{ConfigError, Place, regular};
use parquet::basic::{CompressionCodec, ConvertedType, LogicalType};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::file::reader::{FileReader, SerializedFileReader};
use std::fs::File;
use std::path::Path;

/// Largest table, bytes.
const LARGEST: u64 = 256 << 20;
/// Largest column of a Parquet file, bytes once it is unpacked.
const LARGEST_COLUMN: i64 = 1 << 30;

/// The tables of one batch, all of which have as many rows.
pub(super) struct Tables<'a> {
    folder: &'a Path,
    /// Rows of the first, and what it is called.
    first: Option<(usize, String)>,
}

impl<'a> Tables<'a> {
    /// Tables whose paths are relative to `folder`.
    pub(super) fn of(folder: &'a Path) -> Self {
        let first = None;
        Self { folder, first }
    }

    /// The column that an entry of the batch file names.
    pub(super) fn column(
        &mut self,
        table: &Item<'_>,
        column: &Item<'_>,
    ) -> Result<Vec<Cell>, ConfigError> {
        const EXPECTED: &str = "the path of a .csv or .parquet file, relative to this file";
        let name = table.text(EXPECTED)?;
        let path = self.folder.join(name);
        let extension = path.extension().and_then(|extension| extension.to_str());
        let wanted = column.text("the name of a column")?;
        let found = match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => csv(&path, wanted),
            Some("parquet") => parquet(&path, wanted),
            _ => return Err(table.unexpected(EXPECTED)),
        };
        let cells = found.map_err(|trouble| match trouble {
            Trouble::Unreadable(reason) => ConfigError::Unreadable {
                place: Place {
                    source: format!("{}: {}: {}", table.node.place, table.key, path.display())
                        .into(),
                    line: None,
                },
                reason,
                expected: "a table of the values of keys, a row a plan",
            },
            Trouble::NoColumn(names) => {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                column.error(
                    quoted(wanted),
                    format!("a column of it; {}", hint(wanted, &names)),
                )
            }
        })?;
        let rows = cells.len();
        if rows == 0 || rows as u64 > MOST_ROWS {
            return Err(table.error(format!("{rows} rows"), format!("from 1 to {MOST_ROWS}")));
        }
        match &self.first {
            Some((others, first)) if *others != rows => Err(table.error(
                format!("{rows} rows"),
                format!(
                    "{others}, as {} has: all tables go on together",
                    quoted(first)
                ),
            )),
            _ => {
                self.first.get_or_insert((rows, name.into()));
                Ok(cells)
            }
        }
    }
}

/// Why there is no column.
enum Trouble {
    Unreadable(String),
    /// The columns there are.
    NoColumn(Vec<String>),
}

fn unreadable(error: impl ToString) -> Trouble {
    Trouble::Unreadable(error.to_string())
}

/// Where the one column named `wanted` stands among `names`.
fn only<'n>(names: impl Iterator<Item = &'n str>, wanted: &str) -> Result<usize, Trouble> {
    let names: Vec<&str> = names.collect();
    let mut found = (0..names.len()).filter(|at| names[*at] == wanted);
    match (found.next(), found.next()) {
        (Some(at), None) => Ok(at),
        (Some(_), Some(_)) => Err(Trouble::Unreadable(format!(
            "it has the column {} twice",
            quoted(wanted)
        ))),
        (None, _) => Err(Trouble::NoColumn(
            names.into_iter().map(str::to_owned).collect(),
        )),
    }
}

/// What the values of a column are.
enum Kind {
    Number,
    Text,
}

/// That of a Parquet column by its old and its new type; `None` for dates, times and the like, which are
/// kept as numbers and are none.
fn kind(converted: ConvertedType, logical: Option<&LogicalType>) -> Option<Kind> {
    match (converted, logical) {
        (ConvertedType::UTF8, _) | (_, Some(LogicalType::String)) => Some(Kind::Text),
        (_, Some(LogicalType::Integer(of))) if of.is_signed || of.bit_width < 32 => {
            Some(Kind::Number)
        }
        (_, Some(_)) => None,
        (
            ConvertedType::NONE
            | ConvertedType::INT_8
            | ConvertedType::INT_16
            | ConvertedType::INT_32
            | ConvertedType::INT_64
            | ConvertedType::UINT_8
            | ConvertedType::UINT_16,
            None,
        ) => Some(Kind::Number),
        _ => None,
    }
}

fn csv(path: &Path, wanted: &str) -> Result<Vec<Cell>, Trouble> {
    let bytes = regular::read(path, LARGEST).map_err(Trouble::Unreadable)?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_reader(&bytes[..]);
    let names = reader.headers().map_err(unreadable)?.clone();
    let at = only(names.iter(), wanted)?;
    let mut texts = Vec::new();
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        texts.push(record.get(at).unwrap_or_default().to_owned());
    }
    let number = |text: &String| text.parse::<f64>().ok().filter(|number| number.is_finite());
    let numbers: Vec<Option<f64>> = texts.iter().map(number).collect();
    // One that is too large or none at all is meant as a number all the same.
    let is_number = texts.iter().any(|text| text.parse::<f64>().is_ok());
    let fits = |row: usize| numbers[row].is_some() == is_number && !texts[row].is_empty();
    if let Some(row) = (0..texts.len()).find(|row| !fits(*row)) {
        let kind = if is_number {
            "a finite number"
        } else {
            "a text that is not empty"
        };
        let found = quoted(&texts[row]);
        let message = format!("row {row} of the column has {found}; expected {kind}");
        return Err(Trouble::Unreadable(message));
    }
    let cell =
        |(number, text): (Option<f64>, String)| number.map_or(Cell::Text(text), Cell::Number);
    Ok(numbers.into_iter().zip(texts).map(cell).collect())
}

fn parquet(path: &Path, wanted: &str) -> Result<Vec<Cell>, Trouble> {
    let file: File = regular::open_regular(path).map_err(Trouble::Unreadable)?;
    let reader = SerializedFileReader::new(file).map_err(unreadable)?;
    let metadata = reader.metadata();
    let schema = metadata.file_metadata().schema_descr_ptr();
    let names: Vec<String> = schema
        .columns()
        .iter()
        .map(|column| column.path().string())
        .collect();
    let at = only(names.iter().map(String::as_str), wanted)?;
    let column = schema.column(at);
    let text = match kind(column.converted_type(), column.logical_type_ref()) {
        Some(Kind::Text) => true,
        Some(Kind::Number) => false,
        None => return Err(unreadable("the column has neither numbers nor text")),
    };
    if column.max_rep_level() > 0 {
        return Err(unreadable("the column has lists; expected numbers or text"));
    }
    let levels = column.max_def_level() > 0;
    let mut cells = Vec::new();
    for group in 0..metadata.num_row_groups() {
        let group = reader.get_row_group(group).map_err(unreadable)?;
        let size = group.metadata().column(at).uncompressed_size();
        let packed = group.metadata().column(at).compression_codec();
        if !matches!(
            packed,
            CompressionCodec::UNCOMPRESSED | CompressionCodec::SNAPPY
        ) {
            let packed = format!("it is compressed by {packed}; expected snappy, or nothing");
            return Err(Trouble::Unreadable(packed));
        }
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        if size > LARGEST_COLUMN || (cells.len() + rows) as u64 > MOST_ROWS {
            return Err(unreadable("the column is too large"));
        }
        let number = |value: f64| {
            let finite = value.is_finite().then_some(Cell::Number(value));
            finite.ok_or_else(|| unreadable("the column has a number that is not finite"))
        };
        match group.get_column_reader(at).map_err(unreadable)? {
            ColumnReader::DoubleColumnReader(reader) => {
                take(reader, rows, levels, &mut cells, |value| number(*value))?;
            }
            ColumnReader::FloatColumnReader(reader) => {
                take(reader, rows, levels, &mut cells, |value| {
                    number(f64::from(*value))
                })?;
            }
            ColumnReader::Int32ColumnReader(reader) => {
                take(reader, rows, levels, &mut cells, |value| {
                    number(f64::from(*value))
                })?;
            }
            ColumnReader::Int64ColumnReader(reader) => {
                take(reader, rows, levels, &mut cells, |value| {
                    number(*value as f64)
                })?;
            }
            ColumnReader::ByteArrayColumnReader(reader) if text => {
                take(reader, rows, levels, &mut cells, |value| {
                    value
                        .as_utf8()
                        .map(|text| Cell::Text(text.into()))
                        .map_err(unreadable)
                })?;
            }
            _ => return Err(unreadable("the column has neither numbers nor text")),
        }
    }
    Ok(cells)
}

/// All values of a column of one row group.
fn take<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    levels: bool,
    cells: &mut Vec<Cell>,
    cell: impl Fn(&T::T) -> Result<Cell, Trouble>,
) -> Result<(), Trouble> {
    let mut values = Vec::new();
    let mut defined = Vec::new();
    while values.len() < rows {
        let definition = levels.then_some(&mut defined);
        let (records, read, _) = reader
            .read_records(rows, definition, None, &mut values)
            .map_err(unreadable)?;
        if records != read {
            return Err(unreadable("the column has empty places"));
        }
        if records == 0 {
            return Err(unreadable("the column ends early"));
        }
    }
    for value in &values {
        cells.push(cell(value)?);
    }
    Ok(())
}
