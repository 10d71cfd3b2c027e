//! Motions and forces of rigid bodies: an angular and a linear part, about the base origin in base
//! axes.
//!
//! See R. Featherstone, "Rigid Body Dynamics Algorithms", doi:10.1007/978-1-4899-7560-7, chapter 2.
//! Everything is inlined, so that it is compiled for the vectors of whoever calls it; hence arrays
//! and loops instead of a matrix library.

use super::space::{Planar, Spatial, Symmetric};
use crate::autodiff::{Dual, Over, Scalar};
use std::fmt::Debug;

/// Components of a vector, as a plain array.
pub trait Components<S: Scalar>: Copy + Debug + Send + Sync + AsRef<[S]> + AsMut<[S]> {
    /// The zero vector.
    fn zero() -> Self;
}

impl<S: Scalar, const N: usize> Components<S> for [S; N] {
    #[inline(always)]
    fn zero() -> Self {
        [S::zero(); N]
    }
}

/// Products of angular (rad/s, N·m) and linear (m/s, N) vectors in the plane or in space.
///
/// `K` is the number type of one factor: that of the other, or `f64`.
pub trait Screws: Copy + Debug + Send + Sync + 'static {
    /// Whether angular vectors have directions of their own, and so products with each other.
    const TURNS: bool;
    /// Angular vectors.
    type Angle<S: Scalar>: Components<S>;
    /// Linear vectors.
    type Length<S: Scalar>: Components<S>;
    /// Rotational inertia.
    type Moments: Copy + Debug + Send + Sync;

    /// a × b of angular vectors; zero in the plane.
    fn turn<K: Scalar, S: Over<K>>(a: &Self::Angle<K>, b: &Self::Angle<S>) -> Self::Angle<S>;
    /// ω × r.
    fn sweep<K: Scalar, S: Over<K>>(w: &Self::Angle<K>, r: &Self::Length<S>) -> Self::Length<S>;
    /// ω × r for a constant r.
    fn carry<S: Scalar>(w: &Self::Angle<S>, r: &Self::Length<f64>) -> Self::Length<S>;
    /// r × f.
    fn lever<K: Scalar, S: Over<K>>(r: &Self::Length<K>, f: &Self::Length<S>) -> Self::Angle<S>;
    /// Inertia times angular velocity.
    fn spin<S: Scalar>(inertia: &Self::Moments, w: &Self::Angle<S>) -> Self::Angle<S>;
    /// tr(J)·1 − 2J of an inertia J: twice the second moments of its mass.
    fn spread(inertia: &Self::Moments) -> Self::Moments;
}

impl Screws for Planar {
    const TURNS: bool = false;
    type Angle<S: Scalar> = [S; 1];
    type Length<S: Scalar> = [S; 2];
    type Moments = f64;

    #[inline(always)]
    fn turn<K: Scalar, S: Over<K>>(_a: &[K; 1], _b: &[S; 1]) -> [S; 1] {
        [S::zero()]
    }
    #[inline(always)]
    fn sweep<K: Scalar, S: Over<K>>(w: &[K; 1], r: &[S; 2]) -> [S; 2] {
        [-r[1].over(w[0]), r[0].over(w[0])]
    }
    #[inline(always)]
    fn carry<S: Scalar>(w: &[S; 1], r: &[f64; 2]) -> [S; 2] {
        [w[0] * -r[1], w[0] * r[0]]
    }
    #[inline(always)]
    fn lever<K: Scalar, S: Over<K>>(r: &[K; 2], f: &[S; 2]) -> [S; 1] {
        [f[1].over(r[0]).minus(f[0], r[1])]
    }
    #[inline(always)]
    fn spin<S: Scalar>(inertia: &f64, w: &[S; 1]) -> [S; 1] {
        [w[0] * *inertia]
    }
    #[inline(always)]
    fn spread(_inertia: &f64) -> f64 {
        0.0
    }
}

