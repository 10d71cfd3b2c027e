//! The lengths of steps, and how many were tried.

use super::ode::IntegrationError;

/// Steps of an adaptive method; the length found lasts from one interval to the next.
#[derive(Debug)]
pub(super) struct Steps {
    /// Most steps allowed, taken or rejected.
    most: usize,
    taken: usize,
    rejected: usize,
    /// Length of the next one; zero where none is known.
    next: f64,
}

/// A step to be tried.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub length: f64,
    /// Whether it ends with the interval.
    pub last: bool,
}

impl Steps {
    pub fn new(most: usize) -> Self {
        Self {
            most,
            taken: 0,
            rejected: 0,
            next: 0.0,
        }
    }

    pub fn taken(&self) -> usize {
        self.taken
    }

    /// The next step in another unit of time, `ratio` old ones long.
    pub fn change_unit(&mut self, ratio: f64) {
        self.next /= ratio;
    }

    /// A first step from the size of the rates at `y`, where none is known: by the part `caution` of what
    /// would change y by as much as it is.
    pub fn begin(&mut self, caution: f64, y: &[f64], rates: &[f64], span: f64) {
        if self.next != 0.0 {
            return;
        }
        let mut worst: f64 = 0.0;
        for (value, rate) in y.iter().zip(rates) {
            worst = worst.max(rate.abs() / (1e-3 + value.abs()));
        }
        self.next = (caution / worst).min(10.0 * caution * span);
    }

    /// The step to try from `t` on.
    pub fn at<E>(&self, t: f64, [start, end]: [f64; 2]) -> Result<Step, IntegrationError<E>> {
        if self.taken + self.rejected >= self.most {
            return Err(IntegrationError::StepLimit(t));
        }
        // A step that almost reaches the end is stretched to it.
        let last = t + 1.01 * self.next >= end;
        let length = if last { end - t } else { self.next };
        match length > 4.0 * f64::EPSILON * start.abs().max(end.abs()) {
            true => Ok(Step { length, last }),
            false => Err(IntegrationError::StepUnderflow(t)),
        }
    }

    /// `step` was taken; the next may be longer by `factor`.
    pub fn accept(&mut self, step: Step, factor: f64) {
        self.taken += 1;
        let next = step.length * factor;
        // A step cut short by the end says nothing against the longer one.
        self.next = if step.last { self.next.max(next) } else { next };
    }

    /// `step` was too long; the next is shorter by `factor`.
    pub fn reject(&mut self, step: Step, factor: f64) {
        self.rejected += 1;
        self.next = step.length * factor.min(1.0);
    }
}
