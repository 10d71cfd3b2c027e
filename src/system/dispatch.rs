//! The problem in the plane or in space: the one place where that is decided.

use super::free_floating::FreeFloating;
use crate::dynamics::space::{Planar, Spatial};
use crate::problem::Problem;

/// The optimal control problem of a task, in the plane where its robot moves in one.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum System {
    /// All joint axes are parallel: the base attitude is one angle.
    Planar(Box<FreeFloating<Planar>>),
    /// Anything else.
    Spatial(Box<FreeFloating<Spatial>>),
}

impl System {
    /// The system of `problem`.
    pub fn new(problem: &Problem) -> Self {
        match FreeFloating::planar(problem) {
            Some(planar) => Self::Planar(Box::new(planar)),
            None => Self::Spatial(Box::new(FreeFloating::spatial(problem))),
        }
    }
}

/// Evaluates an expression with the [`FreeFloating`] behind a `&System`, whichever it is.
macro_rules! with_system {
    ($system:expr, $name:ident => $do:expr) => {
        match $system {
            $crate::system::System::Planar(system) => {
                let $name = system.as_ref();
                $do
            }
            $crate::system::System::Spatial(system) => {
                let $name = system.as_ref();
                $do
            }
        }
    };
}

pub(crate) use with_system;
