//! Small problems as people bring them, each a sample of a kind that once failed.

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::{Problem, Shape};
use std::path::Path;
use std::time::Duration;

/// The problem of `file` below `tests/data/cases`, with `set` as by `--set`.
fn load(file: &str, set: &[&str]) -> Problem {
    let mut overrides = Overrides::default();
    for text in set {
        overrides.set(text).unwrap();
    }
    let path = Path::new("tests/data/cases").join(file);
    let loaded = ProblemFile::load(&path, &overrides);
    loaded.unwrap_or_else(|error| panic!("{error}")).problem
}

fn solve(file: &str) -> Plan {
    plan(&load(file, &[])).unwrap()
}

/// The diagnosis in words of a problem that has no solution.
fn infeasible(file: &str) -> String {
    let plan = solve(file);
    assert_eq!(plan.status, Status::Infeasible, "{file}");
    plan.diagnosis.expect("a diagnosis").summary
}

#[test]
fn one_joint_ends_where_momentum_says() {
    // −4.33297° on any path; ±2.13° was "found to work" by one file, the other was "solved" mesh
    // after mesh while J went from 12 to 985.
    for (file, key) in [
        ("diagnosis/one.toml", "base_attitude"),
        ("diagnosis/onef.toml", "final_base_attitude"),
    ] {
        let summary = infeasible(file);
        assert!(
            summary.contains("no bound below ±4.33° can work, ±4.33° was found to"),
            "{summary}"
        );
        let wider = format!("limits.{key}={}", 1.01 * 4.332_97_f64.to_radians());
        let again = plan(&load(file, &[&wider])).unwrap();
        assert_eq!(again.status, Status::Solved, "{file}");
    }
}

/// Whatever sides a bound has, on whatever follows from the joint's position: no search is needed.
#[test]
fn what_one_joint_cannot_avoid_is_proven() {
    for (set, said) in [
        ("base_attitude=[-0.05, 0.2]", "[-4.33, 11.46]°"),
        ("base_attitude=[-0.05, inf]", "at least -4.33°"),
        ("final_base_attitude=[-0.2, -0.1]", "[-11.46, -4.33]°"),
        ("final_base_attitude=[0.1, 0.2]", "[-4.33, 11.46]°"),
    ] {
        let free = "limits.base_attitude=3";
        let plan = plan(&load(
            "diagnosis/one.toml",
            &[free, &format!("limits.{set}")],
        ))
        .unwrap();
        assert_eq!(plan.status, Status::Infeasible, "{set}");
        let diagnosis = plan.diagnosis.expect("a diagnosis");
        let summary = &diagnosis.summary;
        assert!(
            summary.contains("cannot hold, whatever the motion; ") && summary.contains(said),
            "{set}: {summary}"
        );
        assert_eq!((diagnosis.starts.tried, diagnosis.converged), (1, true));
    }
    // What it passes through is no more than it has to.
    let within = load(
        "diagnosis/one.toml",
        &["limits.base_attitude=[-0.0757, 0.0001]"],
    );
    assert_eq!(plan(&within).unwrap().status, Status::Solved);
}

/// A bound next to nothing is answered as one of nothing is.
#[test]
fn bounds_next_to_nothing_are_answered() {
    for bound in ["0.0", "1e-9", "1e-6", "1e-4"] {
        let set = [
            "limits.base_attitude=3",
            &format!("limits.base_rate={bound}"),
        ];
        let plan = plan(&load("diagnosis/one.toml", &set)).unwrap();
        assert_eq!(plan.status, Status::Infeasible, "{bound}");
        let summary = plan.diagnosis.expect("a diagnosis").summary;
        // 4.333° in 20 s.
        assert!(
            summary.ends_with("the smallest bound that was found to work is ±0.217°/s"),
            "{bound}: {summary}"
        );
    }
}

#[test]
fn limits_of_zero_are_answered() {
    // Neither had an answer in a minute.
    for file in ["zero-limits/ba0.toml", "zero-limits/br0.toml"] {
        infeasible(file);
    }
    // 0.00495 N·m were shown as zero.
    let summary = infeasible("zero-limits/tau0.toml");
    assert!(summary.contains("±0.004"), "{summary}");
}

#[test]
fn a_limit_that_means_none_has_no_effect() {
    for file in ["v1e7", "v1e8", "v9.99e8"] {
        let plan = solve(&format!("huge-limits/{file}.toml"));
        assert_eq!(plan.status, Status::Solved, "{file}");
        let gap = (plan.objective - 0.019_122_822).abs();
        assert!(gap < 1e-9, "{file}: {}", plan.objective);
    }
}

#[test]
fn a_long_arm_on_a_light_bus_keeps_its_budgets() {
    // One iteration a solve took 29 s, most of it in a diagnosis of many starts.
    let few = load("canadarm-light/light.toml", &["solver.max_iterations=1"]);
    let plan = plan(&few).unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert!(plan.iterations.iter().all(|mesh| mesh.nlp_iterations <= 1));
    let limited = few
        .edited(|problem| {
            problem.solver.max_iterations = 3000;
            problem.solver.time_limit = Some(Duration::from_secs(1));
        })
        .unwrap();
    let plan = ffsm_ipopt::planner::plan(&limited).unwrap();
    // Fast machines may solve it.
    if plan.status != Status::Solved {
        assert_eq!(plan.status, Status::NotConverged);
        let late = plan.warnings.iter().any(|text| text.contains("time limit"));
        assert!(late, "{:?}", plan.warnings);
    }
    assert!(plan.objective.is_finite());
}

