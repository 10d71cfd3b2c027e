//! Which derivatives of a function are ever nonzero.

use super::{Function, HyperDual, Scalar};

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

/// Rows and columns looked at together.
const TILE: usize = 4;
type Look = HyperDual<TILE, TILE>;

/// Points at which derivatives are looked at.
const SAMPLES: usize = 6;
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
        let mut first = vec![vec![0.0_f64; n]; m];
        let mut second = vec![vec![0.0_f64; n * n]; m];
        let mut size = vec![0.0_f64; m];
        let mut point = vec![0.0; n];
        let mut taken = 0;
        for _ in 0..20 * SAMPLES {
            if taken == SAMPLES {
                break;
            }
            draw(&mut point);
            taken += usize::from(look(f, used, &point, &mut first, &mut second, &mut size));
        }
        if taken == 0 {
            return Self::dense(m, used);
        }
        let peak = |row: &[f64]| row.iter().copied().fold(0.0, f64::max);
        let jacobian = first
            .iter()
            .map(|row| {
                (0..n)
                    .filter(|&i| row[i] > NEGLIGIBLE * peak(row))
                    .collect()
            })
            .collect();
        let bent: Vec<Vec<bool>> = second
            .iter()
            .zip(&first)
            .map(|(block, row)| {
                let scale = peak(block).max(peak(row));
                block.iter().map(|&h| h > NEGLIGIBLE * scale).collect()
            })
            .collect();
        let hessian = (0..n)
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .filter(|&(i, j)| bent.iter().any(|block| block[i * n + j]))
            .collect();
        Self {
            jacobian,
            hessian,
            curved: (0..m).filter(|&r| bent[r].contains(&true)).collect(),
            active: size.iter().map(|&s| s > 0.0).collect(),
        }
    }

    /// Inputs that any output depends on, ascending.
    pub fn columns(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self.jacobian.iter().flatten().copied().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

/// Adds the magnitudes of all derivatives at `point`; false where one is not finite.
fn look<F: Function>(
    f: &F,
    used: &[bool],
    point: &[f64],
    first: &mut [Vec<f64>],
    second: &mut [Vec<f64>],
    size: &mut [f64],
) -> bool {
    let n = point.len();
    let mut scratch = f.scratch();
    let mut out = vec![Look::constant(0.0); f.outputs()];
    let inputs: Vec<usize> = (0..n).filter(|&i| used[i]).collect();
    let blocks: Vec<&[usize]> = inputs.chunks(TILE).collect();
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
                        found.push((r, i, j, o.rows[a].abs(), o.block[a][c].abs()));
                    }
                }
            }
        }
    }
    let finite = found
        .iter()
        .all(|(.., d, h)| d.is_finite() && h.is_finite())
        && out.iter().all(|o| o.value.is_finite());
    if !finite {
        return false;
    }
    for (r, i, j, gradient, curvature) in found {
        first[r][i] = first[r][i].max(gradient);
        second[r][i * n + j] = second[r][i * n + j].max(curvature);
    }
    for (s, o) in size.iter_mut().zip(&out) {
        *s = s.max(o.value.abs());
    }
    true
}
