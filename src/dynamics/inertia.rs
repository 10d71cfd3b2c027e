//! Mass properties of one rigid body.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use std::fmt;

/// Mass properties that no rigid body has.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InertiaError {
    /// Mass is zero, negative or not finite.
    #[error("mass is {0} kg, expected a finite number above zero")]
    Mass(f64),
    /// No mass, and yet an inertia.
    #[error("mass is zero but inertia is not, expected both above zero or both zero")]
    SpinWithoutMass,
    /// The mass centre is not finite.
    #[error("mass centre {0:?} m is not finite")]
    Center([f64; 3]),
    /// A figure that no robot has. Products of such figures overflow.
    #[error("{quantity} of {value:e} {unit}, expected at most {most:e} {unit}", unit = .quantity.unit(), most = .quantity.most())]
    TooLarge {
        /// Which figure.
        quantity: Quantity,
        /// Its value.
        value: f64,
    },
    /// A component of the inertia matrix is not finite.
    #[error("inertia has a component that is not finite")]
    NotFinite,
    /// The matrix is not symmetric.
    #[error(
        "inertia is not symmetric: element ({row}, {column}) and its mirror differ by {gap:.3e} kg m²"
    )]
    NotSymmetric {
        /// Row, counted from 1.
        row: usize,
        /// Column, counted from 1.
        column: usize,
        /// Difference, kg m².
        gap: f64,
    },
    /// A principal moment is not positive.
    #[error(
        "inertia is not positive definite: its smallest principal moment is {0:.6e} kg m², expected above zero"
    )]
    NotPositiveDefinite(f64),
    /// One principal moment exceeds the sum of the others: no mass distribution has that.
    #[error(
        "inertia breaks the triangle inequality: principal moments {0:.6e}, {1:.6e}, {2:.6e} kg m², the largest may not exceed the sum of the others"
    )]
    Triangle(f64, f64, f64),
}

/// A figure of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Mass.
    Mass,
    /// A coordinate of the mass centre.
    Center,
    /// A component of the inertia matrix.
    Inertia,
}

impl Quantity {
    /// The largest magnitude there may be, in its unit: far above any spacecraft, and far below what
    /// overflows in products.
    pub const fn most(self) -> f64 {
        match self {
            Self::Mass => 1e15,
            Self::Center => super::MOST_LENGTH,
            Self::Inertia => 1e30,
        }
    }

    /// Its unit.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Mass => "kg",
            Self::Center => "m",
            Self::Inertia => "kg m²",
        }
    }

    /// Whether the magnitude of one of `values` is too large.
    fn check(self, values: &[f64]) -> Result<(), InertiaError> {
        match values.iter().find(|value| value.abs() > self.most()) {
            Some(&value) => Err(InertiaError::TooLarge {
                quantity: self,
                value,
            }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mass => "a mass",
            Self::Center => "a mass centre with a coordinate",
            Self::Inertia => "an inertia",
        })
    }
}

/// Square of a radius of gyration, m², below which a body counts as a point.
const NEGLIGIBLE: f64 = 1e-15;

/// Mass, mass centre and rotational inertia of a rigid body, in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Inertia {
    mass: f64,
    center: Vector3<f64>,
    rotational: Matrix3<f64>,
}

impl Inertia {
    /// Mass (kg), mass centre in the body frame (m) and rotational inertia about that mass centre
    /// in body axes (kg m²).
    ///
    /// # Errors
    /// [`InertiaError`] where the figures belong to no rigid body.
    pub fn new(
        mass: f64,
        center: Vector3<f64>,
        rotational: Matrix3<f64>,
    ) -> Result<Self, InertiaError> {
        if mass == 0.0 {
            return Err(InertiaError::Mass(mass));
        }
        let inertia = Self::part(mass, center, rotational)?;
        match inertia.moments()[0] {
            least if least <= 0.0 => Err(InertiaError::NotPositiveDefinite(least)),
            _ => Ok(inertia),
        }
    }

