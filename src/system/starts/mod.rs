//! Joint paths to begin a search with: many, unlike each other, the same for the same seed.
//!
//! The optima of one task differ by the way round they take: what turns the base back is a loop in
//! joint space, by the curvature of the momentum connection over the area it encloses. Small changes
//! of a start lead back to the same optimum, so loops and detours are wide: as wide as the joints'
//! limits and rates allow, up to more than a radian. Where bodies are kept apart, a way round them is
//! drawn again until one is free: a solver seldom pushes a path out of what it leads through.
//!
//! | file | does |
//! | --- | --- |
//! | `apart` | how deep a path leads into what is kept apart from the arm |
//! | `curvature` | which pairs of joints turn the base most by a loop |
//! | `perturb` | a detour or a loop on top of a trajectory |

mod apart;
mod curvature;
mod perturb;

use super::free_floating::FreeFloating;
use super::guess::{JointPath, Loop, along};
use crate::collocation::Mesh;
use crate::dynamics::JointKind;
use crate::dynamics::space::Space;
use crate::numeric::standard_normal;
use crate::ocp::Interval;
use crate::problem::Problem;
use crate::transcription::Discretization;
use apart::{Apart, SAMPLES};
use curvature::{Plane, planes};
use perturb::{OnTop, perturbed};
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
    /// An optimum that was found, with a detour or a loop on top of it.
    Perturbed,
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
            Self::Perturbed => "perturbed optimum",
            Self::Given => "given",
        })
    }
}

/// Joints that count as many: their arm has more ways round than loops of two joints.
const MANY: usize = 4;
/// Kinds of starts in turn, after the straight path: loops of two of many joints end where the straight
/// path does.
const TURNS: [StartKind; 1] = [StartKind::Detour];
/// The same of few joints.
const TURNS_OF_FEW: [StartKind; 3] = [StartKind::Loop, StartKind::Loop, StartKind::Detour];
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
/// The same of a detour: standard deviation of each joint.
const DETOURS: Interval = Interval {
    lower: 2.4,
    upper: 4.8,
};
/// The same of few joints, which are led around what is in their way rather than far aside.
const DETOURS_OF_FEW: Interval = Interval {
    lower: 0.6,
    upper: 2.4,
};
/// One of how many optima is perturbed by a loop: of few joints, and of many, where loops seldom lead away.
const LOOPS_OF_FEW: u8 = 2;
const LOOPS: u8 = 4;
/// Standard deviation of a detour on top of an optimum, as a part of [`Starts::reach`].
const BUMP: f64 = 3.0;
/// Radius that a joint without limits may go, rad.
const RADIAN: f64 = 1.0;
/// The least a sliding joint is taken to reach, m.
const LEAST_SLIDE: f64 = 0.05;
/// Largest rate of a loop of radius one over a time of one: 2π times that of a quintic.
const LOOP_RATE: f64 = TAU * 15.0 / 8.0;
/// How often a loop may go round: several narrow ones can turn the base more than one wide one.
const MOST_TURNS: u32 = 4;
/// Part of the largest rates that a loop may take.
const SHARE: f64 = 0.9;
/// Factor by which a loop is narrowed, and how often, where it leaves the joints' limits.
const NARROWED: f64 = 0.7;
const NARROWINGS: usize = 4;

/// Draws of a path in search of one that keeps apart what has to be.
const DRAWS: usize = 32;
/// Draws of a detour of many joints, of which that is taken whose base moves least, by the weights of
/// the cost: the cheapest of so many leads to better optima than any.
const CANDIDATES: usize = 40;
/// The mesh on which their cost is taken.
const SEGMENTS: usize = 20;
const POINTS: usize = 6;

/// Joint paths to begin with, by number.
#[derive(Debug)]
pub(crate) struct Starts<'a, Sp: Space> {
    problem: &'a Problem,
    system: &'a FreeFloating<Sp>,
    apart: Apart<'a, Sp>,
    planes: Vec<Plane>,
    /// How far each joint may go, rad or m.
    reach: Vec<f64>,
    seed: u64,
}

impl<'a, Sp: Space> Starts<'a, Sp> {
    /// Those of `problem`, whose system is `system`, by `seed`.
    pub fn new(problem: &'a Problem, system: &'a FreeFloating<Sp>, seed: u64) -> Self {
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
            system,
            apart: Apart::new(system),
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
        let mut random = self.random(index);
        let free = self.problem.task.free_joints.contains(&true);
        let turns: &[StartKind] = match free {
            true => &TURNS_TO_GOALS,
            false if self.reach.len() < MANY => &TURNS_OF_FEW,
            false => &TURNS,
        };
        let kind = turns[turn % turns.len()];
        let path = match kind {
            StartKind::Loop if !self.planes.is_empty() => self.free(|| self.looped(&mut random)),
            StartKind::OtherGoal => return (kind, self.to_another_goal(&mut random)),
            _ if self.reach.len() < MANY || free => {
                let path = self.free(|| self.detour(&mut random));
                return (StartKind::Detour, path);
            }
            _ => return (StartKind::Detour, self.best_detour(&mut random)),
        };
        (kind, path)
    }

