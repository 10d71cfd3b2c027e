//! The command: what it writes and prints, what it refuses.

use crate::program::{Folder, PROBLEM};

fn planned() -> Folder {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--quiet", "--out", "o"]);
    assert_eq!(run.code, 0, "{run:?}");
    folder
}

const PLAN: &str = "o/solution.json";

#[test]
fn files_summary_and_json() {
    let folder = planned();
    let arguments = ["disperse", PLAN, "--samples", "500", "--seed", "4"];
    let run = folder.run(&[&arguments[..], &["--out", "d"]].concat());
    assert_eq!(run.code, 0, "{run:?}");
    for expected in [
        "case: 500 replays, 15 quantities perturbed, seed 4",
        "largest base angle, °",
        "final attitude off the plan",
        "adjusted R²",
        "d/dispersion.html",
    ] {
        assert!(run.stdout.contains(expected), "{expected}: {}", run.stdout);
    }
    let json: serde_json::Value = serde_json::from_str(&folder.read("d/dispersion.json")).unwrap();
    assert_eq!(json["schema"], 1);
    assert_eq!(json["samples"], 500);
    assert_eq!(json["figures"][0]["name"], "max_base_attitude");
    let solution: serde_json::Value = serde_json::from_str(&folder.read(PLAN)).unwrap();
    for (k, name) in [(0, "max_base_attitude"), (1, "final_base_attitude")] {
        let [found, planned] = [&json["figures"][k]["planned"], &solution["metrics"][name]]
            .map(|v| v.as_f64().unwrap());
        assert!((found - planned).abs() < 1e-12);
    }
    assert_eq!(folder.read("d/samples.csv").lines().count(), 501);
    let page = folder.read("d/dispersion.html");
    assert!(page.contains("<svg") && page.contains("body.base.mass"));
    assert!(!page.contains("http://") || page.matches("http://www.w3.org").count() > 0);

    let again = folder.run(&[&arguments[..], &["--json", "--threads", "1", "--out", "e"]].concat());
    assert_eq!(again.code, 0);
    assert_eq!(again.stdout, folder.read("d/dispersion.json"));
    let quiet = folder.run(&[&arguments[..], &["--quiet"]].concat());
    assert_eq!(
        (quiet.code, quiet.stdout.as_str(), quiet.stderr.as_str()),
        (0, "", "")
    );
    assert!(folder.names().contains(&"out".to_owned()));
}

#[test]
fn only_what_is_set_is_perturbed() {
    let folder = planned();
    let set = [
        "disperse",
        PLAN,
        "--only-set",
        "--samples",
        "20",
        "--out",
        "d",
    ];
    let run = folder.run(&set);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stdout.contains("Nothing varies"), "{}", run.stdout);
    let json: serde_json::Value = serde_json::from_str(&folder.read("d/dispersion.json")).unwrap();
    for figure in json["figures"].as_array().unwrap() {
        let of = |name: &str| figure[name].as_f64().unwrap();
        assert!((of("mean") - of("planned")).abs() < 1e-9, "{figure}");
        assert!(of("sd") < 1e-12);
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = planned();
    let before = folder.names();
    for (set, expected) in [
        (
            "body.link9.mass=normal(100%, 1%)",
            "body.link9.mass: unknown key; expected body.NAME.mass, .com or .inertia with NAME one of base, upper_arm, forearm",
        ),
        (
            "joint.wrist.tracking=normal(0, 1e-3)",
            "joint.wrist.tracking: unknown key; expected joint.NAME.offset or .tracking with NAME one of shoulder, elbow",
        ),
        (
            "mass=3",
            "mass: unknown key; expected body.NAME.mass, body.NAME.com, body.NAME.inertia, joint.NAME.offset, joint.NAME.tracking, momentum.linear or momentum.angular; * stands for every NAME",
        ),
        (
            "body.base.mass=normal(1, 3)",
            "body.base.mass: normal(1, 3); expected at most 1 % of the distribution at or below zero, 37 % of this one is",
        ),
        (
            "body.base.mass=uniform(-1, 3)",
            "body.base.mass: uniform(-1, 3); expected values above zero",
        ),
        (
            "body.base.inertia=fixed(0)",
            "body.base.inertia: fixed(0); expected values above zero",
        ),
        (
            "body.base.com=normal(0, 1%)",
            "body.base.com: normal(0, 1%); expected numbers in its unit: it is zero in the plan, so that a percentage means nothing",
        ),
        (
            "body.base.com=gauss(0, 1)",
            "body.base.com: gauss(0, 1); expected normal(mean, sd), normal(mean, sd, min, max), uniform(a, b), log_uniform(a, b) or fixed(x)",
        ),
        (
            "joint.shoulder.tracking=normal(0, 50)",
            "joint.shoulder.tracking: normal(0, 50); expected numbers of at most 3.142e0",
        ),
        (
            "body.base.mass",
            "no '='; expected --set KEY=DISTRIBUTION, as body.base.mass=normal(100%, 1%)",
        ),
    ] {
        let run = folder.run(&["disperse", PLAN, "--out", "d", "--set", set]);
        assert_eq!(run.code, 2, "{run:?}");
        let message = format!("--set {set}: {expected}");
        assert!(
            run.stderr.trim_end().ends_with(&message),
            "{}\n{message}",
            run.stderr
        );
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        assert_eq!(folder.names(), before, "nothing written");
    }
    let run = folder.run(&["disperse", "nothing.json"]);
    assert_eq!(run.code, 2, "{run:?}");
    let run = folder.run(&["disperse", PLAN, "--samples", "0"]);
    assert_eq!(run.code, 2, "{run:?}");
}
