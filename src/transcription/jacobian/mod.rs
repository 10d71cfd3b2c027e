//! Structure and values of the constraint Jacobian.
//!
//! | file | does |
//! | --- | --- |
//! | `builder` | puts it together, row by row |
//! | `term` | what nonzeros are made of |
//! | `slots` | where derivatives of points and ends stand |

mod builder;
mod slots;
mod term;

pub(super) use builder::Parts;
pub(super) use slots::{end_column, first_slot};

use super::evaluation::Evaluation;
use super::triplets::Triplets;
use crate::collocation::Mesh;
use builder::Builder;
use term::Term;

/// The constraint Jacobian of a transcription: constant parts and terms to add.
#[derive(Debug)]
pub(super) struct Jacobian {
    pub nonzeros: usize,
    /// The first nonzero of every row (26), by points.
    defects: Vec<u32>,
    constants: Vec<(u32, f64)>,
    terms: Vec<(u32, Term)>,
    /// Which derivative of the point is that of each output by the time.
    by_time: Vec<Option<usize>>,
}

impl Jacobian {
    pub fn new(parts: &Parts<'_, '_>) -> Self {
        let sparsity = parts.evaluation.node_derivatives().sparsity();
        let time = parts.evaluation.node.time();
        let by_time = |output: usize| {
            let inputs = &sparsity.jacobian[output];
            let time = inputs.iter().position(|&input| input == time);
            time.map(|k| first_slot(sparsity, output) + k)
        };
        let built = Builder::build(parts);
        Self {
            nonzeros: built.places.len(),
            defects: built.defects,
            constants: built.constants,
            terms: built.terms,
            by_time: (0..sparsity.jacobian.len()).map(by_time).collect(),
        }
    }

    /// Rows and columns of the nonzeros. They are asked for as a solve begins, and not kept: Ipopt has its
    /// own copy.
    pub fn places(parts: &Parts<'_, '_>) -> Triplets {
        Builder::build(parts).places
    }

    pub fn values(
        &self,
        duration: f64,
        mesh: &Mesh,
        evaluation: &Evaluation<'_>,
        values: &mut [f64],
    ) {
        values.fill(0.0);
        self.differentiate(mesh, values);
        for &(nonzero, constant) in &self.constants {
            values[nonzero as usize] = constant;
        }
        let width = evaluation.node_derivatives().jacobian_nonzeros();
        let grid = &evaluation.grid;
        let first =
            |point: u32, slot: u32| evaluation.first[point as usize * width + slot as usize];
        let output = |point: u32, output: u32| evaluation.outputs(point as usize)[output as usize];
        let fraction = |point: u32| evaluation.fraction(point as usize);
        let half_width = |point: u32| grid.half_width[point as usize];
        let quadrature = |point: u32| grid.quadrature[point as usize];
        // An output and, by the time, its derivative.
        let by_duration = |point: u32, row: u32| {
            let slot = self.by_time[row as usize];
            let by_time = slot.map_or(0.0, |slot| {
                duration * fraction(point) * evaluation.first[point as usize * width + slot]
            });
            output(point, row) + by_time
        };
        for &(nonzero, term) in &self.terms {
            values[nonzero as usize] += match term {
                Term::Rate { point, slot } => -duration * half_width(point) * first(point, slot),
                Term::RateByDuration { point, row } => -half_width(point) * by_duration(point, row),
                Term::Path { point, slot } => first(point, slot),
                Term::PathByDuration { point, slot } => fraction(point) * first(point, slot),
                Term::End { slot } => evaluation.end_first[slot as usize],
                Term::WayPoint { way_point, slot } => {
                    evaluation.way_points[way_point as usize].first[slot as usize]
                }
                Term::Integrand { point, slot } => {
                    -duration * quadrature(point) * first(point, slot)
                }
                Term::IntegrandByDuration { point, output } => {
                    -quadrature(point) * by_duration(point, output)
                }
                Term::RateByKnot { point, row, side } => {
                    -f64::from(side) * 0.5 * duration * output(point, row)
                }
                Term::IntegrandByKnot {
                    point,
                    output: row,
                    side,
                } => {
                    let half = 0.5 * duration * grid.weights[point as usize];
                    -f64::from(side) * half * output(point, row)
                }
            };
        }
    }

    /// Writes the coefficients of the differentiation matrix.
    fn differentiate(&self, mesh: &Mesh, values: &mut [f64]) {
        let points = (0..mesh.segments()).flat_map(|s| {
            let rule = mesh.rule(s);
            (0..rule.len()).map(|i| rule.differentiation(i))
        });
        let states = self.defects.len() / mesh.points().max(1);
        for (firsts, coefficients) in self.defects.chunks(states.max(1)).zip(points) {
            for &first in firsts {
                let first = first as usize;
                values[first..first + coefficients.len()].copy_from_slice(coefficients);
            }
        }
    }
}
