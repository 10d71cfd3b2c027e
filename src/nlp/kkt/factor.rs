//! Numerical factorisation: fronts assembled and eliminated in postorder.

#[cfg(target_arch = "x86_64")]
use super::lanes::Avx2;
use super::lanes::{Plain, Vector};
use super::noise::{self, Noise};
use super::panel::{Counts, Panel};
use super::symbolic::{Front, Symbolic, padded};
use super::update::{largest_finite, subtract};

/// The matrix has a value that is infinite or not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix has a value that is not finite")]
pub struct NotFinite;

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

/// Where the factors of one front are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Place {
    /// Panel, in `Factors::panels`.
    pub panel: usize,
    /// Unknowns and inverse pivots, in `Factors::unknowns` and `Factors::inverse`.
    pub pivots: usize,
    pub columns: usize,
    pub eliminated: usize,
}

/// The factors of a matrix, and the memory to make them.
#[derive(Debug, Clone, Default)]
pub struct Factors {
    pub(super) panels: Vec<f64>,
    pub(super) places: Vec<Place>,
    pub(super) unknowns: Vec<u32>,
    pub(super) inverse: Vec<[f64; 2]>,
    arenas: [Vec<f64>; 2],
    /// D Lᵀ of the front in work.
    w: Vec<f64>,
    /// Rows of a child in its parent.
    map: Vec<u32>,
    /// See [`Noise`].
    suspected: f64,
    largest: Vec<f64>,
    pub(super) vector: Vec<f64>,
}

impl Factors {
    /// Memory for matrices of this pattern; delayed pivots may make it grow.
    pub fn new(symbolic: &Symbolic) -> Self {
        let [rows, columns] = symbolic.largest;
        // A tenth more, so that a few delayed pivots need no other memory.
        let more = |size: usize| size + size / 10 + 64;
        Self {
            panels: Vec::with_capacity(more(symbolic.panels)),
            places: vec![Place::default(); symbolic.fronts.len()],
            unknowns: Vec::with_capacity(more(symbolic.len())),
            inverse: Vec::with_capacity(more(symbolic.len())),
            arenas: symbolic.arenas.map(|length| vec![0.0; length]),
            w: vec![0.0; more(rows) * more(columns)],
            map: Vec::with_capacity(more(rows)),
            suspected: 0.0,
            largest: Vec::with_capacity(symbolic.len()),
            vector: vec![0.0; more(rows)],
        }
    }

    /// Factorises the matrix with these values of the analysed pattern's entries.
    ///
    /// A pivot is at least `threshold` times the largest entry of its column, or is delayed.
    ///
    /// # Errors
    /// [`NotFinite`], the factors then being of no use.
    ///
    /// # Panics
    /// Where `values` are not as many as the pattern's entries.
    pub fn factor(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        assert_eq!(values.len(), symbolic.pattern.nonzeros());
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
        {
            // SAFETY: the processor has both.
            return unsafe { self.factor_avx2(symbolic, values, threshold) };
        }
        self.factor_with::<Plain>(symbolic, values, threshold)
    }

