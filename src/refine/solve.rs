//! An optimal control problem solved by one call.

use super::start::guessed;
use super::{Outcome, Refinement, Settings, SolveError, Start, start_check};
use crate::nlp::{self, Control};
use crate::ocp::Ocp;
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
/// The outcome says whether it converged.
///
/// # Errors
/// [`SolveError`], where there is nothing to solve.
pub fn solve<O: Ocp>(problem: &O, settings: &SolveSettings) -> Result<Outcome, SolveError> {
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
pub fn solve_from<O: Ocp>(
    problem: &O,
    settings: &SolveSettings,
    duration: f64,
    guess: impl FnMut(f64, &mut [f64], &mut [f64]),
) -> Result<Outcome, SolveError> {
    begin(problem, settings, |refinement| {
        refinement.start_from(duration, guess)
    })
}

fn begin<O: Ocp>(
    problem: &O,
    settings: &SolveSettings,
    start: impl FnOnce(&Refinement<'_, O>) -> Result<Start, SolveError>,
) -> Result<Outcome, SolveError> {
    let formulation = problem.formulation();
    formulation.validate()?;
    settings.mesh.validate()?;
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
    refinement.run(&start, &mut |_| Control::Continue)
}

impl<O: Ocp> Refinement<'_, O> {
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
