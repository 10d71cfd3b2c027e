//! The solve of one start on the first mesh.

use super::optimum::{Ended, Optimum};
use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Deadline};
use crate::planner::{Event, Method, Plan, PlanError, Planner, Start, first_mesh, led_within};
use crate::problem::Problem;
use crate::refine::{self, Refinement};
use crate::system::{FreeFloating, StartKind, Starts, along, metrics, trajectory};
use crate::transcription::{Discretization, Patterns};

/// Iterations of the solve from the straight path, which a plan without a search begins with; fewer
/// where the solver's limit is lower.
const STRAIGHT_ITERATIONS: u32 = 400;
/// Those from any other start: what takes longer is rarely the best.
const ITERATIONS: u32 = 250;
/// Largest error (28) beyond which a solution is far from any motion.
const GROSS: f64 = 1.0;

/// What the solves of all starts share.
pub(super) struct FirstMesh<'a, Sp: Space> {
    problem: &'a Problem,
    system: &'a FreeFloating<Sp>,
    patterns: Patterns,
    starts: Starts<'a, Sp>,
    /// Tried after the straight path, where there is one.
    given: Option<&'a Discretization>,
    mesh: Mesh,
}

impl<'a, Sp: Space> FirstMesh<'a, Sp> {
    pub fn new(
        problem: &'a Problem,
        system: &'a FreeFloating<Sp>,
        given: Option<&'a Start>,
        seed: u64,
    ) -> Result<Self, PlanError> {
        Ok(Self {
            problem,
            system,
            patterns: Patterns::detect(system),
            starts: Starts::new(problem, system, seed),
            given: given.map(|start| &start.trajectory),
            mesh: first_mesh(problem, system)?,
        })
    }

    /// Start `index`; the first is the straight path, and the first after that and the given one leads
    /// through the reaction null space where it can.
    fn start(&self, index: usize) -> (StartKind, Discretization) {
        let index = match (index, self.given) {
            (1, Some(given)) => return (StartKind::Given, given.resample(self.mesh.clone())),
            (2.., Some(_)) => index - 1,
            _ => index,
        };
        if index == 1
            && let Some(found) = reaction_null_space(self.problem)
        {
            return (
                StartKind::ReactionNullSpace,
                found.resample(self.mesh.clone()),
            );
        }
        let (kind, path) = self.starts.path(index);
        let duration = self.problem.task.duration.center();
        (kind, along(self.system, duration, &path, self.mesh.clone()))
    }

    /// Where start `index` ends, one of `bests` perturbed where there are any; `None` where it is not
    /// solved.
    pub fn solve(
        &self,
        index: usize,
        bests: &[Ended],
        deadline: Deadline,
        monitor: &mut dyn FnMut() -> Control,
    ) -> Result<Option<Ended>, PlanError> {
        let (kind, from) = match bests.get(index % bests.len().max(1)) {
            Some(best) => {
                let optimum = &best.start.trajectory;
                (StartKind::Perturbed, self.starts.perturbed(optimum, index))
            }
            None => self.start(index),
        };
        let own = &self.problem.solver;
        let most = match kind {
            StartKind::Straight | StartKind::Given => STRAIGHT_ITERATIONS,
            _ => ITERATIONS,
        };
        let solver = || nlp::Settings {
            max_iterations: own.max_iterations.min(most),
            warm_start: None,
            time_limit: deadline.remaining(),
            ..own.clone()
        };
        let start = Start {
            trajectory: self.system.with_peaks(from),
            iterate: None,
        };
        // The others are far outside limits on purpose, and would be led to one and the same optimum.
        let start = match kind {
            StartKind::Straight => {
                let monitor = &mut |_: &Event<'_>| monitor();
                led_within(self.problem, self.system, start, &solver(), monitor)?.start
            }
            _ => start,
        };
        let refinement = Refinement {
            ocp: self.system,
            patterns: &self.patterns,
            settings: &refine::Settings {
                max_iterations: Some(1),
                ..self.problem.mesh.clone()
            },
            solver: &solver(),
        };
        let outcome = refinement.run(&start, &mut |_| monitor())?;
        if !outcome.status.is_solved() || !outcome.objective.is_finite() {
            return Ok(None);
        }
        let reached = trajectory(self.system, &outcome.trajectory);
        let found = metrics(self.system, &outcome.trajectory, &reached);
        let error = outcome.max_error();
        Ok(Some(Ended {
            optimum: Optimum {
                objective: outcome.objective,
                max_base_attitude: found.max_base_attitude,
                final_base_attitude: found.final_base_attitude,
                hits: 1,
                start: index,
                kind,
                status: None,
            },
            gross: error.is_nan() || error >= GROSS,
            start: Start {
                trajectory: outcome.trajectory,
                iterate: Some(outcome.iterate),
            },
        }))
    }
}

/// The path through the reaction null space, where the arm has one and the task is one for it.
fn reaction_null_space(problem: &Problem) -> Option<Discretization> {
    let method = Method::ReactionNullSpace;
    let planned = Planner::new().plan_by(method, problem, None, &mut |_| Control::Continue);
    let usable = |plan: &Plan| plan.discretization.x.iter().all(|x| x.is_finite());
    let plan = planned.ok().filter(usable)?;
    Some(plan.discretization)
}
