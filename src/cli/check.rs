//! `check`: what a problem file was understood to say.

use super::failure::Failure;
use super::robot;
use super::show::{by_name, rounded, show, show_interval};
use super::{Outcome, terminal};
use crate::config::{Overrides, ProblemFile};
use crate::dynamics::JointKind;
use crate::dynamics::attitude::SpatialAttitude;
use crate::ocp::Interval;
use crate::problem::{
    ComponentKind, CostEntry, CostId, EndEffectorGoal, GoalFrame, KeepOut, LimitId, Moment,
    Problem, Solid, Unit, WayPoint,
};
use crate::report::{Lines, rotation};
use crate::system::straight_line;
use crate::text::digits::digits;
use clap::Args;
use std::path::PathBuf;

/// Validate a problem, or a robot alone, and print what was understood; solves nothing
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file, or a robot's URDF file
    #[arg(value_name = "PROBLEM.toml|ROBOT.urdf")]
    problem: PathBuf,
    /// Take the nearest inertia that a body can have for those of the robot that no body has, where
    /// rounding explains it or no joint moves them; short for --set robot.repair=inertia
    #[arg(long)]
    repair: bool,
}

/// Reads, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.problem;
    if path.extension().is_some_and(|ends| ends == "urdf") {
        return robot::check(path);
    }
    let mut overrides = Overrides::default();
    overrides.repair(arguments.repair);
    let file = ProblemFile::load(path, &overrides)?;
    terminal::print(&understood(&file))?;
    Ok(Outcome::Done)
}

/// What `check` prints of a problem file.
pub fn understood(file: &ProblemFile) -> String {
    let problem = &file.problem;
    let mut lines = Lines::default();
    of_robot(&mut lines, file);
    task(&mut lines, problem);
    limits(&mut lines, problem);
    cost(&mut lines, problem);
    mesh(&mut lines, problem);
    let repairs = file
        .repairs
        .iter()
        .map(|change| format!("warning: {change}\n"));
    let notes = file.notes.iter().map(|note| format!("note: {note}\n"));
    let notes: String = repairs.chain(notes).collect();
    format!(
        "{}: valid\n\n{}\n{}{}{}\n",
        file.path,
        lines.finish(),
        notes,
        if notes.is_empty() { "" } else { "\n" },
        straight(problem)
    )
}

