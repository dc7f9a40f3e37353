//! Where to look next: many evolution strategies at once over the unit cube, and random points between them.
//!
//! Covariance matrix adaptation (CMA-ES: Hansen and Ostermeier, Evolutionary Computation 9, 2001) follows a narrow curved
//! valley of the error without derivatives, but stays where it began. So several run side by side, each from one of the
//! worst points of a random sample, from anywhere, or closely about the worst point known; one that gets no further ends
//! and another begins. A part of every batch stays random: choices among kinds, drawn as whole words, make the error
//! jump, and no strategy crosses a jump but by luck.

use fcmaes_core::{Cmaes, CmaesParams, Fitness};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

/// Strategies side by side.
const ISLANDS: usize = 8;
/// Points a generation of each; several times what a smooth error needs, for rough ones.
const POPULATION: usize = 96;
/// Random points a batch.
const SCOUTS: usize = 256;
/// Points a batch.
pub(super) const BATCH: usize = ISLANDS * POPULATION + SCOUTS;

/// Random points kept to start from.
const POOL: usize = 64;
/// Generations without progress after which a strategy ends.
const PATIENCE: u32 = 25;
/// What is progress, in octaves of the size.
const PROGRESS: f64 = 0.01;

/// A point of the unit cube and how bad it is.
#[derive(Clone, Debug)]
struct Rated {
    size: f64,
    point: Vec<f64>,
}

/// One strategy and how it is doing.
struct Island {
    strategy: Cmaes,
    /// Least cost so far.
    best: f64,
    idle: u32,
}

/// A search for the point of largest size. Sizes are at least 0; an infinite one is as large as any, so no place to look
/// on for a larger one.
pub(super) struct Search {
    dimensions: usize,
    generator: ChaCha8Rng,
    /// None before the first batch, which is random.
    islands: Vec<Island>,
    scouts: Vec<Vec<f64>>,
    /// Worst random points that nothing has started from, the worst first.
    pool: Vec<Rated>,
    worst: Option<Rated>,
    starts: u64,
    asked: Vec<Vec<f64>>,
}

impl Search {
    pub(super) fn new(dimensions: usize, seed: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        // Apart from every stream of configurations.
        generator.set_stream(u64::MAX);
        Search {
            dimensions,
            generator,
            islands: Vec::new(),
            scouts: Vec::new(),
            pool: Vec::new(),
            worst: None,
            starts: 0,
            asked: Vec::new(),
        }
    }

    /// The next batch: points whose coordinates are in 0..=1.
    pub(super) fn ask(&mut self) -> &[Vec<f64>] {
        let scouts = if self.islands.is_empty() { BATCH } else { SCOUTS };
        self.scouts = (0..scouts).map(|_| self.random()).collect();
        let asked: Vec<Vec<Vec<f64>>> =
            self.islands.par_iter_mut().map(|island| island.strategy.ask()).collect();
        self.asked = asked.into_iter().flatten().chain(self.scouts.iter().cloned()).collect();
        &self.asked
    }

    /// The sizes of the batch asked for, in its order.
    pub(super) fn tell(&mut self, sizes: &[f64]) {
        for (point, size) in self.asked.iter().zip(sizes) {
            let worst = self.worst.as_ref().map_or(f64::NEG_INFINITY, |worst| worst.size);
            if size.is_finite() && *size > worst {
                self.worst = Some(Rated { size: *size, point: point.clone() });
            }
        }
        let (of_islands, of_scouts) = sizes.split_at(self.islands.len() * POPULATION);
        for (point, size) in self.scouts.drain(..).zip(of_scouts) {
            if size.is_finite() {
                self.pool.push(Rated { size: *size, point });
            }
        }
        self.pool.sort_by(|one, other| other.size.total_cmp(&one.size));
        self.pool.truncate(POOL);
        let generations = of_islands.par_chunks_exact(POPULATION);
        self.islands.par_iter_mut().zip(generations).for_each(|(island, sizes)| island.tell(sizes));
        for at in 0..ISLANDS {
            match self.islands.get(at) {
                Some(island) if !island.is_done() => {}
                Some(_) => self.islands[at] = self.start(),
                None => {
                    let island = self.start();
                    self.islands.push(island);
                }
            }
        }
    }

