//! Dense kernels on whole vectors: the rank update C −= L (D Lᵀ) in register tiles, column updates,
//! products and largest magnitudes.

#![expect(
    unsafe_code,
    reason = "the innermost loop of the rank update reads without a bounds check a column"
)]

use super::simd::{LANES, Vector};

/// Eliminated columns of a front.
#[derive(Clone, Copy)]
pub(super) struct Eliminated<'a> {
    /// L, by columns of length `ld`.
    pub l: &'a [f64],
    /// (D Lᵀ)ᵀ, by columns of length `ld`, with four more numbers at the end.
    pub w: &'a [f64],
    pub ld: usize,
}

/// Up to four columns that are updated together.
pub(super) struct Target<'a> {
    /// Columns of length `ld`.
    pub columns: &'a mut [f64],
    pub ld: usize,
    /// The first row to be updated; rows from here on are whole vectors.
    pub row: usize,
}

/// target[target.row.., ..] −= Σ L[row.., k] W[j.., k]; where `FRESH`, the target is overwritten, as
/// if it had been zero.
#[inline(always)]
pub(super) fn rank_update<V: Vector, const FRESH: bool>(
    from: Eliminated<'_>,
    row: usize,
    j: usize,
    mut target: Target<'_>,
) {
    let mut done = 0;
    let rows = target.ld - target.row;
    while rows - done >= 3 * LANES {
        tile::<V, 3, FRESH>(from, row + done, j, target.below(done));
        done += 3 * LANES;
    }
    match (rows - done) / LANES {
        2 => tile::<V, 2, FRESH>(from, row + done, j, target.below(done)),
        1 => tile::<V, 1, FRESH>(from, row + done, j, target.below(done)),
        _ => {}
    }
}

impl Target<'_> {
    /// The same columns from `rows` further down.
    #[inline(always)]
    fn below(&mut self, rows: usize) -> Target<'_> {
        Target {
            columns: self.columns,
            ld: self.ld,
            row: self.row + rows,
        }
    }
}

/// `R` vectors of rows of [`rank_update`].
#[inline(always)]
fn tile<V: Vector, const R: usize, const FRESH: bool>(
    from: Eliminated<'_>,
    row: usize,
    j: usize,
    target: Target<'_>,
) {
    let Eliminated { l, w, ld } = from;
    let zero = V::splat(0.0);
    let mut sums = [[zero; R]; 4];
    let depth = l.len() / ld;
    assert!(row + R * LANES <= ld && w.len() >= depth * ld + 4 && j <= ld);
    for k in 0..depth {
        // SAFETY: by the assertion the rows of L end within column k, and those of W, which may
        // begin in its last rows, not beyond the array.
        let (l, w) = unsafe {
            (
                &*l.as_ptr().add(k * ld + row).cast::<[[f64; LANES]; R]>(),
                &*w.as_ptr().add(k * ld + j).cast::<[f64; 4]>(),
            )
        };
        let l: [V; R] = std::array::from_fn(|r| V::load(&l[r]));
        for (sums, &w) in sums.iter_mut().zip(w) {
            let w = V::splat(w);
            for (sum, l) in sums.iter_mut().zip(l) {
                *sum = l.times_plus(w, *sum);
            }
        }
    }
    for (column, sums) in target.columns.chunks_exact_mut(target.ld).zip(&sums) {
        let (column, _) = column[target.row..].as_chunks_mut::<LANES>();
        for (c, sum) in column.iter_mut().zip(sums) {
            let before = if FRESH { zero } else { V::load(c) };
            before.minus(*sum).store(c);
        }
    }
}

/// Largest magnitude, of whole vectors.
#[inline(always)]
pub(super) fn largest<V: Vector>(column: &[f64]) -> f64 {
    let (column, _) = column.as_chunks::<LANES>();
    let (pairs, rest) = column.as_chunks::<2>();
    let mut most = [V::splat(0.0); 2];
    for [first, second] in pairs {
        most[0] = most[0].max_magnitude(V::load(first));
        most[1] = most[1].max_magnitude(V::load(second));
    }
    if let [last] = rest {
        most[0] = most[0].max_magnitude(V::load(last));
    }
    most[0].max_magnitude(most[1]).largest()
}

/// y −= factor·x, of whole vectors.
#[inline(always)]
pub(super) fn axpy<V: Vector>(factor: f64, x: &[f64], y: &mut [f64]) {
    let factor = V::splat(-factor);
    let (x, _) = x.as_chunks::<LANES>();
    let (y, _) = y.as_chunks_mut::<LANES>();
    for (x, y) in x.iter().zip(y) {
        factor.times_plus(V::load(x), V::load(y)).store(y);
    }
}

/// y −= factor·x, of whole vectors; the largest magnitude that y then has.
#[inline(always)]
pub(super) fn axpy_largest<V: Vector>(factor: f64, x: &[f64], y: &mut [f64]) -> f64 {
    let factor = V::splat(-factor);
    let (x, _) = x.as_chunks::<LANES>();
    let (y, _) = y.as_chunks_mut::<LANES>();
    let mut most = V::splat(0.0);
    for (x, y) in x.iter().zip(y) {
        let sum = factor.times_plus(V::load(x), V::load(y));
        sum.store(y);
        most = most.max_magnitude(sum);
    }
    most.largest()
}

