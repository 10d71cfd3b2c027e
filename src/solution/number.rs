//! Numbers in JSON, which knows neither infinity nor NaN: both are written as null.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes a number, null where it is not finite.
pub(crate) fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    number.is_finite().then_some(*number).serialize(serializer)
}

/// Reads a number, NaN for null.
pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