impl Screws for Spatial {
    const TURNS: bool = true;
    type Angle<S: Scalar> = [S; 3];
    type Length<S: Scalar> = [S; 3];
    type Moments = Symmetric<f64>;

    #[inline(always)]
    fn turn<K: Scalar, S: Over<K>>(a: &[K; 3], b: &[S; 3]) -> [S; 3] {
        [
            b[2].over(a[1]).minus(b[1], a[2]),
            b[0].over(a[2]).minus(b[2], a[0]),
            b[1].over(a[0]).minus(b[0], a[1]),
        ]
    }
    #[inline(always)]
    fn sweep<K: Scalar, S: Over<K>>(w: &[K; 3], r: &[S; 3]) -> [S; 3] {
        Self::turn(w, r)
    }
    #[inline(always)]
    fn carry<S: Scalar>(w: &[S; 3], r: &[f64; 3]) -> [S; 3] {
        [
            (w[1] * r[2]).minus(w[2], r[1]),
            (w[2] * r[0]).minus(w[0], r[2]),
            (w[0] * r[1]).minus(w[1], r[0]),
        ]
    }
    #[inline(always)]
    fn lever<K: Scalar, S: Over<K>>(r: &[K; 3], f: &[S; 3]) -> [S; 3] {
        Self::turn(r, f)
    }
    #[inline(always)]
    fn spin<S: Scalar>(inertia: &Symmetric<f64>, w: &[S; 3]) -> [S; 3] {
        let Symmetric {
            diagonal: [xx, yy, zz],
            products: [yz, xz, xy],
        } = *inertia;
        [
            (w[0] * xx).plus(w[1], xy).plus(w[2], xz),
            (w[0] * xy).plus(w[1], yy).plus(w[2], yz),
            (w[0] * xz).plus(w[1], yz).plus(w[2], zz),
        ]
    }
    #[inline(always)]
    fn spread(inertia: &Symmetric<f64>) -> Symmetric<f64> {
        let [xx, yy, zz] = inertia.diagonal;
        Symmetric {
            diagonal: [yy + zz - xx, xx + zz - yy, xx + yy - zz],
            products: inertia.products.map(|p| -2.0 * p),
        }
    }
}

/// A motion (angular then linear velocity) or a force (moment then force).
#[derive(Debug, Clone, Copy)]
pub(super) struct Screw<Sp: Screws, S: Scalar> {
    pub angular: Sp::Angle<S>,
    pub linear: Sp::Length<S>,
}

/// a + b of arrays.
#[inline(always)]
pub(super) fn sum<S: Scalar, C: Components<S>>(mut a: C, b: &C) -> C {
    for (a, &b) in a.as_mut().iter_mut().zip(b.as_ref()) {
        *a += b;
    }
    a
}

/// a + factor·b of arrays.
#[inline(always)]
pub(super) fn sum_scaled<K: Copy, S: Over<K>, C: Components<S>>(mut a: C, b: &C, factor: K) -> C {
    for (a, &b) in a.as_mut().iter_mut().zip(b.as_ref()) {
        *a = a.plus(b, factor);
    }
    a
}

/// a − b of arrays.
#[inline(always)]
pub(super) fn difference<S: Scalar, C: Components<S>>(mut a: C, b: &C) -> C {
    for (a, &b) in a.as_mut().iter_mut().zip(b.as_ref()) {
        *a -= b;
    }
    a
}

/// factor·a of an array.
#[inline(always)]
pub(super) fn scaled<S: Scalar, C: Components<S>>(mut a: C, factor: f64) -> C {
    for a in a.as_mut() {
        *a = *a * factor;
    }
    a
}

