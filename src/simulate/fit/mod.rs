//! Platform parameters from published measurements, by least squares.
//!
//! | file | does |
//! | --- | --- |
//! | `parameter` | what of a platform can be fitted |
//! | `hypotheses` | several sets of unknowns, each by itself |
//! | `least_squares` | least squares within bounds |

mod hypotheses;
mod least_squares;
mod parameter;
mod quantity;

pub use least_squares::{Minimum, minimise};
pub use parameter::Parameter;
pub use quantity::MeasuredQuantity;

use super::{Figures, Platform, Player, SimulateError};
use fastrand::Rng;
use std::cell::RefCell;

/// What was measured in one experiment; magnitudes, for signs are not published.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Name of the experiment.
    pub name: String,
    /// Largest magnitude of the base attitude, rad.
    pub max_attitude: Option<f64>,
    /// Magnitude of the base attitude at the end, rad.
    pub final_attitude: Option<f64>,
    /// Magnitudes of the displacement at the end along x and y, m.
    pub final_displacement: Option<[f64; 2]>,
}

/// A difference of 1 for the residual: of an attitude (rad) and a length (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Attitude, rad.
    pub attitude: f64,
    /// Length, m.
    pub length: f64,
}

/// One compared number.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Name of the experiment.
    pub experiment: String,
    /// What is compared.
    pub what: MeasuredQuantity,
    /// As measured, a magnitude, rad or m.
    pub measured: f64,
    /// As simulated, with its sign.
    pub simulated: f64,
}

/// A parameter with the range it is sought in.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// The parameter.
    pub parameter: Parameter,
    /// Smallest and largest value thought possible. Where both are above zero the search is
    /// even in the logarithm.
    pub range: [f64; 2],
    /// Whether every experiment has a value of its own.
    pub each: bool,
}

impl Unknown {
    fn value(&self, z: f64) -> f64 {
        let [min, max] = self.range;
        if min > 0.0 {
            min * (max / min).powf(z)
        } else {
            min + (max - min) * z
        }
    }

    fn place(&self, value: f64) -> f64 {
        let [min, max] = self.range;
        let z = if min > 0.0 {
            (value / min).ln() / (max / min).ln()
        } else {
            (value - min) / (max - min)
        };
        if z.is_finite() {
            z.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// A fitted number.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The parameter.
    pub parameter: Parameter,
    /// The experiment it belongs to; none where it is common to all.
    pub experiment: Option<String>,
    /// Its value.
    pub value: f64,
    /// The range it was sought in.
    pub range: [f64; 2],
    /// Whether it lies at an end of that range.
    pub at_bound: bool,
    /// Standard error by the linearised problem, the residual taken as noise; none where the
    /// measurements do not determine it.
    pub error: Option<f64>,
}

/// The best fit found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Parameters.
    pub parameters: Vec<Fitted>,
    /// Measured beside simulated.
    pub comparisons: Vec<Comparison>,
    /// Root of the mean square of the residuals, in units of the scale.
    pub residual: f64,
    /// Root of the mean square with every parameter as the platform has it.
    pub start_residual: f64,
    /// Starts of the search and how many of them came within 1 % of the best residual.
    pub starts: [usize; 2],
    /// Experiments simulated altogether.
    pub simulations: usize,
}

/// Experiments to be explained by one platform.
#[derive(Debug, Clone)]
pub struct Experiments {
    players: Vec<Player>,
    measured: Vec<Measured>,
    scale: Scale,
}

impl Experiments {
    /// Plays `plans` beside what was measured of them. Noise is left out: what is fitted is what
    /// runs scatter around.
    pub fn new(experiments: Vec<(Player, Measured)>, scale: Scale) -> Self {
        let (players, measured) = experiments.into_iter().unzip();
        Self {
            players,
            measured,
            scale,
        }
    }

    /// How well `platform` explains the measurements as it is, and what it gives.
    ///
    /// # Errors
    /// [`SimulateError`] of the simulation.
    pub fn compare(&self, platform: &Platform) -> Result<Vec<Comparison>, SimulateError> {
        self.compare_each(&vec![platform.clone(); self.players.len()])
    }

