//! Gauss-Legendre quadrature of fixed order: n points integrate polynomials of degree 2n - 1 exactly.
//!
//! Abscissae in (0, 1) with their weights, 17 digits; the other half of a rule is its mirror image. From the roots of
//! the Legendre polynomials (Abramowitz & Stegun, table 25.4).

/// 4 points. Of a function analytic in the ellipse with foci at the interval's ends and semi-axes' sum rho (in half
/// lengths), the error is about rho^-8.
pub const POINTS_4: [(f64, f64); 2] = [
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];

/// 8 points: about rho^-16.
pub const POINTS_8: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_29),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

/// 16 points: about rho^-32.
pub const POINTS_16: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_59),
    (0.458_016_777_657_227_39, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_893),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

/// 24 points: about rho^-48.
pub const POINTS_24: [(f64, f64); 12] = [
    (0.064_056_892_862_605_63, 0.127_938_195_346_752_16),
    (0.191_118_867_473_616_3, 0.125_837_456_346_828_3),
    (0.315_042_679_696_163_4, 0.121_670_472_927_803_39),
    (0.433_793_507_626_045_1, 0.115_505_668_053_725_6),
    (0.545_421_471_388_839_6, 0.107_444_270_115_965_63),
    (0.648_093_651_936_975_5, 0.097_618_652_104_113_88),
    (0.740_124_191_578_554_4, 0.086_190_161_531_953_27),
    (0.820_001_985_973_903, 0.073_346_481_411_080_3),
    (0.886_415_527_004_401_1, 0.059_298_584_915_436_78),
    (0.938_274_552_002_732_8, 0.044_277_438_817_419_81),
    (0.974_728_555_971_309_5, 0.028_531_388_628_933_663),
    (0.995_187_219_997_021_3, 0.012_341_229_799_987_2),
];

/// Calls `visit(x, weight)` for every point of the rule on `from..to`: the integral of f is the sum of weight f(x).
pub fn visit(half: &[(f64, f64)], from: f64, to: f64, mut visit: impl FnMut(f64, f64)) {
    let (middle, half_length) = (0.5 * (from + to), 0.5 * (to - from));
    for &(abscissa, weight) in half {
        let offset = abscissa * half_length;
        visit(middle - offset, weight * half_length);
        visit(middle + offset, weight * half_length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Degree 2n - 1 is exact, degree 2n is not: a wrong digit anywhere breaks the first.
    #[test]
    fn rules_have_their_degree() {
        for (rule, points) in
            [(&POINTS_4[..], 4), (&POINTS_8[..], 8), (&POINTS_16[..], 16), (&POINTS_24[..], 24)]
        {
            for degree in 0..2 * points {
                let mut sum = 0.0;
                visit(rule, 0.0, 2.0, |x, weight| sum += weight * x.powi(degree));
                let exact = 2f64.powi(degree + 1) / f64::from(degree + 1);
                assert!(
                    (sum / exact - 1.0).abs() < 4e-15,
                    "{points} points, degree {degree}: {sum} for {exact}"
                );
            }
        }
        let mut sum = 0.0;
        visit(&POINTS_8, -1.0, 1.0, |x, weight| sum += weight * x.powi(16));
        assert!((sum - 2.0 / 17.0).abs() > 1e-6);
    }
}
