//! Numbers from the sources that must come out: the examples' own functions, at sizes that a test can afford.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[path = "../examples/cube_face.rs"]
mod cube_face;
#[path = "../examples/ellipsoid_monte_carlo.rs"]
mod ellipsoid_monte_carlo;
#[path = "../examples/ndf_shadowing.rs"]
#[allow(dead_code, reason = "the picture is the example's")]
mod ndf_shadowing;
#[path = "../examples/orthographic_disk.rs"]
mod orthographic_disk;
#[path = "../examples/solid_angle_test_cases.rs"]
mod solid_angle_test_cases;

/// How far off 4 pi/6 a face of 64 x 64 may be, relatively; `None` where the errors of its pixels bound nothing.
fn face_tolerance(variant: &str) -> Option<f64> {
    let tolerance = match variant {
        // An arctangent of the device, off by 2e-5 of a small angle on lavapipe.
        "oosterom" => 3e-5,
        // Four arctangents of up to 1, each off by as much, which telescope to those along the face's rim.
        "four_atan" | "four_atan_arctangent" => 1e-4,
        // Six angles of about a right one for each of 4096 pixels, each off by up to 5e-5 with the device's acos or
        // atan: if all are off to one side, half of the face.
        "girard" | "girard_atan2" => return None,
        // A sixth of side^2 at the middle of the face, less towards its corners: (1/32)^2/4 at most.
        "midpoint" => 2.5e-4,
        // The fourth power of the side.
        "gauss2" => 1e-6,
        // A dozen roundings, all their errors of one sign.
        _ => 1e-6,
    };
    Some(tolerance)
}

#[test]
fn a_cubes_face_is_a_sixth_of_the_sphere() {
    let sums = cube_face::sums(Some("llvmpipe"), 64).unwrap();
    assert!(sums.len() > 8);
    for (name, sum) in sums {
        let off = (sum / cube_face::FACE - 1.0).abs();
        if name == "as_printed" {
            // The bars round the primitive turn two quadrants' signs.
            assert!(off > 0.9, "{name}: {sum}");
        } else if let Some(tolerance) = face_tolerance(&name) {
            assert!(off <= tolerance, "{name}: {sum}, off by {off:e}");
        } else {
            assert!(sum.is_finite(), "{name}: {sum}");
        }
    }
}

#[test]
fn a_disk_is_a_cap() {
    use solid_angle_test_cases::{disk_of_pixels, truth};
    for tangent in [0.125f32, 0.5, 0.875] {
        let expected = TAU * (1.0 - f64::from(tangent).atan().cos());
        let disk = truth("disk_solid_angle", &[tangent, 1.0]);
        let ellipse = truth("ellipse_solid_angle", &[0.0, 0.0, 1.0, 0.0, tangent, 0.0, -tangent, 0.0, 0.0]);
        // The expected value itself cancels by up to 1/(1 - cos) = 130.
        for value in [disk, ellipse] {
            assert!((value / expected - 1.0).abs() < 1e-13, "{tangent}: {value} {expected}");
        }
        // Counted by their middles: of the smallest disk's 490 pixels some ten are on the wrong side of its rim.
        let pixels = disk_of_pixels(f64::from(tangent), 200);
        assert!((pixels / expected - 1.0).abs() < 0.03, "{tangent}: {pixels} {expected}");
    }
}

#[test]
fn latitude_longitude_rectangles() {
    use solid_angle_test_cases::{sphere_of_cells, truth};
    let expected = (1f64.sin() - 0.25f64.sin()) * 2.5;
    let cell = truth("latlong_solid_angle", &[0.25, 1.0, -0.5, 2.0]);
    assert!((cell / expected - 1.0).abs() < 1e-14, "{cell} {expected}");
    // Neighbours share their rounded sides, so that only the outermost are off, by 3e-8 of their longitude.
    let sphere = sphere_of_cells(45);
    assert!((sphere / (4.0 * PI) - 1.0).abs() < 6e-8, "{sphere}");
}

