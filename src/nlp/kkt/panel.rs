//! Elimination of a front's pivots: threshold pivoting with pivots of order one and two.
//!
//! A panel is column-major: its pivots' rows, padded to whole vectors, then its border's rows,
//! padded likewise; one column a pivot. While columns are eliminated, the pivot block is kept as
//! a full square, so that a column is always contiguous, and rows already eliminated are zero in
//! the columns that are left, so that a search need not leave them out.
//!
//! Tests for pivots as in Duff and Reid's multifrontal method (doi:10.1145/356044.356047) and
//! Hogg and Scott (doi:10.1145/2513109.2513112).

use super::noise::Noise;
use super::update::{fused, subtract};

/// Pivots are first looked for with this much of their columns' largest entry.
const PREFERRED: f64 = 0.01;

/// What counts as zero.
const SMALL: f64 = 1e-20;

/// Columns searched and kept up to date together.
const BLOCK: usize = 24;

/// What has come of a panel's pivots.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Columns eliminated; the rest are delayed.
    pub eliminated: usize,
    /// Negative eigenvalues of the eliminated block.
    pub negative: usize,
    /// Columns that were zero.
    pub zero: usize,
    /// Pivots of order two.
    pub pairs: usize,
}

/// A front while its pivots are eliminated.
pub(super) struct Panel<'a> {
    /// `ld` rows for each of `columns` columns.
    pub a: &'a mut [f64],
    /// D Lᵀ of the columns eliminated, transposed: as large as `a`.
    pub w: &'a mut [f64],
    pub ld: usize,
    pub columns: usize,
    /// Unknown of each column.
    pub unknowns: &'a mut [u32],
    /// Inverse pivots: diagonal, and what links a column to the next.
    pub inverse: &'a mut [[f64; 2]],
    /// Least part of its column's largest entry a pivot may be.
    pub threshold: f64,
    pub noise: Noise<'a>,
}

/// A pivot found.
enum Pivot {
    Zero(usize),
    One(usize),
    Two(usize, usize),
}

