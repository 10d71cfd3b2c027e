//! The command `ffsm-ipopt`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ffsm_ipopt::cli::run()
}
