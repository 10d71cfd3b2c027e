//! A problem in the making.

use super::components::{ComponentKind, base_sizes};
use super::cost::Cost;
use super::limits::Limits;
use super::task::Task;
use crate::dynamics::Model;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::nlp;
use crate::ocp::Interval;
use crate::refine;

/// A problem in the making: all of it may be changed, and [`build`](Self::build) checks it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ProblemBuilder {
    /// Name, used for the output folder.
    pub name: String,
    /// The robot on its base.
    pub robot: Model,
    /// How the base attitude is described in space; in the plane it is one angle. Changed by
    /// [`set_attitude`](Self::set_attitude).
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

impl ProblemBuilder {
    /// A rest-to-rest task of `duration` seconds from `initial` to `goal` joint positions.
    ///
    /// Limits are the robot's own, all weights zero, the mesh and the solver at their defaults.
    pub fn new(name: &str, robot: Model, duration: f64, initial: &[f64], goal: &[f64]) -> Self {
        let task = Task::rest_to_rest(&robot, duration, initial, goal);
        Self::of_task(name, robot, task)
    }

    /// Any task, with the same defaults.
    pub fn of_task(name: &str, robot: Model, task: Task) -> Self {
        Self {
            name: name.into(),
            attitude: SpatialAttitude::default(),
            task,
            limits: Limits::of(&robot),
            cost: Cost::none(&robot),
            mesh: refine::Settings::default(),
            solver: nlp::Settings::default(),
            robot,
        }
    }

    /// Describes the base attitude in space by `attitude`.
    ///
    /// Limits and weights on attitude and rate mean something else then: they are set to none.
    pub fn set_attitude(&mut self, attitude: SpatialAttitude) {
        self.attitude = attitude;
        let angles = self.component_count(ComponentKind::BaseAttitude);
        let rates = self.component_count(ComponentKind::BaseRate);
        self.limits.base_attitude = vec![Interval::FREE; angles];
        self.limits.final_base_attitude = vec![Interval::FREE; angles];
        self.limits.base_rate = vec![Interval::FREE; rates];
        self.cost.final_base_attitude = vec![0.0; angles];
        self.cost.base_attitude = vec![0.0; angles];
        self.cost.base_rate = vec![0.0; rates];
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

    /// What limits on the base attitude are about, at t₀: each angle, or the rotation angle, rad.
    pub fn limited_start_attitude(&self) -> Vec<f64> {
        let angles = &self.task.initial_base_attitude;
        match self.has_rotation_angle() {
            true => vec![SpatialAttitude::RollPitchYaw.to_quaternion(angles).angle()],
            false => angles.clone(),
        }
    }

    /// Whether limits and weights on the base attitude are on its rotation angle: in space, where
    /// the attitude is not given by angles.
    pub fn has_rotation_angle(&self) -> bool {
        self.robot.plane().is_none() && !self.attitude.is_angles()
    }

    /// How many bounds or weights a limit or a cost term with these components has.
    pub fn component_count(&self, components: ComponentKind) -> usize {
        let (angles, lengths) = base_sizes(&self.robot);
        match components {
            ComponentKind::Joint => self.robot.joint_count(),
            ComponentKind::BaseAttitude => self.attitude_sizes().1,
            ComponentKind::BaseRate => angles,
            ComponentKind::BasePosition => lengths,
            ComponentKind::Base => 1,
        }
    }
}
