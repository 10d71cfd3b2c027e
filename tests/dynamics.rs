//! The reduced dynamics against the unreduced ones of `verify`, against themselves in the plane
//! and in space, and against known answers.

mod problems;
mod trees;

use fastrand::Rng;
use ffsm_ipopt::autodiff::{Dual, HyperDual};
use ffsm_ipopt::dynamics::attitude::{Attitude, PlanarAngle, SpatialAttitude};
use ffsm_ipopt::dynamics::space::{Space, Spatial, Vector};
use ffsm_ipopt::dynamics::{Body, Data, Inertia, Model, Placement, Tree};
use ffsm_ipopt::nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies, orientation};
use ffsm_ipopt::verify::mass_matrix::MassMatrix;
use problems::two_link;
use std::f64::consts::PI;

fn evaluate<Sp: Space>(tree: &Tree<Sp>, q: &[f64], dq: &[f64]) -> Data<Sp, f64> {
    let mut data = Data::new(tree);
    tree.kinematics(q, &mut data);
    tree.momentum(&mut data);
    tree.base_rate(dq, &mut data);
    tree.mass_matrix(&mut data);
    tree.bias(dq, &mut data);
    data
}

/// H as a full matrix.
fn inertia_matrix<Sp: Space>(data: &Data<Sp, f64>, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| data.mass_matrix[i.max(j) * n + i.min(j)])
}

fn assert_close(what: &str, found: f64, expected: f64, scale: f64, tolerance: f64) {
    let gap = (found - expected).abs() / scale;
    assert!(
        gap <= tolerance,
        "{what}: {found:e} instead of {expected:e}, relative gap {gap:.1e}"
    );
}

fn robots() -> Vec<Model> {
    let rng = &mut Rng::with_seed(7);
    let mut robots: Vec<Model> = (10..14).flat_map(trees::zoo).collect();
    robots.push(two_link());
    robots.push(two_link().in_space());
    robots.push(trees::planar(rng, Vector3::y()));
    robots
}

/// H and Cθ̇ by whichever form the robot has.
fn reduced(model: &Model, q: &[f64], dq: &[f64]) -> (DMatrix<f64>, Vec<f64>, Vec<f64>) {
    let n = model.joint_count();
    match Tree::planar(model) {
        Some(tree) => {
            let data = evaluate(&tree, q, dq);
            (
                inertia_matrix(&data, n),
                data.bias.clone(),
                data.base_rate.components().to_vec(),
            )
        }
        None => {
            let data = evaluate(&Tree::spatial(model), q, dq);
            (
                inertia_matrix(&data, n),
                data.bias.clone(),
                data.base_rate.components().to_vec(),
            )
        }
    }
}

#[test]
fn reduced_dynamics_are_the_schur_complement_of_the_full_ones() {
    let rng = &mut Rng::with_seed(3);
    for model in robots() {
        let n = model.joint_count();
        let mut bodies = Bodies::new(&model);
        let mut full = MassMatrix::new(&model);
        for _ in 0..30 {
            let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
            let (h, bias, omega) = reduced(&model, &q, &dq);
            // The base's attitude and place must not matter.
            let mut base = BaseMotion::placed(
                trees::vector(rng),
                orientation(
                    &model,
                    SpatialAttitude::RollPitchYaw,
                    &trees::values(rng, 3, 1.2),
                ),
            );
            bodies.update(&model, &base, &q, &dq);
            full.update(&model, &bodies, &dq).unwrap();
            (base.velocity, base.angular) = full.momentum_free(&dq);
            bodies.update(&model, &base, &q, &dq);
            full.update(&model, &bodies, &dq).unwrap();

            let in_base = base.rotation.transpose() * base.angular;
            let expected = match (model.plane(), &omega[..]) {
                (Some(plane), [omega]) => plane.basis.column(2) * *omega,
                _ => Vector3::from_column_slice(&omega),
            };
            let gap = (in_base - expected).norm() / expected.norm();
            assert!(
                gap < 1e-10,
                "{}: base rate differs by {gap:.1e}",
                model.name()
            );

            let mut expected = vec![0.0; n];
            for j in 0..n {
                let mut unit = vec![0.0; n];
                unit[j] = 1.0;
                full.reduced_times(&unit, &mut expected);
                for i in 0..n {
                    assert_close("H", h[(i, j)], expected[i], h.amax(), 1e-10);
                }
            }
            full.reduced_bias(&mut expected);
            let scale = expected.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            for i in 0..n {
                assert_close("Cθ̇", bias[i], expected[i], scale, 1e-10);
            }
        }
    }
}

