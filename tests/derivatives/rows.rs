//! Goals, way-points, pairs kept apart, elastic limits.

use crate::checks::*;
use crate::problem_kinds::*;
use crate::problems;
use crate::trees;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::ocp::{Elastic, Interval};
use ffsm_ipopt::problem::{GoalFrame, KeepOut, Moment, Solid, WayPoint};
use ffsm_ipopt::system::FreeFloating;

/// `problem` with a pose for the end effector, fixed in the last body.

#[test]
fn task_space_goals() {
    for frame in [GoalFrame::Inertial, GoalFrame::Start, GoalFrame::Base] {
        check_problem(&with_goal(loaded(problems::two_link()), frame), small());
        let arm = loaded(trees::chain(3, 4));
        check_problem(&with_goal(arm, frame), Mesh::uniform(1, 2).unwrap());
    }
}

#[test]
fn way_points_in_joint_and_task_space() {
    for robot in [problems::two_link(), trees::chain(3, 4)] {
        let problem = with_goal(loaded(robot), GoalFrame::Start);
        let n = problem.robot.joint_count();
        let goal = problem.task.end_effector.clone().unwrap();
        let mut stop = WayPoint::joints(Moment::Fraction(0.6), &vec![0.3; n]);
        stop.joints[0] = None;
        stop.joint_rates[0] = Some(0.0);
        let pose = WayPoint::pose(Moment::Fraction(0.3), n, goal);
        let problem = problem
            .edited(|problem| {
                problem.task.initial_momentum.linear[0] = 0.4;
                problem.task.way_points = vec![pose, stop];
            })
            .unwrap();
        let mesh = Mesh::new(vec![0.0, 0.3, 0.6, 1.0], &[1, 1, 1]).unwrap();
        check_problem(&problem, mesh.clone());
        if problem.robot.plane().is_some() {
            let system = FreeFloating::planar(&problem).unwrap();
            check(&Elastic::new(&system, groups(&system), 1e-3), mesh);
        }
    }
}

#[test]
fn pairs_kept_apart() {
    for robot in [problems::two_link(), trees::chain(3, 8)] {
        let problem = loaded(robot);
        let last = problem.robot.joint_count() - 1;
        let at = [0.3, 0.1, -0.2];
        let pair = |name: &str, second| KeepOut {
            name: name.into(),
            first: Solid::sphere(Some(last), at, 0.1),
            second,
        };
        let (center, half) = ([0.1, -0.2, 0.3], [0.6, 0.5, 0.4]);
        let problem = problem
            .edited(|problem| {
                problem.limits.keep_out = vec![
                    pair("off the base", Solid::sphere(None, at, 0.5)),
                    pair("along the arm", Solid::sphere(Some(0), at, 0.2)),
                    pair("off the box", Solid::cuboid(None, center, half)),
                    pair("along the arm, a box", Solid::cuboid(Some(0), center, half)),
                    KeepOut {
                        name: "a capsule off the box".into(),
                        first: Solid::capsule(Some(last), [at, [0.5, -0.1, 0.2]], 0.1),
                        second: Solid::cuboid(None, center, half),
                    },
                    KeepOut {
                        name: "along the arm, capsules".into(),
                        first: Solid::capsule(Some(last), [at, [0.5, -0.1, 0.2]], 0.1),
                        second: Solid::capsule(Some(0), [[0.0; 3], [0.3, 0.1, 0.4]], 0.2),
                    },
                    pair("off a capsule", Solid::capsule(None, [[0.0; 3], at], 0.2)),
                    KeepOut {
                        name: "a box in front".into(),
                        // At the height of the point, so that the way to it is in the plane.
                        first: Solid::cuboid(Some(last), [0.15, -0.25, -0.2], [0.1, 0.2, 0.3]),
                        second: Solid::sphere(None, at, 0.0),
                    },
                ];
                problem.limits.torque = vec![Interval::symmetric(3.0); last + 1];
            })
            .unwrap();
        // The first joint moves both bodies of these pairs alike: in base axes its part cancels.
        let first = format!("position of joint {}", problem.robot.joints()[0].name);
        let both_carried = |row: &str, column: &str| {
            row.starts_with("along the arm") && column.starts_with(&first)
        };
        check_problem_with(&problem, Mesh::uniform(1, 2).unwrap(), both_carried);
    }
}

#[test]
fn elastic_limits() {
    let problem = problems::published();
    let system = FreeFloating::planar(&problem).unwrap();
    check(&Elastic::new(&system, groups(&system), 1e-3), small());
}
