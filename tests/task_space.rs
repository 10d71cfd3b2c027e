//! Goals for the end effector, and free final time.

mod problems;
mod trees;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::Placement;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::nalgebra::{Matrix3, Rotation2, Rotation3, Vector2, Vector3};
use ffsm_ipopt::ocp::{Ocp, Point};
use ffsm_ipopt::planner::{Plan, Planner, Status, plan};
use ffsm_ipopt::problem::{EndEffectorGoal, GoalFrame, Moment, Problem, WayPoint};
use ffsm_ipopt::system::{FreeFloating, StraightLine, straight_line};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

/// The smooth two-link case with an end effector at the forearm's end.
fn two_link() -> Problem {
    let tip = Placement::from_xyz_rpy([0.35 + 0.156, 0.0, 0.0], [0.0; 3]);
    let robot = problems::two_link().with_end_effector(Some(1), tip);
    problems::smooth()
        .edited(|problem| problem.robot = robot)
        .unwrap()
}

/// Where the two-link arm's end effector is at t_f: inertial position from the system's mass
/// centre, and heading.
fn tip(plan: &Plan) -> ([f64; 2], f64) {
    let last = |rows: &[Vec<f64>]| rows.last().unwrap().clone();
    let eta = last(&plan.trajectory.base_attitude)[0];
    let base = last(&plan.trajectory.base_position);
    let joints = last(&plan.trajectory.joint_position);
    let headings = [eta, eta + joints[0], eta + joints[0] + joints[1]];
    let lengths = [0.156, 0.506, 0.506];
    let along = |f: fn(f64) -> f64| {
        headings
            .iter()
            .zip(lengths)
            .map(|(h, l)| l * f(*h))
            .sum::<f64>()
    };
    (
        [base[0] + along(f64::cos), base[1] + along(f64::sin)],
        headings[2],
    )
}

#[test]
fn a_point_reached_by_the_joint_goal_costs_no_more_as_a_point() {
    let by_joints = plan(&two_link()).unwrap();
    let (point, _) = tip(&by_joints);
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Inertial, &point));
        })
        .unwrap();
    let by_point = plan(&problem).unwrap();
    assert_eq!(by_point.status, Status::Solved);
    let (reached, _) = tip(&by_point);
    assert!((reached[0] - point[0]).hypot(reached[1] - point[1]) < 1e-7);
    assert!(
        by_point.objective <= by_joints.objective + 1e-8,
        "{} against {}",
        by_point.objective,
        by_joints.objective
    );
}

#[test]
fn a_point_seen_from_the_start_is_the_same_point() {
    let by_joints = plan(&two_link()).unwrap();
    let (point, _) = tip(&by_joints);
    let start = &by_joints.trajectory.base_position[0];
    let seen = [point[0] - start[0], point[1] - start[1]];
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Start, &seen));
        })
        .unwrap();
    let by_point = plan(&problem).unwrap();
    let (reached, _) = tip(&by_point);
    assert!((reached[0] - point[0]).hypot(reached[1] - point[1]) < 1e-7);
}

