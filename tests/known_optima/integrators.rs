//! Double integrators, with and without a bound on the position.

use crate::{fixed, refined, solve, states};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{Ends, Formulation, InteriorPoint, Interval, Ocp, Point, Quantity, WayPoint};
use ffsm_ipopt::refine::{Bounded, CutShort, Event, Record, Refinement, Verdict};
use ffsm_ipopt::transcription::Patterns;
use std::time::Duration;

/// ẍ = u from `initial` to `terminal`, with the running cost `weight`·u².
pub struct Integrator {
    pub initial: [f64; 2],
    pub terminal: [f64; 2],
    pub position: Interval,
    pub weight: f64,
    pub control: Interval,
    pub duration: Interval,
    /// Minimise the duration as well.
    pub time_weight: f64,
    /// Fraction of the duration, bounds of the position and of the rate there.
    pub passed: Vec<(f64, [Interval; 2])>,
}

impl Ocp for Integrator {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: states(&[("position", self.position), ("rate", Interval::FREE)]),
            controls: vec![Quantity::new("force", self.control)],
            path: vec![],
            boundary: vec![],
            way_points: self.passed.iter().map(integrator_passed).collect(),
            initial: fixed(&self.initial),
            terminal: fixed(&self.terminal),
            duration: self.duration,
            ..Formulation::default()
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        rates[0] = p.x[1];
        rates[1] = p.u[0];
        p.u[0].square() * self.weight
    }

    fn way_point<S: Scalar>(&self, point: InteriorPoint<'_, S>, _: &mut (), rows: &mut [S]) {
        rows[0] = point.x[0] * 2.0;
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration * self.time_weight
    }
}

/// The rate is bounded as a state, the position by a row of twice its value.
pub fn integrator_passed(&(fraction, [position, rate]): &(f64, [Interval; 2])) -> WayPoint {
    let twice = Interval::new(2.0 * position.lower, 2.0 * position.upper);
    WayPoint {
        fraction,
        states: vec![Interval::FREE, rate],
        rows: vec![Quantity::new("twice the position", twice)],
    }
}

pub fn bryson_denham(limit: f64) -> Integrator {
    Integrator {
        initial: [0.0, 1.0],
        terminal: [0.0, -1.0],
        position: Interval::new(f64::NEG_INFINITY, limit),
        weight: 0.5,
        control: Interval::FREE,
        duration: Interval::fixed(1.0),
        time_weight: 0.0,
        passed: vec![],
    }
}

#[test]
fn bryson_denham_meets_4_over_9l() {
    for (limit, optimum) in [(1.0 / 9.0, 4.0), (0.1, 4.444444)] {
        let outcome = solve(&bryson_denham(limit), &refined(10, 5, 1e-8, 12));
        let gap = outcome.objective - optimum;
        assert!(gap.abs() < 2e-6, "L = {limit}: J = {}", outcome.objective);
    }
}

#[test]
fn bryson_denham_is_exact_when_breakpoints_stand_at_the_junctions() {
    // The optimal control is linear on [0, 3L], zero in between and linear again: with L = 1/9
    // and three equal segments polynomials of degree 3 hold the solution exactly.
    let problem = bryson_denham(1.0 / 9.0);
    let outcome = solve(&problem, &refined(3, 4, 1e-9, 1));
    // Ipopt relaxes bounds by 1e-8, and dJ/dL = −4/(9L²) = −36.
    assert!(
        (outcome.objective - 4.0).abs() < 4e-7,
        "J = {}",
        outcome.objective
    );
}

#[test]
fn bounds_exceeded_between_the_points_are_refined_away() {
    let limit = 0.1;
    // The error estimate is content with anything.
    let coarse = solve(&bryson_denham(limit), &refined(4, 3, 1e3, 1));
    let [found] = &coarse.violations[..] else {
        panic!("{:?}", coarse.violations);
    };
    assert_eq!(found.what, Bounded::State(0));
    assert!((found.value - limit - found.excess).abs() < 1e-15);
    assert!((found.relative - found.excess / limit).abs() < 1e-15);
    assert_eq!(coarse.records[0].max_violation, found.relative);
    let (mut x, mut u) = ([0.0; 2], [0.0]);
    coarse.trajectory.at_fraction(found.t, &mut x, &mut u);
    assert!((x[0] - found.value).abs() < 1e-12);

    let fine = solve(&bryson_denham(limit), &refined(4, 3, 1e3, 20));
    assert!(fine.violations.is_empty(), "{:?}", fine.violations);
    let highest = (0..=10_000).fold(0.0_f64, |highest, k| {
        let fraction = f64::from(k) / 10_000.0;
        fine.trajectory.at_fraction(fraction, &mut x, &mut u);
        highest.max(x[0])
    });
    assert!(highest < limit * (1.0 + 1.2e-3), "{highest}");
    // A node stands where the first mesh was outside the farthest.
    assert!(fine.records[1].breakpoints.contains(&found.t));
}

