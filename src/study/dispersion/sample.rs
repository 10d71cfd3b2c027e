//! One sample taken apart: the robot, the errors of its joints and its momentum.

use super::chain::Chain;
use super::draws::Draws;
use super::error::DispersionError;
use super::perturbed::{center, inertia};
use super::tracking::{HARMONICS, HarmonicsAt, part_of_tracking};
use crate::config::Dispersed;
use crate::dynamics::{Body, Inertia, Model};

/// A perturbed robot with all that it does otherwise than the plan: what another tool needs to replay
/// the same sample.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sample {
    /// The robot with perturbed mass properties.
    pub model: Model,
    /// Constant error of each joint, rad or m; length n.
    pub offsets: Vec<f64>,
    /// Amplitudes of the cosine and the sine of each harmonic of every joint's error, rad or m;
    /// length n.
    pub harmonics: Vec<[[f64; 2]; HARMONICS]>,
    /// Linear momentum, axes of the plan's inertial frame, kg m/s; in the plane the two in it and 0.
    pub linear: [f64; 3],
    /// Angular momentum about the system's mass centre, kg m²/s; in the plane the last one alone.
    pub angular: [f64; 3],
}

impl Sample {
    pub(super) fn new(
        model: &Model,
        chain: &Chain,
        draws: &Draws,
        momentum: &[[f64; 3]; 2],
        values: &[f64],
    ) -> Result<Self, DispersionError> {
        let n = model.joint_count();
        let mut masses: Vec<_> = chain
            .masses
            .iter()
            .map(|body| (body.mass, body.center, body.inertia))
            .collect();
        let mut offsets = vec![0.0; n];
        let mut harmonics = vec![[[0.0; 2]; HARMONICS]; n];
        let [mut linear, mut angular] = *momentum;
        for entry in &draws.entries {
            let values = &values[entry.from..][..entry.count()];
            match entry.quantity {
                Dispersed::Mass(b) => masses[b].0 = values[0],
                Dispersed::Com(b) => masses[b].1 = center(&chain.masses[b], values),
                Dispersed::Inertia(b) => masses[b].2 = inertia(&chain.masses[b], values),
                Dispersed::Offset(j) => offsets[j] = values[0],
                Dispersed::Tracking(j) => {
                    for (pair, value) in harmonics[j].iter_mut().zip(values.chunks_exact(2)) {
                        *pair = [value[0], value[1]].map(|v| v * part_of_tracking());
                    }
                }
                Dispersed::LinearMomentum => {
                    linear.iter_mut().zip(values).for_each(|(sum, v)| *sum += v);
                }
                Dispersed::AngularMomentum => {
                    let own = &mut angular[3 - values.len()..];
                    own.iter_mut().zip(values).for_each(|(sum, v)| *sum += v);
                }
            }
        }
        let body = |b: usize, body: &Body| {
            let (mass, center, rotational) = masses[b];
            let back = chain.masses[b].turn.transpose();
            let rotational = back * rotational * back.transpose();
            Inertia::part(mass, back * center, rotational)
                .map(|inertia| Body {
                    name: body.name.clone(),
                    inertia,
                })
                .map_err(|cause| DispersionError::Inertia {
                    body: body.name.clone(),
                    cause,
                })
        };
        let base = body(0, model.base())?;
        let mut joints = model.joints().to_vec();
        for (j, joint) in joints.iter_mut().enumerate() {
            joint.body = body(j + 1, &joint.body)?;
        }
        Ok(Self {
            model: Model::new(model.name(), base, joints)?,
            offsets,
            harmonics,
            linear,
            angular,
        })
    }

    /// Error of joint `j`'s position (rad or m) and of its rate at a fraction of the `duration`, s.
    pub fn joint_error(&self, j: usize, fraction: f64, duration: f64) -> [f64; 2] {
        let at = HarmonicsAt::new(fraction, duration);
        let mut error = [self.offsets[j], 0.0];
        for (k, pair) in self.harmonics[j].iter().enumerate() {
            for (i, amplitude) in pair.iter().enumerate() {
                error[0] += amplitude * at.value[k][i];
                error[1] += amplitude * at.rate[k][i];
            }
        }
        error
    }
}
