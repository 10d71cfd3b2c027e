//! What charts and their legends draw alike.

use super::canvas::Canvas;
use super::{Colour, Marker, Stroke};

/// Opacity of a band.
pub(super) const BAND: f64 = 0.25;

/// One marker, some 4 points across.
pub(super) fn mark(canvas: &mut Canvas, [x, y]: [f64; 2], marker: Marker, colour: Colour) {
    const R: f64 = 2.0;
    let filled = |canvas: &mut Canvas, corners: &[[f64; 2]]| {
        canvas.polygon(corners, Some((colour, 0.5)), Some((colour, 1.0)));
    };
    match marker {
        Marker::Disc => canvas.circle([x, y], R, colour, Some(colour)),
        Marker::Ring => canvas.circle([x, y], R, colour, None),
        Marker::Square => filled(
            canvas,
            &[
                [x - R, y - R],
                [x + R, y - R],
                [x + R, y + R],
                [x - R, y + R],
            ],
        ),
        Marker::Triangle => filled(
            canvas,
            &[[x, y - 1.3 * R], [x + 1.2 * R, y + R], [x - 1.2 * R, y + R]],
        ),
        Marker::Diamond => filled(
            canvas,
            &[
                [x, y - 1.4 * R],
                [x + 1.4 * R, y],
                [x, y + 1.4 * R],
                [x - 1.4 * R, y],
            ],
        ),
        Marker::Cross => {
            for sign in [-1.0, 1.0] {
                let line = [[x - R, y - sign * R], [x + R, y + sign * R]];
                canvas.path(&line, colour, 1.0, Stroke::Solid);
            }
        }
    }
}
