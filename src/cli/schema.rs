//! `schema`: the JSON Schema of the problem file.

use super::failure::Failure;
use super::{Outcome, terminal};
use clap::Args;

const PROBLEM: &str = include_str!("../../config/problem.schema.json");

/// Print the JSON Schema of the problem file
///
/// An editor that knows TOML completes and checks a problem that begins with
/// `#:schema problem.schema.json`, once `ffsm-ipopt schema > problem.schema.json` has written it
/// beside.
#[derive(Debug, Args)]
pub(super) struct Arguments {}

/// Prints.
pub(super) fn run(_: &Arguments) -> Result<Outcome, Failure> {
    terminal::print(PROBLEM)?;
    Ok(Outcome::Done)
}
