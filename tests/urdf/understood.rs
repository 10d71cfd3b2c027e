//! What is understood.

use crate::program::edited;
use crate::robots::*;
use ffsm_ipopt::dynamics::{EndEffector, Inertia, JointKind, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

#[test]
fn joints_links_and_limits() {
    let (robot, notes) = read(ARM, 2);
    assert_eq!(notes, Vec::<String>::new());
    assert_eq!((robot.name(), robot.base().name.as_str()), ("arm", "hull"));
    let [shoulder, boom] = robot.joints() else {
        panic!("two joints: {robot:?}")
    };
    assert_eq!(shoulder.name, "shoulder");
    assert_eq!(shoulder.kind, JointKind::Revolute);
    assert_eq!((shoulder.parent, boom.parent), (None, Some(0)));
    assert_near(&shoulder.placement.translation, [0.3, 0.0, 0.1]);
    assert_near(&shoulder.axis, [0.0, 0.0, 1.0]);
    assert_eq!(shoulder.limits.position, [-2.0, 2.5]);
    assert_eq!(
        (shoulder.limits.velocity, shoulder.limits.effort),
        (1.5, 30.0)
    );
    assert_eq!(boom.kind, JointKind::Prismatic);
    // The axis is x where none is given.
    assert_near(&boom.axis, [1.0, 0.0, 0.0]);
    assert_eq!(boom.limits.position, [0.0, 0.4]);
}

#[test]
fn inertias_are_turned_and_fixed_links_lumped() {
    let (robot, _) = read(ARM, 2);
    let upper = &robot.joints()[0].body.inertia;
    let turn = Rotation3::from_euler_angles(0.0, 0.2, 0.0).into_inner();
    let own = Matrix3::new(0.02, 0.001, 0.0, 0.001, 0.09, 0.0, 0.0, 0.0, 0.1);
    let gap = upper.rotational() - turn * own * turn.transpose();
    assert!(gap.amax() < 1e-15, "{gap}");
    assert_near(upper.center(), [0.25, 0.0, 0.0]);

    let lower = &robot.joints()[1].body;
    assert_eq!(lower.name, "lower");
    let own = Inertia::new(
        3.0,
        Vector3::new(0.2, 0.01, 0.0),
        Matrix3::from_diagonal(&Vector3::new(0.01, 0.05, 0.05)),
    );
    // The adapter's z is the lower link's x.
    let adapter = Inertia::new(
        0.5,
        Vector3::new(0.45, 0.0, 0.0),
        Matrix3::identity() * 0.001,
    );
    let expected = own.unwrap().lumped(&adapter.unwrap());
    assert!((lower.inertia.mass() - 3.5).abs() < 1e-15);
    assert!((lower.inertia.center() - expected.center()).amax() < 1e-15);
    assert!((lower.inertia.rotational() - expected.rotational()).amax() < 1e-15);
}

#[test]
fn end_effector_is_the_only_last_link_or_the_one_named() {
    let end = |robot: Model| robot.end_effector().cloned();
    let along = |x, turned: bool| {
        let rpy = [0.0, if turned { FRAC_PI_2 } else { 0.0 }, 0.0];
        Placement::from_xyz_rpy([x, 0.0, 0.0], rpy)
    };
    let assert_at = |found: Option<EndEffector>, joint, expected: Placement| {
        let EndEffector {
            joint: carrier,
            placement,
        } = found.expect("an end effector");
        assert_eq!(carrier, joint);
        assert!((placement.translation - expected.translation).amax() < 1e-15);
        assert!((placement.rotation - expected.rotation).amax() < 1e-15);
    };
    assert_at(end(read(ARM, 2).0), Some(1), along(0.5, true));
    for (name, joint, expected) in [
        ("adapter", Some(1), along(0.4, true)),
        ("lower", Some(1), along(0.0, false)),
        ("upper", Some(0), along(0.0, false)),
        ("hull", None, along(0.0, false)),
    ] {
        let robot = format!("{{ file = \"arm.urdf\", end_effector = \"{name}\" }}");
        let file = load(&folder(ARM, &robot, 2, ""));
        assert_at(end(file.problem.into_builder().robot), joint, expected);
    }
    // Several last links, none of them more of an end than the others.
    assert_eq!(end(read(TWO_ARMS, 4).0), None);
    assert_eq!(end(read(EXPORTED, 3).0), None);
}

#[test]
fn end_effector_that_is_not_there() {
    let robot = "{ file = \"arm.urdf\", end_effector = \"tool1\" }";
    assert_eq!(
        complaint(&folder(ARM, robot, 2, "")),
        "case.toml:3: robot.end_effector: \"tool1\"; expected a body or joint of the robot: hull, \
         upper, lower, adapter, tool0"
    );
}

#[test]
fn locked_joints_become_part_of_what_carries_them() {
    let robot = "{ file = \"arm.urdf\", lock = { boom = 0.3 } }";
    let robot = load(&folder(ARM, robot, 1, ""))
        .problem
        .into_builder()
        .robot;
    assert_eq!(robot.joint_count(), 1);
    assert!((robot.joints()[0].body.inertia.mass() - 7.5).abs() < 1e-15);
    let end = robot.end_effector().unwrap();
    assert_eq!(end.joint, Some(0));
    assert_near(&end.placement.translation, [0.5 + 0.3 + 0.5, 0.0, 0.0]);
    assert_eq!(
        complaint(&folder(
            ARM,
            "{ file = \"arm.urdf\", lock = { bracket = 0.0 } }",
            2,
            ""
        )),
        "case.toml:3: robot.lock.bracket: unknown key; expected one of shoulder, boom"
    );
}

#[test]
fn two_arms_depth_first_in_the_order_of_the_file() {
    let (robot, _) = read(TWO_ARMS, 4);
    let names: Vec<&str> = robot.joints().iter().map(|j| j.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "right_shoulder",
            "right_elbow",
            "left_shoulder",
            "left_elbow"
        ]
    );
    let parents: Vec<_> = robot.joints().iter().map(|joint| joint.parent).collect();
    assert_eq!(parents, [None, Some(0), None, Some(2)]);
}

