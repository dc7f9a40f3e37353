//! Eigenvalues and eigenvectors of symmetric 3x3 matrices of f32 entries, with error bounds.

use glam::DVec3;

use super::exact;
use super::spacing::EPS;
use super::twofold::{Twofold, two_product};

/// [`Symmetric3::jacobi`]'s error in units of EPS times the norm: sixteen rotations that each round an entry thrice.
const JACOBI_BOUND: f64 = 48.0 * EPS;
/// [`Symmetric3::jacobi_twofold`]'s, each operation rounding at 2^-102: 2^-97.
const TWOFOLD_BOUND: f64 = 6.310_887_241_768_095e-30;

/// Eigenvalues closer than this share of the norm, 2^-63, count as equal: rounding one f32 entry turns their vectors
/// anywhere.
pub const EQUAL: f64 = 1.084_202_172_485_504_4e-19;

/// A symmetric matrix whose entries are f32 values (products of two are exact), as diagonal and off-diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetric3 {
    /// xx, yy, zz.
    pub diagonal: [f64; 3],
    /// yz, xz, xy: entry k is the one outside row and column k.
    pub opposite: [f64; 3],
}

/// Eigenvalues in ascending order, unit eigenvectors beside them, and how far off they may be.
#[derive(Clone, Copy, Debug)]
pub struct Eigensystem {
    pub values: [f64; 3],
    pub vectors: [DVec3; 3],
    /// Absolute.
    pub value_bounds: [f64; 3],
    /// Angles; those of eigenvalues that count as equal mean nothing.
    pub vector_bounds: [f64; 3],
}

impl Symmetric3 {
    /// The Frobenius norm.
    pub fn norm(&self) -> f64 {
        let squares = |v: [f64; 3]| v.map(|v| v * v).iter().sum::<f64>();
        libm::sqrt(squares(self.diagonal) + 2.0 * squares(self.opposite))
    }

    /// |q|^T |A| |w|: what changes q^T A w most, if every entry changes by its own size.
    pub fn change(&self, q: DVec3, w: DVec3) -> f64 {
        let ([a, b, c], [f, e, d]) = (self.diagonal.map(f64::abs), self.opposite.map(f64::abs));
        let (q, w) = (q.abs(), w.abs());
        q.dot(DVec3::new(DVec3::new(a, d, e).dot(w), DVec3::new(d, b, f).dot(w), DVec3::new(e, f, c).dot(w)))
    }

    /// The sum of the products of two eigenvalues, rounded once.
    fn second_invariant(&self) -> f64 {
        let ([a, b, c], [f, e, d]) = (self.diagonal, self.opposite);
        exact::sum(&[a * b, b * c, a * c, -d * d, -e * e, -f * f])
    }

    /// The product of the eigenvalues, rounded once.
    pub fn determinant(&self) -> f64 {
        let ([a, b, c], [f, e, d]) = (self.diagonal, self.opposite);
        let terms = [(a * b, c), (2.0 * d * e, f), (-f * f, a), (-e * e, b), (-d * d, c)];
        let mut parts = [0.0; 10];
        for (pair, (product, factor)) in parts.chunks_exact_mut(2).zip(terms) {
            // The product of two f32 is exact, that with a third an exact pair.
            (pair[0], pair[1]) = two_product(product, factor);
        }
        exact::sum(&parts)
    }

    /// Cyclic Jacobi rotations in f64: values within 48 EPS of the norm, vectors within that over their gap.
    ///
    /// Source: Rutishauser, "The Jacobi method for real symmetric matrices", 1966.
    pub fn jacobi(&self) -> Eigensystem {
        let (mut d, mut o) = (self.diagonal, self.opposite);
        let mut vectors = [DVec3::X, DVec3::Y, DVec3::Z];
        for _ in 0..SWEEPS {
            if o == [0.0; 3] {
                break;
            }
            for (p, q, r) in PLANES {
                let apq = o[r];
                if apq.abs() <= NEGLIGIBLE * d[p].abs().min(d[q].abs()) {
                    o[r] = 0.0;
                    continue;
                }
                let t = tangent(d[p], d[q], apq);
                let c = 1.0 / libm::sqrt(1.0 + t * t);
                let s = t * c;
                d[p] -= t * apq;
                d[q] += t * apq;
                o[r] = 0.0;
                (o[q], o[p]) = (c * o[q] - s * o[p], s * o[q] + c * o[p]);
                (vectors[p], vectors[q]) = (c * vectors[p] - s * vectors[q], s * vectors[p] + c * vectors[q]);
            }
        }
        let bound = if self.opposite == [0.0; 3] { 0.0 } else { JACOBI_BOUND * self.norm() };
        Eigensystem::sorted(d, vectors, bound)
    }

