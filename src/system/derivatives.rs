//! Derivatives of the free-floating problem at one point, by the structure of its dynamics.
//!
//! The states enter in three ways, each differentiated by what suits it: the joints through the
//! recursions ([`Sensitivity`]), the attitude η and the base's angular velocity ω₀ through a few
//! elementary functions (dual numbers), the controls linearly. Rows and cost terms add their own
//! derivatives from these.

use super::cost::{PathCost, PathTerm};
use super::free_floating::FreeFloating;
use super::linearization::{Adjoint, Linearization, Lower};
use super::rows::PathRows;
use super::torques::torques;
use crate::autodiff::{Dual, HyperDual, Scalar, has_fused};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::dynamics::{Heap, InPlace, Sensitivity, Storage};
use crate::ocp::{Point, PointDerivatives};

/// Attitude parameters, at most, and those with the components of ω₀.
const PARAMETERS: usize = 4;
const BASE: usize = 8;

/// Derivatives for `system`, with as many directions in one sweep as it has use for; for few joints
/// compiled for their number, unless the processor is so old that this is not worth the compiling.
pub(super) fn of<Sp: Space>(system: &FreeFloating<Sp>) -> Box<dyn PointDerivatives + '_> {
    match (system.joint_count(), has_fused()) {
        (2, true) => Box::new(NodeDerivatives::<Sp, InPlace<2>, 4, true>::new(system)),
        (3, true) => Box::new(NodeDerivatives::<Sp, InPlace<3>, 8, true>::new(system)),
        (_, true) => Box::new(NodeDerivatives::<Sp, Heap, 16, true>::new(system)),
        (_, false) => Box::new(NodeDerivatives::<Sp, Heap, 16, false>::new(system)),
    }
}

struct NodeDerivatives<'a, Sp: Space, J: Storage, const N: usize, const FUSED: bool> {
    system: &'a FreeFloating<Sp>,
    /// States and controls that first derivatives are those of, once they are loaded.
    inputs: Vec<f64>,
    is_loaded: bool,
    /// How many numbers that takes to keep.
    kept: usize,
    motion: Sensitivity<Sp, J, N, FUSED>,
    /// Rates of the base that limits and costs are about, then θ̇.
    rates: Vec<f64>,
    /// Derivatives of ω₀ by η, one parameter after the other, where the system tumbles.
    tumbled: Vec<f64>,
    /// Derivatives of ω₀ by the states, by rows as wide as those.
    omega_by: Vec<f64>,
    /// Whether η̇ and the rates are ω₀ itself, as in the plane.
    straight: bool,
    /// What η and ω₀ alone determine: η̇, the base's rates, φ² where needed; with its derivatives
    /// by both.
    base_first: Vec<Dual<BASE>>,
    base_second: Vec<HyperDual<PARAMETERS, BASE>>,
    /// The same by all of η, θ, θ̇, by rows as wide as those.
    base_by: Vec<f64>,
    base_weights: Vec<f64>,
    torque: Vec<f64>,
    torque_weights: Vec<f64>,
    /// n×n by rows: derivatives of the torques, of weighted torques, and second ones.
    torque_by: Vec<f64>,
    torque_weighted_by: Vec<f64>,
    torque_second: Vec<f64>,
}

/// η̇, the rates that limits and costs are about, and φ² where a row needs it, from η and ω₀.
fn base_outputs<Sp: Space, S: Scalar>(
    system: &FreeFloating<Sp>,
    eta: &[S],
    omega: &Sp::Angular<S>,
    out: &mut [S],
) {
    let attitude = system.plant.attitude;
    let (rates, rest) = out.split_at_mut(attitude.count());
    let (limited, rotation) = rest.split_at_mut(Sp::ANGLES);
    attitude.rates(eta, omega, rates);
    limited.copy_from_slice(system.plant.limited_rates(rates, omega));
    if let [squared] = rotation {
        *squared = attitude.squared_rotation_angle(eta);
    }
}