#[test]
fn a_base_that_starts_turned_moves_as_one_that_does_not() {
    let turn: f64 = 0.7;
    // A pose that the arm can reach, seen from the start.
    let by_joints = plan(&two_link()).unwrap();
    let (point, heading) = tip(&by_joints);
    let start = &by_joints.trajectory.base_position[0];
    let seen = vec![point[0] - start[0], point[1] - start[1]];
    let problem = |turned: f64| {
        let problem = two_link().edited(|problem| {
            // What is counted from the inertial axes would tell them apart.
            problem.cost.final_base_attitude = vec![0.0];
            problem.task.free_joints = vec![true; 2];
            problem.task.initial_base_attitude = vec![turned];
            problem.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Start,
                position: Some(seen.clone()),
                position_tolerance: 0.01,
                orientation: Some(vec![heading]),
                orientation_tolerance: 0.2,
            });
        });
        problem.unwrap()
    };
    let [straight, turned] = [0.0, turn].map(|turned| plan(&problem(turned)).unwrap());
    assert_eq!(
        (straight.status, turned.status),
        (Status::Solved, Status::Solved)
    );
    assert!((straight.objective - turned.objective).abs() < 1e-8 * straight.objective);
    let ends = |plan: &Plan| {
        let motion = &plan.trajectory;
        let last = motion.t.len() - 1;
        let base = &motion.base_position;
        (
            motion.base_attitude[last][0],
            Vector2::new(base[last][0] - base[0][0], base[last][1] - base[0][1]),
            motion.joint_position[last].clone(),
        )
    };
    let (before, after) = (ends(&straight), ends(&turned));
    assert_eq!(turned.trajectory.base_attitude[0], [turn]);
    assert!(
        (after.0 - before.0 - turn).abs() < 1e-6,
        "{} {}",
        after.0,
        before.0
    );
    let expected = Rotation2::new(turn) * before.1;
    assert!((after.1 - expected).norm() < 1e-7, "{} {expected}", after.1);
    for (a, b) in after.2.iter().zip(&before.2) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let (a, b) = (&straight.goals[0], &turned.goals[0]);
    assert!((a.distance.unwrap() - b.distance.unwrap()).abs() < 1e-7);
    assert!((a.angle.unwrap() - b.angle.unwrap()).abs() < 1e-7);
}

#[test]
fn a_base_in_space_that_starts_turned() {
    let angles = [0.4, -0.9, 2.0];
    let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
    let of = |attitude, turned: [f64; 3]| {
        let mut problem =
            Problem::builder("turned", trees::chain(4, 9), 10.0, &[0.0; 4], &[0.7; 4]);
        problem.set_attitude(attitude);
        problem.task.initial_base_attitude = turned.to_vec();
        straight_line(&problem.build().unwrap())
    };
    for attitude in SpatialAttitude::ALL {
        let (before, after) = (of(attitude, [0.0; 3]), of(attitude, angles));
        let rotation = |found: &StraightLine| attitude.to_quaternion(&found.base_attitude);
        let expected = turn * rotation(&before).to_rotation_matrix();
        let found = rotation(&after).to_rotation_matrix();
        assert!(
            (found.matrix() - expected.matrix()).amax() < 1e-8,
            "{attitude:?}"
        );
        let moved = |found: &StraightLine| Vector3::from_column_slice(&found.base_displacement);
        assert!(
            (moved(&after) - turn * moved(&before)).amax() < 1e-10,
            "{attitude:?}"
        );
    }
}

#[test]
fn a_heading_with_a_tolerance_is_met_at_its_near_edge() {
    let problem = two_link()
        .edited(|problem| {
            problem.task.final_joints = vec![0.0, 0.3];
            problem.task.free_joints = vec![false, true];
            problem.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Base,
                position: None,
                position_tolerance: 0.0,
                orientation: Some(vec![1.0]),
                orientation_tolerance: 0.1,
            });
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let joints = plan.trajectory.joint_position.last().unwrap();
    // Joint 1 is held: the heading in the base frame is joint 2's angle, and less motion is
    // cheaper.
    assert!((joints[1] - 0.9).abs() < 1e-6, "{joints:?}");
}

#[test]
fn a_point_out_of_reach_is_named() {
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Base, &[2.0, 0.5]));
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.unwrap().limits;
    assert!(
        limits
            .iter()
            .any(|l| l.limit.key() == "task.final.end_effector"),
        "{limits:?}"
    );
}

