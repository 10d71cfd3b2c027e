//! Typed reading of a document: each failure names its key.

use super::document::{Node, Value};
use super::{ConfigError, Place};
use crate::text::printable::one_line;

/// Largest magnitude of any number: products of several do not overflow.
const MOST: f64 = 1e30;

/// Longest part of a key in messages, characters.
const LONGEST_NAME: usize = 80;

/// A value with its full key path.
#[derive(Debug, Clone)]
pub(super) struct Item<'a> {
    pub key: String,
    /// Last part of the key.
    pub name: &'a str,
    pub node: &'a Node,
}

impl<'a> Item<'a> {
    /// A whole document.
    pub(super) fn root(node: &'a Node) -> Self {
        Self {
            key: String::new(),
            name: "",
            node,
        }
    }

    fn path(&self, name: &str) -> String {
        // A quoted key may hold anything.
        let name = one_line(name, LONGEST_NAME);
        if self.key.is_empty() {
            name
        } else {
            format!("{}.{name}", self.key)
        }
    }

    /// An error about this value.
    pub(super) fn error(
        &self,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> ConfigError {
        ConfigError::Value {
            place: self.node.place.clone(),
            key: self.key.clone(),
            found: found.into(),
            expected: expected.into(),
        }
    }

    /// An error about this value, which is not what was expected.
    pub(super) fn unexpected(&self, expected: impl Into<String>) -> ConfigError {
        self.error(self.node.describe(), expected)
    }

    /// The entries of a table that has no keys but `known`.
    pub(super) fn section(&self, known: &[&str]) -> Result<Section<'a>, ConfigError> {
        let section = Section {
            entries: self.entries("a table")?,
            item: self.clone(),
        };
        for item in &section.entries {
            if !known.contains(&item.name) {
                return Err(ConfigError::UnknownKey {
                    place: item.node.place.clone(),
                    key: item.key.clone(),
                    hint: hint(item.name, known),
                });
            }
        }
        Ok(section)
    }

    /// The entries of a table with any keys.
    pub(super) fn entries(&self, expected: &str) -> Result<Vec<Self>, ConfigError> {
        match &self.node.value {
            Value::Table(entries) => {
                let entry = |(name, node): &'a (String, Node)| Self {
                    key: self.path(name),
                    name,
                    node,
                };
                Ok(entries.iter().map(entry).collect())
            }
            _ => Err(self.unexpected(expected)),
        }
    }

    /// The entries, where this is a table.
    pub(super) fn as_entries(&self) -> Option<Vec<Self>> {
        self.entries("").ok()
    }

    /// The elements, where this is an array.
    pub(super) fn as_elements(&self) -> Option<Vec<Self>> {
        let Value::Array(elements) = &self.node.value else {
            return None;
        };
        let element = |(i, node)| Self {
            key: format!("{}[{i}]", self.key),
            name: self.name,
            node,
        };
        Some(elements.iter().enumerate().map(element).collect())
    }

    /// The number, where this is one: whole, real, infinite or NaN.
    pub(super) fn as_number(&self) -> Option<f64> {
        match self.node.value {
            Value::Integer(number) => Some(number as f64),
            Value::Float(number) => Some(number),
            _ => None,
        }
    }

    /// A finite number of a magnitude that makes sense in some unit.
    pub(super) fn number(&self, expected: &str) -> Result<f64, ConfigError> {
        match self.as_number() {
            Some(number) if number.abs() <= MOST => Ok(number),
            Some(number) if number.is_finite() => {
                Err(self.unexpected(format!("{expected}, of a magnitude up to {MOST:e}")))
            }
            _ => Err(self.unexpected(expected)),
        }
    }

    /// A finite number above zero.
    pub(super) fn positive(&self, expected: &str) -> Result<f64, ConfigError> {
        match self.number(expected)? {
            number if number > 0.0 => Ok(number),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// A whole number from 1 to `most`.
    pub(super) fn count(&self, most: usize) -> Result<usize, ConfigError> {
        match self.node.value {
            Value::Integer(number) => usize::try_from(number).ok(),
            // As a data set has it, whose columns are of one kind of number.
            Value::Float(number) if number.fract() == 0.0 && number >= 0.0 => Some(number as usize),
            _ => None,
        }
        .filter(|number| (1..=most).contains(number))
        .ok_or_else(|| self.unexpected(format!("a whole number from 1 to {most}")))
    }

    /// A text.
    pub(super) fn text(&self, expected: &str) -> Result<&'a str, ConfigError> {
        match &self.node.value {
            Value::Text(text) => Ok(text),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// Exactly three finite numbers.
    pub(super) fn triple(&self, expected: &str) -> Result<[f64; 3], ConfigError> {
        let elements = self
            .as_elements()
            .ok_or_else(|| self.unexpected(expected))?;
        let numbers = elements
            .iter()
            .map(|element| element.number("a finite number"))
            .collect::<Result<Vec<_>, _>>()?;
        numbers.try_into().map_err(|_| self.unexpected(expected))
    }
}

/// A table whose keys have been checked.
#[derive(Debug, Clone)]
pub(super) struct Section<'a> {
    entries: Vec<Item<'a>>,
    item: Item<'a>,
}

impl<'a> Section<'a> {
    /// The value of a key, where it is given.
    pub(super) fn get(&self, name: &str) -> Option<&Item<'a>> {
        self.entries.iter().find(|item| item.name == name)
    }

    /// The value of a key that must be given.
    pub(super) fn require(&self, name: &str, expected: &str) -> Result<&Item<'a>, ConfigError> {
        self.get(name).ok_or_else(|| self.missing(name, expected))
    }

    /// An error about a key that is not given.
    pub(super) fn missing(&self, name: &str, expected: &str) -> ConfigError {
        ConfigError::Missing {
            place: self.place(),
            key: self.item.path(name),
            expected: expected.into(),
        }
    }

    /// Where the table is given.
    pub(super) fn place(&self) -> Place {
        self.item.node.place.clone()
    }
}

/// The nearest of `known`, or all of them.
pub(super) fn hint(name: &str, known: &[&str]) -> String {
    // What is longer is no typing error, and takes its length times theirs to compare.
    const LONGEST: usize = 80;
    if known.is_empty() {
        return "there are none".into();
    }
    let known_short = known.iter().filter(|candidate| candidate.len() <= LONGEST);
    let known_short = known_short.filter(|_| name.len() <= LONGEST);
    let distance = |candidate: &str| strsim::damerau_levenshtein(name, candidate);
    let near = |candidate: &&&str| distance(candidate) <= 1 + candidate.len().max(name.len()) / 4;
    match known_short
        .filter(near)
        .min_by_key(|candidate| distance(candidate))
    {
        Some(nearest) => format!("did you mean '{nearest}'?"),
        None => format!("expected one of {}", known.join(", ")),
    }
}
