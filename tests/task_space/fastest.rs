//! Free final time: the fastest motion.

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::ocp::{Ocp, Point};
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// u, τ along the two-link motion in which both joints move together, the elbow from rest to rest
/// over 60° with acceleration `a` up to `v`; largest share of each limit.
fn share_of_limits(problem: &Problem, a: f64, v: f64) -> f64 {
    let system = FreeFloating::planar(problem).unwrap();
    let mut scratch = system.scratch::<f64>();
    let (mut rates, mut torque) = ([0.0; 5], [0.0; 2]);
    let goal = [FRAC_PI_3 / 2.0, FRAC_PI_3];
    let ramp = 0.5 * v * v / a;
    let mut most = 0.0_f64;
    for k in 0..=1000 {
        // The elbow's angle, its rate there, and its acceleration on the way up and down.
        let elbow = FRAC_PI_3 * f64::from(k) / 1000.0;
        let from_end = elbow.min(FRAC_PI_3 - elbow);
        let rate = (2.0 * a * from_end.min(ramp)).sqrt();
        let slope = if from_end > ramp { 0.0 } else { a };
        for acceleration in [slope, -slope] {
            let part = [goal[0] / goal[1], 1.0];
            let x = [0.0, elbow * part[0], elbow, rate * part[0], rate];
            let mut evaluate = |u: [f64; 2]| {
                let point = Point {
                    x: &x,
                    u: &u,
                    parameters: &[],
                    t: 0.0,
                };
                system.continuous(point, &mut scratch, &mut rates, &mut torque);
                ([rates[3], rates[4]], torque)
            };
            // Without control the joints accelerate by −H⁻¹Cθ̇.
            let (left, _) = evaluate([0.0; 2]);
            let u = [0, 1].map(|j| part[j] * acceleration - left[j]);
            let (_, torque) = evaluate(u);
            let shares = [u[0] / 5.0, u[1] / 4.0, torque[0] / 0.6, torque[1] / 0.6];
            most = shares.into_iter().fold(most, |most, s| most.max(s.abs()));
        }
    }
    most
}

/// Largest |H⁻¹Cθ̇| of the elbow for joints within ±90° and rates within ±0.9 rad/s.
fn coriolis(problem: &Problem) -> f64 {
    let system = FreeFloating::planar(problem).unwrap();
    let mut scratch = system.scratch::<f64>();
    let (mut rates, mut torque) = ([0.0; 5], [0.0; 2]);
    let mut most = 0.0_f64;
    // A grid good to two percent, which the test adds.
    for a in -12..=12 {
        for b in -24..=24 {
            for c in -6..=6 {
                for d in -6..=6 {
                    let angle = |k: i32, of: f64| FRAC_PI_2 * f64::from(k) / of;
                    let rate = |k: i32| 0.9 * f64::from(k) / 6.0;
                    let x = [0.0, angle(a, 12.0), angle(b, 24.0), rate(c), rate(d)];
                    let u = [0.0; 2];
                    let point = Point {
                        x: &x,
                        u: &u,
                        parameters: &[],
                        t: 0.0,
                    };
                    system.continuous(point, &mut scratch, &mut rates, &mut torque);
                    most = most.max(rates[4].abs());
                }
            }
        }
    }
    most
}

#[test]
fn the_fastest_motion_is_between_what_the_elbow_needs_and_what_both_joints_can() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/config/table1-minimum-time.toml"
    );
    let problem = ProblemFile::load(file.as_ref(), &Overrides::default());
    let problem = problem.unwrap().problem;
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let fastest = plan.discretization.duration;
    assert!((fastest - 1.387167).abs() < 2e-5, "{fastest} s");
    assert!((plan.objective - fastest).abs() < 1e-12);
    let bang_cruise_bang = |a: f64| FRAC_PI_3 / 0.9 + 0.9 / a;
    // The elbow cannot accelerate by more than its control and the Coriolis term together.
    let bound = bang_cruise_bang(4.0 + 1.02 * coriolis(&problem));
    assert!(bound < fastest, "{bound} s, {fastest} s");
    // Both joints together, as fast as the limits let them.
    let together = (100..=400)
        .map(|k| 0.01 * f64::from(k))
        .filter(|&a| share_of_limits(&problem, a, 0.9) <= 1.0)
        .map(bang_cruise_bang)
        .fold(f64::INFINITY, f64::min);
    assert!(fastest < together, "{fastest} s, {together} s");
    assert!(
        together - bound < 0.05 * fastest,
        "{bound} s to {together} s"
    );
    // All three kinds of limits are reached.
    let peak = |rows: &[Vec<f64>], j: usize| rows.iter().fold(0.0_f64, |m, r| m.max(r[j].abs()));
    assert!((peak(&plan.trajectory.joint_velocity, 1) - 0.9).abs() < 1e-6);
    assert!((peak(&plan.trajectory.control, 1) - 4.0).abs() < 1e-6);
    assert!((peak(&plan.trajectory.joint_torque, 0) - 0.6).abs() < 1e-3);
}
