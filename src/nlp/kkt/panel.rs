//! Elimination of a front's pivots: threshold pivoting with pivots of order one and two.
//!
//! A panel holds the fully summed columns of a front, by columns: the pivots' rows, padded to whole
//! vectors, then the border's rows, padded likewise. While columns are eliminated, the pivot block is
//! kept as a full square, so that a column is always contiguous.
//!
//! Updates are delayed: a few columns at a time get the updates of all earlier pivots, just before
//! they are searched. The search begins at a whole vector, which may hold rows already eliminated;
//! those are set to zero, so that they are never the largest.
//!
//! The pivot tests are those of Duff and Reid's multifrontal method (doi:10.1145/356044.356047) and of
//! Hogg and Scott (doi:10.1145/2513109.2513112).

use super::simd::{LANES, Vector};
use super::update::{
    Eliminated, Target, axpy, axpy_largest, axpy2, axpy2_largest, largest, rank_update,
};
use super::zero_pivots::ZeroTest;

/// Pivots of at least this part of their column's largest entry are preferred.
const PREFERRED: f64 = 1e-4;

/// A pivot this small counts as zero.
const SMALL: f64 = 1e-20;

/// Columns that are updated together.
const BLOCK: usize = 4;

/// Most columns that are searched for pivots together.
const MAX_SEARCHED: usize = 24;

/// What has become of a panel's columns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct PivotCounts {
    /// Columns eliminated; the rest are delayed.
    pub eliminated: usize,
    /// Negative eigenvalues of the pivots.
    pub negative: usize,
    /// Zero pivots.
    pub zero: usize,
    /// Pivots of order two.
    pub two_by_two: usize,
}

/// A front while its pivots are eliminated.
pub(super) struct Panel<'a> {
    /// `ld` rows for each of `columns` columns.
    pub a: &'a mut [f64],
    /// D Lᵀ of the columns eliminated, transposed: as large as `a`, and four numbers more.
    pub w: &'a mut [f64],
    pub ld: usize,
    pub columns: usize,
    /// Unknown of each column.
    pub unknowns: &'a mut [u32],
    /// Inverse pivots: the diagonal entry, and the one that links a column to the next.
    pub inverse: &'a mut [[f64; 2]],
    /// Pivot threshold: the least part of its column's largest entry that a pivot may be.
    pub threshold: f64,
    pub zero_test: ZeroTest<'a>,
    /// Largest entry of the column to be searched next, its diagonal included, where it is known.
    pub next: Option<f64>,
}

/// A pivot found, by its columns.
enum Pivot {
    Zero(usize),
    One(usize),
    Two(usize, usize),
}

