//! The path of a key: `task.final.joints[0]`.

use std::fmt;

/// One step down a document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    /// Into a table.
    Name(String),
    /// Into an array, counted from 0.
    Index(usize),
}

/// The way to a value of a document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct KeyPath {
    pub steps: Vec<Step>,
}

impl KeyPath {
    /// Reads `a.b[0]`; `None` where a part is empty.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let mut steps = Vec::new();
        for part in text.split('.') {
            let (name, indices) = indexed(part);
            if name.is_empty() {
                return None;
            }
            steps.push(Step::Name(name.into()));
            steps.extend(indices.into_iter().map(Step::Index));
        }
        Some(Self { steps })
    }
}

/// A part of a key and the indices behind it. Brackets that hold no number are part of the name.
fn indexed(part: &str) -> (&str, Vec<usize>) {
    let mut name = part;
    let mut indices = Vec::new();
    while let Some(open) = name.strip_suffix(']')
        && let Some((before, index)) = open.rsplit_once('[')
        && let Ok(index) = index.parse()
    {
        name = before;
        indices.push(index);
    }
    indices.reverse();
    (name, indices)
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.steps.iter().enumerate() {
            match step {
                Step::Name(name) if i == 0 => f.write_str(name)?,
                Step::Name(name) => write!(f, ".{name}")?,
                Step::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_read_and_written() {
        for text in ["a", "a.b", "a.b[0]", "a[2][10].c", "a[x]", "a[-1]"] {
            assert_eq!(KeyPath::parse(text).unwrap().to_string(), text);
        }
        let steps = KeyPath::parse("a.b[0][12]").unwrap().steps;
        assert_eq!(steps[2..], [Step::Index(0), Step::Index(12)]);
        for text in ["", "a.", ".a", "a..b", "[0]"] {
            assert_eq!(KeyPath::parse(text), None, "{text}");
        }
    }
}
