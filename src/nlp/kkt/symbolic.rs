//! Symbolic analysis, of the sparsity pattern alone: the fronts, their assembly tree, and the place of
//! every entry.

use super::amalgamation::{self, MergedFront};
use super::graph::Graph;
use super::lists::Lists;
use super::simd::padded;
use super::{Pattern, dissection, matching, ordering, partition};
use std::ops::Range;

/// One front: a dense matrix of pivots, the fully summed unknowns, and of the border, the later
/// unknowns that they are connected to.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// Start of its unknowns, in `Symbolic::rows`: pivots, then border.
    pub rows: usize,
    /// Number of pivots, without delayed ones.
    pub pivots: usize,
    /// Number of unknowns of the border.
    pub border: usize,
    /// Entries of the matrix that are assembled here, in `Symbolic::entries`.
    pub entries: Range<usize>,
    /// Start of the border's relative indices, in `Symbolic::relative`.
    pub relative: usize,
    /// Its children, in `Symbolic::children`.
    pub children: Range<usize>,
    /// Which of the two arenas of its subtree holds its contribution block.
    pub arena: usize,
    /// Start of the contribution block in that arena.
    pub contribution: usize,
    pub is_root: bool,
}

/// The fronts of a subtree and the memory that it needs without delayed pivots.
#[derive(Debug, Clone, Default)]
pub(super) struct SubtreeSize {
    pub fronts: Range<usize>,
    /// Length of each arena of contribution blocks.
    pub arenas: [usize; 2],
    /// Length of all panels.
    pub panels: usize,
    /// Number of pivots.
    pub pivots: usize,
    /// Most rows of a front, and most pivots, padded.
    pub largest: [usize; 2],
}

/// The analysis of a pattern: made once, used for every matrix with that pattern.
#[derive(Debug)]
pub struct Symbolic {
    pub(super) pattern: Pattern,
    /// Children before parents, subtree by subtree.
    pub(super) fronts: Vec<Front>,
    /// Unknowns of all fronts.
    pub(super) rows: Vec<u32>,
    /// (entry of the matrix, place in the front's panel without delayed pivots).
    pub(super) entries: Vec<(u32, u32)>,
    /// Relative indices: for each row of a border its row in the parent, not counting the padding
    /// of the parent's pivots.
    pub(super) relative: Vec<u32>,
    /// Children of all fronts.
    pub(super) children: Vec<u32>,
    /// Subtrees that can be factorised at the same time; the last is the top of the tree, which
    /// waits for them.
    pub(super) subtrees: Vec<SubtreeSize>,
    multiplications: f64,
}

impl Symbolic {
    /// Analyses `pattern`.
    ///
    /// In a pattern of an interior-point method, with the multipliers last, pivots of order two are
    /// foreseen by matching. In others they are found during the factorisation all the same.
    pub fn new(pattern: Pattern) -> Self {
        let partner = matching::pivot_matching(&pattern);
        let graph = Graph::new(&pattern, &partner);
        let mut dense = ordering::dense(&graph);
        for node in dissection::border(&pattern, &graph, &dense) {
            dense[node] = true;
        }
        let (stage, domains) = dissection::dissect(&pattern, &graph, &dense);
        let tree = ordering::minimum_degree(&graph, &stage, &dense);
        let merged = amalgamation::merge(&graph, &tree);
        let (merged, subtrees) = partition::partition(merged, domains);
        Self::build(pattern, &merged, &subtrees)
    }

    fn build(pattern: Pattern, merged: &[MergedFront], subtrees: &[Range<usize>]) -> Self {
        let n = pattern.len();
        let mut position = vec![0_u32; n];
        let mut front_of = vec![0_u32; n];
        let mut next = 0;
        for (index, front) in merged.iter().enumerate() {
            for &unknown in &front.pivots {
                position[unknown as usize] = next;
                front_of[unknown as usize] = index as u32;
                next += 1;
            }
        }
        let mut symbolic = Self {
            fronts: Vec::with_capacity(merged.len()),
            rows: Vec::new(),
            entries: Vec::new(),
            relative: Vec::new(),
            children: Vec::new(),
            subtrees: Vec::with_capacity(subtrees.len()),
            multiplications: 0.0,
            pattern,
        };
        symbolic.lay_out(merged, &position);
        symbolic.place_entries(&position, &front_of);
        symbolic.place_relative(merged);
        symbolic.place_arenas(merged);
        for fronts in subtrees {
            let size = symbolic.place_contributions(fronts.clone());
            symbolic.subtrees.push(size);
        }
        symbolic
    }

