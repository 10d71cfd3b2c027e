//! `completions`: what a shell needs to complete a command line.

use super::failure::Failure;
use super::{Cli, Outcome, terminal};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Print the completions for a shell
#[derive(Debug, Args)]
#[command(after_help = "bash: ffsm-ipopt completions bash > \
    ~/.local/share/bash-completion/completions/ffsm-ipopt")]
pub(super) struct Arguments {
    /// The shell
    shell: Shell,
}

/// Prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut command = Cli::command();
    let name = command.get_name().to_owned();
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut text);
    terminal::print(&String::from_utf8_lossy(&text))?;
    Ok(Outcome::Done)
}
