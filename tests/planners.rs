//! The planners that A-RPM is compared with: known profiles, and what each promises.

mod problems;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Event, Method, Plan, PlanError, Planner, Status};
use ffsm_ipopt::problem::{CostId, Problem};
use ffsm_ipopt::refine;
use ffsm_ipopt::system::{Side, cost_terms, straight_line};
use ffsm_ipopt::verify::verify;

fn plan(method: Method, problem: &Problem) -> Plan {
    try_plan(method, problem).unwrap()
}

fn try_plan(method: Method, problem: &Problem) -> Result<Plan, PlanError> {
    Planner::new().plan_by(method, problem, None, &mut |_| Control::Continue)
}

fn shipped(name: &str) -> Problem {
    let path = format!("config/{name}.toml");
    let file = ProblemFile::load(path.as_ref(), &Overrides::default()).unwrap();
    file.problem
}

/// Largest acceleration of joint `j`: the slope of the planned rates at every node.
fn peak_acceleration(plan: &Plan, problem: &Problem, j: usize) -> f64 {
    let d = &plan.discretization;
    let first_rate = d.states - problem.robot.joint_count();
    let mut slope = vec![0.0; d.states];
    let mut peak: f64 = 0.0;
    for s in 0..d.mesh.segments() {
        for tau in d.mesh.rule(s).nodes() {
            d.state_derivative_in(s, *tau, &mut slope);
            let seconds = 0.5 * d.mesh.width(s) * d.duration;
            peak = peak.max((slope[first_rate + j] / seconds).abs());
        }
    }
    peak
}

fn ends_at_goal(plan: &Plan, problem: &Problem) -> bool {
    let last = plan.trajectory.joint_position.last().unwrap();
    let at = last.iter().zip(&problem.task.final_joints);
    let rest = plan.trajectory.joint_velocity.last().unwrap();
    at.into_iter().all(|(q, goal)| (q - goal).abs() < 1e-6)
        && rest.iter().all(|rate| rate.abs() < 1e-9)
}

#[test]
fn matpm_accelerates_by_four_times_the_way_over_the_time_squared() {
    let problem = problems::relaxed();
    let plan = plan(Method::Matpm, &problem);
    assert_eq!(plan.status, Status::Solved);
    assert!(ends_at_goal(&plan, &problem));
    for (j, way) in problem.task.final_joints.iter().enumerate() {
        let peak = peak_acceleration(&plan, &problem, j);
        assert!((peak - 4.0 * way / 400.0).abs() < 1e-9, "joint {j}: {peak}");
    }
    // The straight joint path, whatever its timing.
    let degrees = plan.trajectory.base_attitude.last().unwrap()[0].to_degrees();
    assert!((degrees + 36.64882).abs() < 1e-5, "{degrees}");
    assert!(plan.discretization.mesh.breakpoints().contains(&0.5));
    let drift = verify(&problem, &plan.discretization).unwrap();
    assert!(drift.max_base_attitude_drift < 1e-9, "{drift:?}");
    assert!(drift.max_joint_drift < 1e-9, "{drift:?}");
}

#[test]
fn matpm_cruises_where_the_rate_limit_binds() {
    let problem = problems::relaxed()
        .edited(|problem| {
            // The elbow would reach 2·(π/3)/20 = 0.1047 rad/s, the shoulder half of it.
            problem.limits.joint_velocity = vec![Interval::symmetric(0.08); 2];
        })
        .unwrap();
    let plan = plan(Method::Matpm, &problem);
    assert_eq!(plan.status, Status::Solved);
    assert!(ends_at_goal(&plan, &problem));
    let [shoulder, elbow] = [0, 1].map(|j| peak_acceleration(&plan, &problem, j));
    let [a, b] = [problem.task.final_joints[0], problem.task.final_joints[1]];
    assert!((shoulder - 4.0 * a / 400.0).abs() < 1e-9, "{shoulder}");
    assert!(
        (elbow - 0.08 * 0.08 / (0.08 * 20.0 - b)).abs() < 1e-9,
        "{elbow}"
    );
    let fastest = plan.trajectory.joint_velocity.iter().map(|row| row[1]);
    assert!((fastest.fold(0.0, f64::max) - 0.08).abs() < 1e-12);
    let degrees = plan.trajectory.base_attitude.last().unwrap()[0].to_degrees();
    // No longer the straight path, and so another angle.
    assert!((degrees + 36.64882).abs() > 1e-3, "{degrees}");
}

