//! Limits that give way at a price: finds which limits of a problem cannot hold.

use super::elastic_derivatives::ElasticDerivatives;
use super::{Ends, Formulation, Interval, Ocp, Passage, Point, PointDerivatives, Quantity};
use crate::autodiff::Scalar;

/// One bound that may give way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    Passed(usize, usize),
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
/// to be as small as possible: minimise Σ e_g + `regularization`·(the problem's own cost).
///
/// Each e_g is carried as a state that does not change, so that it couples neighbouring instants
/// only and the transcription needs no special case.
#[derive(Debug)]
pub struct Elastic<'a, O> {
    inner: &'a O,
    pub(super) groups: Vec<LimitGroup>,
    pub(super) regularization: f64,
    pub(super) base: Formulation,
    /// Path rows beyond the inner ones: (bound, group, interval).
    pub(super) path: Vec<(Limited, usize, Interval)>,
    boundary: Vec<(End, usize, Interval)>,
    /// The same of each way-point.
    way_points: Vec<Vec<(End, usize, Interval)>>,
}

/// What an elastic row of the ends or of a way-point bounds.
#[derive(Debug, Clone, Copy)]
enum End {
    State(usize),
    Row(usize),
}

impl<'a, O: Ocp> Elastic<'a, O> {
    /// `inner` with `groups` made elastic.
    pub fn new(inner: &'a O, groups: Vec<LimitGroup>, regularization: f64) -> Self {
        let mut base = inner.formulation();
        let mut path = Vec::new();
        let mut boundary = Vec::new();
        let mut way_points = vec![Vec::new(); base.way_points.len()];
        for (g, group) in groups.iter().enumerate() {
            for &member in &group.members {
                let freed = match member {
                    Limited::State(i) => {
                        // The path rows do not reach t_f, which is a node but no point.
                        let bounds = base.states[i].bounds;
                        if !base.terminal[i].is_fixed() {
                            boundary.push((End::State(i), g, bounds));
                        }
                        &mut base.states[i].bounds
                    }
                    Limited::Terminal(i) => {
                        boundary.push((End::State(i), g, base.terminal[i]));
                        base.terminal[i] = Interval::FREE;
                        continue;
                    }
                    Limited::Boundary(b) => {
                        let bounds =
                            std::mem::replace(&mut base.boundary[b].bounds, Interval::FREE);
                        boundary.push((End::Row(b), g, bounds));
                        continue;
                    }
                    Limited::Passed(w, i) => {
                        let at = &mut base.way_points[w].states[i];
                        let bounds = std::mem::replace(at, Interval::FREE);
                        way_points[w].push((End::State(i), g, bounds));
                        continue;
                    }
                    Limited::WayPoint(w, r) => {
                        let at = &mut base.way_points[w].rows[r].bounds;
                        let bounds = std::mem::replace(at, Interval::FREE);
                        way_points[w].push((End::Row(r), g, bounds));
                        continue;
                    }
                    Limited::Control(i) => &mut base.controls[i].bounds,
                    Limited::Path(i) => &mut base.path[i].bounds,
                };
                path.push((member, g, std::mem::replace(freed, Interval::FREE)));
            }
        }
        Self {
            inner,
            groups,
            regularization,
            base,
            path,
            boundary,
            way_points,
        }
    }

    /// The limits that give way.
    pub fn groups(&self) -> &[LimitGroup] {
        &self.groups
    }

    /// Where in the extended state the amounts e_g stand, in units of each group's scale.
    pub fn amounts(&self) -> std::ops::Range<usize> {
        let n = self.base.states.len();
        n..n + self.groups.len()
    }

    /// The two rows of one elastic bound: value − e·scale and value + e·scale.
    fn rows(&self, name: &str, group: usize, bounds: Interval) -> [Quantity; 2] {
        let limit = &self.groups[group].name;
        [
            Quantity::new(
                format!("{name} below {limit}"),
                Interval::new(f64::NEG_INFINITY, bounds.upper),
            ),
            Quantity::new(
                format!("{name} above {limit}"),
                Interval::new(bounds.lower, f64::INFINITY),
            ),
        ]
    }
}

impl<O: Ocp> Elastic<'_, O> {
    /// The two rows of each of `bounds`, from the states at that instant and the inner rows.
    fn bound_ends<S: Scalar>(
        &self,
        bounds: &[(End, usize, Interval)],
        x: &[S],
        amounts: &[S],
        inner_rows: &[S],
        elastic_rows: &mut [S],
    ) {
        for (rows, &(end, group, _)) in elastic_rows.chunks_exact_mut(2).zip(bounds) {
            let value = match end {
                End::State(i) => x[i],
                End::Row(row) => inner_rows[row],
            };
            let room = amounts[group] * self.groups[group].scale;
            rows[0] = value - room;
            rows[1] = value + room;
        }
    }
}

