//! Second derivatives of a weighted sum of the base's motion and the free accelerations.

use super::*;
use crate::autodiff::Kernel;

/// What the adjoint carries beside the motions and forces of the first pass.
#[derive(Debug)]
pub(super) struct Adjoint<Sp: Space, S: Scalar> {
    /// Multipliers of the joints' residuals: rates of a virtual motion without momentum.
    rates: Vec<f64>,
    virtual_motion: Vec<Screw<Sp, S>>,
    /// Its momentum.
    virtual_momentum: Vec<Screw<Sp, S>>,
    /// axis × velocity.
    across: Vec<Screw<Sp, S>>,
    /// What the velocity of each body weighs.
    weight: Vec<Screw<Sp, S>>,
    momentum: Vec<Screw<Sp, S>>,
    /// The motion whose momentum the base's own rate is weighted with.
    rigid: Vec<Screw<Sp, S>>,
    /// Gradient by θ and θ̇, then by base motion, base acceleration and joint accelerations.
    direct: Vec<S>,
    implied: Vec<S>,
}

impl<Sp: Space, S: Scalar> Adjoint<Sp, S> {
    pub fn new(n: usize) -> Self {
        let screws = vec![Screw::zero(); n];
        let components = 2 * (Sp::ANGLES + Sp::LENGTHS);
        Self {
            rates: vec![0.0; n],
            virtual_motion: screws.clone(),
            virtual_momentum: screws.clone(),
            across: screws.clone(),
            weight: screws.clone(),
            momentum: screws.clone(),
            rigid: screws,
            direct: vec![S::zero(); 2 * n],
            implied: vec![S::zero(); components + n],
        }
    }
}

impl<Sp: Space, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Second derivatives of Σ `accelerations`·q̈ + Σ `turning`·ω₀, after [`Sensitivity::first`].
    ///
    /// How ω₀ depends on the other directions is held straight; its curvature, weighted with
    /// [`Sensitivity::momentum_weight`], is for the caller to add.
    pub fn second(&mut self, accelerations: &[f64], turning: &[f64]) {
        let rates = &mut self.adjoint.rates;
        rates.copy_from_slice(accelerations);
        self.fixed.data.factors.solve(rates);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        self.hessian.fill(0.0);
        for sweep in 0..self.tangents.len() {
            dispatch(Second {
                of: self,
                turning,
                sweep,
            });
        }
    }

    /// Weight of the system's angular momentum (base axes) in the sum of [`Sensitivity::second`].
    pub fn momentum_weight(&self) -> impl Iterator<Item = f64> {
        let rigid = self.adjoint.rigid.first();
        rigid
            .into_iter()
            .flat_map(|rigid| rigid.angular.as_ref().iter().map(|c| -c.value))
    }
}

/// Adds the values of `angle` to `sum`.
#[inline(always)]
fn add_values<Sp: Space, const N: usize, const FUSED: bool>(
    sum: &mut Sp::Angle<f64>,
    angle: &Sp::Angle<Dual<N, FUSED>>,
) {
    for (sum, c) in sum.as_mut().iter_mut().zip(angle.as_ref()) {
        *sum += c.value;
    }
}

/// One sweep.
struct Second<'a, Sp: Space, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    turning: &'a [f64],
    sweep: usize,
}

