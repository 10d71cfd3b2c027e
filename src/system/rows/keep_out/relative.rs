//! Points of one body as seen from a solid on another, with their derivatives.

use crate::autodiff::Scalar;
use crate::dynamics::space::{Space, Vector};
use crate::dynamics::{Data, Mount, Placement, Tree};
use nalgebra::{Matrix3, Vector3};
use std::array::from_fn;

/// Points of one body relative to the frame of a solid on another body, in which that solid is at
/// rest.
#[derive(Debug, Clone)]
pub(super) struct RelativePoints<Sp: Space> {
    points: Vec<Mount<Sp>>,
    /// Heights above the solid's frame along the normal of the plane of motion, m; zero in space.
    heights: Vec<f64>,
    frame: Mount<Sp>,
    /// The frame's axes in those that the solid's body is compiled in.
    axes: Matrix3<f64>,
    /// Joints that move the points as seen from the solid, ascending.
    joints: Vec<usize>,
}

impl<Sp: Space> RelativePoints<Sp> {
    /// `points` (m) of the body of joint `body`, as seen from `frame` in the body of joint
    /// `solid`; `None` is the base.
    pub fn new(
        tree: &Tree<Sp>,
        (body, points): (Option<usize>, &[[f64; 3]]),
        (solid, frame): (Option<usize>, &Placement),
    ) -> Self {
        let mounted = |point: &[f64; 3]| {
            let placement = Placement {
                rotation: Matrix3::identity(),
                translation: Vector3::from(*point),
            };
            tree.mount(body, &placement)
        };
        let points: Vec<_> = points.iter().map(mounted).collect();
        let axes = tree.body_axes(solid) * frame.rotation;
        let frame = tree.mount(solid, frame);
        let heights = points.iter().map(|p| tree.height_between(p, &frame));
        Self {
            heights: heights.collect(),
            joints: tree.joints_between(&points[0], &frame),
            points,
            frame,
            axes,
        }
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Joints that move the points as seen from the solid, ascending.
    pub fn joints(&self) -> &[usize] {
        &self.joints
    }

    /// The axis of the frame across the plane of motion, and the largest distance of a point from
    /// the frame's origin along it, m; `None` in space, and where the frame is tilted.
    pub fn across_the_plane(&self) -> Option<(usize, f64)> {
        const TILT: f64 = 1e-9;
        let upright = |i: &usize| self.axes[(2, *i)].abs() > 1.0 - TILT;
        let axis = (0..3).find(|i| Sp::LENGTHS == 2 && upright(i))?;
        let heights = self.heights.iter().map(|height| height.abs());
        Some((axis, heights.fold(0.0, f64::max)))
    }

    /// Position of point `i`, m.
    pub fn position<S: Scalar>(&self, i: usize, tree: &Tree<Sp>, data: &Data<Sp, S>) -> [S; 3] {
        let position = tree.relative_position(&self.points[i], &self.frame, data);
        self.along_axes(position.components(), self.heights[i])
    }

    /// Its change by joint position `k`.
    pub fn by(&self, i: usize, tree: &Tree<Sp>, data: &Data<Sp, f64>, k: usize) -> [f64; 3] {
        let by = tree.relative_position_by(&self.points[i], &self.frame, data, k);
        self.along_axes(by.components(), 0.0)
    }

    /// Its second derivative by joint positions `k` and `l`.
    pub fn by_both(
        &self,
        i: usize,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
        l: usize,
    ) -> [f64; 3] {
        let by = tree.relative_position_by_both(&self.points[i], &self.frame, data, k, l);
        self.along_axes(by.components(), 0.0)
    }

    fn along_axes<S: Scalar>(&self, vector: &[S], height: f64) -> [S; 3] {
        from_fn(|i| {
            let start = S::constant(height * self.axes[(2, i)]);
            let parts = vector.iter().enumerate();
            parts.fold(start, |sum, (j, &c)| sum.plus_times(c, self.axes[(j, i)]))
        })
    }
}
