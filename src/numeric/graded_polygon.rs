//! What [`super::polygon_irradiance`] computes, in as many digits as it takes.
//!
//! The corners are exact, and so is all that is a polynomial of them: the normal a x b of an edge, where it crosses the
//! horizon, (a x b).y and -(a x b).x up to a factor, and with its length both arguments of every angle. What is left to round
//! is a root, an angle and a quotient for each edge, and their sum, of which little may remain: the precision grows until three
//! results agree. What is exact is first scaled by pi to that precision, which changes nothing but roundings: powers of two and
//! their likes have long runs of zeros, which two precisions would round to the same. The sum has more digits than its terms, and
//! shows what their roundings do.

use super::big::{self, Big, Settling, Vector, abs, angle, cross, dot, nearest, rounded};

/// The first precision in bits, and the last one to begin with. Corners that differ by f32's extremes cancel to 2^-1700.
const LEAST: usize = 96;
const MOST: usize = 8192;

/// Digits of sums beyond those of what is rounded.
const GUARD: usize = 32;
/// Sums that are exactly 0 in fewer digits may be luck; whatever has symmetry is so in any.
const ZERO: usize = 512;

/// An edge's part above the horizon: theta n.z/|n|, theta the angle of (factor |n|, cosine).
struct Edge {
    height: Big,
    square: Big,
    factor: Big,
    cosine: Big,
}

/// The way along the horizon between two crossings, by sine and cosine up to a factor.
struct Way {
    sine: Big,
    cosine: Big,
}

/// The irradiance of a polygon above the horizon as a share of the hemisphere's, rounded once; `None` where its contour or a
/// chord that closes it passes through the origin, and where no precision tells it from 0.
pub fn irradiance<const N: usize>(corners: &[Vector; N]) -> Option<f64> {
    let mut edges = Vec::new();
    // Directions in the horizon, and whether the contour leaves there.
    let mut crossings: Vec<([Big; 2], bool)> = Vec::new();
    for (first, a) in corners.iter().enumerate() {
        let b = &corners[(first + 1) % N];
        let (above_a, above_b) = (a[2] > Big::ZERO, b[2] > Big::ZERO);
        if !above_a && !above_b {
            continue;
        }
        let normal = cross(a, b);
        let (factor, cosine) = match (above_a, above_b) {
            (true, true) => (Big::ONE, dot(a, b)),
            (true, false) => (a[2].clone(), &a[2] * dot(a, b) - &b[2] * dot(a, a)),
            _ => (b[2].clone(), &b[2] * dot(a, b) - &a[2] * dot(b, b)),
        };
        if above_a != above_b {
            let [x, y, _] = &normal;
            crossings.push((if above_a { [y.clone(), -x] } else { [-y, x.clone()] }, above_a));
        }
        let square = dot(&normal, &normal);
        if square > Big::ZERO {
            let [.., height] = normal;
            edges.push(Edge { height, square, factor, cosine });
        } else if cosine <= Big::ZERO {
            return None;
        }
    }
    let mut ways = Vec::new();
    for (position, (from, leaves)) in crossings.iter().enumerate() {
        if *leaves {
            let (to, _) = &crossings[(position + 1) % crossings.len()];
            let way = Way {
                sine: &from[0] * &to[1] - &from[1] * &to[0],
                cosine: &from[0] * &to[0] + &from[1] * &to[1],
            };
            if way.sine == Big::ZERO && way.cosine <= Big::ZERO {
                return None;
            }
            ways.push(way);
        }
    }

    let mut settling = Settling::default();
    big::precisions(LEAST, MOST).find_map(|bits| {
        let value = sum(&edges, &ways, bits);
        let is_settled = settling.with(&value, bits) && (value != Big::ZERO || bits >= ZERO);
        is_settled.then(|| nearest(&abs(value)))
    })
}

