//! A planning problem: robot, task, limits, cost and mesh, eq. (7) to (18).

mod goal;
mod keep_out;
mod limit_id;
mod momentum;
mod unit;
mod validation;
mod way_point;

pub use goal::{EndEffectorGoal, GoalFrame};
pub use keep_out::{KeepOut, Obstacle, Sphere};
pub use limit_id::LimitId;
pub use momentum::Momentum;
pub use unit::Unit;
pub use way_point::{Moment, WayPoint};

use validation::{count, error, indexed};

use crate::dynamics::Model;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::space::{Planar, Space, Spatial};
use crate::nlp;
use crate::ocp::Interval;
use crate::refine;

/// What is to be done.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// Duration t_f, s; fixed where both ends are equal.
    pub duration: Interval,
    /// Joint positions at t₀, rad or m; length n.
    pub initial_joints: Vec<f64>,
    /// Joint rates at t₀, rad/s or m/s; length n.
    pub initial_rates: Vec<f64>,
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

/// Limits (8) to (11). Free intervals where there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Joint positions, rad or m; length n, eq. (8).
    pub joint_position: Vec<Interval>,
    /// Joint rates, rad/s or m/s; length n, eq. (9).
    pub joint_velocity: Vec<Interval>,
    /// Controls u = H⁻¹τ, rad/s² or m/s²; length n, eq. (11).
    pub control: Vec<Interval>,
    /// Joint torques, N·m or N; length n.
    pub torque: Vec<Interval>,
    /// Base attitude along the path, rad, eq. (10): one an angle; by quaternion or modified
    /// Rodrigues parameters one for the rotation angle from the start, symmetric.
    pub base_attitude: Vec<Interval>,
    /// Rates of the base attitude angles, rad/s, one an angle, eq. (10); by quaternion or modified
    /// Rodrigues parameters the angular velocity along each base axis.
    pub base_rate: Vec<Interval>,
    /// Base attitude at t_f, rad, as along the path.
    pub final_base_attitude: Vec<Interval>,
    /// Pairs kept apart along the path.
    pub keep_out: Vec<KeepOut>,
}

/// Weights of the cost functional (14).
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// ‖η(t_f)‖², one weight an angle; by quaternion or modified Rodrigues parameters one weight, of
    /// the squared rotation angle from the start.
    pub final_base_attitude: Vec<f64>,
    /// ‖ζ(t_f) − ζ(t₀)‖², one weight a length.
    pub final_base_position: Vec<f64>,
    /// ∫‖η̇‖² dt, one weight an angle; by quaternion or modified Rodrigues parameters ∫‖ω‖² dt, one
    /// a base axis.
    pub base_rate: Vec<f64>,
    /// ∫‖θ̇‖² dt, one weight a joint.
    pub joint_rate: Vec<f64>,
    /// ∫‖u‖² dt, one weight a joint.
    pub control: Vec<f64>,
    /// ∫‖τ‖² dt, one weight a joint.
    pub torque: Vec<f64>,
    /// The duration t_f itself, where it is free; 1/s.
    pub duration: f64,
    /// Λ of (14) as a full matrix over [η̇, θ̇], by rows, added to the weights above; symmetric.
    pub rate_matrix: Option<Vec<Vec<f64>>>,
}

/// A planning problem. Built by [`Problem::new`] and its public fields, or read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Name, used for the output folder.
    pub name: String,
    /// The robot on its base.
    pub robot: Model,
    /// How the base attitude is described in space; in the plane it is one angle.
    pub attitude: SpatialAttitude,
    /// What is to be done.
    pub task: Task,
    /// Limits.
    pub limits: Limits,
    /// Weights of the cost.
    pub cost: Cost,
    /// Method, first mesh, tolerance and refinement.
    pub mesh: refine::Settings,
    /// The solver below.
    pub solver: nlp::Settings,
}

/// A problem that cannot be: which key, what it holds and what was expected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {found}; expected {expected}")]
pub struct ProblemError {
    /// Key path as in the problem file (`limits.joint_velocity[1]`).
    pub key: String,
    /// What stands there.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

impl Problem {
    /// Components of the base's angular velocity and of its position for `robot`: 1 and 2 in the
    /// plane, 3 and 3 in space.
    pub fn base_sizes(robot: &Model) -> (usize, usize) {
        if robot.plane().is_some() {
            (Planar::ANGLES, Planar::LENGTHS)
        } else {
            (Spatial::ANGLES, Spatial::LENGTHS)
        }
    }

    /// How many parameters describe the base attitude, each a state, and how many bounds and
    /// weights there are on it: one an angle, or one on the rotation angle.
    pub fn attitude_sizes(&self) -> (usize, usize) {
        match (self.robot.plane(), self.attitude.is_angles()) {
            (Some(_), _) => (1, 1),
            (None, true) => (3, 3),
            (None, false) => (self.attitude.count(), 1),
        }
    }

    /// Describes the base attitude in space by `attitude`.
    ///
    /// Limits and weights on attitude and rate mean something else then: they are set to none.
    pub fn set_attitude(&mut self, attitude: SpatialAttitude) {
        self.attitude = attitude;
        let (turns, rates) = (self.attitude_sizes().1, Self::base_sizes(&self.robot).0);
        self.limits.base_attitude = vec![Interval::FREE; turns];
        self.limits.final_base_attitude = vec![Interval::FREE; turns];
        self.limits.base_rate = vec![Interval::FREE; rates];
        self.cost.final_base_attitude = vec![0.0; turns];
        self.cost.base_rate = vec![0.0; rates];
    }

    /// A rest-to-rest task of `duration` seconds from `initial` to `goal` joint positions.
    ///
    /// Limits are the robot's own, all weights zero, the mesh and the solver at their defaults.
    pub fn new(name: &str, robot: Model, duration: f64, initial: &[f64], goal: &[f64]) -> Self {
        let n = robot.joint_count();
        let (angles, lengths) = Self::base_sizes(&robot);
        let joints = robot.joints();
        let free = |count: usize| vec![Interval::FREE; count];
        Self {
            name: name.into(),
            task: Task {
                duration: Interval::fixed(duration),
                initial_joints: initial.into(),
                initial_rates: vec![0.0; n],
                initial_momentum: Momentum::zero(angles, lengths),
                final_joints: goal.into(),
                free_joints: vec![false; n],
                end_effector: None,
                way_points: Vec::new(),
            },
            limits: Limits {
                joint_position: joints
                    .iter()
                    .map(|j| Interval::new(j.limits.position[0], j.limits.position[1]))
                    .collect(),
                joint_velocity: joints
                    .iter()
                    .map(|j| Interval::symmetric(j.limits.velocity))
                    .collect(),
                control: free(n),
                torque: joints
                    .iter()
                    .map(|j| Interval::symmetric(j.limits.effort))
                    .collect(),
                base_attitude: free(angles),
                base_rate: free(angles),
                final_base_attitude: free(angles),
                keep_out: Vec::new(),
            },
            cost: Cost {
                final_base_attitude: vec![0.0; angles],
                final_base_position: vec![0.0; lengths],
                base_rate: vec![0.0; angles],
                joint_rate: vec![0.0; n],
                control: vec![0.0; n],
                torque: vec![0.0; n],
                duration: 0.0,
                rate_matrix: None,
            },
            mesh: refine::Settings::default(),
            solver: nlp::Settings::default(),
            attitude: SpatialAttitude::default(),
            robot,
        }
    }
}
