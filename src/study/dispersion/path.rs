//! The planned motion of the joints at any place of the mesh.

use super::base_rate::JointAt;
use super::tracking::HarmonicsAt;
use crate::transcription::Discretization;

/// The joints' path.
#[derive(Debug)]
pub(super) struct Path<'a> {
    plan: &'a Discretization,
    /// Parameters of the base attitude, which stand before the joints.
    parameters: usize,
    joints: usize,
}

impl<'a> Path<'a> {
    pub fn new(plan: &'a Discretization, parameters: usize, joints: usize) -> Self {
        Self {
            plan,
            parameters,
            joints,
        }
    }

    pub fn segments(&self) -> usize {
        self.plan.mesh.segments()
    }

    /// Fraction of the duration at τ of segment `s`.
    pub fn fraction(&self, s: usize, tau: f64) -> f64 {
        self.plan.mesh.fraction(s, tau)
    }

    /// Seconds a unit of τ in segment `s`.
    pub fn unit(&self, s: usize) -> f64 {
        0.5 * self.plan.mesh.width(s) * self.plan.duration
    }

    /// The joints at τ of segment `s`: positions and rates of their polynomials, which is what they
    /// then truly do.
    pub fn at(&self, s: usize, tau: f64) -> (Vec<JointAt>, HarmonicsAt) {
        let mut x = vec![0.0; self.plan.states];
        let mut dx = vec![0.0; self.plan.states];
        self.plan.state_in(s, tau, &mut x);
        self.plan.state_derivative_in(s, tau, &mut dx);
        let unit = self.unit(s);
        let joints = self.parameters..self.parameters + self.joints;
        let of = |(position, slope): (&f64, &f64)| {
            let (sin, cos) = position.sin_cos();
            JointAt {
                sin,
                cos,
                position: *position,
                rate: slope / unit,
            }
        };
        let at = x[joints.clone()].iter().zip(&dx[joints]).map(of);
        let harmonics = HarmonicsAt::new(self.fraction(s, tau), self.plan.duration);
        (at.collect(), harmonics)
    }
}
