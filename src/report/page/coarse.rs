//! Surfaces with fewer triangles: vertices in one cell of a grid become one, their mean.

use crate::config::Surface;
use std::collections::{HashMap, HashSet};

/// Cells along the longest edge that the coarsening begins with; finer is more than a picture shows.
const FINEST: f64 = 512.0;
/// By what the cells grow from one grid to the next.
const GROWTH: f64 = 1.25;
/// Part of a cell by which the grid begins before the surface: vertices lie at even parts of its size, and
/// rounding is not to tell apart those that are one.
const OFFSET: f64 = 0.37;
/// Cells along the longest edge of which no shape is left.
const COARSEST: f64 = 3.0;
/// Corners around each side of a box; bit i of a corner's number says which end of axis i it is at.
pub(super) const SIDES: [[u32; 4]; 6] = [
    [0, 1, 3, 2],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 3, 7, 6],
    [0, 2, 6, 4],
    [1, 3, 7, 5],
];

/// The surface in at most `most` triangles; its bounding box where no fewer make the shape.
pub(super) fn coarse(surface: &Surface, most: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let [low, high] = bounds(&surface.vertices);
    let longest = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    if !(longest > 0.0 && longest.is_finite()) {
        return (Vec::new(), Vec::new());
    }
    let mut cells = FINEST;
    let mut found = clustered(&surface.vertices, &surface.triangles, low, longest / cells);
    while found.1.len() > most && cells > COARSEST {
        cells /= GROWTH;
        found = clustered(&found.0, &found.1, low, longest / cells);
    }
    if found.1.is_empty() || found.1.len() > most {
        return cuboid(low, high);
    }
    found
}

/// The smallest and the largest coordinates.
pub(super) fn bounds(vertices: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    vertices.iter().fold(start, |[low, high], vertex| {
        let each = |of: fn(f64, f64) -> f64, ends: [f64; 3]| {
            std::array::from_fn(|i| of(ends[i], vertex[i]))
        };
        [each(f64::min, low), each(f64::max, high)]
    })
}

fn clustered(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    low: [f64; 3],
    cell: f64,
) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut numbers = HashMap::new();
    let mut sums: Vec<([f64; 3], f64)> = Vec::new();
    let renumbered: Vec<u32> = vertices
        .iter()
        .map(|vertex| {
            let of_grid = |i: usize| ((vertex[i] - low[i]) / cell + OFFSET).floor() as i64;
            let number = *numbers.entry([0, 1, 2].map(of_grid)).or_insert_with(|| {
                sums.push(([0.0; 3], 0.0));
                sums.len() - 1
            });
            let (sum, count) = &mut sums[number];
            for i in 0..3 {
                sum[i] += vertex[i];
            }
            *count += 1.0;
            number as u32
        })
        .collect();
    let mut seen = HashSet::new();
    let kept = triangles.iter().filter_map(|corners| {
        let [a, b, c] = corners.map(|corner| renumbered[corner as usize]);
        let mut sorted = [a, b, c];
        sorted.sort_unstable();
        (a != b && b != c && c != a && seen.insert(sorted)).then_some([a, b, c])
    });
    let kept: Vec<[u32; 3]> = kept.collect();
    let means = sums
        .iter()
        .map(|(sum, count)| sum.map(|value| value / count));
    used(means.collect(), kept)
}

/// Only the vertices that triangles have.
fn used(vertices: Vec<[f64; 3]>, mut triangles: Vec<[u32; 3]>) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut numbers = HashMap::new();
    let mut kept = Vec::new();
    for corner in triangles.iter_mut().flatten() {
        *corner = *numbers.entry(*corner).or_insert_with(|| {
            kept.push(vertices[*corner as usize]);
            kept.len() as u32 - 1
        });
    }
    (kept, triangles)
}

fn cuboid(low: [f64; 3], high: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corner = |bits: usize| std::array::from_fn(|i| [low[i], high[i]][(bits >> i) & 1]);
    let halves = SIDES
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    ((0..8).map(corner).collect(), halves.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A ball as a tool writes it: three vertices of its own for each triangle.
    fn ball(rings: usize) -> Surface {
        let mut surface = Surface::default();
        let at = |i: usize, k: usize| {
            let (a, b) = (PI * i as f64 / rings as f64, PI * k as f64 / rings as f64);
            [a.sin() * b.cos(), a.sin() * b.sin(), a.cos()]
        };
        for i in 0..rings {
            for k in 0..2 * rings {
                for corners in [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]] {
                    let first = surface.vertices.len() as u32;
                    surface
                        .vertices
                        .extend(corners.map(|(di, dk)| at(i + di, k + dk)));
                    surface.triangles.push([first, first + 1, first + 2]);
                }
            }
        }
        surface
    }

    #[test]
    fn a_ball_stays_a_ball_of_fewer_triangles() {
        let (vertices, triangles) = coarse(&ball(60), 400);
        assert!(
            (150..=400).contains(&triangles.len()),
            "{}",
            triangles.len()
        );
        for vertex in &vertices {
            let radius = vertex.iter().map(|value| value * value).sum::<f64>().sqrt();
            assert!((0.9..=1.001).contains(&radius), "{radius}");
        }
    }

    #[test]
    fn what_is_coarse_enough_keeps_its_shape_and_shares_its_vertices() {
        let (vertices, triangles) = coarse(&ball(6), 400);
        // At the poles half of the triangles are none.
        assert_eq!((vertices.len(), triangles.len()), (5 * 12 + 2, 2 * 5 * 12));
    }

    #[test]
    fn nothing_is_left_of_a_point_and_a_box_of_what_has_no_shape() {
        let mut surface = Surface {
            vertices: vec![[1.0; 3]; 3],
            triangles: vec![[0, 1, 2]],
        };
        assert!(coarse(&surface, 10).1.is_empty());
        surface.vertices[1] = [2.0, 1.0, 1.0];
        assert_eq!(coarse(&surface, 20).1.len(), 12);
    }
}
