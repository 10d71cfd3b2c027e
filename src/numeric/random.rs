//! Random numbers: streams far apart from seeds that are near each other, and normal ones.

use std::f64::consts::TAU;

/// The finaliser of SplitMix64 (doi:10.1145/2660193.2660195).
pub(crate) fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A standard normal number from two that are uniform between 0 and 1, the first not 0.
///
/// G. E. P. Box, M. E. Muller, doi:10.1214/aoms/1177706645.
pub(crate) fn standard_normal([radius, turn]: [f64; 2]) -> f64 {
    (-2.0 * radius.ln()).sqrt() * (TAU * turn).cos()
}
