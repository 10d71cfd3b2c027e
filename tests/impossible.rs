//! What no motion can do is said before any solve, and nothing else is.

mod problems;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::{Model, Placement};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::{
    EndEffectorGoal, GoalFrame, Impossible, KeepOut, LimitId, Moment, Place, Problem,
    ProblemBuilder, Solid, WayPoint,
};
use ffsm_ipopt::system::impossible;
use std::f64::consts::PI;

/// What is found in the relaxed problem after a change.
fn found(change: impl FnOnce(&mut ProblemBuilder)) -> Vec<Impossible> {
    impossible(&problems::relaxed().edited(change).unwrap())
}

fn assert_none(found: &[Impossible]) {
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn nothing_is_found_in_what_is_shipped() {
    for entry in std::fs::read_dir("config").unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let file = ProblemFile::load(&path, &Overrides::default()).unwrap();
            assert_none(&impossible(&file.problem));
        }
    }
    for problem in [problems::published(), problems::smooth()] {
        assert_none(&impossible(&problem));
    }
}

#[test]
fn a_joint_that_would_have_to_be_faster_than_its_limit() {
    let within = |duration: f64| {
        found(|problem| {
            problem.task.duration = Interval::fixed(duration);
            problem.limits.control = vec![Interval::FREE; 2];
        })
    };
    // 60° at 0.9 rad/s.
    let least = PI / 3.0 / 0.9;
    assert_none(&within(1.0001 * least));
    let [
        Impossible::TooShort {
            joint,
            between: [Place::Start, Place::Goal],
            limit: LimitId::JointVelocity,
            least: known,
            available,
            ..
        },
    ] = &within(0.999 * least)[..]
    else {
        panic!("{:?}", within(0.999 * least));
    };
    assert_eq!(joint, "joint2");
    assert!((known - least).abs() < 2e-6 && *available == 0.999 * least);
    // A free duration may be as long as its upper bound.
    let free = |upper| {
        found(|problem| {
            problem.task.duration = Interval::new(0.1, upper);
            problem.limits.control = vec![Interval::FREE; 2];
        })
    };
    assert_none(&free(1.0001 * least));
    assert_eq!(free(0.999 * least).len(), 1);
}

#[test]
fn a_range_of_rates_counts_in_the_direction_of_the_way() {
    let with = |range| {
        found(|problem| {
            problem.limits.joint_velocity = vec![Interval::FREE, range];
            problem.task.duration = Interval::fixed(5.0);
        })
    };
    assert_none(&with(Interval::new(-0.01, 0.9)));
    assert_eq!(with(Interval::new(-0.9, 0.1)).len(), 1);
}

#[test]
fn what_is_hardly_possible_is_planned() {
    let problem = problems::relaxed()
        .edited(|problem| {
            problem.task.duration = Interval::fixed(1.5);
            problem.limits.base_rate = vec![Interval::FREE];
            problem.mesh.tolerance = 1.0;
            problem.mesh.bound_tolerance = 1e3;
        })
        .unwrap();
    assert_none(&impossible(&problem));
    assert_eq!(plan(&problem).unwrap().status, Status::Solved);
}

/// An arm of one joint, 0.8 rad in `duration` seconds.
fn one_joint(duration: Interval) -> ProblemBuilder {
    let robot = problems::two_link();
    let joints = robot.joints()[..1].to_vec();
    let robot = Model::new("one", robot.base().clone(), joints).unwrap();
    let mut problem = Problem::builder("one", robot, 1.0, &[0.0], &[0.8]);
    problem.task.duration = duration;
    problem.limits.joint_position = vec![Interval::symmetric(1.0)];
    problem.cost.duration = 1.0;
    problem.mesh.tolerance = 1e-3;
    problem
}

#[test]
fn the_least_time_is_near_that_which_is_planned_and_never_above() {
    type Limit = fn(&mut ProblemBuilder);
    let limits: [Limit; 3] = [
        |problem| problem.limits.control = vec![Interval::symmetric(1.0)],
        |problem| problem.limits.torque = vec![Interval::symmetric(0.2)],
        |problem| {
            problem.limits.control = vec![Interval::symmetric(1.0)];
            problem.limits.joint_velocity = vec![Interval::symmetric(0.5)];
            problem.task.initial_rates = vec![0.2];
        },
    ];
    for limit in limits {
        let mut free = one_joint(Interval::new(0.5, 20.0));
        limit(&mut free);
        let fastest = plan(&free.build().unwrap()).unwrap();
        assert_eq!(fastest.status, Status::Solved, "{:?}", fastest.iterations);
        let duration = fastest.discretization.duration;
        let within = |duration: f64| {
            let mut fixed = one_joint(Interval::fixed(duration));
            limit(&mut fixed);
            impossible(&fixed.build().unwrap())
        };
        assert_none(&within(1.001 * duration));
        let [Impossible::TooShort { least, .. }] = within(0.9 * duration)[..] else {
            panic!("{duration} s: {:?}", within(0.9 * duration));
        };
        assert!(least < 1.001 * duration, "{least} s, planned {duration} s");
    }
}

