//! The plane and three-dimensional space, so that each algorithm is written once for both.

use super::attitude::{Attitude, PlanarAngle, SpatialAttitude};
use super::screw::Screws;
use crate::autodiff::Scalar;
use nalgebra::{Matrix3, SVector, Vector1, Vector2, Vector3};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Sub, SubAssign};

/// A vector with components of type `S`.
pub trait Vector<S: Scalar>:
    Copy + Debug + Send + Sync + Add<Output = Self> + Sub<Output = Self> + AddAssign + SubAssign
{
    /// The zero vector.
    fn zero() -> Self;
    /// From its components.
    fn from_components(components: &[S]) -> Self;
    /// Inner product.
    fn dot(&self, other: &Self) -> S;
    /// Every component times `factor`.
    fn scaled(&self, factor: S) -> Self;
    /// Every component times a constant.
    fn times(&self, factor: f64) -> Self;
    /// Components.
    fn components(&self) -> &[S];
    /// Components, to be changed.
    fn components_mut(&mut self) -> &mut [S];
}

impl<S: Scalar, const N: usize> Vector<S> for SVector<S, N> {
    #[inline]
    fn zero() -> Self {
        Self::from_element(S::zero())
    }
    #[inline]
    fn from_components(components: &[S]) -> Self {
        Self::from_column_slice(components)
    }
    #[inline]
    fn dot(&self, other: &Self) -> S {
        let mut sum = self[0] * other[0];
        for i in 1..N {
            sum += self[i] * other[i];
        }
        sum
    }
    #[inline]
    fn scaled(&self, factor: S) -> Self {
        self.map(|c| c * factor)
    }
    #[inline]
    fn times(&self, factor: f64) -> Self {
        self.map(|c| c * factor)
    }
    #[inline]
    fn components(&self) -> &[S] {
        self.as_slice()
    }
    #[inline]
    fn components_mut(&mut self) -> &mut [S] {
        self.as_mut_slice()
    }
}

/// Where bodies move: [`Planar`] or [`Spatial`].
pub trait Space: Screws<Moments = <Self as Space>::Inertia<f64>> {
    /// Number of components of an angular velocity: 1 in the plane, 3 in space.
    const ANGLES: usize;
    /// Number of components of a position: 2 or 3.
    const LENGTHS: usize;

    /// How the base's orientation is described.
    type Attitude: Attitude<Self>;
    /// Positions, velocities, forces.
    type Linear<S: Scalar>: Vector<S>;
    /// Angular velocities, moments.
    type Angular<S: Scalar>: Vector<S>;
    /// Orientation of a body in the base frame.
    type Orientation<S: Scalar>: Copy + Debug + Send + Sync;
    /// Rotational inertia in base axes.
    type Inertia<S: Scalar>: Copy + Debug + Send + Sync;

