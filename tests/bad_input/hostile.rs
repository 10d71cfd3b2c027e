//! Files that mean harm, or came out of proportion.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM, edited};
use std::process::Command;

/// The complaint about a problem with the table `[solver]`.
fn solver(table: &str) -> String {
    complaint(
        &Folder::new(&format!("{PROBLEM}\n[solver]\n{table}\n")),
        &[],
    )
}

#[test]
fn options_that_load_code_or_touch_files_are_refused_from_files() {
    for (option, key, reach) in [
        (
            "options.hsllib = \"evil.so\"",
            "options.hsllib",
            "loads a library",
        ),
        (
            "options.HSLLIB = \"evil.so\"",
            "options.HSLLIB",
            "loads a library",
        ),
        (
            "options.pardisolib = \"evil.so\"",
            "options.pardisolib",
            "loads a library",
        ),
        (
            "options.\"resto.hsllib\" = \"e\"",
            "options.resto.hsllib",
            "loads a library",
        ),
        (
            "options.linear_solver = \"ma57\"",
            "options.linear_solver",
            "loads a library",
        ),
        (
            "linear_solver = \"ma27\"",
            "linear_solver",
            "loads a library",
        ),
        (
            "linear_solver = \"unheard-of\"",
            "linear_solver",
            "loads a library",
        ),
        (
            "options.output_file = \"x\"",
            "options.output_file",
            "reads or writes files",
        ),
        (
            "options.option_file_name = \"x\"",
            "options.option_file_name",
            "reads or writes files",
        ),
        (
            "options.print_options_documentation = true",
            "options.print_options_documentation",
            "is not known to do without libraries and files",
        ),
    ] {
        let found = solver(option);
        assert!(
            found.starts_with(&format!("case.toml:26: solver.{key}: ")),
            "{found}"
        );
        let end = format!(
            ", which {reach}; expected no such option in a file; --trust-options allows it, or \
             give it by --set"
        );
        assert!(found.ends_with(&end), "{found}");
    }
    // Those that steer the solve are nobody's harm.
    let harmless = format!("{PROBLEM}\n[solver]\noptions = {{ mu_strategy = \"monotone\" }}\n");
    let run = Folder::new(&harmless).run(&["plan", "case.toml", "--quiet"]);
    assert_eq!(run.code, 0, "{run:?}");
}

#[test]
fn the_user_may_set_any_option() {
    let folder = Folder::new(&format!(
        "{PROBLEM}\n[solver]\noptions.option_file_name = \"\"\n"
    ));
    let run = folder.run(&["plan", "case.toml", "--quiet", "--trust-options"]);
    assert_eq!(run.code, 0, "{run:?}");
    let folder = Folder::new(PROBLEM);
    let own = ["--set", "solver.options.option_file_name=''"];
    let run = folder.run(&[&["plan", "case.toml", "--quiet", "--out", "a"][..], &own].concat());
    assert_eq!(run.code, 0, "{run:?}");
    // What the user's own was once comes from a file now.
    let verify = ["verify", "a/solution.json", "--out", "b"];
    let run = folder.run(&verify);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(
        run.stderr.contains("solver.options.option_file_name"),
        "{run:?}"
    );
    let run = folder.run(&[&verify[..], &["--trust-options"]].concat());
    assert_eq!(run.code, 0, "{run:?}");
}

#[test]
fn only_regular_files_are_read() {
    let folder = Folder::new(PROBLEM);
    let pipe = folder.path().join("pipe.toml");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    std::fs::create_dir(folder.path().join("folder.toml")).unwrap();
    for (path, what) in [
        ("pipe.toml", "a pipe"),
        ("folder.toml", "a folder"),
        ("/dev/zero", "a device"),
    ] {
        let run = folder.run(&["plan", path]);
        assert_eq!(
            (run.code, run.stderr),
            (
                2,
                format!(
                    "{path}: cannot be read: it is {what}, not a regular file; expected a problem \
                     file\n"
                )
            )
        );
        let run = folder.run(&["plan", "case.toml", "--warm-start", path]);
        assert_eq!(run.code, 2);
        assert!(run.stderr.contains(&format!("it is {what}")), "{run:?}");
    }
    let large = std::fs::File::create(folder.path().join("case.toml")).unwrap();
    large.set_len(1 << 40).unwrap();
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml: cannot be read: it is larger than 32 MiB; expected a problem file"
    );
}

