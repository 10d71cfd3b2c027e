//! Derivatives of a problem with elastic limits from those of the problem inside.

use super::limits::{Elastic, OnPath};
use crate::ocp::{Ocp, Point, PointDerivatives};

pub(super) struct ElasticDerivatives<'a, O> {
    problem: &'a Elastic<'a, O>,
    inner: Box<dyn PointDerivatives + 'a>,
    /// States, controls, own path rows, static parameters of the problem inside and amounts.
    states: usize,
    controls: usize,
    path: usize,
    parameters: usize,
    amounts: usize,
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
        let parameters = problem.base.parameters.len();
        let integrated = problem.base.integrals.len() + 1;
        let inputs = states + controls + parameters + 1;
        let outputs = states + path + integrated;
        Self {
            problem,
            inner,
            states,
            controls,
            path,
            parameters,
            amounts: problem.groups.len(),
            integrated,
            weights: vec![0.0; outputs],
            first: vec![0.0; outputs * inputs],
            second: vec![0.0; inputs * inputs],
        }
    }

    /// Inputs of the problem inside before the time.
    fn own(&self) -> usize {
        self.states + self.controls + self.parameters
    }

    /// Where an input of the problem inside stands here: the amounts come before the time.
    fn outer(&self, input: usize) -> usize {
        if input < self.own() {
            input
        } else {
            input + self.amounts
        }
    }

    /// `point` as the problem inside sees it.
    fn inner<'p>(&self, point: Point<'p, f64>) -> Point<'p, f64> {
        Point {
            parameters: &point.parameters[..self.parameters],
            ..point
        }
    }
}

impl<O: Ocp> PointDerivatives for ElasticDerivatives<'_, O> {
    fn kept(&self) -> usize {
        self.inner.kept()
    }

    fn keep(&mut self, kept: &mut [f64]) {
        self.inner.keep(kept);
    }

    fn recall(&mut self, kept: &[f64]) {
        self.inner.recall(kept);
    }

    fn jacobian(&mut self, point: Point<'_, f64>, jacobian: &mut [f64]) {
        self.inner.jacobian(self.inner(point), &mut self.first);
        jacobian.fill(0.0);
        let (from, width) = (self.own() + 1, self.own() + 1 + self.amounts);
        let last = self.states + self.path;
        let elastic = 2 * self.problem.path.len();
        for row in 0..last + self.integrated {
            let (to, factor) = match row {
                _ if row < last => (row, 1.0),
                _ if row == last => (row + elastic, self.problem.regularization),
                _ => (row + elastic, 1.0),
            };
            for input in 0..from {
                jacobian[to * width + self.outer(input)] = factor * self.first[row * from + input];
            }
        }
        let cost = (last + elastic) * width;
        for (j, u) in point.u.iter().enumerate() {
            jacobian[cost + self.states + j] += 2.0 * self.problem.control_weight * u;
        }
        for (k, bound) in self.problem.path.iter().enumerate() {
            let scale = self.problem.groups[bound.group].scale;
            for (row, sign) in [(last + 2 * k, -1.0), (last + 2 * k + 1, 1.0)] {
                let to = &mut jacobian[row * width..(row + 1) * width];
                match bound.quantity {
                    OnPath::State(i) => to[i] = 1.0,
                    OnPath::Control(i) => to[self.states + i] = 1.0,
                    OnPath::Row(i) => {
                        for input in 0..from {
                            to[self.outer(input)] = self.first[(self.states + i) * from + input];
                        }
                    }
                }
                to[self.own() + bound.group] = sign * scale;
            }
        }
    }

    fn hessian(&mut self, point: Point<'_, f64>, weights: &[f64], hessian: &mut [f64]) {
        let (states, path) = (self.states, self.path);
        let (rates, rest) = weights.split_at(states);
        let (rows, rest) = rest.split_at(path);
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
        let inner = self.inner(point);
        self.inner.hessian(inner, &self.weights, &mut self.second);
        hessian.fill(0.0);
        let (from, width) = (self.own() + 1, self.own() + 1 + self.amounts);
        for row in 0..from {
            for column in 0..=row {
                hessian[self.outer(row) * width + self.outer(column)] =
                    self.second[row * from + column];
            }
        }
        for j in 0..self.controls {
            let at = self.states + j;
            hessian[at * width + at] += 2.0 * cost[0] * self.problem.control_weight;
        }
    }
}