impl Panel<'_> {
    /// Eliminates the columns that have a pivot; in a root, which has no parent to delay the others
    /// to, eliminates all.
    #[inline(always)]
    pub(super) fn factor<V: Vector>(&mut self, is_root: bool) -> PivotCounts {
        let mut counts = PivotCounts::default();
        // Columns from here on have failed since the last sweep began.
        let mut untried = self.columns;
        let mut progress = false;
        let mut most = MAX_SEARCHED;
        // Pivots whose updates the columns behind the searched group have got.
        let mut applied = 0;
        loop {
            let from = counts.eliminated;
            let mut end = from;
            // A few columns at a time, as long as not too many have failed.
            while end < untried && end - counts.eliminated < most {
                let next = untried.min(end + BLOCK);
                self.apply_pivots::<V>(applied, counts.eliminated, end, next);
                self.eliminate::<V>(&mut counts, end, next);
                end = next;
            }
            let done = counts.eliminated;
            // At the end, every column left was searched after the last pivot was eliminated.
            if done == self.columns || end == self.columns {
                break;
            }
            self.apply_pivots::<V>(applied, done, end, self.columns);
            applied = done;
            // Columns that failed go behind those not yet tried.
            for failed in (done..end).rev() {
                untried -= 1;
                self.swap(failed, untried);
            }
            progress |= done > from;
            if untried > done {
                continue;
            }
            if progress {
                progress = false;
            } else if most < self.columns - done {
                // The partner for a pivot of order two may have been in another group.
                most = self.columns;
            } else {
                break;
            }
            untried = self.columns;
        }
        if is_root {
            self.eliminate_rest::<V>(&mut counts);
        }
        counts
    }

    /// Eliminates the columns before `end` that have a pivot; those before `next` have failed before.
    #[inline(always)]
    fn eliminate<V: Vector>(&mut self, counts: &mut PivotCounts, mut next: usize, end: usize) {
        while counts.eliminated < end {
            let k = counts.eliminated;
            let Some(pivot) = self.find_pivot::<V>(k, next, end, self.threshold) else {
                break;
            };
            // Columns that failed before column t now stand before its place.
            let (Pivot::Zero(t) | Pivot::One(t) | Pivot::Two(t, _)) = pivot;
            self.eliminate_pivot::<V>(pivot, counts, end);
            next = (t + 1).max(counts.eliminated);
        }
    }

    /// Eliminates all columns left, however small their pivots.
    #[inline(always)]
    fn eliminate_rest<V: Vector>(&mut self, counts: &mut PivotCounts) {
        let end = self.columns;
        while counts.eliminated < end {
            let k = counts.eliminated;
            let found = self.find_pivot::<V>(k, k, end, 0.0);
            // Every pivot of order two cancels: take the diagonal entry as it is.
            self.eliminate_pivot::<V>(found.unwrap_or(Pivot::One(k)), counts, end);
        }
    }

    /// Eliminates one pivot and counts it.
    #[inline(always)]
    fn eliminate_pivot<V: Vector>(&mut self, pivot: Pivot, counts: &mut PivotCounts, end: usize) {
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
                let opposite_signs = (a / b.abs()) * (c / b.abs()) < 1.0;
                counts.negative += if opposite_signs {
                    1
                } else if a + c < 0.0 {
                    2
                } else {
                    0
                };
                counts.two_by_two += 1;
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

    /// Sets row and column `k` to zero, so that their rounding error does not spread.
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

    /// The first pivot among columns `next..end`, then `k..next`, that passes the preferred
    /// threshold; else the first that passes `threshold`.
    #[inline(always)]
    fn find_pivot<V: Vector>(
        &mut self,
        k: usize,
        next: usize,
        end: usize,
        threshold: f64,
    ) -> Option<Pivot> {
        let ld = self.ld;
        let from = k / LANES * LANES;
        let preferred = PREFERRED.max(threshold);
        let mut known = self.next.take().filter(|_| next == k);
        let mut second = None;
        for t in (next..end).chain(k..next.min(end)) {
            let column = &self.a[t * ld..(t + 1) * ld];
            let d = column[t];
            // The diagonal may be the largest: a threshold is never above one. No closure here: it
            // would be compiled without AVX2.
            let most = match known.take() {
                Some(most) => most,
                None => largest::<V>(&column[from..]),
            };
            if self.zero_test.is_zero(self.unknowns[t], most) {
                return Some(Pivot::Zero(t));
            }
            if d.abs() > SMALL && d.abs() >= preferred * most {
                return Some(Pivot::One(t));
            }
            if let Some(r) = self.partner(k, t, end) {
                let (determinant, growth) = self.test_two_by_two::<V>(t, r, from, end);
                if determinant >= preferred * growth {
                    return Some(Pivot::Two(t, r));
                }
                if second.is_none() && determinant > 0.0 && determinant >= threshold * growth {
                    second = Some(Pivot::Two(t, r));
                }
            }
            if second.is_none() && d.abs() > SMALL && d.abs() >= threshold * most {
                second = Some(Pivot::One(t));
            }
        }
        second
    }

    /// The column of `k..end` with the largest off-diagonal entry of column `t`, where that is not
    /// zero.
    #[inline(always)]
    fn partner(&self, k: usize, t: usize, end: usize) -> Option<usize> {
        let column = &self.a[t * self.ld..(t + 1) * self.ld];
        let (mut r, mut link) = (t, SMALL);
        for (i, value) in column[k..end].iter().enumerate() {
            let larger = value.abs() > link && k + i != t;
            link = if larger { value.abs() } else { link };
            r = if larger { k + i } else { r };
        }
        (r != t).then_some(r)
    }

    /// The test of a pivot of order two in columns `t` and `r`: its determinant, negative where that
    /// is lost to cancellation, and a bound on the growth. The pivot passes where the determinant is
    /// at least the threshold times the growth.
    #[inline(always)]
    fn test_two_by_two<V: Vector>(
        &self,
        t: usize,
        r: usize,
        from: usize,
        end: usize,
    ) -> (f64, f64) {
        let ld = self.ld;
        let (a, b, c) = (self.a[t * ld + t], self.a[t * ld + r], self.a[r * ld + r]);
        let scale = 1.0 / a.abs().max(b.abs()).max(c.abs());
        let (diagonal, link) = ((a * scale) * c, (b * scale) * b);
        let determinant = (diagonal - link).abs();
        if determinant < SMALL.max(0.5 * diagonal.abs().max(link.abs())) {
            return (-1.0, 1.0);
        }
        let most_t = self.largest_except::<V>(t, [t, r], from, end);
        let most_r = self.largest_except::<V>(r, [t, r], from, end);
        let growth_t = (c.abs() * most_t + b.abs() * most_r) * scale;
        let growth_r = (a.abs() * most_r + b.abs() * most_t) * scale;
        (determinant, growth_t.max(growth_r))
    }

    /// Largest entry of a column from row `from` on, two rows before `end` left out.
    #[inline(always)]
    fn largest_except<V: Vector>(
        &self,
        column: usize,
        rows: [usize; 2],
        from: usize,
        end: usize,
    ) -> f64 {
        let column = &self.a[column * self.ld..(column + 1) * self.ld];
        let (head, tail) = column.split_at(end.next_multiple_of(LANES));
        let mut most = largest::<V>(tail);
        for (row, value) in head.iter().enumerate().skip(from) {
            let counts = row != rows[0] && row != rows[1] && value.abs() > most;
            most = if counts { value.abs() } else { most };
        }
        most
    }

    /// Exchanges columns and rows `i` and `j`.
    ///
    /// `w` is left as it is: only its rows of columns not yet tried are read again.
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
        // As in LAPACK's dsytf2: scaled by the off-diagonal entry, which is not small.
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
        let [a, b, c] = inverse;
        let inverse = [V::splat(a), V::splat(b), V::splat(c)];
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

    /// Applies the updates of pivots `from..done` to columns `first..end`.
    #[inline(always)]
    fn apply_pivots<V: Vector>(&mut self, from: usize, done: usize, first: usize, end: usize) {
        if from == done || first == end {
            return;
        }
        let ld = self.ld;
        let (left, right) = self.a.split_at_mut(first * ld);
        let rows = done / LANES * LANES;
        for (tile, columns) in right[..(end - first) * ld].chunks_mut(4 * ld).enumerate() {
            let j = first + 4 * tile;
            let pivots = Eliminated {
                l: &left[from * ld..done * ld],
                w: &self.w[from * ld..done * ld + 4],
                ld,
            };
            // Four rows of D Lᵀ; those beyond the last column are not used.
            let target = Target {
                columns: &mut *columns,
                ld,
                row: rows,
            };
            rank_update::<V, false>(pivots, rows, j, target);
            for column in columns.chunks_exact_mut(ld) {
                column[rows..done].fill(0.0);
            }
        }
    }
}