    /// Like [`Inertia::new`], but also for what is less than a body: nothing at all, a point mass
    /// or a thin rod, as a part of a body or as a link between two joints.
    ///
    /// # Errors
    /// [`InertiaError`] where no distribution of mass has these figures.
    pub fn part(
        mass: f64,
        center: Vector3<f64>,
        rotational: Matrix3<f64>,
    ) -> Result<Self, InertiaError> {
        if !(mass.is_finite() && mass >= 0.0) {
            return Err(InertiaError::Mass(mass));
        }
        if center.iter().any(|c| !c.is_finite()) {
            return Err(InertiaError::Center(center.into()));
        }
        if rotational.iter().any(|c| !c.is_finite()) {
            return Err(InertiaError::NotFinite);
        }
        Quantity::Mass.check(&[mass])?;
        Quantity::Center.check(center.as_slice())?;
        Quantity::Inertia.check(rotational.as_slice())?;
        let scale = rotational.amax();
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let gap = (rotational[(row, column)] - rotational[(column, row)]).abs();
            if gap > 1e-9 * scale {
                return Err(InertiaError::NotSymmetric {
                    row: row + 1,
                    column: column + 1,
                    gap,
                });
            }
        }
        if mass == 0.0 {
            return match scale {
                0.0 => Ok(Self::massless()),
                _ => Err(InertiaError::SpinWithoutMass),
            };
        }
        let inertia = Self {
            mass,
            center,
            rotational: (rotational + rotational.transpose()) * 0.5,
        };
        let [a, b, c] = inertia.moments();
        // What rounding leaves of a moment that is zero.
        let rounding = 1e-12 * scale + NEGLIGIBLE * mass;
        if a < -rounding {
            return Err(InertiaError::NotPositiveDefinite(a));
        }
        // Published figures are rounded; a thin rod sits right on the limit.
        if c > (a + b) * (1.0 + 1e-3) + rounding {
            return Err(InertiaError::Triangle(a, b, c));
        }
        Ok(inertia)
    }

    /// The body of that mass (kg), its mass centre at the origin, whose rotational inertia is
    /// nearest to the given one, symmetric or not: positive definite, with principal moments of
    /// which none exceeds the sum of the others. Derived in docs/algorithms.md#the-nearest-inertia.
    pub fn nearest(mass: f64, rotational: &Matrix3<f64>) -> Self {
        let eigen = SymmetricEigen::new((rotational + rotational.transpose()) * 0.5);
        let mut order = [0, 1, 2];
        order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
        let sorted = order.map(|i| eigen.eigenvalues[i]);
        let mut moments = Vector3::zeros();
        for (i, moment) in order.into_iter().zip(physical(sorted)) {
            moments[i] = moment;
        }
        let axes = eigen.eigenvectors;
        let turned = axes * Matrix3::from_diagonal(&moments) * axes.transpose();
        let solid = if moments.amax() > 0.0 {
            turned
        } else {
            *Self::ball(mass).rotational()
        };
        Self {
            mass,
            center: Vector3::zeros(),
            rotational: (solid + solid.transpose()) * 0.5,
        }
    }

    /// The block of even density with this mass and inertia: half its edges (m) and, by columns, their
    /// directions in body axes. It is centred at the mass centre.
    pub fn even_block(&self) -> ([f64; 3], Matrix3<f64>) {
        let principal = SymmetricEigen::new(self.rotational);
        let [a, b, c] = [0, 1, 2].map(|i| principal.eigenvalues[i]);
        // The moment about an axis is m/12 times the squares of the two other sides.
        let half = [b + c - a, a + c - b, a + b - c]
            .map(|sum| (1.5 * sum.max(0.0) / self.mass.max(f64::MIN_POSITIVE)).sqrt());
        (half, principal.eigenvectors)
    }

    /// A solid ball of water of that mass (kg) about the origin.
    pub fn ball(mass: f64) -> Self {
        const DENSITY: f64 = 1000.0;
        let cubed = 0.75 * mass / (std::f64::consts::PI * DENSITY);
        let moment = 0.4 * mass * cubed.cbrt().powi(2);
        Self {
            mass,
            center: Vector3::zeros(),
            rotational: Matrix3::identity() * moment,
        }
    }

    /// No mass at all: a frame.
    pub fn massless() -> Self {
        Self {
            mass: 0.0,
            center: Vector3::zeros(),
            rotational: Matrix3::zeros(),
        }
    }

    /// Whether it resists every motion: it has mass, and inertia about every axis.
    pub fn is_solid(&self) -> bool {
        let [least, _, largest] = self.moments();
        self.mass > 0.0 && least > 1e-9 * largest + NEGLIGIBLE * self.mass
    }

    /// Principal moments, kg m², the smallest first.
    pub fn moments(&self) -> [f64; 3] {
        let mut moments: [f64; 3] = SymmetricEigen::new(self.rotational).eigenvalues.into();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Mass centre in the body frame, m.
    pub fn center(&self) -> &Vector3<f64> {
        &self.center
    }

    /// Rotational inertia about the mass centre in body axes, kg m².
    pub fn rotational(&self) -> &Matrix3<f64> {
        &self.rotational
    }

    /// The same body seen from a frame in which this one has the given placement.
    pub fn placed(&self, rotation: &Matrix3<f64>, translation: &Vector3<f64>) -> Self {
        Self {
            mass: self.mass,
            center: translation + rotation * self.center,
            rotational: rotation * self.rotational * rotation.transpose(),
        }
    }

    /// Two bodies welded together, both given in the same frame.
    pub fn lumped(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Self::massless();
        }
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        let shifted = |part: &Self| {
            let r = part.center - center;
            part.rotational
                + (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * part.mass
        };
        Self {
            mass,
            center,
            rotational: shifted(self) + shifted(other),
        }
    }
}

