//! The coupling between joints and base, and joint rates that leave the base at rest.

use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::dynamics::space::Vector;
use crate::dynamics::{Data, Tree};

/// A row of the coupling below this, relative to the largest, is a combination of the others:
/// the arm is singular there and the null space larger.
const SINGULAR: f64 = 1e-9;

/// Orthonormal rows that span the coupling I₀⁻¹G at one posture, for the joints that may move.
///
/// Joint rates across all of them give the system no angular momentum with the base at rest:
/// D. Nenchev, Y. Umetani, K. Yoshida, "Analysis of a redundant free-flying spacecraft/manipulator
/// system", doi:10.1109/70.127234.
#[derive(Debug, Clone)]
pub(super) struct Coupling<S> {
    rows: Vec<Vec<S>>,
}

impl<S: Scalar> Coupling<S> {
    /// The coupling at joint positions `q`, with the joints named in `locked` held.
    pub fn at<Sp: Space>(
        tree: &Tree<Sp>,
        q: &[S],
        locked: &[bool],
        data: &mut Data<Sp, S>,
    ) -> Self {
        tree.kinematics(q, data);
        tree.momentum(data);
        let mut rows = vec![vec![S::zero(); q.len()]; Sp::ANGLES];
        let mut unit = vec![S::zero(); q.len()];
        for j in (0..q.len()).filter(|&j| !locked[j]) {
            unit[j] = S::one();
            tree.base_rate(&unit, data);
            unit[j] = S::zero();
            for (row, &component) in rows.iter_mut().zip(data.base_rate.components()) {
                row[j] = component;
            }
        }
        Self {
            rows: orthonormal(rows),
        }
    }

    /// Number of independent rows.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Takes out of `rates` what would turn the base.
    pub fn remove(&self, rates: &mut [S]) {
        // Twice: the first leaves rounding errors of the size of what it takes out.
        for row in self.rows.iter().chain(&self.rows) {
            let part = dot(row, rates);
            for (rate, &r) in rates.iter_mut().zip(row) {
                *rate -= part * r;
            }
        }
    }
}

/// Gram-Schmidt with the longest remaining row first.
fn orthonormal<S: Scalar>(mut rows: Vec<Vec<S>>) -> Vec<Vec<S>> {
    let mut found: Vec<Vec<S>> = Vec::with_capacity(rows.len());
    let length = |row: &[S]| dot(row, row).value().sqrt();
    let largest = rows.iter().map(|row| length(row)).fold(0.0, f64::max);
    while let Some(next) =
        (0..rows.len()).max_by(|&a, &b| length(&rows[a]).total_cmp(&length(&rows[b])))
    {
        let mut row = rows.swap_remove(next);
        if length(&row) <= SINGULAR * largest {
            break;
        }
        scale_to_unit(&mut row);
        for other in &mut rows {
            for _ in 0..2 {
                let part = dot(&row, other);
                for (value, &r) in other.iter_mut().zip(&row) {
                    *value -= part * r;
                }
            }
        }
        found.push(row);
    }
    found
}

pub(super) fn dot<S: Scalar>(a: &[S], b: &[S]) -> S {
    let mut sum = S::zero();
    for (&x, &y) in a.iter().zip(b) {
        sum += x * y;
    }
    sum
}

pub(super) fn scale_to_unit<S: Scalar>(v: &mut [S]) {
    let factor = dot(v, v).sqrt().recip();
    for value in v {
        *value *= factor;
    }
}
