//! STL, binary and as text.

use super::Surface;

/// Bytes before the first triangle, and of each.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Reads a surface; neither normals nor colours are.
pub(super) fn parse(bytes: &[u8]) -> Result<Surface, String> {
    // Binary files may begin with "solid" too: their length tells.
    match count(bytes) {
        Some(count) if bytes.len() == HEADER + TRIANGLE * count => binary(bytes),
        _ if bytes.trim_ascii_start().starts_with(b"solid") => text(bytes),
        Some(count) if bytes.len() > HEADER + TRIANGLE * count => binary(bytes),
        _ => Err("it ends too early, or is no STL".into()),
    }
}

/// Triangles that a binary file says it has.
fn count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

fn binary(bytes: &[u8]) -> Result<Surface, String> {
    let mut surface = Surface::default();
    let triangles = bytes[HEADER..].chunks_exact(TRIANGLE);
    for triangle in triangles.take(count(bytes).unwrap_or(0)) {
        let numbers: Vec<f64> = triangle[12..48]
            .chunks_exact(4)
            .map(|number| f32::from_le_bytes([number[0], number[1], number[2], number[3]]).into())
            .collect();
        let mut corners = [0; 3];
        for (corner, at) in corners.iter_mut().zip(numbers.chunks_exact(3)) {
            *corner = surface.vertex([at[0], at[1], at[2]])?;
        }
        surface.triangle(corners)?;
    }
    Ok(surface)
}

fn text(bytes: &[u8]) -> Result<Surface, String> {
    let mut surface = Surface::default();
    let text = String::from_utf8_lossy(bytes);
    let mut corners = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("facet") => corners.clear(),
            Some("vertex") => {
                let numbers: Vec<f64> = words.filter_map(|word| word.parse().ok()).collect();
                let at = <[f64; 3]>::try_from(numbers)
                    .map_err(|_| format!("line {}: expected three numbers", k + 1))?;
                corners.push(surface.vertex(at)?);
                if let [a, b, c] = corners[..] {
                    surface.triangle([a, b, c])?;
                }
            }
            _ => {}
        }
    }
    Ok(surface)
}
