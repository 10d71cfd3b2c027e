//! Bounds on integrals.

use crate::{refined, solve};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Ends, Formulation, Interval, Ocp, Point, Quantity};
use std::f64::consts::FRAC_PI_3;

/// Dido's problem: the largest area between a line of 1 m and a curve of a given length over it.
struct Dido {
    length: f64,
}

impl Ocp for Dido {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let ground = Interval::fixed(0.0);
        Formulation::over(Interval::fixed(1.0))
            .state(Quantity::new("height", Interval::FREE), ground, ground)
            .control(Quantity::new("slope", Interval::symmetric(5.0)))
            .integral(Quantity::new("length", Interval::fixed(self.length)))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.u[0];
        -p.x[0]
    }

    fn integrands<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), g: &mut [S]) {
        g[0] = (p.u[0].square() + 1.0).sqrt();
    }
}

/// The curve is an arc of a circle. With half its angle 60° its radius is 1/√3, its length 2·60°
/// times that. A longer curve by dL encloses more by the radius times dL: the multiplier.
#[test]
fn the_largest_area_for_a_length_is_under_an_arc() {
    let radius = 1.0 / 3f64.sqrt();
    let length = 2.0 * radius * FRAC_PI_3;
    let area = radius * radius * (FRAC_PI_3 - 3f64.sqrt() / 4.0);
    // A polynomial height has no error (28), on any mesh: its length is what needs the points.
    let outcome = solve(&Dido { length }, &refined(6, 8, 1e-8, 10));
    assert!(outcome.converged);
    let gap = (outcome.objective + area).abs();
    assert!(
        gap < 1e-8 * area,
        "{} instead of {area}",
        -outcome.objective
    );
    assert!((outcome.trajectory.integrals[0] - length).abs() < 1e-9);
    // The last row of the programme is that of the integral.
    let multiplier = *outcome.iterate.multipliers.last().unwrap();
    assert!((multiplier + radius).abs() < 1e-6, "{multiplier}");
}

/// A double integrator from rest to rest over 1 m with ∫u² of at most `effort`; `priced`: ∫u² costs
/// by the square of the integral instead.
struct Effort {
    effort: f64,
    priced: bool,
}

impl Ocp for Effort {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let [rest, there] = [0.0, 1.0].map(Interval::fixed);
        let most = Interval::new(0.0, self.effort);
        Formulation::over(Interval::new(0.1, 20.0))
            .state(Quantity::new("place", Interval::FREE), rest, there)
            .state(Quantity::new("rate", Interval::FREE), rest, rest)
            .control(Quantity::new("force", Interval::FREE))
            .integral(Quantity::new("effort", most))
            .integral(Quantity::new("way", Interval::FREE))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.x[1];
        f[1] = p.u[0];
        S::zero()
    }

    fn integrands<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), g: &mut [S]) {
        g[0] = p.u[0].square();
        g[1] = p.x[1];
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        match self.priced {
            true => ends.duration + ends.integrals[0].square(),
            false => ends.duration,
        }
    }
}

/// The least ∫u² in T is 12/T³. Where it is bounded by 1.5, T is 2; where T + (12/T³)² is least,
/// T⁷ = 6·144.
#[test]
fn effort_is_bounded_or_priced() {
    let bounded = Effort {
        effort: 1.5,
        priced: false,
    };
    let outcome = solve(&bounded, &refined(3, 4, 1e-7, 8));
    assert!(
        (outcome.objective - 2.0).abs() < 1e-7,
        "{}",
        outcome.objective
    );
    let [effort, way] = outcome.trajectory.integrals[..] else {
        panic!("two integrals")
    };
    assert!((effort - 1.5).abs() < 1e-6 && (way - 1.0).abs() < 1e-9);
    let priced = Effort {
        effort: f64::INFINITY,
        priced: true,
    };
    let outcome = solve(&priced, &refined(3, 4, 1e-7, 8));
    let duration = 864f64.powf(1.0 / 7.0);
    let expected = duration + (12.0 / duration.powi(3)).powi(2);
    assert!((outcome.objective / expected - 1.0).abs() < 1e-8);
    assert!((outcome.trajectory.duration / duration - 1.0).abs() < 1e-5);
}

/// A value that no curve has is infeasible, and is said to be.
#[test]
fn a_length_below_that_of_the_line_is_infeasible() {
    let settings = ffsm_ipopt::ocp::Settings::from(refined(4, 4, 1e-6, 3));
    let outcome = ffsm_ipopt::ocp::solve(&Dido { length: 0.9 }, &settings).unwrap();
    assert!(!outcome.converged && !outcome.status.is_solved());
}

/// A point that goes from 0 to 10 with least ∫u², past a source of dose 1/(1 + 400(x − 5)²).
struct Dose;

impl Ocp for Dose {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let [start, end] = [0.0, 10.0].map(Interval::fixed);
        Formulation::over(Interval::fixed(10.0))
            .state(Quantity::new("place", Interval::FREE), start, end)
            .control(Quantity::new("speed", Interval::FREE))
            .integral(Quantity::new("dose", Interval::FREE))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.u[0];
        p.u[0].square()
    }

    fn integrands<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), g: &mut [S]) {
        let off = p.x[0] - S::constant(5.0);
        g[0] = S::one() / (off.square() * 400.0 + S::one());
    }
}

/// The states are straight lines, exact on any mesh; the integral is not: its error refines.
#[test]
fn an_integral_is_as_accurate_as_a_state() {
    let coarse = solve(&Dose, &refined(4, 4, 1e-6, 1));
    assert!(!coarse.converged, "{:e}", coarse.max_error());
    let outcome = solve(&Dose, &refined(4, 4, 1e-6, 20));
    assert!(outcome.converged, "{:e}", outcome.max_error());
    // ∫ dx/(1 + 400(x − 5)²) from 0 to 10 is arctan(100)/10.
    let dose = outcome.trajectory.integrals[0];
    assert!((dose - 100.0_f64.atan() / 10.0).abs() < 1e-6, "{dose}");
}
