//! What came of a batch: how its rows ended, distributions, the worst of them.

use super::sheet::Sheet;
use crate::solution::dataset::{Column, Data, DataSet, DataSetError};
use crate::study::batch::RowStatus;
use crate::text::digits::digits;
use crate::text::printable::one_line;
use serde::Serialize;
use std::collections::BTreeMap;

/// What came of a batch.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct BatchReport {
    /// Version of the format, 1.
    pub schema: u32,
    /// Rows of the whole batch.
    pub rows: u64,
    /// Those in the data set.
    pub done: u64,
    /// How many ended how; every status that any has.
    pub statuses: BTreeMap<&'static str, u64>,
    /// Distributions over the solved rows.
    pub distributions: Vec<Distribution>,
    /// The solved rows with the largest base angle, that first; at most ten.
    pub worst: Vec<Row>,
    /// Rows that are not solved, the first of each status; at most five of one.
    pub failures: Vec<Failure>,
}

/// How a figure is distributed.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Distribution {
    /// Name of its column.
    pub column: &'static str,
    /// Rows that have it.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Quantiles at 0, 0.05, 0.25, 0.5, 0.75, 0.95 and 1.
    pub quantiles: [f64; 7],
    /// Rows in each of 40 even parts between the first and the last quantile.
    pub histogram: Vec<usize>,
}

/// A row with its key.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Row {
    /// Its key.
    pub key: String,
    /// Largest base angle, rad.
    pub max_base_attitude: f64,
    /// Cost J.
    pub objective: f64,
}

/// A row that is not solved.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Failure {
    /// Its key.
    pub key: String,
    /// How it ended.
    pub status: &'static str,
    /// Why.
    pub reason: String,
}

/// Parts of the quantiles.
const PARTS: [f64; 7] = [0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0];
/// Columns with a distribution, what they are called, their unit for a person, and how many of that
/// are one in the file's.
const SHOWN: [(&str, &str, &str, f64); 7] = [
    ("objective", "cost J", "", 1.0),
    (
        "max_base_attitude",
        "largest base angle",
        "°",
        57.295_779_513_082_32,
    ),
    (
        "final_base_attitude",
        "final base angle",
        "°",
        57.295_779_513_082_32,
    ),
    (
        "max_base_displacement",
        "largest base displacement",
        "cm",
        100.0,
    ),
    ("peak_joint_torque", "peak joint torque", "N·m", 1.0),
    ("points", "points", "", 1.0),
    ("seconds", "time a plan", "ms", 1e3),
];
const BARS: usize = 40;
const WORST: usize = 10;
const FAILURES: usize = 5;
/// Longest reason in a table, characters.
const REASON: usize = 100;

impl BatchReport {
    /// The report on a data set, also while it is written.
    ///
    /// # Errors
    /// [`DataSetError`] where a part cannot be read.
    pub fn of(set: &DataSet) -> Result<Self, DataSetError> {
        // A row that two parts have would count twice.
        set.done()?;
        let mut report = Self {
            schema: 1,
            rows: set.manifest().rows,
            done: 0,
            statuses: BTreeMap::new(),
            distributions: Vec::new(),
            worst: Vec::new(),
            failures: Vec::new(),
        };
        let names = ["key", "status", "reason", "objective", "max_base_attitude"];
        set.read(&names, &mut |columns| report.take(&columns))?;
        report
            .failures
            .sort_by(|a, b| (a.status, &a.key).cmp(&(b.status, &b.key)));
        // One at a time: a column is all that has to fit into memory.
        for (name, ..) in SHOWN {
            let mut values = Vec::new();
            set.read(&["status", name], &mut |columns| {
                values.extend(solved_numbers(&columns, name));
            })?;
            report.distributions.extend(Distribution::of(name, values));
        }
        Ok(report)
    }

    fn take(&mut self, columns: &[Column]) {
        let (keys, statuses) = (texts(columns, "key"), texts(columns, "status"));
        let reasons = texts(columns, "reason");
        let objectives = numbers(columns, "objective");
        let angles = numbers(columns, "max_base_attitude");
        for (i, status) in statuses.iter().enumerate() {
            self.done += 1;
            let known = status.as_deref().and_then(RowStatus::of);
            let status = known.map_or("unknown", RowStatus::name);
            let count = self.statuses.entry(status).or_default();
            *count += 1;
            let key = || keys.get(i).cloned().flatten().unwrap_or_default();
            if known != Some(RowStatus::Solved) {
                if *count <= FAILURES as u64 {
                    let reason = reasons.get(i).cloned().flatten().unwrap_or_default();
                    let key = key();
                    self.failures.push(Failure {
                        key,
                        status,
                        reason,
                    });
                }
                continue;
            }
            let at = |values: &[Option<f64>]| values.get(i).copied().flatten().unwrap_or(f64::NAN);
            let angle = at(&angles);
            let least = self
                .worst
                .last()
                .map_or(f64::NEG_INFINITY, |row| row.max_base_attitude);
            if self.worst.len() < WORST || angle > least {
                self.worst.push(Row {
                    key: key(),
                    max_base_attitude: angle,
                    objective: at(&objectives),
                });
                self.worst.sort_by(|a, b| {
                    let larger = b.max_base_attitude.total_cmp(&a.max_base_attitude);
                    larger.then_with(|| a.key.cmp(&b.key))
                });
                self.worst.truncate(WORST);
            }
        }
    }

    /// As JSON.
    ///
    /// # Errors
    /// None in practice.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }

