//! Batch files: many problems, as one problem with keys that vary or as JSON lines of whole ones.
//!
//! | file | does |
//! | --- | --- |
//! | `cell` | one value of a key |
//! | `draw` | seeded random values |
//! | `json` | JSON as a document |
//! | `lines` | JSON lines of whole problems |
//! | `read` | the tables of a batch file |
//! | `table` | columns of CSV and Parquet files |
//! | `vary` | the values of a row |
//!
//! docs/batches.md describes the format.

mod cell;
mod draw;
mod json;
mod lines;
mod read;
mod table;
mod vary;

pub use cell::{Cell, CellKind};

use super::document::Node;
use super::files::Files;
use super::item::Item;
use super::overrides::lay;
use super::{ConfigError, Overrides, Place, ProblemFile};
use lines::Lines;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::time::Duration;
use table::Tables;
use vary::Sweep;

/// Rows that are tried when a batch is loaded.
const TRIED: u64 = 16;

/// Many problems, of which each is made when it is asked for.
#[derive(Debug)]
pub struct BatchFile {
    /// Path of the file, as given.
    pub path: String,
    /// Its text; empty for JSON lines.
    pub text: String,
    rows: Rows,
    overrides: Overrides,
    fingerprint: String,
}

#[derive(Debug)]
enum Rows {
    /// One problem, varied.
    Sweep(Box<Base>),
    /// A problem a line.
    Lines(Lines),
}

/// The problem that is varied.
#[derive(Debug)]
struct Base {
    file: ProblemFile,
    sweep: Sweep,
    kinds: Vec<CellKind>,
}

/// One problem of a batch.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct BatchRow {
    /// The problem with the files it is made of. Its overrides are those of `plan --set`: planned with
    /// them alone, it is the same.
    pub file: ProblemFile,
    /// What the problem has at the keys that vary, in their order, read back from it.
    pub cells: Vec<Cell>,
}

impl BatchFile {
    /// Reads a batch file, TOML or JSON lines (by a name that ends in `.jsonl`), with a limit on the
    /// time of each plan where there is one. The first rows are tried.
    ///
    /// # Errors
    /// [`ConfigError`] for what is found wrong in it or in its base problem, and for a key whose value
    /// does not get into the problem. A problem of JSON lines, or one that some value makes impossible,
    /// is for its own row to say.
    pub fn load(path: &Path, time_limit: Option<Duration>) -> Result<Self, ConfigError> {
        let mut overrides = Overrides::default();
        if let Some(limit) = time_limit {
            let limit = limit.as_secs_f64();
            let flag = format!("--time-limit {limit:?}");
            overrides.number(&flag, "solver.time_limit", limit);
        }
        let is_lines = path
            .extension()
            .is_some_and(|end| end.eq_ignore_ascii_case("jsonl"));
        match is_lines {
            true => Self::lines(path, overrides),
            false => Self::sweep(path, overrides),
        }
    }

    fn lines(path: &Path, overrides: Overrides) -> Result<Self, ConfigError> {
        let lines = Lines::open(path)?;
        Ok(Self {
            path: path.display().to_string(),
            text: String::new(),
            fingerprint: fingerprint(&[&lines.hash]),
            rows: Rows::Lines(lines),
            overrides,
        })
    }

    fn sweep(path: &Path, overrides: Overrides) -> Result<Self, ConfigError> {
        let source = Files::Disk.document(path, "a batch file")?;
        let root = Item::root(&source.document)
            .section(&["schema", "problem", "seed", "count", "vary"])?;
        super::schema(&root)?;
        let expected = "the path of a problem file, relative to this file";
        let problem = root.require("problem", expected)?.text(expected)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let sweep = read::sweep(&root, &mut Tables::of(folder))?;
        // Read as it is, for the message of a fault in it; whether its own task is possible matters
        // no more than that of any other row.
        let file = ProblemFile::read(&folder.join(problem), Files::Disk, &overrides)?;
        let fingerprint = fingerprint_of(&sweep, &file);
        let kinds = sweep.row(0).iter().map(Cell::kind).collect();
        let batch = Self {
            path: source.path,
            text: source.text,
            rows: Rows::Sweep(Box::new(Base { file, sweep, kinds })),
            overrides,
            fingerprint,
        };
        batch.try_out()?;
        Ok(batch)
    }

