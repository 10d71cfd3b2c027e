//! When a time limit ends.

use std::time::{Duration, Instant};

/// The moment at which a time limit ends; never, where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deadline(Option<Instant>);

impl Deadline {
    /// `limit` from now on.
    pub fn after(limit: Option<Duration>) -> Self {
        // A limit beyond what the clock can count is none.
        Self(limit.and_then(|limit| Instant::now().checked_add(limit)))
    }

    /// The time left, zero where it has passed; `None` where there is no limit.
    pub fn remaining(self) -> Option<Duration> {
        self.0
            .map(|end| end.saturating_duration_since(Instant::now()))
    }

    /// Whether it has passed.
    pub fn has_passed(self) -> bool {
        self.remaining().is_some_and(|left| left.is_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_limit_it_never_passes() {
        assert_eq!(Deadline::after(None).remaining(), None);
        assert!(!Deadline::after(None).has_passed());
        assert!(!Deadline::after(Some(Duration::MAX)).has_passed());
        assert!(!Deadline::after(Some(Duration::from_secs(3600))).has_passed());
        assert!(Deadline::after(Some(Duration::ZERO)).has_passed());
    }
}
