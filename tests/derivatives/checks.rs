//! A transcribed programme written down once more, and what is compared.

use crate::reference::*;
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::space::Space;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::ocp::{Ends, Formulation, InteriorPoint, Interval, LimitGroup, Ocp, Point};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;
use ffsm_ipopt::transcription::{Patterns, Transcription};
use num_dual::HyperDual64;
use num_traits::Zero;

/// The limits of `system` that may give way.
pub fn groups<Sp: Space>(system: &FreeFloating<Sp>) -> Vec<LimitGroup> {
    let limits = system.elastic_limits().into_iter();
    limits.map(|limit| limit.group).collect()
}

/// Objective and constraints of the programme, written out anew from (25) to (27).
pub fn programme<O: Ocp>(ocp: &O, mesh: &Mesh, v: &[Reference]) -> (Reference, Vec<Reference>) {
    let f: Formulation = ocp.formulation();
    let (n, m) = f.widths();
    let width = n + m;
    let node = |k: usize| &v[k * width..];
    // Behind the last states: the duration and t₀ where they are free, parameters, integrals.
    let mut border = &v[mesh.points() * width + n..];
    let mut time = |bounds: &Interval| match bounds.is_fixed() {
        true => Reference::constant(bounds.lower),
        false => *border.split_off_first().unwrap(),
    };
    let [duration, start] = [time(&f.duration), time(&f.initial_time)];
    let (parameters, integrals) = border.split_at(f.parameters.len());
    let mut scratch = ocp.scratch();
    let mut rows = Vec::new();
    let mut cost = Reference::zero();
    let mut sums = vec![Reference::zero(); f.integrals.len()];
    let points = mesh.points();
    let mut k = 0;
    for s in 0..mesh.segments() {
        let rule = mesh.rule(s);
        let half = duration * (0.5 * mesh.width(s));
        for i in 0..rule.len() {
            for (w, passed) in f.way_points.iter().enumerate() {
                if mesh.node_at(passed.fraction) == Some(k) {
                    let mut own = vec![Reference::zero(); passed.rows.len()];
                    let point = InteriorPoint {
                        way_point: w,
                        x: &node(k)[..n],
                        parameters,
                        t: start + duration * passed.fraction,
                    };
                    ocp.way_point(point, &mut scratch, &mut own);
                    rows.extend(own);
                }
            }
            let t = start + duration * mesh.fraction(s, rule.points()[i]);
            let mut rates = vec![Reference::zero(); n];
            let mut path = vec![Reference::zero(); f.path.len()];
            let point = Point {
                x: &node(k)[..n],
                u: &node(k)[n..width],
                parameters,
                t,
            };
            let running = ocp.continuous(point, &mut scratch, &mut rates, &mut path);
            cost += running * half * rule.weights()[i];
            let mut integrands = vec![Reference::zero(); sums.len()];
            ocp.integrands(point, &mut scratch, &mut integrands);
            for (sum, g) in sums.iter_mut().zip(integrands) {
                *sum += g * half * rule.weights()[i];
            }
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
        parameters,
        integrals,
        initial_time: start,
        duration,
    };
    cost += ocp.boundary(ends, &mut scratch, &mut boundary);
    rows.extend(boundary);
    rows.extend(sums.iter().zip(integrals).map(|(&sum, &q)| q - sum));
    if f.has_free_time() && !f.final_time.is_free() {
        rows.push(start + duration);
    }
    (cost, rows)
}

pub fn random_within(bounds: (f64, f64), random: &mut fastrand::Rng) -> f64 {
    let (lower, upper) = (bounds.0.max(-1.2), bounds.1.min(1.2));
    if lower < upper {
        lower + random.f64() * (upper - lower)
    } else {
        bounds.0
    }
}

/// Compares everything at two random points; every nonzero must be alive at one of them.
pub fn check<O: Ocp>(ocp: &O, mesh: Mesh) {
    check_with(ocp, mesh, |_, _| false);
}

/// The same where the entries of the Jacobian for which `cancels` says so, by the names of row and
/// column, are in the pattern and yet zero: operations do not show what cancels.
pub fn check_with<O: Ocp>(ocp: &O, mesh: Mesh, cancels: impl Fn(&str, &str) -> bool) {
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
        assert!(
            *alive != cancels(&row, &column),
            "structural zero in the Jacobian, or none where one is expected: {row} by {column}"
        );
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
pub fn close(found: f64, expected: f64, scale: f64, what: &str) {
    assert!(
        (found - expected).abs() <= 1e-10 * scale.max(1e-3),
        "{what}: {found:e} instead of {expected:e}"
    );
}

pub fn check_problem(problem: &Problem, mesh: Mesh) {
    check_problem_with(problem, mesh, |_, _| false);
}

pub fn check_problem_with(problem: &Problem, mesh: Mesh, cancels: impl Fn(&str, &str) -> bool) {
    match FreeFloating::planar(problem) {
        Some(planar) => check_with(&planar, mesh, cancels),
        None => check_with(&FreeFloating::spatial(problem), mesh, cancels),
    }
}

pub fn small() -> Mesh {
    Mesh::new(vec![0.0, 0.3, 1.0], &[2, 1]).unwrap()
}
