//! Random tasks as people bring them, planned to the tolerance: arms of two to nine joints in the plane
//! and in space, every kind of goal, limit and cost.
//!
//! `make random-plans` plans many: as many as `FFSM_RANDOM_PLANS` says, from the seed
//! `FFSM_RANDOM_FROM` on, by the law that `FFSM_RANDOM_LAW` names.

mod trees;

use fastrand::Rng;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::{
    EndEffectorGoal, GoalFrame, KeepOut, Moment, Problem, ProblemBuilder, Solid, WayPoint,
};
use ffsm_ipopt::refine::Law;
use ffsm_ipopt::system::impossible;
use std::time::{Duration, Instant};
use trees::{PRISMATIC, REVOLUTE, uniform, values};

/// What each plan may take.
const LIMIT: Duration = Duration::from_secs(20);

/// An arm and what the tasks are made of.
struct Arm {
    robot: Model,
    axes: Vec<Vector3<f64>>,
    lengths: Vec<f64>,
    /// Half the edge of the spacecraft, a cube.
    half: f64,
    planar: bool,
}

/// Links of steel tube on a spacecraft: one after another along x, turning about z in the plane, about
/// all axes in space; the last joint but one slides now and then.
fn arm(rng: &mut Rng) -> Arm {
    let n = rng.usize(2..=9);
    let planar = rng.u8(..3) == 0;
    let slides = rng.u8(..8) == 0;
    let mass = 50.0 * 30_f64.powf(rng.f64());
    let edge = (mass / 300.0).cbrt();
    let cube = Matrix3::identity() * (mass * edge * edge / 6.0);
    let base = Body {
        name: "spacecraft".into(),
        inertia: Inertia::new(mass, Vector3::zeros(), cube).unwrap(),
    };
    let reach = edge * (1.0 + 2.0 * rng.f64());
    let (mut axes, mut lengths, mut joints) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..n {
        let length = reach / n as f64 * (0.5 + rng.f64());
        let kind = match slides && j + 2 == n {
            true => PRISMATIC,
            false => REVOLUTE,
        };
        let axis = match (kind, planar) {
            (JointKind::Prismatic, _) => Vector3::x(),
            (_, true) => Vector3::z(),
            _ => [Vector3::z(), Vector3::y(), Vector3::x()][rng.usize(..3)],
        };
        let link = 0.1 * mass / n as f64 * (0.2 + rng.f64());
        // A tube of a tenth of its length across.
        let across = link * (0.05 * length).powi(2);
        let along = link * length * length / 12.0 + 0.5 * across;
        let moments = Vector3::new(across, along, along);
        let before = lengths.last().copied().unwrap_or(0.5 * edge);
        joints.push(Joint {
            name: format!("joint{j}"),
            kind,
            parent: j.checked_sub(1),
            placement: Placement::from_xyz_rpy([before, 0.0, 0.0], [0.0; 3]),
            axis: Unit::new_normalize(axis),
            limits: JointLimits::NONE,
            body: Body {
                name: format!("link{j}"),
                inertia: Inertia::new(
                    link,
                    Vector3::new(0.5 * length, 0.0, 0.0),
                    Matrix3::from_diagonal(&moments),
                )
                .unwrap(),
            },
        });
        axes.push(axis);
        lengths.push(length);
    }
    let tip = Placement::from_xyz_rpy([lengths[n - 1], 0.0, 0.0], [0.0; 3]);
    let robot = Model::new("random", base, joints).unwrap();
    Arm {
        robot: robot.with_end_effector(Some(n - 1), tip),
        axes,
        lengths,
        half: 0.5 * edge,
        planar,
    }
}

impl Arm {
    /// Where the end effector is in the base frame.
    fn tip(&self, q: &[f64]) -> Vector3<f64> {
        let mut turned = Rotation3::identity();
        let mut at = Vector3::new(self.half, 0.0, 0.0);
        for (j, joint) in self.robot.joints().iter().enumerate() {
            let axis = Unit::new_normalize(self.axes[j]);
            match joint.kind {
                JointKind::Prismatic => at += turned * self.axes[j] * q[j],
                _ => turned *= Rotation3::from_axis_angle(&axis, q[j]),
            }
            at += turned * Vector3::new(self.lengths[j], 0.0, 0.0);
        }
        at
    }

    /// Joint positions; a sliding joint's are a tenth of those of the others.
    fn posture(&self, rng: &mut Rng, size: f64) -> Vec<f64> {
        let joints = self.robot.joints().iter();
        let of = |joint: &Joint| match joint.kind {
            JointKind::Prismatic => 0.1 * size * uniform(rng),
            _ => size * uniform(rng),
        };
        joints.map(of).collect()
    }
}

