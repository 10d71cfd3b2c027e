//! A periodic orbit of which neither a point nor the period is known.
//!
//! Van der Pol's oscillator ẍ = (1 − x²)ẋ − x has one limit cycle, of the period 6.6632868593 and the
//! amplitude 2.0086198608. Boundary rows make both ends the same point; the start at rest, on the side
//! where x is positive, says which of the points it is.
//!
//! ```sh
//! cargo run --release --example periodic_orbit
//! ```

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use std::error::Error;

/// States: x and ẋ. Nothing is steered.
#[derive(Debug)]
pub struct VanDerPol;

impl Ocp for VanDerPol {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let (free, same) = (Interval::FREE, Interval::fixed(0.0));
        let positive = Interval::new(0.5, f64::INFINITY);
        Formulation::over(Interval::new(1.0, 20.0))
            .state(Quantity::new("x", free), positive, free)
            .state(Quantity::new("rate of x", free), same, free)
            .boundary_row(Quantity::new("x comes back", same))
            .boundary_row(Quantity::new("its rate comes back", same))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (x, rate) = (point.x[0], point.x[1]);
        rates[0] = rate;
        rates[1] = rate - x.square() * rate - x;
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        rows[0] = ends.terminal[0] - ends.initial[0];
        rows[1] = ends.terminal[1] - ends.initial[1];
        S::zero()
    }
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut settings = ocp::Settings::default();
    settings.mesh.tolerance = 1e-7;
    settings.mesh.max_iterations = Some(15);
    // A circle, as a guess.
    let outcome = ocp::solve_from(&VanDerPol, &settings, 6.0, |fraction, x, _| {
        let (sin, cos) = (std::f64::consts::TAU * fraction).sin_cos();
        x[0] = 2.0 * cos;
        x[1] = -2.0 * sin;
    })?;
    let (period, amplitude) = (outcome.trajectory.duration, outcome.trajectory.state(0)[0]);
    println!(
        "period {period:.10} (known: 6.6632868593), amplitude {amplitude:.10} (known: 2.0086198608), \
         {} points",
        outcome.trajectory.mesh.points(),
    );
    assert!(outcome.converged && (period - 6.663_286_859_3).abs() < 1e-8);
    assert!((amplitude - 2.008_619_860_8).abs() < 1e-8);
    Ok(())
}
