//! Static parameters: unknowns that do not change in time.

use crate::{refined, solve};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};

/// Which spring takes a mass from 1 to −1 in one second, at rest at both ends? ẍ = u − kx, least
/// ∫u² + (k − 3)²/100.
///
/// With `as_state` the stiffness is a state that does not change instead.
struct Spring {
    as_state: bool,
    weight: f64,
}

impl Spring {
    fn place_rate(&self, formulation: Formulation) -> Formulation {
        let [one, rest, minus] = [1.0, 0.0, -1.0].map(Interval::fixed);
        formulation
            .state(Quantity::new("place", Interval::FREE), one, minus)
            .state(Quantity::new("rate", Interval::FREE), rest, rest)
            .control(Quantity::new("force", Interval::FREE))
    }
}

impl Ocp for Spring {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let stiffness = Quantity::new("stiffness", Interval::new(0.0, 30.0));
        let second = self.place_rate(Formulation::over(Interval::fixed(1.0)));
        match self.as_state {
            true => second.state(stiffness, Interval::FREE, Interval::FREE),
            false => second.parameter(stiffness, 1.0),
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        let k = match self.as_state {
            true => p.x[2],
            false => p.parameters[0],
        };
        f[0] = p.x[1];
        f[1] = p.u[0] - k * p.x[0];
        if self.as_state {
            f[2] = S::zero();
        }
        p.u[0].square()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        let k = match self.as_state {
            true => ends.terminal[2],
            false => ends.parameters[0],
        };
        (k - 3.0).square() * self.weight
    }
}

/// x = cos πt is the free motion of a spring of π²: no force is needed.
#[test]
fn the_spring_that_swings_by_itself_is_found() {
    let spring = Spring {
        as_state: false,
        weight: 0.0,
    };
    let outcome = solve(&spring, &refined(4, 5, 1e-8, 8));
    let found = outcome.trajectory.parameters[0];
    assert!(outcome.converged && outcome.objective < 1e-10);
    assert!(
        (found - std::f64::consts::PI.powi(2)).abs() < 1e-5,
        "{found}"
    );
}

/// The same optimum from an unknown of the whole and from a state without a rate.
#[test]
fn a_parameter_and_a_state_that_does_not_change_give_the_same() {
    let [parameter, state] = [false, true].map(|as_state| {
        let weight = 0.1;
        let outcome = solve(&Spring { as_state, weight }, &refined(4, 5, 1e-7, 8));
        assert!(outcome.converged);
        outcome
    });
    let gap = (parameter.objective / state.objective - 1.0).abs();
    assert!(
        gap < 1e-8,
        "{} and {}",
        parameter.objective,
        state.objective
    );
    let stiffness = parameter.trajectory.parameters[0];
    assert!((stiffness / state.trajectory.state(0)[2] - 1.0).abs() < 1e-6);
    assert!(stiffness > 3.0 && stiffness < 9.0, "{stiffness}");
    let unknowns = [&parameter, &state].map(|outcome| outcome.iterate.x.len());
    assert!(unknowns[0] < unknowns[1]);
}

/// The next mesh begins with the parameter and the multiplier of its bound.
#[test]
fn a_bound_on_a_parameter_holds_on_every_mesh() {
    struct Stiff(Spring);
    impl Ocp for Stiff {
        type Scratch<S: Scalar> = ();
        fn formulation(&self) -> Formulation {
            let stiffness = Quantity::new("stiffness", Interval::new(0.0, 5.0));
            let second = Formulation::over(Interval::fixed(1.0));
            self.0.place_rate(second).parameter(stiffness, 1.0)
        }
        fn scratch<S: Scalar>(&self) {}
        fn continuous<S: Scalar>(
            &self,
            p: Point<'_, S>,
            _: &mut (),
            f: &mut [S],
            c: &mut [S],
        ) -> S {
            self.0.continuous(p, &mut (), f, c)
        }
    }
    let weight = 0.0;
    let as_state = false;
    let outcome = solve(
        &Stiff(Spring { as_state, weight }),
        &refined(2, 3, 1e-8, 10),
    );
    assert!(outcome.converged && outcome.records.len() > 2);
    let found = outcome.trajectory.parameters[0];
    assert!((found - 5.0).abs() < 1e-6, "{found}");
    let pressed = outcome.iterate.upper_multipliers.last().unwrap();
    assert!(*pressed > 1e-3, "{pressed}");
    for record in &outcome.records[1..] {
        assert!(record.nlp_iterations <= 8, "{}", record.nlp_iterations);
    }
}

#[test]
fn what_cannot_be_a_parameter_is_said() {
    struct Stated(Formulation);
    impl Ocp for Stated {
        type Scratch<S: Scalar> = ();
        fn formulation(&self) -> Formulation {
            self.0.clone()
        }
        fn scratch<S: Scalar>(&self) {}
        fn continuous<S: Scalar>(
            &self,
            p: Point<'_, S>,
            _: &mut (),
            f: &mut [S],
            _: &mut [S],
        ) -> S {
            f[0] = p.u[0];
            S::zero()
        }
    }
    let free = Interval::FREE;
    let named = |name: &str| Quantity::new(name, free);
    let plain = || {
        Formulation::over(Interval::fixed(1.0))
            .state(named("x"), free, free)
            .control(named("u"))
    };
    let empty = Quantity::new("p", Interval::new(1.0, 0.0));
    let between = |start, end| Formulation {
        initial_time: start,
        final_time: end,
        ..plain()
    };
    for (formulation, expected) in [
        (
            plain().parameter(named("p"), f64::NAN),
            "the guess of parameter p is NaN: expected a finite number",
        ),
        (
            plain().parameter(empty, 0.0),
            "p allows no value, it is 1 to 0: expected a lower bound not above the upper one",
        ),
        (
            Formulation {
                parameter_guess: vec![1.0],
                ..plain()
            },
            "formulation.parameter_guess has 1 values: expected 0, one for each parameter",
        ),
        (
            plain()
                .parameter(named("p"), 0.0)
                .parameter(named("p"), 0.0),
            "formulation.parameters[1] is named \"p\": expected a name that no other has",
        ),
        (
            plain().integral(named("")),
            "formulation.integrals[0] is named \"\": expected a name that no other has",
        ),
        (
            plain().integral(named("dose")),
            "integrands[0] (dose) was never written: expected Ocp::integrands to write it on every \
             call, or to write it before adding to it",
        ),
        (
            between(Interval::new(2.0, 1.0), free),
            "formulation.initial_time allows no value, it is 2 to 1: expected a lower bound not \
             above the upper one",
        ),
        (
            between(Interval::new(0.0, 1.0), Interval::new(5.0, 6.0)),
            "formulation.final_time is 5 to 6 s: expected one between 1 and 2 s, which t₀ and \
             duration allow",
        ),
    ] {
        let refused = ocp::solve(&Stated(formulation), &ocp::Settings::default());
        assert_eq!(refused.unwrap_err().to_string(), expected);
    }
}
