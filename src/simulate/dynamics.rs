//! The unreduced equations of motion (4) in the plane, with a wrench on every body.

use super::plane::PlanarBodies;
use crate::dynamics::{JointKind, Ldl};
use nalgebra::Vector2;

/// Degrees of freedom of the base: position of its origin, then its angle.
pub const BASE: usize = 3;

/// One body at one instant, inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    /// Cosine and sine of its angle.
    pub turn: Vector2<f64>,
    /// Angular velocity, rad/s.
    pub omega: f64,
    /// Origin of its frame, m.
    pub origin: Vector2<f64>,
    /// Velocity of that origin, m/s.
    pub origin_velocity: Vector2<f64>,
    /// Mass centre, m.
    pub center: Vector2<f64>,
    /// Velocity of the mass centre, m/s.
    pub velocity: Vector2<f64>,
    /// Direction of sliding.
    slide: Vector2<f64>,
    /// Acceleration of origin and mass centre at zero generalized acceleration, m/s².
    origin_bias: Vector2<f64>,
    bias: Vector2<f64>,
}

impl BodyState {
    const REST: Self = Self {
        turn: Vector2::new(1.0, 0.0),
        omega: 0.0,
        origin: Vector2::new(0.0, 0.0),
        origin_velocity: Vector2::new(0.0, 0.0),
        center: Vector2::new(0.0, 0.0),
        velocity: Vector2::new(0.0, 0.0),
        slide: Vector2::new(0.0, 0.0),
        origin_bias: Vector2::new(0.0, 0.0),
        bias: Vector2::new(0.0, 0.0),
    };

    /// A base at rest with its origin at `position` (m), turned by `attitude` (rad).
    pub fn placed(position: &Vector2<f64>, attitude: f64) -> Self {
        let (sin, cos) = attitude.sin_cos();
        Self {
            turn: Vector2::new(cos, sin),
            origin: *position,
            ..Self::REST
        }
    }

    /// A point fixed to the body, and its velocity.
    pub fn point(&self, at: &Vector2<f64>) -> (Vector2<f64>, Vector2<f64>) {
        let arm = turned(&self.turn, at);
        (
            self.origin + arm,
            self.origin_velocity + left(&arm) * self.omega,
        )
    }
}

/// Force at a body's mass centre (N) and moment (N·m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: Vector2<f64>,
    /// Moment about the mass centre, N·m.
    pub moment: f64,
}

impl Wrench {
    /// None.
    pub const ZERO: Self = Self {
        force: Vector2::new(0.0, 0.0),
        moment: 0.0,
    };

    /// Adds a force that acts at `point` of a body with its mass centre at `center`.
    pub fn add(&mut self, force: &Vector2<f64>, point: &Vector2<f64>, center: &Vector2<f64>) {
        self.force += force;
        self.moment += (point - center).perp(force);
    }
}

/// Bodies in motion, and M(q) v̇ = f(q, v) with M factored: allocated once.
#[derive(Debug, Clone)]
pub struct PlanarDynamics {
    model: PlanarBodies,
    states: Vec<BodyState>,
    /// Velocity of the current body's mass centre and its rate of turning for each unit rate;
    /// entries of other branches are not read.
    jacobian: Vec<(Vector2<f64>, f64)>,
    /// The coordinates that move the current body.
    moved_by: Vec<usize>,
    matrix: Vec<f64>,
    factors: Ldl<f64>,
}

impl PlanarDynamics {
    /// Scratch for `model`.
    pub fn new(model: PlanarBodies) -> Self {
        let size = BASE + model.joint_count();
        Self {
            states: vec![BodyState::REST; model.bodies().len()],
            jacobian: vec![(Vector2::zeros(), 0.0); size],
            moved_by: Vec::with_capacity(size),
            matrix: vec![0.0; size * size],
            factors: Ldl::new(size),
            model,
        }
    }

    /// Degrees of freedom, 3 + n.
    pub fn size(&self) -> usize {
        self.jacobian.len()
    }

    /// The robot.
    pub fn model(&self) -> &PlanarBodies {
        &self.model
    }

    /// The bodies as last placed, the base first.
    pub fn states(&self) -> &[BodyState] {
        &self.states
    }

    /// Moves all bodies to the coordinates `q` and their rates `v` (x, y, η, θ; length 3 + n).
    pub fn place(&mut self, q: &[f64], v: &[f64]) {
        for (i, body) in self.model.bodies().iter().enumerate() {
            let mut state = BodyState::REST;
            if i == 0 {
                let (sin, cos) = q[2].sin_cos();
                state.turn = Vector2::new(cos, sin);
                state.omega = v[2];
                state.origin = Vector2::new(q[0], q[1]);
                state.origin_velocity = Vector2::new(v[0], v[1]);
            } else {
                let parent = &self.states[body.parent];
                let (position, rate) = (q[BASE + i - 1], v[BASE + i - 1]);
                let mut arm = turned(&parent.turn, &body.offset);
                state.turn = parent.turn;
                state.omega = parent.omega;
                match body.kind {
                    JointKind::Revolute => {
                        let (sin, cos) = (body.sign * position).sin_cos();
                        state.turn = turned(&parent.turn, &Vector2::new(cos, sin));
                        state.omega += body.sign * rate;
                    }
                    JointKind::Prismatic => {
                        state.slide = turned(&parent.turn, &body.slide);
                        arm += state.slide * position;
                        state.origin_velocity = state.slide * rate;
                        // Coriolis.
                        state.origin_bias = left(&state.slide) * (2.0 * parent.omega * rate);
                    }
                }
                state.origin = parent.origin + arm;
                state.origin_velocity += parent.origin_velocity + left(&arm) * parent.omega;
                state.origin_bias += parent.origin_bias - arm * (parent.omega * parent.omega);
            }
            let arm = turned(&state.turn, &body.center);
            state.center = state.origin + arm;
            state.velocity = state.origin_velocity + left(&arm) * state.omega;
            state.bias = state.origin_bias - arm * (state.omega * state.omega);
            self.states[i] = state;
        }
    }

