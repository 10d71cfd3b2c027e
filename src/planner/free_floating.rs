//! The free-floating manipulator as an optimal control problem, eq. (7) to (18).

use super::Problem;
use super::goal::GoalRows;
use super::keep_out::KeepOutRow;
use super::momentum::Drift;
use super::node_derivatives;
use super::turn::{ROTATION, TurnLimits};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::{Attitude, PlanarAngle};
use crate::dynamics::space::{Planar, Space, Spatial, Vector};
use crate::dynamics::{Data, Tree};
use crate::ocp::{
    Ends, Formulation, Interval, LimitGroup, Limited, Ocp, Passage, Point, PointDerivatives,
    Quantity,
};
use crate::transcription::Discretization;

/// States x = [η, θ, θ̇], controls u = H⁻¹τ.
///
/// The paper's state is [θ, θ̇]; the base attitude joins it because its limits (10) and its cost
/// (14) need it. Path rows, where limited: the rates η̇ (or ω, where η are no angles), the torques
/// τ = Hu, the rotation angle, the pairs kept apart.
#[derive(Debug, Clone)]
pub struct FreeFloating<Sp: Space> {
    tree: Tree<Sp>,
    pub(super) attitude: Sp::Attitude,
    formulation: Formulation,
    pub(super) cost: super::Cost,
    start_position: Sp::Linear<f64>,
    pub(super) rate_rows: bool,
    pub(super) torque_rows: bool,
    pub(super) torque_cost: bool,
    goal: Option<GoalRows<Sp>>,
    /// Goal at each way-point.
    way_points: Vec<Option<GoalRows<Sp>>>,
    pub(super) drift: Drift<Sp>,
    turn: TurnLimits,
    pub(super) keep_out: Vec<KeepOutRow<Sp>>,
}

impl FreeFloating<Planar> {
    /// The planar form of `problem`, or `None` where its motion leaves the plane.
    pub fn planar(problem: &Problem) -> Option<Self> {
        let tree = Tree::planar(&problem.robot)?;
        Some(Self::new(problem, tree, PlanarAngle))
    }
}

impl FreeFloating<Spatial> {
    /// The spatial form of `problem`.
    pub fn spatial(problem: &Problem) -> Self {
        let tree = Tree::spatial(&problem.robot);
        Self::new(problem, tree, problem.attitude)
    }
}

impl<Sp: Space> FreeFloating<Sp> {
    fn new(problem: &Problem, tree: Tree<Sp>, attitude: Sp::Attitude) -> Self {
        let limits = &problem.limits;
        let limited = |bounds: &[Interval]| bounds.iter().any(|b| !b.is_free());
        let rate_rows = limited(&limits.base_rate);
        let torque_rows = limited(&limits.torque);
        let mut data = Data::<Sp, f64>::new(&tree);
        tree.kinematics(&problem.task.initial_joints, &mut data);
        tree.momentum(&mut data);
        let start_position = attitude.base_position(attitude.start(), &data.system_center);
        let goal = problem.task.end_effector.as_ref();
        let goal = goal.map(|goal| GoalRows::new(goal, start_position));
        let turn = TurnLimits::new::<Sp>(problem, attitude);
        let mut formulation = formulation::<Sp>(problem, (attitude, &turn), rate_rows, torque_rows);
        formulation.path.extend(turn.path());
        let points = problem.task.way_points.iter().enumerate();
        let (passed, way_points) = points
            .map(|(i, point)| {
                point.formulate(i, &problem.task.duration, attitude.count(), start_position)
            })
            .unzip();
        formulation.way_points = passed;
        let pairs = limits.keep_out.iter();
        let keep_out: Vec<_> = pairs.map(|pair| KeepOutRow::new(pair, &tree)).collect();
        formulation
            .path
            .extend(keep_out.iter().map(KeepOutRow::quantity));
        formulation.boundary = goal.iter().flat_map(GoalRows::quantities).collect();
        formulation.boundary.extend(turn.ends());
        // Path rows do not reach t_f, which is no collocation point.
        formulation
            .boundary
            .extend(keep_out.iter().map(KeepOutRow::quantity));
        Self {
            formulation,
            cost: problem.cost.clone(),
            start_position,
            goal,
            turn,
            way_points,
            keep_out,
            drift: Drift::new(&problem.task.initial_momentum, tree.total_mass()),
            rate_rows,
            torque_rows,
            torque_cost: problem.cost.torque.iter().any(|w| *w > 0.0),
            attitude,
            tree,
        }
    }

    /// The dynamics behind the problem.
    pub fn tree(&self) -> &Tree<Sp> {
        &self.tree
    }

