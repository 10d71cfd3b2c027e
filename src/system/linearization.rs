//! First derivatives at a collocation point, as rows and cost terms use them for their own; and
//! the weights by which what they are functions of bends in the Hessian.

use super::plant::Plant;
use crate::dynamics::Data;
use crate::dynamics::space::Space;
use crate::ocp::Point;

/// A collocation point with the first derivatives of the base's rates and of the torques.
///
/// The inputs of all derivatives are η, θ, θ̇, u, the static parameters and t in this order.
#[derive(Debug)]
pub(crate) struct Linearization<'a, Sp: Space> {
    pub plant: &'a Plant<Sp>,
    pub point: Point<'a, f64>,
    pub data: &'a Data<Sp, f64>,
    /// Rates of the base that limits and costs are about, then θ̇.
    pub rates: &'a [f64],
    /// Joint torques.
    pub torque: &'a [f64],
    /// Derivatives by the states: rates of the base, one row each, then φ² where it is needed.
    pub base_by: &'a [f64],
    /// Derivatives of the torques by θ, n×n by rows.
    pub torque_by: &'a [f64],
}

impl<Sp: Space> Linearization<'_, Sp> {
    /// Number of joints n.
    pub fn joints(&self) -> usize {
        self.plant.joints()
    }

    /// Number of states.
    pub fn states(&self) -> usize {
        self.plant.states()
    }

    /// Input that the time is, the last one.
    pub fn time(&self) -> usize {
        self.parameter(self.point.parameters.len())
    }

    /// Input that static parameter `i` is.
    pub fn parameter(&self, i: usize) -> usize {
        self.states() + self.joints() + i
    }

    /// Number of inputs, the width of a row.
    pub fn width(&self) -> usize {
        self.time() + 1
    }

    /// Input that joint position `j` is.
    pub fn position(&self, j: usize) -> usize {
        self.plant.parameters() + j
    }

    /// Input that joint rate `j` is.
    pub fn rate(&self, j: usize) -> usize {
        self.plant.parameters() + self.joints() + j
    }

    /// Input that control `j` is.
    pub fn control(&self, j: usize) -> usize {
        self.states() + j
    }

    /// Derivatives by the states of component `i` of the base's rate.
    pub fn base_rate_by(&self, i: usize) -> &[f64] {
        let states = self.states();
        &self.base_by[i * states..(i + 1) * states]
    }

    /// Derivatives of φ² by the states.
    pub fn squared_rotation_by(&self) -> &[f64] {
        self.base_rate_by(Sp::ANGLES)
    }

    /// Derivatives of torque `j` by the joint positions.
    pub fn torque_by(&self, j: usize) -> &[f64] {
        let n = self.joints();
        &self.torque_by[j * n..(j + 1) * n]
    }

    /// Element of H, the derivative of torque `i` by control `j`.
    pub fn mass(&self, i: usize, j: usize) -> f64 {
        self.data.mass_matrix[i.max(j) * self.joints() + i.min(j)]
    }
}

/// Sums of weights on what rows and cost terms are functions of, for the second derivatives of
/// those: Σ weight·∂(row or term)/∂(quantity).
#[derive(Debug)]
pub(crate) struct Adjoint<'a> {
    /// Of the base's rates.
    pub base_rate: &'a mut [f64],
    /// Of φ²; of no length where it is not needed.
    pub squared_rotation: &'a mut [f64],
    /// Of the joint torques.
    pub torque: &'a mut [f64],
}

/// The lower triangle of a Hessian over the inputs, by rows of the square matrix.
#[derive(Debug)]
pub(crate) struct Lower<'a> {
    values: &'a mut [f64],
    width: usize,
}

impl<'a> Lower<'a> {
    /// Over `values`, `width`² of them.
    pub fn new(values: &'a mut [f64], width: usize) -> Self {
        Self { values, width }
    }

    /// Adds to the element in `row` and `column`, `column` not above `row`.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(column <= row);
        self.values[row * self.width + column] += value;
    }

    /// Adds to the element of two inputs, in whatever order; where they are the same, both
    /// triangles meet and the value counts twice.
    #[inline]
    pub fn add_pair(&mut self, a: usize, b: usize, value: f64) {
        let value = if a == b { 2.0 * value } else { value };
        self.add(a.max(b), a.min(b), value);
    }

    /// The elements of `row` up to the diagonal.
    #[inline]
    pub fn row(&mut self, row: usize) -> &mut [f64] {
        &mut self.values[row * self.width..=row * self.width + row]
    }
}
