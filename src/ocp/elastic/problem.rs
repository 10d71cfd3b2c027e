//! The elastic problem: the one inside with a state more for each group of limits, and two rows for
//! each bound that gives way.

use super::derivatives::ElasticDerivatives;
use super::limits::{AtInstant, Elastic, ElasticBound, OnPath};
use crate::autodiff::Scalar;
use crate::ocp::{
    Ends, Formulation, InteriorPoint, Interval, Ocp, Point, PointDerivatives, Quantity,
};

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
            let value = match bound.quantity {
                AtInstant::State(i) => x[i],
                AtInstant::Row(row) => inner_rows[row],
            };
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
        for point in &mut formulation.way_points {
            let amounts = self.groups.len();
            point
                .states
                .extend(std::iter::repeat_n(Interval::FREE, amounts));
        }
        for group in &self.groups {
            let amount = Interval::new(0.0, f64::INFINITY);
            let excess = Quantity::new(format!("excess of {}", group.name), amount);
            formulation.states.push(excess.scaled(1.0));
            formulation.initial.push(Interval::FREE);
            formulation.terminal.push(Interval::FREE);
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
        let n = self.base.states.len();
        let (x, amounts) = point.x.split_at(n);
        let (rates, still) = rates.split_at_mut(n);
        let cost = self.inner.continuous(
            Point { x, ..point },
            &mut scratch.inner,
            rates,
            &mut scratch.path,
        );
        still.fill(S::zero());
        let own = scratch.path.len();
        path[..own].copy_from_slice(&scratch.path);
        for (rows, bound) in path[own..].chunks_exact_mut(2).zip(&self.path) {
            let value = match bound.quantity {
                OnPath::State(i) => x[i],
                OnPath::Control(i) => point.u[i],
                OnPath::Row(i) => scratch.path[i],
            };
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
        let x = &point.x[..self.base.states.len()];
        let inner = Point { x, ..point };
        self.inner.integrands(inner, &mut scratch.inner, integrands);
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        let n = self.base.states.len();
        let (x, amounts) = ends.terminal.split_at(n);
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.boundary.len());
        let inner_ends = Ends {
            initial: &ends.initial[..n],
            terminal: x,
            ..ends
        };
        let mut cost = self
            .inner
            .boundary(inner_ends, &mut scratch.inner, inner_rows)
            * self.regularization;
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
        let (x, amounts) = point.x.split_at(self.base.states.len());
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.way_points[w].rows.len());
        let inner = InteriorPoint { x, ..point };
        self.inner.way_point(inner, &mut scratch.inner, inner_rows);
        self.bound_ends(&self.way_points[w], x, amounts, inner_rows, elastic_rows);
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        let inner = self.inner.derivatives()?;
        Some(Box::new(ElasticDerivatives::new(self, inner)))
    }

    fn has_branches(&self) -> bool {
        self.inner.has_branches()
    }
}
