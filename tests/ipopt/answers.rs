//! Answers that are known.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::solve;
use ffsm_ipopt::nlp::{Control, Iterate, Settings, Status};

#[test]
fn hs071_reaches_its_known_optimum() {
    let mut nlp = hs071();
    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &HS071_OPTIMUM, 1e-6);
    assert_near(&[solution.objective], &[17.0140173], 1e-6);
    assert!(
        solution.iterate.multipliers[0] < 0.0,
        "the product's lower bound is active"
    );
    assert!(
        solution.iterate.lower_multipliers[0] > 1.0,
        "the first variable is at its bound"
    );
    assert_optimal(&mut nlp, &solution, 1e-7);

    let statistics = solution.statistics;
    assert!((5..20).contains(&statistics.iterations));
    assert!(statistics.primal_infeasibility < 1e-8 && statistics.dual_infeasibility < 1e-8);
    assert!(statistics.barrier < 1e-8);
    let of = statistics.evaluations;
    let evaluations = [
        of.objective,
        of.gradient,
        of.constraints,
        of.jacobian,
        of.hessian,
    ];
    assert!(
        evaluations
            .iter()
            .all(|&count| count >= statistics.iterations)
    );
    assert_eq!(evaluations.iter().sum::<u32>(), nlp.evaluations);
    assert_eq!((statistics.solves, statistics.fallbacks), (1, 0));
    assert!(nlp.new_points > statistics.iterations && nlp.new_points < nlp.evaluations);
}

#[test]
fn a_programme_without_constraints_is_solved() {
    let mut nlp = rosenbrock();
    let solution = run(&mut nlp, &Settings::default(), &[-1.2, 1.0]).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &[1.0, 1.0], 1e-7);
    assert!(solution.constraints.is_empty() && solution.iterate.multipliers.is_empty());
}

#[test]
fn a_fixed_variable_stays() {
    let mut nlp = hs071();
    (nlp.variables[0][3], nlp.variables[1][3]) = (1.5, 1.5);
    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_eq!(solution.iterate.x[3], 1.5);
    assert_optimal(&mut nlp, &solution, 1e-7);
}

#[test]
fn an_infeasible_programme_is_called_so() {
    // Within the unit circle, and at x + y = 3.
    let mut nlp = Dense::new(
        |x| x[0],
        |_, d| d.copy_from_slice(&[1.0, 0.0]),
        |_, _, l, h| h.copy_from_slice(&[2.0 * l[0], 0.0, 2.0 * l[0]]),
        free(2),
    )
    .subject_to(
        |x, g| g.copy_from_slice(&[x[0] * x[0] + x[1] * x[1], x[0] + x[1]]),
        |x, d| d.copy_from_slice(&[2.0 * x[0], 2.0 * x[1], 1.0, 1.0]),
        [vec![f64::NEG_INFINITY, 3.0], vec![1.0, 3.0]],
    );
    let mut restoration = false;
    let start = Iterate::primal(vec![0.3, 0.1]);
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        restoration |= progress.restoration;
        Control::Continue
    });
    assert_eq!(solution.unwrap().status, Status::LocallyInfeasible);
    assert!(restoration, "the monitor sees the restoration phase");
}

#[test]
fn more_equations_than_variables_are_called_so() {
    let mut nlp = Dense::new(
        |x| x[0],
        |_, d| d[0] = 1.0,
        |_, _, _, h| h[0] = 0.0,
        free(1),
    )
    .subject_to(
        |x, g| g.copy_from_slice(&[x[0], x[0] * x[0]]),
        |x, d| d.copy_from_slice(&[1.0, 2.0 * x[0]]),
        [vec![1.0, 2.0], vec![1.0, 2.0]],
    );
    let solution = run(&mut nlp, &Settings::default(), &[0.5]).unwrap();
    assert_eq!(solution.status, Status::TooFewDegreesOfFreedom);
    assert_eq!(solution.iterate.x, [0.5]);
    assert!(solution.objective.is_nan());
}

#[test]
fn undefined_trial_points_only_shorten_the_step() {
    let mut nlp = logarithm();
    let solution = run(&mut nlp, &Settings::default(), &[3.0]).unwrap();
    assert!(nlp.undefined > 0, "the test means to leave the domain");
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &[1.0], 1e-6);
}

#[test]
fn an_undefined_start_is_an_invalid_number() {
    let solution = run(&mut logarithm(), &Settings::default(), &[-3.0]).unwrap();
    assert_eq!(solution.status, Status::InvalidNumber);
}

#[test]
fn the_iteration_limit_is_a_status_with_an_iterate() {
    let settings = with(|settings| settings.max_iterations = 3);
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::MaxIterations);
    assert_eq!(solution.statistics.iterations, 3);
    assert!(solution.objective.is_finite());
}

#[test]
fn a_warm_start_takes_fewer_iterations() {
    let cold = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    let again = run(&mut hs071(), &Settings::default(), &cold.iterate.x).unwrap();
    let settings = with(|settings| settings.warm_start = Some(1e-8));
    let mut nlp = hs071();
    let warm = solve(&mut nlp, &settings, &cold.iterate, &mut |_| {
        Control::Continue
    })
    .unwrap();
    assert_eq!(warm.status, Status::Solved);
    assert_optimal(&mut nlp, &warm, 1e-7);
    let [cold, again, warm] = [cold, again, warm].map(|solution| solution.statistics.iterations);
    assert!(
        warm <= 3 && warm < again && warm < cold,
        "{warm} of {again} and {cold}"
    );
}
