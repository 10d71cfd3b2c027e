//! The published case is infeasible: the diagnosis against dynamic programming.

mod problems;
mod trees;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::floor::{Certainty, Connection, Grid};
use ffsm_ipopt::planner::{Event, Planner, Status, plan};
use ffsm_ipopt::problem::{Problem, ProblemBuilder};
use std::f64::consts::PI;
use std::path::Path;
use std::time::Duration;

#[test]
fn the_published_case_names_the_base_attitude_and_the_smallest_bound() {
    let plan = plan(&problems::published()).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let diagnosis = plan.diagnosis.expect("a diagnosis");
    assert!(
        diagnosis.limits.iter().all(|l| l.name == "base attitude"),
        "{diagnosis:?}"
    );
    let along = diagnosis
        .limits
        .iter()
        .find(|l| l.limit.key() == "limits.base_attitude")
        .unwrap();
    let end = diagnosis
        .limits
        .iter()
        .find(|l| l.limit.key() == "limits.final_base_attitude")
        .unwrap();
    let smallest = along
        .smallest_bound
        .upper
        .max(end.smallest_bound.upper)
        .to_degrees();
    let grid = Grid::new(&problems::published(), 1.28e6).expect("a planar arm of two joints");
    let floor = along.floor.expect("a floor").to_degrees();
    assert!((25.0..smallest).contains(&floor), "{floor}°");
    let bound = grid
        .smallest_bound([0.0, 0.5 * PI], 5e-4, Certainty::Estimate)
        .to_degrees();
    assert!(
        (bound - 28.5).abs() < 0.3,
        "dynamic programming finds {bound}°"
    );
    // Without a bound along the path the published one at t_f is just out of reach.
    let [_, nearest] = grid
        .reachable(f64::INFINITY, Certainty::Estimate)
        .map(f64::to_degrees);
    assert!((-17.0..-14.0).contains(&nearest), "{nearest}°");
    assert!(
        smallest > bound - 0.2,
        "{smallest}° is below the estimate of the grid, {bound}°"
    );
    assert!(
        smallest < 1.05 * bound,
        "{smallest}° is not within 5 % of {bound}°"
    );
    assert!(
        diagnosis.summary.contains("limits.base_attitude"),
        "{}",
        diagnosis.summary
    );
}

