//! The functions of an optimal control problem that derivatives are taken of.

use crate::autodiff::{Function, Scalar};
use crate::ocp::{Ends, Formulation, InteriorPoint, Ocp, Point};

/// One collocation point: (x, u, p, t) ↦ (f, C, ℒ, g).
#[derive(Debug)]
pub(super) struct Node<'a, O> {
    pub ocp: &'a O,
    pub states: usize,
    pub controls: usize,
    pub parameters: usize,
    pub path: usize,
    pub integrals: usize,
}

impl<'a, O: Ocp> Node<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation) -> Self {
        let (states, controls) = formulation.widths();
        Self {
            ocp,
            states,
            controls,
            parameters: formulation.parameters.len(),
            path: formulation.path.len(),
            integrals: formulation.integrals.len(),
        }
    }

    /// Number of inputs that each point has of its own: states and controls.
    pub fn own(&self) -> usize {
        self.states + self.controls
    }

    /// Position of the time among the inputs.
    pub fn time(&self) -> usize {
        self.own() + self.parameters
    }

    /// Position of the running cost among the outputs.
    pub fn cost(&self) -> usize {
        self.states + self.path
    }

    /// The point that the inputs `v` describe.
    pub fn point<'v, S: Scalar>(&self, v: &'v [S]) -> Point<'v, S> {
        let (x, rest) = v.split_at(self.states);
        let (u, rest) = rest.split_at(self.controls);
        let (parameters, time) = rest.split_at(self.parameters);
        Point {
            x,
            u,
            parameters,
            t: time[0],
        }
    }
}

impl<O: Ocp> Function for Node<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        self.time() + 1
    }

    fn outputs(&self) -> usize {
        self.cost() + 1 + self.integrals
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let (rates, rest) = out.split_at_mut(self.states);
        let (path, rest) = rest.split_at_mut(self.path);
        let (cost, integrands) = rest.split_at_mut(1);
        let point = self.point(v);
        cost[0] = self.ocp.continuous(point, scratch, rates, path);
        if self.integrals > 0 {
            self.ocp.integrands(point, scratch, integrands);
        }
    }
}

/// Both ends: (x(t₀), x(t_f), p, q, t₀, T) ↦ (E, Φ), q being the integrals.
#[derive(Debug)]
pub(super) struct Boundary<'a, O> {
    pub ocp: &'a O,
    pub states: usize,
    pub parameters: usize,
    pub integrals: usize,
    pub rows: usize,
}

impl<'a, O: Ocp> Boundary<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation) -> Self {
        Self {
            ocp,
            states: formulation.states.len(),
            parameters: formulation.parameters.len(),
            integrals: formulation.integrals.len(),
            rows: formulation.boundary.len(),
        }
    }
}

impl<O: Ocp> Function for Boundary<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        2 * self.states + self.parameters + self.integrals + 2
    }

    fn outputs(&self) -> usize {
        self.rows + 1
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let (rows, cost) = out.split_at_mut(self.rows);
        let (initial, rest) = v.split_at(self.states);
        let (terminal, rest) = rest.split_at(self.states);
        let (parameters, rest) = rest.split_at(self.parameters);
        let (integrals, times) = rest.split_at(self.integrals);
        let ends = Ends {
            initial,
            terminal,
            parameters,
            integrals,
            initial_time: times[0],
            duration: times[1],
        };
        cost[0] = self.ocp.boundary(ends, scratch, rows);
    }
}

/// One way-point: (x, p, t₀, T) ↦ rows.
#[derive(Debug)]
pub(super) struct WayPoint<'a, O> {
    pub ocp: &'a O,
    /// Which one.
    pub index: usize,
    /// Fraction of the duration.
    pub fraction: f64,
    pub states: usize,
    pub parameters: usize,
    pub rows: usize,
}

impl<'a, O: Ocp> WayPoint<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation, index: usize) -> Self {
        Self {
            ocp,
            index,
            fraction: formulation.way_points[index].fraction,
            states: formulation.states.len(),
            parameters: formulation.parameters.len(),
            rows: formulation.way_points[index].rows.len(),
        }
    }
}

impl<O: Ocp> Function for WayPoint<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        self.states + self.parameters + 2
    }

    fn outputs(&self) -> usize {
        self.rows
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let (x, rest) = v.split_at(self.states);
        let (parameters, times) = rest.split_at(self.parameters);
        let point = InteriorPoint {
            way_point: self.index,
            x,
            parameters,
            t: times[0] + times[1] * self.fraction,
        };
        self.ocp.way_point(point, scratch, out);
    }
}
