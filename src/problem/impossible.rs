//! Why no motion can carry out a task, whatever plans it.

use super::limit_id::LimitId;
use super::unit::Unit;
use crate::ocp::Interval;
use std::fmt;

/// A moment at which a task says where the arm is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// t₀.
    Start,
    /// The way-point of that index.
    WayPoint(usize),
    /// t_f.
    Goal,
}

impl Place {
    /// The key of the joint positions there.
    fn joints(self) -> String {
        match self {
            Self::Start => "task.initial.joints".into(),
            Self::WayPoint(_) => format!("{self}.joints"),
            Self::Goal => LimitId::FinalJoints.to_string(),
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start => f.write_str("the start"),
            Self::WayPoint(index) => LimitId::WayPoint(*index).fmt(f),
            Self::Goal => f.write_str("the goal"),
        }
    }
}

/// One reason why no motion can carry out a task: what is asked for, and what there can be at most.
///
/// Each is a fact, whatever the path: a task without such a reason may be impossible all the same.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Impossible {
    /// A joint's way from one place to the next takes longer than there is.
    TooShort {
        /// Name of the joint.
        joint: String,
        /// Its unit of position.
        unit: Unit,
        /// Where its way begins and ends.
        between: [Place; 2],
        /// Its positions there, rad or m.
        positions: [f64; 2],
        /// The limit that keeps it from being faster.
        limit: LimitId,
        /// The largest rate there may be in that direction, rad/s or m/s; infinite for none.
        rate: f64,
        /// The time that this takes at least, s.
        least: f64,
        /// The time there is at most, s.
        available: f64,
    },
    /// An arm that moves at the start cannot come to rest in time.
    TooShortToStop {
        /// The limit that keeps it from stopping earlier.
        limit: LimitId,
        /// The time that it takes at least, s.
        least: f64,
        /// The time there is at most, s.
        available: f64,
    },
    /// A goal beyond the reach of the end effector.
    OutOfReach {
        /// The goal that it belongs to.
        goal: LimitId,
        /// Whether distances are from where the arm begins on the base, or from the system's mass
        /// centre.
        from_base: bool,
        /// The goal's distance, its tolerance taken off, m.
        distance: f64,
        /// The largest that the arm can reach, m.
        reach: f64,
    },
    /// Two solids that are to be kept apart overlap at a place that the task names.
    NotApart {
        /// The pair of `limits.keep_out`.
        pair: usize,
        /// Its name.
        name: String,
        /// Where.
        place: Place,
        /// How far they are within each other, m.
        overlap: f64,
    },
    /// The system's mass centre keeps the base outside of the box it may be in.
    BaseDisplacement {
        /// Where the joint positions are given.
        place: Place,
        /// The largest rotation angle that the limits on the attitude allow there, rad; `None` where the
        /// base is outside whatever its attitude.
        turned: Option<f64>,
        /// How far it is outside at the least, m.
        outside: f64,
    },
    /// The base turns too fast from the start.
    BaseRate {
        /// The component of the limit, and how many there are.
        component: [usize; 2],
        /// What a person calls it.
        name: String,
        /// Its rate at the start, rad/s.
        rate: f64,
        /// The limit.
        bound: Interval,
    },
    /// The base attitude at t_f is to be where it may never be.
    FinalBaseAttitude {
        /// The component of the limit, and how many there are.
        component: [usize; 2],
        /// The range at t_f, rad.
        at_end: Interval,
        /// The range along the path, rad.
        along: Interval,
    },
}

