//! Adaptive integration of eighth order, DOP853, with an interpolation of seventh within each step.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential Equations I", section II.5 and
//! II.6. To tight tolerances it takes a third of the evaluations of a method of fifth order, and its
//! steps need not end where a value is asked for.
//!
//! | file | has |
//! | --- | --- |
//! | `coefficients` | the numbers of the method |
//! | `interpolation` | values within a step |

mod coefficients;
mod interpolation;

use super::ode::{IntegrationError, Ode};
use super::steps::Steps;
use coefficients::{A, ALL, C, E3, E5, STAGES, combine};
use interpolation::Interpolation;
use std::ops::ControlFlow;

/// Part of what would change the state by as much as it is, for a first step.
const CAUTION: f64 = 1e-2;

/// What [`Dop853::advance`] has come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reached<'y> {
    /// The end of a step, with the state there.
    Step(&'y [f64]),
    /// The node of this number, with the state there.
    Node(usize, &'y [f64]),
}

/// The integrator with its workspace; the step found lasts from one interval to the next.
#[derive(Debug)]
pub struct Dop853 {
    /// Tolerance relative to each component.
    pub relative: f64,
    /// Absolute tolerance.
    pub absolute: f64,
    steps: Steps,
    /// Rates of all stages, one after the other.
    stages: Vec<f64>,
    trial: Vec<f64>,
    /// Sums of stages: the two error estimates, one after the other.
    errors: Vec<f64>,
    interpolation: Interpolation,
}

impl Dop853 {
    /// An integrator of `size` equations, with at most `max_steps` steps, taken or rejected.
    pub fn new(size: usize, relative: f64, absolute: f64, max_steps: usize) -> Self {
        Self {
            relative,
            absolute,
            steps: Steps::new(max_steps),
            stages: vec![0.0; ALL * size],
            trial: vec![0.0; size],
            errors: vec![0.0; 2 * size],
            interpolation: Interpolation::new(size),
        }
    }

    /// Steps taken so far.
    pub fn taken(&self) -> usize {
        self.steps.taken()
    }

    /// The next step in another unit of time, `ratio` old ones long.
    pub fn change_unit(&mut self, ratio: f64) {
        self.steps.change_unit(ratio);
    }

    /// Carries `y` from the first of `nodes`, which rise, to the last; the right-hand side is smooth in
    /// between. `see` is told every step and every node after the first, in the order of time, and may
    /// break off.
    ///
    /// # Errors
    /// [`IntegrationError`] where the interval cannot be crossed.
    pub fn advance<O: Ode>(
        &mut self,
        ode: &mut O,
        nodes: &[f64],
        y: &mut [f64],
        mut see: impl FnMut(&mut O, Reached<'_>) -> ControlFlow<()>,
    ) -> Result<(), IntegrationError<O::Error>> {
        let (&[start, ..], &[.., end]) = (nodes, nodes) else {
            return Ok(());
        };
        let size = y.len();
        ode.rate(start, y, &mut self.stages[..size])
            .map_err(|e| IntegrationError::Rate(start, e))?;
        let rates = &self.stages[..size];
        self.steps.begin(CAUTION, y, rates, end - start);
        let (mut t, mut next) = (start, 1);
        while t < end {
            let step = self.steps.at(t, [start, end])?;
            let h = step.length;
            let error = self.attempt(ode, t, h, y);
            let factor = (0.9 * error.powf(-0.125)).clamp(1.0 / 3.0, 6.0);
            if error > 1.0 {
                self.steps.reject(step, factor);
                continue;
            }
            self.steps.accept(step, factor);
            let reached = if step.last { end } else { t + h };
            let inside = nodes[next..].iter().take_while(|&&node| node < reached);
            let inside = inside.count();
            if inside > 0 {
                self.interpolate(ode, t, h, y)
                    .map_err(|e| IntegrationError::Rate(t, e))?;
            }
            for &node in &nodes[next..next + inside] {
                let value = self.interpolation.at((node - t) / h, y);
                if see(ode, Reached::Node(next, value)).is_break() {
                    return Ok(());
                }
                next += 1;
            }
            y.copy_from_slice(&self.trial);
            self.stages
                .copy_within((STAGES - 1) * size..STAGES * size, 0);
            t = reached;
            if see(ode, Reached::Step(y)).is_break() {
                return Ok(());
            }
            if nodes.get(next).is_some_and(|&node| node <= reached) {
                if see(ode, Reached::Node(next, y)).is_break() {
                    return Ok(());
                }
                next += 1;
            }
        }
        Ok(())
    }

    /// Error of a trial step relative to the tolerance; infinite where it has none.
    fn attempt<O: Ode>(&mut self, ode: &mut O, t: f64, h: f64, y: &[f64]) -> f64 {
        for stage in 1..STAGES {
            // A shorter step may get by where a wild trial state has no rate.
            if self.rate(ode, stage, (t, h), y).is_err() {
                return f64::INFINITY;
            }
        }
        let size = y.len();
        let (fifth, third) = self.errors.split_at_mut(size);
        combine(E5, &self.stages, fifth);
        combine(E3, &self.stages, third);
        let [mut by_fifth, mut by_third] = [0.0; 2];
        for (k, trial) in self.trial.iter().enumerate() {
            let scale = self.absolute + self.relative * y[k].abs().max(trial.abs());
            by_fifth += (fifth[k] / scale).powi(2);
            by_third += (third[k] / scale).powi(2);
        }
        if by_fifth == 0.0 {
            return if by_third.is_nan() {
                f64::INFINITY
            } else {
                0.0
            };
        }
        let error = h * by_fifth / ((by_fifth + 0.01 * by_third) * size as f64).sqrt();
        if error.is_nan() { f64::INFINITY } else { error }
    }

    /// The rate of a stage, from those before it; the state it is taken at stays in `trial`.
    fn rate<O: Ode>(
        &mut self,
        ode: &mut O,
        stage: usize,
        (t, h): (f64, f64),
        y: &[f64],
    ) -> Result<(), O::Error> {
        let (known, new) = self.stages.split_at_mut(stage * y.len());
        combine(A[stage], known, &mut self.trial);
        for (trial, y) in self.trial.iter_mut().zip(y) {
            *trial = y + h * *trial;
        }
        ode.rate(t + C[stage] * h, &self.trial, &mut new[..y.len()])
    }

    /// Makes ready for values within the step that was just accepted.
    fn interpolate<O: Ode>(
        &mut self,
        ode: &mut O,
        t: f64,
        h: f64,
        y: &[f64],
    ) -> Result<(), O::Error> {
        // The stages of the interpolation write over the state at the end of the step.
        let end = std::mem::take(&mut self.interpolation.end);
        self.interpolation.end = std::mem::replace(&mut self.trial, end);
        let stages = (STAGES..ALL).try_for_each(|stage| self.rate(ode, stage, (t, h), y));
        std::mem::swap(&mut self.trial, &mut self.interpolation.end);
        stages?;
        self.interpolation.load(&self.stages, [y, &self.trial], h);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pendulum, ÿ = −sin y, with the invariant ẏ²/2 − cos y; and ż = z cos t, whose solution is exp(sin t).
    struct Pendulum {
        rates: usize,
    }

    impl Ode for Pendulum {
        type Error = ();

        fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), ()> {
            self.rates += 1;
            dy[0] = y[1];
            dy[1] = -y[0].sin();
            dy[2] = y[2] * t.cos();
            Ok(())
        }
    }

    fn energy(y: &[f64]) -> f64 {
        0.5 * y[1] * y[1] - y[0].cos()
    }

    /// Largest errors at the steps and at nodes in between, and how often the rates were asked for.
    fn run(tolerance: f64) -> ([f64; 2], usize) {
        let nodes: Vec<f64> = (0..=400).map(|k| f64::from(k) * 0.02).collect();
        let mut ode = Pendulum { rates: 0 };
        let mut y = [1.0, 0.5, 1.0];
        let start = energy(&y);
        let mut integrator = Dop853::new(3, tolerance, 1e-3 * tolerance, 100_000);
        let ([mut at_steps, mut at_nodes], mut seen) = ([0.0_f64; 2], 0);
        integrator
            .advance(&mut ode, &nodes, &mut y, |_, reached| {
                match reached {
                    Reached::Step(y) => at_steps = at_steps.max((energy(y) - start).abs()),
                    Reached::Node(k, y) => {
                        seen += 1;
                        assert_eq!(k, seen);
                        let exact = nodes[k].sin().exp();
                        let gap = (energy(y) - start).abs().max((y[2] - exact).abs());
                        at_nodes = at_nodes.max(gap);
                    }
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!(seen, 400);
        ([at_steps, at_nodes], ode.rates)
    }

    #[test]
    fn errors_follow_the_tolerance_at_steps_and_between() {
        for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
            let ([at_steps, at_nodes], rates) = run(tolerance);
            assert!(at_steps < 20.0 * tolerance, "{tolerance:e}: {at_steps:e}");
            assert!(at_nodes < 50.0 * tolerance, "{tolerance:e}: {at_nodes:e}");
            assert!(rates < 1200, "{tolerance:e}: {rates}");
        }
    }

    /// One step of length h misses by h⁹, the interpolation within by h⁸.
    #[test]
    fn steps_are_of_eighth_order_and_values_between_of_seventh() {
        let missed = |h: f64| {
            let nodes = [0.3, 0.3 + 0.37 * h, 0.3 + h];
            let mut y = [1.0, 0.5, nodes[0].sin().exp()];
            let mut integrator = Dop853::new(3, 1.0, 1.0, 10);
            integrator.steps.begin(h, &[1.0 - 1e-3], &[1.0], f64::MAX);
            let mut gaps = [0.0; 3];
            integrator
                .advance(&mut Pendulum { rates: 0 }, &nodes, &mut y, |_, reached| {
                    if let Reached::Node(k, y) = reached {
                        gaps[k] = (y[2] - nodes[k].sin().exp()).abs();
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            assert_eq!(integrator.taken(), 1);
            gaps
        };
        let (coarse, fine) = (missed(0.4), missed(0.2));
        let order = |k: usize| (coarse[k] / fine[k]).log2();
        // SciPy's method of that name misses by as much.
        assert!((missed(0.8)[2] / 5.226092e-8 - 1.0).abs() < 1e-6);
        assert!(
            order(2) > 8.4,
            "{coarse:e} {fine:e}",
            coarse = coarse[2],
            fine = fine[2]
        );
        assert!(
            order(1) > 7.8,
            "{coarse:e} {fine:e}",
            coarse = coarse[1],
            fine = fine[1]
        );
    }

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
    fn it_says_where_it_stops_and_stops_when_told() {
        let mut y = [1.0];
        let mut integrator = Dop853::new(1, 1e-10, 1e-12, 100_000);
        let mut go_on = |_: &mut Blowup, _: Reached<'_>| ControlFlow::Continue(());
        integrator
            .advance(&mut Blowup, &[0.0, 0.9], &mut y, &mut go_on)
            .unwrap();
        assert!((y[0] / 10.0 - 1.0).abs() < 1e-8, "{y:?}");
        let error = integrator
            .advance(&mut Blowup, &[0.9, 2.0], &mut y, &mut go_on)
            .unwrap_err();
        let IntegrationError::StepUnderflow(t) = error else {
            panic!("{error:?}")
        };
        assert!((t - 1.0).abs() < 1e-6, "{t}");

        let (mut y, mut steps) = ([1.0], 0);
        Dop853::new(1, 1e-10, 1e-12, 100_000)
            .advance(&mut Blowup, &[0.0, 2.0], &mut y, |_, _| {
                steps += 1;
                ControlFlow::Break(())
            })
            .unwrap();
        assert_eq!(steps, 1);
    }
}
