//! What a roboticist wants to know, in degrees and centimetres.

use super::base_motion;
use super::format::{OF_RELAXED, centimetres, cost, degrees, gap, list, rotation, seconds, shares};
use super::lines::Lines;
use super::peaks::Peaks;
use super::prices;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::{JointKind, Model};
use crate::planner::{BASE_RATE_REGULARIZATION, Method, Plan, Status};
use crate::problem::Problem;
use crate::refine::{Record, Verdict};
use crate::solution;
use crate::study::{BaseMotion, Baselines};
use crate::system::shadow_prices;
use crate::text::digits::digits;
use crate::verify::Verification;
use comfy_table::{CellAlignment, Table, presets};
use std::path::PathBuf;

/// The summary of `plan`, some twenty lines; `baselines` are its motion without planning, `files` those
/// written.
pub fn summary(problem: &Problem, plan: &Plan, baselines: &Baselines, files: &[PathBuf]) -> String {
    let mut lines = Lines::default();
    match plan.status {
        Status::Infeasible => {
            lines.add("cost J", format!("{}, {OF_RELAXED}", cost(plan.objective)));
        }
        _ => quality(&mut lines, plan),
    }
    if !problem.task.duration.is_fixed() {
        lines.add(
            "duration",
            format!("{} s", digits(plan.discretization.duration, 6, 3)),
        );
    }
    motion(&mut lines, &problem.robot, plan, baselines);
    goals(&mut lines, problem, plan);
    if let Some(found) = &plan.verification {
        verification(&mut lines, &problem.robot, found);
    }
    if plan.status == Status::Solved && plan.method.optimises() {
        let planned = BaseMotion::planned(&plan.metrics);
        if let Some(remark) = base_motion::remark(planned, baselines) {
            lines.add("remark", remark);
        }
        let prices = shadow_prices(problem, &plan.discretization, &plan.iterate);
        if let Some(held) = prices::dearest(&prices, plan.objective) {
            lines.add("limits", held);
        }
    }
    for warning in &plan.warnings {
        lines.add("warning", warning);
    }
    let time = &plan.timing;
    let spent = match plan.method.optimises() {
        true => shares(solution::timing(time)),
        false => seconds(time.total),
    };
    lines.add("time", spent);
    lines.files(files);
    let heading = match (plan.status, &plan.diagnosis) {
        (Status::Infeasible, Some(diagnosis)) => format!(
            "{}: infeasible ({})\n\n{}\n\n{}",
            problem.name,
            plan.method.name(),
            diagnosis.summary,
            if plan.method.optimises() {
                "The motion below has those limits relaxed."
            } else {
                "The motion below is the one this planner has to offer."
            }
        ),
        _ => verdict(problem, plan),
    };
    let lines = lines.finish();
    if plan.iterations.is_empty() {
        return format!("{heading}\n\n{lines}");
    }
    format!("{heading}\n\n{}\n{lines}", iterations(plan))
}

fn quality(lines: &mut Lines, plan: &Plan) {
    let mesh = &plan.discretization.mesh;
    let within = plan.max_error <= plan.tolerance;
    let reached = if within { "within" } else { "above" };
    let error = format!(
        "{:.3e}, {reached} the tolerance {:e}",
        plan.max_error, plan.tolerance
    );
    let size = format!("{} segments, {} points", mesh.segments(), mesh.points());
    lines.add("cost J", cost(plan.objective));
    if plan.method == Method::BaseRate {
        let own = format!(
            "of the problem; above the planner's own, ∫‖η̇‖² + {BASE_RATE_REGULARIZATION:?} ∫‖u‖²"
        );
        lines.add("", own);
    }
    if let Some(error) = plan.iterations.last().and_then(objective_error) {
        lines.add("error of J", error);
    }
    lines.add("largest error", error);
    lines.add("mesh", size);
}

fn verification(lines: &mut Lines, robot: &Model, found: &Verification) {
    let all_turn = robot
        .joints()
        .iter()
        .all(|joint| joint.kind == JointKind::Revolute);
    let joints = if all_turn {
        format!("{}°", gap(found.max_joint_drift.to_degrees()))
    } else {
        format!("{} rad or m", gap(found.max_joint_drift))
    };
    let base = format!(
        "base within {}° and {} cm",
        gap(found.max_base_attitude_drift.to_degrees()),
        gap(100.0 * found.max_base_position_drift)
    );
    let momentum = format!("momentum below {:.1e} kg m²/s", found.max_angular_momentum);
    lines.add(
        "re-integrated",
        format!("{base}, joints within {joints}; {momentum}"),
    );
}

