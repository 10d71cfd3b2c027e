//! Texts in the font that is part of the program: how wide they are, and their outlines.
//!
//! Characters stand side by side, each as wide as the font says. Kerning, which moves a few pairs by a
//! tenth of a letter, is left out, and so is the shaping of scripts that need it.

use crate::text::printable::printable;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

/// DejaVu Sans 2.37, the Latin, Greek and mathematical characters of it.
static FONT: &[u8] = include_bytes!("font/DejaVuSans.ttf");

/// Width of a text at a font size, both in the same unit.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let mut width = 0.0;
    glyphs(text, |_, advance| width += f64::from(advance));
    width * size
}

/// Draws the outlines of a text at a font size, its baseline beginning at the origin. As in the font, y
/// points up.
pub(super) fn draw(text: &str, size: f32, pen: &mut dyn OutlinePen) {
    let Ok(font) = FontRef::new(FONT) else {
        return;
    };
    let outlines = font.outline_glyphs();
    let mut x = 0.0;
    glyphs(text, |glyph, advance| {
        if let Some(outline) = outlines.get(glyph) {
            let settings = DrawSettings::unhinted(Size::new(size), LocationRef::default());
            let mut shifted = Shifted { pen: &mut *pen, x };
            // A glyph that cannot be drawn leaves a gap.
            let _ = outline.draw(settings, &mut shifted);
        }
        x += advance * size;
    });
}

/// Calls `each` with every glyph of a text and its advance in parts of the font size.
fn glyphs(text: &str, mut each: impl FnMut(GlyphId, f32)) {
    let Ok(font) = FontRef::new(FONT) else {
        return;
    };
    let characters = font.charmap();
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    for c in printable(text).chars() {
        // The font's glyph for what it lacks is an empty box.
        let glyph = characters.map(c).unwrap_or(GlyphId::NOTDEF);
        each(glyph, metrics.advance_width(glyph).unwrap_or(0.0));
    }
}

/// A pen moved to the right.
struct Shifted<'p> {
    pen: &'p mut dyn OutlinePen,
    x: f32,
}

impl OutlinePen for Shifted<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.pen.move_to(self.x + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.pen.line_to(self.x + x, y);
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        self.pen.quad_to(self.x + cx0, cy0, self.x + x, y);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.pen
            .curve_to(self.x + cx0, cy0, self.x + cx1, cy1, self.x + x, y);
    }

    fn close(&mut self) {
        self.pen.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_character_that_labels_use() {
        let font = FontRef::new(FONT).unwrap();
        let characters = font.charmap();
        for c in "θ₁θ₂η̇ζΛ°·⁻⁰¹²³⁴⁵⁶⁷⁸⁹−–‖∫²Δ±≤".chars()
        {
            assert!(characters.map(c).is_some(), "{c}");
        }
        assert!(text_width("wide text", 10.0) > 2.0 * text_width("text", 10.0));
        assert_eq!(text_width("", 10.0), 0.0);
    }

    #[test]
    fn widths_are_those_of_the_font() {
        // Advances of DejaVu Sans, in 2048 parts of the font size.
        let known = [("H", 1540.0), ("0", 1303.0), (".", 651.0), (" ", 651.0)];
        for (text, parts) in known {
            let gap = text_width(text, 2048.0) - parts;
            assert!(gap.abs() < 1e-3, "{text:?}: {gap}");
        }
        // A combining mark stands over the letter before it.
        assert_eq!(text_width("η̇", 1.0), text_width("η", 1.0));
    }
}
