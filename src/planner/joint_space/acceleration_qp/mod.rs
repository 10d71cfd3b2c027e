//! A convex quadratic programme in the joint accelerations at every time step, after Lu et al.
//!
//! The duration is divided into equal steps over which accelerations are constant. At each, the
//! accelerations minimise
//!
//! w_b ‖η̈ − η̈_ref‖² + w_θ ‖a − a_ref‖²,  η̈ = Ja + b,
//!
//! within the limits on joint positions, rates, controls and torques and on the base's rate, all
//! turned into limits on a. Both references are the accelerations of the motion of least ∫‖a‖²
//! that arrives at rest in the steps that are left: the joints at their goal, the base at the
//! attitude it started with. That part is ours, as are the weights: those of the problem's cost on
//! η̇ and θ̇, the base's fading with the square of the time that is left, as both references grow
//! with its inverse and the two goals would fight to the end.
//!
//! So that the goal is reached under limits as well, every step keeps each joint where it can still
//! arrive at rest in the steps that follow, within its limits on rate and half those on control;
//! the other half is for what the Coriolis term does in the meantime. Where that is not enough the
//! whole control counts. What a joint then cannot reach it misses, and the plan says so.
//!
//! Derived in docs/algorithms.md#acceleration-qp.

mod arrival;
mod base;
mod bounds;
mod quadratic;

use super::joint_motion::{JointMotion, THERE, assemble, duration, goal_missed, rest_to_rest};
use crate::dynamics::attitude::SpatialAttitude;
use crate::dynamics::space::Space;
use crate::integrate::Rk4;
use crate::nlp::Control;
use crate::ocp::Interval;
use crate::planner::{Event, Method, Plan, PlanError, Status};
use crate::problem::Problem;
use crate::system::{FreeFloating, System, with_system};
use arrival::Way;
use base::Affine;
use bounds::{BRAKE, Joint, narrowed};
use quadratic::Quadratic;
use std::time;

/// Steps.
const STEPS: usize = 200;
/// The base's weight fades with this power of the share of the time that is left.
const FADE: i32 = 2;
/// Smallest weight of a joint relative to the largest: all joints have a goal to reach.
const LEAST: f64 = 1e-3;

/// Plans `problem`'s task step by step.
///
/// Nothing is known at a step of those to come, so that limits may turn out not to hold or the
/// goal not to be reached; the plan is infeasible then.
///
/// # Errors
/// [`PlanError`] for a task that is not from rest to rest in joint space.
pub(in crate::planner) fn plan(
    problem: &Problem,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Plan, PlanError> {
    let began = time::Instant::now();
    rest_to_rest(Method::AccelerationQp, problem)?;
    // References are for angles, whatever the plan is to be written in.
    let by_angles = problem.edited(|by_angles| {
        if by_angles.has_rotation_angle() {
            by_angles.set_attitude(SpatialAttitude::RollPitchYaw);
        }
    })?;
    let motion = with_system!(&System::new(&by_angles), system => {
        follow(&by_angles, system, monitor)
    });
    with_system!(&System::new(problem), system => finish(problem, system, &motion, began))
}

/// Chooses the accelerations step by step.
fn follow<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> ConstantAccelerations {
    let h = duration(problem) / STEPS as f64;
    let mut stepper = Stepper::new(problem, system);
    let mut motion = ConstantAccelerations::new(problem, h);
    for k in 0..STEPS {
        let event = Event::Step {
            step: k + 1,
            of: STEPS,
        };
        motion.stopped |= monitor(&event) == Control::Stop;
        let state = motion.last();
        let a = if motion.stopped {
            // Bring the joints to rest as they are.
            state.dq.iter().map(|rate| -rate / h).collect()
        } else {
            stepper.acceleration(state, STEPS - k, h)
        };
        let next = stepper.advance(state, &a, h);
        motion.push(a, next);
    }
    motion
}

/// The plan of the motion that was found.
fn finish<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    motion: &ConstantAccelerations,
    began: time::Instant,
) -> Result<Plan, PlanError> {
    let mut plan = assemble(problem, system, Method::AccelerationQp, motion, began)?;
    if motion.stopped {
        plan.status = Status::Interrupted;
        plan.diagnosis = None;
    } else {
        let why = "acceleration-qp does not reach the goal within the limits";
        goal_missed(problem, &mut plan, THERE, why.into());
    }
    Ok(plan)
}