/// y −= factors·(x₁, x₂), of whole vectors; the largest magnitude that y then has.
#[inline(always)]
pub(super) fn axpy2_largest<V: Vector>(
    factors: [f64; 2],
    x1: &[f64],
    x2: &[f64],
    y: &mut [f64],
) -> f64 {
    let factors = [V::splat(-factors[0]), V::splat(-factors[1])];
    let (x1, _) = x1.as_chunks::<LANES>();
    let (x2, _) = x2.as_chunks::<LANES>();
    let (y, _) = y.as_chunks_mut::<LANES>();
    let mut most = V::splat(0.0);
    for ((x1, x2), y) in x1.iter().zip(x2).zip(y) {
        let one = factors[0].times_plus(V::load(x1), V::load(y));
        let sum = factors[1].times_plus(V::load(x2), one);
        sum.store(y);
        most = most.max_magnitude(sum);
    }
    most.largest()
}

/// y −= factors·(x₁, x₂), of whole vectors.
#[inline(always)]
pub(super) fn axpy2<V: Vector>(factors: [f64; 2], x1: &[f64], x2: &[f64], y: &mut [f64]) {
    let factors = [V::splat(-factors[0]), V::splat(-factors[1])];
    let (x1, _) = x1.as_chunks::<LANES>();
    let (x2, _) = x2.as_chunks::<LANES>();
    let (y, _) = y.as_chunks_mut::<LANES>();
    for ((x1, x2), y) in x1.iter().zip(x2).zip(y) {
        let one = factors[0].times_plus(V::load(x1), V::load(y));
        factors[1].times_plus(V::load(x2), one).store(y);
    }
}

/// y −= X·factors, for four columns of whole vectors.
#[inline(always)]
pub(super) fn axpy4<V: Vector>(
    factors: &[f64; LANES],
    x: [&[[f64; LANES]]; LANES],
    y: &mut [[f64; LANES]],
) {
    let [a, b, c, d] = factors.map(|factor| -factor);
    let [a, b, c, d] = [V::splat(a), V::splat(b), V::splat(c), V::splat(d)];
    let [p, q, r, s] = x;
    let columns = p.iter().zip(q).zip(r.iter().zip(s));
    for (y, ((p, q), (r, s))) in y.iter_mut().zip(columns) {
        let first = a.times_plus(V::load(p), V::load(y));
        let second = b.times(V::load(q));
        let first = c.times_plus(V::load(r), first);
        let second = d.times_plus(V::load(s), second);
        first.plus(second).store(y);
    }
}

/// Xᵀy, for four columns of whole vectors.
#[inline(always)]
pub(super) fn dot4<V: Vector>(x: [&[[f64; LANES]]; LANES], y: &[[f64; LANES]]) -> [f64; LANES] {
    let zero = V::splat(0.0);
    let mut sums = [zero, zero, zero, zero];
    let [p, q, r, s] = x;
    let columns = p.iter().zip(q).zip(r.iter().zip(s));
    for (y, ((p, q), (r, s))) in y.iter().zip(columns) {
        let y = V::load(y);
        sums[0] = V::load(p).times_plus(y, sums[0]);
        sums[1] = V::load(q).times_plus(y, sums[1]);
        sums[2] = V::load(r).times_plus(y, sums[2]);
        sums[3] = V::load(s).times_plus(y, sums[3]);
    }
    V::sums(sums)
}

/// xᵀy, of whole vectors.
#[inline(always)]
pub(super) fn dot<V: Vector>(x: &[f64], y: &[f64]) -> f64 {
    let (x, _) = x.as_chunks::<LANES>();
    let (y, _) = y.as_chunks::<LANES>();
    let (x_pairs, x_rest) = x.as_chunks::<2>();
    let (y_pairs, y_rest) = y.as_chunks::<2>();
    let mut sum = [V::splat(0.0); 2];
    for (x, y) in x_pairs.iter().zip(y_pairs) {
        sum[0] = V::load(&x[0]).times_plus(V::load(&y[0]), sum[0]);
        sum[1] = V::load(&x[1]).times_plus(V::load(&y[1]), sum[1]);
    }
    if let ([x], [y]) = (x_rest, y_rest) {
        sum[0] = V::load(x).times_plus(V::load(y), sum[0]);
    }
    let one = V::splat(1.0);
    sum[0].times_plus(one, sum[1]).sum()
}

/// Largest magnitude of `values`, of any length; `None` where one is not finite.
pub(super) fn largest_finite(values: &[f64]) -> Option<f64> {
    // Eight at a time. A number times zero is zero only where the number is finite.
    let (chunks, rest) = values.as_chunks::<8>();
    let (mut most, mut check) = ([0.0_f64; 8], [0.0_f64; 8]);
    for values in chunks {
        for ((most, check), value) in most.iter_mut().zip(&mut check).zip(values) {
            *most = if value.abs() > *most {
                value.abs()
            } else {
                *most
            };
            *check += value * 0.0;
        }
    }
    let finite = check.iter().sum::<f64>() == 0.0 && rest.iter().all(|value| value.is_finite());
    let most = most
        .iter()
        .chain(rest)
        .fold(0.0, |most: f64, v| most.max(v.abs()));
    finite.then_some(most)
}
