//! Motion in space.

use super::vector::vector;
use super::{Algebra, Symmetric, Vector};
use crate::autodiff::{Scalar, Times};
use nalgebra::{Matrix3, Vector3};

/// Motion in space: three angles, three lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spatial;

impl Algebra for Spatial {
    const ANGLES: usize = 3;
    const LENGTHS: usize = 3;

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
    fn after_joint<S: Scalar>(
        carrier: &[Vector3<S>; 3],
        fixed: &[Vector3<f64>; 3],
        sin_cos: Option<(S, S)>,
        sign: f64,
    ) -> [Vector3<S>; 3] {
        let [x, y, z] = [0, 1, 2].map(|i| Self::rotated(carrier, &fixed[i]));
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
    fn rotation_between<S: Scalar>(o: &[Vector3<S>; 3], goal: &[Vector3<f64>; 3], rows: &mut [S]) {
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
    #[inline(always)]
    fn visit_orientation(orientation: &mut [Vector3<f64>; 3], visit: &mut impl FnMut(&mut [f64])) {
        for column in orientation {
            visit(column.components_mut());
        }
    }
    #[inline(always)]
    fn visit_inertia(inertia: &mut Symmetric<f64>, visit: &mut impl FnMut(&mut [f64])) {
        visit(&mut inertia.diagonal);
        visit(&mut inertia.products);
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
        let mut sum = *a;
        for i in 0..3 {
            sum.diagonal[i] += b.diagonal[i];
            sum.products[i] += b.products[i];
        }
        sum
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
        let mut inverse = cofactors;
        for i in 0..3 {
            inverse.diagonal[i] *= factor;
            inverse.products[i] *= factor;
        }
        inverse
    }
    #[inline(always)]
    fn cross<K: Scalar, S: Scalar + Times<K>>(omega: &Vector3<K>, r: &Vector3<S>) -> Vector3<S> {
        cross(omega, r)
    }
    #[inline(always)]
    fn cross_constant<S: Scalar>(omega: &Vector3<S>, r: &Vector3<f64>) -> Vector3<S> {
        let (w, r) = (&omega.data.0[0], &r.data.0[0]);
        vector([
            (w[1] * r[2]).minus_times(w[2], r[1]),
            (w[2] * r[0]).minus_times(w[0], r[2]),
            (w[0] * r[1]).minus_times(w[1], r[0]),
        ])
    }
    #[inline(always)]
    fn cross_angular<K: Scalar, S: Scalar + Times<K>>(
        a: &Vector3<K>,
        b: &Vector3<S>,
    ) -> Vector3<S> {
        cross(a, b)
    }
    #[inline(always)]
    fn moment<K: Scalar, S: Scalar + Times<K>>(r: &Vector3<K>, f: &Vector3<S>) -> Vector3<S> {
        cross(r, f)
    }
    #[inline(always)]
    fn apply_constant<S: Scalar>(inertia: &Symmetric<f64>, omega: &Vector3<S>) -> Vector3<S> {
        let Symmetric {
            diagonal: [xx, yy, zz],
            products: [yz, xz, xy],
        } = *inertia;
        let w = &omega.data.0[0];
        vector([
            (w[0] * xx).plus_times(w[1], xy).plus_times(w[2], xz),
            (w[0] * xy).plus_times(w[1], yy).plus_times(w[2], yz),
            (w[0] * xz).plus_times(w[1], yz).plus_times(w[2], zz),
        ])
    }
    #[inline(always)]
    fn second_moments(inertia: &Symmetric<f64>) -> Symmetric<f64> {
        let [xx, yy, zz] = inertia.diagonal;
        Symmetric {
            diagonal: [yy + zz - xx, xx + zz - yy, xx + yy - zz],
            products: inertia.products.map(|p| -2.0 * p),
        }
    }
}

#[inline(always)]
fn cross<K: Scalar, S: Scalar + Times<K>>(a: &Vector3<K>, b: &Vector3<S>) -> Vector3<S> {
    let (a, b) = (&a.data.0[0], &b.data.0[0]);
    vector([
        b[2].times(a[1]).minus_times(b[1], a[2]),
        b[0].times(a[2]).minus_times(b[2], a[0]),
        b[1].times(a[0]).minus_times(b[0], a[1]),
    ])
}
