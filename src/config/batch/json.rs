//! JSON as a document. A key that stands twice is refused: which of the two was meant is not known.

use crate::config::Place;
use crate::config::document::{Node, Value};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::collections::HashSet;
use std::fmt;

/// A value of a document, all of it given at one place.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeAt<'a>(pub &'a Place);

impl NodeAt<'_> {
    fn node<E>(self, value: Value) -> Result<Node, E> {
        let place = self.0.clone();
        Ok(Node { place, value })
    }
}

impl<'de> DeserializeSeed<'de> for NodeAt<'_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for NodeAt<'_> {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no key, or a value other than null")
    }

    fn visit_bool<E>(self, yes: bool) -> Result<Node, E> {
        self.node(Value::Boolean(yes))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Node, E> {
        self.node(Value::Integer(number))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Node, E> {
        let whole = i64::try_from(number);
        self.node(whole.map_or(Value::Float(number as f64), Value::Integer))
    }

    fn visit_f64<E>(self, number: f64) -> Result<Node, E> {
        self.node(Value::Float(number))
    }

    fn visit_str<E>(self, text: &str) -> Result<Node, E> {
        self.node(Value::Text(text.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut all: A) -> Result<Node, A::Error> {
        let mut elements = Vec::new();
        while let Some(element) = all.next_element_seed(self)? {
            elements.push(element);
        }
        self.node(Value::Array(elements))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut all: A) -> Result<Node, A::Error> {
        let (mut entries, mut names) = (Vec::new(), HashSet::new());
        while let Some(key) = all.next_key::<String>()? {
            if !names.insert(key.clone()) {
                return Err(A::Error::custom(format!("the key {key:?} stands twice")));
            }
            entries.push((key, all.next_value_seed(self)?));
        }
        self.node(Value::Table(entries))
    }
}
