//! Distinct optima: what several starts ended at, counted once.

use crate::planner::{Start, Status};
use crate::system::StartKind;
use std::cmp::Ordering;

/// Relative difference of J, and difference of the base angles in rad, within which two starts ended
/// at the same optimum.
const SAME_COST: f64 = 1e-5;
const SAME_ANGLE: f64 = 1e-3;
/// The same where one of them is on a coarser mesh than the other, though not on the first.
const ALIKE_COST: f64 = 1e-3;
const ALIKE_ANGLE: f64 = 5e-3;

/// One optimum that starts ended at.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Optimum {
    /// Cost J: refined to the tolerance where `status` says solved, else on the first mesh.
    pub objective: f64,
    /// Largest base angle along the path, rad.
    pub max_base_attitude: f64,
    /// Base angle at t_f, rad.
    pub final_base_attitude: f64,
    /// How many starts ended here.
    pub hits: usize,
    /// The first of them, and of which kind it was.
    pub start: usize,
    /// Kind of that start.
    pub kind: StartKind,
    /// How its refinement ended; `None` where it was not refined.
    pub status: Option<Status>,
}

/// Where one start ended on the first mesh.
#[derive(Debug, Clone)]
pub(super) struct Ended {
    pub optimum: Optimum,
    /// Whether the solution on that mesh is far from any motion.
    pub gross: bool,
    /// That solution, to go on from.
    pub start: Start,
}

impl Ended {
    /// Whether a plan without a search would begin with it.
    pub fn is_default(&self) -> bool {
        self.optimum.start == 0 || self.optimum.kind == StartKind::Given
    }
}

/// `ended` added to `found`, those that ended at the same optimum counted as one; the
/// [best first](better_first).
pub(super) fn distinct(
    mut found: Vec<Ended>,
    ended: impl IntoIterator<Item = Ended>,
) -> Vec<Ended> {
    for one in ended {
        match found
            .iter_mut()
            .find(|other| same(&other.optimum, &one.optimum))
        {
            Some(known) => known.optimum.hits += one.optimum.hits,
            None => found.push(one),
        }
    }
    found.sort_by(better_first);
    found
}

/// The order of optima: the least J first, gross ones last.
pub(super) fn better_first(a: &Ended, b: &Ended) -> Ordering {
    let costs = a.optimum.objective.total_cmp(&b.optimum.objective);
    a.gross.cmp(&b.gross).then(costs)
}

/// Whether two are the same optimum.
pub(super) fn same(a: &Optimum, b: &Optimum) -> bool {
    within(a, b, (SAME_COST, SAME_ANGLE))
}

/// The same for one on its last mesh and one on a coarser mesh.
pub(super) fn alike(a: &Optimum, b: &Optimum) -> bool {
    within(a, b, (ALIKE_COST, ALIKE_ANGLE))
}

fn within(a: &Optimum, b: &Optimum, (cost, angle): (f64, f64)) -> bool {
    let largest = a.objective.abs().max(b.objective.abs());
    let near = |x: f64, y: f64| (x - y).abs() <= angle;
    (a.objective - b.objective).abs() <= cost * largest
        && near(a.max_base_attitude, b.max_base_attitude)
        && near(a.final_base_attitude, b.final_base_attitude)
}
