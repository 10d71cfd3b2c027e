//! Inertia and Coriolis force after the base is eliminated.

use crate::compared::*;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::autodiff::Dual;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::space::Spatial;
use ffsm_ipopt::dynamics::{Data, Model, Tree};
use ffsm_ipopt::nalgebra::{DVector, Vector3};
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies, orientation};
use ffsm_ipopt::verify::mass_matrix::MassMatrix;

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
