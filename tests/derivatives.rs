//! Jacobian and Hessian of whole programmes against `num-dual`, an independent exact method, and
//! against their own sparsity pattern.

mod allocations;
mod problems;
mod trees;

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::{Model, Placement};
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::ocp::{
    self, Elastic, Ends, Formulation, Interval, LimitGroup, Ocp, Passage, Point, Quantity,
};
use ffsm_ipopt::planner::{
    EndEffectorGoal, FreeFloating, GoalFrame, KeepOut, Moment, Obstacle, Problem, Sphere, WayPoint,
};
use ffsm_ipopt::transcription::{Patterns, Transcription};
use num_dual::{DualNum, HyperDual64};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A `num-dual` number as a [`Scalar`]: arithmetic and functions are all its own.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Reference(HyperDual64);

macro_rules! operators {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident),*) => {$(
        impl $trait for Reference {
            type Output = Self;
            fn $method(self, rhs: Self) -> Self { Self($trait::$method(self.0, rhs.0)) }
        }
        impl $trait<f64> for Reference {
            type Output = Self;
            fn $method(self, rhs: f64) -> Self {
                Self($trait::$method(self.0, HyperDual64::from_re(rhs)))
            }
        }
        impl $assign_trait for Reference {
            fn $assign(&mut self, rhs: Self) { *self = $trait::$method(*self, rhs); }
        }
    )*};
}
operators!(Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign);

