//! The cost (14), one file a kind of term: terms of the path, integrated, and terms of the end.
//!
//! A term of the path says its value and derivatives by [`PathTerm`], one of the end its value by
//! [`EndTerm`]. [`PathCost`] and [`EndCost`] list the kinds, [`path`] and [`end`] make those that a
//! problem has weights for. The cost, its derivatives and its breakdown follow from these lists.

mod base_attitude;
mod base_position;
mod breakdown;
mod control;
mod effort;
mod peak;
mod rates;
mod term;
mod terminal;
mod torque;

pub use breakdown::{CostTerm, CostTerms, Side};
pub use effort::JointEffort;

pub(crate) use effort::quadrature;
pub(crate) use term::{EndTerm, PathTerm};

use super::instant::{Instant, Needs, Pose};
use super::linearization::{Adjoint, Linearization, Lower};
use super::plant::Plant;
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use base_attitude::BaseAttitudeTerm;
use base_position::BasePositionTerm;
use control::ControlTerm;
use peak::PeakTerm;
use rates::RateTerm;
use terminal::{DurationTerm, FinalAttitudeTerm, FinalPositionTerm};
use torque::TorqueTerm;

/// The kinds of terms of the path.
#[derive(Debug, Clone)]
pub(crate) enum PathCost {
    BaseAttitude(BaseAttitudeTerm),
    BasePosition(BasePositionTerm),
    Rates(RateTerm),
    Control(ControlTerm),
    Torque(TorqueTerm),
}

macro_rules! each_path {
    ($cost:expr, $term:ident => $do:expr) => {
        match $cost {
            PathCost::BaseAttitude($term) => $do,
            PathCost::BasePosition($term) => $do,
            PathCost::Rates($term) => $do,
            PathCost::Control($term) => $do,
            PathCost::Torque($term) => $do,
        }
    };
}

/// The terms of the path that `problem` has weights for.
pub(crate) fn path<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<PathCost> {
    let mut terms = Vec::new();
    terms.extend(RateTerm::squares(problem).map(PathCost::Rates));
    terms.extend(ControlTerm::new(problem).map(PathCost::Control));
    terms.extend(TorqueTerm::new(problem).map(PathCost::Torque));
    terms.extend(BaseAttitudeTerm::new(problem, plant).map(PathCost::BaseAttitude));
    terms.extend(BasePositionTerm::new(problem).map(PathCost::BasePosition));
    terms.extend(RateTerm::matrix(problem, Sp::ANGLES).map(PathCost::Rates));
    terms
}

/// The kinds of terms of the end.
#[derive(Debug, Clone)]
pub(crate) enum EndCost {
    Attitude(FinalAttitudeTerm),
    Position(FinalPositionTerm),
    Duration(DurationTerm),
    Peak(PeakTerm),
}

macro_rules! each_end {
    ($cost:expr, $term:ident => $do:expr) => {
        match $cost {
            EndCost::Attitude($term) => $do,
            EndCost::Position($term) => $do,
            EndCost::Duration($term) => $do,
            EndCost::Peak($term) => $do,
        }
    };
}

/// The terms of the end that `problem` has weights for.
pub(crate) fn end<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<EndCost> {
    let mut terms = Vec::new();
    terms.extend(FinalAttitudeTerm::new(problem, plant).map(EndCost::Attitude));
    terms.extend(DurationTerm::new(problem).map(EndCost::Duration));
    terms.extend(FinalPositionTerm::new(problem).map(EndCost::Position));
    terms.extend(PeakTerm::all(problem).map(EndCost::Peak));
    terms
}

impl<Sp: Space> PathTerm<Sp> for PathCost {
    fn id(&self) -> CostId {
        each_path!(self, term => PathTerm::<Sp>::id(term))
    }

    fn side(&self) -> Side {
        each_path!(self, term => PathTerm::<Sp>::side(term))
    }

    fn needs(&self) -> Needs {
        each_path!(self, term => PathTerm::<Sp>::needs(term))
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        each_path!(self, term => term.value(at))
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        each_path!(self, term => term.gradient(at, row));
    }

    fn weigh(&self, at: &Linearization<'_, Sp>, weight: f64, adjoint: &mut Adjoint<'_>) {
        each_path!(self, term => term.weigh(at, weight, adjoint));
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        each_path!(self, term => term.curvature(at, weight, hessian));
    }
}

impl<Sp: Space> EndTerm<Sp> for EndCost {
    fn id(&self) -> CostId {
        each_end!(self, term => EndTerm::<Sp>::id(term))
    }

    fn side(&self) -> Side {
        each_end!(self, term => EndTerm::<Sp>::side(term))
    }

    fn needs(&self) -> Needs {
        each_end!(self, term => EndTerm::<Sp>::needs(term))
    }

    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        each_end!(self, term => term.value(at))
    }
}