    /// Fronts with their unknowns and children.
    fn lay_out(&mut self, merged: &[MergedFront], position: &[u32]) {
        let children = Lists::grouped(merged.len(), merged.len(), |front| merged[front].parent);
        let unknowns: Vec<u32> = merged.iter().flat_map(|of| &of.pivots).copied().collect();
        let rows = merged.iter().map(|of| of.pivots.len() + of.border.len());
        self.rows.reserve(rows.sum());
        self.children.reserve(merged.len());
        for (index, front) in merged.iter().enumerate() {
            let rows = self.rows.len();
            self.rows.extend(&front.pivots);
            let border = self.rows.len();
            let places = front
                .border
                .iter()
                .map(|&unknown| position[unknown as usize]);
            self.rows.extend(places);
            self.rows[border..].sort_unstable();
            for row in &mut self.rows[border..] {
                *row = unknowns[*row as usize];
            }
            let (c, b) = (front.pivots.len(), front.border.len());
            let first_child = self.children.len();
            self.children.extend(children.get(index));
            self.fronts.push(Front {
                rows,
                pivots: c,
                border: b,
                entries: 0..0,
                relative: 0,
                children: first_child..self.children.len(),
                arena: 0,
                contribution: 0,
                is_root: front.parent.is_none(),
            });
            let (c, b) = (c as f64, b as f64);
            self.multiplications += c * (c * c / 3.0 + c * b + b * b);
        }
    }

    /// The place of every entry of the matrix in its front's panel.
    fn place_entries(&mut self, position: &[u32], front_of: &[u32]) {
        let owner = |i: usize, j: usize| {
            if position[i] < position[j] {
                (i, j)
            } else {
                (j, i)
            }
        };
        let mut start = vec![0_usize; self.fronts.len() + 1];
        for (i, j) in self.pattern.entries() {
            start[front_of[owner(i, j).0] as usize + 1] += 1;
        }
        for front in 0..self.fronts.len() {
            start[front + 1] += start[front];
            self.fronts[front].entries = start[front]..start[front + 1];
        }
        // First the entries by front, each with its later unknown; then its place in the panel.
        self.entries = vec![(0, 0); self.pattern.nonzeros()];
        let mut columns = vec![0_u32; self.pattern.nonzeros()];
        for (source, (i, j)) in self.pattern.entries().enumerate() {
            let (early, late) = owner(i, j);
            let place = &mut start[front_of[early] as usize];
            self.entries[*place] = (source as u32, late as u32);
            columns[*place] = early as u32;
            *place += 1;
        }
        let mut local = vec![0_u32; self.pattern.len()];
        for front in &self.fronts {
            let rows = &self.rows[front.rows..front.rows + front.pivots + front.border];
            let ld = padded(front.pivots) + padded(front.border);
            for (place, &unknown) in rows.iter().enumerate() {
                let below = if place < front.pivots {
                    0
                } else {
                    padded(front.pivots) - front.pivots
                };
                local[unknown as usize] = (place + below) as u32;
            }
            let entries = &mut self.entries[front.entries.clone()];
            for ((_, target), &early) in entries.iter_mut().zip(&columns[front.entries.clone()]) {
                *target = local[early as usize] * ld as u32 + local[*target as usize];
            }
        }
    }

    /// Relative indices of every border.
    fn place_relative(&mut self, merged: &[MergedFront]) {
        let mut local = vec![0_u32; self.pattern.len()];
        let total: usize = self.fronts.iter().map(|front| front.border).sum();
        self.relative = vec![0; total];
        let mut next = 0;
        for (front, merged) in self.fronts.iter_mut().zip(merged) {
            front.relative = next;
            next += if merged.parent.is_some() {
                front.border
            } else {
                0
            };
        }
        for front in &self.fronts {
            let rows = &self.rows[front.rows..front.rows + front.pivots + front.border];
            for (place, &unknown) in rows.iter().enumerate() {
                local[unknown as usize] = place as u32;
            }
            for &child in &self.children[front.children.clone()] {
                let child = &self.fronts[child as usize];
                let border = &self.rows[child.rows + child.pivots..][..child.border];
                let relative = &mut self.relative[child.relative..][..child.border];
                for (place, &unknown) in relative.iter_mut().zip(border) {
                    *place = local[unknown as usize];
                }
            }
        }
    }

