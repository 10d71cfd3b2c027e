//! Solution with the factors: forward, by the pivots, and backward.

use super::factor::Factors;
#[cfg(target_arch = "x86_64")]
use super::lanes::Avx2;
use super::lanes::{LANES, Plain, Vector};
use super::part::{Part, Place};
use super::symbolic::{Front, Symbolic, padded};
use super::update::{axpy, dot};

impl Factors {
    /// Overwrites the right-hand side `x` by the solution.
    ///
    /// Unknowns of zero pivots are set to zero.
    ///
    /// # Panics
    /// Where `x` is shorter than the matrix, or nothing was factorised yet.
    pub fn solve(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        assert!(x.len() >= symbolic.len());
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the processor has both.
            unsafe { self.solve_avx2(symbolic, x) };
            return;
        }
        self.solve_with::<Plain>(symbolic, x);
    }

    /// # Safety
    /// The processor has AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn solve_avx2(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        self.solve_with::<Avx2>(symbolic, x);
    }

    #[inline(always)]
    fn solve_with<V: Vector>(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        let Self { parts, vector } = self;
        for (part, size) in parts.iter().zip(&symbolic.parts) {
            for (front, place) in symbolic.fronts[size.fronts.clone()]
                .iter()
                .zip(&part.places)
            {
                forward::<V>(symbolic, part, front, place, vector, x);
            }
        }
        for (part, size) in parts.iter().zip(&symbolic.parts).rev() {
            let fronts = symbolic.fronts[size.fronts.clone()].iter();
            for (front, place) in fronts.zip(&part.places).rev() {
                backward::<V>(symbolic, part, front, place, vector, x);
            }
        }
    }
}

/// Eliminates a front's unknowns from the right-hand side, and divides by its pivots.
#[inline(always)]
fn forward<V: Vector>(
    symbolic: &Symbolic,
    part: &Part,
    front: &Front,
    place: &Place,
    vector: &mut [f64],
    x: &mut [f64],
) {
    let pivots = padded(place.columns);
    let ld = pivots + padded(front.border);
    let unknowns = &part.unknowns[place.pivots..place.pivots + place.columns];
    let inverse = &part.inverse[place.pivots..place.pivots + place.columns];
    let y = gather(vector, ld, unknowns, x);
    let panel = &part.panels[place.panel..place.panel + ld * place.eliminated];
    for (k, column) in panel.chunks_exact(ld).enumerate() {
        let from = k / LANES * LANES;
        axpy::<V>(y[k], &column[from..], &mut y[from..]);
    }
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

/// A front's unknowns from those of its border.
#[inline(always)]
fn backward<V: Vector>(
    symbolic: &Symbolic,
    part: &Part,
    front: &Front,
    place: &Place,
    vector: &mut [f64],
    x: &mut [f64],
) {
    let pivots = padded(place.columns);
    let ld = pivots + padded(front.border);
    let unknowns = &part.unknowns[place.pivots..place.pivots + place.columns];
    let y = gather(vector, ld, unknowns, x);
    let border = &symbolic.rows[front.rows + front.pivots..][..front.border];
    for (y, &unknown) in y[pivots..].iter_mut().zip(border) {
        *y = x[unknown as usize];
    }
    let panel = &part.panels[place.panel..place.panel + ld * place.eliminated];
    for (k, column) in panel.chunks_exact(ld).enumerate().rev() {
        let from = k / LANES * LANES;
        y[k] -= dot::<V>(&column[from..], &y[from..]);
    }
    for (y, &unknown) in y.iter().zip(&unknowns[..place.eliminated]) {
        x[unknown as usize] = *y;
    }
}

/// A front's own right-hand side in `ld` rows, the rest being zero.
#[inline(always)]
fn gather<'v>(vector: &'v mut [f64], ld: usize, unknowns: &[u32], x: &[f64]) -> &'v mut [f64] {
    let y = &mut vector[..ld];
    y.fill(0.0);
    for (y, &unknown) in y.iter_mut().zip(unknowns) {
        *y = x[unknown as usize];
    }
    y
}
