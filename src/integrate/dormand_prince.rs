//! Adaptive Dormand-Prince 5(4) integration.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential Equations I", table II.5.2,
//! step control of section II.4.

use super::ode::{IntegrationError, Ode};
use super::steps::Steps;

/// The integrator with its workspace; the step found lasts from one interval to the next.
#[derive(Debug)]
pub struct DormandPrince {
    /// Tolerance relative to each component.
    pub relative: f64,
    /// Absolute tolerance.
    pub absolute: f64,
    steps: Steps,
    stages: [Vec<f64>; 7],
    trial: Vec<f64>,
}

/// Part of what would change the state by as much as it is, for a first step.
const CAUTION: f64 = 1e-3;

const C: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
const A: [&[f64]; 7] = [
    &[],
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ],
    &[
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    // The last row is the solution itself: its rate serves the next step.
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// Fifth minus fourth order weights.
const E: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

impl DormandPrince {
    /// An integrator of `size` equations, with at most `max_steps` steps, taken or rejected.
    pub fn new(size: usize, relative: f64, absolute: f64, max_steps: usize) -> Self {
        Self {
            relative,
            absolute,
            steps: Steps::new(max_steps),
            stages: std::array::from_fn(|_| vec![0.0; size]),
            trial: vec![0.0; size],
        }
    }

    /// Steps taken so far.
    pub fn taken(&self) -> usize {
        self.steps.taken()
    }

    /// Carries `y` from `start` to `end` exactly. `fresh` says that the right-hand side is not the
    /// one of the interval before; `accepted` sees the state after every step taken.
    ///
    /// # Errors
    /// [`IntegrationError`] where the interval cannot be crossed.
    pub fn advance<O: Ode>(
        &mut self,
        ode: &mut O,
        [start, end]: [f64; 2],
        y: &mut [f64],
        fresh: bool,
        mut accepted: impl FnMut(&mut O, &[f64]),
    ) -> Result<(), IntegrationError<O::Error>> {
        if fresh {
            ode.rate(start, y, &mut self.stages[0])
                .map_err(|e| IntegrationError::Rate(start, e))?;
        }
        let rates = &self.stages[0];
        self.steps.begin(CAUTION, y, rates, end - start);
        let mut t = start;
        while t < end {
            let step = self.steps.at(t, [start, end])?;
            let h = step.length;
            let error = self.attempt(ode, t, h, y);
            let factor = (0.9 * error.powf(-0.2)).clamp(0.2, 5.0);
            if error > 1.0 {
                self.steps.reject(step, factor);
                continue;
            }
            self.steps.accept(step, factor);
            t = if step.last { end } else { t + h };
            y.copy_from_slice(&self.trial);
            self.stages.swap(0, 6);
            accepted(ode, y);
        }
        Ok(())
    }

    /// Error of a trial step relative to the tolerance; infinite where it has none.
    fn attempt<O: Ode>(&mut self, ode: &mut O, t: f64, h: f64, y: &[f64]) -> f64 {
        for i in 1..7 {
            let (known, new) = self.stages.split_at_mut(i);
            for (k, trial) in self.trial.iter_mut().enumerate() {
                let slope: f64 = A[i]
                    .iter()
                    .zip(&*known)
                    .map(|(a, stage)| a * stage[k])
                    .sum();
                *trial = y[k] + h * slope;
            }
            // A shorter step may get by where a wild trial state has no rate.
            if ode.rate(t + C[i] * h, &self.trial, &mut new[0]).is_err() {
                return f64::INFINITY;
            }
        }
        let mut sum = 0.0;
        for (k, trial) in self.trial.iter().enumerate() {
            let error: f64 = E
                .iter()
                .zip(&self.stages)
                .map(|(e, stage)| e * stage[k])
                .sum();
            let scale = self.absolute + self.relative * y[k].abs().max(trial.abs());
            sum += (h * error / scale).powi(2);
        }
        let error = (sum / y.len() as f64).sqrt();
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ẏ = y² with the solution 1/(1 − t), which ends at t = 1.
    struct Blowup;

    impl Ode for Blowup {
        type Error = ();

        fn rate(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), ()> {
            dy[0] = y[0] * y[0];
            Ok(())
        }
    }

    #[test]
    fn the_integrator_meets_its_tolerance_and_says_where_it_stops() {
        let mut y = [1.0];
        let mut integrator = DormandPrince::new(1, 1e-10, 1e-12, 100_000);
        integrator
            .advance(&mut Blowup, [0.0, 0.5], &mut y, true, |_, _| {})
            .unwrap();
        integrator
            .advance(&mut Blowup, [0.5, 0.9], &mut y, false, |_, _| {})
            .unwrap();
        assert!((y[0] / 10.0 - 1.0).abs() < 1e-8, "{y:?}");
        assert!(integrator.taken() < 1000);
        let error = integrator
            .advance(&mut Blowup, [0.9, 2.0], &mut y, false, |_, _| {})
            .unwrap_err();
        let IntegrationError::StepUnderflow(t) = error else {
            panic!("{error:?}")
        };
        assert!((t - 1.0).abs() < 1e-6, "{t}");
    }
}
