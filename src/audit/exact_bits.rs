//! Floating-point numbers as the integers of their bits, for a journal that must read back what it wrote: JSON has no
//! infinities, and its decimals need not round-trip.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What has an exact form in integers.
pub(super) trait Bits: Sized {
    type Words: Serialize + DeserializeOwned;
    fn words(&self) -> Self::Words;
    fn of(words: Self::Words) -> Self;
}

impl Bits for f64 {
    type Words = u64;
    fn words(&self) -> u64 {
        self.to_bits()
    }
    fn of(words: u64) -> Self {
        f64::from_bits(words)
    }
}

impl Bits for f32 {
    type Words = u32;
    fn words(&self) -> u32 {
        self.to_bits()
    }
    fn of(words: u32) -> Self {
        f32::from_bits(words)
    }
}

impl<T: Bits> Bits for Vec<T> {
    type Words = Vec<T::Words>;
    fn words(&self) -> Self::Words {
        self.iter().map(T::words).collect()
    }
    fn of(words: Self::Words) -> Self {
        words.into_iter().map(T::of).collect()
    }
}

/// An error and the configuration that has it.
impl Bits for Option<(f64, u64)> {
    type Words = Option<(u64, u64)>;
    fn words(&self) -> Self::Words {
        self.map(|(error, index)| (error.to_bits(), index))
    }
    fn of(words: Self::Words) -> Self {
        words.map(|(error, index)| (f64::from_bits(error), index))
    }
}

pub(super) fn serialize<T: Bits, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.words().serialize(serializer)
}

pub(super) fn deserialize<'de, T: Bits, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::Words::deserialize(deserializer).map(T::of)
}