    /// Makes the first rows. A row that is refused for its values says so itself, but a key must be one
    /// that gets into the problem.
    fn try_out(&self) -> Result<(), ConfigError> {
        let mut refused = None;
        for position in 0..self.count().min(TRIED) {
            match self.row(position) {
                Ok(_) => return Ok(()),
                Err(error @ (ConfigError::UnknownKey { .. } | ConfigError::Unvaried { .. })) => {
                    return Err(error);
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        refused.map_or(Ok(()), Err)
    }

    /// How many rows there are.
    pub fn count(&self) -> u64 {
        match &self.rows {
            Rows::Sweep(base) => base.sweep.count,
            Rows::Lines(lines) => lines.count(),
        }
    }

    /// What the random values begin with; 0 where nothing is drawn.
    pub fn seed(&self) -> u64 {
        match &self.rows {
            Rows::Sweep(base) => base.sweep.seed,
            Rows::Lines(_) => 0,
        }
    }

    /// The keys that vary, with what their values are.
    pub fn keys(&self) -> Vec<(String, CellKind)> {
        match &self.rows {
            Rows::Sweep(base) => {
                let names = base.sweep.vary.iter().map(|vary| vary.name.clone());
                names.zip(base.kinds.iter().copied()).collect()
            }
            Rows::Lines(_) => Vec::new(),
        }
    }

    /// SHA-256 of all that the rows follow from, hexadecimal: problem, robot, seed and values, but
    /// neither their number nor the time limit.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The problem that is varied; `None` for JSON lines.
    pub fn base(&self) -> Option<&ProblemFile> {
        match &self.rows {
            Rows::Sweep(base) => Some(&base.file),
            Rows::Lines(_) => None,
        }
    }

    /// The key of a row: a function of the seed and of the position alone.
    pub fn key(&self, position: u64) -> String {
        format!("{}-{position:08}", self.seed())
    }

    /// The row at `position`, below [`count`](Self::count); a function of the seed and of the position
    /// alone. Whether its task is possible is left to be asked ([`ProblemFile::possible`]).
    ///
    /// # Errors
    /// [`ConfigError`] where its values make no problem.
    pub fn row(&self, position: u64) -> Result<BatchRow, ConfigError> {
        match &self.rows {
            Rows::Sweep(base) => base.row(position, &self.overrides),
            Rows::Lines(lines) => {
                let mut document = lines.document(position)?;
                let text = lines::toml(&document);
                self.overrides.apply(&mut document)?;
                let source = (PathBuf::from(&self.path), text);
                let flags = self.overrides.flags();
                let file = ProblemFile::of(document, source, Files::Disk, flags)?;
                let cells = Vec::new();
                Ok(BatchRow { file, cells })
            }
        }
    }
}

impl Base {
    fn row(&self, position: u64, overrides: &Overrides) -> Result<BatchRow, ConfigError> {
        let given = self.sweep.row(position);
        let mut document: Node = self.file.document().clone();
        let mut flags = overrides.flags();
        for (vary, cell) in self.sweep.vary.iter().zip(&given) {
            // With its line: what stands in a file is not trusted as the command line is.
            let place = Place {
                source: format!("row {position}: {}", vary.place.source).into(),
                line: vary.place.line,
            };
            lay(&mut document, &vary.key, &place, &cell.value(&place))?;
            flags.push(format!("--set {}={}", vary.name, cell.toml()));
        }
        let robot = &self.file.robot;
        let held = [(robot.path.as_str(), robot.text.as_str())];
        let source = (PathBuf::from(&self.file.path), self.file.text.clone());
        let file = ProblemFile::of(document, source, Files::Held(&held), flags)?;
        let back = |(vary, given): (&vary::Vary, &Cell)| {
            let found = file.read_back(&vary.key, given);
            match found {
                Some(found) if found == *given => Ok(found),
                found => Err(ConfigError::Unvaried {
                    place: vary.place.clone(),
                    key: vary.name.clone(),
                    given: given.toml(),
                    found: found.map(|found| found.toml()),
                }),
            }
        };
        let cells = self.sweep.vary.iter().zip(&given).map(back);
        let cells = cells.collect::<Result<_, _>>()?;
        Ok(BatchRow { file, cells })
    }
}

/// That of all that the rows of a sweep follow from; how many they are is no part of it.
fn fingerprint_of(sweep: &Sweep, file: &ProblemFile) -> String {
    let vary = sweep.vary.iter();
    let vary = vary.map(|vary| format!("{}: {:?}", vary.name, vary.values));
    let parts = [
        sweep.seed.to_string(),
        file.text.clone(),
        file.robot.text.clone(),
    ];
    let parts: Vec<String> = parts.into_iter().chain(vary).collect();
    let parts: Vec<&[u8]> = parts.iter().map(String::as_bytes).collect();
    fingerprint(&parts)
}

/// SHA-256 of `parts`, each with its length, hexadecimal.
fn fingerprint(parts: &[&[u8]]) -> String {
    let mut hash = Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    let digest = hash.finalize();
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