#[test]
fn an_arm_that_cannot_stop() {
    let mut problem = one_joint(Interval::fixed(0.9));
    problem.limits.control = vec![Interval::symmetric(0.5)];
    problem.task.initial_rates = vec![0.8];
    let found = impossible(&problem.build().unwrap());
    assert!(
        matches!(
            found[..],
            [Impossible::TooShortToStop {
                limit: LimitId::Control,
                least,
                ..
            }] if least > 1.2 && least < 1.6
        ),
        "{found:?}"
    );
}

#[test]
fn limits_of_zero_are_left_to_the_diagnosis() {
    // No duration would do, and the diagnosis finds the bound that would.
    let zero = || vec![Interval::symmetric(0.0); 2];
    assert_none(&found(|problem| problem.limits.torque = zero()));
    assert_none(&found(|problem| problem.limits.control = zero()));
    assert_none(&found(|problem| problem.limits.joint_velocity = zero()));
}

#[test]
fn momentum_may_swing_the_arm() {
    let with = |angular: f64| {
        found(|problem| {
            problem.task.initial_momentum.angular = vec![angular];
            problem.limits.base_rate = vec![Interval::FREE];
            problem.limits.control = vec![Interval::symmetric(5e-4); 2];
        })
    };
    assert_eq!(with(0.0).len(), 2);
    assert_none(&with(0.1));
}

#[test]
fn ways_between_way_points() {
    let passing = |time: f64| {
        found(|problem| {
            let point = WayPoint::joints(Moment::Time(time), &[0.3, -0.9]);
            problem.task.way_points = vec![point];
        })
    };
    assert_none(&passing(10.0));
    assert!(matches!(
        passing(0.9)[..],
        [Impossible::TooShort {
            between: [Place::Start, Place::WayPoint(0)],
            ..
        }]
    ));
    let late = passing(18.0);
    assert!(
        matches!(
            late[..],
            [Impossible::TooShort {
                between: [Place::WayPoint(0), Place::Goal],
                available,
                ..
            }] if (available - 2.0).abs() < 1e-9
        ),
        "{late:?}"
    );
}

#[test]
fn goals_beyond_reach() {
    // Stretched along x all is in one line: 1.012 m to the mass centre of the last link and 0.3 m on.
    let robot = problems::two_link()
        .with_end_effector(Some(1), Placement::from_xyz_rpy([0.65, 0.0, 0.0], [0.0; 3]));
    let (mass, moment, _) = problems::two_link_composite();
    let tip = 0.156 + 0.506 + 0.65;
    let center = moment / mass;
    let at = |frame, position: [f64; 2], tolerance: f64| {
        let mut problem = Problem::builder("reach", robot.clone(), 20.0, &[0.2; 2], &[0.1; 2]);
        problem.task.free_joints = vec![true; 2];
        let mut goal = EndEffectorGoal::at(frame, &position);
        goal.position_tolerance = tolerance;
        problem.task.end_effector = Some(goal);
        problem
    };
    let reasons = |problem: ProblemBuilder| impossible(&problem.build().unwrap());
    let far = tip - center;
    assert_none(&reasons(at(GoalFrame::Inertial, [0.0, 0.9999 * far], 0.0)));
    let beyond = reasons(at(GoalFrame::Inertial, [0.0, 1.001 * far], 0.0));
    assert!(
        matches!(
            beyond[..],
            [Impossible::OutOfReach {
                from_base: false,
                reach,
                ..
            }] if (reach - far).abs() < 1e-9
        ),
        "{beyond:?}"
    );
    assert_none(&reasons(at(GoalFrame::Inertial, [0.0, far + 0.01], 0.01)));
    // The mass centre drifts towards the goal.
    let mut drifting = at(GoalFrame::Inertial, [far + 1.0, 0.0], 0.0);
    drifting.task.initial_momentum.linear = vec![0.06 * mass, 0.0];
    assert_none(&reasons(drifting));
    let away = at(GoalFrame::Base, [0.156, 1.2], 0.0);
    assert_eq!(reasons(away).len(), 1);
    assert_none(&reasons(at(GoalFrame::Base, [0.156, 1.155], 0.0)));
    let from_start = at(GoalFrame::Start, [1.5, 0.0], 0.0);
    assert_eq!(reasons(from_start).len(), 1);
}

