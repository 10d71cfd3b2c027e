//! Whether a problem can be at all: lengths, signs, start and goal within their limits.

use super::{Obstacle, Problem, ProblemError, way_point};
use crate::dynamics::JointKind;
use crate::ocp::Interval;

impl Problem {
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