fn of_robot(lines: &mut Lines, file: &ProblemFile) {
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
        let at = |value| show(Unit::position(joint.kind), value);
        let goal = if task.free_joints[i] {
            "wherever the end effector needs it".into()
        } else {
            at(task.final_joints[i])
        };
        let mut motion = format!("{} to {goal}", at(task.initial_joints[i]));
        if task.initial_rates[i] != 0.0 {
            let rate = show(Unit::rate(joint.kind), task.initial_rates[i]);
            motion.push_str(&format!(", starting at {rate}"));
        }
        lines.add(&format!("joint {}", joint.name), motion);
    }
    if task.starts_turned() {
        let angles = task.initial_base_attitude.iter();
        let shown: Vec<String> = angles.map(|angle| show(Unit::Radian, *angle)).collect();
        lines.add("base at the start", format!("turned {}", shown.join(", ")));
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
    type Of = fn(JointKind) -> Unit;
    for (values, unit) in [
        (&point.joints, Unit::position as Of),
        (&point.joint_rates, Unit::rate),
    ] {
        let joints = problem.robot.joints().iter().zip(values);
        parts.extend(joints.filter_map(|(joint, value)| {
            let value = show(unit(joint.kind), (*value)?);
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
    let list = |values: &[f64], unit: Unit| {
        let shown: Vec<String> = values.iter().map(|v| show(unit, *v)).collect();
        shown.join(", ")
    };
    let mut parts = Vec::new();
    for (what, values, room, unit) in [
        ("at", &goal.position, goal.position_tolerance, Unit::Metre),
        (
            "turned",
            &goal.orientation,
            goal.orientation_tolerance,
            Unit::Radian,
        ),
    ] {
        if let Some(values) = values {
            let mut part = format!("{what} {}", list(values, unit));
            if room > 0.0 {
                part.push_str(&format!(" ± {}", show(unit, room)));
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
    lines.add("limits", "");
    limits_on(lines, problem, ComponentKind::Joint);
    for pair in &problem.limits.keep_out {
        let label = format!("  {}", LimitId::KeepOut.words());
        lines.add(&label, keep_out(problem, pair));
    }
    limits_on(lines, problem, ComponentKind::BaseAttitude);
    limits_on(lines, problem, ComponentKind::BaseRate);
    limits_on(lines, problem, ComponentKind::BasePosition);
    let most = problem.limits.base_motion;
    if most.is_finite() {
        let label = format!("  {}", LimitId::BaseMotion.words());
        lines.add(
            &label,
            format!("its terms of the cost together at most {most}"),
        );
    }
}

/// The limits that have one bound a component of that kind.
fn limits_on(lines: &mut Lines, problem: &Problem, kind: ComponentKind) {
    let names = component_names(problem, kind);
    // A rotation angle has no sign.
    let turned = kind == ComponentKind::BaseAttitude && problem.has_rotation_angle();
    let entries = problem.limits.entries();
    for entry in entries.filter(|entry| entry.components == kind) {
        let show = |(i, bound): (usize, &Interval)| {
            let shown = show_interval(entry.unit(&problem.robot, i), bound);
            match shown.strip_prefix('±') {
                Some(bound) if turned => format!("turned by at most {bound}"),
                _ => shown,
            }
        };
        let shown: Vec<String> = entry.bounds.iter().enumerate().map(show).collect();
        let label = format!("  {}", entry.id.words());
        lines.add(&label, by_name(&names, &shown));
    }
}

/// A pair kept apart in one line.
fn keep_out(problem: &Problem, pair: &KeepOut) -> String {
    let solid = |solid: &Solid| {
        let body = match solid.joint {
            Some(joint) => &problem.robot.joints()[joint].body.name,
            None => &problem.robot.base().name,
        };
        format!("{} on {body}", solid.shape)
    };
    let (first, second) = (solid(&pair.first), solid(&pair.second));
    format!("{}: {first} from {second}", pair.name)
}

/// Names of the components that limits and weights of that kind have.
fn component_names(problem: &Problem, kind: ComponentKind) -> Vec<String> {
    let planar = problem.robot.plane().is_some();
    let names: &[&str] = match kind {
        ComponentKind::Joint => {
            let joints = problem.robot.joints().iter();
            return joints.map(|joint| joint.name.clone()).collect();
        }
        ComponentKind::BaseAttitude if problem.has_rotation_angle() => &["rotation angle"],
        ComponentKind::BaseRate if problem.has_rotation_angle() => &["x", "y", "z"],
        ComponentKind::BaseAttitude | ComponentKind::BaseRate if planar => &["angle"],
        ComponentKind::BaseAttitude | ComponentKind::BaseRate => &["roll", "pitch", "yaw"],
        ComponentKind::BasePosition if planar => &["x", "y"],
        ComponentKind::BasePosition => &["x", "y", "z"],
        ComponentKind::Base => &["base"],
    };
    names.iter().map(|name| name.to_string()).collect()
}

fn cost(lines: &mut Lines, problem: &Problem) {
    let cost = &problem.cost;
    let weighed = |entry: &CostEntry<&Vec<f64>>| entry.weights.iter().any(|w| *w != 0.0);
    let mut terms: Vec<String> = cost
        .entries()
        .filter(weighed)
        .map(|entry| {
            let shown: Vec<String> = entry.weights.iter().map(|w| rounded(*w)).collect();
            let term = entry.id.formula(problem.has_rotation_angle());
            match by_name(&component_names(problem, entry.components), &shown) {
                weight if weight.contains(' ') => format!("({weight}) {term}"),
                weight => format!("{weight} {term}"),
            }
        })
        .collect();
    if cost.duration > 0.0 {
        let term = CostId::Duration.formula(problem.has_rotation_angle());
        terms.push(format!("{} {term}", rounded(cost.duration)));
    }
    if cost.rate_matrix.is_some() {
        let term = CostId::RateMatrix.formula(problem.has_rotation_angle());
        terms.push(format!("{term} with the full matrix"));
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
    let (method, first) = (mesh.method.name(), mesh.law().describe());
    let described = format!("{method}: {first}; tolerance {:e}", mesh.tolerance);
    lines.add("mesh", described);
}

/// Base motion when the joints move along the straight line.
fn straight(problem: &Problem) -> String {
    let found = straight_line(problem);
    let list = |values: &[f64], factor: f64, decimals: usize| {
        let shown: Vec<String> = values
            .iter()
            .map(|value| digits(factor * value, decimals, 2))
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
    let attitude = if problem.has_rotation_angle() {
        rotation(problem.attitude, &found.base_attitude)
    } else {
        list(&found.base_attitude, 1f64.to_degrees(), 5) + "°"
    };
    format!(
        "straight-line base motion{to}: {attitude}, {} cm",
        list(&found.base_displacement, 100.0, 6)
    )
}
