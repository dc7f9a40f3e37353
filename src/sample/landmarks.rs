//! Landmark values of f32 and their floating-point neighbours.

use super::Draw;

/// How many neighbours each side of a landmark are in reach.
pub const NEIGHBOURS: u32 = 100;

/// Values around which f32 code changes its behaviour: zero, one, domain ends, the subnormal boundary, powers of two.
pub const LANDMARKS: [f32; 15] = [
    0.0,
    1.0,
    0.5,
    2.0,
    f32::EPSILON,
    1e-7,
    1e-4,
    1e-3,
    f32::MIN_POSITIVE,
    // 2^-63 and 2^63: their squares are at the ends of the normal range; 2^-31 and 2^31: fourth powers.
    1.084_202_2e-19,
    9.223_372e18,
    4.656_613e-10,
    2_147_483_648.0,
    1e-20,
    1e10,
];

/// A landmark of either sign or one of its [`NEIGHBOURS`] either side; never infinite.
pub fn near_landmark(draw: &mut Draw) -> f32 {
    let landmark = draw.pick(&LANDMARKS);
    let offset = i64::from(draw.below(2 * NEIGHBOURS + 1)) - i64::from(NEIGHBOURS);
    let value = neighbour(landmark, offset);
    if draw.sign() < 0.0 { -value } else { value }
}

/// The f32 that is `offset` representable values above `value` (below if negative); zero has one neighbour each side.
pub fn neighbour(value: f32, offset: i64) -> f32 {
    let ordered = |bits: u32| {
        let magnitude = i64::from(bits & 0x7fff_ffff);
        if bits >> 31 == 1 { -magnitude } else { magnitude }
    };
    let limit = i64::from(f32::MAX.to_bits());
    let target = (ordered(value.to_bits()) + offset).clamp(-limit, limit);
    let magnitude = f32::from_bits(target.unsigned_abs() as u32);
    if target < 0 { -magnitude } else { magnitude }
}

/// Any f32 by its exponent; a quarter are 0.
#[cfg(test)]
pub fn any_exponent(draw: &mut Draw) -> f32 {
    // One variate for kind and exponent.
    let place = draw.uniform(0.0, 8.0);
    let size = libm::exp2(277.0 * (place - libm::floor(place)) - 149.0);
    match place as u8 {
        0 | 1 => 0.0,
        2 | 4 | 6 => -size as f32,
        _ => size as f32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_cross_zero_and_stop_at_the_largest() {
        assert_eq!(neighbour(1.0, 1), 1.0 + f32::EPSILON);
        assert_eq!(neighbour(1.0, -1), 1.0 - f32::EPSILON / 2.0);
        assert_eq!(neighbour(0.0, -1), -f32::from_bits(1));
        assert_eq!(neighbour(f32::from_bits(1), -2), -f32::from_bits(1));
        assert_eq!(neighbour(f32::MAX, 5), f32::MAX);
    }
}
