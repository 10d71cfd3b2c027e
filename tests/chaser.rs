//! The seven-joint chaser in `config/`, whose answer an independent model knows.

mod program;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::parallel;
use ffsm_ipopt::planner::{Plan, Planner, Status};
use ffsm_ipopt::problem::Problem;
use program::Folder;
use std::fs;
use std::num::NonZero;
use std::path::Path;

fn shipped(name: &str) -> (ProblemFile, Plan) {
    let file = ProblemFile::shipped(name).unwrap();
    let plan = Planner::new().plan(&file.problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    (file, plan)
}

/// Attitudes of the plan in degrees: the largest of each angle, and the last.
fn attitudes(plan: &Plan) -> ([f64; 3], [f64; 3]) {
    let degrees = |row: &Vec<f64>| [0, 1, 2].map(|i| row[i].to_degrees());
    let rows = &plan.trajectory.base_attitude;
    let largest = rows.iter().map(degrees).fold([0.0f64; 3], |most, row| {
        [0, 1, 2].map(|i| most[i].max(row[i].abs()))
    });
    (largest, degrees(rows.last().unwrap()))
}

fn assert_within(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < tolerance,
            "{found} instead of {expected}"
        );
    }
}

#[test]
fn straight_line_motion_is_the_published_one() {
    let folder = Folder::new("");
    fs::create_dir(folder.path().join("robots")).unwrap();
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("config");
    for name in ["chaser-7dof.toml", "robots/chaser-7dof.urdf"] {
        fs::copy(config.join(name), folder.path().join(name)).unwrap();
    }
    let run = folder.run(&["check", "chaser-7dof.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    // Published to 1e-4 degrees and 1e-6 m: (-0.8869, 8.2104, 1.3218)°, (-1.6188, 0.4726, -2.9121) cm.
    let expected = "straight-line base motion: (-0.88691, 8.21038, 1.32180)°, (-1.618813, 0.472631, -2.912057) cm\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
    assert!(run.stdout.contains("link7 9 kg"), "{}", run.stdout);
    assert!(!run.stdout.contains("note:"), "{}", run.stdout);
}

/// The peak p as a cost with weight w, and as a bound b on the rotation angle: of all wb + J(b) that with
/// b = p is the least, and equals the cost with the peak.
#[test]
fn the_least_peak_is_the_best_bound() {
    let weight = 10.0;
    let overrides = Overrides::of(&["base.attitude=\"quaternion\"".into()]).unwrap();
    let file = ProblemFile::load("config/chaser-7dof.toml".as_ref(), &overrides).unwrap();
    let solved = |problem: &Problem| {
        let plan = Planner::new().plan(problem).unwrap();
        assert_eq!(plan.status, Status::Solved);
        plan
    };
    let peaked = file.problem.edited(|problem| {
        problem.cost.peak_base_attitude = vec![weight];
    });
    let peaked = solved(&peaked.unwrap());
    let peak = peaked.discretization.parameters[0];
    let bounded = |bound: f64| {
        let problem = file.problem.edited(|problem| {
            problem.limits.base_attitude = vec![Interval::symmetric(bound)];
        });
        weight * bound + solved(&problem.unwrap()).objective
    };
    let at_peak = bounded(peak);
    assert!(
        (at_peak - peaked.objective).abs() < 1e-5 * at_peak,
        "{at_peak}"
    );
    for other in [0.995, 1.005] {
        assert!(bounded(other * peak) > at_peak);
    }
}

#[test]
fn urdf_and_toml_describe_the_same_robot() {
    let urdf = ProblemFile::shipped("chaser-7dof").unwrap().problem;
    let urdf = urdf.into_builder().robot;
    let folder = Folder::new(include_str!("data/chaser.toml"));
    folder.write("chaser-7dof.toml", include_str!("data/chaser-7dof.toml"));
    let path = folder.path().join("case.toml");
    let toml = ProblemFile::load(&path, &Overrides::default())
        .unwrap()
        .problem;
    let toml = toml.into_builder().robot;
    assert_eq!(urdf.base().inertia, toml.base().inertia);
    assert_eq!(urdf.joint_count(), toml.joint_count());
    for (a, b) in urdf.joints().iter().zip(toml.joints()) {
        assert_eq!((&a.name, a.kind, a.parent), (&b.name, b.kind, b.parent));
        assert_eq!((&a.placement, a.axis), (&b.placement, b.axis));
        assert_eq!(a.body, b.body);
    }
    let end = urdf.end_effector().unwrap();
    assert_eq!((end.joint, end.placement.translation.z), (Some(6), 0.294));
}

#[test]
fn plan_of_the_published_task() {
    let (_, plan) = shipped("chaser-7dof");
    let relative = plan.objective / 0.0526398956 - 1.0;
    assert!(relative.abs() < 1e-6, "J = {:.10}", plan.objective);
    let (largest, last) = attitudes(&plan);
    assert_within(largest, [1.1349, 8.0051, 1.2279], 1e-3);
    assert_within(last, [-0.4976, 8.0051, 1.2279], 1e-3);
}

#[test]
fn plan_where_the_base_matters_more() {
    let (_, plan) = shipped("chaser-7dof-heavy");
    let relative = plan.objective / 0.651074798 - 1.0;
    assert!(relative.abs() < 1e-6, "J = {:.10}", plan.objective);
    let (_, last) = attitudes(&plan);
    assert_within(last, [-0.0086, 1.3543, 0.3465], 1e-3);
}

#[test]
fn every_description_of_the_attitude_gives_the_same_plan() {
    // Costs that do not depend on the description, and no limits that do.
    let problem = ProblemFile::shipped("chaser-7dof")
        .unwrap()
        .problem
        .edited(|problem| {
            problem.mesh.max_iterations = Some(1);
            problem.mesh.segments = 10;
        })
        .unwrap();
    let [angles, quaternion, rodrigues] = SpatialAttitude::ALL.map(|attitude| {
        let problem = problem
            .edited(|problem| problem.set_attitude(attitude))
            .unwrap();
        Planner::new().plan(&problem).unwrap()
    });
    assert!(angles.objective > 0.03, "J = {}", angles.objective);
    let end = |plan: &Plan| {
        let found = &plan.trajectory;
        let by = found.attitude.unwrap();
        by.to_quaternion(found.base_attitude.last().unwrap())
    };
    for other in [quaternion, rodrigues] {
        let gap = (other.objective / angles.objective - 1.0).abs();
        assert!(gap < 1e-8, "objectives {gap:e} apart");
        let gap = end(&other).angle_to(&end(&angles));
        assert!(gap < 1e-6, "orientations {gap:e} rad apart");
    }
}

#[test]
fn plans_do_not_depend_on_the_number_of_threads() {
    let problem = ProblemFile::shipped("chaser-7dof")
        .unwrap()
        .problem
        .edited(|problem| {
            (problem.mesh.segments, problem.mesh.points) = (12, 5);
            problem.mesh.max_iterations = Some(1);
        })
        .unwrap();
    let plan = |threads| {
        let threads = NonZero::new(threads).unwrap();
        parallel::with_threads(threads, || Planner::new().plan(&problem).unwrap())
    };
    let one = plan(1);
    assert_eq!(one.linear_solver, "multifrontal");
    let bits = |plan: &Plan| -> Vec<u64> {
        let found = &plan.discretization;
        let all = found.x.iter().chain(&found.u);
        all.map(|value| value.to_bits()).collect()
    };
    // At the same time, so that they take helpers from each other.
    std::thread::scope(|scope| {
        for threads in [2, 3, 4, 4] {
            let (one, plan) = (&one, &plan);
            scope.spawn(move || {
                let other = plan(threads);
                assert_eq!(one.objective.to_bits(), other.objective.to_bits());
                assert_eq!(bits(one), bits(&other));
            });
        }
    });
}
