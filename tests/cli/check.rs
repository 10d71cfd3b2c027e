//! `check`.

use crate::program::{Folder, PROBLEM};

#[test]
fn check_prints_what_was_understood() {
    let run = Folder::new(PROBLEM).run(&["check", "case.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for expected in [
        "case.toml: valid",
        "planar",
        "3: base 15.2 kg, upper_arm 1.7 kg, forearm 1.2 kg",
        "18.1 kg",
        "±85.9437°",
        "shoulder ±5 rad/s², elbow ±4 rad/s²",
        "straight-line base motion: ",
    ] {
        assert!(
            run.stdout.contains(expected),
            "{expected} in\n{}",
            run.stdout
        );
    }
}

#[test]
fn straight_line_motion_of_the_published_case() {
    let folder =
        Folder::new(&PROBLEM.replace("[0.5, 1.0]", "[0.5235987755982988, 1.0471975511965976]"));
    let run = folder.run(&["check", "case.toml"]);
    let expected = "straight-line base motion: -36.64882°, (1.475023, 0.414488) cm\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
}

#[test]
fn straight_line_motion_of_an_arm_in_space() {
    let folder = Folder::new(include_str!("../data/chaser.toml"));
    folder.write("chaser-7dof.toml", include_str!("../data/chaser-7dof.toml"));
    let run = folder.run(&["check", "case.toml"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stdout.contains("spatial"), "{}", run.stdout);
    let line = run.stdout.lines().last().unwrap();
    let numbers: Vec<f64> = line
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|word| word.parse().ok())
        .collect();
    // As three other tools have it, degrees and centimetres.
    let expected = [-0.8869, 8.2104, 1.3218, -1.6188, 0.4726, -2.9121];
    assert_eq!(numbers.len(), expected.len(), "{line}");
    for (found, expected) in numbers.iter().zip(expected) {
        assert!((found - expected).abs() < 6e-5, "{line}");
    }
}

#[test]
fn a_robot_alone_is_described_and_its_problem_named() {
    let folder = Folder::new(PROBLEM);
    folder.write("arm.urdf", include_str!("../../config/starter/arm.urdf"));
    let run = folder.run(&["check", "arm.urdf"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let expected = "\nA problem for it: ffsm-ipopt init DIR --urdf arm.urdf\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
}
