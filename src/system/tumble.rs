//! A base that tumbles with its momentum, however long the task: steps it can be carried by, and
//! attitudes that stay numbers.

use super::free_floating::FreeFloating;
use super::motion::Trajectory;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::dynamics::space::Space;
use crate::problem::Problem;
use nalgebra::UnitQuaternion;

/// Angle that the base turns by in one step, rad: far within what methods of second order bear.
const TURN: f64 = 0.125;
/// Most steps in place of one, which take part of a second in all: a base that turns thousands of times
/// cannot be followed on any mesh.
const MOST: f64 = 200.0;
/// Length that a quaternion may be off one for rounding and the method's error.
const OFF: f64 = 1e-3;
/// Longest modified Rodrigues parameters that are followed, 356°: no more is a number at 360°.
const LONGEST: f64 = 60.0;

/// In how many steps the base is to be carried through `time` seconds; one where it has no angular
/// momentum, since joints turn it no further than they go themselves.
pub(crate) fn steps<Sp: Space>(system: &FreeFloating<Sp>, time: f64) -> usize {
    let turns = system.tumble_rate() * time / TURN;
    match turns > 1.0 {
        true => turns.min(MOST).ceil() as usize,
        false => 1,
    }
}

/// `problem` with the attitude by a quaternion, where the base tumbles and its own description has places
/// that no motion can be followed through.
pub(crate) fn by_quaternion(problem: &Problem) -> Option<Problem> {
    let tumbles = problem
        .task
        .initial_momentum
        .angular
        .iter()
        .any(|l| *l != 0.0);
    let in_space = problem.robot.plane().is_none();
    let otherwise = problem.attitude != SpatialAttitude::Quaternion;
    let edited = (tumbles && in_space && otherwise)
        .then(|| problem.edited(|problem| problem.set_attitude(SpatialAttitude::Quaternion)));
    edited?.ok()
}

/// The base's attitudes along `motion`, which are quaternions, by `attitude`.
pub(crate) fn describe(attitude: SpatialAttitude, motion: &mut Trajectory) {
    let mut near = attitude.of_quaternion(&UnitQuaternion::identity(), &[0.0; 3]);
    for eta in &mut motion.base_attitude {
        let orientation = SpatialAttitude::Quaternion.to_quaternion(eta);
        *eta = attitude.of_quaternion(&orientation, &near);
        near.clone_from(eta);
    }
    motion.attitude = Some(attitude);
}

/// Makes `eta`, which follows `before`, an attitude again: a quaternion of length one, and what the
/// description cannot say as it was before.
pub(crate) fn settle<Sp: Space>(attitude: Sp::Attitude, before: &[f64], eta: &mut [f64]) {
    let length = eta.iter().map(|value| value * value).sum::<f64>().sqrt();
    let described = match attitude.in_space() {
        Some(SpatialAttitude::Quaternion) => length > OFF && length.is_finite(),
        Some(SpatialAttitude::Mrp) => length < LONGEST,
        Some(SpatialAttitude::RollPitchYaw) | None => length.is_finite(),
    };
    if !described {
        eta.copy_from_slice(before);
    } else if attitude.in_space() == Some(SpatialAttitude::Quaternion) && (length - 1.0).abs() > OFF
    {
        eta.iter_mut().for_each(|value| *value /= length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::space::Spatial;

    fn settled(attitude: SpatialAttitude, before: &[f64], eta: &[f64]) -> Vec<f64> {
        let mut eta = eta.to_vec();
        settle::<Spatial>(attitude, before, &mut eta);
        eta
    }

    #[test]
    fn quaternions_have_a_length_of_one() {
        let before = [1.0, 0.0, 0.0, 0.0];
        let of = |eta| settled(SpatialAttitude::Quaternion, &before, eta);
        assert_eq!(of(&[3.0, 0.0, 0.0, 4.0]), [0.6, 0.0, 0.0, 0.8]);
        assert_eq!(of(&[f64::NAN, 0.0, 0.0, 4.0]), before);
        // Rounding is left alone.
        let near = [0.6, 0.0, 0.0, 0.8 + 1e-9];
        assert_eq!(of(&near), near);
    }

    #[test]
    fn what_cannot_be_said_stays_as_it_was() {
        let before = [50.0, 0.0, 0.0];
        let of = |eta| settled(SpatialAttitude::Mrp, &before, eta);
        assert_eq!(of(&[1e9, 0.0, 0.0]), before);
        assert_eq!(of(&[2.0, 0.0, 0.0]), [2.0, 0.0, 0.0]);
        // Angles may be any.
        let angles = [1e9, 0.0, 0.0];
        let of = |eta| settled(SpatialAttitude::RollPitchYaw, &before, eta);
        assert_eq!(of(&angles), angles);
        assert_eq!(of(&[f64::INFINITY, 0.0, 0.0]), before);
    }
}
