//! What a replay says of one sample.

/// Figures of one sample; the first four as of a plan ([`crate::system::Metrics`]), looked for at the
/// same times.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Figures {
    /// Largest base angle, rad.
    pub max_base_attitude: f64,
    /// Base angle at t_f, rad.
    pub final_base_attitude: f64,
    /// Largest distance of the base from where it started, m.
    pub max_base_displacement: f64,
    /// Distance at t_f, m.
    pub final_base_displacement: f64,
    /// Rotation of the base at t_f out of the plan's attitude there, as a rotation vector in the
    /// plan's base axes, rad; in the plane the last component alone.
    pub departure: [f64; 3],
}

impl Figures {
    /// Angle of the base at t_f from the plan's attitude there, rad.
    pub fn departure_angle(&self) -> f64 {
        self.departure
            .iter()
            .map(|part| part * part)
            .sum::<f64>()
            .sqrt()
    }

    /// Whether all of them are numbers.
    pub(super) fn are_finite(&self) -> bool {
        let own = [
            self.max_base_attitude,
            self.final_base_attitude,
            self.max_base_displacement,
            self.final_base_displacement,
        ];
        own.iter()
            .chain(&self.departure)
            .all(|figure| figure.is_finite())
    }
}
