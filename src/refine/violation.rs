//! How far a trajectory leaves its bounds between the nodes, where nothing holds it.
//!
//! Derived in docs/algorithms.md#bounds-between-the-nodes.

use crate::ocp::{Interval, Ocp, Quantity};
use crate::transcription::Discretization;

/// What is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bounded {
    /// A state along the path.
    State(usize),
    /// A path row.
    Path(usize),
}

/// The instant at which a trajectory leaves a bound the farthest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Violation {
    /// Which bound.
    pub what: Bounded,
    /// Segment, counted from 0.
    pub segment: usize,
    /// τ ∈ [−1, 1] in the segment.
    pub tau: f64,
    /// Time, s.
    pub t: f64,
    /// Value there; may be NaN.
    pub value: f64,
    /// How far it is outside; infinite where the value is NaN.
    pub excess: f64,
    /// The same as a part of the quantity's size, which is that of its bounds unless it has one
    /// of its own; of one where the bounds are zero.
    pub relative: f64,
}

/// Places looked at between two neighbouring nodes.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// The farthest that each bounded state and path row is outside in each segment, segments ×
/// those that are outside at all.
///
/// The nodes themselves are left out, the programme holds the bounds there; t_f, which is no
/// collocation point, is looked at as well.
pub fn violations<O: Ocp>(ocp: &O, trajectory: &Discretization) -> Vec<Vec<Violation>> {
    let formulation = ocp.formulation();
    let (n, m) = formulation.widths();
    let limited = |bounds: &Interval| !bounds.is_free();
    let path_rows = formulation.path.iter().any(|row| limited(&row.bounds));
    let quantities: Vec<(Bounded, &Quantity)> = formulation
        .states
        .iter()
        .enumerate()
        .map(|(i, state)| (Bounded::State(i), state))
        .chain(
            formulation
                .path
                .iter()
                .enumerate()
                .map(|(p, row)| (Bounded::Path(p), row)),
        )
        .filter(|(_, quantity)| limited(&quantity.bounds))
        .collect();
    let mesh = &trajectory.mesh;
    if quantities.is_empty() {
        return vec![Vec::new(); mesh.segments()];
    }
    let mut scratch = ocp.scratch::<f64>();
    let (mut x, mut rates, mut u) = (vec![0.0; n], vec![0.0; n], vec![0.0; m]);
    let mut path = vec![0.0; formulation.path.len()];
    (0..mesh.segments())
        .map(|segment| {
            let mut worst: Vec<Option<Violation>> = vec![None; quantities.len()];
            for tau in places(mesh.rule(segment).nodes(), segment + 1 == mesh.segments()) {
                trajectory.state_in(segment, tau, &mut x);
                let t = trajectory.time(mesh.fraction(segment, tau));
                if path_rows {
                    trajectory.control_in(segment, tau, &mut u);
                    let point = trajectory.point(&x, &u, t);
                    ocp.continuous(point, &mut scratch, &mut rates, &mut path);
                }
                for (worst, &(what, quantity)) in worst.iter_mut().zip(&quantities) {
                    let value = match what {
                        Bounded::State(i) => x[i],
                        Bounded::Path(p) => path[p],
                    };
                    let excess = quantity.bounds.violation(value);
                    if excess > worst.map_or(0.0, |w| w.excess) {
                        *worst = Some(Violation {
                            what,
                            segment,
                            tau,
                            t,
                            value,
                            excess,
                            relative: excess / size(quantity),
                        });
                    }
                }
            }
            worst.into_iter().flatten().collect()
        })
        .collect()
}

/// The worst violation of every bound that is exceeded by more than `tolerance` of its size.
pub(super) fn worst_of_each(by_segment: &[Vec<Violation>], tolerance: f64) -> Vec<Violation> {
    let mut found: Vec<Violation> = Vec::new();
    for violation in by_segment.iter().flatten() {
        if violation.relative <= tolerance {
            continue;
        }
        match found.iter_mut().find(|known| known.what == violation.what) {
            Some(known) if known.excess < violation.excess => *known = *violation,
            Some(_) => {}
            None => found.push(*violation),
        }
    }
    found
}

fn places(nodes: &[f64], last: bool) -> Vec<f64> {
    let between = |pair: &[f64]| BETWEEN.map(|share| pair[0] + share * (pair[1] - pair[0]));
    let mut places: Vec<f64> = nodes.windows(2).flat_map(between).collect();
    if last {
        places.push(1.0);
    }
    places
}

/// Its own size, or the larger of the finite bounds' magnitudes.
fn size(quantity: &Quantity) -> f64 {
    if let Some(size) = quantity.size {
        return size;
    }
    let finite = [quantity.bounds.lower, quantity.bounds.upper]
        .into_iter()
        .filter(|b| b.is_finite());
    match finite.fold(0.0, |size: f64, bound| size.max(bound.abs())) {
        0.0 => 1.0,
        size => size,
    }
}
