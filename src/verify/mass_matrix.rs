//! The unreduced equations of motion (4): inertia matrix and bias forces from body Jacobians.

use super::bodies::{Bodies, BodyMotion};
use crate::dynamics::{JointKind, Model};
use nalgebra::{Cholesky, DMatrix, DMatrixView, DVectorViewMut, Dyn, Matrix3, Vector3};

/// Degrees of freedom of the base: velocity of its origin, then angular velocity, inertial axes.
pub const BASE: usize = 6;

/// The matrix lost positive definiteness: the state has run away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the full inertia matrix is not positive definite")]
pub struct NotPositiveDefinite;

/// M = Σ JᵀMᵢJ over all bodies with the bias Σ Jᵀ(Mᵢa + ω×Iω), a being the accelerations at zero
/// generalized acceleration. The base's six coordinates come first, then the joints.
pub struct MassMatrix {
    matrix: DMatrix<f64>,
    /// L with M = LLᵀ; nothing where that broke down.
    factor: Option<Cholesky<f64, Dyn>>,
    bias: Vec<f64>,
    /// The joints' columns of the current body's Jacobian that are not zero: coordinate, velocity of the
    /// mass centre and angular velocity for its unit rate.
    jacobian: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
    /// Angular and origin acceleration of every body at zero generalized acceleration.
    accelerations: Vec<(Vector3<f64>, Vector3<f64>)>,
}

impl std::fmt::Debug for MassMatrix {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MassMatrix")
            .field("matrix", &self.matrix)
            .field("bias", &self.bias)
            .finish_non_exhaustive()
    }
}

impl MassMatrix {
    /// Room for `model`.
    pub fn new(model: &Model) -> Self {
        let size = BASE + model.joint_count();
        let zero = Vector3::zeros();
        Self {
            matrix: DMatrix::identity(size, size),
            factor: Cholesky::new(DMatrix::identity(size, size)),
            bias: vec![0.0; size],
            jacobian: Vec::with_capacity(size),
            accelerations: vec![(zero, zero); model.joint_count() + 1],
        }
    }

