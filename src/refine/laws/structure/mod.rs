//! The law of structure: breakpoints stand where controls switch, and the solve places them.
//!
//! After the first mesh, switches and arcs on bounds are looked for (`switches`); the next mesh has a
//! free breakpoint at each switch, controls fixed on their bounds in the arcs, and ends without a bend
//! where a control that is free meets an arc on a bound. Degrees follow from the decay of Legendre
//! coefficients (`degrees`). A control that rings (`ringing`) shows no switches. Where no structure is
//! found, or a solve with it fails, the paper's law goes on.
//!
//! Derived in docs/algorithms.md#law-of-structure.

mod degrees;
mod ringing;
mod switches;

use super::adaptive;
use crate::collocation::{Mesh, MeshError};
use crate::numeric::largest_or_nan;
use crate::ocp::Interval;
use crate::refine::{Assessment, Decision, Facts, Record, Refined, RefinementLaw, Settings};
use crate::transcription::{FixedControl, FixedRow, Knot, SmoothState, Structure};
use switches::{Found, What};

/// Points of a segment in which nothing is to be resolved.
const FEWEST: usize = 3;
/// Segments narrower than this part of the narrowest before are layers.
const LAYER: f64 = 0.5;
/// Most points a segment gets at once.
const MOST_MORE: usize = 6;
/// Most points of a segment with a free control on the first mesh with a structure, and of one without: the
/// mesh before tells no more of the solution.
const MOST_AT_FIRST_FREE: usize = 14;
const MOST_AT_FIRST_FIXED: usize = 5;
/// Most switches for which a structure is tried.
const MOST_SWITCHES: usize = 40;
/// Part of the tolerance that a raised degree aims at.
const RAISE_AIM: f64 = 0.5;
/// Part of the distance to the next fixed breakpoint that a free one keeps from it.
const LEAST_WIDTH: f64 = 1e-3;

#[derive(Debug)]
pub(super) struct Law<'a>(pub &'a Settings);

impl RefinementLaw for Law<'_> {
    fn first_mesh(&self) -> Result<Mesh, MeshError> {
        adaptive::Law(self.0).first_mesh()
    }

    fn describe(&self) -> String {
        let paper = adaptive::Law(self.0).describe();
        format!("{paper}, breakpoints where controls switch")
    }

    fn is_last(&self, records: &[Record]) -> bool {
        adaptive::Law(self.0).is_last(records)
    }

    fn refine(&self, assessment: &Assessment<'_>) -> Option<Refined> {
        let paper = adaptive::Law(self.0);
        let Some(facts) = assessment.facts.filter(|_| !assessment.structure_failed) else {
            return paper.refine(assessment);
        };
        if assessment.errors.max() <= self.0.tolerance {
            // Only bounds between the nodes are left.
            return match assessment.structure.is_empty() {
                true => paper.refine(assessment),
                false => None,
            };
        }
        let next = match assessment.structure.is_empty() {
            true => {
                let found = switches::find(assessment, facts);
                self.structured(assessment, facts, &found)
            }
            false => {
                // A better mesh may show switches that the first one did not.
                let found = switches::find(assessment, facts);
                match found.switches.len() > assessment.structure.knots.len() {
                    true => self.structured(assessment, facts, &found),
                    false => self.refined(assessment, facts),
                }
            }
        };
        next.or_else(|| paper.refine(assessment))
    }
}

/// A mesh in the making: each breakpoint with its window where it is free.
struct Draft {
    breakpoints: Vec<(f64, Option<Interval>)>,
    /// Of each segment, its points.
    points: Vec<usize>,
    /// Of each segment and control, the value that it is fixed to.
    fixed: Vec<Vec<Option<f64>>>,
    /// The same of each path row.
    rows: Vec<Vec<Option<f64>>>,
}