    /// Of many detours that whose base moves least, or the first where nothing of that has a weight.
    fn best_detour(&self, random: &mut fastrand::Rng) -> JointPath {
        let mut best = self.free(|| self.detour(random));
        let mut least = self.base_cost(&best);
        for _ in 1..CANDIDATES {
            if least.is_nan() || least <= 0.0 {
                break;
            }
            let path = self.free(|| self.detour(random));
            let cost = self.base_cost(&path);
            if cost < least {
                (best, least) = (path, cost);
            }
        }
        best
    }

    /// What the cost counts of the base's motion along `path`.
    fn base_cost(&self, path: &JointPath) -> f64 {
        let Ok(mesh) = Mesh::uniform(SEGMENTS, POINTS) else {
            return f64::NAN;
        };
        let duration = self.problem.task.duration.center();
        let motion = along(self.system, duration, path, mesh);
        self.system.cost_terms(&motion).base()
    }

    /// The first of many paths that keeps apart what has to be, or the one that overlaps least.
    fn free(&self, mut draw: impl FnMut() -> JointPath) -> JointPath {
        let mut best = draw();
        let mut least = self.apart.overlap(&best);
        for _ in 1..DRAWS {
            if least <= 0.0 {
                break;
            }
            let path = draw();
            let overlap = self.apart.overlap(&path);
            if overlap < least {
                (best, least) = (path, overlap);
            }
        }
        best
    }

    /// Random numbers of start `index` alone, so that none depends on how many were drawn before.
    fn random(&self, index: usize) -> fastrand::Rng {
        let mut random = fastrand::Rng::with_seed(self.seed);
        fastrand::Rng::with_seed(random.u64(..) ^ index as u64)
    }

    /// `optimum` with a detour or a loop on top of it, as start `index`; the base is left as it is.
    pub fn perturbed(&self, optimum: &Discretization, index: usize) -> Discretization {
        let mut random = self.random(index);
        let legs = JointPath::new(self.problem, &[]);
        let loops = match self.reach.len() < MANY {
            true => LOOPS_OF_FEW,
            false => LOOPS,
        };
        let on_top = match random.u8(..loops) == 0 && !self.planes.is_empty() {
            true => OnTop::Loop(self.a_loop(&legs, &mut random)),
            false => {
                let (from, to) = legs.leg_at(random.f64());
                let off = |reach: &f64| BUMP * reach * normal(&mut random);
                OnTop::Bump {
                    offsets: self.reach.iter().map(off).collect(),
                    from,
                    to,
                }
            }
        };
        perturbed(optimum, &on_top, &self.problem.limits.joint_position)
    }

    /// The straight path with a loop of two joints on one of its legs.
    fn looped(&self, random: &mut fastrand::Rng) -> JointPath {
        let straight = JointPath::new(self.problem, &[]);
        let mut on_top = self.a_loop(&straight, random);
        for _ in 0..NARROWINGS {
            if self.is_within_limits(&straight.clone().with_loop(on_top)) {
                break;
            }
            on_top.radii = on_top.radii.map(|radius| NARROWED * radius);
        }
        straight.with_loop(on_top)
    }

    /// A loop on one of the legs of `path`, as wide as rates allow.
    fn a_loop(&self, path: &JointPath, random: &mut fastrand::Rng) -> Loop {
        let [i, j] = self.plane(random).joints;
        let mut radius = |joint: usize| between(random, RADII) * self.reach[joint];
        let mut radii = [radius(i), radius(j)];
        let (from, to) = path.leg_at(random.f64());
        let lasts = self.problem.task.duration.upper * (to - from);
        let turns = random.u32(1..=MOST_TURNS);
        for (radius, joint) in radii.iter_mut().zip([i, j]) {
            let fastest = self.problem.limits.joint_velocity[joint].upper;
            *radius = radius.min(SHARE * fastest * lasts / (LOOP_RATE * f64::from(turns)));
        }
        Loop {
            joints: [i, j],
            radii,
            phase: random.f64() * TAU,
            turns: f64::from(turns) * if random.bool() { 1.0 } else { -1.0 },
            from,
            to,
        }
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
        let sizes = match self.reach.len() < MANY {
            true => DETOURS_OF_FEW,
            false => DETOURS,
        };
        let legs = task.way_points.len() + 1;
        let aside = |k: usize, random: &mut fastrand::Rng| -> Vec<f64> {
            let along = (k + 1) as f64 / (points * legs + 1) as f64;
            let size = between(random, sizes);
            let mut joint = |j: usize| {
                let (a, b) = (task.initial_joints[j], task.final_joints[j]);
                let straight = a + along * (b - a);
                let off = size * normal(random) * self.reach[j];
                self.problem.limits.joint_position[j].clamp(straight + off)
            };
            (0..self.reach.len()).map(&mut joint).collect()
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
    // In (0, 1], so that the logarithm is finite.
    let radius = 1.0 - random.f64();
    standard_normal([radius, random.f64()])
}
