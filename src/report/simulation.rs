//! What `simulate` leaves behind: `simulation.json`, `simulation.csv` and the table a person
//! reads.

use super::Lines;
use super::format::{centimetres, degrees};
use crate::plot::{Axis, Chart, Colour, Figure, Series, Stroke, Width};
use crate::simulate::{Figures, Run, Spread};
use crate::solution::{Build, number, to_json};
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use std::path::PathBuf;

/// All runs of one plan on one platform.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    /// Name of the problem.
    pub name: &'a str,
    /// Path of the solution, as given.
    pub solution: String,
    /// Name of the platform.
    pub platform: &'a str,
    /// Path and text of its file.
    pub file: (&'a str, &'a str),
    /// Seed of all runs.
    pub seed: u64,
    /// Whether no joint slides.
    pub joints_turn: bool,
    /// Planned x, y (m) and attitude (rad) of the base, one row a frame.
    pub planned: &'a [[f64; 3]],
    /// The runs, at least one, of as many frames each.
    pub runs: &'a [Run],
}

/// A figure that is told of plan and runs.
struct Kind {
    key: &'static str,
    label: &'static str,
    show: fn(f64) -> String,
    of: fn(&Figures) -> f64,
}

const KINDS: [Kind; 6] = [
    Kind {
        key: "max_base_attitude",
        label: "largest attitude",
        show: degrees,
        of: |f| f.max_attitude,
    },
    Kind {
        key: "final_base_attitude",
        label: "final attitude",
        show: degrees,
        of: |f| f.final_attitude,
    },
    Kind {
        key: "max_base_displacement",
        label: "largest displacement",
        show: centimetres,
        of: |f| f.max_displacement,
    },
    Kind {
        key: "final_base_displacement",
        label: "final displacement",
        show: centimetres,
        of: Figures::final_distance,
    },
    Kind {
        key: "final_x",
        label: "along x",
        show: centimetres,
        of: |f| f.final_displacement[0],
    },
    Kind {
        key: "final_y",
        label: "along y",
        show: centimetres,
        of: |f| f.final_displacement[1],
    },
];

