//! The paper's claims, each with what this code finds.

use super::Findings;
use crate::refine::Record;
use crate::reproduction::figures::{Case, Motion, Sample};
use crate::reproduction::table2::{Row, faster, pays};

/// Whether a claim holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It does.
    Holds,
    /// On one of the cases, or in its direction only.
    Partly,
    /// It does not.
    Fails,
}

impl Verdict {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "yes",
            Self::Partly => "in part",
            Self::Fails => "**no**",
        }
    }

    fn whether(holds: bool) -> Self {
        Self::of(holds, holds)
    }

    fn of(relaxed: bool, smooth: bool) -> Self {
        match (relaxed, smooth) {
            (true, true) => Self::Holds,
            (false, false) => Self::Fails,
            _ => Self::Partly,
        }
    }
}

/// One claim.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What is claimed, and where.
    pub claim: &'static str,
    /// The published figure.
    pub published: &'static str,
    /// Ours.
    pub ours: String,
    /// Whether it holds.
    pub verdict: Verdict,
    /// Why not, or on what ground.
    pub why: String,
    /// The command that checks it.
    pub check: &'static str,
}

const RELAXED: &str = "ffsm-ipopt plan config/table1-relaxed.toml";
const SMOOTH: &str = "ffsm-ipopt plan config/table1-smooth.toml";

/// All claims that a run can speak to, in the paper's order.
pub fn claims(found: &Findings) -> Vec<Claim> {
    let mut claims = vec![feasible(found)];
    claims.extend(motion(found));
    claims.extend(refinement(found));
    claims.extend(table(found));
    claims.extend(experiment(found));
    claims
}

fn feasible(found: &Findings) -> Claim {
    let bounds = &found.bounds;
    Claim {
        claim: "IV.A: the task can be done with the base within ±π/12 along the path and at t_f",
        published: "15°",
        ours: format!(
            "{} at least (dynamic programming); {} found to work",
            degrees(bounds.smallest_bound_by_grid),
            bounds
                .smallest_bound_by_diagnosis
                .map_or_else(|| "none".into(), degrees)
        ),
        verdict: Verdict::whether(bounds.smallest_bound_by_grid <= bounds.published_bound),
        why: "momentum conservation with Table I; see below".into(),
        check: "ffsm-ipopt plan config/table1.toml",
    }
}

