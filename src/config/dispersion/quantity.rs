//! The quantities that a dispersion perturbs, and the keys they have on the command line.

use crate::dynamics::Model;

/// A quantity of the robot or its start that is not known exactly. Bodies are counted with the base
/// first, then those of the joints in the model's order; joints in that order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dispersed {
    /// Mass of a body, kg.
    Mass(usize),
    /// Displacement of a body's mass centre along each axis of the body's frame, m: three numbers in
    /// space, two in the plane.
    Com(usize),
    /// Factor on each of a body's principal second moments of mass, of which the rotational inertia
    /// is made: three numbers in space; one factor on the inertia in the plane. Whatever the factors
    /// are, as long as they are above zero, there is a body with that inertia.
    Inertia(usize),
    /// Constant error of a joint's position, rad or m.
    Offset(usize),
    /// Error of a joint's position that comes and goes, rad or m: a Fourier sum over the motion.
    Tracking(usize),
    /// Linear momentum beside the plan's own along each inertial axis, kg m/s.
    LinearMomentum,
    /// Angular momentum about the system's mass centre beside the plan's own about each inertial
    /// axis, kg m²/s; about the normal in the plane.
    AngularMomentum,
}

impl Dispersed {
    /// Its key: `body.NAME.mass`, `.com`, `.inertia`, `joint.NAME.offset`, `.tracking`,
    /// `momentum.linear` or `momentum.angular`.
    ///
    /// # Panics
    /// Where `model` has no such body or joint.
    pub fn key(self, model: &Model) -> String {
        let body = |b: usize| match b {
            0 => &model.base().name,
            b => &model.joints()[b - 1].body.name,
        };
        let joint = |j: usize| &model.joints()[j].name;
        match self {
            Self::Mass(b) => format!("body.{}.mass", body(b)),
            Self::Com(b) => format!("body.{}.com", body(b)),
            Self::Inertia(b) => format!("body.{}.inertia", body(b)),
            Self::Offset(j) => format!("joint.{}.offset", joint(j)),
            Self::Tracking(j) => format!("joint.{}.tracking", joint(j)),
            Self::LinearMomentum => "momentum.linear".into(),
            Self::AngularMomentum => "momentum.angular".into(),
        }
    }

    /// Unit of the value; empty for a factor.
    pub fn unit(self, model: &Model) -> &'static str {
        let of_joint = |j: usize| match model.joints()[j].kind {
            crate::dynamics::JointKind::Revolute => "rad",
            crate::dynamics::JointKind::Prismatic => "m",
        };
        match self {
            Self::Mass(_) => "kg",
            Self::Com(_) => "m",
            Self::Inertia(_) => "",
            Self::Offset(j) | Self::Tracking(j) => of_joint(j),
            Self::LinearMomentum => "kg m/s",
            Self::AngularMomentum => "kg m²/s",
        }
    }

    /// Its value in the plan: the mass, a factor of 1, or an error of 0.
    pub fn nominal(self, model: &Model) -> f64 {
        match self {
            Self::Mass(0) => model.base().inertia.mass(),
            Self::Mass(b) => model.joints()[b - 1].body.inertia.mass(),
            Self::Inertia(_) => 1.0,
            _ => 0.0,
        }
    }

    /// Whether only values above zero make sense.
    pub(super) fn is_positive(self) -> bool {
        matches!(self, Self::Mass(_) | Self::Inertia(_))
    }

    /// The largest magnitude that makes sense, in its unit.
    pub(super) fn most(self) -> f64 {
        match self {
            Self::Offset(_) | Self::Tracking(_) => std::f64::consts::PI,
            Self::Com(_) => 1e3,
            Self::Inertia(_) => 1e3,
            Self::Mass(_) | Self::LinearMomentum | Self::AngularMomentum => 1e12,
        }
    }

    /// All of `model`, a body after another, then the joints, then the momentum. Bodies without mass
    /// have nothing to perturb.
    pub(super) fn all(model: &Model) -> Vec<Self> {
        let bodies = (0..=model.joint_count()).filter(|b| Self::Mass(*b).nominal(model) > 0.0);
        let bodies = bodies.flat_map(|b| [Self::Mass(b), Self::Com(b), Self::Inertia(b)]);
        let joints = 0..model.joint_count();
        bodies
            .chain(joints.flat_map(|j| [Self::Offset(j), Self::Tracking(j)]))
            .chain([Self::LinearMomentum, Self::AngularMomentum])
            .collect()
    }
}