#[test]
fn matpm_says_which_joint_is_too_slow() {
    let problem = problems::relaxed()
        .edited(|problem| problem.limits.joint_velocity = vec![Interval::symmetric(0.05); 2])
        .unwrap();
    let plan = plan(Method::Matpm, &problem);
    assert_eq!(plan.status, Status::Infeasible);
    let diagnosis = plan.diagnosis.unwrap();
    assert!(
        diagnosis
            .summary
            .contains("joint 'joint2' cannot be there in 20 s")
    );
    let elbow = diagnosis
        .limits
        .iter()
        .find(|l| l.name == "rate of joint joint2");
    let needed = problem.task.final_joints[1] / 20.0;
    assert!((elbow.unwrap().smallest_bound.upper - needed).abs() < 1e-12);
}

#[test]
fn limits_a_planner_knows_nothing_of_are_still_held_against_it() {
    let problem = problems::published();
    for method in [Method::Matpm, Method::StraightLine, Method::AccelerationQp] {
        let plan = plan(method, &problem);
        assert_eq!(plan.status, Status::Infeasible, "{}", method.name());
        let found = plan.diagnosis.unwrap();
        let keys: Vec<_> = found.limits.iter().map(|l| l.limit.key()).collect();
        assert!(
            keys.iter().any(|key| key == "limits.base_attitude"),
            "{keys:?}"
        );
        assert!(found.summary.contains(method.name()), "{}", found.summary);
    }
}

#[test]
fn straight_line_moves_on_the_straight_path_with_no_jerk_at_the_ends() {
    let problem = shipped("chaser-7dof");
    let plan = plan(Method::StraightLine, &problem);
    assert_eq!(plan.status, Status::Solved);
    assert!(ends_at_goal(&plan, &problem));
    let expected = straight_line(&problem).base_attitude;
    for (found, expected) in plan
        .trajectory
        .base_attitude
        .last()
        .unwrap()
        .iter()
        .zip(expected)
    {
        assert!((found - expected).abs() < 1e-9);
    }
    let fastest = plan.metrics.peak_joint_velocity;
    let longest = 60f64.to_radians();
    assert!((fastest - 1.875 * longest / 30.0).abs() < 1e-3, "{fastest}");
    let [first, last] = [
        &plan.trajectory.control[0],
        plan.trajectory.control.last().unwrap(),
    ];
    assert!(
        first.iter().chain(last).all(|u| u.abs() < 1e-6),
        "{first:?} {last:?}"
    );
}

#[test]
fn reaction_null_space_holds_the_base_on_a_redundant_arm() {
    for name in ["planar-3link", "chaser-7dof"] {
        let problem = shipped(name);
        let plan = plan(Method::ReactionNullSpace, &problem);
        assert!(
            plan.metrics.max_base_attitude < 1e-8,
            "{name}: {:?}",
            plan.metrics
        );
        // Also as the full equations of motion have it.
        let drift = verify(&problem, &plan.discretization).unwrap();
        assert!(drift.max_base_attitude_drift < 1e-8, "{name}: {drift:?}");
        assert!(drift.replay_base_attitude_drift < 1e-8, "{name}: {drift:?}");
        // It has moved, towards the goal, and says why it stops.
        let last = plan.trajectory.joint_position.last().unwrap();
        let away = |q: &[f64]| -> f64 {
            let squares = q
                .iter()
                .zip(&problem.task.final_joints)
                .map(|(q, g)| (q - g).powi(2));
            squares.sum::<f64>().sqrt()
        };
        assert!(
            away(last) < 0.95 * away(&problem.task.initial_joints),
            "{name}"
        );
        assert_eq!(plan.status, Status::Infeasible);
        let diagnosis = plan.diagnosis.unwrap();
        assert!(
            diagnosis.summary.contains("lies across the null space"),
            "{}",
            diagnosis.summary
        );
        assert!(
            diagnosis
                .limits
                .iter()
                .any(|l| l.limit.key() == "task.final.joints")
        );
    }
}

#[test]
fn reaction_null_space_of_two_links_is_a_line_that_misses_the_goal() {
    let problem = problems::relaxed();
    let missed = plan(Method::ReactionNullSpace, &problem);
    assert_eq!(missed.status, Status::Infeasible);
    let summary = missed.diagnosis.unwrap().summary;
    for part in [
        "one joint rate",
        "single joint path",
        "no nearer to the goal than 47.1",
    ] {
        assert!(summary.contains(part), "{summary}");
    }
    // A goal on that line is reached, and with the base at rest.
    let problem = problem
        .edited(|problem| {
            problem.task.final_joints = missed.trajectory.joint_position.last().unwrap().clone()
        })
        .unwrap();
    let reached = plan(Method::ReactionNullSpace, &problem);
    assert_eq!(reached.status, Status::Solved);
    assert!(ends_at_goal(&reached, &problem));
    assert!(reached.metrics.max_base_attitude < 1e-8);
}

