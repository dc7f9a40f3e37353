//! Synthetic times for tests: seeded, with the skew that times have.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

pub(super) struct Noise(ChaCha8Rng);

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        Noise(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Uniform in (0, 1).
    fn unit(&mut self) -> f64 {
        (f64::from(self.0.next_u32()) + 0.5) / 4_294_967_296.0
    }

    /// `centre` times a log-normal factor, and one time in twenty an interruption on top.
    pub(super) fn around(&mut self, centre: f64, sigma: f64) -> f64 {
        // Box and Muller's transform.
        let normal = (-2.0 * self.unit().ln()).sqrt() * (std::f64::consts::TAU * self.unit()).cos();
        let interruption = if self.unit() < 0.05 { 1.0 + self.unit() } else { 1.0 };
        centre * (sigma * normal).exp() * interruption
    }
}
