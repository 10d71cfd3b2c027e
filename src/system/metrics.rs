//! Figures of a planned motion: how far the base turns and moves, how fast and hard the joints work.
//!
//! The base angle is one figure wherever it is shown: the angle by which the base is turned out of
//! the axes that its attitude is counted from, those of the start unless the base starts turned. In
//! the plane that is the magnitude of the one angle, in space the angle of the shortest rotation,
//! whatever describes the attitude.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::motion::{Metrics, Trajectory};
use super::trajectory::resampled;
use crate::collocation::{Mesh, MeshError};
use crate::dynamics::Data;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::space::{Space, Vector};
use crate::numeric::largest_or_nan;
use crate::problem::Problem;
use crate::transcription::Discretization;

/// Even segments of the grid that extremes are looked for on, beside those of the plan's mesh.
const SEGMENTS: usize = 100;

/// The base angle at every time, rad.
pub fn base_angles(trajectory: &Trajectory) -> Vec<f64> {
    let rows = trajectory.base_attitude.iter();
    match trajectory.attitude {
        // Of a plan that has not converged a quaternion need not be of length one.
        Some(SpatialAttitude::Quaternion) => rows
            .map(|eta| SpatialAttitude::Quaternion.to_quaternion(eta).angle())
            .collect(),
        Some(attitude) => rows
            .map(|eta| attitude.squared_rotation_angle::<f64>(eta).sqrt())
            .collect(),
        None => rows
            .map(|eta| largest_or_nan(eta.iter().map(|a| a.abs())))
            .collect(),
    }
}

/// Distances of the base from where it started, m.
pub fn base_displacements(trajectory: &Trajectory) -> Vec<f64> {
    let rows = &trajectory.base_position;
    let from_start = |row: &Vec<f64>| {
        let squares = row.iter().zip(&rows[0]).map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    };
    rows.iter().map(from_start).collect()
}

/// The grid that curves are drawn on and extremes are looked for on: the breakpoints of the mesh,
/// where layers are, and even ones.
fn fine_mesh(plan: &Discretization) -> Result<Mesh, MeshError> {
    let even = (1..SEGMENTS).map(|k| k as f64 / SEGMENTS as f64);
    let own = plan.mesh.breakpoints().iter().copied();
    let mut cuts: Vec<f64> = own.chain(even).collect();
    cuts.sort_by(f64::total_cmp);
    // The end stays what it is.
    cuts.dedup_by(|next, last| *next - *last < 1e-9);
    let last = cuts.len() - 1;
    cuts[last] = 1.0;
    Mesh::new(cuts, &vec![2; last])
}

/// A planned motion between its nodes as well, as for a smooth curve; `None` where its mesh is too
/// fine for that.
pub fn finely(problem: &Problem, plan: &Discretization) -> Option<Trajectory> {
    Some(resampled(problem, plan, fine_mesh(plan).ok()?))
}

/// Figures of `plan`, whose motion at the nodes is `nodes`. Those of the base are looked for between
/// the nodes as well.
pub(crate) fn metrics<Sp: Space>(
    system: &FreeFloating<Sp>,
    plan: &Discretization,
    nodes: &Trajectory,
) -> Metrics {
    let peak = |rows: &[Vec<f64>]| largest_or_nan(rows.iter().flatten().map(|value| value.abs()));
    let last = |values: &[f64]| values.last().copied().unwrap_or(0.0);
    let between = fine_mesh(plan).map(|mesh| base_motion(system, &plan.resample(mesh)));
    let mut between = between.unwrap_or_default();
    // The end is a node, and known to the last digit.
    between.base_attitude.pop();
    between.base_position.pop();
    let most =
        |of: fn(&Trajectory) -> Vec<f64>| largest_or_nan(of(nodes).into_iter().chain(of(&between)));
    Metrics {
        max_base_attitude: most(base_angles),
        final_base_attitude: last(&base_angles(nodes)),
        max_base_displacement: most(base_displacements),
        final_base_displacement: last(&base_displacements(nodes)),
        peak_joint_velocity: peak(&nodes.joint_velocity),
        peak_joint_torque: peak(&nodes.joint_torque),
    }
}

/// A pose of the base at which [`metrics_of`] looks for its largest turn and displacement.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct WatchedPose {
    /// Fraction of the duration.
    pub fraction: f64,
    /// Base attitude η.
    pub attitude: Vec<f64>,
    /// Base position ζ, m.
    pub position: Vec<f64>,
}

/// The poses of the base that the figures of a plan are the largest of, in the order of time; the
/// last is the end.
pub fn watched_poses(problem: &Problem, plan: &Discretization) -> Vec<WatchedPose> {
    let of = |plan: &Discretization| {
        let motion = with_system!(&System::new(problem), system => base_motion(system, plan));
        let poses = motion.base_attitude.into_iter().zip(motion.base_position);
        let at = plan.mesh.node_fractions().into_iter().zip(poses);
        at.map(|(fraction, (attitude, position))| WatchedPose {
            fraction,
            attitude,
            position,
        })
        .collect::<Vec<_>>()
    };
    let mut between = fine_mesh(plan).map_or_else(|_| Vec::new(), |mesh| of(&plan.resample(mesh)));
    between.pop();
    let mut poses = of(plan);
    poses.extend(between);
    poses.sort_by(|a, b| a.fraction.total_cmp(&b.fraction));
    poses
}

/// Figures of a planned motion for `problem`.
pub fn metrics_of(problem: &Problem, plan: &Discretization) -> Metrics {
    with_system!(&System::new(problem), system => {
        metrics(system, plan, &super::trajectory::trajectory(system, plan))
    })
}

/// Everything a user wants to know at the nodes of a planned motion for `problem`.
pub fn at_nodes(problem: &Problem, plan: &Discretization) -> Trajectory {
    with_system!(&System::new(problem), system => super::trajectory::trajectory(system, plan))
}

/// Attitude and position of the base at the nodes of `plan`; all else stays empty.
fn base_motion<Sp: Space>(system: &FreeFloating<Sp>, plan: &Discretization) -> Trajectory {
    let (tree, attitude) = (system.tree(), system.attitude());
    let mut data = Data::<Sp, f64>::new(tree);
    let mut motion = Trajectory {
        t: plan.times(),
        attitude: attitude.in_space(),
        ..Trajectory::default()
    };
    for k in 0..=plan.mesh.points() {
        let (eta, joints) = plan.state(k).split_at(attitude.count());
        tree.kinematics(&joints[..system.joint_count()], &mut data);
        tree.momentum(&mut data);
        let position = system.base_position(eta, motion.t[k], &data);
        motion.base_attitude.push(eta.to_vec());
        motion.base_position.push(position.components().to_vec());
    }
    motion
}
