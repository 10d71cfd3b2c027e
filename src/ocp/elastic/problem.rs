//! The elastic problem: the one inside with a static parameter more for each group of limits, and two
//! rows for each bound that gives way.

use super::derivatives::ElasticDerivatives;
use super::limits::{AtInstant, Elastic, ElasticBound, OnPath};
use crate::autodiff::Scalar;
use crate::ocp::{
    Ends, Formulation, InteriorPoint, Interval, Ocp, Point, PointDerivatives, Quantity,
};

/// What each amount begins with.
const FIRST_AMOUNT: f64 = 1.0;

impl<O: Ocp> Elastic<'_, O> {
    /// The two rows of each of `bounds`, from the states at that instant and the inner rows.
    fn bound_ends<S: Scalar>(
        &self,
        bounds: &[ElasticBound<AtInstant>],
        x: &[S],
        amounts: &[S],
        inner_rows: &[S],
        elastic_rows: &mut [S],
    ) {
        for (rows, bound) in elastic_rows.chunks_exact_mut(2).zip(bounds) {
            let value = bound.quantity.value(x, inner_rows);
            self.widen(value, bound.group, amounts, rows);
        }
    }

    /// The two rows of a bound of `group`.
    fn widen<S: Scalar>(&self, value: S, group: usize, amounts: &[S], rows: &mut [S]) {
        let room = amounts[group] * self.groups[group].scale;
        rows[0] = value - room;
        rows[1] = value + room;
    }
}

/// Scratch of [`Elastic`].
#[derive(Debug)]
pub struct ElasticScratch<S, I> {
    inner: I,
    path: Vec<S>,
}

impl<O: Ocp> Ocp for Elastic<'_, O> {
    type Scratch<S: Scalar> = ElasticScratch<S, O::Scratch<S>>;

    fn formulation(&self) -> Formulation {
        let mut formulation = self.base.clone();
        for bound in &self.path {
            let quantity = match bound.quantity {
                OnPath::State(i) => &self.base.states[i],
                OnPath::Control(i) => &self.base.controls[i],
                OnPath::Row(i) => &self.base.path[i],
            };
            let rows = self.rows(quantity, bound.group, bound.bounds);
            formulation.path.extend(rows);
        }
        for bound in &self.boundary {
            let quantity = match bound.quantity {
                AtInstant::State(i) => &self.base.states[i],
                AtInstant::Row(b) => &self.base.boundary[b],
            };
            let rows = self.rows(quantity, bound.group, bound.bounds);
            formulation.boundary.extend(rows);
        }
        for (w, elastic) in self.way_points.iter().enumerate() {
            for bound in elastic {
                let quantity = match bound.quantity {
                    AtInstant::State(i) => &self.base.states[i],
                    AtInstant::Row(r) => &self.base.way_points[w].rows[r],
                };
                let rows = self.rows(quantity, bound.group, bound.bounds);
                formulation.way_points[w].rows.extend(rows);
            }
        }
        for group in &self.groups {
            let amount = Interval::new(0.0, f64::INFINITY);
            let excess = Quantity::new(format!("excess of {}", group.name), amount);
            formulation = formulation.parameter(excess.scaled(1.0), FIRST_AMOUNT);
        }
        formulation
    }

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        ElasticScratch {
            inner: self.inner.scratch(),
            path: vec![S::zero(); self.base.path.len()],
        }
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let (parameters, amounts) = point.parameters.split_at(self.base.parameters.len());
        let inner = Point {
            parameters,
            ..point
        };
        let cost = self
            .inner
            .continuous(inner, &mut scratch.inner, rates, &mut scratch.path);
        let own = scratch.path.len();
        path[..own].copy_from_slice(&scratch.path);
        for (rows, bound) in path[own..].chunks_exact_mut(2).zip(&self.path) {
            let value = bound.quantity.value(point.x, point.u, &scratch.path);
            self.widen(value, bound.group, amounts, rows);
        }
        let mut cost = cost * self.regularization;
        if self.control_weight > 0.0 {
            for &u in point.u {
                cost += u * u * self.control_weight;
            }
        }
        cost
    }

    fn integrands<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        integrands: &mut [S],
    ) {
        let parameters = &point.parameters[..self.base.parameters.len()];
        let inner = Point {
            parameters,
            ..point
        };
        self.inner.integrands(inner, &mut scratch.inner, integrands);
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        let (parameters, amounts) = ends.parameters.split_at(self.base.parameters.len());
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.boundary.len());
        let inner = Ends { parameters, ..ends };
        let mut cost =
            self.inner.boundary(inner, &mut scratch.inner, inner_rows) * self.regularization;
        let x = ends.terminal;
        self.bound_ends(&self.boundary, x, amounts, inner_rows, elastic_rows);
        for &amount in amounts {
            cost += amount;
        }
        cost
    }

    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        let w = point.way_point;
        let (parameters, amounts) = point.parameters.split_at(self.base.parameters.len());
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.way_points[w].rows.len());
        let inner = InteriorPoint {
            parameters,
            ..point
        };
        self.inner.way_point(inner, &mut scratch.inner, inner_rows);
        let bounds = &self.way_points[w];
        self.bound_ends(bounds, point.x, amounts, inner_rows, elastic_rows);
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        let inner = self.inner.derivatives()?;
        Some(Box::new(ElasticDerivatives::new(self, inner)))
    }

    fn has_branches(&self) -> bool {
        self.inner.has_branches()
    }
}
