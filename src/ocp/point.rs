//! Where the functions of an optimal control problem are evaluated.

use crate::autodiff::Scalar;

/// One instant on the path.
#[derive(Debug, Clone, Copy)]
pub struct Point<'a, S> {
    /// States, in the order of [`Formulation::states`](super::Formulation::states).
    pub x: &'a [S],
    /// Controls.
    pub u: &'a [S],
    /// Static parameters, in the order of [`Formulation::parameters`](super::Formulation::parameters).
    pub parameters: &'a [S],
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
    /// Static parameters.
    pub parameters: &'a [S],
    /// Values of the integrals, in the order of [`Formulation::integrals`](super::Formulation::integrals).
    pub integrals: &'a [S],
    /// t₀, s.
    pub initial_time: S,
    /// Duration t_f − t₀, s.
    pub duration: S,
}

impl<S: Scalar> Ends<'_, S> {
    /// t_f, s.
    pub fn final_time(&self) -> S {
        self.initial_time + self.duration
    }
}

/// The instant of a way-point: where an interior-point constraint is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct InteriorPoint<'a, S> {
    /// Which one, in the order of [`Formulation::way_points`](super::Formulation::way_points).
    pub way_point: usize,
    /// States there.
    pub x: &'a [S],
    /// Static parameters.
    pub parameters: &'a [S],
    /// Time there, s.
    pub t: S,
}
