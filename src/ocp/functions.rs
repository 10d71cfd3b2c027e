//! The functions of an optimal control problem that derivatives are taken of.

use super::{Ends, Formulation, InteriorPoint, Ocp, Point};
use crate::autodiff::{Function, Scalar};

/// One of the functions of a problem, as one vector of inputs to one of outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A collocation point: (x, u, p, t) ↦ (f, C, ℒ, g).
    Point,
    /// Both ends: (x(t₀), x(t_f), p, q, t₀, T) ↦ (E, Φ), q being the integrals.
    Ends,
    /// A way-point, by its index: (x, p, t₀, T) ↦ rows.
    WayPoint(usize),
}

impl Part {
    /// Number of inputs.
    pub fn inputs(self, formulation: &Formulation) -> usize {
        match self {
            Self::Point => PointShape::of(formulation).inputs(),
            Self::Ends => EndsShape::of(formulation).inputs(),
            Self::WayPoint(index) => WayPointShape::of(formulation, index).inputs(),
        }
    }

    /// Number of outputs.
    pub fn outputs(self, formulation: &Formulation) -> usize {
        match self {
            Self::Point => PointShape::of(formulation).outputs(),
            Self::Ends => EndsShape::of(formulation).outputs(),
            Self::WayPoint(index) => WayPointShape::of(formulation, index).outputs(),
        }
    }
}

/// The sizes of a [`Part`], and how its inputs and outputs are those of a problem's function.
pub(crate) trait Shape: Send {
    /// Number of inputs.
    fn inputs(&self) -> usize;

    /// Number of outputs.
    fn outputs(&self) -> usize;

    /// Writes the outputs of `ocp` at the inputs `v` into `out`.
    fn evaluate<O: Ocp, S: Scalar>(
        &self,
        ocp: &O,
        v: &[S],
        scratch: &mut O::Scratch<S>,
        out: &mut [S],
    );
}

/// Sizes of [`Part::Point`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct PointShape {
    pub states: usize,
    pub controls: usize,
    pub parameters: usize,
    pub path: usize,
    pub integrals: usize,
}

impl PointShape {
    pub fn of(formulation: &Formulation) -> Self {
        let (states, controls) = formulation.widths();
        Self {
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

    /// `out` as f, C, ℒ and g.
    pub fn split<'o, S>(&self, out: &'o mut [S]) -> [&'o mut [S]; 4] {
        let (rates, rest) = out.split_at_mut(self.states);
        let (path, rest) = rest.split_at_mut(self.path);
        let (cost, integrands) = rest.split_at_mut(1);
        [rates, path, cost, integrands]
    }
}

impl Shape for PointShape {
    fn inputs(&self) -> usize {
        self.time() + 1
    }

    fn outputs(&self) -> usize {
        self.cost() + 1 + self.integrals
    }

    fn evaluate<O: Ocp, S: Scalar>(
        &self,
        ocp: &O,
        v: &[S],
        scratch: &mut O::Scratch<S>,
        out: &mut [S],
    ) {
        let [rates, path, cost, integrands] = self.split(out);
        let point = self.point(v);
        cost[0] = ocp.continuous(point, scratch, rates, path);
        if !integrands.is_empty() {
            ocp.integrands(point, scratch, integrands);
        }
    }
}

/// Sizes of [`Part::Ends`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct EndsShape {
    states: usize,
    parameters: usize,
    integrals: usize,
    rows: usize,
}

impl EndsShape {
    pub fn of(formulation: &Formulation) -> Self {
        Self {
            states: formulation.states.len(),
            parameters: formulation.parameters.len(),
            integrals: formulation.integrals.len(),
            rows: formulation.boundary.len(),
        }
    }
}

impl Shape for EndsShape {
    fn inputs(&self) -> usize {
        2 * self.states + self.parameters + self.integrals + 2
    }

    fn outputs(&self) -> usize {
        self.rows + 1
    }

    fn evaluate<O: Ocp, S: Scalar>(
        &self,
        ocp: &O,
        v: &[S],
        scratch: &mut O::Scratch<S>,
        out: &mut [S],
    ) {
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
        cost[0] = ocp.boundary(ends, scratch, rows);
    }
}

/// Sizes of [`Part::WayPoint`], and where it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WayPointShape {
    index: usize,
    /// Fraction of the duration.
    fraction: f64,
    pub states: usize,
    parameters: usize,
    rows: usize,
}

impl WayPointShape {
    pub fn of(formulation: &Formulation, index: usize) -> Self {
        let way_point = &formulation.way_points[index];
        Self {
            index,
            fraction: way_point.fraction,
            states: formulation.states.len(),
            parameters: formulation.parameters.len(),
            rows: way_point.rows.len(),
        }
    }
}

impl Shape for WayPointShape {
    fn inputs(&self) -> usize {
        self.states + self.parameters + 2
    }

    fn outputs(&self) -> usize {
        self.rows
    }

    fn evaluate<O: Ocp, S: Scalar>(
        &self,
        ocp: &O,
        v: &[S],
        scratch: &mut O::Scratch<S>,
        out: &mut [S],
    ) {
        let (x, rest) = v.split_at(self.states);
        let (parameters, times) = rest.split_at(self.parameters);
        let point = InteriorPoint {
            way_point: self.index,
            x,
            parameters,
            t: times[0] + times[1] * self.fraction,
        };
        ocp.way_point(point, scratch, out);
    }
}

/// One function of a problem, for derivatives.
pub(super) struct Of<'a, O, P> {
    pub ocp: &'a O,
    pub shape: P,
}

impl<O: Ocp, P: Shape> Function for Of<'_, O, P> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn inputs(&self) -> usize {
        self.shape.inputs()
    }

    fn outputs(&self) -> usize {
        self.shape.outputs()
    }

    fn scratch<S: Scalar>(&self) -> O::Scratch<S> {
        self.ocp.scratch()
    }

    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut O::Scratch<S>, out: &mut [S]) {
        self.shape.evaluate(self.ocp, v, scratch, out);
    }
}
