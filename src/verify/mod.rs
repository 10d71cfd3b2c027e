//! Independent checks of a plan: re-integration of the full, unreduced dynamics, momentum and
//! energy balance. Shares no algorithm with [`crate::dynamics`] beyond the model's description.
//!
//! Of plans that are exact but for rounding (17 s, two to eight joints), the drift found is below
//! 1e-11 rad and m: what is above that belongs to the plan.
//!
//! | file | does |
//! | --- | --- |
//! | `bodies` | poses, velocities and momentum of all bodies by forward kinematics |
//! | `mass_matrix` | inertia matrix and bias of eq. (4) from body Jacobians, Schur complement (6) |
//! | `forward` | the full dynamics under the planned control, open loop |
//! | `replay` | the base where the joints follow the planned path |
//! | `pass` | one integration over all segments, compared with the plan at its nodes |

pub mod bodies;
mod forward;
pub mod mass_matrix;
mod pass;
mod polynomial;
mod replay;

use crate::problem::Problem;
use crate::transcription::Discretization;

/// What re-integration found: largest differences between plan and re-integration.
///
/// Drifts are taken at the nodes of the mesh, momentum and energy after every step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Verification {
    /// Base attitude: angle between the orientations, rad.
    pub max_base_attitude_drift: f64,
    /// Base position, m.
    pub max_base_position_drift: f64,
    /// Joint positions, rad or m.
    pub max_joint_drift: f64,
    /// Base attitude where the joints are made to follow the planned path, rad.
    pub replay_base_attitude_drift: f64,
    /// Base position where the joints are made to follow the planned path, m.
    pub replay_base_position_drift: f64,
    /// Largest departure of the linear momentum from what it was at t₀, kg m/s.
    pub max_linear_momentum: f64,
    /// Largest departure of the angular momentum about the system's mass centre, kg m²/s.
    pub max_angular_momentum: f64,
    /// Largest gap between kinetic energy and the joints' work, J.
    pub max_energy_gap: f64,
    /// Steps of the adaptive integrator.
    pub steps: usize,
}

/// A plan that could not be verified.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VerifyError {
    /// The plan is not one of this robot.
    #[error(
        "the plan has {found} {what}, robot '{robot}' needs {expected}; verify a plan with the problem it was made for"
    )]
    Shape {
        /// What is counted.
        what: &'static str,
        /// How many the plan has.
        found: usize,
        /// How many there should be.
        expected: usize,
        /// Name of the robot.
        robot: String,
    },
    /// A state or a control is not a number.
    #[error(
        "the plan's {what} at t = {time:.6} s is {value}, expected a finite number; the plan is damaged or planning failed, plan again"
    )]
    NotFinite {
        /// "state" or "control".
        what: &'static str,
        /// Time, s.
        time: f64,
        /// What stands there.
        value: f64,
    },
    /// The duration is not a time.
    #[error("the plan's duration is {0} s, expected a finite duration above zero")]
    Duration(f64),
    /// The integrator's step became shorter than time resolves.
    #[error(
        "re-integration of {pass} stops at t = {time:.6} s: no step is short enough for the tolerance; the planned control drives the motion out of range there, tighten the limits on joint rates and controls or refine the mesh"
    )]
    StepUnderflow {
        /// What was integrated.
        pass: &'static str,
        /// Time reached, s.
        time: f64,
    },
    /// Too many steps.
    #[error(
        "re-integration of {pass} gives up at t = {time:.6} s after {limit} steps; the planned motion is too fast to follow, tighten the limits on joint rates and controls or refine the mesh"
    )]
    StepLimit {
        /// What was integrated.
        pass: &'static str,
        /// Time reached, s.
        time: f64,
        /// Steps allowed.
        limit: usize,
    },
    /// The full inertia matrix could not be factored.
    #[error(
        "re-integration of {pass} stops at t = {time:.6} s: the full inertia matrix is not positive definite; check that no mass or inertia of the robot is many orders of magnitude below the others"
    )]
    Singular {
        /// What was integrated.
        pass: &'static str,
        /// Time reached, s.
        time: f64,
    },
}

/// Re-integrates the unreduced equations of motion (4) under the control of `plan`, whose states
/// are [η, θ, θ̇], and compares.
///
/// The control u = H⁻¹τ is turned into joint torques along the re-integrated motion and these are
/// applied open loop, so that the drift of the joints shows the collocation error of the plan.
/// A second pass makes the joints follow the planned path and integrates the base alone.
///
/// # Errors
/// [`VerifyError`] where plan and robot do not belong together or the integration gets stuck.
pub fn verify(problem: &Problem, plan: &Discretization) -> Result<Verification, VerifyError> {
    check(problem, plan)?;
    let mut found = Verification::default();
    let planned = || pass::Planned::new(problem, plan);
    pass::run(forward::Forward::new(planned()), plan, &mut found)?;
    pass::run(replay::Replay::new(planned()), plan, &mut found)?;
    Ok(found)
}

/// Whether `plan` has the states and controls of `problem`'s robot, all of them finite.
///
/// # Errors
/// [`VerifyError`] for the first thing that is wrong.
pub fn check(problem: &Problem, plan: &Discretization) -> Result<(), VerifyError> {
    let model = &problem.robot;
    let (parameters, _) = problem.attitude_sizes();
    shape(model.name(), parameters, model.joint_count(), plan)
}

fn shape(
    robot: &str,
    parameters: usize,
    n: usize,
    plan: &Discretization,
) -> Result<(), VerifyError> {
    let points = plan.mesh.points();
    let (states, controls) = (parameters + 2 * n, n);
    for (what, found, expected) in [
        ("states", plan.states, states),
        ("controls", plan.controls, controls),
        ("state values", plan.x.len(), (points + 1) * states),
        ("control values", plan.u.len(), points * controls),
    ] {
        if found != expected {
            return Err(VerifyError::Shape {
                what,
                found,
                expected,
                robot: robot.into(),
            });
        }
    }
    if !(plan.duration.is_finite() && plan.duration > 0.0) {
        return Err(VerifyError::Duration(plan.duration));
    }
    for (what, values, width) in [("state", &plan.x, states), ("control", &plan.u, controls)] {
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let time = plan.mesh.node_fractions()[i / width] * plan.duration;
            return Err(VerifyError::NotFinite {
                what,
                time,
                value: values[i],
            });
        }
    }
    Ok(())
}