fn sum(edges: &[Edge], ways: &[Way], bits: usize) -> Big {
    let pi = Big::pi(bits + GUARD);
    let unit = rounded(&pi, 0);
    let guarded = |x: &Big| rounded(&rounded(x, bits), bits + GUARD);
    let round = |x: &Big| guarded(&(x * &unit));
    let mut sum = Big::ZERO;
    for Edge { height, square, factor, cosine } in edges {
        // In units that make both arguments of the angle as many times as large.
        let length = round(&(square * &unit)).sqrt();
        let theta = angle(&(guarded(factor) * &length), &round(cosine), &pi);
        sum += theta * round(height) / length;
    }
    for Way { sine, cosine } in ways {
        let turn = angle(&round(&abs(sine.clone())), &round(cosine), &pi);
        sum += if *sine < Big::ZERO { -turn } else { turn };
    }
    sum / (pi << 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::polygon_irradiance;
    use crate::sample::Stream;
    use crate::sample::landmarks;
    use glam::DVec3;

    #[test]
    fn agrees_with_plain_arithmetic() {
        let mut lit = 0;
        Stream::new(8, "graded").visit(0, 500, |_, draw| {
            let corners: [DVec3; 4] = std::array::from_fn(|_| draw.log_uniform(0.5, 5.0) * draw.direction());
            let plain = polygon_irradiance::irradiance(&corners.map(|corner| corner.to_array()));
            let exact = irradiance(&corners.map(big::vector)).unwrap();
            assert!((plain.value.abs() - exact).abs() <= plain.bound, "{corners:?}: {plain:?} {exact}");
            lit += usize::from(exact > 0.0);
        });
        assert!(lit > 300, "{lit}");
    }

    /// What plain arithmetic calls certain is right, whatever f32 the corners are.
    #[test]
    fn plain_arithmetic_knows_what_it_knows() {
        let (mut certain, mut uncertain) = (0, 0);
        Stream::new(8, "exponents").visit(0, 4_000, |_, draw| {
            let corners: [DVec3; 4] = std::array::from_fn(|_| {
                DVec3::from_array(std::array::from_fn(|_| f64::from(landmarks::any_exponent(draw))))
            });
            let pairs = corners.map(|corner| corner.to_array().map(|component| (component, 0.0)));
            let found = polygon_irradiance::of_pairs(&pairs, [false; 4]).finer(&pairs, [false; 4]);
            if !found.is_certain() {
                uncertain += 1;
                return;
            }
            let exact = irradiance(&corners.map(big::vector)).unwrap();
            // What it promises.
            assert!((found.value.abs() - exact).abs() <= 2.92e-11 * exact, "{corners:?}: {found:?} {exact}");
            certain += 1;
        });
        assert!(certain > 300 && uncertain > 300, "{certain} {uncertain}");
    }

    /// A square of half width s straight above at 1 has (4/pi) s atan(s/h)/h, h^2 = 1 + s^2; what is tiny, 4 s^2/pi.
    #[test]
    fn tiny_squares_keep_their_digits() {
        for exponent in [-500, -100, -30, 0, 3] {
            let s = libm::ldexp(1.0, exponent);
            let corners =
                [(-s, -s), (s, -s), (s, s), (-s, s)].map(|(x, y)| big::vector(DVec3::new(x, y, 1.0)));
            let h = libm::hypot(1.0, s);
            let expected = 4.0 / std::f64::consts::PI * (s / h) * libm::atan(s / h);
            let found = irradiance(&corners).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-15, "{s}: {found} {expected}");
        }
    }

    /// Specks of any outline around (0, 0, 1) before Minv: |det Minv| A q.z/(pi |q|^4) for their area A and q = Minv (0, 0, 1).
    /// Roundings of both precisions that cancel leave exactly 0, and may not be taken for it.
    #[test]
    fn specks_are_not_dark() {
        let mut seen = 0;
        Stream::new(9, "specks").visit(0, 2_000, |_, draw| {
            let single = |x: f64| f64::from(x as f32);
            let minv: [DVec3; 3] = std::array::from_fn(|_| {
                DVec3::from_array(std::array::from_fn(|_| single(draw.uniform(-2.0, 2.0))))
            });
            let size = libm::ldexp(1.0, -100 - draw.below(45) as i32);
            let corners: [DVec3; 4] = std::array::from_fn(|_| {
                let [x, y] = std::array::from_fn(|_| single(size * draw.uniform(-1.0, 1.0)));
                DVec3::new(x, y, 1.0)
            });
            let q = minv[2];
            if q.z <= 0.0 {
                return;
            }
            let area = (0..4)
                .map(|k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    a.x * b.y - b.x * a.y
                })
                .sum::<f64>();
            let slope = minv[0].dot(minv[1].cross(q)).abs() * q.z / q.length_squared().powi(2);
            let expected = 0.5 * area.abs() * slope / std::f64::consts::PI;
            let found = irradiance(&corners.map(|corner| big::mapped(&minv, &big::vector(corner)))).unwrap();
            assert!(
                (found - expected).abs() <= 1e-9 * expected,
                "{minv:?} {corners:?}: {found:e} {expected:e}"
            );
            seen += 1;
        });
        assert!(seen > 900, "{seen}");
    }

    #[test]
    fn contours_through_the_point_have_no_value() {
        let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];
        assert_eq!(irradiance(&corners.map(|corner| big::vector(DVec3::from_array(corner)))), None);
        let below = [[1.0, 0.0, -1.0], [0.0, 1.0, -0.5], [-1.0, 0.0, 0.0], [0.0, -1.0, -1.0]];
        assert_eq!(irradiance(&below.map(|corner| big::vector(DVec3::from_array(corner)))), Some(0.0));
    }
}
