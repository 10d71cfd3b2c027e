//! What the platform's model says of the measurements, together and in words.

use super::{BaseInertia, Played, fit, played};
use crate::config::{FitFile, ProblemFile};
use crate::planner::Method;
use crate::report::{FitReport, Sheet, reduced};
use crate::reproduction::{A_RPM, HEAVY, RELAXED, ReproductionError, Session};
use crate::simulate::fit::{Fit, Measured};
use serde::Serialize;

/// The shipped fits: with Table I's base, and with the heavier one.
const FITS: [&str; 2] = ["published", "published-heavy-base"];

/// What the model of the platform says of Section IV.B.
#[derive(Debug, Clone)]
pub struct Platform {
    /// What was measured, A-RPM first.
    pub measured: Vec<Measured>,
    /// With which base MATPM would turn as far as was measured.
    pub base_inertia: Option<BaseInertia>,
    /// Inertia of the shipped heavier base, kg m².
    pub heavier: f64,
    /// The bound on its attitude, which is the published one, rad.
    pub bound: f64,
    /// A-RPM and MATPM with either base, on the table with noise.
    pub played: Vec<Played>,
    /// Disturbances that may explain the measurements, with either base.
    pub fits: Vec<FitReport>,
}

/// What `platform.json` holds; SI units and radians.
#[derive(Serialize)]
struct Record<'a> {
    base_inertia: Option<BaseInertia>,
    played: &'a [Played],
}

impl Platform {
    /// The command that does the same.
    pub const COMMAND: &'static str = "ffsm-ipopt reproduce platform";

    /// Plans, plays and fits.
    ///
    /// # Errors
    /// [`ReproductionError`] where a plan or a simulation fails, or it is stopped.
    pub fn examine(session: &mut Session<'_>) -> Result<Self, ReproductionError> {
        let files = [FitFile::shipped(FITS[0])?, FitFile::shipped(FITS[1])?];
        let experiments = files[0].experiments.iter();
        let measured: Vec<Measured> = experiments.map(|e| e.measured.clone()).collect();
        session.begin("base inertia that explains MATPM")?;
        let turn = measured.last().and_then(|m| m.final_attitude);
        let relaxed = ProblemFile::shipped(RELAXED)?.problem;
        let heavy = ProblemFile::shipped(HEAVY)?.problem;
        let played = played(session)?;
        let fits = files.iter().map(|file| fit(session, file));
        Ok(Self {
            base_inertia: turn.and_then(|turn| BaseInertia::explaining(&relaxed, turn)),
            heavier: heavy.robot.base().inertia.rotational()[(2, 2)],
            bound: heavy.limits.final_base_attitude[0].upper,
            measured,
            played,
            fits: fits.collect::<Result<_, _>>()?,
        })
    }

    /// A plan by problem and planner.
    pub fn plan(&self, problem: &str, method: Method) -> Option<&Played> {
        self.played
            .iter()
            .find(|played| played.problem == problem && played.method == method)
    }

    /// The fit with Table I's base, or with the heavier one.
    pub fn fit(&self, heavier: bool) -> Option<&FitReport> {
        self.fits.get(usize::from(heavier))
    }

    /// The finding about the base's inertia, in a sentence or two.
    pub fn finding(&self) -> String {
        let (Some(found), Some(matpm), Some(a_rpm)) = (
            self.base_inertia,
            self.plan(HEAVY, Method::Matpm),
            self.plan(HEAVY, A_RPM),
        ) else {
            return "No base inertia explains the measured turn.".into();
        };
        format!(
            "With Table I's base of {} kg m² the base ends at {} under MATPM, by momentum alone; with \
             {:.4} kg m², {:.2} times as much, it would end {} off as measured. \
             `config/{HEAVY}.toml` has {} kg m²: MATPM ends at {}, and the published bounds of ±{:.0}° \
             {}: A-RPM's base is at most {} off, and {} at the end.",
            found.published,
            degrees(found.turn.to_degrees(), 2),
            found.needed,
            found.needed / found.published,
            degrees(found.measured.to_degrees(), 1),
            self.heavier,
            degrees(matpm.extremes.final_attitude, 2),
            self.bound.to_degrees(),
            if a_rpm.solved {
                "can be met"
            } else {
                "are still not met"
            },
            degrees(a_rpm.extremes.largest_attitude, 1),
            degrees(a_rpm.extremes.final_attitude, 1),
        )
    }

