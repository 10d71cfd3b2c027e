//! Rows that hold a quantity of the base below a static parameter, which is then its largest value
//! along the path: `cost.peak_base_attitude`, `cost.peak_base_position`, `cost.peak_base_rate`.
//!
//! Derived in docs/algorithms.md#peaks.

use super::{BoundId, Component, EndRows, Measure, PathRows, Row};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Interval, Quantity};
use crate::problem::{CostId, LimitId, Problem, Unit};
use crate::system::instant::{Instant, Needs, Pose};
use crate::system::linearization::{Adjoint, Linearization, Lower};
use crate::system::plant::Plant;
use crate::system::pose_function::{PoseVariables, Variable, add_curvature, each_slope};
use std::slice;

/// What is largest somewhere along the path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PeakOf {
    /// The base angle: that of the rotation out of the axes that the attitude is counted from.
    Attitude,
    /// The distance of the base from where it was at t₀.
    Position,
    /// The length of the base's rates that limits are about.
    Rate,
}

impl PeakOf {
    const ALL: [Self; 3] = [Self::Attitude, Self::Position, Self::Rate];

    fn weight(self, problem: &Problem) -> f64 {
        let cost = &problem.cost;
        match self {
            Self::Attitude => cost.peak_base_attitude[0],
            Self::Position => cost.peak_base_position[0],
            Self::Rate => cost.peak_base_rate[0],
        }
    }

    fn cost(self) -> CostId {
        match self {
            Self::Attitude => CostId::PeakBaseAttitude,
            Self::Position => CostId::PeakBasePosition,
            Self::Rate => CostId::PeakBaseRate,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Attitude => "base angle",
            Self::Position => "base displacement",
            Self::Rate => "base rate",
        }
    }

    /// The least peak that is told from none, rad, m or rad/s: below it the row's derivatives, which are as
    /// large as its inverse, are out of all proportion.
    fn least(self) -> f64 {
        match self {
            Self::Attitude | Self::Position => 1e-4,
            Self::Rate => 1e-5,
        }
    }

    fn unit(self) -> Unit {
        match self {
            Self::Attitude => Unit::Radian,
            Self::Position => Unit::Metre,
            Self::Rate => Unit::RadianPerSecond,
        }
    }
}

/// A quantity v of the base held below its peak p, as the row (v/p)² ≤ 1: v itself is not smooth at
/// zero.
#[derive(Debug, Clone)]
pub(crate) struct PeakRow {
    of: PeakOf,
    /// Which of the static parameters p is.
    parameter: usize,
    weight: f64,
    row: Row,
}

impl PeakRow {
    /// The rows of `problem`, one a peak that has a weight, in the order of the static parameters.
    pub fn all(problem: &Problem) -> Vec<Self> {
        let weighted = PeakOf::ALL
            .into_iter()
            .filter(|of| of.weight(problem) > 0.0);
        let row = |(parameter, of): (usize, PeakOf)| {
            let id = BoundId::new(LimitId::Peak(of.cost()), Component::Peak);
            let bounds = Interval::new(f64::NEG_INFINITY, 1.0);
            Self {
                of,
                parameter,
                weight: of.weight(problem),
                row: Row {
                    measure: Measure::SquaredRatioToParameter { parameter },
                    // Of the squares: twice the relative excess, to first order.
                    ..Row::new(id, of.unit(), of.name(), bounds).sized(2.0)
                },
            }
        };
        weighted.enumerate().map(row).collect()
    }

    /// Which term of the cost the peak is.
    pub fn cost(&self) -> CostId {
        self.of.cost()
    }

    /// Which of the static parameters the peak is, and its weight.
    pub fn weighted_parameter(&self) -> (usize, f64) {
        (self.parameter, self.weight)
    }

    /// The static parameter that the peak is.
    pub fn quantity(&self) -> Quantity {
        let name = format!("largest {}", self.of.name());
        Quantity {
            scale: self.row.quantity.scale,
            ..Quantity::new(name, Interval::new(self.least(), f64::INFINITY))
        }
    }

    /// The least that the static parameter can be.
    pub fn least(&self) -> f64 {
        self.of.least()
    }

    /// Whether it holds at t_f by a row of the end; the arm rests there, and so does the base but
    /// for momentum that it cannot change.
    pub fn reaches_the_end(&self) -> bool {
        self.of != PeakOf::Rate
    }

