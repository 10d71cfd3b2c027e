//! Derivatives of the free-floating problem at one point, by the structure of its dynamics.
//!
//! The states enter in three ways, each differentiated by what suits it: the joints through the
//! recursions ([`Sensitivity`]), the attitude η and the base's angular velocity ω₀ through a few
//! elementary functions (dual numbers), the controls linearly.

use super::FreeFloating;
use crate::autodiff::{Dual, HyperDual, Scalar, has_fused};
use crate::dynamics::Sensitivity;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Point, PointDerivatives};

/// Attitude parameters, at most, and those with the components of ω₀.
const PARAMETERS: usize = 4;
const BASE: usize = 8;

/// Derivatives for `system`, with as many directions in one sweep as it has use for.
pub(super) fn of<Sp: Space>(system: &FreeFloating<Sp>) -> Box<dyn PointDerivatives + '_> {
    match (system.joint_count() <= 2, has_fused()) {
        (true, true) => Box::new(NodeDerivatives::<Sp, 4, true>::new(system)),
        (true, false) => Box::new(NodeDerivatives::<Sp, 4, false>::new(system)),
        (false, true) => Box::new(NodeDerivatives::<Sp, 16, true>::new(system)),
        (false, false) => Box::new(NodeDerivatives::<Sp, 16, false>::new(system)),
    }
}

struct NodeDerivatives<'a, Sp: Space, const N: usize, const FUSED: bool> {
    system: &'a FreeFloating<Sp>,
    motion: Sensitivity<Sp, N, FUSED>,
    /// Input behind each direction of `motion`.
    inputs: Vec<usize>,
    /// Second derivatives of the running cost by [base rates, θ̇]: (row, column, value), both
    /// triangles.
    rate_cost: Vec<(usize, usize, f64)>,
    /// [base rates, θ̇] and their derivatives of the cost.
    rates: Vec<f64>,
    rate_slope: Vec<f64>,
    /// Derivatives of ω₀ by η, one parameter after the other, where the system tumbles.
    turned: Vec<f64>,
    /// What η and ω₀ alone determine, with its derivatives by both.
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

impl<'a, Sp: Space, const N: usize, const FUSED: bool> NodeDerivatives<'a, Sp, N, FUSED> {
    fn new(system: &'a FreeFloating<Sp>) -> Self {
        let n = system.joint_count();
        let parameters = system.attitude.count();
        let tumbles = system.drift.angular().is_some();
        let others = if tumbles { parameters } else { 0 };
        let outputs = system.base_output_count();
        let rates = Sp::ANGLES + n;
        Self {
            motion: Sensitivity::new(system.tree(), others),
            inputs: (parameters..parameters + 2 * n).chain(0..others).collect(),
            rate_cost: rate_cost(system),
            rates: vec![0.0; rates],
            rate_slope: vec![0.0; rates],
            turned: vec![0.0; others * Sp::ANGLES],
            base_first: vec![Dual::constant(0.0); outputs],
            base_second: vec![HyperDual::constant(0.0); outputs],
            base_by: vec![0.0; outputs * (parameters + 2 * n)],
            base_weights: vec![0.0; outputs],
            torque: vec![0.0; n],
            torque_weights: vec![0.0; n],
            torque_by: vec![0.0; n * n],
            torque_weighted_by: vec![0.0; n * n],
            torque_second: vec![0.0; n * n],
            system,
        }
    }

    fn parameters(&self) -> usize {
        self.system.attitude.count()
    }

    /// States: η, θ, θ̇.
    fn states(&self) -> usize {
        self.parameters() + 2 * self.system.joint_count()
    }

    /// Input that joint rate `j` is.
    fn rate_input(&self, j: usize) -> usize {
        self.parameters() + self.system.joint_count() + j
    }

    fn torques_wanted(&self) -> bool {
        self.system.torque_rows || self.system.torque_cost
    }

    /// Free motion with its first derivatives.
    fn load(&mut self, point: &Point<'_, f64>) {
        let system = self.system;
        let n = system.joint_count();
        let (eta, joints) = point.x.split_at(self.parameters());
        let (theta, dtheta) = joints.split_at(n);
        self.motion.load(system.tree(), theta, dtheta, |data| {
            system.drift.tumble(system.attitude, eta, data);
        });
        if let Some(angular) = system.drift.angular() {
            let seeded: [Dual<PARAMETERS>; PARAMETERS] = seeded(eta, Dual::seeded);
            let seen = system.attitude.to_base(&seeded[..eta.len()], angular);
            for (i, turned) in self.turned.chunks_exact_mut(Sp::ANGLES).enumerate() {
                let mut by = [0.0; 3];
                for (by, c) in by.iter_mut().zip(seen.components()) {
                    *by = c.gradient[i];
                }
                let by = Sp::Angular::from_components(&by[..Sp::ANGLES]);
                let by = Sp::apply(&self.motion.data().inverse_inertia, &by);
                turned.copy_from_slice(by.components());
            }
        }
        self.motion.first(&self.turned);
        if self.torques_wanted() {
            let data = self.motion.data();
            super::torques(&data.mass_matrix, point.u, &mut self.torque);
            self.motion.torque_by(point.u, &mut self.torque_by);
        }
    }

