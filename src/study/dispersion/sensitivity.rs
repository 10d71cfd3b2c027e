//! Which quantity the spread of the figures comes from: shares of their variance by linear
//! regression on all numbers that were drawn.
//!
//! The numbers are drawn independently, so that the variances of their contributions add up. What a
//! linear model does not explain is said, and is nobody's share.

use super::draws::Draws;
use super::figures::Figures;
use super::replays::Replays;
use crate::parallel;
use nalgebra::{DMatrix, DVector};

/// Samples for each number that is drawn, below which regression would explain chance.
const LEAST_SAMPLES: usize = 4;
/// Samples that are summed in one piece; sums so never depend on the number of threads.
const PIECE: usize = 512;
/// Pieces summed at a time.
const PIECES: usize = 32;

/// What a spread is explained for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Response {
    /// Rotation of the base at t_f out of the plan's attitude: all three components together.
    Departure,
    /// Largest base angle.
    LargestAttitude,
    /// Base angle at t_f.
    FinalAttitude,
    /// Largest distance of the base from its start.
    LargestDisplacement,
    /// Distance of the base at t_f from its start.
    FinalDisplacement,
}

impl Response {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Departure,
        Self::LargestAttitude,
        Self::FinalAttitude,
        Self::LargestDisplacement,
        Self::FinalDisplacement,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Departure => "departure",
            Self::LargestAttitude => "max_base_attitude",
            Self::FinalAttitude => "final_base_attitude",
            Self::LargestDisplacement => "max_base_displacement",
            Self::FinalDisplacement => "final_base_displacement",
        }
    }

    /// Its columns among the numbers of a sample.
    fn columns(self) -> &'static [usize] {
        match self {
            Self::Departure => &[0, 1, 2],
            Self::LargestAttitude => &[3],
            Self::FinalAttitude => &[4],
            Self::LargestDisplacement => &[5],
            Self::FinalDisplacement => &[6],
        }
    }
}

/// Numbers of a sample that are explained.
const COLUMNS: usize = 7;

fn columns(figures: &Figures) -> [f64; COLUMNS] {
    let [x, y, z] = figures.departure;
    [
        x,
        y,
        z,
        figures.max_base_attitude,
        figures.final_base_attitude,
        figures.max_base_displacement,
        figures.final_base_displacement,
    ]
}

/// What a quantity explains.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Share {
    /// Key of the quantity.
    pub key: String,
    /// Part of the variance, 0 to 1; chance is taken off.
    pub share: f64,
    /// Standard deviation that it alone causes, in the unit of the response.
    pub sd: f64,
}

/// What explains the spread of one response.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sensitivities {
    /// What is explained.
    pub response: Response,
    /// Part of the variance that the linear model explains, adjusted for the number of its
    /// coefficients; the rest is curvature and what quantities do together.
    pub explained: f64,
    /// Quantities that vary, the one with the largest share first.
    pub shares: Vec<Share>,
}

impl Sensitivities {
    /// For every response that varies; empty where fewer than four samples were replayed for each
    /// number that is drawn. `figures` are those of the first samples of `replays`.
    pub fn of(replays: &Replays<'_>, figures: &[Figures]) -> Vec<Self> {
        let draws = &replays.draws;
        let varied: Vec<usize> = draws
            .entries
            .iter()
            .filter(|entry| !entry.distribution.is_fixed())
            .flat_map(|entry| entry.from..entry.from + entry.count())
            .collect();
        if varied.is_empty() || figures.len() < LEAST_SAMPLES * varied.len() + 2 {
            return Vec::new();
        }
        let sums = Sums::all(draws, &varied, figures);
        let Some(regression) = Regression::of(&sums, figures.len()) else {
            return Vec::new();
        };
        let responses = Response::ALL.into_iter();
        responses
            .filter_map(|response| regression.explain(response, draws, &varied))
            .collect()
    }

    /// Samples that [`Self::of`] needs for `replays`.
    pub fn needed(replays: &Replays<'_>) -> usize {
        let entries = replays.draws.entries.iter();
        let varied = entries.filter(|entry| !entry.distribution.is_fixed());
        LEAST_SAMPLES * varied.map(|entry| entry.count()).sum::<usize>() + 2
    }
}

/// Sums of products over samples: drawn numbers with each other and with the figures, all counted
/// from those of the first sample.
struct Sums {
    /// Drawn numbers and then figures.
    width: usize,
    totals: Vec<f64>,
    /// Lower triangle by rows.
    products: Vec<f64>,
}

