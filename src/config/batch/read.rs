//! The tables of a batch file.

use super::Cell;
use super::draw::cholesky;
use super::table::Tables;
use super::vary::{MOST_ROWS, Sweep, Values, Vary};
use crate::config::ConfigError;
use crate::config::distribution::{Distribution, LEAST_INSIDE, inside};
use crate::config::document::{Value, quoted};
use crate::config::item::{Item, Section};
use crate::config::key_path::KeyPath;
use std::collections::HashSet;

/// Most keys that are varied.
const MOST_KEYS: usize = 256;

/// What a batch file says beside the path of its problem.
pub(super) fn sweep(root: &Section<'_>, tables: &mut Tables<'_>) -> Result<Sweep, ConfigError> {
    let expected = "a whole number from 0";
    let seed = match root.get("seed") {
        Some(item) => match item.node.value {
            Value::Integer(seed) if seed >= 0 => seed as u64,
            _ => return Err(item.unexpected(expected)),
        },
        None => 0,
    };
    let expected = "one [[vary]] table a key";
    let item = root.require("vary", expected)?;
    let entries = item.as_elements().filter(|all| !all.is_empty());
    let entries = entries.ok_or_else(|| item.unexpected(expected))?;
    let mut vary = Vec::new();
    for entry in &entries {
        vary.extend(one(entry, tables)?);
        if vary.len() > MOST_KEYS {
            return Err(item.error("more keys", format!("at most {MOST_KEYS}")));
        }
    }
    let mut known = HashSet::new();
    if let Some(twice) = vary.iter().find(|vary| !known.insert(vary.name.as_str())) {
        return Err(ConfigError::Value {
            place: twice.place.clone(),
            key: "vary.key".into(),
            found: format!("{} for the second time", quoted(&twice.name)),
            expected: "every key once".into(),
        });
    }
    let count = count(root, &vary, item)?;
    Ok(Sweep { seed, vary, count })
}

/// Rows of the batch.
fn count(root: &Section<'_>, vary: &[Vary], whole: &Item<'_>) -> Result<u64, ConfigError> {
    // What no number of 64 bits counts is more than any count that is given.
    let product = Sweep::product(vary).unwrap_or(u64::MAX);
    let given = root.get("count");
    let given = given.map(|item| Ok((item.count(MOST_ROWS as usize)? as u64, item)));
    match (given.transpose()?, product) {
        (Some((count, _)), _) if Sweep::draws(vary) => Ok(count),
        (None, _) if Sweep::draws(vary) => {
            Err(root.missing("count", "how many rows to draw, a whole number from 1"))
        }
        (Some((count, _)), product) if count <= product => Ok(count),
        (Some((_, item)), product) => {
            let expected = format!("at most {product}, as many rows as there are different ones");
            Err(item.unexpected(expected))
        }
        (None, product) if product <= MOST_ROWS => Ok(product),
        (None, _) => {
            let found = "more combinations of values";
            let expected = format!("at most {MOST_ROWS} rows, or count, how many of them to plan");
            Err(whole.error(found, expected))
        }
    }
}

const SOURCES: &str = "one of values, uniform, log_uniform, normal, or table with column";

/// The keys of one entry.
fn one(entry: &Item<'_>, tables: &mut Tables<'_>) -> Result<Vec<Vary>, ConfigError> {
    let section = entry.section(&[
        "key",
        "keys",
        "values",
        "uniform",
        "log_uniform",
        "normal",
        "table",
        "column",
    ])?;
    let sources = ["values", "uniform", "log_uniform", "normal", "table"];
    let given: Vec<_> = sources
        .iter()
        .filter_map(|name| section.get(name))
        .collect();
    let [source] = given[..] else {
        let found = format!("{} of them", given.len());
        return Err(entry.error(found, SOURCES));
    };
    if let Some(keys) = section.get("keys") {
        return match (source.name, section.get("key")) {
            ("normal", None) => correlated(keys, source),
            (_, Some(key)) => Err(key.error("beside keys", "one of both")),
            _ => Err(source.error("beside keys", "normal = { mean = […], covariance = [[…]] }")),
        };
    }
    let item = section.require("key", "a key of the problem file, as task.final.joints[0]")?;
    if let (Some(column), true) = (section.get("column"), source.name != "table") {
        return Err(column.error(
            "beside no table",
            "table = \"FILE.csv\" or \"FILE.parquet\"",
        ));
    }
    let values = match source.name {
        "values" => Values::Grid(list(source)?),
        "uniform" => Values::Drawn(Distribution::Uniform(ends(source, "[a, b], a below b")?)),
        "log_uniform" => {
            let expected = "[a, b], a above zero and below b";
            let [a, b] = ends(source, expected)?;
            if a <= 0.0 {
                return Err(source.error(format!("[{a}, {b}]"), expected));
            }
            Values::Drawn(Distribution::LogUniform([a, b]))
        }
        "normal" => Values::Drawn(normal(source)?),
        _ => {
            let column = section.require("column", "the name of a column of the table")?;
            Values::Column(tables.column(source, column)?)
        }
    };
    Ok(vec![vary(item, values)?])
}

