//! An element of a URDF file: each failure names its line, its link or joint and its tag.

use crate::config::document::quoted;
use crate::config::{ConfigError, Place};
use crate::text::printable::one_line;
use roxmltree::Node;
use std::sync::Arc;

/// A text whose byte positions can be told by line.
#[derive(Debug)]
pub(super) struct Source<'a> {
    name: &'a Arc<str>,
    /// Positions of the line breaks.
    breaks: Vec<usize>,
}

impl<'a> Source<'a> {
    /// The file `name` with its text.
    pub(super) fn new(name: &'a Arc<str>, text: &str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self {
            name,
            breaks: breaks.map(|(position, _)| position).collect(),
        }
    }

    /// The whole file.
    pub(super) fn whole(&self) -> Place {
        self.line(None)
    }

    /// A line of it, counted from 1.
    pub(super) fn line(&self, line: Option<usize>) -> Place {
        Place {
            source: self.name.clone(),
            line,
        }
    }

    fn place(&self, position: usize) -> Place {
        self.line(Some(1 + self.breaks.partition_point(|at| *at < position)))
    }
}

/// The children of that tag, in the name space of the whole file.
pub(super) fn children<'a, 'input>(
    node: Node<'a, 'input>,
    tag: &str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    let space = node.document().root_element().tag_name().namespace();
    node.children().filter(move |child| {
        child.tag_name().name() == tag && child.tag_name().namespace() == space
    })
}

/// An element with what messages call it.
#[derive(Debug, Clone)]
pub(super) struct Element<'a, 'input> {
    source: &'a Source<'a>,
    node: Node<'a, 'input>,
    /// "joint 'elbow' <limit>".
    path: String,
}

impl<'a, 'input> Element<'a, 'input> {
    /// A `<link>`, `<joint>` or the `<robot>`, called by its name where it has one.
    pub(super) fn top(source: &'a Source<'a>, node: Node<'a, 'input>) -> Self {
        let tag = node.tag_name().name();
        let path = match node.attribute("name") {
            Some(name) if tag != "robot" => format!("{tag} '{}'", one_line(name, 80)),
            _ => format!("<{tag}>"),
        };
        Self { source, node, path }
    }

    /// Where it starts.
    pub(super) fn place(&self) -> Place {
        self.source.place(self.node.range().start)
    }

    /// What messages call it.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// An error about the whole element.
    pub(super) fn error(
        &self,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> ConfigError {
        ConfigError::Value {
            place: self.place(),
            key: self.path.clone(),
            found: found.into(),
            expected: expected.into(),
        }
    }

    /// Its child of that tag; there may be one at most.
    pub(super) fn child(&self, tag: &str) -> Result<Option<Self>, ConfigError> {
        let mut found = children(self.node, tag);
        let first = found.next().map(|node| Self {
            source: self.source,
            node,
            path: format!("{} <{tag}>", self.path),
        });
        match (first, found.next()) {
            (Some(first), Some(second)) => {
                let second = Self {
                    node: second,
                    ..first
                };
                Err(second.error("given twice", "one at most"))
            }
            (first, _) => Ok(first),
        }
    }

    /// All its children of that tag.
    pub(super) fn children(&self, tag: &str) -> Vec<Self> {
        let path = format!("{} <{tag}>", self.path);
        let of = |node| Self {
            source: self.source,
            node,
            path: path.clone(),
        };
        children(self.node, tag).map(of).collect()
    }

    /// Its child of that tag, which must be there.
    pub(super) fn require(&self, tag: &str, expected: &str) -> Result<Self, ConfigError> {
        self.child(tag)?.ok_or_else(|| ConfigError::Missing {
            place: self.place(),
            key: format!("{} <{tag}>", self.path),
            expected: expected.into(),
        })
    }

    /// An attribute, without the blanks around it.
    pub(super) fn get(&self, name: &str) -> Option<Attribute<'_, 'a, 'input>> {
        let text = self.node.attribute(name)?.trim();
        Some(Attribute {
            element: self,
            name: name.into(),
            text,
        })
    }

    /// An attribute that must be there.
    pub(super) fn attribute(
        &self,
        name: &str,
        expected: &str,
    ) -> Result<Attribute<'_, 'a, 'input>, ConfigError> {
        self.get(name).ok_or_else(|| ConfigError::Missing {
            place: self.place(),
            key: format!("{} {name}", self.path),
            expected: expected.into(),
        })
    }

    /// A name that is not empty.
    pub(super) fn name(&self, attribute: &str) -> Result<String, ConfigError> {
        let expected = "a name that is not empty";
        let found = self.attribute(attribute, expected)?;
        match found.text {
            name if name.is_empty() || is_expression(name) => Err(found.unexpected(expected)),
            name => Ok(name.into()),
        }
    }
}

/// Whether xacro would put another text in place of this one.
fn is_expression(text: &str) -> bool {
    text.contains("${") || text.contains("$(")
}

/// An attribute of an element.
#[derive(Debug)]
pub(super) struct Attribute<'e, 'a, 'input> {
    element: &'e Element<'a, 'input>,
    name: String,
    /// What it holds.
    pub text: &'e str,
}

impl Attribute<'_, '_, '_> {
    /// An error about the attribute, which is not what was expected.
    pub(super) fn unexpected(&self, expected: &str) -> ConfigError {
        let node = self.element.node.attribute_node(self.name.as_str());
        let start = node.map_or(self.element.node.range().start, |node| node.range().start);
        let hint = if is_expression(self.text) {
            " (an expression of xacro's; run xacro on the file first)"
        } else {
            ""
        };
        ConfigError::Value {
            place: self.element.source.place(start),
            key: format!("{} {}", self.element.path, self.name),
            found: quoted(self.text),
            expected: format!("{expected}{hint}"),
        }
    }

    /// A number, infinite ones included; never NaN.
    pub(super) fn number(&self, expected: &str) -> Result<f64, ConfigError> {
        self.text
            .parse::<f64>()
            .ok()
            .filter(|number| !number.is_nan())
            .ok_or_else(|| self.unexpected(expected))
    }

    /// A finite number.
    pub(super) fn finite(&self, expected: &str) -> Result<f64, ConfigError> {
        match self.number(expected)? {
            number if number.is_finite() => Ok(number),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// Three finite numbers.
    pub(super) fn triple(&self, expected: &str) -> Result<[f64; 3], ConfigError> {
        self.text
            .split_whitespace()
            .map(|word| word.parse().ok().filter(|number: &f64| number.is_finite()))
            .collect::<Option<Vec<f64>>>()
            .and_then(|numbers| numbers.try_into().ok())
            .ok_or_else(|| self.unexpected(expected))
    }
}
