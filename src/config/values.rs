//! Values with one component a joint, a base angle or a base length.

use super::ConfigError;
use super::item::{Item, hint};
use crate::ocp::Interval;

/// What a value has one component of.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Components {
    /// "joint", "base angle" or "base length".
    pub what: &'static str,
    /// Names, in order.
    pub names: Vec<String>,
    /// Where nothing but one number will do: what was expected.
    pub single: Option<&'static str>,
}

impl Components {
    /// Angles of the base attitude: 1 in the plane, else 3.
    pub(super) fn angles(count: usize) -> Self {
        let names: &[&str] = if count == 1 {
            &["angle"]
        } else {
            &["roll", "pitch", "yaw"]
        };
        Self {
            what: "base angle",
            names: names.iter().map(|name| name.to_string()).collect(),
            single: None,
        }
    }

    /// The rotation angle of the base, where its attitude is not described by angles.
    pub(super) fn rotation_angle() -> Self {
        Self {
            what: "base rotation angle",
            names: vec!["angle".into()],
            single: Some(
                "one number, for the rotation angle of the base: base.attitude has no roll, \
                 pitch or yaw",
            ),
        }
    }

    /// Base axes, along which the angular velocity is taken.
    pub(super) fn axes() -> Self {
        Self {
            what: "base axis",
            ..Self::lengths(3)
        }
    }

    /// Components of the base position: 2 in the plane, else 3.
    pub(super) fn lengths(count: usize) -> Self {
        let names = ["x", "y", "z"][..count]
            .iter()
            .map(|name| name.to_string())
            .collect();
        Self {
            what: "base length",
            names,
            single: None,
        }
    }

    /// The base as a whole.
    pub(super) fn base() -> Self {
        Self {
            what: "base",
            names: vec!["base".into()],
            single: Some("one number, for the base as a whole"),
        }
    }

    fn len(&self) -> usize {
        self.names.len()
    }

    fn one_each(&self) -> String {
        format!(
            "{}, one a {}: {}",
            self.len(),
            self.what,
            self.names.join(", ")
        )
    }

