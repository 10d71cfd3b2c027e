//! Plans by the adaptive or the global Radau pseudospectral method.

mod base_rate;
mod bound_warnings;
pub(super) mod diagnosis;
mod retarget;

pub use base_rate::REGULARIZATION as BASE_RATE_REGULARIZATION;
pub(super) use base_rate::plan as plan_base_rate;

use super::{Event, Method, Plan, PlanError, Status, Timing};
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Nlp, ipopt};
use crate::ocp::Ocp;
use crate::problem::{EndEffectorGoal, Problem};
use crate::refine::{Outcome, Refinement, Start, midpoint_errors};
use crate::system::{
    FreeFloating, JointPath, Trajectory, along, gaps, metrics, rotation_rows, trajectory,
};
use crate::transcription::{Discretization, Patterns, Transcription};

use std::time::{Duration, Instant};

/// Barrier parameter a saved solution is taken up with.
const WARM_BARRIER: f64 = 1e-8;

/// Plans `problem` with a fresh [`Planner`].
///
/// # Errors
/// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
pub fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    Planner::new().plan(problem)
}

/// Plans problems one after another and keeps what they share.
///
/// Sparsity patterns are found once for each robot and set of limits; problems that differ in
/// task, weights' sizes or bounds' values alone reuse them.
#[derive(Debug, Default)]
pub struct Planner {
    patterns: Option<(Problem, Patterns)>,
}

impl Planner {
    /// A planner with nothing kept yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Plans `problem` from a straight joint path.
    ///
    /// # Errors
    /// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
    pub fn plan(&mut self, problem: &Problem) -> Result<Plan, PlanError> {
        self.plan_with(problem, None, &mut |_| Control::Continue)
    }

