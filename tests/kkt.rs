//! The multifrontal linear solver by itself, against dense eigenvalues and dense solutions.

use fastrand::Rng;
use ffsm_ipopt::nlp::kkt::{Factors, Inertia, NotFinite, Pattern, PatternError, Symbolic};
use ffsm_ipopt::parallel;
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::num::NonZero;

/// A symmetric matrix by the entries of its lower triangle.
#[derive(Clone)]
struct Matrix {
    order: usize,
    entries: Vec<(usize, usize, f64)>,
}

impl Matrix {
    fn new(order: usize) -> Self {
        Self {
            order,
            entries: Vec::new(),
        }
    }

    fn push(&mut self, i: usize, j: usize, value: f64) {
        self.entries.push((i.max(j), i.min(j), value));
    }

    fn dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.order, self.order);
        for &(i, j, value) in &self.entries {
            dense[(i, j)] += value;
            if i != j {
                dense[(j, i)] += value;
            }
        }
        dense
    }

    /// Pattern and values by columns.
    fn sparse(&self) -> (Pattern, Vec<f64>) {
        let mut entries = self.entries.clone();
        entries.sort_by_key(|&(i, j, _)| (j, i));
        let mut starts = vec![0; self.order + 1];
        for &(_, j, _) in &entries {
            starts[j + 1] += 1;
        }
        for j in 0..self.order {
            starts[j + 1] += starts[j];
        }
        let rows = entries.iter().map(|&(i, _, _)| i as u32).collect();
        let values = entries.iter().map(|&(_, _, value)| value).collect();
        (Pattern::new(starts, rows).expect("a pattern"), values)
    }

    /// Factorises, and solves for a known solution; its largest scaled residual.
    fn run(&self) -> (Inertia, f64) {
        let (pattern, values) = self.sparse();
        let symbolic = Symbolic::new(pattern);
        let mut factors = Factors::new(&symbolic);
        let inertia = factors.factor(&symbolic, &values, 1e-8).expect("finite");
        let dense = self.dense();
        let known = DVector::from_fn(self.order, |i, _| 1.0 + (i % 7) as f64);
        let b = &dense * &known;
        let mut x: Vec<f64> = b.iter().copied().collect();
        factors.solve(&symbolic, &mut x);
        let mut x = DVector::from_vec(x);
        for _ in 0..2 {
            let mut r: Vec<f64> = (&b - &dense * &x).iter().copied().collect();
            factors.solve(&symbolic, &mut r);
            x += DVector::from_vec(r);
        }
        let scale = dense.abs().row_sum().max() * x.amax() + b.amax();
        let residual = (&b - &dense * &x).amax() / scale.max(1e-300);
        (inertia, residual)
    }

    fn negative_eigenvalues(&self) -> usize {
        let values = SymmetricEigen::new(self.dense()).eigenvalues;
        values.iter().filter(|v| **v < 0.0).count()
    }

    /// Asserts the inertia of the eigenvalues and a small residual.
    fn check(&self, what: &str) {
        let (inertia, residual) = self.run();
        assert_eq!(
            inertia.negative,
            self.negative_eigenvalues(),
            "{what}: {inertia:?}"
        );
        assert_eq!(inertia.zero, 0, "{what}: {inertia:?}");
        assert!(
            residual < 1e-13,
            "{what}: residual {residual:e}, {inertia:?}"
        );
    }
}

fn uniform(rng: &mut Rng) -> f64 {
    2.0 * rng.f64() - 1.0
}

/// A sparse matrix without any structure, some diagonals missing.
fn indefinite(rng: &mut Rng, order: usize, entries: usize) -> Matrix {
    let mut matrix = Matrix::new(order);
    for i in 0..order {
        if rng.f64() < 0.7 {
            matrix.push(i, i, uniform(rng));
        }
        // A cycle, so that it is not singular by structure.
        matrix.push(i, (i + 1) % order, uniform(rng));
    }
    for _ in 0..entries {
        let (i, j) = (rng.usize(..order), rng.usize(..order));
        matrix.push(i, j, uniform(rng));
    }
    matrix
}

/// [H Jᵀ; J 0] with a sparse J.
fn saddle(rng: &mut Rng, variables: usize, rows: usize, scale: impl Fn(&mut Rng) -> f64) -> Matrix {
    let mut matrix = separable(rng, variables, rows, scale);
    for _ in 0..variables {
        let (i, j) = (rng.usize(..variables), rng.usize(..variables));
        if i != j {
            let value = 0.1 * uniform(rng);
            matrix.push(i, j, value);
        }
    }
    matrix
}

