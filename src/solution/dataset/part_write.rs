//! A part file, written.

use super::table::{Column, Data};
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};
use std::io::Write;
use std::sync::Arc;

/// Writes `columns` with `metadata` by key; columns are optional but those of `required`, which have
/// a value in every row.
pub(in crate::solution) fn write<W: Write + Send>(
    to: W,
    columns: &[Column],
    required: &[&str],
    metadata: &[(&str, String)],
) -> Result<W> {
    let fields = columns
        .iter()
        .map(|column| field(column, required.contains(&column.name.as_str())))
        .collect::<Result<Vec<_>>>()?;
    let schema = Type::group_type_builder("plan")
        .with_fields(fields)
        .build()?;
    let pairs = metadata.iter();
    let pairs = pairs.map(|(key, value)| KeyValue::new(key.to_string(), value.clone()));
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(pairs.collect()))
        .build();
    let mut writer = SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for column in columns {
        let Some(to) = group.next_column()? else {
            break;
        };
        put(to, column, required.contains(&column.name.as_str()))?;
    }
    group.close()?;
    writer.into_inner()
}

fn field(column: &Column, required: bool) -> Result<TypePtr> {
    let name = column.name.as_str();
    let repetition = match required {
        true => Repetition::REQUIRED,
        false => Repetition::OPTIONAL,
    };
    let of = |physical| Type::primitive_type_builder(name, physical).with_repetition(repetition);
    let made = match &column.data {
        Data::Text(_) => of(Physical::BYTE_ARRAY)
            .with_logical_type(Some(LogicalType::String))
            .build(),
        Data::Integer(_) => of(Physical::INT64).build(),
        Data::Number(_) => of(Physical::DOUBLE).build(),
        Data::Numbers(_) => list(name, repetition, number()?),
        Data::Rows(_) => {
            let inner = list("element", Repetition::REQUIRED, number()?)?;
            list(name, repetition, Arc::new(inner))
        }
    };
    made.map(Arc::new)
}

/// The elements of a list.
fn number() -> Result<TypePtr> {
    Type::primitive_type_builder("element", Physical::DOUBLE)
        .with_repetition(Repetition::REQUIRED)
        .build()
        .map(Arc::new)
}

/// A list in the three levels that the format has it in.
fn list(name: &str, repetition: Repetition, element: TypePtr) -> Result<Type> {
    let repeated = Type::group_type_builder("list")
        .with_repetition(Repetition::REPEATED)
        .with_fields(vec![element])
        .build()?;
    Type::group_type_builder(name)
        .with_repetition(repetition)
        .with_logical_type(Some(LogicalType::List))
        .with_fields(vec![Arc::new(repeated)])
        .build()
}

fn put(to: SerializedColumnWriter<'_>, column: &Column, required: bool) -> Result<()> {
    match &column.data {
        Data::Text(values) => {
            flat::<ByteArrayType, _>(to, values, required, |text| ByteArray::from(text.as_str()))
        }
        Data::Integer(values) => flat::<Int64Type, _>(to, values, required, |number| *number),
        Data::Number(values) => flat::<DoubleType, _>(to, values, required, |number| *number),
        Data::Numbers(values) => {
            let mut levels = Levels::default();
            for value in values {
                levels.numbers(value.as_deref());
            }
            levels.put(to)
        }
        Data::Rows(values) => {
            let mut levels = Levels::default();
            for value in values {
                levels.rows(value.as_deref());
            }
            levels.put(to)
        }
    }
}

fn flat<D: DataType, T>(
    mut to: SerializedColumnWriter<'_>,
    values: &[Option<T>],
    required: bool,
    of: impl Fn(&T) -> D::T,
) -> Result<()> {
    let there: Vec<D::T> = values.iter().flatten().map(of).collect();
    let levels: Vec<i16> = values
        .iter()
        .map(|value| i16::from(value.is_some()))
        .collect();
    let levels = (!required).then_some(&levels[..]);
    to.typed::<D>().write_batch(&there, levels, None)?;
    to.close()
}

/// Lists, taken apart into their numbers and how deep each of them stands.
#[derive(Default)]
struct Levels {
    values: Vec<f64>,
    /// How much of the way to a number is there.
    definition: Vec<i16>,
    /// Which list goes on.
    repetition: Vec<i16>,
}

impl Levels {
    fn push(&mut self, definition: i16, repetition: i16) {
        self.definition.push(definition);
        self.repetition.push(repetition);
    }

    fn numbers(&mut self, value: Option<&[f64]>) {
        match value {
            None => self.push(0, 0),
            Some([]) => self.push(1, 0),
            Some(numbers) => {
                for (i, number) in numbers.iter().enumerate() {
                    self.push(2, i16::from(i > 0));
                    self.values.push(*number);
                }
            }
        }
    }

    fn rows(&mut self, value: Option<&[Vec<f64>]>) {
        match value {
            None => self.push(0, 0),
            Some([]) => self.push(1, 0),
            Some(rows) => {
                for (k, row) in rows.iter().enumerate() {
                    let first = i16::from(k > 0);
                    if row.is_empty() {
                        self.push(2, first);
                    }
                    for (i, number) in row.iter().enumerate() {
                        self.push(3, if i == 0 { first } else { 2 });
                        self.values.push(*number);
                    }
                }
            }
        }
    }

    fn put(&self, mut to: SerializedColumnWriter<'_>) -> Result<()> {
        to.typed::<DoubleType>().write_batch(
            &self.values,
            Some(&self.definition),
            Some(&self.repetition),
        )?;
        to.close()
    }
}
