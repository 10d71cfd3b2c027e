//! What limits and weights have one component of.

use crate::dynamics::Model;
use crate::dynamics::space::{Algebra, Planar, Spatial};

/// What a limit or a weight has one component of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ComponentKind {
    /// A joint.
    Joint,
    /// An angle of the base attitude; the rotation angle where attitude is not given by angles.
    BaseAttitude,
    /// The rate of an angle of the base attitude, or the angular velocity along a base axis.
    BaseRate,
    /// A coordinate of the base position.
    BasePosition,
    /// The base as a whole: one.
    Base,
}

impl ComponentKind {
    /// Whether it is about the base rather than the joints.
    pub fn is_on_base(self) -> bool {
        self != Self::Joint
    }
}

/// Components of the angular velocity and of the position of the base of `robot`: 1 and 2 in the
/// plane, 3 and 3 in space.
pub(super) fn base_sizes(robot: &Model) -> (usize, usize) {
    if robot.plane().is_some() {
        (Planar::ANGLES, Planar::LENGTHS)
    } else {
        (Spatial::ANGLES, Spatial::LENGTHS)
    }
}
