//! The optimal control problem as a trait.

use super::{Interval, PointDerivatives};
use crate::autodiff::Scalar;

/// A named quantity with its bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// What a person calls it ("joint 2 rate").
    pub name: String,
    /// Bounds along the whole path (states, controls, path rows) or at the ends (boundary rows).
    pub bounds: Interval,
}

impl Quantity {
    /// A quantity within bounds.
    pub fn new(name: impl Into<String>, bounds: Interval) -> Self {
        Self {
            name: name.into(),
            bounds,
        }
    }
}

/// What there is to decide and within which bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Formulation {
    /// States x, with their bounds along the path.
    pub states: Vec<Quantity>,
    /// Controls u, with their bounds.
    pub controls: Vec<Quantity>,
    /// Rows of the path constraint C, eq. (18), held at the collocation points.
    pub path: Vec<Quantity>,
    /// Rows of the boundary constraint E, eq. (18), beyond what `initial` and `terminal` say.
    pub boundary: Vec<Quantity>,
    /// Bounds of each state at t₀.
    pub initial: Vec<Interval>,
    /// Bounds of each state at t_f.
    pub terminal: Vec<Interval>,
    /// Bounds of the duration t_f − t₀ in s; fixed where both are equal. t₀ is 0.
    pub duration: Interval,
    /// What has to hold between the ends, in the order of the fractions, no two at the same.
    pub way_points: Vec<WayPoint>,
}

/// Conditions at one instant between t₀ and t_f: an interior-point constraint.
///
/// The mesh has a breakpoint there, so that the states have a node and their costates may jump.
#[derive(Debug, Clone, PartialEq)]
pub struct WayPoint {
    /// Where it stands: fraction of the duration, above 0 and below 1.
    pub fraction: f64,
    /// Bounds of each state there, beyond those along the path.
    pub states: Vec<Interval>,
    /// Rows that are functions of the states there and of the time.
    pub rows: Vec<Quantity>,
}

impl Formulation {
    /// Number of states and of controls.
    pub fn widths(&self) -> (usize, usize) {
        (self.states.len(), self.controls.len())
    }

    /// Fractions of the duration at which the mesh needs a breakpoint, rising.
    pub fn way_point_fractions(&self) -> Vec<f64> {
        self.way_points.iter().map(|point| point.fraction).collect()
    }
}

/// One instant on the path.
#[derive(Debug, Clone, Copy)]
pub struct Point<'a, S> {
    /// States, in the order of [`Formulation::states`].
    pub x: &'a [S],
    /// Controls.
    pub u: &'a [S],
    /// Time, s.
    pub t: S,
}

/// Both ends of the path.
#[derive(Debug, Clone, Copy)]
pub struct Ends<'a, S> {
    /// States at t₀.
    pub initial: &'a [S],
    /// States at t_f.
    pub terminal: &'a [S],
    /// Duration t_f − t₀, s.
    pub duration: S,
}

/// The instant of a way-point.
#[derive(Debug, Clone, Copy)]
pub struct Passage<'a, S> {
    /// Which one, in the order of [`Formulation::way_points`].
    pub way_point: usize,
    /// States there.
    pub x: &'a [S],
    /// Time there, s.
    pub t: S,
}

/// An optimal control problem in Bolza form, eq. (17) and (18).
///
/// Minimise Φ(ends) + ∫ℒ dt subject to ẋ = f, path and boundary constraints and bounds. All
/// functions are generic over [`Scalar`], from which values, gradients and Hessians follow; they
/// must be smooth where they are evaluated. Sparsity follows from their operations, recorded by
/// [`Trace`](crate::autodiff::Trace); a problem that branches on values says so by
/// [`Ocp::has_branches`].
pub trait Ocp: Sync {
    /// Mutable scratch for one number type, so that nothing is allocated in the solve.
    type Scratch<S: Scalar>: Send;

    /// Quantities and bounds. Called at set-up only.
    fn formulation(&self) -> Formulation;

    /// Fresh scratch.
    fn scratch<S: Scalar>(&self) -> Self::Scratch<S>;

    /// Writes f into `rates` and the path rows C into `path`; returns the running cost ℒ.
    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S;

    /// Writes the boundary rows E into `rows`; returns the terminal cost Φ.
    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        let _ = (ends, scratch, rows);
        S::zero()
    }

    /// Writes the rows of a way-point into `rows`.
    fn way_point<S: Scalar>(
        &self,
        passage: Passage<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        let _ = (passage, scratch, rows);
    }

    /// Derivatives of [`Ocp::continuous`] by the problem's own structure, where it has any that
    /// beat dual numbers swept over the whole function.
    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        None
    }

    /// Whether the functions branch by `if` or `match` on values, so that operations of one branch
    /// say nothing of another's. Every derivative is then kept in the sparsity pattern.
    ///
    /// `max`, `min` and `abs` of [`Scalar`] are no such branches.
    fn has_branches(&self) -> bool {
        false
    }
}
