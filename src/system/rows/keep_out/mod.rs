//! Clearance of pairs that are kept apart: the distance between two solids, m, negative inside.
//!
//! It is measured in the frame of the second solid, which is at rest there; the points of the
//! first that it depends on have closed-form derivatives by the joint positions, and distances
//! derivatives by dual numbers.
//!
//! Derived in docs/algorithms.md#distance-of-solids.

mod distance;
mod relative;
mod segment;

use super::block::{EndRows, PathRows};
use super::row::{BoundId, Component, Row};
use crate::autodiff::{Dual, HyperDual, Scalar};
use crate::dynamics::space::Space;
use crate::dynamics::{Data, Placement, Tree};
use crate::ocp::Interval;
use crate::problem::{KeepOut, LimitId, Problem, Shape, Unit};
use crate::system::instant::{Instant, Pose};
use crate::system::linearization::{Linearization, Lower};
use crate::system::plant::Plant;
use distance::Core;
use nalgebra::{Matrix3, Rotation3, Vector3};
use relative::RelativePoints;
use std::array::from_fn;
use std::f64::consts::PI;
use std::slice;

/// A pair compiled for evaluation. Its row is the clearance, at least 0 where the pair is apart.
#[derive(Debug, Clone)]
pub(crate) struct KeepOutRow<Sp: Space> {
    row: Row,
    points: RelativePoints<Sp>,
    core: Core,
    /// Of both solids together, m.
    radius: f64,
}

impl<Sp: Space> KeepOutRow<Sp> {
    /// The pairs of `problem`.
    pub fn all(problem: &Problem, plant: &Plant<Sp>) -> impl Iterator<Item = Self> {
        let pairs = problem.limits.keep_out.iter().enumerate();
        pairs.map(|(i, pair)| Self::new(i, pair, &plant.tree))
    }

    /// Pair `index`; of two boxes, which validation refuses, there is no row.
    fn new(index: usize, pair: &KeepOut, tree: &Tree<Sp>) -> Self {
        // Distance has no direction: a box is the one at rest.
        let (moving, still) = match pair.first.shape {
            Shape::Box { .. } => (&pair.second, &pair.first),
            _ => (&pair.first, &pair.second),
        };
        let (points, radius) = spine(&moving.shape);
        let (frame, half, rounding) = core(&still.shape);
        let points = RelativePoints::new(tree, (moving.joint, &points), (still.joint, &frame));
        let radius = radius + rounding;
        let size = radius + half.into_iter().fold(f64::INFINITY, f64::min);
        let mut core = Core::new(half, size);
        if let Some((axis, height)) = points.across_the_plane()
            && height <= half[axis]
        {
            core = core.closed_along(axis);
        }
        let id = BoundId::new(LimitId::KeepOut, Component::Pair(index));
        let bounds = Interval::new(0.0, f64::INFINITY);
        Self {
            // The distance of the centres at contact, at least, counts as one.
            row: Row::new(id, Unit::Metre, pair.name.clone(), bounds).sized(size),
            points,
            core,
            radius,
        }
    }

    /// The clearance, m.
    fn value<S: Scalar>(&self, tree: &Tree<Sp>, data: &Data<Sp, S>) -> S {
        let last = self.points.count() - 1;
        self.clearance(&[0, last].map(|i| self.points.position(i, tree, data)))
    }

    fn clearance<S: Scalar>(&self, [a, b]: &[[S; 3]; 2]) -> S {
        let distance = match self.points.count() {
            1 => self.core.to_point(a),
            _ => self.core.to_segment(a, b),
        };
        distance - self.radius
    }

    /// Adds the value's derivatives by the joint positions to `row`.
    fn add_gradient(&self, tree: &Tree<Sp>, data: &Data<Sp, f64>, row: &mut [f64]) {
        match self.points.count() {
            1 => self.gradient_over::<3>(tree, data, row),
            _ => self.gradient_over::<6>(tree, data, row),
        }
    }

    /// The same with the `N` coordinates of the points as directions.
    fn gradient_over<const N: usize>(
        &self,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        row: &mut [f64],
    ) {
        let seeded = self.seeded::<N, _>(tree, data, Dual::<N>::seeded);
        let slope = self.clearance(&seeded).gradient;
        for &k in self.points.joints() {
            row[k] += inner(&self.by::<N>(tree, data, k), &slope);
        }
    }