#[test]
fn the_full_equations_are_solved() {
    let rng = &mut Rng::with_seed(4);
    for model in robots() {
        let n = model.joint_count();
        let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
        let u = trees::values(rng, n, 3.0);
        let (h, bias, _) = reduced(&model, &q, &dq);
        let mut bodies = Bodies::new(&model);
        let mut full = MassMatrix::new(&model);
        let mut base = BaseMotion::placed(
            trees::vector(rng),
            orientation(
                &model,
                SpatialAttitude::RollPitchYaw,
                &trees::values(rng, 3, 1.2),
            ),
        );
        bodies.update(&model, &base, &q, &dq);
        full.update(&model, &bodies, &dq).unwrap();
        (base.velocity, base.angular) = full.momentum_free(&dq);
        bodies.update(&model, &base, &q, &dq);
        full.update(&model, &bodies, &dq).unwrap();
        let mut torque = vec![0.0; n];
        full.reduced_times(&u, &mut torque);
        let mut a = vec![0.0; n + 6];
        full.accelerations(&torque, &mut a);

        // Residual of M a + bias = [0; τ].
        let m = full.matrix();
        let scale = a.iter().fold(0.0, |s: f64, a| s.max(a.abs()));
        for i in 0..n + 6 {
            let ma: f64 = (0..n + 6).map(|j| m[(i.max(j), i.min(j))] * a[j]).sum();
            let force = if i < 6 { 0.0 } else { torque[i - 6] };
            assert_close(
                "residual",
                ma + full.bias()[i],
                force,
                scale * m[(i, i)],
                1e-10,
            );
        }
        // θ̈ = u − H⁻¹Cθ̇, eq. (7).
        let free = h
            .cholesky()
            .unwrap()
            .solve(&DVector::from_column_slice(&bias));
        for j in 0..n {
            assert_close("θ̈", a[6 + j], u[j] - free[j], scale, 1e-9);
        }
    }
}

#[test]
fn free_motion_keeps_its_energy() {
    let rng = &mut Rng::with_seed(5);
    for model in robots().into_iter().map(Model::in_space) {
        let tree = Tree::spatial(&model);
        let n = model.joint_count();
        let mut rates = Data::<Spatial, Dual<1>>::new(&tree);
        for _ in 0..20 {
            let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
            let data = evaluate(&tree, &q, &dq);
            let moving: Vec<Dual<1>> = q
                .iter()
                .zip(&dq)
                .map(|(&value, &rate)| Dual {
                    value,
                    gradient: [rate],
                })
                .collect();
            tree.kinematics(&moving, &mut rates);
            tree.momentum(&mut rates);
            tree.mass_matrix(&mut rates);
            let (mut power, mut scale) = (0.0, 0.0);
            for i in 0..n {
                for j in 0..n {
                    let rate = rates.mass_matrix[i.max(j) * n + i.min(j)].gradient[0];
                    let term = 0.5 * dq[i] * rate * dq[j];
                    power += term;
                    scale += term.abs();
                }
            }
            let bias: f64 = data.bias.iter().zip(&dq).map(|(c, rate)| c * rate).sum();
            assert_close("½θ̇ᵀḢθ̇", power, bias, scale, 1e-12);
        }
    }
}

#[test]
fn the_reduced_inertia_is_positive_definite() {
    let rng = &mut Rng::with_seed(6);
    for model in robots() {
        let n = model.joint_count();
        for _ in 0..30 {
            let (h, ..) = reduced(&model, &trees::values(rng, n, 3.0), &vec![0.0; n]);
            let smallest = h.symmetric_eigenvalues().min();
            assert!(smallest > 0.0, "{}: eigenvalue {smallest:e}", model.name());
        }
    }
}

