//! PNG from SVG, and the widths of texts, with a font that is part of the program.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use std::sync::{Arc, LazyLock};

/// An SVG that cannot be turned into a PNG.
#[derive(Debug, thiserror::Error)]
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
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\">\
         <text font-family=\"DejaVu Sans\" font-size=\"100\">{escaped}</text></svg>"
    );
    let width =
        Tree::from_str(&svg, &OPTIONS).map_or(0.0, |tree| tree.root().abs_bounding_box().width());
    f64::from(width) * size / 100.0
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
    fn what_is_no_svg_is_refused() {
        assert!(matches!(png("no svg"), Err(PlotError::Svg(_))));
    }
}
