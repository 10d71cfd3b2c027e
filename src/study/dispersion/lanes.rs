//! Several samples side by side: numbers and vectors that the compiler turns into wide instructions.
//!
//! All is `#[inline(always)]`, so that it is compiled for the vectors of the kernel it is used in
//! ([`crate::autodiff::dispatch`]). Products and sums stay apart: results are the same on every
//! machine.

use crate::numeric::largest_or_nan;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// Samples side by side.
pub(super) const LANES: usize = 4;

/// A number of each sample.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(32))]
pub(super) struct Lanes(pub [f64; LANES]);

impl Lanes {
    pub const ZERO: Self = Self([0.0; LANES]);
    pub const ONE: Self = Self([1.0; LANES]);

    #[inline(always)]
    pub fn of(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub fn map(mut self, of: impl Fn(f64) -> f64) -> Self {
        for value in &mut self.0 {
            *value = of(*value);
        }
        self
    }

    #[inline(always)]
    fn with(mut self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        for (a, b) in self.0.iter_mut().zip(&other.0) {
            *a = of(*a, *b);
        }
        self
    }

    #[inline(always)]
    pub fn recip(self) -> Self {
        self.map(|a| 1.0 / a)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The largest magnitude of any sample; NaN where one is.
    #[inline(always)]
    pub fn amax(self) -> f64 {
        largest_or_nan(self.0.map(f64::abs))
    }

    /// Sine and cosine of an angle. Small ones, as errors of joints are, take their series, which is
    /// exact to rounding.
    #[inline(always)]
    pub fn sin_cos(self) -> (Self, Self) {
        if self.amax() > SMALL {
            return (self.map(f64::sin), self.map(f64::cos));
        }
        let square = self * self;
        (self * square.series(&SINE), square.series(&COSINE))
    }

    #[inline(always)]
    fn series(self, coefficients: &[f64; 7]) -> Self {
        let mut sum = Self::of(coefficients[6]);
        for k in (0..6).rev() {
            sum = sum * self + Self::of(coefficients[k]);
        }
        sum
    }
}

/// Largest angle for the series, rad: its first term left out is below 1e-18.
const SMALL: f64 = 0.25;
const SINE: [f64; 7] = inverse_factorials(1);
const COSINE: [f64; 7] = inverse_factorials(0);

/// (−1)^k / (2k + first)!
const fn inverse_factorials(first: u32) -> [f64; 7] {
    let mut coefficients = [1.0; 7];
    let mut k = 1;
    while k < 7 {
        let n = (2 * k as u32 + first) as f64;
        coefficients[k] = -coefficients[k - 1] / (n * (n - 1.0));
        k += 1;
    }
    coefficients
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.map(|a| a * other)
    }
}

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// A vector of each sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vector(pub [Lanes; 3]);

impl Vector {
    pub const ZERO: Self = Self([Lanes::ZERO; 3]);

    #[inline(always)]
    pub fn of([x, y, z]: [f64; 3]) -> Self {
        Self([Lanes::of(x), Lanes::of(y), Lanes::of(z)])
    }

    #[inline(always)]
    pub fn scaled(self, by: Lanes) -> Self {
        let [x, y, z] = self.0;
        Self([x * by, y * by, z * by])
    }

    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// The vectors of one sample.
    #[inline(always)]
    pub fn lane(self, l: usize) -> [f64; 3] {
        self.0.map(|component| component.0[l])
    }
}

impl Add for Vector {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl Sub for Vector {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a - x, b - y, c - z])
    }
}

