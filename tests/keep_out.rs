//! Pairs kept apart along the path.

mod problems;

use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::{KeepOut, LimitId, Problem, ProblemBuilder, Solid, Unit};

/// The two-link arm swings its elbow from one side to the other, past a mast on the base.
fn swing() -> Problem {
    let mut problem = problems::smooth().into_builder();
    problem.task.initial_joints = vec![0.9, 0.5];
    problem.task.final_joints = vec![-0.9, -0.5];
    problem.limits.joint_position = vec![Interval::symmetric(2.8); 2];
    problem.mesh.tolerance = 1e-3;
    problem.mesh.segments = 20;
    problem.mesh.max_iterations = Some(15);
    problem.build().unwrap()
}

/// The plan of a problem in the making.
fn solve(problem: &ProblemBuilder) -> Plan {
    plan(&problem.clone().build().unwrap()).unwrap()
}

/// Joint positions at many times, far more than the mesh has nodes.
fn joints(plan: &Plan) -> Vec<[f64; 2]> {
    let mut x = vec![0.0; plan.discretization.states];
    let mut u = vec![0.0; plan.discretization.controls];
    (0..=5000)
        .map(|k| {
            let fraction = f64::from(k) / 5000.0;
            plan.discretization.at_fraction(fraction, &mut x, &mut u);
            [x[1], x[2]]
        })
        .collect()
}

/// Distances of the forearm's end from a point of the base.
fn distances(plan: &Plan, point: [f64; 2]) -> Vec<f64> {
    let tips = joints(plan).into_iter().map(tip);
    tips.map(|(x, y)| (x - point[0]).hypot(y - point[1]))
        .collect()
}

/// The forearm's end in the base frame.
fn tip(q: [f64; 2]) -> (f64, f64) {
    let (a, b) = (q[0], q[0] + q[1]);
    let x = 0.156 + 0.506 * a.cos() + 0.506 * b.cos();
    let y = 0.506 * a.sin() + 0.506 * b.sin();
    (x, y)
}

/// The forearm's end, as a ball, and what it is kept out of.
fn off(name: &str, radius: f64, second: Solid) -> Vec<KeepOut> {
    vec![KeepOut {
        name: name.into(),
        first: Solid::sphere(Some(1), [0.506, 0.0, 0.0], radius),
        second,
    }]
}

const MAST: [f64; 2] = [1.0, 0.0];

/// The swing with 0.3 m kept between the forearm's end and the mast.
fn around_the_mast() -> Problem {
    let mut problem = swing().into_builder();
    let mast = Solid::sphere(None, [MAST[0], MAST[1], 0.0], 0.25);
    problem.limits.keep_out = off("mast", 0.05, mast);
    problem.build().unwrap()
}

fn closest(plan: &Plan) -> f64 {
    let distances = distances(plan, MAST).into_iter();
    distances.fold(f64::INFINITY, f64::min)
}

/// What is left of 0.3 m with the tolerance of one in a thousand.
const NEAREST: f64 = 0.3 * (1.0 - 1.01e-3);

#[test]
fn the_arm_goes_around_a_sphere() {
    let free = plan(&swing()).unwrap();
    assert!(closest(&free) < 0.25, "the task would not need the limit");
    let around = plan(&around_the_mast()).unwrap();
    assert_eq!(around.status, Status::Solved, "{:?}", around.iterations);
    assert_eq!(around.warnings, [""; 0]);
    assert!(closest(&around) > NEAREST, "{}", closest(&around));
}

#[test]
fn slipping_through_between_points_is_no_solution() {
    let mut problem = around_the_mast().into_builder();
    // The error estimate is content with anything.
    problem.mesh.tolerance = 10.0;
    problem.mesh.segments = 4;
    problem.mesh.points = 4;
    problem.mesh.max_iterations = Some(1);
    let coarse = solve(&problem);
    assert_eq!(coarse.status, Status::NotConverged);
    assert!(coarse.max_error < problem.mesh.tolerance);
    let depth = 0.3 - closest(&coarse);
    assert!(depth > 0.05, "{depth}");
    let [warning] = &coarse.warnings[..] else {
        panic!("{:?}", coarse.warnings);
    };
    let told = warning.strip_prefix("limits.keep_out (mast) is exceeded by ");
    let told = told.and_then(|rest| rest.split_once(" m between the points of the mesh, at "));
    let (size, when) = told.expect(warning);
    let size: f64 = size.parse().unwrap();
    assert!((size - depth).abs() < 0.2 * depth, "{size} of {depth}");
    assert!(when.contains(" s; more mesh.segments"), "{warning}");
}

