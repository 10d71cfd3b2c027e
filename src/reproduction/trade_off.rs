//! What the base's rest costs the joints, on the paper's arm.

use super::figures::Drawn;
use super::{RELAXED, ReproductionError, Session};
use crate::config::ProblemFile;
use crate::planner::Status;
use crate::report::ParetoReport;
use crate::study::pareto::{ParetoFront, ParetoPoint, balanced, factors};

/// Base motion against joint effort, as `pareto` does it unless told otherwise.
#[derive(Debug, Clone)]
pub struct TradeOff {
    /// The points, in the order of their factors.
    pub points: Vec<ParetoPoint>,
    notes: Vec<String>,
    /// What the command was given for a search.
    search_flags: String,
}

impl TradeOff {
    /// Plans along the curve.
    ///
    /// # Errors
    /// Those of [`Session::sweep`].
    pub fn plan(session: &mut Session<'_>) -> Result<Self, ReproductionError> {
        let (problem, notes) = balanced(&ProblemFile::shipped(RELAXED)?.problem);
        let mut front = ParetoFront::new(&problem);
        session.sweep(&problem.name, &mut front, &factors(0.01, 100.0, 9))?;
        Ok(Self {
            points: front.points().to_vec(),
            notes,
            search_flags: session.search_flags(),
        })
    }

    /// The command that does the same.
    pub fn command(&self) -> String {
        format!(
            "ffsm-ipopt pareto config/{RELAXED}.toml{}",
            self.search_flags
        )
    }

    /// Table and figure.
    pub fn report(&self) -> ParetoReport<'_> {
        ParetoReport::of(RELAXED, &self.points, &self.notes)
    }

    /// The figure.
    pub fn drawn(&self) -> Drawn {
        Drawn {
            name: "pareto".into(),
            caption: format!(
                "`{RELAXED}`: (a) the cost's terms about the base over those about the joints, (b) \
                 the base attitude over the factor on the base's weights; points that converged."
            ),
            figure: self.report().figure(),
        }
    }

    /// How much there is to gain, in a sentence.
    pub fn finding(&self) -> String {
        let mut solved = self
            .points
            .iter()
            .filter(|point| point.plan.status == Status::Solved);
        let (Some(first), Some(last)) = (solved.next(), solved.next_back()) else {
            return "No two points converged.".into();
        };
        let angle = |p: &ParetoPoint| p.plan.metrics.final_base_attitude.to_degrees();
        format!(
            "Between the ends of the curve that converged, weights on the base {:.0} times as large \
             bring the final attitude from {:.2}° to {:.2}° and cost the joints {:.1} times the effort.",
            last.factor / first.factor,
            angle(first),
            angle(last),
            last.joints / first.joints
        )
    }
}