    /// # Safety
    /// The processor has AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn factor_avx2(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        self.factor_with::<Avx2>(symbolic, values, threshold)
    }

    #[inline(always)]
    fn factor_with<V: Vector>(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        let largest = largest_finite::<V>(values).ok_or(NotFinite)?;
        self.suspected = noise::suspected(largest);
        self.largest.clear();
        let mut inertia = Inertia::default();
        self.panels.clear();
        self.unknowns.clear();
        self.inverse.clear();
        for (index, front) in symbolic.fronts.iter().enumerate() {
            self.open(symbolic, index, front);
            self.assemble(symbolic, index, front, values);
            for child in front.children.clone() {
                self.extend(symbolic, index, symbolic.children[child] as usize);
            }
            let counts = self.eliminate::<V>(symbolic, index, values, threshold);
            inertia.negative += counts.negative;
            inertia.zero += counts.zero;
            inertia.pairs += counts.pairs;
            inertia.delayed += self.places[index].columns - counts.eliminated;
        }
        Ok(inertia)
    }

    /// Makes room for a front, delayed pivots of its children included.
    #[inline(always)]
    fn open(&mut self, symbolic: &Symbolic, index: usize, front: &Front) {
        let pivots = self.unknowns.len();
        self.unknowns
            .extend_from_slice(&symbolic.rows[front.rows..front.rows + front.pivots]);
        for &child in &symbolic.children[front.children.clone()] {
            let child = self.places[child as usize];
            let delayed = child.pivots + child.eliminated..child.pivots + child.columns;
            self.unknowns.extend_from_within(delayed);
        }
        let columns = self.unknowns.len() - pivots;
        self.inverse.resize(self.unknowns.len(), [0.0; 2]);
        let ld = padded(columns) + padded(front.border);
        let panel = self.panels.len();
        self.panels.resize(panel + ld * columns, 0.0);
        if self.w.len() < ld * columns + 4 {
            self.w.resize(ld * columns + 4, 0.0);
        }
        if self.vector.len() < ld {
            self.vector.resize(ld, 0.0);
        }
        self.places[index] = Place {
            panel,
            pivots,
            columns,
            eliminated: 0,
        };
        let length = padded(front.border) * padded(front.border);
        self.arenas[front.arena][front.contribution..front.contribution + length].fill(0.0);
    }

    /// Adds the matrix's own entries.
    #[inline(always)]
    fn assemble(&mut self, symbolic: &Symbolic, index: usize, front: &Front, values: &[f64]) {
        let place = self.places[index];
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

    /// Adds a child's contribution, and its delayed pivots.
    #[inline(always)]
    fn extend(&mut self, symbolic: &Symbolic, index: usize, child_index: usize) {
        let (front, child) = (&symbolic.fronts[index], &symbolic.fronts[child_index]);
        let place = self.places[index];
        let (pivots, border) = (padded(place.columns), padded(front.border));
        let ld = pivots + border;
        let skip = pivots - front.pivots;
        self.map.clear();
        let relative = &symbolic.relative[child.relative..child.relative + child.border];
        self.map.extend(relative.iter().map(|&row| {
            let row = row as usize;
            (if row < front.pivots { row } else { row + skip }) as u32
        }));
        let inside = relative.partition_point(|&row| (row as usize) < front.pivots);

        let (first, second) = self.arenas.split_at_mut(1);
        let (mine, theirs) = if front.arena == 0 {
            (&mut first[0], &second[0])
        } else {
            (&mut second[0], &first[0])
        };
        let from_ld = padded(child.border);
        let from = &theirs[child.contribution..child.contribution + from_ld * child.border];
        let panel = &mut self.panels[place.panel..place.panel + ld * place.columns];
        let square = &mut mine[front.contribution..front.contribution + border * border];
        // Rows rise, so that the last one bounds them all.
        let last = self.map.last().map_or(0, |&row| row as usize);
        assert!(last < ld && (inside == child.border || last - pivots < border));
        for (j, column) in from.chunks_exact(from_ld.max(1)).enumerate() {
            let target = self.map[j] as usize;
            let (into, skipped) = if j < inside {
                (&mut panel[target * ld..(target + 1) * ld], 0)
            } else {
                let start = (target - pivots) * border;
                (&mut square[start..start + border], pivots)
            };
            for (&row, value) in self.map[j..].iter().zip(&column[j..]) {
                // SAFETY: a row is less than `ld`; from `inside` on it is at least `pivots` and
                // less than that by `border`.
                unsafe { *into.get_unchecked_mut(row as usize - skipped) += value };
            }
        }
        let delayed = self.places[child_index];
        if delayed.eliminated < delayed.columns {
            self.extend_delayed(symbolic, index, child_index, inside);
        }
    }

    /// Moves a child's delayed columns to where its parent has them.
    #[cold]
    fn extend_delayed(
        &mut self,
        symbolic: &Symbolic,
        index: usize,
        child_index: usize,
        inside: usize,
    ) {
        let (front, child) = (&symbolic.fronts[index], &symbolic.fronts[child_index]);
        let (place, from) = (self.places[index], self.places[child_index]);
        let ld = padded(place.columns) + padded(front.border);
        let from_rows = padded(from.columns);
        let from_ld = from_rows + padded(child.border);
        // Delayed pivots of the children before this one come first.
        let mut first = front.pivots;
        for &other in &symbolic.children[front.children.clone()] {
            if other as usize == child_index {
                break;
            }
            let other = self.places[other as usize];
            first += other.columns - other.eliminated;
        }
        let (before, panel) = self.panels.split_at_mut(place.panel);
        let before = &before[from.panel..];
        for (q, column) in (from.eliminated..from.columns).enumerate() {
            let values = &before[column * from_ld..(column + 1) * from_ld];
            let target = first + q;
            // The pivot block is read from its lower triangle.
            for (p, row) in (column..from.columns).enumerate() {
                panel[target * ld + target + p] += values[row];
            }
            for (i, value) in values[from_rows..from_rows + child.border]
                .iter()
                .enumerate()
            {
                let row = self.map[i] as usize;
                if i < inside {
                    panel[row * ld + target] += value;
                } else {
                    panel[target * ld + row] += value;
                }
            }
        }
    }

    /// Eliminates a front's pivots and forms its contribution.
    #[inline(always)]
    fn eliminate<V: Vector>(
        &mut self,
        symbolic: &Symbolic,
        index: usize,
        values: &[f64],
        threshold: f64,
    ) -> Counts {
        let front = &symbolic.fronts[index];
        let place = self.places[index];
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
            threshold,
            noise: Noise {
                pattern: &symbolic.pattern,
                values,
                suspected: self.suspected,
                largest: &mut self.largest,
            },
        };
        let counts = panel.factor::<V>(front.is_root);
        let done = counts.eliminated;
        self.places[index].eliminated = done;
        if border > 0 {
            let square = &mut self.arenas[front.arena]
                [front.contribution..front.contribution + border * border];
            let a = &self.panels[place.panel..place.panel + done * ld];
            let w = &self.w[..done * ld + 4];
            for (tile, columns) in square.chunks_exact_mut(4 * border).enumerate() {
                let j = 4 * tile;
                subtract::<V>(a, w, ld, pivots + j, pivots + j, columns, border, j);
            }
        }
        counts
    }
}
