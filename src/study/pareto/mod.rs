//! The trade-off between the base's motion and the joints' effort.
//!
//! The cost (14) is split into what is about the base, B, and what is about the joints, E. Its
//! minimisers with κB + E instead of B + E, κ from small to large, are points of the Pareto front
//! of the two: B falls and E rises along it, if no point's motion is better at another's κ than that
//! point's own. Where the front is not convex no κ leads, and B is bounded instead.
//!
//! | file | does |
//! | --- | --- |
//! | `gaps` | where neighbours are farthest apart, and how to get in between |
//! | `point` | one point of the front |
//! | `weights` | the factors κ, and the cost they weigh |

mod gaps;
mod point;
mod weights;

pub use point::ParetoPoint;
pub use weights::{balanced, factors};

use crate::nlp::{Control, Deadline};
use crate::planner::{Event, Plan, PlanError, Planner, Status, on_first_mesh};
use crate::problem::Problem;
use crate::refine::Start;
use crate::study::search::{Search, SearchEvent};
use crate::system::cost_terms;
use gaps::{By, Gap, widest};
use std::time::Duration;
use weights::scaled;

/// What is told of every step: the factor of the point that is planned, and the step.
type Monitor<'m> = dyn FnMut(f64, &SearchEvent<'_>) -> Control + Send + 'm;

/// A sweep over the factor.
#[derive(Debug)]
pub struct ParetoFront<'a> {
    problem: &'a Problem,
    planner: Planner,
    search: Option<Search>,
    deadline: Deadline,
    points: Vec<ParetoPoint>,
    /// Whether the monitor stopped a plan.
    stopped: bool,
}

/// What a point begins with.
enum Starts {
    /// The motion of another point alone.
    Given,
    /// That and a few more.
    Few,
    /// A search, that motion among its starts.
    Search(Search),
    /// Perturbations of that motion.
    Around,
}

/// Iterations on one mesh after which a plan from a neighbour's mesh and multipliers is given up: where
/// they serve it takes fewer, and where they do not it takes hundreds, on that neighbour's many points.
const WARM_ITERATIONS: u32 = 60;
/// Relative gain for which a point is planned again from a neighbour's motion.
const GAIN: f64 = 1e-6;
/// Starts at every point: the straight path, the plan before, the path through the reaction null space,
/// a detour, and the best of them perturbed.
const FEW_STARTS: usize = 8;
/// How many of what these end at are refined.
const FEW_REFINED: usize = 2;
/// There are searches at the largest factor, where optima are most, and at one so far below it, as a part of
/// the number of steps, where the front may go from one motion to another.
const SEARCHED: usize = 4;
/// Passes over all points in which motions are handed to neighbours.
const PASSES: usize = 3;

