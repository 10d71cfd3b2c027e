//! What each limit costs: how much J would fall were it wider.
//!
//! To first order the optimal J falls by Σ λ·δ where bounds with multipliers λ move outwards by δ:
//! Nocedal & Wright, *Numerical Optimization*, 2nd ed., section 12.8 (DOI 10.1007/978-0-387-40065-5).

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::rows::{BoundId, Measure, Row};
use crate::dynamics::space::Space;
use crate::nlp::Iterate;
use crate::ocp::{Interval, Ocp};
use crate::problem::{LimitId, Problem};
use crate::transcription::{Discretization, Layout};

/// The price of one component of a limit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ShadowPrice {
    /// Which limit, and which component of it.
    pub id: BoundId,
    /// What it bounds: "control of joint elbow".
    pub name: String,
    /// −∂J/∂ε at ε = 0 where its bounds are wider by the part ε of the half of their range, or of
    /// their size where there is one bound; in the unit of J.
    pub price: f64,
}

/// Prices of the limits along the path of `problem`, the dearest first, by the multipliers of `iterate`
/// at its solution `plan`; none without multipliers, and none of a limit that has no effect.
pub fn shadow_prices(
    problem: &Problem,
    plan: &Discretization,
    iterate: &Iterate,
) -> Vec<ShadowPrice> {
    with_system!(&System::new(problem), system => prices(system, plan, iterate))
}

fn prices<Sp: Space>(
    system: &FreeFloating<Sp>,
    plan: &Discretization,
    iterate: &Iterate,
) -> Vec<ShadowPrice> {
    let layout = Layout::new(&system.formulation(), &plan.mesh);
    if !iterate.has_multipliers(layout.rows()) || iterate.x.len() != layout.variables() {
        return Vec::new();
    }
    let last = layout.points;
    // At both ends other bounds hold.
    let state = |i: usize| {
        (1..last)
            .map(|k| of_bounds(iterate, layout.state(k, i)))
            .sum()
    };
    let control = |j: usize| {
        (0..last)
            .map(|k| of_bounds(iterate, layout.control(k, j)))
            .sum()
    };
    let path = |p: usize| {
        (0..last)
            .map(|k| iterate.multipliers[layout.path(k, p)].abs())
            .sum()
    };
    let bounded = &system.bounded;
    let states = bounded
        .states
        .iter()
        .enumerate()
        .map(|(i, row)| (row, state(i)));
    let controls = bounded
        .controls
        .iter()
        .enumerate()
        .map(|(j, row)| (row, control(j)));
    let rows = bounded
        .path
        .iter()
        .enumerate()
        .map(|(p, row)| (row, path(p)));
    let mut found: Vec<ShadowPrice> = states
        .chain(controls)
        .chain(rows)
        .filter_map(|(row, multipliers): (&Row, f64)| {
            let price = multipliers * moved(row)?;
            (price > 0.0).then(|| ShadowPrice {
                id: row.id,
                name: row.quantity.name.clone(),
                price,
            })
        })
        .collect();
    found.sort_by(|a, b| b.price.total_cmp(&a.price));
    found
}

/// The sum of both bounds' multipliers of variable `v`.
fn of_bounds(iterate: &Iterate, v: usize) -> f64 {
    iterate.lower_multipliers[v] + iterate.upper_multipliers[v]
}

/// By how much the programme's bounds of `row` move outwards a unit of ε; `None` where wider means
/// nothing.
fn moved(row: &Row) -> Option<f64> {
    if matches!(row.id.limit, LimitId::KeepOut | LimitId::Peak(_)) {
        return None;
    }
    let Interval { lower, upper } = row.quantity.bounds;
    let size = match (lower.is_finite(), upper.is_finite()) {
        (true, true) => 0.5 * (upper - lower),
        (true, false) => lower.abs(),
        (false, true) => upper.abs(),
        (false, false) => return None,
    };
    match row.measure {
        Measure::Itself => Some(size),
        // (q/b)² ≤ 1 becomes (q/b)² ≤ (1 + ε)².
        Measure::SquaredRatio { .. } => Some(2.0 * upper),
        Measure::SquaredRatioToParameter { .. } => None,
    }
}
