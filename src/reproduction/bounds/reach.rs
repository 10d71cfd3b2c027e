//! What a motion does reach: the least final attitude by optimal control from many starts.

use crate::nlp;
use crate::ocp::Interval;
use crate::planner::{Event, PlanError, Start};
use crate::problem::Problem;
use crate::refine::{self, Method, Refinement};
use crate::reproduction::{ReproductionError, Session};
use crate::system::{FreeFloating, through};
use crate::transcription::{Discretization, Patterns};

/// Starts through random way-points; loops come before them.
const RANDOM: usize = 30;
/// Weight on the control that keeps the problem regular without moving its optimum noticeably.
const REGULARIZATION: f64 = 1e-6;

/// The least final attitude that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Final base attitude, rad.
    pub final_attitude: f64,
    /// Largest magnitude of it on the way, rad.
    pub largest_attitude: f64,
    /// Largest error (28).
    pub max_error: f64,
    /// Starts tried, and how many of them ended at an optimum.
    pub starts: [usize; 2],
}

/// Minimises η(t_f)² under the limits of `problem` but for those on the base attitude, from many
/// starts. `None` where no start ended at an optimum, or where the motion is not planar.
///
/// # Errors
/// What the solver refuses, and [`ReproductionError::Interrupted`].
pub fn nearest_final_attitude(
    session: &mut Session<'_>,
    problem: &Problem,
) -> Result<Option<Reached>, ReproductionError> {
    let task = problem.edited(|task| {
        let cost = &mut task.cost;
        for weights in [
            &mut cost.final_base_position,
            &mut cost.base_rate,
            &mut cost.joint_rate,
        ] {
            weights.fill(0.0);
        }
        cost.final_base_attitude.fill(1.0);
        cost.control.fill(REGULARIZATION);
        task.limits.base_attitude.fill(Interval::FREE);
        task.limits.final_base_attitude.fill(Interval::FREE);
    })?;
    let Some(system) = FreeFloating::planar(&task) else {
        return Ok(None);
    };
    let settings = refine::Settings {
        method: Method::Adaptive,
        segments: 20,
        points: 5,
        max_iterations: Some(1),
        ..task.mesh.clone()
    };
    let solver = nlp::Settings {
        tolerance: 1e-7,
        max_iterations: 400,
        warm_start: None,
        ..task.solver.clone()
    };
    let patterns = Patterns::detect(&system);
    let refinement = Refinement {
        ocp: &system,
        patterns: &patterns,
        settings: &settings,
        solver: &solver,
    };
    let failed = |cause: PlanError| ReproductionError::Plan {
        title: "final attitude nearest to zero".into(),
        cause,
    };
    let mesh = settings
        .first_mesh()
        .map_err(|error| failed(error.into()))?;
    let paths = paths(&task);
    let mut best: Option<(f64, Discretization)> = None;
    let mut solved = 0;
    for (k, path) in paths.iter().enumerate() {
        session.begin(&format!(
            "final attitude nearest to zero, start {} of {}",
            k + 1,
            paths.len()
        ))?;
        let start = through(&task, &system, path.clone(), mesh.clone());
        let outcome = refinement
            .run(&start, &mut |event| session.show(&Event::Refinement(event)))
            .map_err(|error| failed(error.into()))?;
        if outcome.status == nlp::Status::Interrupted {
            return Err(ReproductionError::Interrupted);
        }
        if !outcome.status.is_solved() {
            continue;
        }
        solved += 1;
        let last = outcome.trajectory.state(outcome.trajectory.mesh.points())[0].abs();
        if best.as_ref().is_none_or(|(least, _)| last < *least) {
            best = Some((last, outcome.trajectory));
        }
    }
    let Some((_, trajectory)) = best else {
        return Ok(None);
    };
    // What was found on one coarse mesh is refined: between its nodes it need not be a motion.
    session.begin("final attitude nearest to zero, refined")?;
    let settings = refine::Settings {
        max_iterations: Some(5),
        tolerance: 1e-3,
        ..settings
    };
    let refinement = Refinement {
        settings: &settings,
        ..refinement
    };
    let start = Start {
        trajectory,
        iterate: None,
    };
    let outcome = refinement
        .run(&start, &mut |event| session.show(&Event::Refinement(event)))
        .map_err(|error| failed(error.into()))?;
    if outcome.status == nlp::Status::Interrupted {
        return Err(ReproductionError::Interrupted);
    }
    let attitudes: Vec<f64> = (0..=outcome.trajectory.mesh.points())
        .map(|k| outcome.trajectory.state(k)[0])
        .collect();
    Ok(Some(Reached {
        final_attitude: attitudes[attitudes.len() - 1],
        largest_attitude: attitudes.iter().fold(0.0, |m, eta| m.max(eta.abs())),
        max_error: outcome.max_error(),
        starts: [paths.len(), solved],
    }))
}

/// Way-points: none; one to three loops around each half of the joints' box in both senses, since
/// the curvature changes its sign within the whole; random ones.
fn paths(problem: &Problem) -> Vec<Vec<Vec<f64>>> {
    let limits = &problem.limits.joint_position;
    let at = |share: f64| -> Vec<f64> {
        let within = |b: &Interval| b.lower + share * (b.upper - b.lower);
        limits.iter().map(within).collect()
    };
    let corner = |a: f64, b: f64| vec![at(a)[0], at(b)[1]];
    let mut paths = vec![Vec::new()];
    let (whole, lower, upper) = ([0.02, 0.98], [0.02, 0.5], [0.5, 0.98]);
    for [a, b] in [
        [whole, lower],
        [whole, upper],
        [lower, whole],
        [upper, whole],
    ] {
        let mut round = vec![
            corner(a[0], b[0]),
            corner(a[1], b[0]),
            corner(a[1], b[1]),
            corner(a[0], b[1]),
        ];
        for _ in 0..2 {
            round.reverse();
            for rounds in 1..=3 {
                paths.push((0..rounds).flat_map(|_| round.clone()).collect());
            }
        }
    }
    let mut random = fastrand::Rng::with_seed(1);
    for k in 0..RANDOM {
        let mut point = |_| -> Vec<f64> {
            let mut within = |b: &Interval| b.lower + random.f64() * (b.upper - b.lower);
            limits.iter().map(&mut within).collect()
        };
        paths.push((0..1 + k % 5).map(&mut point).collect());
    }
    paths
}
