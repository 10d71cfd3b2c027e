//! Every example runs and its own assertions hold.

#[path = "../examples/batch_in_code.rs"]
mod batch_in_code;
#[path = "../examples/known_optima_bench.rs"]
mod known_optima_bench;
#[path = "../examples/own_problem.rs"]
mod own_problem;
#[path = "../examples/periodic_orbit.rs"]
mod periodic_orbit;
#[path = "../examples/plan_from_file.rs"]
mod plan_from_file;
#[path = "../examples/plan_in_code.rs"]
mod plan_in_code;
#[path = "../examples/replan_many.rs"]
mod replan_many;
#[path = "../examples/replan_on_the_way.rs"]
mod replan_on_the_way;
#[path = "../examples/shuttle_reentry.rs"]
mod shuttle_reentry;
#[path = "../examples/static_parameter.rs"]
mod static_parameter;
#[path = "../examples/time_in_process.rs"]
mod time_in_process;

use known_optima_bench::free_flying_robot;

#[test]
fn free_flying_robot_runs() {
    free_flying_robot::main().unwrap();
}

#[test]
fn shuttle_reentry_runs() {
    shuttle_reentry::main().unwrap();
}

#[test]
fn static_parameter_runs() {
    static_parameter::main().unwrap();
}

#[test]
fn periodic_orbit_runs() {
    periodic_orbit::main().unwrap();
}

#[test]
fn known_optima_bench_runs() {
    known_optima_bench::main().unwrap();
}

#[test]
fn own_problem_runs() {
    own_problem::main().unwrap();
}

#[test]
fn plan_from_file_runs() {
    plan_from_file::main().unwrap();
}

#[test]
fn plan_in_code_runs() {
    plan_in_code::main().unwrap();
}

#[test]
fn replan_many_runs() {
    replan_many::main().unwrap();
}

#[test]
fn replan_on_the_way_runs() {
    replan_on_the_way::main().unwrap();
}

#[test]
fn time_in_process_runs() {
    time_in_process::main().unwrap();
}

#[test]
fn the_shuttle_flies_the_same_in_any_unit_under_any_ceiling() {
    // In units of 1e5 ft the first mesh of 50 points is followed by one of 300. A ceiling of 3e6 ft,
    // where the density underflows, was "locally infeasible".
    for (ceiling, unit) in [(1e6, 1e5), (3e6, 1.0)] {
        let shuttle = shuttle_reentry::Shuttle { ceiling, unit };
        let outcome = ffsm_ipopt::ocp::solve(&shuttle, &Default::default()).unwrap();
        let range = -outcome.objective.to_degrees();
        assert!(
            outcome.converged && (range - 34.1412).abs() < 1e-4,
            "{range}"
        );
        let points = outcome.trajectory.mesh.points();
        assert!(points <= 2 * 300, "{points} points");
    }
}

#[test]
fn batch_in_code_runs() {
    batch_in_code::main().unwrap();
}