#[test]
fn coming_too_near_between_points_is_refined_away() {
    let mut problem = around_the_mast().into_builder();
    problem.mesh.tolerance = 10.0;
    problem.mesh.points = 4;
    let refined = solve(&problem);
    assert_eq!(refined.status, Status::Solved);
    assert_eq!(refined.warnings, [""; 0]);
    assert!(closest(&refined) > NEAREST, "{}", closest(&refined));
    // A mesh before the last was good enough for the error, not for the mast.
    let iterations = &refined.iterations;
    let before = &iterations[iterations.len() - 2];
    assert!(before.nlp_status.is_solved() && before.max_violation > 1e-3);
}

/// Smallest distance of the forearm's end from a box with edges along the axes.
fn closest_to_box(plan: &Plan, center: [f64; 2], half: [f64; 2]) -> f64 {
    let tips = joints(plan).into_iter().map(tip);
    let distances = tips.map(|(x, y)| {
        let dx = (x - center[0]).abs() - half[0];
        let dy = (y - center[1]).abs() - half[1];
        dx.max(0.0).hypot(dy.max(0.0)) + dx.max(dy).min(0.0)
    });
    distances.fold(f64::INFINITY, f64::min)
}

#[test]
fn the_arm_stays_out_of_a_box_and_no_farther() {
    let mut problem = swing().into_builder();
    let (center, half) = ([1.0, 0.0, 0.0], [0.15, 0.15, 0.2]);
    problem.limits.keep_out = off("box", 0.05, Solid::cuboid(None, center, half));
    let plan = solve(&problem);
    assert_eq!(plan.status, Status::Solved);
    // What is left between the points is small, and said.
    let left = plan.iterations.last().unwrap().max_violation;
    assert!(left < 5e-3, "{left}");
    assert_eq!(
        left > problem.mesh.bound_tolerance,
        !plan.warnings.is_empty()
    );
    let clearance = closest_to_box(&plan, [1.0, 0.0], [0.15, 0.15]) - 0.05;
    assert!(clearance.abs() < 2e-3 * 0.15, "{clearance}");
}

#[test]
fn the_arm_may_touch_a_face() {
    let mut problem = swing().into_builder();
    // A wall at x = 0.7 m: a face of a box of 2 m.
    let (center, half) = ([1.7, 0.0, 0.0], [1.0; 3]);
    problem.limits.keep_out = off("wall", 0.05, Solid::cuboid(None, center, half));
    let plan = solve(&problem);
    assert_eq!(plan.status, Status::Solved);
    let farthest = joints(&plan)
        .into_iter()
        .map(|q| tip(q).0)
        .fold(0.0, f64::max);
    assert!((farthest - 0.65).abs() < 2e-3, "{farthest}");
}

/// A sphere at one height that the forearm's end passes below.
#[test]
fn what_is_above_the_plane_is_not_in_the_way() {
    let mut problem = swing().into_builder();
    let free = solve(&problem);
    for (height, in_the_way) in [(0.35, false), (0.1, true)] {
        let above = Solid::sphere(None, [MAST[0], MAST[1], height], 0.25);
        problem.limits.keep_out = off("above", 0.05, above);
        let plan = solve(&problem);
        assert_eq!(plan.status, Status::Solved);
        // The way round may well be the better one of two optima.
        let around = (plan.objective - free.objective).abs() > 1e-4;
        assert_eq!(around, in_the_way, "{height}");
        let apart = closest(&plan).hypot(height);
        assert!(apart > NEAREST, "{apart}");
    }
}

/// The swing to joints at zero, where the forearm's end is 0.232 m from the middle of a sphere of
/// this radius.
fn into_a_sphere(radius: f64) -> Problem {
    let mut problem = swing().into_builder();
    problem.task.final_joints = vec![0.0, 0.0];
    problem.limits.keep_out = off("wall", 0.0, Solid::sphere(None, [1.4, 0.0, 0.0], radius));
    problem.mesh.segments = 4;
    problem.mesh.points = 4;
    problem.mesh.max_iterations = Some(1);
    problem.build().unwrap()
}

