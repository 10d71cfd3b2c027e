//! Why a plan could not be verified.

/// A plan that could not be verified.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
    /// A drift, a momentum or the energy is not a number.
    #[error(
        "re-integration of {pass} cannot be compared with the plan at t = {time:.6} s: the difference is not a number; the planned state there describes no motion, plan again"
    )]
    Undefined {
        /// What was integrated.
        pass: &'static str,
        /// Time, s.
        time: f64,
    },
}
