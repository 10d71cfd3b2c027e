//! Time in the linear solver, from Ipopt's own statistics.
//!
//! The C interface gives no times; Ipopt writes them to an output file, in milliseconds:
//!
//! ```text
//!  LinearSystemFactorization..........:      0.012 (sys:      0.001 wall:      0.013)
//! ```

use super::problem::Problem;
use std::ffi::CString;
use std::fs::File;
use std::io::{Read, Seek};
use std::os::unix::ffi::OsStrExt;
use std::time::Duration;
use tempfile::NamedTempFile;

/// Lowest print level at which Ipopt writes its statistics.
const SUMMARY: ipopt_sys::Int = 3;

/// Where Linux keeps files in memory.
const SHARED_MEMORY: &str = "/dev/shm";

/// The task that holds all work on the linear systems: assembly, factorisation, back-solves.
///
/// Its parts are printed too, but 3.11 books MUMPS's factorisation under none of them.
const TASK: &str = "StdAugSystemSolverMultiSolve";

/// A file without a name that Ipopt writes its statistics to.
pub(super) struct TimingFile(File);

impl TimingFile {
    /// Has `problem` write to a new file; `None` where there cannot be one.
    pub(super) fn attach(problem: &mut Problem) -> Option<Self> {
        // In memory where there is such a place: a file on disk costs 0.3 ms more than one there.
        let file = NamedTempFile::new_in(SHARED_MEMORY).or_else(|_| NamedTempFile::new());
        let (file, path) = file.ok()?.into_parts();
        let name = CString::new(path.as_os_str().as_bytes()).ok()?;
        // The name goes with `path`: once Ipopt has the file open, nothing is left to clean up.
        problem.output_file(&name, SUMMARY).then_some(Self(file))
    }

    /// Time in the linear solver; `None` where the file does not tell.
    pub(super) fn read(mut self) -> Option<Duration> {
        let mut text = String::new();
        self.0.rewind().ok()?;
        self.0.read_to_string(&mut text).ok()?;
        linear_solver(&text)
    }
}

fn linear_solver(text: &str) -> Option<Duration> {
    let times = text.lines().find_map(|line| {
        let (name, times) = line.split_once(':')?;
        (name.trim().trim_end_matches('.') == TASK).then_some(times)
    })?;
    Duration::try_from_secs_f64(seconds(times)?).ok()
}

/// Wall seconds where they are printed, otherwise those of the processor.
fn seconds(times: &str) -> Option<f64> {
    let wall = times
        .rsplit_once("wall:")
        .map(|(_, wall)| wall.trim_end().trim_end_matches(')'));
    let number = wall.or_else(|| times.split('(').next())?;
    number.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STATISTICS: &str = "
Timing Statistics:

OverallAlgorithm....................:      0.108 (sys:      0.001 wall:      0.109)
PDSystemSolverTotal.................:      0.086 (sys:      0.000 wall:      0.086)
 StdAugSystemSolverMultiSolve.......:      0.080 (sys:      0.000 wall:      0.081)
 LinearSystemFactorization..........:      0.030 (sys:      0.000 wall:      0.040)
Function Evaluations................:      0.010 (sys:      0.000 wall:      0.011)
";

    #[test]
    fn the_wall_time_of_all_linear_systems_is_read() {
        assert_eq!(linear_solver(STATISTICS), Some(Duration::from_millis(81)));
    }

    #[test]
    fn processor_times_do_where_no_wall_times_are_printed() {
        let line = " StdAugSystemSolverMultiSolve.......:      0.030";
        assert_eq!(linear_solver(line), Some(Duration::from_millis(30)));
    }

    #[test]
    fn text_without_times_tells_nothing() {
        assert_eq!(linear_solver("EXIT: Optimal Solution Found.\n"), None);
        assert_eq!(linear_solver(" StdAugSystemSolverMultiSolve..: soon"), None);
    }
}
