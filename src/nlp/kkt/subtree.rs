//! Numerical factorisation of one subtree: its fronts assembled and eliminated, children first.

#![expect(
    unsafe_code,
    reason = "entries and contribution blocks are added without a bounds check a number"
)]

use super::panel::{Panel, PivotCounts};
use super::simd::{Kernel, Vector, dispatch, padded};
use super::symbolic::{Front, SubtreeSize, Symbolic};
use super::update::{Eliminated, Target, rank_update};
use super::zero_pivots::ZeroTest;

/// The inertia of a matrix, and how its factorisation went.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Inertia {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Eigenvalues that are zero to rounding.
    pub zero: usize,
    /// Delayed pivots: those that a front has handed to its parent.
    pub delayed: usize,
    /// Pivots of order two.
    pub two_by_two: usize,
    /// Length of the factors: [`Symbolic::factor_size`], and what delayed pivots add.
    pub entries: usize,
}

/// What all subtrees are given of a matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct Matrix<'a> {
    pub values: &'a [f64],
    /// Pivot threshold: the least part of its column's largest entry that a pivot may be.
    pub threshold: f64,
    /// See [`super::zero_pivots::screen`].
    pub zero_screen: f64,
}

/// Where in its [`Subtree`] the factors of a front are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FrontPlace {
    /// Start of its panel, in `Subtree::panels`.
    pub panel: usize,
    /// Start of its unknowns and inverse pivots, in `Subtree::unknowns` and `Subtree::inverse`.
    pub pivots: usize,
    /// Fully summed columns: its own pivots and those delayed to it.
    pub columns: usize,
    /// Columns eliminated here; the rest are delayed to the parent.
    pub eliminated: usize,
}

/// The factors of a subtree's fronts, and the memory to make them.
#[derive(Debug, Clone, Default)]
pub(super) struct Subtree {
    /// The first of its fronts.
    first: usize,
    pub places: Vec<FrontPlace>,
    /// L of each front, by columns: pivots' rows, then the border's, both padded to whole vectors.
    pub panels: Vec<f64>,
    /// Unknown of each column.
    pub unknowns: Vec<u32>,
    /// Inverse pivots: the diagonal entry, and the one that links a column to the next.
    pub inverse: Vec<[f64; 2]>,
    pub inertia: Inertia,
    /// Contribution blocks; a front's is in the other arena than its children's.
    arenas: [Vec<f64>; 2],
    /// D Lᵀ of the current front, transposed.
    w: Vec<f64>,
    /// Rows of a child's border in its parent.
    map: Vec<u32>,
    /// See [`ZeroTest::largest`].
    largest: Vec<f64>,
    /// Most rows of a front so far, delayed pivots included.
    pub rows: usize,
}

/// A front as its parent assembles it.
struct Child<'a> {
    front: &'a Front,
    place: FrontPlace,
    /// Panels of its subtree, from its own on.
    panel: &'a [f64],
    /// Lower triangle of its contribution block, by columns.
    contribution: &'a [f64],
}

/// The factorisation of a subtree, for whatever vectors the processor has.
struct Factor<'a> {
    subtree: &'a mut Subtree,
    below: &'a [Subtree],
    symbolic: &'a Symbolic,
    matrix: &'a Matrix<'a>,
}

impl Kernel for Factor<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vector>(self) {
        self.subtree
            .factor_with::<V>(self.below, self.symbolic, self.matrix);
    }
}

impl Subtree {
    /// Memory for a subtree of this size; delayed pivots may make it grow.
    pub fn new(size: &SubtreeSize, unknowns: usize) -> Self {
        let [rows, columns] = size.largest;
        // A tenth more, so that a few delayed pivots need no new memory.
        let more = |size: usize| size + size / 10 + 64;
        Self {
            first: size.fronts.start,
            places: vec![FrontPlace::default(); size.fronts.len()],
            panels: Vec::with_capacity(more(size.panels)),
            unknowns: Vec::with_capacity(more(size.pivots)),
            inverse: Vec::with_capacity(more(size.pivots)),
            inertia: Inertia::default(),
            arenas: size.arenas.map(|length| vec![0.0; length]),
            w: vec![0.0; more(rows) * more(columns)],
            map: Vec::with_capacity(more(rows)),
            largest: Vec::with_capacity(unknowns),
            rows: more(rows),
        }
    }