    /// For a person.
    pub fn text(&self) -> String {
        let ended = self.statuses.iter().map(|(name, count)| {
            let part = 100.0 * *count as f64 / self.done.max(1) as f64;
            format!("  {name:<15} {count:>10}  {part:>5.1} %\n")
        });
        let mut text = format!("{} of {} rows\n\n", self.done, self.rows);
        text.extend(ended);
        if !self.distributions.is_empty() {
            text += "\nSolved rows:\n\n";
            text += &self.quantiles();
            for distribution in self.distributions.iter().take(2) {
                text += &distribution.bars();
            }
        }
        if !self.worst.is_empty() {
            let mut sheet = Sheet::new(&["largest base angle", "degrees", "cost J"]).words(1);
            for row in &self.worst {
                let angle = digits(row.max_base_attitude.to_degrees(), 3, 2);
                sheet.row(vec![row.key.clone(), angle, digits(row.objective, 9, 6)]);
            }
            text += &format!("\n{}", sheet.markdown());
        }
        if !self.failures.is_empty() {
            let mut sheet = Sheet::new(&["not solved", "status", "reason"]).words(3);
            for row in &self.failures {
                let reason = one_line(&row.reason, REASON);
                sheet.row(vec![row.key.clone(), row.status.into(), reason]);
            }
            text += &format!("\n{}", sheet.markdown());
        }
        text
    }

    fn quantiles(&self) -> String {
        let header = [
            "", "least", "5 %", "25 %", "median", "75 %", "95 %", "largest", "mean",
        ];
        let mut sheet = Sheet::new(&header).words(1);
        for distribution in &self.distributions {
            let shown = SHOWN
                .iter()
                .find(|(column, ..)| *column == distribution.column);
            let &(_, name, unit, factor) = shown.expect("one of them");
            let label = match unit {
                "" => name.to_owned(),
                unit => format!("{name}, {unit}"),
            };
            let values = distribution.quantiles.iter().chain([&distribution.mean]);
            let values = values.map(|value| digits(factor * value, 0, 4));
            sheet.row(std::iter::once(label).chain(values).collect());
        }
        sheet.markdown()
    }
}

impl Distribution {
    /// That of `values`, of which there has to be one.
    fn of(column: &'static str, mut values: Vec<f64>) -> Option<Self> {
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let (first, last) = (*values.first()?, *values.last()?);
        let count = values.len();
        let quantile = |part: f64| {
            let at = part * (count - 1) as f64;
            let below = at.floor() as usize;
            let above = (below + 1).min(count - 1);
            values[below] + (at - below as f64) * (values[above] - values[below])
        };
        let mut histogram = vec![0; BARS];
        for value in &values {
            let part = (value - first) / (last - first);
            // All in the first where they are equal.
            let bar = (part * BARS as f64) as usize;
            histogram[bar.min(BARS - 1)] += 1;
        }
        Some(Self {
            column,
            count,
            mean: values.iter().sum::<f64>() / count as f64,
            quantiles: PARTS.map(quantile),
            histogram,
        })
    }

    /// The histogram as a line of bars.
    fn bars(&self) -> String {
        const LEVELS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
        let most = self.histogram.iter().copied().max().unwrap_or(0).max(1);
        let bar = |count: &usize| LEVELS[(count * 8).div_ceil(most)];
        let shown = SHOWN.iter().find(|(column, ..)| *column == self.column);
        let &(_, name, unit, factor) = shown.expect("one of them");
        let [first, .., last] = self.quantiles.map(|value| digits(factor * value, 0, 4));
        let bars: String = self.histogram.iter().map(bar).collect();
        format!("\n  {name}: {first}{unit} │{bars}│ {last}{unit}\n")
    }
}

fn texts(columns: &[Column], name: &str) -> Vec<Option<String>> {
    match columns.iter().find(|column| column.name == name) {
        Some(Column {
            data: Data::Text(values),
            ..
        }) => values.clone(),
        _ => Vec::new(),
    }
}

fn numbers(columns: &[Column], name: &str) -> Vec<Option<f64>> {
    match columns
        .iter()
        .find(|column| column.name == name)
        .map(|column| &column.data)
    {
        Some(Data::Number(values)) => values.clone(),
        Some(Data::Integer(values)) => values.iter().map(|v| v.map(|v| v as f64)).collect(),
        _ => Vec::new(),
    }
}

/// The numbers of the solved rows.
fn solved_numbers(columns: &[Column], name: &str) -> Vec<f64> {
    let statuses = texts(columns, "status");
    let solved = statuses
        .iter()
        .map(|status| status.as_deref() == Some(RowStatus::Solved.name()));
    let values = numbers(columns, name).into_iter().zip(solved);
    values
        .filter_map(|(value, solved)| value.filter(|_| solved))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::Distribution;

    #[test]
    fn quantiles_lie_between_the_values() {
        let values = (0..=100).map(f64::from).rev().collect();
        let found = Distribution::of("objective", values).unwrap();
        assert_eq!(found.quantiles, [0.0, 5.0, 25.0, 50.0, 75.0, 95.0, 100.0]);
        assert_eq!((found.count, found.mean), (101, 50.0));
        assert_eq!(found.histogram.iter().sum::<usize>(), 101);
        assert!(Distribution::of("objective", vec![f64::NAN]).is_none());
        let one = Distribution::of("objective", vec![3.0; 4]).unwrap();
        assert_eq!((one.quantiles, one.histogram[0]), ([3.0; 7], 4));
    }
}
