//! One task from many starts: the best optimum that is found.
//!
//! Every start is solved on the first mesh, where J ranks them nearly as it does on finer ones; the
//! best few are refined, and the one that a plan begins with where it may come to less. Half of the
//! starts are paths unlike each other, the rest the best optima until then with a detour or a loop on
//! top (monotonic basin hopping, D. J. Wales, J. P. K. Doye, doi:10.1021/jp970984n). Starts and their
//! order follow from the seed, each start has random numbers of its own, and each solve runs on one
//! thread, or on several where others are idle: the result is the same whatever the number of threads.
//!
//! No number of starts proves that there is nothing better.
//!
//! | file | does |
//! | --- | --- |
//! | `event` | what a monitor sees |
//! | `first_mesh` | the solve of one start |
//! | `optimum` | what several starts ended at, counted once |
//! | `refining` | finer meshes for the best of them |
//! | `results` | what starts that run at the same time see of each other |
//! | `rivals` | the same for what is refined |
//! | `teller` | one monitor for work on several threads |

mod event;
mod first_mesh;
mod optimum;
mod refining;
mod results;
mod rivals;
mod teller;

pub use event::SearchEvent;
pub use optimum::Optimum;

use crate::nlp::{Control, Deadline};
use crate::parallel;
use crate::planner::floor::LowerBounds;
use crate::planner::{Plan, PlanError, Planner, Start, Status};
use crate::problem::Problem;
use crate::system::{System, with_system};
use first_mesh::FirstMesh;
use optimum::{Ended, better_first, same};
use refining::{Refined, Refinements, Refining};
use results::Results;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use teller::Teller;

/// Starts, where nobody says how many.
pub const STARTS: usize = 32;
/// Part of the time limit after which no further start is begun.
const SEARCHING: f64 = 0.6;
/// How many of the best are refined, and how many more where J differs so little that the first mesh
/// may rank them wrongly.
const REFINED: usize = 3;
const MOST_REFINED: usize = 6;
const NEAR: f64 = 0.04;
/// Relative difference of J on the first mesh and on finer ones that is one of meshes.
const MESHES: f64 = 1e-3;
/// Steps of the solver after which a start is slow: later ones go on without it.
const SLOW: u32 = 64;
/// How many of the best are perturbed.
const PERTURBED: usize = 3;

/// A search over seeded starts.
#[derive(Debug, Clone)]
pub struct Search {
    /// How many starts; the first is the straight path.
    pub starts: usize,
    /// What the random numbers begin with.
    pub seed: u64,
}

impl Default for Search {
    fn default() -> Self {
        Self {
            starts: STARTS,
            seed: 1,
        }
    }
}

/// What the starts of a search ended at.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Optima {
    /// Distinct ones, the best first: those that were refined, then others on the first mesh.
    pub found: Vec<Optimum>,
    /// Starts that were tried.
    pub tried: usize,
    /// Those of them that were solved on the first mesh.
    pub solved: usize,
    /// What the random numbers began with.
    pub seed: u64,
    /// How long the whole search took.
    pub time: Duration,
    /// What no motion can do better than; for planar arms with two joints.
    pub bounds: Option<LowerBounds>,
}

/// What a search came to.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Searched {
    /// The best plan.
    pub plan: Plan,
    /// All that was found.
    pub optima: Optima,
}

/// What is refined of all that starts ended at, and the rest.
type Choose = dyn Fn(Vec<Ended>) -> (Vec<Ended>, Vec<Ended>);

