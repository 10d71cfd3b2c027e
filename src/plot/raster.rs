//! A canvas as PNG.

use super::Colour;
use super::canvas::{Anchor, Canvas, Direction, Element, RING, dashes};
use super::text;
use skrifa::outline::OutlinePen;
use tiny_skia::{
    Color, FillRule, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Rect, Stroke as Line,
    StrokeDash, Transform,
};

/// A figure that cannot be drawn as PNG.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// It is empty or too large.
    #[error("a figure of {width} by {height} pixels cannot be drawn")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// It cannot be compressed.
    #[error("the figure cannot be written as PNG: {0}")]
    Png(String),
}

/// Pixels a point: 288 an inch, for print.
const ZOOM: f32 = 4.0;

/// The canvas on white as PNG; width and height in points.
pub(super) fn png(canvas: &Canvas, width: f64, height: f64) -> Result<Vec<u8>, PlotError> {
    let [width, height] = [width, height].map(|side| (side as f32 * ZOOM).ceil() as u32);
    let no_size = PlotError::Size { width, height };
    let mut painter = Painter::new(width, height).ok_or(no_size)?;
    for element in &canvas.elements {
        painter.draw(element);
    }
    let written = painter.pixels.encode_png();
    written.map_err(|error| PlotError::Png(error.to_string()))
}

/// Pixels, and the window that is drawn in.
struct Painter {
    pixels: Pixmap,
    window: Mask,
    is_clipped: bool,
}

impl Painter {
    fn new(width: u32, height: u32) -> Option<Self> {
        let mut pixels = Pixmap::new(width, height)?;
        pixels.fill(Color::WHITE);
        Some(Self {
            pixels,
            window: Mask::new(width, height)?,
            is_clipped: false,
        })
    }

    fn draw(&mut self, element: &Element) {
        match element {
            Element::Clip(window) => self.clip(window),
            Element::Unclip => self.is_clipped = false,
            Element::Group(_) | Element::Ungroup => {}
            Element::Path {
                points,
                colour,
                width,
                stroke,
            } => {
                let dashes = StrokeDash::new(dashes(*stroke).to_vec(), 0.0);
                self.line(polyline(points, false), *colour, *width, dashes);
            }
            Element::Polygon {
                corners,
                outline,
                fill,
            } => {
                let path = polyline(corners, true);
                if let Some((colour, opacity)) = fill {
                    self.fill(path.clone(), paint(*colour, *opacity), scaled());
                }
                if let Some((colour, width)) = outline {
                    self.line(path, *colour, *width, None);
                }
            }
            Element::Circle {
                centre: [x, y],
                radius,
                outline,
                fill,
            } => {
                let path = PathBuilder::from_circle(*x as f32, *y as f32, *radius as f32);
                let inside = fill.map_or_else(white, |colour| paint(colour, 1.0));
                self.fill(path.clone(), inside, scaled());
                self.line(path, *outline, RING, None);
            }
            Element::Text {
                at: [x, y],
                anchor,
                direction,
                size,
                text,
            } => {
                let mut outlines = Outlines(PathBuilder::new());
                text::draw(text, *size as f32, &mut outlines);
                let back = match anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => -0.5,
                    Anchor::End => -1.0,
                } * text::text_width(text, *size);
                let turn = match direction {
                    Direction::Right => 0.0,
                    Direction::Up => -90.0,
                };
                let place = scaled()
                    .pre_translate(*x as f32, *y as f32)
                    .pre_rotate(turn)
                    .pre_translate(back as f32, 0.0);
                self.fill(outlines.0.finish(), paint(Colour::Black, 1.0), place);
            }
        }
    }

    fn clip(&mut self, [x, y, width, height]: &[f64; 4]) {
        self.window.clear();
        let [x, y, width, height] = [x, y, width, height].map(|value| *value as f32);
        if let Some(window) = Rect::from_xywh(x, y, width, height) {
            let path = PathBuilder::from_rect(window);
            self.window
                .fill_path(&path, FillRule::Winding, true, scaled());
        }
        self.is_clipped = true;
    }

    /// Fills a path; there is none where it has no area.
    fn fill(&mut self, path: Option<Path>, paint: Paint<'_>, place: Transform) {
        if let Some(path) = path {
            let window = self.is_clipped.then_some(&self.window);
            self.pixels
                .fill_path(&path, &paint, FillRule::Winding, place, window);
        }
    }

    fn line(&mut self, path: Option<Path>, colour: Colour, width: f64, dash: Option<StrokeDash>) {
        if let Some(path) = path {
            let line = Line {
                width: width as f32,
                line_join: LineJoin::Round,
                dash,
                ..Line::default()
            };
            let window = self.is_clipped.then_some(&self.window);
            self.pixels
                .stroke_path(&path, &paint(colour, 1.0), &line, scaled(), window);
        }
    }
}