    /// How the base attitude is described.
    pub fn attitude(&self) -> Sp::Attitude {
        self.attitude
    }

    /// The base's angular velocity for the joint rates and the system's momentum, into `data`;
    /// needs [`Tree::momentum`].
    pub fn base_rate<S: Scalar>(&self, eta: &[S], dtheta: &[S], data: &mut Data<Sp, S>) {
        self.tree.base_rate(dtheta, data);
        self.drift.tumble(self.attitude, eta, data);
    }

    /// Moves an inertial position with the system's mass centre, `t` seconds after t₀.
    pub fn carry<S: Scalar>(&self, t: S, position: &mut [S]) {
        self.drift.carry(t, position);
    }

    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.tree.joint_count()
    }

    /// Key in the problem file of the limit behind path row `p`, and the joint it is about.
    pub fn path_limit(&self, p: usize) -> (&'static str, Option<usize>) {
        let count = |given: bool, rows: usize| if given { rows } else { 0 };
        let torques = count(self.rate_rows, Sp::ANGLES);
        let turn = torques + count(self.torque_rows, self.joint_count());
        if p < torques {
            ("limits.base_rate", None)
        } else if p < turn {
            ("limits.torque", Some(p - torques))
        } else if p < turn + self.turn.path().len() {
            ("limits.base_attitude", None)
        } else {
            ("limits.keep_out", None)
        }
    }

    /// Key in the problem file of the limit on state `i` along the path, and the joint it is about.
    pub fn state_limit(&self, i: usize) -> (&'static str, Option<usize>) {
        let n = self.joint_count();
        match i.checked_sub(self.attitude.count()) {
            None => ("limits.base_attitude", None),
            Some(j) if j < n => ("limits.joint_position", Some(j)),
            Some(j) => ("limits.joint_velocity", Some(j - n)),
        }
    }

    /// How far the pair behind path row `p` is too near where the row has that value, m.
    pub(super) fn keep_out_depth(&self, p: usize, value: f64) -> f64 {
        let first = self.formulation.path.len() - self.keep_out.len();
        self.keep_out[p - first].depth(value)
    }

    /// Key in the problem file of what is behind boundary row `b`.
    pub fn boundary_key(&self, b: usize) -> &'static str {
        let goals = self.goal_rows();
        if b < goals {
            "task.final.end_effector"
        } else if b < goals + self.turn.ends().len() {
            "limits.final_base_attitude"
        } else {
            "limits.keep_out"
        }
    }

    /// Boundary rows of the end-effector goal, which come first.
    fn goal_rows(&self) -> usize {
        self.formulation.boundary.len() - self.turn.ends().len() - self.keep_out.len()
    }

    /// The goal for the end effector at t_f.
    pub(super) fn final_goal(&self) -> Option<&GoalRows<Sp>> {
        self.goal.as_ref()
    }

    /// The goals at way-points: which one, its fraction of the duration, its rows.
    pub(super) fn way_point_goals(&self) -> impl Iterator<Item = (usize, f64, &GoalRows<Sp>)> {
        let fractions = self.formulation.way_points.iter().map(|p| p.fraction);
        let goals = fractions.zip(&self.way_points).enumerate();
        goals.filter_map(|(w, (fraction, goal))| Some((w, fraction, goal.as_ref()?)))
    }

    /// Values of a goal's rows for the states `x`, `t` seconds after t₀.
    pub(super) fn goal_values(&self, goal: &GoalRows<Sp>, x: &[f64], t: f64) -> Vec<f64> {
        let mut data = Data::<Sp, f64>::new(&self.tree);
        let mut rows = vec![0.0; goal.quantities().len()];
        self.pose(goal, x, t, &mut data, &mut rows);
        rows
    }

    /// Rows of a goal for the states `x`, `t` seconds after t₀.
    fn pose<S: Scalar>(
        &self,
        goal: &GoalRows<Sp>,
        x: &[S],
        t: S,
        data: &mut Data<Sp, S>,
        rows: &mut [S],
    ) {
        let (eta, joints) = x.split_at(self.attitude.count());
        self.tree.kinematics(&joints[..self.joint_count()], data);
        self.tree.momentum(data);
        if let Some(pose) = self.tree.end_effector(data) {
            let carry = |position: &mut [S]| self.drift.carry(t, position);
            let base = (self.attitude, eta);
            goal.values(base, pose, &data.system_center, carry, rows);
        }
    }

    /// Values of the path rows at every collocation point of `trajectory`.
    pub fn path_rows(&self, trajectory: &Discretization) -> Vec<Vec<f64>> {
        let mut scratch = self.scratch::<f64>();
        let mut rates = vec![0.0; trajectory.states];
        let times = trajectory.times();
        (0..trajectory.mesh.points())
            .map(|k| {
                let mut rows = vec![0.0; self.formulation.path.len()];
                let (x, u, t) = (trajectory.state(k), trajectory.control(k), times[k]);
                self.continuous(Point { x, u, t }, &mut scratch, &mut rates, &mut rows);
                rows
            })
            .collect()
    }

    /// States and values of the rows at every way-point of `trajectory`.
    pub fn passed(&self, trajectory: &Discretization) -> Vec<(Vec<f64>, Vec<f64>)> {
        let mut u = vec![0.0; trajectory.controls];
        let points = self.formulation.way_points.iter().zip(&self.way_points);
        points
            .map(|(point, goal)| {
                let mut x = vec![0.0; trajectory.states];
                trajectory.at_fraction(point.fraction, &mut x, &mut u);
                let t = point.fraction * trajectory.duration;
                let goal = goal.as_ref();
                let rows = goal.map_or_else(Vec::new, |goal| self.goal_values(goal, &x, t));
                (x, rows)
            })
            .collect()
    }

    /// Values of the boundary rows at the ends of `trajectory`.
    pub fn end_rows(&self, trajectory: &Discretization) -> Vec<f64> {
        let mut rows = vec![0.0; self.formulation.boundary.len()];
        let ends = Ends {
            initial: trajectory.state(0),
            terminal: trajectory.state(trajectory.mesh.points()),
            duration: trajectory.duration,
        };
        self.boundary(ends, &mut self.scratch::<f64>(), &mut rows);
        rows
    }

    /// Limits that may be what makes the problem infeasible, each with its key in the problem
    /// file. Base attitude along the path and at t_f give way together.
    pub fn limit_groups(&self) -> Vec<LimitGroup> {
        let n = self.joint_count();
        let states = &self.formulation.states;
        let scale = |bounds: &Interval| {
            let finite = [bounds.lower, bounds.upper].map(f64::abs);
            finite
                .into_iter()
                .filter(|b| b.is_finite())
                .fold(0.0, f64::max)
                .max(1e-3)
        };
        let mut groups = Vec::new();
        let mut push = |name: String, members: Vec<Limited>, bounds: &Interval| {
            if !members.is_empty() {
                groups.push(LimitGroup {
                    name,
                    members,
                    scale: scale(bounds),
                });
            }
        };
        let whole = !self.attitude.is_angles();
        let mut turn = Vec::new();
        for (i, state) in states.iter().enumerate().take(self.attitude.count()) {
            let along = state.bounds;
            let at_end = self.formulation.terminal[i];
            let members = [(along, Limited::State(i)), (at_end, Limited::Terminal(i))];
            let tightest = along.intersect(&at_end);
            let members = members
                .into_iter()
                .filter(|(b, _)| !b.is_free())
                .map(|(_, m)| m);
            if whole {
                turn.extend(members);
            } else {
                push(state.name.clone(), members.collect(), &tightest);
            }
        }
        // All that bounds the rotation angle gives way together.
        let on_turn = |p: &usize| self.path_limit(*p).0 == "limits.base_attitude";
        let path = 0..self.formulation.path.len();
        turn.extend(path.filter(on_turn).map(Limited::Path));
        let ends = (0..self.turn.ends().len()).map(|b| Limited::Boundary(self.goal_rows() + b));
        turn.extend(ends);
        // Of the squares: twice the relative excess of the angle, to first order.
        push(ROTATION.into(), turn, &Interval::symmetric(2.0));
        for (i, row) in self
            .formulation
            .path
            .iter()
            .enumerate()
            .filter(|(i, r)| !r.bounds.is_free() && !on_turn(i))
        {
            let mut members = vec![Limited::Path(i)];
            // The same pair at t_f: both lists of rows end with the pairs.
            if self.path_limit(i).0 == "limits.keep_out" {
                let from_last = self.formulation.path.len() - i;
                members.push(Limited::Boundary(
                    self.formulation.boundary.len() - from_last,
                ));
            }
            push(row.name.clone(), members, &row.bounds);
        }
        // Positions before rates: where both could give way, the cheaper one is found anyway.
        let joints = states.iter().enumerate().skip(self.attitude.count());
        for (i, state) in joints.take(2 * n) {
            if !state.bounds.is_free() {
                push(state.name.clone(), vec![Limited::State(i)], &state.bounds);
            }
        }
        let goal_rows = &self.formulation.boundary[..self.goal_rows()];
        for (b, row) in goal_rows.iter().enumerate() {
            // Allowed distances are small; a tenth of a metre or radian counts as one.
            groups.push(LimitGroup {
                name: row.name.clone(),
                members: vec![Limited::Boundary(b)],
                scale: 0.1,
            });
        }
        for (w, point) in self.formulation.way_points.iter().enumerate() {
            let mut push = |name: String, member| {
                groups.push(LimitGroup {
                    name,
                    members: vec![member],
                    scale: 0.1,
                });
            };
            for (i, _) in point
                .states
                .iter()
                .enumerate()
                .filter(|(_, b)| !b.is_free())
            {
                let name = format!("{}, way-point {}", states[i].name, w + 1);
                push(name, Limited::Passed(w, i));
            }
            for (r, row) in point.rows.iter().enumerate() {
                push(row.name.clone(), Limited::WayPoint(w, r));
            }
        }
        let mut push = |name: String, members: Vec<Limited>, bounds: &Interval| {
            groups.push(LimitGroup {
                name,
                members,
                scale: scale(bounds),
            });
        };
        for (j, control) in self.formulation.controls.iter().enumerate() {
            if !control.bounds.is_free() {
                push(
                    control.name.clone(),
                    vec![Limited::Control(j)],
                    &control.bounds,
                );
            }
        }
        groups
    }
}

