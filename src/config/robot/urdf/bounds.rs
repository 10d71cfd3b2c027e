//! What no robot's file has, and what would take time or memory out of all proportion to read.

use super::element::Source;
use crate::config::ConfigError;

/// Largest file, bytes.
const LARGEST: usize = 32 << 20;
/// Most declarations of name spaces: each element knows all that hold where it stands.
const MOST_NAME_SPACES: usize = 100;
/// Most attributes of an element, which are held against each other.
const MOST_ATTRIBUTES: usize = 200;
/// Most elements within each other.
const DEEPEST: usize = 200;

/// Refuses `text` where it is out of proportion.
///
/// It is looked over as bytes, before it is known to be XML.
pub(super) fn check(source: &Source<'_>, text: &str) -> Result<(), ConfigError> {
    if text.len() > LARGEST {
        let message = format!("the file is larger than {} MiB", LARGEST >> 20);
        let place = source.whole();
        return Err(ConfigError::Format { place, message });
    }
    let mut found = Counts::default();
    let mut i = 0;
    while i < text.len() {
        i += found.count(&text.as_bytes()[i..]);
        if let Some(message) = found.excess() {
            let line = 1 + text.as_bytes()[..i].iter().filter(|b| **b == b'\n').count();
            let place = source.line(Some(line));
            return Err(ConfigError::Format { place, message });
        }
    }
    Ok(())
}

/// What was met so far.
#[derive(Default)]
struct Counts {
    depth: usize,
    /// In the present element.
    attributes: usize,
    name_spaces: usize,
}

impl Counts {
    /// Counts what `rest` begins with; the number of bytes that are done with.
    fn count(&mut self, rest: &[u8]) -> usize {
        for (begin, end) in [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")] {
            if rest.starts_with(begin.as_bytes()) {
                let mut windows = rest.windows(end.len());
                let end_at = windows.position(|window| window == end.as_bytes());
                return end_at.map_or(rest.len(), |at| at + end.len());
            }
        }
        match rest {
            [b'<', b'/', ..] | [b'/', b'>', ..] => self.depth = self.depth.saturating_sub(1),
            [b'<', ..] => (self.depth, self.attributes) = (self.depth + 1, 0),
            [b'=', after @ ..] => {
                let mut after = after.iter().filter(|byte| !byte.is_ascii_whitespace());
                let quoted = matches!(after.next(), Some(b'"' | b'\''));
                self.attributes += usize::from(quoted);
            }
            [b'x', ..] if rest.starts_with(b"xmlns") => self.name_spaces += 1,
            _ => {}
        }
        1
    }

    fn excess(&self) -> Option<String> {
        if self.depth > DEEPEST {
            Some(format!("more than {DEEPEST} elements within each other"))
        } else if self.attributes > MOST_ATTRIBUTES {
            Some(format!(
                "an element with more than {MOST_ATTRIBUTES} attributes"
            ))
        } else if self.name_spaces > MOST_NAME_SPACES {
            Some(format!("more than {MOST_NAME_SPACES} name spaces"))
        } else {
            None
        }
    }
}
