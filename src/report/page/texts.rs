//! What the page says in words and numbers.

use crate::dynamics::JointKind;
use crate::planner::Status;
use crate::problem::Problem;
use crate::report::base_motion;
use crate::report::format::{OF_RELAXED, centimetres, cost, degrees, gap, shares, time};
use crate::report::peaks::Peaks;
use crate::solution::{CostTerm, Solution, Verification};
use crate::study::{BaseMotion, Baselines};
use crate::system::{Trajectory, base_angles, base_displacements};
use crate::text::digits::digits;

/// A fact: what, how much, and where it needs one, what that means.
pub(super) struct Fact {
    pub what: String,
    pub value: String,
    pub meaning: String,
}

impl Fact {
    pub fn new(what: &str, value: String, meaning: &str) -> Self {
        Self {
            what: what.into(),
            value,
            meaning: meaning.into(),
        }
    }
}

/// What came of it, in a few sentences.
pub(super) fn lead(solution: &Solution, straight: Option<&Trajectory>) -> String {
    let caution = match solution.status {
        Status::Infeasible => {
            "This problem has no solution; the motion below does not keep its limits. "
        }
        Status::NotConverged => "This is the best trajectory found, not a converged one. ",
        Status::Interrupted => "This is the best trajectory until it was interrupted. ",
        Status::Solved => "",
    };
    let found = &solution.metrics;
    let planned = format!(
        "The base is turned by at most {} on its way, and ends turned by {} and {} from where it \
         started.",
        degrees(found.max_base_attitude),
        degrees(found.final_base_attitude),
        centimetres(found.final_base_displacement)
    );
    let ends = straight.and_then(|motion| {
        let turned = base_angles(motion).last().copied()?;
        Some((turned, base_displacements(motion).last().copied()?))
    });
    let straight = ends.map(|(turned, moved)| {
        let (turned, moved) = (degrees(turned), centimetres(moved));
        format!(" Along the straight joint path it would end turned by {turned} and {moved} away.")
    });
    [Some(caution.into()), Some(planned), straight]
        .into_iter()
        .flatten()
        .collect()
}

/// The figures a person asks for first.
pub(super) fn figures(solution: &Solution, problem: &Problem, baselines: &Baselines) -> Vec<Fact> {
    let fact = |what: &str, value: String| Fact::new(what, value, "");
    let found = &solution.metrics;
    let last = solution.trajectory.t.last().copied().unwrap_or(0.0);
    let mut facts = vec![
        fact(
            "duration",
            format!("{} s", digits(last, 6, 3)).replace(".000000", ""),
        ),
        Fact::new("cost J", cost(solution.objective), &terms(solution)),
        fact(
            "mesh",
            format!("{} segments, {} points", solution.segments, solution.points),
        ),
        Fact::new(
            "base attitude",
            format!(
                "{} at most, {} at the end",
                degrees(found.max_base_attitude),
                degrees(found.final_base_attitude)
            ),
            &without_planning(solution, baselines),
        ),
        fact(
            "base displacement",
            format!(
                "{} at most, {} at the end",
                centimetres(found.max_base_displacement),
                centimetres(found.final_base_displacement)
            ),
        ),
    ];
    let rows = &solution.trajectory;
    for peaks in Peaks::of(&problem.robot, &rows.joint_velocity, &rows.joint_torque) {
        facts.push(fact(peaks.label(), peaks.describe()));
    }
    let spent = match solution.iterations[..] {
        [] => time(solution.timing.total),
        _ => shares(solution.timing),
    };
    facts.push(fact("planned in", spent));
    facts
}

/// The base's motion without planning, and a word where planning gained little over it.
fn without_planning(solution: &Solution, baselines: &Baselines) -> String {
    let beside = base_motion::beside(baselines).into_iter();
    let planned = BaseMotion {
        largest: solution.metrics.max_base_attitude,
        last: solution.metrics.final_base_attitude,
    };
    let solved = solution.status == Status::Solved && !solution.iterations.is_empty();
    let remark = solved.then(|| base_motion::remark(planned, baselines));
    beside
        .map(|(label, turned)| format!("{label}: {turned}"))
        .chain(remark.flatten())
        .collect::<Vec<_>>()
        .join("; ")
}