#[test]
fn plane_and_space_agree() {
    let rng = &mut Rng::with_seed(8);
    let mut robots = vec![two_link()];
    for normal in [
        Vector3::z(),
        Vector3::y(),
        Vector3::x(),
        Vector3::new(0.3, 0.5, -1.0).normalize(),
    ] {
        robots.push(trees::planar(rng, normal));
    }
    for model in robots {
        let n = model.joint_count();
        let plane = Tree::planar(&model).expect("planar");
        let space = Tree::spatial(&model);
        let basis = model.plane().unwrap().basis;
        for _ in 0..30 {
            let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
            let (flat, full) = (evaluate(&plane, &q, &dq), evaluate(&space, &q, &dq));
            let omega = basis.transpose() * full.base_rate;
            let scale = omega.norm();
            assert_close("ω", flat.base_rate.x, omega.z, scale, 1e-12);
            assert_close("ω in the plane", omega.xy().norm(), 0.0, scale, 1e-12);
            let center = basis.transpose() * full.system_center;
            let scale = center.norm();
            assert_close(
                "mass centre",
                (flat.system_center - center.xy()).norm(),
                0.0,
                scale,
                1e-12,
            );
            let (a, b) = (inertia_matrix(&flat, n), inertia_matrix(&full, n));
            assert!((&a - &b).amax() < 1e-12 * b.amax(), "H differs");
            let scale = full.bias.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            for (a, b) in flat.bias.iter().zip(&full.bias) {
                assert_close("Cθ̇", *a, *b, scale, 1e-12);
            }
        }
    }
}

/// Derivatives of the mass centre by every pair of joints against hyper-dual numbers.
fn check_center_derivatives<Sp: Space>(tree: &Tree<Sp>, rng: &mut Rng) {
    let n = tree.joint_count();
    let (q, dq) = (trees::values(rng, n, 3.0), vec![0.0; n]);
    let data = evaluate(tree, &q, &dq);
    let mut seeded = Data::<Sp, HyperDual<1, 1>>::new(tree);
    let close = |what: &str, found: &Sp::Linear<f64>, expected: Vec<f64>| {
        assert_eq!(expected.len(), Sp::LENGTHS);
        for (found, expected) in found.components().iter().zip(expected) {
            assert_close(what, *found, expected, 1.0, 1e-14);
        }
    };
    for k in 0..n {
        for l in 0..n {
            let position = |(i, &value): (usize, &f64)| {
                HyperDual::seeded(value, (i == k).then_some(0), (i == l).then_some(0))
            };
            let moving: Vec<_> = q.iter().enumerate().map(position).collect();
            tree.kinematics(&moving, &mut seeded);
            tree.momentum(&mut seeded);
            let center = seeded.system_center.components();
            let by = center.iter().map(|c| c.rows[0]).collect();
            close("by one joint", &tree.system_center_by(&data, k), by);
            let both = center.iter().map(|c| c.block[0][0]).collect();
            let found = tree.system_center_by_both(&data, k, l);
            close("by two joints", &found, both);
        }
    }
}

#[test]
fn the_mass_centre_moves_with_the_joints() {
    let rng = &mut Rng::with_seed(14);
    for model in robots() {
        check_center_derivatives(&Tree::spatial(&model), rng);
        if let Some(tree) = Tree::planar(&model) {
            check_center_derivatives(&tree, rng);
        }
    }
}

/// Table I with the second link's body replaced.
fn with_second_link(center: Vector3<f64>, rotational: Matrix3<f64>) -> Model {
    let robot = two_link();
    let mut joints = robot.joints().to_vec();
    let name = "link".into();
    joints[1].body = Body {
        name,
        inertia: Inertia::new(1.2, center, rotational).unwrap(),
    };
    Model::new("changed", robot.base().clone(), joints).unwrap()
}

#[test]
fn a_plane_needs_more_than_parallel_axes() {
    let round = Matrix3::identity() * 0.0486;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), round)
            .plane()
            .is_some()
    );
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.01), round)
            .plane()
            .is_none()
    );

    let mut product = round;
    product[(0, 1)] = 0.004;
    product[(1, 0)] = 0.004;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), product)
            .plane()
            .is_some()
    );
    let mut product = round;
    product[(0, 2)] = 0.004;
    product[(2, 0)] = 0.004;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), product)
            .plane()
            .is_none()
    );
    // What would be lost: this robot's base tips out of the plane.
    let tilted = with_second_link(Vector3::new(0.35, 0.0, 0.01), round);
    let omega = evaluate(&Tree::spatial(&tilted), &[0.3, -0.8], &[1.0, 0.5]).base_rate;
    assert!(omega.xy().norm() > 1e-4);

    assert!(two_link().in_space().plane().is_none());
    for model in trees::zoo(3) {
        assert!(model.plane().is_none());
    }
}

