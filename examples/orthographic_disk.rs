//! A quarter of the unit disk, seen orthographically, stands for a quarter of the hemisphere: pi/2. The sum over its pixels by
//! the published code, which drops every pixel with a corner outside the circle; by the exact areas of the pixels that lie
//! inside; and with boundary pixels clipped exactly. `cargo run --release --example orthographic_disk`
//!
//! The page prints 1.5535995614989679 for 10000 x 10000. Corners that lie exactly on the circle, such as (6000, 8000), are in or
//! out as rounding has it: all of them out make 1.5535976, all of them in 1.5536054, by integer arithmetic.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;
use rootq::numeric::disk_rectangle::clipped;

/// The published primitive in f64, with its own treatment of the circle; nothing outside it.
fn published_area(mut x: f64, mut y: f64) -> Option<f64> {
    let square = x * x + y * y;
    if square > 1.0 {
        return None;
    }
    let secant = 1.0 / (1.0 - square).sqrt();
    if secant.is_infinite() {
        x = if x == 0.0 { 1e-12 } else { x };
        y = if y == 0.0 { 1e-12 } else { y };
    }
    let half = ((1.0 - x - y * y) * secant / y).atan() - ((1.0 + x - y * y) * secant / y).atan();
    Some(y * (x * secant).atan() + x * (y * secant).atan() + 0.5 * half)
}

/// The same in closed form with its height 0 outside, where it is the clipped area.
fn clipped_area(x: f64, y: f64) -> f64 {
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    y * x.atan2(z) + x * y.atan2(z) - (x * y).atan2(z)
}

/// Sums over the pixels of the quarter in an image of `size` x `size` quarter pixels.
#[derive(Debug)]
pub(crate) struct Sums {
    /// The published code: corners k/size as it computes them, zero if any leaves the circle, at least 0.
    pub(crate) published: f64,
    /// Exact areas of the pixels whose far corner is not outside.
    pub(crate) inside: f64,
    /// Exact areas of all, the boundary clipped.
    pub(crate) clipped: f64,
}

/// Rows in parallel; within a row one corner's value serves two pixels.
pub(crate) fn sums(size: u32) -> Sums {
    // The quarter X, Y >= size of an image of twice the size, as the published code counts them.
    let at = |k: u32| 2.0 * f64::from(size + k) / f64::from(2 * size) - 1.0;
    let zero = || Sums { published: 0.0, inside: 0.0, clipped: 0.0 };
    let row = |line: u32| {
        let (y0, y1) = (at(line), at(line + 1));
        let mut sums = zero();
        let corner =
            |x: f64| (published_area(x, y0), published_area(x, y1), clipped_area(x, y0), clipped_area(x, y1));
        let mut left = corner(0.0);
        for column in 0..size {
            let (x0, x1) = (at(column), at(column + 1));
            if x0 * x0 + y0 * y0 >= 1.0 {
                break;
            }
            let right = corner(x1);
            if let (Some(a), Some(b), Some(c), Some(d)) = (left.0, right.0, left.1, right.1) {
                sums.published += (d - b - c + a).max(0.0);
            }
            // Rounding of the primitive is 1e-16 a pixel; a pixel that the circle cuts is taken without cancellation.
            if x1 * x1 + y1 * y1 <= 1.0 {
                let area = (right.3 - left.3) - (right.2 - left.2);
                sums.inside += area;
                sums.clipped += area;
            } else {
                sums.clipped += clipped(x0, y0, x1, y1).value;
            }
            left = right;
        }
        sums
    };
    (0..size).into_par_iter().map(row).reduce(zero, |a, b| Sums {
        published: a.published + b.published,
        inside: a.inside + b.inside,
        clipped: a.clipped + b.clipped,
    })
}

/// What the page prints for 10000 x 10000.
pub(crate) const PRINTED: f64 = 1.553_599_561_498_968;

/// Exact areas of the pixels whose far corner is inside the circle, or on it where `on_circle` says so: decided in integers, and
/// a row of pixels is the difference of two corners.
pub(crate) fn whole_pixels(size: u32, on_circle: bool) -> f64 {
    let n = u64::from(size);
    let row = |line: u64| {
        let square = n * n - (line + 1) * (line + 1);
        let root = square.isqrt();
        let columns = if root * root == square && !on_circle { root.saturating_sub(1) } else { root };
        let at = |k: u64| k as f64 / n as f64;
        clipped_area(at(columns), at(line + 1)) - clipped_area(at(columns), at(line))
    };
    (0..n).map(row).sum()
}

#[allow(dead_code, reason = "tests take the functions above")]
fn main() {
    println!("pi/2 = {FRAC_PI_2:.15}\n  size    published code     whole pixels       clipped exactly");
    for size in [1_000, 5_000, 10_000] {
        let Sums { published, inside, clipped } = sums(size);
        println!("{size:6}    {published:.15}  {inside:.15}  {clipped:.15}");
    }
    let [out, inside] = [false, true].map(|on_circle| whole_pixels(10_000, on_circle));
    println!("10000, corners on the circle out: {out:.9}, in: {inside:.9}; printed: {PRINTED:.9}");
}
