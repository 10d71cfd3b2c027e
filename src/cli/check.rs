//! `check`: what a problem file was understood to say.

use super::failure::Failure;
use super::show::{Quantity, by_name, rounded};
use super::{Outcome, terminal};
use crate::config::{Overrides, ProblemFile};
use crate::dynamics::JointKind;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::ocp::Interval;
use crate::problem::{
    EndEffectorGoal, GoalFrame, KeepOut, Moment, Obstacle, Problem, Sphere, WayPoint,
};
use crate::refine::Method;
use crate::report::{Lines, rotation};
use crate::system::straight_line;
use clap::Args;
use std::path::PathBuf;

/// Validate a problem and print what was understood; solves nothing
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
}

/// Reads, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let file = ProblemFile::load(&arguments.problem, &Overrides::default())?;
    let problem = &file.problem;
    let mut lines = Lines::default();
    robot(&mut lines, &file);
    task(&mut lines, problem);
    limits(&mut lines, problem);
    cost(&mut lines, problem);
    mesh(&mut lines, problem);
    let notes: String = file.notes.iter().map(|n| format!("note: {n}\n")).collect();
    terminal::print(&format!(
        "{}: valid\n\n{}\n{}{}{}\n",
        file.path,
        lines.finish(),
        notes,
        if notes.is_empty() { "" } else { "\n" },
        straight(problem)
    ))?;
    Ok(Outcome::Done)
}

fn robot(lines: &mut Lines, file: &ProblemFile) {
    let (problem, path) = (&file.problem, &file.robot.path);
    let robot = &problem.robot;
    let n = robot.joint_count();
    let (angles, lengths) = Problem::base_sizes(robot);
    let (parameters, _) = problem.attitude_sizes();
    lines.add("problem", &problem.name);
    lines.add("robot", format!("{}, from {path}", robot.name()));
    let bodies: Vec<String> = std::iter::once(robot.base())
        .chain(robot.joints().iter().map(|joint| &joint.body))
        .map(|body| format!("{} {} kg", body.name, rounded(body.inertia.mass())))
        .collect();
    lines.add("bodies", format!("{}: {}", bodies.len(), bodies.join(", ")));
    lines.add("total mass", format!("{} kg", rounded(robot.total_mass())));
    if let Some(name) = &file.end_effector {
        lines.add("end effector", name);
    }
    let motion = match (robot.plane(), problem.attitude) {
        (Some(_), _) => "planar; the base attitude is one angle",
        (None, SpatialAttitude::RollPitchYaw) => "spatial; the base attitude is roll, pitch, yaw",
        (None, SpatialAttitude::Quaternion) => "spatial; the base attitude is a unit quaternion",
        (None, SpatialAttitude::Mrp) => {
            "spatial; the base attitude is modified Rodrigues parameters"
        }
    };
    lines.add("motion", motion);
    lines.add(
        "degrees of freedom",
        format!(
            "{}: {n} of the joints, {} of the base",
            n + angles + lengths,
            angles + lengths
        ),
    );
    lines.add(
        "states",
        format!(
            "{}: {parameters} base attitude, {n} joint positions, {n} joint rates",
            parameters + 2 * n
        ),
    );
    lines.add("controls", format!("{n}: u = H⁻¹τ"));
}

fn task(lines: &mut Lines, problem: &Problem) {
    let task = &problem.task;
    let Interval { lower, upper } = task.duration;
    let duration = if task.duration.is_fixed() {
        format!("{} s", rounded(lower))
    } else {
        format!("free, {} to {} s", rounded(lower), rounded(upper))
    };
    lines.add("duration", duration);
    for (i, joint) in problem.robot.joints().iter().enumerate() {
        let at = |value| Quantity::Position(joint.kind).show(value);
        let goal = if task.free_joints[i] {
            "wherever the end effector needs it".into()
        } else {
            at(task.final_joints[i])
        };
        let mut motion = format!("{} to {goal}", at(task.initial_joints[i]));
        if task.initial_rates[i] != 0.0 {
            let rate = Quantity::Rate(joint.kind).show(task.initial_rates[i]);
            motion.push_str(&format!(", starting at {rate}"));
        }
        lines.add(&format!("joint {}", joint.name), motion);
    }
    if let Some(goal) = &task.end_effector {
        lines.add("goal", end_effector(goal));
    }
    for point in &task.way_points {
        lines.add("way-point", way_point(problem, point));
    }
    let momentum = &task.initial_momentum;
    if !momentum.is_zero() {
        let list = |values: &[f64]| {
            let shown: Vec<String> = values.iter().map(|v| rounded(*v)).collect();
            format!("({})", shown.join(", "))
        };
        let linear = format!("{} kg m/s", list(&momentum.linear));
        let angular = format!("{} kg m²/s", list(&momentum.angular));
        lines.add("momentum", format!("linear {linear}, angular {angular}"));
    }
}

