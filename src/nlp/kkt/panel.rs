//! Elimination of a front's pivots: threshold pivoting with pivots of order one and two.
//!
//! A panel is column-major: its pivots' rows, padded to whole vectors, then its border's rows,
//! padded likewise; one column a pivot. While columns are eliminated, the pivot block is kept as
//! a full square, so that a column is always contiguous, and rows already eliminated are zero in
//! the columns that are left, so that a search need not leave them out.
//!
//! Tests for pivots as in Duff and Reid's multifrontal method (doi:10.1145/356044.356047) and
//! Hogg and Scott (doi:10.1145/2513109.2513112).

use super::lanes::{LANES, Vector};
use super::noise::Noise;
use super::update::{axpy, axpy_largest, axpy2, axpy2_largest, largest, subtract};

/// Pivots are first looked for with this much of their columns' largest entry.
const PREFERRED: f64 = 1e-4;

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
    /// D Lᵀ of the columns eliminated, transposed: as large as `a`, and four more.
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
    /// Largest entry of the column to be tried next, its diagonal included, where it is known.
    pub next: Option<f64>,
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
    pub(super) fn factor<V: Vector>(&mut self, last: bool) -> Counts {
        let mut counts = Counts::default();
        let mut untried = self.columns;
        let mut progress = false;
        let mut block = BLOCK;
        loop {
            let from = counts.eliminated;
            let end = untried.min(from + block);
            self.eliminate::<V>(&mut counts, end, self.threshold);
            let done = counts.eliminated;
            progress |= done > from;
            if done > from && end < self.columns {
                self.update_rest::<V>(from, done, end);
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
                    self.force::<V>(&mut counts);
                }
                break;
            }
        }
        counts
    }

    /// Eliminates what can be of the columns up to `end`.
    #[inline(always)]
    fn eliminate<V: Vector>(&mut self, counts: &mut Counts, end: usize, threshold: f64) {
        let preferred = PREFERRED.max(threshold);
        while counts.eliminated < end {
            let k = counts.eliminated;
            let found = match self.find::<V>(k, end, preferred) {
                None if threshold < preferred => self.find::<V>(k, end, threshold),
                found => found,
            };
            match found {
                Some(pivot) => self.pivot::<V>(pivot, counts, end),
                None => break,
            }
        }
    }

    /// Eliminates all that is left, whatever its size.
    #[inline(always)]
    fn force<V: Vector>(&mut self, counts: &mut Counts) {
        let end = self.columns;
        while counts.eliminated < end {
            let k = counts.eliminated;
            let found = self.find::<V>(k, end, PREFERRED);
            let found = found.or_else(|| self.find::<V>(k, end, 0.0));
            // Cancellation in every pivot of order two: take the diagonal as it is.
            self.pivot::<V>(found.unwrap_or(Pivot::One(k)), counts, end);
        }
    }

    #[inline(always)]
    fn pivot<V: Vector>(&mut self, pivot: Pivot, counts: &mut Counts, end: usize) {
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
                self.eliminate_one::<V>(k, end);
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
                self.eliminate_two::<V>(k, end);
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
    fn find<V: Vector>(&mut self, k: usize, end: usize, threshold: f64) -> Option<Pivot> {
        let ld = self.ld;
        let from = k / LANES * LANES;
        let mut known = self.next.take();
        for t in k..end {
            let column = &self.a[t * ld..(t + 1) * ld];
            let d = column[t];
            // The diagonal may count: a threshold is never above one.
            let most = known
                .take()
                .unwrap_or_else(|| largest::<V>(&column[from..]));
            if self.noise.is(self.unknowns[t], most) {
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
            if r != t && link > SMALL && self.is_pair::<V>(t, r, from, threshold) {
                return Some(Pivot::Two(t, r));
            }
        }
        None
    }

    /// Whether columns `t` and `r` make a pivot of order two.
    #[inline(always)]
    fn is_pair<V: Vector>(&self, t: usize, r: usize, from: usize, threshold: f64) -> bool {
        let ld = self.ld;
        let (a, b, c) = (self.a[t * ld + t], self.a[t * ld + r], self.a[r * ld + r]);
        let scale = 1.0 / a.abs().max(b.abs()).max(c.abs());
        let (diagonal, link) = ((a * scale) * c, (b * scale) * b);
        let determinant = (diagonal - link).abs();
        if determinant < SMALL.max(0.5 * diagonal.abs().max(link.abs())) {
            return false;
        }
        let most_t = self.without::<V>(t, [t, r], from);
        let most_r = self.without::<V>(r, [t, r], from);
        let growth_t = (c.abs() * most_t + b.abs() * most_r) * scale;
        let growth_r = (a.abs() * most_r + b.abs() * most_t) * scale;
        threshold * growth_t.max(growth_r) <= determinant
    }

    /// Largest entry of a column from row `from` on but for those of two rows.
    #[inline(always)]
    fn without<V: Vector>(&self, column: usize, rows: [usize; 2], from: usize) -> f64 {
        let column = &self.a[column * self.ld + from..(column + 1) * self.ld];
        let [first, second] = [rows[0].min(rows[1]) - from, rows[0].max(rows[1]) - from];
        let [one, two] = [first / LANES, second / LANES];
        let (chunks, _) = column.as_chunks::<LANES>();
        let mut most = largest::<V>(&column[..one * LANES]);
        most = most.max(largest::<V>(&column[(two + 1) * LANES..]));
        if one < two {
            most = most.max(largest::<V>(&column[(one + 1) * LANES..two * LANES]));
        }
        for chunk in [one, two] {
            for (lane, value) in chunks[chunk].iter().enumerate() {
                let row = chunk * LANES + lane;
                if row != first && row != second {
                    most = most.max(value.abs());
                }
            }
        }
        most
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
    fn eliminate_one<V: Vector>(&mut self, k: usize, end: usize) {
        let ld = self.ld;
        let from = k / LANES * LANES;
        let (left, right) = self.a.split_at_mut((k + 1) * ld);
        let pivot = &mut left[k * ld..];
        let inverse = 1.0 / pivot[k];
        self.inverse[k] = [inverse, 0.0];
        pivot[k] = 0.0;
        let mut columns = (k + 1..end).zip(right.chunks_exact_mut(ld));
        if let Some((j, column)) = columns.next() {
            let factor = pivot[j] * inverse;
            column[k] = 0.0;
            let column = &mut column[from..];
            self.next = Some(axpy_largest::<V>(factor, &pivot[from..], column));
        }
        for (j, column) in columns {
            let factor = pivot[j] * inverse;
            axpy::<V>(factor, &pivot[from..], &mut column[from..]);
            column[k] = 0.0;
        }
        let (values, _) = pivot[from..].as_chunks_mut::<LANES>();
        let (kept, _) = self.w[k * ld + from..(k + 1) * ld].as_chunks_mut::<LANES>();
        let inverse = V::splat(inverse);
        for (values, kept) in values.iter_mut().zip(kept) {
            let value = V::load(values);
            value.store(kept);
            value.times(inverse).store(values);
        }
    }

    /// Eliminates columns `k` and `k + 1` from the columns up to `end`.
    #[inline(always)]
    fn eliminate_two<V: Vector>(&mut self, k: usize, end: usize) {
        let ld = self.ld;
        let from = k / LANES * LANES;
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
        let factors = |x: f64, y: f64| {
            [
                inverse[0] * x + inverse[1] * y,
                inverse[1] * x + inverse[2] * y,
            ]
        };
        let mut columns = (k + 2..end).zip(right.chunks_exact_mut(ld));
        if let Some((j, column)) = columns.next() {
            let factors = factors(first[j], second[j]);
            column[k] = 0.0;
            column[k + 1] = 0.0;
            let column = &mut column[from..];
            self.next = Some(axpy2_largest::<V>(
                factors,
                &first[from..],
                &second[from..],
                column,
            ));
        }
        for (j, column) in columns {
            let factors = factors(first[j], second[j]);
            axpy2::<V>(
                factors,
                &first[from..],
                &second[from..],
                &mut column[from..],
            );
            column[k] = 0.0;
            column[k + 1] = 0.0;
        }
        let (kept_first, kept_second) = self.w[k * ld..(k + 2) * ld].split_at_mut(ld);
        let (first, _) = first[from..].as_chunks_mut::<LANES>();
        let (second, _) = second[from..].as_chunks_mut::<LANES>();
        let (kept_first, _) = kept_first[from..].as_chunks_mut::<LANES>();
        let (kept_second, _) = kept_second[from..].as_chunks_mut::<LANES>();
        let inverse = inverse.map(V::splat);
        let columns = first.iter_mut().zip(second);
        for ((first, second), (kept_first, kept_second)) in
            columns.zip(kept_first.iter_mut().zip(kept_second))
        {
            let (x, y) = (V::load(first), V::load(second));
            x.store(kept_first);
            y.store(kept_second);
            inverse[0].times_plus(x, inverse[1].times(y)).store(first);
            inverse[1].times_plus(x, inverse[2].times(y)).store(second);
        }
    }

    /// Brings the columns from `end` on up to date with pivots `from..done`.
    #[inline(always)]
    fn update_rest<V: Vector>(&mut self, from: usize, done: usize, end: usize) {
        let ld = self.ld;
        let (left, right) = self.a.split_at_mut(end * ld);
        let rows = done / LANES * LANES;
        for (tile, columns) in right[..(self.columns - end) * ld]
            .chunks_mut(4 * ld)
            .enumerate()
        {
            let j = end + 4 * tile;
            // Four rows of D Lᵀ; those beyond the last column are not used.
            subtract::<V>(
                &left[from * ld..done * ld],
                &self.w[from * ld..done * ld + 4],
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