    /// All of it in words and tables.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "Of the platform no more is published than what it is made of. Its model ([platform \
             file](platform-file.md)) has parameters that can each be measured on a table; here it \
             is asked with which of them the published figures can be reached.\n\n\
             ### A base that is harder to turn\n\n\
             Check: `ffsm-ipopt check config/{RELAXED}.toml`, `ffsm-ipopt check \
             config/{HEAVY}.toml` and `ffsm-ipopt plan config/{HEAVY}.toml`\n\n{}\n",
            self.finding()
        );
        if let Some(plan) = self.plan(RELAXED, A_RPM) {
            let [x, y] = plan.extremes.final_displacement;
            let [u, v] = plan.extremes.unturned_displacement;
            text.push_str(&format!(
                "\nWith Table I the base's origin ends {} along x and {} along y under A-RPM; had the \
                 base not turned, it would be {} and {}.\n",
                centimetres(x),
                centimetres(y),
                centimetres(u),
                centimetres(v)
            ));
        }
        text.push_str(&self.spread());
        text.push_str(
            "\n### Which disturbances reach which measurements\n\n\
             Each row of the first table is one set of disturbances, fitted to all measurements at \
             once; the second has its parameters, by their keys in the platform file.\n",
        );
        for (name, report) in FITS.iter().zip(&self.fits) {
            text.push_str(&format!(
                "\nCheck: `ffsm-ipopt simulate --fit config/platforms/{name}.toml`\n\n{}",
                report.markdown()
            ));
        }
        text.push_str(&self.conclusion());
        text
    }

    /// What the table's disturbances make of the plans, run by run.
    fn spread(&self) -> String {
        let mut text = String::from("\n### The plans on a good table, with noise\n\n");
        for played in &self.played {
            let [plan, simulate] = played.commands();
            text.push_str(&format!("- `{plan}`, then `{simulate}`\n"));
        }
        let runs = self.played.first().map_or(0, |played| played.runs);
        text.push_str(&format!(
            "\nMean ± standard deviation of {runs} runs each, as motion capture has them; signs are \
             not published.\n\n"
        ));
        let mut sheet = Sheet::new(&[
            "plan",
            "",
            "largest attitude / °",
            "final attitude / °",
            "final x / cm",
            "final y / cm",
        ])
        .words(2);
        let degrees = 1f64.to_degrees();
        let units = [degrees, degrees, 100.0, 100.0];
        for (method, measured) in [A_RPM, Method::Matpm].into_iter().zip(&self.measured) {
            let [x, y] = [0, 1].map(|i| measured.final_displacement.map(|d| d[i]));
            let published = [measured.max_attitude, measured.final_attitude, x, y];
            let cells = published.iter().zip(units).map(|(value, unit)| {
                value.map_or_else(|| "–".into(), |value| format!("{:.1}", value * unit))
            });
            let start = [method.name(), "measured"].map(String::from);
            sheet.row(start.into_iter().chain(cells).collect());
            for played in self.played.iter().filter(|p| p.method == method) {
                let e = &played.extremes;
                let [x, y] = e.final_displacement;
                let planned = [e.largest_attitude, e.final_attitude, x, y];
                let cells = planned.iter().map(|value| format!("{value:.2}"));
                let start = [method.name().into(), format!("{}, planned", played.problem)];
                sheet.row(start.into_iter().chain(cells).collect());
                let cells = (0..4).map(|i| {
                    let [mean, deviation] = [played.mean[i], played.deviation[i]];
                    format!("{:.2} ± {:.2}", mean * units[i], deviation * units[i])
                });
                let start = [method.name().into(), format!("{}, played", played.problem)];
                sheet.row(start.into_iter().chain(cells).collect());
            }
        }
        text.push_str(&sheet.markdown());
        text
    }

    /// Either base with one platform for both experiments.
    fn conclusion(&self) -> String {
        let best = |heavier: bool| {
            let found = self.fit(heavier).and_then(FitReport::best_common);
            found.map_or_else(
                || "none".into(),
                |(name, fit)| format!("“{name}” (reduced residual {:.2})", reduced(fit)),
            )
        };
        format!(
            "\nOf the sets that are the same in both runs, {} explains most where the plans are for \
             Table I's base, {} where they are for the heavier one.\n",
            best(false),
            best(true)
        )
    }

    /// The numbers, for `platform.json`.
    pub fn record(&self) -> impl Serialize + '_ {
        Record {
            base_inertia: self.base_inertia,
            played: &self.played,
        }
    }

    /// The best set with the heavier base that is the same in both runs.
    pub fn best(&self) -> Option<&(String, Fit)> {
        self.fit(true)?.best_common()
    }
}

fn degrees(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}°").replace('-', "−")
}

fn centimetres(value: f64) -> String {
    format!("{value:.2} cm").replace('-', "−")
}
