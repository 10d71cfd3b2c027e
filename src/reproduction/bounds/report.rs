//! The evidence together, and in words.

use super::{Reached, nearest_final_attitude};
use crate::config::ProblemFile;
use crate::ocp::Interval;
use crate::planner::floor::{Certainty, Connection, CurvatureBound, Grid};
use crate::planner::{Plan, Start};
use crate::reproduction::figures::{Case, Extremes};
use crate::reproduction::{ReproductionError, Session};
use crate::system::straight_line;
use serde::Serialize;

/// Angles and steps of the dynamic programme together, angles 1.5° apart over the paper's joint limits.
const WORK: f64 = 1e7;
/// Range of the smallest bound, rad, and its accuracy, a part of it.
const SOUGHT: [f64; 2] = [0.0, std::f64::consts::FRAC_PI_2];
const ACCURACY: f64 = 5e-4;
/// Cells of the grid the curvature is integrated on.
const CELLS: usize = 240;

/// Why `config/table1.toml` has no solution. Angles in degrees.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bounds {
    /// The published bound on the base attitude.
    pub published_bound: f64,
    /// Base attitude at the end of the straight joint path.
    pub straight_line: f64,
    /// Largest magnitude of the curvature over the joint limits; no unit.
    pub largest_curvature: f64,
    /// The joint angles where that is.
    pub largest_curvature_at: [f64; 2],
    /// Turn of the base by one loop around the joint limits.
    pub box_loop: f64,
    /// What one loop within the joint limits gains at most, in either sense.
    pub best_loops: [f64; 2],
    /// The final attitude nearest to zero by dynamic programming, without a bound along the path.
    pub nearest_final_by_grid: f64,
    /// The same with what may lie between the angles of the grid: no motion ends nearer.
    pub nearest_final_proven: f64,
    /// The smallest bound along the path and at t_f by dynamic programming.
    pub smallest_bound_by_grid: f64,
    /// The same with what may lie between the angles of the grid: no motion keeps a smaller one.
    pub smallest_bound_proven: f64,
    /// The final attitude nearest to zero by optimal control, without a bound along the path.
    pub nearest_final_by_control: Option<f64>,
    /// Largest error (28) of that motion.
    pub nearest_final_error: Option<f64>,
    /// Largest attitude on the way there.
    pub largest_on_the_way: Option<f64>,
    /// Starts of that search, and how many ended at an optimum.
    pub starts: [usize; 2],
    /// The smallest bound along the path and at t_f that the diagnosis found to work.
    pub smallest_bound_by_diagnosis: Option<f64>,
    /// Starts of the diagnosis, and how many ended at a feasible relaxation.
    pub diagnosis_starts: [usize; 2],
    /// The bound, somewhat wider, for which a motion was refined.
    pub bounded_at: f64,
    /// The largest attitude of that motion, between the nodes as well.
    pub bounded_largest: f64,
    /// Its largest error (28).
    pub bounded_error: f64,
}

/// The published case with both bounds on the base attitude widened to where a motion exists, at
/// least half a degree beyond what the diagnosis found, refined to an error of 1e-3.
///
/// A second check, on a mesh of its own: what the diagnosis found is a motion.
///
/// # Errors
/// Those of [`Session::plan`].
pub fn bounded(session: &mut Session<'_>) -> Result<(Case, Plan), ReproductionError> {
    let problem = ProblemFile::shipped("table1")?.problem;
    let published = session.plan("table1, as published", &problem, None)?.plan;
    let bound = smallest_bound(&published).map_or(90.0, |found| (found + 0.5).ceil());
    let problem = problem.edited(|problem| {
        let limits = &mut problem.limits;
        let bound = Interval::symmetric(bound.to_radians());
        limits.base_attitude.fill(bound);
        limits.final_base_attitude.fill(bound);
        let settings = &mut problem.mesh;
        (settings.segments, settings.points) = (40, 4);
        (settings.tolerance, settings.max_iterations) = (1e-3, Some(10));
    })?;
    let title = format!("table1, the base within ±{bound}°");
    let mesh = problem
        .mesh
        .first_mesh()
        .map_err(|error| ReproductionError::Plan {
            title: title.clone(),
            cause: error.into(),
        })?;
    let start = Start {
        trajectory: published.discretization.resample(mesh),
        iterate: None,
    };
    let plan = session.plan(&title, &problem, Some(&start))?.plan;
    Ok((Case::new("bounded", problem, plan), published))
}

/// The smallest bound that the diagnosis found to work, degrees.
fn smallest_bound(plan: &Plan) -> Option<f64> {
    let diagnosis = plan.diagnosis.as_ref()?;
    let bounds = diagnosis
        .limits
        .iter()
        .map(|limit| limit.smallest_bound.upper);
    Some(bounds.fold(0.0, f64::max).to_degrees())
}

