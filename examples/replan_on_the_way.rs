//! A motion planned again on its way, every few seconds, from where the system is found to be: something
//! that the model does not have turns the base.
//!
//! ```sh
//! cargo run --release --example replan_on_the_way
//! ```

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Planner, Start, Status};
use ffsm_ipopt::transcription::Discretization;
use std::error::Error;
use std::path::Path;

/// Time between two plans, s.
const PERIOD: f64 = 8.0;
/// By how much the base turns in that time beside the plan, rad.
const DISTURBANCE: f64 = 0.01;

/// The part of `plan` from this fraction of its duration on, on the same mesh: where the next search
/// begins.
fn rest(plan: &Discretization, from: f64) -> Discretization {
    let duration = (1.0 - from) * plan.duration;
    let mesh = plan.mesh.clone();
    Discretization::sample(mesh, duration, plan.states, plan.controls, |part, x, u| {
        plan.at_fraction(from + part * (1.0 - from), x, u);
    })
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/config/planar-3link.toml");
    let whole = ProblemFile::load(Path::new(file), &Overrides::default())?.problem;
    let joints = whole.robot.joint_count();
    let mut planner = Planner::new();
    let mut plan = planner.plan(&whole)?;
    assert_eq!(plan.status, Status::Solved);
    let (mut left, mut disturbed) = (whole.task.duration.upper, 0.0);
    while left > PERIOD {
        let motion = &plan.discretization;
        // The joints follow the plan; the base is where a star tracker would say.
        let (mut x, mut u) = (vec![0.0; motion.states], vec![0.0; motion.controls]);
        motion.at_fraction(PERIOD / left, &mut x, &mut u);
        x[0] += DISTURBANCE;
        disturbed += DISTURBANCE;
        let start = Start {
            trajectory: rest(motion, PERIOD / left),
            iterate: None,
        };
        left -= PERIOD;
        let problem = whole.edited(|problem| {
            problem.task.duration = Interval::fixed(left);
            problem.task.initial_base_attitude = vec![x[0]];
            problem.task.initial_joints = x[1..=joints].into();
            problem.task.initial_rates = x[1 + joints..].into();
        })?;
        plan = planner.plan_with(&problem, Some(&start), &mut |_| Control::Continue)?;
        assert_eq!(plan.status, Status::Solved);
        println!(
            "{left:4.1} s to go, base at {:+.3}°: ends at {:+.3}°, {} meshes, {:.1} ms",
            x[0].to_degrees(),
            plan.metrics.final_base_attitude.to_degrees(),
            plan.iterations.len(),
            plan.timing.total.as_secs_f64() * 1e3,
        );
    }
    let off = plan.metrics.final_base_attitude;
    println!(
        "the base ends {:.3}° off, of {:.3}° that it was turned",
        off.to_degrees(),
        disturbed.to_degrees(),
    );
    assert!(off < 0.5 * disturbed, "{off}, of {disturbed}");
    Ok(())
}
