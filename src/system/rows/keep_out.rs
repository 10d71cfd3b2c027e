//! Spheres on the arm that are kept out of others, and of boxes on the base.

use super::{BoundId, Component, EndRows, PathRows, Row};
use crate::autodiff::{HyperDual, Scalar};
use crate::dynamics::space::{Space, Vector};
use crate::dynamics::{Data, Mount, Placement, Tree};
use crate::ocp::Interval;
use crate::problem::{KeepOut, LimitId, Obstacle, Problem, Unit};
use crate::system::instant::{Instant, Pose};
use crate::system::linearization::{Linearization, Lower};
use crate::system::plant::Plant;
use nalgebra::{Matrix3, Vector3};
use std::slice;

/// Even power of the norm that rounds a box: a smooth solid around it, with the corners on its
/// surface and faces that stand off by a fifth of half an edge in space (an eighth in the plane).
const POWER: i32 = 6;

/// A pair compiled for evaluation. Its row is at least 1 where the pair is apart.
#[derive(Debug, Clone)]
pub(crate) struct KeepOutRow<Sp: Space> {
    row: Row,
    sphere: Mount<Sp>,
    from: Solid<Sp>,
}

#[derive(Debug, Clone)]
enum Solid<Sp: Space> {
    /// Other sphere's centre and 1/(sum of radii)².
    Sphere(Mount<Sp>, f64),
    /// Box centre and 1/(half edge) along each axis of the plane or of space.
    Box(Mount<Sp>, Vec<f64>),
}

impl<Sp: Space> KeepOutRow<Sp> {
    /// The pairs of `problem`.
    pub fn all(problem: &Problem, plant: &Plant<Sp>) -> impl Iterator<Item = Self> {
        let pairs = problem.limits.keep_out.iter().enumerate();
        pairs.map(|(i, pair)| Self::new(i, pair, &plant.tree))
    }

    fn new(index: usize, pair: &KeepOut, tree: &Tree<Sp>) -> Self {
        let at = |joint, center: [f64; 3]| {
            let placement = Placement {
                rotation: Matrix3::identity(),
                translation: Vector3::from(center),
            };
            tree.mount(joint, &placement)
        };
        let from = match &pair.from {
            Obstacle::Sphere(other) => Solid::Sphere(
                at(other.joint, other.center),
                (pair.sphere.radius + other.radius).powi(-2),
            ),
            Obstacle::Box { center, half } => {
                // The sphere's radius goes to the box, which is then rounded outwards.
                let count = Sp::LENGTHS as f64;
                let outwards = count.powf(1.0 / f64::from(POWER));
                let edge = |h: &f64| 1.0 / ((h + pair.sphere.radius) * outwards);
                Solid::Box(
                    at(None, *center),
                    half.iter().take(Sp::LENGTHS).map(edge).collect(),
                )
            }
        };
        Self {
            row: Row::new(
                BoundId::new(LimitId::KeepOut, Component::Pair(index)),
                Unit::One,
                pair.name.clone(),
                Interval::new(1.0, f64::INFINITY),
            ),
            sphere: at(pair.sphere.joint, pair.sphere.center),
            from,
        }
    }

    /// Squared distance over the least one, or the box's rounded norm to its power.
    fn value<S: Scalar>(&self, tree: &Tree<Sp>, data: &Data<Sp, S>) -> S {
        let (Solid::Sphere(other, _) | Solid::Box(other, _)) = &self.from;
        self.measure(tree.position(&self.sphere, data) - tree.position(other, data))
    }

    /// The value for the vector from the other solid's centre to the sphere's.
    fn measure<S: Scalar>(&self, apart: Sp::Linear<S>) -> S {
        match &self.from {
            Solid::Sphere(_, scale) => apart.dot(&apart) * *scale,
            Solid::Box(_, scales) => {
                let mut sum = S::zero();
                for (&c, &scale) in apart.components().iter().zip(scales) {
                    let square = (c * scale).square();
                    sum += square * square * square;
                }
                sum
            }
        }
    }

    /// The value with its derivatives by the vector's components.
    fn measured(&self, tree: &Tree<Sp>, data: &Data<Sp, f64>) -> HyperDual<3, 3> {
        let (Solid::Sphere(other, _) | Solid::Box(other, _)) = &self.from;
        let apart = tree.position(&self.sphere, data) - tree.position(other, data);
        let mut seeded = [HyperDual::constant(0.0); 3];
        for (i, (to, &c)) in seeded.iter_mut().zip(apart.components()).enumerate() {
            *to = HyperDual::seeded(c, Some(i), Some(i));
        }
        self.measure(Sp::Linear::from_components(&seeded[..Sp::LENGTHS]))
    }

    /// Change of the vector by joint position `k`.
    fn apart_by(&self, tree: &Tree<Sp>, data: &Data<Sp, f64>, k: usize) -> Sp::Linear<f64> {
        let (Solid::Sphere(other, _) | Solid::Box(other, _)) = &self.from;
        tree.position_by(&self.sphere, data, k) - tree.position_by(other, data, k)
    }

    /// Adds the value's derivatives by the joint positions to `row`.
    fn add_gradient(&self, tree: &Tree<Sp>, data: &Data<Sp, f64>, row: &mut [f64]) {
        let slope = self.measured(tree, data).rows;
        for (k, sum) in row.iter_mut().enumerate() {
            let by = self.apart_by(tree, data, k);
            *sum += inner(by.components(), &slope);
        }
    }

    /// Hands each second derivative by joint positions k ≥ l to `add`.
    fn each_curvature(
        &self,
        tree: &Tree<Sp>,
        data: &Data<Sp, f64>,
        mut add: impl FnMut(usize, usize, f64),
    ) {
        let (Solid::Sphere(other, _) | Solid::Box(other, _)) = &self.from;
        let measured = self.measured(tree, data);
        for k in 0..tree.joint_count() {
            let by_k = self.apart_by(tree, data, k);
            let bent = measured.block.map(|row| inner(by_k.components(), &row));
            for l in 0..=k {
                let by_l = self.apart_by(tree, data, l);
                let by_both = tree.position_by_both(&self.sphere, data, k, l)
                    - tree.position_by_both(other, data, k, l);
                let second =
                    inner(by_l.components(), &bent) + inner(by_both.components(), &measured.rows);
                add(k, l, second);
            }
        }
    }
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
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
