//! What the plane and space have to provide, so that each algorithm is written once for both.

use super::Vector;
use crate::autodiff::{Scalar, Times};
use nalgebra::{Matrix3, Vector3};
use std::fmt::Debug;

/// Vectors, rotations and inertia of [`Planar`](super::Planar) or [`Spatial`](super::Spatial)
/// motion.
///
/// Linear vectors are positions, velocities and forces, angular ones angular velocities and
/// moments. In products of two number types `K` is that of the first factor: that of the other,
/// or `f64`.
pub trait Algebra: Copy + Debug + Send + Sync + 'static {
    /// Number of components of an angular vector: 1 in the plane, 3 in space.
    const ANGLES: usize;
    /// Number of components of a linear vector: 2 or 3.
    const LENGTHS: usize;

    /// Linear vectors.
    type Linear<S: Scalar>: Vector<S>;
    /// Angular vectors.
    type Angular<S: Scalar>: Vector<S>;
    /// Orientation of a body in the base frame.
    type Orientation<S: Scalar>: Copy + Debug + Send + Sync;
    /// Rotational inertia in base axes, kg m².
    type Inertia<S: Scalar>: Copy + Debug + Send + Sync;

    /// Base axes.
    fn aligned<S: Scalar>() -> Self::Orientation<S>;
    /// A constant vector given by three components in the frame that bodies are compiled in.
    fn constant_vector(v: &Vector3<f64>) -> Self::Linear<f64>;
    /// A constant orientation given by a rotation matrix in that frame.
    fn constant_orientation(rotation: &Matrix3<f64>) -> Self::Orientation<f64>;
    /// The orientation beyond a joint: from that of its carrier first by the constant rotation
    /// `fixed`, then about the joint's own axis by the angle whose sine and cosine are given, in
    /// the sense `sign`.
    fn after_joint<S: Scalar>(
        carrier: &Self::Orientation<S>,
        fixed: &Self::Orientation<f64>,
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> Self::Orientation<S>;
    /// The constant orientation `fixed` of a frame in a body, in base axes.
    fn attached<S: Scalar>(
        body: &Self::Orientation<S>,
        fixed: &Self::Orientation<f64>,
    ) -> Self::Orientation<S>;
    /// The rotation from the constant `goal` to `orientation`: sine of the rotation angle along
    /// each axis (one in the plane, three in space), then its cosine. Zeros and a one where they
    /// agree.
    fn rotation_between<S: Scalar>(
        orientation: &Self::Orientation<S>,
        goal: &Self::Orientation<f64>,
        rows: &mut [S],
    );
    /// A constant vector of the body in base axes.
    fn rotated<S: Scalar>(
        orientation: &Self::Orientation<S>,
        vector: &Self::Linear<f64>,
    ) -> Self::Linear<S>;
    /// Hands the numbers of an orientation to `visit`.
    fn visit_orientation(
        orientation: &mut Self::Orientation<f64>,
        visit: &mut impl FnMut(&mut [f64]),
    );
    /// Hands the numbers of an inertia to `visit`.
    fn visit_inertia(inertia: &mut Self::Inertia<f64>, visit: &mut impl FnMut(&mut [f64]));
    /// A vector in base axes by its components along the body's axes.
    fn along_axes<S: Scalar>(
        orientation: &Self::Orientation<S>,
        vector: &Self::Linear<S>,
    ) -> Self::Linear<S>;
    /// A revolute joint's axis in base axes, in the sense `sign`.
    fn axis<S: Scalar>(orientation: &Self::Orientation<S>, sign: f64) -> Self::Angular<S>;

    /// ω × r.
    fn cross<K: Scalar, S: Scalar + Times<K>>(
        omega: &Self::Angular<K>,
        r: &Self::Linear<S>,
    ) -> Self::Linear<S>;
    /// ω × r for a constant r.
    fn cross_constant<S: Scalar>(
        omega: &Self::Angular<S>,
        r: &Self::Linear<f64>,
    ) -> Self::Linear<S>;
    /// a × b of angular vectors; zero in the plane.
    fn cross_angular<K: Scalar, S: Scalar + Times<K>>(
        a: &Self::Angular<K>,
        b: &Self::Angular<S>,
    ) -> Self::Angular<S>;
    /// r × f.
    fn moment<K: Scalar, S: Scalar + Times<K>>(
        r: &Self::Linear<K>,
        f: &Self::Linear<S>,
    ) -> Self::Angular<S>;

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
    /// A constant inertia times angular velocity.
    fn apply_constant<S: Scalar>(
        inertia: &Self::Inertia<f64>,
        omega: &Self::Angular<S>,
    ) -> Self::Angular<S>;
    /// The inverse of an inertia, itself shaped like one.
    fn inverse<S: Scalar>(inertia: &Self::Inertia<S>) -> Self::Inertia<S>;
    /// tr(J)·1 − 2J of an inertia J: twice the second moments of its mass. Zero in the plane,
    /// where angular vectors have no products.
    fn second_moments(inertia: &Self::Inertia<f64>) -> Self::Inertia<f64>;
}