    /// The values of `unknowns` that explain the measurements best, by searches from `starts`
    /// points, all else as in `platform`. Where `stop` says so the best so far is returned.
    ///
    /// # Errors
    /// [`SimulateError`] where `platform` itself cannot be simulated.
    pub fn fit(
        &self,
        platform: &Platform,
        unknowns: &[Unknown],
        starts: usize,
        stop: &dyn Fn() -> bool,
    ) -> Result<Fit, SimulateError> {
        self.fit_from(platform, unknowns, starts, None, stop)
    }

    /// [`Self::fit`] with one more start, where a fit of some of the unknowns ended.
    fn fit_from(
        &self,
        platform: &Platform,
        unknowns: &[Unknown],
        starts: usize,
        part: Option<&Fit>,
        stop: &dyn Fn() -> bool,
    ) -> Result<Fit, SimulateError> {
        let exact = platform.without_noise();
        let platform = coarse(&exact);
        let simulations = RefCell::new(0);
        let mut residual = |z: &[f64]| {
            *simulations.borrow_mut() += self.players.len();
            let found = self.compare_each(&self.platforms(&platform, unknowns, z))?;
            Ok::<Vec<f64>, SimulateError>(found.iter().map(|c| self.residual(c)).collect())
        };
        let slots = self.slots(unknowns);
        let own: Vec<f64> = slots
            .iter()
            .map(|&(u, _)| unknowns[u].place(unknowns[u].parameter.get(&platform)))
            .collect();
        let start_residual = root_mean_square(&{
            let found = self.compare(&exact)?;
            found.iter().map(|c| self.residual(c)).collect::<Vec<f64>>()
        });
        let mut rng = Rng::with_seed(platform.seed);
        let mut from = vec![own.clone()];
        from.extend((1..starts).map(|_| slots.iter().map(|_| rng.f64()).collect()));
        from.extend(part.map(|part| self.place(unknowns, &slots, part, &own)));
        let mut ends: Vec<Minimum> = Vec::new();
        for (start, z) in from.into_iter().enumerate() {
            if start > 0 && stop() {
                break;
            }
            // A start from which nothing can be simulated is no start.
            if let Ok(end) = least_squares::minimise(&z, &mut residual) {
                ends.push(end);
            }
        }
        let Some(best) = ends.iter().min_by(|a, b| a.sum().total_cmp(&b.sum())) else {
            return Err(SimulateError::Stuck { time: 0.0 });
        };
        let near = |end: &&Minimum| end.sum() <= 1.02 * best.sum() + 1e-6;
        let comparisons = self.compare_each(&self.platforms(&exact, unknowns, &best.z))?;
        let residuals: Vec<f64> = comparisons.iter().map(|c| self.residual(c)).collect();
        Ok(Fit {
            parameters: self.describe(unknowns, &slots, best),
            residual: root_mean_square(&residuals),
            comparisons,
            start_residual,
            starts: [ends.len(), ends.iter().filter(near).count()],
            simulations: simulations.into_inner(),
        })
    }

    /// One variable an unknown, or one each experiment: the unknown and the experiment.
    fn slots(&self, unknowns: &[Unknown]) -> Vec<(usize, Option<usize>)> {
        let mut slots = Vec::new();
        for (u, unknown) in unknowns.iter().enumerate() {
            if unknown.each {
                slots.extend((0..self.players.len()).map(|e| (u, Some(e))));
            } else {
                slots.push((u, None));
            }
        }
        slots
    }

    /// Where a fit of some of the unknowns ended; `own` for the others.
    fn place(
        &self,
        unknowns: &[Unknown],
        slots: &[(usize, Option<usize>)],
        part: &Fit,
        own: &[f64],
    ) -> Vec<f64> {
        let place = |(&(u, experiment), &own): (&(usize, Option<usize>), &f64)| {
            let name = experiment.map(|e| &self.measured[e].name);
            let unknown = &unknowns[u];
            let same =
                |f: &&Fitted| f.parameter == unknown.parameter && f.experiment.as_ref() == name;
            let found = part.parameters.iter().find(same);
            found.map_or(own, |fitted| unknown.place(fitted.value))
        };
        slots.iter().zip(own).map(place).collect()
    }

    fn platforms(&self, platform: &Platform, unknowns: &[Unknown], z: &[f64]) -> Vec<Platform> {
        let mut platforms = vec![platform.clone(); self.players.len()];
        for ((u, experiment), z) in self.slots(unknowns).into_iter().zip(z) {
            let unknown = &unknowns[u];
            for (e, platform) in platforms.iter_mut().enumerate() {
                if experiment.is_none_or(|experiment| experiment == e) {
                    unknown.parameter.set(platform, unknown.value(*z));
                }
            }
        }
        platforms
    }

