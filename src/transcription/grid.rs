//! Widths and quadrature weights at an iterate, whose breakpoints may be variables.

use super::{Layout, Structure};
use crate::collocation::Mesh;

/// What follows from the breakpoints, point by point.
#[derive(Debug)]
pub(super) struct Grid {
    mesh: Mesh,
    /// (breakpoint, variable) of the free ones.
    knots: Vec<(usize, usize)>,
    breakpoints: Vec<f64>,
    /// Segment of each point.
    segments: Vec<usize>,
    /// Weight of the rule of each point.
    pub weights: Vec<f64>,
    /// width/2 of the segment of each point, fraction of the duration.
    pub half_width: Vec<f64>,
    /// Quadrature weight of each point, fraction of the duration; sum 1.
    pub quadrature: Vec<f64>,
}

impl Grid {
    pub fn new(layout: &Layout, mesh: &Mesh, structure: &Structure) -> Self {
        let knots = structure.knots.iter().enumerate();
        let of_segment = |s: usize| std::iter::repeat_n(s, mesh.rule(s).len());
        let weights = (0..mesh.segments()).flat_map(|s| mesh.rule(s).weights());
        let mut grid = Self {
            knots: knots.map(|(i, k)| (k.breakpoint, layout.knot(i))).collect(),
            breakpoints: mesh.breakpoints().to_vec(),
            segments: (0..mesh.segments()).flat_map(of_segment).collect(),
            weights: weights.copied().collect(),
            half_width: vec![0.0; mesh.points()],
            quadrature: vec![0.0; mesh.points()],
            mesh: mesh.clone(),
        };
        grid.fill();
        grid
    }

    /// Takes the free breakpoints from the iterate `x`.
    pub fn place(&mut self, x: &[f64]) {
        if self.knots.is_empty() {
            return;
        }
        for &(breakpoint, variable) in &self.knots {
            self.breakpoints[breakpoint] = x[variable];
        }
        self.fill();
    }

    fn fill(&mut self) {
        for (k, &s) in self.segments.iter().enumerate() {
            self.half_width[k] = 0.5 * (self.breakpoints[s + 1] - self.breakpoints[s]);
            self.quadrature[k] = self.half_width[k] * self.weights[k];
        }
    }

    /// Whether any breakpoint is free.
    pub fn is_free(&self) -> bool {
        !self.knots.is_empty()
    }

    /// Free breakpoints beside point `k`: variable, and −1 at the start, +1 at the end of its
    /// segment, the derivative of the width.
    pub fn sides(&self, k: usize) -> impl Iterator<Item = (usize, i8)> + '_ {
        let s = self.segments[k];
        self.knots
            .iter()
            .filter_map(move |&(breakpoint, variable)| {
                let side = match breakpoint {
                    b if b == s => -1,
                    b if b == s + 1 => 1,
                    _ => return None,
                };
                Some((variable, side))
            })
    }

    /// The mesh with its free breakpoints as in `x`.
    pub fn mesh(&self, x: &[f64]) -> Mesh {
        if self.knots.is_empty() {
            return self.mesh.clone();
        }
        let mut breakpoints = self.breakpoints.clone();
        for &(breakpoint, variable) in &self.knots {
            breakpoints[breakpoint] = x[variable];
        }
        let moved = Mesh::new(breakpoints, &self.mesh.points_per_segment());
        // An iterate that is no solution may have them out of order.
        moved.unwrap_or_else(|_| self.mesh.clone())
    }
}
