//! What is wrong with a problem.

/// A problem that cannot be: which key, what it holds and what was expected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{key}: {found}; expected {expected}")]
pub struct ProblemError {
    /// Key path as in the problem file (`limits.joint_velocity[1]`).
    pub key: String,
    /// What stands there.
    pub found: String,
    /// What was expected.
    pub expected: String,
}
