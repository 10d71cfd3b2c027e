//! What a batch varies: keys, and where their values come from.

use super::Cell;
use super::draw::normal;
use crate::config::Place;
use crate::config::distribution::Distribution;
use crate::config::key_path::KeyPath;

/// Most rows of a batch.
pub(super) const MOST_ROWS: u64 = 100_000_000;

/// A key of the problem file with its values.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Vary {
    /// As it is written.
    pub name: String,
    pub key: KeyPath,
    /// Where it is given.
    pub place: Place,
    pub values: Values,
}

/// Where the values of a key come from.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
    /// One after another, every one with every one of the other grids.
    Grid(Vec<Cell>),
    /// A column of a table; all tables go on together.
    Column(Vec<Cell>),
    /// Drawn by itself.
    Drawn(Distribution),
    /// Drawn together with others: mean plus a row of the covariance's factor times independent
    /// normal numbers, one for each of `keys`.
    Correlated {
        mean: f64,
        factor: Vec<f64>,
        keys: Vec<String>,
    },
}

impl Values {
    fn is_drawn(&self) -> bool {
        matches!(self, Self::Drawn(_) | Self::Correlated { .. })
    }
}

/// All that is varied, and how many rows that makes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sweep {
    pub seed: u64,
    pub vary: Vec<Vary>,
    /// Rows of the batch.
    pub count: u64,
}

impl Sweep {
    /// Whether anything is drawn.
    pub(super) fn draws(vary: &[Vary]) -> bool {
        vary.iter().any(|vary| vary.values.is_drawn())
    }

    /// Rows of the tables, which go on together; 1 without any.
    fn table_rows(vary: &[Vary]) -> u64 {
        let columns = vary.iter().filter_map(|vary| match &vary.values {
            Values::Column(column) => Some(column.len() as u64),
            _ => None,
        });
        columns.max().unwrap_or(1)
    }

    /// Rows until all grids and tables begin again; `None` where that is no number of 64 bits.
    pub(super) fn product(vary: &[Vary]) -> Option<u64> {
        let grids = vary.iter().filter_map(|vary| match &vary.values {
            Values::Grid(values) => Some(values.len() as u64),
            _ => None,
        });
        let mut sizes = grids.chain([Self::table_rows(vary)]);
        sizes.try_fold(1_u64, |product, size| product.checked_mul(size))
    }

    /// The values of the row at `position`, in the order of the keys. The last grid goes fastest, the
    /// tables slowest.
    pub(super) fn row(&self, position: u64) -> Vec<Cell> {
        let mut left = position;
        let mut row: Vec<Option<Cell>> = vec![None; self.vary.len()];
        for (vary, cell) in self.vary.iter().zip(&mut row).rev() {
            if let Values::Grid(values) = &vary.values {
                let size = values.len() as u64;
                *cell = Some(values[(left % size) as usize].clone());
                left /= size;
            }
        }
        let of = |vary: &Vary, cell: Option<Cell>| match &vary.values {
            Values::Grid(_) => cell.expect("taken above"),
            Values::Column(column) => column[(left % column.len() as u64) as usize].clone(),
            Values::Drawn(distribution) => {
                Cell::Number(distribution.draw(self.seed, &vary.name, position))
            }
            Values::Correlated { mean, factor, keys } => {
                let parts = keys.iter().zip(factor);
                let sum = parts.map(|(key, part)| part * normal(self.seed, key, position, 0));
                Cell::Number(mean + sum.sum::<f64>())
            }
        };
        let cells = self.vary.iter().zip(row);
        cells.map(|(vary, cell)| of(vary, cell)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vary(name: &str, values: Values) -> Vary {
        Vary {
            name: name.into(),
            key: KeyPath::parse(name).unwrap(),
            place: Place {
                source: "b.toml".into(),
                line: None,
            },
            values,
        }
    }

    fn numbers(values: &[f64]) -> Vec<Cell> {
        values.iter().copied().map(Cell::Number).collect()
    }

    #[test]
    fn a_grid_has_every_combination_once() {
        let vary = vec![
            vary("a", Values::Grid(numbers(&[1.0, 2.0, 3.0]))),
            vary("t", Values::Column(numbers(&[7.0, 8.0]))),
            vary("b", Values::Grid(numbers(&[4.0, 5.0]))),
        ];
        assert_eq!(Sweep::product(&vary), Some(12));
        let (seed, count) = (0, 12);
        let sweep = Sweep { seed, vary, count };
        assert_eq!(sweep.row(0), numbers(&[1.0, 7.0, 4.0]));
        assert_eq!(sweep.row(1), numbers(&[1.0, 7.0, 5.0]));
        assert_eq!(sweep.row(2), numbers(&[2.0, 7.0, 4.0]));
        assert_eq!(sweep.row(6), numbers(&[1.0, 8.0, 4.0]));
        let mut rows: Vec<String> = (0..12).map(|i| format!("{:?}", sweep.row(i))).collect();
        rows.sort();
        rows.dedup();
        assert_eq!(rows.len(), 12);
        assert_eq!(sweep.row(12), sweep.row(0));
    }

    #[test]
    fn correlated_numbers_have_their_covariance() {
        let keys = vec!["a".to_owned(), "b".to_owned()];
        let correlated = |name: &str, factor: &[f64]| {
            let factor = factor.to_vec();
            let keys = keys.clone();
            vary(
                name,
                Values::Correlated {
                    mean: 1.0,
                    factor,
                    keys,
                },
            )
        };
        // Covariance [[4, 2], [2, 5]].
        let vary = vec![correlated("a", &[2.0, 0.0]), correlated("b", &[1.0, 2.0])];
        let (seed, count) = (3, 20_000);
        let sweep = Sweep { seed, vary, count };
        let rows = (0..count).map(|i| match &sweep.row(i)[..] {
            [Cell::Number(a), Cell::Number(b)] => [a - 1.0, b - 1.0],
            _ => unreachable!(),
        });
        let mut sums = [0.0; 3];
        for [a, b] in rows {
            sums[0] += a * a;
            sums[1] += a * b;
            sums[2] += b * b;
        }
        let found = sums.map(|sum| sum / count as f64);
        for (found, expected) in found.iter().zip([4.0, 2.0, 5.0]) {
            assert!((found - expected).abs() < 0.2, "{found}, {expected}");
        }
    }
}
