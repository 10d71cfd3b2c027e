//! The reaction null-space planner: joint motions that leave the base's attitude where it is.
//!
//! Without angular momentum the base's rate is −I₀⁻¹Gθ̇; rates in the null space of G do not turn
//! it (D. N. Nenchev, Y. Umetani, K. Yoshida, IEEE Transactions on Robotics and Automation 8(1),
//! 1992). Such motions exist where there are more joints than angles of the base, and they reach
//! what can be reached by them: the path here follows the goal-directed direction projected into
//! the null space, dθ/ds ∝ P(θ)(θ_goal − θ), until nothing is left of it. Where the null space
//! has one dimension there is no choice but the line through the start, and the path goes to its
//! point nearest to the goal. The time law of every smooth leg is quintic.
//!
//! Derived in docs/algorithms.md#reaction-null-space.

mod coupling;
mod path;
mod search;

use super::joint_motion::{JointMotion, THERE, assemble, duration, goal_missed, rest_to_rest};
use crate::autodiff::Dual;
use crate::dynamics::space::Space;
use crate::dynamics::{Data, JointKind, Tree};
use crate::planner::{Method, Plan, PlanError};
use crate::problem::{Problem, ProblemError};
use crate::system::{FreeFloating, System, quintic, with_system};
use crate::text::digits::digits;
use path::{Leg, distance};
use search::{End, Search};
use std::cell::RefCell;
use std::time::Instant;

/// Plans `problem`'s task with the base's attitude held.
///
/// A goal that cannot be reached so makes the plan infeasible; its motion goes as near as it can,
/// and its diagnosis says why no further.
///
/// # Errors
/// [`PlanError`] for a task that is not from rest to rest in joint space, or a system that has
/// angular momentum and so turns whatever the joints do.
pub(in crate::planner) fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    let began = Instant::now();
    rest_to_rest(Method::ReactionNullSpace, problem)?;
    if problem
        .task
        .initial_momentum
        .angular
        .iter()
        .any(|l| *l != 0.0)
    {
        return Err(PlanError::Problem(ProblemError {
            key: "task.initial.angular_momentum".into(),
            found: "a system that turns".into(),
            expected: "no angular momentum, for reaction-null-space holds the base by joint rates \
                       without any"
                .into(),
        }));
    }
    with_system!(&System::new(problem), system => run(problem, system, began))
}

fn run<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    began: Instant,
) -> Result<Plan, PlanError> {
    let task = &problem.task;
    let tree = system.tree();
    let mut search = Search::new(tree, &problem.limits.joint_position, &task.final_joints);
    let (legs, end) = search.run(&task.initial_joints);
    let motion = Motion::new(legs, task.initial_joints.clone(), duration(problem), tree);
    let method = Method::ReactionNullSpace;
    let mut plan = assemble(problem, system, method, &motion, began)?;
    if end == End::Goal {
        return Ok(plan);
    }
    let reached = plan
        .trajectory
        .joint_position
        .last()
        .cloned()
        .unwrap_or_default();
    let why = explanation::<Sp>(problem, &end, &reached);
    goal_missed(problem, &mut plan, THERE, why);
    Ok(plan)
}

/// Why the goal is not reached, for a person.
fn explanation<Sp: Space>(problem: &Problem, end: &End, reached: &[f64]) -> String {
    let goal = &problem.task.final_joints;
    let n = goal.len();
    let all_turn = problem
        .robot
        .joints()
        .iter()
        .all(|j| j.kind == JointKind::Revolute);
    let (factor, unit) = if all_turn {
        (1f64.to_degrees(), "°")
    } else {
        (1.0, " rad or m")
    };
    let shown = |q: &[f64]| {
        let values: Vec<String> = q.iter().map(|v| digits(factor * v, 1, 2)).collect();
        format!("({}){unit}", values.join(", "))
    };
    let away = format!("{}{unit}", digits(factor * distance(reached, goal), 2, 2));
    let angles = match Sp::ANGLES {
        1 => "the one angle of the base".to_string(),
        count => format!("the {count} angles of the base"),
    };
    match end {
        End::Goal => String::new(),
        End::NoNullSpace => format!(
            "there is no reaction null space: {n} joints less {angles} leave no joint motion that \
             does not turn the base"
        ),
        End::Line([a, b]) => format!(
            "the reaction null space does not lead to the goal: {n} joints less {angles} leave one \
             joint rate, hence a single joint path through the start along which the base does not \
             turn; between {} and {} it comes no nearer to the goal than {away}, at {}",
            shown(a),
            shown(b),
            shown(reached)
        ),
        End::Stalled => {
            let left: Vec<f64> = goal.iter().zip(reached).map(|(g, q)| g - q).collect();
            format!(
                "the reaction null space does not lead straight to the goal: {away} from it, at \
                 {}, the way that is left, {}, lies across the null space and would turn the base",
                shown(reached),
                shown(&left)
            )
        }
    }
}

/// The legs with their times: each as much of the duration as its part of the length, at rest in
/// between.
struct Motion<'a, Sp: Space> {
    legs: Vec<Leg<'a, Sp>>,
    start: Vec<f64>,
    breakpoints: Vec<f64>,
    scratch: RefCell<(Data<Sp, f64>, Data<Sp, Dual<1>>)>,
}

impl<'a, Sp: Space> Motion<'a, Sp> {
    fn new(legs: Vec<Leg<'a, Sp>>, start: Vec<f64>, duration: f64, tree: &Tree<Sp>) -> Self {
        let total: f64 = legs.iter().map(|leg| leg.length).sum();
        let mut breakpoints = vec![0.0];
        let mut length = 0.0;
        for leg in &legs {
            length += leg.length;
            breakpoints.push(duration * length / total);
        }
        if legs.is_empty() {
            breakpoints.push(duration);
        }
        let last = breakpoints.len() - 1;
        breakpoints[last] = duration;
        Self {
            legs,
            start,
            breakpoints,
            scratch: RefCell::new((Data::new(tree), Data::new(tree))),
        }
    }
}

impl<Sp: Space> JointMotion for Motion<'_, Sp> {
    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    fn at(&self, piece: usize, t: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let Some(leg) = self.legs.get(piece) else {
            q.copy_from_slice(&self.start);
            dq.fill(0.0);
            ddq.fill(0.0);
            return;
        };
        let [from, to] = [self.breakpoints[piece], self.breakpoints[piece + 1]];
        let [share, rate, acceleration] = quintic(t - from, to - from);
        let [s, ds, dds] = [share, rate, acceleration].map(|part| part * leg.length);
        let (plain, dual) = &mut *self.scratch.borrow_mut();
        let (at, field) = leg.at(s, plain);
        let (tangent, bend) = field.curvature(&at, dual);
        q.copy_from_slice(&at);
        for j in 0..q.len() {
            dq[j] = tangent[j] * ds;
            ddq[j] = tangent[j] * dds + bend[j] * ds * ds;
        }
    }
}