    /// The square of the quantity along the path.
    pub fn square<Sp: Space, S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        match self.of {
            PeakOf::Rate => sum_of_squares(at.base_rate),
            _ => self.square_at(&at.pose),
        }
    }

    /// The same where all is at rest.
    pub fn square_at<Sp: Space, S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        match self.of {
            PeakOf::Attitude => at.plant.attitude.squared_rotation_angle(at.eta),
            PeakOf::Position => {
                let center = &at.data.system_center;
                displacement(at.plant, at.eta, at.t, center)
            }
            PeakOf::Rate => S::zero(),
        }
    }

    /// Hands each input with the derivative of the square by it to `each`.
    fn each_slope<Sp: Space>(&self, at: &Linearization<'_, Sp>, mut each: impl FnMut(usize, f64)) {
        match self.of {
            PeakOf::Attitude => {
                for (i, by) in at
                    .squared_rotation_by()
                    .iter()
                    .take(at.states())
                    .enumerate()
                {
                    each(i, *by);
                }
            }
            PeakOf::Position => each_slope(at, &displaced(at), each),
            PeakOf::Rate => {
                for k in 0..Sp::ANGLES {
                    let slope = 2.0 * at.rates[k];
                    for (i, by) in at.base_rate_by(k).iter().enumerate() {
                        each(i, slope * by);
                    }
                }
            }
        }
    }

    fn square_in<Sp: Space>(&self, at: &Linearization<'_, Sp>) -> f64 {
        match self.of {
            PeakOf::Attitude => {
                let eta = &at.point.x[..at.plant.parameters()];
                at.plant.attitude.squared_rotation_angle::<f64>(eta)
            }
            PeakOf::Position => displaced(at).value,
            PeakOf::Rate => sum_of_squares(&at.rates[..Sp::ANGLES]),
        }
    }

    /// p.
    fn peak(&self, parameters: &[f64]) -> f64 {
        parameters[self.parameter]
    }
}

impl<Sp: Space> PathRows<Sp> for PeakRow {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn needs(&self) -> Needs {
        Needs {
            rotation: self.of == PeakOf::Attitude,
            ..Needs::default()
        }
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        rows[0] = self.square(at) / at.pose.parameters[self.parameter].square();
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        let p = self.peak(at.point.parameters);
        let factor = p.powi(-2);
        self.each_slope(at, |input, by| rows[input] += factor * by);
        rows[at.parameter(self.parameter)] -= 2.0 * factor / p * self.square_in(at);
    }

    fn weigh(&self, at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        let weight = weights[0] / self.peak(at.point.parameters).powi(2);
        match self.of {
            PeakOf::Attitude => adjoint.squared_rotation[0] += weight,
            PeakOf::Position => {}
            PeakOf::Rate => {
                for (to, rate) in adjoint.base_rate.iter_mut().zip(at.rates) {
                    *to += 2.0 * weight * rate;
                }
            }
        }
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weights: &[f64], hessian: &mut Lower<'_>) {
        let p = self.peak(at.point.parameters);
        let weight = weights[0] / (p * p);
        let own = at.parameter(self.parameter);
        self.each_slope(at, |input, by| {
            hessian.add_pair(own, input, -2.0 * weight / p * by);
        });
        hessian.add(own, own, 6.0 * weight / (p * p) * self.square_in(at));
        match self.of {
            PeakOf::Attitude => {}
            PeakOf::Position => add_curvature(at, &displaced(at), weight, hessian),
            PeakOf::Rate => {
                for k in 0..Sp::ANGLES {
                    let slopes = at.base_rate_by(k);
                    for (row, a) in slopes.iter().enumerate() {
                        for (to, b) in hessian.row(row).iter_mut().zip(slopes) {
                            *to += 2.0 * weight * a * b;
                        }
                    }
                }
            }
        }
    }
}

impl<Sp: Space> EndRows<Sp> for PeakRow {
    fn rows(&self) -> &[Row] {
        slice::from_ref(&self.row)
    }

    fn needs(&self) -> Needs {
        Needs {
            end_pose: self.of == PeakOf::Position,
            ..Needs::default()
        }
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        rows[0] = self.square_at(at) / at.parameters[self.parameter].square();
    }
}

fn sum_of_squares<S: Scalar>(values: &[S]) -> S {
    let mut sum = S::zero();
    for value in values {
        sum += value.square();
    }
    sum
}

/// ‖ζ − ζ(t₀)‖².
fn displacement<Sp: Space, S: Scalar>(
    plant: &Plant<Sp>,
    eta: &[S],
    t: S,
    center: &Sp::Linear<S>,
) -> S {
    sum_of_squares(plant.base_displacement(eta, t, center).components())
}

/// ‖ζ − ζ(t₀)‖² with its derivatives.
fn displaced<Sp: Space>(at: &Linearization<'_, Sp>) -> Variable {
    let variables = PoseVariables::at(at);
    displacement(at.plant, variables.eta(), variables.t, &variables.center)
}
