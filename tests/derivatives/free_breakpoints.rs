//! Breakpoints that are variables: derivatives by them, and what a structure adds.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::ocp::{Ends, Formulation, Interval, Ocp, Point, Quantity};
use ffsm_ipopt::transcription::{
    FixedControl, FixedRow, Knot, Patterns, SmoothState, Structure, Transcription,
};

/// Everything depends on everything but the time.
struct Coupled {
    duration: Interval,
}

fn named(name: &str) -> Quantity {
    Quantity::new(name, Interval::FREE)
}

impl Ocp for Coupled {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        Formulation::over(self.duration)
            .state(named("x"), free, free)
            .state(named("y"), free, free)
            .control(named("u"))
            .path_row(named("path"))
            .boundary_row(named("ends"))
            .parameter(named("p"), 0.3)
            .integral(named("work"))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), f: &mut [S], path: &mut [S]) -> S {
        let (x, y, u, p) = (a.x[0], a.x[1], a.u[0], a.parameters[0]);
        f[0] = y.sin() + u * p.square() + x * y;
        f[1] = x.square() * p - y.exp() * u;
        path[0] = x * p + y;
        u.square() * (x * p).cos() + y
    }

    fn integrands<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), g: &mut [S]) {
        g[0] = a.u[0].square() * a.x[1] + a.x[0] * a.parameters[0];
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        rows[0] = ends.initial[0] * ends.terminal[1] * ends.duration;
        ends.integrals[0].square()
    }
}

fn structure() -> Structure {
    let knot = |breakpoint, lower, upper| Knot {
        breakpoint,
        window: Interval::new(lower, upper),
    };
    Structure {
        knots: vec![knot(1, 0.1, 0.3), knot(2, 0.25, 0.6)],
        fixed: vec![FixedControl {
            segment: 0,
            control: 0,
            value: 0.7,
        }],
        rows: vec![FixedRow {
            segment: 3,
            row: 0,
            value: 0.2,
        }],
        smooth: vec![SmoothState {
            segment: 1,
            state: 1,
        }],
    }
}

fn mesh() -> Mesh {
    Mesh::new(vec![0.0, 0.2, 0.4, 0.8, 1.0], &[2, 3, 2, 2]).unwrap()
}

fn programme(problem: &Coupled) -> Transcription<'_> {
    let patterns = Patterns::detect(problem);
    Transcription::structured(
        problem,
        problem.formulation(),
        &patterns,
        mesh(),
        structure(),
    )
}

/// Gradient of the Lagrangian.
fn slope(nlp: &mut impl Nlp, x: &[f64], sigma: f64, lambda: &[f64]) -> Vec<f64> {
    let size = nlp.size();
    let count = size.jacobian_nonzeros;
    let (mut rows, mut columns, mut values) = (vec![0; count], vec![0; count], vec![0.0; count]);
    nlp.jacobian_structure(&mut rows, &mut columns);
    let mut slope = vec![0.0; size.variables];
    nlp.new_point();
    nlp.gradient(x, &mut slope).unwrap();
    nlp.jacobian(x, &mut values).unwrap();
    slope.iter_mut().for_each(|v| *v *= sigma);
    for ((r, c), v) in rows.into_iter().zip(columns).zip(values) {
        slope[c] += lambda[r] * v;
    }
    slope
}

fn lagrangian(nlp: &mut impl Nlp, x: &[f64], sigma: f64, lambda: &[f64]) -> f64 {
    let mut rows = vec![0.0; lambda.len()];
    nlp.new_point();
    nlp.constraints(x, &mut rows).unwrap();
    let sum: f64 = rows.iter().zip(lambda).map(|(g, l)| g * l).sum();
    sigma * nlp.objective(x).unwrap() + sum
}