    fn compare_each(&self, platforms: &[Platform]) -> Result<Vec<Comparison>, SimulateError> {
        let mut found = Vec::new();
        for ((player, measured), platform) in self.players.iter().zip(&self.measured).zip(platforms)
        {
            let run = player.on(platform.without_noise()).run(0)?;
            let figures = Figures::measured(&run);
            let mut add = |what, measured_value: Option<f64>, simulated| {
                if let Some(value) = measured_value {
                    found.push(Comparison {
                        experiment: measured.name.clone(),
                        what,
                        measured: value,
                        simulated,
                    });
                }
            };
            let [x, y] = figures.final_displacement;
            let [along_x, along_y] = [0, 1].map(|i| measured.final_displacement.map(|d| d[i]));
            let found = [figures.max_attitude, figures.final_attitude];
            add(
                MeasuredQuantity::LargestAttitude,
                measured.max_attitude,
                found[0],
            );
            add(
                MeasuredQuantity::FinalAttitude,
                measured.final_attitude,
                found[1],
            );
            add(MeasuredQuantity::FinalX, along_x, x);
            add(MeasuredQuantity::FinalY, along_y, y);
        }
        Ok(found)
    }

    /// Difference of the magnitudes in units of the scale.
    fn residual(&self, comparison: &Comparison) -> f64 {
        let unit = if comparison.what.is_angle() {
            self.scale.attitude
        } else {
            self.scale.length
        };
        (comparison.simulated.abs() - comparison.measured) / unit
    }

    fn describe(
        &self,
        unknowns: &[Unknown],
        slots: &[(usize, Option<usize>)],
        best: &Minimum,
    ) -> Vec<Fitted> {
        let errors = standard_errors(best);
        slots
            .iter()
            .zip(&best.z)
            .zip(errors)
            .map(|((&(u, experiment), &z), error)| {
                let unknown = &unknowns[u];
                let value = unknown.value(z);
                // Slope of the value over z.
                let [min, max] = unknown.range;
                let slope = if min > 0.0 {
                    value * (max / min).ln()
                } else {
                    max - min
                };
                Fitted {
                    parameter: unknown.parameter,
                    experiment: experiment.map(|e| self.measured[e].name.clone()),
                    value,
                    range: unknown.range,
                    at_bound: !(1e-6..=1.0 - 1e-6).contains(&z),
                    // Of the whole range the measurements tell nothing.
                    error: error.filter(|e| *e < 1.0).map(|e| e * slope),
                }
            })
            .collect()
    }
}

/// The platform with longer samples and fewer frames, for the search: what is compared changes by
/// far less than was measured. The fit found is simulated again with its own.
fn coarse(platform: &Platform) -> Platform {
    let mut coarse = platform.clone();
    coarse.controller.period = coarse.controller.period.max(0.01);
    coarse.capture.rate = coarse.capture.rate.min(20.0);
    coarse
}

fn root_mean_square(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len().max(1) as f64).sqrt()
}

/// Roots of the diagonal of σ²(JᵀJ)⁻¹ over the variables that are not at a bound, σ² being the
/// sum of squares over the degrees of freedom left, at least one.
fn standard_errors(best: &Minimum) -> Vec<Option<f64>> {
    use faer::linalg::solvers::DenseSolveCore;
    use faer::{Mat, Side};
    let free: Vec<usize> = (0..best.z.len())
        .filter(|&i| (1e-6..=1.0 - 1e-6).contains(&best.z[i]))
        .collect();
    let spare = best.residual.len().saturating_sub(free.len());
    let variance = best.sum() / spare.max(1) as f64;
    let entry =
        |a: usize, b: usize| -> f64 { best.jacobian.iter().map(|row| row[a] * row[b]).sum() };
    let mut errors = vec![None; best.z.len()];
    let matrix = Mat::from_fn(free.len(), free.len(), |i, j| entry(free[i], free[j]));
    if spare > 0
        && !free.is_empty()
        && let Ok(factors) = matrix.llt(Side::Lower)
    {
        let inverse = factors.inverse();
        for (k, &i) in free.iter().enumerate() {
            let error = (variance * inverse[(k, k)]).sqrt();
            errors[i] = error.is_finite().then_some(error);
        }
    }
    errors
}
