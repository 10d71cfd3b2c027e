//! Momentum that the system starts with and keeps.

/// Total momentum of the system, constant along the motion; zero in the paper (Remark 1).
#[derive(Debug, Clone, PartialEq)]
pub struct Momentum {
    /// Linear momentum, inertial axes, kg m/s; two components in the plane, three in space.
    pub linear: Vec<f64>,
    /// Angular momentum about the system's mass centre, inertial axes, kg m²/s; one component in
    /// the plane, three in space.
    pub angular: Vec<f64>,
}

impl Momentum {
    /// No momentum, for a base with that many angles and lengths.
    pub fn zero(angles: usize, lengths: usize) -> Self {
        Self {
            linear: vec![0.0; lengths],
            angular: vec![0.0; angles],
        }
    }

    /// Whether there is none.
    pub fn is_zero(&self) -> bool {
        self.linear.iter().chain(&self.angular).all(|m| *m == 0.0)
    }
}
