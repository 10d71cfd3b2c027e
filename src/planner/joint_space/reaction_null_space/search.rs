//! How far towards the goal joint paths lead along which the base does not turn.

use super::coupling::{Coupling, dot};
use super::path::{Field, Heading, Leg, PathPoint, distance};
use crate::dynamics::space::Space;
use crate::dynamics::{Data, Tree};
use crate::ocp::Interval;
use crate::planner::joint_space::joint_motion::THERE;

/// Longest step of arc length, rad.
const STEP: f64 = 2e-3;
/// A path towards the goal ends where its pull is this part of the distance left: all further
/// gain would be half the square of it.
const STALLED: f64 = 1e-3;
/// Distance from a limit that counts as at it, rad.
const AT_LIMIT: f64 = 1e-9;
/// Arc length after which a line is followed no further, rad.
const LINE: f64 = 40.0;
/// Most legs between joint limits.
const LEGS: usize = 100;

/// Why a path ends where it does.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum End {
    /// At the goal.
    Goal,
    /// There is no null space: as many independent rows as joints.
    NoNullSpace,
    /// The null space is a single line, and this is its point nearest to the goal; the line's
    /// ends, at joint limits or after a long way.
    Line([Vec<f64>; 2]),
    /// What is left of the way would turn the base.
    Stalled,
}

/// Paths of one task.
pub(super) struct Search<'a, Sp: Space> {
    pub tree: &'a Tree<Sp>,
    pub limits: &'a [Interval],
    pub goal: &'a [f64],
    data: Data<Sp, f64>,
}

impl<'a, Sp: Space> Search<'a, Sp> {
    pub fn new(tree: &'a Tree<Sp>, limits: &'a [Interval], goal: &'a [f64]) -> Self {
        Self {
            tree,
            limits,
            goal,
            data: Data::new(tree),
        }
    }

    /// The path from `start` as near to the goal as it gets, and why it ends there.
    pub fn run(&mut self, start: &[f64]) -> (Vec<Leg<'a, Sp>>, End) {
        if distance(start, self.goal) <= THERE {
            return (Vec::new(), End::Goal);
        }
        let free = vec![false; start.len()];
        let rank = Coupling::at(self.tree, start, &free, &mut self.data).rank();
        match start.len() - rank {
            0 => (Vec::new(), End::NoNullSpace),
            1 => self.along_line(start),
            _ => self.towards_goal(start),
        }
    }

    /// The only line through `start`, as far as its point nearest to the goal.
    fn along_line(&mut self, start: &[f64]) -> (Vec<Leg<'a, Sp>>, End) {
        let towards: Vec<f64> = (self.goal.iter().zip(start)).map(|(g, q)| g - q).collect();
        let field = |heading| Field {
            tree: self.tree,
            heading,
            locked: vec![false; start.len()],
        };
        // The goal may lie square to the line; any direction that does not will do as well.
        let mut side = towards;
        for j in 0..start.len() {
            let pull = field(Heading::Line(side.clone())).pull(start, &mut self.data);
            if dot(&pull, &pull).sqrt() > 1e-6 * dot(&side, &side).sqrt() {
                side = pull;
                break;
            }
            side = vec![0.0; start.len()];
            side[j] = 1.0;
        }
        let back = side.iter().map(|v| -v).collect();
        let mut both: Vec<Leg<'a, Sp>> = Vec::new();
        for side in [side, back] {
            let leg = Leg::new(field(Heading::Line(side)), start.to_vec(), &mut self.data);
            both.push(self.trace(leg));
        }
        let ends = [both[0].last().q.clone(), both[1].last().q.clone()];
        let (side, k) = self.nearest_mark(&both);
        let mut leg = both.swap_remove(side);
        self.cut_at_nearest(&mut leg, k);
        if distance(&leg.last().q, self.goal) <= THERE {
            return (vec![leg], End::Goal);
        }
        let legs = if leg.length > 0.0 {
            vec![leg]
        } else {
            Vec::new()
        };
        (legs, End::Line(ends))
    }

