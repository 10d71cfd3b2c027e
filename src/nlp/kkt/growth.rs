//! Growth of the factors by delayed pivots, and what is done about it.
//!
//! A delayed pivot makes its parent's front larger, and many of them make a sparse factorisation a dense
//! one. The matrix is then scaled, this one and those after it, unless that helps nothing.

use super::factor::{Factors, NotFinite};
use super::subtree::Inertia;
use super::symbolic::Symbolic;

/// Factors this many times longer than the analysis has foreseen call for a scaling.
const GROWTH: f64 = 1.5;

/// A scaling that leaves more than this part of the growth is no help.
const HELP: f64 = 0.8;

/// Scaling on demand, through the factorisations of one solve.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Growth {
    is_scaled: bool,
    /// Length of the factors that a scaling did not help against.
    helpless: usize,
}

impl Growth {
    /// How many times longer the factors are than the analysis has foreseen.
    pub fn of(symbolic: &Symbolic, inertia: &Inertia) -> f64 {
        inertia.entries as f64 / symbolic.factor_size().max(1) as f64
    }

    /// Factorises, and scales where the factors have grown.
    pub fn factor(
        &mut self,
        factors: &mut Factors,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        if self.is_scaled {
            return factors.factor_scaled(symbolic, values, threshold);
        }
        let plain = factors.factor(symbolic, values, threshold)?;
        if Self::of(symbolic, &plain) < GROWTH || plain.entries < 2 * self.helpless {
            return Ok(plain);
        }
        let scaled = factors.factor_scaled(symbolic, values, threshold)?;
        self.is_scaled = (scaled.entries as f64) < HELP * plain.entries as f64;
        if !self.is_scaled {
            self.helpless = plain.entries;
        }
        Ok(scaled)
    }
}
