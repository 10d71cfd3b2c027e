//! Total momentum of all bodies, summed over their own velocities by the separate kinematics of
//! `verify`, vanishes where the base moves as `dynamics` says.

mod problems;
mod trees;

use fastrand::Rng;
use ffsm_ipopt::autodiff::Dual;
use ffsm_ipopt::dynamics::attitude::{Attitude, PlanarAngle, SpatialAttitude};
use ffsm_ipopt::dynamics::space::{Space, Vector};
use ffsm_ipopt::dynamics::{Data, Model, Tree};
use ffsm_ipopt::nalgebra::{Matrix3, Vector3};
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies, orientation};
use problems::two_link;

type Rate = Dual<1>;

/// Value and time derivative.
fn moving(values: &[f64], rates: &[f64]) -> Vec<Rate> {
    values
        .iter()
        .zip(rates)
        .map(|(&value, &rate)| Dual {
            value,
            gradient: [rate],
        })
        .collect()
}

/// Position and velocity of the base and its angular velocity in base axes, as `dynamics` says.
fn base_motion<Sp: Space>(
    tree: &Tree<Sp>,
    (attitude, eta): (Sp::Attitude, &[f64]),
    q: &[f64],
    dq: &[f64],
) -> (Vec<Rate>, Vec<f64>) {
    let mut data = Data::<Sp, f64>::new(tree);
    tree.kinematics(q, &mut data);
    tree.momentum(&mut data);
    tree.base_rate(dq, &mut data);
    let omega = data.base_rate.components().to_vec();
    let mut eta_rate = vec![0.0; attitude.count()];
    attitude.rates(eta, &data.base_rate, &mut eta_rate);

    let mut data = Data::<Sp, Rate>::new(tree);
    tree.kinematics(&moving(q, dq), &mut data);
    tree.momentum(&mut data);
    let zeta = attitude.base_position(&moving(eta, &eta_rate), &data.system_center);
    (zeta.components().to_vec(), omega)
}

/// Momentum relative to the sum of the bodies' magnitudes; `basis` leads from the coordinates of
/// `dynamics` to base axes.
fn check(
    model: &Model,
    (attitude, eta): (SpatialAttitude, &[f64]),
    basis: Matrix3<f64>,
    motion: (Vec<Rate>, Vec<f64>),
    q: &[f64],
    dq: &[f64],
) {
    let (zeta, omega) = motion;
    let in_space = |part: &dyn Fn(&Rate) -> f64| {
        let mut v = Vector3::zeros();
        for (k, component) in zeta.iter().enumerate() {
            v[k] = part(component);
        }
        basis * v
    };
    let omega = match *omega {
        [about_normal] => Vector3::z() * about_normal,
        _ => Vector3::from_column_slice(&omega),
    };
    let mut base = BaseMotion::placed(
        in_space(&|component| component.value),
        orientation(model, attitude, eta),
    );
    base.velocity = in_space(&|component| component.gradient[0]);
    base.angular = base.rotation * basis * omega;
    let mut bodies = Bodies::new(model);
    bodies.update(model, &base, q, dq);

    let center = bodies.center();
    let (mut linear_scale, mut angular_scale, mut extent) = (0.0, 0.0, 0.0_f64);
    for body in bodies.motions() {
        let arm = body.center - center;
        linear_scale += (body.velocity * body.mass).norm();
        angular_scale +=
            (body.inertia * body.angular).norm() + arm.cross(&(body.velocity * body.mass)).norm();
        extent = extent.max(arm.norm());
    }
    assert!(
        linear_scale > 1e-3 && angular_scale > 1e-4,
        "the robot does not move"
    );
    let linear = bodies.linear_momentum().norm() / linear_scale;
    let angular = bodies.angular_momentum().norm() / angular_scale;
    assert!(
        linear < 1e-12,
        "{}: linear momentum {linear:.1e}",
        model.name()
    );
    assert!(
        angular < 1e-12,
        "{}: angular momentum {angular:.1e}",
        model.name()
    );

    // The mass centre is the origin; in the plane only as far as the plane goes.
    let flat = model
        .plane()
        .map(|plane| plane.basis.column(2).into_owned());
    let off = center - flat.map_or(Vector3::zeros(), |normal| normal * normal.dot(&center));
    assert!(
        off.norm() < 1e-13 * (1.0 + extent),
        "{}: mass centre at {center}",
        model.name()
    );
}

fn check_in_space(model: &Model, rng: &mut Rng) {
    let tree = Tree::spatial(model);
    let n = model.joint_count();
    let attitudes = SpatialAttitude::ALL.into_iter().cycle();
    for attitude in attitudes.take(60) {
        let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
        let eta = trees::attitude(rng, attitude);
        let motion = base_motion(&tree, (attitude, &eta), &q, &dq);
        check(
            model,
            (attitude, &eta),
            Matrix3::identity(),
            motion,
            &q,
            &dq,
        );
    }
}

fn check_in_plane(model: &Model, rng: &mut Rng) {
    let tree = Tree::planar(model).expect("planar");
    let basis = model.plane().unwrap().basis;
    let n = model.joint_count();
    for _ in 0..50 {
        let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
        let eta = trees::values(rng, 1, 3.0);
        let motion = base_motion(&tree, (PlanarAngle, &eta), &q, &dq);
        check(
            model,
            (SpatialAttitude::default(), &eta),
            basis,
            motion,
            &q,
            &dq,
        );
    }
}

#[test]
fn random_trees_keep_zero_momentum() {
    let rng = &mut Rng::with_seed(1);
    for seed in 0..5 {
        for model in trees::zoo(seed) {
            check_in_space(&model, rng);
        }
    }
}

#[test]
fn planar_robots_keep_zero_momentum_in_both_forms() {
    let rng = &mut Rng::with_seed(2);
    let mut robots = vec![two_link()];
    for normal in [
        Vector3::z(),
        Vector3::y(),
        Vector3::x(),
        Vector3::new(1.0, -2.0, 0.5).normalize(),
    ] {
        robots.push(trees::planar(rng, normal));
    }
    for model in robots {
        check_in_plane(&model, rng);
        check_in_space(&model.in_space(), rng);
    }
}
