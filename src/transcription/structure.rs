//! What a mesh knows of where a solution switches.

use crate::collocation::Mesh;
use crate::ocp::Interval;

/// Part of the narrower window beside it that a segment between two free breakpoints keeps.
const LEAST_WIDTH: f64 = 0.01;

/// What is known of a solution's arcs on a mesh: breakpoints that the solve places, controls that
/// lie on a bound, and ends of segments that the control must not bend towards.
///
/// Derived in docs/algorithms.md#free-breakpoints.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Structure {
    /// Breakpoints that are variables, rising.
    pub knots: Vec<Knot>,
    /// Controls that have one value in a whole segment.
    pub fixed: Vec<FixedControl>,
    /// Path rows that have one value in a whole segment.
    pub rows: Vec<FixedRow>,
    /// States without their term of highest degree in a segment.
    pub smooth: Vec<SmoothState>,
}

/// A breakpoint that the solve places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Which breakpoint of the mesh; neither the first nor the last, nor that of a way-point.
    pub breakpoint: usize,
    /// Where it may be, fractions of the duration.
    pub window: Interval,
}

/// A control of one value in a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedControl {
    /// Segment.
    pub segment: usize,
    /// Control.
    pub control: usize,
    /// Its value.
    pub value: f64,
}

/// A path row of one value in a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedRow {
    /// Segment.
    pub segment: usize,
    /// Path row.
    pub row: usize,
    /// Its value.
    pub value: f64,
}

/// A state whose polynomial in a segment of N points has degree N − 1: its value at the end is
/// what its values at the points extrapolate to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SmoothState {
    /// Segment.
    pub segment: usize,
    /// State.
    pub state: usize,
}

impl Knot {
    /// What counts as one in its place: a power of two near the width of its window.
    pub fn unit(&self) -> f64 {
        let width = self.window.upper - self.window.lower;
        width.max(1e-12).log2().round().exp2()
    }
}

/// A row that structure adds: bounds on a weighted sum of variables.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LinearRow {
    /// (variable, weight).
    pub terms: Vec<(usize, f64)>,
    pub bounds: Interval,
}

impl Structure {
    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.knots.is_empty()
            && self.fixed.is_empty()
            && self.rows.is_empty()
            && self.smooth.is_empty()
    }

    /// Pairs of knots, by their places in the list, with one segment between them.
    pub(super) fn neighbours(&self) -> impl Iterator<Item = usize> + '_ {
        let beside = |&i: &usize| self.knots[i].breakpoint + 1 == self.knots[i + 1].breakpoint;
        (0..self.knots.len().saturating_sub(1)).filter(beside)
    }

    /// Number of rows that it adds.
    pub(super) fn row_count(&self) -> usize {
        self.smooth.len() + self.neighbours().count()
    }

    /// The rows that it adds on `mesh`, with `state(node, state)` and `knot(i)` as variables.
    pub(super) fn linear_rows(
        &self,
        mesh: &Mesh,
        state: impl Fn(usize, usize) -> usize,
        knot: impl Fn(usize) -> usize,
    ) -> Vec<LinearRow> {
        let smooth = self.smooth.iter().map(|smooth| {
            let (s, i) = (smooth.segment, smooth.state);
            let start = mesh.start(s);
            let end = mesh.rule(s).control().basis(1.0);
            let inner = end.iter().enumerate();
            let mut terms: Vec<_> = inner.map(|(j, l)| (state(start + j, i), -l)).collect();
            terms.push((state(mesh.start(s + 1), i), 1.0));
            LinearRow {
                terms,
                bounds: Interval::fixed(0.0),
            }
        });
        let order = self.neighbours().map(|i| {
            let width = |knot: &Knot| knot.window.upper - knot.window.lower;
            let least = LEAST_WIDTH * width(&self.knots[i]).min(width(&self.knots[i + 1]));
            LinearRow {
                terms: vec![(knot(i), -1.0), (knot(i + 1), 1.0)],
                bounds: Interval::new(least, f64::INFINITY),
            }
        });
        smooth.chain(order).collect()
    }
}