impl AddAssign for Vector {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// A rotation matrix of each sample by its columns.
pub(super) type Columns = [Vector; 3];

/// The matrix times a vector.
#[inline(always)]
pub(super) fn times(columns: &Columns, v: &Vector) -> Vector {
    columns[0].scaled(v.0[0]) + columns[1].scaled(v.0[1]) + columns[2].scaled(v.0[2])
}

/// The matrix times one that all samples share, by its columns.
#[inline(always)]
pub(super) fn times_shared(columns: &Columns, shared: &[[f64; 3]; 3]) -> Columns {
    [
        combined(columns, &shared[0]),
        combined(columns, &shared[1]),
        combined(columns, &shared[2]),
    ]
}

/// The matrix times a vector that all samples share.
#[inline(always)]
pub(super) fn combined(columns: &Columns, shared: &[f64; 3]) -> Vector {
    let [a, b, c] = *shared;
    let [p, q, r] = columns;
    Vector([
        p.0[0] * a + q.0[0] * b + r.0[0] * c,
        p.0[1] * a + q.0[1] * b + r.0[1] * c,
        p.0[2] * a + q.0[2] * b + r.0[2] * c,
    ])
}

/// A symmetric matrix of each sample: xx, yy, zz, xy, xz, yz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Symmetric(pub [Lanes; 6]);

impl Symmetric {
    pub const ZERO: Self = Self([Lanes::ZERO; 6]);

    #[inline(always)]
    pub fn apply(&self, v: Vector) -> Vector {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let [x, y, z] = v.0;
        Vector([
            xx * x + xy * y + xz * z,
            xy * x + yy * y + yz * z,
            xz * x + yz * y + zz * z,
        ])
    }

    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        for (sum, value) in self.0.iter_mut().zip(&other.0) {
            *sum += *value;
        }
    }

    /// Adds `mass` times (|r|²·1 − r·rᵀ), the inertia of a point mass at r.
    #[inline(always)]
    pub fn add_point(&mut self, mass: Lanes, r: Vector) {
        let [x, y, z] = r.0;
        let [mx, my, mz] = r.scaled(mass).0;
        let (sx, sy, sz) = (mx * x, my * y, mz * z);
        self.0[0] += sy + sz;
        self.0[1] += sx + sz;
        self.0[2] += sx + sy;
        self.0[3] -= mx * y;
        self.0[4] -= mx * z;
        self.0[5] -= my * z;
    }

    /// R·S·Rᵀ for the rotation R.
    #[inline(always)]
    pub fn turned(&self, rotation: &Columns) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        // Columns of R·S.
        let half = [
            times(rotation, &Vector([xx, xy, xz])),
            times(rotation, &Vector([xy, yy, yz])),
            times(rotation, &Vector([xz, yz, zz])),
        ];
        Self([
            entry(&half, rotation, 0, 0),
            entry(&half, rotation, 1, 1),
            entry(&half, rotation, 2, 2),
            entry(&half, rotation, 0, 1),
            entry(&half, rotation, 0, 2),
            entry(&half, rotation, 1, 2),
        ])
    }

    #[inline(always)]
    pub fn inverse(&self) -> Self {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let scale = (xx * a + xy * b + xz * c).recip();
        Self([
            a * scale,
            (xx * zz - xz * xz) * scale,
            (xx * yy - xy * xy) * scale,
            b * scale,
            c * scale,
            (xy * xz - xx * yz) * scale,
        ])
    }
}

/// Entry (i, j) of A·Bᵀ, both by their columns.
#[inline(always)]
fn entry(a: &Columns, b: &Columns, i: usize, j: usize) -> Lanes {
    a[0].0[i] * b[0].0[j] + a[1].0[i] * b[1].0[j] + a[2].0[i] * b[2].0[j]
}

/// A quaternion of each sample: w, x, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quaternion(pub [Lanes; 4]);

impl Quaternion {
    #[inline(always)]
    pub fn of(values: [f64; 4]) -> Self {
        Self(values.map(Lanes::of))
    }

    /// This one's change a second where the body turns with `omega`, in its own axes.
    #[inline(always)]
    pub fn rate(&self, omega: &Vector) -> Self {
        let [w, x, y, z] = self.0;
        let [a, b, c] = omega.0;
        let half = Lanes::of(0.5);
        Self([
            -(x * a + y * b + z * c) * half,
            (w * a + y * c - z * b) * half,
            (w * b + z * a - x * c) * half,
            (w * c + x * b - y * a) * half,
        ])
    }

    #[inline(always)]
    pub fn plus(&self, other: &Self, times: f64) -> Self {
        let mut sum = *self;
        for (sum, value) in sum.0.iter_mut().zip(&other.0) {
            *sum += *value * times;
        }
        sum
    }