    /// Factorises the fronts; `below` are the subtrees factorised before, whose roots may be
    /// children of these fronts.
    pub fn factor(&mut self, below: &[Self], symbolic: &Symbolic, matrix: &Matrix<'_>) {
        dispatch(Factor {
            subtree: self,
            below,
            symbolic,
            matrix,
        });
    }

    #[inline(always)]
    fn factor_with<V: Vector>(&mut self, below: &[Self], symbolic: &Symbolic, matrix: &Matrix<'_>) {
        self.largest.clear();
        self.panels.clear();
        self.unknowns.clear();
        self.inverse.clear();
        let mut inertia = Inertia::default();
        for local in 0..self.places.len() {
            let front = &symbolic.fronts[self.first + local];
            let children = &symbolic.children[front.children.clone()];
            self.allocate(below, symbolic, local, front, children);
            self.assemble(symbolic, local, front, matrix.values);
            let mut delayed = front.pivots;
            for &child in children {
                self.extend_add(below, symbolic, local, child as usize, &mut delayed);
            }
            let counts = self.eliminate::<V>(symbolic, local, front, matrix);
            inertia.negative += counts.negative;
            inertia.zero += counts.zero;
            inertia.two_by_two += counts.two_by_two;
            inertia.delayed += self.places[local].columns - counts.eliminated;
        }
        inertia.entries = self.panels.len();
        self.inertia = inertia;
    }