/// Where the system is.
#[derive(Debug, Clone)]
struct State {
    eta: Vec<f64>,
    q: Vec<f64>,
    dq: Vec<f64>,
}

/// Poses and solves the programme of one step.
struct Stepper<'a, Sp: Space> {
    problem: &'a Problem,
    instant: base::Instant<'a, Sp>,
    base_weights: Vec<f64>,
    joint_weights: Vec<f64>,
}

impl<'a, Sp: Space> Stepper<'a, Sp> {
    fn new(problem: &'a Problem, system: &'a FreeFloating<Sp>) -> Self {
        let cost = &problem.cost;
        let largest = |weights: &[f64]| weights.iter().copied().fold(0.0, f64::max);
        let or_one = |weights: &[f64], least: f64| -> Vec<f64> {
            let most = largest(weights);
            let given = |w: &f64| if most > 0.0 { w.max(least * most) } else { 1.0 };
            weights.iter().map(given).collect()
        };
        Self {
            problem,
            instant: base::Instant::new(system),
            base_weights: or_one(&cost.base_rate, 0.0),
            joint_weights: or_one(&cost.joint_rate, LEAST),
        }
    }

    /// The accelerations of the step that begins at `state`, with `left` steps of `h` to go.
    fn acceleration(&mut self, state: &State, left: usize, h: f64) -> Vec<f64> {
        let goal = &self.problem.task.final_joints;
        let n = goal.len();
        let affine = self.instant.at(&state.eta, &state.q, &state.dq);
        let fade = (left as f64 / STEPS as f64).powi(FADE);
        let mut squares = Vec::with_capacity(state.eta.len() + n);
        for i in 0..state.eta.len() {
            let reference = arrival(-state.eta[i], affine.base_rate[i], left, h);
            let target = reference - affine.drift[i];
            squares.push((
                affine.jacobian[i].clone(),
                target,
                fade * self.base_weights[i],
            ));
        }
        let mut reference = vec![0.0; n];
        for j in 0..n {
            reference[j] = arrival(goal[j] - state.q[j], state.dq[j], left, h);
            let mut unit = vec![0.0; n];
            unit[j] = 1.0;
            squares.push((unit, reference[j], self.joint_weights[j]));
        }
        let quadratic = Quadratic {
            squares,
            bounds: self.bounds(state, &affine, left, h),
            rows: self.rows(&affine, h),
        };
        let clamped = || -> Vec<f64> {
            let bounds = quadratic.bounds.iter().zip(&reference);
            bounds.map(|(bound, &a)| bound.clamp(a)).collect()
        };
        // The last two steps are what brings the joints there; nothing is left to choose.
        if left <= 2 {
            return clamped();
        }
        quadratic.solve().unwrap_or_else(clamped)
    }

    fn bounds(&self, state: &State, affine: &Affine, left: usize, h: f64) -> Vec<Interval> {
        let limits = &self.problem.limits;
        let goal = &self.problem.task.final_joints;
        (0..state.q.len())
            .map(|j| {
                let joint = Joint {
                    q: state.q[j],
                    rate: state.dq[j],
                    coriolis: affine.coriolis[j],
                    position: limits.joint_position[j],
                    velocity: limits.joint_velocity[j],
                    control: limits.control[j],
                };
                let way = Way {
                    left: goal[j] - joint.q,
                    rate: joint.rate,
                    steps: left,
                    h,
                };
                let arriving = |share: f64| {
                    let Interval { lower, upper } = joint.control;
                    // Without a limit on the control, from one end of the rates to the other.
                    let most = (joint.velocity.upper - joint.velocity.lower) / h;
                    let limits =
                        Interval::new((share * lower).max(-most), (share * upper).min(most));
                    way.arriving(&limits, &joint.velocity)
                };
                let allowed = joint.acceleration(h);
                match arriving(BRAKE).or_else(|| arriving(1.0)) {
                    Some(arriving) => narrowed(allowed, arriving),
                    None => allowed,
                }
            })
            .collect()
    }

