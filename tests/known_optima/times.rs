//! Free initial and final times.

use crate::{refined, solve};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Ends, Formulation, Interval, Ocp, Point, Quantity};

/// A drift with the tide, ẋ = sin t from t₀ to t_f: as far as can be.
struct Tide(Formulation);

impl Ocp for Tide {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let place = Quantity::new("place", Interval::FREE);
        self.0
            .clone()
            .state(place, Interval::fixed(0.0), Interval::FREE)
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.t.sin();
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        -ends.terminal[0]
    }
}

fn assert_tide(times: Formulation, start: f64, end: f64) {
    let outcome = solve(&Tide(times), &refined(2, 5, 1e-9, 8));
    let (found, duration) = (outcome.trajectory.initial_time, outcome.trajectory.duration);
    assert!(outcome.converged);
    assert!((outcome.objective + start.cos() - end.cos()).abs() < 1e-8);
    assert!((found - start).abs() < 1e-4, "from {found}");
    assert!(
        (found + duration - end).abs() < 1e-4,
        "to {}",
        found + duration
    );
    let times = outcome.trajectory.times();
    assert_eq!(times[0], found);
    assert_eq!(*times.last().unwrap(), found + duration);
}

/// ∫ sin t is largest over a second about π/2, up to a given end from 0 on, and over all of 0 to π.
#[test]
fn the_tide_is_taken_when_it_is_strongest() {
    let pi = std::f64::consts::PI;
    let within = Interval::new;
    let second = Formulation {
        initial_time: within(-1.0, 3.0),
        ..Formulation::over(Interval::fixed(1.0))
    };
    assert_tide(second, pi / 2.0 - 0.5, pi / 2.0 + 0.5);
    let until = Formulation::between(within(-1.0, 2.0), Interval::fixed(2.5));
    assert_tide(until, 0.0, 2.5);
    let any = Formulation::between(within(-1.0, 1.0), within(2.0, 5.0));
    assert_tide(any, 0.0, pi);
    let bounded = Formulation::between(within(0.5, 1.0), within(2.0, 3.0));
    assert_tide(bounded, 0.5, 3.0);
    let late = Formulation::between(Interval::fixed(1.0), within(2.0, 5.0));
    assert_tide(late, 1.0, pi);
}

/// ẋ = u over 1 m, least ∫u² + (t₀ − 1)² + (t_f − 2.75)².
struct Window;

impl Ocp for Window {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let [from, to] = [0.0, 1.0].map(Interval::fixed);
        Formulation::between(Interval::new(0.0, 5.0), Interval::new(0.0, 9.0))
            .state(Quantity::new("place", Interval::FREE), from, to)
            .control(Quantity::new("rate", Interval::FREE))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        f[0] = p.u[0];
        p.u[0].square()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        (ends.initial_time - 1.0).square() + (ends.final_time() - 2.75).square()
    }
}

/// With both ends δ outside their aims J = 1/(1.75 + 2δ) + 2δ², least for δ = 1/8: T is 2.
#[test]
fn both_ends_of_a_window_give_way_alike() {
    let outcome = solve(&Window, &refined(2, 4, 1e-8, 5));
    let trajectory = &outcome.trajectory;
    assert!((outcome.objective - 0.53125).abs() < 1e-9);
    assert!((trajectory.initial_time - 0.875).abs() < 1e-5);
    assert!((trajectory.duration - 2.0).abs() < 1e-5);
}