/// Whether one of `of` times.
fn one_in(rng: &mut Rng, of: u8) -> bool {
    rng.u8(..of) == 0
}

/// Between two numbers, evenly in their logarithm.
fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(rng.f64())
}

/// A task; `None` where it cannot be carried out, whatever the motion, or where nothing bounds or weighs
/// the control: no trajectory attains the least cost then, since rates may jump.
fn task(seed: u64) -> Option<Problem> {
    let rng = &mut Rng::with_seed(seed);
    let arm = arm(rng);
    let (start, goal) = (arm.posture(rng, 1.0), arm.posture(rng, 1.5));
    let duration = 15.0 + 25.0 * rng.f64();
    let mut problem = Problem::builder("random", arm.robot.clone(), duration, &start, &goal);
    if !arm.planar {
        let all = [
            SpatialAttitude::RollPitchYaw,
            SpatialAttitude::Quaternion,
            SpatialAttitude::Mrp,
        ];
        problem.set_attitude(all[rng.usize(..3)]);
    }
    add_goals(rng, &arm, &mut problem);
    add_limits(rng, &arm, &mut problem);
    add_costs(rng, &mut problem);
    problem.solver.time_limit = Some(LIMIT);
    let problem = problem
        .build()
        .unwrap_or_else(|error| panic!("{seed}: {error}"));
    (has_a_least(&problem) && impossible(&problem).is_empty()).then_some(problem)
}

/// Whether the control of every joint is bounded or costs something.
fn has_a_least(problem: &Problem) -> bool {
    let (limits, cost) = (&problem.limits, &problem.cost);
    (0..problem.robot.joint_count()).all(|j| {
        let bounded = [limits.control[j], limits.torque[j]].map(|range| range.upper.is_finite());
        bounded.contains(&true) || cost.control[j] + cost.torque[j] > 0.0
    })
}

fn add_goals(rng: &mut Rng, arm: &Arm, problem: &mut ProblemBuilder) {
    let task = &mut problem.task;
    if one_in(rng, 4) {
        let lengths = if arm.planar { 2 } else { 3 };
        let tip = arm.tip(&task.final_joints);
        let frame = [GoalFrame::Start, GoalFrame::Base][rng.usize(..2)];
        task.end_effector = Some(EndEffectorGoal::at(frame, &tip.as_slice()[..lengths]));
        task.free_joints.fill(true);
    }
    if one_in(rng, 6) {
        let joints = arm.posture(rng, 1.2);
        let at = Moment::Fraction(0.3 + 0.4 * rng.f64());
        task.way_points = vec![WayPoint::joints(at, &joints)];
    }
    if one_in(rng, 5) {
        let duration = task.duration.center();
        task.duration = Interval::new(0.5 * duration, 2.0 * duration);
        problem.cost.duration = between(rng, 1e-3, 0.1);
    }
    if one_in(rng, 8) {
        let size = 1e-3 * arm.robot.base().inertia.mass();
        let angular = &mut problem.task.initial_momentum.angular;
        *angular = values(rng, angular.len(), size * arm.half);
    }
}

fn add_limits(rng: &mut Rng, arm: &Arm, problem: &mut ProblemBuilder) {
    let n = arm.lengths.len();
    let (_, angles) = problem.attitude_sizes();
    let limits = &mut problem.limits;
    let mut all = |count: usize, low: f64, high: f64| {
        vec![Interval::symmetric(between(rng, low, high)); count]
    };
    let (velocity, control, torque) = (all(n, 0.15, 0.6), all(n, 0.05, 1.0), all(n, 0.5, 50.0));
    let (attitude, last) = (all(angles, 0.02, 0.5), all(angles, 2e-3, 0.1));
    let rate = all(limits.base_rate.len(), 0.01, 0.2);
    let moved = all(limits.base_position.len(), 0.02, 0.5);
    if rng.bool() {
        limits.joint_velocity = velocity;
    }
    if rng.bool() {
        limits.control = control;
    }
    if one_in(rng, 5) {
        limits.torque = torque;
    }
    if one_in(rng, 5) {
        limits.base_attitude = attitude;
    }
    if one_in(rng, 6) {
        limits.final_base_attitude = last;
    }
    if one_in(rng, 4) {
        limits.base_rate = rate;
    }
    if one_in(rng, 8) {
        limits.base_position = moved;
    }
    if one_in(rng, 5) {
        limits.keep_out = vec![KeepOut {
            name: "hand off the spacecraft".into(),
            first: Solid::sphere(Some(n - 1), [arm.lengths[n - 1], 0.0, 0.0], 0.05),
            second: Solid::cuboid(None, [0.0; 3], [arm.half; 3]),
        }];
    }
}

