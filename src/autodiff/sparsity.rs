//! Which derivatives of a function are ever nonzero.

use super::{Dual, Function, HyperDual, Scalar};

/// Nonzero pattern of a function's Jacobian and of its Hessians.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sparsity {
    /// Of each output, the inputs it depends on, ascending.
    pub jacobian: Vec<Vec<usize>>,
    /// Pairs (row ≥ column) of inputs with a nonzero second derivative of any output, by rows.
    pub hessian: Vec<(usize, usize)>,
    /// Outputs with any second derivative.
    pub curved: Vec<usize>,
    /// Outputs that are not zero everywhere.
    pub active: Vec<bool>,
}

/// Inputs looked at together for first derivatives.
const WIDE: usize = 8;
type Slope = Dual<WIDE>;

/// Rows and columns looked at together for second ones.
const TILE: usize = 4;
type Look = HyperDual<TILE, TILE>;

/// Points at which derivatives are looked at.
const SAMPLES: usize = 3;
/// Below this fraction of the output's largest derivative an entry is rounding error.
const NEGLIGIBLE: f64 = 1e-12;

impl Sparsity {
    /// Every derivative counts as nonzero, except those of the inputs where `used` is false.
    pub fn dense(outputs: usize, used: &[bool]) -> Self {
        let inputs: Vec<usize> = (0..used.len()).filter(|&i| used[i]).collect();
        let hessian = inputs
            .iter()
            .flat_map(|&i| {
                inputs
                    .iter()
                    .filter(move |&&j| j <= i)
                    .map(move |&j| (i, j))
            })
            .collect();
        Self {
            jacobian: vec![inputs; outputs],
            hessian,
            curved: (0..outputs).collect(),
            active: vec![true; outputs],
        }
    }

    /// The union of the nonzeros at random points drawn by `draw`.
    ///
    /// Inputs where `used` is false are constants. Where no point is found at which the function
    /// is finite, every derivative counts as nonzero.
    pub fn sampled<F: Function>(f: &F, used: &[bool], mut draw: impl FnMut(&mut [f64])) -> Self {
        let (n, m) = (f.inputs(), f.outputs());
        let mut seen = Seen::new(n, m);
        let mut point = vec![0.0; n];
        let mut points = Vec::with_capacity(SAMPLES);
        for _ in 0..20 * SAMPLES {
            if points.len() == SAMPLES {
                break;
            }
            draw(&mut point);
            if seen.first_at(f, used, &point) {
                points.push(point.clone());
            }
        }
        // What an output does not depend on at all cannot bend it: few inputs are left.
        let matter: Vec<usize> = (0..n).filter(|&i| seen.matters(i)).collect();
        let curved = points
            .iter()
            .filter(|point| seen.second_at(f, &matter, point))
            .count();
        if curved == 0 {
            return Self::dense(m, used);
        }
        seen.pattern()
    }

    /// Inputs that any output depends on, ascending.
    pub fn columns(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self.jacobian.iter().flatten().copied().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

/// Largest magnitudes met so far.
struct Seen {
    inputs: usize,
    /// Of each output.
    size: Vec<f64>,
    /// Of each output by each input.
    first: Vec<Vec<f64>>,
    /// Of each output by each pair of inputs, a square by rows.
    second: Vec<Vec<f64>>,
}

impl Seen {
    fn new(inputs: usize, outputs: usize) -> Self {
        Self {
            inputs,
            size: vec![0.0; outputs],
            first: vec![vec![0.0; inputs]; outputs],
            second: vec![vec![0.0; inputs * inputs]; outputs],
        }
    }

    /// Whether any output depends on input `i`.
    fn matters(&self, i: usize) -> bool {
        self.first.iter().any(|row| row[i] > 0.0)
    }

    /// Adds values and first derivatives at `point`; false where one is not finite.
    fn first_at<F: Function>(&mut self, f: &F, used: &[bool], point: &[f64]) -> bool {
        let mut scratch = f.scratch();
        let mut out = vec![Slope::constant(0.0); f.outputs()];
        let inputs: Vec<usize> = (0..self.inputs).filter(|&i| used[i]).collect();
        let mut found = Vec::new();
        // Without inputs to look at, the values still are.
        for lanes in inputs
            .chunks(WIDE)
            .chain(inputs.is_empty().then_some(&[][..]))
        {
            let mut seeds: Vec<Slope> = point.iter().map(|&p| Slope::constant(p)).collect();
            for (lane, &i) in lanes.iter().enumerate() {
                seeds[i].gradient[lane] = 1.0;
            }
            f.evaluate(&seeds, &mut scratch, &mut out);
            for (r, o) in out.iter().enumerate() {
                found.extend((lanes.iter().zip(o.gradient)).map(|(&i, d)| (r, i, d.abs())));
            }
        }
        let finite =
            found.iter().all(|(.., d)| d.is_finite()) && out.iter().all(|o| o.value.is_finite());
        if finite {
            for (r, i, d) in found {
                self.first[r][i] = self.first[r][i].max(d);
            }
            for (size, o) in self.size.iter_mut().zip(&out) {
                *size = size.max(o.value.abs());
            }
        }
        finite
    }

    /// Adds second derivatives by the inputs that matter; false where one is not finite.
    fn second_at<F: Function>(&mut self, f: &F, matter: &[usize], point: &[f64]) -> bool {
        let mut scratch = f.scratch();
        let mut out = vec![Look::constant(0.0); f.outputs()];
        let blocks: Vec<&[usize]> = matter.chunks(TILE).collect();
        let mut found = Vec::new();
        for (b, rows) in blocks.iter().enumerate() {
            for columns in &blocks[..=b] {
                let mut seeds: Vec<Look> = point.iter().map(|&p| Look::constant(p)).collect();
                rows.iter()
                    .enumerate()
                    .for_each(|(lane, &i)| seeds[i].rows[lane] = 1.0);
                columns
                    .iter()
                    .enumerate()
                    .for_each(|(lane, &j)| seeds[j].columns[lane] = 1.0);
                f.evaluate(&seeds, &mut scratch, &mut out);
                for (r, o) in out.iter().enumerate() {
                    for (a, &i) in rows.iter().enumerate() {
                        for (c, &j) in columns.iter().enumerate() {
                            found.push((r, i * self.inputs + j, o.block[a][c].abs()));
                        }
                    }
                }
            }
        }
        let finite = found.iter().all(|(.., d)| d.is_finite());
        if finite {
            for (r, place, d) in found {
                self.second[r][place] = self.second[r][place].max(d);
            }
        }
        finite
    }

    fn pattern(&self) -> Sparsity {
        let n = self.inputs;
        let peak = |row: &[f64]| row.iter().copied().fold(0.0, f64::max);
        let jacobian = self.first.iter().map(|row| {
            let least = NEGLIGIBLE * peak(row);
            (0..n).filter(|&i| row[i] > least).collect()
        });
        let bent: Vec<Vec<bool>> = (self.second.iter().zip(&self.first))
            .map(|(block, row)| {
                let scale = peak(block).max(peak(row));
                block.iter().map(|&h| h > NEGLIGIBLE * scale).collect()
            })
            .collect();
        let hessian = (0..n)
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .filter(|&(i, j)| bent.iter().any(|block| block[i * n + j]))
            .collect();
        Sparsity {
            jacobian: jacobian.collect(),
            hessian,
            curved: (0..bent.len())
                .filter(|&r| bent[r].contains(&true))
                .collect(),
            active: self.size.iter().map(|&s| s > 0.0).collect(),
        }
    }
}
