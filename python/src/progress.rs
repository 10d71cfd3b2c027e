//! A step of planning as its user sees it.

use ffsm_ipopt::planner::Event;
use ffsm_ipopt::refine;
use ffsm_ipopt::study::search::SearchEvent;

/// A step of planning.
#[derive(Debug, Clone, Copy, Default)]
pub struct Progress {
    pub stage: &'static str,
    pub number: Option<usize>,
    pub of: Option<usize>,
    pub points: Option<usize>,
    pub objective: Option<f64>,
    pub max_error: Option<f64>,
}

/// The fields, in the order of the tuple of that name in Python.
type Values = (
    &'static str,
    Option<usize>,
    Option<usize>,
    Option<usize>,
    Option<f64>,
    Option<f64>,
);

impl Progress {
    /// The fields.
    pub fn values(self) -> Values {
        (
            self.stage,
            self.number,
            self.of,
            self.points,
            self.objective,
            self.max_error,
        )
    }

    /// Of a plan; `None` of steps that nobody asks for.
    pub fn of(event: &Event<'_>) -> Option<Self> {
        let step = |stage, number, of| Self {
            stage,
            number: Some(number),
            of,
            ..Self::default()
        };
        Some(match event {
            Event::Refinement(refine::Event::Mesh {
                iteration, points, ..
            }) => Self {
                points: Some(*points),
                ..step("mesh", *iteration, None)
            },
            Event::Refinement(refine::Event::Solver(progress)) => Self {
                objective: Some(progress.objective),
                ..step("iteration", progress.iteration as usize, None)
            },
            Event::Refinement(refine::Event::Solved(record)) => Self {
                points: Some(record.points),
                objective: Some(record.objective),
                max_error: Some(record.max_error),
                ..step("solved", record.nlp_iterations as usize, None)
            },
            Event::Diagnosing { start, of } => step("diagnosing", *start, Some(*of)),
            Event::Step { step: number, of } => step("step", *number, Some(*of)),
            _ => return None,
        })
    }

    /// Of a search.
    pub fn of_search(event: &SearchEvent<'_>) -> Option<Self> {
        match event {
            SearchEvent::Tried { tried, of, best } => Some(Self {
                stage: "search",
                number: Some(*tried),
                of: Some(*of),
                objective: best.is_finite().then_some(*best),
                ..Self::default()
            }),
            SearchEvent::Refining { event, .. } => Self::of(event),
            _ => None,
        }
    }
}
