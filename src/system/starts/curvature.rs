//! Curvature of the momentum connection: how far a small loop of two joints turns the base.

use crate::dynamics::space::{Algebra, Space, Vector};
use crate::dynamics::{Data, Tree};
use crate::system::FreeFloating;

/// Step of the differences, rad or m: the curvature only ranks.
const STEP: f64 = 1e-4;

/// Two joints and how far a loop of theirs turns the base.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    pub joints: [usize; 2],
    /// Turn of the base for each unit of area, rad.
    pub turn: f64,
}

/// All pairs of joints at the joint positions `q`.
///
/// The base turns by ω = A(θ)·θ̇, in base axes. A small loop in the plane of joints i and j turns it
/// by its area times F_ij = ∂_i A_j − ∂_j A_i + A_i × A_j (R. L. Hatton, H. Choset,
/// doi:10.1177/0278364910394392).
pub(super) fn planes<Sp: Space>(system: &FreeFloating<Sp>, q: &[f64]) -> Vec<Plane> {
    let n = q.len();
    let mut data = Data::<Sp, f64>::new(system.tree());
    let here = connection(system.tree(), q, &mut data);
    let slopes: Vec<Vec<Sp::Angular<f64>>> = (0..n)
        .map(|i| {
            let mut side = |step: f64| {
                let mut moved = q.to_vec();
                moved[i] += step;
                connection(system.tree(), &moved, &mut data)
            };
            let (above, below) = (side(STEP), side(-STEP));
            let slope =
                |(a, b): (&Sp::Angular<f64>, &Sp::Angular<f64>)| a.minus(b).times(0.5 / STEP);
            above.iter().zip(&below).map(slope).collect()
        })
        .collect();
    let plane = |i: usize, j: usize| {
        let turn = slopes[i][j]
            .minus(&slopes[j][i])
            .plus(&Sp::cross_angular(&here[i], &here[j]));
        Plane {
            joints: [i, j],
            turn: turn.dot(&turn).sqrt(),
        }
    };
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    pairs.map(|(i, j)| plane(i, j)).collect()
}

/// A: the base's rate for each unit of each joint's.
fn connection<Sp: Algebra>(
    tree: &Tree<Sp>,
    q: &[f64],
    data: &mut Data<Sp, f64>,
) -> Vec<Sp::Angular<f64>> {
    tree.kinematics(q, data);
    tree.momentum(data);
    let mut rates = vec![0.0; q.len()];
    (0..q.len())
        .map(|j| {
            rates.fill(0.0);
            rates[j] = 1.0;
            tree.base_rate(&rates, data);
            data.base_rate
        })
        .collect()
}