    /// The subtree among `below` that owns a front; `None` where it is one of this subtree's.
    #[inline(always)]
    fn owner<'a>(&self, below: &'a [Self], symbolic: &Symbolic, front: usize) -> Option<&'a Self> {
        let inside = front >= self.first && front < self.first + self.places.len();
        (!inside).then(|| &below[symbolic.subtree_of(front)])
    }

    /// Makes room for a front, with columns for the delayed pivots of its children.
    #[inline(always)]
    fn allocate(
        &mut self,
        below: &[Self],
        symbolic: &Symbolic,
        local: usize,
        front: &Front,
        children: &[u32],
    ) {
        let pivots = self.unknowns.len();
        self.unknowns
            .extend_from_slice(&symbolic.rows[front.rows..front.rows + front.pivots]);
        for &child in children {
            let child = child as usize;
            let delayed =
                |place: FrontPlace| place.pivots + place.eliminated..place.pivots + place.columns;
            match self.owner(below, symbolic, child) {
                None => {
                    let place = self.places[child - self.first];
                    self.unknowns.extend_from_within(delayed(place));
                }
                Some(subtree) => {
                    let place = subtree.places[child - subtree.first];
                    self.unknowns
                        .extend_from_slice(&subtree.unknowns[delayed(place)]);
                }
            }
        }
        let columns = self.unknowns.len() - pivots;
        self.inverse.resize(self.unknowns.len(), [0.0; 2]);
        let ld = padded(columns) + padded(front.border);
        let panel = self.panels.len();
        self.panels.resize(panel + ld * columns, 0.0);
        if self.w.len() < ld * columns + 4 {
            self.w.resize(ld * columns + 4, 0.0);
        }
        self.rows = self.rows.max(ld);
        self.places[local] = FrontPlace {
            panel,
            pivots,
            columns,
            eliminated: 0,
        };
        // Without children the contribution block is overwritten when it is formed.
        if !children.is_empty() {
            let length = padded(front.border) * padded(front.border);
            self.arenas[front.arena][front.contribution..front.contribution + length].fill(0.0);
        }
    }

    /// Adds the entries of the matrix.
    #[inline(always)]
    fn assemble(&mut self, symbolic: &Symbolic, local: usize, front: &Front, values: &[f64]) {
        let place = self.places[local];
        let entries = &symbolic.entries[front.entries.clone()];
        let panel = &mut self.panels[place.panel..];
        if place.columns == front.pivots {
            let panel = &mut panel[..(padded(front.pivots) + padded(front.border)) * front.pivots];
            for &(source, target) in entries {
                // SAFETY: the analysis places entries inside the panel of their front, and there
                // are as many values as entries of the pattern.
                unsafe {
                    *panel.get_unchecked_mut(target as usize) +=
                        values.get_unchecked(source as usize);
                }
            }
            return;
        }
        let rows = padded(front.pivots);
        let (ld, wider) = (rows + padded(front.border), padded(place.columns));
        for &(source, target) in entries {
            let (column, row) = (target as usize / ld, target as usize % ld);
            let row = if row < rows { row } else { row - rows + wider };
            panel[column * (wider + padded(front.border)) + row] += values[source as usize];
        }
    }

    /// Extend-add: adds a child's contribution block and takes over its delayed pivots, the first of
    /// them as column `delayed`, which then counts on.
    #[inline(always)]
    fn extend_add(
        &mut self,
        below: &[Self],
        symbolic: &Symbolic,
        local: usize,
        child: usize,
        delayed: &mut usize,
    ) {
        let owner = self.owner(below, symbolic, child);
        let front = &symbolic.fronts[self.first + local];
        let place = self.places[local];
        let ld = padded(place.columns) + padded(front.border);
        let square = padded(front.border) * padded(front.border);
        let [first, second] = &mut self.arenas;
        let (mine, theirs) = if front.arena == 0 {
            (first, second)
        } else {
            (second, first)
        };
        let (before, panel) = self.panels.split_at_mut(place.panel);
        let delayed_by = |place: &FrontPlace| place.columns - place.eliminated;
        let from = &symbolic.fronts[child];
        let length = padded(from.border) * from.border;
        let span = from.contribution..from.contribution + length;
        let child = match owner {
            None => {
                let place = self.places[child - self.first];
                Child {
                    front: from,
                    place,
                    panel: &before[place.panel..],
                    contribution: &theirs[span],
                }
            }
            Some(subtree) => {
                let place = subtree.places[child - subtree.first];
                Child {
                    front: from,
                    place,
                    panel: &subtree.panels[place.panel..],
                    contribution: &subtree.arenas[from.arena][span],
                }
            }
        };
        let mut parent = Parent {
            front,
            columns: place.columns,
            panel: &mut panel[..ld * place.columns],
            square: &mut mine[front.contribution..front.contribution + square],
            map: &mut self.map,
        };
        let inside = parent.add(symbolic, &child);
        if delayed_by(&child.place) > 0 {
            parent.add_delayed(&child, inside, *delayed);
            *delayed += delayed_by(&child.place);
        }
    }

    /// Eliminates a front's pivots and forms its contribution block.
    #[inline(always)]
    fn eliminate<V: Vector>(
        &mut self,
        symbolic: &Symbolic,
        local: usize,
        front: &Front,
        matrix: &Matrix<'_>,
    ) -> PivotCounts {
        let place = self.places[local];
        let (pivots, border) = (padded(place.columns), padded(front.border));
        let ld = pivots + border;
        let a = &mut self.panels[place.panel..place.panel + ld * place.columns];
        for j in 1..place.columns {
            let (left, right) = a.split_at_mut(j * ld);
            for (row, column) in left.chunks_exact(ld).enumerate() {
                right[row] = column[j];
            }
        }
        let mut panel = Panel {
            a,
            w: &mut self.w,
            ld,
            columns: place.columns,
            unknowns: &mut self.unknowns[place.pivots..],
            inverse: &mut self.inverse[place.pivots..],
            threshold: matrix.threshold,
            zero_test: ZeroTest {
                pattern: &symbolic.pattern,
                values: matrix.values,
                screen: matrix.zero_screen,
                largest: &mut self.largest,
            },
            next: None,
        };
        let counts = panel.factor::<V>(front.is_root);
        let done = counts.eliminated;
        self.places[local].eliminated = done;
        if border > 0 {
            let square = &mut self.arenas[front.arena]
                [front.contribution..front.contribution + border * border];
            let from = Eliminated {
                l: &self.panels[place.panel..place.panel + done * ld],
                w: &self.w[..done * ld + 4],
                ld,
            };
            let fresh = front.children.is_empty();
            for (tile, columns) in square.chunks_exact_mut(4 * border).enumerate() {
                let j = 4 * tile;
                let row = pivots + j;
                let target = Target {
                    columns,
                    ld: border,
                    row: j,
                };
                if fresh {
                    rank_update::<V, true>(from, row, row, target);
                } else {
                    rank_update::<V, false>(from, row, row, target);
                }
            }
        }
        counts
    }
}

