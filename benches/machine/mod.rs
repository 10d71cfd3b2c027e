//! What the machine can do at most: the two lines of its roofline.

use pulp::{Arch, Simd, WithSimd};
use std::hint::black_box;
use std::time::Instant;

/// Runs of each measurement, of which the fastest counts.
const RUNS: usize = 9;

/// Chains of operations that do not wait for each other: latency times throughput, and some more.
const CHAINS: usize = 12;

struct MultiplyAdd {
    rounds: usize,
}

impl WithSimd for MultiplyAdd {
    /// Floating-point operations done.
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let factor = simd.splat_f64s(black_box(0.999));
        let term = simd.splat_f64s(black_box(1e-3));
        let mut chains = [simd.splat_f64s(1.0); CHAINS];
        for _ in 0..self.rounds {
            for chain in &mut chains {
                *chain = simd.mul_add_f64s(factor, *chain, term);
            }
        }
        black_box(chains);
        (2 * self.rounds * CHAINS * S::F64_LANES) as f64
    }
}

/// Most floating-point operations a second on one core, in units of 1e9: fused multiplications and
/// additions on the widest vectors, nothing else.
pub fn peak() -> f64 {
    let arch = Arch::new();
    fastest(|| arch.dispatch(MultiplyAdd { rounds: 400_000 }))
}

/// Gigabytes a second that one core reads and writes while it changes `numbers` numbers in place,
/// again and again.
pub fn bandwidth(numbers: usize) -> f64 {
    let mut memory = vec![1.0_f64; numbers];
    let passes = (4_000_000 / numbers.max(1)).max(1);
    fastest(|| {
        for _ in 0..passes {
            black_box(&mut memory).iter_mut().for_each(|v| *v = -*v);
        }
        (2 * size_of::<f64>() * numbers * passes) as f64
    })
}

/// The most that `work` does in a nanosecond.
fn fastest(mut work: impl FnMut() -> f64) -> f64 {
    let mut most = 0.0_f64;
    for _ in 0..RUNS {
        let begin = Instant::now();
        let done = work();
        most = most.max(done / begin.elapsed().as_nanos() as f64);
    }
    most
}
