//! The independent re-integration against motions that are known otherwise.

mod allocations;
mod problems;
mod trees;

use fastrand::Rng;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::attitude::{Attitude, PlanarAngle, SpatialAttitude};
use ffsm_ipopt::dynamics::space::Space;
use ffsm_ipopt::dynamics::{Data, Model, Tree};
use ffsm_ipopt::integrate::Rk4;
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::transcription::Discretization;
use ffsm_ipopt::verify::{Verification, VerifyError, verify};
use problems::two_link;
use std::f64::consts::PI;

/// Not such that a unit of τ lasts one second.
const DURATION: f64 = 17.0;

/// A rest-to-rest quintic between random joint positions: positions, rates and accelerations.
struct Quintic {
    from: Vec<f64>,
    to: Vec<f64>,
}

impl Quintic {
    fn at(&self, fraction: f64) -> [Vec<f64>; 3] {
        let s = fraction;
        let blend = [
            s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
            30.0 * (s * (1.0 - s)).powi(2) / DURATION,
            60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / DURATION.powi(2),
        ];
        [0, 1, 2].map(|order| {
            let offset = if order == 0 { 1.0 } else { 0.0 };
            self.from
                .iter()
                .zip(&self.to)
                .map(|(a, b)| offset * a + blend[order] * (b - a))
                .collect()
        })
    }
}

/// The plan that goes with the path, by the dynamics that are to be checked.
fn plan<Sp: Space>(
    tree: &Tree<Sp>,
    attitude: Sp::Attitude,
    path: &Quintic,
    mesh: Mesh,
) -> Discretization {
    let n = tree.joint_count();
    let angles = attitude.count();
    let mut data = Data::<Sp, f64>::new(tree);
    let rate = |fraction: f64, eta: &[f64], data: &mut Data<Sp, f64>| {
        let [q, dq, _] = path.at(fraction);
        tree.kinematics(&q, data);
        tree.momentum(data);
        tree.base_rate(&dq, data);
        let mut rates = vec![0.0; angles];
        attitude.rates(eta, &data.base_rate, &mut rates);
        rates
    };
    let mut eta = attitude.start().to_vec();
    let mut reached = 0.0;
    let mut rk4 = Rk4::new(angles);
    Discretization::sample(mesh, DURATION, angles + 2 * n, n, |fraction, x, u| {
        // Steps from node to node, fine enough for rounding to count.
        let along = |s: f64, eta: &[f64], slope: &mut [f64]| {
            let rates = rate(s, eta, &mut data);
            for (slope, rate) in slope.iter_mut().zip(rates) {
                *slope = DURATION * rate;
            }
        };
        rk4.integrate(along, [reached, fraction], 40, &mut eta);
        reached = fraction;
        let [q, dq, ddq] = path.at(fraction);
        tree.kinematics(&q, &mut data);
        tree.momentum(&mut data);
        tree.base_rate(&dq, &mut data);
        tree.mass_matrix(&mut data);
        tree.bias(&dq, &mut data);
        let mut free = data.bias.clone();
        data.factors.factor(&data.mass_matrix);
        data.factors.solve(&mut free);
        for j in 0..n {
            u[j] = ddq[j] + free[j];
        }
        x[..angles].copy_from_slice(&eta);
        x[angles..angles + n].copy_from_slice(&q);
        x[angles + n..].copy_from_slice(&dq);
    })
}

fn case(
    model: Model,
    attitude: SpatialAttitude,
    [from, to]: [Vec<f64>; 2],
    mesh: Mesh,
) -> (Problem, Discretization) {
    let path = Quintic { from, to };
    let plan = match Tree::planar(&model) {
        Some(tree) => plan(&tree, PlanarAngle, &path, mesh),
        None => plan(&Tree::spatial(&model), attitude, &path, mesh),
    };
    let mut problem = Problem::builder("test", model, DURATION, &path.from, &path.to);
    problem.set_attitude(attitude);
    let problem = problem.build().unwrap();
    (problem, plan)
}

fn two_link_plan(mesh: Mesh) -> (Problem, Discretization) {
    let ends = [vec![0.0, 0.0], vec![PI / 6.0, PI / 3.0]];
    case(two_link(), SpatialAttitude::default(), ends, mesh)
}

fn assert_exact(name: &str, found: &Verification) {
    for (what, value, limit) in [
        ("base attitude", found.max_base_attitude_drift, 1e-10),
        ("base position", found.max_base_position_drift, 1e-10),
        ("joints", found.max_joint_drift, 1e-10),
        (
            "base attitude of the replay",
            found.replay_base_attitude_drift,
            1e-8,
        ),
        (
            "base position of the replay",
            found.replay_base_position_drift,
            1e-8,
        ),
        ("linear momentum", found.max_linear_momentum, 1e-11),
        ("angular momentum", found.max_angular_momentum, 1e-11),
        ("energy", found.max_energy_gap, 1e-11),
    ] {
        assert!(
            value < limit,
            "{name}: {what} off by {value:.1e}: {found:?}"
        );
    }
    // Each of ten segments takes one at least.
    assert!(found.steps >= 10);
}

