//! Numerical factorisation of one part of the tree: its fronts assembled and eliminated in order.

#[cfg(target_arch = "x86_64")]
use super::lanes::Avx2;
use super::lanes::{Plain, Vector, padded};
use super::noise::Noise;
use super::panel::{Counts, Panel};
use super::symbolic::{Front, PartSize, Symbolic};
use super::update::subtract;

/// What a factorisation found of a matrix.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Inertia {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Eigenvalues that are zero as far as rounding lets one tell.
    pub zero: usize,
    /// Pivots that were handed to a parent.
    pub delayed: usize,
    /// Pivots of order two.
    pub pairs: usize,
}

/// What all parts are given of a matrix.
#[derive(Debug, Clone, Copy)]
pub(super) struct Matrix<'a> {
    pub values: &'a [f64],
    /// Least part of its column's largest entry a pivot may be.
    pub threshold: f64,
    /// See [`super::noise::suspected`].
    pub suspected: f64,
}

/// Where the factors of one front are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Place {
    /// Panel, in `Part::panels`.
    pub panel: usize,
    /// Unknowns and inverse pivots, in `Part::unknowns` and `Part::inverse`.
    pub pivots: usize,
    pub columns: usize,
    pub eliminated: usize,
}

/// The factors of a part's fronts, and the memory to make them.
#[derive(Debug, Clone, Default)]
pub(super) struct Part {
    /// The first of its fronts.
    first: usize,
    pub places: Vec<Place>,
    pub panels: Vec<f64>,
    pub unknowns: Vec<u32>,
    pub inverse: Vec<[f64; 2]>,
    pub inertia: Inertia,
    arenas: [Vec<f64>; 2],
    /// D Lᵀ of the front in work.
    w: Vec<f64>,
    /// Rows of a child in its parent.
    map: Vec<u32>,
    /// See [`Noise`].
    largest: Vec<f64>,
    /// Most rows of a front so far, delayed pivots included.
    pub rows: usize,
}

/// What a front's parent takes over of it.
struct Child<'a> {
    front: &'a Front,
    place: Place,
    /// Its panel and those after it.
    panel: &'a [f64],
    /// Lower triangle of its contribution, by columns.
    contribution: &'a [f64],
}

impl Part {
    /// Memory for a part of this size; delayed pivots may make it grow.
    pub fn new(size: &PartSize, unknowns: usize) -> Self {
        let [rows, columns] = size.largest;
        // A tenth more, so that a few delayed pivots need no other memory.
        let more = |size: usize| size + size / 10 + 64;
        Self {
            first: size.fronts.start,
            places: vec![Place::default(); size.fronts.len()],
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

    /// Factorises the part's fronts; `below` are the parts that come first.
    pub fn factor(&mut self, below: &[Self], symbolic: &Symbolic, matrix: &Matrix<'_>) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the processor has both.
            unsafe { self.factor_avx2(below, symbolic, matrix) };
            return;
        }
        self.factor_with::<Plain>(below, symbolic, matrix);
    }

    /// # Safety
    /// The processor has AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn factor_avx2(&mut self, below: &[Self], symbolic: &Symbolic, matrix: &Matrix<'_>) {
        self.factor_with::<Avx2>(below, symbolic, matrix);
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
            self.open(below, symbolic, local, front, children);
            self.assemble(symbolic, local, front, matrix.values);
            let mut delayed = front.pivots;
            for &child in children {
                self.extend(below, symbolic, local, child as usize, &mut delayed);
            }
            let counts = self.eliminate::<V>(symbolic, local, front, matrix);
            inertia.negative += counts.negative;
            inertia.zero += counts.zero;
            inertia.pairs += counts.pairs;
            inertia.delayed += self.places[local].columns - counts.eliminated;
        }
        self.inertia = inertia;
    }

    /// The part that a front below this one, or of it, is in: `None` for this one.
    #[inline(always)]
    fn other<'a>(&self, below: &'a [Self], symbolic: &Symbolic, front: usize) -> Option<&'a Self> {
        let inside = front >= self.first && front < self.first + self.places.len();
        (!inside).then(|| &below[symbolic.part_of(front)])
    }

    /// Makes room for a front, delayed pivots of its children included.
    #[inline(always)]
    fn open(
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
                |place: Place| place.pivots + place.eliminated..place.pivots + place.columns;
            match self.other(below, symbolic, child) {
                None => {
                    let place = self.places[child - self.first];
                    self.unknowns.extend_from_within(delayed(place));
                }
                Some(part) => {
                    let place = part.places[child - part.first];
                    self.unknowns
                        .extend_from_slice(&part.unknowns[delayed(place)]);
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
        self.places[local] = Place {
            panel,
            pivots,
            columns,
            eliminated: 0,
        };
        // Without children nothing is added to the contribution before it is formed.
        if !children.is_empty() {
            let length = padded(front.border) * padded(front.border);
            self.arenas[front.arena][front.contribution..front.contribution + length].fill(0.0);
        }
    }

    /// Adds the matrix's own entries.
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

    /// Adds a child's contribution, and its delayed pivots, of which the first is to be column
    /// `delayed`.
    #[inline(always)]
    fn extend(
        &mut self,
        below: &[Self],
        symbolic: &Symbolic,
        local: usize,
        child: usize,
        delayed: &mut usize,
    ) {
        let other = self.other(below, symbolic, child);
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
        let of = |part: &Place| part.columns - part.eliminated;
        let from = &symbolic.fronts[child];
        let length = padded(from.border) * from.border;
        let span = from.contribution..from.contribution + length;
        let child = match other {
            None => {
                let place = self.places[child - self.first];
                Child {
                    front: from,
                    place,
                    panel: &before[place.panel..],
                    contribution: &theirs[span],
                }
            }
            Some(part) => {
                let place = part.places[child - part.first];
                Child {
                    front: from,
                    place,
                    panel: &part.panels[place.panel..],
                    contribution: &part.arenas[from.arena][span],
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
        if of(&child.place) > 0 {
            parent.add_delayed(&child, inside, *delayed);
            *delayed += of(&child.place);
        }
    }

    /// Eliminates a front's pivots and forms its contribution.
    #[inline(always)]
    fn eliminate<V: Vector>(
        &mut self,
        symbolic: &Symbolic,
        local: usize,
        front: &Front,
        matrix: &Matrix<'_>,
    ) -> Counts {
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
            noise: Noise {
                pattern: &symbolic.pattern,
                values: matrix.values,
                suspected: matrix.suspected,
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
            let a = &self.panels[place.panel..place.panel + done * ld];
            let w = &self.w[..done * ld + 4];
            let fresh = front.children.is_empty();
            for (tile, columns) in square.chunks_exact_mut(4 * border).enumerate() {
                let j = 4 * tile;
                let row = pivots + j;
                if fresh {
                    subtract::<V, true>(a, w, ld, row, row, columns, border, j);
                } else {
                    subtract::<V, false>(a, w, ld, row, row, columns, border, j);
                }
            }
        }
        counts
    }
}

/// A front that takes over from its children.
struct Parent<'a> {
    front: &'a Front,
    columns: usize,
    panel: &'a mut [f64],
    /// Lower triangle of its contribution, by columns.
    square: &'a mut [f64],
    map: &'a mut Vec<u32>,
}

impl Parent<'_> {
    /// Adds a child's contribution; how many of its rows are pivots here.
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

    /// Moves a child's delayed columns to where they are here, from column `first` on.
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