    /// A strategy about one of the worst random points (two in four), anywhere, or closely about the worst point known.
    fn start(&mut self) -> Island {
        let turn = self.starts;
        self.starts += 1;
        let (centre, width) = match turn % 4 {
            1 => (None, 0.3),
            2 => (self.worst.as_ref().map(|rated| rated.point.clone()), 0.01),
            even => {
                let next = (!self.pool.is_empty()).then(|| self.pool.remove(0).point);
                (next, if even == 0 { 0.1 } else { 0.03 })
            }
        };
        let centre = centre.unwrap_or_else(|| self.random());
        let bounds =
            Fitness::bounded(self.dimensions, 1, &vec![0.0; self.dimensions], &vec![1.0; self.dimensions]);
        let parameters = CmaesParams {
            popsize: POPULATION as i32,
            seed: self.generator.next_u64(),
            ..CmaesParams::default()
        };
        Island { strategy: Cmaes::new(bounds, &centre, &[width], &parameters), best: f64::MAX, idle: 0 }
    }

    /// Uniform in the cube.
    fn random(&mut self) -> Vec<f64> {
        let coordinate = |_| (f64::from(self.generator.next_u32()) + 0.5) / 4_294_967_296.0;
        (0..self.dimensions).map(coordinate).collect()
    }
}

impl Island {
    fn tell(&mut self, sizes: &[f64]) {
        // The strategy compares costs only, but for its tolerances: those become relative to the size.
        let cost = |size: &f64| if size.is_finite() { -size.max(1e-30).log2() } else { 1e3 };
        let costs: Vec<f64> = sizes.iter().map(cost).collect();
        let best = costs.iter().copied().fold(f64::MAX, f64::min);
        self.idle = if best < self.best - PROGRESS { 0 } else { self.idle + 1 };
        self.best = self.best.min(best);
        self.strategy.tell(&costs);
    }

    fn is_done(&self) -> bool {
        self.strategy.stop() != 0 || self.idle >= PATIENCE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest size after `batches`, and whether every point was in the cube.
    fn climb(dimensions: usize, seed: u64, batches: usize, size: impl Fn(&[f64]) -> f64) -> (f64, Vec<f64>) {
        let mut search = Search::new(dimensions, seed);
        let mut best = (0.0, Vec::new());
        for _ in 0..batches {
            let points = search.ask();
            assert_eq!(points.len(), BATCH);
            assert!(points.iter().flatten().all(|coordinate| (0.0..=1.0).contains(coordinate)));
            let sizes: Vec<f64> = points.iter().map(|point| size(point)).collect();
            for (point, size) in points.iter().zip(&sizes) {
                if size.is_finite() && *size > best.0 {
                    best = (*size, point.clone());
                }
            }
            search.tell(&sizes);
        }
        best
    }

    /// The same number of random points.
    fn sample(dimensions: usize, seed: u64, batches: usize, size: impl Fn(&[f64]) -> f64) -> f64 {
        let mut search = Search::new(dimensions, seed);
        (0..batches * BATCH).map(|_| size(&search.random())).fold(0.0, f64::max)
    }

    /// A curved ridge that narrows towards its top, on one of four plateaus: the lowest a random point finds at once.
    fn ridge(point: &[f64]) -> f64 {
        let kind = [0.1, 1.0, 0.3, 0.2][(4.0 * point[0]).min(3.0) as usize];
        let along = point[1];
        let off: f64 = point[2..].iter().map(|x| (x - 0.5 - 0.3 * (along - 0.5).powi(2)).powi(2)).sum();
        kind / (1e-9 + off + 0.01 * (along - 0.7).powi(2))
    }

    #[test]
    fn finds_what_random_points_do_not() {
        let batches = 100;
        for seed in 1..=3 {
            let (found, random) = (climb(6, seed, batches, ridge).0, sample(6, seed, batches, ridge));
            // The top is 1e9 high and as wide as one random point in 1e18 would hit.
            assert!(found > 1e8 && random < 1e5, "seed {seed}: {found:e} against {random:e}");
        }
    }

    #[test]
    fn the_same_seed_finds_the_same() {
        assert_eq!(climb(4, 5, 30, ridge), climb(4, 5, 30, ridge));
        assert_ne!(climb(4, 5, 3, ridge).1, climb(4, 6, 3, ridge).1);
    }

    #[test]
    fn infinite_sizes_and_flat_ground_do_not_stop_it() {
        // Infinite in a corner, flat in half of the cube, and a slope between them.
        let size = |point: &[f64]| match point[0] {
            x if x > 0.9 => f64::INFINITY,
            x if x < 0.5 => 0.0,
            x => 1.0 / (0.9 - x + 1e-6) - point[1],
        };
        let (found, _) = climb(2, 1, 60, size);
        assert!(found > 9e5, "{found}");
        assert_eq!(climb(3, 1, 60, |_| 0.0).0, 0.0);
        assert_eq!(climb(1, 1, 60, |_| f64::INFINITY).0, 0.0);
    }
}