impl Law<'_> {
    /// The first mesh with a structure.
    fn structured(
        &self,
        assessment: &Assessment<'_>,
        facts: &Facts<'_>,
        found: &Found,
    ) -> Option<Refined> {
        if found.switches.is_empty() || found.switches.len() > MOST_SWITCHES {
            return None;
        }
        let settings = self.0;
        let mesh = &assessment.solution.mesh;
        let way_points = facts.formulation.way_point_fractions();
        let free = |at: f64| !way_points.contains(&at);
        let mut breakpoints: Vec<(f64, Option<Interval>)> = vec![(0.0, None), (1.0, None)];
        breakpoints.extend(way_points.iter().map(|&at| (at, None)));
        let switches = found.switches.iter().filter(|switch| free(switch.at));
        breakpoints.extend(switches.map(|switch| {
            let window = facts.autonomous.then_some(switch.window);
            (switch.at, window)
        }));
        breakpoints.sort_by(|a, b| a.0.total_cmp(&b.0));
        breakpoints.dedup_by(|b, a| a.0 == b.0);
        let narrowest = (0..mesh.segments()).map(|s| mesh.width(s));
        let narrowest = narrowest.fold(1.0, f64::min);
        let noise = median(&assessment.errors.by_segment);
        let mut draft = Draft {
            breakpoints: vec![breakpoints[0]],
            points: Vec::new(),
            fixed: Vec::new(),
            rows: Vec::new(),
        };
        for pair in breakpoints.windows(2) {
            let (from, to) = (pair[0].0, pair[1].0);
            let middle = 0.5 * (from + to);
            let on = |what: What| {
                let mut arcs = found.arcs.iter();
                let arc = arcs.find(|a| a.what == what && a.from < middle && middle < a.to);
                arc.map(|arc| arc.value)
            };
            let controls = 0..assessment.solution.controls;
            let fixed: Vec<_> = controls.map(|j| on(What::Control(j))).collect();
            let paths = 0..facts.formulation.path.len();
            let rows: Vec<_> = paths.map(|p| on(What::Row(p))).collect();
            let points = match to - from < LAYER * narrowest {
                true if fixed.iter().all(Option::is_some) => FEWEST,
                true => FEWEST + 1,
                false => degrees::needed(
                    assessment.trajectory,
                    (from, to),
                    noise,
                    settings.tolerance,
                    FEWEST,
                ),
            };
            // The mesh before is too coarse to tell high degrees: more of them are for the next.
            let free = fixed.iter().filter(|value| value.is_none()).count();
            let most = match free > rows.iter().flatten().count() {
                true => MOST_AT_FIRST_FREE,
                false => MOST_AT_FIRST_FIXED,
            };
            draft.breakpoints.push(pair[1]);
            draft.points.push(points.min(most).min(settings.max_points));
            draft.fixed.push(fixed);
            draft.rows.push(rows);
        }
        let decisions = vec![Decision::Divide(2); mesh.segments()];
        draft.finish(facts, decisions)
    }

    /// The next mesh with the structure that there is: degrees raised, segments divided.
    fn refined(&self, assessment: &Assessment<'_>, facts: &Facts<'_>) -> Option<Refined> {
        let settings = self.0;
        let old = &assessment.trajectory.mesh;
        let structure = assessment.structure;
        let at = old.breakpoints();
        let free = |b: usize| structure.knots.iter().any(|knot| knot.breakpoint == b);
        let window = |b: usize| {
            free(b).then(|| {
                let (left, right) = (at[b] - at[b - 1], at[b + 1] - at[b]);
                Interval::new(at[b] - 0.5 * left, at[b] + 0.5 * right)
            })
        };
        let mut draft = Draft {
            breakpoints: vec![(0.0, None)],
            points: Vec::new(),
            fixed: Vec::new(),
            rows: Vec::new(),
        };
        let mut decisions = Vec::new();
        for s in 0..old.segments() {
            let n = old.rule(s).len();
            let error = assessment.errors.worst(s).1;
            let fixed: Vec<Option<f64>> = (0..assessment.solution.controls)
                .map(|control| {
                    let mut fixed = structure.fixed.iter();
                    let fixed = fixed.find(|f| f.segment == s && f.control == control);
                    fixed.map(|fixed| fixed.value)
                })
                .collect();
            let rows: Vec<Option<f64>> = (0..facts.formulation.path.len())
                .map(|row| {
                    let mut fixed = structure.rows.iter();
                    let fixed = fixed.find(|f| f.segment == s && f.row == row);
                    fixed.map(|fixed| fixed.value)
                })
                .collect();
            let (parts, points) = if error <= settings.tolerance {
                decisions.push(Decision::Keep);
                (1, n)
            } else {
                let decades = (error / (RAISE_AIM * settings.tolerance)).log10();
                let more = (decades / degrees::decay(assessment.trajectory, s)).ceil();
                let more = (more.max(1.0) as usize).min(MOST_MORE);
                match n + more <= settings.max_points {
                    true => {
                        decisions.push(Decision::Raise(n + more));
                        (1, n + more)
                    }
                    false => {
                        decisions.push(Decision::Divide(2));
                        (2, n.div_ceil(2) + 2)
                    }
                }
            };
            for part in 1..=parts {
                let cut = at[s] + (at[s + 1] - at[s]) * part as f64 / parts as f64;
                draft.breakpoints.push(match part == parts {
                    true => (at[s + 1], window(s + 1)),
                    false => (cut, None),
                });
                draft.points.push(points);
                draft.fixed.push(fixed.clone());
                draft.rows.push(rows.clone());
            }
        }
        draft.finish(facts, decisions)
    }
}

