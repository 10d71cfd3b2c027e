//! The file a robot was read from.

/// The file a robot was read from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotFile {
    /// Path, as found from the problem file.
    pub path: String,
    /// Its text.
    pub text: String,
}
