//! Programmes with known answers.

use ffsm_ipopt::nlp::{Nlp, Size, Undefined};

pub type Scalar = fn(&[f64]) -> f64;
pub type Vector = fn(&[f64], &mut [f64]);
pub type Lagrangian = fn(&[f64], f64, &[f64], &mut [f64]);

/// A small programme with dense matrices, that watches how it is called.
pub struct Dense {
    pub variables: [Vec<f64>; 2],
    pub constraints: [Vec<f64>; 2],
    pub f: Scalar,
    pub df: Vector,
    pub g: Vector,
    /// Row by row.
    pub dg: Vector,
    /// Lower triangle, row by row.
    pub h: Lagrangian,
    /// Panics in the evaluation with this number, counted from 0.
    pub panic_at: Option<u32>,
    /// Hessians from this number on, counted from 0, are not finite in the first attempt, and no
    /// error says so.
    pub bad_hessian: Option<u32>,
    /// Where the first Hessian was asked for, and how often: once for each attempt.
    pub first: (Vec<f64>, u32),
    pub hessians: u32,
    pub evaluations: u32,
    pub undefined: u32,
    pub new_points: u32,
    pub started: bool,
}

impl Dense {
    pub fn new(f: Scalar, df: Vector, h: Lagrangian, bounds: [Vec<f64>; 2]) -> Self {
        Self {
            variables: bounds,
            constraints: [vec![], vec![]],
            f,
            df,
            g: |_, _| {},
            dg: |_, _| {},
            h,
            panic_at: None,
            bad_hessian: None,
            first: (Vec::new(), 0),
            hessians: 0,
            evaluations: 0,
            undefined: 0,
            new_points: 0,
            started: false,
        }
    }

    pub fn subject_to(mut self, g: Vector, dg: Vector, bounds: [Vec<f64>; 2]) -> Self {
        (self.g, self.dg, self.constraints) = (g, dg, bounds);
        self
    }

    pub fn n(&self) -> usize {
        self.variables[0].len()
    }

    pub fn m(&self) -> usize {
        self.constraints[0].len()
    }

    pub fn check(&mut self, values: &[f64]) -> Result<(), Undefined> {
        assert!(self.started, "new_point comes before the first evaluation");
        self.evaluations += 1;
        if self.panic_at == Some(self.evaluations - 1) {
            panic!("deliberate {}", self.evaluations - 1);
        }
        if values.iter().all(|value| value.is_finite()) {
            return Ok(());
        }
        self.undefined += 1;
        Err(Undefined {
            function: "test function",
        })
    }
}

impl Nlp for Dense {
    fn size(&self) -> Size {
        Size {
            variables: self.n(),
            constraints: self.m(),
            jacobian_nonzeros: self.n() * self.m(),
            hessian_nonzeros: self.n() * (self.n() + 1) / 2,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.copy_from_slice(&self.variables[0]);
        upper.copy_from_slice(&self.variables[1]);
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.copy_from_slice(&self.constraints[0]);
        upper.copy_from_slice(&self.constraints[1]);
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        for (entry, (row, column)) in rows.iter_mut().zip(columns).enumerate() {
            (*row, *column) = (entry / self.n(), entry % self.n());
        }
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        let lower = (0..self.n()).flat_map(|row| (0..=row).map(move |column| (row, column)));
        for (entry, (row, column)) in lower.enumerate() {
            (rows[entry], columns[entry]) = (row, column);
        }
    }

    fn new_point(&mut self) {
        self.started = true;
        self.new_points += 1;
    }

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        let value = (self.f)(x);
        self.check(&[value]).map(|()| value)
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        (self.df)(x, gradient);
        self.check(gradient)
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        (self.g)(x, values);
        self.check(values)
    }

    fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        (self.dg)(x, values);
        self.check(values)
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        (self.h)(x, sigma, multipliers, values);
        self.check(values)?;
        if self.hessians == 0 {
            self.first.0 = x.to_vec();
        }
        self.first.1 += u32::from(self.first.0 == x);
        let bad = self.bad_hessian.is_some_and(|bad| self.hessians >= bad);
        if bad && self.first.1 == 1 {
            values[0] = f64::NAN;
        }
        self.hessians += 1;
        Ok(())
    }

    fn variable_name(&self, index: usize) -> String {
        format!("length {index}")
    }

    fn constraint_name(&self, index: usize) -> String {
        format!("row {index}")
    }
}

/// Problem 71 of Hock and Schittkowski.
pub fn hs071() -> Dense {
    Dense::new(
        |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2],
        |x, d| {
            let sum = x[0] + x[1] + x[2];
            d.copy_from_slice(&[
                x[3] * (x[0] + sum),
                x[0] * x[3],
                x[0] * x[3] + 1.0,
                x[0] * sum,
            ]);
        },
        |x, sigma, l, h| {
            h.copy_from_slice(&[
                sigma * 2.0 * x[3] + 2.0 * l[1],
                sigma * x[3] + l[0] * x[2] * x[3],
                2.0 * l[1],
                sigma * x[3] + l[0] * x[1] * x[3],
                l[0] * x[0] * x[3],
                2.0 * l[1],
                sigma * (2.0 * x[0] + x[1] + x[2]) + l[0] * x[1] * x[2],
                sigma * x[0] + l[0] * x[0] * x[2],
                sigma * x[0] + l[0] * x[0] * x[1],
                2.0 * l[1],
            ]);
        },
        [vec![1.0; 4], vec![5.0; 4]],
    )
    .subject_to(
        |x, g| {
            g[0] = x[0] * x[1] * x[2] * x[3];
            g[1] = x.iter().map(|x| x * x).sum();
        },
        |x, d| {
            for j in 0..4 {
                d[j] = (0..4).filter(|&k| k != j).map(|k| x[k]).product();
                d[4 + j] = 2.0 * x[j];
            }
        },
        [vec![25.0, 40.0], vec![f64::INFINITY, 40.0]],
    )
}