#[test]
fn a_plane_may_have_any_normal() {
    let rng = &mut Rng::with_seed(9);
    for normal in [
        Vector3::y(),
        Vector3::x(),
        Vector3::new(1.0, 2.0, -3.0).normalize(),
    ] {
        let plane = trees::planar(rng, normal).plane().expect("planar").clone();
        assert!(plane.basis.column(2).cross(&normal).norm() < 1e-12);
        assert!((plane.basis.determinant() - 1.0).abs() < 1e-12);
    }
}

/// Base attitude (rad) and displacement (m) after the straight path between joint positions.
fn straight_line(model: &Model, from: [f64; 2], to: [f64; 2]) -> (f64, [f64; 2]) {
    let tree = Tree::planar(model).unwrap();
    let dq: Vec<f64> = to.iter().zip(from).map(|(b, a)| b - a).collect();
    let at = |s: f64| evaluate(&tree, &[from[0] + s * dq[0], from[1] + s * dq[1]], &dq);
    // Simpson's rule: the rate depends on s alone.
    let steps = 1000;
    let mut eta = 0.0;
    for k in 0..=steps {
        let weight = if k == 0 || k == steps {
            1.0
        } else {
            2.0 * (1 + k % 2) as f64
        };
        eta += weight * at(k as f64 / steps as f64).base_rate.x / (3 * steps) as f64;
    }
    let start = PlanarAngle.base_position(&[0.0], &at(0.0).system_center);
    let end = PlanarAngle.base_position(&[eta], &at(1.0).system_center);
    (eta, (end - start).into())
}

#[test]
fn the_straight_path_of_table_1_moves_the_base_as_other_tools_say() {
    let (eta, [x, y]) = straight_line(&two_link(), [0.0, 0.0], [PI / 6.0, PI / 3.0]);
    assert!(
        (eta.to_degrees() + 36.648820).abs() < 5e-7,
        "{}°",
        eta.to_degrees()
    );
    assert!((100.0 * x - 1.475023).abs() < 5e-7, "{} cm", 100.0 * x);
    assert!((100.0 * y - 0.414488).abs() < 5e-7, "{} cm", 100.0 * y);
}

#[test]
fn attitude_rates_are_those_of_the_orientation() {
    // R(η + η̇ dt) − R(η) against ω, by dual numbers on the axes of the base.
    let rng = &mut Rng::with_seed(11);
    let attitudes = SpatialAttitude::ALL.into_iter().cycle();
    for attitude in attitudes.take(150) {
        let eta = trees::attitude(rng, attitude);
        let omega = trees::vector(rng);
        let mut rates = vec![0.0; eta.len()];
        attitude.rates(&eta, &omega, &mut rates);
        let moving: Vec<Dual<1>> = (0..eta.len())
            .map(|i| Dual {
                value: eta[i],
                gradient: [rates[i]],
            })
            .collect();
        let r = orientation(&trees::zoo(1)[0], attitude, &eta)
            .to_rotation_matrix()
            .into_inner();
        for k in 0..3 {
            let axis = Vector3::ith(k, 1.0);
            let turned = attitude.to_inertial(
                &moving,
                &axis.map(|c| Dual {
                    value: c,
                    gradient: [0.0],
                }),
            );
            let expected = r * omega.cross(&axis);
            assert!((turned.map(|c| c.value) - r * axis).norm() < 1e-14);
            assert!((turned.map(|c| c.gradient[0]) - expected).norm() < 1e-13);
        }
    }
}