/// Gathers the evidence; the bounded case comes with it.
///
/// # Errors
/// Those of [`Session::plan`].
pub fn bounds(session: &mut Session<'_>) -> Result<(Bounds, Case), ReproductionError> {
    let (case, published) = bounded(session)?;
    let problem = ProblemFile::shipped("table1")?.problem;
    let problem = &problem;
    session.begin("curvature of the momentum connection")?;
    let limits = &problem.limits.joint_position;
    let corner = |i: usize| [limits[0], limits[1]].map(|b| if i == 0 { b.lower } else { b.upper });
    let curvature = Connection::new(&problem.robot)
        .map(|connection| connection.over(corner(0), corner(1), CELLS));
    session.begin("dynamic programme over the joint angles")?;
    let grid = Grid::new(problem, WORK);
    let [by_grid, proven] = [Certainty::Estimate, Certainty::Bound].map(|certainty| {
        grid.as_ref()
            .map_or([f64::NAN; 2], |grid| least_turn(grid, certainty))
    });
    let reached = nearest_final_attitude(session, problem)?;
    let curvature = curvature.unwrap_or(CurvatureBound {
        largest: f64::NAN,
        at: [f64::NAN; 2],
        box_loop: f64::NAN,
        parts: [f64::NAN; 2],
    });
    let largest = Extremes::of(&case).map_or(f64::NAN, |found| found.largest_attitude);
    let last = case.iterations.last();
    let error = last.map_or(f64::NAN, |record| record.max_error);
    let evidence = Bounds {
        published_bound: problem.limits.final_base_attitude[0].upper.to_degrees(),
        straight_line: straight_line(problem).base_attitude[0].to_degrees(),
        largest_curvature: curvature.largest,
        largest_curvature_at: curvature.at.map(f64::to_degrees),
        box_loop: curvature.box_loop.to_degrees(),
        best_loops: curvature.parts.map(f64::to_degrees),
        nearest_final_by_grid: by_grid[0].to_degrees(),
        nearest_final_proven: proven[0].to_degrees(),
        smallest_bound_by_grid: by_grid[1].to_degrees(),
        smallest_bound_proven: proven[1].to_degrees(),
        nearest_final_by_control: reached
            .map(|Reached { final_attitude, .. }| final_attitude.to_degrees()),
        largest_on_the_way: reached.map(|reached| reached.largest_attitude.to_degrees()),
        starts: reached.map_or([0; 2], |reached| reached.starts),
        nearest_final_error: reached.map(|reached| reached.max_error),
        smallest_bound_by_diagnosis: smallest_bound(&published),
        diagnosis_starts: published
            .diagnosis
            .map_or([0; 2], |found| [found.starts.tried, found.starts.feasible]),
        bounded_at: case.problem.limits.base_attitude[0].upper.to_degrees(),
        bounded_largest: largest,
        bounded_error: error,
    };
    Ok((evidence, case))
}

/// The final attitude nearest to zero, and the smallest bound along the path and at t_f, rad.
fn least_turn(grid: &Grid, certainty: Certainty) -> [f64; 2] {
    let [low, high] = grid.reachable(f64::INFINITY, certainty);
    let nearest = if low <= 0.0 && high >= 0.0 {
        0.0
    } else if low.abs() < high.abs() {
        low
    } else {
        high
    };
    [nearest, grid.smallest_bound(SOUGHT, ACCURACY, certainty)]
}

/// The evidence in words.
pub fn markdown(found: &Bounds) -> String {
    let degrees = |value: f64| format!("{value:.1}°").replace('-', "−");
    let optional = |value: Option<f64>| value.map_or_else(|| "not found".into(), degrees);
    let needed = found.straight_line.abs() - found.published_bound;
    format!(
        "The published limits ask for a base attitude within ±{:.0}° along the path and at t_f = \
         20 s. No motion does that.\n\n\
         - Along the straight joint path the base turns by {}. Momentum is linear in the rates, so \
         that this does not depend on the speed. To end within the bound, a detour has to gain \
         {}.\n\
         - What a detour gains is the integral of the curvature of the momentum connection, \
         ∂A₂/∂θ₁ − ∂A₁/∂θ₂ with η̇ = A(θ)·θ̇, over the area it encloses. Over the joint limits its \
         magnitude is {:.4} at most, at θ = ({}, {}). A loop along the joint limits turns the base \
         by {}; the best loop within them gains {} in one sense and {} in the other. A loop along \
         the limits takes each joint 2π rad, one after the other, 14 s at 0.9 rad/s.\n\
         - Dynamic programming over the joint angles (1.5° apart, rates up to 0.9 rad/s, no limit on \
         acceleration) ends at {} without a bound along the path. With the bound along the path and \
         at t_f it needs ±{}. What may lie between its angles added, it is a proof that no motion \
         ends nearer than {} and none keeps less than ±{}.\n\
         - Optimal control with η(t_f)² as its cost, no bound along the path, from {} starts ({} \
         ended at an optimum), ends at {} at best, and passes through {} on the way (largest error \
         {}).\n\
         - The diagnosis of `plan`, which relaxes both bounds by the same least amount, finds ±{} \
         to work ({} starts, {} of them feasible), refined to the tolerance. With both bounds at \
         ±{:.0}° the plan from there, refined on other meshes, stays within {}, between the nodes as \
         well (largest error {:.1e}).\n",
        found.published_bound,
        degrees(found.straight_line),
        degrees(needed),
        found.largest_curvature,
        degrees(found.largest_curvature_at[0]),
        degrees(found.largest_curvature_at[1]),
        degrees(found.box_loop),
        degrees(found.best_loops[0]),
        degrees(found.best_loops[1]),
        degrees(found.nearest_final_by_grid),
        degrees(found.smallest_bound_by_grid),
        degrees(found.nearest_final_proven),
        degrees(found.smallest_bound_proven),
        found.starts[0],
        found.starts[1],
        optional(found.nearest_final_by_control),
        optional(found.largest_on_the_way),
        found
            .nearest_final_error
            .map_or_else(|| "–".into(), |error| format!("{error:.1e}")),
        optional(found.smallest_bound_by_diagnosis),
        found.diagnosis_starts[0],
        found.diagnosis_starts[1],
        found.bounded_at,
        degrees(found.bounded_largest),
        found.bounded_error,
    )
}
