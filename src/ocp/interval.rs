//! A closed interval that a quantity must stay in.

/// Bounds whose ratio is larger say little of what is between them.
const WIDE: f64 = 1e4;

/// Lower and upper bound; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

impl Interval {
    /// No bound at all.
    pub const FREE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };

    /// From `lower` to `upper`.
    pub const fn new(lower: f64, upper: f64) -> Self {
        Self { lower, upper }
    }

    /// From −`bound` to `bound`.
    pub const fn symmetric(bound: f64) -> Self {
        Self {
            lower: -bound,
            upper: bound,
        }
    }

    /// One value only.
    pub const fn fixed(value: f64) -> Self {
        Self {
            lower: value,
            upper: value,
        }
    }

    /// Whether only one value is allowed.
    pub fn is_fixed(&self) -> bool {
        self.lower == self.upper
    }

    /// Whether there is no bound at all.
    pub fn is_free(&self) -> bool {
        self.lower == f64::NEG_INFINITY && self.upper == f64::INFINITY
    }

    /// What both intervals allow; empty (lower above upper) where they are apart.
    pub fn intersect(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.max(other.lower),
            upper: self.upper.min(other.upper),
        }
    }

    /// How far `value` lies outside; 0 inside. Infinite for NaN, which is within no bounds.
    pub fn violation(&self, value: f64) -> f64 {
        if value.is_nan() {
            return f64::INFINITY;
        }
        (self.lower - value).max(value - self.upper).max(0.0)
    }

    /// The nearest allowed value.
    pub fn clamp(&self, value: f64) -> f64 {
        value.max(self.lower).min(self.upper)
    }

    /// A value well inside: the middle, or the finite end, or 0.
    pub fn center(&self) -> f64 {
        match (self.lower.is_finite(), self.upper.is_finite()) {
            (true, true) => 0.5 * (self.lower + self.upper),
            (true, false) => self.lower.max(0.0),
            (false, true) => self.upper.min(0.0),
            (false, false) => 0.0,
        }
    }

    /// A likely value of a quantity above zero, such as a duration: the middle, unless the bounds are
    /// orders of magnitude apart; then what is as many times the lower one as the upper one is of it.
    pub fn typical(&self) -> f64 {
        let (lower, upper) = (self.lower, self.upper);
        if self.is_fixed() || upper <= WIDE * lower || (lower <= 0.0 && upper <= WIDE) {
            return self.center();
        }
        let lower = if lower > 0.0 { lower } else { upper.min(1.0) };
        match upper.is_finite() {
            true => (lower * upper).sqrt(),
            false => 2.0 * lower,
        }
    }
}
