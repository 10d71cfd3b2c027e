//! Analyses that a thread keeps from one solve to the next.

use crate::nlp::kkt::{Factors, Growth, Pattern, Symbolic};
use std::cell::RefCell;
use std::sync::Arc;

/// Analyses that a thread keeps for the next programme with the same structure.
const KEPT: usize = 4;
/// An analysis whose factors have more numbers than this is not kept.
const LARGEST_KEPT: usize = 1 << 20;

thread_local! {
    static ANALYSES: RefCell<Vec<Analysis>> = const { RefCell::new(Vec::new()) };
}

/// An analysis, and the factors of the last matrix with its pattern.
pub(super) struct Analysis {
    pub symbolic: Arc<Symbolic>,
    pub factors: Factors,
    pub growth: Growth,
}

impl Analysis {
    /// The analysis of `pattern`: one that this thread has kept, or a new one.
    pub fn of(pattern: Pattern) -> Self {
        let kept = ANALYSES.with_borrow_mut(|kept| {
            let known = kept
                .iter()
                .position(|analysis| *analysis.symbolic.pattern() == pattern);
            known.map(|index| kept.remove(index))
        });
        kept.unwrap_or_else(|| {
            let symbolic = Symbolic::new(pattern);
            Self {
                factors: Factors::new(&symbolic),
                symbolic: Arc::new(symbolic),
                growth: Growth::default(),
            }
        })
    }

    /// Keeps this analysis for the next solve with its pattern, unless it is large.
    pub fn keep(mut self) {
        // What was found in this solve is not to change the next one.
        self.growth = Growth::default();
        if self.symbolic.factor_size() > LARGEST_KEPT {
            return;
        }
        // This fails while the thread ends, and then nothing is kept.
        let _ = ANALYSES.try_with(|kept| {
            let mut kept = kept.borrow_mut();
            if kept.len() == KEPT {
                kept.remove(0);
            }
            kept.push(self);
        });
    }
}
