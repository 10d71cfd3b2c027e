//! The problem without conditions that follow from others.

use super::invariants::Dependent;
use super::{Ends, Formulation, InteriorPoint, Ocp, Point, PointDerivatives};
use crate::autodiff::Scalar;

/// The problem inside, its dependent conditions replaced by bounds that are not met.
#[derive(Debug)]
pub(crate) struct Released<'a, O> {
    inner: &'a O,
    dependent: &'a [Dependent],
}

impl<'a, O> Released<'a, O> {
    pub fn new(inner: &'a O, dependent: &'a [Dependent]) -> Self {
        Self { inner, dependent }
    }
}

impl<O: Ocp> Ocp for Released<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

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

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        self.inner.scratch()
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        self.inner.continuous(point, scratch, rates, path)
    }

    fn integrands<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        integrands: &mut [S],
    ) {
        self.inner.integrands(point, scratch, integrands);
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        self.inner.boundary(ends, scratch, rows)
    }

    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        self.inner.way_point(point, scratch, rows);
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        self.inner.derivatives()
    }

    fn has_branches(&self) -> bool {
        self.inner.has_branches()
    }
}
