//! Amalgamation: a front is merged with its parent where fewer fronts are worth the added zeros.

use super::graph::Graph;
use super::lists::Lists;
use super::ordering::AssemblyTree;
use super::simd::padded;

/// A front after amalgamation, by its unknowns.
#[derive(Debug, Default)]
pub(super) struct MergedFront {
    pub pivots: Vec<u32>,
    pub border: Vec<u32>,
    pub parent: Option<usize>,
}

/// Estimated time of a front of `c` pivots and `b` other rows, in units of a vector operation.
pub(super) fn cost(c: usize, b: usize) -> f64 {
    let rows = (padded(c) + padded(b)) as f64 / 4.0;
    let (c, b) = (c as f64, b as f64);
    let panel = c * c / 2.0 * rows;
    let search = c * (2.0 * rows + 30.0);
    let update = c * b * (b + 4.0) / 8.0;
    let contribution = b * (b + 4.0);
    let solve = 4.0 * c * rows + 4.0 * b;
    panel + search + update + contribution + solve + 120.0
}

/// Merges fronts with their parents; returns the fronts in postorder.
pub(super) fn merge(graph: &Graph, tree: &AssemblyTree) -> Vec<MergedFront> {
    let count = tree.len();
    let unknowns = |nodes: &[u32]| -> usize {
        nodes
            .iter()
            .map(|&node| graph.weight(node as usize) as usize)
            .sum()
    };
    let mut pivots: Vec<usize> = (0..count).map(|f| unknowns(tree.pivots.get(f))).collect();
    let border: Vec<usize> = (0..count).map(|f| unknowns(tree.borders.get(f))).collect();
    let mut into: Vec<usize> = (0..count).collect();
    for front in 0..count {
        let Some(parent) = tree.parents[front] else {
            continue;
        };
        let (c, b) = (pivots[front], border[front]);
        let apart = cost(c, b) + cost(pivots[parent], border[parent]);
        let together = cost(c + pivots[parent], border[parent]);
        if together < apart {
            into[front] = parent;
            pivots[parent] += c;
        }
    }
    // Parents come after children, so that one pass from the end finds where each front ends up.
    for front in (0..count).rev() {
        into[front] = into[into[front]];
    }
    let stays = |front: usize| into[front] == front;
    let parent = |front: usize| tree.parents[front].map(|parent| into[parent]);
    let mut children = Lists::grouped(count, count, |front| parent(front).filter(|_| stays(front)));
    order_children(&mut children, &border);
    let roots = (0..count).filter(|&front| stays(front) && parent(front).is_none());
    let members = Lists::grouped(count, count, |front| Some(into[front]));
    let mut place = vec![usize::MAX; count];
    let mut merged: Vec<MergedFront> = Vec::with_capacity(count);
    let expand = |nodes: &[u32], unknowns: &mut Vec<u32>| {
        for &node in nodes {
            unknowns.extend_from_slice(graph.unknowns(node as usize));
        }
    };
    for front in postorder(roots, &children) {
        place[front] = merged.len();
        for &child in children.get(front) {
            merged[place[child as usize]].parent = Some(place[front]);
        }
        let mut whole = MergedFront {
            pivots: Vec::with_capacity(pivots[front]),
            border: Vec::with_capacity(border[front]),
            parent: None,
        };
        for &member in members.get(front) {
            expand(tree.pivots.get(member as usize), &mut whole.pivots);
        }
        expand(tree.borders.get(front), &mut whole.border);
        merged.push(whole);
    }
    merged
}

/// Orders children so that the waiting contribution blocks take the least memory.
///
/// Liu's rule (doi:10.1145/7921.11325): by decreasing peak memory less the memory that stays.
fn order_children(children: &mut Lists, border: &[usize]) {
    let left: Vec<usize> = border.iter().map(|&b| padded(b) * padded(b)).collect();
    let mut peak = vec![0; border.len()];
    // Children have lower numbers than their parents.
    for front in 0..border.len() {
        let children = children.get_mut(front);
        children
            .sort_by_key(|&child| std::cmp::Reverse(peak[child as usize] - left[child as usize]));
        let mut waiting = 0;
        for &child in children.iter() {
            peak[front] = peak[front].max(waiting + peak[child as usize]);
            waiting += left[child as usize];
        }
        peak[front] = peak[front].max(waiting + left[front]);
    }
}

/// Every front after all of its children.
fn postorder(roots: impl Iterator<Item = usize>, children: &Lists) -> Vec<usize> {
    let mut order = Vec::new();
    let mut stack: Vec<(usize, usize)> = Vec::new();
    for root in roots {
        stack.push((root, 0));
        while let Some((front, next)) = stack.last_mut() {
            match children.get(*front).get(*next) {
                Some(&child) => {
                    *next += 1;
                    stack.push((child as usize, 0));
                }
                None => {
                    order.push(*front);
                    stack.pop();
                }
            }
        }
    }
    order
}