    /// Hands each second derivative by joint positions k ≥ l to `add`.
    fn each_curvature(
        &self,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        add: impl FnMut(usize, usize, f64),
    ) {
        match self.points.count() {
            1 => self.curvature_over::<3>(tree, data, add),
            _ => self.curvature_over::<6>(tree, data, add),
        }
    }

    fn curvature_over<const N: usize>(
        &self,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        mut add: impl FnMut(usize, usize, f64),
    ) {
        let seed = |value, i| HyperDual::<N, N>::seeded(value, Some(i), Some(i));
        let measured = self.clearance(&self.seeded::<N, _>(tree, data, seed));
        let joints = self.points.joints();
        for (i, &k) in joints.iter().enumerate() {
            let by_k = self.by::<N>(tree, data, k);
            let bent = measured.block.map(|row| inner(&by_k, &row));
            for &l in &joints[..=i] {
                let by_l = self.by::<N>(tree, data, l);
                let by_both: [f64; N] =
                    coordinates(|point| self.points.by_both(point, tree, data, k, l));
                add(k, l, inner(&by_l, &bent) + inner(&by_both, &measured.rows));
            }
        }
    }

    /// First and last point with a direction for each of the first `N` coordinates.
    fn seeded<const N: usize, S: Scalar>(
        &self,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        seed: impl Fn(f64, usize) -> S,
    ) -> [[S; 3]; 2] {
        from_fn(|point| {
            let at = self.points.position(point.min(N / 3 - 1), tree, data);
            from_fn(|i| match 3 * point + i < N {
                true => seed(at[i], 3 * point + i),
                false => S::constant(at[i]),
            })
        })
    }

    /// Change of the coordinates by joint position `k`.
    fn by<const N: usize>(&self, tree: &Tree<Sp>, data: &Data<Sp, f64>, k: usize) -> [f64; N] {
        coordinates(|point| self.points.by(point, tree, data, k))
    }
}

/// Coordinates of `N`/3 points, one after the other.
fn coordinates<const N: usize>(of: impl Fn(usize) -> [f64; 3]) -> [f64; N] {
    let mut all = [0.0; N];
    for (point, coordinates) in all.chunks_exact_mut(3).enumerate() {
        coordinates.copy_from_slice(&of(point));
    }
    all
}

impl<Sp: Space> PathRows<Sp> for KeepOutRow<Sp> {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        EndRows::values(self, &at.pose, rows);
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        let positions = &mut rows[at.position(0)..at.position(at.joints())];
        self.add_gradient(&at.plant.tree, at.data, positions);
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weights: &[f64], hessian: &mut Lower<'_>) {
        self.each_curvature(&at.plant.tree, at.data, |k, l, second| {
            hessian.add(at.position(k), at.position(l), weights[0] * second);
        });
    }
}

impl<Sp: Space> EndRows<Sp> for KeepOutRow<Sp> {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        rows[0] = self.value(&at.plant.tree, at.data);
    }
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Points within a solid and the radius around them that makes it.
fn spine(shape: &Shape) -> (Vec<[f64; 3]>, f64) {
    match *shape {
        Shape::Sphere { center, radius } => (vec![center], radius),
        Shape::Capsule { ends, radius } => (ends.to_vec(), radius),
        Shape::Box { .. } => panic!("a box against a box"),
    }
}

/// Frame and half edges of a solid's core, m, and the radius around it.
fn core(shape: &Shape) -> (Placement, [f64; 3], f64) {
    let frame = |center: [f64; 3], rotation| Placement {
        rotation,
        translation: center.into(),
    };
    match *shape {
        Shape::Sphere { center, radius } => (frame(center, Matrix3::identity()), [0.0; 3], radius),
        Shape::Capsule { ends, radius } => {
            let [a, b] = ends.map(Vector3::from);
            let along = b - a;
            let half = 0.5 * along.norm();
            // The axis of the capsule is that of z.
            let rotation = Rotation3::rotation_between(&Vector3::z(), &along)
                .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), PI));
            let center = 0.5 * (a + b);
            (
                frame(center.into(), rotation.into_inner()),
                [0.0, 0.0, half],
                radius,
            )
        }
        Shape::Box {
            center,
            rotation,
            half,
        } => (frame(center, rotation), half, 0.0),
    }
}
