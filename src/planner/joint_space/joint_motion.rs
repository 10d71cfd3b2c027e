//! From a motion of the joints alone to a complete plan: the base follows by momentum.
//!
//! Derived in docs/algorithms.md#base-motion-along-a-joint-motion.

use crate::collocation::{Mesh, MeshError};
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::integrate::Rk4;
use crate::nlp::Iterate;
use crate::ocp::Interval;
use crate::planner::collocation::diagnosis::findings;
use crate::planner::words::sentence;
use crate::planner::{
    Diagnosis, LimitFinding, Method, Plan, PlanError, StartCounts, Status, Timing,
};
use crate::problem::{LimitId, Problem, ProblemError, Unit};
use crate::refine::{Errors, midpoint_errors};
use crate::system::{
    Component, FreeFloating, Trajectory, goal_errors_in, metrics, of_joint, settle, trajectory,
    tumbling_steps,
};
use crate::transcription::Discretization;
use std::time::Instant;

/// Joint positions, rates and accelerations as functions of time, smooth between breakpoints.
pub(super) trait JointMotion {
    /// Times at which an acceleration may jump, s; rising, the first 0, the last t_f.
    fn breakpoints(&self) -> &[f64];

    /// LGR points in a segment of the plan's mesh.
    fn points(&self) -> usize {
        8
    }

    /// Writes positions, rates and accelerations (length n each) at time `t` of the piece between
    /// breakpoints `piece` and `piece + 1`.
    fn at(&self, piece: usize, t: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]);
}

/// Distance from its goal at which a joint counts as there, rad or m.
pub(super) const THERE: f64 = 1e-6;

/// Segments that a motion without breakpoints has on its first mesh.
const SEGMENTS: f64 = 8.0;
/// Most halvings of a segment.
const HALVINGS: usize = 6;
/// Error (28) that segments are halved down to; nothing is solved here, so that accuracy is cheap.
const ERROR: f64 = 1e-9;
/// Steps of the base's integration along the whole motion; its error is of fourth order.
const STEPS: f64 = 2000.0;

/// Refuses tasks that are not from rest to rest between given joint positions.
pub(super) fn rest_to_rest(method: Method, problem: &Problem) -> Result<(), ProblemError> {
    let refused = |key: &str, found: &str, expected: &str| {
        Err(ProblemError {
            key: key.into(),
            found: found.into(),
            expected: format!("{expected}, for {} plans in joint space", method.name()),
        })
    };
    let task = &problem.task;
    if task.end_effector.is_some() {
        let expected = "a position for every joint in task.final.joints";
        return refused("task.final.end_effector", "a goal in task space", expected);
    }
    if task.initial_rates.iter().any(|rate| *rate != 0.0) {
        return refused("task.initial.rates", "joints that move", "joints at rest");
    }
    if !task.way_points.is_empty() {
        let expected = "no way-points";
        return refused("task.way_points", "way-points to pass", expected);
    }
    Ok(())
}

/// The duration such a planner takes: where it is free, the longest, which is the gentlest.
pub(super) fn duration(problem: &Problem) -> f64 {
    problem.task.duration.upper
}

/// The plan of `motion`: the base by momentum, controls by (7), on a mesh with its breakpoints.
///
/// It is solved where all limits of `problem` hold along it, those that the planner knows nothing
/// of included, and infeasible otherwise: the planner has no other motion to offer.
pub(super) fn assemble<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    method: Method,
    motion: &impl JointMotion,
    began: Instant,
) -> Result<Plan, PlanError> {
    let (discretization, errors) = on_fine_mesh(system, motion)?;
    let trajectory = trajectory(system, &discretization);
    let max_error = errors.max();
    let limits = findings(problem, system, &system.elastic_limits(), &discretization);
    let tolerance = problem.mesh.tolerance;
    let status = if !limits.is_empty() {
        Status::Infeasible
    } else if max_error <= tolerance {
        Status::Solved
    } else {
        Status::NotConverged
    };
    let verb = format!(
        "does not hold along the motion of {}, which needs",
        method.name()
    );
    let diagnosis = (status == Status::Infeasible).then(|| Diagnosis {
        converged: true,
        summary: sentence(&limits, |_, works| format!("{verb} {works}")),
        limits,
        starts: StartCounts {
            tried: 1,
            feasible: 0,
        },
    });
    let elapsed = began.elapsed();
    let cost_terms = system.cost_terms(&discretization);
    Ok(Plan {
        status,
        method,
        objective: cost_terms.total(),
        cost_terms,
        tolerance,
        max_error,
        iterations: Vec::new(),
        iterate: Iterate::default(),
        linear_solver: "none".into(),
        metrics: metrics(system, &discretization, &trajectory),
        goals: goal_errors_in(system, &discretization),
        trajectory,
        discretization,
        diagnosis,
        verification: None,
        warnings: Vec::new(),
        timing: Timing {
            setup: elapsed,
            total: elapsed,
            ..Timing::default()
        },
    })
}