#[test]
fn a_pose_in_space_is_reached() {
    let mut problem = Problem::builder("pose", trees::chain(6, 9), 10.0, &[0.0; 6], &[0.0; 6]);
    let mount = Placement::from_xyz_rpy([0.2, 0.1, 0.3], [0.3, -0.5, 1.0]);
    problem.robot = problem.robot.with_end_effector(Some(5), mount.clone());
    problem.cost.joint_rate = vec![1.0; 6];
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; 6];
    let problem = problem.build().unwrap();
    let wanted: [f64; 6] = [0.4, -0.3, 0.5, 0.2, -0.4, 0.3];
    let pose = |q: &[f64]| -> (Matrix3<f64>, Vector3<f64>) {
        let mut rotation = Matrix3::identity();
        let mut origin = Vector3::zeros();
        for (joint, angle) in problem.robot.joints().iter().zip(q) {
            origin += rotation * joint.placement.translation;
            let turn = Rotation3::from_axis_angle(&joint.axis, *angle);
            rotation = rotation * joint.placement.rotation * turn.matrix();
        }
        (
            rotation * mount.rotation,
            origin + rotation * mount.translation,
        )
    };
    let (rotation, position) = pose(&wanted);
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(rotation).euler_angles();
    let task = problem
        .edited(|task| {
            task.task.free_joints = vec![true; 6];
            task.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Base,
                position: Some(position.iter().copied().collect()),
                position_tolerance: 0.0,
                orientation: Some(vec![roll, pitch, yaw]),
                orientation_tolerance: 0.0,
            });
        })
        .unwrap();
    let plan = plan(&task).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let (turned, reached) = pose(plan.trajectory.joint_position.last().unwrap());
    assert!((reached - position).norm() < 1e-7);
    assert!((turned - rotation).norm() < 1e-7);
    // The joints that reach it are one way to do so.
    let by_joints = problem
        .edited(|by_joints| by_joints.task.final_joints = wanted.to_vec())
        .unwrap();
    let by_joints = self::plan(&by_joints).unwrap();
    assert_eq!(by_joints.status, Status::Solved);
    assert!(
        plan.objective <= by_joints.objective + 1e-8,
        "{} against {}",
        plan.objective,
        by_joints.objective
    );
}

/// u, τ along the two-link motion in which both joints move together, the elbow from rest to rest
/// over 60° with acceleration `a` up to `v`; largest share of each limit.
fn share_of_limits(problem: &Problem, a: f64, v: f64) -> f64 {
    let system = FreeFloating::planar(problem).unwrap();
    let mut scratch = system.scratch::<f64>();
    let (mut rates, mut torque) = ([0.0; 5], [0.0; 2]);
    let goal = [FRAC_PI_3 / 2.0, FRAC_PI_3];
    let ramp = 0.5 * v * v / a;
    let mut most = 0.0_f64;
    for k in 0..=1000 {
        // The elbow's angle, its rate there, and its acceleration on the way up and down.
        let elbow = FRAC_PI_3 * f64::from(k) / 1000.0;
        let from_end = elbow.min(FRAC_PI_3 - elbow);
        let rate = (2.0 * a * from_end.min(ramp)).sqrt();
        let slope = if from_end > ramp { 0.0 } else { a };
        for acceleration in [slope, -slope] {
            let part = [goal[0] / goal[1], 1.0];
            let x = [0.0, elbow * part[0], elbow, rate * part[0], rate];
            let mut evaluate = |u: [f64; 2]| {
                let point = Point {
                    x: &x,
                    u: &u,
                    parameters: &[],
                    t: 0.0,
                };
                system.continuous(point, &mut scratch, &mut rates, &mut torque);
                ([rates[3], rates[4]], torque)
            };
            // Without control the joints accelerate by −H⁻¹Cθ̇.
            let (left, _) = evaluate([0.0; 2]);
            let u = [0, 1].map(|j| part[j] * acceleration - left[j]);
            let (_, torque) = evaluate(u);
            let shares = [u[0] / 5.0, u[1] / 4.0, torque[0] / 0.6, torque[1] / 0.6];
            most = shares.into_iter().fold(most, |most, s| most.max(s.abs()));
        }
    }
    most
}