/// A front while its children are assembled into it.
struct Parent<'a> {
    front: &'a Front,
    columns: usize,
    panel: &'a mut [f64],
    /// Lower triangle of its contribution block, by columns.
    square: &'a mut [f64],
    map: &'a mut Vec<u32>,
}

impl Parent<'_> {
    /// Adds a child's contribution block; returns how many of its rows are pivots here.
    #[inline(always)]
    fn add(&mut self, symbolic: &Symbolic, child: &Child<'_>) -> usize {
        let front = self.front;
        let (pivots, border) = (padded(self.columns), padded(front.border));
        let ld = pivots + border;
        let skip = pivots - front.pivots;
        self.map.clear();
        let relative = &symbolic.relative[child.front.relative..][..child.front.border];
        self.map.extend(relative.iter().map(|&row| {
            let row = row as usize;
            (if row < front.pivots { row } else { row + skip }) as u32
        }));
        let inside = relative.partition_point(|&row| (row as usize) < front.pivots);
        let from_ld = padded(child.front.border);
        // Rows rise, so that the last one bounds them all.
        let last = self.map.last().map_or(0, |&row| row as usize);
        assert!(last < ld && (inside == child.front.border || last - pivots < border));
        for (j, column) in child.contribution.chunks_exact(from_ld.max(1)).enumerate() {
            let target = self.map[j] as usize;
            let (into, skipped) = if j < inside {
                (&mut self.panel[target * ld..(target + 1) * ld], 0)
            } else {
                let start = (target - pivots) * border;
                (&mut self.square[start..start + border], pivots)
            };
            for (&row, value) in self.map[j..].iter().zip(&column[j..]) {
                // SAFETY: a row is less than `ld`; from `inside` on it is at least `pivots` and
                // less than that by `border`.
                unsafe { *into.get_unchecked_mut(row as usize - skipped) += value };
            }
        }
        inside
    }

    /// Adds a child's delayed columns, as columns from `first` on.
    #[cold]
    fn add_delayed(&mut self, child: &Child<'_>, inside: usize, first: usize) {
        let ld = padded(self.columns) + padded(self.front.border);
        let from = child.place;
        let from_rows = padded(from.columns);
        let from_ld = from_rows + padded(child.front.border);
        for (q, column) in (from.eliminated..from.columns).enumerate() {
            let values = &child.panel[column * from_ld..(column + 1) * from_ld];
            let target = first + q;
            // The pivot block is read from its lower triangle.
            for (p, row) in (column..from.columns).enumerate() {
                self.panel[target * ld + target + p] += values[row];
            }
            for (i, value) in values[from_rows..from_rows + child.front.border]
                .iter()
                .enumerate()
            {
                let row = self.map[i] as usize;
                if i < inside {
                    self.panel[row * ld + target] += value;
                } else {
                    self.panel[target * ld + row] += value;
                }
            }
        }
    }
}