#[test]
fn the_bound_that_was_found_does_work() {
    let problem = problems::published()
        .edited(|problem| {
            problem.limits.base_attitude = vec![Interval::symmetric(29.2_f64.to_radians())];
            problem.limits.final_base_attitude = problem.limits.base_attitude.clone();
            // On this mesh, whose nodes alone are looked at.
            problem.mesh.tolerance = 1.0;
            problem.mesh.bound_tolerance = 1e3;
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.diagnosis);
    let mut nodes = plan.trajectory.base_attitude.iter();
    assert!(nodes.all(|eta| eta[0].abs().to_degrees() < 29.2 + 1e-3));
}

/// From the straight path it is not found; that is no proof that there is none.
#[test]
fn a_bound_just_above_the_smallest_is_not_called_infeasible() {
    let problem = problems::published().edited(|problem| {
        problem.limits.base_attitude = vec![Interval::symmetric(29.5_f64.to_radians())];
        problem.limits.final_base_attitude = problem.limits.base_attitude.clone();
        problem.mesh.tolerance = 1.0;
        problem.mesh.bound_tolerance = 1e3;
    });
    let plan = plan(&problem.unwrap()).unwrap();
    assert_ne!(plan.status, Status::Infeasible, "{:?}", plan.diagnosis);
    let mut nodes = plan.trajectory.base_attitude.iter();
    assert!(nodes.all(|eta| eta[0].abs().to_degrees() < 29.5 + 1e-3));
}

#[test]
fn a_limit_on_the_joints_is_named_too() {
    // A radian in half a second at 0.9 rad/s: no base limit has a part in it.
    let problem = problems::relaxed()
        .edited(|problem| problem.task.duration = Interval::fixed(0.5))
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.expect("a diagnosis").limits;
    assert!(
        limits
            .iter()
            .any(|l| l.limit.key() == "limits.joint_velocity"),
        "{limits:?}"
    );
    assert!(
        limits
            .iter()
            .all(|l| l.excess > 0.0 && l.smallest_bound.upper > l.bound.upper)
    );
}

#[test]
fn limits_that_no_motion_keeps_are_relaxed_at_once() {
    // With those on the base alone no motion would be found, which is known before any solve.
    type Limits = fn(&mut ProblemBuilder) -> &mut Vec<Interval>;
    let limits: [(&str, Limits); 3] = [
        ("limits.torque", |problem| &mut problem.limits.torque),
        ("limits.control", |problem| &mut problem.limits.control),
        ("limits.joint_velocity", |problem| {
            &mut problem.limits.joint_velocity
        }),
    ];
    for (key, of) in limits {
        let problem = problems::relaxed()
            .edited(|problem| *of(problem) = vec![Interval::symmetric(0.0); 2])
            .unwrap();
        let mut most = Vec::new();
        let plan = Planner::new()
            .plan_with(&problem, None, &mut |event| {
                if let Event::Diagnosing { of, .. } = event {
                    most.push(*of);
                }
                Control::Continue
            })
            .unwrap();
        assert_eq!(plan.status, Status::Infeasible, "{key}");
        let one_search = most.iter().all(|of| *of == most[0]);
        assert!(!most.is_empty() && one_search, "{key}: {most:?}");
        let diagnosis = plan.diagnosis.expect("a diagnosis");
        assert!(diagnosis.converged, "{key}");
        let named: Vec<_> = diagnosis.limits.iter().map(|l| l.limit.key()).collect();
        assert_eq!(named, [key; 2]);
        for limit in &diagnosis.limits {
            assert!(limit.smallest_bound.upper > 1e-4, "{limit:?}");
        }
    }
}

#[test]
fn a_limit_on_the_rotation_angle_is_named_in_degrees() {
    // An arm that can hardly move on a base that tumbles: as one body, by L/I·t about z.
    let mut problem = Problem::builder(
        "still",
        problems::two_link().in_space(),
        20.0,
        &[0.0; 2],
        &[0.0; 2],
    );
    problem.set_attitude(SpatialAttitude::Quaternion);
    problem.task.initial_momentum.angular = vec![0.0, 0.0, 0.05];
    problem.limits.control = vec![Interval::symmetric(1e-6); 2];
    problem.limits.base_attitude = vec![Interval::symmetric(0.1)];
    problem.limits.final_base_attitude = vec![Interval::symmetric(0.05)];
    problem.cost.joint_rate = vec![1.0; 2];
    problem.mesh.segments = 2;
    problem.mesh.points = 4;
    let problem = problem.build().unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    // Of (mass, inertia, distance) of each body.
    let bodies = [
        (15.2, 0.1454, 0.0),
        (1.7, 0.059, 0.52),
        (1.2, 0.0486, 1.012),
    ];
    let mass: f64 = bodies.iter().map(|b| b.0).sum();
    let center = bodies.iter().map(|b| b.0 * b.2).sum::<f64>() / mass;
    let about = |b: &(f64, f64, f64)| b.1 + b.0 * (b.2 - center).powi(2);
    let turned = 0.05 / bodies.iter().map(about).sum::<f64>() * 20.0;
    let diagnosis = plan.diagnosis.expect("a diagnosis");
    let keys: Vec<_> = diagnosis.limits.iter().map(|l| l.limit.key()).collect();
    assert_eq!(keys, ["limits.base_attitude", "limits.final_base_attitude"]);
    for (limit, bound) in diagnosis.limits.iter().zip([0.1, 0.05]) {
        assert_eq!(limit.name, "base rotation angle");
        assert_eq!((limit.bound.lower, limit.bound.upper), (0.0, bound));
        let gap = (limit.smallest_bound.upper - turned).abs();
        assert!(gap < 2e-3 * turned, "{limit:?}, expected {turned}");
    }
    let start =
        "limits.base_attitude = 5.73° (base rotation angle) was not found to hold; the smallest";
    assert!(
        diagnosis.summary.starts_with(start),
        "{}",
        diagnosis.summary
    );
}

#[test]
fn no_motion_of_two_joints_is_outside_what_the_grid_bounds() {
    let problem = problems::published();
    let grid = Grid::new(&problem, 2e5).expect("a planar arm of two joints");
    let connection = Connection::new(&problem.robot).unwrap();
    let [low, high] = grid.reachable(f64::INFINITY, Certainty::Bound);
    let inner = grid.reachable(f64::INFINITY, Certainty::Estimate);
    assert!(
        low < inner[0] && inner[1] < high,
        "{low}, {high}, {inner:?}"
    );
    let task = &problem.task;
    let rates = [0, 1].map(|i| problem.limits.joint_velocity[i].upper);
    let mut random = fastrand::Rng::with_seed(7);
    let mut tried = 0;
    while tried < 60 {
        // Straight legs at full speed through points within the joint limits, as long as time lasts.
        let mut points = vec![[0, 1].map(|i| task.initial_joints[i])];
        for _ in 0..random.usize(..12) {
            let within = |i: usize| {
                let bounds = problem.limits.joint_position[i];
                bounds.lower + random.f64() * (bounds.upper - bounds.lower)
            };
            points.push([0, 1].map(within));
        }
        points.push([0, 1].map(|i| task.final_joints[i]));
        let spent: f64 = points
            .windows(2)
            .map(|leg| {
                let time = |i: usize| (leg[1][i] - leg[0][i]).abs() / rates[i];
                time(0).max(time(1))
            })
            .sum();
        if spent > task.duration.upper {
            continue;
        }
        tried += 1;
        let (mut eta, mut largest) = (0.0_f64, 0.0_f64);
        for leg in points.windows(2) {
            let moved = [0, 1].map(|i| (leg[1][i] - leg[0][i]) / 100.0);
            for k in 0..100 {
                let middle = [0, 1].map(|i| leg[0][i] + (f64::from(k) + 0.5) * moved[i]);
                let [a, b] = connection.coefficients(middle);
                eta += a * moved[0] + b * moved[1];
                largest = largest.max(eta.abs());
            }
        }
        assert!((low..=high).contains(&eta), "{eta} by {points:?}");
        let [least, most] = grid.reachable(largest + 1e-4, Certainty::Bound);
        assert!(
            least <= eta + 1e-4 && eta - 1e-4 <= most,
            "{eta} within {largest} by {points:?}"
        );
    }
}

#[test]
fn the_curvature_is_that_of_small_loops() {
    let connection = Connection::new(&problems::two_link()).unwrap();
    // Turn of the base along a straight leg, Simpson's rule.
    let leg = |from: [f64; 2], to: [f64; 2]| {
        let along = |part: f64| {
            let theta = [0, 1].map(|i| from[i] + part * (to[i] - from[i]));
            let [a, b] = connection.coefficients(theta);
            a * (to[0] - from[0]) + b * (to[1] - from[1])
        };
        (along(0.0) + 4.0 * along(0.5) + along(1.0)) / 6.0
    };
    let h = 0.01;
    for theta in [[0.0, 0.0], [0.4, -1.1], [-1.3, 0.7], [1.5, 1.5]] {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[a, b]| [theta[0] + 0.5 * h * a, theta[1] + 0.5 * h * b]);
        let round: f64 = (0..4).map(|k| leg(corners[k], corners[(k + 1) % 4])).sum();
        let curvature = connection.curvature(theta);
        assert!(
            (round / (h * h) - curvature).abs() < 1e-5,
            "{theta:?}: {} against {curvature}",
            round / (h * h)
        );
    }
    // One joint alone cannot enclose an area, and three are another problem.
    assert!(Connection::new(&problems::two_link().in_space()).is_none());
}

