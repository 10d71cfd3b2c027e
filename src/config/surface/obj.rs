//! Wavefront OBJ: vertices and faces.

use super::Surface;

/// Reads a surface; faces with more corners than three are cut into triangles, which is right for
/// convex ones.
pub(super) fn parse(bytes: &[u8]) -> Result<Surface, String> {
    let mut surface = Surface::default();
    let text = String::from_utf8_lossy(bytes);
    for (k, line) in text.lines().enumerate() {
        let wrong = |expected: &str| format!("line {}: expected {expected}", k + 1);
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Option<Vec<f64>> =
                    words.take(3).map(|word| word.parse().ok()).collect();
                let at = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
                surface.vertex(at.ok_or_else(|| wrong("three numbers"))?)?;
            }
            Some("f") => {
                let known = surface.vertices.len();
                let corners: Option<Vec<u32>> = words.map(|word| corner(word, known)).collect();
                let corners = corners.filter(|corners| corners.len() >= 3);
                let corners =
                    corners.ok_or_else(|| wrong("three vertices or more that are there"))?;
                for pair in corners[1..].windows(2) {
                    surface.triangle([corners[0], pair[0], pair[1]])?;
                }
            }
            _ => {}
        }
    }
    Ok(surface)
}

/// The number of the vertex of a corner, `7`, `7/1/2` or `-1` for the last of the `known` ones.
fn corner(word: &str, known: usize) -> Option<u32> {
    let number: i64 = word.split('/').next()?.parse().ok()?;
    let known = i64::try_from(known).ok()?;
    let index = if number < 0 {
        known.checked_add(number)?
    } else {
        number - 1
    };
    u32::try_from(index)
        .ok()
        .filter(|index| i64::from(*index) < known)
}
