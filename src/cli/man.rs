//! `man`: the pages of the manual.

use super::failure::Failure;
use super::{Cli, Outcome, terminal};
use crate::report::{FileSet, Lines, OutputFolder};
use clap::{Args, CommandFactory};
use clap_mangen::Man;
use std::path::PathBuf;

/// Write the pages of the manual, one a command
#[derive(Debug, Args)]
#[command(after_help = "ffsm-ipopt man ~/.local/share/man/man1, then man ffsm-ipopt-plan")]
pub(super) struct Arguments {
    /// Folder to write to
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Writes, says where.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.folder)?;
    let mut set = FileSet::new();
    let mut whole = Cli::command()
        .propagate_version(true)
        .disable_help_subcommand(true);
    // Gives every command its full name.
    whole.build();
    let shown = whole
        .get_subcommands()
        .filter(|command| !command.is_hide_set());
    for command in shown {
        let name = command.get_display_name().unwrap_or(command.get_name());
        add(name, command.clone(), &folder, &mut set)?;
    }
    add(whole.get_name(), whole.clone(), &folder, &mut set)?;
    let mut lines = Lines::default();
    lines.add("pages", set.write()?.len().to_string());
    lines.add("written to", folder.path().display().to_string());
    terminal::print(&lines.finish())?;
    Ok(Outcome::Done)
}

fn add(
    name: &str,
    command: clap::Command,
    folder: &OutputFolder,
    set: &mut FileSet,
) -> Result<(), Failure> {
    let mut page = Vec::new();
    Man::new(command)
        .render(&mut page)
        .map_err(|error| Failure::Format {
            path: name.into(),
            message: error.to_string(),
        })?;
    set.add_bytes(folder, format!("{name}.1"), page);
    Ok(())
}