    /// Assembles and factors M for the current `bodies`; the bias for joint rates `dq`.
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] where the factorisation breaks down.
    pub fn update(
        &mut self,
        model: &Model,
        bodies: &Bodies,
        dq: &[f64],
    ) -> Result<(), NotPositiveDefinite> {
        self.accelerate(model, bodies, dq);
        self.matrix.fill(0.0);
        self.bias.fill(0.0);
        for body in 0..bodies.motions().len() {
            self.add_body(model, bodies, body);
        }
        // The room of the last factor serves again.
        let room = self.factor.take().map(Cholesky::unpack_dirty);
        let room = match room {
            Some(mut room) => {
                room.copy_from(&self.matrix);
                room
            }
            None => self.matrix.clone(),
        };
        self.factor = Cholesky::new(room);
        match self.factor {
            Some(_) => Ok(()),
            None => Err(NotPositiveDefinite),
        }
    }

    /// The full matrix M; only its lower triangle is filled.
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// L, its upper triangle being of no meaning.
    ///
    /// # Panics
    /// Where the last [`Self::update`] failed.
    fn factor(&self) -> &DMatrix<f64> {
        let factor = self.factor.as_ref();
        factor
            .expect("a factor is asked for after an update that worked")
            .l_dirty()
    }

    /// The bias forces, length 6 + n.
    pub fn bias(&self) -> &[f64] {
        &self.bias
    }

    /// The base's velocity and angular velocity for zero total momentum: H_bb ξ̇ = −H_bm θ̇.
    pub fn momentum_free(&self, dq: &[f64]) -> (Vector3<f64>, Vector3<f64>) {
        self.with_momentum(dq, &Vector3::zeros(), &Vector3::zeros())
    }

    /// The base's velocity and angular velocity for the given total momentum: `linear` (kg m/s)
    /// and `angular` about the base's origin (kg m²/s), in the axes the matrix is in.
    pub fn with_momentum(
        &self,
        dq: &[f64],
        linear: &Vector3<f64>,
        angular: &Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let mut twist = [
            linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
        ];
        for (row, sum) in twist.iter_mut().enumerate() {
            for (j, rate) in dq.iter().enumerate() {
                *sum -= self.matrix[(BASE + j, row)] * rate;
            }
        }
        solve(self.factor().view((0, 0), (BASE, BASE)), &mut twist);
        (
            Vector3::new(twist[0], twist[1], twist[2]),
            Vector3::new(twist[3], twist[4], twist[5]),
        )
    }

    /// Reduced inertia matrix H = H_mm − H_mb H_bb⁻¹ H_bm times `u` (length n).
    ///
    /// With the base first, the joints' block of the Cholesky factor is that of this Schur
    /// complement.
    pub fn reduced_times(&self, u: &[f64], product: &mut [f64]) {
        let n = u.len();
        product.fill(0.0);
        let (factor, size) = (self.factor().as_slice(), BASE + n);
        for column in 0..n {
            let l = &factor[(BASE + column) * size + BASE..][..n];
            let along: f64 = (column..n).map(|row| l[row] * u[row]).sum();
            for row in column..n {
                product[row] += l[row] * along;
            }
        }
    }

    /// Reduced bias Cθ̇ = c_m − H_mb H_bb⁻¹ c_b, by elimination of the base.
    pub fn reduced_bias(&self, product: &mut [f64]) {
        let mut base = [0.0; BASE];
        base.copy_from_slice(&self.bias[..BASE]);
        solve(self.factor().view((0, 0), (BASE, BASE)), &mut base);
        for (j, out) in product.iter_mut().enumerate() {
            let through_base: f64 = (0..BASE)
                .map(|k| self.matrix[(BASE + j, k)] * base[k])
                .sum();
            *out = self.bias[BASE + j] - through_base;
        }
    }

    /// Solves M a + bias = [0; τ] for all 6 + n accelerations.
    pub fn accelerations(&self, torque: &[f64], a: &mut [f64]) {
        for (value, bias) in a.iter_mut().zip(&self.bias) {
            *value = -bias;
        }
        for (value, torque) in a[BASE..].iter_mut().zip(torque) {
            *value += torque;
        }
        solve(self.factor().as_view(), a);
    }

    /// Accelerations that remain when all generalized accelerations are zero.
    fn accelerate(&mut self, model: &Model, bodies: &Bodies, dq: &[f64]) {
        let motions = bodies.motions();
        // The coordinates of the base are its own velocities in inertial axes.
        self.accelerations[0] = (Vector3::zeros(), Vector3::zeros());
        for (j, joint) in model.joints().iter().enumerate() {
            let p = joint.parent.map_or(0, |parent| parent + 1);
            let (parent, body) = (&motions[p], &motions[j + 1]);
            let (alpha, origin) = self.accelerations[p];
            let arm = body.origin - parent.origin;
            let carried = origin + at(&alpha, &parent.angular, &arm);
            let moved = parent.angular.cross(&(body.axis * dq[j]));
            self.accelerations[j + 1] = match joint.kind {
                JointKind::Revolute => (alpha + moved, carried),
                JointKind::Prismatic => (alpha, carried + moved * 2.0),
            };
        }
    }

    /// Adds JᵀMᵢJ and Jᵀ(Mᵢa + ω×Iω) of one body. The base's columns of J are those of a rigid body about
    /// its origin, and are not written out.
    fn add_body(&mut self, model: &Model, bodies: &Bodies, index: usize) {
        let motions = bodies.motions();
        let body = &motions[index];
        let arm = body.center - motions[0].origin;
        self.fill_jacobian(model, bodies, index);
        let (alpha, origin) = self.accelerations[index];
        let force = (origin + at(&alpha, &body.angular, &(body.center - body.origin))) * body.mass;
        let moment = body.inertia * alpha + body.angular.cross(&(body.inertia * body.angular));
        self.add_to_base(body, &arm);
        let turning = moment + arm.cross(&force);
        for k in 0..3 {
            self.bias[k] += force[k];
            self.bias[3 + k] += turning[k];
        }
        for (first, (joint, linear, angular)) in self.jacobian.iter().enumerate() {
            let (momentum, spin) = (linear * body.mass, body.inertia * angular);
            let about_base = spin + arm.cross(&momentum);
            self.bias[*joint] += linear.dot(&force) + angular.dot(&moment);
            for k in 0..3 {
                self.matrix[(*joint, k)] += momentum[k];
                self.matrix[(*joint, 3 + k)] += about_base[k];
            }
            // The joints nearer to the base come later.
            for (column, linear, angular) in &self.jacobian[first..] {
                self.matrix[(*joint, *column)] += linear.dot(&momentum) + angular.dot(&spin);
            }
        }
    }

    /// Adds the block of the base, the body's mass centre being at `arm` from its origin.
    fn add_to_base(&mut self, body: &BodyMotion, arm: &Vector3<f64>) {
        let first_moment = arm * body.mass;
        let about = body.inertia + Matrix3::identity() * first_moment.dot(arm)
            - first_moment * arm.transpose();
        let crossed = first_moment.cross_matrix();
        for column in 0..3 {
            self.matrix[(column, column)] += body.mass;
            for row in 0..3 {
                self.matrix[(3 + row, column)] += crossed[(row, column)];
                self.matrix[(3 + row, 3 + column)] += about[(row, column)];
            }
        }
    }

    /// The joints that move a body, from the body towards the base.
    fn fill_jacobian(&mut self, model: &Model, bodies: &Bodies, index: usize) {
        let motions = bodies.motions();
        let center = motions[index].center;
        self.jacobian.clear();
        let mut joint = index.checked_sub(1);
        while let Some(j) = joint {
            let carried = &motions[j + 1];
            let (linear, angular) = match model.joints()[j].kind {
                JointKind::Revolute => {
                    (carried.axis.cross(&(center - carried.origin)), carried.axis)
                }
                JointKind::Prismatic => (carried.axis, Vector3::zeros()),
            };
            self.jacobian.push((BASE + j, linear, angular));
            joint = model.joints()[j].parent;
        }
    }
}

/// α×r + ω×(ω×r).
fn at(alpha: &Vector3<f64>, omega: &Vector3<f64>, r: &Vector3<f64>) -> Vector3<f64> {
    alpha.cross(r) + omega.cross(&omega.cross(r))
}

/// Overwrites `b` with (LLᵀ)⁻¹b. The diagonal of a factor has no zeros.
fn solve(lower: DMatrixView<'_, f64, nalgebra::U1, Dyn>, b: &mut [f64]) {
    let mut b = DVectorViewMut::from_slice(b, b.len());
    lower.solve_lower_triangular_unchecked_mut(&mut b);
    lower.tr_solve_lower_triangular_unchecked_mut(&mut b);
}