impl<Sp: Screws, S: Scalar> Screw<Sp, S> {
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            angular: Sp::Angle::<S>::zero(),
            linear: Sp::Length::<S>::zero(),
        }
    }

    /// All components, the angular ones first.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = &S> {
        self.angular.as_ref().iter().chain(self.linear.as_ref())
    }

    #[inline(always)]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut S> {
        let (angular, linear) = (&mut self.angular, &mut self.linear);
        angular.as_mut().iter_mut().chain(linear.as_mut())
    }

    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.angular = sum(self.angular, &other.angular);
        self.linear = sum(self.linear, &other.linear);
    }

    /// self + factor·other.
    #[inline(always)]
    pub fn add_scaled<K: Copy>(&mut self, other: &Self, factor: K)
    where
        S: Over<K>,
    {
        self.angular = sum_scaled(self.angular, &other.angular, factor);
        self.linear = sum_scaled(self.linear, &other.linear, factor);
    }

    /// Power of a force on a motion, in either order.
    #[inline(always)]
    pub fn dot<K: Scalar>(&self, other: &Screw<Sp, K>) -> S
    where
        S: Over<K>,
    {
        let mut pairs = self.iter().zip(other.iter());
        let (&a, &b) = pairs.next().expect("a screw has components");
        let mut power = a.over(b);
        for (&a, &b) in pairs {
            power = power.plus(a, b);
        }
        power
    }

    /// self × motion: how a motion that moves along with self changes.
    #[inline(always)]
    pub fn cross(&self, motion: &Self) -> Self
    where
        S: Over<S>,
    {
        let linear = Sp::sweep(&self.angular, &motion.linear);
        Self {
            angular: Sp::turn(&self.angular, &motion.angular),
            linear: difference(linear, &Sp::sweep(&motion.angular, &self.linear)),
        }
    }

    /// self ×* force: how a force that moves along with self changes.
    #[inline(always)]
    pub fn cross_force(&self, force: &Self) -> Self
    where
        S: Over<S>,
    {
        let mut angular = Sp::lever(&self.linear, &force.linear);
        if Sp::TURNS {
            angular = sum(angular, &Sp::turn(&self.angular, &force.angular));
        }
        Self {
            angular,
            linear: Sp::sweep(&self.angular, &force.linear),
        }
    }
}

impl<Sp: Screws> Screw<Sp, f64> {
    /// A constant, as any number.
    #[inline(always)]
    pub fn lifted<S: Scalar>(&self) -> Screw<Sp, S> {
        let mut lifted = Screw::zero();
        for (to, &from) in lifted.iter_mut().zip(self.iter()) {
            *to = S::constant(from);
        }
        lifted
    }

    /// self × motion for a constant self.
    #[inline(always)]
    pub fn across<S: Scalar>(&self, motion: &Screw<Sp, S>) -> Screw<Sp, S> {
        let linear = Sp::sweep(&self.angular, &motion.linear);
        Screw {
            angular: Sp::turn(&self.angular, &motion.angular),
            linear: difference(linear, &Sp::carry(&motion.angular, &self.linear)),
        }
    }

    /// self ×* force for a constant self.
    #[inline(always)]
    pub fn across_force<S: Scalar>(&self, force: &Screw<Sp, S>) -> Screw<Sp, S> {
        let mut angular = Sp::lever(&self.linear, &force.linear);
        if Sp::TURNS {
            angular = sum(angular, &Sp::turn(&self.angular, &force.angular));
        }
        Screw {
            angular,
            linear: Sp::sweep(&self.angular, &force.linear),
        }
    }
}

impl<Sp: Screws, const N: usize, const FUSED: bool> Screw<Sp, Dual<N, FUSED>> {
    /// The value without its derivatives.
    #[inline(always)]
    pub fn value(&self) -> Screw<Sp, f64> {
        let mut value = Screw::zero();
        for (to, from) in value.iter_mut().zip(self.iter()) {
            *to = from.value;
        }
        value
    }

