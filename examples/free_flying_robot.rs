//! A robot that floats on a plane flies by two pairs of jets, on the least fuel.
//!
//! Y. Sakawa, *Trajectory planning of a free-flying robot by using the optimal control*,
//! doi:10.1002/oca.659, in the form of Betts: the sum of the jets' thrusts costs 7.910154.
//!
//! ```sh
//! cargo run --release --example free_flying_robot
//! ```

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Formulation, Interval, Ocp, Point, Quantity};
use std::error::Error;
use std::f64::consts::FRAC_PI_2;

/// Place x, y, angle, and their rates. Controls: the four jets' thrusts.
#[derive(Debug)]
pub struct Robot;

/// Turning effect of either pair.
const LEVER: f64 = 0.2;

impl Ocp for Robot {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let ends = [
            ("x", -10.0),
            ("y", -10.0),
            ("angle", FRAC_PI_2),
            ("rate of x", 0.0),
            ("rate of y", 0.0),
            ("rate of the angle", 0.0),
        ];
        let mut formulation = Formulation::over(Interval::fixed(12.0));
        for (name, start) in ends {
            let state = Quantity::new(name, Interval::FREE);
            formulation = formulation.state(state, Interval::fixed(start), Interval::fixed(0.0));
        }
        for jet in 1..=4 {
            let thrust = Interval::new(0.0, f64::INFINITY);
            formulation = formulation.control(Quantity::new(format!("jet {jet}"), thrust));
        }
        let most = Interval::new(f64::NEG_INFINITY, 1.0);
        formulation
            .path_row(Quantity::new("jets 1 and 2", most))
            .path_row(Quantity::new("jets 3 and 4", most))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let (x, u) = (point.x, point.u);
        let [first, second] = [u[0] - u[1], u[2] - u[3]];
        let (sin, cos) = x[2].sin_cos();
        rates[..3].copy_from_slice(&x[3..]);
        rates[3] = (first + second) * cos;
        rates[4] = (first + second) * sin;
        rates[5] = (first - second) * LEVER;
        path[0] = u[0] + u[1];
        path[1] = u[2] + u[3];
        u[0] + u[1] + u[2] + u[3]
    }
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut settings = ocp::Settings::default();
    settings.mesh.max_iterations = Some(15);
    let outcome = ocp::solve(&Robot, &settings)?;
    println!(
        "fuel {:.6} (known: 7.910154), {} points, largest error {:.1e}",
        outcome.objective,
        outcome.trajectory.mesh.points(),
        outcome.max_error()
    );
    assert!(outcome.converged && (outcome.objective / 7.910_154 - 1.0).abs() < 1e-5);
    Ok(())
}