    /// Follows a line to the limits.
    fn trace(&mut self, mut leg: Leg<'a, Sp>) -> Leg<'a, Sp> {
        let locked = vec![false; self.limits.len()];
        while leg.length < LINE {
            let mark = leg.ahead(STEP, &mut self.data);
            if !mark.tangent.iter().all(|t| t.is_finite()) {
                break;
            }
            if self.outside(&mark.q, &locked) {
                let mark = self.up_to_limit(&leg, STEP, &locked);
                leg.push(mark);
                break;
            }
            leg.push(mark);
        }
        leg
    }

    fn nearest_mark(&self, legs: &[Leg<'a, Sp>]) -> (usize, usize) {
        let mut best = (f64::INFINITY, (0, 0));
        for (side, leg) in legs.iter().enumerate() {
            for (k, mark) in leg.marks.iter().enumerate() {
                let away = distance(&mark.q, self.goal);
                if away < best.0 - 1e-12 {
                    best = (away, (side, k));
                }
            }
        }
        best.1
    }

    /// Ends a leg where the distance from the goal is least, around its mark `k`.
    fn cut_at_nearest(&mut self, leg: &mut Leg<'a, Sp>, k: usize) {
        let nearing = |mark: &PathPoint, goal: &[f64]| -> bool {
            let left: Vec<f64> = goal.iter().zip(&mark.q).map(|(g, q)| g - q).collect();
            dot(&left, &mark.tangent) > 0.0
        };
        // The interval whose start still comes nearer and whose end no longer does.
        let from = if nearing(&leg.marks[k], self.goal) || k == 0 {
            k
        } else {
            k - 1
        };
        let room = match leg.marks.get(from + 1) {
            Some(next) if nearing(&leg.marks[from], self.goal) => next.s - leg.marks[from].s,
            _ => 0.0,
        };
        leg.marks.truncate(from + 1);
        leg.length = leg.last().s;
        if room == 0.0 {
            return;
        }
        let (mut low, mut high) = (0.0, room);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if nearing(&leg.ahead(middle, &mut self.data), self.goal) {
                low = middle;
            } else {
                high = middle;
            }
        }
        if low > 0.0 {
            let mark = leg.ahead(low, &mut self.data);
            leg.push(mark);
        }
    }

    /// Projected goal-directed rates: dθ/ds along P(θ)(θ_goal − θ). Joints at a limit that would
    /// leave it are held and let go again; the path rests where the set of them changes.
    fn towards_goal(&mut self, start: &[f64]) -> (Vec<Leg<'a, Sp>>, End) {
        let mut legs: Vec<Leg<'a, Sp>> = Vec::new();
        let mut q = start.to_vec();
        while legs.len() < LEGS {
            let locked = self.held(&q);
            let field = Field {
                tree: self.tree,
                heading: Heading::Goal(self.goal.to_vec()),
                locked: locked.clone(),
            };
            if let Some(end) = self.end(&field, &q) {
                return (legs, end);
            }
            let mut leg = Leg::new(field, q.clone(), &mut self.data);
            let end = loop {
                let pull = leg.field.pull(&leg.last().q, &mut self.data);
                // Where the pull fades its direction may turn quickly.
                let h = STEP.min(0.05 * dot(&pull, &pull).sqrt());
                let mark = leg.ahead(h, &mut self.data);
                if self.outside(&mark.q, &locked) {
                    let mark = self.up_to_limit(&leg, h, &locked);
                    leg.push(mark);
                    break None;
                }
                leg.push(mark);
                let end = self.end(&leg.field, &leg.last().q.clone());
                if end.is_some() || self.held(&leg.last().q.clone()) != locked {
                    break end;
                }
            };
            q.clone_from(&leg.last().q);
            legs.push(leg);
            if let Some(end) = end {
                return (legs, end);
            }
        }
        (legs, End::Stalled)
    }

    fn end(&mut self, field: &Field<'a, Sp>, q: &[f64]) -> Option<End> {
        let left = distance(q, self.goal);
        if left <= THERE {
            return Some(End::Goal);
        }
        let pull = field.pull(q, &mut self.data);
        (dot(&pull, &pull).sqrt() <= STALLED * left).then_some(End::Stalled)
    }

    /// Joints at a limit that the way to the goal would take beyond it.
    fn held(&mut self, q: &[f64]) -> Vec<bool> {
        let mut field = Field {
            tree: self.tree,
            heading: Heading::Goal(self.goal.to_vec()),
            locked: vec![false; q.len()],
        };
        loop {
            let pull = field.pull(q, &mut self.data);
            let leaving = (0..q.len()).find(|&j| {
                let bound = &self.limits[j];
                !field.locked[j]
                    && ((q[j] >= bound.upper - AT_LIMIT && pull[j] > 0.0)
                        || (q[j] <= bound.lower + AT_LIMIT && pull[j] < 0.0))
            });
            match leaving {
                Some(j) => field.locked[j] = true,
                None => return field.locked,
            }
        }
    }

    fn outside(&self, q: &[f64], locked: &[bool]) -> bool {
        let beyond = |j: usize| !locked[j] && self.limits[j].violation(q[j]) > 0.0;
        (0..q.len()).any(beyond)
    }

    /// The last posture within the limits, less than `h` beyond the last mark.
    fn up_to_limit(&mut self, leg: &Leg<'a, Sp>, h: f64, locked: &[bool]) -> PathPoint {
        let (mut low, mut high) = (0.0, h);
        while high - low > 1e-3 * AT_LIMIT {
            let middle = 0.5 * (low + high);
            let mark = leg.ahead(middle, &mut self.data);
            if self.outside(&mark.q, locked) {
                high = middle;
            } else {
                low = middle;
            }
        }
        leg.ahead(low, &mut self.data)
    }
}