#[test]
fn a_goal_inside_an_obstacle_is_named_with_a_clearance_that_works() {
    let plan = plan(&into_a_sphere(0.6)).unwrap();
    assert_eq!(plan.status, Status::Infeasible, "{:?}", plan.iterations);
    let diagnosis = plan.diagnosis.unwrap();
    let [limit] = &diagnosis.limits[..] else {
        panic!("{:?}", diagnosis.limits);
    };
    assert_eq!(limit.limit, LimitId::KeepOut);
    assert_eq!(limit.unit, Unit::Metre);
    assert_eq!(limit.bound, Interval::new(0.0, f64::INFINITY));
    let works = limit.smallest_bound.lower;
    assert!((works + 0.368).abs() < 1e-3, "{works}");
    let told = "limits.keep_out = a clearance of 0.0000 m (wall) was not found to hold; the \
                smallest bound that was found to work is a clearance of -0.368";
    assert!(diagnosis.summary.contains(told), "{}", diagnosis.summary);
    let again = ffsm_ipopt::planner::plan(&into_a_sphere(0.6 + 1.01 * works)).unwrap();
    let last = again.iterations.last().unwrap();
    assert!(last.nlp_status.is_solved(), "{:?}", last.nlp_status);
}

/// A gap between two spheres that the forearm's end has to pass, as wide as the figure says.
#[test]
fn a_passage_that_is_too_narrow_is_named_with_a_clearance_that_works() {
    // The end starts and stops within reach and has to cross a ring around the base.
    let ring = |radius: f64| {
        let mut problem = swing().into_builder();
        problem.limits.keep_out = off("ring", 0.02, Solid::sphere(None, [0.6, 0.0, 0.0], radius));
        problem.limits.joint_position = vec![Interval::symmetric(1.6); 2];
        problem.mesh.segments = 10;
        problem.mesh.max_iterations = Some(3);
        problem.build().unwrap()
    };
    let plan = plan(&ring(0.8)).unwrap();
    assert_eq!(plan.status, Status::Infeasible, "{:?}", plan.iterations);
    let limits = plan.diagnosis.unwrap().limits;
    let pair = limits.iter().find(|l| l.limit == LimitId::KeepOut);
    let works = pair.expect("the pair is named").smallest_bound.lower;
    assert!((-0.8..-0.1).contains(&works), "{works}");
    let again = ffsm_ipopt::planner::plan(&ring(0.8 + 1.01 * works)).unwrap();
    assert_ne!(again.status, Status::Infeasible, "{works}");
}

#[test]
fn a_pair_may_have_any_name() {
    let mut problem = into_a_sphere(0.6).into_builder();
    problem.limits.keep_out[0].name = "base rotation angle".into();
    let plan = solve(&problem);
    assert_eq!(plan.status, Status::Infeasible, "{:?}", plan.iterations);
}

/// The whole forearm, as a capsule, goes around a mast that its end alone would pass by.
#[test]
fn a_link_is_kept_off_along_its_whole_length() {
    let mut problem = swing().into_builder();
    let mast = Solid::sphere(None, [MAST[0], MAST[1], 0.0], 0.05);
    let forearm = Solid::capsule(Some(1), [[0.0; 3], [0.506, 0.0, 0.0]], 0.03);
    problem.limits.keep_out = vec![KeepOut {
        name: "forearm off the mast".into(),
        first: forearm,
        second: mast,
    }];
    problem.mesh.max_iterations = Some(25);
    let plan = solve(&problem);
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.warnings);
    let nearest = joints(&plan).into_iter().map(|q| {
        let elbow = [0.156 + 0.506 * q[0].cos(), 0.506 * q[0].sin()];
        let (x, y) = tip(q);
        let along = [x - elbow[0], y - elbow[1]];
        let to_mast = [MAST[0] - elbow[0], MAST[1] - elbow[1]];
        let place = (along[0] * to_mast[0] + along[1] * to_mast[1]) / 0.506_f64.powi(2);
        let place = place.clamp(0.0, 1.0);
        (to_mast[0] - place * along[0]).hypot(to_mast[1] - place * along[1])
    });
    let nearest = nearest.fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.08 - 1e-3, "{nearest}");
}