/// Largest |H⁻¹Cθ̇| of the elbow for joints within ±90° and rates within ±0.9 rad/s.
fn coriolis(problem: &Problem) -> f64 {
    let system = FreeFloating::planar(problem).unwrap();
    let mut scratch = system.scratch::<f64>();
    let (mut rates, mut torque) = ([0.0; 5], [0.0; 2]);
    let mut most = 0.0_f64;
    // A grid good to two percent, which the test adds.
    for a in -12..=12 {
        for b in -24..=24 {
            for c in -6..=6 {
                for d in -6..=6 {
                    let angle = |k: i32, of: f64| FRAC_PI_2 * f64::from(k) / of;
                    let rate = |k: i32| 0.9 * f64::from(k) / 6.0;
                    let x = [0.0, angle(a, 12.0), angle(b, 24.0), rate(c), rate(d)];
                    let u = [0.0; 2];
                    let point = Point {
                        x: &x,
                        u: &u,
                        parameters: &[],
                        t: 0.0,
                    };
                    system.continuous(point, &mut scratch, &mut rates, &mut torque);
                    most = most.max(rates[4].abs());
                }
            }
        }
    }
    most
}

#[test]
fn the_fastest_motion_is_between_what_the_elbow_needs_and_what_both_joints_can() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/config/table1-minimum-time.toml"
    );
    let problem = ProblemFile::load(file.as_ref(), &Overrides::default());
    let problem = problem.unwrap().problem;
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let fastest = plan.discretization.duration;
    assert!((fastest - 1.387167).abs() < 2e-5, "{fastest} s");
    assert!((plan.objective - fastest).abs() < 1e-12);
    let bang_cruise_bang = |a: f64| FRAC_PI_3 / 0.9 + 0.9 / a;
    // The elbow cannot accelerate by more than its control and the Coriolis term together.
    let bound = bang_cruise_bang(4.0 + 1.02 * coriolis(&problem));
    assert!(bound < fastest, "{bound} s, {fastest} s");
    // Both joints together, as fast as the limits let them.
    let together = (100..=400)
        .map(|k| 0.01 * f64::from(k))
        .filter(|&a| share_of_limits(&problem, a, 0.9) <= 1.0)
        .map(bang_cruise_bang)
        .fold(f64::INFINITY, f64::min);
    assert!(fastest < together, "{fastest} s, {together} s");
    assert!(
        together - bound < 0.05 * fastest,
        "{bound} s to {together} s"
    );
    // All three kinds of limits are reached.
    let peak = |rows: &[Vec<f64>], j: usize| rows.iter().fold(0.0_f64, |m, r| m.max(r[j].abs()));
    assert!((peak(&plan.trajectory.joint_velocity, 1) - 0.9).abs() < 1e-6);
    assert!((peak(&plan.trajectory.control, 1) - 4.0).abs() < 1e-6);
    assert!((peak(&plan.trajectory.joint_torque, 0) - 0.6).abs() < 1e-3);
}

#[test]
fn the_capture_case_meets_its_known_answer() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/config/capture.toml");
    let problem = ProblemFile::load(file.as_ref(), &Overrides::default())
        .unwrap()
        .problem;
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    assert!(
        (plan.objective - 0.297674).abs() < 5e-6,
        "J = {}",
        plan.objective
    );
    let degrees = plan.metrics.final_base_attitude.to_degrees();
    assert!(
        (degrees - 0.211).abs() < 2e-3,
        "final base attitude {degrees}°"
    );
}

/// States of `plan` at the node that stands at `fraction` of the duration.
fn passed(plan: &Plan, fraction: f64) -> &[f64] {
    let node = plan.discretization.mesh.node_at(fraction);
    plan.discretization
        .state(node.expect("a node at the way-point"))
}