#[test]
fn the_rotation_angle_and_the_change_of_description() {
    let rng = &mut Rng::with_seed(12);
    let robot = &trees::zoo(1)[0];
    let attitudes = SpatialAttitude::ALL.into_iter().cycle();
    for from in attitudes.take(300) {
        let eta = trees::attitude(rng, from);
        let turned = orientation(robot, from, &eta);
        let shortest = turned.angle().min(2.0 * PI - turned.angle());
        let found = from.squared_rotation_angle::<f64>(&eta).sqrt();
        assert!(
            (found - shortest).abs() < 1e-14,
            "{found} instead of {shortest}"
        );
        for to in SpatialAttitude::ALL {
            let other = to.of_quaternion(&from.to_quaternion(&eta), to.start());
            assert!(orientation(robot, to, &other).angle_to(&turned) < 1e-7);
            let back = from.of_quaternion(&to.to_quaternion(&other), &eta);
            let gap = back.iter().zip(&eta).map(|(a, b)| (a - b).abs());
            assert!(gap.fold(0.0, f64::max) < 1e-12, "{back:?} for {eta:?}");
        }
    }
    // A full turn about one axis: roll-pitch-yaw and quaternion go on, past half a turn too.
    for by in [SpatialAttitude::RollPitchYaw, SpatialAttitude::Quaternion] {
        let mut eta = by.start().to_vec();
        for k in 0..=40 {
            let angle = f64::from(k) * PI / 20.0;
            let roll = SpatialAttitude::RollPitchYaw.to_quaternion(&[angle, 0.0, 0.0]);
            eta = by.of_quaternion(&roll, &eta);
        }
        let last = match by {
            SpatialAttitude::RollPitchYaw => 2.0 * PI,
            _ => -1.0,
        };
        assert!((eta[0] - last).abs() < 1e-12, "{eta:?}");
    }
}

/// The point `mount` as seen from `other` and its derivatives, by formula and by hyper-dual numbers.
fn check_relative_position<Sp: Space>(tree: &Tree<Sp>, links: [Option<usize>; 2], rng: &mut Rng) {
    type Second = HyperDual<1, 1>;
    let n = tree.joint_count();
    let [mount, other] = links.map(|link| {
        let placement = Placement {
            rotation: trees::rotation(rng),
            translation: trees::vector(rng),
        };
        tree.mount(link, &placement)
    });
    let q = trees::values(rng, n, 1.5);
    let mut data = Data::<Sp, f64>::new(tree);
    tree.kinematics(&q, &mut data);
    let mut dual = Data::<Sp, Second>::new(tree);
    let moving = tree.joints_between(&mount, &other);
    for k in 0..n {
        let by_k = tree.relative_position_by(&mount, &other, &data, k);
        let still = by_k.components().iter().all(|c| *c == 0.0);
        assert!(still || moving.contains(&k), "joint {k}");
        for l in 0..n {
            let seeded: Vec<Second> = (0..n)
                .map(|j| Second::seeded(q[j], (j == k).then_some(0), (j == l).then_some(0)))
                .collect();
            tree.kinematics(&seeded, &mut dual);
            let expected = tree.relative_position(&mount, &other, &dual);
            let by_both = tree.relative_position_by_both(&mount, &other, &data, k, l);
            for (i, expected) in expected.components().iter().enumerate() {
                for (found, expected) in [
                    (by_k.components()[i], expected.rows[0]),
                    (by_both.components()[i], expected.block[0][0]),
                ] {
                    assert_close("derivative", found, expected, 1.0, 1e-13);
                }
            }
        }
    }
}

#[test]
fn relative_positions_and_their_derivatives() {
    let rng = &mut Rng::with_seed(31);
    for model in robots() {
        let n = model.joint_count();
        let mut link = || rng.usize(0..=n).checked_sub(1);
        let pairs: Vec<_> = (0..6).map(|_| [link(), link()]).collect();
        for links in pairs {
            if let Some(tree) = Tree::planar(&model) {
                check_relative_position(&tree, links, rng);
            }
            check_relative_position(&Tree::spatial(&model), links, rng);
        }
    }
}

