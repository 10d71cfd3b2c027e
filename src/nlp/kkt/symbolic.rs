//! What a sparsity pattern alone decides: fronts, their tree, and where every entry goes.

use super::amalgamation::{self, Merged};
use super::graph::Graph;
use super::lanes::padded;
use super::{Pattern, dissection, division, ordering, pairs};
use std::ops::Range;

/// One front: the dense matrix of some pivots and the unknowns they are connected to.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// Unknowns, in `Symbolic::rows`: pivots, then border.
    pub rows: usize,
    pub pivots: usize,
    pub border: usize,
    /// Matrix entries that are assembled here, in `Symbolic::entries`.
    pub entries: Range<usize>,
    /// Places of the border in the parent, in `Symbolic::relative`.
    pub relative: usize,
    /// In `Symbolic::children`.
    pub children: Range<usize>,
    /// Which of the two arenas holds its contribution, and where.
    pub arena: usize,
    pub contribution: usize,
    pub is_root: bool,
}

/// What a part of the tree needs.
#[derive(Debug, Clone, Default)]
pub(super) struct PartSize {
    pub fronts: Range<usize>,
    /// Length of each arena of contributions.
    pub arenas: [usize; 2],
    /// Length of all panels without delayed pivots.
    pub panels: usize,
    pub pivots: usize,
    /// Most rows of a front, and most pivots, padded.
    pub largest: [usize; 2],
}

/// Analysis of a pattern: made once, used for every matrix that has it.
#[derive(Debug)]
pub struct Symbolic {
    pub(super) pattern: Pattern,
    pub(super) fronts: Vec<Front>,
    pub(super) rows: Vec<u32>,
    /// (entry of the matrix, place in the front's panel without delayed pivots).
    pub(super) entries: Vec<(u32, u32)>,
    /// Local rows of the parent, padding of its pivots left out.
    pub(super) relative: Vec<u32>,
    pub(super) children: Vec<u32>,
    /// Those that can be worked on at the same time, then the one that waits for them.
    pub(super) parts: Vec<PartSize>,
    flops: f64,
}

impl Symbolic {
    /// Analyses `pattern`.
    ///
    /// Where it is that of an interior-point method, its multipliers last, pivots of order two are
    /// foreseen; in other matrices they are found all the same.
    pub fn new(pattern: Pattern) -> Self {
        let partner = pairs::partners(&pattern);
        let graph = Graph::new(&pattern, &partner);
        let dense = ordering::dense(&graph);
        let (rounds, stretches) = dissection::rounds(&pattern, &graph, &dense);
        let fronts = ordering::fronts(&graph, &rounds, &dense);
        let merged = amalgamation::merge(&graph, &fronts);
        let (merged, parts) = division::divide(merged, stretches);
        Self::build(pattern, &merged, &parts)
    }

    fn build(pattern: Pattern, merged: &[Merged], parts: &[Range<usize>]) -> Self {
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
            parts: Vec::with_capacity(parts.len()),
            flops: 0.0,
            pattern,
        };
        symbolic.lay_out(merged, &position);
        symbolic.place_entries(&position, &front_of);
        symbolic.place_relative(merged);
        symbolic.place_arenas(merged);
        for fronts in parts {
            let part = symbolic.measure(fronts.clone());
            symbolic.parts.push(part);
        }
        symbolic
    }

    fn lay_out(&mut self, merged: &[Merged], position: &[u32]) {
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); merged.len()];
        for (index, front) in merged.iter().enumerate() {
            if let Some(parent) = front.parent {
                children[parent].push(index as u32);
            }
            let rows = self.rows.len();
            self.rows.extend(&front.pivots);
            let border = self.rows.len();
            self.rows.extend(&front.border);
            self.rows[border..].sort_unstable_by_key(|&unknown| position[unknown as usize]);
            let (c, b) = (front.pivots.len(), front.border.len());
            let first_child = self.children.len();
            self.children.extend(&children[index]);
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
            self.flops += c * (c * c / 3.0 + c * b + b * b);
        }
    }

    /// Where in its front's panel every entry of the matrix goes.
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
        // Sources by front first, then targets front by front.
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

    /// Where in its parent each row of a border stands.
    fn place_relative(&mut self, merged: &[Merged]) {
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

    /// Which arena contributions stand in: children in the other one than their parent.
    fn place_arenas(&mut self, merged: &[Merged]) {
        for index in (0..self.fronts.len()).rev() {
            self.fronts[index].arena = match merged[index].parent {
                Some(parent) => 1 - self.fronts[parent].arena,
                None => 0,
            };
        }
    }

    /// Where the contributions of a part's fronts stand, and what memory it needs.
    fn measure(&mut self, fronts: Range<usize>) -> PartSize {
        let mut part = PartSize {
            fronts: fronts.clone(),
            ..PartSize::default()
        };
        let mut arenas = [Arena::default(), Arena::default()];
        for index in fronts.clone() {
            let front = &mut self.fronts[index];
            let (pivots, border) = (padded(front.pivots), padded(front.border));
            front.contribution = arenas[front.arena].take(border * border);
            part.pivots += front.pivots;
            part.panels += (pivots + border) * front.pivots;
            part.largest[0] = part.largest[0].max(pivots + border);
            part.largest[1] = part.largest[1].max(pivots);
            for child in self.fronts[index].children.clone() {
                let child = self.children[child] as usize;
                // That of another part stays where it is.
                if fronts.contains(&child) {
                    let child = &self.fronts[child];
                    let length = padded(child.border) * padded(child.border);
                    arenas[child.arena].give_back(child.contribution, length);
                }
            }
        }
        part.arenas = arenas.map(|arena| arena.end);
        part
    }

    /// The part a front belongs to.
    pub(super) fn part_of(&self, front: usize) -> usize {
        self.parts.partition_point(|part| part.fronts.end <= front)
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

    /// Numbers kept for the factors, padding included, if no pivot is delayed.
    pub fn factor_size(&self) -> usize {
        self.parts.iter().map(|part| part.panels).sum()
    }

    /// Stretches of the matrix that are factorised at the same time where threads are free.
    pub fn concurrency(&self) -> usize {
        (self.parts.len() - 1).max(1)
    }

    /// Multiplications of one factorisation, if no pivot is delayed.
    pub fn multiplications(&self) -> f64 {
        self.flops
    }
}

/// Places in a stretch of memory, lowest first.
#[derive(Debug, Default)]
struct Arena {
    /// Free stretches (start, length) below `end`, by start.
    free: Vec<(usize, usize)>,
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
        // Nothing fits: lengthen the last stretch, or begin a new one.
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
