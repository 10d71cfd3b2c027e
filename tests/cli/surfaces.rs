//! Surfaces of a robot of one's own: `init` brings them along, and they are drawn.

use crate::program::{Folder, PROBLEM, edited};
use serde_json::Value;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::PathBuf;

const URDF: &str = include_str!("../page/shaped-robot.urdf");
const SLEEVE: &[u8] = include_bytes!("../page/shaped/upper.stl");
const HAND: &[u8] = include_bytes!("../page/shaped/hand.obj");

/// `arm/robot/arm.urdf` with its surfaces as others have them: one in a folder of its own, one in the
/// package by its name.
fn folder(urdf: &str) -> Folder {
    let folder = Folder::new(PROBLEM);
    for part in ["arm/robot", "arm/meshes"] {
        fs::create_dir_all(folder.path().join(part)).unwrap();
    }
    folder.write("arm/package.xml", "<package/>");
    folder.write("arm/robot/arm.urdf", urdf);
    fs::write(folder.path().join("arm/meshes/upper.stl"), SLEEVE).unwrap();
    fs::write(folder.path().join("arm/meshes/hand.obj"), HAND).unwrap();
    folder
}

fn urdf(sleeve: &str, hand: &str) -> String {
    let urdf = edited(URDF, "shaped/upper.stl", sleeve);
    edited(&urdf, "package://shaped/hand.obj", hand)
}

/// Files below the folder.
fn below(folder: &Folder, name: &str) -> Vec<PathBuf> {
    let top = folder.path().join(name);
    let (mut open, mut found) = (vec![top.clone()], Vec::new());
    while let Some(path) = open.pop() {
        match fs::read_dir(&path) {
            Ok(entries) => open.extend(entries.map(|entry| entry.unwrap().path())),
            Err(_) => found.push(path.strip_prefix(&top).unwrap().to_path_buf()),
        }
    }
    found.sort();
    found
}

/// How many faces the solids of the page have, one by one.
fn solids(page: &str) -> Vec<usize> {
    let (_, rest) = page
        .split_once("<script id=\"scene\" type=\"application/json\">")
        .unwrap();
    let scene: Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let faces = |solid: &Value| solid["faces"].as_array().unwrap().len();
    scene["solids"]
        .as_array()
        .unwrap()
        .iter()
        .map(faces)
        .collect()
}

