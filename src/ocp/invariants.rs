//! Invariants of the dynamics, and the conditions that depend on others because of them.
//!
//! A function φ(x) that no control changes, as the length of a quaternion, is at the end what it is at
//! the start. Where the start is fixed and all states in φ are fixed at the end, one of these
//! conditions follows from the others: its row adds nothing but a singular system.
//!
//! Derived in docs/algorithms.md#dependent-conditions.

use super::dyn_ocp::{DynOcp, Functions};
use super::{Formulation, Interval, Point};
use nalgebra::{DMatrix, SVD};

/// A combination of columns below this part of the largest one is zero to rounding.
const ROUNDING: f64 = 1e-12;

/// A component whose part in an invariant is below this part of the largest one has none.
const PART: f64 = 1e-6;

/// A condition that others contradict by more than this part of its size is left as it is.
const CONTRADICTION: f64 = 1e-3;

/// States fixed at both ends beyond which invariants are not looked for.
const MOST: usize = 60;

/// A condition on a state that follows from the others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dependent {
    /// The state.
    pub state: usize,
    /// The way-point where it is fixed; `None` for the end.
    pub way_point: Option<usize>,
    /// The value that was asked for.
    pub asked: f64,
    /// Bounds in its place, around the value that the other conditions leave: they hold no other one
    /// that the invariant allows, nor are they met.
    pub bounds: Interval,
}

impl Dependent {
    /// Whether a trajectory that has `found` there has what the invariant leaves, as far as can be
    /// told by a trajectory: an invariant is known from samples.
    pub fn holds(&self, found: f64) -> bool {
        let reach = 0.5 * (self.bounds.upper - self.bounds.lower);
        (found - self.bounds.center()).abs() <= CONTRADICTION * reach
    }
}

/// The conditions of `formulation` that follow from others.
///
/// Looked for are invariants Σ (c_i x_i + ½ q_i x_i²) of the states fixed at the start and at the
/// other instant.
pub(crate) fn dependent(ocp: &dyn DynOcp, formulation: &Formulation) -> Vec<Dependent> {
    let way_points = formulation.way_points.iter().enumerate();
    let way_points = way_points.map(|(w, point)| (Some(w), &point.states));
    let instants = way_points.chain([(None, &formulation.terminal)]);
    let mut found = Vec::new();
    let mut known: Option<(Vec<usize>, Vec<Vec<f64>>)> = None;
    for (way_point, at) in instants {
        let both = formulation.initial.iter().zip(at).enumerate();
        let fixed: Vec<usize> = both
            .filter(|(_, (start, end))| start.is_fixed() && end.is_fixed())
            .map(|(i, _)| i)
            .collect();
        if fixed.is_empty() || fixed.len() > MOST {
            continue;
        }
        let invariants = match &known {
            Some((of, invariants)) if *of == fixed => invariants.clone(),
            _ => invariants(ocp, formulation, &fixed),
        };
        let ends = fixed
            .iter()
            .map(|&i| [formulation.initial[i].lower, at[i].lower]);
        for (component, bounds) in conditions(&invariants, &ends.collect::<Vec<_>>()) {
            let state = fixed[component];
            let asked = at[state].lower;
            found.push(Dependent {
                state,
                way_point,
                asked,
                bounds,
            });
        }
        known = Some((fixed, invariants));
    }
    found
}

/// Coefficients c and then q of the invariants of the states `fixed`, a basis of all of them.
fn invariants(ocp: &dyn DynOcp, formulation: &Formulation, fixed: &[usize]) -> Vec<Vec<f64>> {
    let count = fixed.len();
    let (columns, samples) = (2 * count, 3 * count + 8);
    let mut rates_of = Samples::new(ocp, formulation);
    let mut matrix = DMatrix::zeros(samples, columns);
    for row in 0..samples {
        let Some((x, rates)) = rates_of.next() else {
            return Vec::new();
        };
        let largest = rates
            .iter()
            .fold(0.0, |most: f64, rate| most.max(rate.abs()));
        for (j, &i) in fixed.iter().enumerate() {
            let rate = rates[i] / largest.max(f64::MIN_POSITIVE);
            matrix[(row, j)] = rate;
            matrix[(row, count + j)] = x[i] * rate;
        }
    }
    // Columns of one size, so that what is rounding error does not depend on units.
    let mut sizes = vec![1.0; columns];
    for (size, mut column) in sizes.iter_mut().zip(matrix.column_iter_mut()) {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
            *size = norm;
        }
    }
    let svd = SVD::new(matrix, false, true);
    let Some(right) = svd.v_t else {
        return Vec::new();
    };
    let largest = svd.singular_values.max();
    let small = svd.singular_values.iter().enumerate();
    small
        .filter(|(_, value)| **value <= ROUNDING * largest)
        .map(|(k, _)| {
            right
                .row(k)
                .iter()
                .zip(&sizes)
                .map(|(w, size)| w / size)
                .collect()
        })
        .collect()
}