/// The same with a diagonal H.
fn separable(
    rng: &mut Rng,
    variables: usize,
    rows: usize,
    scale: impl Fn(&mut Rng) -> f64,
) -> Matrix {
    let mut matrix = Matrix::new(variables + rows);
    for i in 0..variables {
        let value = scale(rng);
        matrix.push(i, i, value);
    }
    for row in 0..rows {
        matrix.push(variables + row, variables + row, 0.0);
        // Its own variable, so that the rows are independent.
        matrix.push(variables + row, row, 1.0 + rng.f64());
        for _ in 0..3 {
            let value = 0.3 * uniform(rng);
            matrix.push(variables + row, rng.usize(..variables), value);
        }
    }
    matrix
}

#[test]
fn sparse_indefinite_matrices() {
    let mut rng = Rng::with_seed(1);
    for order in [2, 3, 5, 8, 13, 40, 90, 150] {
        for density in [0, 1, 3] {
            let matrix = indefinite(&mut rng, order, density * order);
            matrix.check(&format!("order {order}, density {density}"));
        }
    }
}

#[test]
fn saddle_points() {
    let mut rng = Rng::with_seed(2);
    for variables in [4, 20, 60, 120] {
        for rows in [1, variables / 2, variables] {
            let matrix = saddle(&mut rng, variables, rows, |rng| 0.5 + rng.f64());
            matrix.check(&format!("{variables} variables, {rows} rows"));
            let matrix = saddle(&mut rng, variables, rows, uniform);
            matrix.check(&format!("{variables} variables, {rows} rows, indefinite"));
        }
    }
}

#[test]
fn badly_scaled_saddle_points() {
    // Barrier terms: variables near their bounds, and others far from them.
    let mut rng = Rng::with_seed(3);
    for _ in 0..20 {
        let matrix = separable(&mut rng, 60, 30, |rng| 10_f64.powf(16.0 * rng.f64() - 8.0));
        let (inertia, residual) = matrix.run();
        assert_eq!((inertia.negative, inertia.zero), (30, 0));
        assert!(residual < 1e-13, "{residual:e}");
    }
}

#[test]
fn dense_matrices_beyond_a_block() {
    let mut rng = Rng::with_seed(4);
    for order in [24, 25, 60, 130] {
        let mut matrix = Matrix::new(order);
        for i in 0..order {
            for j in 0..=i {
                let value = if i == j { 0.0 } else { uniform(&mut rng) };
                matrix.push(i, j, value);
            }
        }
        matrix.check(&format!("dense {order}"));
    }
}

#[test]
fn a_row_that_touches_everything() {
    let mut rng = Rng::with_seed(5);
    let mut matrix = saddle(&mut rng, 900, 450, |rng| 0.5 + rng.f64());
    for i in 0..1350 {
        let value = uniform(&mut rng);
        matrix.push(1350, i, value);
    }
    matrix.push(1350, 1350, 3.0);
    matrix.order += 1;
    let (inertia, residual) = matrix.run();
    assert!(inertia.negative == 450 || inertia.negative == 451);
    assert_eq!(inertia.zero, 0);
    assert!(residual < 1e-13, "{residual:e}");
}

#[test]
fn rank_deficient_jacobians_are_singular() {
    let mut rng = Rng::with_seed(6);
    for copies in [1, 3] {
        let mut matrix = saddle(&mut rng, 50, 20, |rng| 0.5 + rng.f64());
        // Rows that repeat others, scaled.
        for copy in 0..copies {
            let row = matrix.order;
            let again: Vec<_> = matrix
                .entries
                .iter()
                .filter(|(i, j, _)| *i == 50 + copy && *j < 50)
                .map(|&(_, j, value)| (j, 0.7 * value))
                .collect();
            for (j, value) in again {
                matrix.push(row, j, value);
            }
            matrix.order += 1;
        }
        let (inertia, _) = matrix.run();
        assert_eq!((inertia.negative, inertia.zero), (20, copies));
    }
}

#[test]
fn matrices_of_zeros_are_singular() {
    let mut matrix = Matrix::new(5);
    for i in 0..5 {
        matrix.push(i, i, 0.0);
        matrix.push(i, 0, 0.0);
    }
    assert_eq!(matrix.run().0.zero, 5);
    // A column without any entry.
    let mut matrix = Matrix::new(3);
    matrix.push(0, 0, 2.0);
    matrix.push(2, 2, -1.0);
    let (inertia, _) = matrix.run();
    assert_eq!((inertia.negative, inertia.zero), (1, 1));
}

#[test]
fn the_smallest_matrices() {
    let empty = Symbolic::new(Pattern::new(vec![0], vec![]).expect("a pattern"));
    let mut factors = Factors::new(&empty);
    assert_eq!(factors.factor(&empty, &[], 0.1), Ok(Inertia::default()));
    factors.solve(&empty, &mut []);

    for value in [4.0, -4.0] {
        let mut matrix = Matrix::new(1);
        matrix.push(0, 0, value);
        matrix.check("one by one");
    }
    let mut pair = Matrix::new(2);
    pair.push(1, 0, 3.0);
    pair.check("a pair without diagonal");
}

