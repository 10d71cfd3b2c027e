#![doc = include_str!("../README.md")]

pub mod autodiff;
pub mod collocation;
pub mod config;
pub mod dynamics;
pub mod integrate;
pub mod nlp;
mod numeric;
pub mod parallel;
pub mod planner;
pub mod problem;
pub mod refine;
pub mod report;
pub mod simulate;
pub mod solution;
pub mod study;
pub mod system;
mod text;
pub mod transcription;
pub mod verify;

// Not part of the library's interface: what the program and its tests need to reach.
#[doc(hidden)]
#[allow(rustdoc::invalid_html_tags)] // help texts name places by <problem name>
pub mod cli;
#[doc(hidden)]
pub mod plot;
#[doc(hidden)]
pub mod reproduction;

/// The optimal control problem as the transcription sees it, eq. (14) to (20), and what solves it.
///
/// Any problem that implements [`Ocp`](ocp::Ocp) can be solved by [`ocp::solve`], not only the
/// manipulator's.
///
/// # What a problem is made of
///
/// A [`Formulation`](ocp::Formulation) lists what there is to decide and within which bounds. The functions
/// of [`Ocp`](ocp::Ocp) see it as slices in that order:
///
/// | list | is decided | seen as |
/// | --- | --- | --- |
/// | `states` | at every node | `Point::x`, `Ends::initial`, `Ends::terminal`, `InteriorPoint::x` |
/// | `controls` | at every collocation point | `Point::u` |
/// | `parameters` | once | `parameters` of all three |
/// | `integrals` | follow from `Ocp::integrands` | `Ends::integrals` |
/// | `initial_time`, `duration` | once | `Point::t`, `Ends::initial_time`, `Ends::duration` |
///
/// and write rates (one for each state, in its unit a second), `path`, `boundary` and way-point rows,
/// integrands (in the integral's unit a second). Times are in seconds, or whatever unit the problem is
/// written in. A solution has them in [`Discretization`](transcription::Discretization): `x`, `u`,
/// `parameters`, `integrals`, `initial_time`, `duration`.
///
/// What cannot be is refused before the first solve: [`FormulationError`](ocp::FormulationError) names the
/// list and the place, [`SolveError`](ocp::SolveError) the function that leaves an output unwritten or not
/// finite.
// Here and not in a file of its own: `solve` stands above the folder that the problem's files are in.
pub mod ocp {
    mod derivatives;
    mod dyn_ocp;
    mod elastic;
    mod formulation;
    mod functions;
    mod interval;
    mod invariants;
    mod point;
    mod problem;
    mod released;
    mod validation;

    pub use crate::refine::{SolveError, SolveSettings as Settings, solve, solve_from};
    pub use derivatives::PointDerivatives;
    pub use dyn_ocp::{Derivatives, DynOcp, Functions};
    pub use elastic::{Elastic, LimitGroup, Limited};
    pub use formulation::{Formulation, Quantity, WayPoint};
    pub use functions::Part;
    pub(crate) use functions::{PointShape, Shape, WayPointShape};
    pub use interval::Interval;
    pub(crate) use invariants::{Dependent, dependent};
    pub use point::{Ends, InteriorPoint, Point};
    pub use problem::Ocp;
    pub(crate) use released::Released;
    pub use validation::FormulationError;
}

/// The small dense algebra that models are described with.
pub use nalgebra;
