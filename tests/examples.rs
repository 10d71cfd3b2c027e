//! Every example runs and its own assertions hold.

#[path = "../examples/own_problem.rs"]
mod own_problem;
#[path = "../examples/plan_from_file.rs"]
mod plan_from_file;
#[path = "../examples/plan_in_code.rs"]
mod plan_in_code;
#[path = "../examples/replan_many.rs"]
mod replan_many;
#[path = "../examples/time_in_process.rs"]
mod time_in_process;

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
fn time_in_process_runs() {
    time_in_process::main().unwrap();
}