impl Div for Reference {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        Self(self.0 / rhs.0)
    }
}
impl Neg for Reference {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}
impl Zero for Reference {
    fn zero() -> Self {
        Self::constant(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0.re == 0.0
    }
}
impl One for Reference {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
impl Scalar for Reference {
    fn constant(value: f64) -> Self {
        Self(HyperDual64::from_re(value))
    }
    fn value(&self) -> f64 {
        self.0.re
    }
    fn chain(self, value: f64, first: f64, second: f64) -> Self {
        let HyperDual64 {
            eps1,
            eps2,
            eps1eps2,
            ..
        } = self.0;
        let both = first * eps1eps2 + second * eps1 * eps2;
        Self(HyperDual64::new(value, first * eps1, first * eps2, both))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Self(s), Self(c))
    }
    fn recip(self) -> Self {
        Self(self.0.recip())
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}

/// Objective and constraints of the programme, written out anew from (25) to (27).
fn programme<O: Ocp>(ocp: &O, mesh: &Mesh, v: &[Reference]) -> (Reference, Vec<Reference>) {
    let f: Formulation = ocp.formulation();
    let (n, m) = f.widths();
    let width = n + m;
    let node = |k: usize| &v[k * width..];
    let duration = if f.duration.is_fixed() {
        Reference::constant(f.duration.lower)
    } else {
        v[v.len() - 1]
    };
    let mut scratch = ocp.scratch();
    let mut rows = Vec::new();
    let mut cost = Reference::zero();
    let points = mesh.points();
    let mut k = 0;
    for s in 0..mesh.segments() {
        let rule = mesh.rule(s);
        let half = duration * (0.5 * mesh.width(s));
        for i in 0..rule.len() {
            for (w, passed) in f.way_points.iter().enumerate() {
                if mesh.node_at(passed.fraction) == Some(k) {
                    let mut own = vec![Reference::zero(); passed.rows.len()];
                    let passage = Passage {
                        way_point: w,
                        x: &node(k)[..n],
                        t: duration * passed.fraction,
                    };
                    ocp.way_point(passage, &mut scratch, &mut own);
                    rows.extend(own);
                }
            }
            let t = duration * mesh.fraction(s, rule.points()[i]);
            let mut rates = vec![Reference::zero(); n];
            let mut path = vec![Reference::zero(); f.path.len()];
            let point = Point {
                x: &node(k)[..n],
                u: &node(k)[n..width],
                t,
            };
            let running = ocp.continuous(point, &mut scratch, &mut rates, &mut path);
            cost += running * half * rule.weights()[i];
            for (r, &rate) in rates.iter().enumerate() {
                let mut defect = Reference::zero();
                for (j, &d) in rule.differentiation(i).iter().enumerate() {
                    defect += node(mesh.start(s) + j)[r] * d;
                }
                rows.push(defect - half * rate);
            }
            rows.extend(path);
            k += 1;
        }
    }
    let mut boundary = vec![Reference::zero(); f.boundary.len()];
    let ends = Ends {
        initial: &node(0)[..n],
        terminal: &node(points)[..n],
        duration,
    };
    cost += ocp.boundary(ends, &mut scratch, &mut boundary);
    rows.extend(boundary);
    (cost, rows)
}

fn random_within(bounds: (f64, f64), random: &mut fastrand::Rng) -> f64 {
    let (lower, upper) = (bounds.0.max(-1.2), bounds.1.min(1.2));
    if lower < upper {
        lower + random.f64() * (upper - lower)
    } else {
        bounds.0
    }
}

/// Compares everything at two random points; every nonzero must be alive at one of them.
fn check<O: Ocp>(ocp: &O, mesh: Mesh) {
    let mut nlp = Transcription::new(ocp, &Patterns::detect(ocp), mesh.clone());
    let size = nlp.size();
    let (n, m) = (size.variables, size.constraints);
    let mut random = fastrand::Rng::with_seed(7);
    let (mut rows, mut columns) = (
        vec![0; size.jacobian_nonzeros],
        vec![0; size.jacobian_nonzeros],
    );
    nlp.jacobian_structure(&mut rows, &mut columns);
    let (mut h_rows, mut h_columns) = (
        vec![0; size.hessian_nonzeros],
        vec![0; size.hessian_nonzeros],
    );
    nlp.hessian_structure(&mut h_rows, &mut h_columns);
    assert!(
        h_rows.iter().zip(&h_columns).all(|(r, c)| r >= c),
        "lower triangle only"
    );
    let mut alive = (vec![false; rows.len()], vec![false; h_rows.len()]);
    let (mut lower, mut upper) = (vec![0.0; n], vec![0.0; n]);
    nlp.variable_bounds(&mut lower, &mut upper);

    for _ in 0..2 {
        let x: Vec<f64> = (0..n)
            .map(|i| random_within((lower[i] - 0.3, upper[i] + 0.4), &mut random))
            .collect();
        let lambda: Vec<f64> = (0..m).map(|_| 2.0 * random.f64() - 1.0).collect();
        let sigma = 0.7;
        nlp.new_point();
        let mut gradient = vec![0.0; n];
        let mut values = vec![0.0; rows.len()];
        let mut hessian = vec![0.0; h_rows.len()];
        let mut constraints = vec![0.0; m];
        nlp.hessian(&x, sigma, &lambda, &mut hessian).unwrap();
        nlp.jacobian(&x, &mut values).unwrap();
        nlp.gradient(&x, &mut gradient).unwrap();
        nlp.constraints(&x, &mut constraints).unwrap();
        let objective = nlp.objective(&x).unwrap();

        let mut jacobian = vec![vec![0.0; n]; m];
        rows.iter()
            .zip(&columns)
            .zip(&values)
            .for_each(|((&r, &c), v)| jacobian[r][c] += v);
        let mut dense = vec![vec![0.0; n]; n];
        h_rows
            .iter()
            .zip(&h_columns)
            .zip(&hessian)
            .for_each(|((&r, &c), v)| dense[r][c] += v);
        // Lower triangle by rows.
        let mut expected_hessian = Vec::new();
        for i in 0..n {
            let mut expected = Vec::new();
            for j in 0..=i {
                let seeded: Vec<Reference> = (0..n)
                    .map(|k| {
                        let one = |hit: bool| if hit { 1.0 } else { 0.0 };
                        Reference(HyperDual64::new(x[k], one(k == i), one(k == j), 0.0))
                    })
                    .collect();
                let (f, g) = programme(ocp, &mesh, &seeded);
                if j == i {
                    close(f.0.re, objective, objective.abs(), "objective");
                    close(gradient[i], f.0.eps1, f.0.eps1.abs().max(1.0), "gradient");
                    for r in 0..m {
                        close(constraints[r], g[r].0.re, 10.0, "constraint");
                        let scale = g[r].0.eps1.abs().max(1.0);
                        close(jacobian[r][i], g[r].0.eps1, scale, &nlp.constraint_name(r));
                    }
                }
                let second = sigma * f.0.eps1eps2
                    + g.iter()
                        .zip(&lambda)
                        .map(|(g, l)| l * g.0.eps1eps2)
                        .sum::<f64>();
                expected.push(second);
            }
            expected_hessian.push(expected);
        }
        let scale = expected_hessian
            .iter()
            .flatten()
            .fold(0.0_f64, |a, b| a.max(b.abs()));
        for (i, expected) in expected_hessian.iter().enumerate() {
            for (j, &expected) in expected.iter().enumerate() {
                let what = format!("{} × {}", nlp.variable_name(i), nlp.variable_name(j));
                close(dense[i][j], expected, scale, &what);
            }
        }
        alive
            .0
            .iter_mut()
            .zip(&values)
            .for_each(|(a, v)| *a |= v.abs() > 1e-13);
        alive
            .1
            .iter_mut()
            .zip(&hessian)
            .for_each(|(a, v)| *a |= v.abs() > 1e-13 * scale);
    }
    for (k, alive) in alive.0.iter().enumerate() {
        let (row, column) = (nlp.constraint_name(rows[k]), nlp.variable_name(columns[k]));
        assert!(alive, "structural zero in the Jacobian: {row} by {column}");
    }
    for (k, alive) in alive.1.iter().enumerate() {
        let (row, column) = (
            nlp.variable_name(h_rows[k]),
            nlp.variable_name(h_columns[k]),
        );
        assert!(alive, "structural zero in the Hessian: {row} × {column}");
    }
}

/// Relative to `scale` to 1e-10, as the derivatives must be.
fn close(found: f64, expected: f64, scale: f64, what: &str) {
    assert!(
        (found - expected).abs() <= 1e-10 * scale.max(1e-3),
        "{what}: {found:e} instead of {expected:e}"
    );
}

/// Every weight and every limit at work.
fn loaded(robot: Model) -> Problem {
    let n = robot.joint_count();
    let mut problem = Problem::new("loaded", robot, 3.0, &vec![0.1; n], &vec![0.5; n]);
    let (angles, lengths) = Problem::base_sizes(&problem.robot);
    problem.cost.final_base_attitude = vec![1.3; angles];
    problem.cost.final_base_position = vec![0.8; lengths];
    problem.cost.base_rate = vec![0.6; angles];
    problem.cost.joint_rate = vec![0.2; n];
    problem.cost.control = vec![0.1; n];
    problem.limits.base_rate = vec![Interval::symmetric(0.6); angles];
    problem
}

/// The same with the attitude described by `attitude`, its limits at work too.
fn described(mut problem: Problem, attitude: SpatialAttitude) -> Problem {
    problem.set_attitude(attitude);
    problem.cost.final_base_attitude = vec![1.3];
    problem.cost.base_rate = vec![0.6, 0.5, 0.4];
    problem.limits.base_rate = vec![Interval::symmetric(0.6); 3];
    problem.limits.base_attitude = vec![Interval::symmetric(0.9)];
    problem.limits.final_base_attitude = vec![Interval::symmetric(0.4)];
    problem
}

fn check_problem(problem: &Problem, mesh: Mesh) {
    problem.validate().unwrap();
    match FreeFloating::planar(problem) {
        Some(planar) => check(&planar, mesh),
        None => check(&FreeFloating::spatial(problem), mesh),
    }
}

fn small() -> Mesh {
    Mesh::new(vec![0.0, 0.3, 1.0], &[2, 1]).unwrap()
}

#[test]
fn two_joints_in_the_plane() {
    check_problem(&loaded(problems::two_link()), small());
    check_problem(&problems::relaxed(), small());
    check_problem(&problems::smooth(), small());
}

#[test]
fn two_joints_in_the_plane_treated_in_space() {
    let mut problem = loaded(problems::two_link().in_space());
    problem.cost.torque = vec![0.0; 2];
    let mesh = Mesh::uniform(1, 2).unwrap();
    // Motion stays in the plane, so that out-of-plane terms vanish on the joints alone, not by
    // the base's own roll and pitch.
    check_problem(&problem, mesh);
}

#[test]
fn torque_rows_and_costs() {
    let mut problem = loaded(problems::two_link());
    problem.limits.torque = vec![Interval::symmetric(2.0); 2];
    problem.cost.torque = vec![0.3, 0.4];
    problem.cost.rate_matrix = Some(vec![
        vec![0.1, 0.05, 0.0],
        vec![0.05, 0.2, -0.03],
        vec![0.0, -0.03, 0.4],
    ]);
    check_problem(&problem, small());
}

#[test]
fn free_duration() {
    let mut problem = loaded(problems::two_link());
    problem.task.duration = Interval::new(1.0, 5.0);
    check_problem(&problem, small());
}

/// `problem` with a pose for the end effector, fixed in the last body.
fn with_goal(mut problem: Problem, frame: GoalFrame) -> Problem {
    let last = problem.robot.joint_count() - 1;
    let mount = Placement::from_xyz_rpy([0.3, 0.1, -0.2], [0.4, -0.3, 0.8]);
    problem.robot = problem.robot.with_end_effector(Some(last), mount);
    let (angles, lengths) = Problem::base_sizes(&problem.robot);
    problem.task.free_joints = vec![true; last + 1];
    problem.task.end_effector = Some(EndEffectorGoal {
        frame,
        position: Some([0.7, 0.4, -0.3][..lengths].to_vec()),
        position_tolerance: 0.01,
        orientation: Some([0.5, -0.2, 0.9][..angles].to_vec()),
        orientation_tolerance: 0.1,
    });
    problem.cost.duration = 0.3;
    problem.task.duration = Interval::new(1.0, 5.0);
    problem
}

#[test]
fn task_space_goals() {
    for frame in [GoalFrame::Inertial, GoalFrame::Start, GoalFrame::Base] {
        check_problem(&with_goal(loaded(problems::two_link()), frame), small());
        let arm = loaded(trees::chain(3, 4));
        check_problem(&with_goal(arm, frame), Mesh::uniform(1, 2).unwrap());
    }
}

#[test]
fn way_points_in_joint_and_task_space() {
    for robot in [problems::two_link(), trees::chain(3, 4)] {
        let mut problem = with_goal(loaded(robot), GoalFrame::Start);
        problem.task.initial_momentum.linear[0] = 0.4;
        let n = problem.robot.joint_count();
        let goal = problem.task.end_effector.clone().unwrap();
        let mut stop = WayPoint::joints(Moment::Fraction(0.6), &vec![0.3; n]);
        stop.joints[0] = None;
        stop.joint_rates[0] = Some(0.0);
        let pose = WayPoint::pose(Moment::Fraction(0.3), n, goal);
        problem.task.way_points = vec![pose, stop];
        let mesh = Mesh::new(vec![0.0, 0.3, 0.6, 1.0], &[1, 1, 1]).unwrap();
        check_problem(&problem, mesh.clone());
        if problem.robot.plane().is_some() {
            let system = FreeFloating::planar(&problem).unwrap();
            check(&Elastic::new(&system, system.limit_groups(), 1e-3), mesh);
        }
    }
}

#[test]
fn pairs_kept_apart() {
    let sphere = |joint, radius| Sphere {
        joint,
        center: [0.3, 0.1, -0.2],
        radius,
    };
    for robot in [problems::two_link(), trees::chain(3, 8)] {
        let mut problem = loaded(robot);
        let last = problem.robot.joint_count() - 1;
        let pair = |from| KeepOut {
            name: "apart".into(),
            sphere: sphere(Some(last), 0.1),
            from,
        };
        let (center, half) = ([0.1, -0.2, 0.3], [0.6, 0.5, 0.4]);
        problem.limits.keep_out = vec![
            pair(Obstacle::Sphere(sphere(None, 0.5))),
            pair(Obstacle::Sphere(sphere(Some(0), 0.2))),
            pair(Obstacle::Box { center, half }),
        ];
        problem.limits.torque = vec![Interval::symmetric(3.0); last + 1];
        check_problem(&problem, Mesh::uniform(1, 2).unwrap());
    }
}

#[test]
fn a_system_that_drifts_and_tumbles() {
    for robot in [problems::two_link(), trees::chain(3, 6)] {
        let mut problem = with_goal(loaded(robot), GoalFrame::Inertial);
        let momentum = &mut problem.task.initial_momentum;
        momentum
            .linear
            .iter_mut()
            .enumerate()
            .for_each(|(i, p)| *p = 0.4 - 0.3 * i as f64);
        momentum
            .angular
            .iter_mut()
            .enumerate()
            .for_each(|(i, l)| *l = 0.2 + 0.1 * i as f64);
        check_problem(&problem, Mesh::uniform(1, 2).unwrap());
    }
}

#[test]
fn three_joints_in_space() {
    check_problem(&loaded(trees::chain(3, 3)), small());
}

#[test]
fn a_tree_with_a_sliding_joint() {
    let kinds = [
        trees::REVOLUTE,
        trees::PRISMATIC,
        trees::REVOLUTE,
        trees::PRISMATIC,
    ];
    let rng = &mut fastrand::Rng::with_seed(11);
    let robot = trees::random(rng, &[None, Some(0), Some(0), None], &kinds);
    check_problem(&loaded(robot), Mesh::uniform(1, 2).unwrap());
}

#[test]
fn seven_joints_in_space() {
    check_problem(&loaded(trees::chain(7, 5)), Mesh::uniform(1, 2).unwrap());
}

#[test]
fn attitude_by_quaternion_and_by_rodrigues_parameters() {
    for attitude in [SpatialAttitude::Quaternion, SpatialAttitude::Mrp] {
        let arm = described(loaded(trees::chain(3, 4)), attitude);
        check_problem(&arm, Mesh::uniform(1, 2).unwrap());
        let mut tumbling = with_goal(arm, GoalFrame::Start);
        tumbling.task.initial_momentum.angular = vec![0.2, -0.3, 0.4];
        tumbling.limits.final_base_attitude = vec![Interval::symmetric(1.2)];
        check_problem(&tumbling, Mesh::uniform(1, 2).unwrap());
        // The limits on the rotation angle give way as one.
        let system = FreeFloating::spatial(&tumbling);
        let groups = system.limit_groups();
        let turn = |g: &&LimitGroup| g.name == "base rotation angle";
        let turn: Vec<_> = groups.iter().filter(turn).cloned().collect();
        assert_eq!((turn.len(), turn[0].members.len()), (1, 3), "{turn:?}");
        check(
            &Elastic::new(&system, turn, 1e-3),
            Mesh::uniform(1, 1).unwrap(),
        );
    }
}

#[test]
fn elastic_limits() {
    let problem = problems::published();
    let system = FreeFloating::planar(&problem).unwrap();
    check(&Elastic::new(&system, system.limit_groups(), 1e-3), small());
}

/// A problem without derivatives of its own, so that dual numbers are swept over all of it.
struct Swept<'a, O>(&'a O);

impl<O: Ocp> Ocp for Swept<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn formulation(&self) -> Formulation {
        self.0.formulation()
    }

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        self.0.scratch()
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        self.0.continuous(point, scratch, rates, path)
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        self.0.boundary(ends, scratch, rows)
    }

    fn way_point<S: Scalar>(
        &self,
        passage: Passage<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        self.0.way_point(passage, scratch, rows);
    }
}

