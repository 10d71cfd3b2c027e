//! The fit file; docs/platform-file.md describes it.

use super::document::quoted;
use super::files::{Files, Source, without_parents};
use super::item::{Item, Section, hint};
use super::platform::PARTS;
use super::{ConfigError, Overrides, PlatformFile, ProblemFile};
use crate::dynamics::Model;
use crate::planner::Method;
use crate::simulate::fit::{Measured, Parameter, Scale, Unknown};
use std::path::{Path, PathBuf};

/// Most starts of a search.
const MOST_STARTS: usize = 10_000;

/// What a fit file asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct FitFile {
    /// Name, for the report and the output folder.
    pub name: String,
    /// Path, as given.
    pub path: String,
    /// Its text.
    pub text: String,
    /// The platform file that everything not fitted is taken from, as found from this one.
    pub platform: PathBuf,
    /// Searches from different starts for each hypothesis.
    pub starts: usize,
    /// Differences that count one.
    pub scale: Scale,
    /// What was measured, and of which plan.
    pub experiments: Vec<Experiment>,
    /// All parameters with their ranges.
    pub unknowns: Vec<Unknown>,
    /// Which of them are fitted together.
    pub hypotheses: Vec<Hypothesis>,
    /// Whether it came with the program; the files it names then do as well.
    shipped: bool,
}

/// One experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// The plan that was played.
    pub plan: PlanSource,
    /// What came of it.
    pub measured: Measured,
}

/// Where a plan comes from; paths as found from the fit file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PlanSource {
    /// A saved one.
    Solution(PathBuf),
    /// One made from a problem file, by the file's own method unless another is named.
    Problem(PathBuf, Option<Method>),
}

/// Parameters that are fitted together.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// Name.
    pub name: String,
    /// Their places among the unknowns.
    pub unknowns: Vec<usize>,
}

impl FitFile {
    /// Reads the fit file at `path`.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in it.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::read(path, Files::Disk)
    }

    /// One of the fits shipped in `config/platforms/`, by name ("published").
    ///
    /// # Errors
    /// [`ConfigError`] where there is none of that name.
    pub fn shipped(name: &str) -> Result<Self, ConfigError> {
        let path = format!("config/platforms/{name}.toml");
        Self::read(Path::new(&path), Files::Shipped)
    }

    fn read(path: &Path, files: Files<'_>) -> Result<Self, ConfigError> {
        let Source {
            path: source,
            text,
            document,
        } = files.document(path, "a fit file")?;
        let root = Item::root(&document);
        let mut entries = root.as_entries().into_iter().flatten();
        if let Some(item) = entries.find(|item| PARTS.contains(&item.name)) {
            let expected = "measurements with the platform they are of; simulate SOLUTION.json takes this file";
            return Err(item.error("part of a platform", expected));
        }
        let root = root.section(&[
            "schema",
            "name",
            "platform",
            "starts",
            "scale",
            "experiments",
            "parameters",
            "hypotheses",
        ])?;
        super::schema(&root)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let expected = "the path of a platform file, relative to this one";
        let platform = root.require("platform", expected)?.text(expected)?;
        let unknowns = parameters(&root)?;
        Ok(Self {
            name: super::problem::name(&root, path)?,
            platform: folder.join(platform),
            starts: match root.get("starts") {
                Some(item) => item.count(MOST_STARTS)?,
                None => 4,
            },
            scale: scale(&root)?,
            experiments: experiments(&root, folder)?,
            hypotheses: hypotheses(&root, &unknowns)?,
            unknowns,
            shipped: files == Files::Shipped,
            path: source,
            text,
        })
    }

    /// The platform that is fitted, for `robot`.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in its file.
    pub fn platform(&self, robot: &Model) -> Result<PlatformFile, ConfigError> {
        PlatformFile::read(&self.platform, self.files(), robot)
    }

    /// The problem of an experiment that is planned.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in its files.
    pub fn problem(&self, path: &Path) -> Result<ProblemFile, ConfigError> {
        let mut file = ProblemFile::read(path, self.files(), &Overrides::default())?;
        file.path = without_parents(path).display().to_string();
        Ok(file)
    }

    /// The unknowns of every hypothesis.
    pub fn unknowns_by_hypothesis(&self) -> Vec<Vec<Unknown>> {
        let of = |h: &Hypothesis| {
            let places = h.unknowns.iter();
            places.map(|&u| self.unknowns[u].clone()).collect()
        };
        self.hypotheses.iter().map(of).collect()
    }

    fn files(&self) -> Files<'static> {
        match self.shipped {
            true => Files::Shipped,
            false => Files::Disk,
        }
    }
}

