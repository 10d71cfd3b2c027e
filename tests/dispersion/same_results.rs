//! A sample is a function of seed and index; sensitivities and spreads of known cases.

use crate::{chaser, motion, only, problems, run};
use ffsm_ipopt::config::Dispersion;
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::parallel;
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::study::dispersion::{DispersionError, Replays, Response, Sensitivities, Spread};
use std::num::NonZero;

#[test]
fn the_same_bits_on_one_thread_and_two_and_for_any_count() {
    let problem = chaser("roll-pitch-yaw");
    let plan = plan(&problem).unwrap().discretization;
    let usual = Dispersion::usual(&problem.robot);
    let on = |threads: usize, count: u64| {
        parallel::with_threads(NonZero::new(threads).unwrap(), || {
            let replays = Replays::new(&problem, &plan, &usual, 5).unwrap();
            let figures = run(&replays, count);
            let sensitivities = Sensitivities::of(&replays, &figures);
            (figures, sensitivities)
        })
    };
    let one = on(1, 1200);
    assert_eq!(one, on(2, 1200));
    assert_eq!(one.0[..301], on(2, 301).0);
    assert!(!one.1.is_empty());
    let other = Replays::new(&problem, &plan, &usual, 6).unwrap();
    assert_ne!(run(&other, 1)[0], one.0[0]);
}

#[test]
fn it_stops_where_it_is_told_to() {
    let problem = problems::smooth();
    let plan = motion(&problem, 20.0, |_| (vec![0.0], vec![0.0; 2]));
    let usual = Dispersion::usual(&problem.robot);
    let replays = Replays::new(&problem, &plan, &usual, 0).unwrap();
    let stopped = replays.run(1_000_000, &mut |_| Control::Stop).unwrap_err();
    assert!(matches!(stopped, DispersionError::Interrupted { samples } if samples > 0));
    let none = replays.run(0, &mut |_| Control::Stop).unwrap_err();
    assert!(matches!(none, DispersionError::Count { found: 0, .. }));
}

/// The angle is L·t/I: its spread is that of L, and nothing else matters.
#[test]
fn the_spread_of_a_turn_is_that_of_its_momentum() {
    let problem = problems::smooth();
    let (mass, moment, inertia) = problems::two_link_composite();
    let inertia = inertia - moment * moment / mass;
    let plan = motion(&problem, 20.0, |_| (vec![0.0], vec![0.0; 2]));
    let sets = [
        "momentum.angular=normal(0.05, 0.001)",
        "joint.*.offset=normal(0, 1e-6)",
        "body.link2.inertia=normal(100%, 0.5%)",
    ];
    let replays = Replays::new(&problem, &plan, &only(&problem, &sets), 2).unwrap();
    let figures = run(&replays, 20_000);
    let angles: Vec<f64> = figures.iter().map(|f| f.final_base_attitude).collect();
    let spread = Spread::of(&angles);
    let unit = 20.0 / inertia;
    // Inertia by less than a ten-thousandth.
    assert!((spread.mean - 0.05 * unit).abs() < 4.0 * spread.mean_error);
    assert!((spread.sd - 0.001 * unit).abs() < 4.0 * spread.sd_error + 1e-3 * spread.sd);
    let found = Sensitivities::of(&replays, &figures);
    let turn = found.iter().find(|s| s.response == Response::FinalAttitude);
    let turn = turn.unwrap();
    assert!(turn.explained > 0.999, "{}", turn.explained);
    assert_eq!(turn.shares[0].key, "momentum.angular");
    assert!(turn.shares[0].share > 0.99);
    assert!((turn.shares[0].sd / (0.001 * unit) - 1.0).abs() < 0.02);
    let sum: f64 = turn.shares.iter().map(|share| share.share).sum();
    assert!((sum - 1.0).abs() < 0.03, "{sum}");
    assert!(Sensitivities::of(&replays, &figures[..10]).is_empty());
}
