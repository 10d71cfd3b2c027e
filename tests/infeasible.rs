//! The published case is infeasible: the diagnosis against dynamic programming.

mod problems;

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::space::Planar;
use ffsm_ipopt::dynamics::{Data, Tree};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Problem, Status, plan};
use std::f64::consts::PI;

#[test]
fn the_published_case_names_the_base_attitude_and_the_smallest_bound() {
    let plan = plan(&problems::published()).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let diagnosis = plan.diagnosis.expect("a diagnosis");
    assert!(
        diagnosis
            .limits
            .iter()
            .all(|l| l.component == "base attitude"),
        "{diagnosis:?}"
    );
    let along = diagnosis
        .limits
        .iter()
        .find(|l| l.key == "limits.base_attitude")
        .unwrap();
    let end = diagnosis
        .limits
        .iter()
        .find(|l| l.key == "limits.final_base_attitude")
        .unwrap();
    let smallest = along
        .smallest_bound
        .upper
        .max(end.smallest_bound.upper)
        .to_degrees();
    let bound = smallest_bound_by_dynamic_programming().to_degrees();
    assert!(
        (bound - 28.5).abs() < 0.3,
        "dynamic programming finds {bound}°"
    );
    assert!(
        smallest > bound - 0.2,
        "{smallest}° is below what is possible, {bound}°"
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
    let mut problem = problems::published();
    problem.limits.base_attitude = vec![Interval::symmetric(29.2_f64.to_radians())];
    problem.limits.final_base_attitude = problem.limits.base_attitude.clone();
    problem.mesh.tolerance = 1.0;
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.diagnosis);
    assert!(plan.metrics.max_base_attitude.to_degrees() < 29.2 + 1e-3);
}

#[test]
fn a_limit_on_the_joints_is_named_too() {
    // A radian in half a second at 0.9 rad/s: no base limit has a part in it.
    let mut problem = problems::relaxed();
    problem.task.duration = Interval::fixed(0.5);
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.expect("a diagnosis").limits;
    assert!(
        limits.iter().any(|l| l.key == "limits.joint_velocity"),
        "{limits:?}"
    );
    assert!(
        limits
            .iter()
            .all(|l| l.excess > 0.0 && l.smallest_bound.upper > l.bound.upper)
    );
}

#[test]
fn a_limit_on_the_rotation_angle_is_named_in_degrees() {
    // An arm that can hardly move on a base that tumbles: as one body, by L/I·t about z.
    let mut problem = Problem::new(
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
    let keys: Vec<&str> = diagnosis.limits.iter().map(|l| l.key.as_str()).collect();
    assert_eq!(keys, ["limits.base_attitude", "limits.final_base_attitude"]);
    for (limit, bound) in diagnosis.limits.iter().zip([0.1, 0.05]) {
        assert_eq!(limit.component, "base rotation angle");
        assert_eq!((limit.bound.lower, limit.bound.upper), (0.0, bound));
        let gap = (limit.smallest_bound.upper - turned).abs();
        assert!(gap < 2e-3 * turned, "{limit:?}, expected {turned}");
    }
    let start = "limits.base_attitude = 5.73° (base rotation angle) cannot hold; the smallest";
    assert!(
        diagnosis.summary.starts_with(start),
        "{}",
        diagnosis.summary
    );
}

/// Smallest bound on |η| along the path for which the goal can be reached in time, the joints
/// moving at up to 0.9 rad/s without limits on acceleration.
///
/// On a grid of joint angles, one step moves each joint by one cell at most; the range of base
/// attitudes that can be reached within the bound is carried along. A lower bound, up to the
/// grid's error: what is left out only helps.
fn smallest_bound_by_dynamic_programming() -> f64 {
    let (mut low, mut high) = (10.0_f64.to_radians(), 40.0_f64.to_radians());
    let grid = Grid::new(61);
    for _ in 0..9 {
        let middle = 0.5 * (low + high);
        if grid.reaches(middle) {
            high = middle
        } else {
            low = middle
        }
    }
    high
}

const MOVES: [[isize; 2]; 9] = [
    [0, 0],
    [0, 1],
    [0, -1],
    [1, 0],
    [-1, 0],
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
];

struct Grid {
    n: usize,
    steps: usize,
    /// Turn of the base for each move that ends at a cell.
    turn: Vec<[f64; 9]>,
}

impl Grid {
    fn new(n: usize) -> Self {
        let cell = PI / (n - 1) as f64;
        let tree = Tree::<Planar>::planar(&problems::two_link()).unwrap();
        let mut data = Data::<Planar, f64>::new(&tree);
        let angle = |i: usize| -0.5 * PI + i as f64 * cell;
        let mut turn = Vec::new();
        for i in 0..n {
            for j in 0..n {
                turn.push(MOVES.map(|[a, b]| {
                    let (a, b) = (a as f64 * cell, b as f64 * cell);
                    tree.kinematics(&[angle(i) - 0.5 * a, angle(j) - 0.5 * b], &mut data);
                    tree.momentum(&mut data);
                    tree.base_rate(&[a, b], &mut data);
                    data.base_rate.x.value()
                }));
            }
        }
        Self {
            n,
            steps: (20.0 * 0.9 / cell) as usize,
            turn,
        }
    }

    fn reaches(&self, bound: f64) -> bool {
        let n = self.n as isize;
        let nothing = [f64::INFINITY, f64::NEG_INFINITY];
        let cell = |angle: f64| ((angle / PI + 0.5) * (n - 1) as f64).round() as usize;
        let index = |i: usize, j: usize| i * self.n + j;
        let mut range = vec![nothing; self.n * self.n];
        range[index(cell(0.0), cell(0.0))] = [0.0, 0.0];
        for _ in 0..self.steps {
            let mut next = vec![nothing; range.len()];
            for (k, reached) in next.iter_mut().enumerate() {
                let (i, j) = (k as isize / n, k as isize % n);
                for ([a, b], turn) in MOVES.iter().zip(self.turn[k]) {
                    let (from_i, from_j) = (i - a, j - b);
                    if !(0..n).contains(&from_i) || !(0..n).contains(&from_j) {
                        continue;
                    }
                    let [low, high] = range[(from_i * n + from_j) as usize].map(|eta| eta + turn);
                    if low <= bound && high >= -bound {
                        reached[0] = reached[0].min(low.max(-bound));
                        reached[1] = reached[1].max(high.min(bound));
                    }
                }
            }
            range = next;
        }
        let [low, high] = range[index(cell(PI / 6.0), cell(PI / 3.0))];
        low <= high
    }
}
