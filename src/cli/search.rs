//! What the commands that search take for it.

use super::failure::Failure;
use crate::planner::Method;
use crate::refine;
use crate::study::search::{STARTS, Search};
use clap::Args;

/// Most starts of one search.
const MOST: usize = 1_000_000;

/// A search from many starts.
#[derive(Debug, Args)]
pub(super) struct SearchArguments {
    /// Plan from N starts [default: 32] and keep the best: the straight path, loops, detours, other
    /// final joints for a goal of the end effector
    #[arg(long, value_name = "N", num_args = 0..=1, value_parser = starts, default_missing_value = "32")]
    search: Option<usize>,
    /// What the random numbers of the search begin with
    #[arg(long, value_name = "S", default_value_t = 1, requires = "search")]
    seed: u64,
}

fn starts(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(starts) if (1..=MOST).contains(&starts) => Ok(starts),
        _ => Err(format!(
            "expected a number of starts from 1 to {MOST}, such as {STARTS}"
        )),
    }
}

impl SearchArguments {
    /// The search that was asked for, by the method that it refines with.
    pub(super) fn of(&self, method: Method) -> Result<Option<(Search, refine::Method)>, Failure> {
        let Some(starts) = self.search else {
            return Ok(None);
        };
        let Method::Collocation(method) = method else {
            return Err(Failure::Usage(format!(
                "--search with --method {}: this method has no starts to choose from",
                method.name()
            )));
        };
        let seed = self.seed;
        Ok(Some((Search { starts, seed }, method)))
    }
}
