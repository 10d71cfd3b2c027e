//! Plans that re-integration does not confirm, and what a planner keeps for the next problem.

mod problems;
mod program;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Doubt, Method, Planner, Status, judge, plan};
use ffsm_ipopt::problem::ProblemBuilder;
use program::{Folder, PROBLEM, edited};
use std::path::Path;

#[test]
fn a_plan_that_holds_stays_solved() {
    let problem = problems::smooth();
    let mut found = plan(&problem).unwrap();
    found.verify(&problem);
    assert_eq!(found.status, Status::Solved);
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    let checked = found.verification.unwrap();
    assert!(checked.max_joint_drift < 1e-3, "{checked:?}");
}

#[test]
fn a_plan_that_drifts_is_not_solved() {
    let problem = problems::smooth();
    let mut found = plan(&problem).unwrap();
    // Another control than the motion needs.
    for value in &mut found.discretization.u {
        *value *= 1.2;
    }
    found.verify(&problem);
    assert_eq!(found.status, Status::NotConverged);
    let [warning] = &found.warnings[..] else {
        panic!("{:?}", found.warnings)
    };
    assert!(warning.contains("drifts by"), "{warning}");
    assert!(found.verification.is_some());
}

#[test]
fn a_plan_that_cannot_be_checked_is_not_solved() {
    let problem = problems::smooth();
    let mut found = plan(&problem).unwrap();
    found.discretization.u[3] = f64::NAN;
    found.verify(&problem);
    assert_eq!(found.status, Status::NotConverged);
    assert!(found.warnings[0].contains("could not be checked"));
    assert!(found.verification.is_none());
}

/// A wrist that hardly anything resists: 5.6e-4 kg m² about its mass centre, on arms of tens.
#[test]
fn a_drift_is_put_down_to_the_joint_that_hardly_anything_resists() {
    let path = Path::new("tests/data/light-wrist/problem.toml");
    let file = ProblemFile::load(path, &Overrides::default()).unwrap();
    let problem = &file.problem;
    let mut planned = Planner::new()
        .plan_by(Method::StraightLine, problem, None, &mut |_| {
            Control::Continue
        })
        .unwrap();
    // Another control than the motion needs.
    for value in &mut planned.discretization.u {
        *value *= 1.1;
    }
    let doubt = judge(problem, &planned.discretization).doubt.unwrap();
    let words = doubt.to_string();
    let Doubt::JointDrift {
        drift,
        room,
        conditioning: Some(found),
        ..
    } = doubt
    else {
        panic!("{words}");
    };
    assert!(drift > room);
    assert_eq!(found.joint, "a9");
    assert!(found.condition > 1e5 && found.condition < 1e6, "{found:?}");
    // Of the wrist alone: about its mass centre, and about its axis.
    assert!(
        found.inertia > 5.5e-4 && found.inertia < 6.6e-4,
        "{found:?}"
    );
    for said in [
        "kg m² resist joint a9",
        "condition number of the inertia matrix H",
    ] {
        assert!(words.contains(said), "{words}");
    }
}

/// An arm without such a joint is not blamed.
#[test]
fn a_drift_of_an_even_arm_is_not_put_down_to_its_inertia() {
    let problem = problems::smooth();
    let mut found = plan(&problem).unwrap();
    for value in &mut found.discretization.u {
        *value *= 1.2;
    }
    let doubt = judge(&problem, &found.discretization).doubt.unwrap();
    let words = doubt.to_string();
    assert!(
        words.contains("joint joint") && !words.contains("condition number"),
        "{words}"
    );
    let Doubt::JointDrift { conditioning, .. } = doubt else {
        panic!("{words}");
    };
    assert!(conditioning.unwrap().condition < 1e3);
}

/// Two coarse segments and a tolerance that everything is within.
#[test]
fn the_program_ends_as_for_an_unconverged_plan() {
    let mesh = "segments = 4\npoints = 5\ntolerance = 1e-3";
    let coarse = edited(PROBLEM, mesh, "segments = 1\npoints = 3\ntolerance = 10.0");
    let run = Folder::new(&coarse).run(&["plan", "case.toml"]);
    assert_eq!(run.code, 4, "{}", run.stderr);
    for said in [
        "NOT converged, re-integration does not confirm it",
        "drifts by",
    ] {
        assert!(run.stdout.contains(said), "{}", run.stdout);
    }
}

#[test]
fn a_planner_keeps_nothing_that_wider_bounds_make_wrong() {
    let problem = ProblemFile::shipped("chaser-7dof").unwrap().problem;
    let bounded = |pitch: f64| {
        let change = |problem: &mut ProblemBuilder| {
            problem.limits.base_attitude[1] = Interval::symmetric(pitch);
            problem.limits.final_base_attitude[1] = Interval::symmetric(pitch);
            problem.mesh.max_iterations = Some(1);
        };
        problem.edited(change).unwrap()
    };
    let mut planner = Planner::new();
    let held = planner.plan(&bounded(0.0)).unwrap();
    let free = planner.plan(&bounded(0.5)).unwrap();
    let fresh = plan(&bounded(0.5)).unwrap();
    assert_ne!(held.objective, free.objective);
    assert_eq!(free.objective, fresh.objective);
    assert_eq!(free.discretization, fresh.discretization);
}

/// With joints that stand still, momentum turns the whole system as one body.
#[test]
fn the_straight_line_figure_knows_the_momentum() {
    let problem = problems::smooth()
        .edited(|problem| {
            problem.task.final_joints = problem.task.initial_joints.clone();
            problem.task.initial_momentum.angular = vec![0.3];
            problem.task.initial_momentum.linear = vec![0.9, 0.0];
        })
        .unwrap();
    let (mass, moment, about_origin) = problems::two_link_composite();
    let inertia = about_origin - moment * moment / mass;
    let found = ffsm_ipopt::system::straight_line(&problem);
    let angle = 0.3 / inertia * 20.0;
    assert!(
        (found.base_attitude[0] - angle).abs() < 1e-9,
        "{found:?} {angle}"
    );
    let center = moment / mass;
    let drift = 0.9 / mass * 20.0;
    let expected = [drift - center * (angle.cos() - 1.0), -center * angle.sin()];
    for (found, expected) in found.base_displacement.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

/// A slide on a spinning base: errors grow as fast as it turns, though each part of the motion is right.
#[test]
fn a_plan_for_an_unstable_motion_is_solved_and_says_so() {
    let path = Path::new("tests/data/cases/unstable/problem.toml");
    let problem = ProblemFile::load(path, &Overrides::default())
        .unwrap()
        .problem;
    let mut found = plan(&problem).unwrap();
    found.verify(&problem);
    assert_eq!(found.status, Status::Solved, "{:?}", found.warnings);
    let judgement = judge(&problem, &found.discretization);
    let instability = judgement.instability.expect("growing errors");
    assert!(judgement.doubt.is_none());
    assert!(
        instability.drift > 1e-2 && instability.own < 1e-5,
        "{instability:?}"
    );
    assert!(
        found.warnings.iter().any(|text| text.contains("unstable")),
        "{:?}",
        found.warnings
    );
    // Another control than the motion needs is another matter.
    for value in &mut found.discretization.u {
        *value *= 1.02;
    }
    let judgement = judge(&problem, &found.discretization);
    assert!(judgement.doubt.is_some() && judgement.instability.is_none());
}