#[test]
fn surfaces_go_with_the_copy_of_a_robot_and_are_drawn() {
    let folder = folder(&urdf(
        "../meshes/upper.stl",
        "package://arm/meshes/hand.obj",
    ));
    let run = folder.run(&["init", "mine", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(
        run.stdout.contains("surfaces copied     2, 0.0 MB"),
        "{run:?}"
    );
    let missing = "warning: not drawn: link 'hand': package://shaped/missing.stl: not found";
    assert!(run.stderr.starts_with(missing), "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    let there = [
        "arm/meshes/hand.obj",
        "arm.urdf",
        "meshes/upper.stl",
        "problem.toml",
    ];
    assert_eq!(below(&folder, "mine"), there.map(PathBuf::from));
    assert_eq!(
        folder.read("mine/arm.urdf"),
        folder.read("arm/robot/arm.urdf")
    );

    // They need nothing of where they came from.
    fs::remove_dir_all(folder.path().join("arm")).unwrap();
    let plan = ["plan", "mine/problem.toml", "--out", "o", "--quiet"];
    let run = folder.run(&[&plan[..], &["--set", "mesh.tolerance=1e-2"]].concat());
    assert_eq!(run.code, 0, "{run:?}");
    // Bus, panels, engine; sleeve and ball of the upper arm; the hand as it collides.
    assert_eq!(
        solids(&folder.read("o/report.html")),
        [6, 6, 6, 22, 60, 128, 12]
    );
}

#[test]
fn surfaces_from_elsewhere_stay_there() {
    let folder = folder("");
    fs::write(folder.path().join("secret.stl"), SLEEVE).unwrap();
    symlink(
        folder.path().join("secret.stl"),
        folder.path().join("arm/meshes/link.stl"),
    )
    .unwrap();
    let whole = folder.path().join("arm/meshes/upper.stl");
    for (name, expected) in [
        ("../../secret.stl", "expected a file below"),
        ("../meshes/link.stl", "expected a file below"),
        ("package://arm/../secret.stl", "expected a file below"),
        ("../package.xml", "expected a file that ends in .stl"),
        // Inside, but a copy would not find it by this name.
        (
            whole.to_str().unwrap(),
            "expected a path relative to the URDF",
        ),
    ] {
        folder.write("arm/robot/arm.urdf", &urdf(name, "../meshes/hand.obj"));
        let before = below(&folder, ".").len();
        let run = folder.run(&["init", "mine", "--urdf", "arm/robot/arm.urdf"]);
        assert_eq!(run.code, 0, "{name}: {run:?}");
        let line = format!("warning: not drawn: link 'upper': {name}: {expected}");
        assert!(run.stderr.contains(&line), "{name}: {run:?}");
        let there = ["arm.urdf", "meshes/hand.obj", "problem.toml"];
        assert_eq!(below(&folder, "mine"), there.map(PathBuf::from), "{name}");
        assert_eq!(below(&folder, ".").len(), before + there.len(), "{name}");
        fs::remove_dir_all(folder.path().join("mine")).unwrap();
    }
}

#[test]
fn one_of_two_surfaces_for_one_place_is_left() {
    let folder = folder(&urdf("../meshes/upper.stl", "meshes/hand.obj"));
    let own = folder.path().join("arm/robot/meshes");
    fs::create_dir(&own).unwrap();
    fs::write(own.join("hand.obj"), HAND).unwrap();
    fs::write(own.join("upper.stl"), SLEEVE).unwrap();
    let text = folder.read("arm/robot/arm.urdf");
    let sphere = "<sphere radius=\"0.09\"/>";
    let text = edited(&text, sphere, "<mesh filename=\"meshes/upper.stl\"/>");
    folder.write("arm/robot/arm.urdf", &text);
    let run = folder.run(&["init", "mine", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!(run.code, 0, "{run:?}");
    let expected = "link 'upper': meshes/upper.stl: another file goes to its place";
    assert!(run.stderr.contains(expected), "{run:?}");
    let there = [
        "arm.urdf",
        "meshes/hand.obj",
        "meshes/upper.stl",
        "problem.toml",
    ];
    assert_eq!(below(&folder, "mine"), there.map(PathBuf::from));
}

#[test]
fn surfaces_do_not_follow_links_out_of_the_new_folder() {
    let folder = folder(&urdf("../meshes/upper.stl", "../meshes/hand.obj"));
    for part in ["mine", "other"] {
        fs::create_dir(folder.path().join(part)).unwrap();
    }
    symlink("../other", folder.path().join("mine/meshes")).unwrap();
    let run = folder.run(&["init", "mine", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run:?}");
    assert_eq!(
        run.stderr,
        "mine/meshes: is there already and stays as it is; expected a folder without it\n"
    );
    assert!(below(&folder, "other").is_empty());
    assert!(!folder.path().join("mine/problem.toml").exists());
}

#[test]
fn surfaces_that_are_in_their_place_already_stay() {
    let folder = folder(&urdf("../meshes/upper.stl", "../meshes/hand.obj"));
    let run = folder.run(&["init", "arm", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(!run.stdout.contains("surfaces"), "{run:?}");
    let run = folder.run(&["init", "arm/robot", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
}

#[test]
fn no_more_surfaces_are_copied_than_can_be_drawn() {
    let mesh =
        |k: usize| format!("<visual><geometry><mesh filename=\"{k}.stl\"/></geometry></visual>");
    let many: String = (0..310).map(mesh).collect();
    let upper = "<link name=\"upper\">";
    let text = edited(URDF, upper, &format!("{upper}{many}"));
    let folder = folder(&text);
    for k in 0..310 {
        let path = folder.path().join(format!("arm/robot/{k}.stl"));
        fs::write(path, SLEEVE).unwrap();
    }
    let run = folder.run(&["init", "mine", "--urdf", "arm/robot/arm.urdf"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stdout.contains("surfaces copied     300, "), "{run:?}");
    let expected = "link 'upper': 300.stl: expected at most 300 files";
    assert!(run.stderr.contains(expected), "{run:?}");
    assert!(run.stderr.lines().count() < 10, "{run:?}");
    assert_eq!(below(&folder, "mine").len(), 302);
}