#[test]
fn a_switch_of_the_control_inside_a_segment_is_refined() {
    let plan = solve("refinement/switch/problem.toml");
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.iterations);
}

#[test]
fn a_control_that_rings_on_a_constrained_arc_is_refined() {
    let plan = solve("refinement/constrained-arc/problem.toml");
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.iterations);
}

#[test]
fn a_warm_start_after_a_large_error_is_no_slower_than_the_first_mesh() {
    // 170 iterations with a barrier parameter of 1e-10.
    let plan = solve("refinement/warm-start/problem.toml");
    assert_eq!(plan.status, Status::Solved);
    let [first, second, ..] = &plan.iterations[..] else {
        panic!("{:?}", plan.iterations);
    };
    assert!(second.nlp_iterations <= first.nlp_iterations);
}

#[test]
fn a_light_joint_drifts_by_the_plan_and_not_by_the_integration() {
    // The last joint moves 5.6e-4 kg m², so that errors of the motion grow a hundred thousandfold. Integrated
    // to 1e-10 it drifted by 1.75°, and the plan was not believed; to 1e-11 and 1e-13 by 0.255° and 0.279°.
    let problem = load("refinement/light-tool/problem.toml", &[]);
    let mut plan = plan(&problem).unwrap();
    plan.verify(&problem);
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.warnings);
    let drift = plan.verification.as_ref().unwrap().max_joint_drift;
    assert!((0.24..0.3).contains(&drift.to_degrees()), "{drift}");
}

#[test]
fn a_passage_too_narrow_is_named_by_a_clearance_in_metres() {
    let file = "keep-out/problem.toml";
    let failed = solve(file);
    assert_eq!(failed.status, Status::Infeasible);
    let diagnosis = failed.diagnosis.unwrap();
    assert!(
        diagnosis.summary.contains("a clearance of -0."),
        "{}",
        diagnosis.summary
    );
    // Spheres smaller by what is missing pass one another.
    let clearance = diagnosis.limits[0].smallest_bound.lower;
    let smaller = load(file, &[])
        .edited(|problem| {
            let pair = &mut problem.limits.keep_out[0];
            let Shape::Sphere { radius, .. } = &mut pair.second.shape else {
                panic!("{:?}", pair.second);
            };
            *radius += 1.01 * clearance;
            if *radius < 0.0 {
                let left = std::mem::take(radius);
                let Shape::Sphere { radius, .. } = &mut pair.first.shape else {
                    panic!("{:?}", pair.first);
                };
                *radius += left;
            }
        })
        .unwrap();
    assert_eq!(plan(&smaller).unwrap().status, Status::Solved);
}

#[test]
fn a_magnitude_that_cannot_be_is_refused_by_its_key() {
    let path = Path::new("tests/data/cases/overflow/overflow.toml");
    let error = ProblemFile::load(path, &Overrides::default()).unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("robot.toml") && text.contains("com[") && text.contains("1e150"),
        "{text}"
    );
}

/// What ended the refinement of a plan that has not converged is said.
#[test]
fn a_plan_that_has_not_converged_names_the_reason() {
    let shipped = |set: &[&str]| {
        let mut overrides = Overrides::default();
        for text in set {
            overrides.set(text).unwrap();
        }
        let path = Path::new("config/table1-relaxed.toml");
        plan(&ProblemFile::load(path, &overrides).unwrap().problem).unwrap()
    };
    for (set, word) in [
        (
            &["mesh.max_iterations=2"][..],
            "mesh.max_iterations = 2 ended the refinement",
        ),
        (
            &["mesh.method=\"rpm\"", "mesh.max_global_points=40"],
            "mesh.max_global_points = 40 ended the refinement",
        ),
        // Bounded, but so widely that the best rates jump.
        (
            &["limits.control=1e4", "mesh.max_iterations=3"],
            "may have rates that jump",
        ),
    ] {
        let plan = shipped(set);
        assert_eq!(plan.status, Status::NotConverged, "{set:?}");
        let said = |text: &String| text.contains(word);
        assert!(
            plan.warnings.iter().any(said),
            "{set:?}: {:?}",
            plan.warnings
        );
    }
    // Bounds that a mesh resolves are no reason, whatever the method makes of them.
    let global = shipped(&["mesh.method=\"rpm\""]);
    let jumps = |text: &String| text.contains("rates that jump");
    assert!(!global.warnings.iter().any(jumps), "{:?}", global.warnings);
    let solved = shipped(&[]);
    let reasons = ["ended the refinement", "rates that jump"];
    let named = |text: &String| reasons.iter().any(|reason| text.contains(reason));
    assert!(!solved.warnings.iter().any(named), "{:?}", solved.warnings);
}
