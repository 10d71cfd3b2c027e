//! The first evaluation: everything written, everything finite.

use super::SolveError;
use crate::ocp::{DynOcp, Ends, Formulation, InteriorPoint, Quantity};
use crate::transcription::{Discretization, integrals};

/// What outputs hold before the first call: a number that no computation gives.
const UNTOUCHED: u64 = 0x7ff8_0bad_c0de_0001;

/// Whether `value` is still what stood there, or what adding to that gives.
fn is_untouched(value: f64) -> bool {
    value.to_bits() & !(1 << 63) == UNTOUCHED
}

/// One output of a function.
struct Output<'a> {
    function: &'static str,
    list: &'static str,
    index: usize,
    name: &'a str,
    value: f64,
    t: f64,
}

impl Output<'_> {
    fn written(&self) -> Result<(), SolveError> {
        match is_untouched(self.value) {
            false => Ok(()),
            true => Err(SolveError::Unwritten {
                function: self.function,
                output: self.label(),
                name: self.name.into(),
            }),
        }
    }

    fn finite(&self) -> Result<(), SolveError> {
        match self.value.is_finite() {
            true => Ok(()),
            false => Err(SolveError::Undefined {
                function: self.function,
                output: self.label(),
                name: self.name.into(),
                t: self.t,
                value: self.value,
            }),
        }
    }

    fn label(&self) -> String {
        match self.list {
            "" => "the value".into(),
            list => format!("{list}[{}]", self.index),
        }
    }
}

/// Asks that every output is written at the first point, at the ends and at the way-points.
pub(super) fn written(
    ocp: &dyn DynOcp,
    formulation: &Formulation,
    start: &Discretization,
) -> Result<(), SolveError> {
    each(ocp, formulation, start, 1, &mut |output| output.written())
}

/// Asks that every output is finite at every point of `start`.
pub(super) fn finite(
    ocp: &dyn DynOcp,
    formulation: &Formulation,
    start: &Discretization,
) -> Result<(), SolveError> {
    let points = start.mesh.points();
    each(ocp, formulation, start, points, &mut |output| {
        output.finite()
    })
}

/// Calls every function at the first `points` points and at all instants, and `ask` of each output.
fn each(
    ocp: &dyn DynOcp,
    formulation: &Formulation,
    start: &Discretization,
    points: usize,
    ask: &mut dyn FnMut(&Output<'_>) -> Result<(), SolveError>,
) -> Result<(), SolveError> {
    let untouched = |count: usize| vec![f64::from_bits(UNTOUCHED); count];
    let mut ask_list = |function, list, of: &[Quantity], values: &[f64], t| {
        let mut pairs = of.iter().zip(values).enumerate();
        pairs.try_for_each(|(index, (quantity, &value))| {
            ask(&Output {
                function,
                list,
                index,
                name: &quantity.name,
                value,
                t,
            })
        })
    };
    let cost = |name: &str| [Quantity::new(name, crate::ocp::Interval::FREE)];
    let mut functions = ocp.functions();
    let times = start.times();
    for (k, &t) in times.iter().enumerate().take(points) {
        let (x, u) = (start.state(k), start.control(k));
        let mut rates = untouched(formulation.states.len());
        let mut path = untouched(formulation.path.len());
        let mut integrands = untouched(formulation.integrals.len());
        let point = start.point(x, u, t);
        let value = functions.continuous(point, &mut rates, &mut path);
        if !integrands.is_empty() {
            functions.integrands(point, &mut integrands);
        }
        let function = "continuous";
        ask_list(function, "rates", &formulation.states, &rates, t)?;
        ask_list(function, "path", &formulation.path, &path, t)?;
        ask_list(function, "", &cost("running cost"), &[value], t)?;
        let integrals = &formulation.integrals;
        ask_list("integrands", "integrands", integrals, &integrands, t)?;
    }
    let last = start.mesh.points();
    let mut rows = untouched(formulation.boundary.len());
    let integrals = integrals(ocp, formulation, start);
    let ends = Ends {
        integrals: &integrals,
        ..start.ends()
    };
    let value = functions.boundary(ends, &mut rows);
    ask_list(
        "boundary",
        "rows",
        &formulation.boundary,
        &rows,
        times[last],
    )?;
    ask_list(
        "boundary",
        "",
        &cost("terminal cost"),
        &[value],
        times[last],
    )?;
    for (way_point, point) in formulation.way_points.iter().enumerate() {
        let Some(k) = start.mesh.node_at(point.fraction) else {
            continue;
        };
        let mut rows = untouched(point.rows.len());
        let passed = InteriorPoint {
            way_point,
            x: start.state(k),
            parameters: &start.parameters,
            t: times[k],
        };
        functions.way_point(passed, &mut rows);
        ask_list("way_point", "rows", &point.rows, &rows, passed.t)?;
    }
    Ok(())
}