impl Search {
    /// Searches for the best plan of `problem`, from `given` as well where there is one, telling
    /// `monitor` of every step.
    ///
    /// The solver's time limit is one for all of it. Where nothing that starts ended at can be refined,
    /// the problem is planned from the straight path, with a diagnosis where that fails.
    ///
    /// # Errors
    /// [`PlanError`] as of [`Planner::plan_with`].
    pub fn run(
        &self,
        problem: &Problem,
        given: Option<&Start>,
        monitor: &mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send),
    ) -> Result<Searched, PlanError> {
        self.run_choosing((self.half(), &chosen), problem, given, monitor)
    }

    /// The same with nearly all starts perturbing the best ones, where those from nothing were tried before
    /// and led to `given`.
    pub(in crate::study) fn run_around(
        &self,
        problem: &Problem,
        given: &Start,
        monitor: &mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send),
    ) -> Result<Searched, PlanError> {
        self.run_choosing((Results::LAG, &chosen), problem, Some(given), monitor)
    }

    /// The same with the `few` best on the first mesh refined alone, where neighbours of a sweep will be
    /// starts again.
    pub(in crate::study) fn run_refining(
        &self,
        few: usize,
        problem: &Problem,
        given: Option<&Start>,
        monitor: &mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send),
    ) -> Result<Searched, PlanError> {
        let best = move |mut ended: Vec<Ended>| {
            let rest = ended.split_off(few.min(ended.len()));
            (ended, rest)
        };
        self.run_choosing((self.half(), &best), problem, given, monitor)
    }

    /// Half of the starts, which are from nothing.
    fn half(&self) -> usize {
        self.starts.max(1).div_ceil(2)
    }

    /// Solves from the straight path and `given` on the first mesh, and refines what is better there than
    /// `cost`; nothing where neither is.
    pub(in crate::study) fn from_given(
        problem: &Problem,
        given: &Start,
        cost: f64,
        monitor: &mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send),
    ) -> Result<Option<Plan>, PlanError> {
        let deadline = Deadline::after(problem.solver.time_limit);
        let teller = Teller::new(monitor);
        let (search, mut optima) = (Self { starts: 2, seed: 0 }, Optima::default());
        let task = (problem, Some(given));
        let ended = search.try_starts(2, task, &|| (), &mut optima, &teller)?;
        let better = |one: &Ended| one.optimum.objective < cost * (1.0 - MESHES);
        let best = ended.into_iter().next().filter(better);
        let refining = Refining {
            problem,
            deadline,
            teller: &teller,
        };
        best.map(|one| refining.alone(&one)).transpose()
    }

    fn run_choosing(
        &self,
        (fresh, choose): (usize, &Choose),
        problem: &Problem,
        given: Option<&Start>,
        monitor: &mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send),
    ) -> Result<Searched, PlanError> {
        let began = Instant::now();
        let deadline = Deadline::after(problem.solver.time_limit);
        let teller = Teller::new(monitor);
        let mut optima = Optima {
            seed: self.seed,
            ..Optima::default()
        };
        let bounds = OnceLock::new();
        let beside = || {
            bounds.get_or_init(|| LowerBounds::new(problem, deadline));
        };
        let ended = self.try_starts(fresh, (problem, given), &beside, &mut optima, &teller)?;
        let (best, mut rest) = choose(ended);
        let refining = Refining {
            problem,
            deadline,
            teller: &teller,
        };
        let Refinements {
            mut refined,
            left,
            others,
        } = refining.hopeful(best)?;
        refined.sort_by(|a, b| {
            let unsolved = |one: &Refined| one.plan.status != Status::Solved;
            let costs = a.plan.objective.total_cmp(&b.plan.objective);
            unsolved(a).cmp(&unsolved(b)).then(costs)
        });
        for one in &refined {
            list(&mut optima.found, one);
        }
        rest.extend(others);
        for one in left {
            match optima.found.iter_mut().find(|known| one.is_alike(known)) {
                Some(known) => known.hits += one.ended.optimum.hits,
                None => rest.push(one.ended),
            }
        }
        rest.sort_by(better_first);
        optima
            .found
            .extend(rest.into_iter().map(|ended| ended.optimum));
        let best = refined.into_iter().next().map(|one| one.plan);
        let plan = match best {
            Some(plan) if plan.status == Status::Solved || teller.has_stopped() => plan,
            best => {
                let problem = refining.in_time()?;
                let (candidate, of) = (1, 1);
                let plan = Planner::new().plan_with(&problem, given, &mut |&event| {
                    teller.tell(&SearchEvent::Refining {
                        candidate,
                        of,
                        event,
                    })
                })?;
                // Neither converged: the better of two that come as near.
                let better = |best: &Plan| {
                    [best, &plan].map(|plan| plan.status) == [Status::NotConverged; 2]
                        && best.max_error <= plan.max_error.max(plan.tolerance)
                        && best.objective < plan.objective
                };
                best.filter(better).unwrap_or(plan)
            }
        };
        let bounds = bounds.into_inner().flatten();
        optima.bounds = bounds.filter(|_| plan.status == Status::Solved);
        optima.time = began.elapsed();
        Ok(Searched { plan, optima })
    }

    /// Distinct optima on the first mesh, the best first, of so many `fresh` starts and of those that
    /// perturb what was found. Does what is to be done `beside` them once.
    fn try_starts(
        &self,
        fresh: usize,
        (problem, given): (&Problem, Option<&Start>),
        beside: &(dyn Fn() + Sync),
        optima: &mut Optima,
        teller: &Teller<'_>,
    ) -> Result<Vec<Ended>, PlanError> {
        let limit = problem.solver.time_limit;
        let deadline = Deadline::after(limit.map(|limit| limit.mul_f64(SEARCHING)));
        let tried = AtomicUsize::new(0);
        let least = Mutex::new(f64::INFINITY);
        let report = |ended: &Option<Ended>| {
            let mut least = least.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(ended) = ended {
                *least = least.min(ended.optimum.objective);
            }
            teller.tell(&SearchEvent::Tried {
                tried: tried.fetch_add(1, Ordering::Relaxed) + 1,
                of: self.starts,
                best: *least,
            });
        };
        let starts = self.starts.max(1);
        let results = Results::new(fresh, PERTURBED);
        with_system!(&System::new(problem), system => {
            let first_mesh = FirstMesh::new(problem, system, given, self.seed)?;
            let one = |start: usize| -> Result<Option<Ended>, PlanError> {
                let bests = match start < fresh {
                    true => Vec::new(),
                    false => results.best_before(start),
                };
                if teller.has_stopped() || deadline.has_passed() {
                    return Ok(None);
                }
                let mut steps = 0;
                let mut answer = || {
                    steps += 1;
                    if steps == SLOW {
                        results.mark_slow(start);
                    }
                    teller.answer()
                };
                let ended = first_mesh.solve(start, &bests, deadline, &mut answer)?;
                report(&ended);
                Ok(ended)
            };
            parallel::map_sharing(starts + 1, &|piece| match piece < starts {
                true => results.run_next(one),
                false => beside(),
            });
        });
        optima.tried = tried.into_inner();
        let (found, solved) = results.into_distinct()?;
        optima.solved = solved;
        Ok(found)
    }
}

/// The best few and what a plan without a search would begin with, so that a search is not worse; and the
/// others.
fn chosen(ended: Vec<Ended>) -> (Vec<Ended>, Vec<Ended>) {
    let best = ended.first();
    let least = best.map_or(f64::INFINITY, |one| one.optimum.objective);
    let mut rank = 0;
    ended.into_iter().partition(|one| {
        rank += 1;
        let cost = one.optimum.objective;
        let near = rank <= MOST_REFINED && cost - NEAR * cost.abs() <= least;
        rank <= REFINED || near || one.is_default()
    })
}

/// Adds what `refined` came to, or counts it to what is the same.
fn list(found: &mut Vec<Optimum>, refined: &Refined) {
    let optimum = refined.optimum();
    let known = found
        .iter_mut()
        .find(|known| known.status == optimum.status && same(known, &optimum));
    match known {
        Some(known) => known.hits += optimum.hits,
        None => found.push(optimum),
    }
}
