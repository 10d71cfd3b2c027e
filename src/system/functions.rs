//! The functions of the optimal control problem, eq. (7) to (18): dynamics, rows, cost.

use super::cost::{EndTerm, PathCost, PathTerm, Side};
use super::derivatives;
use super::free_floating::FreeFloating;
use super::instant::{Instant, Pose};
use super::rows::{EndRows, PathRows};
use super::torques::torques;
use crate::autodiff::Scalar;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Ends, Formulation, InteriorPoint, Ocp, Point, PointDerivatives};

/// Scratch of [`FreeFloating`].
#[derive(Debug, Clone)]
pub struct Scratch<Sp: Space, S: Scalar> {
    data: Data<Sp, S>,
    /// H⁻¹Cθ̇.
    coriolis: Vec<S>,
    /// τ = Hu.
    torque: Vec<S>,
    /// The running cost of the base alone, where that is bounded.
    base_motion: S,
}

impl<Sp: Space> Ocp for FreeFloating<Sp> {
    type Scratch<S: Scalar> = Scratch<Sp, S>;

    fn formulation(&self) -> Formulation {
        self.formulation.clone()
    }

    fn scratch<S: Scalar>(&self) -> Scratch<Sp, S> {
        let n = self.joint_count();
        Scratch {
            data: Data::new(self.tree()),
            coriolis: vec![S::zero(); n],
            torque: vec![S::zero(); n],
            base_motion: S::zero(),
        }
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let (plant, tree) = (&self.plant, self.tree());
        let n = plant.joints();
        let (eta, joints) = point.x.split_at(plant.parameters());
        let (theta, dtheta) = joints.split_at(n);
        let Scratch {
            data,
            coriolis,
            torque,
            base_motion,
        } = scratch;
        tree.kinematics(theta, data);
        tree.momentum(data);
        plant.base_rate(eta, dtheta, data);
        tree.mass_matrix(data);
        tree.bias(dtheta, data);
        data.factors.factor(&data.mass_matrix);
        coriolis.copy_from_slice(&data.bias);
        data.factors.solve(coriolis);

        let (eta_rates, joint_rates) = rates.split_at_mut(plant.parameters());
        plant.attitude.rates(eta, &data.base_rate, eta_rates);
        let (velocities, accelerations) = joint_rates.split_at_mut(n);
        velocities.copy_from_slice(dtheta);
        let controls = point.u.iter().zip(coriolis.iter());
        for (a, (&u, &c)) in accelerations.iter_mut().zip(controls) {
            *a = u - c;
        }
        if self.needs.torque {
            torques(&data.mass_matrix, point.u, torque);
        }
        let t = point.t;
        let at = Instant {
            pose: Pose {
                plant,
                eta,
                t,
                data,
                parameters: point.parameters,
            },
            dtheta,
            u: point.u,
            base_rate: plant.limited_rates(eta_rates, &data.base_rate),
            torque,
        };
        let mut rest = path;
        for block in &self.path {
            let (own, others) = rest.split_at_mut(block.rows().len());
            block.values(&at, own);
            rest = others;
        }
        if self.bounds_base_motion() {
            let base = self.path_cost.iter().filter(|term| self.is_of_base(term));
            *base_motion = sum(base.map(|term| term.value(&at)));
        }
        sum(self.path_cost.iter().map(|term| term.value(&at)))
    }

    fn integrands<S: Scalar>(
        &self,
        _point: Point<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        integrands: &mut [S],
    ) {
        if let [base] = integrands {
            *base = scratch.base_motion;
        }
    }

    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rows: &mut [S],
    ) {
        if let Some(goal) = &self.way_points[point.way_point].goal {
            let pose = self.pose(point.x, point.parameters, point.t, &mut scratch.data);
            goal.values(&pose, rows);
        }
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        Some(derivatives::of(self))
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rows: &mut [S],
    ) -> S {
        let at = if self.needs.end_pose {
            let (x, p) = (ends.terminal, ends.parameters);
            self.pose(x, p, ends.duration, &mut scratch.data)
        } else {
            Pose {
                plant: &self.plant,
                eta: &ends.terminal[..self.plant.parameters()],
                t: ends.duration,
                data: &scratch.data,
                parameters: ends.parameters,
            }
        };
        let mut rest = rows;
        for block in &self.end {
            let (own, others) = rest.split_at_mut(block.rows().len());
            block.values(&at, own);
            rest = others;
        }
        if let ([base], [along]) = (rest, ends.integrals) {
            let own = self.end_cost.iter();
            let own = own.filter(|term| EndTerm::<Sp>::side(*term) == Side::Base);
            *base = *along + sum(own.map(|term| term.value(&at)));
        }
        sum(self.end_cost.iter().map(|term| term.value(&at)))
    }
}

impl<Sp: Space> FreeFloating<Sp> {
    /// Whether what the cost counts of the base is bounded: by an integral and the last row of the end.
    pub(super) fn bounds_base_motion(&self) -> bool {
        !self.formulation.integrals.is_empty()
    }

    /// Whether a term of the running cost counts the base's motion alone.
    pub(super) fn is_of_base(&self, term: &PathCost) -> bool {
        PathTerm::<Sp>::side(term) == Side::Base
    }

    /// The pose at the states `x`, `t` seconds after t₀, with the static parameters.
    pub(super) fn pose<'a, S: Scalar>(
        &'a self,
        x: &'a [S],
        parameters: &'a [S],
        t: S,
        data: &'a mut Data<Sp, S>,
    ) -> Pose<'a, Sp, S> {
        let plant = &self.plant;
        let (eta, joints) = x.split_at(plant.parameters());
        plant.tree.kinematics(&joints[..plant.joints()], data);
        plant.tree.momentum(data);
        Pose {
            plant,
            eta,
            t,
            data,
            parameters,
        }
    }
}

fn sum<S: Scalar>(values: impl Iterator<Item = S>) -> S {
    let mut sum = S::zero();
    for value in values {
        sum += value;
    }
    sum
}