#[test]
fn entries_given_twice_are_summed() {
    let mut matrix = Matrix::new(3);
    for (i, j, value) in [
        (0, 0, 1.0),
        (1, 0, 2.0),
        (1, 0, -1.5),
        (1, 1, 1.0),
        (2, 1, 1.0),
        (2, 2, -3.0),
    ] {
        matrix.push(i, j, value);
        matrix.push(i, j, value);
    }
    matrix.check("doubled");
}

#[test]
fn random_structures() {
    let mut rng = Rng::with_seed(7);
    for case in 0..300 {
        let order = rng.usize(1..40);
        let mut matrix = Matrix::new(order);
        for i in 0..order {
            let value = 0.1 + uniform(&mut rng);
            matrix.push(i, i, value);
        }
        for _ in 0..rng.usize(..3 * order) {
            let (i, j) = (rng.usize(..order), rng.usize(..order));
            let value = uniform(&mut rng) * 10_f64.powi(rng.i32(-3..3));
            matrix.push(i, j, value);
        }
        matrix.check(&format!("case {case}"));
    }
}

#[test]
fn one_analysis_serves_many_matrices_and_always_alike() {
    let mut rng = Rng::with_seed(8);
    let matrix = saddle(&mut rng, 80, 40, |rng| 0.5 + rng.f64());
    let (pattern, values) = matrix.sparse();
    let symbolic = Symbolic::new(pattern);
    let mut used = Factors::new(&symbolic);
    for round in 0..5 {
        let values: Vec<f64> = values
            .iter()
            .map(|v| v * (1.0 + f64::from(round)))
            .collect();
        let mut fresh = Factors::new(&symbolic);
        let one = used.factor(&symbolic, &values, 1e-8);
        assert_eq!(one, fresh.factor(&symbolic, &values, 1e-8));
        let mut x = vec![1.0; 120];
        let mut y = x.clone();
        used.solve(&symbolic, &mut x);
        fresh.solve(&symbolic, &mut y);
        assert_eq!(x, y);
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    let mut matrix = Matrix::new(3);
    for i in 0..3 {
        matrix.push(i, i, 1.0);
    }
    let (pattern, mut values) = matrix.sparse();
    let symbolic = Symbolic::new(pattern);
    let mut factors = Factors::new(&symbolic);
    for bad in [f64::NAN, f64::INFINITY] {
        values[1] = bad;
        assert_eq!(factors.factor(&symbolic, &values, 1e-8), Err(NotFinite));
    }
}

#[test]
fn patterns_that_are_none_are_refused() {
    assert_eq!(Pattern::new(vec![], vec![]), Err(PatternError::Starts(0)));
    assert_eq!(
        Pattern::new(vec![0, 2, 1], vec![0, 1]),
        Err(PatternError::Starts(2))
    );
    assert_eq!(
        Pattern::new(vec![0, 1, 3], vec![0, 1]),
        Err(PatternError::Starts(2))
    );
    let above = PatternError::Entry {
        row: 0,
        column: 1,
        order: 2,
    };
    assert_eq!(Pattern::new(vec![0, 1, 2], vec![0, 0]), Err(above));
}

/// A chain of `stages` dense blocks with a few links from each to the next, and multipliers: the
/// structure of a transcription.
fn chain(rng: &mut Rng, stages: usize) -> Matrix {
    let (variables, rows) = (14, 8);
    let primal = stages * variables;
    let mut matrix = Matrix::new(primal + stages * rows);
    for stage in 0..stages {
        let first = stage * variables;
        for i in 0..variables {
            for j in 0..=i {
                let value = uniform(rng) + if i == j { 16.0 } else { 0.0 };
                matrix.push(first + i, first + j, value);
            }
        }
        for row in 0..rows {
            let multiplier = primal + stage * rows + row;
            let last = if stage + 1 < stages {
                variables + 4
            } else {
                variables
            };
            for j in 0..last {
                matrix.push(multiplier, first + j, uniform(rng));
            }
        }
    }
    matrix
}

#[test]
fn what_is_cut_along_the_time_axis_has_the_factors_of_any_number_of_threads() {
    let mut rng = Rng::with_seed(11);
    let matrix = chain(&mut rng, 96);
    let (pattern, values) = matrix.sparse();
    let symbolic = Symbolic::new(pattern);
    assert!(symbolic.concurrency() > 1, "in one piece");
    let right: Vec<f64> = (0..symbolic.len()).map(|_| uniform(&mut rng)).collect();
    let solve = |threads| {
        let threads = NonZero::new(threads).unwrap();
        let mut factors = Factors::new(&symbolic);
        let inertia = parallel::with_threads(threads, || {
            factors.factor(&symbolic, &values, 1e-8).unwrap()
        });
        let mut x = right.clone();
        factors.solve(&symbolic, &mut x);
        (inertia, x)
    };
    let (inertia, x) = solve(1);
    // The blocks are positive definite by their diagonals: one negative eigenvalue a row.
    assert_eq!((inertia.negative, inertia.zero), (96 * 8, 0));
    for threads in [2, 5] {
        let (other, y) = solve(threads);
        assert_eq!(inertia, other);
        assert!(x.iter().zip(&y).all(|(x, y)| x.to_bits() == y.to_bits()));
    }
    let mut residual = right.clone();
    for &(i, j, value) in &matrix.entries {
        residual[i] -= value * x[j];
        if i != j {
            residual[j] -= value * x[i];
        }
    }
    let most = residual.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
    assert!(most < 1e-9, "{most:e}");
}

/// A chain with a border: two unknowns that one row of every stage depends on, as static parameters, and
/// a row with one entry for every stage, as an integral, with its value where `open`.
fn bordered(rng: &mut Rng, stages: usize, open: bool) -> Matrix {
    let chain = chain(rng, stages);
    let (variables, rows) = (14, 8);
    let primal = stages * variables;
    let added = 2 + usize::from(open);
    let shifted = |i: usize| if i < primal { i } else { i + added };
    let mut matrix = Matrix::new(chain.order + added + 1);
    for &(i, j, value) in &chain.entries {
        matrix.push(shifted(i), shifted(j), value);
    }
    let integral = chain.order + added;
    for stage in 0..stages {
        for parameter in 0..2 {
            let row = shifted(primal + stage * rows + parameter);
            matrix.push(row, primal + parameter, uniform(rng));
        }
        matrix.push(integral, stage * variables + 13, uniform(rng));
    }
    for parameter in 0..2 {
        matrix.push(primal + parameter, primal + parameter, 1.0);
    }
    if open {
        matrix.push(integral, primal + 2, 1.0);
    }
    matrix
}

#[test]
fn unknowns_and_rows_of_the_whole_time_axis() {
    let mut rng = Rng::with_seed(5);
    for open in [false, true] {
        for stages in [1, 3, 7] {
            bordered(&mut rng, stages, open).check(&format!("{stages} stages, {open}"));
        }
    }
}

/// They belong to no domain: the axis is cut as without them, and a front is larger by so many rows.
#[test]
fn a_border_is_eliminated_last() {
    let mut rng = Rng::with_seed(6);
    let plain = Symbolic::new(chain(&mut rng, 96).sparse().0);
    for open in [false, true] {
        let border = Symbolic::new(bordered(&mut rng, 96, open).sparse().0);
        assert_eq!(border.concurrency(), plain.concurrency());
        let growth = border.multiplications() / plain.multiplications();
        assert!(growth < 1.7, "{growth}");
    }
}

/// Unknowns of very different sizes: what is delayed for its units' sake finds a pivot once the
/// columns are of one size.
#[test]
fn scaling_keeps_inertia_and_solutions_and_delays_less() {
    let mut rng = Rng::with_seed(12);
    let mut matrix = chain(&mut rng, 20);
    let sizes: Vec<f64> = (0..matrix.order)
        .map(|_| 10_f64.powf(6.0 * uniform(&mut rng)))
        .collect();
    for (i, j, value) in &mut matrix.entries {
        *value *= sizes[*i] * sizes[*j];
    }
    let (pattern, values) = matrix.sparse();
    let symbolic = Symbolic::new(pattern);
    let mut factors = Factors::new(&symbolic);
    let plain = factors.factor(&symbolic, &values, 1e-4).unwrap();
    let scaled = factors.factor_scaled(&symbolic, &values, 1e-4).unwrap();
    assert_eq!((plain.negative, plain.zero), (20 * 8, 0));
    assert_eq!((scaled.negative, scaled.zero), (20 * 8, 0));
    assert!(4 * scaled.delayed < plain.delayed, "{plain:?} {scaled:?}");
    assert!(scaled.entries < plain.entries && scaled.entries >= symbolic.factor_size());
    // Residuals row by row, against what each row sums.
    let right: Vec<f64> = sizes.iter().map(|size| size * uniform(&mut rng)).collect();
    let mut x = right.clone();
    factors.solve(&symbolic, &mut x);
    let (mut residual, mut sum) = (right.clone(), vec![0.0; matrix.order]);
    for &(i, j, value) in &matrix.entries {
        residual[i] -= value * x[j];
        sum[i] += (value * x[j]).abs();
        if i != j {
            residual[j] -= value * x[i];
            sum[j] += (value * x[i]).abs();
        }
    }
    for (r, sum) in residual.iter().zip(&sum) {
        assert!(r.abs() <= 1e-9 * sum, "{r:e} of {sum:e}");
    }
}
