//! Where quad lights stand: the distributions of `ltc_polygon`.

use glam::{DMat3, DVec3};

use super::super::problem::Scenario;
use crate::sample::{Draw, ggx, landmarks};

pub(super) const ALL: &[Scenario] = &[
    Scenario {
        name: "ggx",
        summary: "rectangles of 0.2 to 4 m over a floor, 0.3 to 8 m away, any direction; roughness 0.1 to 1, any view",
        draw: |draw, row| {
            let minv = any_material(draw);
            let mut centre = draw.log_uniform(0.3, 8.0) * draw.direction();
            centre.z = centre.z.abs();
            let quad = rectangle(draw, centre, 0.2, 4.0);
            store(row, minv, quad);
        },
    },
    Scenario {
        name: "grazing",
        summary: "view and light within 0.06 to 12 degrees of the surface, roughness 0.1 to 0.5",
        draw: |draw, row| {
            let minv = ggx::minv(draw.uniform(0.1, 0.5), draw.log_uniform(1e-3, 0.2));
            // Towards the mirror direction, -x, and up to 20 degrees either side of it.
            let (rise, side) = (draw.log_uniform(1e-3, 0.2), draw.uniform(-0.35, 0.35));
            let centre = draw.log_uniform(0.5, 20.0) * DVec3::new(-libm::cos(side), libm::sin(side), rise);
            let quad = rectangle(draw, centre, 0.2, 4.0);
            store(row, minv, quad);
        },
    },
    Scenario {
        name: "facing",
        summary: "a rectangle overhead, parallel to the surface, 0.05 to 20 sizes away",
        draw: |draw, row| {
            let minv = any_material(draw);
            let (cos, sin) = draw.angle();
            let (x, y) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
            let centre = DVec3::Z * draw.log_uniform(0.05, 20.0);
            let (half_x, half_y) = (draw.log_uniform(0.2, 1.0), draw.log_uniform(0.2, 1.0));
            store(row, minv, corners(centre, half_x * x, half_y * y));
        },
    },
    Scenario {
        name: "far",
        summary: "10 to 1e5 sizes away (log-uniform), any direction above the surface",
        draw: |draw, row| {
            let minv = any_material(draw);
            let distance = draw.log_uniform(0.5, 50.0);
            let mut centre = distance * draw.direction();
            centre.z = centre.z.abs();
            let size = distance / draw.log_uniform(10.0, 1e5);
            let quad = rectangle(draw, centre, 0.5 * size, size);
            store(row, minv, quad);
        },
    },
    Scenario {
        name: "near_plane",
        summary: "1e-7 to 1e-1 sizes (log-uniform) from the light's plane, within its outline, close by it or on it",
        draw: near_plane,
    },
    Scenario {
        name: "needle",
        summary: "rectangles of aspect 10 to 1e5 (log-uniform), 0.3 to 8 m away",
        draw: |draw, row| {
            let minv = any_material(draw);
            let mut centre = draw.log_uniform(0.3, 8.0) * draw.direction();
            centre.z = centre.z.abs();
            let frame = draw.frame();
            let long = draw.log_uniform(0.1, 4.0);
            let short = long / draw.log_uniform(10.0, 1e5);
            store(row, minv, corners(centre, long * frame.x_axis, short * frame.y_axis));
        },
    },
    Scenario {
        name: "horizon",
        summary: "rectangles that the horizon cuts, 0.5 to 8 m away",
        draw: |draw, row| {
            let minv = any_material(draw);
            let (cos, sin) = draw.angle();
            let distance = draw.log_uniform(0.5, 8.0);
            let frame = draw.frame();
            let x = draw.log_uniform(0.1, 2.0) * frame.x_axis;
            let y = draw.log_uniform(0.1, 2.0) * frame.y_axis;
            let reach = x.z.abs() + y.z.abs();
            let centre = DVec3::new(distance * cos, distance * sin, reach * draw.uniform(-1.0, 1.0));
            store(row, minv, corners(centre, x, y));
        },
    },
    Scenario {
        name: "inside_out",
        summary: "rectangles larger than their distance of 0.01 to 0.5 sizes, the point's projection within",
        draw: |draw, row| {
            let minv = any_material(draw);
            let frame = draw.frame();
            let (x, y) =
                (draw.log_uniform(0.5, 5.0) * frame.x_axis, draw.log_uniform(0.5, 5.0) * frame.y_axis);
            let height = draw.log_uniform(0.01, 0.5) * x.length().min(y.length());
            let centre =
                height * frame.z_axis + draw.uniform(-0.95, 0.95) * x + draw.uniform(-0.95, 0.95) * y;
            store(row, minv, corners(centre, x, y));
        },
    },
    Scenario {
        name: "edge",
        summary: "no area, corners together, at the point or on the horizon, edge-on, singular Minv, scales of 2^+-20",
        draw: edge,
    },
];

fn any_material(draw: &mut Draw) -> DMat3 {
    ggx::minv(draw.uniform(0.1, 1.0), draw.uniform(0.02, 1.0))
}