impl<'a, Sp: Space, J: Storage, const N: usize, const FUSED: bool>
    NodeDerivatives<'a, Sp, J, N, FUSED>
{
    fn new(system: &'a FreeFloating<Sp>) -> Self {
        let plant = &system.plant;
        let (n, parameters, states) = (plant.joints(), plant.parameters(), plant.states());
        let tumbles = plant.drift.angular().is_some();
        let others = if tumbles { parameters } else { 0 };
        let outputs = parameters + Sp::ANGLES + usize::from(system.needs.rotation);
        let mut derivatives = Self {
            inputs: vec![0.0; states + n],
            is_loaded: false,
            kept: 0,
            motion: Sensitivity::new(&plant.tree, others),
            rates: vec![0.0; Sp::ANGLES + n],
            tumbled: vec![0.0; others * Sp::ANGLES],
            omega_by: vec![0.0; Sp::ANGLES * states],
            straight: Sp::ANGLES == 1 && !system.needs.rotation,
            base_first: vec![Dual::constant(0.0); outputs],
            // Where they are ω₀ itself, they stay as they are here.
            base_second: vec![HyperDual::seeded(0.0, None, Some(parameters)); outputs],
            base_by: vec![0.0; outputs * states],
            base_weights: vec![0.0; outputs],
            torque: vec![0.0; n],
            torque_weights: vec![0.0; n],
            torque_by: vec![0.0; n * n],
            torque_weighted_by: vec![0.0; n * n],
            torque_second: vec![0.0; n * n],
            system,
        };
        let mut kept = 1;
        derivatives.visit(|part| kept += part.len());
        derivatives.kept = kept;
        derivatives
    }

    /// Hands all that belongs to [`Self::load`] to `visit`, piece by piece.
    #[inline(always)]
    fn visit(&mut self, mut visit: impl FnMut(&mut [f64])) {
        visit(&mut self.inputs);
        visit(&mut self.omega_by);
        visit(&mut self.rates[Sp::ANGLES..]);
        if self.system.needs.torque {
            visit(&mut self.torque);
            visit(&mut self.torque_by);
        }
        self.motion.visit(&mut visit);
    }

    fn parameters(&self) -> usize {
        self.system.plant.parameters()
    }

    /// Joints n, a constant where the compiler knows it.
    fn joints(&self) -> usize {
        self.motion.joints()
    }

    /// States: η, θ, θ̇.
    fn states(&self) -> usize {
        self.parameters() + 2 * self.joints()
    }

    /// Free motion with its first derivatives, torques with theirs; nothing is to be done where
    /// they are those already.
    fn load(&mut self, point: &Point<'_, f64>) {
        let inputs = point.x.iter().chain(point.u);
        if self.is_loaded && same(self.inputs.iter(), inputs.clone()) {
            return;
        }
        for (to, &from) in self.inputs.iter_mut().zip(inputs) {
            *to = from;
        }
        self.is_loaded = true;
        let system = self.system;
        let plant = &system.plant;
        let (eta, joints) = point.x.split_at(plant.parameters());
        let (theta, dtheta) = joints.split_at(self.joints());
        self.motion.load(&plant.tree, theta, dtheta, |data| {
            plant.drift.tumble(plant.attitude, eta, data);
        });
        if let Some(angular) = plant.drift.angular() {
            let seeded: [Dual<PARAMETERS>; PARAMETERS] = seeded(eta, Dual::seeded);
            let seen = plant.attitude.to_base(&seeded[..eta.len()], angular);
            for (i, tumbled) in self.tumbled.chunks_exact_mut(Sp::ANGLES).enumerate() {
                let mut by = [0.0; 3];
                for (by, c) in by.iter_mut().zip(seen.components()) {
                    *by = c.gradient[i];
                }
                let by = Sp::Angular::from_components(&by[..Sp::ANGLES]);
                let by = Sp::apply(&self.motion.data().inverse_inertia, &by);
                tumbled.copy_from_slice(by.components());
            }
        }
        self.motion.first(&self.tumbled);
        let states = self.states();
        for (i, row) in self.omega_by.chunks_exact_mut(states).enumerate() {
            let (by_eta, by_joints) = row.split_at_mut(plant.parameters());
            self.motion.base_rate_by(i, by_joints, by_eta);
        }
        if system.needs.torque {
            let data = self.motion.data();
            torques(&data.mass_matrix, point.u, &mut self.torque);
            self.motion.torque_by(point.u, &mut self.torque_by);
        }
        self.rates[Sp::ANGLES..].copy_from_slice(dtheta);
    }

    /// Row `row` of `base_by` from its derivatives by η and ω₀, and the values of the rates.
    fn spread_base(&mut self, row: usize, value: f64, by: &[f64; BASE]) {
        let (parameters, states) = (self.parameters(), self.states());
        let to = &mut self.base_by[row * states..(row + 1) * states];
        to[..parameters].copy_from_slice(&by[..parameters]);
        to[parameters..].fill(0.0);
        for (omega_by, by) in self.omega_by.chunks_exact(states).zip(&by[parameters..]) {
            for (to, omega_by) in to.iter_mut().zip(omega_by) {
                *to += by * omega_by;
            }
        }
        if let Some(rate) = row.checked_sub(parameters).filter(|&i| i < Sp::ANGLES) {
            self.rates[rate] = value;
        }
    }

    /// `base_by` and the rates where both are ω₀ itself.
    fn copy_base(&mut self) {
        for row in self.base_by.chunks_exact_mut(self.omega_by.len()) {
            row.copy_from_slice(&self.omega_by);
        }
        let omega = self.motion.data().base_rate;
        self.rates[..Sp::ANGLES].copy_from_slice(omega.components());
    }

    /// What the base's outputs and their first derivatives are.
    fn base_slopes(&mut self, eta: &[f64]) {
        if self.straight {
            return self.copy_base();
        }
        let omega = self.motion.data().base_rate;
        let parameters = eta.len();
        let eta: [Dual<BASE>; PARAMETERS] = seeded(eta, Dual::seeded);
        let spin: [Dual<BASE>; 3] = seeded(omega.components(), |value, i| {
            Dual::seeded(value, parameters + i)
        });
        let spin = Sp::Angular::from_components(&spin[..Sp::ANGLES]);
        base_outputs(self.system, &eta[..parameters], &spin, &mut self.base_first);
        for row in 0..self.base_first.len() {
            let output = self.base_first[row];
            self.spread_base(row, output.value, &output.gradient);
        }
    }

    /// The same with second derivatives.
    fn base_bends(&mut self, eta: &[f64]) {
        if self.straight {
            return self.copy_base();
        }
        let omega = self.motion.data().base_rate;
        let parameters = eta.len();
        let eta: [HyperDual<PARAMETERS, BASE>; PARAMETERS] =
            seeded(eta, |value, i| HyperDual::seeded(value, Some(i), Some(i)));
        let spin: [HyperDual<PARAMETERS, BASE>; 3] = seeded(omega.components(), |value, i| {
            HyperDual::seeded(value, None, Some(parameters + i))
        });
        let spin = Sp::Angular::from_components(&spin[..Sp::ANGLES]);
        base_outputs(
            self.system,
            &eta[..parameters],
            &spin,
            &mut self.base_second,
        );
        for row in 0..self.base_second.len() {
            let (value, by) = (self.base_second[row].value, self.base_second[row].columns);
            self.spread_base(row, value, &by);
        }
    }

    /// First derivatives of all that rows and cost terms are functions of, but the attitude's own
    /// rates.
    fn linearization<'s>(&'s self, point: Point<'s, f64>) -> Linearization<'s, Sp> {
        Linearization {
            plant: &self.system.plant,
            point,
            data: self.motion.data(),
            rates: &self.rates,
            torque: &self.torque,
            base_by: &self.base_by[self.parameters() * self.states()..],
            torque_by: &self.torque_by,
        }
    }

    /// Weights on the base's outputs and on the torques, from those on the rates of the states, on
    /// the path rows and on the running cost.
    fn weigh(&mut self, point: Point<'_, f64>, weights: &[f64]) {
        let (parameters, states) = (self.parameters(), self.states());
        let mut base = std::mem::take(&mut self.base_weights);
        let mut torque = std::mem::take(&mut self.torque_weights);
        let (own, rest) = base.split_at_mut(parameters);
        own.copy_from_slice(&weights[..parameters]);
        rest.fill(0.0);
        torque.fill(0.0);
        let (base_rate, squared_rotation) = rest.split_at_mut(Sp::ANGLES);
        let mut adjoint = Adjoint {
            base_rate,
            squared_rotation,
            torque: &mut torque,
        };
        let at = self.linearization(point);
        let mut rest = &weights[states..];
        for block in &self.system.path {
            let (own, others) = rest.split_at(block.rows().len());
            block.weigh(&at, own, &mut adjoint);
            rest = others;
        }
        for term in &self.system.path_cost {
            term.weigh(&at, self.weight(term, rest), &mut adjoint);
        }
        self.base_weights = base;
        self.torque_weights = torque;
    }

    /// The weight on `term`, of those on the running cost and, where that is bounded, the base's motion.
    fn weight(&self, term: &PathCost, on_cost: &[f64]) -> f64 {
        match on_cost {
            [cost, base] if self.system.is_of_base(term) => cost + base,
            _ => on_cost[0],
        }
    }

    /// Adds what bends with η: η and ω₀ in the base's outputs, and RᵀL where the system tumbles.
    fn add_attitude(&self, eta: &[f64], hessian: &mut Lower<'_>) {
        let parameters = self.parameters();
        let mut bent = [[0.0; BASE]; PARAMETERS];
        for (output, weight) in self.base_second.iter().zip(&self.base_weights) {
            for (sums, row) in bent.iter_mut().zip(&output.block) {
                for (sum, second) in sums.iter_mut().zip(row) {
                    *sum += weight * second;
                }
            }
        }
        let plant = &self.system.plant;
        if let Some(angular) = plant.drift.angular() {
            let seeded: [HyperDual<PARAMETERS, PARAMETERS>; PARAMETERS] =
                seeded(eta, |value, i| HyperDual::seeded(value, Some(i), Some(i)));
            let seen = plant.attitude.to_base(&seeded[..parameters], angular);
            for (c, weight) in seen.components().iter().zip(self.motion.momentum_weight()) {
                for (sums, row) in bent.iter_mut().zip(&c.block) {
                    for (sum, second) in sums.iter_mut().zip(row) {
                        *sum += weight * second;
                    }
                }
            }
        }
        for (row, bent) in bent.iter().enumerate().take(parameters) {
            for (column, second) in bent.iter().enumerate().take(row + 1) {
                hessian.add(row, column, *second);
            }
            let by_rate = &bent[parameters..parameters + Sp::ANGLES];
            for (by, omega_by) in by_rate
                .iter()
                .zip(self.omega_by.chunks_exact(self.states()))
            {
                for (input, omega_by) in omega_by.iter().enumerate() {
                    hessian.add_pair(row, input, by * omega_by);
                }
            }
        }
    }

    /// Adds what bends in the weighted sum of the torques.
    fn add_torques(&mut self, hessian: &mut Lower<'_>) {
        let n = self.joints();
        let (first, controls) = (self.parameters(), self.states());
        self.motion.torque_curvature(
            &self.torque_weights,
            &mut self.torque_weighted_by,
            &mut self.torque_second,
        );
        for k in 0..n {
            for l in 0..n {
                if l <= k {
                    hessian.add(first + k, first + l, self.torque_second[k * n + l]);
                }
                hessian.add(controls + k, first + l, self.torque_weighted_by[k * n + l]);
            }
        }
    }
}