/// `[scale]`: a degree and a centimetre unless given.
fn scale(root: &Section<'_>) -> Result<Scale, ConfigError> {
    let mut scale = Scale {
        attitude: 1f64.to_radians(),
        length: 0.01,
    };
    if let Some(item) = root.get("scale") {
        let section = item.section(&["attitude", "length"])?;
        if let Some(item) = section.get("attitude") {
            scale.attitude = item.positive("a finite angle above zero, rad")?;
        }
        if let Some(item) = section.get("length") {
            scale.length = item.positive("a finite length above zero, m")?;
        }
    }
    Ok(scale)
}

/// `[[experiments]]`.
fn experiments(root: &Section<'_>, folder: &Path) -> Result<Vec<Experiment>, ConfigError> {
    let expected = "one [[experiments]] table an experiment";
    let experiment = |item: &Item<'_>| {
        let section = item.section(&[
            "name",
            "solution",
            "problem",
            "method",
            "max_base_attitude",
            "final_base_attitude",
            "final_base_displacement",
        ])?;
        let angle = |key| match section.get(key) {
            Some(item) => item.number("the magnitude of an angle, rad").map(Some),
            None => Ok(None),
        };
        let displacement = match section.get("final_base_displacement") {
            Some(item) => Some(super::platform::pair(
                item,
                "[along x, along y], two magnitudes, m",
            )?),
            None => None,
        };
        Ok(Experiment {
            plan: plan(&section, folder)?,
            measured: Measured {
                name: section
                    .require("name", "a string")?
                    .text("a string")?
                    .into(),
                max_attitude: angle("max_base_attitude")?,
                final_attitude: angle("final_base_attitude")?,
                final_displacement: displacement,
            },
        })
    };
    let item = root.require("experiments", expected)?;
    item.as_elements()
        .filter(|elements| !elements.is_empty())
        .ok_or_else(|| item.unexpected(expected))?
        .iter()
        .map(experiment)
        .collect()
}

fn plan(section: &Section<'_>, folder: &Path) -> Result<PlanSource, ConfigError> {
    let path = |item: &Item<'_>| {
        item.text("a path, relative to this file")
            .map(|p| folder.join(p))
    };
    if let Some(item) = section.get("solution") {
        for key in ["problem", "method"] {
            if let Some(other) = section.get(key) {
                return Err(other.unexpected("nothing beside solution, which is planned already"));
            }
        }
        return path(item).map(PlanSource::Solution);
    }
    let problem =
        path(section.require("problem", "a problem file, or solution with a saved one")?)?;
    let method = match section.get("method") {
        Some(item) => {
            let names: Vec<&str> = Method::ALL.iter().map(|method| method.name()).collect();
            let expected = format!("one of {}", names.join(", "));
            let name = item.text(&expected)?;
            let found = Method::ALL.into_iter().find(|method| method.name() == name);
            Some(found.ok_or_else(|| item.error(quoted(name), expected))?)
        }
        None => None,
    };
    Ok(PlanSource::Problem(problem, method))
}

/// `[parameters]`.
fn parameters(root: &Section<'_>) -> Result<Vec<Unknown>, ConfigError> {
    let expected = "a table of ranges by key of the platform file";
    let keys = Parameter::keys();
    root.require("parameters", expected)?
        .entries(expected)?
        .iter()
        .map(|item| {
            let parameter = Parameter::find(item.name).ok_or_else(|| ConfigError::UnknownKey {
                place: item.node.place.clone(),
                key: item.key.clone(),
                hint: hint(item.name, &keys),
            })?;
            let section = item.section(&["range", "each"])?;
            let expected = "[min, max] with min below max";
            let range = section.require("range", expected)?;
            let [min, max] = super::platform::pair(range, expected)?;
            if min >= max {
                return Err(range.unexpected(expected));
            }
            Ok(Unknown {
                parameter,
                range: [min, max],
                each: match section.get("each") {
                    Some(item) => match item.node.value {
                        super::document::Value::Boolean(each) => each,
                        _ => return Err(item.unexpected("true or false")),
                    },
                    None => false,
                },
            })
        })
        .collect()
}