/// What the cost is the cost of where no plan is, and its terms where there are several.
fn terms(solution: &Solution) -> String {
    let term = |term: &CostTerm| format!("{} for {}", digits(term.value, 4, 4), term.formula);
    let of = (solution.status == Status::Infeasible).then(|| OF_RELAXED.to_string());
    let terms = match &solution.cost_terms[..] {
        [] | [_] => None,
        terms => Some(terms.iter().map(term).collect::<Vec<_>>().join(", ")),
    };
    [of, terms]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(": ")
}

/// Why the numbers can be trusted, or what has not been checked.
pub(super) fn evidence(solution: &Solution, problem: &Problem) -> Vec<Fact> {
    let mut facts = Vec::new();
    if !solution.iterations.is_empty() {
        let within = if solution.max_error <= solution.tolerance {
            "within"
        } else {
            "above"
        };
        facts.push(Fact::new(
            "collocation error",
            format!(
                "{:.2e}, {within} the tolerance {:e}",
                solution.max_error, solution.tolerance
            ),
            "when it was planned: the largest defect of the equations of motion midway between nodes, \
             eq. (28) of the paper",
        ));
    }
    if let Some(last) = solution.iterations.last() {
        facts.push(Fact::new(
            "between the nodes",
            if last.max_violation > 0.0 {
                format!(
                    "limits exceeded by {} of their size",
                    gap(last.max_violation)
                )
            } else if last.max_violation.is_nan() {
                "a limit is not a number".into()
            } else {
                "no limit is exceeded".into()
            },
            "when it was planned: limits hold at the nodes, and were looked at on a finer grid",
        ));
    }
    match &solution.verification {
        Some(found) => facts.extend(verification(found, problem)),
        None => facts.push(Fact::new(
            "re-integration",
            "none".into(),
            "this motion was not integrated again with the full equations; ffsm-ipopt verify does that",
        )),
    }
    for goal in &solution.goals {
        let gaps = [goal.distance.map(centimetres), goal.angle.map(degrees)];
        let gaps: Vec<String> = gaps.into_iter().flatten().collect();
        facts.push(Fact::new(
            &goal.key,
            format!("{} off at {} s", gaps.join(" and "), digits(goal.t, 3, 2)),
            "distance and angle between the end effector and its goal",
        ));
    }
    facts
}

fn verification(found: &Verification, problem: &Problem) -> Vec<Fact> {
    let turns = |joint: &crate::dynamics::Joint| joint.kind == JointKind::Revolute;
    let joints = if problem.robot.joints().iter().all(turns) {
        format!("{}°", gap(found.max_joint_drift.to_degrees()))
    } else {
        format!("{} rad or m", gap(found.max_joint_drift))
    };
    vec![
        Fact::new(
            "under its control",
            format!(
                "base within {}° and {} cm, joints within {joints}",
                gap(found.max_base_attitude_drift.to_degrees()),
                gap(100.0 * found.max_base_position_drift)
            ),
            "the full, unreduced equations of motion of base and arm, integrated by an adaptive \
             method that shares no code with the planner, under the planned control",
        ),
        Fact::new(
            "along the planned joint path",
            format!(
                "base within {}° and {} cm",
                gap(found.replay_base_attitude_drift.to_degrees()),
                gap(100.0 * found.replay_base_position_drift)
            ),
            "the same with the joints led along the plan, as a controller would",
        ),
        Fact::new(
            "momentum",
            format!(
                "off by at most {:.1e} kg m/s and {:.1e} kg m²/s",
                found.max_linear_momentum, found.max_angular_momentum
            ),
            "nothing pushes the system: its momentum stays what it was at the start",
        ),
        Fact::new(
            "energy",
            format!("off by at most {:.1e} J", found.max_energy_gap),
            "kinetic energy against the work of the joints",
        ),
    ]
}