    /// The same with twofold entries, and exact zeros where the matrix is singular.
    pub fn jacobi_twofold(&self) -> Eigensystem {
        let norm = self.norm();
        let mut d = self.diagonal.map(Twofold::from);
        let mut o = self.opposite.map(Twofold::from);
        let mut vectors = [DVec3::X, DVec3::Y, DVec3::Z];
        // What is below is left, and counted in the bound.
        let negligible = 0.125 * TWOFOLD_BOUND * norm;
        for _ in 0..SWEEPS {
            if o.iter().all(|entry| entry.hi.abs() <= negligible) {
                break;
            }
            for (p, q, r) in PLANES {
                let apq = o[r];
                if apq.hi.abs() <= negligible {
                    continue;
                }
                // One step of Newton's for apq t^2 + (aqq - app) t - apq = 0 doubles the digits of t.
                let first = tangent(d[p].hi, d[q].hi, apq.hi);
                let difference = d[q] - d[p];
                let residual = (apq * first + difference) * first - apq;
                let slope = 2.0 * apq.hi * first + difference.hi;
                let t = Twofold::from(first) + Twofold::from(-residual.hi / slope);
                // And one for c = (1 + t^2)^(-1/2).
                let square = Twofold::from(1.0) + t * t;
                let rough = 1.0 / libm::sqrt(square.hi);
                let missing = Twofold::from(1.0) - square * rough * rough;
                let c = Twofold::from(rough) + Twofold::from(0.5 * rough * missing.hi);
                let s = t * c;
                let shift = t * apq;
                d[p] = d[p] - shift;
                d[q] = d[q] + shift;
                o[r] = Twofold::ZERO;
                (o[q], o[p]) = (c * o[q] - s * o[p], s * o[q] + c * o[p]);
                (vectors[p], vectors[q]) =
                    (c.hi * vectors[p] - s.hi * vectors[q], s.hi * vectors[p] + c.hi * vectors[q]);
            }
        }
        let mut found = Eigensystem::sorted(d.map(Twofold::value), vectors, TWOFOLD_BOUND * norm);
        self.settle_smallest(&mut found, norm);
        found
    }

    /// Eigenvalues that the norm drowns, from the determinant, which has their relative accuracy.
    fn settle_smallest(&self, found: &mut Eigensystem, norm: f64) {
        let mut by_size = [0, 1, 2];
        by_size.sort_unstable_by(|a, b| found.values[*a].abs().total_cmp(&found.values[*b].abs()));
        let [smallest, middle, largest] = by_size;
        let determinant = self.determinant();
        if determinant == 0.0 {
            found.values[smallest] = 0.0;
            found.value_bounds[smallest] = 0.0;
            if self.second_invariant() == 0.0 {
                found.values[middle] = 0.0;
                found.value_bounds[middle] = 0.0;
            }
        } else if found.values[smallest].abs() < 1e-19 * norm {
            let others = found.values[middle] * found.values[largest];
            let relative = [middle, largest].map(|k| found.value_bounds[k] / found.values[k].abs());
            found.values[smallest] = determinant / others;
            found.value_bounds[smallest] =
                (4.0 * EPS + relative[0] + relative[1]) * found.values[smallest].abs();
        }
        // A zero set exactly may have passed a neighbour within the bound.
        found.sort();
    }
}

/// Cyclic sweeps converge quadratically: six or seven are enough, and a sweep without work ends them.
const SWEEPS: usize = 12;
/// Off-diagonal entries below this share of the smaller diagonal one, 2^-64, move no bit of f64.
const NEGLIGIBLE: f64 = 5.421_010_862_427_522e-20;
/// The planes of rotation, and the index left out.
const PLANES: [(usize, usize, usize); 3] = [(0, 1, 2), (0, 2, 1), (1, 2, 0)];

/// The smaller root t of apq t^2 + (aqq - app) t - apq = 0.
fn tangent(app: f64, aqq: f64, apq: f64) -> f64 {
    let theta = 0.5 * (aqq - app) / apq;
    if theta.abs() > 1e150 {
        return 0.5 / theta;
    }
    let t = 1.0 / (theta.abs() + libm::sqrt(theta * theta + 1.0));
    if theta < 0.0 { -t } else { t }
}