    /// Plans `problem` from `start`, telling `monitor` of every step.
    ///
    /// The start is led to the problem's own ends first. One with multipliers makes the first solve
    /// a warm one; they may be those of a problem with other rows on the same robot.
    ///
    /// # Errors
    /// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
    pub fn plan_with(
        &mut self,
        problem: &Problem,
        start: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Plan, PlanError> {
        let began = Instant::now();
        match FreeFloating::planar(problem) {
            Some(planar) => self.run(problem, &planar, start, monitor, began),
            None => self.run(
                problem,
                &FreeFloating::spatial(problem),
                start,
                monitor,
                began,
            ),
        }
    }

    fn run<Sp: Space>(
        &mut self,
        problem: &Problem,
        system: &FreeFloating<Sp>,
        start: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
        began: Instant,
    ) -> Result<Plan, PlanError> {
        let patterns = self.patterns(problem, system);
        let mut solver = problem.solver.clone();
        let start = match start {
            Some(given) => {
                check_start(given, system)?;
                if given.iterate.is_some() {
                    solver.warm_start.get_or_insert(WARM_BARRIER);
                }
                Start {
                    trajectory: retarget::retarget(&given.trajectory, problem),
                    iterate: given.iterate.clone(),
                }
            }
            None => {
                let path = JointPath::new(problem, &[]);
                let duration = problem.task.duration.center();
                let fractions = system.formulation().way_point_fractions();
                let mesh = problem.mesh.first_mesh()?.through(&fractions)?;
                Start {
                    trajectory: along(system, duration, &path, mesh),
                    iterate: None,
                }
            }
        };
        let refinement = Refinement {
            ocp: system,
            patterns,
            settings: &problem.mesh,
            solver: &solver,
        };
        let mut stopped = false;
        let mut outcome = refinement.run(&start, &mut |event| {
            let control = monitor(&Event::Refinement(event));
            stopped |= control == Control::Stop;
            control
        })?;
        let mut status = grade(&outcome, stopped);
        let mut finding = None;
        if status == Status::NotConverged && !outcome.status.is_solved() {
            let diagnosed = diagnosis::diagnose(problem, system, &outcome.trajectory, monitor)?;
            outcome.statistics.add(&diagnosed.statistics);
            if diagnosed.interrupted {
                status = Status::Interrupted;
            } else if let Some(found) = diagnosed.diagnosis {
                status = Status::Infeasible;
                outcome.trajectory = diagnosed.trajectory;
                outcome.objective = cost_of(system, patterns, &outcome.trajectory);
                finding = Some(found);
            } else if diagnosed.feasible {
                // A point within all limits exists: plan again from there.
                let again = Start {
                    trajectory: diagnosed.trajectory,
                    iterate: None,
                };
                let mut second = refinement.run(&again, &mut |event| {
                    let control = monitor(&Event::Refinement(event));
                    stopped |= control == Control::Stop;
                    control
                })?;
                second.records = [outcome.records, second.records].concat();
                second.statistics.add(&outcome.statistics);
                outcome = second;
                status = grade(&outcome, stopped);
            }
        }
        let max_error = if status == Status::Infeasible {
            midpoint_errors(system, &outcome.trajectory).max()
        } else {
            outcome.max_error()
        };
        let trajectory = trajectory(system, &outcome.trajectory);
        let exceeded = match status {
            Status::Infeasible => Vec::new(),
            _ => bound_warnings::warnings(problem, system, &outcome.violations),
        };
        let warnings = [
            near_singularity(&trajectory),
            ipopt::why_not_ours(&solver),
            fallback(&outcome.statistics),
        ];
        Ok(Plan {
            status,
            method: Method::Collocation(problem.mesh.method),
            objective: outcome.objective,
            tolerance: problem.mesh.tolerance,
            max_error,
            metrics: metrics(&trajectory),
            goals: gaps(system, &outcome.trajectory),
            timing: timing(&outcome.statistics, began.elapsed()),
            iterations: outcome.records,
            discretization: outcome.trajectory,
            iterate: outcome.iterate,
            trajectory,
            diagnosis: finding,
            warnings: warnings.into_iter().flatten().chain(exceeded).collect(),
            linear_solver: linear_solver(&solver, &outcome.statistics),
        })
    }

    /// Sparsity of `problem`, found anew only where the robot or the shape of the problem differ
    /// from the last one's.
    fn patterns<Sp: Space>(&mut self, problem: &Problem, system: &FreeFloating<Sp>) -> &Patterns {
        let known = self
            .patterns
            .as_ref()
            .is_some_and(|(last, _)| same_shape(last, problem));
        if !known {
            self.patterns = Some((problem.clone(), Patterns::detect(system)));
        }
        &self.patterns.as_ref().expect("just set").1
    }
}

/// Whether two problems have the same derivatives nonzero.
fn same_shape(a: &Problem, b: &Problem) -> bool {
    let zero = |w: &[f64]| w.iter().map(|w| *w == 0.0).collect::<Vec<_>>();
    let weights = |p: &Problem| {
        let c = &p.cost;
        [
            &c.final_base_attitude,
            &c.final_base_position,
            &c.base_rate,
            &c.joint_rate,
            &c.control,
            &c.torque,
        ]
        .map(|w| zero(w))
    };
    let limited = |p: &Problem| {
        [&p.limits.base_rate, &p.limits.torque].map(|b| b.iter().any(|b| !b.is_free()))
    };
    let passed = |p: &Problem| -> Vec<Option<EndEffectorGoal>> {
        let points = p.task.way_points.iter();
        points.map(|point| point.end_effector.clone()).collect()
    };
    a.robot == b.robot
        && a.attitude == b.attitude
        && rotation_rows(a) == rotation_rows(b)
        && weights(a) == weights(b)
        && a.cost.rate_matrix == b.cost.rate_matrix
        && (a.cost.duration == 0.0) == (b.cost.duration == 0.0)
        && a.task.end_effector == b.task.end_effector
        && passed(a) == passed(b)
        && a.task.initial_momentum == b.task.initial_momentum
        && a.limits.keep_out == b.limits.keep_out
        && limited(a) == limited(b)
        && a.task.duration.is_fixed() == b.task.duration.is_fixed()
}

/// The linear solver behind a plan.
fn linear_solver(settings: &nlp::Settings, statistics: &nlp::Statistics) -> String {
    let mut name = ipopt::linear_solver(settings);
    if statistics.fallbacks > 0 {
        name.push_str(", mumps");
    }
    name
}

/// A word where MUMPS had to stand in for our own linear solver.
fn fallback(statistics: &nlp::Statistics) -> Option<String> {
    (statistics.fallbacks > 0).then(|| {
        format!(
            "our linear solver could not serve {} of the solves; MUMPS took them over",
            statistics.fallbacks
        )
    })
}

/// Cost (25) of a trajectory that no solve of the problem itself ended at.
fn cost_of<Sp: Space>(
    system: &FreeFloating<Sp>,
    patterns: &Patterns,
    trajectory: &Discretization,
) -> f64 {
    let mut program = Transcription::new(system, patterns, trajectory.mesh.clone());
    let x = program.pack(trajectory);
    program.objective(&x).unwrap_or(f64::NAN)
}

/// Base pitch beyond which roll-pitch-yaw rates are more than ten times the base's own, rad.
const STEEP: f64 = 1.47;
/// Length of modified Rodrigues parameters beyond which their rates are more than ten times those
/// of a base that has not turned; 286°.
const LONG: f64 = 3.0;

/// A word about the description of the attitude where the base comes close to its singularity.
fn near_singularity(trajectory: &Trajectory) -> Option<String> {
    let most = |size: fn(&[f64]) -> f64| {
        let rows = trajectory.base_attitude.iter();
        rows.map(|eta| size(eta)).fold(0.0, f64::max)
    };
    match trajectory.attitude? {
        SpatialAttitude::RollPitchYaw => {
            let steepest = most(|eta| eta[1].abs());
            (steepest > STEEP).then(|| {
                format!(
                    "the base pitches to {:.1}°, and roll-pitch-yaw is singular at 90°: roll and \
                     yaw there are not to be relied on, nor may a failure to converge say \
                     anything about the task; plan with base.attitude = \"quaternion\" or \"mrp\"",
                    steepest.to_degrees()
                )
            })
        }
        SpatialAttitude::Quaternion => None,
        SpatialAttitude::Mrp => {
            let longest = most(|eta| eta.iter().map(|s| s * s).sum::<f64>().sqrt());
            (longest > LONG).then(|| {
                format!(
                    "the base turns by {:.1}°, and modified Rodrigues parameters are singular at \
                     360°: a failure to converge may say nothing about the task; plan with \
                     base.attitude = \"quaternion\"",
                    (4.0 * longest.atan()).to_degrees()
                )
            })
        }
    }
}

fn check_start<Sp: Space>(start: &Start, system: &FreeFloating<Sp>) -> Result<(), PlanError> {
    let joints = system.joint_count();
    let expected = system.attitude().count() + 2 * joints;
    let (found, controls) = (start.trajectory.states, start.trajectory.controls);
    if (found, controls) == (expected, joints) {
        Ok(())
    } else {
        Err(PlanError::Start {
            found,
            controls,
            expected,
            joints,
        })
    }
}

fn grade(outcome: &Outcome, stopped: bool) -> Status {
    if stopped || outcome.status == nlp::Status::Interrupted {
        Status::Interrupted
    } else if outcome.converged {
        Status::Solved
    } else {
        Status::NotConverged
    }
}

fn timing(statistics: &nlp::Statistics, total: Duration) -> Timing {
    let known = statistics.derivatives + statistics.linear_solver;
    Timing {
        setup: total.saturating_sub(statistics.total),
        derivatives: statistics.derivatives,
        linear_solver: statistics.linear_solver,
        ipopt_other: statistics.total.saturating_sub(known),
        total,
    }
}
