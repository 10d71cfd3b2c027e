//! The dynamics, rows and costs of the optimal control problem, eq. (7) to (18).

use super::super::node_derivatives;
use super::FreeFloating;
use crate::autodiff::Scalar;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Ends, Formulation, InteriorPoint, Ocp, Point, PointDerivatives};

/// Scratch of [`FreeFloating`].
#[derive(Debug, Clone)]
pub struct Scratch<Sp: Space, S: Scalar> {
    data: Data<Sp, S>,
    /// H⁻¹Cθ̇.
    coriolis: Vec<S>,
    /// τ = Hu.
    torque: Vec<S>,
}

impl<Sp: Space> Ocp for FreeFloating<Sp> {
    type Scratch<S: Scalar> = Scratch<Sp, S>;

    fn formulation(&self) -> Formulation {
        self.formulation.clone()
    }

    fn scratch<S: Scalar>(&self) -> Scratch<Sp, S> {
        let n = self.joint_count();
        Scratch {
            data: Data::new(&self.tree),
            coriolis: vec![S::zero(); n],
            torque: vec![S::zero(); n],
        }
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let n = self.joint_count();
        let (eta, joints) = point.x.split_at(self.attitude.count());
        let (theta, dtheta) = joints.split_at(n);
        let data = &mut scratch.data;
        self.tree.kinematics(theta, data);
        self.tree.momentum(data);
        self.base_rate(eta, dtheta, data);
        self.tree.mass_matrix(data);
        self.tree.bias(dtheta, data);
        data.factors.factor(&data.mass_matrix);
        scratch.coriolis.copy_from_slice(&data.bias);
        data.factors.solve(&mut scratch.coriolis);

        let (eta_rates, joint_rates) = rates.split_at_mut(self.attitude.count());
        self.attitude.rates(eta, &data.base_rate, eta_rates);
        let (velocities, accelerations) = joint_rates.split_at_mut(n);
        velocities.copy_from_slice(dtheta);
        for (a, (&u, &c)) in accelerations
            .iter_mut()
            .zip(point.u.iter().zip(&scratch.coriolis))
        {
            *a = u - c;
        }
        if self.torque_rows || self.torque_cost {
            torques(&data.mass_matrix, point.u, &mut scratch.torque);
        }
        let (rate_rows, rest) = path.split_at_mut(if self.rate_rows { Sp::ANGLES } else { 0 });
        let (torque_rows, rest) = rest.split_at_mut(if self.torque_rows { n } else { 0 });
        let (turn_rows, apart) = rest.split_at_mut(rest.len() - self.keep_out.len());
        self.turn
            .path_values(|| self.attitude.squared_turn(eta), turn_rows);
        for (row, pair) in apart.iter_mut().zip(&self.keep_out) {
            *row = pair.value(&self.tree, data);
        }
        // What limits and costs on the rate are about.
        let spin: &[S] = if self.attitude.is_angles() {
            eta_rates
        } else {
            data.base_rate.components()
        };
        if self.rate_rows {
            rate_rows.copy_from_slice(spin);
        }
        if self.torque_rows {
            torque_rows.copy_from_slice(&scratch.torque);
        }
        self.running_cost(spin, dtheta, point.u, &scratch.torque)
    }

    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rows: &mut [S],
    ) {
        if let Some(goal) = &self.way_points[point.way_point] {
            self.pose(goal, point.x, point.t, &mut scratch.data, rows);
        }
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        Some(node_derivatives::of(self))
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rows: &mut [S],
    ) -> S {
        let (eta, joints) = ends.terminal.split_at(self.attitude.count());
        let squared_turn = || self.attitude.squared_turn(eta);
        let weights = &self.cost.final_base_attitude;
        let mut cost = match weights[..] {
            _ if self.attitude.is_angles() => weighted_squares(weights, eta),
            [weight] if weight > 0.0 => squared_turn() * weight,
            _ => S::zero(),
        };
        if self.cost.duration > 0.0 {
            cost += ends.duration * self.cost.duration;
        }
        let data = &mut scratch.data;
        let placed = self.cost.final_base_position.iter().any(|w| *w > 0.0);
        let posed = self.goal.is_some() || !self.keep_out.is_empty();
        if placed || posed {
            self.tree.kinematics(&joints[..self.joint_count()], data);
            self.tree.momentum(data);
        }
        let (rest, apart) = rows.split_at_mut(rows.len() - self.keep_out.len());
        let (goal_rows, turn_rows) = rest.split_at_mut(self.goal_rows());
        self.turn.end_values(squared_turn, turn_rows);
        for (row, pair) in apart.iter_mut().zip(&self.keep_out) {
            *row = pair.value(&self.tree, data);
        }
        if let (Some(goal), Some(pose)) = (&self.goal, self.tree.end_effector(data)) {
            let carry = |position: &mut [S]| self.drift.carry(ends.duration, position);
            goal.values(
                (self.attitude, eta),
                pose,
                &data.system_center,
                carry,
                goal_rows,
            );
        }
        if placed {
            let mut end = self.attitude.base_position(eta, &data.system_center);
            self.drift.carry(ends.duration, end.components_mut());
            let weights = &self.cost.final_base_position;
            let start = self.start_position.components();
            for ((&weight, &z), &z0) in weights.iter().zip(end.components()).zip(start) {
                cost += (z - z0).square() * weight;
            }
        }
        cost
    }
}