#[test]
fn a_way_point_is_passed_at_its_time() {
    let problem = two_link();
    let direct = plan(&problem).unwrap();
    // Back and forth: 0.8 and −0.4 after 7 s, at rest; then joint 2 alone through 0.9.
    let mut stop = WayPoint::joints(Moment::Time(7.0), &[0.8, -0.4]);
    stop.joint_rates = vec![Some(0.0); 2];
    let mut half = WayPoint::joints(Moment::Fraction(0.61), &[0.0, 0.9]);
    half.joints[0] = None;
    let problem = problem
        .edited(|problem| problem.task.way_points = vec![stop, half])
        .unwrap();
    let through = plan(&problem).unwrap();
    assert_eq!(through.status, Status::Solved);
    assert!(through.trajectory.t.contains(&7.0));
    let x = passed(&through, 0.35);
    for (value, expected) in x[1..].iter().zip([0.8, -0.4, 0.0, 0.0]) {
        assert!((value - expected).abs() < 1e-9, "{x:?}");
    }
    let x = passed(&through, 0.61);
    assert!((x[2] - 0.9).abs() < 1e-9, "{x:?}");
    // What is free there is used: the arm does not stop.
    assert!(x[3].abs() > 1e-3 && x[4].abs() > 1e-3, "{x:?}");
    assert!(through.objective > direct.objective + 1e-2);
    for record in &through.iterations {
        assert!(record.breakpoints.contains(&0.35) && record.breakpoints.contains(&0.61));
    }
}

#[test]
fn a_way_point_on_the_best_path_costs_nothing() {
    let problem = two_link()
        .edited(|problem| problem.mesh.tolerance = 1e-7)
        .unwrap();
    let direct = plan(&problem).unwrap();
    let node = direct.discretization.mesh.points() / 3;
    let fraction = direct.discretization.mesh.node_fractions()[node];
    let joints = &direct.discretization.state(node)[1..3];
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::joints(Moment::Fraction(fraction), joints)]
        })
        .unwrap();
    let through = plan(&problem).unwrap();
    assert_eq!(through.status, Status::Solved);
    let gap = (through.objective - direct.objective).abs();
    assert!(gap < 1e-8, "{} and {}", through.objective, direct.objective);
}

#[test]
fn one_planner_serves_problems_with_and_without_way_points() {
    let mut planner = Planner::new();
    let mut problem = two_link()
        .edited(|problem| {
            problem.mesh.max_iterations = Some(1);
            problem.mesh.tolerance = 1.0;
        })
        .unwrap();
    let mut point = WayPoint::joints(Moment::Fraction(0.4), &[0.4, 0.2]);
    let mut objectives = Vec::new();
    for end_effector in [
        None,
        Some(EndEffectorGoal::at(GoalFrame::Start, &[1.0, 0.3])),
    ] {
        objectives.push(planner.plan(&problem).unwrap().objective);
        point.end_effector = end_effector;
        point.joints = vec![None, Some(0.2)];
        problem = problem
            .edited(|problem| problem.task.way_points = vec![point.clone()])
            .unwrap();
    }
    let last = planner.plan(&problem).unwrap();
    assert_eq!(last.status, Status::Solved);
    objectives.push(last.objective);
    assert!(
        objectives[0] < objectives[1] && objectives[1] < objectives[2],
        "{objectives:?}"
    );
}

