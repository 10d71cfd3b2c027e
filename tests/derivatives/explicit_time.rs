//! Problems of which time is an input.

use crate::checks::*;
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::ocp::{self, Ends, Formulation, InteriorPoint, Interval, Ocp, Point, Quantity};

/// Dynamics, path, boundary rows and costs that depend on time explicitly, with a free duration.
struct TimeVarying;

impl Ocp for TimeVarying {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        let named = |name: &str| Quantity::new(name, free);
        Formulation {
            states: vec![named("x"), named("y")],
            controls: vec![named("u")],
            path: vec![named("path")],
            boundary: vec![named("ends")],
            way_points: [0.3, 0.7]
                .into_iter()
                .map(|fraction| ocp::WayPoint {
                    fraction,
                    states: vec![free; 2],
                    rows: vec![named("product"), named("wave")],
                })
                .collect(),
            initial: vec![free; 2],
            terminal: vec![free; 2],
            duration: Interval::new(0.5, 1.5),
            ..Formulation::default()
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], path: &mut [S]) -> S {
        let (x, y, u, t) = (p.x[0], p.x[1], p.u[0], p.t);
        // Nothing here vanishes at t = 0, where the first point stands.
        let late = t + 1.0;
        f[0] = y * late.sin() + u * late;
        f[1] = x.square() * late.square() - y.exp() * u;
        path[0] = x * u * late + late.square() * y;
        u.square() * (x * late).cos() + late * late * late
    }

    fn way_point<S: Scalar>(&self, point: InteriorPoint<'_, S>, _: &mut (), rows: &mut [S]) {
        let InteriorPoint {
            way_point, x, t, ..
        } = point;
        rows[0] = x[0] * x[1].square() * t;
        rows[1] = (x[1] * t).sin() + x[0].square() * way_point as f64;
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        let (a, b, t) = (ends.initial, ends.terminal, ends.duration);
        rows[0] = a[0] * b[1] * t + b[0].square();
        (t * a[1]).sin() + b[1].square() * t
    }
}

#[test]
fn explicit_time_with_a_free_duration() {
    check(
        &TimeVarying,
        Mesh::new(vec![0.0, 0.3, 0.7, 1.0], &[2, 1, 2]).unwrap(),
    );
}
