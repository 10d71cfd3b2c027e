//! docs/reproduction.md: claim by claim, the published figure, ours, whether it holds and why not.

mod claims;
mod data;

pub use claims::{Claim, Verdict, claims};
pub use data::{data, pictures};

use super::bounds::{self, Bounds};
use super::figures::{self, Case, Drawn, Plans};
use super::platform::Platform;
use super::table2::{self, Row, SensitivityRow, SweepRow};
use super::{Compared, ReproductionError, Session, TradeOff, compared};
use crate::nlp::ipopt;
use crate::report::Sheet;
use crate::solution::Build;

/// Everything the document is written from.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Runs behind each row of Table II.
    pub repeat: u16,
    /// Table II.
    pub rows: Vec<Row>,
    /// Its sensitivity to the constants of the law.
    pub sensitivity: Vec<SensitivityRow>,
    /// Both methods against the weight of the control.
    pub sweep: Vec<SweepRow>,
    /// Why the published case has no solution.
    pub bounds: Bounds,
    /// The published case with its bounds widened to where a motion exists.
    pub bounded: Case,
    /// The plans behind the figures.
    pub plans: Plans,
    /// One task by every planner.
    pub compared: Vec<Compared>,
    /// Base motion against joint effort.
    pub trade_off: TradeOff,
    /// What the model of the platform says of the measurements.
    pub platform: Platform,
}

impl Findings {
    /// Computes all of it, Table II with `repeat` runs a row.
    ///
    /// # Errors
    /// [`ReproductionError`] where a part fails, or it is stopped.
    pub fn gather(session: &mut Session<'_>, repeat: u16) -> Result<Self, ReproductionError> {
        let (bounds, bounded) = bounds::bounds(session)?;
        Ok(Self {
            repeat,
            bounds,
            bounded,
            plans: Plans::make(session)?,
            rows: table2::rows(session, repeat)?,
            sensitivity: table2::sensitivity(session)?,
            sweep: table2::sweep(session)?,
            compared: compared(session)?,
            trade_off: TradeOff::plan(session)?,
            platform: Platform::examine(session)?,
        })
    }
}

/// The document; figures are linked from the folder `figures` beside it.
pub fn markdown(findings: &Findings) -> String {
    let mut text = format!(
        "# What of the paper holds\n\n\
         Written by `make reproduction` (ffsm-ipopt {}, Ipopt {}); no figure of ours below is typed \
         by hand. `ffsm-ipopt` stands for `cargo run --release --`; a command beside a table prints \
         the figures in it. Times are this machine's and differ from run to run.\n\n\
         The case as published cannot be solved (why is shown below), so that other cases stand \
         in for it: *relaxed*, without the bounds on the base attitude (`config/table1-relaxed.toml`); \
         *smooth*, relaxed with a small cost on the control besides (`config/table1-smooth.toml`); \
         *bounded*, as published with the base within ±{:.0}° instead of ±15°; *heavy-base*, as \
         published with a base of {} kg m² instead of Table I's 0.1454 \
         (`config/table1-heavy-base.toml`). What cannot be compared is said to be so.\n\n\
         ## Claim by claim\n\n",
        Build::VERSION,
        ipopt::version(),
        findings.bounds.bounded_at,
        findings.platform.heavier,
    );
    text.push_str(&verdicts(&claims(findings)));
    let mut add = |title: &str, check: &[&str], body: &str| {
        let check = commands(check);
        text.push_str(&format!(
            "\n## {title}\n\nCheck: {check}\n\n{}\n",
            body.trim_end()
        ));
    };
    add(
        "Why the published case has no solution",
        &["ffsm-ipopt reproduce bounds"],
        &bounds::markdown(&findings.bounds),
    );
    add(
        "Table II",
        &["ffsm-ipopt table2"],
        &table2::markdown(&findings.rows, findings.repeat),
    );
    add(
        "The constants of the law",
        &["ffsm-ipopt table2 --sensitivity"],
        &table2::sensitivity_markdown(&findings.sensitivity),
    );
    let sweep = table2::sweep_markdown(&findings.sweep) + &picture(&data::sweep(findings));
    add(
        "Where the adaptive method starts to pay",
        &["ffsm-ipopt table2 --sweep"],
        &sweep,
    );
    let drawn = figures::all(&findings.plans, &findings.bounded);
    let pictures: String = drawn.iter().map(picture).collect();
    add("Figures 2 to 6", &["ffsm-ipopt figures"], &pictures);
    let names: Vec<String> = findings.compared.iter().map(Compared::command).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    add("The planners compared", &names, &comparison(findings));
    let front = &findings.trade_off;
    add(
        "Base motion against joint effort",
        &[&front.command()],
        &format!(
            "{}\n{}\n\n{}",
            front.report().markdown(),
            front.finding(),
            picture(&front.drawn())
        ),
    );
    add(
        "The ground platform",
        &[Platform::COMMAND],
        &findings.platform.markdown(),
    );
    text
}

/// The table of all claims.
fn verdicts(claims: &[Claim]) -> String {
    let mut sheet = Sheet::new(&["", "claim", "published", "ours", "holds", "why", "check"]);
    for (k, claim) in claims.iter().enumerate() {
        sheet.row(vec![
            (k + 1).to_string(),
            claim.claim.into(),
            claim.published.into(),
            claim.ours.clone(),
            claim.verdict.name().into(),
            claim.why.clone(),
            commands(claim.check),
        ]);
    }
    sheet.markdown_words()
}

/// Both tasks by every planner.
fn comparison(findings: &Findings) -> String {
    let mut text = String::from(
        "Each command plans one task by all seven planners, and writes every plan as `plan \
         --method` does.\n\n",
    );
    for compared in &findings.compared {
        text.push_str(&format!(
            "{}\n{}\n\n{}",
            compared.report().markdown(),
            compared.finding(),
            picture(&compared.drawn())
        ));
    }
    text
}

/// A figure with its caption.
fn picture(drawn: &Drawn) -> String {
    let Drawn { name, caption, .. } = drawn;
    let short = caption.split(": ").next().unwrap_or_default();
    format!(
        "![{}](figures/{name}.svg)\n\n{caption}\n\n",
        short.replace('`', "")
    )
}

fn commands(commands: &[&str]) -> String {
    let quoted: Vec<String> = commands.iter().map(|c| format!("`{c}`")).collect();
    quoted.join(", ")
}
