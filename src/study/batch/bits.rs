//! Numbers as their bits: JSON keeps neither infinity nor NaN.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Something made of numbers.
pub(super) trait Bits: Sized {
    /// The same made of their bits.
    type Wire: Serialize + for<'de> Deserialize<'de>;

    fn to_wire(&self) -> Self::Wire;
    fn from_wire(wire: Self::Wire) -> Self;
}

impl Bits for f64 {
    type Wire = u64;

    fn to_wire(&self) -> u64 {
        self.to_bits()
    }

    fn from_wire(wire: u64) -> Self {
        Self::from_bits(wire)
    }
}

impl<T: Bits> Bits for Option<T> {
    type Wire = Option<T::Wire>;

    fn to_wire(&self) -> Self::Wire {
        self.as_ref().map(T::to_wire)
    }

    fn from_wire(wire: Self::Wire) -> Self {
        wire.map(T::from_wire)
    }
}

impl<T: Bits> Bits for Vec<T> {
    type Wire = Vec<T::Wire>;

    fn to_wire(&self) -> Self::Wire {
        self.iter().map(T::to_wire).collect()
    }

    fn from_wire(wire: Self::Wire) -> Self {
        wire.into_iter().map(T::from_wire).collect()
    }
}

pub(super) fn serialize<T: Bits, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
    value.to_wire().serialize(to)
}

pub(super) fn deserialize<'de, T: Bits, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    T::Wire::deserialize(from).map(T::from_wire)
}
