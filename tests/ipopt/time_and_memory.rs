//! Where the time goes, and that nothing is allocated.

use crate::allocations;
use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::solve;
use ffsm_ipopt::nlp::{Control, Iterate, Settings, Status};
use std::time::Duration;

#[test]
fn the_parts_of_the_time_fit_into_the_whole() {
    let mut nlp = Chain {
        points: 5000,
        upper: false,
    };
    let start = vec![0.9; nlp.points];
    let timed = run(&mut nlp, &Settings::default(), &start).unwrap();
    assert_eq!(timed.status, Status::Solved);
    let statistics = timed.statistics;
    assert!(statistics.linear_solver > Duration::ZERO, "{statistics:?}");
    assert!(statistics.derivatives > Duration::ZERO, "{statistics:?}");
    assert!(statistics.linear_solver + statistics.derivatives <= statistics.total);

    let settings = with(|settings| settings.timing = false);
    let untimed = run(&mut nlp, &settings, &start).unwrap();
    assert_eq!(untimed.statistics.linear_solver, Duration::ZERO);
    assert_eq!(untimed.iterate, timed.iterate, "timing changes nothing");
}

#[test]
fn callbacks_and_linear_solver_do_not_allocate() {
    let mut nlp = Chain {
        points: 50,
        upper: false,
    };
    let start = Iterate::primal(vec![0.9; nlp.points]);
    let (mut first, mut last) = (None, 0);
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        last = allocations::so_far();
        // The linear solver analyses the structure in the first iteration.
        if progress.iteration > 0 {
            first.get_or_insert(last);
        }
        Control::Continue
    })
    .unwrap();
    assert!(solution.statistics.iterations > 3);
    assert_eq!(solution.statistics.fallbacks, 0);
    assert_eq!(first, Some(last));
}
