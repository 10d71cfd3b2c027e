//! JSON lines: a whole problem a line, with the keys of a problem file.

use super::cell::text;
use super::vary::MOST_ROWS;
use crate::config::document::{Node, Value};
use crate::config::{ConfigError, Place, regular};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::fs::FileExt;
use std::path::Path;
use std::sync::Arc;

/// Longest line, bytes.
const LONGEST: u64 = 1 << 20;
/// Most lines: where each begins is kept.
const MOST_LINES: u64 = if MOST_ROWS < 20_000_000 {
    MOST_ROWS
} else {
    20_000_000
};

/// A file of problems, of which a line is read when it is asked for.
#[derive(Debug)]
pub(super) struct Lines {
    file: File,
    source: Arc<str>,
    /// Where each line begins, its length in bytes, and its number in the file, counted from 1.
    lines: Vec<(u64, u32, u32)>,
    /// Of all bytes.
    pub hash: [u8; 32],
}

impl Lines {
    /// Looks where the lines of the file at `path` begin; empty ones are left out.
    pub(super) fn open(path: &Path) -> Result<Self, ConfigError> {
        let source: Arc<str> = path.display().to_string().into();
        let unreadable = |reason: String| ConfigError::Unreadable {
            place: Place {
                source: source.clone(),
                line: None,
            },
            reason,
            expected: "JSON lines, a problem a line",
        };
        let file = regular::open_regular(path).map_err(unreadable)?;
        let mut reader = BufReader::with_capacity(1 << 16, &file);
        let mut lines = Vec::new();
        let mut hash = Sha256::new();
        let mut line = Vec::new();
        let (mut at, mut number) = (0_u64, 0_u32);
        loop {
            line.clear();
            let read = (&mut reader).take(LONGEST + 1).read_until(b'\n', &mut line);
            let length = read.map_err(|error| unreadable(error.to_string()))?;
            if length == 0 {
                break;
            }
            number += 1;
            if length as u64 > LONGEST {
                return Err(unreadable(format!(
                    "line {number} is longer than {LONGEST} bytes"
                )));
            }
            hash.update(&line);
            if !line.trim_ascii().is_empty() {
                lines.push((at, length as u32, number));
            }
            if lines.len() as u64 > MOST_LINES {
                return Err(unreadable(format!("it has more than {MOST_LINES} lines")));
            }
            at += length as u64;
        }
        match lines.is_empty() {
            true => Err(unreadable("it has no lines".into())),
            false => Ok(Self {
                lines,
                hash: hash.finalize().into(),
                source,
                file,
            }),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> u64 {
        self.lines.len() as u64
    }

    /// The document of a line; any thread may ask.
    pub(super) fn document(&self, position: u64) -> Result<Node, ConfigError> {
        let (at, length, number) = self.lines[position as usize];
        let place = Place {
            source: self.source.clone(),
            line: Some(number as usize),
        };
        let format = |message: String| ConfigError::Format {
            place: place.clone(),
            message,
        };
        let mut bytes = vec![0; length as usize];
        let read = self.file.read_exact_at(&mut bytes, at);
        read.map_err(|error| format(error.to_string()))?;
        let json: serde_json::Value =
            serde_json::from_slice(&bytes).map_err(|error| format(format!("not JSON: {error}")))?;
        match node(&json, &place) {
            Some(node) if json.is_object() => Ok(node),
            Some(_) => Err(format(
                "expected an object with the keys of a problem file".into(),
            )),
            None => Err(format("null; expected no key, or a value".into())),
        }
    }
}

/// The same as a document; `None` where there is a null in it.
fn node(json: &serde_json::Value, place: &Place) -> Option<Node> {
    use serde_json::Value as Json;
    let value = match json {
        Json::Null => return None,
        Json::Bool(yes) => Value::Boolean(*yes),
        Json::Number(number) => match number.as_i64() {
            Some(whole) => Value::Integer(whole),
            None => Value::Float(number.as_f64()?),
        },
        Json::String(text) => Value::Text(text.clone()),
        Json::Array(all) => Value::Array(
            all.iter()
                .map(|one| node(one, place))
                .collect::<Option<_>>()?,
        ),
        Json::Object(entries) => {
            let entry = |(key, value)| Some((String::clone(key), node(value, place)?));
            Value::Table(entries.iter().map(entry).collect::<Option<_>>()?)
        }
    };
    let place = place.clone();
    Some(Node { place, value })
}

/// A document as TOML, a key of the outermost table a line.
pub(super) fn toml(document: &Node) -> String {
    let Value::Table(entries) = &document.value else {
        return String::new();
    };
    let line = |(name, node): &(String, Node)| format!("{} = {}\n", text(name), inline(node));
    entries.iter().map(line).collect()
}

fn inline(node: &Node) -> String {
    let list = |parts: Vec<String>| parts.join(", ");
    match &node.value {
        Value::Text(string) => text(string),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => format!("{number:?}").to_lowercase(),
        Value::Boolean(yes) => yes.to_string(),
        Value::Date(date) => date.clone(),
        Value::Array(all) => format!("[{}]", list(all.iter().map(inline).collect())),
        Value::Table(entries) => {
            let entry =
                |(name, node): &(String, Node)| format!("{} = {}", text(name), inline(node));
            format!("{{ {} }}", list(entries.iter().map(entry).collect()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_is_the_same_as_toml() {
        let json = serde_json::json!({
            "schema": 1,
            "a b": {"c": [1.5, 1e-30, 2], "d": "x\"\u{7f}\n", "e": true, "f": {}},
            "list": [{"x": 1}, {"x": -0.25}],
        });
        let place = Place {
            source: "p.jsonl".into(),
            line: Some(3),
        };
        let document = node(&json, &place).unwrap();
        let again = Node::parse(&"p.toml".into(), &toml(&document)).unwrap();
        assert_eq!(toml(&again), toml(&document));
        let Value::Table(entries) = &again.value else {
            panic!("a table")
        };
        assert_eq!(entries.len(), 3);
        assert_eq!(
            again.get("a b").unwrap().get("d").unwrap().value,
            Value::Text("x\"\u{7f}\n".into())
        );
    }
}
