//! `report.html`: one page that needs nothing else, with the motion played back beside that along
//! the straight joint path, every quantity with its bounds, and why the numbers can be trusted.

mod chart_data;
mod charts;
mod coarse;
mod dispersion;
mod drawing_words;
mod head;
mod marks;
mod pareto;
mod pose;
mod scene;
mod scrolling;
mod solids;
mod task_table;
mod texts;

use super::format::{cost, degrees, time};
use crate::collocation::Mesh;
use crate::config::Drawing;
use crate::parallel;
use crate::planner::{Method, Status};
use crate::problem::Problem;
use crate::solution::{Search, Solution};
use crate::study::Baselines;
use crate::system::resampled;
use crate::text::printable::printable;
use crate::transcription::Discretization;
use chart_data::ChartData;
use charts::Panel;
use head::head;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use scene::Scene;
use scrolling::scrolling;
use solids::Solids;
use texts::Fact;

/// One script; a file uses what those before it define.
const SCRIPT: &str = concat!(
    include_str!("clock.js"),
    include_str!("camera.js"),
    include_str!("solids.js"),
    include_str!("picture.js"),
    include_str!("playback.js"),
    include_str!("download.js"),
    include_str!("span.js"),
    include_str!("stretch.js"),
    include_str!("charts.js"),
    include_str!("main.js"),
);

/// Optima shown of a search; the file has all of them.
const OPTIMA: usize = 12;
/// Times of the playback, less one: those of the motion it is compared with.
const FRAMES: usize = Baselines::STEPS;

/// The page of `solution`, which is `plan` for `problem`; `baselines` are its motion without
/// planning, `drawing` is what can be drawn of its robot.
pub fn page(
    solution: &Solution,
    problem: &Problem,
    (plan, baselines): (&Discretization, &Baselines),
    drawing: &Drawing,
) -> String {
    let status = solution.status;
    let in_joints = solution.method == Method::StraightLine.name();
    let straight = baselines.straight_motion.as_ref();
    let straight = straight.filter(|_| !in_joints);
    // One point a segment: the nodes are the breakpoints.
    let even = Mesh::uniform(FRAMES, 1).map(|mesh| resampled(problem, plan, mesh));
    let title = match status {
        Status::Solved => format!("planned, {}", solution.method),
        other => format!("{}, {}", solution.method, other.words()),
    };
    let planned = even.iter().map(|motion| (title.as_str(), motion));
    let compared = straight.map(|motion| ("straight joint path", motion));
    let matpm = baselines.matpm_motion.as_ref();
    let matpm = matpm.filter(|_| solution.method != Method::Matpm.name());
    let solids = Solids::of(drawing, problem.robot.joint_count());
    let scene = Scene::new(
        (problem, &solids),
        plan,
        &planned.chain(compared).collect::<Vec<_>>(),
        &matpm
            .map(|motion| ("MATPM", motion))
            .into_iter()
            .collect::<Vec<_>>(),
    );
    let panels = charts::panels(solution, problem, plan, straight);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(&format!("{} · {}", solution.name, status.words())))
            body {
                header {
                    h1 { (solution.name) " " span class={ "status " (status.name()) } { (status.words()) } }
                    p { (texts::lead(solution, straight)) }
                }
                @if let Some(diagnosis) = &solution.diagnosis {
                    section.notice { h2 { "Why there is no solution" } p { (diagnosis.summary) } }
                }
                @let known: Vec<_> = solution.warnings.iter().chain(&solution.provenance.repairs).collect();
                @if !known.is_empty() {
                    section.notice {
                        h2 { "Before it is used" }
                        ul { @for warning in known { li { (warning) } } }
                    }
                }
                (playback(&scene, &solids))
                section { h2 { "In figures" } (facts(&texts::figures(solution, problem, baselines))) }
                section { h2 { "The problem" } (task(problem)) }
                section {
                    h2 {
                        @if status == Status::Solved && solution.verification.is_some() { "Why the numbers can be trusted" }
                        @else { "What was checked" }
                    }
                    (facts(&texts::evidence(solution, problem)))
                }
                (charts_over_time(&panels))
                @if !solution.iterations.is_empty() {
                    section { h2 { "Mesh by mesh" } (history(solution)) }
                }
                @if let Some(search) = &solution.search {
                    section { h2 { "Other optima" } (optima(search)) }
                }
                section { h2 { "Where it comes from" } (provenance(solution)) }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
    .into_string();
    // Names and texts come from files.
    printable(&page).into_owned()
}

