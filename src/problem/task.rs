//! What is to be done.

use super::components::base_sizes;
use super::goal::EndEffectorGoal;
use super::momentum::Momentum;
use super::way_point::WayPoint;
use crate::dynamics::Model;
use crate::ocp::Interval;

/// What is to be done.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Task {
    /// Duration t_f, s; fixed where both ends are equal.
    pub duration: Interval,
    /// Joint positions at t₀, rad or m; length n.
    pub initial_joints: Vec<f64>,
    /// Joint rates at t₀, rad/s or m/s; length n.
    pub initial_rates: Vec<f64>,
    /// Orientation of the base at t₀ in the inertial axes from which the base attitude is counted,
    /// whatever describes it: the angle in the plane, else roll, pitch, yaw, rad. Zero in the
    /// paper; anything else where a motion is planned again on its way.
    pub initial_base_attitude: Vec<f64>,
    /// Momentum of the whole system; zero in the paper.
    pub initial_momentum: Momentum,
    /// Joint positions at t_f, rad or m; length n. The arm comes to rest there, eq. (13).
    pub final_joints: Vec<f64>,
    /// Joints whose position at t_f is for the planner to find, length n; `final_joints` is then
    /// where the search begins. Only with an end-effector goal.
    pub free_joints: Vec<bool>,
    /// Where the end effector is to be at t_f.
    pub end_effector: Option<EndEffectorGoal>,
    /// Where the arm is to be on its way, in the order of time.
    pub way_points: Vec<WayPoint>,
}

impl Task {
    /// From rest at the joint positions `initial` to rest at `goal` (rad or m, length n each) in
    /// `duration` seconds, without momentum.
    pub fn rest_to_rest(robot: &Model, duration: f64, initial: &[f64], goal: &[f64]) -> Self {
        let n = robot.joint_count();
        let (angles, lengths) = base_sizes(robot);
        Self {
            duration: Interval::fixed(duration),
            initial_joints: initial.into(),
            initial_rates: vec![0.0; n],
            initial_base_attitude: vec![0.0; angles],
            initial_momentum: Momentum::zero(angles, lengths),
            final_joints: goal.into(),
            free_joints: vec![false; n],
            end_effector: None,
            way_points: Vec::new(),
        }
    }

    /// Whether the base starts turned out of the inertial axes.
    pub fn starts_turned(&self) -> bool {
        self.initial_base_attitude.iter().any(|angle| *angle != 0.0)
    }
}