/// A way-point in one line.
fn way_point(problem: &Problem, point: &WayPoint) -> String {
    let mut parts = vec![match point.at {
        Moment::Time(time) => format!("at {} s", rounded(time)),
        Moment::Fraction(part) => format!("at {} of the duration", rounded(part)),
    }];
    type Of = fn(JointKind) -> Quantity;
    for (values, quantity) in [
        (&point.joints, Quantity::Position as Of),
        (&point.joint_rates, Quantity::Rate),
    ] {
        let joints = problem.robot.joints().iter().zip(values);
        parts.extend(joints.filter_map(|(joint, value)| {
            let value = quantity(joint.kind).show((*value)?);
            Some(format!("{} {value}", joint.name))
        }));
    }
    if let Some(goal) = &point.end_effector {
        parts.push(format!("end effector {}", end_effector(goal)));
    }
    parts.join(", ")
}

/// A task-space goal in one line, but for when.
fn end_effector(goal: &EndEffectorGoal) -> String {
    let list = |values: &[f64], quantity: Quantity| {
        let shown: Vec<String> = values.iter().map(|v| quantity.show(*v)).collect();
        shown.join(", ")
    };
    let (length, angle) = (
        Quantity::Position(JointKind::Prismatic),
        Quantity::Position(JointKind::Revolute),
    );
    let mut parts = Vec::new();
    for (what, values, room, quantity) in [
        ("at", &goal.position, goal.position_tolerance, length),
        (
            "turned",
            &goal.orientation,
            goal.orientation_tolerance,
            angle,
        ),
    ] {
        if let Some(values) = values {
            let mut part = format!("{what} {}", list(values, quantity));
            if room > 0.0 {
                part.push_str(&format!(" ± {}", quantity.show(room)));
            }
            parts.push(part);
        }
    }
    let frame = match goal.frame {
        GoalFrame::Inertial => "inertial axes, from the mass centre at the start",
        GoalFrame::Start => "the base frame at the start",
        GoalFrame::Base => "the base frame at that time",
    };
    format!("{}; in {frame}", parts.join(", "))
}

fn limits(lines: &mut Lines, problem: &Problem) {
    type Of = fn(JointKind) -> Quantity;
    let limits = &problem.limits;
    let joints = problem.robot.joints();
    let names: Vec<String> = joints.iter().map(|joint| joint.name.clone()).collect();
    lines.add("limits", "");
    for (label, bounds, quantity) in [
        (
            "joint position",
            &limits.joint_position,
            Quantity::Position as Of,
        ),
        ("joint velocity", &limits.joint_velocity, Quantity::Rate),
        ("control", &limits.control, Quantity::Acceleration),
        ("torque", &limits.torque, Quantity::Effort),
    ] {
        let shown: Vec<String> = joints
            .iter()
            .zip(bounds)
            .map(|(joint, bound)| quantity(joint.kind).show_interval(bound))
            .collect();
        lines.add(&format!("  {label}"), by_name(&names, &shown));
    }
    for pair in &limits.keep_out {
        lines.add("  kept apart", keep_out(problem, pair));
    }
    let (angles, axes) = base_names(problem);
    for (label, names, bounds, quantity) in [
        (
            "base attitude",
            &angles,
            &limits.base_attitude,
            Quantity::Position as Of,
        ),
        (
            "final attitude",
            &angles,
            &limits.final_base_attitude,
            Quantity::Position,
        ),
        ("base rate", &axes, &limits.base_rate, Quantity::Rate),
    ] {
        let shown: Vec<String> = bounds
            .iter()
            .map(|bound| {
                let shown = quantity(JointKind::Revolute).show_interval(bound);
                match shown.strip_prefix('±') {
                    // A rotation angle has no sign.
                    Some(bound) if names[0] == ROTATION => format!("turned by at most {bound}"),
                    _ => shown,
                }
            })
            .collect();
        lines.add(&format!("  {label}"), by_name(names, &shown));
    }
}

/// A pair kept apart in one line.
fn keep_out(problem: &Problem, pair: &KeepOut) -> String {
    let length = Quantity::Position(JointKind::Prismatic);
    let sphere = |sphere: &Sphere| {
        let body = match sphere.joint {
            Some(joint) => &problem.robot.joints()[joint].body.name,
            None => &problem.robot.base().name,
        };
        match sphere.radius {
            0.0 => format!("a point of {body}"),
            radius => format!("a sphere of {} on {body}", length.show(radius)),
        }
    };
    let from = match &pair.from {
        Obstacle::Sphere(other) => sphere(other),
        Obstacle::Box { half, .. } => {
            let edges = half.map(|h| rounded(200.0 * h)).join(" × ");
            format!("a box of {edges} cm on {}", problem.robot.base().name)
        }
    };
    format!("{}: {} from {from}", pair.name, sphere(&pair.sphere))
}

