//! Plans one problem file over and over in one process, as a batch would, and prints the median
//! times as JSON: of all, and of the solve alone, without what a peer calls the build of its solver.
//! Peers' solvers are timed like this: loaded, and warm.
//!
//! ```sh
//! cargo run --release --example time_in_process -- config/table1-relaxed.toml 21 mesh.max_iterations=1
//! ```

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::ipopt::read_by_tick;
use ffsm_ipopt::planner::Planner;
use std::error::Error;
use std::path::Path;

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    // As the command line does.
    read_by_tick();
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/config/table1-smooth.toml");
    let mut arguments = std::env::args().skip(1).peekable();
    let path = arguments.next_if(|argument| argument.ends_with(".toml"));
    let mut runs = 3;
    let mut overrides = Overrides::default();
    if path.is_some() {
        runs = arguments.next().map_or(Ok(11), |runs| runs.parse())?;
        for assignment in arguments {
            overrides.set(&assignment)?;
        }
    }
    let path = path.as_deref().unwrap_or(shipped);
    let file = ProblemFile::load(Path::new(path), &overrides)?;

    let (mut seconds, mut solves) = (Vec::new(), Vec::new());
    let mut objective = f64::NAN;
    for _ in 0..=runs {
        // A new planner each time: nothing is known of the problem's sparsity from before.
        let plan = Planner::new().plan(&file.problem)?;
        seconds.push(plan.timing.total.as_secs_f64());
        solves.push((plan.timing.total - plan.timing.setup).as_secs_f64());
        // One run knows nothing of the one before, so that all end at the same number.
        assert!(objective.is_nan() || objective == plan.objective);
        objective = plan.objective;
    }
    let [seconds, solve] = [seconds, solves].map(median);
    println!(r#"{{"seconds": {seconds:e}, "solve": {solve:e}, "objective": {objective:e}}}"#);
    Ok(())
}

/// Of all but the first, which has loaded what all others use.
fn median(mut times: Vec<f64>) -> f64 {
    let warm = &mut times[1..];
    warm.sort_by(f64::total_cmp);
    warm.get(warm.len() / 2).copied().unwrap_or(f64::NAN)
}
