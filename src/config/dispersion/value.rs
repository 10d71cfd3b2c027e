//! Distributions as they are written on the command line: `normal(12.5, 1%)`.

use crate::config::distribution::{Distribution, LEAST_INSIDE, inside};

/// What can be written.
pub(super) const FORMS: &str =
    "normal(mean, sd), normal(mean, sd, min, max), uniform(a, b), log_uniform(a, b) or fixed(x)";

/// Why a text is no distribution.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    pub expected: String,
}

/// Reads a distribution. A number with a percent sign is that part of `nominal`; where there is no
/// such thing, it is none.
pub(super) fn distribution(text: &str, nominal: Option<f64>) -> Result<Distribution, Fault> {
    let fault = |expected: &str| Fault {
        expected: expected.into(),
    };
    let text = text.trim();
    let number = |text: &str| number(text, nominal);
    if let Ok(value) = number(text) {
        return Ok(Distribution::Fixed(value));
    }
    let call = text.strip_suffix(')').and_then(|text| text.split_once('('));
    let Some((name, arguments)) = call else {
        return Err(fault(FORMS));
    };
    let numbers = arguments.split(',').map(number);
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    match (name.trim(), &numbers[..]) {
        ("fixed", &[value]) => Ok(Distribution::Fixed(value)),
        ("uniform", &[a, b]) if a < b => Ok(Distribution::Uniform([a, b])),
        ("uniform", _) => Err(fault("uniform(a, b), a below b")),
        ("log_uniform", &[a, b]) if 0.0 < a && a < b => Ok(Distribution::LogUniform([a, b])),
        ("log_uniform", _) => Err(fault("log_uniform(a, b), a above zero and below b")),
        ("normal", &[_, sd] | &[_, sd, _, _]) if sd < 0.0 => {
            Err(fault("a standard deviation of at least zero"))
        }
        ("normal", &[mean, sd]) => Ok(match sd {
            0.0 => Distribution::Fixed(mean),
            sd => Distribution::normal(mean, sd),
        }),
        ("normal", &[mean, sd, low, high]) => {
            let range = [low, high];
            let [least, most] = range.map(|end| (end - mean) / sd.max(f64::MIN_POSITIVE));
            match inside(least, most) < LEAST_INSIDE {
                true => Err(fault(
                    "min and max around at least a hundredth of the distribution",
                )),
                false => Ok(Distribution::Normal { mean, sd, range }),
            }
        }
        _ => Err(fault(FORMS)),
    }
}

/// A finite number, or a part of `nominal`.
fn number(text: &str, nominal: Option<f64>) -> Result<f64, Fault> {
    let text = text.trim();
    let fault = |expected: &str| Fault {
        expected: expected.into(),
    };
    let read = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let finite = "finite numbers, as in normal(1.0, 0.1)";
    match (text.strip_suffix('%'), nominal) {
        (None, _) => read(text).ok_or_else(|| fault(finite)),
        (Some(_), None) => Err(fault(
            "numbers in its unit: it is zero in the plan, so that a percentage means nothing",
        )),
        (Some(part), Some(nominal)) => read(part)
            .map(|part| part / 100.0 * nominal)
            .ok_or_else(|| fault(finite)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distributions_are_read() {
        let read = |text| distribution(text, Some(20.0)).unwrap();
        assert_eq!(read("normal(12.5, 1%)"), Distribution::normal(12.5, 0.2));
        assert_eq!(
            read(" uniform( 90% ,22) "),
            Distribution::Uniform([18.0, 22.0])
        );
        assert_eq!(read("fixed(100%)"), Distribution::Fixed(20.0));
        assert_eq!(read("100 %"), Distribution::Fixed(20.0));
        assert_eq!(read("normal(3, 0)"), Distribution::Fixed(3.0));
        assert_eq!(
            read("normal(1,2,0,3)"),
            Distribution::Normal {
                mean: 1.0,
                sd: 2.0,
                range: [0.0, 3.0]
            }
        );
    }

    #[test]
    fn what_is_none_is_refused() {
        for (text, part) in [
            ("", "normal(mean, sd)"),
            ("normal", "normal(mean, sd)"),
            ("gauss(1, 2)", "normal(mean, sd)"),
            ("normal(1, -2)", "at least zero"),
            ("normal(1)", "normal(mean, sd)"),
            ("normal(1, x)", "finite numbers"),
            ("normal(1, inf)", "finite numbers"),
            ("uniform(2, 1)", "a below b"),
            ("log_uniform(0, 1)", "above zero"),
            ("normal(0, 1, 50, 60)", "a hundredth"),
        ] {
            let fault = distribution(text, None).unwrap_err();
            assert!(fault.expected.contains(part), "{text}: {}", fault.expected);
        }
        let fault = distribution("normal(0, 1%)", None).unwrap_err();
        assert!(fault.expected.contains("percentage"), "{}", fault.expected);
    }
}