/// Scratch of [`Elastic`].
#[derive(Debug)]
pub struct ElasticScratch<S, I> {
    inner: I,
    path: Vec<S>,
}

impl<O: Ocp> Ocp for Elastic<'_, O> {
    type Scratch<S: Scalar> = ElasticScratch<S, O::Scratch<S>>;

    fn formulation(&self) -> Formulation {
        let mut formulation = self.base.clone();
        for &(member, group, bounds) in &self.path {
            let name = match member {
                Limited::State(i) | Limited::Terminal(i) => &self.base.states[i].name,
                Limited::Control(i) => &self.base.controls[i].name,
                Limited::Path(i) => &self.base.path[i].name,
                _ => unreachable!("bounds at one instant are not path rows"),
            };
            formulation.path.extend(self.rows(name, group, bounds));
        }
        for &(end, group, bounds) in &self.boundary {
            let name = match end {
                End::State(i) => &self.base.states[i].name,
                End::Row(b) => &self.base.boundary[b].name,
            };
            formulation.boundary.extend(self.rows(name, group, bounds));
        }
        for (w, elastic) in self.way_points.iter().enumerate() {
            for &(end, group, bounds) in elastic {
                let name = match end {
                    End::State(i) => &self.base.states[i].name,
                    End::Row(r) => &self.base.way_points[w].rows[r].name,
                };
                let rows = self.rows(name, group, bounds);
                formulation.way_points[w].rows.extend(rows);
            }
        }
        for point in &mut formulation.way_points {
            let amounts = self.groups.len();
            point
                .states
                .extend(std::iter::repeat_n(Interval::FREE, amounts));
        }
        for group in &self.groups {
            let amount = Interval::new(0.0, f64::INFINITY);
            formulation
                .states
                .push(Quantity::new(format!("excess of {}", group.name), amount));
            formulation.initial.push(Interval::FREE);
            formulation.terminal.push(Interval::FREE);
        }
        formulation
    }

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        ElasticScratch {
            inner: self.inner.scratch(),
            path: vec![S::zero(); self.base.path.len()],
        }
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let n = self.base.states.len();
        let (x, amounts) = point.x.split_at(n);
        let (rates, still) = rates.split_at_mut(n);
        let cost = self.inner.continuous(
            Point { x, ..point },
            &mut scratch.inner,
            rates,
            &mut scratch.path,
        );
        still.fill(S::zero());
        let own = scratch.path.len();
        path[..own].copy_from_slice(&scratch.path);
        for (rows, &(member, group, _)) in path[own..].chunks_exact_mut(2).zip(&self.path) {
            let value = match member {
                Limited::State(i) | Limited::Terminal(i) => x[i],
                Limited::Control(i) => point.u[i],
                Limited::Path(i) => scratch.path[i],
                _ => unreachable!("bounds at one instant are not path rows"),
            };
            let room = amounts[group] * self.groups[group].scale;
            rows[0] = value - room;
            rows[1] = value + room;
        }
        cost * self.regularization
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        let n = self.base.states.len();
        let (x, amounts) = ends.terminal.split_at(n);
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.boundary.len());
        let inner_ends = Ends {
            initial: &ends.initial[..n],
            terminal: x,
            duration: ends.duration,
        };
        let mut cost = self
            .inner
            .boundary(inner_ends, &mut scratch.inner, inner_rows)
            * self.regularization;
        self.bound_ends(&self.boundary, x, amounts, inner_rows, elastic_rows);
        for &amount in amounts {
            cost += amount;
        }
        cost
    }

    fn way_point<S: Scalar>(
        &self,
        passage: Passage<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        let w = passage.way_point;
        let (x, amounts) = passage.x.split_at(self.base.states.len());
        let (inner_rows, elastic_rows) = rows.split_at_mut(self.base.way_points[w].rows.len());
        let inner = Passage { x, ..passage };
        self.inner.way_point(inner, &mut scratch.inner, inner_rows);
        self.bound_ends(&self.way_points[w], x, amounts, inner_rows, elastic_rows);
    }

    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        let inner = self.inner.derivatives()?;
        Some(Box::new(ElasticDerivatives::new(self, inner)))
    }

    fn has_branches(&self) -> bool {
        self.inner.has_branches()
    }
}
