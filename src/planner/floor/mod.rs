//! What no motion can do better than: how far the base must turn, by its momentum alone.
//!
//! With one joint the base's attitude follows from the joint's angle. With two in the plane, paths
//! between the same ends differ by the curvature they enclose, and joints have a largest rate.

mod connection;
mod grid;
mod lower_bounds;
mod ranges;
mod step;
mod sweep;

pub use connection::{Connection, CurvatureBound};
pub use grid::Grid;
pub use lower_bounds::LowerBounds;
pub use sweep::Certainty;

use super::LimitFinding;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::numeric::largest_or_nan;
use crate::problem::{LimitId, Problem};
use crate::system::{Component, FreeFloating, straight_motion};

/// Angles and steps of the dynamic programme for two joints, together.
const WORK: f64 = 1e7;
/// Accuracy of its smallest bound, as a part of that bound.
const ACCURACY: f64 = 0.01;
/// Steps along a straight path.
const STEPS: usize = 1000;
/// Part of a bound that was found to work by which a floor may be above it: the tolerance of what
/// was found.
const CLOSE: f64 = 0.01;

/// Says of each finding about the base's attitude below which bound none can work, where that is
/// known and more than the bound asked for.
pub(super) fn add<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    findings: &mut [LimitFinding],
) {
    let attitude = |finding: &LimitFinding| {
        let about = matches!(
            finding.limit,
            LimitId::BaseAttitude | LimitId::FinalBaseAttitude
        );
        let symmetric = finding.bound.lower == -finding.bound.upper;
        about && (symmetric || finding.component == Component::RotationAngle)
    };
    if !findings.iter().any(attitude) || !problem.task.initial_momentum.is_zero() {
        return;
    }
    let floors = Floors::new(problem, system);
    for finding in findings.iter_mut().filter(|finding| attitude(finding)) {
        let (asked, works) = (finding.bound.upper, finding.smallest_bound.upper);
        finding.floor = floors
            .below(finding, asked, works)
            .filter(|&floor| floor > asked && floor <= works * (1.0 + CLOSE))
            .map(|floor| floor.min(works));
    }
}

/// Where floors come from.
enum Floors {
    /// The base's attitude on the way of the one joint, one row a step, with its rotation angle.
    OneJoint(Vec<(Vec<f64>, f64)>),
    TwoJoints(Box<Grid>),
    Unknown,
}

impl Floors {
    fn new<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>) -> Self {
        let task = &problem.task;
        if problem.robot.joint_count() == 1 && !task.free_joints[0] {
            let path = straight_motion(problem, task.duration.center(), STEPS);
            let turned = |x: &Vec<f64>| system.attitude().squared_rotation_angle(x).sqrt();
            let rows = path.base_attitude.into_iter();
            return Self::OneJoint(rows.map(|x| (x.clone(), turned(&x))).collect());
        }
        let grid = Grid::new(problem, WORK).map(Box::new);
        grid.map_or(Self::Unknown, Self::TwoJoints)
    }

    /// The bound of `finding` below which none can work, somewhere above `asked`.
    fn below(&self, finding: &LimitFinding, asked: f64, works: f64) -> Option<f64> {
        let at_end = finding.limit == LimitId::FinalBaseAttitude;
        match self {
            Self::OneJoint(path) => {
                let value = |(x, turned): &(Vec<f64>, f64)| match finding.component {
                    Component::Attitude(i) => x[i].abs(),
                    _ => *turned,
                };
                Some(match at_end {
                    true => path.last().map(value)?,
                    false => largest_or_nan(path.iter().map(value)),
                })
            }
            Self::TwoJoints(grid) if at_end => {
                let [low, high] = grid.reachable(f64::INFINITY, Certainty::Bound);
                // Empty where the goal is out of reach in time: no bound on the attitude helps.
                (low <= high).then(|| low.max(-high).max(0.0))
            }
            Self::TwoJoints(grid) => {
                let bound = grid.smallest_bound([asked, works], ACCURACY, Certainty::Bound);
                Some(bound)
            }
            Self::Unknown => None,
        }
    }
}
