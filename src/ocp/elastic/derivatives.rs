//! Derivatives of a problem with elastic limits from those of the problem inside.

use super::limits::{Elastic, OnPath};
use crate::ocp::{Ocp, Point, PointDerivatives};

pub(super) struct ElasticDerivatives<'a, O> {
    problem: &'a Elastic<'a, O>,
    inner: Box<dyn PointDerivatives + 'a>,
    /// States, amounts, controls and own path rows.
    states: usize,
    amounts: usize,
    controls: usize,
    path: usize,
    /// Static parameters and the time.
    others: usize,
    /// Running cost and integrands.
    integrated: usize,
    weights: Vec<f64>,
    first: Vec<f64>,
    second: Vec<f64>,
}

impl<'a, O: Ocp> ElasticDerivatives<'a, O> {
    pub fn new(problem: &'a Elastic<'a, O>, inner: Box<dyn PointDerivatives + 'a>) -> Self {
        let (states, controls) = problem.base.widths();
        let path = problem.base.path.len();
        let others = problem.base.parameters.len() + 1;
        let integrated = problem.base.integrals.len() + 1;
        let (inputs, outputs) = (states + controls + others, states + path + integrated);
        Self {
            problem,
            inner,
            states,
            amounts: problem.groups.len(),
            controls,
            path,
            others,
            integrated,
            weights: vec![0.0; outputs],
            first: vec![0.0; outputs * inputs],
            second: vec![0.0; inputs * inputs],
        }
    }

    fn inputs(&self) -> usize {
        self.states + self.controls + self.others
    }

    /// Where an input of the problem inside stands here.
    fn outer(&self, input: usize) -> usize {
        if input < self.states {
            input
        } else {
            input + self.amounts
        }
    }
}

impl<O: Ocp> PointDerivatives for ElasticDerivatives<'_, O> {
    fn jacobian(&mut self, point: Point<'_, f64>, jacobian: &mut [f64]) {
        let x = &point.x[..self.states];
        self.inner.jacobian(Point { x, ..point }, &mut self.first);
        jacobian.fill(0.0);
        let (from, width) = (self.inputs(), self.inputs() + self.amounts);
        let last = self.states + self.path;
        let elastic = 2 * self.problem.path.len();
        for row in 0..last + self.integrated {
            let (to, factor) = match row {
                _ if row < self.states => (row, 1.0),
                _ if row < last => (row + self.amounts, 1.0),
                _ if row == last => (row + self.amounts + elastic, self.problem.regularization),
                _ => (row + self.amounts + elastic, 1.0),
            };
            for input in 0..from {
                jacobian[to * width + self.outer(input)] = factor * self.first[row * from + input];
            }
        }
        let cost = (last + self.amounts + elastic) * width;
        for (j, u) in point.u.iter().enumerate() {
            jacobian[cost + self.outer(self.states + j)] += 2.0 * self.problem.control_weight * u;
        }
        let own = last + self.amounts;
        for (k, bound) in self.problem.path.iter().enumerate() {
            let scale = self.problem.groups[bound.group].scale;
            for (row, sign) in [(own + 2 * k, -1.0), (own + 2 * k + 1, 1.0)] {
                let to = &mut jacobian[row * width..(row + 1) * width];
                match bound.quantity {
                    OnPath::State(i) => to[i] = 1.0,
                    OnPath::Control(i) => to[self.outer(self.states + i)] = 1.0,
                    OnPath::Row(i) => {
                        for input in 0..from {
                            to[self.outer(input)] = self.first[(self.states + i) * from + input];
                        }
                    }
                }
                to[self.states + bound.group] = sign * scale;
            }
        }
    }

    fn hessian(&mut self, point: Point<'_, f64>, weights: &[f64], hessian: &mut [f64]) {
        let (states, path) = (self.states, self.path);
        let (rates, rest) = weights.split_at(states);
        let (rows, rest) = rest[self.amounts..].split_at(path);
        let (elastic, cost) = rest.split_at(rest.len() - self.integrated);
        self.weights[..states].copy_from_slice(rates);
        self.weights[states..states + path].copy_from_slice(rows);
        self.weights[states + path..].copy_from_slice(cost);
        self.weights[states + path] *= self.problem.regularization;
        for (pair, bound) in elastic.chunks_exact(2).zip(&self.problem.path) {
            if let OnPath::Row(i) = bound.quantity {
                self.weights[states + i] += pair[0] + pair[1];
            }
        }
        let x = &point.x[..states];
        self.inner
            .hessian(Point { x, ..point }, &self.weights, &mut self.second);
        hessian.fill(0.0);
        let (from, width) = (self.inputs(), self.inputs() + self.amounts);
        for row in 0..from {
            for column in 0..=row {
                hessian[self.outer(row) * width + self.outer(column)] =
                    self.second[row * from + column];
            }
        }
        for j in 0..self.controls {
            let at = self.outer(self.states + j);
            hessian[at * width + at] += 2.0 * cost[0] * self.problem.control_weight;
        }
    }
}
