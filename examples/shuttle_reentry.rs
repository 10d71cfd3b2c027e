//! A space shuttle flies as far to the side as it can while it comes down, in feet and pounds.
//!
//! J. T. Betts, *Practical Methods for Optimal Control and Estimation Using Nonlinear Programming*,
//! section 6.1, without the limit on heating: a cross range of 34.1412° after 2008.59 s.
//!
//! ```sh
//! cargo run --release --example shuttle_reentry
//! ```

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use std::error::Error;

/// Altitude ft, longitude and latitude rad, speed ft/s, flight path angle and azimuth rad. Controls:
/// angles of attack and bank, rad.
#[derive(Debug)]
pub struct Shuttle {
    /// Highest altitude, ft.
    pub ceiling: f64,
    /// Feet in the unit of length.
    pub unit: f64,
}

/// Earth's gravitational parameter, ft³/s².
const MU: f64 = 0.140_765_39e17;
/// Earth's radius, ft.
const RADIUS: f64 = 20_902_900.0;
/// Density at sea level, slug/ft³, and the height over which it falls by e, ft.
const DENSITY: [f64; 2] = [0.002_378, 23_800.0];
/// Wing area, ft², and mass, slug.
const AREA: f64 = 2690.0;
const MASS: f64 = 203_000.0 / 32.174;

impl Ocp for Shuttle {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let degrees = |low: f64, high: f64| Interval::new(low.to_radians(), high.to_radians());
        let at = |degrees: f64| Interval::fixed(degrees.to_radians());
        let feet = |feet: f64| Interval::fixed(feet / self.unit);
        let altitude = Interval::new(0.0, self.ceiling / self.unit);
        let speed = Interval::new(1.0 / self.unit, f64::INFINITY);
        let steep = degrees(-89.0, 89.0);
        let free = Interval::FREE;
        Formulation::over(Interval::new(500.0, 4000.0))
            .state(
                Quantity::new("altitude", altitude),
                feet(260_000.0),
                feet(80_000.0),
            )
            .state(Quantity::new("longitude", free), at(0.0), free)
            .state(Quantity::new("latitude", steep), at(0.0), free)
            .state(Quantity::new("speed", speed), feet(25_600.0), feet(2500.0))
            .state(Quantity::new("path angle", steep), at(-1.0), at(-5.0))
            .state(Quantity::new("azimuth", free), at(90.0), free)
            .control(Quantity::new("angle of attack", degrees(-90.0, 90.0)))
            .control(Quantity::new("bank", degrees(-89.0, 1.0)))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let [h, _, latitude, v, gamma, psi] = point.x else {
            unreachable!("six states")
        };
        let (h, v) = (*h * self.unit, *v * self.unit);
        let [alpha, bank] = [point.u[0], point.u[1]];
        let (sin_latitude, cos_latitude) = latitude.sin_cos();
        let (sin_gamma, cos_gamma) = gamma.sin_cos();
        let (sin_psi, cos_psi) = psi.sin_cos();
        let (sin_bank, cos_bank) = bank.sin_cos();
        let r = h + RADIUS;
        let gravity = r.recip().square() * MU;
        let degrees = alpha * 1f64.to_degrees();
        let lift = degrees * 0.029_244 - 0.207_04;
        let drag = degrees.square() * 0.621_408e-3 - degrees * 0.615_92e-2 + 0.078_54;
        let density = (-h / DENSITY[1]).exp() * DENSITY[0];
        // Dynamic pressure times area over mass.
        let pressure = density * v.square() * (0.5 * AREA / MASS);
        let turn = v * cos_gamma * sin_psi / (r * cos_latitude);
        rates[0] = v * sin_gamma / self.unit;
        rates[1] = turn;
        rates[2] = v * cos_gamma * cos_psi / r;
        rates[3] = -(pressure * drag + gravity * sin_gamma) / self.unit;
        rates[4] = pressure * lift * cos_bank / v + cos_gamma * (v / r - gravity / v);
        rates[5] = pressure * lift * sin_bank / (v * cos_gamma) + turn * sin_latitude;
        S::zero()
    }

    /// The cross range, to be as large as can be.
    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        -ends.terminal[2]
    }
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let shuttle = Shuttle {
        ceiling: 1e6,
        unit: 1.0,
    };
    let mut settings = ocp::Settings::default();
    settings.mesh.max_iterations = Some(15);
    let outcome = ocp::solve(&shuttle, &settings)?;
    let range = -outcome.objective.to_degrees();
    println!(
        "cross range {range:.4}° (known: 34.1412°) after {:.2} s, {} points, largest error {:.1e}",
        outcome.trajectory.duration,
        outcome.trajectory.mesh.points(),
        outcome.max_error()
    );
    assert!(outcome.converged && (range - 34.1412).abs() < 1e-4);
    Ok(())
}
