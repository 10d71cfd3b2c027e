//! The problem without conditions that follow from others.

use super::dyn_ocp::{Derivatives, DynOcp, Functions};
use super::functions::Part;
use super::invariants::Dependent;
use super::{Formulation, PointDerivatives};
use crate::autodiff::Sparsity;

/// The problem inside, its dependent conditions replaced by bounds that are not met.
pub(crate) struct Released<'a> {
    inner: &'a dyn DynOcp,
    dependent: &'a [Dependent],
}

impl<'a> Released<'a> {
    pub fn new(inner: &'a dyn DynOcp, dependent: &'a [Dependent]) -> Self {
        Self { inner, dependent }
    }
}

impl DynOcp for Released<'_> {
    fn formulation(&self) -> Formulation {
        let mut formulation = self.inner.formulation();
        for condition in self.dependent {
            let states = match condition.way_point {
                Some(w) => &mut formulation.way_points[w].states,
                None => &mut formulation.terminal,
            };
            states[condition.state] = condition.bounds;
        }
        formulation
    }

    fn has_branches(&self) -> bool {
        self.inner.has_branches()
    }

    fn own_derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        self.inner.own_derivatives()
    }

    fn functions(&self) -> Box<dyn Functions + '_> {
        self.inner.functions()
    }

    fn trace(&self, part: Part, formulation: &Formulation, used: &[bool], at: &[f64]) -> Sparsity {
        self.inner.trace(part, formulation, used, at)
    }

    fn differentiate(
        &self,
        part: Part,
        formulation: &Formulation,
        sparsity: Sparsity,
    ) -> Box<dyn Derivatives + '_> {
        self.inner.differentiate(part, formulation, sparsity)
    }
}
