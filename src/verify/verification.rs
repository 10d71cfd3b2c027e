//! What re-integration found.

/// What re-integration found: largest differences between plan and re-integration.
///
/// Drifts are taken at the nodes of the mesh, momentum and energy after every step. All of them are
/// finite: [`verify`](super::verify) fails where one is not.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Verification {
    /// Base attitude: angle between the orientations, rad.
    pub max_base_attitude_drift: f64,
    /// Base position, m.
    pub max_base_position_drift: f64,
    /// Joint positions, rad or m.
    pub max_joint_drift: f64,
    /// The joint that drifts by that much.
    pub worst_joint: usize,
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

impl Verification {
    /// Whether one of the figures is not a finite number.
    pub(super) fn overflows(&self) -> bool {
        [
            self.max_base_attitude_drift,
            self.max_base_position_drift,
            self.max_joint_drift,
            self.replay_base_attitude_drift,
            self.replay_base_position_drift,
            self.max_linear_momentum,
            self.max_angular_momentum,
            self.max_energy_gap,
        ]
        .iter()
        .any(|figure| !figure.is_finite())
    }
}
