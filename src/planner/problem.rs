//! A planning problem: robot, task, limits, cost and mesh, eq. (7) to (18).

use super::{EndEffectorGoal, KeepOut, Momentum, Obstacle, WayPoint, way_point};
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::space::{Planar, Space, Spatial};
use crate::dynamics::{JointKind, Model};
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

    /// Checks lengths, finiteness, signs and that start and goal lie within their limits.
    ///
    /// # Errors
    /// [`ProblemError`] for the first thing found wrong.
    pub fn validate(&self) -> Result<(), ProblemError> {
        let n = self.robot.joint_count();
        let (angles, lengths) = Self::base_sizes(&self.robot);
        let task = &self.task;
        let duration = task.duration;
        if !(duration.lower > 0.0 && duration.lower.is_finite() && duration.upper.is_finite()) {
            let found = if duration.is_fixed() {
                format!("{} s", duration.lower)
            } else {
                format!("from {} to {} s", duration.lower, duration.upper)
            };
            return Err(error(
                "task.duration",
                found,
                "a finite duration above zero",
            ));
        }
        interval("task.duration", &duration)?;
        for (key, values) in [
            ("task.initial.joints", &task.initial_joints),
            ("task.initial.rates", &task.initial_rates),
            ("task.final.joints", &task.final_joints),
        ] {
            count(key, values.len(), n, "joints")?;
            for (i, value) in values.iter().enumerate() {
                if !value.is_finite() {
                    return Err(error(indexed(key, i, n), value, "a finite number"));
                }
            }
        }
        let momentum = &task.initial_momentum;
        for (key, values, size, what) in [
            (
                "task.initial.linear_momentum",
                &momentum.linear,
                lengths,
                "base lengths",
            ),
            (
                "task.initial.angular_momentum",
                &momentum.angular,
                angles,
                "base angles",
            ),
        ] {
            count(key, values.len(), size, what)?;
            for (i, value) in values.iter().enumerate() {
                if !value.is_finite() {
                    return Err(error(indexed(key, i, size), value, "a finite number"));
                }
            }
        }
        self.validate_goal(n)?;
        way_point::validate(self)?;
        let turns = self.attitude_sizes().1;
        let turned = if turns == angles {
            "base angles"
        } else {
            "base rotation angles"
        };
        let limits = &self.limits;
        for (key, bounds, expected, what) in [
            ("limits.joint_position", &limits.joint_position, n, "joints"),
            ("limits.joint_velocity", &limits.joint_velocity, n, "joints"),
            ("limits.control", &limits.control, n, "joints"),
            ("limits.torque", &limits.torque, n, "joints"),
            ("limits.base_attitude", &limits.base_attitude, turns, turned),
            ("limits.base_rate", &limits.base_rate, angles, "base angles"),
            (
                "limits.final_base_attitude",
                &limits.final_base_attitude,
                turns,
                turned,
            ),
        ] {
            count(key, bounds.len(), expected, what)?;
            for (i, bound) in bounds.iter().enumerate() {
                interval(&indexed(key, i, expected), bound)?;
            }
        }
        if turns < angles {
            for (key, bounds) in [
                ("limits.base_attitude", &limits.base_attitude),
                ("limits.final_base_attitude", &limits.final_base_attitude),
            ] {
                let Interval { lower, upper } = bounds[0];
                if lower != -upper {
                    let found = format!("[{lower}, {upper}]");
                    let expected = "a symmetric bound, the largest rotation angle";
                    return Err(error(key, found, expected));
                }
            }
        }
        for (i, bound) in limits.base_attitude.iter().enumerate() {
            if bound.violation(0.0) > 0.0 {
                return Err(error(
                    indexed("limits.base_attitude", i, turns),
                    format!("[{}, {}]", bound.lower, bound.upper),
                    "a range around 0, the attitude at the start",
                ));
            }
        }
        self.validate_keep_out(n)?;
        self.validate_ends(n)?;
        self.validate_cost(n, angles, lengths)?;
        self.mesh
            .validate()
            .map_err(|(key, found, expected)| error(format!("mesh.{key}"), found, expected))
    }

    fn validate_keep_out(&self, n: usize) -> Result<(), ProblemError> {
        for (i, pair) in self.limits.keep_out.iter().enumerate() {
            let key = |rest: &str| format!("limits.keep_out[{i}].{rest}");
            let mut radii = pair.sphere.radius;
            let mut numbers = pair.sphere.center.to_vec();
            let mut carriers = vec![pair.sphere.joint];
            match &pair.from {
                Obstacle::Sphere(other) => {
                    radii += other.radius;
                    numbers.extend(other.center);
                    carriers.push(other.joint);
                    if !(other.radius.is_finite() && other.radius >= 0.0) {
                        let expected = "a finite length, m, zero or above";
                        return Err(error(key("from.radius"), other.radius, expected));
                    }
                }
                Obstacle::Box { center, half } => {
                    numbers.extend(center);
                    carriers.push(None);
                    if let Some(h) = half.iter().find(|h| !(h.is_finite() && **h > 0.0)) {
                        let expected = "finite lengths above zero, m";
                        return Err(error(key("from.half"), h, expected));
                    }
                    radii += half[0];
                }
            }
            if !(pair.sphere.radius.is_finite() && pair.sphere.radius >= 0.0) {
                let expected = "a finite length, m, zero or above";
                return Err(error(key("sphere.radius"), pair.sphere.radius, expected));
            }
            if let Some(c) = numbers.iter().find(|c| !c.is_finite()) {
                return Err(error(key("sphere.center"), c, "finite numbers"));
            }
            if radii == 0.0 {
                let expected = "a radius above zero on one side";
                return Err(error(key("sphere.radius"), "two points", expected));
            }
            if carriers.iter().flatten().any(|&joint| joint >= n) {
                return Err(error(
                    key("sphere.body"),
                    "no such body",
                    "a body of the robot",
                ));
            }
            if carriers[0] == carriers[1] {
                let expected = "two different bodies";
                return Err(error(key("from.body"), "the same body", expected));
            }
        }
        Ok(())
    }

    fn validate_goal(&self, n: usize) -> Result<(), ProblemError> {
        let task = &self.task;
        count("task.final.free", task.free_joints.len(), n, "joints")?;
        let Some(goal) = &task.end_effector else {
            if task.free_joints.contains(&true) {
                let expected = "a position for every joint, or a goal for the end effector";
                return Err(error(
                    "task.final.joints",
                    "some joints left free",
                    expected,
                ));
            }
            return Ok(());
        };
        goal.validate("task.final.end_effector", &self.robot)
    }

    fn validate_ends(&self, n: usize) -> Result<(), ProblemError> {
        let (task, limits) = (&self.task, &self.limits);
        for (key, values, bounds, limit) in [
            (
                "task.initial.joints",
                &task.initial_joints,
                &limits.joint_position,
                "limits.joint_position",
            ),
            (
                "task.final.joints",
                &task.final_joints,
                &limits.joint_position,
                "limits.joint_position",
            ),
            (
                "task.initial.rates",
                &task.initial_rates,
                &limits.joint_velocity,
                "limits.joint_velocity",
            ),
        ] {
            for (i, (value, bound)) in values.iter().zip(bounds).enumerate() {
                let sought = key == "task.final.joints" && task.free_joints[i];
                if !sought && bound.violation(*value) > 0.0 {
                    let joint = &self.robot.joints()[i];
                    let unit = match joint.kind {
                        JointKind::Revolute => "rad",
                        JointKind::Prismatic => "m",
                    };
                    return Err(error(
                        indexed(key, i, n),
                        format!("{value} {unit} for joint '{}'", joint.name),
                        format!("a value within {limit}, [{}, {}]", bound.lower, bound.upper),
                    ));
                }
            }
        }
        Ok(())
    }

    fn validate_cost(&self, n: usize, angles: usize, lengths: usize) -> Result<(), ProblemError> {
        let cost = &self.cost;
        for (key, weights, expected, what) in [
            (
                "cost.final_base_attitude",
                &cost.final_base_attitude,
                self.attitude_sizes().1,
                "base angles",
            ),
            (
                "cost.final_base_position",
                &cost.final_base_position,
                lengths,
                "base lengths",
            ),
            ("cost.base_rate", &cost.base_rate, angles, "base angles"),
            ("cost.joint_rate", &cost.joint_rate, n, "joints"),
            ("cost.control", &cost.control, n, "joints"),
            ("cost.torque", &cost.torque, n, "joints"),
        ] {
            count(key, weights.len(), expected, what)?;
            for (i, weight) in weights.iter().enumerate() {
                if !(weight.is_finite() && *weight >= 0.0) {
                    let key = indexed(key, i, expected);
                    return Err(error(key, weight, "a finite weight, zero or above"));
                }
            }
        }
        if !(cost.duration.is_finite() && cost.duration >= 0.0) {
            return Err(error(
                "cost.duration",
                cost.duration,
                "a finite weight, zero or above",
            ));
        }
        let Some(matrix) = &cost.rate_matrix else {
            return Ok(());
        };
        let size = angles + n;
        count(
            "cost.rate_matrix",
            matrix.len(),
            size,
            "rows, one a base angle and joint",
        )?;
        for (i, row) in matrix.iter().enumerate() {
            count(
                &format!("cost.rate_matrix[{i}]"),
                row.len(),
                size,
                "columns",
            )?;
            for (j, value) in row.iter().enumerate() {
                let key = || format!("cost.rate_matrix[{i}][{j}]");
                if !value.is_finite() {
                    return Err(error(key(), value, "a finite number"));
                }
                if matrix[j].get(i).is_some_and(|mirror| mirror != value) {
                    return Err(error(key(), value, "a symmetric matrix"));
                }
            }
        }
        Ok(())
    }
}

