//! What counts as one in every quantity of a problem.
//!
//! Derived in docs/algorithms.md#scales.

use super::Layout;
use super::ranges::{Ranges, Typed, magnitude};
use crate::nlp::Units;
use crate::ocp::{Formulation, Quantity};

/// A quantity whose size is within this factor of one has the scale one.
const NEAR_ONE: f64 = 64.0;

/// Part of its scale below which what is left of a quantity may be rounding.
const NOISE: f64 = 1e-7;

/// Scales of all quantities, in the order of the formulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Scales {
    states: Vec<Scale>,
    controls: Vec<Scale>,
    path: Vec<Scale>,
    boundary: Vec<Scale>,
    way_points: Vec<Vec<Scale>>,
    parameters: Vec<Scale>,
    integrals: Vec<Scale>,
    /// Of the duration, and of t₀ and t_f with it.
    duration: Scale,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Scale {
    value: f64,
    basis: Basis,
}

/// What a scale was made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Basis {
    /// Given by the problem.
    Given,
    /// The formulation's bounds and ends.
    Typed,
    /// Nothing but the trajectory.
    Seen,
}

impl Scales {
    /// Those of `formulation`, which has no bounds that are far from `ranges`: what a quantity says
    /// itself, else the size of what its ends fix it to, else of its bounds, and of its values where
    /// these are larger.
    ///
    /// A size between 1/64 and 64 gives the scale 1, any other the power of two nearest to it, so
    /// that nothing is rounded.
    pub fn new(formulation: &Formulation, ranges: &Ranges) -> Self {
        let typed = Typed::of(formulation);
        let many = |quantities: &[Quantity], ranges: &[crate::ocp::Interval]| -> Vec<Scale> {
            let pairs = quantities.iter().zip(ranges);
            pairs
                .map(|(quantity, range)| of(quantity, 0.0, magnitude(range)))
                .collect()
        };
        let points = formulation.way_points.iter().zip(&ranges.way_points);
        Self {
            states: (formulation.states.iter().zip(&ranges.states).zip(&typed.0))
                .map(|((state, range), &end)| of(state, end, magnitude(range)))
                .collect(),
            controls: many(&formulation.controls, &ranges.controls),
            path: many(&formulation.path, &ranges.path),
            boundary: many(&formulation.boundary, &ranges.boundary),
            way_points: points
                .map(|(point, ranges)| many(&point.rows, ranges))
                .collect(),
            parameters: many(&formulation.parameters, &ranges.parameters),
            integrals: many(&formulation.integrals, &ranges.integrals),
            duration: Scale {
                value: rounded(ranges.duration),
                basis: Basis::Typed,
            },
        }
    }

    /// These after a solution: larger where it is much larger, smaller where nothing but the first
    /// trajectory told the size. `None` where nothing changes.
    pub fn after(&self, ranges: &Ranges) -> Option<Self> {
        let many = |scales: &[Scale], ranges: &[crate::ocp::Interval]| -> Vec<Scale> {
            let pairs = scales.iter().zip(ranges);
            pairs
                .map(|(scale, range)| scale.after(magnitude(range)))
                .collect()
        };
        let points = self.way_points.iter().zip(&ranges.way_points);
        let next = Self {
            states: many(&self.states, &ranges.states),
            controls: many(&self.controls, &ranges.controls),
            path: many(&self.path, &ranges.path),
            boundary: many(&self.boundary, &ranges.boundary),
            way_points: points
                .map(|(scales, ranges)| many(scales, ranges))
                .collect(),
            parameters: many(&self.parameters, &ranges.parameters),
            integrals: many(&self.integrals, &ranges.integrals),
            duration: self.duration.after(ranges.duration),
        };
        (next != *self).then_some(next)
    }

    /// Whether one of these is smaller than that of `other`.
    pub fn any_below(&self, other: &Self) -> bool {
        let below = |a: &[Scale], b: &[Scale]| a.iter().zip(b).any(|(a, b)| a.value < b.value);
        below(&self.states, &other.states)
            || below(&self.controls, &other.controls)
            || below(&self.parameters, &other.parameters)
            || below(&self.integrals, &other.integrals)
            || below(&[self.duration], &[other.duration])
    }

    /// Those of the states.
    pub fn states(&self) -> Vec<f64> {
        values(&self.states).collect()
    }

    /// Those of the integrals.
    pub fn integrals(&self) -> Vec<f64> {
        values(&self.integrals).collect()
    }