    /// Row `row` of `base_by` from its derivatives by η and ω₀, and the values of the rates.
    fn spread_base(&mut self, row: usize, value: f64, by: &[f64; BASE]) {
        let (parameters, states) = (self.parameters(), self.states());
        let to = &mut self.base_by[row * states..(row + 1) * states];
        to[..parameters].copy_from_slice(&by[..parameters]);
        to[parameters..].fill(0.0);
        for (direction, &input) in self.inputs.iter().enumerate() {
            for (i, by) in by[parameters..parameters + Sp::ANGLES].iter().enumerate() {
                to[input] += by * self.motion.base_rate_by(i, direction);
            }
        }
        if let Some(rate) = row.checked_sub(parameters).filter(|&i| i < Sp::ANGLES) {
            self.rates[rate] = value;
        }
    }

    /// Derivatives of the running cost by [base rates, θ̇]; after [`Self::spread_base`].
    fn slope(&mut self, point: &Point<'_, f64>) {
        let n = self.system.joint_count();
        let dtheta = &point.x[self.parameters() + n..];
        self.rates[Sp::ANGLES..].copy_from_slice(dtheta);
        self.rate_slope.fill(0.0);
        for &(i, j, second) in &self.rate_cost {
            self.rate_slope[i] += second * self.rates[j];
        }
    }

    /// Adds to the lower triangle the second derivatives of the cost on rates.
    fn add_rate_cost(&self, weight: f64, width: usize, hessian: &mut [f64]) {
        let states = self.states();
        let base = |i: usize| {
            let row = self.parameters() + i;
            &self.base_by[row * states..(row + 1) * states]
        };
        for &(i, j, second) in &self.rate_cost {
            let second = weight * second;
            match (i.checked_sub(Sp::ANGLES), j.checked_sub(Sp::ANGLES)) {
                (Some(i), Some(j)) => {
                    if j <= i {
                        hessian[self.rate_input(i) * width + self.rate_input(j)] += second;
                    }
                }
                (None, None) => {
                    let (left, right) = (base(i), base(j));
                    for (row, a) in left.iter().enumerate() {
                        let to = &mut hessian[row * width..=row * width + row];
                        for (to, b) in to.iter_mut().zip(right) {
                            *to += second * a * b;
                        }
                    }
                }
                // The pair comes twice, as (i, j) and as (j, i): each gives one triangle.
                (None, Some(j)) => {
                    let column = self.rate_input(j);
                    for (row, a) in base(i).iter().enumerate().skip(column) {
                        hessian[row * width + column] += second * a;
                    }
                }
                (Some(i), None) => {
                    let row = self.rate_input(i);
                    for (column, b) in base(j).iter().enumerate().take(row + 1) {
                        hessian[row * width + column] += second * b;
                    }
                }
            }
        }
    }

    /// Adds what bends with η: η and ω₀ in the base's outputs, and RᵀL where the system tumbles.
    fn add_attitude(&self, eta: &[f64], width: usize, hessian: &mut [f64]) {
        let parameters = self.parameters();
        let mut bent = [[0.0; BASE]; PARAMETERS];
        for (output, weight) in self.base_second.iter().zip(&self.base_weights) {
            for (sums, row) in bent.iter_mut().zip(&output.block) {
                for (sum, second) in sums.iter_mut().zip(row) {
                    *sum += weight * second;
                }
            }
        }
        if let Some(angular) = self.system.drift.angular() {
            let seeded: [HyperDual<PARAMETERS, PARAMETERS>; PARAMETERS] =
                seeded(eta, |value, i| HyperDual::seeded(value, Some(i), Some(i)));
            let seen = self.system.attitude.to_base(&seeded[..parameters], angular);
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
                hessian[row * width + column] += second;
            }
            let by_spin = &bent[parameters..parameters + Sp::ANGLES];
            for (direction, &input) in self.inputs.iter().enumerate() {
                let mut second = 0.0;
                for (i, by) in by_spin.iter().enumerate() {
                    second += by * self.motion.base_rate_by(i, direction);
                }
                // On the diagonal both triangles meet.
                let twice = if input == row { 2.0 } else { 1.0 };
                hessian[row.max(input) * width + row.min(input)] += twice * second;
            }
        }
    }

    /// Adds what bends in the torques: their weighted sum, and their squares in the cost.
    fn add_torques(&mut self, u: &[f64], cost: f64, width: usize, hessian: &mut [f64]) {
        let n = self.system.joint_count();
        let (first, controls) = (self.parameters(), self.states());
        self.motion.torque_curvature(
            u,
            &self.torque_weights,
            &mut self.torque_weighted_by,
            &mut self.torque_second,
        );
        let mass = &self.motion.data().mass_matrix;
        let mass = |i: usize, j: usize| mass[i.max(j) * n + i.min(j)];
        let squares = self.system.cost.torque.iter().map(|w| 2.0 * cost * w);
        for k in 0..n {
            for l in 0..n {
                let mut both = [0.0; 3];
                for (r, square) in squares.clone().enumerate() {
                    let (by_k, by_l) = (self.torque_by[r * n + k], self.torque_by[r * n + l]);
                    both[0] += square * by_k * by_l;
                    both[1] += square * mass(r, k) * by_l;
                    both[2] += square * mass(r, k) * mass(r, l);
                }
                if l <= k {
                    hessian[(first + k) * width + first + l] +=
                        self.torque_second[k * n + l] + both[0];
                    hessian[(controls + k) * width + controls + l] += both[2];
                }
                hessian[(controls + k) * width + first + l] +=
                    self.torque_weighted_by[k * n + l] + both[1];
            }
        }
    }
}

