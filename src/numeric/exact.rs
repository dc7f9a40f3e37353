//! Sums of f64 whose rounding error does not depend on cancellation.

/// The sum of `terms`, rounded once: relative error at most 2^-53 however much cancels.
///
/// Shewchuk's growing expansion of non-overlapping partial sums (Discrete Comput. Geom. 18, 1997), with the final
/// rounding corrected for ties. At most 64 terms; they and their sums must stay finite.
pub fn sum(terms: &[f64]) -> f64 {
    compensated(terms).unwrap_or_else(|| remainder(terms))
}

/// The same of terms that cancel, for which there is no shorter way.
pub fn remainder(terms: &[f64]) -> f64 {
    // Most sums are short.
    if terms.len() <= 24 { sum_in(&mut [0.0; 24], terms) } else { sum_in(&mut [0.0; MOST], terms) }
}

/// The sum with what that rounding left, rounded: relative error at most 2^-106. At most 63 terms.
pub fn pair(terms: &[f64]) -> (f64, f64) {
    let high = sum(terms);
    let mut rest = [0.0; MOST];
    rest[..terms.len()].copy_from_slice(terms);
    rest[terms.len()] = -high;
    (high, remainder(&rest[..=terms.len()]))
}

/// The most terms that there may be: there are no more partial sums than terms.
const MOST: usize = 64;

/// The sum in two parts, where what it may be off by does not matter: most sums cancel little.
///
/// What n steps round away is at most n 2^-53 of all terms' size, and its own sum off by as much of that.
fn compensated(terms: &[f64]) -> Option<f64> {
    let (sum, rest, size) = parts(terms);
    let (high, low) = two_sum(sum, rest);
    let off = OFF * size;
    (high + (low + off) == high + (low - off)).then_some(high)
}

/// The sum as it rounds, the sum of what its roundings lose, and that of all absolute values.
#[inline]
pub fn parts(terms: &[f64]) -> (f64, f64, f64) {
    let (mut sum, mut rest, mut size) = (0.0, 0.0, 0.0);
    for &term in terms {
        let (next, lost) = two_sum(sum, term);
        (sum, rest, size) = (next, rest + lost, size + term.abs());
    }
    (sum, rest, size)
}

/// Twice 64^2 2^-106, for the roundings of the bound and of what it is compared with.
const OFF: f64 = 1.0 / (1u128 << 93) as f64;

#[inline]
fn sum_in(partials: &mut [f64], terms: &[f64]) -> f64 {
    let mut used = 0;
    for &term in terms {
        let mut carried = term;
        let mut kept = 0;
        for position in 0..used {
            let (high, low) = two_sum(carried, partials[position]);
            if low != 0.0 {
                partials[kept] = low;
                kept += 1;
            }
            carried = high;
        }
        partials[kept] = carried;
        used = kept + 1;
    }
    let Some((&last, rest)) = partials[..used].split_last() else {
        return 0.0;
    };
    let mut total = last;
    let mut below = rest.iter().rev();
    for &next in below.by_ref() {
        let (high, low) = two_sum(total, next);
        total = high;
        if low != 0.0 {
            // Half-way cases round by the sign of what lies below.
            if let Some(&further) = below.next()
                && (low < 0.0) == (further < 0.0)
            {
                let (twice, candidate) = (2.0 * low, total + 2.0 * low);
                if candidate - total == twice {
                    total = candidate;
                }
            }
            break;
        }
    }
    total
}

/// a + b as an exact pair: the rounded sum and its rounding error (Knuth).
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn cancellation_costs_nothing() {
        assert_eq!(sum(&[1e100, 1.0, -1e100, 1e-100]), 1.0);
        assert_eq!(sum(&[1.0, 2f64.powi(-120), -1.0]), 2f64.powi(-120));
        assert_eq!(sum(&[]), 0.0);
    }

    /// As many partial sums as terms, which do not overlap.
    #[test]
    fn no_exponents_are_too_many() {
        let powers = (0..32).map(|k| libm::ldexp(1.0, 60 * k - 1000));
        let terms: Vec<f64> = powers.clone().chain(powers.skip(1).map(|power| -power)).collect();
        assert_eq!(sum(&terms), libm::ldexp(1.0, -1000));
    }

    #[test]
    fn a_tie_rounds_by_what_lies_below() {
        let half_ulp = f64::EPSILON / 2.0;
        assert_eq!(sum(&[1.0, half_ulp, 1e-30]), 1.0 + f64::EPSILON);
        assert_eq!(sum(&[1.0, half_ulp, -1e-30]), 1.0);
    }

    proptest! {
        /// The integers of a common scale are the independent arithmetic here.
        #[test]
        fn agrees_with_integers(terms in prop::collection::vec((-(1i64 << 52)..(1i64 << 52), 0u32..50), 1..12)) {
            let exact: i128 = terms.iter().map(|(mantissa, shift)| i128::from(*mantissa) << shift).sum();
            let floats: Vec<f64> =
                terms.iter().map(|(mantissa, shift)| *mantissa as f64 * 2f64.powi(*shift as i32)).collect();
            prop_assert_eq!(sum(&floats), exact as f64);
        }
    }
}
