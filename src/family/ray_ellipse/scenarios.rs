//! Rays at elliptic lights.

use glam::{DMat3, DVec3};

use crate::family::Scenario;
use crate::sample::{Draw, landmarks};

pub(super) const ALL: &[Scenario] = &[
    Scenario {
        name: "scene",
        summary: "elliptic lights of 5 cm to 5 m within 10 m, axes 1:1 to 5:1, rays from 0.3 to 20 m aimed within 1.5 radii, a tenth away",
        draw: |draw, row| {
            let ellipse = light(draw);
            let (direction, distance) = (draw.direction(), draw.log_uniform(0.3, 20.0));
            let away = draw.below(10) == 0;
            let place = around(draw, 0.0, 1.5);
            aim(&ellipse, place, if away { -distance } else { distance }, direction, row);
        },
    },
    Scenario {
        name: "border",
        summary: "as scene, aimed at radius 1 +- log-uniform 2^-26..2^-4",
        draw: |draw, row| {
            let ellipse = light(draw);
            let (direction, distance) = (draw.direction(), draw.log_uniform(0.3, 20.0));
            let radius = 1.0 + draw.sign() * draw.log_uniform(libm::exp2(-26.0), 0.0625);
            let place = around(draw, radius, radius);
            aim(&ellipse, place, distance, direction, row);
        },
    },
    Scenario {
        name: "grazing",
        summary: "as scene, sine of ray and plane log-uniform in 1e-7..1",
        draw: |draw, row| {
            let ellipse = light(draw);
            let sine = draw.log_uniform(1e-7, 1.0);
            let (cos, sin) = draw.angle();
            let along = cos * ellipse.u.normalize() + sin * ellipse.v.normalize();
            let direction = libm::sqrt(1.0 - sine * sine) * along + sine * ellipse.normal();
            let (distance, place) = (draw.log_uniform(0.3, 20.0), around(draw, 0.0, 1.5));
            aim(&ellipse, place, distance, direction, row);
        },
    },
    Scenario {
        name: "far",
        summary: "distance log-uniform in 1..1e6 radii, centre near the world's origin",
        draw: |draw, row| {
            let mut ellipse = light(draw);
            ellipse.centre = ellipse.u.length() * draw.direction();
            let distance = ellipse.u.length() * draw.log_uniform(1.0, 1e6);
            let (direction, place) = (draw.direction(), around(draw, 0.0, 1.5));
            aim(&ellipse, place, distance, direction, row);
        },
    },
    Scenario {
        name: "needle",
        summary: "any conjugate semi-axes of an ellipse of aspect log-uniform in 1..1e5",
        draw: |draw, row| {
            let ellipse = light(draw);
            let (length, aspect) = (ellipse.u.length(), draw.log_uniform(1.0, 1e5));
            let (a, b) = (ellipse.u, ellipse.v.normalize() * (length / aspect));
            let (cos, sin) = draw.angle();
            let needle = Ellipse { u: cos * a + sin * b, v: cos * b - sin * a, ..ellipse };
            let (direction, distance) = (draw.direction(), draw.log_uniform(0.3, 20.0));
            let place = around(draw, 0.0, 1.5);
            aim(&needle, place, distance, direction, row);
        },
    },
    Scenario {
        name: "at_plane",
        summary: "origin log-uniform 1e-9..1 radii before or behind the plane: t near zero, of either sign",
        draw: |draw, row| {
            let ellipse = light(draw);
            let distance = draw.sign() * ellipse.u.length() * draw.log_uniform(1e-9, 1.0);
            let (direction, place) = (draw.direction(), around(draw, 0.0, 1.2));
            aim(&ellipse, place, distance, direction, row);
        },
    },
    Scenario {
        name: "scale",
        summary: "as scene, lengths times 2^-40..2^40 and directions times 2^-20..2^20: products of three leave f32",
        draw: |draw, row| {
            let ellipse = light(draw);
            let (direction, distance) = (draw.direction(), draw.log_uniform(0.3, 20.0));
            let place = around(draw, 0.0, 1.5);
            aim(&ellipse, place, distance, direction, row);
            let length = libm::exp2(draw.uniform(-40.0, 40.0)) as f32;
            let pace = libm::exp2(draw.uniform(-20.0, 20.0)) as f32;
            for (place, value) in row.iter_mut().enumerate() {
                *value *= if (3..6).contains(&place) { pace } else { length };
            }
        },
    },
    Scenario {
        name: "edge",
        summary: "parallel and in-plane rays, zero and parallel axes, zero directions, exact borders, landmark neighbours",
        draw: edge,
    },
];