    /// Base axes.
    fn aligned<S: Scalar>() -> Self::Orientation<S>;
    /// First the constant rotation `fixed`, then about the joint's own axis by the angle whose
    /// sine and cosine are given, in the sense `sign`.
    fn turned<S: Scalar>(
        parent: &Self::Orientation<S>,
        fixed: &Self::Orientation<f64>,
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> Self::Orientation<S>;
    /// The constant orientation `fixed` of a frame in a body, in base axes.
    fn attached<S: Scalar>(
        body: &Self::Orientation<S>,
        fixed: &Self::Orientation<f64>,
    ) -> Self::Orientation<S>;
    /// A constant vector given by three components in the frame that bodies are compiled in.
    fn constant_vector(v: &Vector3<f64>) -> Self::Linear<f64>;
    /// A constant orientation given by a rotation matrix in that frame.
    fn constant_orientation(rotation: &Matrix3<f64>) -> Self::Orientation<f64>;
    /// How far `orientation` is turned from the constant `goal`: sines of the angle about each
    /// axis (one in the plane, three in space), then its cosine. All zero but a cosine of one
    /// where they agree.
    fn turn_between<S: Scalar>(
        orientation: &Self::Orientation<S>,
        goal: &Self::Orientation<f64>,
        rows: &mut [S],
    );
    /// A constant vector of the body in base axes.
    fn rotated<S: Scalar>(
        orientation: &Self::Orientation<S>,
        vector: &Self::Linear<f64>,
    ) -> Self::Linear<S>;
    /// A vector in base axes by its components along the body's axes.
    fn along_axes<S: Scalar>(
        orientation: &Self::Orientation<S>,
        vector: &Self::Linear<S>,
    ) -> Self::Linear<S>;
    /// A revolute joint's axis in base axes, in the sense `sign`.
    fn axis<S: Scalar>(orientation: &Self::Orientation<S>, sign: f64) -> Self::Angular<S>;
    /// A body's constant inertia in base axes.
    fn inertia<S: Scalar>(
        orientation: &Self::Orientation<S>,
        inertia: &Self::Inertia<f64>,
    ) -> Self::Inertia<S>;
    /// Sum of two inertias about the same point.
    fn sum<S: Scalar>(a: &Self::Inertia<S>, b: &Self::Inertia<S>) -> Self::Inertia<S>;
    /// Inertia plus that of a point mass at `r`; a negative mass takes it away.
    fn with_point_mass<S: Scalar>(
        inertia: &Self::Inertia<S>,
        mass: f64,
        r: &Self::Linear<S>,
    ) -> Self::Inertia<S>;
    /// Inertia times angular velocity.
    fn apply<S: Scalar>(inertia: &Self::Inertia<S>, omega: &Self::Angular<S>) -> Self::Angular<S>;
    /// The inverse of an inertia, itself shaped like one.
    fn inverse<S: Scalar>(inertia: &Self::Inertia<S>) -> Self::Inertia<S>;
    /// r × f.
    fn moment<S: Scalar>(r: &Self::Linear<S>, f: &Self::Linear<S>) -> Self::Angular<S>;
    /// ω × r.
    fn swept<S: Scalar>(omega: &Self::Angular<S>, r: &Self::Linear<S>) -> Self::Linear<S>;
    /// a × b of two angular vectors; zero in the plane.
    fn gyroscopic<S: Scalar>(a: &Self::Angular<S>, b: &Self::Angular<S>) -> Self::Angular<S>;
}

/// Motion in the plane: one angle, two lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planar;

impl Space for Planar {
    const ANGLES: usize = 1;
    const LENGTHS: usize = 2;

    type Attitude = PlanarAngle;
    type Linear<S: Scalar> = Vector2<S>;
    type Angular<S: Scalar> = Vector1<S>;
    /// Cosine and sine.
    type Orientation<S: Scalar> = Vector2<S>;
    type Inertia<S: Scalar> = S;

    #[inline]
    fn aligned<S: Scalar>() -> Vector2<S> {
        Vector2::new(S::one(), S::zero())
    }
    #[inline]
    fn turned<S: Scalar>(
        parent: &Vector2<S>,
        _fixed: &Vector2<f64>,
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> Vector2<S> {
        // Body frames of a plane are aligned at zero position: no constant rotation.
        match sin_cos {
            Some((s, c)) => {
                let s = s * sign;
                Vector2::new(parent.x * c - parent.y * s, parent.y * c + parent.x * s)
            }
            None => *parent,
        }
    }
    #[inline]
    fn attached<S: Scalar>(body: &Vector2<S>, fixed: &Vector2<f64>) -> Vector2<S> {
        Self::rotated(body, fixed)
    }
    fn constant_vector(v: &Vector3<f64>) -> Vector2<f64> {
        v.xy()
    }
    fn constant_orientation(rotation: &Matrix3<f64>) -> Vector2<f64> {
        let [x, y] = [0, 1].map(|i| Vector2::new(rotation[(0, i)], rotation[(1, i)]));
        if x.norm() > 0.5 {
            x.normalize()
        } else {
            y.normalize()
        }
    }
    #[inline]
    fn turn_between<S: Scalar>(o: &Vector2<S>, goal: &Vector2<f64>, rows: &mut [S]) {
        rows[0] = o.y * goal.x - o.x * goal.y;
        rows[1] = o.x * goal.x + o.y * goal.y;
    }
    #[inline]
    fn rotated<S: Scalar>(o: &Vector2<S>, v: &Vector2<f64>) -> Vector2<S> {
        Vector2::new(o.x * v.x - o.y * v.y, o.y * v.x + o.x * v.y)
    }
    #[inline]
    fn along_axes<S: Scalar>(o: &Vector2<S>, v: &Vector2<S>) -> Vector2<S> {
        Vector2::new(o.x * v.x + o.y * v.y, o.x * v.y - o.y * v.x)
    }
    #[inline]
    fn axis<S: Scalar>(_orientation: &Vector2<S>, sign: f64) -> Vector1<S> {
        Vector1::new(S::constant(sign))
    }
    #[inline]
    fn inertia<S: Scalar>(_orientation: &Vector2<S>, inertia: &f64) -> S {
        S::constant(*inertia)
    }
    #[inline]
    fn sum<S: Scalar>(a: &S, b: &S) -> S {
        *a + *b
    }
    #[inline]
    fn with_point_mass<S: Scalar>(inertia: &S, mass: f64, r: &Vector2<S>) -> S {
        *inertia + Vector::dot(r, r) * mass
    }
    #[inline]
    fn apply<S: Scalar>(inertia: &S, omega: &Vector1<S>) -> Vector1<S> {
        omega.scaled(*inertia)
    }
    #[inline]
    fn inverse<S: Scalar>(inertia: &S) -> S {
        inertia.recip()
    }
    #[inline]
    fn moment<S: Scalar>(r: &Vector2<S>, f: &Vector2<S>) -> Vector1<S> {
        Vector1::new(r.x * f.y - r.y * f.x)
    }
    #[inline]
    fn swept<S: Scalar>(omega: &Vector1<S>, r: &Vector2<S>) -> Vector2<S> {
        Vector2::new(-(omega.x * r.y), omega.x * r.x)
    }
    #[inline]
    fn gyroscopic<S: Scalar>(_a: &Vector1<S>, _b: &Vector1<S>) -> Vector1<S> {
        Vector1::new(S::zero())
    }
}

/// Motion in space: three angles, three lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spatial;

/// A symmetric 3×3 matrix by its six elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Symmetric<S> {
    /// Diagonal xx, yy, zz.
    pub diagonal: [S; 3],
    /// Off the diagonal yz, xz, xy: the element without that index.
    pub products: [S; 3],
}

impl Symmetric<f64> {
    /// From a full matrix, of which the lower triangle is not read.
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        Self {
            diagonal: [m[(0, 0)], m[(1, 1)], m[(2, 2)]],
            products: [m[(1, 2)], m[(0, 2)], m[(0, 1)]],
        }
    }
}

