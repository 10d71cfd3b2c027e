//! Robots described in URDF: what is understood, what is taken for granted, what is refused.

mod program;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::{Inertia, JointKind, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use program::{Folder, Run};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

const ARM: &str = include_str!("data/urdf/arm.urdf");
const TWO_ARMS: &str = include_str!("data/urdf/two-arms.urdf");
const EXPORTED: &str = include_str!("data/urdf/exported.urdf");
const FLOATING: &str = include_str!("data/urdf/floating-base.urdf");
const WRIST: &str = include_str!("data/urdf/wrist.urdf");
const GRIPPER: &str = include_str!("data/urdf/gripper.urdf");
const ROUNDED: &str = include_str!("data/urdf/rounded.urdf");

/// A folder with `arm.urdf` and a problem whose key `robot` is as given.
fn folder(urdf: &str, robot: &str, joints: usize, more: &str) -> Folder {
    let goal = vec!["0.3"; joints].join(", ");
    let start = vec!["0.1"; joints].join(", ");
    let folder = Folder::new(&format!(
        "schema = 1\nname = \"case\"\nrobot = {robot}\n\n[task]\nduration = 20.0\n\
         initial.joints = [{start}]\nfinal.joints = [{goal}]\n\n\
         [cost]\nfinal_base_attitude = 1.0\njoint_rate = 0.2\ncontrol = 0.1\n\n\
         [mesh]\nsegments = 4\npoints = 5\ntolerance = 1e-3\n{more}"
    ));
    folder.write("arm.urdf", urdf);
    folder
}

const FILE: &str = "\"arm.urdf\"";
const SPACECRAFT: &str = "\n[base]\nmass = 200\ninertia = [20, 21, 22]\ncom = [0.1, 0, 0]\n";

fn load(folder: &Folder) -> ProblemFile {
    let path = folder.path().join("case.toml");
    ProblemFile::load(&path, &Overrides::default()).expect("a valid problem")
}

/// The robot of `arm.urdf` and the notes on it.
fn read(urdf: &str, joints: usize) -> (Model, Vec<String>) {
    let file = load(&folder(urdf, FILE, joints, ""));
    (file.problem.robot, file.notes)
}

/// The one line with which `check` and `plan` refuse the files.
#[track_caller]
fn complaint(folder: &Folder) -> String {
    let refused = |command: &str| -> Run {
        let run = folder.run(&[command, "case.toml"]);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(run.stdout, "");
        run
    };
    let run = refused("plan");
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert_eq!(refused("check").stderr, run.stderr);
    run.stderr.trim_end().to_owned()
}

/// The complaint about an URDF file as a whole.
#[track_caller]
fn refusal(urdf: &str) -> String {
    complaint(&folder(urdf, FILE, 2, ""))
}

fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} in the text");
    text.replace(old, new)
}

/// The complaint about `arm.urdf` with `old` replaced.
#[track_caller]
fn edit(old: &str, new: &str) -> String {
    refusal(&edited(ARM, old, new))
}

#[track_caller]
fn assert_near(found: &Vector3<f64>, expected: [f64; 3]) {
    let gap = (found - Vector3::from(expected)).amax();
    assert!(gap < 1e-12, "{found} instead of {expected:?}");
}