/// Least principal moment that a repaired inertia gets, as a part of the largest: that of a rod
/// fifty times as long as it is wide.
const SLENDER: f64 = 1e-3;

/// The nearest principal moments that a body can have to those given, which are sorted.
fn physical([a, b, c]: [f64; 3]) -> [f64; 3] {
    let excess = c - a - b;
    let [a, b, c] = if excess <= 0.0 {
        [a, b, c]
    } else if a + excess / 3.0 >= 0.0 {
        // Onto the plane c = a + b.
        [a + excess / 3.0, b + excess / 3.0, c - excess / 3.0]
    } else {
        // Onto the edge at which b = a + c as well: a rod.
        let rod = (0.5 * (b + c)).max(0.0);
        [0.0, rod, rod]
    };
    // A moment of zero is no body's.
    [a.max(SLENDER * c), b, c]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest of many that can be, by brute force.
    fn by_search(given: [f64; 3]) -> f64 {
        let steps = || (0..=60).map(|k| f64::from(k) * 0.05);
        let mut least = f64::INFINITY;
        for a in steps() {
            for b in steps() {
                for c in steps() {
                    if c <= a + b && b <= a + c && a <= b + c {
                        let gap: f64 = given
                            .iter()
                            .zip([a, b, c])
                            .map(|(x, y)| (x - y).powi(2))
                            .sum();
                        least = least.min(gap.sqrt());
                    }
                }
            }
        }
        least
    }

    #[test]
    fn nothing_physical_is_nearer() {
        for given in [
            [0.2, 0.3, 2.0],
            [-1.0, 1.0, 1.5],
            [0.0, 0.0, 1.5],
            [-0.5, 0.7, 0.9],
            [1.0, 1.0, 1.9],
        ] {
            let found = physical(given);
            let gap: f64 = given.iter().zip(found).map(|(x, y)| (x - y).powi(2)).sum();
            assert!(gap.sqrt() < by_search(given) + 3e-3, "{given:?}: {found:?}");
            let inertia = Inertia::nearest(1.0, &Matrix3::from_diagonal(&given.into()));
            let [a, b, c] = inertia.moments();
            assert!(
                a > 0.0 && c <= (a + b) * (1.0 + 1e-12),
                "{given:?}: {a} {b} {c}"
            );
            assert!(inertia.is_solid());
        }
        assert_eq!(
            Inertia::nearest(2.0, &-Matrix3::identity()),
            Inertia::ball(2.0)
        );
    }

    #[test]
    fn axes_are_kept() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.8, 1.1).into_inner();
        let turned = |d: [f64; 3]| turn * Matrix3::from_diagonal(&d.into()) * turn.transpose();
        let found = Inertia::nearest(1.0, &turned([0.2, 2.0, 0.3]));
        let expected = turned([0.7, 1.5, 0.8]);
        assert!((found.rotational() - expected).amax() < 1e-14);
    }
}