/// Jacobian and Hessian of one programme by structure and by sweeps, to 1e-12 of the largest; a
/// second evaluation by structure allocates nothing.
fn compare<O: Ocp>(ocp: &O, mesh: Mesh) {
    assert!(ocp.derivatives().is_some(), "derivatives of its own");
    let patterns = Patterns::detect(ocp);
    let swept = Swept(ocp);
    let mut by_structure = Transcription::new(ocp, &patterns, mesh.clone());
    let mut by_sweeps = Transcription::new(&swept, &patterns, mesh);
    let size = by_structure.size();
    let mut random = fastrand::Rng::with_seed(3);
    let mut draw =
        |count: usize| -> Vec<f64> { (0..count).map(|_| 2.0 * random.f64() - 1.0).collect() };
    let lambda = draw(size.constraints);
    let [mut jacobian, mut expected] = [(); 2].map(|()| vec![0.0; size.jacobian_nonzeros]);
    let [mut hessian, mut expected_hessian] = [(); 2].map(|()| vec![0.0; size.hessian_nonzeros]);
    for round in 0..3 {
        let x = draw(size.variables);
        let before = allocations::so_far();
        by_structure.new_point();
        by_structure.objective(&x).unwrap();
        by_structure.jacobian(&x, &mut jacobian).unwrap();
        by_structure
            .hessian(&x, 0.8, &lambda, &mut hessian)
            .unwrap();
        assert!(round == 0 || allocations::so_far() == before, "allocates");
        by_sweeps.new_point();
        by_sweeps.jacobian(&x, &mut expected).unwrap();
        by_sweeps
            .hessian(&x, 0.8, &lambda, &mut expected_hessian)
            .unwrap();
        for (found, expected) in [(&jacobian, &expected), (&hessian, &expected_hessian)] {
            let scale = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
                assert!(
                    (found - expected).abs() <= 1e-12 * scale,
                    "nonzero {k}: {found:e} instead of {expected:e}, of {scale:e}"
                );
            }
        }
    }
}

