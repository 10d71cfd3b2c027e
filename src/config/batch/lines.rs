//! JSON lines: a whole problem a line, with the keys of a problem file.

use super::cell::text;
use super::json::NodeAt;
use super::vary::MOST_ROWS;
use crate::config::document::{Node, Value};
use crate::config::{ConfigError, Place, regular};
use serde::Deserialize;
use serde::de::DeserializeSeed;
use sha2::{Digest, Sha256};
use std::collections::HashSet;
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

/// Largest file of a robot, bytes.
const LARGEST_ROBOT: u64 = 64 << 20;
/// UTF-8 that begins with a mark of the byte order.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// A file of problems, of which a line is read when it is asked for.
#[derive(Debug)]
pub(super) struct Lines {
    file: File,
    source: Arc<str>,
    /// Where each line begins, its length in bytes, and its number in the file, counted from 1.
    lines: Vec<(u64, u32, u32)>,
    /// Of all bytes, and of those of the robots' files.
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
        let folder = path.parent().unwrap_or(Path::new(""));
        // Their names as digests: a file may name as many as it has lines, each as long as a line.
        let mut robots = HashSet::new();
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
            // As in other files of text, some editors put a mark of the byte order before the first line.
            let mark = if number == 1 && line.starts_with(MARK) {
                MARK.len()
            } else {
                0
            };
            let own = &line[mark..];
            if !own.trim_ascii().is_empty() {
                lines.push((at + mark as u64, own.len() as u32, number));
                let robot = robot(own).filter(|name| robots.insert(Sha256::digest(name)));
                if let Some(name) = robot {
                    // What cannot be read makes its rows malformed.
                    let bytes = regular::read(&folder.join(name), LARGEST_ROBOT);
                    hash.update(Sha256::digest(bytes.unwrap_or_default()));
                }
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
        let mut json = serde_json::Deserializer::from_slice(&bytes);
        let read = NodeAt(&place)
            .deserialize(&mut json)
            .and_then(|node| json.end().map(|()| node));
        match read {
            Ok(node) if matches!(node.value, Value::Table(_)) => Ok(node),
            Ok(_) => Err(format(
                "expected an object with the keys of a problem file".into(),
            )),
            Err(error) => Err(format(format!("not JSON: {error}"))),
        }
    }
}

/// The file of the robot that a line names, where it does.
fn robot(line: &[u8]) -> Option<String> {
    #[derive(Deserialize)]
    struct Named {
        robot: Robot,
    }
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Robot {
        Path(String),
        Table { file: String },
    }
    match serde_json::from_slice::<Named>(line).ok()?.robot {
        Robot::Path(path) | Robot::Table { file: path } => Some(path),
    }
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
        let json = json.to_string();
        let place = Place {
            source: "p.jsonl".into(),
            line: Some(3),
        };
        let mut json = serde_json::Deserializer::from_str(&json);
        let document = NodeAt(&place).deserialize(&mut json).unwrap();
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