    /// Units of the programme of `layout`.
    pub fn units(&self, layout: &Layout) -> Units {
        let mut units = Units {
            variables: vec![1.0; layout.variables()],
            rows: vec![1.0; layout.rows()],
        };
        for k in 0..=layout.points {
            set(&mut units.variables, layout.state(k, 0), &self.states);
            if k < layout.points {
                set(&mut units.variables, layout.control(k, 0), &self.controls);
                set(&mut units.rows, layout.defect(k, 0), &self.states);
                set(&mut units.rows, layout.path(k, 0), &self.path);
            }
        }
        if layout.free_duration {
            units.variables[layout.duration()] = self.duration.value;
        }
        if layout.free_initial_time {
            units.variables[layout.initial_time()] = self.duration.value;
        }
        set(&mut units.variables, layout.parameter(0), &self.parameters);
        set(&mut units.variables, layout.integral(0), &self.integrals);
        set(&mut units.rows, layout.integral_row(0), &self.integrals);
        if layout.bounded_final_time {
            units.rows[layout.final_time_row()] = self.duration.value;
        }
        for (w, scales) in self.way_points.iter().enumerate() {
            set(&mut units.rows, layout.way_point(w, 0), scales);
        }
        set(&mut units.rows, layout.boundary(0), &self.boundary);
        units
    }
}

impl Scale {
    fn after(self, seen: f64) -> Self {
        let larger = seen > NEAR_ONE * self.value;
        let smaller = self.basis == Basis::Seen
            && (NOISE * self.value..self.value / NEAR_ONE).contains(&seen);
        match self.basis != Basis::Given && (larger || smaller) {
            true => Self {
                value: rounded(seen),
                ..self
            },
            false => self,
        }
    }
}

fn values(scales: &[Scale]) -> impl Iterator<Item = f64> + '_ {
    scales.iter().map(|scale| scale.value)
}

fn set(units: &mut [f64], first: usize, scales: &[Scale]) {
    for (unit, value) in units[first..].iter_mut().zip(values(scales)) {
        *unit = value;
    }
}

/// The scale of a quantity fixed to `end` somewhere and `seen` elsewhere.
fn of(quantity: &Quantity, end: f64, seen: f64) -> Scale {
    let typed = match end {
        // Bounds of what has a value somewhere are often far from it.
        0.0 => magnitude(&quantity.bounds),
        end => end,
    };
    let (value, basis) = match quantity.scale {
        Some(given) => (given, Basis::Given),
        None if typed > 0.0 => (rounded(typed.max(seen)), Basis::Typed),
        // A small value may be rounding.
        None => (rounded(seen.max(1.0)), Basis::Seen),
    };
    Scale { value, basis }
}

/// One where `size` is near one, or zero; else the nearest power of two.
fn rounded(size: f64) -> f64 {
    let near = (1.0 / NEAR_ONE..=NEAR_ONE).contains(&size);
    if near || !(size.is_finite() && size > 0.0) {
        return 1.0;
    }
    // Squares of scales stay far from overflow.
    size.log2().round().clamp(-400.0, 400.0).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ocp::Interval;

    #[test]
    fn a_size_near_one_is_one_and_any_other_a_power_of_two() {
        for size in [0.0, 1.0, 0.05, 64.0, f64::NAN, f64::INFINITY] {
            assert_eq!(rounded(size), 1.0, "{size}");
        }
        assert_eq!(rounded(2.6e5), 262_144.0);
        assert_eq!(rounded(1e-3), 1.0 / 1024.0);
    }

    #[test]
    fn a_scale_is_given_or_typed_or_seen() {
        let free = Quantity::new("x", Interval::FREE);
        let bounded = Quantity::new("x", Interval::new(0.0, 1e5));
        let given = Quantity::new("x", Interval::FREE).scaled(3.0);
        assert_eq!(of(&given, 1e6, 1e7).value, 3.0);
        assert_eq!(of(&bounded, 0.0, 1.0).value, 131_072.0);
        assert_eq!(of(&bounded, 100.0, 2e4).value, 16_384.0);
        assert_eq!(of(&bounded, 100.0, 1.0).value, 128.0);
        assert_eq!(of(&free, 2e-6, 0.0).value, 2f64.powi(-19));
        // A small guess may be rounding, a small solution of the same order is not.
        let unknown = of(&free, 0.0, 1e-5);
        assert_eq!(unknown.value, 1.0);
        assert_eq!(unknown.after(1e-5).value, 2f64.powi(-17));
        assert_eq!(unknown.after(1e-9).value, 1.0);
        assert_eq!(of(&free, 1.0, 0.0).after(1e-5).value, 1.0);
        assert_eq!(of(&free, 1.0, 0.0).after(1e5).value, 131_072.0);
        assert_eq!(of(&given, 0.0, 0.0).after(1e5).value, 3.0);
    }
}
