//! A plan as `solution.json` has it.

use super::Provenance;
use super::schema::*;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::{Joint, JointKind};
use crate::ocp::Interval;
use crate::planner::{self, Plan};
use crate::problem::{Problem, Unit};
use crate::refine::Record;
use crate::study::search::Optima;
use crate::{nlp, study, system, verify};

/// What the components of `trajectory` are told in.
const FRAMES: &str = "base_attitude turns base axes, those of the robot's root link, into inertial axes; \
    base_position is the root link's origin from the system's mass centre at the start, inertial axes";

/// The solution file of `plan` for `problem`.
pub fn solution(problem: &Problem, plan: &Plan, provenance: Provenance) -> Solution {
    let mesh = &plan.discretization.mesh;
    Solution {
        schema: 1,
        name: problem.name.clone(),
        status: plan.status,
        method: plan.method.name().into(),
        objective: plan.objective,
        cost_terms: cost_terms(
            &plan.cost_terms,
            plan.trajectory.attitude.is_some_and(|by| !by.is_angles()),
        ),
        tolerance: plan.tolerance,
        max_error: plan.max_error,
        points: mesh.points(),
        segments: mesh.segments(),
        iterations: plan.iterations.iter().map(iteration).collect(),
        mesh: Mesh {
            breakpoints: mesh.breakpoints().to_vec(),
            points_per_segment: mesh.points_per_segment(),
        },
        joints: problem.robot.joints().iter().map(joint).collect(),
        frames: FRAMES.into(),
        trajectory: trajectory(&plan.trajectory),
        metrics: metrics(&plan.metrics),
        goals: goals(&plan.goals),
        search: None,
        verification: plan.verification.as_ref().map(verification),
        diagnosis: plan.diagnosis.as_ref().map(diagnosis),
        warnings: plan.warnings.clone(),
        timing: timing(&plan.timing),
        provenance,
        iterate: iterate(&plan.iterate),
    }
}

fn joint(joint: &Joint) -> JointColumn {
    let kind = joint.kind;
    JointColumn {
        name: joint.name.clone(),
        kind: match kind {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
        }
        .into(),
        position: Unit::position(kind).symbol().into(),
        velocity: Unit::rate(kind).symbol().into(),
        control: Unit::acceleration(kind).symbol().into(),
        torque: Unit::effort(kind).symbol().into(),
    }
}

/// What a search found.
pub fn search(optima: &Optima) -> Search {
    let optimum = |found: &study::search::Optimum| Optimum {
        objective: found.objective,
        max_base_attitude: found.max_base_attitude,
        final_base_attitude: found.final_base_attitude,
        hits: found.hits,
        start: found.start,
        kind: found.kind,
        status: found.status,
    };
    Search {
        seed: optima.seed,
        tried: optima.tried,
        solved: optima.solved,
        optima: optima.found.iter().map(optimum).collect(),
        lower_bounds: optima.bounds.map(|bounds| LowerBounds {
            max_base_attitude: bounds.max_base_attitude,
            final_base_attitude: bounds.final_base_attitude,
        }),
    }
}

/// The terms of the cost; the blocks of the matrix Λ as one. `rotation` where the attitude is
/// measured by the rotation angle.
pub(super) fn cost_terms(terms: &system::CostTerms, rotation: bool) -> Vec<CostTerm> {
    let mut found: Vec<CostTerm> = Vec::new();
    for term in &terms.terms {
        let key = term.id.key();
        match found.iter_mut().find(|known| known.key == key) {
            Some(known) => known.value += term.value,
            None => found.push(CostTerm {
                key: key.into(),
                formula: term.id.formula(rotation).into(),
                value: term.value,
            }),
        }
    }
    found
}

fn iteration(record: &Record) -> Iteration {
    Iteration {
        points: record.points,
        segments: record.segments,
        max_error: record.max_error,
        quadrature_error: record.quadrature_error,
        max_violation: record.max_violation,
        objective: record.objective,
        objective_error: record.objective_error,
        nlp_iterations: record.nlp_iterations,
        nlp_status: record.nlp_status.describe().into(),
        seconds: record.time.as_secs_f64(),
    }
}