#[test]
fn a_pose_in_space_is_passed_on_the_way() {
    let n = 6;
    let mut problem = Problem::builder("pose", trees::chain(n, 9), 10.0, &[0.0; 6], &[0.1; 6]);
    let mount = Placement::from_xyz_rpy([0.2, 0.1, 0.3], [0.3, -0.5, 1.0]);
    problem.robot = problem.robot.with_end_effector(Some(n - 1), mount.clone());
    problem.cost.joint_rate = vec![1.0; n];
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; n];
    let problem = problem.build().unwrap();
    // The base's own pose at 40 % of the way there and back again.
    let robot = problem.robot.clone();
    let pose = |x: &[f64], base: &[f64], start: &[f64]| -> (Matrix3<f64>, Vector3<f64>) {
        let mut rotation = Rotation3::from_euler_angles(x[0], x[1], x[2]).into_inner();
        let mut origin = Vector3::from_fn(|i, _| base[i] - start[i]);
        for (joint, angle) in robot.joints().iter().zip(&x[3..]) {
            origin += rotation * joint.placement.translation;
            let turn = Rotation3::from_axis_angle(&joint.axis, *angle);
            rotation = rotation * joint.placement.rotation * turn.matrix();
        }
        (
            rotation * mount.rotation,
            origin + rotation * mount.translation,
        )
    };
    let at = |plan: &Plan, fraction: f64| {
        let node = plan.discretization.mesh.node_at(fraction).unwrap();
        let base = &plan.trajectory.base_position;
        pose(plan.discretization.state(node), &base[node], &base[0])
    };
    // A pose that joints can reach there, a way off the direct path.
    let by_joints = WayPoint::joints(Moment::Fraction(0.4), &[0.4, -0.3, 0.5, 0.2, -0.4, 0.3]);
    let joints = problem
        .edited(|joints| joints.task.way_points = vec![by_joints])
        .unwrap();
    let joints = plan(&joints).unwrap();
    assert_eq!(joints.status, Status::Solved);
    let (rotation, position) = at(&joints, 0.4);
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(rotation).euler_angles();
    let goal = |position_tolerance, orientation_tolerance| EndEffectorGoal {
        frame: GoalFrame::Start,
        position: Some(position.iter().copied().collect()),
        position_tolerance,
        orientation: Some(vec![roll, pitch, yaw]),
        orientation_tolerance,
    };
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::pose(Moment::Time(4.0), n, goal(0.0, 0.0))]
        })
        .unwrap();
    let exact = plan(&problem).unwrap();
    assert_eq!(exact.status, Status::Solved);
    let (turned, reached) = at(&exact, 0.4);
    assert!((reached - position).norm() < 1e-7);
    assert!((turned - rotation).norm() < 1e-7);
    // The pose leaves joints to the planner, a tolerance leaves more.
    assert!(exact.objective <= joints.objective * (1.0 + 1e-6));
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::pose(Moment::Time(4.0), n, goal(0.02, 0.1))]
        })
        .unwrap();
    let near = plan(&problem).unwrap();
    assert_eq!(near.status, Status::Solved);
    assert!(near.objective < 0.99 * exact.objective);
    let [found] = &near.goals[..] else {
        panic!("{:?}", near.goals);
    };
    assert_eq!(found.key, "task.way_points[0].end_effector");
    assert_eq!(found.t, 4.0);
    let (turned, reached) = at(&near, 0.4);
    assert!((found.distance.unwrap() - (reached - position).norm()).abs() < 1e-9);
    let angle = Rotation3::from_matrix_unchecked(rotation.transpose() * turned).angle();
    assert!((found.angle.unwrap() - angle).abs() < 1e-7);
    // It is used to the full along some axis.
    assert!((reached - position).amax() > 0.02 - 1e-6);
}

#[test]
fn a_way_point_that_cannot_be_reached_in_time_is_named() {
    let problem = two_link()
        .edited(|problem| {
            // 1 rad in 0.4 s at 0.9 rad/s.
            problem.task.way_points = vec![WayPoint::joints(Moment::Time(0.4), &[1.0, 0.0])];
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.unwrap().limits;
    let named = limits
        .iter()
        .find(|l| l.limit.key() == "task.way_points[0]");
    let named = named.unwrap_or_else(|| panic!("{limits:?}"));
    assert_eq!(named.unit.symbol(), "rad");
    assert!(
        named.name.starts_with("position of joint joint1"),
        "{named:?}"
    );
}
