//! Motion in the plane.

use super::vector::vector;
use super::{Algebra, Vector};
use crate::autodiff::{Scalar, Times};
use nalgebra::{Matrix3, Vector1, Vector2, Vector3};

/// Motion in the plane: one angle, two lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planar;

impl Algebra for Planar {
    const ANGLES: usize = 1;
    const LENGTHS: usize = 2;

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
    fn after_joint<S: Scalar>(
        carrier: &Vector2<S>,
        _fixed: &Vector2<f64>,
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> Vector2<S> {
        // Body frames of a plane are aligned at zero position: no constant rotation.
        match sin_cos {
            Some((s, c)) => {
                let s = s * sign;
                Vector2::new(carrier.x * c - carrier.y * s, carrier.y * c + carrier.x * s)
            }
            None => *carrier,
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
    fn rotation_between<S: Scalar>(o: &Vector2<S>, goal: &Vector2<f64>, rows: &mut [S]) {
        rows[0] = o.y * goal.x - o.x * goal.y;
        rows[1] = o.x * goal.x + o.y * goal.y;
    }
    #[inline]
    fn rotated<S: Scalar>(o: &Vector2<S>, v: &Vector2<f64>) -> Vector2<S> {
        Vector2::new(o.x * v.x - o.y * v.y, o.y * v.x + o.x * v.y)
    }
    #[inline(always)]
    fn visit_orientation(orientation: &mut Vector2<f64>, visit: &mut impl FnMut(&mut [f64])) {
        visit(orientation.components_mut());
    }
    #[inline(always)]
    fn visit_inertia(inertia: &mut f64, visit: &mut impl FnMut(&mut [f64])) {
        visit(std::slice::from_mut(inertia));
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
    #[inline(always)]
    fn cross<K: Scalar, S: Scalar + Times<K>>(omega: &Vector1<K>, r: &Vector2<S>) -> Vector2<S> {
        let (w, r) = (omega.data.0[0][0], &r.data.0[0]);
        vector([-r[1].times(w), r[0].times(w)])
    }
    #[inline(always)]
    fn cross_constant<S: Scalar>(omega: &Vector1<S>, r: &Vector2<f64>) -> Vector2<S> {
        let (w, r) = (omega.data.0[0][0], &r.data.0[0]);
        vector([w * -r[1], w * r[0]])
    }
    #[inline(always)]
    fn cross_angular<K: Scalar, S: Scalar + Times<K>>(
        _a: &Vector1<K>,
        _b: &Vector1<S>,
    ) -> Vector1<S> {
        vector([S::zero()])
    }
    #[inline(always)]
    fn moment<K: Scalar, S: Scalar + Times<K>>(r: &Vector2<K>, f: &Vector2<S>) -> Vector1<S> {
        let (r, f) = (&r.data.0[0], &f.data.0[0]);
        vector([f[1].times(r[0]).minus_times(f[0], r[1])])
    }
    #[inline(always)]
    fn apply_constant<S: Scalar>(inertia: &f64, omega: &Vector1<S>) -> Vector1<S> {
        Vector::times(*omega, *inertia)
    }
    #[inline(always)]
    fn second_moments(_inertia: &f64) -> f64 {
        0.0
    }
}
