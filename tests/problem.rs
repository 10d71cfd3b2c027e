//! A problem is never invalid: `build` and `edited` refuse what cannot be.

mod problems;
mod trees;

use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::problem::{
    EndEffectorGoal, GoalFrame, KeepOut, Moment, Problem, ProblemBuilder, Solid, Task, WayPoint,
};

/// A change that makes a problem invalid, and the key that is to blame.
type Change = (&'static str, fn(&mut ProblemBuilder));

/// `edited` and `build` both refuse each change of `problem`, with the same error.
fn assert_refused(problem: &Problem, changes: &[Change]) {
    for (key, change) in changes {
        let by_edit = problem.edited(change).expect_err(key);
        assert_eq!(by_edit.key, *key, "{by_edit}");
        let mut builder = problem.clone().into_builder();
        change(&mut builder);
        assert_eq!(builder.build(), Err(by_edit), "{key}");
    }
}

fn pair(radius: f64, joint: Option<usize>) -> KeepOut {
    KeepOut {
        name: "apart".into(),
        first: Solid::sphere(joint, [0.0; 3], radius),
        second: Solid::sphere(None, [0.0; 3], radius),
    }
}

#[test]
fn tasks_that_cannot_be() {
    assert_refused(
        &problems::smooth(),
        &[
            ("task.duration", |p| p.task.duration = Interval::fixed(0.0)),
            ("task.duration", |p| {
                p.task.duration = Interval::new(2.0, 1.0)
            }),
            ("task.initial.joints", |p| {
                p.task.initial_joints = vec![0.0; 3]
            }),
            ("task.initial.joints[1]", |p| {
                p.task.initial_joints[1] = f64::NAN
            }),
            ("task.initial.joints[0]", |p| p.task.initial_joints[0] = 1.6),
            ("task.initial.rates[0]", |p| p.task.initial_rates[0] = 1.0),
            ("task.final.joints[1]", |p| p.task.final_joints[1] = -1.6),
            ("task.final.joints", |p| p.task.free_joints[0] = true),
            ("task.final.free", |p| p.task.free_joints.clear()),
            ("task.final.end_effector", |p| {
                let goal = EndEffectorGoal::at(GoalFrame::Base, &[1.0, 0.0]);
                p.task.end_effector = Some(goal);
            }),
            ("task.initial.base_attitude", |p| {
                p.task.initial_base_attitude = vec![0.0; 3]
            }),
            ("task.initial.base_attitude", |p| {
                p.task.initial_base_attitude = vec![f64::NAN]
            }),
            ("task.initial.linear_momentum", |p| {
                p.task.initial_momentum.linear = vec![0.0; 3]
            }),
            ("task.initial.angular_momentum", |p| {
                p.task.initial_momentum.angular[0] = f64::INFINITY
            }),
            ("task.way_points[0].fraction", |p| {
                p.task.way_points = vec![WayPoint::joints(Moment::Fraction(1.0), &[0.0; 2])]
            }),
            ("task.way_points[0].joints[1]", |p| {
                p.task.way_points = vec![WayPoint::joints(Moment::Time(1.0), &[0.0, 1.6])]
            }),
            ("task.way_points[0].joints", |p| {
                p.task.way_points = vec![WayPoint::joints(Moment::Time(1.0), &[0.0; 3])]
            }),
        ],
    );
}

#[test]
fn limits_that_cannot_be() {
    assert_refused(
        &problems::smooth(),
        &[
            ("limits.joint_position", |p| {
                // Way-points are held against these bounds: no less than one a joint.
                p.task.way_points = vec![WayPoint::joints(Moment::Time(1.0), &[0.0; 2])];
                p.limits.joint_position.truncate(1);
            }),
            ("limits.joint_velocity[0]", |p| {
                p.limits.joint_velocity[0] = Interval::new(f64::NAN, 1.0)
            }),
            ("limits.control[1]", |p| {
                p.limits.control[1] = Interval::new(1.0, -1.0)
            }),
            ("limits.torque", |p| p.limits.torque.clear()),
            ("limits.base_attitude", |p| {
                p.limits.base_attitude = vec![Interval::new(0.1, 0.2)]
            }),
            ("limits.base_attitude", |p| {
                p.task.initial_base_attitude = vec![0.3];
                p.limits.base_attitude = vec![Interval::symmetric(0.2)]
            }),
            ("limits.base_rate", |p| {
                p.limits.base_rate = vec![Interval::FREE; 3]
            }),
            ("limits.final_base_attitude", |p| {
                p.limits.final_base_attitude.clear()
            }),
            ("limits.keep_out[0].sphere.radius", |p| {
                p.limits.keep_out = vec![pair(-1.0, Some(0))]
            }),
            ("limits.keep_out[0].sphere.radius", |p| {
                p.limits.keep_out = vec![pair(0.0, Some(0))]
            }),
            ("limits.keep_out[0].capsule.radius", |p| {
                let line = Solid::capsule(Some(0), [[0.0; 3], [0.5, 0.0, 0.0]], 0.0);
                p.limits.keep_out = vec![pair(0.0, None)];
                p.limits.keep_out[0].first = line;
            }),
            ("limits.keep_out[0].sphere.body", |p| {
                p.limits.keep_out = vec![pair(0.1, Some(2))]
            }),
            ("limits.keep_out[0].from.body", |p| {
                p.limits.keep_out = vec![pair(0.1, None)]
            }),
        ],
    );
}

#[test]
fn a_rotation_angle_has_a_symmetric_bound() {
    let mut problem = Problem::builder("space", trees::chain(2, 3), 5.0, &[0.0; 2], &[0.1; 2]);
    problem.set_attitude(SpatialAttitude::Quaternion);
    let lopsided = |p: &mut ProblemBuilder| {
        p.limits.final_base_attitude = vec![Interval::new(-0.1, 0.2)];
    };
    let problem = problem.build().unwrap();
    assert_refused(&problem, &[("limits.final_base_attitude", lopsided)]);
}

#[test]
fn costs_and_meshes_that_cannot_be() {
    assert_refused(
        &problems::smooth(),
        &[
            ("cost.final_base_attitude", |p| {
                p.cost.final_base_attitude.clear()
            }),
            ("cost.final_base_position[1]", |p| {
                p.cost.final_base_position[1] = -1.0
            }),
            ("cost.base_rate", |p| p.cost.base_rate[0] = f64::NAN),
            ("cost.joint_rate", |p| p.cost.joint_rate.push(0.0)),
            ("cost.control[0]", |p| p.cost.control[0] = f64::INFINITY),
            ("cost.torque[1]", |p| p.cost.torque[1] = -0.1),
            ("cost.duration", |p| p.cost.duration = -1.0),
            ("cost.rate_matrix", |p| p.cost.rate_matrix = Some(vec![])),
            ("cost.rate_matrix[0][1]", |p| {
                let mut matrix = vec![vec![0.0; 3]; 3];
                matrix[0][1] = 1.0;
                p.cost.rate_matrix = Some(matrix);
            }),
            ("mesh.segments", |p| p.mesh.segments = 0),
        ],
    );
}

/// A wrist whose first two links have no mass: where the middle joint is at zero, the other two
/// turn about one axis.
fn wrist() -> Model {
    let body = |name: &str, mass: f64| Body {
        name: name.into(),
        inertia: match mass {
            0.0 => Inertia::massless(),
            _ => Inertia::new(mass, Vector3::zeros(), Matrix3::identity() * mass).unwrap(),
        },
    };
    let joint = |name: &str, parent, axis, mass| Joint {
        name: name.into(),
        kind: JointKind::Revolute,
        parent,
        placement: Placement::identity(),
        axis,
        limits: JointLimits::NONE,
        body: body(name, mass),
    };
    let joints = vec![
        joint("roll", None, Vector3::x_axis(), 0.0),
        joint("pitch", Some(0), Vector3::y_axis(), 0.0),
        joint("turn", Some(1), Vector3::x_axis(), 1.0),
    ];
    Model::new("wrist", body("base", 10.0), joints).unwrap()
}

#[test]
fn positions_at_which_a_joint_moves_no_mass() {
    let problem = Problem::builder("wrist", wrist(), 5.0, &[0.1; 3], &[0.2; 3]);
    assert_refused(
        &problem.build().unwrap(),
        &[
            ("task.initial.joints", |p| p.task.initial_joints[1] = 0.0),
            ("task.final.joints", |p| p.task.final_joints[1] = 0.0),
            ("task.way_points[0].joints", |p| {
                p.task.way_points = vec![WayPoint::joints(Moment::Time(1.0), &[0.1, 0.0, 0.1])]
            }),
        ],
    );
}

#[test]
fn a_built_problem_reads_as_it_was_described() {
    let robot = problems::two_link();
    let task = Task::rest_to_rest(&robot, 3.0, &[0.0; 2], &[0.1, 0.2]);
    let described = ProblemBuilder::of_task("short", robot, task);
    let problem = described.clone().build().unwrap();
    assert_eq!(*problem, described);
    let longer = problem.edited(|p| p.task.duration = Interval::fixed(4.0));
    assert_eq!(longer.unwrap().task.duration.upper, 4.0);
    assert_eq!(problem.task.duration.upper, 3.0);
    assert_eq!(problem.into_builder(), described);
}

#[test]
fn bounds_hold_the_attitude_at_the_start_and_not_zero() {
    let turned = problems::smooth().edited(|p| {
        p.task.initial_base_attitude = vec![0.3];
        p.limits.base_attitude = vec![Interval::new(0.1, 0.5)];
    });
    assert!(turned.is_ok(), "{turned:?}");
}
