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

/// Prices of the limits of `problem`, along the path, at way-points and at t_f, the dearest first, by the
/// multipliers of `iterate` at its solution `plan`; none without multipliers, and none of a limit that
/// has no effect.
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
    let mut prices = Prices::default();
    of_states(system, &layout, iterate, &mut prices);
    of_controls(system, &layout, iterate, &mut prices);
    of_rows(system, &layout, iterate, &mut prices);
    prices.dearest_first()
}

/// What was found so far: one price a component of a limit, wherever it holds.
#[derive(Default)]
struct Prices(Vec<ShadowPrice>);

impl Prices {
    fn add(&mut self, row: &Row, multiplier: f64) {
        let price = moved(row).map(|moved| multiplier * moved);
        let Some(price) = price.filter(|&price| price > 0.0) else {
            return;
        };
        let known =
            (self.0.iter_mut()).find(|known| known.id == row.id && known.name == row.quantity.name);
        match known {
            Some(known) => known.price += price,
            None => self.0.push(ShadowPrice {
                id: row.id,
                name: row.quantity.name.clone(),
                price,
            }),
        }
    }

    fn dearest_first(mut self) -> Vec<ShadowPrice> {
        self.0.sort_by(|a, b| b.price.total_cmp(&a.price));
        self.0
    }
}

/// Bounds of the states, from the first point on: the start is no limit.
fn of_states<Sp: Space>(
    system: &FreeFloating<Sp>,
    layout: &Layout,
    iterate: &Iterate,
    prices: &mut Prices,
) {
    let bounded = &system.bounded;
    for k in 1..=layout.points {
        let way_point = layout.way_point_nodes().position(|node| node == k);
        for (i, row) in bounded.states.iter().enumerate() {
            let at_end = (k == layout.points).then(|| &bounded.terminal[i]);
            let passed = way_point.map(|w| &system.way_points[w].states[i]);
            // The one that holds is the tightest.
            let [mut low, mut high] = [row; 2];
            for other in at_end.into_iter().chain(passed) {
                let bounds = other.quantity.bounds;
                if bounds.lower >= low.quantity.bounds.lower {
                    low = other;
                }
                if bounds.upper <= high.quantity.bounds.upper {
                    high = other;
                }
            }
            let v = layout.state(k, i);
            prices.add(low, iterate.lower_multipliers[v]);
            prices.add(high, iterate.upper_multipliers[v]);
        }
    }
}

fn of_controls<Sp: Space>(
    system: &FreeFloating<Sp>,
    layout: &Layout,
    iterate: &Iterate,
    prices: &mut Prices,
) {
    for (j, row) in system.bounded.controls.iter().enumerate() {
        for k in 0..layout.points {
            let v = layout.control(k, j);
            prices.add(row, iterate.lower_multipliers[v]);
            prices.add(row, iterate.upper_multipliers[v]);
        }
    }
}

/// Rows along the path, of way-points and of the end.
fn of_rows<Sp: Space>(
    system: &FreeFloating<Sp>,
    layout: &Layout,
    iterate: &Iterate,
    prices: &mut Prices,
) {
    let bounded = &system.bounded;
    let multiplier = |row: usize| iterate.multipliers[row].abs();
    for (p, row) in bounded.path.iter().enumerate() {
        for k in 0..layout.points {
            prices.add(row, multiplier(layout.path(k, p)));
        }
    }
    for (w, point) in system.way_points.iter().enumerate() {
        for (r, row) in point.rows().iter().enumerate() {
            prices.add(row, multiplier(layout.way_point(w, r)));
        }
    }
    for (b, row) in bounded.boundary.iter().enumerate() {
        prices.add(row, multiplier(layout.boundary(b)));
    }
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
