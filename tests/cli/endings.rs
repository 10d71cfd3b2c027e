//! Ends other than a solution.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn an_infeasible_problem_says_so_and_why() {
    let problem = format!("{PROBLEM}max_iterations = 2\n").replace(
        "control = [5.0, 4.0]",
        "control = [5.0, 4.0]\nfinal_base_attitude = 0.01",
    );
    let folder =
        Folder::new(&problem.replace("joint_position = 1.5", "joint_position = [0.0, 1.0]"));
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!(run.code, 3, "{run:?}");
    assert!(
        run.stdout.contains("limits.final_base_attitude"),
        "{}",
        run.stdout
    );
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(solution["status"], "infeasible");
    let limits = solution["diagnosis"]["limits"].as_array().unwrap();
    assert!(
        limits
            .iter()
            .any(|limit| limit["key"] == "limits.final_base_attitude")
    );
}

#[test]
fn a_tolerance_out_of_reach_is_not_convergence() {
    let folder = Folder::new(PROBLEM);
    let arguments = [
        "plan",
        "case.toml",
        "--out",
        "o",
        "--tolerance",
        "1e-12",
        "--set",
        "mesh.max_iterations=1",
        "--quiet",
    ];
    let run = folder.run(&arguments);
    assert_eq!(run.code, 4, "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1);
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(solution["status"], "not_converged");
    assert!(solution["points"].as_u64().unwrap() > 0);
}
