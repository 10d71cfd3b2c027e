//! Conditions at the end that follow from the others.

use crate::tasks::{Slew, Vessels};
use ffsm_ipopt::nlp::LinearSolver;
use ffsm_ipopt::ocp::{self, Interval, Ocp};
use ffsm_ipopt::refine::Outcome;

fn solve<O: Ocp>(problem: &O, segments: usize, solver: LinearSolver) -> Outcome {
    let mut settings = ocp::Settings::default();
    settings.mesh.segments = segments;
    settings.mesh.points = 4;
    settings.mesh.max_iterations = Some(1);
    settings.solver.linear_solver = solver;
    ocp::solve(problem, &settings).unwrap()
}

/// All four components of a quaternion at both ends: on a coarse mesh the fourth is a condition on the
/// error of the mesh, on a fine one it is none.
#[test]
fn a_quaternion_fixed_at_both_ends_is_planned_as_with_three_components() {
    for (angle, torque, segments) in [(2.6, 0.2, 6), (2.6, 0.2, 20), (1.0, f64::INFINITY, 6)] {
        let all = Slew::new(angle, torque);
        let mut three = Slew::new(angle, torque);
        three.fixed[0] = false;
        let of = solve(&three, segments, LinearSolver::Multifrontal);
        assert!(of.status.is_solved(), "{angle}: {:?}", of.status);
        assert_eq!(of.released, []);
        for solver in [LinearSolver::Multifrontal, LinearSolver::Mumps] {
            let found = solve(&all, segments, solver);
            assert!(found.status.is_solved(), "{:?}", found.status);
            assert!(
                (found.objective / of.objective - 1.0).abs() < 1e-4,
                "{} is not {}",
                found.objective,
                of.objective
            );
            assert!(found.statistics.iterations <= of.statistics.iterations + 10);
            let [released] = &found.released[..] else {
                panic!("{:?}", found.released)
            };
            assert_eq!(released.way_point, None);
            assert!((released.found - released.asked).abs() < 1e-3);
            let said = released.to_string();
            assert!(said.contains("follows from the others"), "{said}");
        }
    }
}

#[test]
fn a_quaternion_fixed_at_a_way_point_as_well_loses_a_condition_there_too() {
    let mut slew = Slew::new(2.0, f64::INFINITY);
    slew.halfway = true;
    let found = solve(&slew, 8, LinearSolver::Multifrontal);
    assert!(found.status.is_solved(), "{:?}", found.status);
    let places: Vec<_> = found.released.iter().map(|of| of.way_point).collect();
    assert_eq!(places, [Some(0), None]);
    for released in &found.released {
        assert!((released.found - released.asked).abs() < 1e-4, "{released}");
    }
}

/// The least work moves the contents evenly: both flows are constant.
#[test]
fn what_vessels_hold_together_is_a_condition_less() {
    let found = solve(
        &Vessels {
            end: [2.0, 3.0, 5.0],
        },
        3,
        LinearSolver::Multifrontal,
    );
    assert!(found.status.is_solved(), "{:?}", found.status);
    // 4 in 2 s through either pump.
    assert!((found.objective - 2.0 * (4.0 + 4.0)).abs() < 1e-7);
    let [released] = &found.released[..] else {
        panic!("{:?}", found.released)
    };
    assert!((released.found - released.asked).abs() < 1e-7);
}

/// Conditions that contradict each other stay, and nothing is called solved.
#[test]
fn ends_that_contradict_an_invariant_are_not_reached() {
    let found = solve(
        &Vessels {
            end: [2.0, 3.0, 6.0],
        },
        3,
        LinearSolver::Multifrontal,
    );
    assert!(!found.status.is_solved(), "{:?}", found.status);
    assert_eq!(found.released, []);
}

/// In free time with torques without limits, and with few components fixed, nothing is released.
#[test]
fn conditions_of_which_none_depends_on_others_all_stay() {
    let mut slew = Slew::new(1.5, f64::INFINITY);
    slew.fixed = [false, true, true, true];
    slew.duration = Interval::new(5.0, 20.0);
    let found = solve(&slew, 6, LinearSolver::Multifrontal);
    assert!(found.status.is_solved(), "{:?}", found.status);
    assert_eq!(found.released, []);
}
