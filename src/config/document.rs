//! A TOML document in which every value knows its line.

use super::{ConfigError, Place};
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Largest document, bytes: every value is kept with its place, which takes many times its text.
const LARGEST: usize = 4 << 20;

/// A value and where it was given.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub place: Place,
    pub value: Value,
}

/// What a value is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    /// A date or time, which no key takes.
    Date(String),
    Array(Vec<Node>),
    Table(Vec<(String, Node)>),
}

impl Node {
    /// Reads a document; `source` is the name of the file in messages.
    pub(super) fn parse(source: &Arc<str>, text: &str) -> Result<Self, ConfigError> {
        // Editors on other systems put a byte order mark in front.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let place = |line| Place {
            source: source.clone(),
            line,
        };
        if text.len() > LARGEST {
            let message = format!("the file is larger than {} MiB", LARGEST >> 20);
            return Err(ConfigError::Format {
                place: place(None),
                message,
            });
        }
        let lines = Lines::new(source, text);
        let table = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(place(None), |span| lines.place(&span));
            ConfigError::Format {
                place: at,
                message: syntax(error.message()),
            }
        })?;
        Ok(Self {
            place: place(None),
            value: lines.table(table.get_ref())?,
        })
    }

    /// The entry of a table.
    pub(super) fn get(&self, key: &str) -> Option<&Self> {
        match &self.value {
            Value::Table(entries) => entries.iter().find(|(k, _)| k == key).map(|(_, node)| node),
            _ => None,
        }
    }

    /// Where `key` ("limits.joint_velocity[1]") is given, or the nearest table around it.
    pub(super) fn locate(&self, key: &str) -> Place {
        let mut node = self;
        for part in key.split('.') {
            let mut names = part.split('[');
            let Some(entry) = names.next().and_then(|name| node.get(name)) else {
                break;
            };
            node = entry;
            for index in names {
                let index = index.trim_end_matches(']').parse::<usize>().ok();
                if let (Value::Array(elements), Some(index)) = (&node.value, index) {
                    node = elements.get(index).unwrap_or(node);
                }
            }
        }
        node.place.clone()
    }

    /// What stands here, for a message.
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("a string ({})", quoted(text)),
            Value::Integer(number) => number.to_string(),
            Value::Float(number) => format!("{number:?}").to_lowercase(),
            Value::Boolean(value) => value.to_string(),
            Value::Date(_) => "a date".into(),
            Value::Array(elements) => match elements.len() {
                0 => "an empty array".into(),
                1 => "an array of 1 value".into(),
                n => format!("an array of {n} values"),
            },
            Value::Table(_) => "a table".into(),
        }
    }
}

/// `text` in quotes on one line, cut where it is long.
pub(super) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{:?}…", &text[..end]),
        None => format!("{text:?}"),
    }
}

/// The parser's message in one line.
fn syntax(message: &str) -> String {
    format!(
        "not TOML: {}",
        message
            .lines()
            .map(str::trim)
            .collect::<Vec<_>>()
            .join(", ")
    )
}

struct Lines<'a> {
    source: &'a Arc<str>,
    /// Positions of the line breaks.
    breaks: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(source: &'a Arc<str>, text: &str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self {
            source,
            breaks: breaks.map(|(position, _)| position).collect(),
        }
    }

    fn place(&self, span: &Range<usize>) -> Place {
        Place {
            source: self.source.clone(),
            line: Some(1 + self.breaks.partition_point(|at| *at < span.start)),
        }
    }

    fn table(&self, table: &DeTable<'_>) -> Result<Value, ConfigError> {
        let entry = |(key, value): (&Spanned<Cow<'_, str>>, &Spanned<DeValue<'_>>)| {
            // The line of the key: a value may run over several.
            let place = self.place(&key.span());
            Ok((
                key.get_ref().to_string(),
                self.node(place, value.get_ref())?,
            ))
        };
        Ok(Value::Table(
            table.iter().map(entry).collect::<Result<_, _>>()?,
        ))
    }

    fn node(&self, place: Place, value: &DeValue<'_>) -> Result<Node, ConfigError> {
        let too_large = |text: &str| ConfigError::Format {
            place: place.clone(),
            message: format!("the number {text} is too large"),
        };
        let value = match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(number) => i64::from_str_radix(number.as_str(), number.radix())
                .map(Value::Integer)
                .map_err(|_| too_large(number.as_str()))?,
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(value) if value.is_finite() || number.as_str().ends_with(['f', 'n']) => {
                    Value::Float(value)
                }
                _ => return Err(too_large(number.as_str())),
            },
            DeValue::Boolean(value) => Value::Boolean(*value),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(elements) => Value::Array(
                elements
                    .iter()
                    .map(|element| self.node(self.place(&element.span()), element.get_ref()))
                    .collect::<Result<_, _>>()?,
            ),
            DeValue::Table(table) => self.table(table)?,
        };
        Ok(Node { place, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Node, ConfigError> {
        Node::parse(&"a.toml".into(), text)
    }

    #[test]
    fn every_value_knows_its_line() {
        let document = parse("a = 1\n[t]\nb.c = [\n 1,\n 2 ]\n").unwrap();
        let line = |key: &str| document.locate(key).line;
        assert_eq!(line("a"), Some(1));
        assert_eq!(line("t.b.c"), Some(3));
        assert_eq!(line("t.b.c[1]"), Some(5));
        assert_eq!(line("t.b.missing"), Some(3));
        assert_eq!(line("t.missing"), Some(2));
        assert_eq!(line("missing"), None);
    }

    #[test]
    fn a_syntax_error_is_one_line_with_its_place() {
        let error = parse("a = 1\nb = = 2\n").unwrap_err().to_string();
        assert!(error.starts_with("a.toml:2: not TOML: "), "{error}");
        assert_eq!(error.lines().count(), 1);
    }

    #[test]
    fn numbers_that_overflow_are_refused_and_infinity_is_not() {
        assert!(parse("a = 1e999").is_err());
        assert!(parse("a = 99999999999999999999").is_err());
        assert_eq!(
            parse("a = -inf").unwrap().get("a").unwrap().value,
            Value::Float(f64::NEG_INFINITY)
        );
    }
}
