//! The rotation angle as a smooth function.
//!
//! Derived in docs/algorithms.md#rotation-angle.

use crate::autodiff::Scalar;
use nalgebra::Vector3;

/// φ² = 16 atan²√t of the angle whose quarter has the squared tangent t ≥ 0.
///
/// Smooth at zero, where φ itself is not: φ² = 16 (t − 2t²/3 + 23t³/45 − …).
#[inline]
pub(super) fn squared<S: Scalar>(t: S) -> S {
    let x = t.value();
    // k = atan(√t)/√t, and (1/(1 + t) − k)/t, in which digits cancel where t is small.
    let (k, bend) = if x < SMALL {
        let (mut k, mut bend) = (0.0, 0.0);
        for i in (0..TERMS).rev() {
            let odd = (2 * i + 1) as f64;
            k = 1.0 / odd - x * k;
            bend = -(odd + 1.0) / (odd + 2.0) - x * bend;
        }
        (k, bend)
    } else {
        let k = x.sqrt().atan() / x.sqrt();
        (k, ((1.0 + x).recip() - k) / x)
    };
    let scale = 16.0 / (1.0 + x);
    t.chain(
        16.0 * x * k * k,
        scale * k,
        scale * (0.5 * bend - k / (1.0 + x)),
    )
}

/// Below this the series is used: its first term left out is then under 1e-17.
const SMALL: f64 = 0.02;
const TERMS: usize = 10;

/// φ² of the shortest rotation that the quaternion w, (x, y, z) describes, 0 to π².
///
/// A quaternion and its negative are one rotation; the one with w ≥ 0 is the shorter way.
/// Its values meet at w = 0, half a turn, with a ridge.
#[inline]
pub(super) fn squared_by_quaternion<S: Scalar>(w: S, v: &Vector3<S>) -> S {
    let w = if w.value() < 0.0 { -w } else { w };
    let whole = w + 1.0;
    squared((v.x.square() + v.y.square() + v.z.square()) / whole.square())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::autodiff::HyperDual;

    #[test]
    fn squared_angle_and_its_derivatives() {
        for t in [0.0, 1e-12, 1e-6, 0.019, 0.021, 0.3, 1.0, 7.0] {
            let x = HyperDual::<1, 1> {
                value: t,
                rows: [1.0],
                columns: [1.0],
                block: [[0.0]],
            };
            let found = squared(x);
            // 16 atan²√t by its Taylor series, or in closed form.
            let (value, first, second) = if t < 1e-3 {
                (
                    16.0 * (t - 2.0 * t * t / 3.0 + 23.0 * t.powi(3) / 45.0),
                    16.0 * (1.0 - 4.0 * t / 3.0 + 23.0 * t * t / 15.0),
                    16.0 * (-4.0 / 3.0 + 46.0 * t / 15.0),
                )
            } else {
                let (r, a) = (t.sqrt(), t.sqrt().atan());
                (
                    16.0 * a * a,
                    16.0 * a / (r * (1.0 + t)),
                    16.0 * (r - a * (1.0 + 3.0 * t)) / (2.0 * r.powi(3) * (1.0 + t).powi(2)),
                )
            };
            for (found, expected) in [
                (found.value, value),
                (found.rows[0], first),
                (found.block[0][0], second),
            ] {
                assert!(
                    (found - expected).abs() <= 1e-11 * expected.abs(),
                    "t = {t}: {found} instead of {expected}"
                );
            }
        }
    }
}
