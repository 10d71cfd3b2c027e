//! Quadratic forms in the rates: ∫‖η̇‖² dt, ∫‖θ̇‖² dt and ∫[η̇, θ̇]ᵀΛ[η̇, θ̇] dt. Where η are no
//! angles, ω takes the place of η̇.

use super::breakdown::Side;
use super::term::{PathTerm, some};
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use crate::system::instant::Instant;
use crate::system::linearization::{Adjoint, Linearization, Lower};

/// A quadratic form Σ w·rᵢ·rⱼ in r = [base rates, θ̇].
#[derive(Debug, Clone)]
pub(crate) struct RateTerm {
    id: CostId,
    side: Side,
    /// (i, j, w), both triangles.
    weights: Vec<(usize, usize, f64)>,
}

impl RateTerm {
    /// The weighted squares of the base's rates, and of the joints'.
    pub fn squares(problem: &Problem) -> impl Iterator<Item = Self> {
        let cost = &problem.cost;
        let angles = cost.base_rate.len();
        let term = |(id, side, weights, first): (CostId, Side, &[f64], usize)| {
            let diagonal = some(weights)?.into_iter().enumerate();
            let weights = diagonal.map(|(i, weight)| (first + i, first + i, weight));
            Self::new(id, side, weights)
        };
        [
            (CostId::BaseRate, Side::Base, &cost.base_rate[..], 0),
            (CostId::JointRate, Side::Joints, &cost.joint_rate, angles),
        ]
        .into_iter()
        .filter_map(term)
    }

    /// Λ by its three blocks: the base alone, the joints alone, and what couples them; `angles`
    /// are the components of the base's rate.
    pub fn matrix(problem: &Problem, angles: usize) -> impl Iterator<Item = Self> {
        let rows = problem.cost.rate_matrix.iter().flatten().enumerate();
        let all: Vec<(usize, usize, f64)> = rows
            .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &w)| (i, j, w)))
            .collect();
        let side = move |i: usize, j: usize| match (i < angles, j < angles) {
            (true, true) => Side::Base,
            (false, false) => Side::Joints,
            _ => Side::Both,
        };
        let sides = [Side::Base, Side::Joints, Side::Both];
        sides.into_iter().filter_map(move |own| {
            let block = all.iter().filter(|&&(i, j, _)| side(i, j) == own);
            Self::new(CostId::RateMatrix, own, block.copied())
        })
    }

    fn new(
        id: CostId,
        side: Side,
        weights: impl Iterator<Item = (usize, usize, f64)>,
    ) -> Option<Self> {
        let weights: Vec<_> = weights.filter(|&(.., weight)| weight != 0.0).collect();
        (!weights.is_empty()).then_some(Self { id, side, weights })
    }
}

/// The input that rate `i` is, where it is a joint's.
fn joint<Sp: Space>(at: &Linearization<'_, Sp>, i: usize) -> Option<usize> {
    i.checked_sub(Sp::ANGLES).map(|j| at.rate(j))
}

impl<Sp: Space> PathTerm<Sp> for RateTerm {
    fn id(&self) -> CostId {
        self.id
    }

    fn side(&self) -> Side {
        self.side
    }

    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S {
        let rate = |i: usize| match i.checked_sub(Sp::ANGLES) {
            Some(j) => at.dtheta[j],
            None => at.base_rate[i],
        };
        let mut sum = S::zero();
        for &(i, j, weight) in &self.weights {
            sum += rate(i) * rate(j) * weight;
        }
        sum
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]) {
        for &(i, j, weight) in &self.weights {
            // The same for (j, i).
            let slope = 2.0 * weight * at.rates[j];
            match joint(at, i) {
                Some(input) => row[input] += slope,
                None => {
                    for (to, by) in row.iter_mut().zip(at.base_rate_by(i)) {
                        *to += slope * by;
                    }
                }
            }
        }
    }

    fn weigh(&self, at: &Linearization<'_, Sp>, weight: f64, adjoint: &mut Adjoint<'_>) {
        let own = self.weights.iter().filter(|(i, ..)| *i < Sp::ANGLES);
        for &(i, j, own) in own {
            adjoint.base_rate[i] += 2.0 * weight * own * at.rates[j];
        }
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        for &(i, j, own) in &self.weights {
            let second = 2.0 * weight * own;
            match (joint(at, i), joint(at, j)) {
                (Some(row), Some(column)) => {
                    if column <= row {
                        hessian.add(row, column, second);
                    }
                }
                (None, None) => {
                    let (left, right) = (at.base_rate_by(i), at.base_rate_by(j));
                    for (row, a) in left.iter().enumerate() {
                        for (to, b) in hessian.row(row).iter_mut().zip(right) {
                            *to += second * a * b;
                        }
                    }
                }
                // The pair comes twice, as (i, j) and as (j, i): each gives one triangle.
                (None, Some(column)) => {
                    for (row, a) in at.base_rate_by(i).iter().enumerate().skip(column) {
                        hessian.add(row, column, second * a);
                    }
                }
                (Some(row), None) => {
                    for (to, b) in hessian.row(row).iter_mut().zip(at.base_rate_by(j)) {
                        *to += second * b;
                    }
                }
            }
        }
    }
}
