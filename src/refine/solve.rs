//! An optimal control problem solved by one call.

use super::start::guessed;
use super::{Outcome, Refinement, ReleasedCondition, Settings, SolveError, Start, start_check};
use crate::nlp::{self, Control, Deadline};
use crate::ocp::{Dependent, DynOcp, Formulation, Ocp, Released, dependent};
use crate::transcription::{Discretization, Patterns};

/// How an optimal control problem is solved: [`ocp::Settings`](crate::ocp::Settings).
///
/// ```
/// let mut settings = ffsm_ipopt::ocp::Settings::default();
/// settings.mesh.tolerance = 1e-7;
/// settings.solver.max_iterations = 1000;
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct SolveSettings {
    /// First mesh, tolerance and refinement.
    pub mesh: Settings,
    /// The solver of each programme.
    pub solver: nlp::Settings,
}

impl From<Settings> for SolveSettings {
    fn from(mesh: Settings) -> Self {
        Self {
            mesh,
            ..Self::default()
        }
    }
}

/// Solves `problem` from straight lines between the ends of its states.
///
/// The outcome says whether it converged. Conditions at the end or at a way-point that follow from the
/// others, since the dynamics keep an invariant, are left out: see [`Outcome::released`].
///
/// # Errors
/// [`SolveError`], where there is nothing to solve.
pub fn solve(problem: &impl Ocp, settings: &SolveSettings) -> Result<Outcome, SolveError> {
    begin(problem, settings, |refinement| {
        Ok(refinement.straight_start()?)
    })
}

/// Solves `problem` from a guess: its duration, and what writes states and controls at a fraction of
/// it. Both are zero where nothing is written. Static parameters begin at
/// [`Formulation::parameter_guess`](crate::ocp::Formulation::parameter_guess).
///
/// # Errors
/// [`SolveError`], where there is nothing to solve.
pub fn solve_from(
    problem: &impl Ocp,
    settings: &SolveSettings,
    duration: f64,
    guess: impl FnMut(f64, &mut [f64], &mut [f64]),
) -> Result<Outcome, SolveError> {
    begin(problem, settings, |refinement| {
        refinement.start_from(duration, guess)
    })
}

fn begin(
    problem: &dyn DynOcp,
    settings: &SolveSettings,
    start: impl FnOnce(&Refinement<'_>) -> Result<Start, SolveError>,
) -> Result<Outcome, SolveError> {
    let formulation = problem.formulation();
    formulation.validate()?;
    settings.mesh.validate()?;
    let deadline = Deadline::after(settings.solver.time_limit);
    let patterns = Patterns::detect(problem);
    let refinement = Refinement {
        ocp: problem,
        patterns: &patterns,
        settings: &settings.mesh,
        solver: &settings.solver,
    };
    let start = start(&refinement)?;
    start_check::written(problem, &formulation, &start.trajectory)?;
    start_check::finite(problem, &formulation, &start.trajectory)?;
    let dependent = dependent(problem, &formulation);
    if dependent.is_empty() {
        return refinement.run(&start, &mut |_| Control::Continue);
    }
    let without = Refinement {
        ocp: &Released::new(problem, &dependent),
        patterns: &patterns,
        settings: &settings.mesh,
        solver: &settings.solver,
    };
    let mut outcome = without.run(&start, &mut |_| Control::Continue)?;
    outcome.released = released(&dependent, &formulation, &outcome.trajectory);
    let mut pairs = dependent.iter().zip(&outcome.released);
    if outcome.converged && !pairs.all(|(of, released)| of.holds(released.found)) {
        // What looked like an invariant is none everywhere.
        let solver = nlp::Settings {
            time_limit: deadline.remaining(),
            ..settings.solver.clone()
        };
        let all = Refinement {
            solver: &solver,
            ..refinement
        };
        let mut statistics = outcome.statistics;
        outcome = all.run(&start, &mut |_| Control::Continue)?;
        statistics.add(&outcome.statistics);
        outcome.statistics = statistics;
    }
    Ok(outcome)
}

/// The conditions left out, with what the trajectory has in their place.
fn released(
    dependent: &[Dependent],
    formulation: &Formulation,
    trajectory: &Discretization,
) -> Vec<ReleasedCondition> {
    let at = |way_point: Option<usize>| match way_point {
        Some(w) => trajectory.mesh.node_at(formulation.way_points[w].fraction),
        None => Some(trajectory.mesh.points()),
    };
    dependent
        .iter()
        .map(|condition| ReleasedCondition {
            state: formulation.states[condition.state].name.clone(),
            way_point: condition.way_point,
            asked: condition.asked,
            found: at(condition.way_point)
                .map_or(f64::NAN, |node| trajectory.state(node)[condition.state]),
        })
        .collect()
}

impl Refinement<'_> {
    /// A trajectory on the first mesh from a guess: the duration, and what writes states and
    /// controls at a fraction of it. t₀ and static parameters are guessed by the formulation.
    ///
    /// # Errors
    /// Where the duration is no time, or the settings give no mesh.
    pub fn start_from(
        &self,
        duration: f64,
        guess: impl FnMut(f64, &mut [f64], &mut [f64]),
    ) -> Result<Start, SolveError> {
        if !(duration.is_finite() && duration > 0.0) {
            return Err(SolveError::StartDuration(duration));
        }
        let formulation = self.ocp.formulation();
        formulation.validate()?;
        let fractions = formulation.way_point_fractions();
        let mesh = self.settings.first_mesh()?.through(&fractions)?;
        let (states, controls) = formulation.widths();
        let trajectory = Discretization::sample(mesh, duration, states, controls, guess);
        Ok(Start {
            trajectory: guessed(&formulation, trajectory),
            iterate: None,
        })
    }
}
