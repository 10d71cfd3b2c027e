//! Many problems side by side, each planned as if it were alone.
//!
//! ```sh
//! cargo run --release --example batch_in_code
//! ```

use ffsm_ipopt::config::ProblemFile;
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::study::batch::{Engine, Event, Record, RowStatus};
use std::error::Error;

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let shipped = ProblemFile::shipped("table1-smooth")?.problem;
    let goal = |k| shipped.edited(|p| p.task.final_joints[1] = 0.9 + 0.05 * f64::from(k));
    let problems = (0..8).map(goal).collect::<Result<Vec<Problem>, _>>()?;
    let mut records: Vec<Record> = Vec::new();
    Engine::default().run(&problems[..], 0..8, &mut |event| {
        if let Event::Record(record) = event {
            records.push(*record);
        }
        Control::Continue
    })?;
    assert!(records.len() == 8 && records.iter().all(|r| r.status == RowStatus::Solved));
    Ok(())
}
