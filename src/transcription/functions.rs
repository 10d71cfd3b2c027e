//! The functions of an optimal control problem that derivatives are taken of.

use crate::autodiff::{Function, Scalar};
use crate::ocp::{Ends, Formulation, InteriorPoint, Ocp, Point};

/// One collocation point: (x, u, t) ↦ (f, C, ℒ).
#[derive(Debug)]
pub(super) struct Node<'a, O> {
    pub ocp: &'a O,
    pub states: usize,
    pub controls: usize,
    pub path: usize,
}

impl<'a, O: Ocp> Node<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation) -> Self {
        let (states, controls) = formulation.widths();
        Self {
            ocp,
            states,
            controls,
            path: formulation.path.len(),
        }
    }

    /// Position of the time among the inputs.
    pub fn time(&self) -> usize {
        self.states + self.controls
    }

    /// Position of the running cost among the outputs.
    pub fn cost(&self) -> usize {
        self.states + self.path
    }
}

impl<O: Ocp> Function for Node<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        self.states + self.controls + 1
    }

    fn outputs(&self) -> usize {
        self.states + self.path + 1
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let (rates, rest) = out.split_at_mut(self.states);
        let (path, cost) = rest.split_at_mut(self.path);
        let (x, u) = v[..self.time()].split_at(self.states);
        cost[0] = self.ocp.continuous(
            Point {
                x,
                u,
                t: v[self.time()],
            },
            scratch,
            rates,
            path,
        );
    }
}

/// Both ends: (x(t₀), x(t_f), T) ↦ (E, Φ).
#[derive(Debug)]
pub(super) struct Boundary<'a, O> {
    pub ocp: &'a O,
    pub states: usize,
    pub rows: usize,
}

impl<'a, O: Ocp> Boundary<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation) -> Self {
        Self {
            ocp,
            states: formulation.states.len(),
            rows: formulation.boundary.len(),
        }
    }
}

impl<O: Ocp> Function for Boundary<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        2 * self.states + 1
    }

    fn outputs(&self) -> usize {
        self.rows + 1
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let (rows, cost) = out.split_at_mut(self.rows);
        let (ends, duration) = v.split_at(2 * self.states);
        let (initial, terminal) = ends.split_at(self.states);
        cost[0] = self.ocp.boundary(
            Ends {
                initial,
                terminal,
                duration: duration[0],
            },
            scratch,
            rows,
        );
    }
}

/// One way-point: (x, T) ↦ rows.
#[derive(Debug)]
pub(super) struct WayPoint<'a, O> {
    pub ocp: &'a O,
    /// Which one.
    pub index: usize,
    /// Fraction of the duration.
    pub fraction: f64,
    pub states: usize,
    pub rows: usize,
}

impl<'a, O: Ocp> WayPoint<'a, O> {
    pub fn new(ocp: &'a O, formulation: &Formulation, index: usize) -> Self {
        Self {
            ocp,
            index,
            fraction: formulation.way_points[index].fraction,
            states: formulation.states.len(),
            rows: formulation.way_points[index].rows.len(),
        }
    }
}

impl<O: Ocp> Function for WayPoint<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        self.states + 1
    }

    fn outputs(&self) -> usize {
        self.rows
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        let point = InteriorPoint {
            way_point: self.index,
            x: &v[..self.states],
            t: v[self.states] * self.fraction,
        };
        self.ocp.way_point(point, scratch, out);
    }
}
