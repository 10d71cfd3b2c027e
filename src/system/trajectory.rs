//! The planned motion at the nodes, and at any time.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::motion::Trajectory;
use super::torques::torques;
use crate::collocation::Mesh;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Formulation, Ocp};
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
    let mut rows = Rows::new(problem);
    let last = plan.mesh.points();
    for (k, t) in plan.times().into_iter().enumerate() {
        if k < last {
            rows.add(t, plan.state(k), plan.control(k));
        } else {
            rows.add(t, plan.state(k), &rows.final_control(plan));
        }
    }
    rows.motion
}

/// A planned motion at `fractions` of its duration, from the polynomials of states and controls; at
/// the nodes it is that of [`at_nodes`](super::at_nodes).
pub fn at_fractions(problem: &Problem, plan: &Discretization, fractions: &[f64]) -> Trajectory {
    with_system!(&System::new(problem), system => {
        let mut rows = Rows::new(system);
        let (mut x, mut u) = (vec![0.0; plan.states], vec![0.0; plan.controls]);
        for &fraction in fractions {
            plan.at_fraction(fraction, &mut x, &mut u);
            if fraction == 1.0 {
                u = rows.final_control(plan);
            }
            rows.add(plan.time(fraction), &x, &u);
        }
        rows.motion
    })
}

/// A motion that is made row by row.
struct Rows<'a, Sp: Space> {
    problem: &'a FreeFloating<Sp>,
    formulation: Formulation,
    data: Data<Sp, f64>,
    motion: Trajectory,
}

impl<'a, Sp: Space> Rows<'a, Sp> {
    fn new(problem: &'a FreeFloating<Sp>) -> Self {
        Self {
            problem,
            formulation: problem.formulation(),
            data: Data::new(problem.tree()),
            motion: Trajectory {
                attitude: problem.attitude().in_space(),
                ..Trajectory::default()
            },
        }
    }

    /// The control at t_f.
    fn final_control(&self, plan: &Discretization) -> Vec<f64> {
        let mut u = vec![0.0; plan.controls];
        plan.control_in(plan.mesh.segments() - 1, 1.0, &mut u);
        for (value, control) in u.iter_mut().zip(&self.formulation.controls) {
            *value = control.bounds.clamp(*value);
        }
        u
    }

    /// Adds the instant `t` with the state `x` and the control `u`.
    fn add(&mut self, t: f64, x: &[f64], u: &[f64]) {
        let (problem, data, out) = (self.problem, &mut self.data, &mut self.motion);
        let (tree, attitude) = (problem.tree(), problem.attitude());
        let (eta, joints) = x.split_at(attitude.count());
        let (theta, dtheta) = joints.split_at(problem.joint_count());
        tree.kinematics(theta, data);
        tree.momentum(data);
        problem.base_rate(eta, dtheta, data);
        tree.mass_matrix(data);
        let mut rates = data.base_rate.components().to_vec();
        if attitude.is_angles() {
            attitude.rates(eta, &data.base_rate, &mut rates);
        }
        let mut torque = vec![0.0; u.len()];
        torques(&data.mass_matrix, u, &mut torque);
        let position = problem.base_position(eta, t, data);
        out.t.push(t);
        out.base_attitude.push(eta.to_vec());
        out.base_position.push(position.components().to_vec());
        out.base_rate.push(rates);
        out.joint_position.push(theta.to_vec());
        out.joint_velocity.push(dtheta.to_vec());
        out.control.push(u.to_vec());
        out.joint_torque.push(torque);
    }
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
