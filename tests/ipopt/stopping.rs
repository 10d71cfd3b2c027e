//! Ways a solve can be stopped.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::{interrupt, solve};
use ffsm_ipopt::nlp::{Control, Iterate, Progress, Settings, Status};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::Ordering;

#[test]
fn the_monitor_stops_a_solve_at_its_iterate() {
    let mut seen: Vec<Progress> = Vec::new();
    let start = Iterate::primal(HS071_START.to_vec());
    let mut nlp = hs071();
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        seen.push(*progress);
        if progress.iteration == 3 {
            Control::Stop
        } else {
            Control::Continue
        }
    })
    .unwrap();
    assert_eq!(solution.status, Status::Interrupted);
    assert_eq!(solution.statistics.iterations, 3);
    let iterations: Vec<_> = seen.iter().map(|progress| progress.iteration).collect();
    assert_eq!(iterations, [0, 1, 2, 3]);
    assert_near(&[solution.objective], &[(nlp.f)(&solution.iterate.x)], 1e-6);
    assert_near(&[solution.objective], &[seen[3].objective], 1e-6);
    assert_ne!(solution.iterate.x, HS071_START);
}

#[test]
fn an_interrupt_stops_a_solve() {
    // The flag is the whole process's: other tests must not see it.
    if !is_child() {
        child(
            "stopping::an_interrupt_stops_a_solve",
            &std::env::temp_dir(),
        );
        return;
    }
    let start = Iterate::primal(HS071_START.to_vec());
    let solution = solve(
        &mut hs071(),
        &Settings::default(),
        &start,
        &mut |progress| {
            interrupt::flag().store(progress.iteration == 2, Ordering::Relaxed);
            Control::Continue
        },
    )
    .unwrap();
    assert!(interrupt::requested());
    assert_eq!(solution.status, Status::Interrupted);
    assert_eq!(solution.statistics.iterations, 2);
}

#[test]
fn a_panic_comes_back_whole_and_leaves_nothing_broken() {
    let evaluations = {
        let mut nlp = hs071();
        run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
        nlp.evaluations
    };
    for panic_at in 0..evaluations {
        let mut nlp = hs071();
        nlp.panic_at = Some(panic_at);
        let solving = AssertUnwindSafe(|| run(&mut nlp, &Settings::default(), &HS071_START));
        let payload = catch_unwind(solving).expect_err("the panic is resumed");
        assert_eq!(
            *payload.downcast::<String>().unwrap(),
            format!("deliberate {panic_at}")
        );
        assert_eq!(
            nlp.evaluations,
            panic_at + 1,
            "nothing is called after the panic"
        );
    }
    let start = Iterate::primal(HS071_START.to_vec());
    let payload = catch_unwind(|| {
        solve(&mut hs071(), &Settings::default(), &start, &mut |_| {
            std::panic::panic_any(71_u8);
        })
    })
    .expect_err("the monitor's panic is resumed");
    assert_eq!(*payload.downcast::<u8>().unwrap(), 71);
    let solution = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}
