//! docs/reproduction.md: claim by claim, the published figure, ours, whether it holds and why not.

mod claims;

pub use claims::{Claim, Verdict, claims};

use super::bounds::{self, Bounds};
use super::figures::{Case, Drawn, Plans};
use super::table2::{self, Row, SensitivityRow, SweepRow};
use crate::nlp::ipopt;
use crate::report::{Build, Sheet};

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
    /// The figures.
    pub figures: Vec<Drawn>,
}

/// The document; figures are linked from the folder `figures` beside it.
pub fn markdown(findings: &Findings) -> String {
    let claims = claims(findings);
    let mut text = format!(
        "# What of the paper holds\n\n\
         Written by `make reproduction` (ffsm-ipopt {}, Ipopt {}); no figure below is typed by \
         hand. `ffsm-ipopt` stands for `cargo run --release --`. Times are this machine's.\n\n\
         The case as published cannot be solved (why is shown below), so that two cases stand \
         in for it: *relaxed*, without the bounds on the base attitude, and *smooth*, relaxed with \
         a small cost on the control besides; *bounded* is the published case with the base within \
         ±{:.0}° instead of ±15°. What cannot be compared is said to be so.\n\n\
         ## Claim by claim\n\n",
        Build::VERSION,
        ipopt::version(),
        findings.bounds.bounded_at
    );
    let mut sheet = Sheet::new(&["", "claim", "published", "ours", "holds", "why", "check"]);
    for (k, claim) in claims.iter().enumerate() {
        sheet.row(vec![
            (k + 1).to_string(),
            claim.claim.into(),
            claim.published.into(),
            claim.ours.clone(),
            claim.verdict.name().into(),
            claim.why.clone(),
            format!("`{}`", claim.check),
        ]);
    }
    text.push_str(&sheet.markdown_words());
    text.push_str(&section(
        "Why the published case has no solution",
        "ffsm-ipopt reproduce bounds",
        &bounds::markdown(&findings.bounds),
    ));
    text.push_str(&section(
        "Table II",
        "ffsm-ipopt table2",
        &table2::markdown(&findings.rows, findings.repeat),
    ));
    text.push_str(&section(
        "The constants of the law",
        "ffsm-ipopt table2 --sensitivity",
        &table2::sensitivity_markdown(&findings.sensitivity),
    ));
    text.push_str(&section(
        "Where the adaptive method starts to pay",
        "ffsm-ipopt table2 --sweep",
        &(table2::sweep_markdown(&findings.sweep) + "![](figures/sweep.svg)\n"),
    ));
    let mut pictures = String::new();
    for drawn in &findings.figures {
        pictures.push_str(&format!(
            "![{}](figures/{}.svg)\n\n{}\n\n",
            drawn.caption.split(':').next().unwrap_or_default(),
            drawn.name,
            drawn.caption
        ));
    }
    text.push_str(&section("Figures 2 to 6", "ffsm-ipopt figures", &pictures));
    while text.ends_with("\n\n") {
        text.pop();
    }
    text
}

/// A section with the command that makes it again.
fn section(title: &str, check: &str, body: &str) -> String {
    format!("\n## {title}\n\nCheck: `{check}`\n\n{}\n", body.trim_end())
}
