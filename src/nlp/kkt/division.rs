//! Division of the assembly tree into parts that can be worked on at the same time.
//!
//! For a transcription these are stretches of the time axis: the parts are subtrees, which have
//! nothing in common, and what is left above them, which waits for all of them. The division
//! depends on the structure alone, never on the number of threads, so that neither do the results.

use super::amalgamation::{Merged, cost};
use std::ops::Range;

/// Parts beside the one above them.
pub(super) const PARTS: usize = 8;

/// How much more than an equal share of the work a subtree may have and not be divided itself.
const SLACK: f64 = 1.1;

/// Puts the fronts of each part next to each other, children before parents still, and returns
/// where the parts are; the last one is what waits for all others. The order of elimination is
/// one that has cut the matrix into so many `stretches`.
pub(super) fn divide(merged: Vec<Merged>, stretches: usize) -> (Vec<Merged>, Vec<Range<usize>>) {
    let count = merged.len();
    if stretches == 1 {
        return (merged, std::iter::once(0..count).collect());
    }
    let own: Vec<f64> = merged
        .iter()
        .map(|front| cost(front.pivots.len(), front.border.len()))
        .collect();
    let mut work = own.clone();
    for (index, front) in merged.iter().enumerate() {
        if let Some(parent) = front.parent {
            work[parent] += work[index];
        }
    }
    let total: f64 = own.iter().sum();
    let part = assign(&merged, &work, SLACK * total / stretches as f64);

    // A stable sort by part: within each the order stays one of children before parents.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&index| part[index]);
    let mut place = vec![0; count];
    for (new, &old) in order.iter().enumerate() {
        place[old] = new;
    }
    let mut ranges = Vec::with_capacity(PARTS + 1);
    let mut start = 0;
    for p in 0..=PARTS {
        let length = order[start..].iter().take_while(|&&i| part[i] == p).count();
        ranges.push(start..start + length);
        start += length;
    }
    let mut fronts: Vec<Option<Merged>> = merged.into_iter().map(Some).collect();
    let ordered = order
        .iter()
        .map(|&old| {
            let mut front = fronts[old].take().expect("each front once");
            front.parent = front.parent.map(|parent| place[parent]);
            front
        })
        .collect();
    (ordered, ranges)
}

/// The part of every front: `PARTS` for what is above all.
fn assign(merged: &[Merged], work: &[f64], grain: f64) -> Vec<usize> {
    // Whole subtrees small enough, found from the top: parents come after children.
    let mut root = vec![None; merged.len()];
    let mut subtrees = Vec::new();
    for index in (0..merged.len()).rev() {
        let inside = merged[index].parent.and_then(|parent| root[parent]);
        root[index] = inside.or_else(|| {
            (work[index] <= grain).then(|| {
                subtrees.push(index);
                index
            })
        });
    }
    // The largest first, each to the part that has least.
    subtrees.sort_by(|&a, &b| work[b].total_cmp(&work[a]).then(a.cmp(&b)));
    let mut load = [0.0; PARTS];
    let mut part_of = vec![PARTS; merged.len()];
    for subtree in subtrees {
        let least = (0..PARTS).fold(0, |least, p| if load[p] < load[least] { p } else { least });
        load[least] += work[subtree];
        part_of[subtree] = least;
    }
    root.iter()
        .map(|root| root.map_or(PARTS, |root| part_of[root]))
        .collect()
}