impl Draft {
    fn finish(self, facts: &Facts<'_>, decisions: Vec<Decision>) -> Option<Refined> {
        let at: Vec<f64> = self.breakpoints.iter().map(|b| b.0).collect();
        let inner = 1..at.len() - 1;
        // A free breakpoint does not pass one that is not.
        let stop = |b: usize| match self.breakpoints[b].1 {
            None => Some(at[b]),
            Some(_) => None,
        };
        let knots = inner
            .filter_map(|b| {
                let window = self.breakpoints[b].1?;
                let room = |c: usize| LEAST_WIDTH * (at[b] - at[c]).abs();
                let lower = stop(b - 1).map_or(window.lower, |a| window.lower.max(a + room(b - 1)));
                let upper = stop(b + 1).map_or(window.upper, |a| window.upper.min(a - room(b + 1)));
                let window = Interval::new(lower, upper);
                (lower < upper).then_some(Knot {
                    breakpoint: b,
                    window,
                })
            })
            .collect();
        let mut fixed = Vec::new();
        for (segment, controls) in self.fixed.iter().enumerate() {
            for (control, value) in controls.iter().enumerate() {
                fixed.extend(value.map(|value| FixedControl {
                    segment,
                    control,
                    value,
                }));
            }
        }
        let mut rows = Vec::new();
        for (segment, values) in self.rows.iter().enumerate() {
            for (row, value) in values.iter().enumerate() {
                rows.extend(value.map(|value| FixedRow {
                    segment,
                    row,
                    value,
                }));
            }
        }
        let structure = Structure {
            knots,
            fixed,
            rows,
            smooth: self.smooth(facts),
        };
        let mesh = Mesh::new(at, &self.points).ok()?;
        Some(Refined {
            mesh,
            decisions,
            structure,
        })
    }

    /// States that a free control drives, in segments at whose end a control comes to a bound, and in
    /// the last one where they are free at the end.
    fn smooth(&self, facts: &Facts<'_>) -> Vec<SmoothState> {
        let mut smooth = Vec::new();
        let last = self.fixed.len() - 1;
        for (segment, fixed) in self.fixed.iter().enumerate() {
            let comes_to_bound = |control: usize| {
                let next = self.fixed.get(segment + 1);
                fixed[control].is_none() && next.is_some_and(|next| next[control].is_some())
            };
            let ends = segment < last && (0..fixed.len()).any(comes_to_bound);
            if !ends && segment < last || self.points[segment] <= FEWEST {
                continue;
            }
            // Other controls may jump with it: they go on along another arc.
            let free: Vec<usize> = (0..fixed.len()).filter(|&j| fixed[j].is_none()).collect();
            let bound = self.rows[segment].iter().flatten().count();
            let is_driven = |state: &usize| {
                let drivers = &facts.drivers[*state];
                let open = !facts.formulation.terminal[*state].is_fixed();
                free.iter().any(|j| drivers.contains(j)) && (ends || open)
            };
            let states = (0..facts.drivers.len()).filter(is_driven);
            let states: Vec<usize> = states.collect();
            if states.len() + bound <= free.len() {
                smooth.extend(
                    states
                        .into_iter()
                        .map(|state| SmoothState { segment, state }),
                );
            }
        }
        smooth
    }
}

/// The median of the largest errors of the segments.
fn median(by_segment: &[Vec<f64>]) -> f64 {
    let worst = |row: &Vec<f64>| largest_or_nan(row.iter().copied());
    let mut all: Vec<f64> = by_segment.iter().map(worst).collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}
