//! An axis as asked for; its range is found from the data.

use super::ruler::{Ruler, Scale, Tick};

/// A labelled axis. The label carries the unit: "Time (s)".
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    pub(super) label: String,
    pub(super) scale: Scale,
    pub(super) range: Option<[f64; 2]>,
    pub(super) ticks: Vec<Tick>,
}

impl Axis {
    /// An axis with even steps.
    pub fn linear(label: &str) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            range: None,
            ticks: Vec::new(),
        }
    }

    /// An axis with decades; values that are not positive are left out.
    pub fn log(label: &str) -> Self {
        Self {
            scale: Scale::Log,
            ..Self::linear(label)
        }
    }

    /// From `low` to `high` whatever the data.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some([low, high]);
        self
    }

    /// Ticks at these values with these labels instead of round ones.
    #[must_use]
    pub fn ticks(mut self, ticks: &[(f64, String)]) -> Self {
        let tick = |(value, label): &(f64, String)| Tick {
            value: *value,
            label: label.clone(),
        };
        self.ticks = ticks.iter().map(tick).collect();
        self
    }

    /// The range asked for, or the one that holds `values`, widened by the part `margin` of it at
    /// both ends.
    pub(super) fn ruler(&self, values: impl Iterator<Item = f64>, margin: f64) -> Ruler {
        match self.range {
            Some(range) => Ruler::new(self.scale, range),
            None => Ruler::fit(self.scale, values, margin),
        }
    }

    /// Ticks on `ruler`, at most about `most` of them with labels unless they were given.
    pub(super) fn ticks_on(&self, ruler: &Ruler, most: usize) -> Vec<Tick> {
        if self.ticks.is_empty() {
            ruler.ticks(most)
        } else {
            self.ticks.clone()
        }
    }
}
