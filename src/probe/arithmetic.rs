//! Rounding, exactness, fusing, subnormals: each by comparison with the host's own IEEE arithmetic.

use serde::{Deserialize, Serialize};

use super::kernels::{Error, Source, run};
use crate::catalog::Type;
use crate::device::Device;
use crate::numeric::spacing::f32_spacing;
use crate::sample::{Draw, Stream};

/// How results are rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rounding {
    NearestEven,
    TowardZero,
    /// Neither throughout.
    Other,
}

/// How far from correctly rounded a function is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exactness {
    /// Every result of the probe was the f32 nearest to the exact one.
    pub correctly_rounded: bool,
    pub worst_ulp: f64,
    /// Inputs of the worst.
    pub at: [f32; 2],
}

/// Whether a product and a sum are rounded once or twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fusing {
    /// Once, always.
    Fused,
    /// Twice, always.
    Separate,
    /// Neither throughout.
    Other,
}

/// `fma(a, b, c)`, and `a * b + c` where contraction is not forbidden.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fused {
    pub fma: Fusing,
    pub expression: Fusing,
}

/// What is kept of subnormal numbers; what is not becomes zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subnormals {
    pub copied: bool,
    pub sum_operand: bool,
    pub sum_result: bool,
    pub product_operand: bool,
    pub product_result: bool,
    pub quotient_operand: bool,
    pub quotient_result: bool,
    pub sqrt_operand: bool,
}

const ARITHMETIC: Source = Source {
    function: "arithmetic",
    text: include_str!("kernels/arithmetic.comp"),
    inputs: &[("a", Type::Float), ("b", Type::Float)],
    results: &["sum", "difference", "product", "quotient"],
};
const ROOTS: Source = Source {
    function: "roots",
    text: include_str!("kernels/roots.comp"),
    inputs: &[("x", Type::Float)],
    results: &["root", "inverse"],
};
const FUSED: Source = Source {
    function: "fused",
    text: include_str!("kernels/fused.comp"),
    inputs: &[("a", Type::Float), ("b", Type::Float), ("c", Type::Float)],
    results: &["fma", "expression"],
};
const COPY: Source = Source {
    function: "copy",
    text: include_str!("kernels/copy.comp"),
    inputs: &[("x", Type::Float)],
    results: &["same"],
};

/// Samples of each probe: what rounds wrongly once in ten thousand is seen with certainty.
pub const SAMPLES: usize = 1 << 17;

/// A sample of rows; the same every time.
fn sample(name: &str, draw: impl Fn(&mut Draw, &mut Vec<f32>)) -> Vec<f32> {
    let mut rows = Vec::new();
    Stream::new(1, name).visit(0, SAMPLES, |_, source| draw(source, &mut rows));
    rows
}

/// Of either sign, with an exponent of at most `exponent` either way.
fn value(draw: &mut Draw, exponent: f64) -> f32 {
    (draw.sign() * draw.log_uniform(libm::exp2(-exponent), libm::exp2(exponent))) as f32
}

pub(super) struct Roundings {
    pub(super) sum: Rounding,
    pub(super) difference: Rounding,
    pub(super) product: Rounding,
    pub(super) division: Exactness,
}

/// Exponents differ by at most 24, so that sums of two are exact in f64, as their products are.
const EXPONENT: f64 = 12.0;

pub(super) fn roundings<D: Device>(device: &D) -> Result<Roundings, Error> {
    let rows = sample("probe/arithmetic", |draw, rows| {
        rows.extend([value(draw, EXPONENT), value(draw, EXPONENT)]);
    });
    let columns = run(device, &ARITHMETIC, &rows)?;
    let pairs = || rows.chunks_exact(2).map(|row| (f64::from(row[0]), f64::from(row[1])));
    Ok(Roundings {
        sum: rounding(pairs().map(|(a, b)| a + b), &columns[0]),
        difference: rounding(pairs().map(|(a, b)| a - b), &columns[1]),
        product: rounding(pairs().map(|(a, b)| a * b), &columns[2]),
        division: exactness(rows.chunks_exact(2), pairs().map(|(a, b)| a / b), &columns[3]),
    })
}

/// Which rounding of the exact values gives the results.
fn rounding(exact: impl Iterator<Item = f64>, results: &[f32]) -> Rounding {
    let (mut nearest, mut truncated) = (true, true);
    for (exact, result) in exact.zip(results) {
        nearest &= *result == exact as f32;
        truncated &= *result == toward_zero(exact);
    }
    match (nearest, truncated) {
        (true, _) => Rounding::NearestEven,
        (_, true) => Rounding::TowardZero,
        _ => Rounding::Other,
    }
}

fn toward_zero(exact: f64) -> f32 {
    let nearest = exact as f32;
    if f64::from(nearest).abs() <= exact.abs() {
        return nearest;
    }
    if exact > 0.0 { nearest.next_down() } else { nearest.next_up() }
}

