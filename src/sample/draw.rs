//! Counter-based random draws: configuration `index` of a scenario is a pure function of (seed, stream, index).
//!
//! The generator is ChaCha8 with one stream a scenario; configuration `i` owns the words
//! `i * WORDS .. (i + 1) * WORDS` of it, so any range of configurations can be drawn on its own, in any order, on any
//! number of threads. Transcendental functions come from the `libm` crate, so that draws are the same bits on every
//! platform.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// 32-bit words that one configuration may use; more is a bug in its scenario.
pub const WORDS: usize = 48;

/// The random stream of one scenario.
#[derive(Clone, Debug)]
pub struct Stream {
    generator: ChaCha8Rng,
}

impl Stream {
    /// The stream `name` (by convention `family/scenario`) under `seed`.
    pub fn new(seed: u64, name: &str) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(fnv1a(name.as_bytes()));
        Stream { generator }
    }

    /// Calls `visit` with the draws of `count` configurations from `first` on.
    pub fn visit(&self, first: u64, count: usize, mut visit: impl FnMut(usize, &mut Draw)) {
        let mut generator = self.generator.clone();
        generator.set_word_pos(u128::from(first) * WORDS as u128);
        let mut bytes = [0u8; 4 * WORDS];
        for row in 0..count {
            generator.fill_bytes(&mut bytes);
            visit(row, &mut Draw::of_words(&words(&bytes)));
        }
    }
}

fn words(bytes: &[u8; 4 * WORDS]) -> [u32; WORDS] {
    std::array::from_fn(|at| {
        let word = &bytes[4 * at..];
        u32::from_le_bytes([word[0], word[1], word[2], word[3]])
    })
}

/// The draws of one configuration.
#[derive(Debug)]
pub struct Draw<'a> {
    words: &'a [u32; WORDS],
    used: usize,
}

impl<'a> Draw<'a> {
    /// The draws that these words make: a configuration is a function of its words, whoever chose them.
    pub fn of_words(words: &'a [u32; WORDS]) -> Self {
        Draw { words, used: 0 }
    }

    /// How many words have been drawn so far.
    pub fn used(&self) -> usize {
        self.used
    }

    /// 32 random bits.
    ///
    /// # Panics
    /// When the scenario draws more than [`WORDS`] words.
    pub fn word(&mut self) -> u32 {
        let word = self.words[self.used];
        self.used += 1;
        word
    }

    /// Uniform in the open interval (0, 1), in steps of 2^-32.
    pub fn unit(&mut self) -> f64 {
        (f64::from(self.word()) + 0.5) / 4_294_967_296.0
    }

    /// Uniform in (`low`, `high`).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Log-uniform in (`low`, `high`), both positive.
    pub fn log_uniform(&mut self, low: f64, high: f64) -> f64 {
        libm::exp2(self.uniform(libm::log2(low), libm::log2(high)))
    }

    /// Uniform in `0..n`.
    pub fn below(&mut self, n: u32) -> u32 {
        ((u64::from(self.word()) * u64::from(n)) >> 32) as u32
    }

    /// One of the items, all equally likely.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[self.below(items.len() as u32) as usize]
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f64 {
        if self.word() & 1 == 0 { -1.0 } else { 1.0 }
    }

    /// Uniform angle in (0, 2 pi), as (cosine, sine).
    pub fn angle(&mut self) -> (f64, f64) {
        let (sin, cos) = libm::sincos(self.uniform(0.0, core::f64::consts::TAU));
        (cos, sin)
    }

    /// Uniform direction on the unit sphere.
    pub fn direction(&mut self) -> glam::DVec3 {
        let z = self.uniform(-1.0, 1.0);
        let (cos, sin) = self.angle();
        let r = libm::sqrt(1.0 - z * z);
        glam::DVec3::new(r * cos, r * sin, z)
    }

    /// Uniform right-handed orthonormal frame.
    pub fn frame(&mut self) -> glam::DMat3 {
        let z = self.direction();
        let (cos, sin) = self.angle();
        let x = z.any_orthonormal_vector();
        let y = z.cross(x);
        glam::DMat3::from_cols(cos * x + sin * y, cos * y - sin * x, z)
    }
}

/// FNV-1a, 64 bits: a stable name for a stream, nothing more is asked of it.
fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first_words(seed: u64, name: &str, first: u64, count: usize) -> Vec<u32> {
        let mut words = Vec::new();
        Stream::new(seed, name).visit(first, count, |_, draw| words.push(draw.word()));
        words
    }

    #[test]
    fn a_range_is_the_same_drawn_whole_or_in_parts() {
        let whole = first_words(7, "a/b", 0, 100);
        let mut parts = first_words(7, "a/b", 0, 33);
        parts.extend(first_words(7, "a/b", 33, 67));
        assert_eq!(whole, parts);
    }

    #[test]
    fn seeds_and_streams_differ() {
        assert_ne!(first_words(7, "a/b", 0, 8), first_words(8, "a/b", 0, 8));
        assert_ne!(first_words(7, "a/b", 0, 8), first_words(7, "a/c", 0, 8));
    }

    #[test]
    fn words_given_are_words_drawn() {
        let words: [u32; WORDS] = std::array::from_fn(|at| 3 + at as u32);
        let mut draw = Draw::of_words(&words);
        assert_eq!((draw.word(), draw.unit(), draw.used()), (3, 4.5 / 4_294_967_296.0, 2));
    }

    #[test]
    fn frames_are_rotations() {
        Stream::new(1, "frames").visit(0, 1000, |_, draw| {
            let frame = draw.frame();
            assert!((frame.determinant() - 1.0).abs() < 1e-14);
            assert!((frame.transpose() * frame).abs_diff_eq(glam::DMat3::IDENTITY, 1e-14));
        });
    }

    #[test]
    fn log_uniform_fills_its_decades_evenly() {
        let mut decades = [0u32; 6];
        Stream::new(1, "decades").visit(0, 60_000, |_, draw| {
            decades[draw.log_uniform(1.0, 1e6).log10() as usize] += 1;
        });
        // Binomial with n = 60 000, p = 1/6: sigma = 91; five sigma either side.
        assert!(decades.iter().all(|count| count.abs_diff(10_000) < 456), "{decades:?}");
    }
}
