//! A table of texts: as Markdown for a person, as CSV for a spreadsheet.

use comfy_table::{CellAlignment, Table, presets};

/// A table of texts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Sheet {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Leading columns that are words.
    words: usize,
}

impl Sheet {
    /// A table without rows yet.
    pub fn new<S: Into<String> + Clone>(header: &[S]) -> Self {
        Self {
            header: header.iter().cloned().map(Into::into).collect(),
            ..Self::default()
        }
    }

    /// The first `columns` to the left, as words stand.
    #[must_use]
    pub fn words(mut self, columns: usize) -> Self {
        self.words = columns;
        self
    }

    /// Adds a row as long as the header.
    pub fn row(&mut self, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.header.len());
        self.rows.push(cells);
    }

    /// The header, then the rows.
    pub(super) fn lines(&self) -> (&[String], &[Vec<String>]) {
        (&self.header, &self.rows)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// As Markdown, columns padded, those of numbers to the right.
    pub fn markdown(&self) -> String {
        let mut table = Table::new();
        table
            .load_style(presets::ASCII_MARKDOWN)
            .set_header(&self.header)
            .add_rows(&self.rows);
        for column in table.column_iter_mut().skip(self.words) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        format!("{table}\n")
    }

    /// As Markdown for tables of words: no padding, all to the left.
    pub fn markdown_words(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = format!("|{}\n", " --- |".repeat(self.header.len()));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        line(&self.header) + &rule + &rows
    }

    /// As CSV.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let records = std::iter::once(&self.header).chain(&self.rows);
        for record in records {
            // Rows are as long as the header and memory does not fail.
            let _ = writer.write_record(record);
        }
        let bytes = writer.into_inner().unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

/// A number with every digit, nothing where it is not finite.
pub fn exact(value: f64) -> String {
    if value.is_finite() {
        value.to_string()
    } else {
        String::new()
    }
}

/// A small number for a person, a dash where it is not finite.
pub fn short(value: f64) -> String {
    if value.is_finite() {
        format!("{value:.2e}")
    } else {
        "–".into()
    }
}