#[test]
fn reaction_null_space_needs_more_joints_than_angles() {
    // The same robot in space: three angles, two joints about one axis.
    let robot = problems::two_link().in_space();
    let spatial = Problem::builder("space", robot, 20.0, &[0.0; 2], &[0.5, 1.0]);
    let spatial = spatial.build().unwrap();
    // All motion is about z, so that one row of three counts and the line is still there.
    let planar = plan(Method::ReactionNullSpace, &spatial);
    assert!(
        planar
            .diagnosis
            .unwrap()
            .summary
            .contains("single joint path")
    );

    let chaser = shipped("chaser-7dof");
    let joints = chaser.robot.joints()[..3].to_vec();
    let base = chaser.robot.base().clone();
    let robot = Model::new("three", base, joints).unwrap();
    let three = Problem::builder("three", robot, 20.0, &[0.1, 0.2, 0.3], &[0.5; 3]);
    let three = three.build().unwrap();
    let plan = plan(Method::ReactionNullSpace, &three);
    assert_eq!(plan.status, Status::Infeasible);
    assert_eq!(plan.metrics.peak_joint_velocity, 0.0);
    assert!(
        plan.diagnosis
            .unwrap()
            .summary
            .starts_with("there is no reaction null space")
    );
}

#[test]
fn reaction_null_space_stays_within_joint_limits() {
    let problem = shipped("planar-3link")
        .edited(|problem| problem.limits.joint_position[1] = Interval::new(0.5, 1.6))
        .unwrap();
    let plan = plan(Method::ReactionNullSpace, &problem);
    let elbow = plan.trajectory.joint_position.iter().map(|row| row[1]);
    let lowest = elbow.fold(f64::INFINITY, f64::min);
    // It would go on to 5.6°, and is held at the limit while the others move on.
    assert!((lowest - 0.5).abs() < 1e-8, "{lowest}");
    assert!(plan.metrics.max_base_attitude < 1e-8);
    assert!(plan.discretization.mesh.segments() > 8);
}

#[test]
fn acceleration_qp_reaches_the_goal_within_the_limits() {
    let problem = shipped("planar-3link")
        .edited(|problem| {
            problem.limits.control = vec![Interval::symmetric(0.02); 3];
            problem.limits.joint_velocity = vec![Interval::symmetric(0.06); 3];
        })
        .unwrap();
    let qp = plan(Method::AccelerationQp, &problem);
    assert_eq!(qp.status, Status::Solved, "{:?}", qp.diagnosis);
    let last = qp.trajectory.joint_position.last().unwrap();
    for (q, goal) in last.iter().zip(&problem.task.final_joints) {
        assert!((q - goal).abs() < 1e-9, "{q} {goal}");
    }
    assert!(qp.metrics.peak_joint_velocity <= 0.06 + 1e-9);
    let drift = verify(&problem, &qp.discretization).unwrap();
    assert!(drift.max_base_attitude_drift < 1e-8, "{drift:?}");
    // A weight on the base holds it still for longer.
    let turned_half_way = |weight: f64| {
        let problem = shipped("planar-3link")
            .edited(|problem| problem.cost.base_rate = vec![weight])
            .unwrap();
        let plan = plan(Method::AccelerationQp, &problem);
        let (mut x, mut u) = (vec![0.0; 7], vec![0.0; 3]);
        plan.discretization.at_fraction(0.5, &mut x, &mut u);
        x[0].abs()
    };
    let [light, heavy] = [0.01, 10.0].map(turned_half_way);
    assert!(heavy < 0.7 * light, "{light} {heavy}");
}

#[test]
fn base_rate_moves_the_base_less_than_any_other() {
    let problem = problems::smooth();
    let motion = |method| {
        let plan = plan(method, &problem);
        let unit = problem
            .edited(|unit| unit.cost.base_rate = vec![1.0])
            .unwrap();
        cost_terms(&unit, &plan.discretization).of(CostId::BaseRate)
    };
    let least = motion(Method::BaseRate);
    for method in Method::ALL
        .into_iter()
        .filter(|m| *m != Method::ReactionNullSpace)
    {
        assert!(motion(method) >= least * (1.0 - 1e-9), "{}", method.name());
    }
    let least_plan = plan(Method::BaseRate, &problem);
    assert_eq!(
        (least_plan.status, least_plan.method),
        (Status::Solved, Method::BaseRate)
    );
}

