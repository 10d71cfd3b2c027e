//! Which bounds of a problem give way, and the problem without them.

use crate::ocp::{Formulation, Interval, Ocp, Quantity};

/// One bound that may give way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limited {
    /// The bounds of a state along the path.
    State(usize),
    /// The bounds of a state at t_f.
    Terminal(usize),
    /// The bounds of a control.
    Control(usize),
    /// The bounds of a path row.
    Path(usize),
    /// The bounds of a boundary row.
    Boundary(usize),
    /// The bounds of a state at a way-point: which way-point, which state.
    WayPointState(usize, usize),
    /// The bounds of a row of a way-point: which way-point, which row.
    WayPoint(usize, usize),
}

/// Bounds that belong to one limit of the problem and give way together.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitGroup {
    /// What a person calls the limit.
    pub name: String,
    /// Its bounds.
    pub members: Vec<Limited>,
    /// How much giving way counts as one: typically the size of the bound.
    pub scale: f64,
}

/// A problem whose chosen limits may be exceeded, each by an amount e_g ≥ 0 of its own that is
/// to be as small as possible: minimise Σ e_g + `regularization`·(the problem's own cost), plus
/// a weight times ∫‖u‖² where asked.
///
/// Each e_g is a static parameter.
#[derive(Debug)]
pub struct Elastic<'a, O> {
    pub(super) inner: &'a O,
    pub(super) groups: Vec<LimitGroup>,
    pub(super) regularization: f64,
    pub(super) control_weight: f64,
    pub(super) base: Formulation,
    /// Elastic bounds along the path: path rows beyond the inner ones.
    pub(super) path: Vec<ElasticBound<OnPath>>,
    /// Those at t_f: boundary rows beyond the inner ones.
    pub(super) boundary: Vec<ElasticBound<AtInstant>>,
    /// Those of each way-point: rows of it beyond the inner ones.
    pub(super) way_points: Vec<Vec<ElasticBound<AtInstant>>>,
}

/// A bound that has become two rows, value − e·scale and value + e·scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElasticBound<Q> {
    /// The bounded quantity.
    pub quantity: Q,
    /// The group whose amount e it takes.
    pub group: usize,
    pub bounds: Interval,
}

/// A quantity bounded along the path.
#[derive(Debug, Clone, Copy)]
pub(super) enum OnPath {
    State(usize),
    Control(usize),
    Row(usize),
}

/// A quantity bounded at t_f or at a way-point.
#[derive(Debug, Clone, Copy)]
pub(super) enum AtInstant {
    State(usize),
    Row(usize),
}

impl OnPath {
    /// Its value at a point: states, controls and path rows there.
    pub fn value<S: Copy>(self, x: &[S], u: &[S], path: &[S]) -> S {
        match self {
            Self::State(i) => x[i],
            Self::Control(i) => u[i],
            Self::Row(i) => path[i],
        }
    }
}

impl AtInstant {
    /// Its value at that instant: states and rows there.
    pub fn value<S: Copy>(self, x: &[S], rows: &[S]) -> S {
        match self {
            Self::State(i) => x[i],
            Self::Row(i) => rows[i],
        }
    }
}

impl<Q> ElasticBound<Q> {
    /// Takes the bounds out of `from`, which is free from then on.
    fn take(quantity: Q, group: usize, from: &mut Interval) -> Self {
        Self {
            quantity,
            group,
            bounds: std::mem::replace(from, Interval::FREE),
        }
    }
}

/// Bounds below this, in their unit, are next to nothing.
const TINY: f64 = 1e-3;
/// What counts as one in a quantity whose bound was next to nothing.
const GIVEN_WAY: f64 = 1e-2;