#[test]
fn an_exact_plan_shows_no_drift() {
    let mesh = || Mesh::uniform(10, 12).unwrap();
    let (problem, plan) = two_link_plan(mesh());
    assert_exact("table 1", &verify(&problem, &plan).unwrap());

    let rng = &mut Rng::with_seed(20);
    let mut robots = trees::zoo(21);
    robots.push(trees::planar(rng, Vector3::y()));
    robots.push(two_link().in_space());
    for model in robots {
        let n = model.joint_count();
        let ends = [trees::values(rng, n, 0.6), trees::values(rng, n, 0.6)];
        for attitude in SpatialAttitude::ALL {
            let (problem, plan) = case(model.clone(), attitude, ends.clone(), mesh());
            assert_exact(problem.robot.name(), &verify(&problem, &plan).unwrap());
            if problem.robot.plane().is_some() {
                break;
            }
        }
    }
}

#[test]
fn a_coarse_plan_drifts() {
    let drift = |segments| {
        let (problem, plan) = two_link_plan(Mesh::uniform(segments, 3).unwrap());
        verify(&problem, &plan).unwrap()
    };
    let (coarse, fine) = (drift(4), drift(16));
    assert!(coarse.max_joint_drift > 1e-4, "{coarse:?}");
    assert!(
        fine.max_joint_drift < 0.05 * coarse.max_joint_drift,
        "{fine:?}"
    );
    // Momentum and energy balance hold whatever the plan is worth.
    assert!(coarse.max_linear_momentum < 1e-10, "{coarse:?}");
    assert!(coarse.max_angular_momentum < 1e-10, "{coarse:?}");
    assert!(coarse.max_energy_gap < 1e-10, "{coarse:?}");
}

#[test]
fn a_false_base_attitude_is_found() {
    let (problem, mut plan) = two_link_plan(Mesh::uniform(10, 8).unwrap());
    let last = plan.x.len() - plan.states;
    plan.x[last] += 1e-3;
    let found = verify(&problem, &plan).unwrap();
    assert!(
        (found.max_base_attitude_drift - 1e-3).abs() < 1e-6,
        "{found:?}"
    );
    assert!(
        (found.replay_base_attitude_drift - 1e-3).abs() < 1e-6,
        "{found:?}"
    );
    assert!(found.replay_base_position_drift > 1e-5, "{found:?}");
    assert!(found.max_joint_drift < 1e-6, "{found:?}");
}

#[test]
fn a_false_control_moves_the_joints_but_not_the_replay() {
    let (problem, mut plan) = two_link_plan(Mesh::uniform(10, 8).unwrap());
    plan.u[0] += 1e-3;
    let found = verify(&problem, &plan).unwrap();
    assert!(found.max_joint_drift > 1e-5, "{found:?}");
    assert!(found.replay_base_attitude_drift < 1e-6, "{found:?}");
}

#[test]
fn steps_do_not_allocate() {
    let (problem, plan) = two_link_plan(Mesh::uniform(10, 8).unwrap());
    let count = |plan: &Discretization| {
        let before = allocations::so_far();
        let found = verify(&problem, plan).unwrap();
        (allocations::so_far() - before, found.steps)
    };
    let calm = count(&plan);
    let mut rough = plan;
    rough
        .u
        .iter_mut()
        .enumerate()
        .for_each(|(i, u)| *u += (i as f64).sin());
    let rough = count(&rough);
    assert!(rough.1 > 2 * calm.1, "{} and {} steps", calm.1, rough.1);
    assert_eq!(rough.0, calm.0);
}

#[test]
fn a_state_that_is_no_orientation_is_no_small_drift() {
    let model = two_link().in_space();
    let ends = [vec![0.0, 0.0], vec![PI / 6.0, PI / 3.0]];
    let mesh = Mesh::uniform(4, 4).unwrap();
    let (problem, mut plan) = case(model, SpatialAttitude::Quaternion, ends, mesh);
    assert!(verify(&problem, &plan).is_ok());
    // A quaternion of length zero: every number is finite, but it turns nothing.
    plan.x[5 * plan.states..5 * plan.states + 4].fill(0.0);
    let error = verify(&problem, &plan).unwrap_err();
    let VerifyError::Undefined { time, .. } = error else {
        panic!("{error}")
    };
    assert!((time - plan.times()[5]).abs() < 1e-9);
    assert!(error.to_string().contains("not a number"), "{error}");
}

#[test]
fn misuse_is_explained() {
    let (problem, plan) = two_link_plan(Mesh::uniform(2, 3).unwrap());
    let other = Problem::builder("other", trees::zoo(1).remove(1), 1.0, &[0.0; 3], &[0.0; 3])
        .build()
        .unwrap();
    let error = verify(&other, &plan).unwrap_err();
    assert!(
        matches!(
            error,
            VerifyError::Shape {
                found: 5,
                expected: 9,
                ..
            }
        ),
        "{error}"
    );

    let mut damaged = plan.clone();
    damaged.u[1] = f64::NAN;
    let error = verify(&problem, &damaged).unwrap_err();
    assert!(
        matches!(
            error,
            VerifyError::NotFinite {
                what: "control",
                ..
            }
        ),
        "{error}"
    );

    // Joints that turn a thousand times a second can be followed, but not within the steps there are.
    let mut fast = plan.clone();
    fast.u[0] = 1e4;
    let error = verify(&problem, &fast).unwrap_err();
    let VerifyError::StepLimit { limit, time, .. } = error else {
        panic!("{error}")
    };
    assert!(limit < 20_000 && time < DURATION, "{error}");

    let mut wild = plan;
    wild.u[2] = 1e300;
    let error = verify(&problem, &wild).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("the full dynamics stops at t = "),
        "{error}"
    );
}
