//! What `disperse` leaves behind: `dispersion.json`, `samples.csv`, the lines a person reads.

mod document;
mod figure;
mod text;

pub(super) use figure::{DispersedFigure, largest};
pub(super) use text::{headline as sensitivity_headline, row as figure_row};

use crate::config::Dispersion;
use crate::problem::Problem;
use crate::study::dispersion::{Figures, Replays, Sensitivities};

/// What came of replaying a plan under perturbations.
#[derive(Debug)]
pub struct DispersionReport<'a> {
    pub(super) problem: &'a Problem,
    /// Path of the solution, as given.
    pub(super) solution: String,
    pub(super) seed: u64,
    pub(super) dispersion: &'a Dispersion,
    pub(super) replays: &'a Replays<'a>,
    pub(super) samples: &'a [Figures],
    pub(super) figures: Vec<DispersedFigure>,
    pub(super) sensitivities: Vec<Sensitivities>,
}

impl<'a> DispersionReport<'a> {
    /// The report on `samples`, the first of `replays`, at least one; these were made for `problem`
    /// and `dispersion` with `seed`.
    ///
    /// # Panics
    /// Where there are no samples.
    pub fn of(
        (problem, solution): (&'a Problem, String),
        (dispersion, seed): (&'a Dispersion, u64),
        replays: &'a Replays<'a>,
        samples: &'a [Figures],
    ) -> Self {
        Self {
            figures: figure::figures(replays.planned(), samples),
            sensitivities: Sensitivities::of(replays, samples),
            problem,
            solution,
            seed,
            dispersion,
            replays,
            samples,
        }
    }
}
