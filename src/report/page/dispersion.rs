//! `dispersion.html`: one page that needs nothing else, with the figures of a plan under
//! perturbations, their histograms and what they come from.

use super::head::head;
use super::scrolling::scrolling;
use crate::plot::{Axis, Chart, Colour, Figure, Series, Shape, Stroke, Width};
use crate::report::dispersion::{
    DispersedFigure, DispersionReport, figure_row, largest, sensitivity_headline,
};
use crate::solution::Build;
use crate::study::dispersion::Sensitivities;
use crate::text::digits::digits;
use crate::text::printable::printable;
use maud::{DOCTYPE, Markup, PreEscaped, html};

/// Bars of sensitivity charts.
const BARS: usize = 12;
/// Share below which a quantity has no bar.
const LEAST: f64 = 0.002;

impl DispersionReport<'_> {
    /// The page.
    pub fn page(&self) -> String {
        let name = &self.problem.name;
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                (head(&format!("{name} · dispersion")))
                body {
                    header {
                        h1 { (name) " under dispersion" }
                        p { (self.lead()) }
                    }
                    section { h2 { "Quantiles" } (self.quantiles()) }
                    section {
                        h2 { "Distributions" }
                        div.charts { @for figure in &self.figures { (histogram(figure)) } }
                        p.hint { "Vermilion: the plan. Dashed: mean, 95 % and 99 %." }
                    }
                    section {
                        h2 { "What matters" }
                        @if let Some(why) = self.without_sensitivities() { p { (why) } }
                        div.charts { @for found in &self.sensitivities { (bars(found)) } }
                    }
                    section { h2 { "What was perturbed" } (self.perturbations()) }
                    section {
                        h2 { "How it was computed" }
                        p {
                            "Every sample is the planned motion of the joints with their errors, and the "
                            "base's motion by conservation of linear and angular momentum. "
                            (self.steps()) "."
                        }
                        p { "From " (self.solution) ", by ffsm-ipopt " (Build::VERSION) ". " (self.heading()) "." }
                    }
                }
            }
        }
        .into_string();
        // Names come from files.
        printable(&page).into_owned()
    }

    fn lead(&self) -> String {
        let shown = |name: &str| {
            let figure = self.figures.iter().find(|figure| figure.name == name)?;
            let of = |value: f64| {
                let unit = figure.measure.unit();
                format!("{}{unit}", digits(figure.measure.factor() * value, 3, 3))
            };
            let [_, likely] = figure
                .spread
                .quantiles
                .iter()
                .find(|[part, _]| *part == 0.99)?;
            Some([of(figure.planned), of(*likely)])
        };
        let figures = shown("max_base_attitude").zip(shown("final_base_attitude"));
        let Some(([most, of_most], [last, of_last])) = figures else {
            return String::new();
        };
        format!(
            "Planned, the base turns by at most {most} and ends turned by {last}. In 99 of 100 \
             replays it stays below {of_most} on its way and {of_last} at the end."
        )
    }

    fn quantiles(&self) -> Markup {
        let head = [
            "", "plan", "mean", "sd", "50 %", "90 %", "95 %", "99 %", "worst", "sample",
        ];
        let table = html! {
            table.numbers {
                thead { tr { @for text in head { th scope="col" { (text) } } } }
                @for figure in &self.figures {
                    tr { @for text in figure_row(figure) { td { (text) } } }
                }
            }
        };
        scrolling("Quantiles", &table)
    }

    fn perturbations(&self) -> Markup {
        let model = &self.problem.robot;
        let table = html! {
            table.numbers {
                thead { tr { @for text in ["quantity", "in the plan", "distribution"] { th scope="col" { (text) } } } }
                @for perturbation in self.dispersion.perturbations() {
                    @let unit = perturbation.quantity.unit(model);
                    tr {
                        td { (perturbation.key) }
                        td { (perturbation.quantity.nominal(model)) " " (unit) }
                        td { (perturbation.distribution.to_string()) " " (unit) }
                    }
                }
            }
        };
        scrolling("What is perturbed", &table)
    }
}

/// A figure's histogram with the plan's own value.
fn histogram(figure: &DispersedFigure) -> Markup {
    let spread = &figure.spread;
    let factor = figure.measure.factor();
    let [low, high] = [spread.least, largest(spread)].map(|value| factor * value);
    let most = figure.histogram.iter().copied().max().unwrap_or(1) as f64;
    let width = (high - low) / figure.histogram.len() as f64;
    let label = format!("{} ({})", capital(figure.title), figure.measure.unit());
    // Where all samples are the same there is one line to be seen.
    let room = if high > low {
        0.04 * (high - low)
    } else {
        0.01 * low.abs() + 1e-9
    };
    let planned = factor * figure.planned;
    let from = low.min(planned) - room;
    let to = high.max(planned) + room;
    let mut chart = Chart::new(
        Axis::linear(&label).range(from, to),
        Axis::linear("Samples").range(0.0, 1.08 * most),
    );
    for (k, count) in figure.histogram.iter().enumerate().filter(|(_, n)| **n > 0) {
        let [left, right] = [k, k + 1].map(|k| low + k as f64 * width);
        chart = chart.shape(bar([left, right], [0.0, *count as f64]));
    }
    for [part, value] in &spread.quantiles {
        if [0.95, 0.99].contains(part) {
            chart = chart.series(upright(factor * value, most, Stroke::Dashed, Colour::Grey));
        }
    }
    chart = chart
        .series(upright(
            factor * spread.mean,
            most,
            Stroke::Dashed,
            Colour::Black,
        ))
        .series(upright(planned, most, Stroke::Solid, Colour::Vermilion).width(1.8))
        .without_legend();
    let description = format!("Histogram of the {}", figure.title);
    drawn(&capital(figure.title), &description, chart)
}

/// The quantities with the largest shares as bars.
fn bars(found: &Sensitivities) -> Markup {
    let shown = found.shares.iter().filter(|share| share.share >= LEAST);
    let shown: Vec<_> = shown.take(BARS).collect();
    let count = shown.len();
    let at = |k: usize| (count - k) as f64;
    let ticks = shown.iter().enumerate();
    let ticks: Vec<(f64, String)> = ticks.map(|(k, share)| (at(k), share.key.clone())).collect();
    let most = shown.first().map_or(1.0, |share| 100.0 * share.share);
    let mut chart = Chart::new(
        Axis::linear("Share of the variance (%)").range(0.0, 1.05 * most),
        Axis::linear("")
            .range(0.3, count as f64 + 0.7)
            .ticks(&ticks),
    )
    .height(14.0 * count as f64 + 10.0);
    for (k, share) in shown.iter().enumerate() {
        chart = chart.shape(bar(
            [0.0, 100.0 * share.share],
            [at(k) - 0.32, at(k) + 0.32],
        ));
    }
    let headline = sensitivity_headline(found);
    drawn(&headline, &headline, chart)
}

fn bar([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> Shape {
    Shape::Polygon {
        corners: vec![[left, bottom], [right, bottom], [right, top], [left, top]],
        outline: Colour::Blue,
        fill: Some((Colour::Blue, 0.35)),
    }
}

fn upright(x: f64, top: f64, stroke: Stroke, colour: Colour) -> Series {
    Series::line("", &[x, x], &[0.0, 1.08 * top])
        .stroke(stroke)
        .colour(colour)
}

fn drawn(heading: &str, description: &str, chart: Chart) -> Markup {
    let figure = Figure::new(description, Width::Column).panel(chart);
    html! {
        figure {
            figcaption { (heading) }
            div.chart { (PreEscaped(figure.svg())) }
        }
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
