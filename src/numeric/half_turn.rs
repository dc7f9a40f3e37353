//! Sine and cosine of angles of at most half a turn, for inner loops of quadratures: no call, no table, no branch.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use core::hint::select_unpredictable;

/// What pi/2 is above f64's nearest value of it.
const FRAC_PI_2_REST: f64 = 6.123_233_995_736_766e-17;

/// (-1)^n/(2n + 1)!: on 0..pi/4 the first term left out is 2^-63 of the sine.
const SINE: [f64; 9] = reciprocal_factorials(1);

/// (-1)^n/(2n)!: the first term left out is 2^-58 of the cosine.
const COSINE: [f64; 9] = reciprocal_factorials(0);

const fn reciprocal_factorials(first: u32) -> [f64; 9] {
    let mut terms = [1.0; 9];
    let mut n = 1;
    while n < 9 {
        let k = (2 * n as u32 + first) as f64;
        // The products stay below 2^53: divided once.
        let mut factorial = 1.0;
        let mut factor = 2.0;
        while factor <= k {
            factorial *= factor;
            factor += 1.0;
        }
        terms[n] = if n % 2 == 0 { 1.0 / factorial } else { -1.0 / factorial };
        n += 1;
    }
    terms
}

/// Sine and cosine of 0 <= `x` <= pi, off by at most 2^-52.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    // The quarter turns nearest by; within a factor of 2 of x, so that the first difference is exact.
    let quarters = f64::from(u8::from(x > FRAC_PI_4)) + f64::from(u8::from(x > 3.0 * FRAC_PI_4));
    let rest = (x - quarters * FRAC_PI_2) - quarters * FRAC_PI_2_REST;
    let square = rest * rest;
    let series = |terms: &[f64; 9]| terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
    // 1 and rest themselves are added last, so that only one rounding counts.
    let sin = rest * series(&SINE);
    let cos = series(&COSINE);
    let swap = quarters == 1.0;
    let sign = 1.0 - 2.0 * f64::from(u8::from(x > FRAC_PI_4));
    (select_unpredictable(swap, cos, sin * sign), select_unpredictable(swap, sin, cos) * sign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    #[test]
    fn agrees_with_the_mathematics_library() {
        let mut worst: f64 = 0.0;
        for k in 0..=200_000 {
            let x = PI * f64::from(k) / 200_000.0;
            let (sin, cos) = sin_cos(x);
            worst = worst.max((sin - libm::sin(x)).abs()).max((cos - libm::cos(x)).abs());
        }
        // The library's own error is 2^-53.
        assert!(worst <= 1.5 * f64::EPSILON, "{worst:e}");
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(PI), (libm::sin(PI), -1.0));
        assert_eq!(sin_cos(FRAC_PI_2).1, FRAC_PI_2_REST);
    }
}