/// Which component each invariant fixes at the other instant, and bounds around the value that it
/// leaves; `ends` are the values asked for at both.
fn conditions(invariants: &[Vec<f64>], ends: &[[f64; 2]]) -> Vec<(usize, Interval)> {
    let count = ends.len();
    let mut left: Vec<Vec<f64>> = invariants.to_vec();
    let size = |i: usize| {
        let [start, end] = ends[i];
        let size = start.abs().max(end.abs());
        if size > 0.0 { size } else { 1.0 }
    };
    let slope = |of: &[f64], i: usize| of[i] + of[count + i] * ends[i][1];
    let mut found = Vec::new();
    let mut taken = vec![false; count];
    while let Some(mut invariant) = left.pop() {
        let part = |i: usize| slope(&invariant, i).abs() * size(i);
        // Against what the terms come to before they cancel.
        let whole = (0..count).fold(0.0, |most: f64, i| {
            let [c, q] = [invariant[i], invariant[count + i]];
            most.max(c.abs() * size(i)).max(q.abs() * size(i).powi(2))
        });
        let free = (0..count).filter(|&i| !taken[i]);
        let Some(pivot) = free.max_by(|&i, &j| part(i).total_cmp(&part(j))) else {
            break;
        };
        if part(pivot) <= PART * whole {
            continue;
        }
        let scale = slope(&invariant, pivot);
        invariant.iter_mut().for_each(|w| *w /= scale);
        for other in &mut left {
            let factor = slope(other, pivot);
            for (w, by) in other.iter_mut().zip(&invariant) {
                *w -= factor * by;
            }
        }
        taken[pivot] = true;
        found.push((pivot, invariant));
    }
    // Pivots found later may still have a part in invariants found before.
    for k in (0..found.len()).rev() {
        let (pivot, by) = found[k].clone();
        for (_, other) in &mut found[..k] {
            let factor = slope(other, pivot);
            for (w, by) in other.iter_mut().zip(&by) {
                *w -= factor * by;
            }
        }
    }
    let conditions = found.into_iter().filter_map(|(pivot, invariant)| {
        let change: f64 = (0..count)
            .map(|i| {
                let [start, end] = ends[i];
                let term = |x: f64| invariant[i] * x + 0.5 * invariant[count + i] * x * x;
                term(start) - term(end)
            })
            .sum();
        let asked = ends[pivot][1];
        let other_value = 2.0 / invariant[count + pivot].abs();
        let reach = 0.25 * other_value.min(4.0 * size(pivot));
        (change.abs() <= CONTRADICTION * size(pivot)).then(|| {
            let left = asked + change;
            (pivot, Interval::new(left - reach, left + reach))
        })
    });
    conditions.collect()
}

/// Rates at random states and controls.
struct Samples<'a> {
    formulation: &'a Formulation,
    functions: Box<dyn Functions + 'a>,
    random: fastrand::Rng,
    x: Vec<f64>,
    u: Vec<f64>,
    p: Vec<f64>,
    rates: Vec<f64>,
    path: Vec<f64>,
}

impl<'a> Samples<'a> {
    /// Places that are tried for one where the rates are finite.
    const TRIALS: usize = 10;

    fn new(ocp: &'a dyn DynOcp, formulation: &'a Formulation) -> Self {
        let (states, controls) = formulation.widths();
        Self {
            formulation,
            functions: ocp.functions(),
            random: fastrand::Rng::with_seed(28),
            x: vec![0.0; states],
            u: vec![0.0; controls],
            p: vec![0.0; formulation.parameters.len()],
            rates: vec![0.0; states],
            path: vec![0.0; formulation.path.len()],
        }
    }

    /// States and rates at another place; `None` where none is found with finite rates.
    fn next(&mut self) -> Option<(&[f64], &[f64])> {
        (0..Self::TRIALS)
            .any(|_| {
                self.evaluate();
                self.rates.iter().all(|rate| rate.is_finite())
            })
            .then_some((self.x.as_slice(), self.rates.as_slice()))
    }

    /// Rates somewhere near the states at both ends.
    fn evaluate(&mut self) {
        let Self {
            formulation,
            random,
            ..
        } = self;
        let mut within = |[one, other]: [f64; 2], bounds: &Interval| {
            let spread = (other - one).abs();
            let spread = match spread > 0.0 {
                true => spread,
                false => one.abs().max(1.0),
            };
            bounds.clamp(0.5 * (one + other) + 1.5 * spread * (random.f64() - 0.5))
        };
        let fixed = |end: &Interval, other: f64| if end.is_fixed() { end.lower } else { other };
        for (i, x) in self.x.iter_mut().enumerate() {
            let bounds = &formulation.states[i].bounds;
            let start = fixed(&formulation.initial[i], bounds.center());
            let end = fixed(&formulation.terminal[i], start);
            *x = within([start, end], bounds);
        }
        for (u, control) in self.u.iter_mut().zip(&formulation.controls) {
            let centre = control.bounds.center();
            let size = match control.bounds.upper - control.bounds.lower {
                width if width.is_finite() => 0.5 * width,
                _ => 1.0,
            };
            *u = within([centre - size, centre + size], &control.bounds);
        }
        let guesses = formulation.parameter_guess.iter();
        for ((p, guess), parameter) in self.p.iter_mut().zip(guesses).zip(&formulation.parameters) {
            *p = within([*guess; 2], &parameter.bounds);
        }
        let elapsed = self.random.f64() * formulation.duration.typical();
        let point = Point {
            x: &self.x,
            u: &self.u,
            t: formulation.initial_time.clamp(0.0) + elapsed,
            parameters: &self.p,
        };
        self.functions
            .continuous(point, &mut self.rates, &mut self.path);
    }
}