impl Eigensystem {
    fn sorted(values: [f64; 3], vectors: [DVec3; 3], bound: f64) -> Self {
        let mut system = Eigensystem { values, vectors, value_bounds: [bound; 3], vector_bounds: [0.0; 3] };
        system.sort();
        for k in 0..3 {
            let gap = system.gap(k);
            system.vector_bounds[k] = if bound == 0.0 { 0.0 } else { 2.0 * bound / gap + 32.0 * EPS };
        }
        system.vectors = system.vectors.map(DVec3::normalize);
        // f64 keeps some of a value's own roundings too.
        for (bound, value) in system.value_bounds.iter_mut().zip(system.values) {
            *bound += if *bound == 0.0 { 0.0 } else { EPS * value.abs() };
        }
        system
    }

    fn sort(&mut self) {
        for (a, b) in [(0, 1), (1, 2), (0, 1)] {
            if self.values[a] > self.values[b] {
                self.values.swap(a, b);
                self.vectors.swap(a, b);
                self.value_bounds.swap(a, b);
                self.vector_bounds.swap(a, b);
            }
        }
    }

    /// The distance from value `k` to the nearest other.
    pub fn gap(&self, k: usize) -> f64 {
        (0..3)
            .filter(|j| *j != k)
            .map(|j| (self.values[k] - self.values[j]).abs())
            .fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn matrix(entries: [f32; 6]) -> Symmetric3 {
        let [xx, yy, zz, xy, xz, yz] = entries.map(f64::from);
        Symmetric3 { diagonal: [xx, yy, zz], opposite: [yz, xz, xy] }
    }

    #[test]
    fn exact_zeros_and_known_spectra() {
        // v v^T for v = (1, 2, 3), and all ones less three: -3, -3 and 0.
        let rank_one = matrix([1.0, 4.0, 9.0, 2.0, 3.0, 6.0]).jacobi_twofold();
        assert_eq!(rank_one.values[..2], [0.0, 0.0]);
        assert!((rank_one.values[2] - 14.0).abs() <= 28.0 * EPS);
        let laplacian = matrix([-2.0, -2.0, -2.0, 1.0, 1.0, 1.0]).jacobi_twofold();
        assert!(
            (laplacian.values[0] + 3.0).abs() <= 6.0 * EPS && (laplacian.values[1] + 3.0).abs() <= 6.0 * EPS
        );
        assert_eq!(laplacian.values[2], 0.0);
        // Tridiagonal 2, -1: 2 and 2 -+ sqrt(2).
        let chain = matrix([2.0, 2.0, 2.0, -1.0, 0.0, -1.0]).jacobi_twofold();
        let root = core::f64::consts::SQRT_2;
        for (value, expected) in chain.values.into_iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!((value - expected).abs() <= 8.0 * EPS);
        }
    }

    proptest! {
        /// The twofold path is some 2^45 times as accurate, and so the measure of the plain one's bound.
        #[test]
        fn plain_rotations_keep_their_bound(entries in prop::array::uniform6(-1.0f32..1.0), shift in prop::array::uniform6(0i32..40)) {
            let mut entries = entries;
            for (entry, shift) in entries.iter_mut().zip(shift) {
                *entry *= 2f32.powi(-shift);
            }
            let a = matrix(entries);
            prop_assume!(a.norm() > 0.0);
            let (plain, fine) = (a.jacobi(), a.jacobi_twofold());
            for k in 0..3 {
                prop_assert!((plain.values[k] - fine.values[k]).abs() <= plain.value_bounds[k] + fine.value_bounds[k]);
                let turn = plain.vectors[k].cross(fine.vectors[k]).length();
                prop_assert!(turn <= plain.vector_bounds[k] + fine.vector_bounds[k], "{} {:?} {:?}", turn, plain, fine);
            }
        }

        /// Against the exact invariants: trace, sum of minors and determinant.
        #[test]
        fn twofold_values_have_the_exact_invariants(entries in prop::array::uniform6(-1.0f32..1.0)) {
            let a = matrix(entries);
            let [x, y, z] = a.jacobi_twofold().values;
            let norm = a.norm();
            prop_assert!((x + y + z - a.diagonal.iter().sum::<f64>()).abs() <= 8.0 * EPS * norm);
            prop_assert!((x * y + y * z + x * z - a.second_invariant()).abs() <= 8.0 * EPS * norm * norm);
            // Relative: the smallest value is right to its own last bits.
            let determinant = a.determinant();
            prop_assert!((x * y * z - determinant).abs() <= 8.0 * EPS * determinant.abs());
        }
    }
}
