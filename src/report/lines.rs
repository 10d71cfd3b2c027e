//! Labels and values in two columns.

use std::fmt::Write;
use std::path::PathBuf;

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

    /// Adds the paths of the files that were written.
    pub fn files(&mut self, files: &[PathBuf]) {
        for (i, file) in files.iter().enumerate() {
            let label = if i == 0 { "written" } else { "" };
            self.add(label, file.display().to_string());
        }
    }

    /// All lines, each with its line break.
    pub fn finish(self) -> String {
        self.text
    }
}
