//! Problems with way-points.

use crate::hypersensitive::{Hypersensitive, hypersensitive_optimum};
use crate::integrators::{Integrator, bryson_denham};
use crate::{refined, solve};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Formulation, Interval, Ocp, Point, WayPoint};
use ffsm_ipopt::refine::{Method, Settings};

/// ∫u² of the cubic from (x₀, v₀) to (x₁, v₁) in `t`.
fn cubic_effort(t: f64, [x0, v0]: [f64; 2], [x1, v1]: [f64; 2]) -> f64 {
    let d = x1 - x0;
    12.0 * d * d / t.powi(3) - 12.0 * d * (v0 + v1) / (t * t)
        + 4.0 * (v0 * v0 + v0 * v1 + v1 * v1) / t
}

#[test]
fn double_integrator_through_way_points_is_a_cubic_spline() {
    // From rest at 0 to rest at 1 in 2 s, through 0.9 at a third and 0.2, at the rate 0.4, at 0.7
    // of it: the rate at the first is free, so that the spline is smooth there.
    let (t, at) = (2.0, [1.0 / 3.0, 0.7]);
    let effort = |v: f64| {
        let (a, b) = ([0.9, v], [0.2, 0.4]);
        cubic_effort(at[0] * t, [0.0, 0.0], a)
            + cubic_effort((at[1] - at[0]) * t, a, b)
            + cubic_effort((1.0 - at[1]) * t, b, [1.0, 0.0])
    };
    // A parabola in v.
    let (low, mid, high) = (effort(-1.0), effort(0.0), effort(1.0));
    let v = 0.5 * (low - high) / (low - 2.0 * mid + high);
    let optimum = effort(v);
    let mut problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 1.0,
        control: Interval::FREE,
        duration: Interval::fixed(t),
        time_weight: 0.0,
        passed: vec![
            (at[0], [Interval::fixed(0.9), Interval::FREE]),
            (at[1], [Interval::fixed(0.2), Interval::fixed(0.4)]),
        ],
    };
    // Cubics in two segments, one of which the way-points cut in three.
    let outcome = solve(&problem, &refined(2, 4, 1e-10, 1));
    let gap = outcome.objective - optimum;
    assert!(
        gap.abs() < 1e-9 * optimum,
        "J = {}, {optimum}",
        outcome.objective
    );
    assert!(outcome.max_error() < 1e-9);
    let mesh = &outcome.trajectory.mesh;
    let node = mesh.node_at(at[0]).expect("a breakpoint at the way-point");
    let state = outcome.trajectory.state(node);
    assert!(
        (state[0] - 0.9).abs() < 1e-9 && (state[1] - v).abs() < 1e-9,
        "{state:?}"
    );
    // One polynomial a leg does as well.
    let global = Settings {
        method: Method::Global,
        global_points: 4,
        ..Settings::default()
    };
    let outcome = solve(&problem, &global);
    assert_eq!(outcome.trajectory.mesh.segments(), 3);
    assert!((outcome.objective - optimum).abs() < 1e-9 * optimum);
    // Without the way-points the effort is that of one cubic.
    problem.passed.clear();
    let outcome = solve(&problem, &refined(2, 4, 1e-10, 1));
    assert!((outcome.objective - cubic_effort(t, [0.0, 0.0], [1.0, 0.0])).abs() < 1e-9);
}

#[test]
fn bryson_denham_with_one_contact_needs_its_limit_there_only() {
    // For 1/6 ≤ L ≤ 1/4 the path touches L at half time, J = 2 + 6(1 − 4L)²: the same as with the
    // limit at that instant alone.
    let limit = 0.2;
    let mut problem = bryson_denham(f64::INFINITY);
    problem.passed = vec![(
        0.5,
        [Interval::new(f64::NEG_INFINITY, limit), Interval::FREE],
    )];
    let outcome = solve(&problem, &refined(3, 4, 1e-10, 1));
    let optimum = 2.0 + 6.0 * (1.0 - 4.0 * limit).powi(2);
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "J = {}",
        outcome.objective
    );
    // Without the limit: J = 2.
    let free = solve(&bryson_denham(f64::INFINITY), &refined(3, 4, 1e-10, 1));
    assert!((free.objective - 2.0).abs() < 1e-9);
}

#[test]
fn the_fastest_way_with_a_stop_at_half_time_is_two_fastest_ways() {
    let free = Interval::FREE;
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: free,
        weight: 0.0,
        control: Interval::symmetric(1.0),
        duration: Interval::new(0.5, 10.0),
        time_weight: 1.0,
        passed: vec![(0.5, [free, Interval::fixed(0.0)])],
    };
    // Rest to rest over 1/2 takes 2√(1/2), twice. Four segments have breakpoints at the switches.
    let outcome = solve(&problem, &refined(4, 4, 1e-9, 1));
    let optimum = 2.0 * 2f64.sqrt();
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "t_f = {}",
        outcome.objective
    );
}

#[test]
fn way_points_keep_their_breakpoints_and_multipliers_from_mesh_to_mesh() {
    /// Hypersensitive, through 1 at 0.37 of the duration.
    struct Through(Hypersensitive);
    impl Ocp for Through {
        type Scratch<S: Scalar> = ();
        fn formulation(&self) -> Formulation {
            let through = WayPoint {
                fraction: 0.37,
                states: vec![Interval::fixed(1.0)],
                rows: vec![],
            };
            Formulation {
                way_points: vec![through],
                ..self.0.formulation()
            }
        }
        fn scratch<S: Scalar>(&self) {}
        fn continuous<S: Scalar>(
            &self,
            p: Point<'_, S>,
            scratch: &mut (),
            rates: &mut [S],
            path: &mut [S],
        ) -> S {
            self.0.continuous(p, scratch, rates, path)
        }
    }
    let ends = [1.5, 1.0];
    let duration = 100.0;
    let outcome = solve(
        &Through(Hypersensitive { ends, duration }),
        &refined(10, 5, 1e-7, 12),
    );
    // Both legs are long: the optimum is that of two problems that meet at 1.
    let optimum = hypersensitive_optimum([1.5, 1.0]) + hypersensitive_optimum([1.0, 1.0]);
    assert!(
        (outcome.objective - optimum).abs() < 1e-8,
        "J = {}",
        outcome.objective
    );
    assert!(outcome.records.len() > 2);
    for record in &outcome.records {
        assert!(record.breakpoints.contains(&0.37));
    }
    let last = outcome.records.last().unwrap();
    assert!(last.nlp_iterations <= 8, "{}", last.nlp_iterations);
}