/// `values` with a direction each, and zeros.
fn seeded<S: Scalar, const P: usize>(values: &[f64], seed: impl Fn(f64, usize) -> S) -> [S; P] {
    let mut seeded = [S::zero(); P];
    for (i, (to, &value)) in seeded.iter_mut().zip(values).enumerate() {
        *to = seed(value, i);
    }
    seeded
}

/// Second derivatives of the running cost by [base rates, θ̇].
fn rate_cost<Sp: Space>(system: &FreeFloating<Sp>) -> Vec<(usize, usize, f64)> {
    let cost = &system.cost;
    let count = Sp::ANGLES + system.joint_count();
    let mut second = vec![vec![0.0; count]; count];
    let own = cost.base_rate.iter().chain(&cost.joint_rate);
    for (i, weight) in own.enumerate() {
        second[i][i] += 2.0 * weight;
    }
    for (i, row) in cost.rate_matrix.iter().flatten().enumerate() {
        for (j, weight) in row.iter().enumerate() {
            second[i][j] += weight;
            second[j][i] += weight;
        }
    }
    let all = second.iter().enumerate();
    all.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &value)| (i, j, value)))
        .filter(|&(.., value)| value != 0.0)
        .collect()
}

impl<Sp: Space, const N: usize, const FUSED: bool> PointDerivatives
    for NodeDerivatives<'_, Sp, N, FUSED>
{
    fn jacobian(&mut self, point: Point<'_, f64>, jacobian: &mut [f64]) {
        self.load(&point);
        let system = self.system;
        let n = system.joint_count();
        let (parameters, states) = (self.parameters(), self.states());
        let eta = &point.x[..parameters];
        let omega = self.motion.data().base_rate;
        let eta: [Dual<BASE>; PARAMETERS] = seeded(eta, Dual::seeded);
        let spin: [Dual<BASE>; 3] = seeded(omega.components(), |value, i| {
            Dual::seeded(value, parameters + i)
        });
        let spin = Sp::Angular::from_components(&spin[..Sp::ANGLES]);
        system.base_outputs(&eta[..parameters], &spin, &mut self.base_first);
        for row in 0..self.base_first.len() {
            let output = self.base_first[row];
            self.spread_base(row, output.value, &output.gradient);
        }
        self.slope(&point);

        jacobian.fill(0.0);
        let width = states + n + 1;
        let mut rows = jacobian.chunks_exact_mut(width);
        let mut next = || rows.next().expect("a row for each output");
        let base_row = |row: usize| &self.base_by[row * states..(row + 1) * states];
        for i in 0..parameters {
            next()[..states].copy_from_slice(base_row(i));
        }
        for j in 0..n {
            next()[self.rate_input(j)] = 1.0;
        }
        for j in 0..n {
            let row = next();
            for (direction, &input) in self.inputs.iter().enumerate() {
                row[input] = self.motion.acceleration_by(j, direction);
            }
            row[states + j] = 1.0;
        }
        if system.rate_rows {
            for i in 0..Sp::ANGLES {
                next()[..states].copy_from_slice(base_row(parameters + i));
            }
        }
        let data = self.motion.data();
        let mass = |i: usize, j: usize| data.mass_matrix[i.max(j) * n + i.min(j)];
        if system.torque_rows {
            for j in 0..n {
                let row = next();
                row[parameters..parameters + n]
                    .copy_from_slice(&self.torque_by[j * n..(j + 1) * n]);
                for k in 0..n {
                    row[states + k] = mass(j, k);
                }
            }
        }
        for extra in parameters + Sp::ANGLES..self.base_first.len() {
            next()[..states].copy_from_slice(base_row(extra));
        }
        for pair in &system.keep_out {
            pair.gradient(system.tree(), data, &mut next()[parameters..parameters + n]);
        }
        let row = next();
        for (i, slope) in self.rate_slope.iter().enumerate() {
            match i.checked_sub(Sp::ANGLES) {
                Some(j) => row[self.rate_input(j)] += slope,
                None => {
                    for (to, by) in row.iter_mut().zip(base_row(parameters + i)) {
                        *to += slope * by;
                    }
                }
            }
        }
        for (j, weight) in system.cost.control.iter().enumerate() {
            row[states + j] += 2.0 * weight * point.u[j];
        }
        if system.torque_cost {
            for (j, weight) in system.cost.torque.iter().enumerate() {
                let slope = 2.0 * weight * self.torque[j];
                for k in 0..n {
                    row[parameters + k] += slope * self.torque_by[j * n + k];
                    row[states + k] += slope * mass(j, k);
                }
            }
        }
    }

    fn hessian(&mut self, point: Point<'_, f64>, weights: &[f64], hessian: &mut [f64]) {
        self.load(&point);
        let system = self.system;
        let n = system.joint_count();
        let (parameters, states) = (self.parameters(), self.states());
        let omega = self.motion.data().base_rate;
        let eta: [HyperDual<PARAMETERS, BASE>; PARAMETERS] =
            seeded(&point.x[..parameters], |value, i| {
                HyperDual::seeded(value, Some(i), Some(i))
            });
        let spin: [HyperDual<PARAMETERS, BASE>; 3] = seeded(omega.components(), |value, i| {
            HyperDual::seeded(value, None, Some(parameters + i))
        });
        let spin = Sp::Angular::from_components(&spin[..Sp::ANGLES]);
        system.base_outputs(&eta[..parameters], &spin, &mut self.base_second);
        for row in 0..self.base_second.len() {
            let (value, by) = (self.base_second[row].value, self.base_second[row].columns);
            self.spread_base(row, value, &by);
        }
        self.slope(&point);

        let (rates, rest) = weights.split_at(parameters);
        let (accelerations, rest) = rest[n..].split_at(n);
        let (spin_rows, rest) = rest.split_at(if system.rate_rows { Sp::ANGLES } else { 0 });
        let (torque_rows, rest) = rest.split_at(if system.torque_rows { n } else { 0 });
        let extra = self.base_weights.len() - parameters - Sp::ANGLES;
        let (extra_rows, rest) = rest.split_at(extra);
        let (pairs, cost) = rest.split_at(system.keep_out.len());
        let cost = cost[0];
        self.base_weights[..parameters].copy_from_slice(rates);
        let (own, extra) = self.base_weights[parameters..].split_at_mut(Sp::ANGLES);
        extra.copy_from_slice(extra_rows);
        for (to, slope) in own.iter_mut().zip(&self.rate_slope) {
            *to = cost * slope;
        }
        for (to, weight) in own.iter_mut().zip(spin_rows) {
            *to += weight;
        }
        let mut turning = [0.0; 3];
        for (output, weight) in self.base_second.iter().zip(&self.base_weights) {
            for (sum, by) in turning.iter_mut().zip(&output.columns[parameters..]) {
                *sum += weight * by;
            }
        }
        self.motion.second(accelerations, &turning[..Sp::ANGLES]);

        let width = states + n + 1;
        hessian.fill(0.0);
        for (row, &i) in self.inputs.iter().enumerate() {
            for (column, &j) in self.inputs[..=row].iter().enumerate() {
                hessian[i.max(j) * width + i.min(j)] = self.motion.second_by(row, column);
            }
        }
        self.add_attitude(&point.x[..parameters], width, hessian);
        self.add_rate_cost(cost, width, hessian);
        for (j, weight) in system.cost.control.iter().enumerate() {
            hessian[(states + j) * width + states + j] += 2.0 * cost * weight;
        }
        if self.torques_wanted() {
            let rows = torque_rows.iter().chain(std::iter::repeat(&0.0));
            let own = system.cost.torque.iter().zip(&self.torque).zip(rows);
            for (to, ((own, torque), row)) in self.torque_weights.iter_mut().zip(own) {
                *to = row + 2.0 * cost * own * torque;
            }
            self.add_torques(point.u, cost, width, hessian);
        }
        for (pair, &weight) in system.keep_out.iter().zip(pairs) {
            let data = self.motion.data();
            pair.curvature(system.tree(), data, |k, l, second| {
                hessian[(parameters + k) * width + parameters + l] += weight * second;
            });
        }
    }
}
