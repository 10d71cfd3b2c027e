//! What is integrated, and why it may not be.

/// An ordinary differential equation dy/dt = f(t, y).
pub trait Ode {
    /// Why the right-hand side has no value.
    type Error;
    /// Writes dy/dt at `t` to `dy`.
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Error>;
}

/// Why an interval could not be crossed, each with the time reached.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IntegrationError<E> {
    /// The right-hand side has no value at the start of the interval.
    #[error("the right-hand side has no value at t = {0}")]
    Rate(f64, #[source] E),
    /// The step had to become shorter than time resolves.
    #[error("no step from t = {0} is short enough for the tolerance")]
    StepUnderflow(f64),
    /// The step limit was reached.
    #[error("the step limit was reached at t = {0}")]
    StepLimit(f64),
}
