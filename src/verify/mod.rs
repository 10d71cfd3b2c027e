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
//! | `quaternion` | orientations in the integrated state |
//! | `pass` | one integration over all segments, compared with the plan at its nodes |
//! | `verification`, `error` | what was found, or why not |
//!
//! Derived in docs/algorithms.md#verification.

pub mod bodies;
mod error;
mod forward;
pub mod mass_matrix;
mod pass;
mod polynomial;
mod quaternion;
mod replay;
mod verification;

pub use error::VerifyError;
pub use verification::Verification;

use crate::problem::Problem;
use crate::transcription::Discretization;
use pass::From;

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
    let mut nothing = |_: &mut Verification| {};
    let forward = forward::Forward::new(planned());
    pass::run(forward, plan, From::Start, &mut found, &mut nothing)?;
    let replay = replay::Replay::new(planned());
    pass::run(replay, plan, From::Start, &mut found, &mut nothing)?;
    Ok(found)
}

/// The sum over all segments of how far the joints (rad or m) and the base's attitude (rad) leave `plan`
/// where the integration of [`verify`] begins anew at the start of each.
///
/// What the plan itself gets wrong adds up to this. A drift beyond it is what the motion makes of small
/// errors as they go on: it is unstable.
///
/// # Errors
/// [`VerifyError`], as of [`verify`].
pub fn drift_of_segments(
    problem: &Problem,
    plan: &Discretization,
) -> Result<[f64; 2], VerifyError> {
    check(problem, plan)?;
    let forward = forward::Forward::new(pass::Planned::new(problem, plan));
    let (mut found, mut sums) = (Verification::default(), [0.0; 2]);
    let mut add = |found: &mut Verification| {
        sums[0] += std::mem::take(&mut found.max_joint_drift);
        sums[1] += std::mem::take(&mut found.max_base_attitude_drift);
    };
    pass::run(forward, plan, From::EachSegment, &mut found, &mut add)?;
    Ok(sums)
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