/// `[[hypotheses]]`.
fn hypotheses(root: &Section<'_>, unknowns: &[Unknown]) -> Result<Vec<Hypothesis>, ConfigError> {
    let expected = "one [[hypotheses]] table with name and parameters";
    let keys: Vec<&str> = unknowns.iter().map(|u| u.parameter.key).collect();
    let hypothesis = |item: &Item<'_>| {
        let section = item.section(&["name", "parameters"])?;
        let wanted = "an array of keys that stand in [parameters]";
        let list = section.require("parameters", wanted)?;
        let chosen = list
            .as_elements()
            .filter(|elements| !elements.is_empty())
            .ok_or_else(|| list.unexpected(wanted))?
            .iter()
            .map(|element| {
                let key = element.text(wanted)?;
                let found = keys.iter().position(|known| *known == key);
                found.ok_or_else(|| {
                    let expected = format!("one of [parameters]: {}", keys.join(", "));
                    element.error(quoted(key), expected)
                })
            })
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Hypothesis {
            name: section
                .require("name", "a string")?
                .text("a string")?
                .into(),
            unknowns: chosen,
        })
    };
    let item = root.require("hypotheses", expected)?;
    item.as_elements()
        .filter(|elements| !elements.is_empty())
        .ok_or_else(|| item.unexpected(expected))?
        .iter()
        .map(hypothesis)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIPPED: &str = include_str!("../../config/platforms/published.toml");

    fn read(text: &str) -> Result<FitFile, ConfigError> {
        let texts = [("a/fit.toml", text)];
        FitFile::read(Path::new("a/fit.toml"), Files::Kept(&texts))
    }

    #[test]
    fn both_shipped_files_ask_the_same() {
        let heavy = read(include_str!(
            "../../config/platforms/published-heavy-base.toml"
        ))
        .unwrap();
        let fit = read(SHIPPED).unwrap();
        assert_eq!(heavy.unknowns, fit.unknowns);
        let measured = |fit: &FitFile| -> Vec<Measured> {
            fit.experiments.iter().map(|e| e.measured.clone()).collect()
        };
        assert_eq!(measured(&heavy), measured(&fit));
    }

    #[test]
    fn shipped_fits_bring_their_problems_and_platform() {
        for name in ["published", "published-heavy-base"] {
            let fit = FitFile::shipped(name).unwrap();
            for experiment in &fit.experiments {
                let PlanSource::Problem(path, _) = &experiment.plan else {
                    panic!("{experiment:?}");
                };
                let file = fit.problem(path).unwrap();
                assert_eq!(file.path, format!("config/{}.toml", file.problem.name));
                assert_eq!(
                    fit.platform(&file.problem.robot).unwrap().platform.name,
                    "ideal"
                );
            }
        }
    }

    #[test]
    fn the_published_measurements_are_read() {
        let fit = read(SHIPPED).unwrap();
        assert_eq!(fit.platform, Path::new("a/ideal.toml"));
        let [first, second] = [&fit.experiments[0], &fit.experiments[1]];
        assert_eq!(first.measured.final_displacement, Some([0.032, 0.042]));
        let problem = PathBuf::from("a/../table1-relaxed.toml");
        let matpm = PlanSource::Problem(problem, Some(Method::Matpm));
        assert_eq!(second.plan, matpm);
        let degrees = second.measured.max_attitude.unwrap().to_degrees();
        assert!((degrees - 25.8).abs() < 1e-9);
        for hypothesis in &fit.hypotheses {
            assert!(!hypothesis.unknowns.is_empty(), "{}", hypothesis.name);
        }
        let release = fit.hypotheses.last().unwrap();
        assert!(release.unknowns.iter().all(|&u| fit.unknowns[u].each));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        let complaint = |from: &str, to: &str| {
            assert!(SHIPPED.contains(from), "{from}");
            read(&SHIPPED.replacen(from, to, 1))
                .unwrap_err()
                .to_string()
        };
        let found = complaint("\"floor.tilt[0]\" = {", "\"floor.tlt[0]\" = {");
        assert!(
            found.contains(": parameters.floor.tlt[0]: unknown key; did you mean"),
            "{found}"
        );
        let found = complaint("[0.0, 1.0]", "[0.5, 0.5]");
        assert!(
            found.ends_with("expected [min, max] with min below max"),
            "{found}"
        );
        let found = complaint("\"matpm\"", "\"matmp\"");
        assert!(
            found.contains("experiments[1].method: \"matmp\"; expected one of a-rpm"),
            "{found}"
        );
        let found = complaint("[\"payload.inertia\"]", "[\"payload.mass\"]");
        assert!(
            found.contains("\"payload.mass\"; expected one of [parameters]: floor.tilt[0], "),
            "{found}"
        );
    }
}