fn vary(item: &Item<'_>, values: Values) -> Result<Vary, ConfigError> {
    let expected = "a key of the problem file, as task.final.joints[0]";
    let name = item.text(expected)?;
    let key = KeyPath::parse(name).filter(|key| key.to_string() == name && name.len() <= 200);
    Ok(Vary {
        name: name.into(),
        key: key.ok_or_else(|| item.unexpected(expected))?,
        place: item.node.place.clone(),
        values,
    })
}

/// Values of one kind.
fn list(item: &Item<'_>) -> Result<Vec<Cell>, ConfigError> {
    let expected = "an array of finite numbers, of strings, or of arrays of finite numbers";
    let elements = item.as_elements().filter(|all| !all.is_empty());
    let elements = elements.ok_or_else(|| item.unexpected(expected))?;
    let cells = elements.iter().map(|element| {
        Cell::of(element).ok_or_else(|| {
            element.unexpected("a finite number, a string or an array of finite numbers")
        })
    });
    let cells = cells.collect::<Result<Vec<_>, _>>()?;
    let kind = cells[0].kind();
    match cells.iter().position(|cell| cell.kind() != kind) {
        Some(other) => Err(elements[other].unexpected("values of one kind")),
        None => Ok(cells),
    }
}

/// Two finite numbers, the first below the second.
fn ends(item: &Item<'_>, expected: &str) -> Result<[f64; 2], ConfigError> {
    let elements = item.as_elements().unwrap_or_default();
    let [a, b] = &elements[..] else {
        return Err(item.unexpected(expected));
    };
    match (a.number("a finite number")?, b.number("a finite number")?) {
        (a, b) if a < b => Ok([a, b]),
        (a, b) => Err(item.error(format!("[{a}, {b}]"), expected)),
    }
}

fn normal(item: &Item<'_>) -> Result<Distribution, ConfigError> {
    if item.as_entries().is_none() {
        return Err(item.unexpected("a table with mean, sd and maybe min and max"));
    }
    let section = item.section(&["mean", "sd", "min", "max"])?;
    let mean = section
        .require("mean", "a finite number")?
        .number("a finite number")?;
    let sd = "a finite number above zero, the standard deviation";
    let sd = section.require("sd", sd)?.positive(sd)?;
    let end = |name: &str, none: f64| {
        section
            .get(name)
            .map_or(Ok(none), |item| item.number("a finite number"))
    };
    let range = [end("min", f64::NEG_INFINITY)?, end("max", f64::INFINITY)?];
    let [low, high] = range.map(|end| (end - mean) / sd);
    if inside(low, high) < LEAST_INSIDE {
        let found = format!("less than {LEAST_INSIDE} of the distribution between min and max");
        return Err(item.error(found, "min and max around more of it"));
    }
    Ok(Distribution::Normal { mean, sd, range })
}

/// Keys drawn together.
fn correlated(keys: &Item<'_>, item: &Item<'_>) -> Result<Vec<Vary>, ConfigError> {
    let expected = "an array of keys of the problem file";
    let names = keys
        .as_elements()
        .filter(|all| !all.is_empty() && all.len() <= MOST_KEYS);
    let names = names.ok_or_else(|| keys.unexpected(expected))?;
    let n = names.len();
    let section = item.section(&["mean", "covariance"])?;
    let row = |item: &Item<'_>| {
        let expected = format!("an array of {n} numbers, one a key");
        let elements = item.as_elements().filter(|all| all.len() == n);
        let elements = elements.ok_or_else(|| item.unexpected(&expected))?;
        let numbers = elements
            .iter()
            .map(|element| element.number("a finite number"));
        numbers.collect::<Result<Vec<_>, _>>()
    };
    let mean = row(section.require("mean", "an array of numbers, one a key")?)?;
    let expected = format!("a symmetric matrix of {n} rows without negative eigenvalues");
    let covariance = section.require("covariance", &expected)?;
    let rows = covariance.as_elements().filter(|all| all.len() == n);
    let rows = rows.ok_or_else(|| covariance.unexpected(&expected))?;
    let matrix = rows.iter().map(row).collect::<Result<Vec<_>, _>>()?;
    let factor = cholesky(&matrix).ok_or_else(|| covariance.unexpected(&expected))?;
    let texts = names
        .iter()
        .map(|item| item.text("a key of the problem file"));
    let texts = texts
        .map(|text| text.map(str::to_owned))
        .collect::<Result<Vec<_>, _>>()?;
    let each = names.iter().zip(mean).zip(factor);
    each.map(|((item, mean), factor)| {
        let keys = texts.clone();
        vary(item, Values::Correlated { mean, factor, keys })
    })
    .collect()
}