/// Figure 2.
fn motion(found: &Findings) -> Vec<Claim> {
    let of = |case: &Case| Motion::new(case).map(|mut motion| motion.samples());
    let [Some(relaxed), Some(smooth), Some(bounded)] = [
        of(&found.plans.cases[0]),
        of(&found.plans.cases[1]),
        of(&found.bounded),
    ] else {
        return Vec::new();
    };
    let largest = |samples: &[Sample]| {
        samples
            .iter()
            .fold(0.0, |m: f64, s| m.max(s.attitude.abs()))
    };
    let last = |samples: &[Sample]| samples[samples.len() - 1].attitude.abs();
    let returns = |samples: &[Sample]| last(samples) < largest(samples) - 0.1;
    // Against the sense of the goal, by more than a tenth of a degree.
    let opposite = |samples: &[Sample]| {
        let goal = &samples[samples.len() - 1].joints;
        let against = |s: &Sample| {
            s.joints
                .iter()
                .zip(goal)
                .any(|(q, end)| q * end.signum() < -0.1)
        };
        samples.iter().any(against)
    };
    let farthest = |samples: &[Sample], i: usize| {
        let start = samples[0].position[i];
        let moved = samples
            .iter()
            .map(|s| 100.0 * (s.position[i] - start).abs());
        moved.fold(0.0, f64::max)
    };
    let yes = |is: bool| if is { "yes" } else { "no" };
    vec![
        Claim {
            claim: "Fig. 2(a): largest offset of the base attitude",
            published: "around 0.35 deg",
            ours: format!(
                "relaxed {}, smooth {}, bounded {}",
                degrees(largest(&relaxed)),
                degrees(largest(&smooth)),
                degrees(largest(&bounded))
            ),
            verdict: Verdict::of(
                close(largest(&relaxed), 0.35),
                close(largest(&smooth), 0.35),
            ),
            why: format!(
                "no motion ends nearer than {} (dynamic programming); 0.35 rad would be 20.1°, \
                 below what the bounds allow as well",
                degrees(found.bounds.nearest_final_by_grid)
            ),
            check: "ffsm-ipopt reproduce bounds",
        },
        Claim {
            claim: "Fig. 2(a): θ_b decreases again after a large deviation",
            published: "yes",
            ours: format!(
                "relaxed {}, smooth {}; where η(t_f) alone is the cost it passes through {} to end \
                 at {}",
                yes(returns(&relaxed)),
                yes(returns(&smooth)),
                optional(found.bounds.largest_on_the_way),
                optional(found.bounds.nearest_final_by_control)
            ),
            verdict: Verdict::of(returns(&relaxed), returns(&smooth)),
            why: "with the published weights the cost of moving the joints outweighs the final \
                  attitude"
                .into(),
            check: RELAXED,
        },
        Claim {
            claim: "Fig. 2(b): the joints first turn in the opposite direction",
            published: "yes",
            ours: format!(
                "relaxed {}, smooth {}, bounded {}",
                yes(opposite(&relaxed)),
                yes(opposite(&smooth)),
                yes(opposite(&bounded))
            ),
            verdict: if opposite(&relaxed) && opposite(&smooth) {
                Verdict::Holds
            } else if opposite(&bounded) {
                Verdict::Partly
            } else {
                Verdict::Fails
            },
            why: "only a motion that is made to turn the base less needs the detour".into(),
            check: "ffsm-ipopt figures",
        },
        Claim {
            claim: "Fig. 2(c): largest base displacement, x and y",
            published: "8.5 cm, 7.0 cm",
            ours: format!(
                "relaxed {:.2} and {:.2} cm, bounded {:.2} and {:.2} cm",
                farthest(&relaxed, 0),
                farthest(&relaxed, 1),
                farthest(&bounded, 0),
                farthest(&bounded, 1)
            ),
            verdict: Verdict::of(
                close(farthest(&relaxed, 0), 8.5) && close(farthest(&relaxed, 1), 7.0),
                close(farthest(&smooth, 0), 8.5) && close(farthest(&smooth, 1), 7.0),
            ),
            why: "the base position follows from joints and attitude alone (Remark 1)".into(),
            check: RELAXED,
        },
    ]
}

/// Figure 3.
fn refinement(found: &Findings) -> Vec<Claim> {
    let [relaxed, smooth] = [&found.plans.cases[0], &found.plans.cases[1]];
    let (error, at) = worst(&smooth.iterations[0], smooth.trajectory.duration);
    let last = |case: &Case| case.iterations[case.iterations.len() - 1].max_error;
    let size = |case: &Case| {
        format!(
            "{} meshes, {} points, {:.2e}",
            case.iterations.len(),
            case.trajectory.mesh.points(),
            last(case)
        )
    };
    let within = |case: &Case| last(case) <= case.problem.mesh.tolerance;
    vec![
        Claim {
            claim: "Fig. 3(a): largest error of the first iteration, 10 segments of 5 points",
            published: "5.297e-4 at t = 17 s",
            ours: format!("smooth {error:.3e} in the segment around t = {at:.0} s"),
            verdict: if (error / 5.297e-4).log10().abs() < 0.2 {
                Verdict::Partly
            } else {
                Verdict::Fails
            },
            why: format!(
                "of the same size on the smooth case; on the relaxed one {:.1e}, by the layers at \
                 both ends",
                relaxed.iterations[0].max_error
            ),
            check: SMOOTH,
        },
        Claim {
            claim: "Fig. 3(d): tolerance 1e-5 met at the fourth iteration",
            published: "4 meshes, 67 points, 0.9436e-5",
            ours: format!("relaxed {}; smooth {}", size(relaxed), size(smooth)),
            verdict: if within(relaxed) && within(smooth) {
                Verdict::Partly
            } else {
                Verdict::Fails
            },
            why: "met on both cases within 6 meshes, with more points; λ₁, λ₂ and r_max are not \
                  published"
                .into(),
            check: "ffsm-ipopt table2 --sensitivity",
        },
    ]
}

