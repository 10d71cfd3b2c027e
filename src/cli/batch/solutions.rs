//! `--solutions`: rows as `plan` writes them.

use crate::cli::failure::Failure;
use crate::cli::plan::{Page, add};
use crate::config::BatchFile;
use crate::nlp::Control;
use crate::planner::{Method, Planner, Start};
use crate::report::{FileSet, OutputFolder};
use crate::study::Baselines;
use std::path::Path;

/// The rows with these keys.
pub(super) fn positions(batch: &BatchFile, keys: &[String]) -> Result<Vec<u64>, Failure> {
    let position = |key: &String| {
        let position = key
            .rsplit('-')
            .next()
            .and_then(|digits| digits.parse::<u64>().ok());
        let known = |at: &u64| *at < batch.count() && batch.key(*at) == *key;
        position.filter(known).ok_or_else(|| {
            let (first, last) = (batch.key(0), batch.key(batch.count() - 1));
            let message = format!("--solutions {key}: no such row; expected {first} to {last}");
            Failure::Usage(message)
        })
    };
    keys.iter().map(position).collect()
}

/// Plans these rows once more, which gives the same, and writes all files of theirs. A row without a
/// problem has none.
pub(super) fn write(
    batch: &BatchFile,
    (positions, start): (&[u64], Option<&Start>),
    out: &Path,
) -> Result<(), Failure> {
    let mut planner = Planner::new();
    for position in positions {
        let Ok(row) = batch.row(*position) else {
            continue;
        };
        let (file, problem) = (&row.file, &row.file.problem);
        if file.possible().is_err() {
            continue;
        }
        let method = Method::Collocation(problem.mesh.method);
        let planned = planner.plan_by(method, problem, start, &mut |_| Control::Continue);
        let mut plan = planned.map_err(|error| Failure::planning(file, None, error))?;
        plan.verify(problem);
        let folder = out.join("solutions").join(batch.key(*position));
        let folder = OutputFolder::create(&folder)?;
        let mut set = FileSet::new();
        let baselines = Baselines::of(problem, &plan.discretization);
        add(file, &plan, Page::Made(&baselines), None, &folder, &mut set)?;
        set.write()?;
    }
    Ok(())
}
