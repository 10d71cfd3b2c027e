//! How far a trajectory leaves its bounds between the nodes, where nothing holds it.
//!
//! Derived in docs/algorithms.md#bounds-between-the-nodes.

use crate::ocp::{DynOcp, Formulation, Quantity};
use crate::transcription::Discretization;

/// What is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bounded {
    /// A state along the path.
    State(usize),
    /// A control along the path.
    Control(usize),
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
    /// For how long in this segment it is outside by more than a tenth of that size, s.
    pub lasts: f64,
    /// Whether it is a control, or depends on one, so that it may jump.
    pub jumps: bool,
}

/// Part of a quantity's size above which the time outside is counted.
pub(super) const OVERSHOOT: f64 = 0.1;

/// Places looked at between two neighbouring nodes.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// The farthest that each bounded state, control and path row is outside in each segment,
/// segments × those that are outside at all.
///
/// The nodes themselves are left out, the programme holds the bounds there; t_f, which is no
/// collocation point, is looked at as well.
///
/// `jumps` says which of them depend on a control.
pub(super) fn violations(
    ocp: &dyn DynOcp,
    trajectory: &Discretization,
    jumps: impl Fn(Bounded) -> bool,
) -> Vec<Vec<Violation>> {
    let formulation = ocp.formulation();
    let (n, m) = formulation.widths();
    let quantities = bounded(&formulation);
    let mesh = &trajectory.mesh;
    if quantities.is_empty() {
        return vec![Vec::new(); mesh.segments()];
    }
    let path_rows = quantities
        .iter()
        .any(|(what, _)| matches!(what, Bounded::Path(_)));
    let mut functions = ocp.functions();
    let (mut x, mut rates, mut u) = (vec![0.0; n], vec![0.0; n], vec![0.0; m]);
    let mut path = vec![0.0; formulation.path.len()];
    (0..mesh.segments())
        .map(|segment| {
            let mut worst: Vec<Option<Violation>> = vec![None; quantities.len()];
            let half = 0.5 * mesh.width(segment) * trajectory.duration;
            let nodes = mesh.rule(segment).nodes();
            for (tau, stands_for) in places(nodes, segment + 1 == mesh.segments()) {
                trajectory.state_in(segment, tau, &mut x);
                trajectory.control_in(segment, tau, &mut u);
                let t = trajectory.time(mesh.fraction(segment, tau));
                if path_rows {
                    let point = trajectory.point(&x, &u, t);
                    functions.continuous(point, &mut rates, &mut path);
                }
                for (worst, &(what, quantity)) in worst.iter_mut().zip(&quantities) {
                    let value = match what {
                        Bounded::State(i) => x[i],
                        Bounded::Control(j) => u[j],
                        Bounded::Path(p) => path[p],
                    };
                    let excess = quantity.bounds.violation(value);
                    if excess <= 0.0 {
                        continue;
                    }
                    let relative = excess / size(quantity);
                    let here = Violation {
                        what,
                        segment,
                        tau,
                        t,
                        value,
                        excess,
                        relative,
                        lasts: f64::from(relative > OVERSHOOT) * stands_for * half,
                        jumps: jumps(what),
                    };
                    *worst = Some(worst.map_or(here, |worst| worst.and(here)));
                }
            }
            worst.into_iter().flatten().collect()
        })
        .collect()
}

impl Violation {
    /// The farther of the two, with the time of both.
    fn and(self, other: Self) -> Self {
        let lasts = self.lasts + other.lasts;
        let farther = if other.excess > self.excess {
            other
        } else {
            self
        };
        Self { lasts, ..farther }
    }
}

/// States, controls and path rows that have a bound.
fn bounded(formulation: &Formulation) -> Vec<(Bounded, &Quantity)> {
    let states = formulation.states.iter().enumerate();
    let controls = formulation.controls.iter().enumerate();
    let path = formulation.path.iter().enumerate();
    states
        .map(|(i, state)| (Bounded::State(i), state))
        .chain(controls.map(|(j, control)| (Bounded::Control(j), control)))
        .chain(path.map(|(p, row)| (Bounded::Path(p), row)))
        .filter(|(_, quantity)| !quantity.bounds.is_free())
        .collect()
}

/// The worst violation of every bound that is exceeded by more than `tolerance` of its size, with
/// the time of all segments.
pub(super) fn worst_of_each(by_segment: &[Vec<Violation>], tolerance: f64) -> Vec<Violation> {
    let mut found: Vec<Violation> = Vec::new();
    for violation in by_segment.iter().flatten() {
        if violation.relative <= tolerance {
            continue;
        }
        match found.iter_mut().find(|known| known.what == violation.what) {
            Some(known) => *known = known.and(*violation),
            None => found.push(*violation),
        }
    }
    found
}

/// τ of each place, and the width in τ it stands for.
fn places(nodes: &[f64], last: bool) -> Vec<(f64, f64)> {
    let between = |pair: &[f64]| {
        let gap = pair[1] - pair[0];
        BETWEEN.map(|share| (pair[0] + share * gap, gap / BETWEEN.len() as f64))
    };
    let mut places: Vec<(f64, f64)> = nodes.windows(2).flat_map(between).collect();
    if last {
        places.push((1.0, 0.0));
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
