//! Derivatives of functions of the base attitude, the system's mass centre and the time.
//!
//! The mass centre moves with the joints, by first and second derivatives in closed form; the
//! function itself is a few operations, swept by hyper-dual numbers. Chained they give all
//! derivatives by the inputs.

use super::linearization::{Linearization, Lower};
use crate::autodiff::{HyperDual, Scalar};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};

/// Attitude parameters, components of the mass centre and the time, at most.
const VARIABLES: usize = 8;

/// A number that carries the derivatives by those.
pub(crate) type Variable = HyperDual<VARIABLES, VARIABLES>;

/// The attitude parameters, the mass centre and the time, each with a direction of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PoseVariables<Sp: Space> {
    eta: [Variable; VARIABLES],
    parameters: usize,
    /// The mass centre in base axes, m.
    pub center: Sp::Linear<Variable>,
    /// Seconds after t₀.
    pub t: Variable,
}

impl<Sp: Space> PoseVariables<Sp> {
    /// Those at a point.
    pub fn at(at: &Linearization<'_, Sp>) -> Self {
        let parameters = at.plant.attitude.count();
        let variable = |value, i| HyperDual::seeded(value, Some(i), Some(i));
        let mut eta = [HyperDual::constant(0.0); VARIABLES];
        for (i, value) in at.point.x[..parameters].iter().enumerate() {
            eta[i] = variable(*value, i);
        }
        let mut center = [HyperDual::constant(0.0); 3];
        for (i, value) in at.data.system_center.components().iter().enumerate() {
            center[i] = variable(*value, parameters + i);
        }
        Self {
            eta,
            parameters,
            center: Sp::Linear::from_components(&center[..Sp::LENGTHS]),
            t: variable(at.point.t, parameters + Sp::LENGTHS),
        }
    }

    /// Attitude parameters.
    pub fn eta(&self) -> &[Variable] {
        &self.eta[..self.parameters]
    }
}

/// Change of the mass centre by joint position `k`, behind the attitude parameters.
fn moved<Sp: Space>(at: &Linearization<'_, Sp>, k: usize) -> Sp::Linear<f64> {
    at.plant.tree.system_center_by(at.data, k)
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Hands each input with the derivative of `value` by it to `each`.
pub(crate) fn each_slope<Sp: Space>(
    at: &Linearization<'_, Sp>,
    value: &Variable,
    mut each: impl FnMut(usize, f64),
) {
    let (by_eta, rest) = value.rows.split_at(at.plant.parameters());
    let (by_center, rest) = rest.split_at(Sp::LENGTHS);
    for (i, by) in by_eta.iter().enumerate() {
        each(i, *by);
    }
    for k in 0..at.joints() {
        each(at.position(k), inner(moved(at, k).components(), by_center));
    }
    each(at.time(), rest[0]);
}

/// Adds the derivatives of `value` by the inputs to `row`.
pub(crate) fn add_gradient<Sp: Space>(
    at: &Linearization<'_, Sp>,
    value: &Variable,
    row: &mut [f64],
) {
    each_slope(at, value, |input, by| row[input] += by);
}

/// Adds `weight` times the second derivatives of `value` by the inputs.
pub(crate) fn add_curvature<Sp: Space>(
    at: &Linearization<'_, Sp>,
    value: &Variable,
    weight: f64,
    hessian: &mut Lower<'_>,
) {
    let parameters = at.plant.parameters();
    let time = parameters + Sp::LENGTHS;
    let center = parameters..time;
    let block = |row: usize| value.block[row].map(|second| weight * second);
    for i in 0..parameters {
        for (j, second) in block(i).iter().enumerate().take(i + 1) {
            hessian.add(i, j, *second);
        }
        hessian.add(at.time(), i, block(time)[i]);
    }
    hessian.add(at.time(), at.time(), block(time)[time]);
    let by_center = &value.rows[center.clone()];
    for k in 0..at.joints() {
        let by_k = moved(at, k);
        let mut bent = [0.0; VARIABLES];
        for (c, component) in center.clone().zip(by_k.components()) {
            for (sum, second) in bent.iter_mut().zip(block(c)) {
                *sum += component * second;
            }
        }
        for (i, second) in bent[..parameters].iter().enumerate() {
            hessian.add(at.position(k), i, *second);
        }
        hessian.add(at.time(), at.position(k), bent[time]);
        for l in 0..=k {
            let both = at.plant.tree.system_center_by_both(at.data, k, l);
            let second = inner(moved(at, l).components(), &bent[center.clone()])
                + weight * inner(both.components(), by_center);
            hessian.add(at.position(k), at.position(l), second);
        }
    }
}
