//! Largest values along the path, each a static parameter.

use crate::checks::*;
use crate::problem_kinds::*;
use crate::problems;
use crate::trees;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::ocp::{Elastic, Interval};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;

/// `problem` with every peak in its cost, drifting, in a time of its own.
fn peaked(problem: &Problem) -> Problem {
    let edited = problem.edited(|problem| {
        problem.cost.peak_base_attitude = vec![0.5];
        problem.cost.peak_base_position = vec![0.4];
        problem.cost.peak_base_rate = vec![0.3];
        problem.task.initial_momentum.linear.fill(0.2);
        problem.task.duration = Interval::new(1.0, 5.0);
    });
    edited.unwrap()
}

#[test]
fn peaks_in_the_plane_and_in_space() {
    check_problem(&peaked(&loaded(problems::two_link())), small());
    let arm = loaded(trees::chain(3, 4));
    let mesh = || Mesh::uniform(1, 2).unwrap();
    check_problem(&peaked(&arm), mesh());
    for attitude in [SpatialAttitude::Quaternion, SpatialAttitude::Mrp] {
        check_problem(&peaked(&described(arm.clone(), attitude)), mesh());
    }
}

/// An integral beside the running cost, and a row of the end that adds what counts there.
#[test]
fn a_bound_on_all_that_counts_of_the_base() {
    let bounded = |problem: Problem| {
        let edited = problem.edited(|problem| {
            problem.cost.rate_matrix = None;
            problem.limits.base_motion = 0.7;
        });
        edited.unwrap()
    };
    check_problem(&bounded(peaked(&loaded(problems::two_link()))), small());
    let arm = loaded(trees::chain(3, 4));
    let mesh = || Mesh::uniform(1, 2).unwrap();
    let described = [SpatialAttitude::Quaternion, SpatialAttitude::Mrp]
        .map(|attitude| described(arm.clone(), attitude));
    for arm in [arm].iter().chain(&described) {
        let problem = bounded(peaked(arm));
        check_problem(&problem, mesh());
        let system = FreeFloating::spatial(&problem);
        check(&Elastic::new(&system, groups(&system), 1e-3), mesh());
    }
}

#[test]
fn limits_give_way_and_peaks_do_not() {
    let problem = peaked(&loaded(problems::two_link()));
    let system = FreeFloating::planar(&problem).unwrap();
    let limits = system.elastic_limits();
    assert!(limits.iter().all(|limit| limit.id.limit.may_give_way()));
    check(&Elastic::new(&system, groups(&system), 1e-3), small());
}
