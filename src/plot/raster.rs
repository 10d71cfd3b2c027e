//! PNG from SVG, and the widths of texts, with a font that is part of the program.

use crate::printable::printable;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock};

/// An SVG that cannot be turned into a PNG.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// It is no SVG.
    #[error("the figure cannot be read as SVG: {0}")]
    Svg(String),
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

/// DejaVu Sans 2.37, the Latin, Greek and mathematical characters of it.
static FONT: &[u8] = include_bytes!("font/DejaVuSans.ttf");

/// SVG takes a point as 4/3 pixels; three times that prints at 288 pixels an inch.
const ZOOM: f32 = 3.0;

static OPTIONS: LazyLock<Options<'static>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    Options {
        font_family: "DejaVu Sans".into(),
        fontdb: Arc::new(fonts),
        ..Options::default()
    }
});

/// An SVG of this module as PNG, 288 pixels an inch.
///
/// # Errors
/// [`PlotError`] for what is no SVG, or too large to draw.
pub fn png(svg: &str) -> Result<Vec<u8>, PlotError> {
    let tree = Tree::from_str(svg, &OPTIONS).map_err(|error| PlotError::Svg(error.to_string()))?;
    let size = tree.size();
    let [width, height] = [size.width(), size.height()].map(|side| (side * ZOOM).ceil() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or(PlotError::Size { width, height })?;
    resvg::render(
        &tree,
        Transform::from_scale(ZOOM, ZOOM),
        &mut pixels.as_mut(),
    );
    pixels
        .encode_png()
        .map_err(|error| PlotError::Png(error.to_string()))
}

/// Width of a text at a font size, both in the same unit.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    if text.chars().all(|c| NUMERIC.contains(c)) {
        return advance(text) * size;
    }
    WIDTHS.with_borrow_mut(|widths| match widths.get(text) {
        Some(width) => width * size,
        None => {
            let width = laid_out(text);
            if widths.len() >= MOST_WIDTHS {
                widths.clear();
            }
            widths.insert(text.into(), width);
            width * size
        }
    })
}

thread_local! {
    /// Widths of texts in parts of the font size: legends come again, and layout takes its time.
    static WIDTHS: RefCell<HashMap<String, f64>> = RefCell::default();
}

/// Texts whose widths are kept.
const MOST_WIDTHS: usize = 1000;

/// Width of a text in parts of the font size, as usvg lays it out.
fn laid_out(text: &str) -> f64 {
    let escaped = printable(text).replace('&', "&amp;").replace('<', "&lt;");
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">\
         <text font-family=\"DejaVu Sans\" font-size=\"100\">{escaped}</text></svg>"
    );
    let width =
        Tree::from_str(&svg, &OPTIONS).map_or(0.0, |tree| tree.root().abs_bounding_box().width());
    f64::from(width) / 100.0
}

/// Characters of numbers. No two of them are moved together by the font, so that their advances
/// are all there is to know, a hundred times sooner than by laying them out.
const NUMERIC: &str = "0123456789.−⁻⁰¹²³⁴⁵⁶⁷⁸⁹";

/// Sum of the advances of all characters, in parts of the font size.
fn advance(text: &str) -> f64 {
    let Ok(font) = FontRef::new(FONT) else {
        return 0.0;
    };
    let glyphs = font.charmap();
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    let width = |c| metrics.advance_width(glyphs.map(c)?);
    text.chars().filter_map(width).map(f64::from).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_character_that_labels_use() {
        let blank = text_width("", 10.0);
        for c in "θ₁θ₂η̇ζΛ°·⁻⁰¹²³⁴⁵⁶⁷⁸⁹−–‖∫²Δ±≤".chars()
        {
            let width = text_width(&format!("|{c}|"), 10.0);
            assert!(width > blank, "{c}");
        }
        assert!(text_width("wide text", 10.0) > 2.0 * text_width("text", 10.0));
    }

    #[test]
    fn numbers_are_as_wide_as_when_laid_out() {
        let bars = text_width("||", 100.0);
        for text in [
            "",
            "0.123456789",
            "−30",
            "10⁻⁵",
            "10²³⁴",
            "⁰¹⁶⁷⁸⁹",
            "777.11",
        ] {
            // Bars make it a text that is laid out.
            let laid_out = text_width(&format!("|{text}|"), 100.0) - bars;
            let gap = text_width(text, 100.0) - laid_out;
            assert!(gap.abs() < 1e-2, "{text:?}: {gap}");
        }
    }

    #[test]
    fn what_is_no_svg_is_refused() {
        assert!(matches!(png("no svg"), Err(PlotError::Svg(_))));
    }
}
