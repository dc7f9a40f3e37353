//! The silhouette of a thin or distant cylinder, summed by differences.

use core::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{Derivatives, Piece, Silhouette};
use crate::numeric::double_double::Real;
use crate::numeric::slim_silhouette::{Arc, Generators, Pair, along_horizon};

/// A thin or distant cylinder, each of whose rims is above or below the horizon as a whole; at least one above.
pub(super) struct Slim {
    /// The visible parts of the rims that are above, with the signs of their t.
    arcs: [Option<(Arc, [f64; 2])>; 2],
    /// The generators' ends on each rim.
    corners: [Pair; 2],
    chord: DVec3,
}

impl Slim {
    pub(super) fn new(silhouette: &Silhouette<f64>, chord: DVec3) -> Option<Slim> {
        let &Silhouette { ref rims, gap, radius, place, length, touch: [cos, sin] } = silhouette;
        if !(gap > radius) {
            return None;
        }
        let (mut arcs, mut corners) = ([None; 2], [Pair { middle: DVec3::ZERO, half: DVec3::ZERO }; 2]);
        let angle = libm::atan2(sin, cos);
        let far = [place < 0.0, place > length];
        for rim in 0..2 {
            let [center, x, y] = [rims[rim].center, rims[rim].cos, rims[rim].sin].map(DVec3::from_array);
            corners[rim] = Pair { middle: center + cos * x, half: sin * y };
            let slope2 = x.z * x.z + y.z * y.z;
            if center.z * center.z <= slope2 {
                return None;
            }
            if center.z > 0.0 {
                let (side, half) = if far[rim] { (-1.0, PI - angle) } else { (1.0, angle) };
                let turn = if rim == 0 { 1.0 } else { -1.0 };
                arcs[rim] = Some((Arc::new(center, side * x, turn * y, half)?, [side, turn]));
            }
        }
        if arcs.iter().all(Option::is_none) {
            return None;
        }
        Some(Slim { arcs, corners, chord })
    }

    /// The irradiance, and what it is off by at the most for these corners and rims. Derivatives are collected as
    /// [`Silhouette::walk`] has them.
    ///
    /// 3 EPS of the sizes are promised: with what the inputs' own roundings add, errors against double-double were below
    /// 0.61 of the whole bound (400 000 cylinders, observed and not proved).
    pub(super) fn integrate(&self, derivatives: &mut Derivatives) -> (f64, f64) {
        let &Slim { ref arcs, corners, chord } = self;
        let (mut value, mut size, mut truncation) = (0.0, 0.0, 0.0);
        let frame = &derivatives.cylinder.frame;
        let (towards, across) = (DVec3::from_array(frame.towards), DVec3::from_array(frame.across));
        for (rim, arc) in arcs.iter().enumerate() {
            if let Some((arc, [side, turn])) = arc {
                let (part, [by, by_cos, by_sin]) = arc.integrate();
                value += part.value;
                size += part.size;
                truncation += arc.truncation;
                derivatives.derive(rim, by, [(*side * towards, by_cos), (*turn * across, by_sin)]);
            }
        }
        let nearest = corners.map(|pair| pair.middle.length());
        let nearer = if nearest[0] < nearest[1] { 0 } else { 1 };
        let normal =
            Pair { middle: corners[nearer].middle.cross(chord), half: corners[nearer].half.cross(chord) };
        let cancelled = nearest[nearer] * chord.length() / normal.middle.length();
        let [mut start, mut end] = corners;
        let (mut part, mut part_difference) = ([1.0; 2], 0.0);
        if let Some(below) = (0..2).find(|rim| arcs[*rim].is_none()) {
            // From the corners above, down the chord to the horizon.
            let above = corners[1 - below];
            let drop = -chord.z;
            let down = Pair {
                middle: above.middle + (above.middle.z / drop) * chord,
                half: above.half + (above.half.z / drop) * chord,
            };
            let sign = if below == 1 { 1.0 } else { -1.0 };
            part = above.ends().map(|corner| sign * corner.z / drop);
            part_difference = sign * 2.0 * above.half.z / drop;
            if below == 1 {
                end = down
            } else {
                start = down
            }
            let horizon = along_horizon(down);
            value += sign * horizon.value;
            // How far rounded heights move the crossings.
            let slide = (above.half.z / drop).abs() * chord.length() / down.half.length();
            size += horizon.size * (1.0 + slide + above.middle.length() / down.middle.length());
        }
        let sides = Generators { start, end, normal, part, part_difference, cancelled }.integrate();
        value += sides.value;
        size += sides.size;
        let [a, b] = corners.map(Pair::ends);
        derivatives.add(Piece::Generator { rims: [0, 1], sign: 1.0, ends: [a[0].into(), b[0].into()] });
        derivatives.add(Piece::Generator { rims: [1, 0], sign: -1.0, ends: [b[1].into(), a[1].into()] });
        ((value / TAU).abs().min(1.0), (3.0 * f64::ROUNDOFF * size + truncation) / TAU)
    }
}
