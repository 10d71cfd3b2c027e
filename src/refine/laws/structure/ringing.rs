//! Controls that follow the mesh instead of the problem.

/// Fewest segments in which that can be told.
const SEGMENTS: usize = 4;

/// Whether `values`, at the points of so many segments, turn round at least once a segment by more than
/// `near`: as where nothing depends on them, so that their switches tell nothing.
pub(super) fn rings(values: &[f64], segments: usize, near: f64) -> bool {
    segments >= SEGMENTS && turns(values, near) >= segments
}

/// How often `values` turn round by more than `near`.
fn turns(values: &[f64], near: f64) -> usize {
    let mut extreme = values[0];
    let mut direction = 0.0;
    let mut count = 0;
    for &value in values {
        let way = value - extreme;
        if direction * way > 0.0 {
            extreme = value;
        } else if way.abs() > near {
            count += usize::from(direction != 0.0);
            direction = way.signum();
            extreme = value;
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::turns;

    #[test]
    fn turns_are_counted_where_they_are_larger_than_noise() {
        assert_eq!(turns(&[0.0, 1.0, 0.95, 2.0, 0.0, 0.05, 3.0], 0.1), 2);
        assert_eq!(turns(&[1.0, 0.0, 1.0, 0.0], 0.1), 2);
        assert_eq!(turns(&[1.0, 1.01, 1.0, 1.01], 0.1), 0);
    }
}
