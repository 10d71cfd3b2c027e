//! Radau points, weights, differentiation and interpolation against closed forms.

use ffsm_ipopt::collocation::{Barycentric, Mesh, MeshError, Rule};

#[test]
fn three_points_have_their_closed_form() {
    let rule = Rule::new(3);
    let root = 6.0_f64.sqrt();
    for (found, expected) in
        rule.points()
            .iter()
            .zip([-1.0, (1.0 - root) / 5.0, (1.0 + root) / 5.0])
    {
        assert!(
            (found - expected).abs() < 1e-15,
            "{found} instead of {expected}"
        );
    }
    let weights = [2.0 / 9.0, (16.0 + root) / 18.0, (16.0 - root) / 18.0];
    for (found, expected) in rule.weights().iter().zip(weights) {
        assert!(
            (found - expected).abs() < 1e-14,
            "{found} instead of {expected}"
        );
    }
}

#[test]
fn quadrature_is_exact_to_degree_2n_minus_2_and_no_further() {
    for n in 1..=40 {
        let rule = Rule::new(n);
        let integral = |degree: i32| -> f64 {
            rule.points()
                .iter()
                .zip(rule.weights())
                .map(|(t, w)| w * t.powi(degree))
                .sum()
        };
        for degree in 0..=(2 * n as i32 - 2) {
            let exact = if degree % 2 == 0 {
                2.0 / f64::from(degree + 1)
            } else {
                0.0
            };
            assert!(
                (integral(degree) - exact).abs() < 1e-13,
                "N = {n}, degree {degree}"
            );
        }
        if n <= 6 {
            let degree = 2 * n as i32 - 1;
            assert!(
                integral(degree).abs() > 1e-6,
                "N = {n} would be a better rule than it can be"
            );
        }
    }
}

#[test]
fn points_are_roots_between_minus_one_and_one() {
    for n in 1..=100 {
        let rule = Rule::new(n);
        assert_eq!(rule.points()[0], -1.0);
        assert!(
            rule.nodes().windows(2).all(|pair| pair[0] < pair[1]),
            "N = {n}"
        );
        assert_eq!(rule.nodes()[n], 1.0);
        let sum: f64 = rule.weights().iter().sum();
        assert!((sum - 2.0).abs() < 1e-12, "N = {n}: weights sum to {sum}");
    }
}

#[test]
fn differentiation_is_exact_for_polynomials_of_degree_n() {
    for n in [1, 2, 3, 5, 8, 13, 20] {
        let rule = Rule::new(n);
        for degree in 0..=n as i32 {
            for (i, tau) in rule.points().iter().enumerate() {
                let derivative: f64 = rule
                    .differentiation(i)
                    .iter()
                    .zip(rule.nodes())
                    .map(|(d, node)| d * node.powi(degree))
                    .sum();
                let exact = if degree == 0 {
                    0.0
                } else {
                    f64::from(degree) * tau.powi(degree - 1)
                };
                assert!(
                    (derivative - exact).abs() < 1e-11,
                    "N = {n}, degree {degree}"
                );
            }
        }
    }
}

#[test]
fn interpolation_and_its_derivative_are_exact_between_nodes() {
    let rule = Rule::new(7);
    let values: Vec<f64> = rule
        .nodes()
        .iter()
        .map(|t| t.powi(7) - 2.0 * t.powi(3) + 1.0)
        .collect();
    let dot = |basis: Vec<f64>| basis.iter().zip(&values).map(|(l, v)| l * v).sum::<f64>();
    for k in 0..=50 {
        let t = -1.0 + 2.0 * f64::from(k) / 50.0;
        let value = t.powi(7) - 2.0 * t.powi(3) + 1.0;
        let slope = 7.0 * t.powi(6) - 6.0 * t.powi(2);
        assert!((dot(rule.state().basis(t)) - value).abs() < 1e-13);
        assert!((dot(rule.state().derivative(t)) - slope).abs() < 1e-11);
    }
}

#[test]
fn interpolation_is_steady_next_to_a_node() {
    let nodes = Barycentric::new(vec![-1.0, -0.2, 0.5, 1.0]);
    for shift in [1e-16, 1e-12, 1e-8] {
        let basis = nodes.basis(0.5 + shift);
        assert!((basis[2] - 1.0).abs() < 1e-6 && basis.iter().all(|l| l.is_finite()));
        assert!(
            nodes
                .derivative(0.5 + shift)
                .iter()
                .all(|d| d.is_finite() && d.abs() < 10.0)
        );
    }
}

#[test]
fn a_mesh_locates_fractions_in_its_segments() {
    let mesh = Mesh::new(vec![0.0, 0.25, 1.0], &[2, 3]).unwrap();
    assert_eq!((mesh.segments(), mesh.points()), (2, 5));
    assert_eq!(mesh.points_per_segment(), [2, 3]);
    assert_eq!(mesh.locate(0.0), (0, -1.0));
    assert_eq!(mesh.locate(0.25), (1, -1.0));
    assert_eq!(mesh.locate(1.0), (1, 1.0));
    let (s, tau) = mesh.locate(0.7);
    assert!(s == 1 && (mesh.fraction(s, tau) - 0.7).abs() < 1e-15);
    let fractions = mesh.node_fractions();
    assert_eq!(
        (fractions.len(), fractions[2], fractions[5]),
        (6, 0.25, 1.0)
    );
}

#[test]
fn impossible_meshes_are_refused() {
    assert_eq!(Mesh::uniform(0, 5), Err(MeshError::NoSegments));
    assert_eq!(Mesh::uniform(3, 0), Err(MeshError::NoPoints { segment: 1 }));
    assert_eq!(
        Mesh::new(vec![0.0, 1.0], &[2, 2]),
        Err(MeshError::Mismatch {
            breakpoints: 2,
            segments: 2
        })
    );
    assert_eq!(
        Mesh::new(vec![0.0, 0.6, 0.6, 1.0], &[2, 2, 2]),
        Err(MeshError::NotRising {
            index: 2,
            value: 0.6
        })
    );
    assert_eq!(
        Mesh::new(vec![0.0, 0.6, 0.9], &[2, 2]),
        Err(MeshError::NotRising {
            index: 2,
            value: 0.9
        })
    );
}
