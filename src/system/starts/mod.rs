//! Joint paths to begin a search with: many, unlike each other, the same for the same seed.
//!
//! The optima of one task differ by the way round they take: what turns the base back is a loop in
//! joint space, by the curvature of the momentum connection over the area it encloses. Small changes
//! of a start lead back to the same optimum, so loops and detours are wide: as wide as the joints'
//! limits and rates allow, up to more than a radian.
//!
//! | file | does |
//! | --- | --- |
//! | `curvature` | which pairs of joints turn the base most by a loop |

mod curvature;

use super::free_floating::FreeFloating;
use super::guess::{JointPath, Loop};
use crate::dynamics::JointKind;
use crate::dynamics::space::Space;
use crate::ocp::Interval;
use crate::problem::Problem;
use curvature::{Plane, planes};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use std::fmt;

/// How a start differs from the straight joint path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum StartKind {
    /// The straight joint path.
    Straight,
    /// A loop of two joints on top of it.
    Loop,
    /// Through a point or two aside.
    Detour,
    /// To other joint positions at the goal.
    OtherGoal,
    /// The path through the reaction null space.
    ReactionNullSpace,
    /// A trajectory that was given.
    Given,
}

impl fmt::Display for StartKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Straight => "straight path",
            Self::Loop => "loop",
            Self::Detour => "detour",
            Self::OtherGoal => "other joints at the goal",
            Self::ReactionNullSpace => "reaction null space",
            Self::Given => "given",
        })
    }
}

/// Kinds of starts in turn, after the straight path.
const TURNS: [StartKind; 3] = [StartKind::Loop, StartKind::Loop, StartKind::Detour];
/// The same where joints at the goal are for the planner to find.
const TURNS_TO_GOALS: [StartKind; 4] = [
    StartKind::Loop,
    StartKind::OtherGoal,
    StartKind::Loop,
    StartKind::Detour,
];
/// Widest and narrowest radius of a loop, as parts of [`Starts::reach`].
const RADII: Interval = Interval {
    lower: 0.4,
    upper: 1.2,
};
/// The same of a detour.
const DETOURS: Interval = Interval {
    lower: 1.2,
    upper: 2.4,
};
/// Radius that a joint without limits may go, rad.
const RADIAN: f64 = 1.0;
/// The least a sliding joint is taken to reach, m.
const LEAST_SLIDE: f64 = 0.05;
/// Largest rate of a loop of radius one over a time of one: 2π times that of a quintic.
const LOOP_RATE: f64 = TAU * 15.0 / 8.0;
/// Part of the largest rates that a loop may take.
const SHARE: f64 = 0.9;
/// Factor by which a loop is narrowed, and how often, where it leaves the joints' limits.
const NARROWED: f64 = 0.7;
const NARROWINGS: usize = 4;
/// Samples that tell whether a path leaves the joints' limits.
const SAMPLES: usize = 48;

/// Joint paths to begin with, by number.
#[derive(Debug)]
pub(crate) struct Starts<'a> {
    problem: &'a Problem,
    planes: Vec<Plane>,
    /// How far each joint may go, rad or m.
    reach: Vec<f64>,
    seed: u64,
}

impl<'a> Starts<'a> {
    /// Those of `problem`, whose system is `system`, by `seed`.
    pub fn new<Sp: Space>(problem: &'a Problem, system: &FreeFloating<Sp>, seed: u64) -> Self {
        let task = &problem.task;
        let ends = task.initial_joints.iter().zip(&task.final_joints);
        let middle: Vec<f64> = ends.map(|(a, b)| 0.5 * (a + b)).collect();
        let reach = reach(problem);
        let mut planes = planes(system, &middle);
        for plane in &mut planes {
            let [i, j] = plane.joints;
            plane.turn *= reach[i] * reach[j];
        }
        planes.sort_by(|a, b| b.turn.total_cmp(&a.turn));
        Self {
            problem,
            planes,
            reach,
            seed,
        }
    }

    /// Start `index`; the first is the straight path.
    pub fn path(&self, index: usize) -> (StartKind, JointPath) {
        let Some(turn) = index.checked_sub(1) else {
            return (StartKind::Straight, JointPath::new(self.problem, &[]));
        };
        // Each has numbers of its own, so that none depends on how many were asked for before.
        let mut random = fastrand::Rng::with_seed(self.seed.wrapping_add(index as u64));
        random.u64(..);
        let free = self.problem.task.free_joints.contains(&true);
        let kind = match free {
            true => TURNS_TO_GOALS[turn % TURNS_TO_GOALS.len()],
            false => TURNS[turn % TURNS.len()],
        };
        let path = match kind {
            StartKind::Loop if !self.planes.is_empty() => self.looped(&mut random),
            StartKind::OtherGoal => return (kind, self.to_another_goal(&mut random)),
            _ => return (StartKind::Detour, self.detour(&mut random)),
        };
        (kind, path)
    }