    /// Writes v̇ (length 3 + n) for the bodies as placed, under a wrench on each and the joint
    /// torques (length n).
    pub fn accelerations(&mut self, wrenches: &[Wrench], torque: &[f64], out: &mut [f64]) {
        out[..BASE].fill(0.0);
        out[BASE..].copy_from_slice(torque);
        self.assemble(
            |state, body, i| {
                let Wrench { force, moment } = wrenches[i];
                (force - state.bias * body.mass, moment)
            },
            out,
        );
        self.factors.factor(&self.matrix);
        self.factors.solve(out);
    }

    /// Base velocities v₀ (length 3) that give the whole the linear momentum `linear` (kg m/s)
    /// and the angular one `angular` about its mass centre (kg m²/s), for the bodies as placed
    /// with the base at rest.
    pub fn base_velocity(&mut self, linear: &Vector2<f64>, angular: f64) -> [f64; BASE] {
        let mut momentum = vec![0.0; self.size()];
        self.assemble(
            |state, body, _| (state.velocity * body.mass, body.inertia * state.omega),
            &mut momentum,
        );
        let (mass, center) = (self.model.total_mass(), self.center());
        let arm = center - self.states[0].origin;
        // The base's coordinates: momentum, and angular momentum about the base's origin.
        let wanted = [linear.x, linear.y, angular + arm.perp(linear)];
        let gap = [0, 1, 2].map(|i| wanted[i] - momentum[i]);
        let inertia = self.matrix[2 * self.size() + 2] - mass * arm.norm_squared();
        let omega = (gap[2] - arm.perp(&Vector2::new(gap[0], gap[1]))) / inertia;
        let velocity = Vector2::new(gap[0], gap[1]) / mass - left(&arm) * omega;
        [velocity.x, velocity.y, omega]
    }

    /// Mass centre of the whole, m.
    pub fn center(&self) -> Vector2<f64> {
        let moment: Vector2<f64> = self.each().map(|(s, mass, _)| s.center * mass).sum();
        moment / self.model.total_mass()
    }

    /// Linear momentum, kg m/s.
    pub fn linear_momentum(&self) -> Vector2<f64> {
        self.each().map(|(s, mass, _)| s.velocity * mass).sum()
    }

    /// Angular momentum about the mass centre of the whole, kg m²/s.
    pub fn angular_momentum(&self) -> f64 {
        let center = self.center();
        self.each()
            .map(|(s, mass, inertia)| {
                inertia * s.omega + (s.center - center).perp(&(s.velocity * mass))
            })
            .sum()
    }

    fn each(&self) -> impl Iterator<Item = (&BodyState, f64, f64)> {
        self.states
            .iter()
            .zip(self.model.bodies())
            .map(|(state, body)| (state, body.mass, body.inertia))
    }

    /// Assembles M (lower triangle) and adds Σ Jᵀ(force, moment) over all bodies to `out`.
    fn assemble(
        &mut self,
        load: impl Fn(&BodyState, &super::plane::PlanarBody, usize) -> (Vector2<f64>, f64),
        out: &mut [f64],
    ) {
        let size = self.jacobian.len();
        self.matrix.fill(0.0);
        for i in 0..self.states.len() {
            self.fill_jacobian(i);
            let (body, state) = (&self.model.bodies()[i], &self.states[i]);
            let (force, moment) = load(state, body, i);
            for &row in &self.moved_by {
                let (linear, angular) = self.jacobian[row];
                out[row] += linear.dot(&force) + angular * moment;
                for &column in &self.moved_by {
                    if column <= row {
                        let (v, w) = self.jacobian[column];
                        self.matrix[row * size + column] +=
                            body.mass * linear.dot(&v) + body.inertia * angular * w;
                    }
                }
            }
        }
    }

    fn fill_jacobian(&mut self, body: usize) {
        let center = self.states[body].center;
        self.jacobian[0] = (Vector2::x(), 0.0);
        self.jacobian[1] = (Vector2::y(), 0.0);
        self.jacobian[2] = (left(&(center - self.states[0].origin)), 1.0);
        self.moved_by.clear();
        self.moved_by.extend(0..BASE);
        let mut i = body;
        while i > 0 {
            let (carried, state) = (&self.model.bodies()[i], &self.states[i]);
            let coordinate = BASE + i - 1;
            self.jacobian[coordinate] = match carried.kind {
                JointKind::Revolute => {
                    (left(&(center - state.origin)) * carried.sign, carried.sign)
                }
                JointKind::Prismatic => (state.slide, 0.0),
            };
            self.moved_by.push(coordinate);
            i = carried.parent;
        }
    }
}

/// A body's vector in inertial axes.
fn turned(turn: &Vector2<f64>, v: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(turn.x * v.x - turn.y * v.y, turn.y * v.x + turn.x * v.y)
}

/// A quarter turn to the left: n × v.
fn left(v: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}
