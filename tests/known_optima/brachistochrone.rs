//! The brachistochrone, in free time.

use crate::{fixed, refined, solve, states};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Ends, Formulation, Interval, Ocp, Point, Quantity};

/// Fastest slide from rest to a point 2 m along and 2 m below; states x, y (down), speed.
pub struct Brachistochrone;

impl Ocp for Brachistochrone {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        Formulation {
            states: states(&[("along", free), ("down", free), ("speed", free)]),
            controls: vec![Quantity::new(
                "slope",
                Interval::new(0.0, std::f64::consts::FRAC_PI_2),
            )],
            path: vec![],
            boundary: vec![],
            way_points: vec![],
            initial: fixed(&[0.0; 3]),
            terminal: vec![Interval::fixed(2.0), Interval::fixed(2.0), free],
            duration: Interval::new(0.1, 10.0),
            ..Formulation::default()
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (s, c) = p.u[0].sin_cos();
        rates[0] = p.x[2] * c;
        rates[1] = p.x[2] * s;
        rates[2] = s * 9.81;
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration
    }
}

#[test]
fn brachistochrone_meets_its_time() {
    let outcome = solve(&Brachistochrone, &refined(4, 6, 1e-7, 6));
    assert!(
        (outcome.objective - 0.8243386694).abs() < 1e-8,
        "t_f = {}",
        outcome.objective
    );
}
