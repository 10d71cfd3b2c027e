//! `report`, and the page that `plan` writes.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

/// What the playback of a page is drawn from.
fn scene(page: &str) -> Value {
    let begin = "<script id=\"scene\" type=\"application/json\">";
    let (_, rest) = page.split_once(begin).expect("a scene");
    let (json, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(json).expect("valid JSON")
}

fn last(values: &Value) -> f64 {
    values.as_array().unwrap().last().unwrap().as_f64().unwrap()
}

#[test]
fn a_page_is_made_again_from_the_solution_alone() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    assert!(run.stdout.contains("o/report.html"), "{}", run.stdout);
    let page = folder.read("o/report.html");
    std::fs::remove_file(folder.path().join("case.toml")).unwrap();
    std::fs::remove_file(folder.path().join("robot.toml")).unwrap();
    let run = folder.run(&["report", "o/solution.json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    assert!(folder.read("o/report.html") == page, "another page");
    let run = folder.run(&["report", "o/solution.json", "--out", "a/b.html"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    assert!(folder.read("a/b.html") == page, "another page");
}

#[test]
fn a_page_needs_nothing_else_and_says_what_is_in_the_solution() {
    let folder = Folder::new(PROBLEM);
    folder.run(&["plan", "case.toml", "--out", "o"]);
    let page = folder.read("o/report.html");
    for outside in ["src=", "href=", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    for expected in [
        format!("{:.9}", solution["objective"].as_f64().unwrap()),
        "solved".into(),
        "within the tolerance 1e-3".into(),
        "limit ±85.944°".into(),
        "limit ±51.566°/s".into(),
        "shares no code".into(),
        "limits, each in its colour".into(),
        "Acceleration (deg/s²)".into(),
        "Collisions are not checked".into(),
        solution["provenance"]["robot_sha256"]
            .as_str()
            .unwrap()
            .into(),
    ] {
        assert!(page.contains(&expected), "{expected}");
    }
    assert_eq!(page.matches("<svg xmlns").count(), 9, "charts");
}

#[test]
fn what_is_played_is_the_plan_and_the_straight_joint_path() {
    let goal = "[0.5235987755982988, 1.0471975511965976]";
    let folder = Folder::new(&PROBLEM.replace("[0.5, 1.0]", goal));
    folder.run(&["plan", "case.toml", "--out", "o"]);
    let scene = scene(&folder.read("o/report.html"));
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(scene["duration"], 20.0);
    let motions = scene["motions"].as_array().unwrap();
    assert_eq!(motions[0]["title"], "planned, a-rpm");
    let trajectory = &solution["trajectory"];
    let rows = trajectory["base_attitude"].as_array().unwrap();
    let turned = last(rows.last().unwrap()).to_degrees();
    assert!((last(&motions[0]["turned"]) - turned).abs() < 1e-3);
    // Published: three tools agree.
    assert!((last(&motions[1]["turned"]) + 36.64882).abs() < 1e-3);
    let shifted = 1.475023_f64.hypot(0.414488);
    assert!((last(&motions[1]["shifted"]) - shifted).abs() < 1e-3);
    // The joints take the same path by MATPM, at another pace: the base ends turned alike.
    let matpm = &scene["ghosts"][0];
    assert_eq!(matpm["title"], "MATPM");
    assert!((last(&matpm["turned"]) + 36.64882).abs() < 1e-3);
    assert_eq!(matpm["frames"].as_array().unwrap().len(), 121);
    // Links keep their lengths while they move.
    let (from, to) = (&scene["links"][1][0], &scene["links"][1][1]);
    let length = |frame: &Value| {
        let at = |point: &Value, i: usize| {
            let index = 3 * point.as_u64().unwrap() as usize + i;
            frame[index].as_f64().unwrap()
        };
        (at(from, 0) - at(to, 0)).hypot(at(from, 1) - at(to, 1))
    };
    for motion in motions {
        let frames = motion["frames"].as_array().unwrap();
        assert_eq!(frames.len(), 121);
        for frame in frames {
            let gap = length(frame) - length(&frames[0]);
            assert!(gap.abs() < 1e-3, "{gap}");
        }
    }
}

#[test]
fn what_is_kept_apart_is_drawn_where_it_is() {
    let apart = r#"
[[limits.keep_out]]
name = "forearm off the base"
sphere = { body = "forearm", center = [0.3, 0.0, 0.0], radius = 0.05 }
from = { center = [0.0, 0.0, 0.0], half = [0.2, 0.1, 0.1] }
"#;
    let folder = Folder::new(&format!("{PROBLEM}{apart}"));
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!(run.code, 0, "{run:?}");
    let scene = scene(&folder.read("o/report.html"));
    assert_eq!(scene["swept_spheres"][0][1], 0.05);
    assert_eq!(scene["boxes"].as_array().unwrap().len(), 4);
    let ball = scene["swept_spheres"][0][0][0].as_u64().unwrap() as usize;
    let elbow = scene["joints"][1].as_u64().unwrap() as usize;
    let corner = scene["boxes"][0][0].as_u64().unwrap() as usize;
    let base = scene["links"][0][0].as_u64().unwrap() as usize;
    for frame in scene["motions"][0]["frames"].as_array().unwrap() {
        let at = |point: usize| [0, 1].map(|i| frame[3 * point + i].as_f64().unwrap());
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!((apart(at(ball), at(elbow)) - 0.3).abs() < 1e-3);
        assert!((apart(at(corner), at(base)) - 0.2_f64.hypot(0.1)).abs() < 1e-3);
    }
}

#[test]
fn names_cannot_break_the_page() {
    let folder = Folder::new(PROBLEM);
    let name = "</script><i>&";
    let robot = folder.read("robot.toml");
    folder.write("robot.toml", &robot.replace("shoulder", name));
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!(run.code, 0, "{run:?}");
    let page = folder.read("o/report.html");
    assert!(page.contains("&lt;/script&gt;&lt;i&gt;&amp;"));
    assert!(!page.contains(name));
    scene(&page);
}

#[test]
fn an_infeasible_problem_has_a_page_that_says_so() {
    let tight = "control = [5.0, 4.0]\nfinal_base_attitude = 0.01";
    let problem = PROBLEM
        .replace("control = [5.0, 4.0]", tight)
        .replace("joint_position = 1.5", "joint_position = [0.0, 1.0]");
    let folder = Folder::new(&format!("{problem}max_iterations = 2\n"));
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!(run.code, 3, "{run:?}");
    let page = folder.read("o/report.html");
    for expected in [
        "This problem has no solution",
        "Why there is no solution",
        "limits.final_base_attitude",
        "What was checked",
    ] {
        assert!(page.contains(expected), "{expected}");
    }
    assert!(!page.contains("can be trusted"));
}

#[test]
fn pages_that_cannot_be_made_are_refused() {
    let folder = Folder::new(PROBLEM);
    folder.run(&["plan", "case.toml", "--out", "o"]);
    for (arguments, expected) in [
        (&["report", "none.json"][..], "none.json: cannot be read"),
        (&["report", "case.toml"], "expected a solution.json"),
        (
            &["report", "o/solution.json", "--out", "o"],
            "--out o: expected the name of a file",
        ),
        (
            &["report", "o/solution.json", "--out", "case.toml"],
            "--out case.toml: expected the name of a file that ends in .html",
        ),
        (
            &[
                "sample",
                "o/trajectory.csv",
                "--rate",
                "1",
                "--out",
                "o/trajectory.csv",
            ],
            "--out o/trajectory.csv: expected another file than the one that is read",
        ),
        (
            &["report", "o/solution.json", "--out", "case.toml/a.html"],
            "the output folder cannot be written",
        ),
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run:?}");
        assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
        assert!(run.stderr.contains(expected), "{run:?}");
    }
    let mut solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    solution["trajectory"]["joint_position"][3][0] = Value::Null;
    folder.write("o/damaged.json", &solution.to_string());
    let run = folder.run(&["report", "o/damaged.json"]);
    assert_eq!(run.code, 2, "{run:?}");
}