pub(super) fn trajectory(planned: &system::Trajectory) -> Trajectory {
    let system::Trajectory {
        t,
        attitude,
        base_attitude,
        base_position,
        base_rate,
        joint_position,
        joint_velocity,
        control,
        joint_torque,
    } = planned.clone();
    Trajectory {
        t,
        attitude: attitude.map_or("angle", SpatialAttitude::name).into(),
        base_attitude,
        base_position,
        base_rate,
        joint_position,
        joint_velocity,
        control,
        joint_torque,
    }
}

pub(super) fn metrics(found: &system::Metrics) -> Metrics {
    Metrics {
        max_base_attitude: found.max_base_attitude,
        final_base_attitude: found.final_base_attitude,
        max_base_displacement: found.max_base_displacement,
        final_base_displacement: found.final_base_displacement,
        peak_joint_velocity: found.peak_joint_velocity,
        peak_joint_torque: found.peak_joint_torque,
    }
}

pub(super) fn goals(found: &[system::GoalError]) -> Vec<Goal> {
    let goal = |found: &system::GoalError| Goal {
        key: found.key.clone(),
        t: found.t,
        distance: found.distance,
        angle: found.angle,
    };
    found.iter().map(goal).collect()
}

pub(crate) fn verification(found: &verify::Verification) -> Verification {
    Verification {
        max_base_attitude_drift: found.max_base_attitude_drift,
        max_base_position_drift: found.max_base_position_drift,
        max_joint_drift: found.max_joint_drift,
        replay_base_attitude_drift: found.replay_base_attitude_drift,
        replay_base_position_drift: found.replay_base_position_drift,
        max_linear_momentum: found.max_linear_momentum,
        max_angular_momentum: found.max_angular_momentum,
        max_energy_gap: found.max_energy_gap,
        steps: found.steps,
    }
}

fn diagnosis(found: &planner::Diagnosis) -> Diagnosis {
    let planner::StartCounts { tried, feasible } = found.starts;
    let limit = |limit: &planner::LimitFinding| LimitFinding {
        key: limit.limit.key().into_owned(),
        component: limit.name.clone(),
        bound: bounds(&limit.bound),
        unit: limit.unit.symbol().into(),
        excess: limit.excess,
        smallest_bound: bounds(&limit.smallest_bound),
        floor: limit.floor,
    };
    Diagnosis {
        summary: found.summary.clone(),
        limits: found.limits.iter().map(limit).collect(),
        starts: tried,
        feasible_starts: feasible,
    }
}

fn bounds(interval: &Interval) -> [Option<f64>; 2] {
    [interval.lower, interval.upper].map(|bound| bound.is_finite().then_some(bound))
}

pub(crate) fn timing(spent: &planner::Timing) -> Timing {
    Timing {
        setup: spent.setup.as_secs_f64(),
        derivatives: spent.derivatives.as_secs_f64(),
        linear_solver: spent.linear_solver.as_secs_f64(),
        ipopt_other: spent.ipopt_other.as_secs_f64(),
        total: spent.total.as_secs_f64(),
    }
}

/// The iterate, unless it has values that nothing can start from.
fn iterate(last: &nlp::Iterate) -> Option<Iterate> {
    let nlp::Iterate {
        x,
        multipliers,
        lower_multipliers,
        upper_multipliers,
    } = last;
    let finite = |values: &Vec<f64>| values.iter().all(|value| value.is_finite());
    let usable = !x.is_empty()
        && [x, multipliers, lower_multipliers, upper_multipliers]
            .into_iter()
            .all(finite);
    usable.then(|| Iterate {
        x: x.clone(),
        multipliers: multipliers.clone(),
        lower_multipliers: lower_multipliers.clone(),
        upper_multipliers: upper_multipliers.clone(),
    })
}
