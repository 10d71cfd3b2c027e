//! Weights by a word: what matters more, the base or the joints, in units of the problem's own sizes.
//!
//! Derived in docs/algorithms.md#presets.

use super::cost::Cost;

/// A set of weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Preset {
    /// The base first: its attitude along the path and at the end.
    Still,
    /// The base and the joints' effort in balance.
    Gentle,
    /// The weights of the paper's example, whatever the robot.
    Paper,
}

/// Sizes of a problem's motion, all above zero.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Sizes {
    /// s.
    pub duration: f64,
    /// Largest base angle along the straight joint path, rad.
    pub base_angle: f64,
    /// Σ (q(t_f) − q(t₀))² over the joints, rad² or m².
    pub squared_travel: f64,
}

impl Sizes {
    /// Least base angle, rad, and least squared travel: of a motion that is nearly none.
    const LEAST: [f64; 2] = [1e-2, 1e-2];

    /// Those of a motion.
    pub fn new(duration: f64, base_angle: f64, squared_travel: f64) -> Self {
        Self {
            duration,
            base_angle: base_angle.max(Self::LEAST[0]),
            squared_travel: squared_travel.max(Self::LEAST[1]),
        }
    }
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Still, Self::Gentle, Self::Paper];

    /// The name in problem files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::Gentle => "gentle",
            Self::Paper => "paper",
        }
    }

    /// Weight of the base relative to the joints' effort, both measured on the straight path: with κ a base
    /// that turns by 1/√κ of the straight path's angle costs as much as the least effort of the way.
    fn base_over_effort(self) -> Option<f64> {
        match self {
            Self::Still => Some(1e3),
            Self::Gentle => Some(1e2),
            Self::Paper => None,
        }
    }

    /// Sets the weights in `cost`.
    pub fn weigh(self, sizes: &Sizes, cost: &mut Cost) {
        let Some(base) = self.base_over_effort() else {
            cost.final_base_attitude.fill(1.0);
            cost.final_base_position.fill(1.0);
            cost.base_rate.fill(0.6);
            cost.joint_rate.fill(0.2);
            return;
        };
        let &Sizes {
            duration,
            base_angle,
            squared_travel,
        } = sizes;
        cost.final_base_attitude.fill(base / base_angle.powi(2));
        let along = duration * base_angle.powi(2);
        cost.base_attitude.fill(base / along);
        // The least ∫‖θ̇‖² and, from rest to rest, ∫‖u‖² that the travel takes.
        cost.joint_rate.fill(duration / squared_travel);
        let effort = 12.0 * squared_travel / duration.powi(3);
        cost.control.fill(effort.recip());
    }
}
