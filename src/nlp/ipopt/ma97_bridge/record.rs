//! A record of the systems that are solved, for benchmarks and tests.

use crate::nlp::kkt::{Inertia, Symbolic};
use std::cell::RefCell;
use std::sync::Arc;

/// A KKT system: one factorisation that Ipopt asked for, with the right-hand sides.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct KktSystem {
    /// The analysis in use.
    pub symbolic: Arc<Symbolic>,
    /// Values of the pattern's entries.
    pub values: Vec<f64>,
    /// Pivot threshold.
    pub threshold: f64,
    /// The inertia found.
    pub inertia: Inertia,
    /// Right-hand sides, in the order of the solutions.
    pub right_hand_sides: Vec<Vec<f64>>,
}

thread_local! {
    static RECORD: RefCell<Option<Vec<KktSystem>>> = const { RefCell::new(None) };
}

/// Runs `body` and returns the systems that the multifrontal solver was given in it, on this thread.
///
/// For benchmarks and tests: it costs a copy of every matrix.
pub fn record<T>(body: impl FnOnce() -> T) -> (T, Vec<KktSystem>) {
    RECORD.set(Some(Vec::new()));
    let result = body();
    (result, RECORD.take().unwrap_or_default())
}

/// Notes a factorised system, where systems are recorded.
pub(super) fn factorised(system: impl FnOnce() -> KktSystem) {
    RECORD.with_borrow_mut(|record| {
        if let Some(record) = record {
            record.push(system());
        }
    });
}

/// Notes a right-hand side of the last system.
pub(super) fn asked(right_hand_side: &[f64]) {
    RECORD.with_borrow_mut(|record| {
        if let Some(system) = record.as_mut().and_then(|all| all.last_mut()) {
            system.right_hand_sides.push(right_hand_side.to_vec());
        }
    });
}
