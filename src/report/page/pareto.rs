//! `pareto.html`: one page that needs nothing else, with the trade-off curve and its points.

use super::charts::Panel;
use super::head::head;
use super::scrolling::scrolling;
use super::{SCRIPT, with_numbers};
use crate::plot::{Chart, Figure, Width};
use crate::report::ParetoReport;
use crate::report::format::degrees;
use crate::solution::Build;
use crate::text::digits::digits;
use crate::text::printable::printable;
use maud::{DOCTYPE, Markup, PreEscaped, html};

impl ParetoReport<'_> {
    /// The page.
    pub fn page(&self) -> String {
        let panels = [
            panel("Terms of the cost", self.curve()),
            panel("Base attitude", self.angles()),
        ];
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                (head(&format!("{} · base motion against joint effort", self.name)))
                body {
                    header {
                        h1 { (self.name) ": base motion against joint effort" }
                        p { (self.lead()) }
                    }
                    section #charts {
                        h2 { "The curve" }
                        (with_numbers(&panels))
                        p.hint {
                            "B and E are the terms of the problem's cost about the base and about the "
                            "joints; every plan minimises factor · B + E, or E under a bound on B where "
                            "no factor leads. A factor of 1 is the problem itself."
                        }
                    }
                    section { h2 { "Point by point" } (self.table()) }
                    @if !self.notes.is_empty() {
                        section {
                            h2 { "What to know" }
                            ul { @for note in self.notes { li { (note) } } }
                        }
                    }
                    section {
                        h2 { "How it was computed" }
                        p {
                            "Every point is a plan of its own, begun at its neighbours' and at a few other "
                            "starts. Neither is proof against a better one: a point above the line between "
                            "its neighbours is worth a search of its own, "
                            code { "pareto --search" } "."
                        }
                        p { "By ffsm-ipopt " (Build::VERSION) "." }
                    }
                    script { (PreEscaped(SCRIPT)) }
                }
            }
        }
        .into_string();
        // Names come from files.
        printable(&page).into_owned()
    }

    fn lead(&self) -> String {
        let solved: Vec<_> = self.rows.iter().filter(|row| row.is_solved()).collect();
        let count = format!("{} of {} points are solved.", solved.len(), self.rows.len());
        let least = |a: &&&_, b: &&&_| f64::total_cmp(&factor(a), &factor(b));
        let ends = solved.iter().min_by(least).zip(solved.iter().max_by(least));
        let Some((low, high)) = ends.filter(|(low, high)| low.factor < high.factor) else {
            return count;
        };
        format!(
            "{count} From the smallest to the largest factor on the base's weights its largest angle \
             goes from {} to {}, and joint effort from {} to {}.",
            degrees(low.max_base_attitude),
            degrees(high.max_base_attitude),
            digits(low.joint_effort, 3, 3),
            digits(high.joint_effort, 3, 3),
        )
    }

    fn table(&self) -> Markup {
        let sheet = self.sheet();
        let (header, rows) = sheet.lines();
        let table = html! {
            table.numbers {
                thead { tr { @for head in header { th scope="col" { (head) } } } }
                @for row in rows { tr { @for cell in row { td { (cell) } } } }
            }
        };
        scrolling("Every point of the curve", &table)
    }
}

fn factor(row: &crate::report::ParetoRow) -> f64 {
    row.factor
}

fn panel(heading: &str, chart: Chart) -> Panel {
    Panel {
        heading: heading.into(),
        figure: Figure::new(heading, Width::Column).panel(chart),
        over_time: false,
    }
}