/// Distance of two points, across the plane included, in the plane and in space.
#[test]
fn heights_above_the_plane_are_kept() {
    let rng = &mut Rng::with_seed(37);
    let model = trees::planar(rng, Vector3::new(0.3, -0.5, 0.8));
    let (flat, solid) = (Tree::planar(&model).unwrap(), Tree::spatial(&model));
    let n = model.joint_count();
    let q = trees::values(rng, n, 1.0);
    let mut in_plane = Data::new(&flat);
    flat.kinematics(&q, &mut in_plane);
    let mut in_space = Data::new(&solid);
    solid.kinematics(&q, &mut in_space);
    for (a, b) in (0..n).flat_map(|a| (0..a).map(move |b| (Some(a), b.checked_sub(1)))) {
        let mut at = || Placement {
            rotation: trees::rotation(rng),
            translation: trees::vector(rng),
        };
        let (first, second) = (at(), at());
        let [p, o] = [(a, &first), (b, &second)].map(|(link, at)| flat.mount(link, at));
        let height = flat.height_between(&p, &o);
        let found = flat
            .relative_position(&p, &o, &in_plane)
            .norm()
            .hypot(height);
        let [p, o] = [(a, &first), (b, &second)].map(|(link, at)| solid.mount(link, at));
        assert_eq!(solid.height_between(&p, &o), 0.0);
        let expected = solid.relative_position(&p, &o, &in_space).norm();
        assert_close("distance", found, expected, 1.0, 1e-12);
    }
}

/// Bounds on H and on the distance of a frame in the last body, held at random positions.
fn assert_bounded<Sp: Space>(tree: &Tree<Sp>, rng: &mut Rng) -> usize {
    let n = tree.joint_count();
    let ranges = vec![[-3.0, 2.0]; n];
    let mobility: Vec<Option<f64>> = (0..n)
        .map(|j| tree.largest_mobility(j, ranges[j]))
        .collect();
    let mount = tree.mount(
        Some(n - 1),
        &Placement::from_xyz_rpy([0.3, -0.2, 0.1], [0.0; 3]),
    );
    let travel = vec![3.0; n];
    let ball = tree.reach_from_base(&mount, &travel);
    let reach = tree.reach_from_center(&mount, &travel);
    let length = |v: Sp::Linear<f64>| v.dot(&v).sqrt();
    for _ in 0..200 {
        let q: Vec<f64> = (0..n).map(|_| -3.0 + 5.0 * rng.f64()).collect();
        let dq = trees::values(rng, n, 1.0);
        let data = evaluate(tree, &q, &dq);
        let h = inertia_matrix(&data, n);
        let rates = DVector::from_vec(dq.clone());
        let sizes: Vec<f64> = dq.iter().map(|rate| rate.abs()).collect();
        let energy = (h.clone() * &rates).dot(&rates);
        let most = tree.largest_energy(&sizes, &ranges);
        assert!(energy <= most * (1.0 + 1e-9), "{energy} above {most}");
        let inverse = h.try_inverse().expect("H is regular");
        for (j, mobility) in mobility.iter().enumerate() {
            let most = mobility.unwrap_or(f64::INFINITY);
            let found = inverse[(j, j)];
            assert!(found <= most * (1.0 + 1e-9), "{j}: {found} above {most}");
        }
        let at = tree.position(&mount, &data);
        assert!(length(at - ball.center) <= ball.radius * (1.0 + 1e-9));
        assert!(length(at - data.system_center) <= reach * (1.0 + 1e-9));
    }
    mobility.iter().flatten().count()
}

#[test]
fn no_position_exceeds_the_bounds_on_inertia_and_reach() {
    let rng = &mut Rng::with_seed(11);
    let mut known = 0;
    for robot in robots() {
        known += assert_bounded(&Tree::spatial(&robot), rng);
        if let Some(tree) = Tree::planar(&robot) {
            known += assert_bounded(&tree, rng);
        }
    }
    assert!(known > 100, "{known} bounds");
}

#[test]
fn bounds_on_one_joint_are_its_extremes() {
    let joints = two_link().joints()[..1].to_vec();
    let model = Model::new("one", two_link().base().clone(), joints).unwrap();
    let tree = Tree::planar(&model).unwrap();
    let range = [-1.5, 1.5];
    let inertia = (0..=1000).map(|k| {
        let q = -1.5 + 0.003 * f64::from(k);
        evaluate(&tree, &[q], &[0.0]).mass_matrix[0]
    });
    let (least, most) = inertia.fold((f64::INFINITY, 0.0_f64), |(least, most), h| {
        (least.min(h), most.max(h))
    });
    let mobility = tree.largest_mobility(0, range).unwrap();
    assert_close("mobility", mobility, 1.0 / least, mobility, 2e-3);
    let energy = tree.largest_energy(&[2.0], &[range]);
    assert_close("energy", energy, 4.0 * most, energy, 2e-3);
}
