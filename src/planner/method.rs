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

/// Those that are no method of collocation of the problem as it is.
const OTHERS: [Method; 5] = [
    Method::BaseRate,
    Method::Matpm,
    Method::StraightLine,
    Method::ReactionNullSpace,
    Method::AccelerationQp,
];

impl Method {
    /// All of them, in the order of a comparison.
    pub const ALL: [Self; refine::Method::ALL.len() + OTHERS.len()] = {
        let mut all = [Self::Matpm; _];
        let mut i = 0;
        while i < all.len() {
            all[i] = if i < refine::Method::ALL.len() {
                Self::Collocation(refine::Method::ALL[i])
            } else {
                OTHERS[i - refine::Method::ALL.len()]
            };
            i += 1;
        }
        all
    };

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
            Self::Collocation(method) => method.title(),
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
