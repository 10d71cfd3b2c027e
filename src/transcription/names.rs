//! What a person calls each variable and row of the programme.

use super::{Layout, Row};
use crate::collocation::Mesh;
use crate::ocp::Formulation;

/// Names made on demand from the formulation and the mesh.
#[derive(Debug, Clone)]
pub(super) struct Names {
    formulation: Formulation,
    starts: Vec<usize>,
}

impl Names {
    pub fn new(formulation: Formulation, mesh: &Mesh) -> Self {
        Self {
            formulation,
            starts: (0..mesh.segments()).map(|s| mesh.start(s)).collect(),
        }
    }

    fn place(&self, layout: &Layout, k: usize) -> String {
        if k == layout.points {
            return "final time".into();
        }
        let s = self.starts.partition_point(|&start| start <= k) - 1;
        format!("segment {}, point {}", s + 1, k - self.starts[s] + 1)
    }

    pub fn variable(&self, layout: &Layout, index: usize) -> String {
        if layout.border().contains(&index) {
            return self.in_border(layout, index);
        }
        if let Some(i) = (0..layout.knots.len()).find(|&i| layout.knot(i) == index) {
            return format!("breakpoint, {}", self.place(layout, layout.knots[i]));
        }
        let width = layout.states + layout.controls;
        let passed = (0..layout.knots.len()).filter(|&i| layout.knot(i) < index);
        let index = index - passed.count();
        let (k, i) = (index / width, index % width);
        let quantity = if i < layout.states {
            &self.formulation.states[i]
        } else {
            &self.formulation.controls[i - layout.states]
        };
        format!("{}, {}", quantity.name, self.place(layout, k))
    }

    fn in_border(&self, layout: &Layout, index: usize) -> String {
        let formulation = &self.formulation;
        if layout.free_duration && index == layout.duration() {
            "duration".into()
        } else if layout.free_initial_time && index == layout.initial_time() {
            "initial time".into()
        } else if index < layout.integral(0) {
            formulation.parameters[index - layout.parameter(0)]
                .name
                .clone()
        } else {
            formulation.integrals[index - layout.integral(0)]
                .name
                .clone()
        }
    }

    pub fn row(&self, layout: &Layout, index: usize) -> String {
        let formulation = &self.formulation;
        match layout.row(index) {
            Row::Defect { point, state } => format!(
                "defect of {}, {}",
                formulation.states[state].name,
                self.place(layout, point)
            ),
            Row::Path { point, row } => {
                let row = &formulation.path[row];
                format!("{}, {}", row.name, self.place(layout, point))
            }
            Row::WayPoint { way_point, row } => {
                formulation.way_points[way_point].rows[row].name.clone()
            }
            Row::Boundary(row) => formulation.boundary[row].name.clone(),
            Row::Integral(row) => format!("quadrature of {}", formulation.integrals[row].name),
            Row::FinalTime => "final time".into(),
            Row::Structural(row) => format!("structure of the mesh, row {}", row + 1),
        }
    }
}