#[test]
fn loops_within_the_joint_limits_gain_little() {
    let connection = Connection::new(&problems::two_link()).unwrap();
    let half = 0.5 * PI;
    let coarse = connection.over([-half; 2], [half; 2], 60);
    let fine = connection.over([-half; 2], [half; 2], 120);
    assert!((fine.largest - 0.156).abs() < 5e-4, "{fine:?}");
    assert!(coarse.largest <= fine.largest && fine.parts[0] < 10_f64.to_radians());
    // Stokes over the whole box: around its edges, by the trapezoidal rule.
    let n = 2000;
    let edge = |fixed: usize, at: f64| -> f64 {
        let value = |k: usize| {
            let mut theta = [at; 2];
            theta[1 - fixed] = -half + PI * k as f64 / n as f64;
            connection.coefficients(theta)[1 - fixed]
        };
        let sum: f64 = (0..n).map(|k| 0.5 * (value(k) + value(k + 1))).sum();
        sum * PI / n as f64
    };
    let around = edge(1, -half) + edge(0, half) - edge(1, half) - edge(0, -half);
    assert!((fine.box_loop - around).abs() < 1e-4, "{fine:?}, {around}");
}

/// The problem of one joint, with `key` of its limits at so many radians.
fn one_joint(key: &str, bound: f64) -> Problem {
    let mut overrides = Overrides::default();
    overrides.set(&format!("limits.{key}={bound:e}")).unwrap();
    let path = Path::new("tests/data/one-joint/problem.toml");
    ProblemFile::load(path, &overrides).unwrap().problem
}