/// Marks `plan` as infeasible where a joint ends further than `there` (rad or m) from its goal,
/// with the reason `why`.
pub(super) fn goal_missed(problem: &Problem, plan: &mut Plan, there: f64, why: String) {
    let joints = problem.robot.joints();
    let Some(reached) = plan.trajectory.joint_position.last() else {
        return;
    };
    let missed: Vec<LimitFinding> = (reached.iter().zip(&problem.task.final_joints).enumerate())
        .filter(|(_, (q, goal))| (*q - *goal).abs() > there)
        .map(|(j, (&q, &goal))| LimitFinding {
            limit: LimitId::FinalJoints,
            component: Component::Joint(j),
            name: of_joint("position", &joints[j]),
            unit: Unit::position(joints[j].kind),
            bound: Interval::fixed(goal),
            excess: (q - goal).abs(),
            smallest_bound: Interval::new(q.min(goal), q.max(goal)),
            floor: None,
        })
        .collect();
    if missed.is_empty() {
        return;
    }
    plan.status = Status::Infeasible;
    let diagnosis = plan.diagnosis.get_or_insert_with(Diagnosis::default);
    diagnosis.limits.splice(0..0, missed);
    let rest = if diagnosis.summary.is_empty() {
        String::new()
    } else {
        format!("; {}", diagnosis.summary)
    };
    diagnosis.summary = format!("{why}{rest}");
}

/// A part of the mesh: the piece of the motion it belongs to and its ends, s.
#[derive(Debug, Clone, Copy)]
struct Part {
    piece: usize,
    ends: [f64; 2],
    halvings: usize,
}

/// The motion on a mesh whose segments are halved until the error (28) is negligible.
fn on_fine_mesh<Sp: Space>(
    system: &FreeFloating<Sp>,
    motion: &impl JointMotion,
) -> Result<(Discretization, Errors), MeshError> {
    let breakpoints = motion.breakpoints();
    let duration = breakpoints[breakpoints.len() - 1];
    let mut parts = Vec::new();
    for (piece, ends) in breakpoints.windows(2).enumerate() {
        let count = ((ends[1] - ends[0]) / duration * SEGMENTS).ceil().max(1.0) as usize;
        let at = |k: usize| {
            if k == count {
                return ends[1];
            }
            ends[0] + (ends[1] - ends[0]) * k as f64 / count as f64
        };
        parts.extend((0..count).map(|k| Part {
            piece,
            ends: [at(k), at(k + 1)],
            halvings: 0,
        }));
    }
    let mut coarser = None;
    loop {
        let sampled = match (sample(system, motion, &parts, duration), coarser.take()) {
            // As fine as a mesh may be.
            (Err(MeshError::TooMany { .. }), Some(done)) => return Ok(done),
            (sampled, _) => sampled?,
        };
        let errors = midpoint_errors(system, &sampled);
        let mut finer = Vec::with_capacity(parts.len());
        for (s, &part) in parts.iter().enumerate() {
            if errors.worst(s).1 <= ERROR || part.halvings == HALVINGS {
                finer.push(part);
                continue;
            }
            let [a, b] = part.ends;
            for ends in [[a, 0.5 * (a + b)], [0.5 * (a + b), b]] {
                finer.push(Part {
                    ends,
                    halvings: part.halvings + 1,
                    ..part
                });
            }
        }
        if finer.len() == parts.len() {
            return Ok((sampled, errors));
        }
        coarser = Some((sampled, errors));
        parts = finer;
    }
}

fn sample<Sp: Space>(
    system: &FreeFloating<Sp>,
    motion: &impl JointMotion,
    parts: &[Part],
    duration: f64,
) -> Result<Discretization, MeshError> {
    let fractions = std::iter::once(0.0)
        .chain(parts.iter().map(|part| part.ends[1] / duration))
        .collect();
    let mesh = Mesh::new(fractions, &vec![motion.points(); parts.len()])?;
    let n = system.joint_count();
    let states = system.attitude().count() + 2 * n;
    let points = mesh.points();
    let mut follower = Follower::new(system, motion);
    let mut x = vec![0.0; (points + 1) * states];
    let mut u = vec![0.0; (points + 1) * n];
    let mut t = 0.0;
    for (s, part) in parts.iter().enumerate() {
        let nodes = mesh.rule(s).nodes();
        for (i, &tau) in nodes.iter().enumerate() {
            let [start, end] = part.ends;
            let now = if i + 1 == nodes.len() {
                end
            } else {
                start + 0.5 * (tau + 1.0) * (end - start)
            };
            follower.carry(part.piece, t, now);
            t = now;
            // The node that two segments share belongs to the later one.
            let k = mesh.start(s) + i;
            if i + 1 < nodes.len() || k == points {
                let row = &mut x[k * states..(k + 1) * states];
                follower.node(part.piece, t, row, &mut u[k * n..(k + 1) * n]);
            }
        }
    }
    u.truncate(points * n);
    Ok(system.with_peaks(Discretization {
        mesh,
        initial_time: 0.0,
        duration,
        parameters: Vec::new(),
        integrals: Vec::new(),
        states,
        controls: n,
        x,
        u,
    }))
}

