//! MUMPS in the place of the multifrontal solver where that fails.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::solve;
use ffsm_ipopt::nlp::{Control, Iterate, LinearSolver, Settings, Status};

/// A matrix that is not finite cannot be factorised. That of the second attempt is finite.
#[test]
fn a_solve_begun_again_counts_as_one_with_the_counts_of_both_attempts() {
    let mut nlp = hs071();
    nlp.bad_hessian = Some(3);
    let (mut attempts, mut iterations, mut last) = (0, 0, 0);
    let start = Iterate::primal(HS071_START.to_vec());
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        if progress.iteration == 0 {
            attempts += 1;
            iterations += last;
        }
        last = progress.iteration;
        Control::Continue
    })
    .unwrap();
    iterations += last;
    assert_eq!(attempts, 2);
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &HS071_OPTIMUM, 1e-6);

    let statistics = solution.statistics;
    assert_eq!((statistics.solves, statistics.fallbacks), (1, 1));
    assert_eq!(statistics.iterations, iterations);
    let of = statistics.evaluations;
    assert_eq!(of.hessian, nlp.hessians);
    let all = of.objective + of.gradient + of.constraints + of.jacobian + of.hessian;
    assert_eq!(all, nlp.evaluations);
    assert!(statistics.linear_solver + statistics.derivatives <= statistics.total);

    // Of two solves one was begun again.
    let mut both = statistics;
    both.add(
        &run(&mut hs071(), &Settings::default(), &HS071_START)
            .unwrap()
            .statistics,
    );
    assert_eq!((both.solves, both.fallbacks), (2, 1));
    let warning = both.fallback_warning().unwrap();
    assert!(warning.contains("1 of 2 solves"), "{warning}");
}

#[test]
fn mumps_has_nothing_to_fall_back_to() {
    let mut nlp = hs071();
    nlp.bad_hessian = Some(3);
    let settings = with(|settings| settings.linear_solver = LinearSolver::Mumps);
    let statistics = run(&mut nlp, &settings, &HS071_START).unwrap().statistics;
    assert_eq!((statistics.solves, statistics.fallbacks), (1, 0));
    assert_eq!(statistics.fallback_warning(), None);
}

/// Rows that are the same from the second iteration on make a system singular in every one.
#[test]
fn singular_systems_on_and_on_are_handed_over_where_they_are() {
    let mut nlp = valley_with_a_row_twice();
    let mut objectives = Vec::new();
    let start = Iterate::primal(VALLEY_START.to_vec());
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        objectives.push((progress.iteration, progress.objective));
        Control::Continue
    })
    .unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &VALLEY_OPTIMUM, 1e-5);
    let statistics = solution.statistics;
    assert_eq!((statistics.solves, statistics.fallbacks), (1, 1));
    assert_eq!(
        (statistics.singular_fallbacks, statistics.growth_fallbacks),
        (1, 0)
    );
    let warning = statistics.fallback_warning().unwrap();
    assert!(warning.contains("singular"), "{warning}");
    // MUMPS begins where the other one was.
    let again = objectives.iter().rposition(|(i, _)| *i == 0).unwrap();
    assert!(again > 0, "{objectives:?}");
    let (last, before) = objectives[again - 1];
    assert!(objectives[again].1 <= before * (1.0 + 1e-6));
    let after = objectives.last().unwrap().0;
    assert_eq!(statistics.iterations, last + after);

    // All of it within one limit on iterations.
    let settings = with(|settings| settings.max_iterations = last + 1);
    let limited = run(&mut valley_with_a_row_twice(), &settings, &VALLEY_START).unwrap();
    assert_eq!(limited.status, Status::MaxIterations);
    assert_eq!(limited.statistics.iterations, last + 1);
    let settings = with(|settings| settings.max_iterations = last);
    let limited = run(&mut valley_with_a_row_twice(), &settings, &VALLEY_START).unwrap();
    assert_eq!(limited.status, Status::MaxIterations);
    assert_eq!(limited.statistics.fallbacks, 0);
}
