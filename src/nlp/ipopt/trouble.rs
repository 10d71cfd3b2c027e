//! What makes the multifrontal solver hand a solve over to MUMPS: singular systems on and on, or factors
//! that delayed pivots have made many times longer than was foreseen.

use crate::nlp::HandOver;

/// Iterations in a row with a singular system after which MUMPS takes over.
const SINGULAR: u32 = 25;

/// Factors this many times longer than foreseen, though the matrix is scaled, are slower than MUMPS's.
const GROWTH: f64 = 4.0;

/// Factorisations in a row with such growth after which MUMPS takes over.
const GROWN: u32 = 10;

/// The trouble that the linear systems of one solve have made so far.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Trouble {
    /// Whether a system of this iteration was singular.
    singular_now: bool,
    /// Iterations in a row with a singular system.
    singular: u32,
    /// Iterations with a singular system in all.
    singular_in_all: u32,
    /// Factorisations in a row with factors that have grown.
    grown: u32,
}

impl Trouble {
    /// Notes a factorisation.
    pub fn factorised(&mut self, is_singular: bool, growth: f64) {
        self.singular_now |= is_singular;
        self.grown = if growth >= GROWTH { self.grown + 1 } else { 0 };
    }

    /// Notes the end of an iteration; a reason to hand over, where there is one.
    pub fn iterated(&mut self) -> Option<HandOver> {
        let now = std::mem::take(&mut self.singular_now);
        self.singular = if now { self.singular + 1 } else { 0 };
        self.singular_in_all += u32::from(now);
        if self.singular >= SINGULAR {
            Some(HandOver::Singular)
        } else if self.grown >= GROWN {
            Some(HandOver::Growth)
        } else {
            None
        }
    }

    /// Whether at least a tenth of `iterations` had a singular system.
    pub fn is_often_singular(&self, iterations: u32) -> bool {
        self.singular_in_all > 0 && 10 * self.singular_in_all >= iterations
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn singular_systems_count_by_iterations_in_a_row() {
        let mut trouble = Trouble::default();
        for iteration in 1..=2 * SINGULAR {
            // Twice an iteration counts once; one iteration without begins anew.
            let singular = iteration != SINGULAR;
            trouble.factorised(singular, 1.0);
            trouble.factorised(false, 1.0);
            let expected = (iteration == 2 * SINGULAR).then_some(HandOver::Singular);
            assert_eq!(trouble.iterated(), expected, "iteration {iteration}");
        }
        assert!(trouble.is_often_singular(10 * SINGULAR));
        assert!(!trouble.is_often_singular(1000 * SINGULAR));
        assert!(!Trouble::default().is_often_singular(0));
    }

    #[test]
    fn growth_counts_by_factorisations_in_a_row() {
        let mut trouble = Trouble::default();
        for _ in 1..GROWN {
            trouble.factorised(false, GROWTH);
        }
        assert_eq!(trouble.iterated(), None);
        trouble.factorised(false, GROWTH);
        assert_eq!(trouble.iterated(), Some(HandOver::Growth));
        trouble.factorised(false, 1.0);
        assert_eq!(trouble.iterated(), None);
    }
}
