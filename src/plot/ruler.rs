//! The scale along an axis: range, places of values, ticks and their labels.

/// How values are laid along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    Linear,
    Log,
}

/// A tick; an empty label for a small one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    pub label: String,
}

/// A scale with its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ruler {
    scale: Scale,
    pub low: f64,
    pub high: f64,
}

impl Ruler {
    /// From `low` to `high`.
    pub fn new(scale: Scale, [low, high]: [f64; 2]) -> Self {
        Self { scale, low, high }
    }

    /// The range that holds `values`, widened by the part `margin` of it at both ends.
    pub fn fit(scale: Scale, values: impl Iterator<Item = f64>, margin: f64) -> Self {
        let fits = |v: &f64| v.is_finite() && (scale == Scale::Linear || *v > 0.0);
        let (mut low, mut high) = values
            .filter(fits)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
                (l.min(v), h.max(v))
            });
        if low > high {
            (low, high) = if scale == Scale::Log {
                (0.1, 1.0)
            } else {
                (0.0, 1.0)
            };
        }
        match scale {
            Scale::Log => {
                let (l, h) = (low.log10(), high.log10());
                let room = (margin * (h - l)).max(0.08);
                (low, high) = (10f64.powf(l - room), 10f64.powf(h + room));
            }
            Scale::Linear => {
                if high - low <= 1e-12 * high.abs().max(low.abs()) {
                    let room = if high == 0.0 { 1.0 } else { 0.5 * high.abs() };
                    (low, high) = (low - room, high + room);
                }
                let room = margin * (high - low);
                (low, high) = (low - room, high + room);
            }
        }
        Self { scale, low, high }
    }

    /// The same centre with a range of `span`.
    pub fn spanning(self, span: f64) -> Self {
        let centre = 0.5 * (self.low + self.high);
        Self {
            low: centre - 0.5 * span,
            high: centre + 0.5 * span,
            ..self
        }
    }

    /// 0 at the low end, 1 at the high end; `None` where the axis has no place for it.
    pub fn part(&self, value: f64) -> Option<f64> {
        let part = match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).log10() / (self.high / self.low).log10(),
        };
        part.is_finite().then_some(part)
    }

    /// Whether a value lies within the range.
    pub fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }

    /// Ticks, at most about `most` of them with labels.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Linear => self.linear_ticks(most),
            Scale::Log => self.log_ticks(most),
        }
    }

    fn linear_ticks(&self, most: usize) -> Vec<Tick> {
        let rough = (self.high - self.low) / most.max(1) as f64;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|digit| digit * power)
            .find(|step| *step >= rough * (1.0 - 1e-9))
            .unwrap_or(10.0 * power);
        let decimals = (-step.log10()).ceil().max(0.0) as usize;
        let slack = 1e-6 * step;
        let first = ((self.low - slack) / step).ceil() as i64;
        let last = ((self.high + slack) / step).floor() as i64;
        (first..=last)
            .map(|k| {
                let value = k as f64 * step;
                let large = self.low.abs().max(self.high.abs());
                let label = if k == 0 {
                    "0".into()
                } else if decimals > 4 || large >= 1e6 {
                    scientific(value)
                } else {
                    format!("{value:.decimals$}").replace('-', "−")
                };
                Tick { value, label }
            })
            .collect()
    }

    fn log_ticks(&self, most: usize) -> Vec<Tick> {
        let slack = 1e-9;
        let first = (self.low.log10() - slack).floor() as i32;
        let last = (self.high.log10() + slack).ceil() as i32;
        let decades = (self.high / self.low).log10();
        let every = (decades / most.max(1) as f64).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for exponent in first..=last {
            for digit in 1..10 {
                let value = f64::from(digit) * 10f64.powi(exponent);
                if value < self.low * (1.0 - slack) || value > self.high * (1.0 + slack) {
                    continue;
                }
                let label = if decades < 2.0 && [1, 2, 5].contains(&digit) {
                    plain(digit, exponent)
                } else if digit == 1 && exponent.rem_euclid(every) == 0 {
                    power_of_ten(exponent)
                } else {
                    String::new()
                };
                if digit == 1 || every == 1 {
                    ticks.push(Tick { value, label });
                }
            }
        }
        ticks
    }
}

fn superscript(number: i32) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    number
        .to_string()
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| digits[digit as usize]))
        .collect()
}

fn power_of_ten(exponent: i32) -> String {
    match exponent {
        0 => "1".into(),
        1 => "10".into(),
        _ => format!("10{}", superscript(exponent)),
    }
}

fn plain(digit: i32, exponent: i32) -> String {
    match exponent {
        0 => digit.to_string(),
        1..3 => (digit * 10i32.pow(exponent as u32)).to_string(),
        -2..0 => format!(
            "{:.*}",
            exponent.unsigned_abs() as usize,
            f64::from(digit) * 10f64.powi(exponent)
        ),
        _ => format!("{digit}·10{}", superscript(exponent)),
    }
}

fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mantissa = mantissa.trim_end_matches(".0").replace('-', "−");
    format!(
        "{mantissa}·10{}",
        superscript(exponent.parse().unwrap_or(0))
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ruler: &Ruler, most: usize) -> Vec<String> {
        let ticks = ruler.ticks(most).into_iter();
        ticks
            .map(|tick| tick.label)
            .filter(|l| !l.is_empty())
            .collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let ruler = Ruler::new(Scale::Linear, [-0.3, 1.0]);
        assert_eq!(labels(&ruler, 4), ["0", "0.5", "1.0"]);
        let small = Ruler::fit(Scale::Linear, [0.0, 3e-6].into_iter(), 0.0);
        assert_eq!(labels(&small, 3), ["0", "1·10⁻⁶", "2·10⁻⁶", "3·10⁻⁶"]);
        let negative = Ruler::fit(Scale::Linear, [-20.0, 0.0].into_iter(), 0.0);
        assert_eq!(labels(&negative, 2), ["−20", "−10", "0"]);
    }

    #[test]
    fn decades_are_labelled() {
        let ruler = Ruler::fit(Scale::Log, [1e-6, 1e-2].into_iter(), 0.0);
        let shown = labels(&ruler, 8);
        assert_eq!(shown, ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"]);
        let narrow = Ruler::fit(Scale::Log, [20.0, 90.0].into_iter(), 0.0);
        assert_eq!(labels(&narrow, 8), ["20", "50", "100"]);
    }

    #[test]
    fn a_log_axis_has_no_place_for_zero() {
        let ruler = Ruler::fit(Scale::Log, [0.0, 1e-3, 1e-1].into_iter(), 0.0);
        assert_eq!(ruler.part(0.0), None);
        assert!(ruler.low > 1e-4 && (ruler.part(1e-2).unwrap() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn flat_data_gets_a_range() {
        let ruler = Ruler::fit(Scale::Linear, [2.0, 2.0].into_iter(), 0.0);
        assert_eq!([ruler.low, ruler.high], [1.0, 3.0]);
    }
}
