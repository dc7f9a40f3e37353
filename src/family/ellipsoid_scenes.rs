//! Ellipsoids to look at: the scenarios and landmarks of every problem whose input is one ellipsoid.

use glam::DVec3;

use super::problem::{Landmark, Scenario};
use crate::catalog::{Field, Type};
use crate::numeric::exact3;
use crate::numeric::spacing::UNIT_ROUNDOFF;
use crate::sample::{Draw, landmarks};

pub(super) const CENTER: usize = 0;
pub(super) const ROTATION: usize = 3;
pub(super) const RADIUS: usize = 7;
const COLUMNS: usize = 10;

pub(super) const INPUTS: &[Field] =
    &[Field::new("center", Type::Vec3), Field::new("rotation", Type::Vec4), Field::new("radius", Type::Vec3)];

pub(super) static SCENARIOS: &[Scenario] = &[
    Scenario {
        name: "scene",
        summary: "ellipsoids of 5 cm to 1 m, aspects to 4, 1.05 to 100 of their radii away, turned anyhow",
        draw: |draw, row| {
            let size = draw.log_uniform(0.05, 1.0);
            let radius = [(); 3].map(|()| size * draw.uniform(0.25, 1.0));
            place(draw, row, radius, 0.05, 99.0);
        },
    },
    Scenario {
        name: "sphere",
        summary: "spheres and, half of them, spheres squeezed by 1e-7..1e-2: circles, whose axes fade into rounding",
        draw: |draw, row| {
            let size = draw.log_uniform(0.05, 1.0);
            let round = draw.sign() > 0.0;
            let radius = [(); 3].map(|()| {
                let squeeze = draw.log_uniform(1e-7, 1e-2);
                if round { size } else { size * (1.0 - squeeze) }
            });
            place(draw, row, radius, 0.05, 99.0);
        },
    },
    Scenario {
        name: "flat",
        summary: "aspects to 1000: discs and rods, 1.1 to 20 radii away",
        draw: |draw, row| {
            let radius = [(); 3].map(|()| draw.log_uniform(1e-3, 1.0));
            place(draw, row, radius, 0.1, 19.0);
        },
    },
    Scenario {
        name: "far",
        summary: "10 to 1e5 radii away, aspects to 4",
        draw: |draw, row| {
            let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
            place(draw, row, radius, 9.0, 1e5);
        },
    },
    Scenario {
        name: "near_surface",
        summary: "the point 1e-5 to 0.1 of a radius off the surface, aspects to 4",
        draw: |draw, row| {
            let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
            place(draw, row, radius, 1e-5, 0.1);
        },
    },
    Scenario {
        name: "edge",
        summary: "from inside, zero semi-axes, no rotation, turns by 90 degrees, quaternions of any length, any scale, landmarks",
        draw: edge,
    },
];

pub(super) static LANDMARKS: &[Landmark] = &[
    Landmark {
        name: "aspect",
        summary: "longest over shortest semi-axis",
        edges: &[1.0 + 1e-6, 1.001, 1.1, 2.0, 4.0, 10.0, 1e2, 1e3],
        coordinate: |input, _| {
            let radius = exact3::vector(&input[RADIUS..]).abs();
            radius.max_element() / radius.min_element()
        },
    },
    Landmark {
        name: "distance",
        summary: "distance of the centre over the longest semi-axis",
        edges: &[0.3, 1.0, 1.1, 2.0, 10.0, 1e2, 1e3, 1e4],
        coordinate: |input, _| {
            let radius = exact3::vector(&input[RADIUS..]).abs();
            exact3::vector(&input[CENTER..]).length() / radius.max_element()
        },
    },
];

fn store(row: &mut [f32], center: DVec3, rotation: [f64; 4], radius: [f64; 3]) {
    let values = center.to_array().into_iter().chain(rotation).chain(radius);
    for (slot, value) in row[..COLUMNS].iter_mut().zip(values) {
        *slot = value as f32;
    }
}

/// A uniform rotation as a unit quaternion.
fn turn(draw: &mut Draw) -> [f64; 4] {
    let share = draw.unit();
    let ((c1, s1), (c2, s2)) = (draw.angle(), draw.angle());
    let (a, b) = (libm::sqrt(1.0 - share), libm::sqrt(share));
    [a * c1, a * s1, b * c2, b * s2]
}

/// An ellipsoid turned anyhow; |D^-1 R^T c|, which is 1 on the surface, is 1 + log-uniform `near`..`far`.
fn place(draw: &mut Draw, row: &mut [f32], radius: [f64; 3], near: f64, far: f64) {
    let rotation = turn(draw);
    let direction = draw.direction();
    let off = 1.0 + draw.log_uniform(near, far);
    let center = glam::DQuat::from_array(rotation) * (off * direction * DVec3::from_array(radius));
    store(row, center, rotation, radius);
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(10);
    let (rotation, direction) = (turn(draw), draw.direction());
    let radius = [(); 3].map(|()| draw.uniform(0.25, 1.0));
    let identity = [0.0, 0.0, 0.0, 1.0];
    match kind {
        // Inside; then on the surface, as near as rounding comes.
        0 => store(row, 0.2 * draw.unit() * direction, rotation, radius),
        1 => {
            let off = 1.0 + draw.sign() * draw.log_uniform(0.25 * UNIT_ROUNDOFF, 1e-5);
            store(row, off * direction * DVec3::from_array(radius), identity, radius);
        }
        2 => store(row, 2.0 * direction, rotation, [radius[0], radius[1], 0.0]),
        3 => store(row, 2.0 * direction, rotation, draw.pick(&[[radius[0], 0.0, 0.0], [0.0; 3]])),
        4 => store(row, 2.0 * direction, [0.0; 4], radius),
        5 => {
            let (half, sign) = (core::f64::consts::FRAC_1_SQRT_2, draw.sign());
            let turns =
                [[half, 0.0, 0.0, half], [0.0, sign, 0.0, 0.0], [0.5, 0.5, 0.5, sign * 0.5], identity];
            store(row, 2.0 * direction, draw.pick(&turns), radius);
        }
        6 => {
            let scale = draw.log_uniform(1e-6, 1e6);
            store(row, 2.0 * direction, rotation.map(|q| q * scale), radius);
        }
        7 => {
            let scale = libm::exp2(f64::from(draw.below(61)) - 30.0);
            store(row, 2.0 * scale * direction, rotation, radius.map(|r| r * scale));
        }
        // Along an axis of a body of revolution: an exact circle.
        8 => {
            let axis = draw.pick(&[DVec3::X, DVec3::Y, DVec3::Z]);
            let squeezed = DVec3::splat(radius[0]) + (radius[1] - radius[0]) * axis;
            store(row, 4.0 * axis, identity, squeezed.to_array());
        }
        _ => {
            store(row, 2.0 * direction, rotation, radius);
            let column = draw.below(COLUMNS as u32) as usize;
            // Squares of what is smaller or larger leave the range of the others.
            row[column] = landmarks::near_landmark(draw).clamp(-1e10, 1e10);
        }
    }
}
