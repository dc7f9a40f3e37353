//! Who is faster, and what the noise leaves open.

use super::bootstrap::Bootstrap;
use super::{Rank, Ratio};

/// What samples say of variants against each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// One a variant, to the reference.
    pub ratios: Vec<Ratio>,
    pub ranks: Vec<Rank>,
    /// The reference's second entry to its first.
    pub control: Ratio,
    /// Ratios this close to 1 are not told apart.
    pub noise: f64,
    pub self_comparisons: usize,
    pub false_positives: usize,
}

/// With fewer pairs of rounds nobody is compared with himself.
const LEAST_PAIRS: usize = 5;

/// Ranks variants by their samples, one a round each. `control` are samples of the reference entered a second time;
/// `alike` says of two variants that their times are not the arithmetic's, so that none of them ranks before the other.
///
/// Two variants are told apart where the 95 % interval of their ratio leaves out 1 and the ratio is farther from 1 than
/// the control's interval reaches.
pub fn standing(
    samples: &[Vec<f64>],
    reference: usize,
    control: &[f64],
    alike: &dyn Fn(usize, usize) -> bool,
) -> Standing {
    let variants = samples.len();
    let bootstrap = Bootstrap::new(control.len());
    let control = bootstrap.ratio(control, &samples[reference]);
    let noise = control.high.max(control.low.recip()) - 1.0;
    let ratios = samples.iter().map(|times| bootstrap.ratio(times, &samples[reference])).collect();

    let mut faster = vec![vec![false; variants]; variants];
    for first in 0..variants {
        for second in first + 1..variants {
            if !alike(first, second) {
                let ratio = bootstrap.ratio(&samples[first], &samples[second]);
                faster[first][second] = differs(&ratio, noise) && ratio.median < 1.0;
                faster[second][first] = differs(&ratio, noise) && ratio.median > 1.0;
            }
        }
    }
    let (mut self_comparisons, mut false_positives) = (0, 0);
    let pairs = samples[reference].len() / 2;
    if pairs >= LEAST_PAIRS {
        let bootstrap = Bootstrap::new(pairs);
        for samples in samples {
            let half = |odd: usize| -> Vec<f64> { samples.chunks_exact(2).map(|pair| pair[odd]).collect() };
            self_comparisons += 1;
            false_positives += usize::from(differs(&bootstrap.ratio(&half(1), &half(0)), noise));
        }
    }
    Standing { ratios, ranks: ranks(faster), control, noise, self_comparisons, false_positives }
}

fn differs(ratio: &Ratio, noise: f64) -> bool {
    let beyond_noise = ratio.median.max(ratio.median.recip()) > 1.0 + noise;
    beyond_noise && (ratio.low > 1.0 || ratio.high < 1.0)
}

