//! Places of the nonzeros of a sparse matrix.

/// Rows and columns of nonzeros, in the order of their values. Ipopt counts in 32 bits as well.
#[derive(Debug, Default)]
pub(super) struct Triplets {
    rows: Vec<u32>,
    columns: Vec<u32>,
}

impl Triplets {
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Adds a nonzero; its number is returned.
    pub fn push(&mut self, row: usize, column: usize) -> usize {
        self.rows.push(index(row));
        self.columns.push(index(column));
        self.rows.len() - 1
    }

    /// Rows and columns of all nonzeros.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> {
        let places = self.rows.iter().zip(&self.columns);
        places.map(|(&row, &column)| (row as usize, column as usize))
    }

    /// Writes rows and columns of all nonzeros.
    pub fn write(&self, rows: &mut [usize], columns: &mut [usize]) {
        for ((row, column), place) in rows.iter_mut().zip(columns).zip(self.iter()) {
            (*row, *column) = place;
        }
    }

    /// Gives back what was reserved for more.
    pub fn close(&mut self) {
        self.rows.shrink_to_fit();
        self.columns.shrink_to_fit();
    }
}

/// `value` in 32 bits.
///
/// # Panics
/// Where it does not fit.
pub(super) fn index(value: usize) -> u32 {
    u32::try_from(value).expect("no programme has as many variables, rows or nonzeros")
}
