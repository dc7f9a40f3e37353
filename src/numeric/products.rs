//! Cross products, determinants and cofactors of f32 data, without the cancellation of plain f64.
//!
//! A product of two f32 is exact in f64, so a 2x2 determinant of f32 is exactly a pair of f64 (sum and rounding error);
//! every further level multiplies pairs with the rounding errors kept (Dekker 1971; the fused form of Ogita, Rump &
//! Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26, 2005) and adds with [`exact::sum`].
//!
//! All arguments are vectors of f32 values held in f64. No product of four of them overflows; products of four
//! subnormals still are normal f64.

use glam::{DMat3, DVec3, Vec3Swizzles};

use super::exact::{self, two_sum};

/// A vector whose components are the exact sums of the pairs.
pub type Pairs = [(f64, f64); 3];

/// a x b, exactly.
pub fn cross(a: DVec3, b: DVec3) -> Pairs {
    [two_sum(a.y * b.z, -(a.z * b.y)), two_sum(a.z * b.x, -(a.x * b.z)), two_sum(a.x * b.y, -(a.y * b.x))]
}

/// What the terms of each component of a x b add up to in absolute value: |a| x |b| with sums for differences.
pub fn cross_terms(a: DVec3, b: DVec3) -> DVec3 {
    let (a, b) = (a.abs(), b.abs());
    a.yzx() * b.zxy() + a.zxy() * b.yzx()
}

/// The sum of exact vectors, each with a factor of -1, 1 or another power of two: off by 2^-105 of itself.
pub fn sum(terms: &[(f64, &Pairs)]) -> Pairs {
    [0, 1, 2].map(|row| {
        let mut parts = [0.0; 9];
        for (slots, (factor, pairs)) in parts.chunks_exact_mut(2).zip(terms) {
            slots.copy_from_slice(&[factor * pairs[row].0, factor * pairs[row].1]);
        }
        let high = exact::sum(&parts);
        parts[8] = -high;
        (high, exact::remainder(&parts))
    })
}

/// Every component rounded once.
pub fn rounded(pairs: &Pairs) -> DVec3 {
    DVec3::from_array(pairs.map(|(high, _)| high))
}

/// The columns c1 x c2, c2 x c0, c0 x c1 of the cofactor matrix of `m`, exactly: `m a x m b = cof(m) (a x b)`.
pub fn cofactors(m: &DMat3) -> [Pairs; 3] {
    [cross(m.y_axis, m.z_axis), cross(m.z_axis, m.x_axis), cross(m.x_axis, m.y_axis)]
}

/// cof(m) v from [`cofactors`] and an exact vector: every component is off by at most 2^-53 of itself and 2^-103 of its
/// largest term.
pub fn cofactors_times(cofactors: &[Pairs; 3], v: &Pairs) -> DVec3 {
    DVec3::from_array(cofactors_times_terms(cofactors, v).map(|terms| exact::sum(&terms)))
}

/// What adds up to every component of that: off by 2^-103 of the largest term.
pub fn cofactors_times_terms(cofactors: &[Pairs; 3], v: &Pairs) -> [[f64; 12]; 3] {
    [0, 1, 2].map(|row| {
        let mut terms = [0.0; 12];
        for (slots, (column, factor)) in terms.chunks_exact_mut(4).zip(cofactors.iter().zip(v)) {
            let (high, low) = column[row];
            let product = high * factor.0;
            let error = high.mul_add(factor.0, -product);
            slots.copy_from_slice(&[product, error, high * factor.1, low * factor.0]);
        }
        terms
    })
}

/// a . v for an exact vector `v`, rounded once; `a` of f32 values. With [`cross`] the determinant [a, b, c].
pub fn dot(a: DVec3, v: &Pairs) -> f64 {
    let mut terms = [0.0; 12];
    for (slots, (factor, (high, low))) in terms.chunks_exact_mut(4).zip(a.to_array().into_iter().zip(v)) {
        let (product, small) = (factor * high, factor * low);
        slots.copy_from_slice(&[
            product,
            factor.mul_add(*high, -product),
            small,
            factor.mul_add(*low, -small),
        ]);
    }
    exact::sum(&terms)
}

/// a - b, exactly.
pub fn difference(a: DVec3, b: DVec3) -> Pairs {
    [two_sum(a.x, -b.x), two_sum(a.y, -b.y), two_sum(a.z, -b.z)]
}

/// a . b for exact vectors: off by 2^-53 of itself and 2^-104 of its largest term, and only by the former where one of
/// the two has no second parts.
pub fn dot_exact(a: &Pairs, b: &Pairs) -> f64 {
    let mut terms = [0.0; 18];
    let mut used = 0;
    for ((high, low), (factor, small)) in a.iter().zip(b) {
        for (p, q) in [(high, factor), (high, small), (low, factor)] {
            if *p != 0.0 && *q != 0.0 {
                let product = p * q;
                terms[used..used + 2].copy_from_slice(&[product, p.mul_add(*q, -product)]);
                used += 2;
            }
        }
    }
    exact::sum(&terms[..used])
}

/// The determinant of a matrix of f32 values, rounded once.
pub fn determinant(m: &DMat3) -> f64 {
    dot(m.x_axis, &cross(m.y_axis, m.z_axis))
}

/// Whether the determinant of a matrix of f32 values is 0, exactly.
pub fn is_singular(m: &DMat3) -> bool {
    let (minors, sizes) = (m.y_axis.cross(m.z_axis), cross_terms(m.y_axis, m.z_axis));
    // The products are off by less than 2^-50 of the sizes' sum. Nothing underflows.
    let doubtful = m.x_axis.dot(minors).abs() <= f64::EPSILON * 8.0 * m.x_axis.abs().dot(sizes);
    doubtful && determinant(m) == 0.0
}

