//! Labels and values in two columns.

use std::fmt::Write;

/// Labels and values in two columns, indented by two.
#[derive(Debug, Clone, Default)]
pub struct Lines {
    text: String,
}

impl Lines {
    /// Adds a line.
    pub fn add(&mut self, label: &str, value: impl AsRef<str>) {
        let line = format!("  {label:<19} {}", value.as_ref());
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{}", line.trim_end());
    }

    /// All lines, each with its line break.
    pub fn finish(self) -> String {
        self.text
    }
}