/// Every weight, limit and coupling at once, for robots of all kinds.
#[test]
fn structure_and_sweeps_agree() {
    let rng = &mut fastrand::Rng::with_seed(23);
    let mut robots = trees::zoo(9);
    robots.push(problems::two_link());
    robots.push(trees::planar(rng, Vector3::new(0.3, -0.5, 0.8)));
    robots.push(trees::chain(10, 2));
    for robot in robots {
        let mut problem = loaded(robot);
        let n = problem.robot.joint_count();
        let (angles, _) = Problem::base_sizes(&problem.robot);
        problem.limits.torque = vec![Interval::symmetric(3.0); n];
        problem.cost.torque = trees::values(rng, n, 0.2);
        problem.cost.torque.iter_mut().for_each(|w| *w = w.abs());
        let rates = angles + n;
        let half: Vec<Vec<f64>> = (0..rates)
            .map(|_| (0..rates).map(|_| 0.05 * trees::uniform(rng)).collect())
            .collect();
        let element = |i: usize, j: usize| match i == j {
            true => rates as f64,
            false => half[i][j] + half[j][i],
        };
        let row = |i: usize| (0..rates).map(|j| element(i, j)).collect();
        problem.cost.rate_matrix = Some((0..rates).map(row).collect());
        let sphere = |joint| Sphere {
            joint,
            center: [0.3, 0.1, -0.2],
            radius: 0.1,
        };
        problem.limits.keep_out = vec![KeepOut {
            name: "apart".into(),
            sphere: sphere(Some(n - 1)),
            from: Obstacle::Sphere(sphere(None)),
        }];
        let mesh = || Mesh::uniform(1, 2).unwrap();
        for tumbling in [false, true] {
            if tumbling {
                problem.task.initial_momentum.angular = vec![0.3; angles];
            }
            match FreeFloating::planar(&problem) {
                Some(system) => {
                    compare(&system, mesh());
                    compare(&Elastic::new(&system, system.limit_groups(), 1e-3), mesh());
                }
                None => {
                    let system = FreeFloating::spatial(&problem);
                    compare(&system, mesh());
                    compare(&Elastic::new(&system, system.limit_groups(), 1e-3), mesh());
                }
            }
        }
    }
}

