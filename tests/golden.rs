//! Known answers from tools nobody here wrote, and the optima of the shipped problems.
//!
//! `tests/data/golden.json` holds values of Pinocchio 4.1.0 and SPART (SPARTpy 1.1.3), each from a
//! model of its own of the same robot, written by `tests/oracle/golden.py`. `make oracle` computes
//! them again; docs/verification.md has the rest.

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::space::{Space, Vector};
use ffsm_ipopt::dynamics::{Data, Tree};
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::straight_line;
use serde::Deserialize;

#[derive(Deserialize)]
struct Golden {
    provenance: String,
    cases: Vec<Case>,
}

/// One problem; `joints` and `rates` are a random configuration of its robot.
#[derive(Deserialize)]
struct Case {
    problem: String,
    joints: Vec<f64>,
    rates: Vec<f64>,
    pinocchio: Values,
    spart: Values,
}

/// What one tool has to say; vectors in space have three components.
#[derive(Deserialize)]
struct Values {
    straight_line: Line,
    /// Angular velocity of the base without momentum, base axes, rad/s.
    base_rate: Vec<f64>,
    /// H by rows.
    mass_matrix: Vec<Vec<f64>>,
    /// Cθ̇.
    bias: Vec<f64>,
}

#[derive(Deserialize)]
struct Line {
    /// Roll, pitch, yaw, rad.
    attitude: Vec<f64>,
    displacement: Vec<f64>,
}

impl Case {
    fn tools(&self) -> [(String, &Values); 2] {
        [("Pinocchio", &self.pinocchio), ("SPART", &self.spart)]
            .map(|(tool, values)| (format!("{}, {tool}", self.problem), values))
    }
}

fn golden() -> Golden {
    serde_json::from_str(include_str!("data/golden.json")).unwrap()
}

fn load(path: &str) -> Problem {
    let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    ProblemFile::load(path.as_ref(), &Overrides::default())
        .unwrap()
        .problem
}

/// Component by component, to 1e-9 of the largest.
fn assert_close(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        let gap = (a - b).abs() / scale;
        assert!(
            gap <= 1e-9,
            "{what}[{i}]: {a:e} instead of {b:e}, relative gap {gap:.1e}"
        );
    }
}

/// The components of a vector in space that the plane has: the last angle, the first lengths.
fn angles(v: &[f64], planar: bool) -> &[f64] {
    if planar { &v[2..] } else { v }
}

fn lengths(v: &[f64], planar: bool) -> &[f64] {
    if planar { &v[..2] } else { v }
}

#[test]
fn the_values_are_of_the_tools_this_file_names() {
    let found = golden().provenance;
    assert!(found.ends_with("Pinocchio 4.1.0, SPARTpy 1.1.3"), "{found}");
}

#[test]
fn base_motion_along_the_straight_joint_path() {
    for case in golden().cases {
        let problem = load(&case.problem);
        let planar = problem.robot.plane().is_some();
        let found = straight_line(&problem);
        for (what, values) in case.tools() {
            let line = &values.straight_line;
            let attitude = angles(&line.attitude, planar);
            assert_close(&what, &found.base_attitude, attitude);
            let displacement = lengths(&line.displacement, planar);
            assert_close(&what, &found.base_displacement, displacement);
        }
    }
}

/// Holds one form of a case's robot against both tools.
fn check_dynamics<Sp: Space>(tree: &Tree<Sp>, case: &Case) {
    let n = tree.joint_count();
    let mut data = Data::<Sp, f64>::new(tree);
    tree.kinematics(&case.joints, &mut data);
    tree.momentum(&mut data);
    tree.base_rate(&case.rates, &mut data);
    tree.mass_matrix(&mut data);
    tree.bias(&case.rates, &mut data);
    let matrix: Vec<f64> = (0..n * n)
        .map(|k| data.mass_matrix[(k / n).max(k % n) * n + (k / n).min(k % n)])
        .collect();
    for (what, values) in case.tools() {
        let rate = angles(&values.base_rate, Sp::ANGLES == 1);
        assert_close(&format!("{what}: ω₀"), data.base_rate.components(), rate);
        assert_close(&format!("{what}: H"), &matrix, &values.mass_matrix.concat());
        assert_close(&format!("{what}: Cθ̇"), &data.bias, &values.bias);
    }
}

#[test]
fn base_rate_mass_matrix_and_coriolis_force() {
    for case in golden().cases {
        let robot = load(&case.problem).into_builder().robot;
        check_dynamics(&Tree::spatial(&robot), &case);
        if let Some(tree) = Tree::planar(&robot) {
            check_dynamics(&tree, &case);
        }
    }
}

/// Solves a shipped problem as it stands and compares its optimum with this program's own on much
/// finer meshes, to 1e-6.
fn assert_optimum(path: &str, expected: f64) {
    let plan = plan(&load(path)).unwrap();
    assert_eq!(plan.status, Status::Solved, "{path}");
    let gap = (plan.objective / expected - 1.0).abs();
    assert!(gap <= 1e-6, "{path}: J = {}", plan.objective);
}

#[test]
fn optimum_of_the_three_link_arm() {
    assert_optimum("config/planar-3link.toml", 0.343_093_0);
}

#[test]
fn optimum_of_the_dual_arm_spacecraft() {
    assert_optimum("config/dual-arm.toml", 0.337_893_9);
}

#[test]
fn optimum_of_the_odd_tree() {
    assert_optimum("tests/data/odd-tree.toml", 0.077_955_81);
}
