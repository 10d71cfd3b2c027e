//! Joint paths along which the base does not turn, by arc length.

use super::coupling::{Coupling, dot, scale_to_unit};
use crate::autodiff::{Dual, Scalar};
use crate::dynamics::space::Space;
use crate::dynamics::{Data, Tree};
use crate::integrate::Rk4;

/// Which way a path goes at every posture.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Heading {
    /// Towards these joint positions, as directly as the null space allows.
    Goal(Vec<f64>),
    /// On along the only line there is, on the side of this direction.
    Line(Vec<f64>),
}

/// Unit joint directions in the null space of the coupling, as a function of the posture.
#[derive(Debug, Clone)]
pub(super) struct Field<'a, Sp: Space> {
    pub tree: &'a Tree<Sp>,
    pub heading: Heading,
    /// Joints that are held, at a limit.
    pub locked: Vec<bool>,
}

impl<Sp: Space> Field<'_, Sp> {
    /// The direction before it is scaled to unit length.
    pub fn pull<S: Scalar>(&self, q: &[S], data: &mut Data<Sp, S>) -> Vec<S> {
        let mut pull: Vec<S> = match &self.heading {
            Heading::Goal(goal) => (q.iter().zip(goal)).map(|(&q, &g)| -(q - g)).collect(),
            Heading::Line(side) => side.iter().map(|&v| S::constant(v)).collect(),
        };
        for (value, _) in pull.iter_mut().zip(&self.locked).filter(|(_, l)| **l) {
            *value = S::zero();
        }
        Coupling::at(self.tree, q, &self.locked, data).remove(&mut pull);
        pull
    }

    /// dθ/ds, of unit length.
    pub fn tangent<S: Scalar>(&self, q: &[S], data: &mut Data<Sp, S>) -> Vec<S> {
        let mut tangent = self.pull(q, data);
        scale_to_unit(&mut tangent);
        tangent
    }

    /// dθ/ds and d²θ/ds².
    pub fn curvature(&self, q: &[f64], data: &mut Data<Sp, Dual<1>>) -> (Vec<f64>, Vec<f64>) {
        let constant: Vec<Dual<1>> = q.iter().map(|&q| Dual::constant(q)).collect();
        let tangent = self.tangent(&constant, data);
        let moving: Vec<Dual<1>> = (q.iter().zip(&tangent))
            .map(|(&value, t)| Dual {
                value,
                gradient: [t.value],
            })
            .collect();
        let along = self.tangent(&moving, data);
        (
            along.iter().map(|t| t.value).collect(),
            along.iter().map(|t| t.gradient[0]).collect(),
        )
    }

    /// One step of the classical Runge-Kutta method, `h` of arc length from `q`.
    pub fn step(&self, q: &[f64], h: f64, data: &mut Data<Sp, f64>) -> Vec<f64> {
        let mut next = q.to_vec();
        let tangent = |_: f64, q: &[f64], slope: &mut [f64]| {
            slope.copy_from_slice(&self.tangent(q, data));
        };
        Rk4::new(q.len()).step(tangent, 0.0, h, &mut next);
        next
    }

    /// Same field, its line continued on the side of `direction`.
    pub fn towards(&self, direction: &[f64]) -> Self {
        let heading = match &self.heading {
            Heading::Goal(goal) => Heading::Goal(goal.clone()),
            Heading::Line(_) => Heading::Line(direction.to_vec()),
        };
        Self {
            heading,
            ..self.clone()
        }
    }
}

/// A posture on a path: arc length from the start of its leg, joint positions, and the direction
/// in which the path goes on.
#[derive(Debug, Clone)]
pub(super) struct PathPoint {
    pub s: f64,
    pub q: Vec<f64>,
    pub tangent: Vec<f64>,
}

/// A smooth part of a path.
#[derive(Debug, Clone)]
pub(super) struct Leg<'a, Sp: Space> {
    pub field: Field<'a, Sp>,
    /// At least one.
    pub marks: Vec<PathPoint>,
    /// Arc length, rad.
    pub length: f64,
}

impl<'a, Sp: Space> Leg<'a, Sp> {
    pub fn new(field: Field<'a, Sp>, q: Vec<f64>, data: &mut Data<Sp, f64>) -> Self {
        let tangent = field.tangent(&q, data);
        Self {
            field,
            marks: vec![PathPoint { s: 0.0, q, tangent }],
            length: 0.0,
        }
    }

    pub fn last(&self) -> &PathPoint {
        &self.marks[self.marks.len() - 1]
    }

    /// The posture `h` of arc length beyond the last mark.
    pub fn ahead(&self, h: f64, data: &mut Data<Sp, f64>) -> PathPoint {
        let last = self.last();
        let field = self.field.towards(&last.tangent);
        let q = field.step(&last.q, h, data);
        let tangent = field.tangent(&q, data);
        PathPoint {
            s: last.s + h,
            q,
            tangent,
        }
    }

    pub fn push(&mut self, mark: PathPoint) {
        self.length = mark.s;
        self.marks.push(mark);
    }

    /// Positions at `s` of arc length, with the field that continues from there.
    pub fn at(&self, s: f64, data: &mut Data<Sp, f64>) -> (Vec<f64>, Field<'a, Sp>) {
        let k = self.marks.partition_point(|mark| mark.s <= s).max(1) - 1;
        let mark = &self.marks[k];
        let field = self.field.towards(&mark.tangent);
        let h = s - mark.s;
        let q = if h == 0.0 {
            mark.q.clone()
        } else {
            field.step(&mark.q, h, data)
        };
        (q, field)
    }
}

/// Distance between joint positions, rad.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    dot(&difference, &difference).sqrt()
}
