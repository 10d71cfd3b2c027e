//! One value of a key that a batch varies.

use crate::config::Place;
use crate::config::document::{Node, Value};
use crate::config::item::Item;
use serde::{Deserialize, Serialize};

/// One value of a key that a batch varies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Cell {
    /// A number.
    Number(f64),
    /// A text, such as the name of a method.
    Text(String),
    /// An array of numbers.
    Numbers(Vec<f64>),
}

/// What cells of one key have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum CellKind {
    /// Numbers.
    Number,
    /// Texts.
    Text,
    /// Arrays of numbers.
    Numbers,
}

impl Cell {
    /// What it is.
    pub fn kind(&self) -> CellKind {
        match self {
            Self::Number(_) => CellKind::Number,
            Self::Text(_) => CellKind::Text,
            Self::Numbers(_) => CellKind::Numbers,
        }
    }

    /// A value of a file: a finite number, a text, or an array of finite numbers.
    pub(super) fn of(item: &Item<'_>) -> Option<Self> {
        let finite = |item: &Item<'_>| item.as_number().filter(|number| number.is_finite());
        if let Some(number) = finite(item) {
            return Some(Self::Number(number));
        }
        if let Some(elements) = item.as_elements() {
            let numbers = elements.iter().map(finite).collect::<Option<Vec<_>>>();
            return numbers.filter(|all| !all.is_empty()).map(Self::Numbers);
        }
        match &item.node.value {
            Value::Text(text) => Some(Self::Text(text.clone())),
            _ => None,
        }
    }

    /// The same as a value of a document, given at `place`.
    pub(super) fn value(&self, place: &Place) -> Value {
        match self {
            Self::Number(number) => of_number(*number),
            Self::Text(text) => Value::Text(text.clone()),
            Self::Numbers(numbers) => Value::Array(
                numbers
                    .iter()
                    .map(|number| Node {
                        place: place.clone(),
                        value: of_number(*number),
                    })
                    .collect(),
            ),
        }
    }

    /// As TOML.
    pub(super) fn toml(&self) -> String {
        match self {
            Self::Number(number) => toml_number(*number),
            Self::Text(string) => text(string),
            Self::Numbers(numbers) => {
                let numbers: Vec<String> = numbers.iter().copied().map(toml_number).collect();
                format!("[{}]", numbers.join(", "))
            }
        }
    }
}

/// A whole number stays one, as counts have to be.
fn of_number(number: f64) -> Value {
    const EXACT: f64 = (1_u64 << 53) as f64;
    match number.fract() == 0.0 && number.abs() < EXACT {
        true => Value::Integer(number as i64),
        false => Value::Float(number),
    }
}

/// A string of JSON is one of TOML, the character DEL apart.
pub(super) fn text(string: &str) -> String {
    let quoted = serde_json::Value::from(string).to_string();
    quoted.replace('\u{7f}', "\\u007f")
}

fn toml_number(number: f64) -> String {
    match of_number(number) {
        Value::Integer(number) => number.to_string(),
        _ => format!("{number:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_with_every_digit() {
        let number = 0.1 + 0.2;
        assert_eq!(Cell::Number(number).toml().parse::<f64>().unwrap(), number);
        assert_eq!(Cell::Number(4.0).toml(), "4");
        assert_eq!(Cell::Numbers(vec![1e-7, -2.0]).toml(), "[1e-7, -2]");
        assert_eq!(Cell::Text("a\"b\n".into()).toml(), r#""a\"b\n""#);
    }
}
