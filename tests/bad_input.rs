//! Bad input ends with status 2 and one line that names file, line, key and what was expected.

mod program;

use program::{Folder, PROBLEM};

const ROBOT: &str = include_str!("../config/robots/planar-2link.toml");

/// The text with `old` replaced, which must be there once.
fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} in the text");
    text.replace(old, new)
}

/// Runs `plan` with more arguments; the one line of its complaint.
#[track_caller]
fn complaint(folder: &Folder, arguments: &[&str]) -> String {
    let before = folder.names();
    let run = folder.run(&[&["plan", "case.toml"], arguments].concat());
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(run.stdout, "", "nothing on standard output");
    assert_eq!(run.stderr.lines().count(), 1, "one line: {}", run.stderr);
    assert_eq!(folder.names(), before, "nothing written");
    run.stderr.trim_end().to_owned()
}

/// The complaint about the problem with `old` replaced by `new`.
#[track_caller]
fn problem(old: &str, new: &str) -> String {
    complaint(&Folder::new(&edited(PROBLEM, old, new)), &[])
}

/// The complaint about the robot with `old` replaced by `new`.
#[track_caller]
fn robot(old: &str, new: &str) -> String {
    let folder = Folder::new(PROBLEM);
    folder.write("robot.toml", &edited(ROBOT, old, new));
    complaint(&folder, &[])
}

/// The complaint about a value given by `--set`.
#[track_caller]
fn set(assignment: &str) -> String {
    let complaint = complaint(&Folder::new(PROBLEM), &["--set", assignment]);
    let prefix = format!("--set {assignment}: ");
    assert!(complaint.starts_with(&prefix), "{complaint}");
    complaint[prefix.len()..].to_owned()
}

// ---------------------------------------------------------------- files

#[test]
fn missing_problem_file() {
    let run = Folder::new(PROBLEM).run(&["plan", "none.toml"]);
    assert_eq!(run.code, 2);
    assert_eq!(
        run.stderr,
        "none.toml: cannot be read: No such file or directory (os error 2); expected a problem file\n"
    );
}

#[test]
fn problem_file_that_is_no_text() {
    let folder = Folder::new(PROBLEM);
    std::fs::write(folder.path().join("case.toml"), [0xff, 0xfe, 0x00]).unwrap();
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml: cannot be read: it is not UTF-8 text; expected a problem file"
    );
}

#[test]
fn missing_robot_file() {
    assert_eq!(
        problem("\"robot.toml\"", "\"arm.toml\""),
        "case.toml:3: robot: arm.toml: cannot be read: No such file or directory (os error 2); \
         expected a robot file, by a path relative to the problem file"
    );
}

#[test]
fn toml_syntax() {
    let found = problem("duration = 20.0", "duration = = 20.0");
    assert!(found.starts_with("case.toml:6: not TOML: "), "{found}");
}

#[test]
fn key_given_twice() {
    let found = problem("duration = 20.0", "duration = 20.0\nduration = 21.0");
    assert_eq!(found, "case.toml:7: not TOML: duplicate key");
}

#[test]
fn folder_that_cannot_be_written() {
    let folder = Folder::new(PROBLEM);
    folder.write("blocked", "a file");
    assert_eq!(
        complaint(&folder, &["--out", "blocked/out"]),
        "blocked/out: the output folder cannot be written: Not a directory (os error 20); \
         expected a folder that can, see --out"
    );
}

#[test]
fn warm_start_that_is_no_solution() {
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        complaint(&folder, &["--warm-start", "none.json"]),
        "none.json: cannot be read: No such file or directory (os error 2); expected a solution.json"
    );
    folder.write("solution.json", "{ \"schema\": 1, \"name\": 3 }");
    let found = complaint(&folder, &["--warm-start", "solution.json"]);
    assert!(
        found.starts_with("solution.json: name: invalid type: integer `3`"),
        "{found}"
    );
    assert!(
        found.ends_with("expected a solution.json of schema 1"),
        "{found}"
    );
}

// ---------------------------------------------------------------- keys

#[test]
fn unknown_key_with_its_nearest() {
    assert_eq!(
        problem("joint_velocity", "joint_velocty"),
        "case.toml:12: limits.joint_velocty: unknown key; did you mean 'joint_velocity'?"
    );
}

