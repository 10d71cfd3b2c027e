//! Motions that make small errors large: no fault of their plan.

use super::Doubt;
use crate::problem::{Problem, Unit};
use crate::text::digits::digits;
use crate::transcription::Discretization;
use crate::verify::drift_of_segments;
use std::fmt;

/// Part of what a solved plan may drift by that all its segments together may, each for itself, where the
/// rest is put down to the motion.
const OWN: f64 = 0.1;

/// A motion that leaves its plan under its control alone, though each part of it keeps to the plan: a
/// sliding joint on a spinning base, say, where a small error grows as fast as the base turns.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Instability {
    /// What drifts the most, rad or m.
    pub drift: f64,
    /// Of that drift.
    pub unit: Unit,
    /// What the segments drift by themselves, all together, same unit.
    pub own: f64,
}

impl Instability {
    /// That behind a drift, where it is one.
    pub(super) fn behind(doubt: &Doubt, problem: &Problem, plan: &Discretization) -> Option<Self> {
        let (drift, room, unit, which) = match *doubt {
            Doubt::JointDrift {
                drift, room, unit, ..
            } => (drift, room, unit, 0),
            // A base that drifts where its joints are led is none of the control's doing.
            Doubt::BaseDrift {
                drift, room, led, ..
            } if led <= room => (drift, room, Unit::Radian, 1),
            _ => return None,
        };
        let own = drift_of_segments(problem, plan).ok()?[which];
        (own <= OWN * room).then_some(Self { drift, unit, own })
    }
}

impl fmt::Display for Instability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (factor, unit) = self.unit.readable();
        let shown = |value: f64| format!("{}{unit}", digits(value * factor, 2, 3));
        write!(
            f,
            "the motion is unstable under its control alone: what the plan leaves, {} in all, grows to \
             {} until the end; it needs a controller that follows it",
            shown(self.own),
            shown(self.drift)
        )
    }
}
