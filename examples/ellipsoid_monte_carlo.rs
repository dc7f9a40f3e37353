//! An ellipsoid's solid angle three ways, as in figure 8 of Heitz's report of 2016: by its own closed form, by that of the ellipse
//! that covers the same directions, and by counting random directions that meet it.
//! `cargo run --release --example ellipsoid_monte_carlo`

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use rootq::family::{Truth, find};
use rootq::sample::Stream;

/// Centre, quaternion and semi-axes: a flat one, a rod, and one close by.
pub(crate) const SHAPES: [(&str, [f32; 10]); 3] = [
    ("flat", [1.0, 1.5, 2.0, 0.3, -0.4, 0.1, 0.86, 1.0, 0.8, 0.15]),
    ("rod", [-1.0, 0.5, 1.5, -0.2, 0.5, 0.4, 0.74, 1.4, 0.25, 0.2]),
    ("close", [0.3, -0.9, 0.6, 0.1, 0.7, -0.1, 0.7, 0.5, 1.0, 0.75]),
];

fn truth(family: &str, input: &[f32]) -> Vec<f64> {
    let problem = find(family).expect("a family of this library");
    let mut truth = Truth::new(problem.outputs());
    problem.oracle(input, &mut truth);
    truth.values().to_vec()
}

/// By the ellipsoid's own closed form, and by that of its ellipse, rounded to f32.
pub(crate) fn closed_forms(shape: &[f32; 10]) -> [f64; 2] {
    let ellipse: Vec<f32> = truth("ellipsoid_ellipse", shape).iter().map(|v| *v as f32).collect();
    [truth("ellipsoid_solid_angle", shape)[0], truth("ellipse_solid_angle", &ellipse)[0]]
}

/// The share of `count` random directions that meet the ellipsoid, as a solid angle, and its standard error.
pub(crate) fn counted(shape: &[f32; 10], count: usize) -> (f64, f64) {
    let v = shape.map(f64::from);
    let turn = DQuat::from_xyzw(v[3], v[4], v[5], v[6]).normalize().conjugate();
    let to_sphere = |p: DVec3| (turn * p) / DVec3::new(v[7], v[8], v[9]);
    let center = to_sphere(DVec3::new(v[0], v[1], v[2]));
    let mut hits = 0u32;
    Stream::new(1, "ellipsoid_monte_carlo").visit(0, count, |_, draw| {
        // The ray t d meets the unit sphere about `center` where the quadratic in t has a positive root.
        let d = to_sphere(draw.direction());
        let along = d.dot(center);
        hits +=
            u32::from(along > 0.0 && along * along >= d.length_squared() * (center.length_squared() - 1.0));
    });
    let share = f64::from(hits) / count as f64;
    (4.0 * PI * share, 4.0 * PI * (share * (1.0 - share) / count as f64).sqrt())
}

#[allow(dead_code, reason = "tests take the functions above")]
fn main() {
    println!("shape   ellipsoid      its ellipse    4 000 000 directions   standard errors off");
    for (name, shape) in &SHAPES {
        let [own, ellipse] = closed_forms(shape);
        let (counted, error) = counted(shape, 4_000_000);
        println!(
            "{name:6}  {own:.9}    {ellipse:.9}    {counted:.6} +- {error:.6}    {:+.2}",
            (counted - own) / error
        );
    }
}