// ---------------------------------------------------------------- what is understood

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
    let assert_at = |found: Option<(Option<usize>, Placement)>, joint, expected: Placement| {
        let (carrier, placement) = found.expect("an end effector");
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
        assert_at(end(file.problem.robot), joint, expected);
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
    let robot = load(&folder(ARM, robot, 1, "")).problem.robot;
    assert_eq!(robot.joint_count(), 1);
    assert!((robot.joints()[0].body.inertia.mass() - 7.5).abs() < 1e-15);
    let (carrier, placement) = robot.end_effector().unwrap();
    assert_eq!(*carrier, Some(0));
    assert_near(&placement.translation, [0.5 + 0.3 + 0.5, 0.0, 0.0]);
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

// ---------------------------------------------------------------- what real files contain

#[test]
fn what_exporters_write() {
    let folder = folder(EXPORTED, FILE, 3, "");
    let file = load(&folder);
    let robot = &file.problem.robot;
    // The massless world link with the real base fixed to it.
    assert_eq!(robot.base().name, "world");
    assert_eq!(robot.base().inertia.mass(), 10.0);
    assert_near(robot.base().inertia.center(), [0.0, 0.0, 0.6]);
    assert_near(&robot.joints()[0].placement.translation, [0.0, 0.0, 0.7]);
    assert_near(&robot.joints()[0].axis, [1.0, 0.0, 0.0]);
    for (joint, velocity) in [(0, f64::INFINITY), (1, f64::INFINITY), (2, 2.0)] {
        let limits = &robot.joints()[joint].limits;
        assert_eq!(limits.position, [f64::NEG_INFINITY, f64::INFINITY]);
        assert_eq!((limits.velocity, limits.effort), (velocity, f64::INFINITY));
    }
    let run = folder.run(&["plan", "case.toml"]);
    assert_eq!(run.code, 0, "{run:?}");
    let notes = "\
note: arm.urdf:24: joint 'unlimited': no limit on position, velocity, effort (absent or 0), taken as unlimited; limits of the problem file can set one
note: arm.urdf:40: joint 'blank': no limit on position, velocity, effort (absent or 0), taken as unlimited; limits of the problem file can set one
";
    assert_eq!(run.stderr, notes);
    let quiet = folder.run(&["plan", "case.toml", "--quiet"]);
    assert_eq!((quiet.code, quiet.stderr.as_str()), (0, ""));
    let check = folder.run(&["check", "case.toml"]);
    assert_eq!((check.code, check.stderr.as_str()), (0, ""));
    assert!(check.stdout.contains(notes), "{}", check.stdout);
}

#[test]
fn limits_of_the_problem_answer_the_note() {
    let limits = "\n[limits]\njoint_position = 3.0\njoint_velocity = { blank = 1.0 }\n";
    assert_eq!(
        load(&folder(EXPORTED, FILE, 3, limits)).notes.map_lines(),
        [
            "joint 'unlimited': no limit on velocity, effort (absent or 0), taken as unlimited; \
             limits of the problem file can set one",
            "joint 'blank': no limit on effort (absent or 0), taken as unlimited; limits of the \
             problem file can set one"
        ]
    );
}

trait Lines {
    fn map_lines(&self) -> Vec<&str>;
}

impl Lines for Vec<String> {
    /// The lines without the place in front.
    fn map_lines(&self) -> Vec<&str> {
        self.iter()
            .map(|line| line.split_once(": ").expect("a place").1)
            .collect()
    }
}

#[test]
fn missing_ends_of_a_limit_are_zero() {
    let urdf = edited(ARM, "lower=\"-2.0\" upper", "upper");
    assert_eq!(read(&urdf, 2).0.joints()[0].limits.position, [0.0, 2.5]);
}

#[test]
fn base_that_floats_on_the_world() {
    let (robot, notes) = read(FLOATING, 1);
    assert_eq!(notes, Vec::<String>::new());
    assert_eq!(
        (robot.base().name.as_str(), robot.total_mass()),
        ("hull", 62.0)
    );
    assert_near(&robot.joints()[0].placement.translation, [0.5, 0.0, 0.0]);
}

#[test]
fn links_without_mass_between_joints() {
    let folder = folder(WRIST, FILE, 3, SPACECRAFT);
    let robot = load(&folder).problem.robot;
    assert_eq!(robot.joints()[1].body.inertia.mass(), 0.0);
    let run = folder.run(&["plan", "case.toml", "--json"]);
    assert_eq!(run.code, 0, "{run:?}");
    // The independent integration holds as well as with massive links.
    let solution: Value = serde_json::from_str(&run.stdout).unwrap();
    let drift = &solution["verification"]["max_base_attitude_drift"];
    assert!(drift.as_f64().unwrap() < 1e-3, "{drift}");
}

#[test]
fn start_at_which_massless_links_make_joints_interchangeable() {
    let folder = folder(WRIST, FILE, 3, SPACECRAFT);
    let problem = edited(
        &folder.read("case.toml"),
        "[0.1, 0.1, 0.1]",
        "[0.1, 0.0, 0.1]",
    );
    folder.write("case.toml", &problem);
    assert_eq!(
        complaint(&folder),
        "case.toml:7: task.initial.joints: joint 'turn' can move there without moving any mass; \
         expected positions at which bodies without mass do not make joints interchangeable"
    );
}

#[test]
fn mimicking_joints_can_be_locked() {
    let robot = "{ file = \"arm.urdf\", lock = { finger1 = 0.02, finger2 = 0.02 } }";
    let robot = load(&folder(GRIPPER, robot, 1, "")).problem.robot;
    assert!((robot.joints()[0].body.inertia.mass() - 2.2).abs() < 1e-15);
    assert_eq!(
        refusal(GRIPPER),
        "arm.urdf:27: joint 'finger2' <mimic>: follows joint 'finger1'; expected a joint that \
         moves by itself, or one held at a position: name it in robot.lock of the problem file"
    );
    let both = edited(
        GRIPPER,
        "<limit lower=\"0\" upper=\"0.04\" velocity=\"0.2\" effort=\"20\"/>\n  </joint>",
        "<mimic joint=\"finger2\" multiplier=\"2\"/>\n  </joint>",
    );
    assert!(refusal(&both).ends_with("in robot.lock of the problem file; likewise 'finger2'"));
}

#[test]
fn nearly_planar_robots_are_pointed_out() {
    let (robot, notes) = read(ROUNDED, 2);
    assert!(robot.plane().is_none());
    assert_eq!(
        notes.map_lines(),
        [
            "nearly planar, and treated in space: axes differ by 3.7e-6 rad. Where a plane is \
             meant, give angles with all their digits (π/2 is 1.5707963267948966)"
        ]
    );
    let exact = edited(ROUNDED, "1.5708", "1.5707963267948966");
    let (robot, notes) = read(&exact, 2);
    assert!(robot.plane().is_some());
    assert_eq!(notes, Vec::<String>::new());
}

#[test]
fn links_without_mass_do_not_hide_a_plane() {
    let urdf = edited(
        &edited(ROUNDED, "1.5708", "1.5707963267948966"),
        "    <inertial><origin xyz=\"0.25 0 0\"/><mass value=\"2\"/><inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.04\" iyz=\"0\" izz=\"0.04\"/></inertial>\n",
        "",
    );
    let (robot, _) = read(&urdf, 2);
    assert_eq!(robot.joints()[0].body.inertia.mass(), 0.0);
    assert!(robot.plane().is_some());
}

// ---------------------------------------------------------------- what is refused: the file

#[test]
fn files_that_are_no_urdf() {
    for (text, expected) in [
        (
            "",
            "arm.urdf: the file is empty; expected a <robot>, as in URDF",
        ),
        (
            " \n\n",
            "arm.urdf: the file is empty; expected a <robot>, as in URDF",
        ),
        ("schema = 1\n", "arm.urdf:1: not XML: unknown token"),
        (
            "<robot>\n  <link name=\"a\">\n</robot>\n",
            "arm.urdf:3: not XML: expected 'link' tag, not 'robot'",
        ),
        (
            "<robot>\n  <link name=\"a\" name=\"b\"/>\n</robot>\n",
            "arm.urdf:2: not XML: attribute 'name' is already defined",
        ),
        (
            "<!DOCTYPE a>\n<robot/>",
            "arm.urdf:1: not XML: XML with DTD detected",
        ),
        (
            "<?xml version=\"1.0\"?>\n<mujoco model=\"arm\"/>\n",
            "arm.urdf:2: <mujoco>: the outermost element; expected <robot>, as in URDF",
        ),
        (
            "<robot name=\"arm\"/>",
            "arm.urdf:1: <robot>: no links; expected at least two links and a joint between them",
        ),
        (
            "<robot name=\"arm\"><link name=\"a\"/></robot>",
            "case.toml:3: robot: robot 'arm' has no joints; it needs at least one",
        ),
    ] {
        assert_eq!(refusal(text), expected);
    }
    let folder = folder("", FILE, 2, "");
    std::fs::write(folder.path().join("arm.urdf"), [0x3c, 0xff]).unwrap();
    assert_eq!(
        complaint(&folder),
        "case.toml:3: robot: arm.urdf: cannot be read: it is not UTF-8 text; expected a robot \
         file, by a path relative to the problem file"
    );
}

#[test]
fn xacro_is_pointed_out() {
    let run_it = "expected URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf";
    let included = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
                    <xacro:include filename=\"a\"/>\n</robot>";
    assert_eq!(
        refusal(included),
        format!("arm.urdf:2: <xacro:include>; {run_it}")
    );
    assert_eq!(
        refusal("<robot>\n<xacro:arm/>\n</robot>"),
        format!("arm.urdf:2: not XML: an unknown namespace prefix 'xacro'; {run_it}")
    );
    assert_eq!(
        edit("0.5 0 0\"/>\n    <limit", "${length} 0 0\"/>\n    <limit"),
        "arm.urdf:28: joint 'boom' <origin> xyz: \"${length} 0 0\"; expected 3 finite lengths, m \
         (an expression of xacro's; run xacro on the file first)"
    );
    assert_eq!(
        complaint(&folder("", "\"arm.urdf.xacro\"", 2, "")),
        format!("case.toml:3: robot: \"arm.urdf.xacro\"; {run_it}")
    );
}

#[test]
fn file_that_is_not_there() {
    assert_eq!(
        complaint(&folder("", "\"none.urdf\"", 2, "")),
        "case.toml:3: robot: none.urdf: cannot be read: No such file or directory (os error 2); \
         expected a robot file, by a path relative to the problem file"
    );
    assert_eq!(
        complaint(&folder("", "\"arm.sdf\"", 2, "")),
        "case.toml:3: robot: \"arm.sdf\"; expected a file that ends in .toml or .urdf"
    );
}

// ---------------------------------------------------------------- what is refused: the tree

#[test]
fn joints_and_links_that_make_no_tree() {
    for (old, new, expected) in [
        (
            "<child link=\"lower\"/>",
            "<child link=\"lowr\"/>",
            "arm.urdf:27: joint 'boom' <child> link: \"lowr\"; expected the name of a link of this file",
        ),
        (
            "<parent link=\"upper\"/>",
            "<parent link=\"uper\"/>",
            "arm.urdf:26: joint 'boom' <parent> link: \"uper\"; expected the name of a link of this file",
        ),
        (
            "<child link=\"lower\"/>",
            "",
            "arm.urdf:25: joint 'boom' <child>: missing; expected the name of a link",
        ),
        (
            "<child link=\"tool0\"/>",
            "<child link=\"lower\"/>",
            "arm.urdf:52: joint 'tip': its child 'lower' is the child of joint 'boom' already; expected one parent a link: a tree",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"tool0\"/>\n  <link name=\"spare\"/>",
            "arm.urdf:58: link 'spare': a second root beside link 'hull' (no joint has it as its child); expected one root: a tree",
        ),
        (
            "<parent link=\"hull\"/>",
            "<parent link=\"tool0\"/>",
            "arm.urdf:17: link 'upper': on a loop of joints; expected a tree: joints that lead from one root link outwards",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"tool0\"/>\n  <joint name=\"back\" type=\"fixed\"><parent link=\"tool0\"/><child link=\"hull\"/></joint>",
            "arm.urdf:3: link 'hull': on a loop of joints; expected a tree: joints that lead from one root link outwards",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"adapter\"/>",
            "arm.urdf:57: link 'adapter': given twice; expected a name of its own",
        ),
        (
            "<joint name=\"tip\"",
            "<joint name=\"boom\"",
            "arm.urdf:52: joint 'boom': given twice; expected a name of its own",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link/>",
            "arm.urdf:57: <link> name: missing; expected a name that is not empty",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}

// ---------------------------------------------------------------- what is refused: joints

#[test]
fn joints_that_cannot_be_used() {
    const SHOULDER: &str = "<limit lower=\"-2.0\" upper=\"2.5\" velocity=\"1.5\" effort=\"30\"/>";
    for (old, new, expected) in [
        (
            "\"prismatic\"",
            "\"slider\"",
            "arm.urdf:25: joint 'boom' type: \"slider\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "\"prismatic\"",
            "\"planar\"",
            "arm.urdf:25: joint 'boom' type: \"planar\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "\"prismatic\"",
            "\"floating\"",
            "arm.urdf:25: joint 'boom' type: \"floating\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"; only the base may float, on a root link that has no mass and no other joint",
        ),
        (
            "name=\"boom\" type=\"prismatic\"",
            "name=\"boom\"",
            "arm.urdf:25: joint 'boom' type: missing; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 0\"/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: \"0 0 0\"; expected 3 finite numbers that are not all zero",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 1\"/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: \"0 1\"; expected 3 finite numbers that are not all zero",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: missing; expected 3 finite numbers that are not all zero",
        ),
        (
            "0.3 0 0.1",
            "0.3 0 O.1",
            "arm.urdf:13: joint 'shoulder' <origin> xyz: \"0.3 0 O.1\"; expected 3 finite lengths, m",
        ),
        (
            "rpy=\"0 0 0.5\"",
            "rpy=\"0 0 nan\"",
            "arm.urdf:13: joint 'shoulder' <origin> rpy: \"0 0 nan\"; expected 3 finite angles, rad",
        ),
        (
            "rpy=\"0 0 0.5\"",
            "quat_xyzw=\"0 0 0 1\"",
            "arm.urdf:13: joint 'shoulder' <origin> quat_xyzw: \"0 0 0 1\"; expected the orientation as rpy",
        ),
        (
            SHOULDER,
            "<limit lower=\"2\" upper=\"1\"/>",
            "arm.urdf:15: joint 'shoulder' <limit>: lower 2 above upper 1; expected lower not above upper",
        ),
        (
            SHOULDER,
            "<limit lower=\"1,5\" upper=\"2\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> lower: \"1,5\"; expected a number, rad or m",
        ),
        (
            SHOULDER,
            "<limit lower=\"NaN\" upper=\"2\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> lower: \"NaN\"; expected a number, rad or m",
        ),
        (
            SHOULDER,
            "<limit lower=\"1\" upper=\"2\"\n velocity=\"-1\"/>",
            "arm.urdf:16: joint 'shoulder' <limit> velocity: \"-1\"; expected a number of zero or above",
        ),
        (
            SHOULDER,
            "<limit effort=\"\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> effort: \"\"; expected a number of zero or above",
        ),
        (
            SHOULDER,
            "<limit/>\n<limit/>",
            "arm.urdf:16: joint 'shoulder' <limit>: given twice; expected one at most",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}

#[test]
fn floating_joints_that_are_not_that_of_the_base() {
    let massive = edited(
        FLOATING,
        "<link name=\"world\"/>",
        "<link name=\"world\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>",
    );
    let crowded = edited(
        FLOATING,
        "<link name=\"world\"/>",
        "<link name=\"world\"/><link name=\"sun\"/><joint name=\"s\" type=\"fixed\"><parent link=\"world\"/><child link=\"sun\"/></joint>",
    );
    for urdf in [massive, crowded] {
        let found = complaint(&folder(&urdf, FILE, 1, ""));
        assert!(
            found.starts_with("arm.urdf:5: joint 'free' type: \"floating\"; expected "),
            "{found}"
        );
    }
}

#[test]
fn joints_that_move_nothing() {
    let idle = |file: &str, line: usize, joint: &str, body: &str| {
        format!(
            "{file}:{line}: joint '{joint}' can move without moving any mass: too little mass or \
             inertia in body '{body}' and what it carries; expected bodies with mass, a fixed \
             joint, or this one in robot.lock"
        )
    };
    let sensor = edited(
        ARM,
        "<joint name=\"tip\" type=\"fixed\">",
        "<joint name=\"tip\" type=\"continuous\">",
    );
    assert_eq!(
        complaint(&folder(&sensor, FILE, 3, "")),
        idle("arm.urdf", 52, "tip", "tool0")
    );
    // Locked, it is fine.
    let robot = "{ file = \"arm.urdf\", lock = { tip = 0.0 } }";
    assert_eq!(
        load(&folder(&sensor, robot, 2, ""))
            .problem
            .robot
            .joint_count(),
        2
    );
    // Two massless links in a row about the same axis.
    let twice = edited(WRIST, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>");
    assert_eq!(
        complaint(&folder(&twice, FILE, 3, SPACECRAFT)),
        idle("arm.urdf", 10, "pitch", "pitch_link")
    );
    // A point mass on its own axis.
    let point = edited(EXPORTED, "<origin xyz=\"0 0 0.1\"/>", "");
    assert_eq!(
        complaint(&folder(&point, FILE, 3, "")),
        idle("arm.urdf", 54, "endless", "hand")
    );
}

// ---------------------------------------------------------------- what is refused: links

#[test]
fn masses_and_inertias() {
    const UPPER: &str =
        "<inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>";
    for (old, new, expected) in [
        (
            "<mass value=\"4\"/>",
            "<mass value=\"-4\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"-4\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"nan\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"nan\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"1e999\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"1e999\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass>4</mass>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: missing; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "",
            "arm.urdf:18: link 'upper' <inertial> <mass>: missing; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"0\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: mass is zero but inertia is not, expected both above zero or both zero",
        ),
        (
            UPPER,
            "",
            "arm.urdf:18: link 'upper' <inertial> <inertia>: missing; expected ixx, ixy, ixz, iyy, iyz and izz, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" iyy=\"0.09\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia> ixy: missing; expected a finite number, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"x\" ixy=\"0\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia> ixx: \"x\"; expected a finite number, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" ixy=\"0.05\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: inertia is not positive definite: its smallest principal moment is -6.032778e-3 kg m², expected above zero",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: inertia breaks the triangle inequality: principal moments 2.000000e-2, 2.000000e-2, 1.000000e-1 kg m², the largest may not exceed the sum of the others",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}

#[test]
fn base_without_mass() {
    assert_eq!(
        complaint(&folder(WRIST, FILE, 3, "")),
        "case.toml:3: robot: base 'hull' has no mass; the base needs mass, and inertia about every \
         axis; expected a heavier root link, or a spacecraft under it: [base] with mass and inertia"
    );
}

#[test]
fn pairs_on_links_that_have_become_part_of_others() {
    // The boom is locked: `lower`, `adapter` and `tool0` are part of `upper`.
    let robot = "{ file = \"arm.urdf\", lock = { boom = 0.3 } }";
    let pairs = "\n[[limits.keep_out]]\nname = \"tool\"\n\
         sphere = { body = \"tool0\", center = [0, 0, 0.2], radius = 0.1 }\n\
         from = { body = \"hull\", center = [0, 0, -1], radius = 0.2 }\n";
    let folder = folder(ARM, robot, 1, pairs);
    let file = load(&folder);
    let sphere = &file.problem.limits.keep_out[0].sphere;
    assert_eq!(sphere.joint, Some(0));
    // The tool's z axis is the arm's x axis.
    let expected = [0.5 + 0.3 + 0.4 + 0.1 + 0.2, 0.0, 0.0];
    assert_near(&Vector3::from(sphere.center), expected);
    let check = folder.run(&["check", "case.toml"]).stdout;
    assert!(check.contains("  end effector        tool0\n"), "{check}");
    let line =
        "    kept apart        tool: a sphere of 10 cm on upper from a sphere of 20 cm on hull";
    assert!(check.contains(line), "{check}");
    // Two links that are one body now cannot be kept apart.
    let same = edited(pairs, "\"hull\"", "\"lower\"");
    assert!(
        complaint(&self::folder(ARM, robot, 1, &same)).ends_with(
            "limits.keep_out[0].from.body: the same body; expected two different bodies"
        )
    );
    let unknown = edited(pairs, "\"tool0\"", "\"tool9\"");
    assert!(complaint(&self::folder(ARM, robot, 1, &unknown)).ends_with(
        "limits.keep_out[0].sphere.body: \"tool9\"; expected a body of the robot; did you \
             mean 'tool0'?"
    ));
}
