//! Solution with the factors: forward substitution, division by the pivots, backward substitution.

use super::factor::Factors;
use super::simd::{Kernel, LANES, Vector, dispatch, padded};
use super::subtree::{FrontPlace, Subtree};
use super::symbolic::{Front, Symbolic};
use super::update::{axpy, axpy4, dot, dot4};

impl Factors {
    /// Overwrites the right-hand side `x` by the solution.
    ///
    /// `x` has one number for each unknown. Unknowns with zero pivots are set to zero.
    ///
    /// # Panics
    /// Where `x` is shorter than the order of the matrix, or nothing was factorised yet.
    pub fn solve(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        assert!(x.len() >= symbolic.len());
        if self.is_scaled {
            self.scaling.apply(x);
        }
        dispatch(Solve {
            factors: self,
            symbolic,
            x: &mut *x,
        });
        if self.is_scaled {
            self.scaling.apply(x);
        }
    }

    #[inline(always)]
    fn solve_with<V: Vector>(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        let Self {
            subtrees, vector, ..
        } = self;
        for (subtree, size) in subtrees.iter().zip(&symbolic.subtrees) {
            for (front, place) in symbolic.fronts[size.fronts.clone()]
                .iter()
                .zip(&subtree.places)
            {
                forward::<V>(symbolic, subtree, front, place, vector, x);
            }
        }
        for (subtree, size) in subtrees.iter().zip(&symbolic.subtrees).rev() {
            let fronts = symbolic.fronts[size.fronts.clone()].iter();
            for (front, place) in fronts.zip(&subtree.places).rev() {
                backward::<V>(symbolic, subtree, front, place, vector, x);
            }
        }
    }
}

/// The solution, for whatever vectors the processor has.
struct Solve<'a> {
    factors: &'a mut Factors,
    symbolic: &'a Symbolic,
    x: &'a mut [f64],
}

impl Kernel for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        self.factors.solve_with::<V>(self.symbolic, self.x);
    }
}

/// Forward substitution with one front, and division by its pivots.
#[inline(always)]
fn forward<V: Vector>(
    symbolic: &Symbolic,
    subtree: &Subtree,
    front: &Front,
    place: &FrontPlace,
    vector: &mut [f64],
    x: &mut [f64],
) {
    let pivots = padded(place.columns);
    let ld = pivots + padded(front.border);
    let unknowns = &subtree.unknowns[place.pivots..place.pivots + place.columns];
    let inverse = &subtree.inverse[place.pivots..place.pivots + place.columns];
    let y = gather(vector, pivots, unknowns, x);
    y[pivots..ld].fill(0.0);
    let panel = &subtree.panels[place.panel..place.panel + ld * place.eliminated];
    let (y, _) = y[..ld].as_chunks_mut::<LANES>();
    for (group, columns) in panel.chunks(LANES * ld).enumerate() {
        let (y, below) = y[group..].split_at_mut(1);
        let y = &mut y[0];
        if columns.len() == LANES * ld {
            let columns = columns_of(columns, ld, group);
            for k in 0..LANES {
                for r in k + 1..LANES {
                    y[r] -= y[k] * columns[k][0][r];
                }
            }
            axpy4::<V>(y, columns.map(|column| &column[1..]), below);
        } else {
            for (k, column) in columns.chunks_exact(ld).enumerate() {
                let (corner, column) = column[group * LANES..].split_at(LANES);
                for r in k + 1..LANES {
                    y[r] -= y[k] * corner[r];
                }
                axpy::<V>(y[k], column, below.as_flattened_mut());
            }
        }
    }
    let y = y.as_flattened();
    let mut k = 0;
    while k < place.eliminated {
        let [d, link] = inverse[k];
        if link == 0.0 {
            x[unknowns[k] as usize] = d * y[k];
            k += 1;
        } else {
            let e = inverse[k + 1][0];
            x[unknowns[k] as usize] = d * y[k] + link * y[k + 1];
            x[unknowns[k + 1] as usize] = link * y[k] + e * y[k + 1];
            k += 2;
        }
    }
    for k in place.eliminated..place.columns {
        x[unknowns[k] as usize] = y[k];
    }
    let border = &symbolic.rows[front.rows + front.pivots..][..front.border];
    for (&unknown, y) in border.iter().zip(&y[pivots..]) {
        x[unknown as usize] += y;
    }
}

/// Backward substitution with one front: its unknowns from those of its border.
#[inline(always)]
fn backward<V: Vector>(
    symbolic: &Symbolic,
    subtree: &Subtree,
    front: &Front,
    place: &FrontPlace,
    vector: &mut [f64],
    x: &mut [f64],
) {
    let pivots = padded(place.columns);
    let ld = pivots + padded(front.border);
    let unknowns = &subtree.unknowns[place.pivots..place.pivots + place.columns];
    let y = gather(vector, pivots, unknowns, x);
    let border = &symbolic.rows[front.rows + front.pivots..][..front.border];
    for (y, &unknown) in y[pivots..].iter_mut().zip(border) {
        *y = x[unknown as usize];
    }
    y[pivots + front.border..ld].fill(0.0);
    let panel = &subtree.panels[place.panel..place.panel + ld * place.eliminated];
    let (y, _) = y[..ld].as_chunks_mut::<LANES>();
    for (group, columns) in panel.chunks(LANES * ld).enumerate().rev() {
        let (y, below) = y[group..].split_at_mut(1);
        let y = &mut y[0];
        if columns.len() == LANES * ld {
            let columns = columns_of(columns, ld, group);
            let mut sums = dot4::<V>(columns.map(|column| &column[1..]), below);
            for k in (0..LANES).rev() {
                for r in k + 1..LANES {
                    sums[k] += y[r] * columns[k][0][r];
                }
                y[k] -= sums[k];
            }
        } else {
            for (k, column) in columns.chunks_exact(ld).enumerate().rev() {
                let (corner, column) = column[group * LANES..].split_at(LANES);
                let mut sum = dot::<V>(column, below.as_flattened());
                for r in k + 1..LANES {
                    sum += y[r] * corner[r];
                }
                y[k] -= sum;
            }
        }
    }
    let y = y.as_flattened();
    for (y, &unknown) in y.iter().zip(&unknowns[..place.eliminated]) {
        x[unknown as usize] = *y;
    }
}

/// [`LANES`] columns of length `ld`, from the vector with number `first` on.
#[inline(always)]
fn columns_of(columns: &[f64], ld: usize, first: usize) -> [&[[f64; LANES]]; LANES] {
    let column = |k: usize| &columns[k * ld..(k + 1) * ld].as_chunks().0[first..];
    [column(0), column(1), column(2), column(3)]
}

/// Copies the right-hand side of `unknowns` to the first rows of `vector`, and fills up to `pivots`
/// rows with zeros.
#[inline(always)]
fn gather<'v>(vector: &'v mut [f64], pivots: usize, unknowns: &[u32], x: &[f64]) -> &'v mut [f64] {
    vector[unknowns.len()..pivots].fill(0.0);
    for (y, &unknown) in vector.iter_mut().zip(unknowns) {
        *y = x[unknown as usize];
    }
    vector
}