#[test]
fn unknown_key_with_none_near() {
    assert_eq!(
        problem("[cost]", "[objective]"),
        "case.toml:15: objective: unknown key; expected one of schema, name, robot, base, task, \
         limits, cost, mesh, solver"
    );
}

#[test]
fn missing_keys() {
    for (line, key, expected) in [
        ("schema = 1", "schema", "schema = 1"),
        (
            "robot = \"robot.toml\"",
            "robot",
            "the path of a robot file, relative to this one",
        ),
    ] {
        assert_eq!(
            problem(line, ""),
            format!("case.toml: {key}: missing; expected {expected}")
        );
    }
    assert_eq!(
        problem("final.joints = [0.5, 1.0]", ""),
        "case.toml:5: task.final: missing; expected a table with joints, the joint positions at the end, or end_effector"
    );
    assert_eq!(
        problem("duration = 20.0", ""),
        "case.toml:5: task.duration: missing; expected a finite duration above zero, s, or { min = …, max = … }"
    );
}

#[test]
fn other_schema() {
    assert_eq!(
        problem("schema = 1", "schema = 2"),
        "case.toml:1: schema: 2; expected 1, the only schema this version reads"
    );
}

#[test]
fn name_that_leaves_the_output_folder() {
    assert_eq!(
        problem("\"case\"", "\"../case\""),
        "case.toml:2: name: \"../case\"; expected letters, digits, '-', '_' and '.', for it names \
         the output folder"
    );
}

// ---------------------------------------------------------------- types and numbers

#[test]
fn wrong_types() {
    for (old, new, line, expected) in [
        (
            "0.9",
            "\"0.9\"",
            12,
            "limits.joint_velocity: a string (\"0.9\"); expected a number, [lo, hi], or one of those a joint",
        ),
        (
            "20.0",
            "true",
            6,
            "task.duration: true; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "[0.5, 1.0]",
            "1.0",
            8,
            "task.final.joints: 1.0; expected an array of 2, one a joint: shoulder, elbow",
        ),
        (
            "segments = 4",
            "segments = 4.0",
            21,
            "mesh.segments: 4.0; expected a whole number from 1 to 100000",
        ),
        (
            "1e-3",
            "2024-01-01",
            23,
            "mesh.tolerance: a date; expected a finite number above zero",
        ),
        (
            "\"robot.toml\"",
            "3",
            3,
            "robot: 3; expected the path of a robot file, or a table with the keys file, lock and end_effector",
        ),
        (
            "joint_rate = 0.2",
            "joint_rate = []",
            17,
            "cost.joint_rate: 0 values; expected 2, one a joint: shoulder, elbow",
        ),
    ] {
        assert_eq!(problem(old, new), format!("case.toml:{line}: {expected}"));
    }
}

