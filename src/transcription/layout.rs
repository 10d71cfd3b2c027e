//! Where every state, control and constraint row stands in the programme.

use super::Structure;
use crate::collocation::Mesh;
use crate::nlp::Iterate;
use crate::ocp::Formulation;
use std::sync::Arc;

/// Order of variables and rows: in time, so that the programme's matrices are banded.
///
/// Variables: states then controls of each collocation point, a free breakpoint before the states at
/// its node, the states at t_f, and the border, which couples all points: the duration and t₀ where they are free, static parameters, integrals.
/// Rows: those of the way-point that stands at a collocation point, the point's defects, its path
/// rows, and so on from point to point; then boundary rows, one row for each integral, that of the
/// final time, and those that the structure adds.
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
    /// Whether t₀ is a variable.
    pub free_initial_time: bool,
    /// Whether t_f has a row of its own.
    pub bounded_final_time: bool,
    /// Number of static parameters.
    pub parameters: usize,
    /// Number of integrals.
    pub integrals: usize,
    /// Way-points, rising in time.
    pub(crate) way_points: Arc<[WayPointRows]>,
    /// Nodes of the free breakpoints, rising.
    pub(crate) knots: Arc<[usize]>,
    /// Number of rows that the structure adds.
    pub(crate) structural: usize,
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
    /// An integral less its quadrature.
    Integral(usize),
    /// t₀ + T.
    FinalTime,
    /// A row that the structure adds.
    Structural(usize),
}

impl Layout {
    /// Layout of `formulation` on `mesh`, which has a breakpoint at each of its way-points.
    ///
    /// # Panics
    /// Where a breakpoint is missing.
    pub fn new(formulation: &Formulation, mesh: &Mesh) -> Self {
        Self::structured(formulation, mesh, &Structure::default())
    }

    /// The same with the free breakpoints and the rows of `structure`.
    ///
    /// # Panics
    /// Where a breakpoint is missing.
    pub fn structured(formulation: &Formulation, mesh: &Mesh, structure: &Structure) -> Self {
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
            free_initial_time: !formulation.initial_time.is_fixed(),
            bounded_final_time: formulation.has_free_time() && !formulation.final_time.is_free(),
            parameters: formulation.parameters.len(),
            integrals: formulation.integrals.len(),
            way_points: formulation.way_points.iter().map(rows_of).collect(),
            knots: (structure.knots.iter())
                .map(|knot| mesh.start(knot.breakpoint))
                .collect(),
            structural: structure.row_count(),
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.integral(self.integrals)
    }

    /// Number of constraint rows.
    pub fn rows(&self) -> usize {
        self.structural_row(self.structural)
    }

    /// State `i` at node `k`; node `points` is t_f.
    pub fn state(&self, k: usize, i: usize) -> usize {
        let passed = self.knots.iter().take_while(|&&node| node <= k).count();
        k * (self.states + self.controls) + passed + i
    }

    /// Control `j` at point `k`.
    pub fn control(&self, k: usize, j: usize) -> usize {
        self.state(k, self.states + j)
    }

    /// Free breakpoint `i`.
    pub fn knot(&self, i: usize) -> usize {
        self.state(self.knots[i], 0) - 1
    }

    /// The duration; only where it is free.
    pub fn duration(&self) -> usize {
        self.state(self.points, self.states)
    }

    /// t₀; only where it is free.
    pub fn initial_time(&self) -> usize {
        self.duration() + usize::from(self.free_duration)
    }

    /// Static parameter `i`.
    pub fn parameter(&self, i: usize) -> usize {
        self.initial_time() + usize::from(self.free_initial_time) + i
    }

    /// Integral `i`.
    pub fn integral(&self, i: usize) -> usize {
        self.parameter(self.parameters + i)
    }

    /// The variables that couple all points.
    pub fn border(&self) -> std::ops::Range<usize> {
        self.duration()..self.variables()
    }

    /// The variable behind input `input` of point `k`, which is not the time.
    pub(super) fn input(&self, k: usize, input: usize) -> usize {
        match input.checked_sub(self.states + self.controls) {
            None => self.state(k, input),
            Some(parameter) => self.parameter(parameter),
        }
    }

    /// Whether no function but those of point `k` depends on its input `input`.
    pub(super) fn is_own(&self, k: usize, input: usize) -> bool {
        let at_end = k == 0 || self.way_points.iter().any(|point| point.node == k);
        input < self.states + self.controls && !at_end
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

    /// Row of integral `i`.
    pub fn integral_row(&self, i: usize) -> usize {
        self.boundary(self.boundary) + i
    }

    /// Row of t_f; only where it is bounded.
    pub fn final_time_row(&self) -> usize {
        self.integral_row(self.integrals)
    }

    /// Row `i` of those that the structure adds.
    pub fn structural_row(&self, i: usize) -> usize {
        self.final_time_row() + usize::from(self.bounded_final_time) + i
    }

    /// The layout without what a structure adds.
    pub fn plain(&self) -> Self {
        Self {
            knots: Arc::new([]),
            structural: 0,
            ..self.clone()
        }
    }

    /// `iterate` of this layout, without what a structure adds.
    pub fn without_structure(&self, iterate: &Iterate) -> Iterate {
        let knots: Vec<usize> = (0..self.knots.len()).map(|i| self.knot(i)).collect();
        let kept = |values: &[f64]| {
            let values = values.iter().enumerate();
            let values = values.filter(|(v, _)| knots.binary_search(v).is_err());
            values.map(|(_, &value)| value).collect()
        };
        let mut multipliers = iterate.multipliers.clone();
        multipliers.truncate(self.structural_row(0));
        Iterate {
            x: kept(&iterate.x),
            lower_multipliers: kept(&iterate.lower_multipliers),
            upper_multipliers: kept(&iterate.upper_multipliers),
            multipliers,
        }
    }

    /// What row `index` is.
    pub fn row(&self, index: usize) -> Row {
        if index >= self.structural_row(0) {
            return Row::Structural(index - self.structural_row(0));
        }
        if index >= self.final_time_row() {
            return Row::FinalTime;
        } else if index >= self.integral_row(0) {
            return Row::Integral(index - self.integral_row(0));
        } else if index >= self.boundary(0) {
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
