//! The planners by name.

use crate::refine;

/// How a plan is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Direct collocation of the problem itself, refined adaptively or globally.
    Collocation(refine::Method),
    /// Direct collocation with the integral of the base rate as the only cost (Schulz).
    BaseRate,
    /// Least largest acceleration of every joint.
    Matpm,
    /// The straight joint path with quintic timing.
    StraightLine,
    /// Joint rates in the null space of the coupling between arm and base (Nenchev).
    ReactionNullSpace,
    /// A convex quadratic programme in the joint accelerations at every time step (Lu et al.).
    AccelerationQp,
}

impl Method {
    /// All of them, in the order of a comparison.
    pub const ALL: [Self; 7] = [
        Self::Collocation(refine::Method::Adaptive),
        Self::Collocation(refine::Method::Global),
        Self::BaseRate,
        Self::Matpm,
        Self::StraightLine,
        Self::ReactionNullSpace,
        Self::AccelerationQp,
    ];

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Collocation(method) => method.name(),
            Self::BaseRate => "base-rate",
            Self::Matpm => "matpm",
            Self::StraightLine => "straight-line",
            Self::ReactionNullSpace => "reaction-null-space",
            Self::AccelerationQp => "acceleration-qp",
        }
    }

    /// What it does, in a line.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Collocation(refine::Method::Adaptive) => "Adaptive Radau pseudospectral method",
            Self::Collocation(refine::Method::Global) => "Global Radau pseudospectral method",
            Self::BaseRate => "A-RPM with the integral of the base rate as its only cost",
            Self::Matpm => "Least largest joint acceleration: bang-bang, or bang-cruise-bang",
            Self::StraightLine => "Straight joint path with quintic timing",
            Self::ReactionNullSpace => "Joint rates that leave the base at rest",
            Self::AccelerationQp => {
                "A quadratic programme in the joint accelerations at every time step"
            }
        }
    }

    /// Whether it solves an optimal control problem, on a mesh that is refined.
    pub fn optimises(self) -> bool {
        matches!(self, Self::Collocation(_) | Self::BaseRate)
    }
}
