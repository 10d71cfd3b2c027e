//! One step of the replay: the base's attitude and position by Gauss-Legendre collocation.
//!
//! What is costly, the momentum of all bodies at the stages, does not depend on the base's attitude
//! and is computed once; the equations of the stages are then solved by iteration. The method keeps
//! the length of a quaternion.

use super::base_rate::{BaseRate, Frame, JointAt, base_rate};
use super::chain::Chain;
use super::gauss::Gauss;
use super::lanes::{Lanes, Quaternion, Vector};
use super::perturbed::Perturbed;
use super::tracking::HarmonicsAt;
use crate::numeric::raise_or_nan;

/// Most stages of a step.
pub(super) const MOST_STAGES: usize = 12;
/// Iterations after which the stages count as not found: the step is far too long.
const MOST_ITERATIONS: usize = 60;
/// Change of a quaternion that is rounding.
const ROUNDING: f64 = 4e-16;

/// Where the bases of all samples are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bases {
    /// Orientations: from base to inertial axes.
    pub orientation: Quaternion,
    /// Positions relative to the start, m.
    pub position: Vector,
    /// Angle about z that was turned through, rad; of use in the plane.
    pub angle: Lanes,
}

/// A place within a step at which the bases are asked for.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// Integral of each stage's polynomial to there.
    pub weights: Vec<f64>,
}

/// What the bases do at each stage of a step.
struct Stages<'a> {
    rate: &'a [Quaternion],
    velocity: &'a [Vector],
    omega: &'a [Vector],
}

/// A step with all that samples share.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// Length, s.
    pub seconds: f64,
    /// Its stages' number and the method's matrix.
    pub stages: usize,
    matrix: Vec<f64>,
    weights: Vec<f64>,
    /// Joints at each stage, stages × joints.
    joints: Vec<JointAt>,
    harmonics: Vec<HarmonicsAt>,
    pub places: Vec<Place>,
}

impl Step {
    /// A step by `gauss` of `seconds`; `at` is given each stage's place in [0, 1], `places` are those
    /// asked for.
    pub fn new(
        gauss: &Gauss,
        seconds: f64,
        places: &[f64],
        at: impl Fn(f64) -> (Vec<JointAt>, HarmonicsAt),
    ) -> Self {
        let mut step = Self {
            seconds,
            stages: gauss.nodes.len(),
            matrix: gauss.matrix.clone(),
            weights: gauss.weights.clone(),
            joints: Vec::new(),
            harmonics: Vec::new(),
            places: places
                .iter()
                .map(|place| Place {
                    weights: gauss.to(*place),
                })
                .collect(),
        };
        for node in &gauss.nodes {
            let (joints, harmonics) = at(*node);
            step.joints.extend(joints);
            step.harmonics.push(harmonics);
        }
        step
    }

    /// Takes `bases` to the end of the step; `found` is given the bases at each of the places in
    /// turn. `false` where the step is too long for any motion of the base to be found.
    #[inline(always)]
    pub fn take(
        &self,
        chain: &Chain,
        robots: &Perturbed,
        frames: &mut [Frame],
        bases: &mut Bases,
        mut found: impl FnMut(&Bases),
    ) -> bool {
        let s = self.stages;
        let n = chain.links.len();
        let mut still = [BaseRate::ZERO; MOST_STAGES];
        for (i, still) in still[..s].iter_mut().enumerate() {
            let joints = &self.joints[i * n..(i + 1) * n];
            *still = base_rate(chain, robots, joints, &self.harmonics[i], frames);
        }
        let mut omega = [Vector::ZERO; MOST_STAGES];
        let mut rate = [Quaternion::of([0.0; 4]); MOST_STAGES];
        let mut at = [bases.orientation; MOST_STAGES];
        let mut solved = false;
        for _ in 0..MOST_ITERATIONS {
            for i in 0..s {
                omega[i] = still[i].angular;
                if robots.spins {
                    omega[i] += still[i]
                        .per_momentum
                        .apply(at[i].turn_back(&robots.angular));
                }
                rate[i] = at[i].rate(&omega[i]);
            }
            let mut change = 0.0_f64;
            for (i, at) in at[..s].iter_mut().enumerate() {
                let next = self.sum(&bases.orientation, &rate, &self.matrix[i * s..][..s]);
                for (next, before) in next.0.iter().zip(&at.0) {
                    raise_or_nan(&mut change, (*next - *before).amax());
                }
                *at = next;
            }
            if change <= ROUNDING {
                solved = true;
                break;
            }
        }
        let mut velocity = [Vector::ZERO; MOST_STAGES];
        for i in 0..s {
            let moved = still[i].drag + omega[i].cross(still[i].center);
            velocity[i] = robots.velocity - at[i].turn(&moved);
        }
        let stages = Stages {
            rate: &rate[..s],
            velocity: &velocity[..s],
            omega: &omega[..s],
        };
        let start = *bases;
        for place in &self.places {
            found(&self.to(&start, &stages, &place.weights));
        }
        let end = self.to(&start, &stages, &self.weights);
        *bases = Bases {
            orientation: end.orientation.normalised(),
            ..end
        };
        solved
    }

    /// The bases where the stages count with `weights`.
    #[inline(always)]
    fn to(&self, start: &Bases, stages: &Stages<'_>, weights: &[f64]) -> Bases {
        let mut bases = *start;
        for (i, weight) in weights.iter().enumerate() {
            let weight = weight * self.seconds;
            let [x, y, z] = stages.velocity[i].0;
            bases.position += Vector([x * weight, y * weight, z * weight]);
            bases.angle += stages.omega[i].0[2] * weight;
            bases.orientation = bases.orientation.plus(&stages.rate[i], weight);
        }
        bases
    }

    #[inline(always)]
    fn sum(&self, start: &Quaternion, rates: &[Quaternion], weights: &[f64]) -> Quaternion {
        let mut sum = *start;
        for (rate, weight) in rates.iter().zip(weights) {
            sum = sum.plus(rate, weight * self.seconds);
        }
        sum
    }
}