struct Ellipse {
    centre: DVec3,
    u: DVec3,
    v: DVec3,
}

impl Ellipse {
    fn normal(&self) -> DVec3 {
        self.u.cross(self.v).normalize()
    }
}

/// An elliptic light with u, v its axes, u the longer.
fn light(draw: &mut Draw) -> Ellipse {
    let (radius, ratio) = (draw.log_uniform(0.05, 5.0), draw.uniform(0.2, 1.0));
    let frame: DMat3 = draw.frame();
    let centre = draw.uniform(0.0, 10.0) * draw.direction();
    Ellipse { centre, u: radius * frame.x_axis, v: radius * ratio * frame.y_axis }
}

/// lambda and gamma of a radius within these bounds.
fn around(draw: &mut Draw, from: f64, to: f64) -> (f64, f64) {
    let radius = if from < to { draw.uniform(from, to) } else { from };
    let (cos, sin) = draw.angle();
    (radius * cos, radius * sin)
}

/// A ray that reaches the place at this distance, up to its rounding.
fn aim(ellipse: &Ellipse, place: (f64, f64), distance: f64, direction: DVec3, row: &mut [f32]) {
    let Ellipse { centre, u, v } = ellipse;
    let origin = *centre + place.0 * *u + place.1 * *v - distance * direction;
    store(row, [origin, direction, *centre, *u, *v]);
}

fn store(row: &mut [f32], vectors: [DVec3; 5]) {
    for (slots, vector) in row.chunks_exact_mut(3).zip(vectors) {
        for (slot, value) in slots.iter_mut().zip(vector.to_array()) {
            *slot = value as f32;
        }
    }
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(11);
    if kind >= 8 {
        match kind {
            8 => row.fill_with(|| landmarks::near_landmark(draw)),
            9 => row.fill_with(|| (draw.sign() * draw.log_uniform(1e-15, 1e15)) as f32),
            // A direction so short that t leaves f32, or nearly.
            _ => {
                let ellipse = light(draw);
                let (direction, place) = (draw.direction(), around(draw, 0.0, 1.5));
                aim(&ellipse, place, 10.0, direction, row);
                let pace = libm::exp2(draw.uniform(-149.0, -100.0));
                row[3..6].iter_mut().for_each(|value| *value = (f64::from(*value) * pace) as f32);
            }
        }
        return;
    }
    // In the plane z = h of a table: all that is said to be exact is exact in f32.
    let half = |draw: &mut Draw| draw.sign() * libm::exp2(f64::from(draw.below(9)) - 4.0);
    let flat = |draw: &mut Draw| DVec3::new(draw.uniform(-2.0, 2.0), draw.uniform(-2.0, 2.0), 0.0);
    let mut centre = flat(draw);
    centre.z = half(draw);
    let (mut u, mut v) = (half(draw) * DVec3::X, half(draw) * DVec3::Y);
    let mut direction = -half(draw) * DVec3::Z;
    let mut origin = centre - draw.sign() * direction;
    match kind {
        0 => direction = DVec3::ZERO,
        1 => {
            let which = draw.below(3);
            if which != 1 {
                u = DVec3::ZERO;
            }
            if which != 0 {
                v = DVec3::ZERO;
            }
        }
        2 => v = half(draw) * u,
        // Parallel to the plane, outside of it and within it.
        3 => direction = flat(draw),
        4 => {
            direction = flat(draw);
            origin = centre + flat(draw);
        }
        // The border exactly, and next to it by a few spacings.
        5 | 6 => {
            centre = DVec3::new(0.0, 0.0, centre.z);
            origin = centre - direction + if kind == 5 { u } else { v };
        }
        // An origin on the ellipse: t = 0.
        _ => {
            direction = draw.direction();
            origin = centre;
        }
    }
    store(row, [origin, direction, centre, u, v]);
    if kind == 5 || kind == 6 {
        let place = kind as usize - 5;
        row[place] = landmarks::neighbour(row[place], i64::from(draw.below(9)) - 4);
    }
}
