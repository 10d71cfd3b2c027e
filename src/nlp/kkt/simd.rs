//! Four numbers at a time: AVX2 vectors where the processor has them, plain arithmetic otherwise.
//!
//! [`dispatch`] is the only way in. It asks the processor for AVX2 and FMA and runs a [`Kernel`] with
//! the vector type that fits. The AVX2 type is private to this file, so that no code can use it
//! without that test.
//!
//! A kernel and all it calls must be `#[inline(always)]`. Intrinsics become instructions only inside
//! a function that is compiled for AVX2; anywhere else each of them is a function call.

#![allow(
    unsafe_code,
    reason = "AVX2 intrinsics, reached only after the processor was asked for AVX2 and FMA"
)]

/// Numbers in a vector.
pub(super) const LANES: usize = 4;

/// `rows` rounded up to whole vectors.
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
    /// The larger of `self` and |other|, lane by lane.
    fn max_magnitude(self, other: Self) -> Self;
    /// The largest lane.
    fn largest(self) -> f64;
    /// The sum of the lanes.
    fn sum(self) -> f64;
    /// The sum of the lanes of each vector.
    fn sums(of: [Self; LANES]) -> [f64; LANES];
}

/// Work that is generic in the vector type.
pub(super) trait Kernel {
    /// The result.
    type Output;
    /// Does the work. Implementations must be `#[inline(always)]`.
    fn run<V: Vector>(self) -> Self::Output;
}

/// Runs `kernel` with the widest vectors of this processor.
pub(super) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        // SAFETY: the processor has both features.
        return unsafe { avx2::run(kernel) };
    }
    kernel.run::<Plain>()
}

/// Plain arithmetic.
#[derive(Debug, Clone, Copy)]
struct Plain([f64; LANES]);

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
    fn max_magnitude(self, other: Self) -> Self {
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

/// AVX2 with fused multiplication and addition.
#[cfg(target_arch = "x86_64")]
mod avx2 {
    use super::{Kernel, LANES, Vector};
    use std::arch::x86_64::*;

    /// Runs `kernel` compiled for AVX2 and FMA.
    ///
    /// # Safety
    /// The processor has AVX2 and FMA.
    #[target_feature(enable = "avx2,fma")]
    pub(super) unsafe fn run<K: Kernel>(kernel: K) -> K::Output {
        kernel.run::<Avx2>()
    }

    /// Four numbers in one register. Private: [`run`] alone hands this type to other code.
    #[derive(Debug, Clone, Copy)]
    struct Avx2(__m256d);

    // SAFETY, for every block below: this code runs only inside `run`, whose caller has seen to it
    // that the processor has AVX2 and FMA; loads and stores are of arrays of four.
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
        fn max_magnitude(self, other: Self) -> Self {
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

#[cfg(test)]
mod tests {
    use super::{Kernel, LANES, Plain, Vector, dispatch};

    /// Every operation once, on numbers whose results are exact.
    struct Operations;

    impl Kernel for Operations {
        type Output = Vec<f64>;

        #[inline(always)]
        fn run<V: Vector>(self) -> Vec<f64> {
            let a = V::load(&[1.0, -2.0, 3.0, -4.0]);
            let b = V::load(&[0.5, 8.0, -0.25, 2.0]);
            let mut results = Vec::new();
            let mut keep = |vector: V| {
                let mut lanes = [0.0; LANES];
                vector.store(&mut lanes);
                results.extend(lanes);
            };
            keep(a.times_plus(b, V::splat(3.0)));
            keep(a.plus(b));
            keep(a.minus(b));
            keep(a.times(b));
            keep(a.max_magnitude(b));
            results.extend([a.largest(), b.sum()]);
            results.extend(V::sums([a, b, a, b]));
            results
        }
    }

    #[test]
    fn the_processor_s_vectors_and_plain_arithmetic_agree() {
        assert_eq!(dispatch(Operations), Operations.run::<Plain>());
    }
}