/// Whether numbers are the same to the bit.
fn same<'n>(a: impl Iterator<Item = &'n f64>, b: impl Iterator<Item = &'n f64>) -> bool {
    a.zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// `values` with a direction each, and zeros.
fn seeded<S: Scalar, const P: usize>(values: &[f64], seed: impl Fn(f64, usize) -> S) -> [S; P] {
    let mut seeded = [S::zero(); P];
    for (i, (to, &value)) in seeded.iter_mut().zip(values).enumerate() {
        *to = seed(value, i);
    }
    seeded
}

impl<Sp: Space, J: Storage, const N: usize, const FUSED: bool> PointDerivatives
    for NodeDerivatives<'_, Sp, J, N, FUSED>
{
    fn kept(&self) -> usize {
        self.kept
    }

    fn keep(&mut self, kept: &mut [f64]) {
        let Some((flag, mut rest)) = kept.split_first_mut() else {
            return;
        };
        *flag = f64::from(u8::from(self.is_loaded));
        self.visit(|part| {
            let (to, others) = std::mem::take(&mut rest).split_at_mut(part.len());
            to.copy_from_slice(part);
            rest = others;
        });
    }

    fn recall(&mut self, kept: &[f64]) {
        let Some((_, mut rest)) = kept.split_first().filter(|(flag, _)| **flag != 0.0) else {
            return;
        };
        self.is_loaded = true;
        self.visit(|part| {
            let (from, others) = rest.split_at(part.len());
            part.copy_from_slice(from);
            rest = others;
        });
    }

    fn jacobian(&mut self, point: Point<'_, f64>, jacobian: &mut [f64]) {
        self.load(&point);
        let system = self.system;
        let n = self.joints();
        let (parameters, states) = (self.parameters(), self.states());
        self.base_slopes(&point.x[..parameters]);

        jacobian.fill(0.0);
        let at = self.linearization(point);
        let width = at.width();
        let (dynamics, rest) = jacobian.split_at_mut(states * width);
        let mut rows = dynamics.chunks_exact_mut(width);
        for (row, by) in rows
            .by_ref()
            .zip(self.base_by.chunks_exact(states))
            .take(parameters)
        {
            row[..states].copy_from_slice(by);
        }
        for (j, row) in rows.by_ref().take(n).enumerate() {
            row[at.rate(j)] = 1.0;
        }
        for (j, row) in rows.enumerate() {
            let (by_eta, by_joints) = row[..states].split_at_mut(parameters);
            self.motion.acceleration_by(j, by_joints, by_eta);
            row[at.control(j)] = 1.0;
        }
        let mut rest = rest;
        for block in &system.path {
            let (own, others) = rest.split_at_mut(block.rows().len() * width);
            block.gradient(&at, own);
            rest = others;
        }
        let (cost, base) = rest.split_at_mut(width);
        for term in &system.path_cost {
            term.gradient(&at, cost);
            if !base.is_empty() && system.is_of_base(term) {
                term.gradient(&at, base);
            }
        }
    }

    fn hessian(&mut self, point: Point<'_, f64>, weights: &[f64], hessian: &mut [f64]) {
        self.load(&point);
        let system = self.system;
        let n = self.joints();
        let (parameters, states) = (self.parameters(), self.states());
        self.base_bends(&point.x[..parameters]);
        self.weigh(point, weights);
        let mut by_omega = [0.0; 3];
        for (output, weight) in self.base_second.iter().zip(&self.base_weights) {
            for (sum, by) in by_omega.iter_mut().zip(&output.columns[parameters..]) {
                *sum += weight * by;
            }
        }
        let accelerations = &weights[parameters + n..states];
        self.motion.second(accelerations, &by_omega[..Sp::ANGLES]);

        hessian.fill(0.0);
        let width = states + n + point.parameters.len() + 1;
        let mut hessian = Lower::new(hessian, width);
        for row in 0..2 * n {
            let by_joints = &mut hessian.row(parameters + row)[parameters..];
            by_joints.copy_from_slice(self.motion.second_by(row));
        }
        for i in 0..self.tumbled.len() / Sp::ANGLES {
            let (by_joints, by_eta) = self.motion.second_by(2 * n + i).split_at(2 * n);
            for (j, second) in by_joints.iter().enumerate() {
                hessian.add(parameters + j, i, *second);
            }
            for (j, second) in by_eta.iter().enumerate() {
                hessian.add(i, j, *second);
            }
        }
        if !self.straight {
            self.add_attitude(&point.x[..parameters], &mut hessian);
        }
        if system.needs.torque {
            self.add_torques(&mut hessian);
        }
        let at = self.linearization(point);
        let mut rest = &weights[states..];
        for block in &system.path {
            let (own, others) = rest.split_at(block.rows().len());
            block.curvature(&at, own, &mut hessian);
            rest = others;
        }
        for term in &system.path_cost {
            term.curvature(&at, self.weight(term, rest), &mut hessian);
        }
    }
}
