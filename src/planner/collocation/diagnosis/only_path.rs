//! Limits on the base's pose that the only path of an arm with one joint exceeds.
//!
//! Without momentum the pose follows from the joint's position, and every motion from start to goal takes
//! the joint through all positions between them. So what the straight path exceeds, each path does, by as
//! much, and no search is needed.

use super::findings::findings;
use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::ocp::Interval;
use crate::planner::{LimitFinding, PlanError};
use crate::problem::{LimitId, Problem};
use crate::system::{ElasticLimit, FreeFloating, JointPath, along};
use crate::transcription::Discretization;

/// The mesh on which the path is looked at.
const SEGMENTS: usize = 100;
const POINTS: usize = 5;
/// Part of an excess by which that of a plan may be larger: then it left the path.
const MORE: f64 = 1e-3;

/// The limits on the pose of a robot with one path, and by how much that exceeds them.
pub(in crate::planner::collocation) struct OnlyPath {
    limits: Vec<ElasticLimit>,
    exceeded: Vec<LimitFinding>,
}

impl OnlyPath {
    /// That of `problem`, where it has one path and that exceeds a limit.
    pub fn of<Sp: Space>(
        problem: &Problem,
        system: &FreeFloating<Sp>,
    ) -> Result<Option<Self>, PlanError> {
        let task = &problem.task;
        let is_only = problem.robot.joint_count() == 1
            && !task.free_joints[0]
            && task.way_points.is_empty()
            && task.initial_momentum.is_zero();
        if !is_only {
            return Ok(None);
        }
        let mut limits = system.elastic_limits();
        limits.retain(|limit| is_on_pose(limit.id.limit));
        let mesh = Mesh::uniform(SEGMENTS, POINTS)?;
        let path = JointPath::new(problem, &[]);
        let path = along(system, task.duration.center(), &path, mesh);
        let exceeded = findings(problem, system, &limits, &path);
        Ok((!exceeded.is_empty()).then_some(Self { limits, exceeded }))
    }

    /// The problem without its limits on the pose.
    ///
    /// # Errors
    /// [`PlanError`] where that is none.
    pub fn freed(&self, problem: &Problem) -> Result<Problem, PlanError> {
        let freed = problem.edited(|problem| {
            let limits = &mut problem.limits;
            limits.base_attitude.fill(Interval::FREE);
            limits.final_base_attitude.fill(Interval::FREE);
            limits.base_position.fill(Interval::FREE);
            limits.keep_out.clear();
        })?;
        Ok(freed)
    }

    /// What of the limits `trajectory`, a plan for the freed problem, exceeds; `None` where it is on another
    /// path, further than it has to go.
    pub fn findings<Sp: Space>(
        &self,
        problem: &Problem,
        system: &FreeFloating<Sp>,
        trajectory: &Discretization,
    ) -> Option<Vec<LimitFinding>> {
        let found = findings(problem, system, &self.limits, trajectory);
        let forced = |finding: &LimitFinding| {
            let same = |other: &&LimitFinding| {
                (other.limit, other.component) == (finding.limit, finding.component)
            };
            let forced = self.exceeded.iter().find(same)?;
            let is_on_path = finding.excess <= forced.excess * (1.0 + MORE);
            // Between the nodes of a plan the path may reach further than at them.
            let (a, b) = (finding.smallest_bound, forced.smallest_bound);
            is_on_path.then(|| LimitFinding {
                excess: finding.excess.max(forced.excess),
                smallest_bound: Interval::new(a.lower.min(b.lower), a.upper.max(b.upper)),
                ..finding.clone()
            })
        };
        found.iter().map(forced).collect()
    }
}

/// Whether a limit is on what follows from the joints' positions.
fn is_on_pose(limit: LimitId) -> bool {
    matches!(
        limit,
        LimitId::BaseAttitude
            | LimitId::FinalBaseAttitude
            | LimitId::BasePosition
            | LimitId::KeepOut
    )
}
