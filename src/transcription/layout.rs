//! Where every state, control and constraint row stands in the programme.

use crate::collocation::Mesh;
use crate::ocp::Formulation;

/// Order of variables and rows: in time, so that the programme's matrices are banded.
///
/// Variables: states then controls of each collocation point, the states at t_f, and the duration
/// where it is free. Rows: defects then path rows of each point, then boundary rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
}

impl Layout {
    /// Layout of `formulation` on `mesh`.
    pub fn new(formulation: &Formulation, mesh: &Mesh) -> Self {
        Self {
            states: formulation.states.len(),
            controls: formulation.controls.len(),
            path: formulation.path.len(),
            boundary: formulation.boundary.len(),
            points: mesh.points(),
            free_duration: !formulation.duration.is_fixed(),
        }
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.points * (self.states + self.controls) + self.states + usize::from(self.free_duration)
    }

    /// Number of constraint rows.
    pub fn rows(&self) -> usize {
        self.points * (self.states + self.path) + self.boundary
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
        k * (self.states + self.path) + i
    }

    /// Path row `p` at point `k`.
    pub fn path(&self, k: usize, p: usize) -> usize {
        self.defect(k, self.states + p)
    }

    /// Boundary row `b`.
    pub fn boundary(&self, b: usize) -> usize {
        self.points * (self.states + self.path) + b
    }
}
