//! A canvas as SVG.

use super::Colour;
use super::canvas::{Anchor, Canvas, Direction, Element, Part, RING, dashes};
use crate::text::printable::xml_text;
use std::fmt::{Display, Write};

/// The family named in the SVG: the one the PNG is drawn with, then common ones of its metrics.
const FAMILY: &str = "'DejaVu Sans', Verdana, sans-serif";

/// Whether the document says what belongs to which entry of the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Groups {
    Told,
    Left,
}

/// The whole document, in points, on white.
pub(super) fn svg(
    canvas: &Canvas,
    description: &str,
    [width, height]: [f64; 2],
    groups: Groups,
) -> String {
    let [width, height] = [width, height].map(number);
    let mut document = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"{FAMILY}\" role=\"img\">\n\
         <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n",
        xml_text(description),
    );
    let is_group = |element: &&Element| matches!(element, Element::Group(_) | Element::Ungroup);
    let left = |element: &&Element| groups == Groups::Left && is_group(element);
    for element in canvas.elements.iter().filter(|element| !left(element)) {
        document.push_str(&of(element));
        document.push('\n');
    }
    document.push_str("</svg>\n");
    document
}

fn of(element: &Element) -> String {
    match element {
        Element::Clip(window) => {
            let [x, y, width, height] = window.map(number);
            format!(
                "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
                 viewBox=\"{x} {y} {width} {height}\" overflow=\"hidden\">"
            )
        }
        Element::Unclip => "</svg>".into(),
        Element::Group(Part::Curve(entry)) => format!("<g data-curve=\"{entry}\">"),
        Element::Group(Part::Entry(entry)) => format!("<g data-entry=\"{entry}\">"),
        Element::Group(Part::Divisions) => "<g data-divisions=\"\">".into(),
        Element::Group(Part::Ticks) => "<g data-ticks=\"\">".into(),
        Element::Ungroup => "</g>".into(),
        Element::Path {
            points,
            colour,
            width,
            stroke,
        } => {
            let dashes = match dashes(*stroke) {
                [] => String::new(),
                lengths => format!(" stroke-dasharray=\"{}\"", joined(lengths)),
            };
            format!(
                "<path d=\"{}\" fill=\"none\"{}{dashes}/>",
                data(points),
                stroked(*colour, *width)
            )
        }
        Element::Polygon {
            corners,
            outline,
            fill,
        } => {
            let outline =
                outline.map_or_else(String::new, |(colour, width)| stroked(colour, width));
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
            format!("<path d=\"{}Z\"{fill}{outline}/>", data(corners))
        }
        Element::Circle {
            centre: [x, y],
            radius,
            outline,
            fill,
        } => format!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" \
             stroke-width=\"{}\"/>",
            number(*x),
            number(*y),
            number(*radius),
            fill.map_or_else(|| "#FFFFFF".into(), Colour::hex),
            outline.hex(),
            number(RING)
        ),
        Element::Text {
            at,
            anchor,
            direction,
            size,
            text,
        } => {
            let [x, y] = at.map(number);
            let place = match direction {
                Direction::Right => format!("x=\"{x}\" y=\"{y}\""),
                Direction::Up => format!("transform=\"translate({x} {y}) rotate(-90)\""),
            };
            let anchor = match anchor {
                Anchor::Start => "",
                Anchor::Middle => " text-anchor=\"middle\"",
                Anchor::End => " text-anchor=\"end\"",
            };
            format!(
                "<text {place} font-size=\"{}\"{anchor}>{}</text>",
                number(*size),
                xml_text(text)
            )
        }
    }
}

fn stroked(colour: Colour, width: f64) -> String {
    format!(
        " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
        colour.hex(),
        number(width)
    )
}

fn joined(values: &[impl Display]) -> String {
    let values: Vec<String> = values.iter().map(ToString::to_string).collect();
    values.join(" ")
}

fn data(points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let command = if k == 0 { 'M' } else { 'L' };
        // Writing to a string cannot fail.
        let _ = write!(text, "{command}{} {}", number(*x), number(*y));
    }
    text
}

/// Hundredths of a point, no more digits than needed.
fn number(value: f64) -> String {
    // The shortest text of the nearest number to so many hundredths has no more; without a negative zero.
    ((value * 100.0).round() / 100.0 + 0.0).to_string()
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
    fn groups_are_told_where_they_are_asked_for() {
        let mut canvas = Canvas::default();
        canvas.group(Part::Curve(3), |canvas| {
            canvas.text([0.0, 0.0], Anchor::Start, 7.0, "a");
        });
        let with = svg(&canvas, "", [10.0, 10.0], Groups::Told);
        let without = svg(&canvas, "", [10.0, 10.0], Groups::Left);
        assert!(with.contains("<g data-curve=\"3\">\n<text") && !without.contains("<g"));
        let left = with
            .replace("<g data-curve=\"3\">\n", "")
            .replace("</g>\n", "");
        assert_eq!(left, without);
    }

    #[test]
    fn texts_cannot_break_the_document() {
        let mut canvas = Canvas::default();
        canvas.text([0.0, 0.0], Anchor::Start, 7.0, "a < b & \"c\"");
        let svg = svg(&canvas, "<x>", [10.0, 10.0], Groups::Left);
        assert!(svg.contains("a &lt; b &amp; &quot;c&quot;") && svg.contains("<title>&lt;x&gt;"));
    }
}