#[test]
fn places_that_a_limit_forbids() {
    // A ball at the end of the arm, and one on the base where the start has it.
    let pair = |at: [f64; 3]| KeepOut {
        name: "hand off the mast".into(),
        first: Solid::sphere(Some(1), [0.5, 0.0, 0.0], 0.05),
        second: Solid::sphere(None, at, 0.05),
    };
    let keep = |at| found(|problem| problem.limits.keep_out = vec![pair(at)]);
    let [
        Impossible::NotApart {
            pair: 0,
            place: Place::Start,
            overlap,
            ..
        },
    ] = keep([1.162, 0.08, 0.0])[..]
    else {
        panic!("{:?}", keep([1.162, 0.08, 0.0]));
    };
    assert!((overlap - 0.02).abs() < 1e-9, "{overlap}");
    assert_none(&keep([1.162, 0.100_001, 0.0]));
    // 30° and 90°: at the goal.
    let end = [0.156 + 0.506 * (PI / 6.0).cos(), 0.506 * 0.5 + 0.5, 0.0];
    assert!(matches!(
        keep(end)[..],
        [Impossible::NotApart {
            place: Place::Goal,
            ..
        }]
    ));
    let turning = found(|problem| {
        problem.task.initial_rates = vec![0.5, 0.5];
        problem.limits.base_rate = vec![Interval::symmetric(0.01)];
    });
    assert!(
        matches!(turning[..], [Impossible::BaseRate { rate, .. }] if rate < -0.01),
        "{turning:?}"
    );
    let apart = found(|problem| {
        problem.limits.base_attitude = vec![Interval::symmetric(0.5)];
        problem.limits.final_base_attitude = vec![Interval::new(0.6, 0.7)];
    });
    assert!(
        matches!(apart[..], [Impossible::FinalBaseAttitude { .. }]),
        "{apart:?}"
    );
}

/// The mass centre of the two-link arm and its base, from the base's frame, in the plane.
fn mass_center(joints: [f64; 2]) -> [f64; 2] {
    let robot = problems::two_link();
    let (mut at, mut turned) = ([0.0; 2], 0.0_f64);
    let mut mass = robot.base().inertia.mass();
    let mut moment = [0.0; 2];
    let mut along = |at: &mut [f64; 2], turned: f64, way: [f64; 2], part: f64| {
        let (sin, cos) = turned.sin_cos();
        let there = [
            at[0] + cos * way[0] - sin * way[1],
            at[1] + sin * way[0] + cos * way[1],
        ];
        moment = [0, 1].map(|k| moment[k] + part * there[k]);
        there
    };
    for (joint, angle) in robot.joints().iter().zip(joints) {
        let way = joint.placement.translation;
        at = along(&mut at, turned, [way.x, way.y], 0.0);
        turned += angle;
        let (part, center) = (joint.body.inertia.mass(), joint.body.inertia.center());
        along(&mut at, turned, [center.x, center.y], part);
        mass += part;
    }
    moment.map(|m| m / mass)
}

#[test]
fn a_box_that_the_mass_centre_keeps_the_base_out_of() {
    let (goal, most) = ([PI / 6.0, PI / 3.0], 0.02_f64);
    let (start, end) = (mass_center([0.0; 2]), mass_center(goal));
    // Where the base is at the goal, turned by so much: at the corner of the smallest square around.
    let needs = |turned: f64| {
        let (sin, cos) = turned.sin_cos();
        let x = start[0] - cos * end[0] + sin * end[1];
        let y = start[1] - sin * end[0] - cos * end[1];
        x.abs().max(y.abs())
    };
    let least = |most: f64| {
        let turns = (-2000..=2000).map(|k| needs(most * f64::from(k) / 2000.0));
        turns.fold(f64::INFINITY, f64::min)
    };
    let with = |half: f64, attitude: f64| {
        found(|problem| {
            problem.limits.base_position = vec![Interval::symmetric(half); 2];
            problem.limits.base_attitude = vec![Interval::symmetric(attitude)];
        })
    };
    let (any, few) = (least(PI), least(most));
    assert!(any > 1e-3 && few > 1.1 * any, "{any} {few}");
    // What can be is never refused, at any attitude or within the limit.
    assert_none(&with(1.001 * any, f64::INFINITY));
    assert_none(&with(1.001 * few, most));
    assert!(matches!(
        with(0.5 * any, f64::INFINITY)[..],
        [Impossible::BaseDisplacement {
            place: Place::Goal,
            turned: None,
            outside,
        }] if outside > 0.0 && outside < any
    ));
    assert!(matches!(
        with(0.9 * any, most)[..],
        [Impossible::BaseDisplacement {
            turned: Some(turned),
            ..
        }] if turned == most
    ));
    // Momentum carries the mass centre away; a free duration leaves open how far.
    let drifting = |duration: Interval, half: f64| {
        found(|problem| {
            problem.task.duration = duration;
            problem.task.initial_momentum.linear = vec![1.0, 0.0];
            problem.limits.base_position = vec![Interval::symmetric(half); 2];
        })
    };
    assert_eq!(drifting(Interval::fixed(20.0), 0.1).len(), 1);
    assert_none(&drifting(Interval::new(0.1, 20.0), 0.1));
}

#[test]
fn all_of_start_and_goal_outside_of_limits_is_listed() {
    let mut problem = problems::relaxed().into_builder();
    problem.task.initial_joints = vec![2.0, -2.0];
    problem.task.final_joints[1] = 1.6;
    problem.limits.base_attitude = vec![Interval::new(0.1, 0.2)];
    let keys: Vec<String> = problem
        .faults()
        .into_iter()
        .map(|fault| fault.key)
        .collect();
    assert_eq!(
        keys,
        [
            "limits.base_attitude",
            "task.initial.joints[0]",
            "task.initial.joints[1]",
            "task.final.joints[1]"
        ]
    );
}