#[test]
fn ellipsoids_are_their_ellipses_and_what_is_counted() {
    for (name, shape) in &ellipsoid_monte_carlo::SHAPES {
        let [own, ellipse] = ellipsoid_monte_carlo::closed_forms(shape);
        // The ellipse is rounded to f32.
        assert!((ellipse / own - 1.0).abs() < 1e-6, "{name}: {own} {ellipse}");
        let (counted, error) = ellipsoid_monte_carlo::counted(shape, 400_000);
        // Four standard errors: one seed in 16 000 misses, and this seed is fixed.
        assert!((counted - own).abs() < 4.0 * error, "{name}: {own} {counted} +- {error}");
    }
}

/// The solid angle, times sqrt(n), of what lies inside the circle in pixels that the circle cuts.
///
/// Where the rim's normal is (c, s), a point at depth t below it lies in a cut pixel if the pixel's far corner, a and b
/// pixels away, is beyond: t < (a c + b s)/n. At depth t the density is 1/sqrt(2 t), whose integral is sqrt(2 t). With a
/// and b uniform in 0..1 the mean of sqrt(a c + b s) is 4/15 ((c + s)^2.5 - c^2.5 - s^2.5)/(c s); the rest is the integral
/// along the rim, by midpoints.
fn boundary_loss() -> f64 {
    const STEPS: u32 = 10_000;
    let mean = |step: u32| {
        let (s, c) = ((f64::from(step) + 0.5) / f64::from(STEPS) * FRAC_PI_2).sin_cos();
        4.0 / 15.0 * ((c + s).powf(2.5) - c.powf(2.5) - s.powf(2.5)) / (c * s)
    };
    2f64.sqrt() * FRAC_PI_2 * (0..STEPS).map(mean).sum::<f64>() / f64::from(STEPS)
}

/// What whole pixels lose is the boundary.
#[test]
fn the_orthographic_quarter_disk() {
    for size in [100, 400, 1_000] {
        let sums = orthographic_disk::sums(size);
        // Rounding of the primitive, 1e-16 a pixel.
        assert!((sums.clipped - FRAC_PI_2).abs() < 1e-10, "{size}: {sums:?}");
        assert!(sums.published <= sums.inside + 1e-10 && sums.inside < FRAC_PI_2, "{size}: {sums:?}");
        let [out, on] = [false, true].map(|on_circle| orthographic_disk::whole_pixels(size, on_circle));
        assert!((out - 1e-10..=on + 1e-10).contains(&sums.published), "{size}: {out} {on} {sums:?}");
        let found = FRAC_PI_2 - sums.inside;
        let root = f64::from(size).sqrt();
        let lost = boundary_loss() / root;
        // Corners are not uniform where the rim stays within a pixel, for an angle of sqrt(2/n) at either axis: sqrt(8/n)
        // of pi/2; half of what is lost there is allowed for.
        assert!((found / lost - 1.0).abs() < 0.9 / root, "{size}: {found} lost for {lost}, {sums:?}");
    }
    let [out, on] = [false, true].map(|on_circle| orthographic_disk::whole_pixels(10_000, on_circle));
    assert!(out < orthographic_disk::PRINTED && orthographic_disk::PRINTED < on, "{out} {on}");
    assert!((on - 1.553_605).abs() < 1e-6, "{on}");
}

#[test]
fn shadowing_from_an_image_is_smiths() {
    let alpha = 0.6;
    let image = ndf_shadowing::ndf_image(alpha, 200);
    for cos_theta in [1.0, 0.8, 0.5, 0.3, 0.1] {
        let (found, smith) = (
            ndf_shadowing::shadowing(&image, ndf_shadowing::direction(cos_theta)),
            ndf_shadowing::smith(alpha, cos_theta),
        );
        // Pixels of 1/100: D at the middle for D over a pixel.
        assert!((found - smith).abs() < 2e-3, "{cos_theta}: {found} {smith}");
    }
}
