//! The descriptions of the base attitude in space, by name.

/// How the base attitude is described in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum SpatialAttitude {
    /// Roll φ, pitch ψ, yaw χ with R = Rz(χ)·Ry(ψ)·Rx(φ), as URDF. Singular at ψ = ±π/2.
    #[default]
    RollPitchYaw,
    /// Unit quaternion w, x, y, z. Singular nowhere.
    Quaternion,
    /// Modified Rodrigues parameters, tan(φ/4) along the axis. Singular at a full turn.
    Mrp,
}

impl SpatialAttitude {
    /// All there are.
    pub const ALL: [Self; 3] = [Self::RollPitchYaw, Self::Quaternion, Self::Mrp];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::RollPitchYaw => "roll-pitch-yaw",
            Self::Quaternion => "quaternion",
            Self::Mrp => "mrp",
        }
    }
}