/// The robot in motion; drawn by the script from the scene.
fn playback(scene: &Scene, solids: &Solids) -> Markup {
    let Ok(json) = scene.json() else {
        return html! {};
    };
    html! {
        section #playback hidden {
            h2 { "Motion" }
            div.stages {}
            div.controls {
                button type="button" aria-label="Play or pause" { "▶" }
                input type="range" min="0" max="1" step="any" value="0" aria-label="Time";
                output {}
                select aria-label="Speed" {}
            }
            div.controls.views role="group" aria-label="View" {}
            div.controls.ghosts role="group" aria-label="Motions to draw into the first picture" {}
            p.hint {
                "To scale. Dashed: the base at the start. " (drawing_words::of(solids))
                " Green: the goal" @if scene.has_way_points() { ", and way-points" } ". "
                @if scene.keeps_apart() {
                    "Dotted: what is kept apart; other collisions are not checked. "
                } @else {
                    "Collisions are not checked: nothing is kept apart. "
                }
            }
            p.hint #keys {
                "Drag, or the arrow keys, turn the view; shift and drag, or the right button, move it; "
                "two fingers, + and −, or the wheel once the picture has been clicked, zoom; "
                "the space bar plays."
            }
            @if !solids.complaints.is_empty() {
                details.hint {
                    summary { "What could not be drawn" }
                    ul { @for complaint in &solids.complaints { li { (complaint) } } }
                }
            }
            div.frames aria-hidden="true" {}
            script #scene type="application/json" { (PreEscaped(json)) }
        }
        noscript { p.hint { "The motion is played where scripts are allowed." } }
    }
}

fn facts(facts: &[Fact]) -> Markup {
    html! {
        table.facts {
            @for fact in facts {
                tr {
                    th scope="row" { (fact.what) }
                    td {
                        (fact.value)
                        @if !fact.meaning.is_empty() { div.meaning { (fact.meaning) } }
                    }
                }
            }
        }
    }
}

fn chart(panel: &Panel) -> Markup {
    let frame = panel.figure.frames().first().map(|frame| {
        let ([from, to], [low, high]) = (frame.x, frame.y);
        let of = [
            frame.left,
            frame.top,
            frame.width,
            frame.height,
            from,
            to,
            low,
            high,
        ];
        of.map(|value| format!("{value:.7e}")).join(" ")
    });
    let svg = panel.figure.svg_with_groups();
    html! {
        figure {
            figcaption { (panel.heading) }
            div.chart data-frame=[frame] data-over-time[panel.over_time] { (PreEscaped(svg)) }
        }
    }
}

/// The charts.
fn charts_over_time(panels: &[Panel]) -> Markup {
    html! {
        section #charts {
            h2 { "Over time" }
            (with_numbers(panels))
        }
    }
}

/// Charts with the numbers behind them.
fn with_numbers(panels: &[Panel]) -> Markup {
    let numbers = || {
        html! {
            @if let Ok(json) = ChartData::of(panels).json() {
                script #numbers type="application/json" { (PreEscaped(json)) }
            }
        }
    };
    // Most of a page's time.
    let mut parts = parallel::map(panels.len() + 1, &|k| match panels.get(k) {
        Some(panel) => chart(panel),
        None => numbers(),
    });
    let numbers = parts.pop();
    html! {
        div.charts { @for chart in &parts { (chart) } }
        @if let Some(numbers) = &numbers { (numbers) }
    }
}

