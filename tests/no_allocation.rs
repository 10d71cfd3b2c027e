//! That a solve on several threads allocates nothing; alone in its program, since all are counted.

mod allocations;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::parallel;
use ffsm_ipopt::planner::{Event, Planner, Status};
use ffsm_ipopt::refine;
use std::num::NonZero;
use std::path::Path;

/// Allocations of all threads before the second iteration of each mesh and before the last.
fn counts(name: &str, overrides: &[&str], count: usize) -> Vec<[usize; 2]> {
    let path = format!("{}/config/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let overrides: Vec<String> = overrides.iter().map(|&text| text.into()).collect();
    let file = ProblemFile::load(Path::new(&path), &Overrides::of(&overrides).unwrap()).unwrap();
    let problem = file.problem;
    let mut meshes = Vec::with_capacity(problem.mesh.max_iterations.unwrap_or(40));
    let mut monitor = |event: &Event<'_>| {
        if let Event::Refinement(refine::Event::Solver(progress)) = event {
            let now = allocations::of_all_threads();
            match progress.iteration {
                // The linear solver analyses the structure in the first one, and helpers start.
                0 => {}
                1 => meshes.push([now; 2]),
                _ => meshes.last_mut().unwrap()[1] = now,
            }
        }
        Control::Continue
    };
    let mut planner = Planner::new();
    let plan = parallel::with_threads(NonZero::new(count).unwrap(), || {
        planner.plan_with(&problem, None, &mut monitor).unwrap()
    });
    assert_eq!(plan.status, Status::Solved);
    assert_eq!(plan.linear_solver, "multifrontal");
    meshes
}

#[test]
fn callbacks_and_linear_solver_on_any_number_of_threads() {
    // Threads allocate when they start, which may be late on a busy machine.
    counts("chaser-7dof", &[], 4);
    // The rotation angle limited along the path and, more tightly, at the end.
    let by_quaternion = [
        "base.attitude=\"quaternion\"",
        "limits.base_attitude=1.5",
        "limits.final_base_attitude=1.0",
    ];
    for (name, overrides) in [
        ("table1-relaxed", &[][..]),
        ("chaser-7dof", &[]),
        ("planar-3link", &[]),
        ("chaser-7dof", &by_quaternion),
    ] {
        for threads in [1, 2, 4] {
            let meshes = counts(name, overrides, threads).into_iter().enumerate();
            for (mesh, [first, last]) in meshes {
                let place = format!("{name} {overrides:?} on {threads} threads, mesh {mesh}");
                assert_eq!(first, last, "{place}");
            }
        }
    }
    assert_eq!(helpers(), 3, "threads that lent a hand");
}

/// Threads of this process that are helpers.
fn helpers() -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    let name = |task: std::io::Result<std::fs::DirEntry>| {
        std::fs::read_to_string(task.unwrap().path().join("comm")).unwrap()
    };
    tasks
        .map(name)
        .filter(|name| name.starts_with("ffsm-helper"))
        .count()
}
