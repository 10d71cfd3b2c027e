//! What is read, and files to begin with.

use ffsm_ipopt::config::{PlatformFile, ProblemFile};
use ffsm_ipopt::planner::Planner;
use ffsm_ipopt::solution::{Provenance, Saved, parse_solution, solution, to_json};
use ffsm_ipopt::verify;
use std::path::Path;
use std::sync::OnceLock;

const ROBOT: &str = include_str!("../../config/robots/planar-2link.toml");
const URDF: &str = include_str!("../../config/robots/chaser-7dof.urdf");
const ARM: &str = include_str!("../../config/starter/arm.urdf");
const SMOOTH: &str = include_str!("../../config/table1-smooth.toml");

fn texts(texts: &[&str]) -> Vec<String> {
    texts.iter().map(|text| (*text).to_owned()).collect()
}

fn message(error: impl std::error::Error) -> String {
    error.to_string()
}

/// Problems of the two-link robot.
pub fn problems() -> Vec<String> {
    texts(&[
        SMOOTH,
        include_str!("../../config/table1.toml"),
        include_str!("../../config/table1-minimum-time.toml"),
        include_str!("../../config/capture.toml"),
    ])
}

pub fn read_problem(text: &str) -> Result<(), String> {
    // Those that name another robot are refused, after all else of them was parsed.
    let robot = ("robots/planar-2link.toml", ROBOT);
    let read = ProblemFile::restore(("case.toml", text), robot, &[]);
    read.map(drop).map_err(message)
}

pub fn robots() -> Vec<String> {
    texts(&[
        ROBOT,
        include_str!("../../config/robots/planar-2link-heavy-base.toml"),
    ])
}

pub fn read_robot(text: &str) -> Result<(), String> {
    let read = ProblemFile::restore(
        ("case.toml", SMOOTH),
        ("robots/planar-2link.toml", text),
        &[],
    );
    read.map(drop).map_err(message)
}

pub fn urdfs() -> Vec<String> {
    texts(&[URDF, ARM])
}

pub fn read_urdf(text: &str) -> Result<(), String> {
    const PROBLEM: &str = "schema = 1\nrobot = \"arm.urdf\"\n[task]\nduration = 10.0\n\
        initial.joints = [0, 0, 0, 0, 0, 0, 0]\nfinal.joints = [0, 0, 0, 0, 0, 0, 0.1]\n";
    let read = ProblemFile::restore(("case.toml", PROBLEM), ("arm.urdf", text), &[]);
    read.map(drop).map_err(message)
}

pub fn platforms() -> Vec<String> {
    texts(&[
        include_str!("../../config/platforms/air-bearing.toml"),
        include_str!("../../config/platforms/ideal.toml"),
    ])
}

/// The problem of platforms and solutions.
fn problem() -> &'static ProblemFile {
    static PROBLEM: OnceLock<ProblemFile> = OnceLock::new();
    PROBLEM.get_or_init(|| {
        let robot = ("robots/planar-2link.toml", ROBOT);
        let smooth = ("table1-smooth.toml", SMOOTH);
        let few = ["--set mesh.segments=2", "--set mesh.max_iterations=1"];
        ProblemFile::restore(smooth, robot, &few.map(String::from)).expect("a problem")
    })
}

pub fn read_platform(text: &str) -> Result<(), String> {
    let read = PlatformFile::parse(Path::new("table.toml"), text, &problem().problem.robot);
    read.map(drop).map_err(message)
}

pub fn solutions() -> Vec<String> {
    let file = problem();
    let plan = Planner::new()
        .plan_with(&file.problem, None, &mut |_| {
            ffsm_ipopt::nlp::Control::Continue
        })
        .expect("a plan");
    let provenance = Provenance::of(file, &plan.linear_solver);
    let saved = solution(&file.problem, &plan, provenance);
    vec![to_json(&saved).expect("JSON")]
}

pub fn read_solution(text: &str) -> Result<(), String> {
    let path = Path::new("solution.json");
    let saved = Saved::of(path, parse_solution(path, text).map_err(message)?).map_err(message)?;
    verify::check(&saved.file.problem, &saved.plan).map_err(message)
}
