//! What a problem is solved with on every mesh: scales, bounds that can act, derivatives' patterns.
//!
//! All three are suppositions, made of the first trajectory. Each solution is held against them; where
//! one does not hold, the mesh is solved again.
//!
//! Derived in docs/algorithms.md#scales and docs/algorithms.md#sparsity.

use super::{ErrorMeasure, Errors, Settings};
use crate::nlp::{Status, Units};
use crate::ocp::{DynOcp, Formulation};
use crate::transcription::{Discretization, Layout, Patterns, Ranges, Scales};
use std::borrow::Cow;

/// Suppositions about one problem.
pub(super) struct Assumptions<'a> {
    ocp: &'a dyn DynOcp,
    all: Formulation,
    /// The formulation without bounds that lie far outside.
    near: Formulation,
    scales: Scales,
    /// Where the trajectory goes that the first solve starts from.
    ranges: Ranges,
    patterns: Cow<'a, Patterns>,
}

impl<'a> Assumptions<'a> {
    /// By the trajectory that the first solve starts from, which has a node at every way-point.
    pub fn new(ocp: &'a dyn DynOcp, patterns: &'a Patterns, start: &Discretization) -> Self {
        let all = ocp.formulation();
        let ranges = Ranges::of(ocp, &all, start);
        let near = ranges.without_far_bounds(&all);
        let wider = patterns.widened(ocp, &all, start);
        Self {
            ocp,
            scales: Scales::new(&near, &ranges),
            ranges,
            all,
            near,
            patterns: wider.map_or(Cow::Borrowed(patterns), Cow::Owned),
        }
    }

    /// The formulation to solve.
    pub fn formulation(&self) -> Formulation {
        self.near.clone()
    }

    /// Its derivatives' patterns.
    pub fn patterns(&self) -> &Patterns {
        &self.patterns
    }

    /// Units of the programme of `layout`.
    pub fn units(&self, layout: &Layout) -> Units {
        self.scales.units(layout)
    }

    /// Mends what does not hold of `solution`; whether it has to be solved again.
    pub fn settle(&mut self, solution: &Discretization, status: Status) -> bool {
        if matches!(status, Status::Interrupted | Status::TimeLimit) {
            return false;
        }
        let ranges = Ranges::of(self.ocp, &self.all, solution);
        let mut again = false;
        if let Some(wider) = self.patterns.widened(self.ocp, &self.all, solution) {
            self.patterns = Cow::Owned(wider);
            again = true;
        }
        if ranges.exceeds_dropped(&self.all, &self.near) {
            self.near = self.all.clone();
            // A solution without bounds that act tells no size.
            self.scales = Scales::new(&self.all, &self.ranges);
            return true;
        }
        // Nor does what did not converge.
        if let Some(scales) = self.scales.after(&ranges).filter(|_| status.is_solved()) {
            // Solved in units too small, a solution is only more accurate than need be.
            again |= scales.any_below(&self.scales);
            self.scales = scales;
        }
        again
    }

    /// `errors` as `settings` measure them.
    pub fn measured(&self, errors: Errors, settings: &Settings) -> Errors {
        match settings.error {
            ErrorMeasure::Paper => errors,
            ErrorMeasure::Relative => {
                errors.in_units_of(&self.scales.states(), &self.scales.integrals())
            }
        }
    }

    /// `trajectory` in the units that `settings` measure errors in.
    pub fn in_units<'t>(
        &self,
        trajectory: &'t Discretization,
        settings: &Settings,
    ) -> Cow<'t, Discretization> {
        let scales = self.scales.states();
        match settings.error {
            ErrorMeasure::Relative if scales.iter().any(|&scale| scale != 1.0) => {
                Cow::Owned(trajectory.in_units_of(&scales))
            }
            _ => Cow::Borrowed(trajectory),
        }
    }
}
