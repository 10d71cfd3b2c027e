//! Largest magnitudes over all joints of a kind, which share their units.

use super::format::{centimetres, degrees};
use crate::dynamics::{JointKind, Model};
use crate::text::digits::digits;

/// Largest rate and effort of the joints of one kind.
pub(super) struct Peaks {
    kind: JointKind,
    rate: f64,
    effort: f64,
}

impl Peaks {
    /// Those of `robot`'s turning joints, then of its sliding ones, where it has any; `rates` and
    /// `efforts` by times and joints.
    pub fn of(robot: &Model, rates: &[Vec<f64>], efforts: &[Vec<f64>]) -> Vec<Self> {
        let kinds = [JointKind::Revolute, JointKind::Prismatic];
        let of = |kind| {
            let joints: Vec<usize> = (0..robot.joint_count())
                .filter(|&joint| robot.joints()[joint].kind == kind)
                .collect();
            let peak = |rows: &[Vec<f64>]| {
                let values = rows
                    .iter()
                    .flat_map(|row| joints.iter().filter_map(|&j| row.get(j)));
                values.fold(0.0, |most: f64, value| most.max(value.abs()))
            };
            (!joints.is_empty()).then(|| Self {
                kind,
                rate: peak(rates),
                effort: peak(efforts),
            })
        };
        kinds.into_iter().filter_map(of).collect()
    }

    /// What moves.
    pub fn label(&self) -> &'static str {
        match self.kind {
            JointKind::Revolute => "joints",
            JointKind::Prismatic => "sliding joints",
        }
    }

    /// How fast and how hard.
    pub fn describe(&self) -> String {
        let effort = digits(self.effort, 4, 3);
        match self.kind {
            JointKind::Revolute => {
                format!("at most {}/s and {effort} N·m", degrees(self.rate))
            }
            JointKind::Prismatic => {
                format!("at most {}/s and {effort} N", centimetres(self.rate))
            }
        }
    }
}
