//! Whether the arrays of a saved solution belong together, and to a robot.

use super::{Iterate, Solution, Trajectory};
use crate::collocation::Mesh;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::problem::Problem;

/// Part of the duration by which a time may be off its node: that of rounding.
const ROUNDING: f64 = 1e-9;

/// Something in a solution file that does not fit the rest.
pub(super) struct Misfit {
    pub key: String,
    pub found: String,
    pub expected: String,
}

impl Misfit {
    fn new(key: impl Into<String>, found: String, expected: String) -> Self {
        Self {
            key: key.into(),
            found,
            expected,
        }
    }
}

/// The columns of a trajectory beside its times, by name.
fn columns(trajectory: &Trajectory) -> [(&'static str, &[Vec<f64>]); 7] {
    [
        ("base_attitude", &trajectory.base_attitude),
        ("base_position", &trajectory.base_position),
        ("base_rate", &trajectory.base_rate),
        ("joint_position", &trajectory.joint_position),
        ("joint_velocity", &trajectory.joint_velocity),
        ("control", &trajectory.control),
        ("joint_torque", &trajectory.joint_torque),
    ]
}

/// The first thing in `solution` that does not fit `mesh`, which is its own.
pub(super) fn check(solution: &Solution, mesh: &Mesh) -> Result<(), Misfit> {
    for (key, found, expected) in [
        ("points", solution.points, mesh.points()),
        ("segments", solution.segments, mesh.segments()),
    ] {
        if found != expected {
            let expected = format!("{expected}, as its mesh has");
            return Err(Misfit::new(key, found.to_string(), expected));
        }
    }
    times(&solution.trajectory.t, mesh)?;
    for (key, rows) in columns(&solution.trajectory) {
        even(key, rows, mesh.points() + 1)?;
    }
    solution.iterate.as_ref().map_or(Ok(()), iterate)
}

/// Times are those of the nodes: from 0 to t_f, rising.
fn times(t: &[f64], mesh: &Mesh) -> Result<(), Misfit> {
    const KEY: &str = "trajectory.t";
    let nodes = mesh.points() + 1;
    if t.len() != nodes {
        let found = format!("{} times", t.len());
        let expected = format!("{nodes}, one a node of the mesh");
        return Err(Misfit::new(KEY, found, expected));
    }
    let at = |k: usize| format!("{KEY}[{k}]");
    if let Some(k) = t.iter().position(|time| !time.is_finite()) {
        let found = t[k].to_string();
        return Err(Misfit::new(at(k), found, "a finite time".into()));
    }
    if t[0] != 0.0 {
        let expected = "0, where a plan begins".into();
        return Err(Misfit::new(at(0), t[0].to_string(), expected));
    }
    let duration = t[nodes - 1];
    if duration <= 0.0 {
        let found = format!("the last time is {duration}");
        return Err(Misfit::new(KEY, found, "a duration above zero".into()));
    }
    if let Some(k) = (1..nodes).find(|&k| t[k] <= t[k - 1]) {
        let expected = format!("more than {}, the time before it", t[k - 1]);
        return Err(Misfit::new(at(k), t[k].to_string(), expected));
    }
    let planned = mesh.node_fractions();
    let off = |k: &usize| (t[*k] - planned[*k] * duration).abs() > ROUNDING * duration;
    match (0..nodes).find(off) {
        Some(k) => {
            let expected = format!("{}, where its mesh has that node", planned[k] * duration);
            Err(Misfit::new(at(k), t[k].to_string(), expected))
        }
        None => Ok(()),
    }
}

/// One row a node, all of the same length.
fn even(key: &str, rows: &[Vec<f64>], nodes: usize) -> Result<(), Misfit> {
    let key = format!("trajectory.{key}");
    if rows.len() != nodes {
        let found = format!("{} rows", rows.len());
        let expected = format!("{nodes}, one a node of the mesh");
        return Err(Misfit::new(key, found, expected));
    }
    let width = rows[0].len();
    if let Some(k) = rows.iter().position(|row| row.len() != width) {
        let found = format!("row {k} has {} values", rows[k].len());
        return Err(Misfit::new(key, found, format!("{width}, as in row 0")));
    }
    let finite = |row: &Vec<f64>| row.iter().all(|value| value.is_finite());
    match rows.iter().position(|row| !finite(row)) {
        Some(k) => {
            let found = format!("row {k} has a value that is not finite");
            Err(Misfit::new(key, found, "finite numbers".into()))
        }
        None => Ok(()),
    }
}

/// Both kinds of bound multipliers have one a variable.
fn iterate(saved: &Iterate) -> Result<(), Misfit> {
    for (key, values) in [
        ("iterate.lower_multipliers", &saved.lower_multipliers),
        ("iterate.upper_multipliers", &saved.upper_multipliers),
    ] {
        if values.len() != saved.x.len() {
            let found = format!("{} values", values.len());
            let expected = format!("{}, one for each of iterate.x", saved.x.len());
            return Err(Misfit::new(key, found, expected));
        }
    }
    Ok(())
}

/// The first column of `trajectory`, whose rows are even, that is not one of `problem`'s robot, its
/// base attitude described by `attitude`.
pub(super) fn check_robot(
    trajectory: &Trajectory,
    problem: &Problem,
    attitude: Option<SpatialAttitude>,
) -> Result<(), Misfit> {
    let robot = &problem.robot;
    let (angles, lengths) = Problem::base_sizes(robot);
    let parameters = match robot.plane() {
        Some(_) => 1,
        None => attitude.map_or(1, Attitude::count),
    };
    let space = match robot.plane() {
        Some(_) => "which moves in a plane",
        None => "which moves in space",
    };
    let name = robot.name();
    if robot.plane().is_some() != attitude.is_none() {
        let found = match attitude {
            Some(by) => format!("\"{}\"", by.name()),
            None => "\"angle\"".into(),
        };
        let expected = match robot.plane() {
            Some(_) => format!("\"angle\" of robot '{name}', {space}"),
            None => format!("a description of attitudes of robot '{name}', {space}"),
        };
        return Err(Misfit::new("trajectory.attitude", found, expected));
    }
    for (key, rows) in columns(trajectory) {
        let (width, of) = match key {
            "base_attitude" => (parameters, space.to_string()),
            "base_position" => (lengths, space.to_string()),
            "base_rate" => (angles, space.to_string()),
            _ => {
                let n = robot.joint_count();
                let joints = if n == 1 { "joint" } else { "joints" };
                (n, format!("which has {n} {joints}"))
            }
        };
        let found = rows[0].len();
        if found != width {
            return Err(Misfit::new(
                format!("trajectory.{key}"),
                format!("{found} values a row"),
                format!("{width}, for robot '{name}', {of}"),
            ));
        }
    }
    Ok(())
}