#[test]
fn nan_is_never_a_value() {
    for (assignment, expected) in [
        (
            "task.duration=nan",
            "task.duration: nan; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "limits.control=nan",
            "limits.control: nan; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.control=[-1.0, nan]",
            "limits.control: [-1.0, nan]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.control=[nan, nan]",
            "limits.control[0]: nan; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "cost.joint_rate=nan",
            "cost.joint_rate: nan; expected a finite weight, zero or above",
        ),
        (
            "task.final.joints=[nan, 0]",
            "task.final.joints[0]: nan; expected a finite number",
        ),
        (
            "mesh.tolerance=nan",
            "mesh.tolerance: nan; expected a finite number above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn infinity_is_for_limits_only() {
    for (assignment, expected) in [
        (
            "task.duration=inf",
            "task.duration: inf; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration={min=1.0,max=inf}",
            "task.duration.max: inf; expected a finite duration above zero, s",
        ),
        (
            "cost.control=inf",
            "cost.control: inf; expected a finite weight, zero or above",
        ),
        (
            "task.initial.joints=[inf, 0]",
            "task.initial.joints[0]: inf; expected a finite number",
        ),
        (
            "limits.control=-inf",
            "limits.control: -inf; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.base_rate=[inf, inf]",
            "limits.base_rate: [inf, inf]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn negative_and_zero() {
    for (assignment, expected) in [
        (
            "mesh.segments=0",
            "mesh.segments: 0; expected a whole number from 1 to 100000",
        ),
        (
            "mesh.points=0",
            "mesh.points: 0; expected a whole number from 1 to 1000",
        ),
        (
            "mesh.points=-1",
            "mesh.points: -1; expected a whole number from 1 to 1000",
        ),
        (
            "mesh.max_iterations=0",
            "mesh.max_iterations: 0; expected a whole number from 1 to 100000",
        ),
        (
            "mesh.tolerance=-1e-5",
            "mesh.tolerance: -1e-5; expected a finite number above zero",
        ),
        (
            "task.duration=-20",
            "task.duration: -20; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration=0",
            "task.duration: 0; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration={min=5,max=2}",
            "task.duration: min 5 above max 2; expected min not above max",
        ),
        (
            "cost.joint_rate=-0.2",
            "cost.joint_rate: -0.2; expected a finite weight, zero or above",
        ),
        (
            "solver.tolerance=0",
            "solver.tolerance: 0; expected a finite number above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        complaint(&folder, &["--tolerance", "-1"]),
        "--tolerance -1.0: mesh.tolerance: -1.0; expected a finite number above zero"
    );
}

// ---------------------------------------------------------------- limits, start and goal

#[test]
fn limit_the_wrong_way_round() {
    for (assignment, expected) in [
        (
            "limits.joint_velocity=[0.9, -0.9]",
            "limits.joint_velocity: [0.9, -0.9]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.control=[[1.0, -1.0], 2.0]",
            "limits.control[0]: [1.0, -1.0]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.joint_position=-1.5",
            "limits.joint_position: -1.5; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.base_attitude=[0.2, 0.1]",
            "limits.base_attitude: [0.2, 0.1]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn limit_that_may_be_read_two_ways() {
    assert_eq!(
        set("limits.joint_position=[0.5, 1.5]"),
        "limits.joint_position: [0.5, 1.5] may be read two ways; expected [[0.5, 1.5], [0.5, 1.5]] \
         for one range or [[-0.5, 0.5], [-1.5, 1.5]] for a bound each"
    );
}

#[test]
fn start_and_goal_outside_their_limits() {
    assert_eq!(
        problem("[0.0, 0.0]", "[0.0, -2.0]"),
        "case.toml:7: task.initial.joints[1]: -2 rad for joint 'elbow'; expected a value within \
         limits.joint_position, [-1.5, 1.5]"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "[1.6, 1.0]"),
        "case.toml:8: task.final.joints[0]: 1.6 rad for joint 'shoulder'; expected a value within \
         limits.joint_position, [-1.5, 1.5]"
    );
    assert_eq!(
        set("limits.base_attitude=[0.1, 0.2]"),
        "limits.base_attitude: [0.1, 0.2]; expected a range around 0, the attitude at the start"
    );
}

#[test]
fn wrong_number_of_joints() {
    assert_eq!(
        problem("[0.5, 1.0]", "[0.5, 1.0, 0.0]"),
        "case.toml:8: task.final.joints: 3 values; expected 2, one a joint: shoulder, elbow"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "{ shoulder = 0.5 }"),
        "case.toml:8: task.final.joints.elbow: missing; expected a finite number"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "{ shoulder = 0.5, elbwo = 1.0 }"),
        "case.toml:8: task.final.joints.elbwo: unknown key; did you mean 'elbow'?"
    );
    assert_eq!(
        problem("[5.0, 4.0]", "[5.0, 4.0, 3.0]"),
        "case.toml:13: limits.control: 3 values; expected 2, one a joint: shoulder, elbow"
    );
}

#[test]
fn rate_matrix_of_the_wrong_size() {
    assert_eq!(
        set("cost.rate_matrix=[[1, 0], [0, 1]]"),
        "cost.rate_matrix: 2 values; expected 3, the number of rows, one a base angle and joint"
    );
}

#[test]
fn options_that_ipopt_refuses() {
    let folder = Folder::new(&format!(
        "{PROBLEM}\n[solver]\noptions = {{ no_such_option = 3 }}\n"
    ));
    let run = folder.run(&["plan", "case.toml"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(
        run.stderr,
        "case.toml:26: solver.options.no_such_option: 3; expected an option and value that this Ipopt knows\n"
    );
}

// ---------------------------------------------------------------- the robot

#[test]
fn masses_and_inertias() {
    for (old, new, line, expected) in [
        (
            "mass = 15.20",
            "mass = 0.0",
            11,
            "base.mass: 0.0; expected a finite mass above zero, kg",
        ),
        (
            "mass = 1.70",
            "mass = -1.70",
            18,
            "joints[0].body.mass: -1.7; expected a finite mass above zero, kg",
        ),
        (
            "mass = 1.20",
            "mass = nan",
            24,
            "joints[1].body.mass: nan; expected a finite mass above zero, kg",
        ),
        (
            "inertia = 0.1454",
            "inertia = [0.1, 0.1]",
            12,
            "base.inertia: an array of 2 values; expected a number, [Ixx, Iyy, Izz] or a 3×3 matrix about the mass centre, kg m²",
        ),
        (
            "inertia = 0.1454",
            "inertia = -1",
            12,
            "base.inertia: inertia is not positive definite: its smallest principal moment is -1.000000e0 kg m², expected above zero",
        ),
        (
            "inertia = 0.1454",
            "inertia = [[1, 0, 0], [0, 1, 0.5], [0, 0, 1]]",
            12,
            "base.inertia: inertia is not symmetric: element (2, 3) and its mirror differ by 5.000e-1 kg m²",
        ),
        (
            "inertia = 0.1454",
            "inertia = [1.0, 1.0, 3.0]",
            12,
            "base.inertia: inertia breaks the triangle inequality: principal moments 1.000000e0, 1.000000e0, 3.000000e0 kg m², the largest may not exceed the sum of the others",
        ),
    ] {
        assert_eq!(robot(old, new), format!("robot.toml:{line}: {expected}"));
    }
}

#[test]
fn spacecraft_without_mass() {
    let folder = Folder::new(&format!("{PROBLEM}\n[base]\nmass = 0\ninertia = 1.0\n"));
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml:26: base.mass: 0; expected a finite mass above zero, kg"
    );
}

#[test]
fn joints_that_make_no_robot() {
    for (old, new, line, expected) in [
        (
            "name = \"elbow\"",
            "name = \"shoulder\"",
            21,
            "joints[1].name: \"shoulder\" is given twice; expected a name of its own",
        ),
        (
            "name = \"forearm\"",
            "name = \"upper_arm\"",
            24,
            "joints[1].body.name: \"upper_arm\" is given twice; expected a name of its own",
        ),
        (
            "parent = \"forearm\"",
            "parent = \"hand\"",
            27,
            "end_effector.parent: \"hand\"; expected a body or joint of the robot: base, upper_arm, forearm, listed before this",
        ),
        (
            "[0.506, 0.0, 0.0] }        # a_1",
            "[0.506, 0.0] }        # a_1",
            23,
            "joints[1].origin.xyz: an array of 2 values; expected an array of 3 lengths, m",
        ),
        (
            "origin = { xyz = [0.156, 0.0, 0.0] }",
            "axis = [0, 0, 0]",
            17,
            "joints[0].axis: 0, 0, 0; expected an array of 3 numbers that are not all zero",
        ),
        (
            "origin = { xyz = [0.156, 0.0, 0.0] }",
            "limits = { speed = 1.0 }",
            17,
            "joints[0].limits.speed: unknown key; expected one of position, velocity, effort",
        ),
    ] {
        assert_eq!(robot(old, new), format!("robot.toml:{line}: {expected}"));
    }
}

#[test]
fn locked_joints_and_end_effectors_that_are_not_there() {
    for (robot, expected) in [
        (
            "{ file = \"robot.toml\", lock = { wrist = 0.0 } }",
            "robot.lock.wrist: unknown key; expected one of shoulder, elbow",
        ),
        (
            "{ file = \"robot.toml\", lock = { elbow = inf } }",
            "robot.lock.elbow: inf; expected the finite position the joint is locked at, rad or m",
        ),
        (
            "{ file = \"robot.toml\", lock = { shoulder = 0.0, elbow = 0.0 } }",
            "robot.lock: robot 'planar-2link' has no joints; it needs at least one",
        ),
        (
            "{ file = \"robot.toml\", end_effector = \"tool0\" }",
            "robot.end_effector: \"tool0\"; expected a body or joint of the robot: base, upper_arm, forearm",
        ),
        (
            "{ lock = {} }",
            "robot.file: missing; expected the path of a robot file",
        ),
    ] {
        assert_eq!(
            problem("\"robot.toml\"", robot),
            format!("case.toml:3: {expected}")
        );
    }
}

// ---------------------------------------------------------------- the command line

#[test]
fn assignments_that_set_nothing() {
    for (assignment, expected) in [
        ("mesh.points", "no '='; expected --set key.path=value"),
        (
            "=3",
            "a part of the key is empty; expected --set key.path=value",
        ),
        (
            "task.duration.min.x=3",
            "task.duration: 20.0; expected a table, so that a key in it can be set",
        ),
        (
            "mesh.point=3",
            "mesh.point: unknown key; did you mean 'points'?",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn bad_usage() {
    let folder = Folder::new(PROBLEM);
    for arguments in [
        &["plan"][..],
        &["nonsense"],
        &["plan", "case.toml", "--method", "x"],
        &["table2", "--repeat", "0"],
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(run.stdout, "");
    }
    assert_eq!(folder.names(), ["case.toml", "robot.toml"]);
}

// ---------------------------------------------------------------- base attitude

/// The complaint about a robot in space with lines of `[base]` and `[limits]` or `[cost]` added.
#[track_caller]
fn in_space(base: &str, table: &str, line: &str) -> String {
    let table = format!("[{table}]");
    let text = edited(
        PROBLEM,
        &table,
        &format!("[base]\n{base}\n\n{table}\n{line}"),
    );
    let folder = Folder::new(&text.replace("final_base_attitude = 1.0\n", ""));
    // A mass centre off the plane of the others.
    let robot = edited(ROBOT, "com = [0.35, 0.0, 0.0]", "com = [0.35, 0.0, 0.02]");
    folder.write("robot.toml", &robot);
    complaint(&folder, &[])
}

#[test]
fn unknown_description_of_the_attitude() {
    assert_eq!(
        in_space("attitude = \"quaternions\"", "limits", ""),
        "case.toml:11: base.attitude: \"quaternions\"; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\" (did you mean 'quaternion'?)"
    );
    assert_eq!(
        in_space("attitude = \"euler\"", "limits", ""),
        "case.toml:11: base.attitude: \"euler\"; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\""
    );
    assert_eq!(
        in_space("attitude = 4", "limits", ""),
        "case.toml:11: base.attitude: 4; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\""
    );
}

#[test]
fn a_base_without_a_mass_has_to_say_something() {
    assert_eq!(
        in_space("", "limits", ""),
        "case.toml:10: base.mass: missing; expected a finite mass above zero, kg"
    );
    assert_eq!(
        in_space("attitude = \"mrp\"\ninertia = 3.0", "limits", ""),
        "case.toml:10: base.mass: missing; expected a finite mass above zero, kg"
    );
}

#[test]
fn a_rotation_angle_takes_one_number() {
    for by in ["quaternion", "mrp"] {
        let base = format!("attitude = \"{by}\"");
        for (table, line) in [
            ("limits", "base_attitude = [0.1, 0.2, 0.3]"),
            ("limits", "base_attitude = [-0.1, 0.2]"),
            ("limits", "final_base_attitude = { pitch = 0.2 }"),
            ("cost", "final_base_attitude = [1.0, 1.0, 0.0]"),
        ] {
            let complaint = in_space(&base, table, line);
            let key = format!("{table}.{}", line.split(' ').next().unwrap());
            assert!(complaint.contains(&key), "{complaint}");
            let expected = "; expected one number, for the rotation angle of the base: base.attitude has no roll, pitch or yaw";
            assert!(complaint.ends_with(expected), "{complaint}");
        }
        let complaint = in_space(&base, "limits", "base_rate = { roll = 0.1 }");
        assert!(
            complaint.contains("limits.base_rate.roll: unknown key"),
            "{complaint}"
        );
        let complaint = in_space(&base, "limits", "base_attitude = -0.1");
        assert!(
            complaint.contains("a bound of zero or above"),
            "{complaint}"
        );
    }
}

// ---------------------------------------------------------------- way-points

/// The complaint about the problem with these `[[task.way_points]]`.
#[track_caller]
fn way_points(points: &[&str], duration: &str) -> String {
    let points: String = points
        .iter()
        .map(|point| format!("[[task.way_points]]\n{point}\n\n"))
        .collect();
    let text = edited(PROBLEM, "[limits]\n", &format!("{points}[limits]\n"));
    let text = edited(&text, "duration = 20.0", duration);
    complaint(&Folder::new(&text), &[])
}

#[test]
fn way_points_that_cannot_be() {
    const FIXED: &str = "duration = 20.0";
    let joints = "joints = [0.1, 0.2]";
    for (points, expected) in [
        (
            vec![format!("time = 20.0\n{joints}")],
            "case.toml:11: task.way_points[0].time: 20 s; expected a time above 0 and below the \
             duration, 20 s",
        ),
        (
            vec![format!("time = -1.0\n{joints}")],
            "case.toml:11: task.way_points[0].time: -1 s; expected a time above 0 and below the \
             duration, 20 s",
        ),
        (
            vec![format!("fraction = 1.5\n{joints}")],
            "case.toml:11: task.way_points[0].fraction: 1.5; expected a fraction of the duration, \
             above 0 and below 1",
        ),
        (
            vec![
                format!("time = 5.0\n{joints}"),
                format!("fraction = 0.25\n{joints}"),
            ],
            "case.toml:15: task.way_points[1].fraction: 0.25; expected way-points in the order of \
             time, no two at one time",
        ),
        (
            vec![
                format!("time = 5.0\n{joints}"),
                format!("time = 4.0\n{joints}"),
            ],
            "case.toml:15: task.way_points[1].time: 4 s; expected way-points in the order of \
             time, no two at one time",
        ),
        (
            vec![format!("time = 5.0\nfraction = 0.25\n{joints}")],
            "case.toml:12: task.way_points[0].fraction: time as well; expected either time, s, or \
             fraction",
        ),
        (
            vec![joints.into()],
            "case.toml:10: task.way_points[0].time: missing; expected a time, s, or fraction, \
             that of the duration",
        ),
        (
            vec!["time = 5.0".into()],
            "case.toml:10: task.way_points[0]: nothing to hold there; expected joints, \
             joint_rates, end_effector or several of them",
        ),
        (
            vec!["time = 5.0\njoints = { elbow = 1.6 }".into()],
            "case.toml:12: task.way_points[0].joints[1]: 1.6 for joint 'elbow'; expected a value \
             within limits.joint_position, [-1.5, 1.5]",
        ),
        (
            vec!["time = 5.0\njoint_rates = 1.0".into()],
            "case.toml:12: task.way_points[0].joint_rates[0]: 1 for joint 'shoulder'; expected a \
             value within limits.joint_velocity, [-0.9, 0.9]",
        ),
        (
            vec!["time = 5.0\njoints = [0.1]".into()],
            "case.toml:12: task.way_points[0].joints: 1 value; expected 2, one a joint: shoulder, \
             elbow",
        ),
        (
            vec!["time = 5.0\njoints = { elbo = 0.1 }".into()],
            "case.toml:12: task.way_points[0].joints.elbo: unknown key; did you mean 'elbow'?",
        ),
        (
            vec!["time = 5.0\nend_effector = { frame = \"base\" }".into()],
            "case.toml:12: task.way_points[0].end_effector: neither; expected a position, an \
             orientation or both",
        ),
    ] {
        let points: Vec<&str> = points.iter().map(String::as_str).collect();
        assert_eq!(way_points(&points, FIXED), expected);
    }
    assert_eq!(
        way_points(
            &["time = 5.0\njoints = [0.1, 0.2]"],
            "duration = { min = 5.0, max = 30.0 }"
        ),
        "case.toml:11: task.way_points[0].time: 5 s, where the duration is free; expected \
         fraction, the fraction of the duration"
    );
}
