//! The hypersensitive problem, whose solution rests between two short layers.

use crate::{fixed, refined, solve, states};
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Formulation, Interval, Ocp, Point, Quantity};

/// min ½∫(x² + u²), ẋ = −x³ + u.
pub struct Hypersensitive {
    pub ends: [f64; 2],
    pub duration: f64,
}

impl Ocp for Hypersensitive {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: states(&[("x", Interval::FREE)]),
            controls: vec![Quantity::new("u", Interval::FREE)],
            path: vec![],
            boundary: vec![],
            way_points: vec![],
            initial: fixed(&self.ends[..1]),
            terminal: fixed(&self.ends[1..]),
            duration: Interval::fixed(self.duration),
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
        let (x, u) = (p.x[0], p.u[0]);
        rates[0] = u - x * x * x;
        (x * x + u * u) * 0.5
    }
}

/// g(s) = ¼(s√(s²+1) + asinh s); J = g(x₀²) − x₀⁴/4 + g(x_f²) + x_f⁴/4.
pub fn hypersensitive_optimum([a, b]: [f64; 2]) -> f64 {
    let g = |s: f64| 0.25 * (s * (s * s + 1.0).sqrt() + s.asinh());
    g(a * a) - a.powi(4) / 4.0 + g(b * b) + b.powi(4) / 4.0
}

#[test]
fn hypersensitive_meets_its_closed_form() {
    let ends = [1.5, 1.0];
    let optimum = hypersensitive_optimum(ends);
    assert!((optimum - 1.330806905).abs() < 1e-9);
    let outcome = solve(
        &Hypersensitive {
            ends,
            duration: 50.0,
        },
        &refined(10, 5, 1e-7, 12),
    );
    assert!(
        (outcome.objective - optimum).abs() < 1e-8,
        "J = {}",
        outcome.objective
    );
}

#[test]
fn stiff_hypersensitive_meets_its_closed_form() {
    let ends = [1.0, 1.5];
    let optimum = hypersensitive_optimum(ends);
    assert!((optimum - 3.362056905).abs() < 1e-9);
    let outcome = solve(
        &Hypersensitive {
            ends,
            duration: 1e4,
        },
        &refined(10, 5, 1e-6, 25),
    );
    assert!(outcome.converged, "error {:e}", outcome.max_error());
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "J = {}",
        outcome.objective
    );
}