/// Times looked at between two breakpoints.
const LOOKED_AT: usize = 40;

/// Times, joint positions and poses of the base along `motion`; all other columns stay empty.
pub(super) fn poses<Sp: Space>(system: &FreeFloating<Sp>, motion: &impl JointMotion) -> Trajectory {
    let mut follower = Follower::new(system, motion);
    let mut found = Trajectory {
        attitude: system.attitude().in_space(),
        ..Trajectory::default()
    };
    let mut t = 0.0;
    follower.pose(0, t, &mut found);
    for (piece, ends) in motion.breakpoints().windows(2).enumerate() {
        for k in 1..=LOOKED_AT {
            let next = ends[0] + (ends[1] - ends[0]) * k as f64 / LOOKED_AT as f64;
            follower.carry(piece, t, next);
            t = next;
            follower.pose(piece, t, &mut found);
        }
    }
    found
}

/// Carries the base along the joints' motion by the classical Runge-Kutta method.
struct Follower<'a, Sp: Space, M: JointMotion> {
    system: &'a FreeFloating<Sp>,
    motion: &'a M,
    data: Data<Sp, f64>,
    /// Longest step, s.
    step: f64,
    method: Rk4,
    eta: Vec<f64>,
    q: Vec<f64>,
    dq: Vec<f64>,
    ddq: Vec<f64>,
}

impl<'a, Sp: Space, M: JointMotion> Follower<'a, Sp, M> {
    fn new(system: &'a FreeFloating<Sp>, motion: &'a M) -> Self {
        let n = system.joint_count();
        let breakpoints = motion.breakpoints();
        let step = breakpoints[breakpoints.len() - 1] / STEPS;
        Self {
            system,
            motion,
            data: Data::new(system.tree()),
            step: step / tumbling_steps(system, step) as f64,
            method: Rk4::new(system.attitude().count()),
            eta: system.start_attitude().to_vec(),
            q: vec![0.0; n],
            dq: vec![0.0; n],
            ddq: vec![0.0; n],
        }
    }

    /// The base's attitude from `from` to `to`, s.
    fn carry(&mut self, piece: usize, from: f64, to: f64) {
        let steps = ((to - from) / self.step).ceil();
        let h = (to - from) / steps;
        let mut method = std::mem::take(&mut self.method);
        let mut eta = std::mem::take(&mut self.eta);
        let attitude = self.system.attitude();
        for step in 0..steps as usize {
            let rate = |t: f64, eta: &[f64], rates: &mut [f64]| self.rate(piece, t, eta, rates);
            let before = eta.clone();
            method.step(rate, from + step as f64 * h, h, &mut eta);
            settle::<Sp>(attitude, &before, &mut eta);
        }
        (self.method, self.eta) = (method, eta);
    }

    fn rate(&mut self, piece: usize, t: f64, eta: &[f64], rates: &mut [f64]) {
        self.motion
            .at(piece, t, &mut self.q, &mut self.dq, &mut self.ddq);
        let data = &mut self.data;
        self.system.tree().kinematics(&self.q, data);
        self.system.tree().momentum(data);
        self.system.base_rate(eta, &self.dq, data);
        let attitude = self.system.attitude();
        attitude.rates(eta, &data.base_rate, rates);
    }

    /// Adds the pose at `t`, where the base has been carried to.
    fn pose(&mut self, piece: usize, t: f64, found: &mut Trajectory) {
        self.motion
            .at(piece, t, &mut self.q, &mut self.dq, &mut self.ddq);
        self.system.tree().kinematics(&self.q, &mut self.data);
        self.system.tree().momentum(&mut self.data);
        let position = self.system.base_position(&self.eta, t, &self.data);
        found.t.push(t);
        found.base_attitude.push(self.eta.clone());
        found.base_position.push(position.components().to_vec());
        found.joint_position.push(self.q.clone());
    }

    /// States [η, θ, θ̇] at `t`, where the base has been carried to, and the controls
    /// u = θ̈ + H⁻¹Cθ̇.
    fn node(&mut self, piece: usize, t: f64, x: &mut [f64], u: &mut [f64]) {
        let eta = self.eta.clone();
        self.rate(piece, t, &eta, &mut vec![0.0; eta.len()]);
        let data = &mut self.data;
        let tree = self.system.tree();
        tree.mass_matrix(data);
        tree.bias(&self.dq, data);
        data.factors.factor(&data.mass_matrix);
        u.copy_from_slice(&data.bias);
        data.factors.solve(u);
        for (value, acceleration) in u.iter_mut().zip(&self.ddq) {
            *value += acceleration;
        }
        let (attitude, joints) = x.split_at_mut(eta.len());
        let (q, dq) = joints.split_at_mut(self.q.len());
        attitude.copy_from_slice(&eta);
        q.copy_from_slice(&self.q);
        dq.copy_from_slice(&self.dq);
    }
}