/// m (p_1 + p_2 + ...), at most five points of f32 values: every component rounded once.
pub fn transform_sum(m: &DMat3, points: &[DVec3]) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|row| {
        let mut terms = [0.0; 15];
        for (slots, point) in terms.chunks_exact_mut(3).zip(points) {
            slots.copy_from_slice(&[
                m.x_axis[row] * point.x,
                m.y_axis[row] * point.y,
                m.z_axis[row] * point.z,
            ]);
        }
        exact::sum(&terms[..3 * points.len()])
    }))
}

/// The relative error of a component that [`transform_pairs`] leaves.
pub const PAIR_ERROR: f64 = 1.0 / (1u128 << 80) as f64;

/// The same as pairs: every component off by [`PAIR_ERROR`] of itself, exactly 0 where it is 0.
pub fn transform_pairs(m: &DMat3, points: &[DVec3]) -> Pairs {
    [0, 1, 2].map(|row| {
        let mut terms = [0.0; 16];
        for (slots, point) in terms.chunks_exact_mut(3).zip(points) {
            slots.copy_from_slice(&[
                m.x_axis[row] * point.x,
                m.y_axis[row] * point.y,
                m.z_axis[row] * point.z,
            ]);
        }
        let used = 3 * points.len();
        // The errors' own sum is off by 2^-101 of the terms at most, which cancel seldom.
        let (sum, error, size) = exact::parts(&terms[..used]);
        let high = sum + error;
        if high.abs() > size / (1u64 << 20) as f64 {
            return (high, error - (high - sum));
        }
        exact::pair(&terms[..used])
    })
}

/// |v|, whatever its scale: no square leaves the range of f64.
pub fn norm(v: DVec3) -> f64 {
    let square = v.length_squared();
    if (1e-250..1e250).contains(&square) {
        return square.sqrt();
    }
    let largest = v.abs().max_element();
    if largest > 0.0 { largest * (v / largest).length() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix whose rows nearly depend on each other; integers are the independent arithmetic.
    #[test]
    fn determinants_are_those_of_integers() {
        let m: [[i128; 3]; 3] =
            [[16_777_213, 16_777_211, 3], [16_777_211, 16_777_209, 5], [16_777_199, 16_777_197, 16_777_215]];
        let minor = |i: usize, j: usize| {
            let (p, q) = ((i + 1) % 3, (i + 2) % 3);
            let (r, s) = ((j + 1) % 3, (j + 2) % 3);
            m[p][r] * m[q][s] - m[p][s] * m[q][r]
        };
        let expected: i128 = (0..3).map(|k| m[0][k] * minor(0, k)).sum();
        let columns = m.map(|column| DVec3::from_array(column.map(|v| v as f64)));
        let matrix = DMat3::from_cols(columns[0], columns[1], columns[2]);
        assert_eq!(determinant(&matrix), expected as f64);
        assert!(!is_singular(&matrix));
        let flat = DMat3::from_cols(columns[0], columns[1], columns[0] - 3.0 * columns[1]);
        assert!(is_singular(&flat) && is_singular(&DMat3::ZERO) && !is_singular(&DMat3::IDENTITY));
        let cofactors = cofactors(&matrix);
        for (i, column) in cofactors.iter().enumerate() {
            for (j, (high, low)) in column.iter().enumerate() {
                assert_eq!(*high as i128 + *low as i128, minor(i, j));
            }
        }
    }

    /// cof(m) (a x b) is m a x m b, here in integers that cancel.
    #[test]
    fn a_mapped_cross_product_is_the_cross_product_of_mapped_vectors() {
        let m: [[i128; 3]; 3] = [[8_388_607, 2, -5], [7, 8_388_593, 11], [-3, 13, 8_388_581]];
        let (a, b): ([i128; 3], [i128; 3]) = ([9_999_991, 77, 1_234_567], [9_999_973, 76, 1_234_565]);
        let map = |v: [i128; 3]| [0, 1, 2].map(|row| (0..3).map(|k| m[k][row] * v[k]).sum::<i128>());
        let (ma, mb) = (map(a), map(b));
        let expected =
            [ma[1] * mb[2] - ma[2] * mb[1], ma[2] * mb[0] - ma[0] * mb[2], ma[0] * mb[1] - ma[1] * mb[0]];
        let vector = |v: [i128; 3]| DVec3::from_array(v.map(|c| c as f64));
        let matrix = DMat3::from_cols(vector(m[0]), vector(m[1]), vector(m[2]));
        let got = cofactors_times(&cofactors(&matrix), &cross(vector(a), vector(b)));
        assert_eq!(got, vector(expected));
        assert_eq!(transform_sum(&matrix, &[vector(a)]), vector(ma));
        let pairs = transform_pairs(&matrix, &[vector(a), vector(b)]);
        let mb = map(b);
        for (row, (high, low)) in pairs.into_iter().enumerate() {
            assert_eq!(high as i128 + low as i128, ma[row] + mb[row]);
        }
    }

    #[test]
    fn norms_keep_their_range() {
        let (large, small) = (2f64.powi(700), 2f64.powi(-700));
        assert!((norm(DVec3::new(3.0 * large, 0.0, 4.0 * large)) / large - 5.0).abs() < 2e-15);
        assert!((norm(DVec3::new(0.0, -3.0 * small, 4.0 * small)) / small - 5.0).abs() < 2e-15);
        assert_eq!(norm(DVec3::ZERO), 0.0);
    }
}
