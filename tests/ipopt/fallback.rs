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