pub(super) fn error(
    key: impl Into<String>,
    found: impl ToString,
    expected: impl Into<String>,
) -> ProblemError {
    ProblemError {
        key: key.into(),
        found: found.to_string(),
        expected: expected.into(),
    }
}

/// The key of element `i`, or of the whole where there is only one.
pub(super) fn indexed(key: &str, i: usize, count: usize) -> String {
    if count == 1 {
        key.into()
    } else {
        format!("{key}[{i}]")
    }
}

pub(super) fn count(
    key: &str,
    found: usize,
    expected: usize,
    what: &str,
) -> Result<(), ProblemError> {
    if found == expected {
        return Ok(());
    }
    let noun = if found == 1 { "value" } else { "values" };
    Err(error(
        key,
        format!("{found} {noun}"),
        format!("{expected}, the number of {what}"),
    ))
}

fn interval(key: &str, bounds: &Interval) -> Result<(), ProblemError> {
    if bounds.lower.is_nan() || bounds.upper.is_nan() {
        return Err(error(key, "not a number", "a lower and an upper bound"));
    }
    if bounds.lower > bounds.upper {
        let found = format!(
            "lower bound {} above upper bound {}",
            bounds.lower, bounds.upper
        );
        return Err(error(key, found, "lower at most upper"));
    }
    Ok(())
}
