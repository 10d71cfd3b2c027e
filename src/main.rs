//! The command `ffsm-ipopt`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ffsm_ipopt::nlp::ipopt::read_by_tick();
    ffsm_ipopt::cli::run()
}