/// The places that "certainly faster" leaves open. What is faster than something that is faster is faster too; so two
/// variants that are not told apart always share a place.
fn ranks(mut faster: Vec<Vec<bool>>) -> Vec<Rank> {
    let variants = faster.len();
    // Warshall's closure.
    for through in 0..variants {
        let beyond = faster[through].clone();
        for row in &mut faster {
            if row[through] {
                for (faster, beyond) in row.iter_mut().zip(&beyond) {
                    *faster |= beyond;
                }
            }
        }
    }
    (0..variants)
        .map(|variant| {
            // In a circle, which noise may make, nobody is faster.
            let certainly = |a: usize, b: usize| faster[a][b] && !faster[b][a];
            let before = (0..variants).filter(|other| certainly(*other, variant)).count();
            let after = (0..variants).filter(|other| certainly(variant, *other)).count();
            Rank { first: 1 + before, last: variants - after }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::noise::Noise;

    fn samples(noise: &mut Noise, centres: &[f64], sigma: f64, rounds: usize) -> Vec<Vec<f64>> {
        centres.iter().map(|centre| (0..rounds).map(|_| noise.around(*centre, sigma)).collect()).collect()
    }

    const ALL_COUNT: &dyn Fn(usize, usize) -> bool = &|_, _| false;

    #[test]
    fn what_differs_is_ranked_and_what_does_not_shares_a_place() {
        let mut noise = Noise::new(1);
        let samples = samples(&mut noise, &[20.0, 10.0, 10.0, 40.0], 0.02, 40);
        let control: Vec<f64> = (0..40).map(|_| noise.around(10.0, 0.02)).collect();
        let standing = standing(&samples, 1, &control, ALL_COUNT);
        let places: Vec<_> = standing.ranks.iter().map(|rank| (rank.first, rank.last)).collect();
        assert_eq!(places, [(3, 3), (1, 2), (1, 2), (4, 4)]);
        assert_eq!(standing.ratios[1].median, 1.0);
        assert!((standing.ratios[3].median - 4.0).abs() < 0.1);
        assert!(standing.noise < 0.05 && standing.self_comparisons == 4);
    }

    #[test]
    fn what_is_not_arithmetic_is_not_ranked() {
        let mut noise = Noise::new(2);
        let samples = samples(&mut noise, &[10.0, 12.0, 30.0], 0.01, 30);
        let control: Vec<f64> = (0..30).map(|_| noise.around(10.0, 0.01)).collect();
        let standing = standing(&samples, 0, &control, &|a, b| a < 2 && b < 2);
        let places: Vec<_> = standing.ranks.iter().map(|rank| (rank.first, rank.last)).collect();
        assert_eq!(places, [(1, 2), (1, 2), (3, 3)]);
    }

    /// Where the same variant entered twice differs by 10 %, nothing closer than that is told apart.
    #[test]
    fn the_control_is_believed() {
        let mut noise = Noise::new(3);
        let samples = samples(&mut noise, &[10.0, 10.7, 30.0], 0.01, 40);
        let control: Vec<f64> = (0..40).map(|_| noise.around(11.0, 0.01)).collect();
        let standing = standing(&samples, 0, &control, ALL_COUNT);
        assert!(standing.noise > 0.09);
        let places: Vec<_> = standing.ranks.iter().map(|rank| (rank.first, rank.last)).collect();
        assert_eq!(places, [(1, 2), (1, 2), (3, 3)]);
    }

    /// Identical variants: told apart in fewer than one pair of twenty, the noise of the control coming on top of the
    /// interval's 95 %.
    #[test]
    fn identical_variants_are_rarely_told_apart() {
        let mut noise = Noise::new(4);
        let (mut told_apart, mut pairs, mut false_positives, mut self_comparisons) = (0, 0, 0, 0);
        for _ in 0..40 {
            let samples = samples(&mut noise, &[10.0; 6], 0.05, 21);
            let control: Vec<f64> = (0..21).map(|_| noise.around(10.0, 0.05)).collect();
            let standing = standing(&samples, 0, &control, ALL_COUNT);
            for first in 0..6 {
                for second in first + 1..6 {
                    pairs += 1;
                    let (a, b) = (standing.ranks[first], standing.ranks[second]);
                    told_apart += usize::from(a.last < b.first || b.last < a.first);
                }
            }
            false_positives += standing.false_positives;
            self_comparisons += standing.self_comparisons;
        }
        assert!(told_apart * 20 < pairs, "{told_apart} of {pairs}");
        // Halves have half the rounds, for which the bootstrap is too sure of itself: one in ten at most.
        assert!(false_positives * 10 < self_comparisons, "{false_positives} of {self_comparisons}");
    }

    #[test]
    fn places_follow_from_who_is_faster() {
        let order = |faster: &[(usize, usize)]| {
            let mut matrix = vec![vec![false; 3]; 3];
            for (a, b) in faster {
                matrix[*a][*b] = true;
            }
            ranks(matrix).iter().map(|rank| (rank.first, rank.last)).collect::<Vec<_>>()
        };
        assert_eq!(order(&[]), [(1, 3); 3]);
        assert_eq!(order(&[(0, 2)]), [(1, 2), (1, 3), (2, 3)]);
        assert_eq!(order(&[(0, 1), (1, 2)]), [(1, 1), (2, 2), (3, 3)]);
        assert_eq!(order(&[(0, 1), (1, 2), (2, 0)]), [(1, 3); 3]);
    }
}
