//! The sparse nonlinear programme as a solver sees it.

/// A function of the programme has no finite value at the point asked for.
///
/// Not a failure of the solve: a line search shortens its step and goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{function} is not finite at the trial point")]
pub struct Undefined {
    /// Which function, in words ("objective", "constraints", "Hessian of the Lagrangian").
    pub function: &'static str,
}

/// Sizes of a programme: fixed for its whole life.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Number of variables, n.
    pub variables: usize,
    /// Number of constraint rows, m.
    pub constraints: usize,
    /// Nonzeros of the constraint Jacobian.
    pub jacobian_nonzeros: usize,
    /// Nonzeros of the lower triangle of the Hessian of the Lagrangian.
    pub hessian_nonzeros: usize,
}

/// A sparse programme: minimise f(x) subject to `lower ≤ g(x) ≤ upper` and `lower ≤ x ≤ upper`.
///
/// Infinite bounds are `f64::INFINITY` and `f64::NEG_INFINITY`; a variable with equal bounds is
/// fixed. All slices have the lengths of [`Size`]. The evaluation functions take `&mut self` so
/// that an implementation can keep what it has computed at a point; [`Nlp::new_point`] tells it
/// when that point has changed.
pub trait Nlp {
    /// Sizes of the programme.
    fn size(&self) -> Size;

    /// Bounds of the variables.
    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]);

    /// Bounds of the constraint rows.
    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]);

    /// Zero-based rows and columns of the Jacobian's nonzeros, in the order of the values.
    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]);

    /// Zero-based rows and columns (row ≥ column) of the Hessian's nonzeros.
    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]);

    /// The evaluations that follow are at a point not seen before.
    fn new_point(&mut self);

    /// f(x).
    ///
    /// # Errors
    /// [`Undefined`] where the value is not finite.
    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined>;

    /// ∇f(x), dense, length n.
    ///
    /// # Errors
    /// [`Undefined`] where a value is not finite.
    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined>;

    /// g(x), length m.
    ///
    /// # Errors
    /// [`Undefined`] where a value is not finite.
    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined>;

    /// Nonzeros of ∂g/∂x.
    ///
    /// # Errors
    /// [`Undefined`] where a value is not finite.
    fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined>;

    /// Nonzeros of the lower triangle of σ∇²f + Σ λᵢ∇²gᵢ.
    ///
    /// # Errors
    /// [`Undefined`] where a value is not finite.
    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined>;

    /// What a person calls variable `index` ("rate of joint elbow, segment 3, point 4").
    fn variable_name(&self, index: usize) -> String {
        format!("variable {index}")
    }

    /// What a person calls constraint row `index`.
    fn constraint_name(&self, index: usize) -> String {
        format!("constraint {index}")
    }
}
