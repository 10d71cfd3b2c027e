//! The name, which names the output folder.

use super::checks::{Checked, error};

/// Longest name, bytes: with what is added to it, a file's name.
const LONGEST: usize = 120;

/// What makes a name, for messages.
pub(crate) const EXPECTED: &str = "at most 120 bytes of letters, digits, '-', '_', '.' and spaces \
     between them, for it names the output folder";

/// Whether `name` names a folder within another one, and nothing else.
pub(crate) fn is_name(name: &str) -> bool {
    let harmless = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
    name.trim() == name
        && !name.trim_matches('.').is_empty()
        && name.chars().all(harmless)
        && name.len() <= LONGEST
}

pub(super) fn check(name: &str) -> Checked {
    match is_name(name) {
        true => Ok(()),
        false => Err(error("name", shown(name), EXPECTED)),
    }
}

/// The name in quotes, cut where it is long.
fn shown(name: &str) -> String {
    const MOST: usize = 40;
    match name.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?}…", &name[..end]),
        None => format!("{name:?}"),
    }
}