    /// Elements of an array, one a component.
    fn elements<'a>(
        &self,
        item: &Item<'a>,
        elements: Vec<Item<'a>>,
    ) -> Result<Vec<Item<'a>>, ConfigError> {
        if elements.len() == self.len() {
            return Ok(elements);
        }
        let noun = if elements.len() == 1 {
            "value"
        } else {
            "values"
        };
        Err(item.error(format!("{} {noun}", elements.len()), self.one_each()))
    }

    /// Entries of a table by component; `None` for those left out.
    pub(super) fn by_name<'a>(
        &self,
        entries: Vec<Item<'a>>,
    ) -> Result<Vec<Option<Item<'a>>>, ConfigError> {
        let mut found = vec![None; self.len()];
        for entry in entries {
            match self.names.iter().position(|name| name == entry.name) {
                Some(component) => found[component] = Some(entry),
                None => {
                    let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
                    return Err(ConfigError::UnknownKey {
                        place: entry.node.place.clone(),
                        hint: hint(entry.name, &names),
                        key: entry.key,
                    });
                }
            }
        }
        Ok(found)
    }

    /// Finite numbers, all of them given: an array or a table by name.
    pub(super) fn vector(&self, item: &Item<'_>) -> Result<Vec<f64>, ConfigError> {
        let expected = format!("an array of {}", self.one_each());
        let finite = |item: &Item<'_>| item.number("a finite number");
        // A single component needs no brackets.
        if self.len() == 1 && item.as_number().is_some() {
            return Ok(vec![finite(item)?]);
        }
        if let Some(elements) = item.as_elements() {
            return self.elements(item, elements)?.iter().map(finite).collect();
        }
        let entries = item.entries(&expected)?;
        self.by_name(entries)?
            .into_iter()
            .zip(&self.names)
            .map(|(entry, name)| match entry {
                Some(entry) => finite(&entry),
                None => Err(ConfigError::Missing {
                    place: item.node.place.clone(),
                    key: format!("{}.{name}", item.key),
                    expected: "a finite number".into(),
                }),
            })
            .collect()
    }

    /// Finite numbers: an array of all of them, or a table by name with those that are given.
    pub(super) fn some(&self, item: &Item<'_>) -> Result<Vec<Option<f64>>, ConfigError> {
        let Some(entries) = item.as_entries() else {
            return Ok(self.vector(item)?.into_iter().map(Some).collect());
        };
        let number = |entry: Option<Item<'_>>| match entry {
            Some(entry) => entry.number("a finite number").map(Some),
            None => Ok(None),
        };
        self.by_name(entries)?.into_iter().map(number).collect()
    }

    /// Weights: one number for all, an array, or a table by name (0 for those left out).
    pub(super) fn weights(&self, item: &Item<'_>) -> Result<Vec<f64>, ConfigError> {
        let expected = format!(
            "a weight of zero or above, or an array of {}",
            self.one_each()
        );
        let weight = |item: &Item<'_>| {
            let expected = "a finite weight, zero or above";
            item.number(expected).and_then(|weight| {
                if weight < 0.0 {
                    Err(item.unexpected(expected))
                } else {
                    Ok(weight)
                }
            })
        };
        if item.as_number().is_some() {
            return Ok(vec![weight(item)?; self.len()]);
        }
        if let Some(expected) = self.single {
            return Err(item.unexpected(expected));
        }
        if let Some(elements) = item.as_elements() {
            return self.elements(item, elements)?.iter().map(weight).collect();
        }
        let entries = self.by_name(item.entries(&expected)?)?;
        entries
            .iter()
            .map(|entry| entry.as_ref().map_or(Ok(0.0), weight))
            .collect()
    }

    /// Bounds: one for all, an array of one each, or a table by name (`default` for those left
    /// out). See [`Components::pair`] for the one doubtful case, where it matters whether a range
    /// `may_exclude_zero`.
    pub(super) fn bounds(
        &self,
        item: &Item<'_>,
        default: &[Interval],
        may_exclude_zero: bool,
    ) -> Result<Vec<Interval>, ConfigError> {
        let expected = format!("a number, [lo, hi], or one of those a {}", self.what);
        let all = |bound| vec![bound; self.len()];
        if item.as_number().is_some() {
            return symmetric(item).map(all);
        }
        if let Some(expected) = self.single {
            return Err(item.unexpected(expected));
        }
        let Some(elements) = item.as_elements() else {
            let entries = self.by_name(item.entries(&expected)?)?;
            return entries
                .iter()
                .zip(default)
                .map(|(entry, default)| entry.as_ref().map_or(Ok(*default), bound))
                .collect();
        };
        if let Some(pair) = flat_pair(&elements)
            && self.pair(item, pair, may_exclude_zero)?
        {
            return range(item, &elements).map(all);
        }
        self.elements(item, elements)?.iter().map(bound).collect()
    }

    /// Whether two numbers are one range for all rather than a bound each.
    ///
    /// Only where there are two components can there be a doubt: a range that holds zero starts
    /// at or below it, and bounds of both are above it. A rising pair above zero is a range only
    /// where it `may_exclude_zero`, and there the file has to say which is meant.
    fn pair(
        &self,
        item: &Item<'_>,
        [a, b]: [f64; 2],
        may_exclude_zero: bool,
    ) -> Result<bool, ConfigError> {
        if self.len() != 2 || a.min(b) <= 0.0 {
            return Ok(true);
        }
        if a < b && may_exclude_zero {
            let expected = format!(
                "[[{a}, {b}], [{a}, {b}]] for one range or [[{}, {a}], [{}, {b}]] for a bound each",
                -a, -b
            );
            return Err(item.error(format!("[{a}, {b}] may be read two ways"), expected));
        }
        Ok(false)
    }
}

/// A bound of one component: a number or [lo, hi].
fn bound(item: &Item<'_>) -> Result<Interval, ConfigError> {
    match item.as_elements() {
        Some(elements) if flat_pair(&elements).is_some() => range(item, &elements),
        None if item.as_number().is_some() => symmetric(item),
        _ => Err(item.unexpected("a number or [lo, hi]")),
    }
}

fn flat_pair(elements: &[Item<'_>]) -> Option<[f64; 2]> {
    match elements {
        [a, b] => Some([a.as_number()?, b.as_number()?]),
        _ => None,
    }
}

/// ±bound; infinite for no limit.
pub(super) fn symmetric(item: &Item<'_>) -> Result<Interval, ConfigError> {
    match item.as_number() {
        Some(bound) if bound >= 0.0 => Ok(Interval::symmetric(bound)),
        _ => Err(item.unexpected("a bound of zero or above (inf for none), or [lo, hi]")),
    }
}

/// From lo to hi, either of which may be infinite on its own side.
fn range(item: &Item<'_>, elements: &[Item<'_>]) -> Result<Interval, ConfigError> {
    let [lower, upper] = [0, 1].map(|i| elements[i].as_number().unwrap_or(f64::NAN));
    if lower <= upper && lower < f64::INFINITY && upper > f64::NEG_INFINITY {
        return Ok(Interval::new(lower, upper));
    }
    let found = format!("[{lower:?}, {upper:?}]").to_lowercase();
    Err(item.error(found, "[lo, hi] with lo not above hi, or bounds above zero"))
}

/// A bound of a joint in a robot file: a number or [lo, hi].
pub(super) fn joint_range(item: &Item<'_>) -> Result<[f64; 2], ConfigError> {
    bound(item).map(|bound| [bound.lower, bound.upper])
}