fn scaled() -> Transform {
    Transform::from_scale(ZOOM, ZOOM)
}

fn paint(colour: Colour, opacity: f64) -> Paint<'static> {
    let [red, green, blue] = colour.rgb();
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

fn white() -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(Color::WHITE);
    paint
}

fn polyline(points: &[[f64; 2]], is_closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, [x, y]) in points.iter().enumerate() {
        match k {
            0 => path.move_to(*x as f32, *y as f32),
            _ => path.line_to(*x as f32, *y as f32),
        }
    }
    if is_closed {
        path.close();
    }
    path.finish()
}

/// Outlines of glyphs; those of the font have y pointing up.
struct Outlines(PathBuilder);

impl OutlinePen for Outlines {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, -y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, -y);
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        self.0.quad_to(cx0, -cy0, x, -y);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.0.cubic_to(cx0, -cy0, cx1, -cy1, x, -y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Stroke;

    /// Pixels of a canvas of 20 by 10 points.
    fn painted(canvas: &Canvas) -> Pixmap {
        Pixmap::decode_png(&png(canvas, 20.0, 10.0).unwrap()).unwrap()
    }

    fn at(pixels: &Pixmap, x: u32, y: u32) -> [u8; 3] {
        let pixel = pixels.pixel(x, y).unwrap();
        [pixel.red(), pixel.green(), pixel.blue()]
    }

    #[test]
    fn lines_are_where_they_belong_and_end_at_the_window() {
        let mut canvas = Canvas::default();
        canvas.clip([0.0, 0.0, 10.0, 10.0]);
        let line = [[0.0, 5.0], [20.0, 5.0]];
        canvas.path(&line, Colour::Blue, 1.0, Stroke::Solid);
        canvas.unclip();
        let pixels = painted(&canvas);
        assert_eq!([pixels.width(), pixels.height()], [80, 40]);
        assert_eq!(at(&pixels, 10, 20), [0x00, 0x72, 0xB2]);
        assert_eq!(at(&pixels, 10, 25), [255; 3]);
        assert_eq!(at(&pixels, 60, 20), [255; 3]);
    }

    #[test]
    fn texts_stand_at_their_anchors() {
        // Dark pixels left and right of the middle, above and below it.
        let sides = |anchor, upward: bool| {
            let mut canvas = Canvas::default();
            match upward {
                true => canvas.upward_text([10.0, 5.0], 6.0, "HH"),
                false => canvas.text([10.0, 5.0], anchor, 6.0, "HH"),
            }
            let pixels = painted(&canvas);
            let dark = |x: std::ops::Range<u32>, y: std::ops::Range<u32>| {
                x.flat_map(|x| y.clone().map(move |y| (x, y)))
                    .any(|(x, y)| at(&pixels, x, y)[0] < 128)
            };
            [
                dark(0..39, 0..40),
                dark(41..80, 0..40),
                dark(0..80, 0..19),
                dark(0..80, 21..40),
            ]
        };
        assert_eq!(sides(Anchor::Start, false), [false, true, true, false]);
        assert_eq!(sides(Anchor::End, false), [true, false, true, false]);
        assert_eq!(sides(Anchor::Middle, false), [true, true, true, false]);
        assert_eq!(sides(Anchor::Middle, true), [true, false, true, true]);
    }

    #[test]
    fn a_figure_without_a_size_is_refused() {
        let nothing = png(&Canvas::default(), 0.0, 10.0);
        assert!(matches!(nothing, Err(PlotError::Size { width: 0, .. })));
    }
}