/// A rectangle of any orientation, its sides log-uniform.
fn rectangle(draw: &mut Draw, centre: DVec3, smallest: f64, largest: f64) -> [DVec3; 4] {
    let frame = draw.frame();
    let (x, y) = (draw.log_uniform(smallest, largest), draw.log_uniform(smallest, largest));
    corners(centre, 0.5 * x * frame.x_axis, 0.5 * y * frame.y_axis)
}

fn corners(centre: DVec3, x: DVec3, y: DVec3) -> [DVec3; 4] {
    [centre - x - y, centre + x - y, centre + x + y, centre - x + y]
}

fn store(row: &mut [f32], minv: DMat3, quad: [DVec3; 4]) {
    let values = minv.to_cols_array().into_iter().chain(quad.into_iter().flat_map(|p| p.to_array()));
    for (slot, value) in row.iter_mut().zip(values) {
        *slot = value as f32;
    }
}

fn near_plane(draw: &mut Draw, row: &mut [f32]) {
    let minv = any_material(draw);
    let frame = draw.frame();
    let (x, y) = (draw.log_uniform(0.1, 2.0), draw.log_uniform(0.1, 2.0));
    let height = draw.log_uniform(1e-7, 1e-1) * x.max(y);
    // In units of the half sides: within, outside by as much, and on an edge's line.
    let mut across = [draw.uniform(-1.5, 1.5), draw.uniform(-1.5, 1.5)];
    if draw.below(4) == 0 {
        across[draw.below(2) as usize] = draw.sign();
    }
    let (x, y) = (x * frame.x_axis, y * frame.y_axis);
    store(row, minv, corners(height * frame.z_axis + across[0] * x + across[1] * y, x, y));
}

fn edge(draw: &mut Draw, row: &mut [f32]) {
    let kind = draw.below(12);
    let minv = if draw.below(2) == 0 { DMat3::IDENTITY } else { any_material(draw) };
    let mut centre = draw.log_uniform(0.3, 8.0) * draw.direction();
    centre.z = centre.z.abs();
    let [a, b, c, d] = rectangle(draw, centre, 0.2, 4.0);
    let small = |draw: &mut Draw| f64::from(draw.below(17)) - 8.0;
    match kind {
        // No area: one point, a line there and back, a triangle with a corner twice.
        0 => store(row, minv, [a; 4]),
        1 => store(row, minv, [a, b, b, a]),
        2 => store(row, minv, [a, b, c, if draw.sign() > 0.0 { a } else { c }]),
        // A corner at the point; then an edge through it.
        3 => store(row, minv, [DVec3::ZERO, b - a, c - a, d - a]),
        4 => {
            let half = 0.5 * (b - a);
            store(row, minv, [-half, half, half + d - a, d - a - half]);
        }
        // In a plane through the point, exactly: integers in the plane of x = y, x = 0 or the horizon.
        5 | 6 => {
            let across = [DVec3::new(1.0, 1.0, 0.0), DVec3::Y, DVec3::X][draw.below(3) as usize];
            let up = if across == DVec3::X { DVec3::Y } else { DVec3::Z };
            let (i, j) = (small(draw), small(draw));
            let (width, height) = (1.0 + small(draw).abs(), 1.0 + small(draw).abs());
            store(row, minv, corners(i * across + j * up, width * across, height * up));
        }
        // Two corners exactly on the horizon, or all four of them below it.
        7 => store(
            row,
            minv,
            [a, b, c, d].map(|p| DVec3::new(p.x, p.y, if p.z > centre.z { p.z } else { 0.0 })),
        ),
        8 => store(row, DMat3::IDENTITY, [a, b, c, d].map(|p| DVec3::new(p.x, p.y, -p.z.abs()))),
        // The whole light at another scale, and Minv at yet another.
        9 | 10 => {
            let (scale, other) = (draw.uniform(-20.0, 20.0), draw.uniform(-20.0, 20.0));
            let scale = libm::exp2(libm::round(scale));
            store(row, minv * libm::exp2(libm::round(other)), [a, b, c, d].map(|p| scale * p));
        }
        // A singular Minv, and one size at a landmark of f32.
        _ => {
            if draw.below(2) == 0 {
                let flat = DMat3::from_cols(minv.x_axis, minv.x_axis, minv.z_axis);
                store(row, flat, [a, b, c, d]);
            } else {
                let mut size =
                    [draw.log_uniform(0.1, 10.0), draw.log_uniform(0.1, 10.0), draw.log_uniform(0.1, 10.0)];
                // No subnormals: a device may flush them, and an infinite plane overhead would be at the horizon.
                let landmark = landmarks::near_landmark(draw);
                size[draw.below(3) as usize] =
                    if landmark.is_subnormal() { 0.0 } else { f64::from(landmark) };
                let [x, y, height] = size;
                store(row, DMat3::IDENTITY, corners(DVec3::Z * height, DVec3::X * x, DVec3::Y * y));
            }
        }
    }
}
