use proptest::prelude::*;

use super::*;
use crate::numeric::big::{self, Big};

const BITS: usize = 256;

type Wide = Ball<DoubleDouble>;

/// A number with exponents up to `shift`.
fn any<M: Middle>(shift: i64) -> impl Strategy<Value = (Ball<M>, Big)> {
    (-1.0..1.0f64, -shift..shift).prop_map(|(x, shift)| {
        let shift = shift as isize;
        (Ball::exact(x) << shift, big::rounded(&big::exact(x), BITS) << shift)
    })
}

fn big<M: Middle>(ball: Ball<M>) -> (Big, Big) {
    let shift = STEP * ball.steps as isize;
    let (high, low) = (ball.high(), (ball.middle - M::from(ball.high())).to_f64());
    let middle = big::rounded(&(big::exact(high) + big::exact(low)), BITS);
    (middle << shift, big::exact(ball.radius) << shift)
}

fn holds<M: Middle>(ball: Ball<M>, exact: &Big) -> bool {
    ball.radius == f64::INFINITY || big::abs(big(ball).0 - exact) <= big(ball).1
}

fn operations_hold<M: Middle>([(a, x), (b, y), (c, z)]: [(Ball<M>, Big); 3]) {
    assert!(holds(a + b, &(&x + &y)));
    assert!(holds(a * b, &(&x * &y)));
    // Operands that are off themselves.
    let (sum, product) = (a + b, a * b);
    let (exact_sum, exact_product) = (&x + &y, &x * &y);
    assert!(holds(sum - c, &(&exact_sum - &z)));
    assert!(holds(sum * product, &(&exact_sum * &exact_product)));
    if z != Big::ZERO {
        assert!(holds(sum / c, &(&exact_sum / &z)));
        assert!((sum / c).relative() < 1e-14 || sum.relative() > 1e-15);
    }
    let squares = &exact_product * &exact_product + &z * &z;
    assert!(holds((product * product + c * c).sqrt(), &squares.sqrt()));
    assert!(holds(product.hypot(c), &squares.sqrt()));
    assert!(holds(Ball::sum(&[1.0, -1e-30], 0.0) * a, &(&x * (Big::ONE + big::exact(-1e-30)))));
    assert!(a.partial_cmp(&b) == x.partial_cmp(&y));
}

/// The crate's own functions are the independent arithmetic.
fn functions_hold<M: Middle>(y: f64, x: f64, shift: isize, off: f64) {
    // Known to a part, the truth being at one end of it.
    let blurred = |v: f64| {
        let end = big::exact(v) + big::exact(off) * big::exact(v);
        (Ball::<M>::within(v, off * v.abs()), big::rounded(&end, BITS))
    };
    let ((b, y), (a, x)) = (blurred(y), blurred(x));
    let (b, y) = (b << shift, y << shift);
    let pi = Big::pi(BITS);
    assert!(holds(b.angle(a), &big::angle(&y, &x, &pi)));
    let (square, big_square) = (b * b, &y * &y);
    assert!(holds(square.asinh_over_root(), &big::asinh_over(&big_square, BITS)));
    if y > Big::ZERO && x != Big::ZERO {
        assert!(holds(square.angle_over_root(a), &(big::angle(&y, &x, &pi) / &y)));
    }
}

proptest! {
    /// Far beyond f64's exponents, and within them, down to where they end.
    #[test]
    fn results_are_within_the_radius(
        wide in [any::<DoubleDouble>(2000), any(2000), any(2000)],
        near in [any::<f64>(100), any(100), any(100)],
        low in [any::<f64>(530), any(530), any(530)],
    ) {
        operations_hold(wide);
        operations_hold(near);
        let [(a, x), (b, y), (c, z)] = low;
        prop_assert!(holds(a * b, &(&x * &y)) && holds(a * b * c, &(&x * &y * &z)));
        prop_assert!(holds(a.hypot(b), &(&x * &x + &y * &y).sqrt()));
        if y != Big::ZERO {
            prop_assert!(holds(a * c / b, &(&x * &z / &y)));
        }
    }

    /// Close exponents, where angles are of any size, without errors of the operands and with them.
    #[test]
    fn functions_are_within_the_radius(
        y in 0.0..1.0f64,
        x in -1.0..1.0f64,
        shift in -60..60isize,
        off in 0.0..1e-3f64,
    ) {
        for off in [0.0, off] {
            functions_hold::<f64>(y, x, shift, off);
            functions_hold::<DoubleDouble>(y, x, shift, off);
        }
    }
}

#[test]
fn what_is_unknown_stays_so() {
    let around_zero = Wide::exact(1.0) - Wide::exact(1.0) * Wide::within(1.0, EPS);
    assert!(!(around_zero > Wide::ZERO) && !(around_zero <= Wide::ZERO) && around_zero != Wide::ZERO);
    assert!((Wide::ONE / around_zero).relative() == f64::INFINITY);
    assert!(Wide::exact(f64::NAN).relative() == f64::INFINITY);
    let root = around_zero.sqrt();
    assert!(root.largest() > Wide::exact(1e-9) && !(root > Wide::ZERO));
    // Whatever it meets, and however far apart.
    let unknown = Wide::ONE / around_zero;
    for other in [Wide::ZERO, Wide::ONE, Wide::ONE << 2000, Wide::ONE >> 2000, around_zero, unknown] {
        for result in [unknown + other, other - unknown, unknown.hypot(other), (unknown + other).sqrt()] {
            assert!(
                result.relative() == f64::INFINITY && !(result < Wide::ONE << 3000),
                "{other:?}: {result:?}"
            );
        }
        let product = unknown * other;
        assert!(other.is_zero() || product.relative() == f64::INFINITY, "{product:?}");
        assert!(((Wide::ONE + unknown) * other).sqrt().relative() == f64::INFINITY || other.is_zero());
    }
    assert!(
        Wide::up_to(unknown).relative() == f64::INFINITY && unknown.largest().relative() == f64::INFINITY
    );
    assert!(Wide::ONE.widened(unknown.radius()).relative() == f64::INFINITY);
    // A radius far beyond the middle.
    let wide = Wide::ONE + Wide::up_to(Wide::ONE << 600);
    assert!(!((Wide::ONE << 900) + wide > (Wide::ONE << 900) - (Wide::ONE << 590)));
    // Infinitely many steps of exponents hold.
    let huge = (0..40).fold(Wide::exact(3.0), |x, _| x * x);
    assert!((huge / huge - Wide::ONE).largest() < Wide::exact(1e-3), "{huge:?}");
    assert_eq!((huge.value(), (Wide::ONE / huge).value()), (f64::INFINITY, 0.0));
}

#[test]
fn the_better_of_two_is_taken() {
    let (good, bad) = (Wide::within(1e-30, 1e-46), Wide::within(0.0, 1e-20));
    assert_eq!(good.or(bad).value(), 1e-30);
    assert_eq!(bad.or(good).value(), 1e-30);
}
