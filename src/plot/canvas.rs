//! SVG, element by element.

use super::{Colour, Stroke};
use crate::printable::printable;
use std::fmt::Write;

/// The family named in the SVG: the one the PNG is drawn with, then common ones of its metrics.
const FAMILY: &str = "'DejaVu Sans', Verdana, sans-serif";

/// Where a text's anchor lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// An SVG document that grows.
#[derive(Debug, Clone, Default)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    /// The whole document, in points, on white.
    pub fn finish(self, description: &str, width: f64, height: f64) -> String {
        let [width, height] = [width, height].map(number);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FAMILY}\" role=\"img\">\n\
             <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n\
             {}</svg>\n",
            escape(description),
            self.body
        )
    }

    /// Begins a window that nothing is drawn outside of; coordinates stay those of the document.
    pub fn clip(&mut self, [x, y, width, height]: [f64; 4]) {
        let [x, y, width, height] = [x, y, width, height].map(number);
        self.add(&format!(
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"{x} {y} {width} {height}\" overflow=\"hidden\">"
        ));
    }

    /// Ends the window.
    pub fn unclip(&mut self) {
        self.add("</svg>");
    }

    /// An open line.
    pub fn path(&mut self, points: &[[f64; 2]], colour: Colour, width: f64, stroke: Stroke) {
        if points.len() < 2 {
            return;
        }
        let Some(dashes) = dashes(stroke) else {
            return;
        };
        self.add(&format!(
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"round\"{dashes}/>",
            data(points),
            colour.hex(),
            number(width)
        ));
    }

    /// A closed outline, filled where a colour is given.
    pub fn polygon(
        &mut self,
        corners: &[[f64; 2]],
        outline: Option<(Colour, f64)>,
        fill: Option<(Colour, f64)>,
    ) {
        let outline = outline.map_or_else(String::new, |(colour, width)| {
            format!(
                " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                colour.hex(),
                number(width)
            )
        });
        let fill = fill.map_or_else(
            || " fill=\"none\"".into(),
            |(colour, opacity)| {
                format!(
                    " fill=\"{}\" fill-opacity=\"{}\"",
                    colour.hex(),
                    number(opacity)
                )
            },
        );
        self.add(&format!("<path d=\"{}Z\"{fill}{outline}/>", data(corners)));
    }

    /// A circle, filled, or white with an outline.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, outline: Colour, fill: Option<Colour>) {
        self.add(&format!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" \
             stroke-width=\"0.7\"/>",
            number(x),
            number(y),
            number(radius),
            fill.map_or("#FFFFFF", Colour::hex),
            outline.hex()
        ));
    }

    /// A text on one line, its baseline at `y`.
    pub fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, size: f64, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        self.add(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{anchor}>{}</text>",
            number(x),
            number(y),
            number(size),
            escape(text)
        ));
    }

    /// A text from bottom to top, centred at `y`, its baseline at `x`.
    pub fn upward_text(&mut self, [x, y]: [f64; 2], size: f64, text: &str) {
        let [x, y] = [x, y].map(number);
        self.add(&format!(
            "<text transform=\"translate({x} {y}) rotate(-90)\" font-size=\"{}\" \
             text-anchor=\"middle\">{}</text>",
            number(size),
            escape(text)
        ));
    }

    fn add(&mut self, element: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.body, "{element}");
    }
}

fn dashes(stroke: Stroke) -> Option<&'static str> {
    match stroke {
        Stroke::Solid => Some(""),
        Stroke::Dashed => Some(" stroke-dasharray=\"5 2.5\""),
        Stroke::Dotted => Some(" stroke-dasharray=\"1.2 1.8\""),
        Stroke::None => None,
    }
}

fn data(points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let command = if k == 0 { 'M' } else { 'L' };
        let _ = write!(text, "{command}{} {}", number(*x), number(*y));
    }
    text
}

/// Hundredths of a point, no more digits than needed.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

fn escape(text: &str) -> String {
    printable(text)
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(1.0), "1");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(120.0), "120");
        assert_eq!(number(12.346), "12.35");
    }

    #[test]
    fn texts_cannot_break_the_document() {
        let mut canvas = Canvas::default();
        canvas.text([0.0, 0.0], Anchor::Start, 7.0, "a < b & \"c\"");
        let svg = canvas.finish("<x>", 10.0, 10.0);
        assert!(svg.contains("a &lt; b &amp; &quot;c&quot;") && svg.contains("<title>&lt;x&gt;"));
    }
}