/// Largest error of a mesh iteration, and the middle of its segment, s.
fn worst(record: &Record, duration: f64) -> (f64, f64) {
    let error = |s: usize| record.segment_errors[s].iter().copied().fold(0.0, f64::max);
    let s = (0..record.segments)
        .max_by(|&a, &b| error(a).total_cmp(&error(b)))
        .unwrap_or(0);
    let ends = [record.breakpoints[s], record.breakpoints[s + 1]];
    (error(s), 0.5 * duration * (ends[0] + ends[1]))
}

/// Table II.
fn table(found: &Findings) -> Vec<Claim> {
    let row = |problem: &str, tolerance: f64, method: &str| {
        found.rows.iter().find(|row| {
            row.problem.ends_with(problem)
                && row.tolerance == tolerance
                && row.measured.method == method
        })
    };
    let cpu = |row: Option<&Row>| row.map_or(f64::NAN, |row| row.measured.cpu_seconds);
    let growth = |problem: &str, method: &str| {
        cpu(row(problem, 1e-5, method)) / cpu(row(problem, 1e-3, method))
    };
    let reached = |problem: &str, method: &str| {
        row(problem, 1e-5, method).is_some_and(|row| row.measured.reached)
    };
    let points = |problem: &str, method: &str| {
        row(problem, 1e-5, method).map_or(0, |row| row.measured.points)
    };
    let fewer = |problem: &str| {
        reached(problem, "rpm") && points(problem, "rpm") < points(problem, "a-rpm")
    };
    let slower = |problem: &str| {
        !reached(problem, "rpm")
            || cpu(row(problem, 1e-5, "rpm")) > cpu(row(problem, 1e-5, "a-rpm"))
    };
    let ours = |problem: &str| {
        let end = |method: &str| {
            format!(
                "{} {:.3} s{}",
                method.to_uppercase(),
                cpu(row(problem, 1e-5, method)),
                if reached(problem, method) {
                    ""
                } else {
                    " (not reached)"
                }
            )
        };
        format!("{problem}: {}, {}", end("rpm"), end("a-rpm"))
    };
    let spread = |problem: &str| growth(problem, "a-rpm");
    vec![
        Claim {
            claim: "Table II: at 1e-5 the global method takes far longer than A-RPM",
            published: "36.5 s against 7.7 s",
            ours: format!("{}; {}", ours("relaxed"), ours("smooth")),
            verdict: Verdict::of(slower("relaxed"), slower("smooth")),
            why: match (faster(&found.sweep), pays(&found.sweep)) {
                (Some(time), Some(reach)) => format!(
                    "where layers have to be resolved: A-RPM takes less time from a control \
                     weight of {time:e} downwards, and from {reach:e} only it gets there"
                ),
                _ => "not along the sweep of the control's weight".into(),
            },
            check: "ffsm-ipopt table2",
        },
        Claim {
            claim: "Table II: A-RPM's time hardly grows from 1e-3 to 1e-5",
            published: "by 1.23",
            ours: format!(
                "relaxed by {:.2}, smooth by {:.2}",
                spread("relaxed"),
                spread("smooth")
            ),
            verdict: Verdict::of(spread("relaxed") < 1.5, spread("smooth") < 1.5),
            why: "solves are short here, and each further mesh is one more".into(),
            check: "ffsm-ipopt table2",
        },
        Claim {
            claim: "Table II: the global method needs fewer points",
            published: "57 against 67 at 1e-5",
            ours: format!(
                "smooth {} against {}, relaxed {} (error {}) against {}",
                points("smooth", "rpm"),
                points("smooth", "a-rpm"),
                points("relaxed", "rpm"),
                row("relaxed", 1e-5, "rpm")
                    .and_then(|row| row.measured.max_error)
                    .map_or_else(|| "–".into(), |error| format!("{error:.1e}")),
                points("relaxed", "a-rpm"),
            ),
            verdict: Verdict::of(fewer("relaxed"), fewer("smooth")),
            why: "on smooth solutions a high degree is the shortest way; layers it never resolves"
                .into(),
            check: "ffsm-ipopt table2 --sweep",
        },
    ]
}

