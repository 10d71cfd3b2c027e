//! Four numbers at a time: the processor's vectors where it has them, plain arithmetic otherwise.
//!
//! Everything here is inlined into a function that is compiled for the processor's features; only
//! there do the instructions become what they stand for.

/// Numbers in a vector.
pub(super) const LANES: usize = 4;

/// Rows padded to whole vectors.
pub(super) fn padded(rows: usize) -> usize {
    rows.next_multiple_of(LANES)
}

/// A vector of [`LANES`] numbers.
pub(super) trait Vector: Copy {
    fn splat(value: f64) -> Self;
    fn load(from: &[f64; LANES]) -> Self;
    fn store(self, to: &mut [f64; LANES]);
    /// self·b + c, in one rounding where there is an instruction for it.
    fn times_plus(self, b: Self, c: Self) -> Self;
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    /// The larger of `self` and the magnitude of `other`, lane by lane.
    fn most(self, other: Self) -> Self;
    /// The largest lane.
    fn largest(self) -> f64;
    fn sum(self) -> f64;
    /// The sum of each of the vectors.
    fn sums(of: [Self; LANES]) -> [f64; LANES];
}

/// Plain arithmetic.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plain([f64; LANES]);

impl Vector for Plain {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn load(from: &[f64; LANES]) -> Self {
        Self(*from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f64; LANES]) {
        *to = self.0;
    }

    #[inline(always)]
    fn times_plus(self, b: Self, c: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] * b.0[i] + c.0[i]))
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] * other.0[i]))
    }

    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| {
            let value = other.0[i].abs();
            if value > self.0[i] { value } else { self.0[i] }
        }))
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        let [a, b, c, d] = self.0;
        a.max(c).max(b.max(d))
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        let [a, b, c, d] = self.0;
        (a + c) + (b + d)
    }

    #[inline(always)]
    fn sums(of: [Self; LANES]) -> [f64; LANES] {
        of.map(Self::sum)
    }
}

/// AVX2 with fused multiplication and addition. Only to be used where the processor has both.
#[cfg(target_arch = "x86_64")]
#[derive(Debug, Clone, Copy)]
pub(super) struct Avx2(std::arch::x86_64::__m256d);

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::{Avx2, LANES, Vector};
    use std::arch::x86_64::*;

    // SAFETY, for every block below: a value of this type is made only in functions compiled for
    // AVX2 and FMA, which are called where the processor has them; loads and stores are of arrays
    // of four.
    impl Vector for Avx2 {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_set1_pd(value) })
        }

        #[inline(always)]
        fn load(from: &[f64; LANES]) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_loadu_pd(from.as_ptr()) })
        }

        #[inline(always)]
        fn store(self, to: &mut [f64; LANES]) {
            // SAFETY: see above.
            unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) };
        }

        #[inline(always)]
        fn times_plus(self, b: Self, c: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_fmadd_pd(self.0, b.0, c.0) })
        }

        #[inline(always)]
        fn plus(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_add_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn minus(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_sub_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn times(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe { _mm256_mul_pd(self.0, other.0) })
        }

        #[inline(always)]
        fn most(self, other: Self) -> Self {
            // SAFETY: see above.
            Self(unsafe {
                let sign = _mm256_set1_pd(-0.0);
                _mm256_max_pd(_mm256_andnot_pd(sign, other.0), self.0)
            })
        }

        #[inline(always)]
        fn largest(self) -> f64 {
            // SAFETY: see above.
            unsafe {
                let halves = _mm_max_pd(
                    _mm256_castpd256_pd128(self.0),
                    _mm256_extractf128_pd::<1>(self.0),
                );
                _mm_cvtsd_f64(_mm_max_sd(halves, _mm_unpackhi_pd(halves, halves)))
            }
        }

        #[inline(always)]
        fn sum(self) -> f64 {
            // SAFETY: see above.
            unsafe {
                let halves = _mm_add_pd(
                    _mm256_castpd256_pd128(self.0),
                    _mm256_extractf128_pd::<1>(self.0),
                );
                _mm_cvtsd_f64(_mm_add_sd(halves, _mm_unpackhi_pd(halves, halves)))
            }
        }

        #[inline(always)]
        fn sums(of: [Self; LANES]) -> [f64; LANES] {
            let [a, b, c, d] = of;
            let mut sums = [0.0; LANES];
            // SAFETY: see above.
            unsafe {
                let ab = _mm256_hadd_pd(a.0, b.0);
                let cd = _mm256_hadd_pd(c.0, d.0);
                let low = _mm256_permute2f128_pd::<0x20>(ab, cd);
                let high = _mm256_permute2f128_pd::<0x31>(ab, cd);
                _mm256_storeu_pd(sums.as_mut_ptr(), _mm256_add_pd(low, high));
            }
            sums
        }
    }
}
