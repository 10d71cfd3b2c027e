//! Signed distance of a point to a solid at rest, m.
//!
//! Written without branches on values: largest, smallest and absolute values are those of
//! [`Scalar`], so that all a distance may depend on can be found from this code.

use crate::autodiff::Scalar;
use std::array::from_fn;

/// Length under square roots, relative to the size of the solids: keeps derivatives finite where
/// centres coincide, and adds less than rounding to a distance at contact.
const GUARD: f64 = 1e-7;

/// A solid at rest without the radius around it: a box, or a line or a point, which are boxes
/// without some of their edges. Its centre is the origin, its edges are parallel to the axes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Core {
    /// Half of each edge, m.
    half: [f64; 3],
    /// The same, but infinite along axes along which nothing moves: no way leads out there.
    exit: [f64; 3],
    /// Squared, m².
    guard: f64,
}

impl Core {
    /// A box with these half edges, m, some of which may be zero. `size` is a length of the
    /// pair, m.
    pub fn new(half: [f64; 3], size: f64) -> Self {
        Self {
            half,
            exit: half,
            guard: (GUARD * size).powi(2),
        }
    }

    /// The same where nothing moves along axis `i`: what is inside is measured along the others.
    pub fn closed_along(mut self, i: usize) -> Self {
        self.exit[i] = f64::INFINITY;
        self
    }

    /// Distance of the point, negative inside.
    pub fn to_point<S: Scalar>(&self, point: &[S; 3]) -> S {
        let outside = from_fn(|i| (point[i].abs() - self.half[i]).max(S::zero()));
        let [x, y, z] = outside.map(S::square);
        let square = x + y + z;
        let root = (square + self.guard).sqrt();
        if !self.has_inside() {
            return root;
        }
        let [x, y, z] = from_fn(|i| point[i].abs() - self.exit[i]);
        let deepest = x.max(y).max(z);
        // The root where it is above zero, written so that in front of a face it is exactly the
        // distance along one axis, whatever stands under the root.
        let beyond = deepest.max(S::zero());
        deepest + (square - beyond.square()) / (root + beyond)
    }

    /// Half of the edge along axis `i`, m.
    pub fn half(&self, i: usize) -> f64 {
        self.half[i]
    }

    /// The same, infinite where that axis leads nowhere.
    pub fn exit(&self, i: usize) -> f64 {
        self.exit[i]
    }

    /// Whether it is a box.
    pub fn has_inside(&self) -> bool {
        self.half.iter().all(|half| *half > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::autodiff::HyperDual;

    type Second = HyperDual<3, 3>;

    const HALF: [f64; 3] = [0.4, 0.3, 0.2];

    fn seeded(point: [f64; 3]) -> [Second; 3] {
        from_fn(|i| Second::seeded(point[i], Some(i), Some(i)))
    }

    fn assert_near(found: f64, expected: f64, tolerance: f64) {
        assert!(
            (found - expected).abs() <= tolerance,
            "{found:e} instead of {expected:e}"
        );
    }

    #[test]
    fn distances_to_a_box_worked_by_hand() {
        let solid = Core::new(HALF, 0.2);
        for (point, expected) in [
            ([0.9, 0.1, -0.1], 0.5),            // in front of a face
            ([0.7, -0.7, 0.1], 0.5),            // of an edge
            ([-0.6, 0.4, 0.4], 0.3),            // of a corner
            ([0.4, 0.1, 0.0], 0.0),             // on a face
            ([0.4, 0.3, 0.2], 0.0),             // on a corner
            ([0.35, 0.0, 0.0], -0.05),          // inside
            ([0.0, 0.0, 0.0], -0.2),            // in the middle
            ([0.4 + 1e-12, 0.1, 0.0], 1e-12),   // hardly outside
            ([0.1, -0.3 + 1e-12, 0.0], -1e-12), // hardly inside
        ] {
            assert_near(solid.to_point(&point), expected, 4e-16);
        }
        // Where z leads nowhere, y is the shortest way out.
        assert_near(solid.closed_along(2).to_point(&[0.0; 3]), -0.3, 0.0);
    }

    #[test]
    fn the_distance_is_straight_across_a_face() {
        let solid = Core::new(HALF, 0.2);
        for gap in [-1e-3, -1e-9, 0.0, 1e-14, 1e-9, 1e-3] {
            let found = solid.to_point(&seeded([0.1, -0.3 - gap, 0.05]));
            assert_near(found.value, gap, 1e-15);
            assert_eq!(found.rows, [0.0, -1.0, 0.0], "{gap}");
            assert_eq!(found.block, [[0.0; 3]; 3], "{gap}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_norm() {
        let from_corner = [0.3, -0.4, 1.2];
        let corner: [f64; 3] = from_fn(|i| HALF[i].copysign(from_corner[i]) + from_corner[i]);
        for found in [
            Core::new([0.0; 3], 1.0).to_point(&seeded(from_corner)),
            Core::new(HALF, 0.2).to_point(&seeded(corner)),
        ] {
            assert_near(found.value, 1.3, 1e-14);
            for i in 0..3 {
                let direction = from_corner.map(|c| c / 1.3);
                assert_near(found.rows[i], direction[i], 1e-14);
                for j in 0..3 {
                    let delta = if i == j { 1.0 } else { 0.0 };
                    let expected = (delta - direction[i] * direction[j]) / 1.3;
                    assert_near(found.block[i][j], expected, 1e-13);
                }
            }
        }
    }

    #[test]
    fn nothing_is_infinite_anywhere() {
        let finite = |found: Second| {
            let second = found.block.iter().flatten();
            let mut all = found.rows.iter().chain(second);
            found.value.is_finite() && all.all(|d| d.is_finite())
        };
        for core in [Core::new([0.0; 3], 0.1), Core::new(HALF, 0.1)] {
            for sign in [-1.0, 1.0] {
                for shares in 0..27 {
                    // Centre, faces, edges and corners.
                    let share = |i: u32| f64::from(shares / 3_i32.pow(i) % 3) / 2.0;
                    let point = from_fn(|i| sign * share(i as u32).ceil() * HALF[i]);
                    assert!(finite(core.to_point(&seeded(point))), "{point:?}");
                }
            }
            assert!(finite(core.closed_along(2).to_point(&seeded([0.0; 3]))));
        }
    }

    #[test]
    fn what_is_not_a_number_stays_so() {
        for core in [Core::new([0.0; 3], 0.1), Core::new(HALF, 0.1)] {
            assert!(core.to_point(&[0.1, f64::NAN, 0.2]).is_nan());
        }
    }
}
