//! Which linear solvers this machine's Ipopt can use.

use super::{linear_solver, solve};
use crate::nlp::{Control, Iterate, LinearSolver, Nlp, Settings, Size, Status, Undefined};

/// The linear solvers of [`LinearSolver::KNOWN`] that solve a tiny programme here.
///
/// Ipopt takes the name of any solver it was built to load later, so that only a solve tells.
/// This loads the libraries it finds, takes some milliseconds a solver, and prints nothing of
/// its own.
pub fn linear_solvers() -> Vec<LinearSolver> {
    LinearSolver::KNOWN.into_iter().filter(works).collect()
}

fn works(solver: &LinearSolver) -> bool {
    let settings = Settings {
        linear_solver: solver.clone(),
        timing: false,
        ..Settings::default()
    };
    let start = Iterate::primal(vec![0.0, 0.0]);
    solve(&mut Tiny, &settings, &start, &mut |_| Control::Continue).is_ok_and(|solution| {
        let served = solution.statistics.fallbacks == 0;
        solution.status == Status::Solved && served && linear_solver(&settings) == *solver
    })
}

/// Minimise x² + y² subject to x + y = 1.
struct Tiny;

impl Nlp for Tiny {
    fn size(&self) -> Size {
        Size {
            variables: 2,
            constraints: 1,
            jacobian_nonzeros: 2,
            hessian_nonzeros: 2,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(f64::NEG_INFINITY);
        upper.fill(f64::INFINITY);
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(1.0);
        upper.fill(1.0);
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        rows.copy_from_slice(&[0, 0]);
        columns.copy_from_slice(&[0, 1]);
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        rows.copy_from_slice(&[0, 1]);
        columns.copy_from_slice(&[0, 1]);
    }

    fn new_point(&mut self) {}

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        Ok(x[0] * x[0] + x[1] * x[1])
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        gradient.copy_from_slice(&[2.0 * x[0], 2.0 * x[1]]);
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        values[0] = x[0] + x[1];
        Ok(())
    }

    fn jacobian(&mut self, _x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        values.fill(1.0);
        Ok(())
    }

    fn hessian(
        &mut self,
        _x: &[f64],
        sigma: f64,
        _multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        values.fill(2.0 * sigma);
        Ok(())
    }
}
