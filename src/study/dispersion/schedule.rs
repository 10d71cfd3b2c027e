//! The steps of all replays, chosen once: as long and of as few stages as the nominal robot and the
//! first samples allow.

use super::base_rate::Frame;
use super::chain::Chain;
use super::error::DispersionError;
use super::follow::{Looking, follow};
use super::gauss::Gauss;
use super::lanes::{LANES, Lanes, Quaternion, Vector};
use super::path::Path;
use super::perturbed::Perturbed;
use super::step::{Bases, MOST_STAGES, Step};

/// Error of the base's motion over the whole plan, rad and m, that the steps are chosen for: at all
/// times that are looked at, of the nominal robot and the first samples.
pub(super) const TOLERANCE: f64 = 1e-9;
/// Stages that are tried.
const STAGES: [usize; 8] = [2, 3, 4, 5, 6, 7, 8, 10];
/// Halvings of a segment after which there is no hope.
const MOST_HALVINGS: u32 = 16;
/// Part of a step by which a time may lie beyond its end through rounding.
const BEYOND: f64 = 1e-9;

/// The steps from t₀ to t_f.
#[derive(Debug)]
pub(super) struct Schedule {
    pub steps: Vec<Step>,
    /// How far the nominal base is at any of the times from where far more steps lead it, rad and m.
    pub error: f64,
}

impl Schedule {
    /// Stages of all steps: momentum is computed that many times a sample.
    pub fn stages(&self) -> usize {
        self.steps.iter().map(|step| step.stages).sum()
    }

    /// Steps along `path`, with places for all of `fractions`, which ascend and end with 1; `probe`
    /// has the nominal robot in its first lane, and the bases begin at `start`.
    pub fn new(
        chain: &Chain,
        path: &Path<'_>,
        fractions: &[f64],
        probe: &Perturbed,
        start: &Bases,
    ) -> Result<Self, DispersionError> {
        let mut maker = Maker {
            chain,
            path,
            probe,
            fractions,
            methods: (0..=MOST_STAGES).map(|s| Gauss::new(s.max(1))).collect(),
            frames: vec![Frame::BASE; chain.links.len()],
            steps: Vec::new(),
            reference: *start,
            taken: *start,
            error: 0.0,
        };
        let share = TOLERANCE / path.segments() as f64;
        for s in 0..path.segments() {
            maker.cover(s, [-1.0, 1.0], share, 0)?;
        }
        Ok(Self {
            steps: maker.steps,
            error: maker.error,
        })
    }
}

struct Maker<'a> {
    chain: &'a Chain,
    path: &'a Path<'a>,
    probe: &'a Perturbed,
    /// Those not covered yet.
    fractions: &'a [f64],
    methods: Vec<Gauss>,
    frames: Vec<Frame>,
    steps: Vec<Step>,
    /// Where far more steps lead.
    reference: Bases,
    /// Where the steps lead.
    taken: Bases,
    error: f64,
}

impl Maker<'_> {
    /// Adds steps from one τ of segment `s` to another.
    fn cover(
        &mut self,
        s: usize,
        ends: [f64; 2],
        tolerance: f64,
        halvings: u32,
    ) -> Result<(), DispersionError> {
        let [from, to] = ends;
        let middle = 0.5 * (from + to);
        let [begin, end] = ends.map(|tau| self.path.fraction(s, tau));
        let limit = end + BEYOND * (end - begin);
        let is_last = s + 1 == self.path.segments() && to == 1.0;
        let count = match is_last {
            true => self.fractions.len(),
            false => self
                .fractions
                .partition_point(|fraction| *fraction <= limit),
        };
        let place = |fraction: &f64| ((fraction - begin) / (end - begin)).clamp(0.0, 1.0);
        let mut places: Vec<f64> = self.fractions[..count].iter().map(place).collect();
        places.push(1.0);

        // Two halves with the most stages.
        let (mut reference, mut bases) = (Vec::new(), self.reference);
        let first = places.partition_point(|place| *place <= 0.5);
        let halves = [
            ([from, middle], &places[..first], 0.0),
            ([middle, to], &places[first..], 0.5),
        ];
        let mut known = true;
        for (ends, places, offset) in halves {
            let inner: Vec<f64> = places.iter().map(|place| 2.0 * (place - offset)).collect();
            let step = self.step(s, ends, MOST_STAGES, &inner);
            known &= self.take(&step, &mut bases, &mut reference);
        }
        for stages in STAGES {
            let step = self.step(s, ends, stages, &places);
            let (mut found, mut after) = (Vec::new(), self.reference);
            if !(known && self.take(&step, &mut after, &mut found)) {
                break;
            }
            let gaps = found.iter().zip(&reference).map(|(a, b)| gap(a, b, LANES));
            if gaps.fold(0.0, f64::max) > tolerance {
                continue;
            }
            // The last place is for this comparison alone.
            let mut step = step;
            step.places.pop();
            let (mut found, mut taken) = (Vec::new(), self.taken);
            self.take(&step, &mut taken, &mut found);
            let pairs = found.iter().zip(&reference);
            self.error = pairs.map(|(a, b)| gap(a, b, 1)).fold(self.error, f64::max);
            (self.taken, self.reference) = (taken, bases);
            self.fractions = &self.fractions[count..];
            self.steps.push(step);
            return Ok(());
        }
        if halvings == MOST_HALVINGS {
            return Err(DispersionError::TooFast {
                fraction: self.path.fraction(s, middle),
            });
        }
        self.cover(s, [from, middle], 0.5 * tolerance, halvings + 1)?;
        self.cover(s, [middle, to], 0.5 * tolerance, halvings + 1)
    }

    fn step(&self, s: usize, [from, to]: [f64; 2], stages: usize, places: &[f64]) -> Step {
        let seconds = (to - from) * self.path.unit(s);
        let gauss = &self.methods[stages];
        Step::new(gauss, seconds, places, |c| {
            self.path.at(s, from + c * (to - from))
        })
    }

    fn take(&mut self, step: &Step, bases: &mut Bases, found: &mut Vec<Bases>) -> bool {
        follow(
            std::slice::from_ref(step),
            self.chain,
            self.probe,
            &mut self.frames,
            bases,
            Looking::Poses(found),
        )
    }
}

/// Largest distance of bases in rad and m, in the first `lanes`. Not a number is infinite.
fn gap(a: &Bases, b: &Bases, lanes: usize) -> f64 {
    let Quaternion(p) = a.orientation.normalised();
    let Quaternion(q) = b.orientation.normalised();
    let (Vector(x), Vector(y)) = (a.position, b.position);
    let of = |pairs: &[(Lanes, Lanes)], l: usize| {
        let squares = pairs.iter().map(|(a, b)| (a.0[l] - b.0[l]).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let turns: Vec<_> = p.into_iter().zip(q).collect();
    let moves: Vec<_> = x.into_iter().zip(y).collect();
    let gaps = (0..lanes).flat_map(|l| {
        // The whole angle is twice that of the quaternions.
        let angle = (a.angle.0[l] - b.angle.0[l]).abs();
        [2.0 * of(&turns, l), of(&moves, l), angle]
    });
    let largest = gaps.map(|gap| if gap.is_nan() { f64::INFINITY } else { gap });
    largest.fold(0.0, f64::max)
}
