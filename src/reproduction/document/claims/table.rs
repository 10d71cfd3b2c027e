//! Table II: points and times of both methods.

use super::{Claim, Findings, Verdict};
use crate::refine::Method;
use crate::reproduction::table2::{Row, faster, pays};

/// Table II.
pub(super) fn table(found: &Findings) -> Vec<Claim> {
    let row = |problem: &str, tolerance: f64, method: Method| {
        found.rows.iter().find(|row| {
            row.problem.ends_with(problem)
                && row.tolerance == tolerance
                && row.measured.method == method
        })
    };
    let cpu = |row: Option<&Row>| row.map_or(f64::NAN, |row| row.measured.cpu_seconds);
    let growth = |problem: &str, method: Method| {
        cpu(row(problem, 1e-5, method)) / cpu(row(problem, 1e-3, method))
    };
    let reached = |problem: &str, method: Method| {
        row(problem, 1e-5, method).is_some_and(|row| row.measured.reached)
    };
    let points = |problem: &str, method: Method| {
        row(problem, 1e-5, method).map_or(0, |row| row.measured.points)
    };
    let fewer = |problem: &str| {
        reached(problem, Method::Global)
            && points(problem, Method::Global) < points(problem, Method::Adaptive)
    };
    let slower = |problem: &str| {
        !reached(problem, Method::Global)
            || cpu(row(problem, 1e-5, Method::Global)) > cpu(row(problem, 1e-5, Method::Adaptive))
    };
    let ours = |problem: &str| {
        let end = |method: Method| {
            format!(
                "{} {:.3} s{}",
                method.name().to_uppercase(),
                cpu(row(problem, 1e-5, method)),
                if reached(problem, method) {
                    ""
                } else {
                    " (not reached)"
                }
            )
        };
        format!(
            "{problem}: {}, {}",
            end(Method::Global),
            end(Method::Adaptive)
        )
    };
    let spread = |problem: &str| growth(problem, Method::Adaptive);
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
            check: &["ffsm-ipopt table2 --sweep"],
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
            check: &["ffsm-ipopt table2"],
        },
        Claim {
            claim: "Table II: the global method needs fewer points",
            published: "57 against 67 at 1e-5",
            ours: format!(
                "smooth {} against {}, relaxed {} (error {}) against {}",
                points("smooth", Method::Global),
                points("smooth", Method::Adaptive),
                points("relaxed", Method::Global),
                row("relaxed", 1e-5, Method::Global)
                    .and_then(|row| row.measured.max_error)
                    .map_or_else(|| "–".into(), |error| format!("{error:.1e}")),
                points("relaxed", Method::Adaptive),
            ),
            verdict: Verdict::of(fewer("relaxed"), fewer("smooth")),
            why: "on smooth solutions a high degree is the shortest way; layers it never resolves"
                .into(),
            check: &["ffsm-ipopt table2"],
        },
    ]
}
