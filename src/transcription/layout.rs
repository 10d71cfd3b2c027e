//! Where every state, control and constraint row stands in the programme.

use crate::collocation::Mesh;
use crate::ocp::Formulation;
use std::sync::Arc;

/// Order of variables and rows: in time, so that the programme's matrices are banded.
///
/// Variables: states then controls of each collocation point, the states at t_f, and the duration
/// where it is free. Rows: those of the way-point that stands at a collocation point, the point's
/// defects, its path rows, and so on from point to point; then boundary rows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layout {
    /// Number of states.
    pub states: usize,
    /// Number of controls.
    pub controls: usize,
    /// Number of path rows a point.
    pub path: usize,
    /// Number of boundary rows.
    pub boundary: usize,
    /// Number of collocation points M.
    pub points: usize,
    /// Whether the duration is a variable.
    pub free_duration: bool,
    /// Way-points, rising in time.
    pub(crate) way_points: Arc<[WayPointRows]>,
}

/// Where a way-point and its rows stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct WayPointRows {
    node: usize,
    rows: usize,
    /// Rows of the way-points before it.
    before: usize,
}

/// What a constraint row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Row {
    /// Defect of a state at a point.
    Defect {
        /// Collocation point.
        point: usize,
        /// State.
        state: usize,
    },
    /// A path row at a point.
    Path {
        /// Collocation point.
        point: usize,
        /// Path row.
        row: usize,
    },
    /// A row of a way-point.
    WayPoint {
        /// Way-point.
        way_point: usize,
        /// Its row.
        row: usize,
    },
    /// A boundary row.
    Boundary(usize),
}

impl Layout {
    /// Layout of `formulation` on `mesh`, which has a breakpoint at each of its way-points.
    ///
    /// # Panics
    /// Where a breakpoint is missing.
    pub fn new(formulation: &Formulation, mesh: &Mesh) -> Self {
        let mut before = 0;
        let rows_of = |point: &crate::ocp::WayPoint| {
            let node = mesh.node_at(point.fraction);
            let rows = point.rows.len();
            before += rows;
            WayPointRows {
                node: node.expect("a breakpoint at every way-point"),
                rows,
                before: before - rows,
            }
        };
        Self {
            states: formulation.states.len(),
            controls: formulation.controls.len(),
            path: formulation.path.len(),
            boundary: formulation.boundary.len(),
            points: mesh.points(),
            free_duration: !formulation.duration.is_fixed(),
            way_points: formulation.way_points.iter().map(rows_of).collect(),
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.points * (self.states + self.controls) + self.states + usize::from(self.free_duration)
    }

    /// Number of constraint rows.
    pub fn rows(&self) -> usize {
        self.boundary(self.boundary)
    }

    /// State `i` at node `k`; node `points` is t_f.
    pub fn state(&self, k: usize, i: usize) -> usize {
        k * (self.states + self.controls) + i
    }

    /// Control `j` at point `k`.
    pub fn control(&self, k: usize, j: usize) -> usize {
        self.state(k, self.states + j)
    }

    /// The duration; only where it is free.
    pub fn duration(&self) -> usize {
        self.state(self.points, self.states)
    }

    /// Defect of state `i` at point `k`.
    pub fn defect(&self, k: usize, i: usize) -> usize {
        let passed = self.way_points.iter().rev().find(|p| p.node <= k);
        let shift = passed.map_or(0, |p| p.before + p.rows);
        k * (self.states + self.path) + shift + i
    }

    /// Path row `p` at point `k`.
    pub fn path(&self, k: usize, p: usize) -> usize {
        self.defect(k, self.states + p)
    }

    /// Row `r` of way-point `w`.
    pub fn way_point(&self, w: usize, r: usize) -> usize {
        let WayPointRows { node, before, .. } = self.way_points[w];
        node * (self.states + self.path) + before + r
    }

    /// Nodes of the way-points, rising.
    pub fn way_point_nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.way_points.iter().map(|p| p.node)
    }

    /// Boundary row `b`.
    pub fn boundary(&self, b: usize) -> usize {
        let shift = self.way_points.last().map_or(0, |p| p.before + p.rows);
        self.points * (self.states + self.path) + shift + b
    }

    /// What row `index` is.
    pub fn row(&self, index: usize) -> Row {
        if index >= self.boundary(0) {
            return Row::Boundary(index - self.boundary(0));
        }
        let mut shift = 0;
        for (way_point, rows) in self.way_points.iter().enumerate() {
            let first = self.way_point(way_point, 0);
            if index < first {
                break;
            }
            if index < first + rows.rows {
                let row = index - first;
                return Row::WayPoint { way_point, row };
            }
            shift = rows.before + rows.rows;
        }
        let width = self.states + self.path;
        let (point, i) = ((index - shift) / width, (index - shift) % width);
        match i.checked_sub(self.states) {
            None => Row::Defect { point, state: i },
            Some(row) => Row::Path { point, row },
        }
    }
}