#[test]
fn derivatives_by_free_breakpoints_are_those_of_differences() {
    for duration in [Interval::fixed(1.3), Interval::new(0.5, 2.0)] {
        let problem = Coupled { duration };
        let mut nlp = programme(&problem);
        let knots = [nlp.layout().knot(0), nlp.layout().knot(1)];
        let size = nlp.size();
        let mut random = fastrand::Rng::with_seed(3);
        let mut x: Vec<f64> = (0..size.variables)
            .map(|_| 0.2 + 0.8 * random.f64())
            .collect();
        (x[knots[0]], x[knots[1]]) = (0.22, 0.37);
        let lambda: Vec<f64> = (0..size.constraints)
            .map(|_| 2.0 * random.f64() - 1.0)
            .collect();
        let sigma = 0.7;
        let found = slope(&mut nlp, &x, sigma, &lambda);
        let count = size.hessian_nonzeros;
        let (mut rows, mut columns, mut values) =
            (vec![0; count], vec![0; count], vec![0.0; count]);
        nlp.hessian_structure(&mut rows, &mut columns);
        nlp.new_point();
        nlp.hessian(&x, sigma, &lambda, &mut values).unwrap();
        let mut hessian = vec![vec![0.0; size.variables]; size.variables];
        for ((r, c), v) in rows.into_iter().zip(columns).zip(values) {
            assert!(r >= c, "lower triangle only");
            hessian[r][c] += v;
            if r != c {
                hessian[c][r] += v;
            }
        }
        let step = 1e-5;
        for i in 0..size.variables {
            let at = |by: f64| {
                let mut moved = x.clone();
                moved[i] += by;
                moved
            };
            let (above, below) = (at(step), at(-step));
            let difference = lagrangian(&mut nlp, &above, sigma, &lambda)
                - lagrangian(&mut nlp, &below, sigma, &lambda);
            let first = difference / (2.0 * step);
            let name = nlp.variable_name(i);
            assert!(
                (first - found[i]).abs() < 1e-8,
                "{name}: {first} {}",
                found[i]
            );
            let above = slope(&mut nlp, &above, sigma, &lambda);
            let below = slope(&mut nlp, &below, sigma, &lambda);
            for j in 0..size.variables {
                let second = (above[j] - below[j]) / (2.0 * step);
                let other = nlp.variable_name(j);
                assert!(
                    (second - hessian[i][j]).abs() < 1e-8,
                    "{name}, {other}: {second} {}",
                    hessian[i][j]
                );
            }
        }
        assert_eq!(nlp.unpack(&x).mesh.breakpoints()[1..3], [0.22, 0.37]);
        assert_eq!(nlp.pack(&nlp.unpack(&x))[knots[1]], 0.37);
    }
}

#[test]
fn a_structure_bounds_controls_and_breakpoints_and_keeps_ends_smooth() {
    let problem = Coupled {
        duration: Interval::fixed(1.0),
    };
    let mut nlp = programme(&problem);
    let layout = nlp.layout().clone();
    let size = nlp.size();
    let (mut lower, mut upper) = (vec![0.0; size.variables], vec![0.0; size.variables]);
    nlp.variable_bounds(&mut lower, &mut upper);
    for k in 0..2 {
        let u = layout.control(k, 0);
        assert_eq!((lower[u], upper[u]), (0.7, 0.7));
    }
    assert_eq!(lower[layout.control(2, 0)], f64::NEG_INFINITY);
    let knot = layout.knot(1);
    assert_eq!((lower[knot], upper[knot]), (0.25, 0.6));
    assert_eq!(nlp.variable_name(knot), "breakpoint, segment 3, point 1");
    // The segment between the two free breakpoints keeps a width; its state y is of degree 2.
    let mesh = nlp.mesh().clone();
    let sampled = |power: i32| {
        let mut x = nlp.pack(
            &ffsm_ipopt::transcription::Discretization::sample(
                mesh.clone(),
                1.0,
                2,
                1,
                |fraction, x, _| x[1] = fraction.powi(power),
            )
            .with(0.0, vec![0.0]),
        );
        x[layout.knot(0)] = 0.2;
        x
    };
    let [square, cube] = [2, 3].map(sampled);
    let mut rows = vec![0.0; size.constraints];
    let mut end = |x: &[f64]| {
        nlp.new_point();
        nlp.constraints(x, &mut rows).unwrap();
        (
            rows[layout.structural_row(0)],
            rows[layout.structural_row(1)],
        )
    };
    let (bend, width) = end(&square);
    assert!(
        bend.abs() < 1e-14 && (width - 0.2).abs() < 1e-14,
        "{bend} {width}"
    );
    assert!(end(&cube).0.abs() > 1e-4);
    let (mut least, mut most) = (vec![0.0; size.constraints], vec![0.0; size.constraints]);
    nlp.constraint_bounds(&mut least, &mut most);
    let path = layout.path(7, 0);
    assert_eq!((least[path], most[path]), (0.2, 0.2));
    let row = layout.structural_row(1);
    assert!(least[row] > 0.0 && most[row] == f64::INFINITY);
}