impl Sums {
    fn all(draws: &Draws, varied: &[usize], figures: &[Figures]) -> Self {
        let width = varied.len() + COLUMNS;
        let first = Self::row(draws, varied, figures, 0);
        let mut sums = Self::empty(width);
        let pieces = figures.len().div_ceil(PIECE);
        for from in (0..pieces).step_by(PIECES) {
            let some = parallel::map(PIECES.min(pieces - from), &|p| {
                let start = (from + p) * PIECE;
                let mut piece = Self::empty(width);
                for index in start..(start + PIECE).min(figures.len()) {
                    let mut row = Self::row(draws, varied, figures, index);
                    row.iter_mut()
                        .zip(&first)
                        .for_each(|(value, first)| *value -= first);
                    piece.add(&row);
                }
                piece
            });
            for piece in some {
                let totals = sums.totals.iter_mut().zip(&piece.totals);
                totals.for_each(|(sum, value)| *sum += value);
                let products = sums.products.iter_mut().zip(&piece.products);
                products.for_each(|(sum, value)| *sum += value);
            }
        }
        sums
    }

    fn empty(width: usize) -> Self {
        Self {
            width,
            totals: vec![0.0; width],
            products: vec![0.0; width * (width + 1) / 2],
        }
    }

    fn row(draws: &Draws, varied: &[usize], figures: &[Figures], index: usize) -> Vec<f64> {
        let mut values = vec![0.0; draws.count];
        draws.draw(index as u64, &mut values);
        let drawn = varied.iter().map(|at| values[*at]);
        drawn.chain(columns(&figures[index])).collect()
    }

    fn add(&mut self, row: &[f64]) {
        let mut at = 0;
        for (i, a) in row.iter().enumerate() {
            self.totals[i] += a;
            let products = &mut self.products[at..=at + i];
            products
                .iter_mut()
                .zip(row)
                .for_each(|(sum, b)| *sum += a * b);
            at += i + 1;
        }
    }

    /// Covariance of two of them over `n` samples.
    fn covariance(&self, i: usize, j: usize, n: f64) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        let product = self.products[i * (i + 1) / 2 + j];
        (product - self.totals[i] * self.totals[j] / n) / (n - 1.0)
    }
}

/// The linear model of all figures.
struct Regression {
    samples: f64,
    /// Standard deviation of what each drawn number contributes to each figure, drawn × figures.
    contributions: DMatrix<f64>,
    /// Variance of each figure, and the part of it that the model explains.
    variances: [[f64; 2]; COLUMNS],
}

impl Regression {
    /// `None` where the drawn numbers do not vary independently.
    fn of(sums: &Sums, samples: usize) -> Option<Self> {
        let n = samples as f64;
        let p = sums.width - COLUMNS;
        let sd = DVector::from_fn(p, |i, _| sums.covariance(i, i, n).sqrt());
        // In standard deviations the matrix is that of correlations, near the identity.
        let correlations =
            DMatrix::from_fn(p, p, |i, j| sums.covariance(i, j, n) / (sd[i] * sd[j]));
        let with = DMatrix::from_fn(p, COLUMNS, |i, y| sums.covariance(p + y, i, n) / sd[i]);
        let contributions = correlations.cholesky()?.solve(&with);
        let variance = |y: usize| {
            let explained = contributions.column(y).dot(&with.column(y));
            [sums.covariance(p + y, p + y, n), explained]
        };
        Some(Self {
            samples: n,
            variances: std::array::from_fn(variance),
            contributions,
        })
    }

    /// `None` where the response does not vary.
    fn explain(
        &self,
        response: Response,
        draws: &Draws,
        varied: &[usize],
    ) -> Option<Sensitivities> {
        let p = varied.len() as f64;
        let mut total = 0.0;
        let mut unexplained = 0.0;
        for y in response.columns() {
            let [variance, explained] = self.variances[*y];
            total += variance;
            // Every coefficient explains a little of any figure by chance.
            let left = (variance - explained).max(0.0);
            unexplained += left * (self.samples - 1.0) / (self.samples - p - 1.0);
        }
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let chance = unexplained / self.samples;
        let mut shares: Vec<Share> = Vec::new();
        for entry in &draws.entries {
            let numbers = entry.from..entry.from + entry.count();
            let rows = varied
                .iter()
                .enumerate()
                .filter(|(_, at)| numbers.contains(at));
            let mut variance = 0.0;
            let mut count = 0;
            for (row, _) in rows {
                count += 1;
                let of = response
                    .columns()
                    .iter()
                    .map(|y| self.contributions[(row, *y)]);
                variance += of.map(|part| part * part).sum::<f64>() - chance;
            }
            if count > 0 {
                let variance = variance.max(0.0);
                shares.push(Share {
                    key: entry.key.clone(),
                    share: variance / total,
                    sd: variance.sqrt(),
                });
            }
        }
        shares.sort_by(|a, b| b.share.total_cmp(&a.share));
        Some(Sensitivities {
            response,
            explained: (1.0 - unexplained / total).clamp(0.0, 1.0),
            shares,
        })
    }
}