/// Dynamics, path, boundary rows and costs that depend on time explicitly, with a free duration.
struct TimeVarying;

impl Ocp for TimeVarying {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        let named = |name: &str| Quantity::new(name, free);
        Formulation {
            states: vec![named("x"), named("y")],
            controls: vec![named("u")],
            path: vec![named("path")],
            boundary: vec![named("ends")],
            way_points: [0.3, 0.7]
                .into_iter()
                .map(|fraction| ocp::WayPoint {
                    fraction,
                    states: vec![free; 2],
                    rows: vec![named("product"), named("wave")],
                })
                .collect(),
            initial: vec![free; 2],
            terminal: vec![free; 2],
            duration: Interval::new(0.5, 1.5),
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], path: &mut [S]) -> S {
        let (x, y, u, t) = (p.x[0], p.x[1], p.u[0], p.t);
        // Nothing here vanishes at t = 0, where the first point stands.
        let late = t + 1.0;
        f[0] = y * late.sin() + u * late;
        f[1] = x.square() * late.square() - y.exp() * u;
        path[0] = x * u * late + late.square() * y;
        u.square() * (x * late).cos() + late * late * late
    }

    fn way_point<S: Scalar>(&self, passage: Passage<'_, S>, _: &mut (), rows: &mut [S]) {
        let Passage { way_point, x, t } = passage;
        rows[0] = x[0] * x[1].square() * t;
        rows[1] = (x[1] * t).sin() + x[0].square() * way_point as f64;
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        let (a, b, t) = (ends.initial, ends.terminal, ends.duration);
        rows[0] = a[0] * b[1] * t + b[0].square();
        (t * a[1]).sin() + b[1].square() * t
    }
}

#[test]
fn explicit_time_with_a_free_duration() {
    check(
        &TimeVarying,
        Mesh::new(vec![0.0, 0.3, 0.7, 1.0], &[2, 1, 2]).unwrap(),
    );
}
