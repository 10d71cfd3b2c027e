//! The law of structure: few points, since they stand where controls switch.

use crate::integrators::{Integrator, bryson_denham};
use crate::{fixed, refined, solve, states};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Formulation, Interval, Ocp, Point, Quantity};
use ffsm_ipopt::refine::{Law, Settings};

#[allow(dead_code)]
#[path = "../../examples/free_flying_robot.rs"]
mod free_flying_robot;

fn by_structure(settings: Settings) -> Settings {
    Settings {
        law: Law::Structure,
        ..settings
    }
}

/// Rest to rest over a distance of one with u from −1 to 7/10: t_f² = 2(1 + 10/7), and the switch is
/// at 10/17 of it.
#[test]
fn the_switch_of_a_minimum_time_motion_is_placed_by_the_solve() {
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 0.0,
        control: Interval::new(-1.0, 0.7),
        duration: Interval::new(0.5, 10.0),
        time_weight: 1.0,
        passed: vec![],
    };
    let outcome = solve(&problem, &by_structure(refined(10, 5, 1e-7, 6)));
    let optimum = (2.0 * (1.0 + 1.0 / 0.7_f64)).sqrt();
    assert!((outcome.objective - optimum).abs() < 1e-8);
    assert_eq!(outcome.records.len(), 2);
    assert!(outcome.converged && outcome.trajectory.mesh.points() <= 10);
    let switch = outcome.trajectory.mesh.breakpoints()[1];
    assert!((switch - 10.0 / 17.0).abs() < 1e-8, "{switch}");
    // The iterate is one of the mesh alone, so that it can be begun from.
    let (n, m) = (2, 1);
    let points = outcome.trajectory.mesh.points();
    assert_eq!(outcome.iterate.x.len(), points * (n + m) + n + 1);
    assert_eq!(outcome.iterate.multipliers.len(), points * n);
}

/// ½∫(x² + ẋ²) dt over 5 s with ẍ = u, |u| ≤ 1, from (0, 1): a bang arc, then a singular one along
/// x + ẋ = 0.
struct Singular;

impl Ocp for Singular {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        Formulation {
            states: states(&[("x", free), ("rate", free)]),
            controls: vec![Quantity::new("u", Interval::symmetric(1.0))],
            initial: fixed(&[0.0, 1.0]),
            terminal: vec![free; 2],
            duration: Interval::fixed(5.0),
            ..Formulation::default()
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.x[1];
        f[1] = p.u[0];
        (p.x[0].square() + p.x[1].square()) * 0.5
    }
}

/// The bang arc ends at 1.41376409 s, and the cost is 0.37699193.
#[test]
fn a_singular_arc_follows_a_bang_arc() {
    let outcome = solve(&Singular, &by_structure(refined(10, 5, 1e-6, 6)));
    assert!(
        (outcome.objective - 0.376_991_93).abs() < 2e-8,
        "J = {:.10}",
        outcome.objective
    );
    assert!(outcome.converged);
    let switch = 5.0 * outcome.trajectory.mesh.breakpoints()[1];
    assert!((switch - 1.413_764).abs() < 1e-3, "{switch}");
    assert!(outcome.trajectory.mesh.points() < 50);
}

/// Eight switches; jets 1 and 2, and 3 and 4, are on the bound of a row together.
#[test]
fn bang_off_bang_of_two_pairs_of_jets() {
    let robot = free_flying_robot::Robot;
    let outcome = solve(&robot, &by_structure(refined(10, 5, 1e-6, 6)));
    assert!(outcome.converged && outcome.records.len() <= 4);
    assert!(outcome.trajectory.mesh.points() <= 60);
    let gap = outcome.objective / 7.910_154 - 1.0;
    assert!(gap.abs() < 1e-6, "J = {:.8}", outcome.objective);
}

#[test]
fn without_a_switch_the_paper_s_law_goes_on() {
    let settings = refined(4, 3, 1e-6, 12);
    let paper = solve(&bryson_denham(0.2), &settings);
    let structure = solve(&bryson_denham(0.2), &by_structure(settings));
    assert_eq!(paper.trajectory, structure.trajectory);
}
