//! The poses that figures are taken at, and the figures of several samples in the making.

use super::figures::Figures;
use super::lanes::{LANES, Lanes, Quaternion, Vector};
use super::step::Bases;

/// A time that is looked at: what takes a replayed base there to where the plan has it, as far as
/// the nominal replay leaves the plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watched {
    /// Quaternion w, x, y, z of the rotation, in inertial axes.
    pub turn: [f64; 4],
    /// m.
    pub shift: [f64; 3],
    /// In the plane, rad.
    pub angle: f64,
}

/// Figures of several samples while they are replayed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watching {
    planar: bool,
    /// Squared vector part and squared real part of the quaternion turned farthest.
    farthest: [Lanes; 2],
    angle: Lanes,
    displacement: Lanes,
    last: Bases,
}

impl Watching {
    pub fn new(planar: bool, start: &Bases) -> Self {
        Self {
            planar,
            farthest: [Lanes::ZERO, Lanes::ONE],
            angle: Lanes::ZERO,
            displacement: Lanes::ZERO,
            last: *start,
        }
    }

    /// Looks at `bases`, at the time `watched`.
    #[inline(always)]
    pub fn look(&mut self, watched: &Watched, bases: &Bases) {
        let orientation = bases.orientation.after(&watched.turn);
        let position = bases.position + Vector::of(watched.shift);
        let angle = bases.angle + Lanes::of(watched.angle);
        let square = position.dot(position);
        for l in 0..LANES {
            let farther = square.0[l] > self.displacement.0[l];
            self.displacement.0[l] = if farther {
                square.0[l]
            } else {
                self.displacement.0[l]
            };
        }
        if self.planar {
            for l in 0..LANES {
                let size = angle.0[l].abs();
                self.angle.0[l] = if size > self.angle.0[l] {
                    size
                } else {
                    self.angle.0[l]
                };
            }
        } else {
            let Quaternion([w, x, y, z]) = orientation;
            let (vector, real) = (x * x + y * y + z * z, w * w);
            let [most, beside] = &mut self.farthest;
            for l in 0..LANES {
                // Tangents of half the angles are compared.
                let farther = vector.0[l] * beside.0[l] > most.0[l] * real.0[l];
                most.0[l] = if farther { vector.0[l] } else { most.0[l] };
                beside.0[l] = if farther { real.0[l] } else { beside.0[l] };
            }
        }
        self.last = Bases {
            orientation,
            position,
            angle,
        };
    }

    /// The figures of the sample in lane `l`, `planned` being the plan's last orientation and angle.
    pub fn figures(&self, l: usize, planned: &([f64; 4], f64)) -> Figures {
        let last = self.last.orientation.lane(l);
        let vector = |q: [f64; 4]| [q[1], q[2], q[3]];
        let norm = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        let angle_of = |q: [f64; 4]| 2.0 * norm(vector(q)).atan2(q[0].abs());
        let displacement = norm(self.last.position.lane(l));
        let (max_base_attitude, final_base_attitude, departure) = if self.planar {
            let angle = self.last.angle.0[l];
            (self.angle.0[l], angle.abs(), [0.0, 0.0, angle - planned.1])
        } else {
            let [most, beside] = self.farthest.map(|part| part.0[l]);
            (
                2.0 * most.sqrt().atan2(beside.sqrt()),
                angle_of(last),
                departure(&planned.0, &last),
            )
        };
        Figures {
            max_base_attitude,
            final_base_attitude,
            max_base_displacement: self.displacement.0[l].sqrt(),
            final_base_displacement: displacement,
            departure,
        }
    }
}

/// Rotation vector of planned⁻¹ ∘ found.
fn departure(planned: &[f64; 4], found: &[f64; 4]) -> [f64; 3] {
    let [a, b, c, d] = [planned[0], -planned[1], -planned[2], -planned[3]];
    let [w, x, y, z] = *found;
    let real = a * w - b * x - c * y - d * z;
    let vector = [
        a * x + b * w + c * z - d * y,
        a * y + c * w + d * x - b * z,
        a * z + d * w + b * y - c * x,
    ];
    let length = vector.iter().map(|v| v * v).sum::<f64>().sqrt();
    let sign = if real < 0.0 { -1.0 } else { 1.0 };
    // Of small rotations the vector part is half the rotation vector.
    let scale = match length > 1e-300 {
        true => 2.0 * length.atan2(real.abs()) / length,
        false => 2.0,
    };
    vector.map(|v| sign * scale * v)
}