    /// Torques at the start of the step, the base's rate at its end.
    fn rows(&self, affine: &Affine, h: f64) -> Vec<(Vec<f64>, Interval)> {
        let limits = &self.problem.limits;
        let torques = affine
            .inertia
            .iter()
            .zip(&limits.torque)
            .map(|(row, bound)| {
                let held: f64 = row.iter().zip(&affine.coriolis).map(|(h, c)| h * c).sum();
                let bound = Interval::new(bound.lower - held, bound.upper - held);
                (row.clone(), bound)
            });
        let rates = (0..affine.base_rate.len()).map(|i| {
            let coasting = affine.base_rate[i] + h * affine.drift[i];
            let bound = &limits.base_rate[i];
            let bound = Interval::new((bound.lower - coasting) / h, (bound.upper - coasting) / h);
            (affine.jacobian[i].clone(), bound)
        });
        torques.chain(rates).collect()
    }

    /// The state after `h` seconds of the accelerations `a`: joints exactly, the base by the
    /// classical Runge-Kutta method.
    fn advance(&mut self, state: &State, a: &[f64], h: f64) -> State {
        let joints = |t: f64| -> (Vec<f64>, Vec<f64>) {
            let mut q = state.q.clone();
            let mut dq = state.dq.clone();
            for j in 0..a.len() {
                q[j] += t * (dq[j] + 0.5 * t * a[j]);
                dq[j] += t * a[j];
            }
            (q, dq)
        };
        let mut eta = state.eta.clone();
        let rate = |t: f64, eta: &[f64], rates: &mut [f64]| {
            let (q, dq) = joints(t);
            rates.copy_from_slice(&self.instant.base_rate(eta, &q, &dq));
        };
        Rk4::new(eta.len()).step(rate, 0.0, h, &mut eta);
        let (q, dq) = joints(h);
        State { eta, q, dq }
    }
}

/// The first of `left` constant accelerations, `h` seconds each, of least sum of squares that cover
/// `way` from the rate `rate` to rest.
fn arrival(way: f64, rate: f64, left: usize, h: f64) -> f64 {
    if left <= 1 {
        return -rate / h;
    }
    let m = left as f64;
    // Σ aᵢ = A and Σ dᵢ aᵢ = D, dᵢ the steps' middles from the middle of what is left.
    let sum = -rate / h;
    let moment = (way - rate * m * h) / (h * h) - 0.5 * m * sum;
    sum / m + 6.0 * moment / (m * (m + 1.0))
}

/// Constant accelerations between equidistant states.
struct ConstantAccelerations {
    breakpoints: Vec<f64>,
    states: Vec<State>,
    accelerations: Vec<Vec<f64>>,
    /// Whether the monitor stopped the planner.
    stopped: bool,
}

impl ConstantAccelerations {
    fn new(problem: &Problem, h: f64) -> Self {
        let start = State {
            eta: problem.task.initial_base_attitude.clone(),
            q: problem.task.initial_joints.clone(),
            dq: problem.task.initial_rates.clone(),
        };
        Self {
            breakpoints: (0..=STEPS).map(|k| k as f64 * h).collect(),
            states: vec![start],
            accelerations: Vec::new(),
            stopped: false,
        }
    }

    fn last(&self) -> &State {
        &self.states[self.states.len() - 1]
    }

    fn push(&mut self, a: Vec<f64>, next: State) {
        self.accelerations.push(a);
        self.states.push(next);
    }
}

impl JointMotion for ConstantAccelerations {
    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    fn points(&self) -> usize {
        4
    }

    fn at(&self, piece: usize, t: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let t = t - self.breakpoints[piece];
        let (state, a) = (&self.states[piece], &self.accelerations[piece]);
        for j in 0..a.len() {
            q[j] = state.q[j] + t * (state.dq[j] + 0.5 * t * a[j]);
            dq[j] = state.dq[j] + t * a[j];
            ddq[j] = a[j];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_arrives_at_rest_in_any_number_of_steps() {
        for steps in 2..9 {
            let h = 0.3;
            let (mut q, mut rate) = (0.2, -0.4);
            let mut first = None;
            for left in (1..=steps).rev() {
                let a = arrival(1.0 - q, rate, left, h);
                first.get_or_insert(a);
                q += h * (rate + 0.5 * h * a);
                rate += h * a;
            }
            assert!(
                (q - 1.0).abs() < 1e-12 && rate.abs() < 1e-12,
                "{steps}: {q}, {rate}"
            );
            if steps == 2 {
                // Two unknowns, two conditions: 0.8 = 0.6·(−0.4) + 0.09·(1.5a + 0.5b), a + b = 4/3.
                let a: f64 = first.unwrap();
                assert!((a - ((1.04 / 0.09) - 2.0 / 3.0)).abs() < 1e-9, "{a}");
            }
        }
    }
}
