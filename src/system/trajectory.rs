//! The planned motion at the nodes.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::motion::Trajectory;
use super::torques::torques;
use crate::collocation::Mesh;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::Ocp;
use crate::problem::Problem;
use crate::transcription::Discretization;

/// Everything a user wants to know at every node of the mesh.
///
/// The control has no value of its own at t_f, which is not collocated: its polynomial is
/// extrapolated there and kept within its limits.
pub(crate) fn trajectory<Sp: Space>(
    problem: &FreeFloating<Sp>,
    plan: &Discretization,
) -> Trajectory {
    let n = problem.joint_count();
    let controls = problem.formulation().controls;
    let (tree, attitude) = (problem.tree(), problem.attitude());
    let mut data = Data::<Sp, f64>::new(tree);
    let mut out = Trajectory {
        t: plan.times(),
        attitude: attitude.in_space(),
        ..Trajectory::default()
    };
    for k in 0..=plan.mesh.points() {
        let (eta, joints) = plan.state(k).split_at(attitude.count());
        let (theta, dtheta) = joints.split_at(n);
        let mut u = vec![0.0; n];
        if k < plan.mesh.points() {
            u.copy_from_slice(plan.control(k));
        } else {
            plan.control_in(plan.mesh.segments() - 1, 1.0, &mut u);
            for (value, control) in u.iter_mut().zip(&controls) {
                *value = control.bounds.clamp(*value);
            }
        }
        tree.kinematics(theta, &mut data);
        tree.momentum(&mut data);
        problem.base_rate(eta, dtheta, &mut data);
        tree.mass_matrix(&mut data);
        let mut rates = data.base_rate.components().to_vec();
        if attitude.is_angles() {
            attitude.rates(eta, &data.base_rate, &mut rates);
        }
        let mut torque = vec![0.0; n];
        torques(&data.mass_matrix, &u, &mut torque);
        let position = problem.base_position(eta, out.t[k], &data);
        out.base_attitude.push(eta.to_vec());
        out.base_position.push(position.components().to_vec());
        out.base_rate.push(rates);
        out.joint_position.push(theta.to_vec());
        out.joint_velocity.push(dtheta.to_vec());
        out.control.push(u);
        out.joint_torque.push(torque);
    }
    out
}

/// The angles that limits on the base attitude are about, rad: those of each row, or its rotation
/// angle.
pub fn limited_angles(trajectory: &Trajectory) -> Vec<Vec<f64>> {
    let rows = trajectory.base_attitude.iter();
    match trajectory.attitude {
        Some(attitude) if !attitude.is_angles() => rows
            .map(|eta| vec![attitude.squared_rotation_angle::<f64>(eta).sqrt()])
            .collect(),
        _ => rows.cloned().collect(),
    }
}

/// A planned motion at the nodes of another mesh, as for a smooth curve.
pub fn resampled(problem: &Problem, plan: &Discretization, mesh: Mesh) -> Trajectory {
    let plan = plan.resample(mesh);
    with_system!(&System::new(problem), system => trajectory(system, &plan))
}