#[test]
fn large_files_are_read_in_a_moment_and_not_by_the_square() {
    // A hundred thousand of each took minutes when every one looked through all before it.
    let many = |one: &str| one.repeat(100_000);
    let folder = Folder::new(&edited(
        PROBLEM,
        "joint_rate = 0.2",
        &format!("joint_rate = [{}0.0]", many("0.0,\n")),
    ));
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml:17: cost.joint_rate: 100001 values; expected 2, one a joint: shoulder, elbow"
    );
    let key = format!("{} = 1\n", "k".repeat(1_000_000));
    let folder = Folder::new(&edited(PROBLEM, "[cost]", &format!("[cost]\n{key}")));
    let found = complaint(&folder, &[]);
    assert!(
        found.len() < 2000 && found.contains("unknown key"),
        "{}",
        found.len()
    );
}

/// The complaint about a URDF.
fn urdf(text: &str) -> String {
    let folder = Folder::new(&edited(PROBLEM, "robot.toml", "arm.urdf"));
    folder.write("arm.urdf", text);
    complaint(&folder, &[])
}

#[test]
fn robots_out_of_proportion() {
    let spaces: String = (0..65_000)
        .map(|i| format!(" xmlns:n{i}=\"u{i}\""))
        .collect();
    let found = urdf(&format!("<robot{spaces}/>"));
    assert_eq!(found, "arm.urdf:1: more than 100 name spaces");
    let attributes: String = (0..65_000).map(|i| format!(" a{i} = 'u'")).collect();
    let found = urdf(&format!("<robot\n{attributes}/>"));
    assert_eq!(
        found,
        "arm.urdf:2: an element with more than 200 attributes"
    );
    let found = urdf(&format!("<robot>\n{}", "<a>".repeat(1_000_000)));
    assert_eq!(
        found,
        "arm.urdf:2: more than 200 elements within each other"
    );
    // Rules drawn in comments are none of these.
    let found = urdf(&format!("<!-- {} <a> -->\n<arm/>", "=".repeat(500)));
    assert!(found.contains("the outermost element"), "{found}");

    let body = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' \
                iyz='0'/></inertial>";
    let chain = |kind: &str, count: usize| {
        let joints: String = (0..count)
            .map(|i| {
                format!(
                    "<link name='l{}'>{body}</link><joint name='j{i}' type='{kind}'><parent \
                     link='l{i}'/><child link='l{}'/><axis xyz='0 0 1'/></joint>\n",
                    i + 1,
                    i + 1
                )
            })
            .collect();
        format!("<robot name='r'><link name='l0'>{body}</link>{joints}</robot>")
    };
    let found = urdf(&chain("fixed", 100_000));
    assert!(found.contains("has no joints"), "{found}");
    let found = urdf(&chain("continuous", 501));
    assert_eq!(
        found,
        "case.toml:3: robot: 501 joints that move; expected at most 500"
    );
}

#[test]
fn magnitudes_that_cannot_be() {
    for (old, new, expected) in [
        (
            "mass = 1.20, com = [0.35, 0.0, 0.0]",
            "mass = 1.20, com = [0.35, 0.0, 1e20]",
            "joints[1].body.com: a mass centre with a coordinate of 1e20 m",
        ),
        (
            "mass = 15.20",
            "mass = 1e20",
            "base.mass: a mass of 1e20 kg, expected at most 1e15 kg",
        ),
        (
            "inertia = 0.1454",
            "inertia = 1e200",
            "base.inertia: 1e200; expected",
        ),
        (
            "[0.506, 0.0, 0.0] }        # a_1",
            "[1e12, 0.0, 0.0] } #",
            "joints[1].origin.xyz: ",
        ),
    ] {
        let found = robot(old, new);
        assert!(found.contains(expected), "{found}");
    }
    for (assignment, expected) in [
        ("task.duration=1e300", "task.duration: 1e300; expected"),
        (
            "task.duration=1e-300",
            "task.duration: 1e-300 to 1e-300 s; expected a duration from 1e-9 to 1e12 s",
        ),
        (
            "task.initial.joints=[1e20, 0]",
            "task.initial.joints[0]: 1e20; expected a number of a magnitude up to 1e9",
        ),
        ("cost.joint_rate=1e31", "cost.joint_rate: 1e31; expected"),
        (
            "limits.control=1e300",
            "limits.control[0]: -1e300; expected bounds of a magnitude up to 1e18, or inf for none",
        ),
        (
            "mesh.segments=100000",
            "mesh.segments: 100000 of 5 points; expected at most 50000 points in all segments together",
        ),
    ] {
        let found = set(assignment);
        assert!(found.starts_with(expected), "{found}");
    }
}