/// A quotient or a square root rounded to f64 and then to f32 is the one rounded once: 53 bits are more than twice 24 and
/// two (Figueroa, "When is double rounding innocuous?", 1995). An inverse root in f64 is off by a few parts in 2^53; it
/// counts as correctly rounded if no error exceeds half a unit by more.
fn exactness<'a>(
    rows: impl Iterator<Item = &'a [f32]>,
    exact: impl Iterator<Item = f64>,
    results: &[f32],
) -> Exactness {
    let mut worst = Exactness { correctly_rounded: true, worst_ulp: 0.0, at: [0.0; 2] };
    for ((row, exact), result) in rows.zip(exact).zip(results) {
        let ulp = (f64::from(*result) - exact).abs() / f32_spacing(exact);
        let ulp = if ulp.is_nan() { f64::INFINITY } else { ulp };
        worst.correctly_rounded &= *result == exact as f32 || ulp <= 0.5 + 1e-8;
        if ulp > worst.worst_ulp {
            worst.worst_ulp = ulp;
            worst.at = [row[0], row.get(1).copied().unwrap_or(0.0)];
        }
    }
    worst
}

pub(super) fn roots<D: Device>(device: &D) -> Result<(Exactness, Exactness), Error> {
    let rows = sample("probe/roots", |draw, rows| rows.push(value(draw, 100.0).abs()));
    let columns = run(device, &ROOTS, &rows)?;
    let exact = |function: fn(f64) -> f64| rows.iter().map(move |x| function(f64::from(*x)));
    Ok((
        exactness(rows.chunks_exact(1), exact(f64::sqrt), &columns[0]),
        exactness(rows.chunks_exact(1), exact(|x| 1.0 / x.sqrt()), &columns[1]),
    ))
}

/// The sum cancels the rounded product, so that what is left is its rounding error or zero.
pub(super) fn fused<D: Device>(device: &D) -> Result<Fused, Error> {
    let rows = sample("probe/fused", |draw, rows| {
        let (a, b) = (value(draw, EXPONENT), value(draw, EXPONENT));
        rows.extend([a, b, -(a * b)]);
    });
    let columns = run(device, &FUSED, &rows)?;
    let fusing = |results: &[f32]| {
        let (mut once, mut twice) = (true, true);
        for (row, result) in rows.chunks_exact(3).zip(results) {
            once &= *result == row[0].mul_add(row[1], row[2]);
            twice &= *result == row[0] * row[1] + row[2];
        }
        match (once, twice) {
            (true, _) => Fusing::Fused,
            (_, true) => Fusing::Separate,
            _ => Fusing::Other,
        }
    };
    Ok(Fused { fma: fusing(&columns[0]), expression: fusing(&columns[1]) })
}

pub(super) fn subnormals<D: Device>(device: &D) -> Result<Subnormals, Error> {
    const SUBNORMAL: f32 = f32::MIN_POSITIVE / 4.0;
    const LARGE: f32 = 1.0 / f32::EPSILON;
    let rows = [
        // A subnormal operand and a normal result.
        [SUBNORMAL, f32::MIN_POSITIVE],
        [SUBNORMAL, LARGE],
        [SUBNORMAL, 1.0 / LARGE],
        // Normal operands and a subnormal result.
        [f32::MIN_POSITIVE, -1.5 * f32::MIN_POSITIVE],
        [f32::MIN_POSITIVE, 0.25],
        [f32::MIN_POSITIVE, 4.0],
    ];
    let columns = run(device, &ARITHMETIC, rows.as_flattened())?;
    let [sum, _, product, quotient] = [0, 1, 2, 3].map(|column| &columns[column]);
    Ok(Subnormals {
        copied: run(device, &COPY, &[SUBNORMAL])?[0][0] != 0.0,
        sum_operand: sum[0] != f32::MIN_POSITIVE,
        product_operand: product[1] != 0.0,
        quotient_operand: quotient[2] != 0.0,
        sum_result: sum[3] != 0.0,
        product_result: product[4] != 0.0,
        quotient_result: quotient[5] != 0.0,
        sqrt_operand: run(device, &ROOTS, &[SUBNORMAL])?[0][0] != 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roundings_are_told_apart() {
        let exact = [1.0 + 0.75 * f64::from(f32::EPSILON), -1.0 - 0.75 * f64::from(f32::EPSILON)];
        let up = [1.0 + f32::EPSILON, -1.0 - f32::EPSILON];
        assert_eq!(rounding(exact.into_iter(), &up), Rounding::NearestEven);
        assert_eq!(rounding(exact.into_iter(), &[1.0, -1.0]), Rounding::TowardZero);
        assert_eq!(rounding(exact.into_iter(), &[1.0, up[1]]), Rounding::Other);
        assert_eq!(toward_zero(-0.25), -0.25);
    }

    #[test]
    fn exactness_is_the_worst_distance() {
        let rows = [2f32, 3.0];
        let exact = rows.map(|x| f64::from(x).sqrt());
        let rounded = exact.map(|x| x as f32);
        let exactness = |results: &[f32]| super::exactness(rows.chunks_exact(1), exact.into_iter(), results);
        assert!(exactness(&rounded).correctly_rounded && exactness(&rounded).worst_ulp <= 0.5);
        let off = exactness(&[rounded[0], rounded[1].next_up().next_up()]);
        assert!(
            !off.correctly_rounded && (1.5..=2.5).contains(&off.worst_ulp) && off.at[0] == 3.0,
            "{off:?}"
        );
        assert_eq!(exactness(&[f32::NAN, 1.0]).worst_ulp, f64::INFINITY);
    }
}