/// What a bound on the attitude is about where there are no angles.
const ROTATION: &str = "rotation angle";

/// What limits and weights on the base attitude are about, and those on its rate.
fn base_names(problem: &Problem) -> (Vec<String>, Vec<String>) {
    let angles: &[&str] = &["roll", "pitch", "yaw"];
    let (attitude, rate) = match (problem.robot.plane(), problem.attitude.is_angles()) {
        (Some(_), _) => (&["angle"][..], &["angle"][..]),
        (None, true) => (angles, angles),
        (None, false) => (&[ROTATION][..], &["x", "y", "z"][..]),
    };
    let owned = |names: &[&str]| names.iter().map(|name| name.to_string()).collect();
    (owned(attitude), owned(rate))
}

fn cost(lines: &mut Lines, problem: &Problem) {
    let cost = &problem.cost;
    let joints: Vec<String> = problem
        .robot
        .joints()
        .iter()
        .map(|joint| joint.name.clone())
        .collect();
    let (angles, axes) = base_names(problem);
    let turned = angles[0] == ROTATION;
    let (attitude, rate) = if turned {
        ("φ(t_f)²", "∫‖ω‖²")
    } else {
        ("‖η(t_f)‖²", "∫‖η̇‖²")
    };
    let lengths = ["x", "y", "z"].map(String::from);
    let mut terms: Vec<String> = [
        (attitude, &cost.final_base_attitude, &angles[..]),
        (
            "‖Δζ(t_f)‖²",
            &cost.final_base_position,
            &lengths[..cost.final_base_position.len()],
        ),
        (rate, &cost.base_rate, &axes),
        ("∫‖θ̇‖²", &cost.joint_rate, &joints),
        ("∫‖u‖²", &cost.control, &joints),
        ("∫‖τ‖²", &cost.torque, &joints),
    ]
    .into_iter()
    .filter(|(_, weights, _)| weights.iter().any(|weight| *weight != 0.0))
    .map(|(term, weights, names)| {
        let shown: Vec<String> = weights.iter().map(|weight| rounded(*weight)).collect();
        match by_name(names, &shown) {
            weight if weight.contains(' ') => format!("({weight}) {term}"),
            weight => format!("{weight} {term}"),
        }
    })
    .collect();
    if cost.duration > 0.0 {
        terms.push(format!("{} t_f", rounded(cost.duration)));
    }
    if cost.rate_matrix.is_some() {
        let rate = if turned { "ω" } else { "η̇" };
        terms.push(format!("∫[{rate}, θ̇]ᵀΛ[{rate}, θ̇] with the full matrix"));
    }
    lines.add(
        "cost J",
        if terms.is_empty() {
            "0: any feasible motion".into()
        } else {
            terms.join(" + ")
        },
    );
}

fn mesh(lines: &mut Lines, problem: &Problem) {
    let mesh = &problem.mesh;
    let first = match mesh.method {
        Method::Adaptive => format!(
            "a-rpm: {} segments of {} points, at most {} points and {} iterations",
            mesh.segments, mesh.points, mesh.max_points, mesh.max_iterations
        ),
        Method::Global => format!(
            "rpm: one segment of {} points, at most {}",
            mesh.global_points, mesh.max_global_points
        ),
    };
    lines.add("mesh", format!("{first}; tolerance {:e}", mesh.tolerance));
}

/// Base motion when the joints move along the straight line.
fn straight(problem: &Problem) -> String {
    let found = straight_line(problem);
    let list = |values: &[f64], factor: f64, decimals: usize| {
        let shown: Vec<String> = values
            .iter()
            .map(|value| format!("{:.decimals$}", factor * value))
            .collect();
        if shown.len() == 1 {
            shown[0].clone()
        } else {
            format!("({})", shown.join(", "))
        }
    };
    let to = if problem.task.free_joints.contains(&true) {
        " to where the search begins"
    } else {
        ""
    };
    let attitude = match problem.robot.plane() {
        None if !problem.attitude.is_angles() => rotation(problem.attitude, &found.base_attitude),
        _ => list(&found.base_attitude, 1f64.to_degrees(), 5) + "°",
    };
    format!(
        "straight-line base motion{to}: {attitude}, {} cm",
        list(&found.base_displacement, 100.0, 6)
    )
}
