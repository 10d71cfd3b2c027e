//! Sparse first and second derivatives by sweeps of dual numbers over the nonzeros only.

use super::{Dual, Function, HyperDual, Scalar, Sparsity};

/// Directions of one first-order sweep.
const WIDTH: usize = 8;
/// Rows and columns of one second-order sweep.
const TILE: usize = 4;

type First = Dual<WIDTH>;
type Second = HyperDual<TILE, TILE>;

/// A nonzero that a sweep finds: where it stands in the list of nonzeros and in the sweep.
#[derive(Debug, Clone, Copy)]
struct Entry {
    slot: usize,
    /// Output (first order) or row of the tile (second order).
    row: usize,
    /// Direction in the sweep: the column of the tile at second order.
    direction: usize,
}

#[derive(Debug)]
struct Sweep {
    seeds: Vec<usize>,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Tile {
    rows: Vec<usize>,
    columns: Vec<usize>,
    entries: Vec<Entry>,
}

/// Variables, values and scratch of one number type.
struct Buffers<F: Function, S: Scalar> {
    scratch: F::Scratch<S>,
    inputs: Vec<S>,
    outputs: Vec<S>,
}

impl<F: Function, S: Scalar> Buffers<F, S> {
    fn new(f: &F) -> Self {
        Self {
            scratch: f.scratch(),
            inputs: vec![S::zero(); f.inputs()],
            outputs: vec![S::zero(); f.outputs()],
        }
    }

    fn load(&mut self, point: &[f64]) {
        for (input, &value) in self.inputs.iter_mut().zip(point) {
            *input = S::constant(value);
        }
    }

    fn run(&mut self, f: &F) {
        f.evaluate(&self.inputs, &mut self.scratch, &mut self.outputs);
    }
}

/// Values, sparse Jacobian and sparse weighted Hessian of a [`Function`], allocated once.
pub struct SparseDerivatives<F: Function> {
    sparsity: Sparsity,
    nonzeros: usize,
    sweeps: Vec<Sweep>,
    tiles: Vec<Tile>,
    plain: F::Scratch<f64>,
    first: Buffers<F, First>,
    second: Buffers<F, Second>,
}

impl<F: Function> std::fmt::Debug for SparseDerivatives<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SparseDerivatives")
            .field("sparsity", &self.sparsity)
            .finish_non_exhaustive()
    }
}

impl<F: Function> SparseDerivatives<F> {
    /// Plans the sweeps for the given pattern.
    pub fn new(f: &F, sparsity: Sparsity) -> Self {
        let starts: Vec<usize> = sparsity
            .jacobian
            .iter()
            .scan(0, |next, row| {
                *next += row.len();
                Some(*next - row.len())
            })
            .collect();
        let sweeps = sparsity
            .columns()
            .chunks(WIDTH)
            .map(|seeds| {
                let mut entries = Vec::new();
                for (row, columns) in sparsity.jacobian.iter().enumerate() {
                    for (k, column) in columns.iter().enumerate() {
                        if let Some(direction) = seeds.iter().position(|seed| seed == column) {
                            entries.push(Entry {
                                slot: starts[row] + k,
                                row,
                                direction,
                            });
                        }
                    }
                }
                Sweep {
                    seeds: seeds.to_vec(),
                    entries,
                }
            })
            .collect();
        Self {
            nonzeros: sparsity.jacobian.iter().map(Vec::len).sum(),
            sweeps,
            tiles: tiles(&sparsity),
            plain: f.scratch(),
            first: Buffers::new(f),
            second: Buffers::new(f),
            sparsity,
        }
    }

    /// The nonzero pattern.
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Number of nonzeros of the Jacobian.
    pub fn jacobian_nonzeros(&self) -> usize {
        self.nonzeros
    }

    /// Values at `point`, into `out`.
    pub fn values(&mut self, f: &F, point: &[f64], out: &mut [f64]) {
        f.evaluate(point, &mut self.plain, out);
    }

    /// Nonzeros of the Jacobian at `point`, output by output, into `jacobian`.
    pub fn jacobian(&mut self, f: &F, point: &[f64], jacobian: &mut [f64]) {
        for sweep in &self.sweeps {
            self.first.load(point);
            for (direction, &seed) in sweep.seeds.iter().enumerate() {
                self.first.inputs[seed] = First::seeded(point[seed], direction);
            }
            self.first.run(f);
            for entry in &sweep.entries {
                jacobian[entry.slot] = self.first.outputs[entry.row].gradient[entry.direction];
            }
        }
    }

    /// Nonzeros of Σ weightsᵢ ∇²fᵢ at `point`, in the order of [`Sparsity::hessian`].
    pub fn hessian(&mut self, f: &F, point: &[f64], weights: &[f64], hessian: &mut [f64]) {
        for tile in &self.tiles {
            self.second.load(point);
            for (i, &row) in tile.rows.iter().enumerate() {
                self.second.inputs[row].rows[i] = 1.0;
            }
            for (j, &column) in tile.columns.iter().enumerate() {
                self.second.inputs[column].columns[j] = 1.0;
            }
            self.second.run(f);
            let mut sum = [[0.0; TILE]; TILE];
            for &output in &self.sparsity.curved {
                let weight = weights[output];
                for (sums, terms) in sum.iter_mut().zip(&self.second.outputs[output].block) {
                    for (s, t) in sums.iter_mut().zip(terms) {
                        *s += weight * t;
                    }
                }
            }
            for entry in &tile.entries {
                hessian[entry.slot] = sum[entry.row][entry.direction];
            }
        }
    }
}

/// Tiles of the Hessian that hold a nonzero.
fn tiles(sparsity: &Sparsity) -> Vec<Tile> {
    let mut curved: Vec<usize> = sparsity.hessian.iter().flat_map(|&(i, j)| [i, j]).collect();
    curved.sort_unstable();
    curved.dedup();
    let blocks: Vec<&[usize]> = curved.chunks(TILE).collect();
    let mut tiles = Vec::new();
    for (b, rows) in blocks.iter().enumerate() {
        for columns in &blocks[..=b] {
            let entries: Vec<Entry> = sparsity
                .hessian
                .iter()
                .enumerate()
                .filter_map(|(slot, (i, j))| {
                    let row = rows.iter().position(|r| r == i)?;
                    let direction = columns.iter().position(|c| c == j)?;
                    Some(Entry {
                        slot,
                        row,
                        direction,
                    })
                })
                .collect();
            if !entries.is_empty() {
                tiles.push(Tile {
                    rows: rows.to_vec(),
                    columns: columns.to_vec(),
                    entries,
                });
            }
        }
    }
    tiles
}