impl<'a, O: Ocp> Elastic<'a, O> {
    /// `inner` with `groups` made elastic.
    pub fn new(inner: &'a O, groups: Vec<LimitGroup>, regularization: f64) -> Self {
        let mut base = inner.formulation();
        let mut path = Vec::new();
        let mut boundary = Vec::new();
        let mut way_points = vec![Vec::new(); base.way_points.len()];
        for (group, limit) in groups.iter().enumerate() {
            for &member in &limit.members {
                match member {
                    Limited::State(i) => {
                        let quantity = AtInstant::State(i);
                        let from = &mut base.states[i].bounds;
                        // The path rows do not reach t_f, which is a node but no point.
                        if !base.terminal[i].is_fixed() {
                            let bounds = *from;
                            boundary.push(ElasticBound {
                                quantity,
                                group,
                                bounds,
                            });
                        }
                        path.push(ElasticBound::take(OnPath::State(i), group, from));
                    }
                    Limited::Control(i) => {
                        let from = &mut base.controls[i].bounds;
                        path.push(ElasticBound::take(OnPath::Control(i), group, from));
                    }
                    Limited::Path(i) => {
                        let from = &mut base.path[i].bounds;
                        path.push(ElasticBound::take(OnPath::Row(i), group, from));
                    }
                    Limited::Terminal(i) => {
                        let from = &mut base.terminal[i];
                        boundary.push(ElasticBound::take(AtInstant::State(i), group, from));
                    }
                    Limited::Boundary(b) => {
                        let from = &mut base.boundary[b].bounds;
                        boundary.push(ElasticBound::take(AtInstant::Row(b), group, from));
                    }
                    Limited::WayPointState(w, i) => {
                        let from = &mut base.way_points[w].states[i];
                        way_points[w].push(ElasticBound::take(AtInstant::State(i), group, from));
                    }
                    Limited::WayPoint(w, r) => {
                        let from = &mut base.way_points[w].rows[r].bounds;
                        way_points[w].push(ElasticBound::take(AtInstant::Row(r), group, from));
                    }
                }
            }
        }
        Self {
            inner,
            groups,
            regularization,
            control_weight: 0.0,
            base,
            path,
            boundary,
            way_points,
        }
    }

    /// The same with `weight`·∫‖u‖² in its cost. It keeps motions smooth, which on a coarse mesh
    /// might otherwise find an excess that is none between the points.
    pub fn with_control_weight(self, weight: f64) -> Self {
        Self {
            control_weight: weight,
            ..self
        }
    }

    /// The same with its limits tighter by `amount` of each group's scale, so that the least amounts are
    /// asked for below the limits as well: `amount` is within them.
    pub fn tightened(mut self, amount: f64) -> Self {
        let by = |group: usize| amount * self.groups[group].scale;
        for bound in &mut self.path {
            bound.bounds = narrowed(bound.bounds, by(bound.group));
        }
        let at_instants = self.way_points.iter_mut().flatten();
        for bound in at_instants.chain(&mut self.boundary) {
            bound.bounds = narrowed(bound.bounds, by(bound.group));
        }
        self
    }

    /// The limits that give way.
    pub fn groups(&self) -> &[LimitGroup] {
        &self.groups
    }

    /// Where among the static parameters the amounts e_g stand, in units of each group's scale.
    pub fn amounts(&self) -> std::ops::Range<usize> {
        let first = self.base.parameters.len();
        first..first + self.groups.len()
    }

    /// The two rows of one elastic bound: value − e·scale and value + e·scale.
    pub(super) fn rows(&self, of: &Quantity, group: usize, bounds: Interval) -> [Quantity; 2] {
        let (name, limit) = (&of.name, &self.groups[group].name);
        let largest = [bounds.lower, bounds.upper]
            .map(f64::abs)
            .into_iter()
            .filter(|bound| bound.is_finite())
            .fold(0.0, f64::max);
        // What is left of a bound next to nothing once it has given way is of another size.
        let size = (0.0 < largest && largest < TINY).then_some(GIVEN_WAY);
        let row = |side: &str, bounds| Quantity {
            scale: of.scale,
            size,
            ..Quantity::new(format!("{name} {side} {limit}"), bounds)
        };
        [
            row("below", Interval::new(f64::NEG_INFINITY, bounds.upper)),
            row("above", Interval::new(bounds.lower, f64::INFINITY)),
        ]
    }
}

/// `bounds` moved inwards, no further than to their middle.
fn narrowed(bounds: Interval, by: f64) -> Interval {
    let by = by.min(0.5 * (bounds.upper - bounds.lower));
    Interval::new(bounds.lower + by, bounds.upper - by)
}
