//! The matrix product of a factorisation, C −= A Wᵀ, in register tiles.

use super::symbolic::LANES;

/// a·b + c, in one rounding where the processor has an instruction for it.
#[inline(always)]
pub(super) fn fused<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

/// C[r, ..4] −= Σ A[rows + …, k] W[j.., k] for the rows of `c` from `c_row` on.
///
/// `a` and `w` are columns of length `ld`; `c` has up to four columns of length `c_ld`, of which
/// rows `c_row..` match rows `row..` of `a`.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) fn subtract<const FMA: bool>(
    a: &[f64],
    w: &[f64],
    ld: usize,
    row: usize,
    j: usize,
    c: &mut [f64],
    c_ld: usize,
    c_row: usize,
) {
    let mut done = 0;
    let rows = c_ld - c_row;
    while rows - done >= 3 * LANES {
        tile::<FMA, 3>(a, w, ld, row + done, j, c, c_ld, c_row + done);
        done += 3 * LANES;
    }
    match (rows - done) / LANES {
        2 => tile::<FMA, 2>(a, w, ld, row + done, j, c, c_ld, c_row + done),
        1 => tile::<FMA, 1>(a, w, ld, row + done, j, c, c_ld, c_row + done),
        _ => {}
    }
}

#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn tile<const FMA: bool, const R: usize>(
    a: &[f64],
    w: &[f64],
    ld: usize,
    row: usize,
    j: usize,
    c: &mut [f64],
    c_ld: usize,
    c_row: usize,
) {
    let mut sums = [[[0.0; LANES]; R]; 4];
    for (a, w) in a.chunks_exact(ld).zip(w.chunks_exact(ld)) {
        let (a, _) = a[row..row + R * LANES].as_chunks::<LANES>();
        let a: &[[f64; LANES]; R] = a.first_chunk().expect("R vectors");
        let w = four(w, j);
        for (sums, w) in sums.iter_mut().zip(w) {
            for (sums, a) in sums.iter_mut().zip(a) {
                for (sum, a) in sums.iter_mut().zip(a) {
                    *sum = fused::<FMA>(*a, w, *sum);
                }
            }
        }
    }
    for (column, sums) in c.chunks_exact_mut(c_ld).zip(&sums) {
        for (value, sum) in column[c_row..].iter_mut().zip(sums.as_flattened()) {
            *value -= sum;
        }
    }
}

/// Four entries from `j` on; what lies beyond the end is zero.
#[inline(always)]
fn four(w: &[f64], j: usize) -> [f64; 4] {
    match w.get(j..j + 4) {
        Some(w) => [w[0], w[1], w[2], w[3]],
        None => std::array::from_fn(|i| w.get(j + i).copied().unwrap_or(0.0)),
    }
}