#[test]
fn cost_terms_add_up_to_the_objective() {
    let problem = problems::smooth()
        .edited(|problem| {
            problem.cost.torque = vec![0.3; 2];
            problem.cost.rate_matrix = Some(vec![
                vec![0.2, 0.05, 0.0],
                vec![0.05, 0.1, 0.0],
                vec![0.0, 0.0, 0.1],
            ]);
        })
        .unwrap();
    let plan = ffsm_ipopt::planner::plan(&problem).unwrap();
    let terms = cost_terms(&problem, &plan.discretization);
    assert!(
        (terms.total() - plan.objective).abs() < 1e-12,
        "{terms:?} {}",
        plan.objective
    );
    let blocks = terms.terms.iter().filter(|t| t.id == CostId::RateMatrix);
    let sides: Vec<Side> = blocks.filter(|t| t.value != 0.0).map(|t| t.side).collect();
    assert_eq!(sides, [Side::Base, Side::Joints, Side::Both]);
}

#[test]
fn tasks_that_are_not_in_joint_space_are_refused_by_their_key() {
    let capture = shipped("capture");
    let moving = problems::relaxed()
        .edited(|moving| moving.task.initial_rates[0] = 0.1)
        .unwrap();
    let tumbling = problems::relaxed()
        .edited(|tumbling| tumbling.task.initial_momentum.angular[0] = 0.1)
        .unwrap();
    for (method, problem, key) in [
        (Method::Matpm, &capture, "task.final.end_effector"),
        (Method::AccelerationQp, &capture, "task.final.end_effector"),
        (Method::StraightLine, &moving, "task.initial.rates"),
        (
            Method::ReactionNullSpace,
            &tumbling,
            "task.initial.angular_momentum",
        ),
    ] {
        match try_plan(method, problem) {
            Err(PlanError::Problem(error)) => assert_eq!(error.key, key),
            other => panic!("{}: {other:?}", method.name()),
        }
    }
}

#[test]
fn a_motion_is_the_same_however_the_base_attitude_is_described() {
    let by_angles = shipped("chaser-7dof");
    let by_quaternion = by_angles.edited(|by_quaternion| {
        by_quaternion.set_attitude(SpatialAttitude::Quaternion);
        by_quaternion.cost.final_base_attitude = vec![1.0];
    });
    let by_quaternion = by_quaternion.unwrap();
    for method in [
        Method::Matpm,
        Method::ReactionNullSpace,
        Method::AccelerationQp,
    ] {
        let [a, b] = [&by_angles, &by_quaternion].map(|problem| plan(method, problem));
        let last = |plan: &Plan| plan.trajectory.base_position.last().unwrap().clone();
        for (x, y) in last(&a).iter().zip(last(&b)) {
            // The quadratic programme weighs the base's motion in the parameters themselves.
            let room = match method {
                Method::AccelerationQp => 1e-4,
                _ => 1e-9,
            };
            assert!((x - y).abs() < room, "{}: {x} {y}", method.name());
        }
        if method != Method::AccelerationQp {
            // The rotation angle, whatever describes the attitude.
            let [a, b] = [&a, &b].map(|plan| plan.metrics.final_base_attitude);
            assert!((a - b).abs() < 1e-9, "{}: {a} {b}", method.name());
        }
        let terms = cost_terms(&by_quaternion, &b.discretization);
        let square = b.metrics.final_base_attitude.powi(2);
        assert!(
            (terms.of(CostId::FinalBaseAttitude) - square).abs() < 1e-12,
            "{terms:?}"
        );
    }
}

#[test]
fn a_start_far_outside_limits_on_the_base_is_led_within_them_first() {
    // The straight path turns the base by 25.8° where 15° are allowed. From it the solver took 399
    // iterations on the first mesh and 553 in all; its other best known optimum costs 1.65315.
    let problem = shipped("table1-heavy-base");
    let mut iterations = 0;
    let mut led = false;
    let plan = Planner::new()
        .plan_with(&problem, None, &mut |event| {
            led |= matches!(event, Event::LeadingWithin);
            let is_step = matches!(event, Event::Refinement(refine::Event::Solver(_)));
            iterations += usize::from(is_step);
            Control::Continue
        })
        .unwrap();
    assert!(led);
    assert_eq!(plan.status, Status::Solved);
    assert!(
        (plan.objective - 1.65315).abs() < 3e-4,
        "{}",
        plan.objective
    );
    assert!(iterations < 400, "{iterations}");
}
