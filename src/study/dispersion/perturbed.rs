//! Several perturbed robots side by side.

use super::chain::{Chain, Mass};
use super::draws::{Draws, Entry};
use super::lanes::{LANES, Lanes, Symmetric, Vector};
use super::tracking::{HARMONICS, part_of_tracking};
use crate::config::Dispersed;
use nalgebra::{Matrix3, Vector3};

/// Mass properties of one body in every sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyLanes {
    pub mass: Lanes,
    pub center: Vector,
    pub inertia: Symmetric,
}

/// Position error of one joint in every sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointLanes {
    pub offset: Lanes,
    /// Of the cosine and the sine of each harmonic.
    pub harmonics: [[Lanes; 2]; HARMONICS],
}

/// As many robots as there are lanes.
#[derive(Debug, Clone)]
pub(super) struct Perturbed {
    /// The base first.
    pub bodies: Vec<BodyLanes>,
    pub joints: Vec<JointLanes>,
    pub inverse_mass: Lanes,
    /// Velocity of the system's mass centre, inertial axes, m/s.
    pub velocity: Vector,
    /// Angular momentum about it, inertial axes.
    pub angular: Vector,
    /// Whether any has angular momentum.
    pub spins: bool,
    linear: Vector,
    values: Vec<f64>,
}

impl Perturbed {
    /// Room for robots of `chain`.
    pub fn new(chain: &Chain, draws: &Draws) -> Self {
        let body = BodyLanes {
            mass: Lanes::ZERO,
            center: Vector::ZERO,
            inertia: Symmetric::ZERO,
        };
        let joint = JointLanes {
            offset: Lanes::ZERO,
            harmonics: [[Lanes::ZERO; 2]; HARMONICS],
        };
        Self {
            bodies: vec![body; chain.masses.len()],
            joints: vec![joint; chain.links.len()],
            inverse_mass: Lanes::ZERO,
            velocity: Vector::ZERO,
            angular: Vector::ZERO,
            spins: false,
            linear: Vector::ZERO,
            values: vec![0.0; draws.count],
        }
    }

    /// The robots of the samples from `first` on, with the plan's own momentum `linear` and
    /// `angular`.
    pub fn draw(&mut self, chain: &Chain, draws: &Draws, momentum: &[[f64; 3]; 2], first: u64) {
        for l in 0..LANES {
            self.reset(chain, momentum, l);
            let mut values = std::mem::take(&mut self.values);
            draws.draw(first + l as u64, &mut values);
            for entry in &draws.entries {
                self.apply(chain, entry, &values[entry.from..][..entry.count()], l);
            }
            self.values = values;
        }
        self.finish();
    }

    /// The nominal robot in lane `l`.
    pub fn set_nominal(&mut self, chain: &Chain, momentum: &[[f64; 3]; 2], l: usize) {
        self.reset(chain, momentum, l);
        self.finish();
    }

    fn reset(&mut self, chain: &Chain, momentum: &[[f64; 3]; 2], l: usize) {
        for (body, nominal) in self.bodies.iter_mut().zip(&chain.masses) {
            body.mass.0[l] = nominal.mass;
            set(&mut body.center, l, nominal.center.into());
            set_inertia(&mut body.inertia, l, &nominal.inertia);
        }
        for joint in &mut self.joints {
            joint.offset.0[l] = 0.0;
            for pair in &mut joint.harmonics {
                pair[0].0[l] = 0.0;
                pair[1].0[l] = 0.0;
            }
        }
        set(&mut self.linear, l, momentum[0]);
        set(&mut self.angular, l, momentum[1]);
    }

    fn apply(&mut self, chain: &Chain, entry: &Entry, values: &[f64], l: usize) {
        match entry.quantity {
            Dispersed::Mass(b) => self.bodies[b].mass.0[l] = values[0],
            Dispersed::Com(b) => {
                let center = center(&chain.masses[b], values);
                set(&mut self.bodies[b].center, l, center.into());
            }
            Dispersed::Inertia(b) => {
                let inertia = inertia(&chain.masses[b], values);
                set_inertia(&mut self.bodies[b].inertia, l, &inertia);
            }
            Dispersed::Offset(j) => self.joints[j].offset.0[l] = values[0],
            Dispersed::Tracking(j) => {
                let pairs = self.joints[j].harmonics.iter_mut();
                for (pair, value) in pairs.zip(values.chunks_exact(2)) {
                    pair[0].0[l] = value[0] * part_of_tracking();
                    pair[1].0[l] = value[1] * part_of_tracking();
                }
            }
            Dispersed::LinearMomentum => {
                for (component, value) in self.linear.0.iter_mut().zip(values) {
                    component.0[l] += value;
                }
            }
            Dispersed::AngularMomentum => {
                // In the plane there is one, about the normal.
                let skipped = 3 - values.len();
                for (component, value) in self.angular.0[skipped..].iter_mut().zip(values) {
                    component.0[l] += value;
                }
            }
        }
    }

    fn finish(&mut self) {
        let mass = self
            .bodies
            .iter()
            .fold(Lanes::ZERO, |sum, body| sum + body.mass);
        self.inverse_mass = mass.recip();
        self.velocity = self.linear.scaled(self.inverse_mass);
        self.spins = self
            .angular
            .0
            .iter()
            .any(|component| component.amax() > 0.0);
    }
}

/// The mass centre displaced by `values`: along the model's axes of the body in space, along the two
/// axes used here in the plane.
pub(super) fn center(nominal: &Mass, values: &[f64]) -> Vector3<f64> {
    nominal.center
        + match *values {
            [x, y] => Vector3::new(x, y, 0.0),
            _ => nominal.turn * Vector3::from_column_slice(values),
        }
}

/// The inertia with its second moments times `values`.
pub(super) fn inertia(nominal: &Mass, values: &[f64]) -> Matrix3<f64> {
    let parts = nominal.by_factor.iter().enumerate();
    let factor = |k: usize| values.get(k).unwrap_or(&values[0]) - 1.0;
    parts.fold(nominal.inertia, |sum, (k, part)| sum + part * factor(k))
}

fn set(vector: &mut Vector, l: usize, values: [f64; 3]) {
    for (component, value) in vector.0.iter_mut().zip(values) {
        component.0[l] = value;
    }
}

fn set_inertia(symmetric: &mut Symmetric, l: usize, m: &Matrix3<f64>) {
    let values = [m.m11, m.m22, m.m33, m.m12, m.m13, m.m23];
    for (component, value) in symmetric.0.iter_mut().zip(values) {
        component.0[l] = value;
    }
}
