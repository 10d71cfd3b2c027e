//! Robots in the plane.

use crate::checks::*;
use crate::problem_kinds::*;
use crate::problems;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::ocp::Interval;

#[test]
fn two_joints_in_the_plane() {
    check_problem(&loaded(problems::two_link()), small());
    check_problem(&problems::relaxed(), small());
    check_problem(&problems::smooth(), small());
}

#[test]
fn two_joints_in_the_plane_treated_in_space() {
    let problem = loaded(problems::two_link().in_space())
        .edited(|problem| problem.cost.torque = vec![0.0; 2])
        .unwrap();
    let mesh = Mesh::uniform(1, 2).unwrap();
    // Motion stays in the plane, so that out-of-plane terms vanish on the joints alone, not by
    // the base's own roll and pitch.
    check_problem(&problem, mesh);
}

#[test]
fn torque_rows_and_costs() {
    let problem = loaded(problems::two_link())
        .edited(|problem| {
            problem.limits.torque = vec![Interval::symmetric(2.0); 2];
            problem.cost.torque = vec![0.3, 0.4];
            problem.cost.rate_matrix = Some(vec![
                vec![0.1, 0.05, 0.0],
                vec![0.05, 0.2, -0.03],
                vec![0.0, -0.03, 0.4],
            ]);
        })
        .unwrap();
    check_problem(&problem, small());
}

#[test]
fn free_duration() {
    let problem = loaded(problems::two_link())
        .edited(|problem| problem.task.duration = Interval::new(1.0, 5.0))
        .unwrap();
    check_problem(&problem, small());
}
