//! The base's motion without planning: along the straight joint path, and by MATPM.

use crate::numeric::largest_or_nan;
use crate::ocp::Interval;
use crate::planner::matpm_motion;
use crate::problem::Problem;
use crate::system::{Metrics, Trajectory, base_angles, straight_motion};
use crate::transcription::Discretization;

/// How far a base turns, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseMotion {
    /// The largest base angle on the way.
    pub largest: f64,
    /// That at t_f.
    pub last: f64,
}

impl BaseMotion {
    /// Of a motion.
    pub fn of(motion: &Trajectory) -> Self {
        let angles = base_angles(motion);
        Self {
            last: angles.last().copied().unwrap_or(0.0),
            largest: largest_or_nan(angles),
        }
    }

    /// Of a plan's figures.
    pub fn planned(metrics: &Metrics) -> Self {
        Self {
            largest: metrics.max_base_attitude,
            last: metrics.final_base_attitude,
        }
    }
}

/// What planning gained over the straight joint path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Gain {
    /// The base hardly turns along the straight path: there is nothing to gain.
    Needless,
    /// It ends turned much less, but turns no less on its way, or further.
    EndAlone,
    /// It neither turns nor ends turned by much less.
    Little,
    /// It turns and ends turned by much less.
    Clear,
}

/// Base angle that needs no planning, rad: a thousandth of a degree.
const NOTHING: f64 = 1.7e-5;
/// Part of the straight path's angle from which on little is gained.
const LITTLE: f64 = 0.8;

impl Gain {
    /// That of a plan beside the straight path.
    pub fn of(planned: BaseMotion, straight: BaseMotion) -> Self {
        let on_the_way = planned.largest < LITTLE * straight.largest;
        let at_the_end = planned.last < LITTLE * straight.last;
        match (on_the_way, at_the_end) {
            _ if straight.largest < NOTHING => Self::Needless,
            // The largest angle may be that of the end.
            (true, _) => Self::Clear,
            (false, true) => Self::EndAlone,
            (false, false) => Self::Little,
        }
    }
}

/// The base's motion between the ends of a plan without planning.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Baselines {
    /// Along the straight joint path.
    pub straight: Option<BaseMotion>,
    /// By MATPM.
    pub matpm: Option<BaseMotion>,
    /// The motion along the straight joint path, at [`STEPS`](Self::STEPS) even times more than one.
    pub straight_motion: Option<Trajectory>,
    /// The motion by MATPM, at times that are not even.
    pub matpm_motion: Option<Trajectory>,
}

impl Baselines {
    /// Even steps at which the straight path is looked at.
    pub const STEPS: usize = 120;

    /// Between where `plan` for `problem` begins and ends; nothing where its task is not from rest to
    /// rest.
    pub fn of(problem: &Problem, plan: &Discretization) -> Self {
        let Some(task) = joint_task(problem, plan) else {
            return Self::default();
        };
        let matpm = matpm_motion(&task);
        let straight = straight_motion(&task, plan.duration, Self::STEPS);
        Self {
            straight: Some(BaseMotion::of(&straight)),
            matpm: matpm.as_ref().map(BaseMotion::of),
            straight_motion: Some(straight),
            matpm_motion: matpm,
        }
    }
}

/// The task of moving the joints to where `plan` ends; `None` where the joints move at the start.
fn joint_task(problem: &Problem, plan: &Discretization) -> Option<Problem> {
    let task = &problem.task;
    if task.initial_rates.iter().any(|rate| *rate != 0.0) {
        return None;
    }
    let n = problem.robot.joint_count();
    let last = plan.state(plan.mesh.points());
    let reached = &last[last.len() - 2 * n..last.len() - n];
    let edited = problem.edited(|problem| {
        let task = &mut problem.task;
        task.final_joints = reached.to_vec();
        task.free_joints.fill(false);
        task.end_effector = None;
        task.way_points.clear();
        task.duration = Interval::fixed(plan.duration);
        // Where a plan ends need not be within the limits, which have no part in the straight path.
        problem.limits.joint_position.fill(Interval::FREE);
    });
    edited.ok()
}
