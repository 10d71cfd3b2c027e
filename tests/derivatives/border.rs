//! Unknowns and rows that couple all points: static parameters, integrals, both times.

use crate::checks::*;
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::ocp::{
    self, Elastic, Ends, Formulation, InteriorPoint, Interval, LimitGroup, Limited, Ocp, Point,
    Quantity,
};
use ffsm_ipopt::transcription::{Patterns, Transcription};

/// Everything depends on everything; which of the times are free is told.
struct Coupled {
    initial_time: Interval,
    duration: Interval,
    final_time: Interval,
}

fn named(name: &str) -> Quantity {
    Quantity::new(name, Interval::FREE)
}

impl Ocp for Coupled {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        Formulation {
            initial_time: self.initial_time,
            final_time: self.final_time,
            ..Formulation::over(self.duration)
        }
        .state(named("x"), free, free)
        .state(named("y"), free, free)
        .control(named("u"))
        .path_row(named("path"))
        .boundary_row(named("ends"))
        .parameter(named("p"), 0.3)
        .parameter(named("s"), 0.1)
        .integral(named("work"))
        .integral(named("dose"))
        .way_point(ocp::WayPoint {
            fraction: 0.3,
            states: vec![free; 2],
            rows: vec![named("passed")],
        })
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), f: &mut [S], path: &mut [S]) -> S {
        let (x, y, u, late) = (a.x[0], a.x[1], a.u[0], a.t + 1.0);
        let (p, s) = (a.parameters[0], a.parameters[1]);
        f[0] = y * late.sin() + u * p.square() * late + s * x;
        f[1] = x.square() * late * s - y.exp() * u;
        path[0] = x * p * late + y * s.square();
        u.square() * (x * late * p).cos() + late.square() * s.square()
    }

    fn integrands<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), g: &mut [S]) {
        let (p, s) = (a.parameters[0], a.parameters[1]);
        g[0] = a.u[0].square() * (a.t + 1.0).square() + a.x[0] * p * s;
        g[1] = (a.x[1] * p).sin() + s * s;
    }

    fn way_point<S: Scalar>(&self, a: InteriorPoint<'_, S>, _: &mut (), rows: &mut [S]) {
        rows[0] = a.x[0] * a.parameters[1] * (a.t + 1.0).square() + a.x[1].square();
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        let (p, q) = (ends.parameters[0], ends.integrals[0]);
        rows[0] =
            ends.initial[0] * ends.terminal[1] * (ends.final_time() + 1.0).square() * p + q * q;
        (ends.initial_time + 1.0).square() * ends.duration.square() * q + ends.integrals[1].square()
    }
}

fn kinds() -> impl Iterator<Item = Coupled> {
    let times = [(0.4, 0.4), (0.2, 0.5)].map(|(a, b)| Interval::new(a, b));
    let durations = [(0.9, 0.9), (0.5, 1.5)].map(|(a, b)| Interval::new(a, b));
    times.into_iter().flat_map(move |initial_time| {
        durations.into_iter().flat_map(move |duration| {
            [Interval::FREE, Interval::new(0.0, 3.0)].map(|final_time| Coupled {
                initial_time,
                duration,
                final_time,
            })
        })
    })
}

fn mesh() -> Mesh {
    Mesh::new(vec![0.0, 0.3, 1.0], &[2, 2]).unwrap()
}

#[test]
fn parameters_integrals_and_both_times() {
    for problem in kinds() {
        check(&problem, mesh());
    }
}

/// The same without the sparsity that operations tell: every derivative is kept, none is wrong.
struct Branching<'a>(&'a Coupled);

