//! One task by every planner, on the paper's arm and on one that has joints to spare.

use super::figures::Drawn;
use super::{RELAXED, ReproductionError, Session};
use crate::config::ProblemFile;
use crate::planner::Method;
use crate::problem::Problem;
use crate::refine;
use crate::report::{ComparisonReport, comparison_figure};
use crate::study::Comparison;

/// The shipped problems that planners are compared on.
const PROBLEMS: [&str; 2] = [RELAXED, "chaser-7dof-heavy"];

/// One task by every planner.
#[derive(Debug, Clone)]
pub struct Compared {
    /// The task.
    pub problem: Problem,
    /// What the planners made of it.
    pub found: Comparison,
    /// What the command was given for a search.
    search_flags: String,
}

/// Plans both tasks by every planner.
///
/// # Errors
/// Those of [`Session::compare`].
pub fn compared(session: &mut Session<'_>) -> Result<Vec<Compared>, ReproductionError> {
    let plan = |name| {
        let problem = ProblemFile::shipped(name)?.problem;
        let found = session.compare(&problem)?;
        Ok(Compared {
            problem,
            found,
            search_flags: session.search_flags(),
        })
    };
    PROBLEMS.into_iter().map(plan).collect()
}

impl Compared {
    /// The command that does the same.
    pub fn command(&self) -> String {
        let Self {
            problem,
            search_flags,
            ..
        } = self;
        format!(
            "ffsm-ipopt compare config/{}.toml{search_flags}",
            problem.name
        )
    }

    /// The tables.
    pub fn report(&self) -> ComparisonReport<'_> {
        ComparisonReport::of(&self.problem.name, &self.found)
    }

    /// The motions over each other.
    pub fn drawn(&self) -> Drawn {
        let name = &self.problem.name;
        Drawn {
            name: format!("compare-{name}"),
            caption: format!(
                "`{name}` by every planner: lines are solid where the planner optimises."
            ),
            figure: comparison_figure(&self.problem, &self.found),
        }
    }

    /// How far A-RPM gets beside MATPM, in a sentence.
    pub fn finding(&self) -> String {
        let last = |method| self.found.by(method).map(|p| p.metrics.final_base_attitude);
        let adaptive = Method::Collocation(refine::Method::Adaptive);
        let (Some(ours), Some(theirs)) = (last(adaptive), last(Method::Matpm)) else {
            return String::new();
        };
        format!(
            "On `{}` the base ends {:.3}° off under A-RPM and {:.3}° off under MATPM, {:.2} times as \
             far.",
            self.problem.name,
            ours.to_degrees(),
            theirs.to_degrees(),
            theirs / ours
        )
    }
}
