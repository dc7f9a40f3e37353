//! The bits of millions of results in a kilobyte: enough to say whether two devices agree to the last bit, and if not,
//! on about how many configurations they differ.
//!
//! Nested samples of the configurations (all, one in 8, one in 64 ...) are spread over cells, each the sum of its rows'
//! hashes. Where few cells of a level differ, their number estimates the number of differing rows (the strata estimator
//! of Eppstein, Goodrich, Uyeda and Varghese, SIGCOMM 2011, with linear counting in place of invertible cells). Sums
//! merge by addition, so neither threads nor chunks show.

use serde::{Deserialize, Serialize};

/// One level holds every configuration whose hash ends in so many zero bits more than the level's below.
const LEVEL_BITS: u32 = 3;
const LEVELS: usize = 8;
/// Cells a level.
const CELLS: usize = 64;

/// What was left of a set of rows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "Vec<u8>", try_from = "Vec<u8>")]
pub struct Fingerprint {
    total: u64,
    cells: Box<[u16; LEVELS * CELLS]>,
}

impl Default for Fingerprint {
    fn default() -> Self {
        Fingerprint { total: 0, cells: Box::new([0; LEVELS * CELLS]) }
    }
}

impl Fingerprint {
    /// Bytes of [`bytes`](Self::bytes).
    pub const BYTES: usize = 8 + 2 * LEVELS * CELLS;

    /// Adds a row, each index once.
    pub fn add(&mut self, index: u64, row: &[f32]) {
        let place = mix(index);
        let hash = row_hash(index, row);
        self.total = self.total.wrapping_add(hash);
        let cell = (place >> 32) as usize % CELLS;
        let deepest = (place.trailing_zeros() / LEVEL_BITS).min(LEVELS as u32 - 1) as usize;
        for level in 0..=deepest {
            let slot = &mut self.cells[level * CELLS + cell];
            *slot = slot.wrapping_add((hash >> 48) as u16);
        }
    }

    /// Adds the rows of another part.
    pub fn merge(&mut self, other: &Fingerprint) {
        self.total = self.total.wrapping_add(other.total);
        for (mine, theirs) in self.cells.iter_mut().zip(other.cells.iter()) {
            *mine = mine.wrapping_add(*theirs);
        }
    }

    /// About how many rows differ between two fingerprints of the same indices: exactly 0.0 if none does (but for a
    /// chance of 2^-64), otherwise at least 1, with a standard error of about a fifth where many do.
    pub fn difference(&self, other: &Fingerprint) -> f64 {
        if self == other {
            return 0.0;
        }
        /// Beyond this load linear counting loses its precision; the next level has an eighth of it.
        const FULL: usize = CELLS * 3 / 4;
        let differing = |level: usize| {
            let cells = level * CELLS..(level + 1) * CELLS;
            cells.filter(|cell| self.cells[*cell] != other.cells[*cell]).count()
        };
        let level = (0..LEVELS).find(|level| differing(*level) <= FULL).unwrap_or(LEVELS - 1);
        let share = differing(level).min(CELLS - 1) as f64 / CELLS as f64;
        let rows = -(CELLS as f64) * f64::ln_1p(-share);
        (rows * f64::from(1u32 << (LEVEL_BITS * level as u32))).max(1.0)
    }

    /// The sums, little endian: the total, then the cells.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.total.to_le_bytes().to_vec();
        bytes.extend(self.cells.iter().flat_map(|cell| cell.to_le_bytes()));
        bytes
    }

    /// The reverse of [`bytes`](Self::bytes); `None` if their number is not [`BYTES`](Self::BYTES).
    pub fn from_bytes(bytes: &[u8]) -> Option<Fingerprint> {
        let (total, cells) = bytes.split_first_chunk::<8>()?;
        let mut fingerprint = Fingerprint { total: u64::from_le_bytes(*total), ..Fingerprint::default() };
        let (pairs, rest) = cells.as_chunks::<2>();
        if pairs.len() != LEVELS * CELLS || !rest.is_empty() {
            return None;
        }
        for (cell, pair) in fingerprint.cells.iter_mut().zip(pairs) {
            *cell = u16::from_le_bytes(*pair);
        }
        Some(fingerprint)
    }
}