/// Section IV.B, as far as a plan can speak to it.
fn experiment(found: &Findings) -> Vec<Claim> {
    let end = |case: &Case| Motion::new(case).map(|mut motion| [motion.at(0.0), motion.at(1.0)]);
    let [Some([start, matpm]), Some([_, relaxed])] =
        [end(&found.plans.matpm), end(&found.plans.cases[0])]
    else {
        return Vec::new();
    };
    let moved = [0, 1].map(|i| 100.0 * (matpm.position[i] - start.position[i]).abs());
    // The displacement if the base did not turn: that of the mass centre in base axes.
    let unturned = |end: &Sample| {
        let (s, c) = end.attitude.to_radians().sin_cos();
        let [x, y] = end.position;
        [
            c * x + s * y - start.position[0],
            c * y - s * x - start.position[1],
        ]
        .map(|moved: f64| 100.0 * moved.abs())
    };
    let still = unturned(&relaxed);
    let planned = [0, 1].map(|i| 100.0 * (relaxed.position[i] - start.position[i]).abs());
    let (matpm, ours) = (matpm.attitude.abs(), relaxed.attitude.abs());
    vec![
        Claim {
            claim: "IV.B: base rotation under MATPM",
            published: "25.8°",
            ours: degrees(matpm),
            verdict: Verdict::whether(close(matpm, 25.8)),
            why: "joints that move in step follow the straight path whatever their timing, and \
                  momentum fixes where the base ends; Pinocchio, SPART and MuJoCo give the same \
                  angle"
                .into(),
            check: "ffsm-ipopt check config/table1-relaxed.toml",
        },
        Claim {
            claim: "IV.B: A-RPM leaves the base turned much less than MATPM",
            published: "9.0° against 25.8°",
            ours: format!(
                "relaxed {} against {}; at best {}",
                degrees(ours),
                degrees(matpm),
                optional(found.bounds.nearest_final_by_control)
            ),
            verdict: if ours < 0.5 * matpm {
                Verdict::Holds
            } else {
                Verdict::Partly
            },
            why: "the published weights do not pay for the detour; a heavier weight on η(t_f) \
                  halves the angle, 9.0° is out of reach in 20 s"
                .into(),
            check: "ffsm-ipopt reproduce bounds",
        },
        Claim {
            claim: "IV.B: final displacement under A-RPM, x and y",
            published: "3.2 cm, 4.2 cm",
            ours: format!(
                "relaxed {:.2} cm, {:.2} cm; a base that did not turn: {:.2} cm, {:.2} cm",
                planned[0], planned[1], still[0], still[1]
            ),
            verdict: Verdict::whether(close(planned[0], 3.2) && close(planned[1], 4.2)),
            why: "with Table I the displacement follows from the final joint angles and the final \
                  attitude; x is what a base without rotation would show"
                .into(),
            check: "ffsm-ipopt plan config/table1-relaxed.toml",
        },
        Claim {
            claim: "IV.B: final displacement under MATPM, x and y",
            published: "6.5 cm, 13.4 cm",
            ours: format!("{:.2} cm, {:.2} cm", moved[0], moved[1]),
            verdict: Verdict::whether(close(moved[0], 6.5) && close(moved[1], 13.4)),
            why: "the mass centre stays where it is (Remark 1): forces from outside moved the \
                  platform"
                .into(),
            check: "ffsm-ipopt check config/table1-relaxed.toml",
        },
    ]
}

fn degrees(value: f64) -> String {
    format!("{value:.1}°").replace('-', "−")
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "none found".into(), degrees)
}

/// Within a tenth of a published figure.
fn close(ours: f64, published: f64) -> bool {
    (ours - published).abs() <= 0.1 * published
}
