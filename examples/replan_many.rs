//! Many goals in a row with one planner, each plan started from the last one's solution.
//!
//! ```sh
//! cargo run --release --example replan_many
//! ```

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::planner::{Planner, Start, Status};
use std::error::Error;
use std::path::Path;

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/config/table1-smooth.toml");
    let shipped = ProblemFile::load(Path::new(file), &Overrides::default())?.problem;
    let mut planner = Planner::new();
    let mut last: Option<Start> = None;
    let mut cold = 0;
    for degrees in [60.0_f64, 62.0, 64.0, 66.0, 68.0, 70.0] {
        let elbow = degrees.to_radians();
        let problem = shipped.edited(|problem| problem.task.final_joints[1] = elbow)?;
        let plan = planner.plan_with(&problem, last.as_ref(), &mut |_| Control::Continue)?;
        assert_eq!(plan.status, Status::Solved);
        let iterations: u32 = plan.iterations.iter().map(|r| r.nlp_iterations).sum();
        println!(
            "elbow to {degrees}°: J = {:.6}, base ends at {:+.3}°, {iterations} iterations, {:.1} ms",
            plan.objective,
            plan.discretization.state(plan.discretization.mesh.points())[0].to_degrees(),
            plan.timing.total.as_secs_f64() * 1e3,
        );
        if last.is_none() {
            cold = iterations;
        } else {
            assert!(
                2 * iterations < cold,
                "{iterations} iterations, {cold} at first"
            );
        }
        last = Some(Start {
            trajectory: plan.discretization,
            iterate: Some(plan.iterate),
        });
    }
    Ok(())
}