impl From<Fingerprint> for Vec<u8> {
    fn from(fingerprint: Fingerprint) -> Self {
        fingerprint.bytes()
    }
}

impl TryFrom<Vec<u8>> for Fingerprint {
    type Error = String;

    fn try_from(bytes: Vec<u8>) -> Result<Self, String> {
        Fingerprint::from_bytes(&bytes).ok_or_else(|| format!("{} bytes are no fingerprint", bytes.len()))
    }
}

/// A hash of a row's place and bits. All NaN are one: their bits are nobody's promise.
pub(super) fn row_hash(index: u64, row: &[f32]) -> u64 {
    row.iter().fold(mix(index), |hash, value| {
        let bits = if value.is_nan() { 0x7fc0_0000 } else { value.to_bits() };
        mix(hash ^ u64::from(bits))
    })
}

/// The finaliser of SplitMix64, a bijection of 64 bits.
pub(super) fn mix(index: u64) -> u64 {
    let mut z = index.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows 0..`rows`; every `every`-th has another last bit.
    fn fingerprint(rows: u64, every: Option<u64>) -> Fingerprint {
        let mut fingerprint = Fingerprint::default();
        for index in 0..rows {
            let value = f32::from_bits(0x3f80_0000 + (index % 1000) as u32);
            let turned = every.is_some_and(|every| index % every == 0);
            let second = if turned { f32::from_bits(value.to_bits() ^ 1) } else { value };
            fingerprint.add(index, &[value, second]);
        }
        fingerprint
    }

    #[test]
    fn equal_bits_have_no_difference_and_one_bit_shows() {
        let all = fingerprint(100_000, None);
        assert_eq!(all.difference(&fingerprint(100_000, None)), 0.0);
        let one = fingerprint(100_000, Some(100_000));
        assert_eq!(all.difference(&one).round(), 1.0);
    }

    #[test]
    fn zeros_of_different_sign_differ_and_nans_do_not() {
        let of = |value: f32| {
            let mut fingerprint = Fingerprint::default();
            fingerprint.add(7, &[value]);
            fingerprint
        };
        assert!(of(0.0).difference(&of(-0.0)) > 0.0);
        assert_eq!(of(f32::NAN).difference(&of(-f32::NAN)), 0.0);
    }

    /// Linear counting of 64 cells up to a load of 3/4 has a standard error below a quarter of what is counted where at
    /// least 8 cells differ; three of them are allowed.
    #[test]
    fn estimates_are_of_the_right_size() {
        let all = fingerprint(300_000, None);
        for every in [1, 2, 10, 100, 1000, 10_000] {
            let truth = (300_000 / every) as f64;
            let estimate = all.difference(&fingerprint(300_000, Some(every)));
            assert!((estimate / truth).ln().abs() < 0.75, "{every}: {estimate} of {truth}");
        }
    }

    #[test]
    fn parts_add_up_and_bytes_read_back() {
        let whole = fingerprint(10_000, Some(7));
        let (mut first, mut second) = (Fingerprint::default(), Fingerprint::default());
        for index in 0..10_000u64 {
            let part = if index % 3 == 0 { &mut first } else { &mut second };
            let value = f32::from_bits(0x3f80_0000 + (index % 1000) as u32);
            let turned = if index % 7 == 0 { f32::from_bits(value.to_bits() ^ 1) } else { value };
            part.add(index, &[value, turned]);
        }
        second.merge(&first);
        assert_eq!(second, whole);
        assert_eq!(whole.bytes().len(), Fingerprint::BYTES);
        assert_eq!(Fingerprint::from_bytes(&whole.bytes()), Some(whole));
        assert_eq!(Fingerprint::from_bytes(&[0; 8]), None);
    }
}