pub const HS071_START: [f64; 4] = [1.0, 5.0, 5.0, 1.0];
pub const HS071_OPTIMUM: [f64; 4] = [1.0, 4.7429994, 3.8211503, 1.3794082];

/// The banana-shaped valley, without constraints.
pub fn rosenbrock() -> Dense {
    Dense::new(
        |x| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2),
        |x, d| {
            let valley = x[1] - x[0] * x[0];
            d.copy_from_slice(&[-2.0 * (1.0 - x[0]) - 400.0 * x[0] * valley, 200.0 * valley]);
        },
        |x, sigma, _, h| {
            h[0] = sigma * (2.0 - 400.0 * (x[1] - 3.0 * x[0] * x[0]));
            h[1] = sigma * -400.0 * x[0];
            h[2] = sigma * 200.0;
        },
        free(2),
    )
}

/// Minimise x − log x, undefined from zero down; a full Newton step from 3 leads to −3.
pub fn logarithm() -> Dense {
    Dense::new(
        |x| x[0] - x[0].ln(),
        |x, d| {
            d[0] = if x[0] > 0.0 {
                1.0 - 1.0 / x[0]
            } else {
                f64::NAN
            }
        },
        |x, sigma, _, h| h[0] = sigma / (x[0] * x[0]),
        free(1),
    )
}

pub fn free(n: usize) -> [Vec<f64>; 2] {
    [vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]]
}

/// A chain of coupled valleys, large enough that its linear algebra takes time.
pub struct Chain {
    pub points: usize,
    /// Whether to give the Hessian's upper triangle by mistake.
    pub upper: bool,
}

impl Nlp for Chain {
    fn size(&self) -> Size {
        Size {
            variables: self.points,
            constraints: 0,
            jacobian_nonzeros: 0,
            hessian_nonzeros: 2 * self.points - 1,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(-10.0);
        upper.fill(10.0);
    }

    fn constraint_bounds(&self, _: &mut [f64], _: &mut [f64]) {}

    fn jacobian_structure(&self, _: &mut [usize], _: &mut [usize]) {}

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        for i in 0..self.points {
            (rows[i], columns[i]) = (i, i);
        }
        for i in 1..self.points {
            let entry = self.points + i - 1;
            let (row, column) = if self.upper { (i - 1, i) } else { (i, i - 1) };
            (rows[entry], columns[entry]) = (row, column);
        }
    }

    fn new_point(&mut self) {}

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        let valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        Ok(x.windows(2).map(valley).sum())
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        gradient.fill(0.0);
        for i in 1..x.len() {
            let valley = x[i] - x[i - 1] * x[i - 1];
            gradient[i - 1] += -2.0 * (1.0 - x[i - 1]) - 400.0 * x[i - 1] * valley;
            gradient[i] += 200.0 * valley;
        }
        Ok(())
    }

    fn constraints(&mut self, _: &[f64], _: &mut [f64]) -> Result<(), Undefined> {
        Ok(())
    }

    fn jacobian(&mut self, _: &[f64], _: &mut [f64]) -> Result<(), Undefined> {
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        _: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        values.fill(0.0);
        for i in 1..x.len() {
            let curvature = 2.0 - 400.0 * (x[i] - 3.0 * x[i - 1] * x[i - 1]);
            values[i - 1] += sigma * curvature;
            values[i] += sigma * 200.0;
            values[x.len() + i - 1] = sigma * -400.0 * x[i - 1];
        }
        Ok(())
    }
}

/// A long valley, min 1000 (x₁ − x₀²)² + (1 − x₀)², with two rows that are the same once y = x₃ has
/// left its start.
pub fn valley_with_a_row_twice() -> Dense {
    Dense::new(
        |x| {
            let across = x[1] - x[0] * x[0];
            1e3 * across * across + (1.0 - x[0]).powi(2) + (x[3] - 0.2).powi(2)
        },
        |x, d| {
            let across = x[1] - x[0] * x[0];
            d[0] = -4e3 * x[0] * across - 2.0 * (1.0 - x[0]);
            d[1] = 2e3 * across;
            d[2] = 0.0;
            d[3] = 2.0 * (x[3] - 0.2);
        },
        |x, sigma, _, h| {
            h.fill(0.0);
            h[0] = sigma * (1e3 * (12.0 * x[0] * x[0] - 4.0 * x[1]) + 2.0);
            h[1] = sigma * -4e3 * x[0];
            h[2] = sigma * 2e3;
            h[9] = sigma * 2.0;
        },
        free(4),
    )
    .subject_to(
        |x, g| {
            let more = if x[3] > 0.6 { x[3] - 0.5 } else { 0.0 };
            g.copy_from_slice(&[x[2] - 1.0, x[2] - 1.0 + more]);
        },
        |x, d| {
            let more = f64::from(x[3] > 0.6);
            d.copy_from_slice(&[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, more]);
        },
        [vec![0.0; 2], vec![0.0; 2]],
    )
}

pub const VALLEY_START: [f64; 4] = [-1.9, 2.0, 0.0, 1.0];
pub const VALLEY_OPTIMUM: [f64; 4] = [1.0, 1.0, 1.0, 0.2];