#[test]
fn the_bound_of_one_joint_is_what_momentum_asks_and_works() {
    // On one mesh a motion between the points does with 2.13°, and on finer ones the cost grows
    // without end: neither is a motion.
    for key in ["base_attitude", "final_base_attitude"] {
        let found = plan(&one_joint(key, 0.0)).unwrap();
        assert_eq!(found.status, Status::Infeasible, "{key}");
        let diagnosis = found.diagnosis.expect("a diagnosis");
        assert!(diagnosis.converged, "{}", diagnosis.summary);
        let [limit] = &diagnosis.limits[..] else {
            panic!("{}", diagnosis.summary);
        };
        let bound = limit.smallest_bound.upper;
        assert!(
            (bound.to_degrees() - 4.332_97).abs() < 4e-3,
            "{}",
            diagnosis.summary
        );
        // Any path passes all angles in between, so that what works is the least that can.
        let floor = limit.floor.expect("a floor");
        assert!(floor <= bound && floor > 0.999 * bound, "{floor}, {bound}");
        let again = plan(&one_joint(key, 1.01 * bound)).unwrap();
        assert_eq!(again.status, Status::Solved, "{key}: {:?}", again.diagnosis);
    }
}

#[test]
fn the_diagnosis_keeps_the_time_it_was_given() {
    let problem = problems::published()
        .edited(|problem| problem.solver.time_limit = Some(Duration::from_nanos(1)))
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert_eq!(plan.iterations.len(), 1);
    let warned = plan.warnings.iter().any(|text| text.contains("time limit"));
    assert!(warned, "{:?}", plan.warnings);
}

#[test]
fn too_few_iterations_are_no_reason_to_doubt_the_limits() {
    let problem = problems::published()
        .edited(|problem| problem.solver.max_iterations = 3)
        .unwrap();
    let mut asked = false;
    let plan = Planner::new()
        .plan_with(&problem, None, &mut |event| {
            asked |= matches!(event, Event::Diagnosing { .. });
            Control::Continue
        })
        .unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert!(!asked, "no diagnosis");
    let iterations: u32 = plan.iterations.iter().map(|mesh| mesh.nlp_iterations).sum();
    assert_eq!(iterations, 3);
}

#[test]
fn many_joints_keep_the_time_they_were_given() {
    const JOINTS: usize = 12;
    let robot = trees::chain(JOINTS, 5);
    let mut problem = Problem::builder("chain", robot, 20.0, &[0.0; JOINTS], &[0.1; JOINTS]);
    problem.cost.joint_rate = vec![1.0; JOINTS];
    // Not to be had, so that there is something to diagnose.
    problem.limits.base_attitude = vec![Interval::symmetric(0.0); 3];
    problem.solver.time_limit = Some(Duration::from_nanos(1));
    let mut asked = false;
    let plan = Planner::new()
        .plan_with(&problem.build().unwrap(), None, &mut |event| {
            asked |= matches!(event, Event::Diagnosing { .. });
            Control::Continue
        })
        .unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert!(!asked && plan.iterations.len() == 1);
    assert!(plan.objective.is_finite() && plan.iterate.x.iter().all(|x| x.is_finite()));
    let warned = plan.warnings.iter().any(|text| text.contains("time limit"));
    assert!(warned, "{:?}", plan.warnings);
}
