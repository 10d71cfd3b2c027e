//! A problem that can be.

use super::builder::ProblemBuilder;
use super::components::base_sizes;
use super::error::ProblemError;
use super::validation;
use crate::dynamics::Model;
use std::ops::Deref;

/// A planning problem whose content has been checked, eq. (7) to (18).
///
/// Built by [`Problem::builder`] or read from a file; a changed one comes from [`edited`]. It
/// dereferences to [`ProblemBuilder`] so that it reads as its description does
/// (`problem.limits.torque`), but never to a mutable one: it cannot be changed in place, and so it
/// is never invalid.
///
/// [`edited`]: Problem::edited
#[derive(Debug, Clone, PartialEq)]
pub struct Problem(ProblemBuilder);

impl Problem {
    /// Begins a rest-to-rest task of `duration` seconds from `initial` to `goal` joint positions,
    /// as [`ProblemBuilder::new`].
    pub fn builder(
        name: &str,
        robot: Model,
        duration: f64,
        initial: &[f64],
        goal: &[f64],
    ) -> ProblemBuilder {
        ProblemBuilder::new(name, robot, duration, initial, goal)
    }

    /// A copy of the problem, changed by `edit`.
    ///
    /// # Errors
    /// [`ProblemError`] for the first thing found wrong after the change.
    pub fn edited(&self, edit: impl FnOnce(&mut ProblemBuilder)) -> Result<Self, ProblemError> {
        let mut builder = self.0.clone();
        edit(&mut builder);
        builder.build()
    }

    /// The description, to be changed and built again.
    pub fn into_builder(self) -> ProblemBuilder {
        self.0
    }

    /// Components of the base's angular velocity and of its position for `robot`: 1 and 2 in the
    /// plane, 3 and 3 in space.
    pub fn base_sizes(robot: &Model) -> (usize, usize) {
        base_sizes(robot)
    }
}

impl Deref for Problem {
    type Target = ProblemBuilder;

    fn deref(&self) -> &ProblemBuilder {
        &self.0
    }
}

impl ProblemBuilder {
    /// Checks lengths, finiteness and signs, that start and goal lie within their limits, and that
    /// no joint can move without moving any mass there.
    ///
    /// # Errors
    /// [`ProblemError`] for the first thing found wrong; [`faults`](Self::faults) has all.
    pub fn build(self) -> Result<Problem, ProblemError> {
        match self.faults().into_iter().next() {
            Some(fault) => Err(fault),
            None => Ok(Problem(self)),
        }
    }

    /// All that [`build`](Self::build) would find wrong: the first thing where something has the wrong
    /// length or is no sensible number, else every place where start, way-points and goal are outside
    /// of their limits.
    pub fn faults(&self) -> Vec<ProblemError> {
        validation::faults(self)
    }
}