impl Ocp for Branching<'_> {
    type Scratch<S: Scalar> = ();
    fn formulation(&self) -> Formulation {
        self.0.formulation()
    }
    fn scratch<S: Scalar>(&self) {}
    fn continuous<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), f: &mut [S], path: &mut [S]) -> S {
        self.0.continuous(a, &mut (), f, path)
    }
    fn integrands<S: Scalar>(&self, a: Point<'_, S>, _: &mut (), g: &mut [S]) {
        self.0.integrands(a, &mut (), g);
    }
    fn way_point<S: Scalar>(&self, a: InteriorPoint<'_, S>, _: &mut (), rows: &mut [S]) {
        self.0.way_point(a, &mut (), rows);
    }
    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), rows: &mut [S]) -> S {
        self.0.boundary(ends, &mut (), rows)
    }
    fn has_branches(&self) -> bool {
        true
    }
}

/// Structure as a set of (row, column), and the values with it.
fn jacobian<O: Ocp>(problem: &O) -> Vec<((usize, usize), f64)> {
    let mut nlp = Transcription::new(problem, &Patterns::detect(problem), mesh());
    let size = nlp.size();
    let count = size.jacobian_nonzeros;
    let (mut rows, mut columns, mut values) = (vec![0; count], vec![0; count], vec![0.0; count]);
    nlp.jacobian_structure(&mut rows, &mut columns);
    let x: Vec<f64> = (0..size.variables)
        .map(|i| 0.3 + 0.1 * (i % 5) as f64)
        .collect();
    nlp.new_point();
    nlp.jacobian(&x, &mut values).unwrap();
    let mut entries: Vec<_> = rows.into_iter().zip(columns).zip(values).collect();
    entries.sort_by_key(|(place, _)| *place);
    entries
}

#[test]
fn every_place_of_the_jacobian_stands_once_and_the_dense_pattern_gives_the_same() {
    for problem in kinds() {
        let known = jacobian(&problem);
        assert!(known.windows(2).all(|pair| pair[0].0 != pair[1].0));
        let all = jacobian(&Branching(&problem));
        for (place, value) in &all {
            let found = known.iter().find(|(other, _)| other == place);
            let found = found.map_or(0.0, |(_, value)| *value);
            assert!(
                (found - value).abs() < 1e-12,
                "{place:?}: {found} and {value}"
            );
        }
        assert!(all.len() >= known.len());
    }
}

/// The columns that a programme without free times has more than one without parameters and
/// integrals: those of the border, and in each row only what the row depends on.
#[test]
fn only_rows_that_depend_on_a_parameter_have_it() {
    let fixed = Interval::fixed(1.0);
    let problem = Coupled {
        initial_time: Interval::fixed(0.0),
        duration: fixed,
        final_time: Interval::FREE,
    };
    let nlp = Transcription::new(&problem, &Patterns::detect(&problem), mesh());
    let layout = nlp.layout();
    assert_eq!(layout.border().len(), 4);
    let entries = jacobian(&problem);
    let has = |row, column| entries.iter().any(|(place, _)| *place == (row, column));
    for k in 0..layout.points {
        let (p, s) = (layout.parameter(0), layout.parameter(1));
        assert!(has(layout.defect(k, 0), p) && has(layout.defect(k, 0), s));
        assert!(!has(layout.defect(k, 1), p) && has(layout.defect(k, 1), s));
        assert!(has(layout.integral_row(0), layout.control(k, 0)));
        assert!(!has(layout.integral_row(1), layout.control(k, 0)));
        assert!(!has(layout.integral_row(1), layout.state(k, 0)));
    }
    assert!(has(layout.integral_row(1), layout.integral(1)));
    assert!(!has(layout.integral_row(1), layout.integral(0)));
}

#[test]
fn limits_that_give_way_leave_parameters_and_integrals_as_they_are() {
    for problem in kinds() {
        let group = |name: &str, member| LimitGroup {
            name: name.into(),
            members: vec![member],
            scale: 0.7,
        };
        let groups = vec![
            group("x", Limited::State(0)),
            group("path", Limited::Path(0)),
            group("ends", Limited::Boundary(0)),
        ];
        check(&Elastic::new(&problem, groups, 1e-3), mesh());
    }
}