/// The status in one line, with the diagnosis where there is one.
pub fn verdict(problem: &Problem, plan: &Plan) -> String {
    let last = plan.iterations.last().map(|last| last.verdict);
    let remark = match (plan.status, last) {
        (Status::Solved, Some(Verdict::Overshoots)) => {
            "; controls overshoot a limit for an instant"
        }
        _ => "",
    };
    format!(
        "{}: {} ({}){remark}",
        problem.name,
        status(plan),
        plan.method.name()
    )
}

fn status(plan: &Plan) -> String {
    match (plan.status, &plan.diagnosis) {
        (Status::Solved, _) => "solved".into(),
        (Status::Infeasible, Some(diagnosis)) => format!("infeasible: {}", diagnosis.summary),
        (Status::Infeasible, None) => "infeasible".into(),
        (Status::NotConverged, _) => {
            let why = match plan.iterations.last().map(|last| last.verdict) {
                Some(found) if found.is_converged() => "re-integration does not confirm it".into(),
                Some(other) => other.to_string(),
                None => "the motion is not as accurate as it should be".into(),
            };
            format!("NOT converged, {why}; this is the best trajectory found")
        }
        (Status::Interrupted, _) => "INTERRUPTED; this is the best trajectory until then".into(),
    }
}

fn motion(lines: &mut Lines, robot: &Model, plan: &Plan, baselines: &Baselines) {
    let found = &plan.metrics;
    let last = |rows: &[Vec<f64>]| rows.last().cloned().unwrap_or_default();
    let attitude = last(&plan.trajectory.base_attitude);
    let at_end = match plan.trajectory.attitude {
        Some(by) if !by.is_angles() => rotation(by, &attitude),
        _ if attitude.len() == 1 => list(&attitude, degrees),
        _ => format!(
            "{} {}",
            degrees(found.final_base_attitude),
            list(&attitude, degrees)
        ),
    };
    lines.add(
        "base attitude",
        format!(
            "largest {}, final {at_end}",
            degrees(found.max_base_attitude)
        ),
    );
    if plan.method != Method::StraightLine {
        for (label, turned) in base_motion::beside(baselines) {
            lines.add(&format!("  {label}"), turned);
        }
    }
    let position = last(&plan.trajectory.base_position);
    let start = plan
        .trajectory
        .base_position
        .first()
        .cloned()
        .unwrap_or_default();
    let moved: Vec<f64> = position.iter().zip(&start).map(|(a, b)| a - b).collect();
    lines.add(
        "base displacement",
        format!(
            "largest {}, final {} {}",
            centimetres(found.max_base_displacement),
            centimetres(found.final_base_displacement),
            list(&moved, centimetres)
        ),
    );
    let rows = &plan.trajectory;
    for peaks in Peaks::of(robot, &rows.joint_velocity, &rows.joint_torque) {
        lines.add(peaks.label(), peaks.describe());
    }
}

/// How near the goals with a tolerance were met.
fn goals(lines: &mut Lines, problem: &Problem, plan: &Plan) {
    let task = &problem.task;
    let points = task
        .way_points
        .iter()
        .filter_map(|p| p.end_effector.as_ref());
    for (goal, found) in points.chain(&task.end_effector).zip(&plan.goals) {
        if goal.position_tolerance == 0.0 && goal.orientation_tolerance == 0.0 {
            continue;
        }
        let gaps = [found.distance.map(centimetres), found.angle.map(degrees)];
        let gaps: Vec<String> = gaps.into_iter().flatten().collect();
        let off = format!(
            "{} off its goal at {} s",
            gaps.join(" and "),
            digits(found.t, 3, 2)
        );
        let allowed = match plan.status {
            Status::Solved => ", as allowed",
            _ => "",
        };
        lines.add("end effector", off + allowed);
    }
}

/// What the mesh leaves of J, where that is known.
fn objective_error(last: &Record) -> Option<String> {
    let error = last.objective_error;
    error
        .is_finite()
        .then(|| format!("about {error:+.1e}, from the multipliers"))
}

/// One row a mesh iteration.
fn iterations(plan: &Plan) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header([
        "mesh",
        "segments",
        "points",
        "largest error",
        "cost J",
        "Ipopt",
        "time",
    ]);
    for (i, record) in plan.iterations.iter().enumerate() {
        table.add_row([
            (i + 1).to_string(),
            record.segments.to_string(),
            record.points.to_string(),
            format!("{:.3e}", record.max_error),
            // J of meshes without a solution is the cost of nothing.
            match plan.status {
                Status::Infeasible => "–".into(),
                _ => cost(record.objective),
            },
            format!(
                "{} iteration{}, {}",
                record.nlp_iterations,
                if record.nlp_iterations == 1 { "" } else { "s" },
                record.nlp_status.describe()
            ),
            seconds(record.time),
        ]);
    }
    for column in [0, 1, 2, 3, 4, 6] {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let indented = |line: &str| format!(" {}\n", line.trim_end());
    table.to_string().lines().map(indented).collect()
}