fn add_costs(rng: &mut Rng, problem: &mut ProblemBuilder) {
    let cost = &mut problem.cost;
    cost.final_base_attitude
        .fill([0.0, 1.0, 100.0][rng.usize(..3)]);
    cost.final_base_position.fill([0.0, 1.0][rng.usize(..2)]);
    cost.base_rate.fill([0.0, 0.6, 20.0][rng.usize(..3)]);
    cost.joint_rate.fill(between(rng, 0.05, 0.5));
    cost.control.fill([0.0, 0.1, 1.0][rng.usize(..3)]);
    if one_in(rng, 6) {
        cost.base_attitude.fill(between(rng, 0.1, 10.0));
    }
    if one_in(rng, 6) {
        cost.peak_base_attitude.fill(between(rng, 0.1, 10.0));
    }
    if one_in(rng, 8) {
        cost.torque.fill(between(rng, 1e-4, 1e-2));
    }
}

/// How many ended how.
#[derive(Debug, Default)]
struct Tally {
    solved: usize,
    infeasible: usize,
    /// Neither, by seed.
    neither: Vec<u64>,
}

/// Plans `count` tasks that are not refused, from `seed` on.
fn planned(seed: u64, count: usize) -> Tally {
    let mut tally = Tally::default();
    let tasks = (seed..).filter_map(|seed| Some((seed, task(seed)?)));
    let law = std::env::var("FFSM_RANDOM_LAW").ok();
    let law = law.and_then(|name| Law::ALL.into_iter().find(|law| law.name() == name));
    for (seed, problem) in tasks.take(count) {
        let problem = problem
            .edited(|problem| problem.mesh.law = law.unwrap_or_default())
            .unwrap();
        let began = Instant::now();
        let plan = plan(&problem).unwrap_or_else(|error| panic!("{seed}: {error}"));
        let seconds = began.elapsed().as_secs_f64();
        check(seed, &plan);
        match plan.status {
            Status::Solved => tally.solved += 1,
            Status::Infeasible => tally.infeasible += 1,
            _ => {
                tally.neither.push(seed);
                print_meshes(&problem, &plan);
            }
        }
        println!(
            "{seed}: {} joints, {:?}, {} meshes, {} points, error {:.1e}, J {:.6}, {seconds:.1} s; {}",
            problem.robot.joint_count(),
            plan.status,
            plan.iterations.len(),
            plan.discretization.mesh.points(),
            plan.max_error,
            plan.objective,
            plan.diagnosis
                .map_or_else(|| plan.warnings.join("; "), |found| found.summary),
        );
    }
    tally
}

/// Limits, cost and meshes of what ended neither way.
fn print_meshes(problem: &Problem, plan: &Plan) {
    println!(
        "{:?}\n{:?}\n{:?}",
        problem.task, problem.limits, problem.cost
    );
    for record in &plan.iterations {
        println!(
            "  {} segments, {} points: {:?}, {} iterations, error {:.1e}, J {:.6}, {:.1} s",
            record.segments,
            record.points,
            record.nlp_status,
            record.nlp_iterations,
            record.max_error,
            record.objective,
            record.time.as_secs_f64(),
        );
    }
}

/// What holds of a plan whatever its status.
fn check(seed: u64, plan: &Plan) {
    assert!(plan.objective.is_finite(), "{seed}");
    if plan.status == Status::Solved {
        assert!(plan.max_error <= plan.tolerance, "{seed}");
        assert!(plan.diagnosis.is_none(), "{seed}");
    }
}

#[test]
fn a_few_random_tasks_are_planned() {
    let tally = planned(0, 8);
    assert!(tally.solved >= 5, "{tally:?}");
}

#[test]
#[ignore = "many minutes"]
fn many_random_tasks_are_planned() {
    let number = |name: &str, default: usize| {
        std::env::var(name).map_or(default, |text| text.parse().unwrap())
    };
    let count = number("FFSM_RANDOM_PLANS", 200);
    let tally = planned(number("FFSM_RANDOM_FROM", 1000) as u64, count);
    println!("{tally:?}");
    let answered = tally.solved + tally.infeasible;
    assert!(answered as f64 >= 0.99 * count as f64, "{tally:?}");
}
