//! Files, printing, threads and versions around a solve.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::{IpoptError, linear_solvers, solve, version};
use ffsm_ipopt::nlp::{Control, Iterate, LinearSolver, Settings, Status};
use std::path::Path;
use std::time::{Duration, Instant};

#[test]
fn an_option_file_in_the_working_directory_is_not_read() {
    if !is_child() {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(
            directory.path().join("ipopt.opt"),
            "max_iter 0\nprint_level 5\n",
        )
        .unwrap();
        child(
            "surroundings::an_option_file_in_the_working_directory_is_not_read",
            directory.path(),
        );
        return;
    }
    assert!(Path::new("ipopt.opt").exists());
    let solution = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}

#[test]
fn nothing_is_printed_or_left_behind_unless_asked() {
    if !is_child() {
        let directory = tempfile::tempdir().unwrap();
        let printed = child(
            "surroundings::nothing_is_printed_or_left_behind_unless_asked",
            directory.path(),
        );
        let (quiet, loud) = printed
            .split_once("<quiet>")
            .unwrap()
            .1
            .split_once("<loud>")
            .unwrap();
        assert_eq!(quiet.trim(), "");
        assert!(loud.contains("inf_pr"), "{loud}");
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
        return;
    }
    println!("<quiet>");
    let settings = Settings::default();
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
    assert!(run(&mut logarithm(), &settings, &[-3.0]).is_ok());
    assert!(
        run(
            &mut hs071(),
            &with_option("nonsense", text("1")),
            &HS071_START
        )
        .is_err()
    );
    assert!(
        run(
            &mut hs071(),
            &with_option("linear_solver", text("none")),
            &HS071_START
        )
        .is_err()
    );
    assert!(!linear_solvers().is_empty());
    // Ipopt prints through C's own buffer; the end of a solve empties it.
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
    println!("<loud>");
    let settings = with(|settings| settings.print_level = 5);
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
}

#[test]
fn two_threads_solve_at_once() {
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                for _ in 0..100 {
                    let mut nlp = hs071();
                    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
                    assert_eq!(solution.status, Status::Solved);
                    assert_near(&solution.iterate.x, &HS071_OPTIMUM, 1e-6);
                }
            });
        }
    });
}

#[test]
fn a_solve_inside_a_solve_is_refused() {
    let nested = |linear_solver: &str| {
        let settings = with(|settings| settings.linear_solver = linear_solver.into());
        let start = Iterate::primal(HS071_START.to_vec());
        let mut inner = None;
        let outer = solve(&mut hs071(), &settings, &start, &mut |_| {
            inner.get_or_insert_with(|| run(&mut hs071(), &settings, &HS071_START));
            Control::Continue
        });
        assert_eq!(outer.unwrap().status, Status::Solved);
        inner.unwrap()
    };
    assert_eq!(nested("mumps"), Err(IpoptError::Nested("mumps".into())));
    // The multifrontal solver keeps no state outside the solve.
    let inner = nested("multifrontal");
    assert_eq!(inner.unwrap().status, Status::Solved);
}

/// Four threads with problems of their own for `time`, against one thread.
fn threads_agree(time: Duration) {
    assert!(!ffsm_ipopt::nlp::ipopt::serialised(
        &LinearSolver::Multifrontal
    ));
    let case = |kind: usize| {
        let settings = with(|settings| settings.linear_solver = LinearSolver::Multifrontal);
        let solution = if kind == 0 {
            run(&mut hs071(), &settings, &HS071_START).unwrap()
        } else {
            let points = 20 + 37 * kind;
            let mut nlp = Chain {
                points,
                upper: false,
            };
            run(&mut nlp, &settings, &vec![0.9; points]).unwrap()
        };
        assert_eq!(solution.statistics.fallbacks, 0);
        (solution.status, solution.iterate, solution.constraints)
    };
    let alone: Vec<_> = (0..8).map(case).collect();
    let begin = Instant::now();
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let alone = &alone;
            scope.spawn(move || {
                let mut next = thread;
                while begin.elapsed() < time {
                    assert_eq!(case(next % 8), alone[next % 8], "case {}", next % 8);
                    next += 1;
                }
                assert!(next > thread + 8, "too few solves to tell");
            });
        }
    });
}

#[test]
fn four_threads_find_what_one_finds() {
    threads_agree(Duration::from_secs(2));
}

/// `make test-threads`.
#[test]
#[ignore = "takes a minute"]
fn four_threads_find_what_one_finds_for_a_minute() {
    threads_agree(Duration::from_secs(60));
}

#[test]
fn the_multifrontal_solver_finds_what_mumps_finds() {
    for points in [2, 3, 50, 300] {
        let mut nlp = Chain {
            points,
            upper: false,
        };
        let [multifrontal, mumps] = ["multifrontal", "mumps"].map(|name| {
            let settings = with(|settings| settings.linear_solver = name.into());
            run(&mut nlp, &settings, &vec![0.9; points]).unwrap()
        });
        assert_eq!(
            (multifrontal.status, mumps.status),
            (Status::Solved, Status::Solved)
        );
        assert_eq!(multifrontal.statistics.fallbacks, 0);
        assert!(multifrontal.statistics.iterations <= mumps.statistics.iterations);
        assert_near(&multifrontal.iterate.x, &mumps.iterate.x, 1e-7);
    }
}

#[test]
fn the_linear_solvers_listed_are_those_that_solve() {
    let listed = linear_solvers();
    assert!(listed.contains(&LinearSolver::Mumps), "{listed:?}");
    for solver in ["ours", "ma27", "ma97", "pardiso", "spral", "unheard-of"].map(LinearSolver::from)
    {
        let settings = with(|settings| settings.linear_solver = solver.clone());
        let solved = run(&mut hs071(), &settings, &HS071_START);
        assert_eq!(
            solved.is_ok(),
            listed.contains(&solver),
            "{solver}: {solved:?}"
        );
    }
}

#[test]
fn the_version_is_one_this_was_made_for() {
    let minor = version()
        .strip_prefix("3.")
        .and_then(|rest| rest.split('.').next());
    assert!(
        (11..).contains(&minor.unwrap().parse::<u32>().unwrap()),
        "{}",
        version()
    );
}