    /// The derivatives times `factor`, about another value.
    #[inline(always)]
    pub fn derivatives(mut self, value: &Screw<Sp, f64>, factor: f64) -> Self {
        for (c, &value) in self.iter_mut().zip(value.iter()) {
            *c = *c * factor;
            c.value = value;
        }
        self
    }

    /// Adds `factor`·`by` to the value.
    #[inline(always)]
    pub fn shift(&mut self, by: &Screw<Sp, f64>, factor: f64) {
        for (to, by) in self.iter_mut().zip(by.iter()) {
            to.value += factor * by;
        }
    }

    /// Adds `column`·`factor`.
    #[inline(always)]
    pub fn add_column(&mut self, column: &Screw<Sp, f64>, factor: Dual<N, FUSED>) {
        for (to, &by) in self.iter_mut().zip(column.iter()) {
            *to = to.plus_multiple(factor, by);
        }
    }

    /// Adds `factor`·`by` to the derivative in direction `lane`, where there is one.
    #[inline(always)]
    pub fn nudge(&mut self, lane: Option<usize>, by: &Screw<Sp, f64>, factor: f64) {
        if let Some(lane) = lane {
            for (to, by) in self.iter_mut().zip(by.iter()) {
                to.nudge(lane, factor * by);
            }
        }
    }
}

/// The body's constants at one configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyMass<Sp: Screws> {
    pub mass: f64,
    pub center: Sp::Length<f64>,
    pub moments: Sp::Moments,
}

impl<Sp: Screws> BodyMass<Sp> {
    /// Velocity of the mass centre.
    #[inline(always)]
    pub fn at_center<S: Scalar>(&self, motion: &Screw<Sp, S>) -> Sp::Length<S> {
        sum(Sp::carry(&motion.angular, &self.center), &motion.linear)
    }

    /// Momentum of a motion whose velocity at the mass centre is `at_center`.
    #[inline(always)]
    pub fn momentum<S: Scalar>(
        &self,
        motion: &Screw<Sp, S>,
        at_center: &Sp::Length<S>,
    ) -> Screw<Sp, S> {
        let linear = scaled(*at_center, self.mass);
        let angular = Sp::lever(&self.center, &linear);
        Screw {
            angular: sum(angular, &Sp::spin(&self.moments, &motion.angular)),
            linear,
        }
    }

    /// Force that gives the acceleration `acceleration` (spatial, that is of the body's points as
    /// they pass the base origin) at the velocity `velocity`.
    #[inline(always)]
    pub fn force<S: Over<S>>(
        &self,
        velocity: &Screw<Sp, S>,
        at_center: &Sp::Length<S>,
        acceleration: &Screw<Sp, S>,
    ) -> Screw<Sp, S> {
        let turning = Sp::sweep(&velocity.angular, at_center);
        let linear = scaled(sum(self.at_center(acceleration), &turning), self.mass);
        let mut angular = sum(
            Sp::lever(&self.center, &linear),
            &Sp::spin(&self.moments, &acceleration.angular),
        );
        if Sp::TURNS {
            let spin = Sp::spin(&self.moments, &velocity.angular);
            angular = sum(angular, &Sp::turn(&velocity.angular, &spin));
        }
        Screw { angular, linear }
    }

    /// V ×* I Y − Y ×* I V − I(V × Y) of two motions: a pure couple,
    /// (tr J·1 − 2J)(ω × υ) + 2m·v_c × y_c.
    #[inline(always)]
    pub fn couple<S: Over<S>>(
        &self,
        (velocity, v_center): (&Screw<Sp, S>, &Sp::Length<S>),
        (other, y_center): (&Screw<Sp, S>, &Sp::Length<S>),
    ) -> Sp::Angle<S> {
        let couple = scaled(Sp::lever(v_center, y_center), 2.0 * self.mass);
        if !Sp::TURNS {
            return couple;
        }
        let turned = Sp::turn(&velocity.angular, &other.angular);
        sum(couple, &Sp::spin(&Sp::spread(&self.moments), &turned))
    }
}
