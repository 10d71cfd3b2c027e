//! How strong an engine is worth its weight? An unknown that does not change in time.
//!
//! A cart goes 4 m from rest to rest in the time T, with an acceleration u of at most a either way. The
//! engine that gives a costs a/4: what is the least T + a/4?
//!
//! With a given, the fastest way is to accelerate at a for half of the time and to brake at a for the
//! other half, which takes T = 2√(4/a) = 4/√a. Then d/da (4/√a + a/4) = −2a^(−3/2) + 1/4 is zero for
//! a^(3/2) = 8: a = 4, T = 2, and the least cost is 3.
//!
//! ```sh
//! cargo run --release --example static_parameter
//! ```

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use std::error::Error;

/// States: place (m), speed (m/s). Control: acceleration (m/s²). Parameter: the largest acceleration.
#[derive(Debug)]
pub struct Cart;

impl Ocp for Cart {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let [rest, there] = [0.0, 4.0].map(Interval::fixed);
        let below = Interval::new(f64::NEG_INFINITY, 0.0);
        Formulation::over(Interval::new(0.1, 100.0))
            .state(Quantity::new("place", Interval::FREE), rest, there)
            .state(Quantity::new("speed", Interval::FREE), rest, rest)
            .control(Quantity::new("acceleration", Interval::FREE))
            .parameter(Quantity::new("engine", Interval::new(0.01, 100.0)), 1.0)
            .path_row(Quantity::new("forwards", below))
            .path_row(Quantity::new("backwards", below))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let (u, most) = (point.u[0], point.parameters[0]);
        rates[0] = point.x[1];
        rates[1] = u;
        path[0] = u - most;
        path[1] = -u - most;
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration + ends.parameters[0] * 0.25
    }
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let outcome = ocp::solve(&Cart, &ocp::Settings::default())?;
    let engine = outcome.trajectory.parameters[0];
    println!(
        "cost {:.7} (known: 3), engine {engine:.5} m/s² (known: 4), {} points",
        outcome.objective,
        outcome.trajectory.mesh.points(),
    );
    assert!(outcome.converged && (outcome.objective - 3.0).abs() < 1e-6);
    assert!((engine - 4.0).abs() < 1e-3);
    Ok(())
}