    #[inline(always)]
    pub fn normalised(&self) -> Self {
        let [w, x, y, z] = self.0;
        let scale = (w * w + x * x + y * y + z * z).sqrt().recip();
        Self([w * scale, x * scale, y * scale, z * scale])
    }

    /// `first` turned on by this: the product first ∘ self, `first` being shared by all samples.
    #[inline(always)]
    pub fn after(&self, first: &[f64; 4]) -> Self {
        let [w, x, y, z] = self.0;
        let [a, b, c, d] = *first;
        Self([
            w * a - x * b - y * c - z * d,
            x * a + w * b + z * c - y * d,
            y * a + w * c + x * d - z * b,
            z * a + w * d + y * b - x * c,
        ])
    }

    /// From body axes to those that the quaternion is counted from.
    #[inline(always)]
    pub fn turn(&self, v: &Vector) -> Vector {
        let [w, x, y, z] = self.0;
        let axis = Vector([x, y, z]);
        let twice = axis.cross(*v).scaled(Lanes::of(2.0));
        *v + twice.scaled(w) + axis.cross(twice)
    }

    /// Into body axes.
    #[inline(always)]
    pub fn turn_back(&self, v: &Vector) -> Vector {
        let [w, x, y, z] = self.0;
        Self([w, -x, -y, -z]).turn(v)
    }

    /// The quaternion of one sample.
    #[inline(always)]
    pub fn lane(&self, l: usize) -> [f64; 4] {
        self.0.map(|component| component.0[l])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, UnitQuaternion, Vector3};

    #[test]
    fn series_are_sine_and_cosine() {
        for x in [0.0, 1e-9, 1e-3, -0.1, 0.2499, 0.2501, -2.0, 40.0] {
            let (sin, cos) = Lanes::of(x).sin_cos();
            assert!((sin.0[0] - x.sin()).abs() < 2e-16, "{x}");
            assert!((cos.0[0] - x.cos()).abs() < 2e-16, "{x}");
        }
    }

    #[test]
    fn algebra_is_that_of_matrices() {
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.1);
        let (w, v) = (turn.w, turn.imag());
        let q = Quaternion::of([w, v.x, v.y, v.z]);
        let matrix = turn.to_rotation_matrix().into_inner();
        let columns: Columns = [0, 1, 2].map(|i| Vector::of(matrix.column(i).into_owned().into()));
        let u = Vector3::new(0.7, -0.2, 0.4);
        let turned = q.turn(&Vector::of(u.into())).lane(3);
        assert!((Vector3::from(turned) - matrix * u).amax() < 1e-15);
        let back = q.turn_back(&Vector::of(turned)).lane(3);
        assert!((Vector3::from(back) - u).amax() < 1e-15);

        let full = Matrix3::new(3.0, 0.2, -0.4, 0.2, 2.0, 0.5, -0.4, 0.5, 4.0);
        let s = Symmetric([3.0, 2.0, 4.0, 0.2, -0.4, 0.5].map(Lanes::of));
        let check = |found: Symmetric, expected: Matrix3<f64>| {
            let e = &expected;
            let entries = [e.m11, e.m22, e.m33, e.m12, e.m13, e.m23];
            for (found, expected) in found.0.iter().zip(entries) {
                assert!((found.0[0] - expected).abs() < 1e-14);
            }
        };
        check(s.turned(&columns), matrix * full * matrix.transpose());
        check(s.inverse(), full.try_inverse().unwrap());
        let mut point = Symmetric::ZERO;
        point.add_point(Lanes::of(2.0), Vector::of(u.into()));
        let expected = (Matrix3::identity() * u.norm_squared() - u * u.transpose()) * 2.0;
        check(point, expected);

        let other = UnitQuaternion::from_euler_angles(-0.5, 0.1, 0.9);
        let o = other.into_inner();
        let product = (other * turn).into_inner();
        let found = q.after(&[o.w, o.i, o.j, o.k]).lane(0);
        for (a, b) in found
            .iter()
            .zip([product.w, product.i, product.j, product.k])
        {
            assert!((a - b).abs() < 1e-15);
        }
    }
}