impl<'a> ParetoFront<'a> {
    /// The front of `problem`, whose cost should have weights on both sides, see [`balanced`].
    pub fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            planner: Planner::new(),
            search: None,
            deadline: Deadline::after(None),
            points: Vec::new(),
            stopped: false,
        }
    }

    /// The same with a search from many starts at every point, the plan before among them.
    pub fn searching(mut self, search: Search) -> Self {
        self.search(search);
        self
    }

    /// Searches from many starts at every point that is planned from now on.
    pub fn search(&mut self, search: Search) {
        self.search = Some(search);
    }

    /// The same within `limit` from now on, shared out among the points: each has an even part of what
    /// is left.
    pub fn within(self, limit: Duration) -> Self {
        Self {
            deadline: Deadline::after(Some(limit)),
            ..self
        }
    }

    /// Whether the monitor stopped a plan, be it one that was to replace a point and did not.
    pub fn was_stopped(&self) -> bool {
        self.stopped
    }

    /// The points found so far, in the order of their factors.
    pub fn points(&self) -> &[ParetoPoint] {
        &self.points
    }

    /// Plans for every factor in turn, each from the plan before and a few other starts; at the last one
    /// and at one below it from many, unless there is a search at every point.
    ///
    /// The problem is not convex, and a plan may stay with a motion that another has become better
    /// than. Where a neighbour's motion has the lower cost at a point's own factor, the point is
    /// planned again from there. Where the monitor stops it, the points until then stay.
    ///
    /// # Errors
    /// [`PlanError`] as of [`Planner::plan_with`].
    pub fn sweep(&mut self, factors: &[f64], monitor: &mut Monitor<'_>) -> Result<(), PlanError> {
        for (k, &factor) in factors.iter().enumerate() {
            let from = self.points.len().checked_sub(1);
            let left = factors.len() - k;
            let point = self.plan((factor, from), (self.starts(), left), monitor)?;
            self.points.push(point);
            if self.stopped {
                return Ok(());
            }
        }
        if let (None, Some(last)) = (&self.search, self.points.len().checked_sub(1)) {
            let below = last - last / SEARCHED;
            for k in [last, below] {
                if !self.is_over() {
                    self.search_at(k, monitor)?;
                }
            }
            self.descend(last, monitor)?;
            if !self.is_over() && self.search_around(below, monitor)? {
                self.descend(below, monitor)?;
            }
        } else if let Some(last) = self.points.len().checked_sub(1) {
            self.descend(last, monitor)?;
        }
        self.hand_on(monitor)
    }

    /// Searches from many starts at point `k`.
    fn search_at(&mut self, k: usize, monitor: &mut Monitor<'_>) -> Result<(), PlanError> {
        let factor = self.points[k].factor;
        // That of `plan --search`, which is not to find more. Half of the time left is for what follows.
        let many = Starts::Search(Search::default());
        let point = self.plan((factor, Some(k)), (many, 2), monitor)?;
        self.replace(k, point);
        Ok(())
    }

    /// Searches again at point `k`, around the motion that came of all before; whether it gained.
    fn search_around(&mut self, k: usize, monitor: &mut Monitor<'_>) -> Result<bool, PlanError> {
        let factor = self.points[k].factor;
        let point = self.plan((factor, Some(k)), (Starts::Around, 2), monitor)?;
        Ok(self.replace(k, point))
    }

    /// From point `first` down, solves each point on the first mesh from the motion of the point
    /// above, and refines what is better there. That motion itself need not be: the first sweep came
    /// from below, and a motion that serves large factors is left and found again by its own optimum.
    fn descend(&mut self, first: usize, monitor: &mut Monitor<'_>) -> Result<(), PlanError> {
        for k in (1..=first).rev() {
            let (above, below) = (k, k - 1);
            if self.is_over() {
                break;
            }
            if let Some(point) = self.plan_below(below, above, monitor)? {
                self.replace(below, point);
            }
        }
        Ok(())
    }

    /// Point `k` from the motion of point `above`, where that leads to less cost on the first mesh.
    fn plan_below(
        &mut self,
        k: usize,
        above: usize,
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<ParetoPoint>, PlanError> {
        let factor = self.points[k].factor;
        let problem = self.within_share(scaled(self.problem, factor)?, k + 1)?;
        let Some(start) = self.start(above) else {
            return Ok(None);
        };
        let own = &self.points[k];
        let cost = match own.is_solved() {
            true => own.scalarised(factor),
            false => f64::INFINITY,
        };
        let mut stopped = false;
        let told = &mut |event: &SearchEvent<'_>| {
            let answer = monitor(factor, event);
            stopped |= answer == Control::Stop;
            answer
        };
        let plan = Search::from_given(&problem, &start, cost, told)?;
        self.stopped |= stopped;
        Ok(plan.map(|plan| self.point(factor, plan)))
    }

    /// Puts `point` in the place of point `k` where it is better; whether it is.
    fn replace(&mut self, k: usize, point: ParetoPoint) -> bool {
        let own = &self.points[k];
        let factor = own.factor;
        let gains = point.scalarised(factor) < own.scalarised(factor) * (1.0 - GAIN);
        let better = point.is_solved() && (gains || !own.is_solved());
        if better {
            self.points[k] = point;
        }
        better
    }

    /// Up to `count` further points, one after another where solved neighbours are farthest apart: at the
    /// factor in the middle of theirs, and where no factor leads in between, since that part of the front
    /// is not convex, under a bound on the base's motion in the middle of theirs (the ε-constraint method,
    /// Y. Y. Haimes, L. S. Lasdon, D. A. Wismer, doi:10.1109/TSMC.1971.4308298).
    ///
    /// # Errors
    /// [`PlanError`] as of [`Planner::plan_with`].
    pub fn fill(&mut self, count: usize, monitor: &mut Monitor<'_>) -> Result<(), PlanError> {
        let mut closed = Vec::new();
        let mut left = count;
        while left > 0 && !self.is_over() {
            let Some(Gap { first: k, by }) = widest(&self.points, &closed) else {
                break;
            };
            let first = self.points[k].factor;
            let factor = (first * self.points[k + 1].factor).sqrt();
            let point = match by {
                By::Weights => self.plan((factor, Some(k)), (self.starts(), left), monitor)?,
                By::Bound => self.plan_bounded(k, factor, left, monitor)?,
            };
            let nothing_new = gaps::is_at_an_end(&point, &self.points[k..k + 2]);
            if nothing_new {
                closed.push((first, by));
            }
            // What weights lead to may be better than what stands there, and is handed on.
            if by == By::Weights || !nothing_new {
                self.points.insert(k + 1, point);
                left -= 1;
            }
            self.hand_on(monitor)?;
        }
        Ok(())
    }

    /// A point between point `k` and the next, with the base's motion bounded by the middle of both: the one
    /// with less effort of two, from the motion of either. The base weighs as little as anywhere on the
    /// front, so that the bound is what holds it.
    fn plan_bounded(
        &mut self,
        k: usize,
        factor: f64,
        left: usize,
        monitor: &mut Monitor<'_>,
    ) -> Result<ParetoPoint, PlanError> {
        let bound = 0.5 * (self.points[k].base + self.points[k + 1].base);
        let weight = self.points[0].factor;
        let bounded = scaled(self.problem, weight)?.edited(|problem| {
            let own = &mut problem.limits.base_motion;
            *own = own.min(weight * bound);
        })?;
        // The motion of the next point keeps the bound.
        let mut best = self.plan_under(&bounded, (k + 1, factor), 2 * left, monitor)?;
        if !self.is_over() {
            let first = self.plan_under(&bounded, (k, factor), 2 * left, monitor)?;
            if first.is_solved() && (!best.is_solved() || first.joints < best.joints) {
                best = first;
            }
        }
        best.bound = Some(bound);
        Ok(best)
    }

    /// The point of `problem`, whose base motion is bounded, from the motion of point `from`.
    fn plan_under(
        &mut self,
        problem: &Problem,
        (from, factor): (usize, f64),
        left: usize,
        monitor: &mut Monitor<'_>,
    ) -> Result<ParetoPoint, PlanError> {
        let problem = self.within_share(problem.clone(), left)?;
        let start = self.start(from).map(|start| Start {
            iterate: None,
            ..start
        });
        let plan = self.plan_from(&problem, start, &mut |&event| {
            monitor(factor, &SearchEvent::of_plan(event))
        })?;
        Ok(self.point(factor, plan))
    }

    /// Hands motions to neighbours where they are better, down and up, until none is.
    fn hand_on(&mut self, monitor: &mut Monitor<'_>) -> Result<(), PlanError> {
        let count = self.points.len();
        for _ in 0..PASSES {
            let mut gained = false;
            // Down, then up: a better motion may serve several points in a row.
            let down = (1..count).rev().map(|k| (k - 1, k));
            for (k, neighbour) in down.chain((1..count).map(|k| (k, k - 1))) {
                if self.is_over() {
                    return Ok(());
                }
                gained |= self.improve(k, neighbour, monitor)?;
            }
            if !gained {
                break;
            }
        }
        Ok(())
    }

    /// Plans point `k` again from the motion of `neighbour` where that is better; whether it gained.
    fn improve(
        &mut self,
        k: usize,
        neighbour: usize,
        monitor: &mut Monitor<'_>,
    ) -> Result<bool, PlanError> {
        let [own, other] = [k, neighbour].map(|i| &self.points[i]);
        let factor = own.factor;
        let better = other.scalarised(factor) < own.scalarised(factor) * (1.0 - GAIN);
        if own.bound.is_some() || !other.is_solved() || own.is_solved() && !better {
            return Ok(false);
        }
        let point = self.plan((factor, Some(neighbour)), (Starts::Given, 1), monitor)?;
        Ok(self.replace(k, point))
    }

    /// Whether the monitor stopped a plan, or the time is over.
    fn is_over(&self) -> bool {
        self.stopped || self.deadline.has_passed()
    }

    /// What a point begins with that is not planned yet.
    fn starts(&self) -> Starts {
        match &self.search {
            Some(search) => Starts::Search(search.clone()),
            None => Starts::Few,
        }
    }

    /// The point of a factor, from the motion of another point and other starts, in an even part of the
    /// time left for so many points.
    fn plan(
        &mut self,
        (factor, from): (f64, Option<usize>),
        (starts, left): (Starts, usize),
        monitor: &mut Monitor<'_>,
    ) -> Result<ParetoPoint, PlanError> {
        let problem = self.within_share(scaled(self.problem, factor)?, left)?;
        let start = from.and_then(|k| self.start(k));
        let told = &mut |event: &SearchEvent<'_>| monitor(factor, event);
        let plan = match starts {
            Starts::Search(search) => search.run(&problem, start.as_ref(), told)?.plan,
            Starts::Around => match &start {
                Some(start) => Search::default().run_around(&problem, start, told)?.plan,
                None => Search::default().run(&problem, None, told)?.plan,
            },
            Starts::Few => {
                let search = Search {
                    starts: FEW_STARTS,
                    // Others than at other points: what one finds is handed on to the rest.
                    seed: self.points.len() as u64,
                };
                let found = search.run_refining(FEW_REFINED, &problem, start.as_ref(), told)?;
                found.plan
            }
            Starts::Given => self.plan_from(&problem, start, &mut |&event| {
                monitor(factor, &SearchEvent::of_plan(event))
            })?,
        };
        Ok(self.point(factor, plan))
    }

    /// The motion of point `k` to start from, with its multipliers.
    fn start(&self, k: usize) -> Option<Start> {
        let plan = &self.points[k].plan;
        let usable = matches!(plan.status, Status::Solved | Status::NotConverged);
        usable.then(|| Start {
            trajectory: plan.discretization.clone(),
            iterate: Some(plan.iterate.clone()),
        })
    }

    /// The point that `plan` is.
    fn point(&mut self, factor: f64, plan: Plan) -> ParetoPoint {
        self.stopped |= plan.status == Status::Interrupted;
        let terms = cost_terms(self.problem, &plan.discretization);
        ParetoPoint {
            factor,
            bound: None,
            base: terms.base(),
            joints: terms.joints(),
            plan,
        }
    }

    /// Plans from `start`, and where its mesh and multipliers do not serve from its motion alone.
    fn plan_from(
        &mut self,
        problem: &Problem,
        start: Option<Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Plan, PlanError> {
        let Some(start) = start else {
            return self.planner.plan_with(problem, None, monitor);
        };
        let deadline = Deadline::after(problem.solver.time_limit);
        let few = problem.edited(|problem| {
            let most = &mut problem.solver.max_iterations;
            *most = (*most).min(WARM_ITERATIONS);
        })?;
        let warm = self.planner.plan_with(&few, Some(&start), monitor)?;
        if warm.status != Status::NotConverged || deadline.has_passed() {
            return Ok(warm);
        }
        let motion = Start {
            trajectory: on_first_mesh(problem, &start.trajectory)?,
            iterate: None,
        };
        let rest = problem.edited(|problem| problem.solver.time_limit = deadline.remaining())?;
        self.planner.plan_with(&rest, Some(&motion), monitor)
    }

    /// `problem` with an even part of the time left, where that is limited, for so many points.
    fn within_share(&self, problem: Problem, left: usize) -> Result<Problem, PlanError> {
        let Some(remaining) = self.deadline.remaining() else {
            return Ok(problem);
        };
        let share = remaining.div_f64(left as f64);
        let own = problem.solver.time_limit;
        let limit = own.map_or(share, |own| own.min(share));
        Ok(problem.edited(|problem| problem.solver.time_limit = Some(limit))?)
    }
}
