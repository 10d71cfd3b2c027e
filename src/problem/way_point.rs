//! Way-points of the task: where the arm is to be on its way.

use super::goal::EndEffectorGoal;
use crate::ocp::Interval;

/// When a way-point is passed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Moment {
    /// Seconds after t₀; only where the duration is fixed.
    Time(f64),
    /// Fraction of the duration.
    Fraction(f64),
}

/// What has to hold at one moment between the ends.
#[derive(Debug, Clone, PartialEq)]
pub struct WayPoint {
    /// When.
    pub at: Moment,
    /// Joint positions, rad or m, of the joints that have one there; length n.
    pub joints: Vec<Option<f64>>,
    /// Joint rates, rad/s or m/s, of the joints that have one there; length n.
    pub joint_rates: Vec<Option<f64>>,
    /// Where the end effector is to be; the base frame is the one at that moment.
    pub end_effector: Option<EndEffectorGoal>,
    /// Positions of the other joints at which the search begins.
    pub guess: Option<Vec<f64>>,
}

impl WayPoint {
    /// Passes `joints` at `at`, at whatever rates.
    pub fn joints(at: Moment, joints: &[f64]) -> Self {
        Self {
            at,
            joints: joints.iter().copied().map(Some).collect(),
            joint_rates: vec![None; joints.len()],
            end_effector: None,
            guess: None,
        }
    }

    /// Meets `goal` at `at`, for a robot with `joints` joints.
    pub fn pose(at: Moment, joints: usize, goal: EndEffectorGoal) -> Self {
        Self {
            at,
            joints: vec![None; joints],
            joint_rates: vec![None; joints],
            end_effector: Some(goal),
            guess: None,
        }
    }

    /// Fraction of `duration`, whose bounds are equal where the moment is a time.
    pub fn fraction(&self, duration: &Interval) -> f64 {
        match self.at {
            Moment::Time(time) => time / duration.upper,
            Moment::Fraction(fraction) => fraction,
        }
    }
}