    /// The arena of each contribution block: not that of its parent's, so that children are read
    /// while the parent's is written.
    fn place_arenas(&mut self, merged: &[MergedFront]) {
        for index in (0..self.fronts.len()).rev() {
            self.fronts[index].arena = match merged[index].parent {
                Some(parent) => 1 - self.fronts[parent].arena,
                None => 0,
            };
        }
    }

    /// Places the contribution blocks of a subtree's fronts; returns the memory it needs.
    fn place_contributions(&mut self, fronts: Range<usize>) -> SubtreeSize {
        let mut size = SubtreeSize {
            fronts: fronts.clone(),
            ..SubtreeSize::default()
        };
        let mut arenas = [Arena::default(), Arena::default()];
        for index in fronts.clone() {
            let front = &mut self.fronts[index];
            let (pivots, border) = (padded(front.pivots), padded(front.border));
            front.contribution = arenas[front.arena].take(border * border);
            size.pivots += front.pivots;
            size.panels += (pivots + border) * front.pivots;
            size.largest[0] = size.largest[0].max(pivots + border);
            size.largest[1] = size.largest[1].max(pivots);
            for child in self.fronts[index].children.clone() {
                let child = self.children[child] as usize;
                // The block of another subtree stays where it is.
                if fronts.contains(&child) {
                    let child = &self.fronts[child];
                    let length = padded(child.border) * padded(child.border);
                    arenas[child.arena].give_back(child.contribution, length);
                }
            }
        }
        size.arenas = arenas.map(|arena| arena.end);
        size
    }

    /// The subtree that a front belongs to.
    pub(super) fn subtree_of(&self, front: usize) -> usize {
        self.subtrees.partition_point(|of| of.fronts.end <= front)
    }

    /// Order of the matrix.
    pub fn len(&self) -> usize {
        self.pattern.len()
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.pattern.is_empty()
    }

    /// The pattern analysed.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Number of fronts.
    pub fn fronts(&self) -> usize {
        self.fronts.len()
    }

    /// Numbers that the factors take, padding included, if no pivot is delayed.
    pub fn factor_size(&self) -> usize {
        self.subtrees.iter().map(|of| of.panels).sum()
    }

    /// Number of subtrees that are factorised at the same time where threads are free.
    pub fn concurrency(&self) -> usize {
        (self.subtrees.len() - 1).max(1)
    }

    /// Multiplications of one factorisation, if no pivot is delayed.
    pub fn multiplications(&self) -> f64 {
        self.multiplications
    }
}

/// First-fit places for contribution blocks in one array.
#[derive(Debug, Default)]
struct Arena {
    /// Free ranges (start, length) below `end`, by start; no two touch.
    free: Vec<(usize, usize)>,
    /// Length that is needed so far.
    end: usize,
}

impl Arena {
    fn take(&mut self, length: usize) -> usize {
        if length == 0 {
            return 0;
        }
        if let Some(index) = self.free.iter().position(|&(_, free)| free >= length) {
            let (start, free) = self.free[index];
            if free == length {
                self.free.remove(index);
            } else {
                self.free[index] = (start + length, free - length);
            }
            return start;
        }
        // Nothing fits: take what is free at the end, and lengthen the array.
        let start = match self.free.last() {
            Some(&(start, free)) if start + free == self.end => {
                self.free.pop();
                start
            }
            _ => self.end,
        };
        self.end = start + length;
        start
    }

    fn give_back(&mut self, start: usize, length: usize) {
        if length == 0 {
            return;
        }
        let index = self.free.partition_point(|&(other, _)| other < start);
        self.free.insert(index, (start, length));
        if let Some(&(next, more)) = self.free.get(index + 1)
            && start + length == next
        {
            self.free[index].1 += more;
            self.free.remove(index + 1);
        }
        if index > 0 {
            let (before, free) = self.free[index - 1];
            if before + free == start {
                self.free[index - 1].1 += self.free[index].1;
                self.free.remove(index);
            }
        }
    }
}
