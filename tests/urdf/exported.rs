//! What real files contain.

use crate::program::edited;
use crate::robots::*;
use serde_json::Value;

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
    let robot = load(&folder).problem.into_builder().robot;
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
    let robot = load(&folder(GRIPPER, robot, 1, ""))
        .problem
        .into_builder()
        .robot;
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