impl Simulation<'_> {
    fn figures(&self) -> Vec<Figures> {
        self.runs.iter().map(Figures::measured).collect()
    }

    /// The table and what else a person wants to know; `files` are those written.
    pub fn summary(&self, files: &[PathBuf]) -> String {
        let planned = Figures::of(self.planned);
        let measured = self.figures();
        let mut table = Table::new();
        table.load_style(presets::NOTHING).set_header([
            "base, as measured",
            "planned",
            "mean",
            "deviation",
            "min",
            "max",
        ]);
        for Kind {
            label, show, of, ..
        } in KINDS
        {
            let Spread {
                mean,
                deviation,
                min,
                max,
            } = Spread::of(measured.iter().map(of));
            let values = [of(&planned), mean, deviation, min, max].map(show);
            table.add_row(std::iter::once(label.to_string()).chain(values));
        }
        for column in 1..6 {
            if let Some(column) = table.column_mut(column) {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        let table: String = table
            .to_string()
            .lines()
            .map(|line| format!(" {}\n", line.trim_end()))
            .collect();

        let most = |of: fn(&Run) -> f64| self.runs.iter().map(of).fold(0.0, f64::max);
        let error = most(|run| run.max_joint_error);
        let joints = if self.joints_turn {
            format!("within {:.2e}° of their plan", error.to_degrees())
        } else {
            format!("within {error:.2e} rad or m of their plan")
        };
        let mut lines = Lines::default();
        lines.add("joints", joints);
        lines.add(
            "momentum",
            format!(
                "changes by at most {:.2e} kg m/s and {:.2e} kg m²/s",
                most(|run| run.max_linear_momentum),
                most(|run| run.max_angular_momentum)
            ),
        );
        lines.files(files);
        let runs = match self.runs.len() {
            1 => "1 run".into(),
            count => format!("{count} runs"),
        };
        format!(
            "{} on {}: {runs}, seed {}\n\n{table}\n{}",
            self.name,
            self.platform,
            self.seed,
            lines.finish()
        )
    }

    /// Base attitude and position over time: the plan, and what the runs measured.
    pub fn figure(&self) -> Figure {
        let t = &self.runs[0].t;
        let start = self.planned[0];
        let zero: Vec<[f64; 3]> = self.runs.iter().map(|run| run.measured[0]).collect();
        let chart = |title: &str, unit: &str, factor: f64, components: &[(usize, &str)]| {
            let mut chart = Chart::new(Axis::linear("Time (s)"), Axis::linear(unit)).title(title);
            for (number, &(component, name)) in components.iter().enumerate() {
                let colour = Colour::of_series(number);
                let planned: Vec<f64> = self
                    .planned
                    .iter()
                    .map(|row| factor * (row[component] - start[component]))
                    .collect();
                let spread: Vec<Spread> = (0..t.len())
                    .map(|k| {
                        Spread::of(self.runs.iter().zip(&zero).map(|(run, zero)| {
                            factor * (run.measured[k][component] - zero[component])
                        }))
                    })
                    .collect();
                let of = |f: fn(&Spread) -> f64| spread.iter().map(f).collect::<Vec<f64>>();
                if self.runs.len() > 1 {
                    let (lower, upper) = (of(|s| s.min), of(|s| s.max));
                    let band = Series::band("", t, &lower, &upper);
                    chart = chart.series(band.colour(colour));
                }
                let measured = Series::line(&format!("{name}measured"), t, &of(|s| s.mean));
                let dashed = Series::line(&format!("{name}planned"), t, &planned);
                chart = chart
                    .series(measured.colour(colour))
                    .series(dashed.colour(colour).stroke(Stroke::Dashed));
            }
            chart
        };
        let (title, runs) = match self.runs.len() {
            1 => ("", String::new()),
            count => (
                " (mean and range)",
                format!(", mean and range of {count} runs"),
            ),
        };
        let description = format!(
            "Base attitude and displacement of {} on {}{runs}",
            self.name, self.platform
        );
        Figure::new(&description, Width::Column)
            .panel(chart(
                &format!("(a) Base attitude{title}"),
                "Angle (deg)",
                1f64.to_degrees(),
                &[(2, "")],
            ))
            .panel(chart(
                &format!("(b) Base displacement{title}"),
                "Displacement (cm)",
                100.0,
                &[(0, "x "), (1, "y ")],
            ))
    }

    /// `simulation.json`.
    ///
    /// # Errors
    /// None that is expected: all keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        let table = |of: &dyn Fn(&Kind) -> serde_json::Result<serde_json::Value>| {
            KINDS
                .iter()
                .map(|kind| Ok((kind.key.to_string(), of(kind)?)))
                .collect::<serde_json::Result<serde_json::Map<_, _>>>()
        };
        let figures = |figures: &Figures| table(&|kind| Ok((kind.of)(figures).into()));
        let measured = self.figures();
        let spread = table(&|kind| {
            let Spread {
                mean,
                deviation,
                min,
                max,
            } = Spread::of(measured.iter().map(kind.of));
            serde_json::to_value(Statistics {
                mean,
                deviation,
                min,
                max,
            })
        })?;
        let runs = self.runs.iter().zip(&measured).map(|(run, found)| {
            Ok(RunRecord {
                figures: figures(found)?,
                max_joint_error: run.max_joint_error,
                max_linear_momentum: run.max_linear_momentum,
                max_angular_momentum: run.max_angular_momentum,
                measured: &run.measured,
                actual: &run.actual,
                joint_position: &run.joint_position,
                joint_torque: &run.joint_torque,
            })
        });
        let (path, text) = self.file;
        to_json(&Document {
            schema: 1,
            name: self.name,
            solution: &self.solution,
            version: Build::VERSION,
            platform: PlatformRecord {
                name: self.platform,
                path,
                text,
            },
            seed: self.seed,
            repeats: self.runs.len(),
            planned_figures: figures(&Figures::of(self.planned))?,
            measured_figures: spread,
            t: &self.runs[0].t,
            planned: self.planned,
            runs: runs.collect::<serde_json::Result<Vec<_>>>()?,
        })
    }

    /// `simulation.csv`: one row a run and frame.
    ///
    /// # Errors
    /// None that is expected: all rows are as long as the header.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let n = self.runs[0].joint_position.first().map_or(0, Vec::len);
        let mut header: Vec<String> = ["run", "t"].map(String::from).to_vec();
        for what in ["planned", "measured", "actual"] {
            header.extend(["x", "y", "eta"].map(|k| format!("{what}_{k}")));
        }
        for what in ["th", "tau"] {
            header.extend((1..=n).map(|j| format!("{what}_{j}")));
        }
        writer.write_record(header)?;
        for (index, run) in self.runs.iter().enumerate() {
            for k in 0..run.t.len() {
                let poses = [self.planned[k], run.measured[k], run.actual[k]];
                let joints = run.joint_position[k].iter().chain(&run.joint_torque[k]);
                let values = std::iter::once(&run.t[k])
                    .chain(poses.iter().flatten())
                    .chain(joints);
                writer.serialize((index + 1, values.copied().collect::<Vec<f64>>()))?;
            }
        }
        let bytes = writer.into_inner().map_err(|error| error.into_error())?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    name: &'a str,
    solution: &'a str,
    version: &'static str,
    platform: PlatformRecord<'a>,
    seed: u64,
    repeats: usize,
    planned_figures: serde_json::Map<String, serde_json::Value>,
    measured_figures: serde_json::Map<String, serde_json::Value>,
    t: &'a [f64],
    planned: &'a [[f64; 3]],
    runs: Vec<RunRecord<'a>>,
}

#[derive(Serialize)]
struct PlatformRecord<'a> {
    name: &'a str,
    path: &'a str,
    text: &'a str,
}

#[derive(Serialize)]
struct Statistics {
    #[serde(with = "number")]
    mean: f64,
    #[serde(with = "number")]
    deviation: f64,
    #[serde(with = "number")]
    min: f64,
    #[serde(with = "number")]
    max: f64,
}

#[derive(Serialize)]
struct RunRecord<'a> {
    figures: serde_json::Map<String, serde_json::Value>,
    max_joint_error: f64,
    max_linear_momentum: f64,
    max_angular_momentum: f64,
    measured: &'a [[f64; 3]],
    actual: &'a [[f64; 3]],
    joint_position: &'a [Vec<f64>],
    joint_torque: &'a [Vec<f64>],
}
