//! The sparsity of a symmetric matrix: its lower triangle by columns.

/// Why lists are not a pattern.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum PatternError {
    /// Column starts do not begin at 0, fall, or do not end at the number of entries.
    #[error("column {0} of the matrix does not start where the one before it ends")]
    Starts(usize),
    /// An entry above the diagonal, or below the last row.
    #[error(
        "the entry at row {row}, column {column} is not in the lower triangle of order {order}"
    )]
    Entry {
        /// Row of the entry.
        row: usize,
        /// Column of the entry.
        column: usize,
        /// Order of the matrix.
        order: usize,
    },
    /// More unknowns or entries than an index counts.
    #[error("the matrix has {0} entries; an index counts to 2147483647")]
    TooLarge(usize),
}

/// Lower triangle by columns. Entries may stand twice and are then summed; a diagonal entry that
/// is not there is zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// Start of each column, one more than there are columns.
    starts: Vec<u32>,
    /// Row of each entry.
    rows: Vec<u32>,
}

impl Pattern {
    /// The pattern of `starts` and `rows`, both counted from 0.
    ///
    /// # Errors
    /// [`PatternError`] where they are no lower triangle.
    pub fn new(starts: Vec<u32>, rows: Vec<u32>) -> Result<Self, PatternError> {
        let order = starts.len().saturating_sub(1);
        if rows.len() > i32::MAX as usize || order > i32::MAX as usize {
            return Err(PatternError::TooLarge(rows.len()));
        }
        if starts.first() != Some(&0) {
            return Err(PatternError::Starts(0));
        }
        if let Some(column) = starts.windows(2).position(|w| w[1] < w[0]) {
            return Err(PatternError::Starts(column + 1));
        }
        if starts[order] as usize != rows.len() {
            return Err(PatternError::Starts(order));
        }
        let pattern = Self { starts, rows };
        let wrong = pattern
            .entries()
            .find(|&(row, column)| row < column || row >= order);
        match wrong {
            None => Ok(pattern),
            Some((row, column)) => Err(PatternError::Entry { row, column, order }),
        }
    }

    /// Order of the matrix.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of entries.
    pub fn nonzeros(&self) -> usize {
        self.rows.len()
    }

    /// Row and column of each entry, in the order of the values.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.len()).flat_map(move |column| {
            self.column(column)
                .iter()
                .map(move |&row| (row as usize, column))
        })
    }

    /// Rows of one column's entries.
    pub fn column(&self, column: usize) -> &[u32] {
        &self.rows[self.starts[column] as usize..self.starts[column + 1] as usize]
    }
}