impl Space for Spatial {
    const ANGLES: usize = 3;
    const LENGTHS: usize = 3;

    type Attitude = SpatialAttitude;
    type Linear<S: Scalar> = Vector3<S>;
    type Angular<S: Scalar> = Vector3<S>;
    /// Columns: the body's axes in base axes.
    type Orientation<S: Scalar> = [Vector3<S>; 3];
    type Inertia<S: Scalar> = Symmetric<S>;

    #[inline]
    fn aligned<S: Scalar>() -> [Vector3<S>; 3] {
        let (o, z) = (S::one(), S::zero());
        [
            Vector3::new(o, z, z),
            Vector3::new(z, o, z),
            Vector3::new(z, z, o),
        ]
    }
    #[inline]
    fn turned<S: Scalar>(
        parent: &[Vector3<S>; 3],
        fixed: &[Vector3<f64>; 3],
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> [Vector3<S>; 3] {
        let [x, y, z] = [0, 1, 2].map(|i| Self::rotated(parent, &fixed[i]));
        match sin_cos {
            Some((s, c)) => {
                let s = s * sign;
                [x.scaled(c) + y.scaled(s), y.scaled(c) - x.scaled(s), z]
            }
            None => [x, y, z],
        }
    }
    #[inline]
    fn attached<S: Scalar>(body: &[Vector3<S>; 3], fixed: &[Vector3<f64>; 3]) -> [Vector3<S>; 3] {
        [0, 1, 2].map(|i| Self::rotated(body, &fixed[i]))
    }
    fn constant_vector(v: &Vector3<f64>) -> Vector3<f64> {
        *v
    }
    fn constant_orientation(rotation: &Matrix3<f64>) -> [Vector3<f64>; 3] {
        [0, 1, 2].map(|i| rotation.column(i).into_owned())
    }
    #[inline]
    fn turn_between<S: Scalar>(o: &[Vector3<S>; 3], goal: &[Vector3<f64>; 3], rows: &mut [S]) {
        // E = Gᵀ O: the vector part of its skew half is sin(angle)·axis, its trace 1 + 2 cos.
        let e = |i: usize, j: usize| o[j].x * goal[i].x + o[j].y * goal[i].y + o[j].z * goal[i].z;
        rows[0] = (e(2, 1) - e(1, 2)) * 0.5;
        rows[1] = (e(0, 2) - e(2, 0)) * 0.5;
        rows[2] = (e(1, 0) - e(0, 1)) * 0.5;
        rows[3] = (e(0, 0) + e(1, 1) + e(2, 2) - 1.0) * 0.5;
    }
    #[inline]
    fn rotated<S: Scalar>(o: &[Vector3<S>; 3], v: &Vector3<f64>) -> Vector3<S> {
        o[0].times(v.x) + o[1].times(v.y) + o[2].times(v.z)
    }
    #[inline]
    fn along_axes<S: Scalar>(o: &[Vector3<S>; 3], v: &Vector3<S>) -> Vector3<S> {
        Vector3::new(
            Vector::dot(&o[0], v),
            Vector::dot(&o[1], v),
            Vector::dot(&o[2], v),
        )
    }
    #[inline]
    fn axis<S: Scalar>(o: &[Vector3<S>; 3], sign: f64) -> Vector3<S> {
        o[2].times(sign)
    }
    #[inline]
    fn inertia<S: Scalar>(o: &[Vector3<S>; 3], inertia: &Symmetric<f64>) -> Symmetric<S> {
        let Symmetric {
            diagonal: [xx, yy, zz],
            products: [yz, xz, xy],
        } = *inertia;
        // R I Rᵀ by the columns of R I.
        let a = o[0].times(xx) + o[1].times(xy) + o[2].times(xz);
        let b = o[0].times(xy) + o[1].times(yy) + o[2].times(yz);
        let c = o[0].times(xz) + o[1].times(yz) + o[2].times(zz);
        let element = |i: usize, j: usize| a[i] * o[0][j] + b[i] * o[1][j] + c[i] * o[2][j];
        Symmetric {
            diagonal: [element(0, 0), element(1, 1), element(2, 2)],
            products: [element(1, 2), element(0, 2), element(0, 1)],
        }
    }
    #[inline]
    fn sum<S: Scalar>(a: &Symmetric<S>, b: &Symmetric<S>) -> Symmetric<S> {
        Symmetric {
            diagonal: [0, 1, 2].map(|i| a.diagonal[i] + b.diagonal[i]),
            products: [0, 1, 2].map(|i| a.products[i] + b.products[i]),
        }
    }
    #[inline]
    fn with_point_mass<S: Scalar>(
        inertia: &Symmetric<S>,
        mass: f64,
        r: &Vector3<S>,
    ) -> Symmetric<S> {
        let m = r.times(mass);
        let [x, y, z] = [m.x * r.x, m.y * r.y, m.z * r.z];
        Symmetric {
            diagonal: [
                inertia.diagonal[0] + y + z,
                inertia.diagonal[1] + x + z,
                inertia.diagonal[2] + x + y,
            ],
            products: [
                inertia.products[0] - m.y * r.z,
                inertia.products[1] - m.x * r.z,
                inertia.products[2] - m.x * r.y,
            ],
        }
    }
    #[inline]
    fn apply<S: Scalar>(inertia: &Symmetric<S>, w: &Vector3<S>) -> Vector3<S> {
        let Symmetric {
            diagonal: [xx, yy, zz],
            products: [yz, xz, xy],
        } = *inertia;
        Vector3::new(
            xx * w.x + xy * w.y + xz * w.z,
            xy * w.x + yy * w.y + yz * w.z,
            xz * w.x + yz * w.y + zz * w.z,
        )
    }
    #[inline]
    fn inverse<S: Scalar>(inertia: &Symmetric<S>) -> Symmetric<S> {
        let Symmetric {
            diagonal: [xx, yy, zz],
            products: [yz, xz, xy],
        } = *inertia;
        let cofactors = Symmetric {
            diagonal: [yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy],
            products: [xy * xz - xx * yz, xy * yz - xz * yy, yz * xz - xy * zz],
        };
        let determinant =
            xx * cofactors.diagonal[0] + xy * cofactors.products[2] + xz * cofactors.products[1];
        let factor = determinant.recip();
        Symmetric {
            diagonal: cofactors.diagonal.map(|c| c * factor),
            products: cofactors.products.map(|c| c * factor),
        }
    }
    #[inline]
    fn moment<S: Scalar>(r: &Vector3<S>, f: &Vector3<S>) -> Vector3<S> {
        cross(r, f)
    }
    #[inline]
    fn swept<S: Scalar>(omega: &Vector3<S>, r: &Vector3<S>) -> Vector3<S> {
        cross(omega, r)
    }
    #[inline]
    fn gyroscopic<S: Scalar>(a: &Vector3<S>, b: &Vector3<S>) -> Vector3<S> {
        cross(a, b)
    }
}

#[inline]
fn cross<S: Scalar>(a: &Vector3<S>, b: &Vector3<S>) -> Vector3<S> {
    Vector3::new(
        a.y * b.z - a.z * b.y,
        a.z * b.x - a.x * b.z,
        a.x * b.y - a.y * b.x,
    )
}