impl<Sp: Space, const N: usize, const FUSED: bool> Kernel for Second<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, turning, sweep } = self;
        let start = sweep * N;
        let n = of.joints;
        let lane = |direction: usize| Sensitivity::<Sp, N, FUSED>::lane(start, direction);
        let base_velocity = of.tangents[sweep].velocity;
        let base_acceleration = of.tangents[sweep].acceleration;
        let base_virtual = of.fixed.base_motion(&of.adjoint.rates).lifted();

        // Outwards: motions, and what each body makes of them.
        of.velocities(start, &base_velocity);
        let mut couple = Sp::Angle::<f64>::zero();
        for j in 0..n {
            let across = of.fixed.axes[j].across(&of.passes.velocity[j]);
            of.acceleration(start, j, &base_acceleration, &across);
            let body = &of.fixed.bodies[j];
            let axis = &of.fixed.axes[j];
            let acceleration = &mut of.passes.acceleration[j];
            acceleration.add_column(axis, of.tangents[sweep].joints[j]);
            let adjoint = &mut of.adjoint;
            let motion = of
                .fixed
                .carried(j, &mut adjoint.virtual_motion, &base_virtual);
            motion.nudge(lane(j), &axis.across(&motion.value()), -1.0);
            motion.shift(axis, adjoint.rates[j]);
            let velocity = &of.passes.velocity[j];
            let at_center = body.at_center(velocity);
            let beside = body.at_center(motion);
            let weight = body.couple((velocity, &at_center), (motion, &beside));
            add_values::<Sp, N, FUSED>(&mut couple, &weight);
            of.passes.force[j] = body.force(velocity, &at_center, acceleration);
            adjoint.momentum[j] = body.momentum(velocity, &at_center);
            adjoint.virtual_momentum[j] = body.momentum(motion, &beside);
            adjoint.weight[j] = Screw {
                angular: weight,
                linear: Sp::Length::<Dual<N, FUSED>>::zero(),
            };
            adjoint.across[j] = across;
        }
        let own = &of.fixed.base;
        let beside = own.at_center(&base_virtual);
        let own_weight = own.couple(
            (&base_velocity, &own.at_center(&base_velocity)),
            (&base_virtual, &beside),
        );
        add_values::<Sp, N, FUSED>(&mut couple, &own_weight);
        let mut virtual_momentum = own.momentum(&base_virtual, &beside);

        // The motion, rigid about the mass centre, whose momentum weighs against all of that.
        for (sum, weight) in couple.as_mut().iter_mut().zip(turning) {
            *sum += weight;
        }
        let turn = scaled(Sp::spin(&of.fixed.inverse_inertia, &couple), -1.0);
        let rigid = Screw {
            angular: turn,
            linear: scaled(Sp::carry(&turn, &of.fixed.center), -1.0),
        };
        let rigid: Screw<Sp, Dual<N, FUSED>> = rigid.lifted();
        for j in 0..n {
            let motion = of.fixed.carried(j, &mut of.adjoint.rigid, &rigid);
            let turned = of.fixed.axes[j].across(&motion.value());
            motion.nudge(lane(j), &turned, -1.0);
        }

        // Inwards: the gradient.
        let mut weight = own.momentum(&rigid, &own.at_center(&rigid));
        weight.angular = sum(weight.angular, &own_weight);
        for j in (0..n).rev() {
            let adjoint = &mut of.adjoint;
            let axis = &of.fixed.axes[j];
            let body = &of.fixed.bodies[j];
            let rigid = &adjoint.rigid[j];
            // Until now the weight holds this body's couple and what its children handed on.
            let rigid_momentum = body.momentum(rigid, &body.at_center(rigid));
            adjoint.weight[j].add(&rigid_momentum);
            let (force, momentum) = (&of.passes.force[j], &adjoint.momentum[j]);
            let (weighs, beside) = (&adjoint.weight[j], &adjoint.virtual_momentum[j]);
            let across = &adjoint.across[j];

            let mut pulled = axis.across(&of.passes.acceleration[j]);
            pulled.add_scaled(&across.cross(&of.passes.velocity[j]), -1.0);
            let by_position = axis.across(&adjoint.virtual_motion[j]).dot(force)
                + across.dot(weighs)
                + pulled.dot(beside)
                + axis.across(rigid).dot(momentum);
            adjoint.direct[j] = -by_position;
            let by_rate = weighs.dot(axis);
            adjoint.direct[n + j] = by_rate.plus_multiple(across.dot(beside), -2.0);
            let joint = adjoint.implied.len() - n + j;
            adjoint.implied[joint] = beside.dot(axis);

            let fixed = &of.fixed;
            // What of these two reaches the base is of no use.
            let mut forgotten = Screw::zero();
            fixed.hand_on(start, j, &mut of.passes.force, &mut forgotten);
            fixed.hand_on(start, j, &mut adjoint.momentum, &mut forgotten);
            fixed.hand_on(start, j, &mut adjoint.weight, &mut weight);
            fixed.hand_on(
                start,
                j,
                &mut adjoint.virtual_momentum,
                &mut virtual_momentum,
            );
        }
        weight.add_scaled(&base_velocity.cross_force(&virtual_momentum), -1.0);
        let implied = weight.iter().chain(virtual_momentum.iter());
        for (to, &from) in of.adjoint.implied.iter_mut().zip(implied) {
            *to = from;
        }
        of.gather(start);
    }
}

impl<Sp: Space, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Columns `start`.. of the lower triangle: the gradient's own derivatives, and those by what
    /// the directions imply.
    #[inline(always)]
    fn gather(&mut self, start: usize) {
        let width = self.tangents.len() * N;
        for row in start..self.directions() {
            let tangent = &self.tangents[row / N];
            let lane = row % N;
            let mut sums = match self.adjoint.direct.get(row) {
                Some(direct) => *direct,
                None => Dual::constant(0.0),
            };
            let implied = tangent.velocity.iter().chain(tangent.acceleration.iter());
            for (by, &along) in self
                .adjoint
                .implied
                .iter()
                .zip(implied.chain(&tangent.joints))
            {
                sums = sums.plus_multiple(*by, along.gradient[lane]);
            }
            self.hessian[row * width + start..][..N].copy_from_slice(&sums.gradient);
        }
    }
}