#[test]
fn spacecraft_is_attached_to_the_root_link() {
    let file = load(&folder(ARM, FILE, 2, SPACECRAFT));
    let base = file.problem.robot.base();
    assert_eq!((base.name.as_str(), base.inertia.mass()), ("hull", 240.0));
    assert_near(base.inertia.center(), [200.0 * 0.1 / 240.0, 0.0, 0.0]);
    let run = folder(ARM, FILE, 2, SPACECRAFT).run(&["check", "case.toml"]);
    assert!(
        run.stdout
            .contains("3: hull 240 kg, upper 4 kg, lower 3.5 kg"),
        "{run:?}"
    );
}

#[test]
fn plan_of_a_robot_in_urdf() {
    let folder = folder(ARM, FILE, 2, SPACECRAFT);
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    let drift = &solution["verification"]["max_base_attitude_drift"];
    assert!(drift.as_f64().unwrap() < 1e-3);
    let provenance = &solution["provenance"];
    assert_eq!(provenance["robot"]["text"], ARM);
    let digest = provenance["robot_sha256"].as_str().unwrap();
    assert_eq!(
        digest,
        "d18aa4b87066fe3adeedc4d1f49d5121b8bab398cbdbd2b7d7739d76225c5b2e"
    );
}

#[test]
fn file_names() {
    for name in ["arm.URDF", "arm.xml"] {
        let folder = folder("", &format!("\"{name}\""), 2, "");
        folder.write(name, ARM);
        assert_eq!(load(&folder).problem.robot.name(), "arm");
    }
    let unnamed = edited(ARM, "<robot name=\"arm\">", "<robot>");
    assert_eq!(
        read(&format!("\u{feff}{}", &unnamed[22..]), 2).0.name(),
        "arm"
    );
}
