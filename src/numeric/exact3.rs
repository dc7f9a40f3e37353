//! Vectors and 3x3 matrices whose entries are f32 values: what can be had of them without rounding.

use glam::DVec3;

use super::exact;
use super::twofold::{Twofold, two_product};

/// A vector of twofold components.
pub type Vector = [Twofold; 3];

/// The matrix whose columns start at `columns[0]`, `[3]` and `[6]`, of f32 values.
pub fn columns(values: &[f32]) -> [DVec3; 3] {
    [0, 3, 6].map(|at| vector(&values[at..]))
}

/// Three f32 values.
pub fn vector(values: &[f32]) -> DVec3 {
    DVec3::new(f64::from(values[0]), f64::from(values[1]), f64::from(values[2]))
}

/// M v for f32 values: relative error 2^-104 of the largest product of a component, exactly 0 where it is 0.
#[inline]
pub fn transformed(m: &[DVec3; 3], v: DVec3) -> Vector {
    [0, 1, 2].map(|row| Twofold::sum3(m[0][row] * v.x, m[1][row] * v.y, m[2][row] * v.z))
}

/// The determinant of three vectors of f32 values, rounded once. Entries between 2^-300 and 2^300 in products of three.
pub fn determinant(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    exact::sum(&determinant_terms(a, b, c))
}

/// What adds up to that exactly.
pub fn determinant_terms(a: DVec3, b: DVec3, c: DVec3) -> [f64; 12] {
    let mut terms = [0.0; 12];
    let minors = [(b.y * c.z, b.z * c.y), (b.z * c.x, b.x * c.z), (b.x * c.y, b.y * c.x)];
    for (column, (plus, minus)) in minors.into_iter().enumerate() {
        let (p, q) = (two_product(plus, a[column]), two_product(minus, -a[column]));
        terms[4 * column..4 * column + 4].copy_from_slice(&[p.0, p.1, q.0, q.1]);
    }
    terms
}

/// The power of two that brings the largest component of the vectors into 1/2..1; 1 for zero vectors.
pub fn scale_to_one(vectors: &[Vector]) -> f64 {
    let largest = vectors.iter().flatten().fold(0.0f64, |largest, c| largest.max(c.value().abs()));
    libm::ldexp(1.0, -libm::frexp(largest).1)
}

/// z of M v for f32 values, rounded once, so that the sign is right.
pub fn height(m: &[DVec3; 3], v: DVec3) -> f64 {
    exact::sum(&[m[0].z * v.x, m[1].z * v.y, m[2].z * v.z])
}

/// What adds up exactly to the square of a sum of three products of two f32 values, or to its opposite.
pub fn square_of_sum(products: &[f64; 3], sign: f64) -> [f64; 12] {
    let [a, b, c] = *products;
    let pairs = [(a, a), (b, b), (c, c), (a, 2.0 * b), (a, 2.0 * c), (b, 2.0 * c)];
    let mut terms = [0.0; 12];
    for (slots, (p, q)) in terms.chunks_exact_mut(2).zip(pairs) {
        let (high, low) = two_product(p, sign * q);
        slots.copy_from_slice(&[high, low]);
    }
    terms
}

/// What sums of [`square`]s of [`transformed`] vectors are off by, of their terms: a few of twofold arithmetic's 2^-102.
pub const SQUARES: f64 = 1.0 / (1u128 << 96) as f64;

/// The upper triangle xx, yy, zz, xy, xz, yz of v v^T.
#[inline]
pub fn square(v: &Vector) -> [Twofold; 6] {
    let [x, y, z] = *v;
    [x * x, y * y, z * z, x * y, x * z, y * z]
}

/// M S M^T for symmetric S in the order of [`square`]: relative error 2^-100 of the largest products.
pub fn congruence(m: &[DVec3; 3], s: &[Twofold; 6]) -> [Twofold; 6] {
    let [xx, yy, zz, xy, xz, yz] = *s;
    let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    // Row i of M S.
    let product = [0, 1, 2]
        .map(|i| [0, 1, 2].map(|k| rows[0][k] * m[0][i] + rows[1][k] * m[1][i] + rows[2][k] * m[2][i]));
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        .map(|(i, j)| product[i][0] * m[0][j] + product[i][1] * m[1][j] + product[i][2] * m[2][j])
}

/// A symmetric matrix in f64, from the order of [`square`].
pub fn symmetric(s: &[Twofold; 6]) -> glam::DMat3 {
    let [xx, yy, zz, xy, xz, yz] = s.map(|component| component.value());
    glam::DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn differences_of_squares_have_their_sign() {
        // (1 + 2^-30 + 2^-40)^2 of one, and of the other in two parts and a bit.
        let (a, b) = (2f64.powi(-30), 2f64.powi(-40));
        let difference = |plus: &[[f64; 3]], minus: &[f64; 3]| {
            let plus = plus.iter().flat_map(|sum| square_of_sum(sum, 1.0));
            exact::sum(&plus.chain(square_of_sum(minus, -1.0)).collect::<Vec<_>>())
        };
        assert_eq!(difference(&[[1.0, a, b]], &[b, 1.0, a]), 0.0);
        assert_eq!(difference(&[[1.0, a, b], [2f64.powi(-100), 0.0, 0.0]], &[b, a, 1.0]), 2f64.powi(-200));
        assert_eq!(
            difference(&[[3.0, 0.0, 0.0], [4.0, 0.0, 0.0]], &[5.0, 2f64.powi(-90), 0.0]),
            -10.0 * 2f64.powi(-90)
        );
    }

    proptest! {
        /// Integers are the independent arithmetic: 20-bit entries leave no rounding anywhere.
        #[test]
        fn determinants_are_rounded_once(e in prop::array::uniform9(-(1i64 << 20)..(1i64 << 20)), shift in -40i32..40) {
            let [a, b, c] = [0, 3, 6].map(|at| [e[at], e[at + 1], e[at + 2]].map(i128::from));
            let exact = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
            let scale = 2f64.powi(shift);
            let [a, b, c] = columns(&e.map(|v| v as f32)).map(|v| v * scale);
            prop_assert_eq!(determinant(a, b, c), exact as f64 * scale * scale * scale);
        }
    }

    #[test]
    fn dependent_vectors_have_no_volume() {
        let (a, b) = (DVec3::new(0.1f32.into(), 0.7, 3.0), DVec3::new(1.0, f64::from(0.3f32), 0.5));
        let a = DVec3::new(a.x, f64::from(0.7f32), a.z);
        assert_eq!(determinant(a, b, 2.0 * a), 0.0);
        assert_eq!(determinant(a, b, a - 4.0 * b), 0.0);
    }
}