#[test]
fn a_mesh_for_the_sake_of_bounds_that_fails_is_put_aside_with_its_record() {
    let problem = bryson_denham(0.1);
    let settings = refined(4, 3, 1e3, 20);
    let full = solve(&problem, &settings);
    let converged = |record: &Record| record.verdict.is_converged();
    let count = full.records.iter().position(converged).unwrap() + 1;
    assert!(count < full.records.len());
    // The same, stopped on the mesh after the first that counts.
    let patterns = Patterns::detect(&problem);
    let refinement = Refinement {
        ocp: &problem,
        patterns: &patterns,
        settings: &settings,
        solver: &nlp::Settings::default(),
    };
    let start = refinement.straight_start().unwrap();
    let outcome = refinement.run(&start, &mut |event| match event {
        Event::Mesh { iteration, .. } if iteration > count => Control::Stop,
        _ => Control::Continue,
    });
    let outcome = outcome.unwrap();
    assert!(outcome.converged && outcome.status.is_solved());
    assert_eq!(outcome.records.len(), count);
    let last = outcome.records.last().unwrap();
    assert_eq!(last.points, outcome.trajectory.mesh.points());
    assert_eq!(last.objective, outcome.objective);
    let [aside] = &outcome.discarded[..] else {
        panic!("{:?}", outcome.discarded)
    };
    let interrupted = Verdict::NotSolved(nlp::Status::Interrupted);
    assert_eq!(aside.verdict, interrupted);
    assert!(aside.points > last.points);
    // Its iterations are among those of all solves.
    let all = outcome.records.iter().chain(&outcome.discarded);
    let iterations: u32 = all.map(|record| record.nlp_iterations).sum();
    assert_eq!(outcome.statistics.iterations, iterations);
}

#[test]
fn the_last_mesh_that_was_solved_counts_where_a_later_one_is_cut_short() {
    let problem = bryson_denham(0.1);
    let settings = refined(4, 3, 1e-8, 20);
    let patterns = Patterns::detect(&problem);
    let mut solver = nlp::Settings::default();
    let stopped_on = |solver: &nlp::Settings, mesh: usize| {
        let refinement = Refinement {
            ocp: &problem,
            patterns: &patterns,
            settings: &settings,
            solver,
        };
        let start = refinement.straight_start().unwrap();
        let outcome = refinement.run(&start, &mut |event| match event {
            Event::Mesh { iteration, .. } if iteration == mesh => Control::Stop,
            _ => Control::Continue,
        });
        outcome.unwrap()
    };
    let outcome = stopped_on(&solver, 2);
    assert_eq!(outcome.cut_short, Some(CutShort::Interrupted));
    assert!(!outcome.converged && outcome.status.is_solved());
    assert_eq!((outcome.records.len(), outcome.discarded.len()), (1, 1));
    assert_eq!(outcome.trajectory.mesh.points(), outcome.records[0].points);
    // Nothing was solved before: the last iterate.
    let outcome = stopped_on(&solver, 1);
    assert_eq!(outcome.status, nlp::Status::Interrupted);
    assert_eq!(outcome.cut_short, Some(CutShort::Interrupted));
    solver.time_limit = Some(Duration::from_nanos(1));
    let outcome = stopped_on(&solver, 0);
    assert_eq!(outcome.status, nlp::Status::TimeLimit);
    assert_eq!(outcome.cut_short, Some(CutShort::OutOfTime));
}

#[test]
fn double_integrator_is_exact_on_one_segment() {
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 1.0,
        control: Interval::FREE,
        duration: Interval::fixed(1.0),
        time_weight: 0.0,
        passed: vec![],
    };
    // The optimal position is a cubic: four points hold it exactly.
    let outcome = solve(&problem, &refined(1, 4, 1e-10, 1));
    assert!(
        (outcome.objective - 12.0).abs() < 1e-9,
        "J = {}",
        outcome.objective
    );
    assert!(outcome.max_error() < 1e-10);
}

/// Rest to rest over a distance of one in the least time; the control switches halfway, at 1 s.
fn minimum_time() -> Integrator {
    Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 0.0,
        control: Interval::symmetric(1.0),
        duration: Interval::new(0.5, 10.0),
        time_weight: 1.0,
        passed: vec![],
    }
}

#[test]
fn minimum_time_double_integrator_takes_two_seconds() {
    // A breakpoint at the switch makes it exact.
    let outcome = solve(&minimum_time(), &refined(2, 4, 1e-7, 1));
    assert!(
        (outcome.objective - 2.0).abs() < 1e-6,
        "t_f = {}",
        outcome.objective
    );
    assert!((outcome.trajectory.duration - outcome.objective).abs() < 1e-12);
    assert_eq!(outcome.records[0].verdict, Verdict::Converged);
}

#[test]
fn a_control_that_overshoots_its_bound_between_the_points_is_seen() {
    // The switch stands inside the middle one of three segments, and the error estimate is content
    // with anything.
    let coarse = solve(&minimum_time(), &refined(3, 5, 1e3, 1));
    let [found] = &coarse.violations[..] else {
        panic!("{:?}", coarse.violations);
    };
    assert_eq!(found.what, Bounded::Control(0));
    assert!(found.relative > 0.1 && found.lasts > 1e-3 * 2.0);
    let (mut x, mut u) = ([0.0; 2], [0.0]);
    let fraction = found.t / coarse.trajectory.duration;
    coarse.trajectory.at_fraction(fraction, &mut x, &mut u);
    assert!((u[0] - found.value).abs() < 1e-12);
    assert!(!coarse.converged);
    assert_eq!(coarse.records[0].verdict, Verdict::BoundExceeded);

    let fine = solve(&minimum_time(), &refined(3, 5, 1e3, 20));
    assert!(fine.converged && fine.records.len() > 1);
    let outside = (0..=100_000).filter(|&k| {
        fine.trajectory
            .at_fraction(f64::from(k) / 100_000.0, &mut x, &mut u);
        u[0].abs() > 1.1
    });
    // One segment holds the switch, and it may be outside for a thousandth of the duration.
    assert!(outside.count() < 150);
    match &fine.violations[..] {
        [] => assert_eq!(fine.records.last().unwrap().verdict, Verdict::Converged),
        [left] if left.relative > 0.1 => {
            assert_eq!(fine.records.last().unwrap().verdict, Verdict::Overshoots);
        }
        _ => {}
    }
}
