//! The test cases that a page on the solid angle of a pixel proposes: a disk one unit away covers 2 pi (1 - cos theta), and a
//! rectangle of latitude and longitude (sin lat1 - sin lat0)(lon1 - lon0). `cargo run --release --example solid_angle_test_cases`
//!
//! Each by this library's oracles, which share no formula with those, and by a sum over many small parts.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use rootq::family::{Truth, find};
use rootq::numeric::plane_rectangle;

/// The first value of a family's oracle.
pub(crate) fn truth(family: &str, input: &[f32]) -> f64 {
    let problem = find(family).expect("a family of this library");
    let mut truth = Truth::new(problem.outputs());
    problem.oracle(input, &mut truth);
    truth.values()[0]
}

/// The disk of radius `tangent` on the plane z = 1, as pixels of a cube's face of `size` x `size` whose middle lies in it.
pub(crate) fn disk_of_pixels(tangent: f64, size: u32) -> f64 {
    let at = |k: f64| 2.0 * k / f64::from(size) - 1.0;
    let mut sum = 0.0;
    for y in (0..size).map(f64::from) {
        for x in (0..size).map(f64::from) {
            if at(x + 0.5).powi(2) + at(y + 0.5).powi(2) <= tangent * tangent {
                sum += plane_rectangle::solid_angle(at(x), at(y), at(x + 1.0), at(y + 1.0));
            }
        }
    }
    sum
}

/// The whole sphere in cells of latitude and longitude.
pub(crate) fn sphere_of_cells(rows: u32) -> f64 {
    let lat = |k: u32| (PI * f64::from(k) / f64::from(rows) - FRAC_PI_2) as f32;
    let lon = |k: u32| (PI * f64::from(k) / f64::from(rows) - PI) as f32;
    let cells = (0..rows).flat_map(|row| (0..2 * rows).map(move |column| (row, column)));
    cells
        .map(|(row, column)| {
            truth("latlong_solid_angle", &[lat(row), lat(row + 1), lon(column), lon(column + 1)])
        })
        .sum()
}

#[allow(dead_code, reason = "tests take the functions above")]
fn main() {
    println!("disk at distance 1     2 pi (1 - cos)   as a disk        as an ellipse    as pixels of a face");
    for tangent in [0.125f32, 0.5, 0.875] {
        let expected = TAU * (1.0 - f64::from(tangent).atan().cos());
        let disk = truth("disk_solid_angle", &[tangent, 1.0]);
        let ellipse = truth("ellipse_solid_angle", &[0.0, 0.0, 1.0, 0.0, tangent, 0.0, -tangent, 0.0, 0.0]);
        let pixels = disk_of_pixels(f64::from(tangent), 1000);
        println!("radius {tangent:5}           {expected:.12}   {disk:.12}   {ellipse:.12}   {pixels:.6}");
    }
    let (lat, lon) = ([0.25f32, 1.0], [-0.5f32, 2.0]);
    let expected = (f64::from(lat[1]).sin() - f64::from(lat[0]).sin()) * f64::from(lon[1] - lon[0]);
    let cell = truth("latlong_solid_angle", &[lat[0], lat[1], lon[0], lon[1]]);
    println!("latitudes {lat:?}, longitudes {lon:?}: {expected:.12} expected, {cell:.12}");
    println!("the sphere in 180 x 360 cells: {:.9}, 4 pi = {:.9}", sphere_of_cells(180), 4.0 * PI);
}
