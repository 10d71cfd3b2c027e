//! The distinct optima of a search, for the terminal.

use super::format::{cost, degrees, seconds};
use crate::planner::floor::LowerBounds;
use crate::study::search::{Optima, Optimum};
use comfy_table::{CellAlignment, Table, presets};

/// Rows shown; the file has all of them.
const SHOWN: usize = 12;

/// A table of the optima that `optima` found, the best first, under a line that says of how many starts.
pub fn optima(optima: &Optima) -> String {
    let Optima { found, .. } = optima;
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_header([
        "",
        "cost J",
        "largest base angle",
        "final",
        "hits",
        "first start",
        "",
    ]);
    for (k, one) in found.iter().take(SHOWN).enumerate() {
        table.add_row([
            (k + 1).to_string(),
            cost(one.objective),
            degrees(one.max_base_attitude),
            degrees(one.final_base_attitude),
            one.hits.to_string(),
            one.kind.to_string(),
            how(one),
        ]);
    }
    for column in [0, 1, 2, 3, 4] {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let indented = |line: &str| format!(" {}\n", line.trim_end());
    let rows: String = table.to_string().lines().map(indented).collect();
    let more = match found.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!("  and {more} more on the first mesh\n"),
    };
    let heading = headline(optima);
    let least = optima.bounds.as_ref().map(lower_bounds);
    let least = least
        .map(|words| format!("\n  {words}\n"))
        .unwrap_or_default();
    match found.is_empty() {
        true => format!("  {heading}\n"),
        false => format!("  {heading}\n\n{rows}{more}{least}"),
    }
}

/// What no motion can do better than.
fn lower_bounds(bounds: &LowerBounds) -> String {
    format!(
        "no motion keeps the base angle below {} all along, or below {} at the end (dynamic programming)",
        degrees(bounds.max_base_attitude),
        degrees(bounds.final_base_attitude),
    )
}

/// How many starts ended at how many optima.
pub(super) fn headline(optima: &Optima) -> String {
    let Optima {
        found,
        tried,
        solved,
        seed,
        time,
        ..
    } = optima;
    let several = |count: usize, what: &str, plural: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {plural}"),
    };
    format!(
        "search: {}, {solved} solved, {}, seed {seed}, {}; others may exist",
        several(*tried, "start", "starts"),
        several(found.len(), "distinct optimum", "distinct optima"),
        seconds(*time),
    )
}

/// How its refinement ended.
fn how(one: &Optimum) -> String {
    match one.status {
        Some(status) => status.words().into(),
        None => "first mesh".into(),
    }
}
