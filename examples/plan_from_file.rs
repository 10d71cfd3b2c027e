//! Reads a problem file and plans it: what the command `ffsm-ipopt plan` does.
//!
//! ```sh
//! cargo run --release --example plan_from_file -- config/table1-smooth.toml
//! ```

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::planner::{Status, plan};
use std::error::Error;
use std::path::Path;

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/config/table1-smooth.toml");
    let file = std::env::args().nth(1).filter(|a| a.ends_with(".toml"));
    let problem = ProblemFile::load(
        Path::new(file.as_deref().unwrap_or(shipped)),
        &Overrides::default(),
    )?
    .problem;
    let plan = plan(&problem)?;
    assert_eq!(plan.status, Status::Solved);
    for record in &plan.iterations {
        println!(
            "{:3} points in {:2} segments: error {:.2e}, J = {:.9}",
            record.points, record.segments, record.max_error, record.objective
        );
    }
    Ok(())
}