impl<Sp: Space> FreeFloating<Sp> {
    /// How many values [`Self::base_outputs`] writes.
    pub(in crate::planner) fn base_output_count(&self) -> usize {
        self.attitude.count() + Sp::ANGLES + self.turn.path().len()
    }

    /// What η and ω₀ alone determine: η̇, then the rates that limits and costs are about, then the
    /// path rows of the rotation angle.
    pub(in crate::planner) fn base_outputs<S: Scalar>(
        &self,
        eta: &[S],
        omega: &Sp::Angular<S>,
        out: &mut [S],
    ) {
        let (rates, rest) = out.split_at_mut(self.attitude.count());
        let (spin, turn_rows) = rest.split_at_mut(Sp::ANGLES);
        self.attitude.rates(eta, omega, rates);
        spin.copy_from_slice(if self.attitude.is_angles() {
            rates
        } else {
            omega.components()
        });
        self.turn
            .path_values(|| self.attitude.squared_turn(eta), turn_rows);
    }

    /// ℒ of (14), with the weights on u and τ.
    fn running_cost<S: Scalar>(&self, spin: &[S], dtheta: &[S], u: &[S], torque: &[S]) -> S {
        let cost = &self.cost;
        let mut sum = weighted_squares(&cost.base_rate, spin)
            + weighted_squares(&cost.joint_rate, dtheta)
            + weighted_squares(&cost.control, u);
        if self.torque_cost {
            sum += weighted_squares(&cost.torque, torque);
        }
        if let Some(matrix) = &cost.rate_matrix {
            let rate = |i: usize| {
                if i < Sp::ANGLES {
                    spin[i]
                } else {
                    dtheta[i - Sp::ANGLES]
                }
            };
            for (i, row) in matrix.iter().enumerate() {
                for (j, &weight) in row.iter().enumerate().filter(|(_, w)| **w != 0.0) {
                    sum += rate(i) * rate(j) * weight;
                }
            }
        }
        sum
    }
}

/// Σ wᵢ vᵢ², leaving out what has no weight.
fn weighted_squares<S: Scalar>(weights: &[f64], values: &[S]) -> S {
    let mut sum = S::zero();
    for (&weight, value) in weights.iter().zip(values).filter(|(w, _)| **w != 0.0) {
        sum += value.square() * weight;
    }
    sum
}

/// τ = Hu from the lower triangle of H.
pub(in crate::planner) fn torques<S: Scalar>(mass_matrix: &[S], u: &[S], torque: &mut [S]) {
    let n = u.len();
    for i in 0..n {
        let mut sum = S::zero();
        for (j, &uj) in u.iter().enumerate() {
            sum += mass_matrix[i.max(j) * n + i.min(j)] * uj;
        }
        torque[i] = sum;
    }
}