fn formulation<Sp: Space>(
    problem: &Problem,
    (attitude, turn): (Sp::Attitude, &TurnLimits),
    rate_rows: bool,
    torque_rows: bool,
) -> Formulation {
    let n = problem.robot.joint_count();
    let (task, limits) = (&problem.task, &problem.limits);
    let joints = |what: &str, bounds: &[Interval]| -> Vec<Quantity> {
        let named =
            |(j, b): (usize, &Interval)| Quantity::new(format!("joint {} {what}", j + 1), *b);
        bounds.iter().enumerate().map(named).collect()
    };
    let angles = |suffix: &str, bounds: &[Interval]| -> Vec<Quantity> {
        let named = |(name, b): (&&str, &Interval)| Quantity::new(format!("{name}{suffix}"), *b);
        attitude.names().iter().zip(bounds).map(named).collect()
    };
    let fixed = |values: &[f64]| {
        values
            .iter()
            .copied()
            .map(Interval::fixed)
            .collect::<Vec<_>>()
    };
    let axes = ["x", "y", "z"].iter().zip(&limits.base_rate);
    let spin = axes.map(|(axis, b)| Quantity::new(format!("base angular velocity {axis}"), *b));
    let mut path = Vec::new();
    if rate_rows && attitude.is_angles() {
        path.extend(angles(" rate", &limits.base_rate));
    } else if rate_rows {
        path.extend(spin);
    }
    if torque_rows {
        path.extend(joints("torque", &limits.torque));
    }
    let rest = vec![0.0; n];
    let [along, last] = turn.parameter_bounds(problem, attitude.start());
    Formulation {
        states: [
            angles("", &along),
            joints("position", &limits.joint_position),
            joints("rate", &limits.joint_velocity),
        ]
        .concat(),
        controls: joints("control", &limits.control),
        path,
        boundary: Vec::new(),
        initial: [
            fixed(attitude.start()),
            fixed(&task.initial_joints),
            fixed(&task.initial_rates),
        ]
        .concat(),
        terminal: [
            last,
            fixed(&task.final_joints)
                .into_iter()
                .zip(&task.free_joints)
                .map(|(at, &free)| if free { Interval::FREE } else { at })
                .collect(),
            fixed(&rest),
        ]
        .concat(),
        duration: task.duration,
        way_points: Vec::new(),
    }
}

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
        passage: Passage<'_, S>,
        scratch: &mut Scratch<Sp, S>,
        rows: &mut [S],
    ) {
        if let Some(goal) = &self.way_points[passage.way_point] {
            self.pose(goal, passage.x, passage.t, &mut scratch.data, rows);
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
    pub(super) fn base_output_count(&self) -> usize {
        self.attitude.count() + Sp::ANGLES + self.turn.path().len()
    }

    /// What η and ω₀ alone determine: η̇, then the rates that limits and costs are about, then the
    /// path rows of the rotation angle.
    pub(super) fn base_outputs<S: Scalar>(&self, eta: &[S], omega: &Sp::Angular<S>, out: &mut [S]) {
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
pub(super) fn torques<S: Scalar>(mass_matrix: &[S], u: &[S], torque: &mut [S]) {
    let n = u.len();
    for i in 0..n {
        let mut sum = S::zero();
        for (j, &uj) in u.iter().enumerate() {
            sum += mass_matrix[i.max(j) * n + i.min(j)] * uj;
        }
        torque[i] = sum;
    }
}
