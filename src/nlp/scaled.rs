//! A programme in other units: each variable and each row in one of its own.

use super::{Iterate, Nlp, Size, Undefined};

/// What counts as one in every variable and every row of a programme.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Of the variables, all above zero.
    pub variables: Vec<f64>,
    /// Of the constraint rows, all above zero.
    pub rows: Vec<f64>,
}

impl Units {
    /// Whether nothing changes in them.
    pub fn are_one(&self) -> bool {
        self.variables.iter().chain(&self.rows).all(|&s| s == 1.0)
    }

    /// `iterate`, which is in the programme's own units, in these.
    pub fn scaled(&self, iterate: &Iterate) -> Iterate {
        self.convert(
            iterate,
            |value, unit| value / unit,
            |dual, unit| dual * unit,
        )
    }

    /// The converse of [`Units::scaled`].
    pub fn unscaled(&self, iterate: &Iterate) -> Iterate {
        self.convert(
            iterate,
            |value, unit| value * unit,
            |dual, unit| dual / unit,
        )
    }

    fn convert(
        &self,
        from: &Iterate,
        primal: fn(f64, f64) -> f64,
        dual: fn(f64, f64) -> f64,
    ) -> Iterate {
        // Multipliers may be left out, which is an empty list.
        let all = |values: &[f64], units: &[f64], by: fn(f64, f64) -> f64| {
            let pairs = values.iter().zip(units);
            pairs.map(|(&value, &unit)| by(value, unit)).collect()
        };
        Iterate {
            x: all(&from.x, &self.variables, primal),
            multipliers: all(&from.multipliers, &self.rows, dual),
            lower_multipliers: all(&from.lower_multipliers, &self.variables, dual),
            upper_multipliers: all(&from.upper_multipliers, &self.variables, dual),
        }
    }
}

/// A programme seen in [`Units`]: variables x/s, rows g/r.
///
/// Multipliers become λ·r and z·s, first derivatives of a row by a variable s/r of what they were.
/// The objective stays as it is.
#[derive(Debug)]
pub struct Scaled<'a, N> {
    inner: &'a mut N,
    units: &'a Units,
    /// Factor of each nonzero of the Jacobian.
    jacobian: Vec<f64>,
    /// Factor of each nonzero of the Hessian.
    hessian: Vec<f64>,
    x: Vec<f64>,
    multipliers: Vec<f64>,
}

impl<'a, N: Nlp> Scaled<'a, N> {
    /// `inner` in `units`.
    ///
    /// # Panics
    /// Where there are not as many units as variables and rows.
    pub fn new(inner: &'a mut N, units: &'a Units) -> Self {
        let size = inner.size();
        assert!(
            units.variables.len() == size.variables && units.rows.len() == size.constraints,
            "a unit for every variable and row"
        );
        let factors = |count: usize,
                       structure: &dyn Fn(&mut [usize], &mut [usize]),
                       factor: &dyn Fn(usize, usize) -> f64| {
            let (mut rows, mut columns) = (vec![0; count], vec![0; count]);
            structure(&mut rows, &mut columns);
            let places = rows.into_iter().zip(columns);
            places.map(|(i, j)| factor(i, j)).collect::<Vec<f64>>()
        };
        let of = &units.variables;
        Self {
            jacobian: factors(
                size.jacobian_nonzeros,
                &|rows, columns| inner.jacobian_structure(rows, columns),
                &|row, column| of[column] / units.rows[row],
            ),
            hessian: factors(
                size.hessian_nonzeros,
                &|rows, columns| inner.hessian_structure(rows, columns),
                &|row, column| of[row] * of[column],
            ),
            x: vec![0.0; size.variables],
            multipliers: vec![0.0; size.constraints],
            inner,
            units,
        }
    }

    /// Loads the variables in their own units.
    fn load(&mut self, x: &[f64]) {
        multiply(&mut self.x, x, &self.units.variables);
    }
}

fn multiply(to: &mut [f64], values: &[f64], factors: &[f64]) {
    for ((to, value), factor) in to.iter_mut().zip(values).zip(factors) {
        *to = value * factor;
    }
}

fn multiply_in_place(values: &mut [f64], factors: &[f64]) {
    for (value, factor) in values.iter_mut().zip(factors) {
        *value *= factor;
    }
}

fn divide(values: &mut [f64], units: &[f64]) {
    for (value, unit) in values.iter_mut().zip(units) {
        *value /= unit;
    }
}

impl<N: Nlp> Nlp for Scaled<'_, N> {
    fn size(&self) -> Size {
        self.inner.size()
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        self.inner.variable_bounds(lower, upper);
        divide(lower, &self.units.variables);
        divide(upper, &self.units.variables);
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        self.inner.constraint_bounds(lower, upper);
        divide(lower, &self.units.rows);
        divide(upper, &self.units.rows);
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        self.inner.jacobian_structure(rows, columns);
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        self.inner.hessian_structure(rows, columns);
    }

    fn new_point(&mut self) {
        self.inner.new_point();
    }

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        self.load(x);
        self.inner.objective(&self.x)
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        self.load(x);
        self.inner.gradient(&self.x, gradient)?;
        multiply_in_place(gradient, &self.units.variables);
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        self.load(x);
        self.inner.constraints(&self.x, values)?;
        divide(values, &self.units.rows);
        Ok(())
    }

    fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        self.load(x);
        self.inner.jacobian(&self.x, values)?;
        multiply_in_place(values, &self.jacobian);
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        self.load(x);
        self.multipliers.copy_from_slice(multipliers);
        divide(&mut self.multipliers, &self.units.rows);
        self.inner
            .hessian(&self.x, sigma, &self.multipliers, values)?;
        multiply_in_place(values, &self.hessian);
        Ok(())
    }

    fn variable_name(&self, index: usize) -> String {
        self.inner.variable_name(index)
    }

    fn constraint_name(&self, index: usize) -> String {
        self.inner.constraint_name(index)
    }
}