impl Panel<'_> {
    /// Eliminates what can be; in `last` there is no parent to delay to, and all are.
    #[inline(always)]
    pub(super) fn factor<const FMA: bool>(&mut self, last: bool) -> Counts {
        let mut counts = Counts::default();
        let mut untried = self.columns;
        let mut progress = false;
        let mut block = BLOCK;
        loop {
            let from = counts.eliminated;
            let end = untried.min(from + block);
            self.eliminate::<FMA>(&mut counts, end, self.threshold);
            let done = counts.eliminated;
            progress |= done > from;
            if done > from && end < self.columns {
                self.update_rest::<FMA>(from, done, end);
            }
            // What failed goes behind what has not been tried.
            for failed in (done..end).rev() {
                untried -= 1;
                self.swap(failed, untried);
            }
            if untried > done {
                continue;
            }
            if done == self.columns {
                break;
            }
            if progress {
                (progress, untried) = (false, self.columns);
            } else if block < self.columns - done {
                // A partner may have been in another block.
                (block, untried) = (self.columns, self.columns);
            } else {
                if last {
                    self.force::<FMA>(&mut counts);
                }
                break;
            }
        }
        counts
    }

    /// Eliminates what can be of the columns up to `end`.
    #[inline(always)]
    fn eliminate<const FMA: bool>(&mut self, counts: &mut Counts, end: usize, threshold: f64) {
        let preferred = PREFERRED.max(threshold);
        while counts.eliminated < end {
            let k = counts.eliminated;
            let found = match self.find(k, end, preferred) {
                None if threshold < preferred => self.find(k, end, threshold),
                found => found,
            };
            match found {
                Some(pivot) => self.pivot::<FMA>(pivot, counts, end),
                None => break,
            }
        }
    }

    /// Eliminates all that is left, whatever its size.
    #[cold]
    fn force<const FMA: bool>(&mut self, counts: &mut Counts) {
        let end = self.columns;
        while counts.eliminated < end {
            let k = counts.eliminated;
            let found = self.find(k, end, PREFERRED);
            let found = found.or_else(|| self.find(k, end, 0.0));
            // Cancellation in every pivot of order two: take the diagonal as it is.
            self.pivot::<FMA>(found.unwrap_or(Pivot::One(k)), counts, end);
        }
    }

    #[inline(always)]
    fn pivot<const FMA: bool>(&mut self, pivot: Pivot, counts: &mut Counts, end: usize) {
        let k = counts.eliminated;
        match pivot {
            Pivot::Zero(t) => {
                self.swap(t, k);
                self.clear(k);
                counts.zero += 1;
                counts.eliminated += 1;
            }
            Pivot::One(t) => {
                self.swap(t, k);
                let d = self.a[k * self.ld + k];
                counts.negative += usize::from(d < 0.0);
                self.eliminate_one::<FMA>(k, end);
                counts.eliminated += 1;
            }
            Pivot::Two(t, r) => {
                let (t, r) = (t.min(r), t.max(r));
                self.swap(t, k);
                self.swap(r, k + 1);
                let [a, b, c] = self.corner(k);
                let both = (a / b.abs()) * (c / b.abs()) < 1.0;
                counts.negative += if both {
                    1
                } else if a + c < 0.0 {
                    2
                } else {
                    0
                };
                counts.pairs += 1;
                self.eliminate_two::<FMA>(k, end);
                counts.eliminated += 2;
            }
        }
    }

    /// Entries (k, k), (k + 1, k) and (k + 1, k + 1).
    fn corner(&self, k: usize) -> [f64; 3] {
        let first = k * self.ld + k;
        [
            self.a[first],
            self.a[first + 1],
            self.a[first + self.ld + 1],
        ]
    }

    /// Makes row and column `k` zero: rounding error may not spread.
    #[cold]
    fn clear(&mut self, k: usize) {
        self.inverse[k] = [0.0; 2];
        let column = k * self.ld..(k + 1) * self.ld;
        self.w[column.clone()].fill(0.0);
        self.a[column].fill(0.0);
        for column in self.a.chunks_exact_mut(self.ld).skip(k) {
            column[k] = 0.0;
        }
    }

    /// The first pivot among columns `k..end` that passes `threshold`.
    #[inline(always)]
    fn find(&mut self, k: usize, end: usize, threshold: f64) -> Option<Pivot> {
        let ld = self.ld;
        let from = k / 4 * 4;
        for t in k..end {
            let column = &mut self.a[t * ld..(t + 1) * ld];
            let d = std::mem::take(&mut column[t]);
            let most = largest(&column[from..]);
            column[t] = d;
            if self.noise.is(self.unknowns[t], d.abs().max(most)) {
                return Some(Pivot::Zero(t));
            }
            if d.abs() > SMALL && d.abs() >= threshold * most {
                return Some(Pivot::One(t));
            }
            // A partner: the largest entry in the block.
            let mut r = t;
            let mut link = 0.0;
            for (i, value) in column[k..end].iter().enumerate() {
                if value.abs() > link && k + i != t {
                    (r, link) = (k + i, value.abs());
                }
            }
            if r != t && link > SMALL && self.is_pair(t, r, from, threshold) {
                return Some(Pivot::Two(t, r));
            }
        }
        None
    }

    /// Whether columns `t` and `r` make a pivot of order two.
    #[inline(always)]
    fn is_pair(&mut self, t: usize, r: usize, from: usize, threshold: f64) -> bool {
        let ld = self.ld;
        let (a, b, c) = (self.a[t * ld + t], self.a[t * ld + r], self.a[r * ld + r]);
        let scale = 1.0 / a.abs().max(b.abs()).max(c.abs());
        let (diagonal, link) = ((a * scale) * c, (b * scale) * b);
        let determinant = (diagonal - link).abs();
        if determinant < SMALL.max(0.5 * diagonal.abs().max(link.abs())) {
            return false;
        }
        let mut without = |column: usize| {
            let column = &mut self.a[column * ld..(column + 1) * ld];
            let taken = [
                std::mem::take(&mut column[t]),
                std::mem::take(&mut column[r]),
            ];
            let most = largest(&column[from..]);
            [column[t], column[r]] = taken;
            most
        };
        let (most_t, most_r) = (without(t), without(r));
        let growth_t = (c.abs() * most_t + b.abs() * most_r) * scale;
        let growth_r = (a.abs() * most_r + b.abs() * most_t) * scale;
        threshold * growth_t.max(growth_r) <= determinant
    }

    /// Exchanges columns and rows `i` and `j`; D Lᵀ is needed for rows not yet tried only.
    #[inline(always)]
    fn swap(&mut self, i: usize, j: usize) {
        if i == j {
            return;
        }
        let ld = self.ld;
        let (i, j) = (i.min(j), i.max(j));
        let (left, right) = self.a.split_at_mut(j * ld);
        left[i * ld..(i + 1) * ld].swap_with_slice(&mut right[..ld]);
        for column in self.a.chunks_exact_mut(ld).take(self.columns) {
            column.swap(i, j);
        }
        self.unknowns.swap(i, j);
    }

    /// Eliminates column `k` from the columns up to `end`.
    #[inline(always)]
    fn eliminate_one<const FMA: bool>(&mut self, k: usize, end: usize) {
        let ld = self.ld;
        let from = k / 4 * 4;
        let (left, right) = self.a.split_at_mut((k + 1) * ld);
        let pivot = &mut left[k * ld..];
        let inverse = 1.0 / pivot[k];
        self.inverse[k] = [inverse, 0.0];
        pivot[k] = 0.0;
        for (j, column) in (k + 1..end).zip(right.chunks_exact_mut(ld)) {
            let factor = pivot[j] * inverse;
            axpy::<FMA>(factor, &pivot[from..], &mut column[from..]);
            column[k] = 0.0;
        }
        let kept = &mut self.w[k * ld + from..(k + 1) * ld];
        for (value, kept) in pivot[from..].iter_mut().zip(kept) {
            *kept = *value;
            *value *= inverse;
        }
    }

    /// Eliminates columns `k` and `k + 1` from the columns up to `end`.
    #[inline(always)]
    fn eliminate_two<const FMA: bool>(&mut self, k: usize, end: usize) {
        let ld = self.ld;
        let from = k / 4 * 4;
        let [a, b, c] = self.corner(k);
        // As in LAPACK's dsytf2: scaled by the link, which is not small.
        let (over_a, over_c) = (a / b, c / b);
        let scale = 1.0 / (b * (over_a * over_c - 1.0));
        let inverse = [over_c * scale, -scale, over_a * scale];
        self.inverse[k] = [inverse[0], inverse[1]];
        self.inverse[k + 1] = [inverse[2], 0.0];
        let (left, right) = self.a.split_at_mut((k + 2) * ld);
        let (first, second) = left[k * ld..].split_at_mut(ld);
        for column in [&mut *first, &mut *second] {
            column[k] = 0.0;
            column[k + 1] = 0.0;
        }
        for (j, column) in (k + 2..end).zip(right.chunks_exact_mut(ld)) {
            let (x, y) = (first[j], second[j]);
            let factors = [
                inverse[0] * x + inverse[1] * y,
                inverse[1] * x + inverse[2] * y,
            ];
            axpy2::<FMA>(
                factors,
                &first[from..],
                &second[from..],
                &mut column[from..],
            );
            column[k] = 0.0;
            column[k + 1] = 0.0;
        }
        let (kept_first, kept_second) = self.w[k * ld..(k + 2) * ld].split_at_mut(ld);
        for i in from..ld {
            let (x, y) = (first[i], second[i]);
            kept_first[i] = x;
            kept_second[i] = y;
            first[i] = inverse[0] * x + inverse[1] * y;
            second[i] = inverse[1] * x + inverse[2] * y;
        }
    }

    /// Brings the columns from `end` on up to date with pivots `from..done`.
    #[inline(always)]
    fn update_rest<const FMA: bool>(&mut self, from: usize, done: usize, end: usize) {
        let ld = self.ld;
        let (left, right) = self.a.split_at_mut(end * ld);
        let rows = done / 4 * 4;
        for (tile, columns) in right[..(self.columns - end) * ld]
            .chunks_mut(4 * ld)
            .enumerate()
        {
            let j = end + 4 * tile;
            // Four rows of D Lᵀ, which may reach into the padding.
            subtract::<FMA>(
                &left[from * ld..done * ld],
                &self.w[from * ld..done * ld],
                ld,
                rows,
                j,
                columns,
                ld,
                rows,
            );
            for column in columns.chunks_exact_mut(ld) {
                column[from..done].fill(0.0);
            }
        }
    }
}

