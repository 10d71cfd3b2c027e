//! The paper's claims, each with what this code finds.

mod experiment;
mod motion;
mod refinement;
mod table;

use super::Findings;

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
    /// The commands that check it.
    pub check: &'static [&'static str],
}

/// All claims that a run can speak to, in the paper's order.
pub fn claims(found: &Findings) -> Vec<Claim> {
    let mut claims = vec![motion::feasible(found)];
    claims.extend(motion::motion(found));
    claims.extend(refinement::refinement(found));
    claims.extend(table::table(found));
    claims.extend(experiment::experiment(found));
    claims
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