/// A mass centre beyond the moon: no planner calls it solved.
#[test]
fn an_overflow_is_no_plan() {
    let robot = "schema = 1\nname = \"r\"\n[base]\nmass = 50.0\ninertia = 2.0\n[[joints]]\n\
        name = \"a\"\ntype = \"revolute\"\nbody = { mass = 1.0, com = [0.2, 0.0, 1e150], \
        inertia = 0.02 }\n";
    let folder = Folder::new(
        &PROBLEM
            .replace("[0.0, 0.0]", "[0.0]")
            .replace("[0.5, 1.0]", "[0.5]")
            .replace("[5.0, 4.0]", "5.0"),
    );
    folder.write("robot.toml", robot);
    for method in [
        "straight-line",
        "matpm",
        "a-rpm",
        "reaction-null-space",
        "acceleration-qp",
    ] {
        let found = complaint(&folder, &["--method", method]);
        assert!(
            found.starts_with("robot.toml:9: joints[0].body.com[2]: 1e150; "),
            "{found}"
        );
    }
}

#[test]
fn one_rule_for_names_wherever_they_come_from() {
    let folder = Folder::new(PROBLEM);
    let unnamed = edited(PROBLEM, "name = \"case\"\n", "");
    folder.write("...toml", &unnamed);
    let run = folder.run(&["plan", "...toml", "--quiet"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(
        run.stderr,
        "...toml: name: not given, and that of the file is \"..\"; expected at most 120 bytes of \
         letters, digits, '-', '_', '.' and spaces between them, for it names the output folder\n"
    );
    folder.write("a$(b).toml", &unnamed);
    let run = folder.run(&["plan", "a$(b).toml", "--quiet"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(folder.path().join("out/a--b-/solution.json").exists());
    let long = format!("name = \"{}\"", "n".repeat(300));
    let found = problem("name = \"case\"", &long);
    assert!(found.starts_with("case.toml:2: name: \"nnn"), "{found}");
}

#[test]
fn nothing_from_a_file_steers_the_terminal() {
    let folder = Folder::new(PROBLEM);
    let robot = ROBOT.replace("shoulder", "\\u001b[31mshoulder\\u009b2J");
    folder.write("robot.toml", &robot);
    let steers = |text: &str| text.chars().any(|c| c.is_control() && c != '\n');
    for arguments in [
        &["check", "case.toml"][..],
        &["plan", "case.toml", "--out", "o"],
        &["plan", "case.toml", "--json", "--out", "o"],
        &["plan", "case.toml", "--set", "limits.control={x=1}"],
        &["compare", "case.toml", "--out", "c"],
    ] {
        let run = folder.run(arguments);
        assert!(!steers(&run.stdout) && !steers(&run.stderr), "{run:?}");
    }
    let page = folder.read("o/report.html");
    assert!(
        !steers(&page.replace('\t', "")) && page.contains("\\u001b[31m"),
        "page"
    );
    assert!(!steers(&folder.read("c/compare.svg")));
}

#[test]
fn counts_in_a_solution_are_checked_before_they_are_used() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--quiet", "--out", "o"]);
    assert_eq!(run.code, 0, "{run:?}");
    let text = folder.read("o/solution.json");
    let begin = text.find("\"points_per_segment\": [").unwrap() + 23;
    let end = begin + text[begin..].find([',', ']']).unwrap();
    let damage = |number: &str| {
        folder.write(
            "d.json",
            &format!("{}{number}{}", &text[..begin], &text[end..]),
        );
        let run = folder.run(&["verify", "d.json"]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run:?}");
        run.stderr
    };
    assert_eq!(
        damage("9000000000000000"),
        "d.json: mesh: a segment of 9000000000000000 collocation points; expected at most 1000\n"
    );
    assert!(damage("900").contains("d.json: points: "));
    folder.write("n.json", &edited_objective(&text));
    let run = folder.run(&["report", "n.json"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(
        run.stderr
            .starts_with("n.json: objective: null, and yet the status is \"solved\""),
        "{run:?}"
    );
}

/// A solved plan whose cost is no number.
fn edited_objective(text: &str) -> String {
    let line = text
        .lines()
        .find(|line| line.starts_with("  \"objective\":"))
        .unwrap();
    text.replacen(line, "  \"objective\": null,", 1)
}