/// Largest magnitude.
#[inline(always)]
fn largest(column: &[f64]) -> f64 {
    let (chunks, _) = column.as_chunks::<4>();
    let mut most = [0.0_f64; 4];
    for chunk in chunks {
        for (most, value) in most.iter_mut().zip(chunk) {
            let value = value.abs();
            *most = if value > *most { value } else { *most };
        }
    }
    most.into_iter().fold(0.0, f64::max)
}

/// y −= factor·x, in whole vectors.
#[inline(always)]
fn axpy<const FMA: bool>(factor: f64, x: &[f64], y: &mut [f64]) {
    let (x, _) = x.as_chunks::<4>();
    let (y, _) = y.as_chunks_mut::<4>();
    for (x, y) in x.iter().zip(y) {
        for (x, y) in x.iter().zip(y) {
            *y = fused::<FMA>(-factor, *x, *y);
        }
    }
}

/// y −= factors·(x₁, x₂), in whole vectors.
#[inline(always)]
fn axpy2<const FMA: bool>(factors: [f64; 2], x1: &[f64], x2: &[f64], y: &mut [f64]) {
    let (x1, _) = x1.as_chunks::<4>();
    let (x2, _) = x2.as_chunks::<4>();
    let (y, _) = y.as_chunks_mut::<4>();
    for ((x1, x2), y) in x1.iter().zip(x2).zip(y) {
        for lane in 0..4 {
            let one = fused::<FMA>(-factors[0], x1[lane], y[lane]);
            y[lane] = fused::<FMA>(-factors[1], x2[lane], one);
        }
    }
}
