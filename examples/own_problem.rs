//! Any optimal control problem: the fastest slide between two points, by the generic interface.
//!
//! ```sh
//! cargo run --release --example own_problem
//! ```

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use std::error::Error;
use std::f64::consts::FRAC_PI_2;

/// States: along, down (m), speed (m/s). Control: slope of the path (rad).
struct Slide;

impl Ocp for Slide {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let [rest, there] = [0.0, 2.0].map(Interval::fixed);
        let state = |name: &str| Quantity::new(name, Interval::FREE);
        Formulation::over(Interval::new(0.1, 10.0))
            .state(state("along"), rest, there)
            .state(state("down"), rest, there)
            .state(state("speed"), rest, Interval::FREE)
            .control(Quantity::new("slope", Interval::new(0.0, FRAC_PI_2)))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (sin, cos) = point.u[0].sin_cos();
        rates[0] = point.x[2] * cos;
        rates[1] = point.x[2] * sin;
        rates[2] = sin * 9.81;
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration
    }
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut settings = ocp::Settings::default();
    settings.mesh.segments = 4;
    settings.mesh.points = 6;
    settings.mesh.tolerance = 1e-7;
    let outcome = ocp::solve(&Slide, &settings)?;
    println!(
        "t_f = {:.9} s (known: 0.824338669), {} points, largest error {:.1e}",
        outcome.objective,
        outcome.trajectory.mesh.points(),
        outcome.max_error()
    );
    assert!(outcome.converged && (outcome.objective - 0.824338669).abs() < 1e-8);
    Ok(())
}
