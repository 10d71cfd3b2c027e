//! Figures for print: charts with axes, drawings to scale, written as SVG and PNG.
//!
//! Nothing here knows of robots or plans. Lengths are points (1/72 inch), so that text has the
//! size it is printed with: a [`Width::Column`] fits one column of a two-column page. Colours are
//! those of Okabe and Ito, which the colour-blind can tell apart. The same figure gives the same
//! bytes on every machine: the PNG is drawn with a font that is part of the program.
//!
//! ```
//! use ffsm_ipopt::plot::{Axis, Chart, Figure, Series, Width};
//!
//! let t: Vec<f64> = (0..=200).map(|k| 0.1 * f64::from(k)).collect();
//! let swing = |phase: f64| t.iter().map(|t| 30.0 * (0.5 * t + phase).sin()).collect::<Vec<_>>();
//! let chart = Chart::new(Axis::linear("Time (s)"), Axis::linear("Angle (deg)"))
//!     .title("(a) Joint angles")
//!     .series(Series::line("θ₁", &t, &swing(0.0)))
//!     .series(Series::line("θ₂", &t, &swing(1.0)))
//!     .bounds("limit", &[-45.0, 45.0])
//!     .divisions(&[5.0, 10.0, 15.0]);
//! let figure = Figure::new("Joint angles of a swing", Width::Column).panel(chart);
//! let svg = figure.svg();
//! let png = figure.png()?;
//! assert!(svg.starts_with("<svg") && png.starts_with(b"\x89PNG"));
//! # Ok::<(), ffsm_ipopt::plot::PlotError>(())
//! ```

mod axis;
mod canvas;
mod chart;
mod colour;
mod contents;
mod draw;
mod figure;
mod legend;
mod marks;
mod raster;
mod ruler;
mod series;
mod shape;
mod svg;
mod text;

pub use axis::Axis;
pub use chart::Chart;
pub use colour::Colour;
pub use contents::{Contents, Curve};
pub use figure::{Figure, Frame, Width};
pub use raster::PlotError;
pub use series::{Marker, Series, Stroke};
pub use shape::Shape;