    /// The straight path with a loop of two joints on one of its legs.
    fn looped(&self, random: &mut fastrand::Rng) -> JointPath {
        let straight = JointPath::new(self.problem, &[]);
        let [i, j] = self.plane(random).joints;
        let mut radius = |joint: usize| between(random, RADII) * self.reach[joint];
        let mut radii = [radius(i), radius(j)];
        let (from, to) = straight.leg_at(random.f64());
        let lasts = self.problem.task.duration.upper * (to - from);
        for (radius, joint) in radii.iter_mut().zip([i, j]) {
            let fastest = self.problem.limits.joint_velocity[joint].upper;
            *radius = radius.min(SHARE * fastest * lasts / LOOP_RATE);
        }
        let phase = random.f64() * TAU;
        let turns = if random.bool() { 1.0 } else { -1.0 };
        let mut path = straight.clone();
        for _ in 0..NARROWINGS {
            path = straight.clone().with_loop(Loop {
                joints: [i, j],
                radii,
                phase,
                turns,
                from,
                to,
            });
            if self.is_within_limits(&path) {
                break;
            }
            radii = radii.map(|radius| NARROWED * radius);
        }
        path
    }

    /// A plane of two joints, those with large curvature more often.
    fn plane(&self, random: &mut fastrand::Rng) -> &Plane {
        let total: f64 = self.planes.iter().map(|plane| plane.turn).sum();
        let mut left = random.f64() * total;
        for plane in &self.planes {
            left -= plane.turn;
            if left <= 0.0 {
                return plane;
            }
        }
        &self.planes[0]
    }

    /// Through a point or two aside of the straight path, in random directions.
    fn detour(&self, random: &mut fastrand::Rng) -> JointPath {
        let task = &self.problem.task;
        let points = random.usize(1..=2);
        let legs = task.way_points.len() + 1;
        let aside = |k: usize, random: &mut fastrand::Rng| -> Vec<f64> {
            let along = (k + 1) as f64 / (points * legs + 1) as f64;
            let size = between(random, DETOURS);
            let direction: Vec<f64> = self.reach.iter().map(|_| normal(random)).collect();
            let norm = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
            let joint = |j: usize| {
                let (a, b) = (task.initial_joints[j], task.final_joints[j]);
                let straight = a + along * (b - a);
                let off = size * direction[j] / norm.max(f64::MIN_POSITIVE) * self.reach[j];
                self.problem.limits.joint_position[j].clamp(straight + off)
            };
            (0..direction.len()).map(joint).collect()
        };
        let detours: Vec<Vec<f64>> = (0..points * legs).map(|k| aside(k, random)).collect();
        JointPath::new(self.problem, &detours)
    }

    /// To other positions of the joints that are free at the goal.
    fn to_another_goal(&self, random: &mut fastrand::Rng) -> JointPath {
        let mut problem = self.problem.task.clone();
        for (j, free) in problem.free_joints.iter().enumerate() {
            if !free {
                continue;
            }
            let limits = self.problem.limits.joint_position[j];
            let known = problem.final_joints[j];
            let wide = PI * self.reach[j];
            let range = limits.intersect(&Interval::new(known - wide, known + wide));
            problem.final_joints[j] = between(random, range);
        }
        JointPath::of(&problem, &[])
    }

    fn is_within_limits(&self, path: &JointPath) -> bool {
        let n = self.reach.len();
        let (mut q, mut dq, mut ddq) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        (0..=SAMPLES).all(|k| {
            path.at_fraction(k as f64 / SAMPLES as f64, &mut q, &mut dq, &mut ddq);
            let limits = self.problem.limits.joint_position.iter().zip(&q);
            limits
                .into_iter()
                .all(|(limit, &q)| limit.violation(q) <= 0.0)
        })
    }
}

/// How far each joint may go: a radian, or what a sliding joint's limits or travel say.
fn reach(problem: &Problem) -> Vec<f64> {
    let task = &problem.task;
    let joint = |j: usize| {
        let limits = problem.limits.joint_position[j];
        let half = 0.5 * (limits.upper - limits.lower);
        match problem.robot.joints()[j].kind {
            JointKind::Prismatic if half.is_finite() => half,
            JointKind::Prismatic => {
                let travel = task.final_joints[j] - task.initial_joints[j];
                travel.abs().max(LEAST_SLIDE)
            }
            _ => RADIAN.min(half),
        }
    };
    (0..task.initial_joints.len()).map(joint).collect()
}

fn between(random: &mut fastrand::Rng, range: Interval) -> f64 {
    range.lower + random.f64() * (range.upper - range.lower)
}

/// A normally distributed number.
fn normal(random: &mut fastrand::Rng) -> f64 {
    let (a, b) = (1.0 - random.f64(), random.f64());
    (-2.0 * a.ln()).sqrt() * (TAU * b).cos()
}
