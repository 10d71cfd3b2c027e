//! Why a plan is not what it says.

use super::LimitFinding;
use super::conditioning::Conditioning;
use super::words::sentence;
use crate::problem::Unit;
use crate::text::digits::digits;
use crate::verify::VerifyError;
use std::fmt;

/// Why a plan is not what it says.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// It could not be integrated again.
    Unchecked(VerifyError),
    /// Under its control a joint leaves the plan.
    JointDrift {
        /// Name of the joint that drifts the most.
        joint: String,
        /// Of drift and room.
        unit: Unit,
        /// By how much it drifts.
        drift: f64,
        /// How much a solved plan may.
        room: f64,
        /// Where small errors are magnified the most.
        conditioning: Option<Conditioning>,
    },
    /// Under its control the base turns away from the plan.
    BaseDrift {
        /// By how much, rad.
        drift: f64,
        /// How much a solved plan may, rad.
        room: f64,
        /// By how much it drifts where the joints are led along their path, rad.
        led: f64,
        /// Where small errors are magnified the most.
        conditioning: Option<Conditioning>,
    },
    /// It begins or ends elsewhere than its task says.
    Ends {
        /// What a person calls the quantity.
        name: String,
        /// Of the quantity.
        unit: Unit,
        /// When, s.
        time: f64,
        /// Its value there.
        found: f64,
        /// What the task says.
        expected: f64,
    },
    /// It takes another time than its task gives.
    Duration {
        /// Of the plan, s.
        found: f64,
        /// The range of the task, s.
        expected: [f64; 2],
    },
    /// A figure that follows from its states and controls is another.
    Derived {
        /// What a person calls the quantity.
        name: &'static str,
        /// When, s.
        time: f64,
        /// What was saved, in SI units.
        found: f64,
        /// What follows, in SI units.
        expected: f64,
    },
    /// It exceeds limits at its nodes, or misses goals.
    Limits(Vec<LimitFinding>),
}

/// Condition number of the inertia matrix from which on it is worth a word.
const EXTREME: f64 = 1e3;

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LEAVES: &str = "re-integrated under its control, the motion leaves the plan";
        match self {
            Self::Unchecked(error) => write!(f, "the plan could not be checked: {error}"),
            Self::JointDrift {
                joint,
                unit,
                drift,
                room,
                conditioning,
            } => write!(
                f,
                "{LEAVES}: joint {joint} drifts by {}, more than the {} (a hundredth of the \
                 joints' travel) that a solved plan may; {}",
                quantity(*unit, *drift),
                quantity(*unit, *room),
                magnified(conditioning.as_ref())
            ),
            Self::BaseDrift {
                drift,
                room,
                led,
                conditioning,
            } => write!(
                f,
                "{LEAVES}: the base drifts by {}, more than the {} that a solved plan may; {}",
                quantity(Unit::Radian, *drift),
                quantity(Unit::Radian, *room),
                match led > room {
                    true => "so it does where the joints are led along their path, and its motion \
                             in the plan is not the one that they give it"
                        .into(),
                    false => magnified(conditioning.as_ref()),
                }
            ),
            Self::Ends {
                name,
                unit,
                time,
                found,
                expected,
            } => write!(
                f,
                "at {} s the {name} is {}, and the task has it at {}",
                digits(*time, 3, 2),
                quantity(*unit, *found),
                quantity(*unit, *expected)
            ),
            Self::Duration {
                found,
                expected: [lower, upper],
            } => match lower == upper {
                true => write!(
                    f,
                    "the motion takes {found} s, and the task gives it {lower} s"
                ),
                false => write!(
                    f,
                    "the motion takes {found} s, and the task gives it {lower} to {upper} s"
                ),
            },
            Self::Derived {
                name,
                time,
                found,
                expected,
            } => write!(
                f,
                "at {} s the {name} was saved as {found:e}, and {expected:e} follows from the motion",
                digits(*time, 3, 2)
            ),
            Self::Limits(limits) => f.write_str(&sentence(limits, |_, works| {
                format!("does not hold along the motion, which needs {works}")
            })),
        }
    }
}

/// Why the drift is as large, and what helps.
fn magnified(conditioning: Option<&Conditioning>) -> String {
    let helps = "a smaller mesh.tolerance brings it down";
    match conditioning {
        Some(found) if found.condition >= EXTREME => format!(
            "no more than {:.1e} {} resist joint {}, and the condition number of the inertia matrix H \
             reaches {:.1e} (at {} s), so that small errors of the control are large errors of the \
             motion; {helps}, and so does a heavier link or a locked joint",
            found.inertia,
            found.unit,
            found.joint,
            found.condition,
            digits(found.time, 3, 2)
        ),
        _ => helps.into(),
    }
}

/// A value as a person reads it.
fn quantity(unit: Unit, value: f64) -> String {
    let (factor, unit) = unit.readable();
    format!("{}{unit}", digits(value * factor, 2, 3))
}