impl Impossible {
    /// The key that is to blame, as in the problem file.
    pub fn key(&self) -> String {
        let of = |limit: LimitId, [index, count]: [usize; 2]| match count {
            1 => limit.to_string(),
            _ => format!("{limit}[{index}]"),
        };
        match self {
            Self::TooShort { between, .. } => match between {
                [Place::Start, Place::Goal] => "task.duration".into(),
                [from, Place::Goal] => from.to_string(),
                [_, to] => to.to_string(),
            },
            Self::TooShortToStop { .. } => "task.duration".into(),
            Self::OutOfReach { goal, .. } => match goal {
                LimitId::WayPoint(_) => format!("{goal}.end_effector.position"),
                goal => format!("{goal}.position"),
            },
            Self::NotApart { place, .. } => place.joints(),
            Self::BaseDisplacement { .. } => LimitId::BasePosition.to_string(),
            Self::BaseRate { component, .. } => of(LimitId::BaseRate, *component),
            Self::FinalBaseAttitude { component, .. } => of(LimitId::FinalBaseAttitude, *component),
        }
    }

    /// What stands there, in words.
    pub fn found(&self) -> String {
        match self {
            Self::TooShort {
                joint,
                unit,
                between: [from, to],
                positions: [a, b],
                limit,
                rate,
                available,
                ..
            } => {
                let speed = format!("{}, {} {unit}/s", LimitId::JointVelocity, digits(*rate));
                let within = match limit {
                    LimitId::JointVelocity => speed,
                    // Acceleration to that rate.
                    limit if rate.is_finite() => format!("{limit} and {speed}"),
                    limit => limit.to_string(),
                };
                format!(
                    "{} s from {from} to {to}, too short for joint '{joint}' to go {} {unit} \
                     within {within}",
                    digits(*available),
                    digits(b - a)
                )
            }
            Self::TooShortToStop {
                limit, available, ..
            } => format!(
                "{} s, too short to stop the arm from task.initial.rates within {limit}",
                digits(*available)
            ),
            Self::OutOfReach {
                from_base,
                distance,
                ..
            } => {
                let from = match from_base {
                    true => "where the arm begins on the base",
                    false => "the system's mass centre",
                };
                format!("{} m from {from}", digits(*distance))
            }
            Self::NotApart {
                pair,
                name,
                overlap,
                ..
            } => format!(
                "the pair '{name}' of {}[{pair}] overlaps by {} m there",
                LimitId::KeepOut,
                digits(*overlap)
            ),
            Self::BaseDisplacement {
                place,
                turned,
                outside,
            } => {
                let attitude = match turned {
                    Some(angle) => format!("while it turns by {} rad at most", digits(*angle)),
                    None => "whatever its attitude".into(),
                };
                let outside = digits(*outside);
                format!(
                    "a box that the base is at least {outside} m outside of at {place}, {attitude}"
                )
            }
            Self::BaseRate {
                name, rate, bound, ..
            } => format!(
                "[{}, {}], while the {name} is {} rad/s at the start",
                bound.lower,
                bound.upper,
                digits(*rate)
            ),
            Self::FinalBaseAttitude { at_end, .. } => {
                format!("[{}, {}]", at_end.lower, at_end.upper)
            }
        }
    }

    /// What was expected, in words.
    pub fn expected(&self) -> String {
        match self {
            Self::TooShort { least, .. } | Self::TooShortToStop { least, .. } => {
                format!("at least {} s", digits(*least))
            }
            Self::OutOfReach { reach, .. } => {
                format!("at most {} m, as far as the arm can reach", digits(*reach))
            }
            Self::NotApart { .. } => "positions at which they are apart".into(),
            Self::BaseDisplacement { outside, .. } => format!(
                "{} m more room: joints do not move the system's mass centre",
                digits(*outside)
            ),
            Self::BaseRate { rate, .. } => format!("a range around {}", digits(*rate)),
            Self::FinalBaseAttitude { along, .. } => format!(
                "a range that meets {}, [{}, {}]",
                LimitId::BaseAttitude,
                along.lower,
                along.upper
            ),
        }
    }
}

impl fmt::Display for Impossible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {}; expected {}",
            self.key(),
            self.found(),
            self.expected()
        )
    }
}

impl std::error::Error for Impossible {}

/// Six significant digits at most, no trailing zeros.
fn digits(value: f64) -> String {
    let text = format!("{value:.5e}");
    text.parse::<f64>()
        .map_or(text, |value| (value + 0.0).to_string())
}
