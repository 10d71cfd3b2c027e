//! Tree partition: the assembly tree in subtrees that can be factorised at the same time.
//!
//! The subtrees have nothing in common; the fronts above them wait for all of them. For a
//! transcription a subtree is an interval of the time axis. The partition depends on the pattern
//! alone and never on the number of threads, and so do the results.

use super::amalgamation::{MergedFront, cost};
use std::ops::Range;

/// Most subtrees, the top of the tree apart.
pub(super) const MAX_SUBTREES: usize = 8;

/// A subtree with more than this times an equal share of the work is divided itself.
const IMBALANCE: f64 = 1.1;

/// Orders the fronts subtree by subtree, children before parents in each, and returns the range of
/// each subtree; the last range is the top of the tree, which waits for all others.
///
/// `domains` is the number of domains that nested dissection has made; with one, the tree stays
/// whole.
pub(super) fn partition(
    merged: Vec<MergedFront>,
    domains: usize,
) -> (Vec<MergedFront>, Vec<Range<usize>>) {
    let count = merged.len();
    if domains == 1 {
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
    let subtree = assign(&merged, &work, IMBALANCE * total / domains as f64);

    // A stable sort by subtree keeps children before parents.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&index| subtree[index]);
    let mut place = vec![0; count];
    for (new, &old) in order.iter().enumerate() {
        place[old] = new;
    }
    let mut ranges = Vec::with_capacity(MAX_SUBTREES + 1);
    let mut start = 0;
    for s in 0..=MAX_SUBTREES {
        let length = order[start..]
            .iter()
            .take_while(|&&i| subtree[i] == s)
            .count();
        ranges.push(start..start + length);
        start += length;
    }
    let mut fronts: Vec<Option<MergedFront>> = merged.into_iter().map(Some).collect();
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

/// The subtree of each front; [`MAX_SUBTREES`] for fronts above all of them.
///
/// Branches of the tree with at most `most` work stay whole. They are dealt out the largest first,
/// each to the subtree with the least work, so that a subtree may consist of several branches.
fn assign(merged: &[MergedFront], work: &[f64], most: f64) -> Vec<usize> {
    let mut root = vec![None; merged.len()];
    let mut branches = Vec::new();
    // From the top: parents come after children.
    for index in (0..merged.len()).rev() {
        let inside = merged[index].parent.and_then(|parent| root[parent]);
        root[index] = inside.or_else(|| {
            (work[index] <= most).then(|| {
                branches.push(index);
                index
            })
        });
    }
    branches.sort_by(|&a, &b| work[b].total_cmp(&work[a]).then(a.cmp(&b)));
    let mut load = [0.0; MAX_SUBTREES];
    let mut subtree_of = vec![MAX_SUBTREES; merged.len()];
    for branch in branches {
        let lighter = |best, s| if load[s] < load[best] { s } else { best };
        let least = (0..MAX_SUBTREES).fold(0, lighter);
        load[least] += work[branch];
        subtree_of[branch] = least;
    }
    root.iter()
        .map(|root| root.map_or(MAX_SUBTREES, |root| subtree_of[root]))
        .collect()
}
