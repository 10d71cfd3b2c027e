//! Columns in memory.

/// A column with its name.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its values, one a row.
    pub data: Data,
}

/// Values of a column; `None` where a row has none.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Data {
    /// Texts.
    Text(Vec<Option<String>>),
    /// Whole numbers.
    Integer(Vec<Option<i64>>),
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Arrays of numbers.
    Numbers(Vec<Option<Vec<f64>>>),
    /// Arrays of arrays of numbers.
    Rows(Vec<Option<Vec<Vec<f64>>>>),
}

impl Data {
    /// How many rows there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Text(values) => values.len(),
            Self::Integer(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Numbers(values) => values.len(),
            Self::Rows(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Keeps the rows that `keep` says.
    pub(super) fn retain(&mut self, keep: &[bool]) {
        fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
            let mut keep = keep.iter();
            values.retain(|_| keep.next().is_none_or(|keep| *keep));
        }
        match self {
            Self::Text(values) => retain(values, keep),
            Self::Integer(values) => retain(values, keep),
            Self::Number(values) => retain(values, keep),
            Self::Numbers(values) => retain(values, keep),
            Self::Rows(values) => retain(values, keep),
        }
    }
}