/// What is to be done.
fn task(problem: &Problem) -> Markup {
    let joints = html! {
        table.joints {
            thead {
                tr {
                    th scope="col" { "joint" }
                    @for head in task_table::JOINT_COLUMNS { th scope="col" { (head) } }
                }
            }
            @for row in task_table::joints(problem) {
                tr {
                    th scope="row" { (row.name) }
                    @for cell in row.cells { td { (cell) } }
                }
            }
        }
    };
    html! {
        (scrolling("What is asked of every joint", &joints))
        (facts(&task_table::rest(problem)))
    }
}

/// One row a mesh iteration.
fn history(solution: &Solution) -> Markup {
    let table = html! {
        table.history {
            thead {
                tr {
                    @for head in [
                        "mesh", "segments", "points", "largest error", "cost J", "iterations",
                        "Ipopt", "time",
                    ] {
                        th scope="col" { (head) }
                    }
                }
            }
            @for (k, record) in solution.iterations.iter().enumerate() {
                tr {
                    td { (k + 1) }
                    td { (record.segments) }
                    td { (record.points) }
                    td { (format!("{:.3e}", record.max_error)) }
                    td {
                        // J of meshes without a solution is the cost of nothing.
                        @if solution.status == Status::Infeasible { "–" }
                        @else { (cost(record.objective)) }
                    }
                    td { (record.nlp_iterations) }
                    td { (record.nlp_status) }
                    td { (time(record.seconds)) }
                }
            }
        }
    };
    scrolling("Every mesh", &table)
}

/// One row for each of the optima that a search found.
fn optima(search: &Search) -> Markup {
    let table = html! {
        table.history {
            thead {
                tr {
                    @for head in ["", "cost J", "largest base angle", "final", "hits", "first start", ""] {
                        th scope="col" { (head) }
                    }
                }
            }
            @for (k, one) in search.optima.iter().take(OPTIMA).enumerate() {
                tr {
                    td { (k + 1) }
                    td { (cost(one.objective)) }
                    td { (degrees(one.max_base_attitude)) }
                    td { (degrees(one.final_base_attitude)) }
                    td { (one.hits) }
                    td { (one.kind) }
                    td { (one.status.map_or("first mesh", Status::words)) }
                }
            }
        }
    };
    html! {
        p {
            (search.solved) " of " (search.tried) " starts were solved (seed " (search.seed)
            "); there may be optima that none of them led to."
        }
        (scrolling("Every optimum", &table))
        @if search.optima.len() > OPTIMA {
            p { "And " (search.optima.len() - OPTIMA) " more on the first mesh." }
        }
        @if let Some(bounds) = &search.lower_bounds {
            p {
                "No motion keeps the base angle below " (degrees(bounds.max_base_attitude))
                " all along, or below " (degrees(bounds.final_base_attitude))
                " at the end: by dynamic programming over the two joints."
            }
        }
    }
}

/// What was solved by what, and the files word by word.
fn provenance(solution: &Solution) -> Markup {
    let kept = &solution.provenance;
    let fact = |what: &str, value: &str| Fact {
        what: what.into(),
        value: value.into(),
        meaning: String::new(),
    };
    let mut lines = vec![
        fact("ffsm-ipopt", &kept.version),
        fact("Ipopt", &kept.ipopt),
        fact("linear solver", &kept.linear_solver),
        fact("method", &solution.method),
        fact("problem", &kept.problem.path),
    ];
    if !kept.problem.overrides.is_empty() {
        lines.push(fact("changed by", &kept.problem.overrides.join(", ")));
    }
    lines.push(fact("robot", &kept.robot.path));
    lines.push(fact("SHA-256 of the robot", &kept.robot_sha256));
    html! {
        (facts(&lines))
        @for (what, text) in [("problem", &kept.problem.text), ("robot", &kept.robot.text)] {
            details { summary { "The " (what) " file" } pre tabindex="0" { (text) } }
        }
    }
}
