//! Bounds on the reduced inertia matrix H that hold at all joint positions: how little energy there
//! is in the rate of a joint, and how much in the rates of all.
//!
//! Derived in docs/algorithms.md#least-time.

use super::algebra::{Algebra, Vector};
use super::reach::norm;
use super::tree::Link;
use super::{Data, JointKind, Tree};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Positions at which the inertia of a pair of bodies is computed; it varies slowly.
const SAMPLES: usize = 128;

/// Part of its largest value below which the inertia of a pair is taken as none.
const NONE: f64 = 1e-9;

impl<Sp: Algebra> Tree<Sp> {
    /// A number that (H⁻¹)ⱼⱼ exceeds nowhere, 1/(kg m²) or 1/kg; `None` where none is known.
    /// `range` is that of the joint's position.
    ///
    /// The least energy with a rate of one in joint j, whatever the others do, is at least that of
    /// the two bodies which it joins, were they alone.
    pub fn largest_mobility(&self, j: usize, range: [f64; 2]) -> Option<f64> {
        let [least, most] = self.pair_inertia(j, range)?;
        (least > NONE * most).then(|| 1.0 / least)
    }

    /// A number that θ̇ᵀHθ̇ exceeds nowhere for rates up to `rates`, twice an energy, J; infinite
    /// where a joint slides without end. `ranges` are those of the joints' positions.
    ///
    /// Without momentum the base moves so that there is no less energy: at most that with the base
    /// held.
    pub fn largest_energy(&self, rates: &[f64], ranges: &[[f64; 2]]) -> f64 {
        if let ([rate], [range]) = (rates, ranges)
            && let Some([_, most]) = self.pair_inertia(0, *range)
        {
            return most * rate * rate;
        }
        (0..self.links.len())
            .map(|body| {
                let [speed, turn] = self.largest_motion(body, rates, ranges);
                let link = &self.links[body];
                link.mass * speed * speed + largest_moment::<Sp>(&link.inertia) * turn * turn
            })
            .sum()
    }

    /// Largest speed of the mass centre of `body`, m/s, and its largest angular velocity, rad/s, on
    /// a base that is held.
    fn largest_motion(&self, body: usize, rates: &[f64], ranges: &[[f64; 2]]) -> [f64; 2] {
        let mut arm = norm::<Sp>(&self.links[body].center);
        let (mut speed, mut turn) = (0.0, 0.0);
        let mut at = Some(body);
        while let Some(k) = at {
            match self.links[k].kind {
                JointKind::Revolute => {
                    speed += rates[k] * arm;
                    turn += rates[k];
                }
                JointKind::Prismatic => {
                    speed += rates[k];
                    let [lower, upper] = ranges[k];
                    arm += lower.abs().max(upper.abs());
                }
            }
            arm += norm::<Sp>(&self.links[k].offset);
            at = self.links[k].parent;
        }
        [speed, turn]
    }

    /// The least and the largest reduced inertia of joint `j` between the two bodies that it joins,
    /// were they alone, over `range`; `None` where that is no number.
    fn pair_inertia(&self, j: usize, range: [f64; 2]) -> Option<[f64; 2]> {
        let [lower, upper] = match self.links[j].kind {
            // Beyond one turn it is the same again.
            JointKind::Revolute if range[1] - range[0] < TAU => range,
            JointKind::Revolute => [0.0, TAU],
            JointKind::Prismatic => range,
        };
        if !(lower.is_finite() && upper.is_finite()) {
            return None;
        }
        let pair = self.pair(j);
        let mut data = Data::<Sp, f64>::new(&pair);
        let step = (upper - lower) / (SAMPLES - 1) as f64;
        let inertia: Vec<f64> = (0..SAMPLES)
            .map(|k| {
                pair.kinematics(&[lower + step * k as f64], &mut data);
                pair.momentum(&mut data);
                pair.mass_matrix(&mut data);
                data.mass_matrix[0]
            })
            .collect();
        // Between samples it differs from both by an eighth of this where it bends.
        let bends = inertia.windows(3);
        let bend = bends.map(|at| (at[0] - 2.0 * at[1] + at[2]).abs());
        let room = bend.fold(0.0, f64::max);
        let least = inertia.iter().copied().fold(f64::INFINITY, f64::min) - room;
        let most = inertia.iter().copied().fold(0.0, f64::max) + room;
        let finite = inertia.iter().all(|value| value.is_finite());
        finite.then_some([least, most])
    }

    /// The two bodies that joint `j` joins, the one that carries it as the base.
    fn pair(&self, j: usize) -> Self {
        let link = &self.links[j];
        let alone = Link {
            parent: None,
            carried: link.mass,
            ..link.clone()
        };
        let (mass, center, inertia) = match link.parent {
            Some(p) => {
                let carrier = &self.links[p];
                (carrier.mass, carrier.center, carrier.inertia)
            }
            None => (self.base_mass, self.base_center, self.base_inertia),
        };
        let frames = vec![self.frames[j]];
        Self::assemble(vec![alone], mass, center, inertia, frames, self.base_frame)
    }
}

/// The largest principal moment of a body's inertia, kg m².
fn largest_moment<Sp: Algebra>(inertia: &Sp::Inertia<f64>) -> f64 {
    let unit = |i: usize| {
        let mut axis = Sp::Angular::<f64>::zero();
        axis.components_mut()[i] = 1.0;
        axis
    };
    let n = Sp::ANGLES;
    let matrix = DMatrix::from_fn(n, n, |i, k| {
        Sp::apply_constant(inertia, &unit(k)).components()[i]
    });
    matrix.symmetric_eigenvalues().max()
}
