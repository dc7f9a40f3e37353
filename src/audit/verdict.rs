//! What a comparison says.

use serde::{Deserialize, Serialize};

/// The verdict on one configuration, in ascending order of gravity; the gravest of all outputs counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every output within its tolerance.
    Ok,
    /// The specification of the device promises nothing for these inputs: any answer will do.
    Unspecified,
    /// Beyond the tolerance, but no further than rounding the inputs, or flushing subnormal ones, would explain: the
    /// problem's fault.
    IllConditioned,
    /// Beyond the tolerance: the variant's fault.
    Inaccurate,
    /// Axes that ought to be orthogonal are not.
    NotOrthogonal,
    /// A box that does not enclose what it must.
    NotEnclosing,
    /// A direction whose length is not 1.
    NotUnit,
    /// A value of the wrong sign, such as a negative length or solid angle.
    WrongSign,
    /// A share of the whole that is negative or above all there is; a solid angle above 4 pi.
    OutOfRange,
    /// A miss for a hit, or a hit for a miss, and further from the border than rounding the inputs would explain.
    Missed,
    /// NaN or infinite where the truth is a finite f32.
    NonFinite,
}

impl Verdict {
    /// Every verdict, ascending.
    pub const ALL: [Verdict; 11] = [
        Verdict::Ok,
        Verdict::Unspecified,
        Verdict::IllConditioned,
        Verdict::Inaccurate,
        Verdict::NotOrthogonal,
        Verdict::NotEnclosing,
        Verdict::NotUnit,
        Verdict::WrongSign,
        Verdict::OutOfRange,
        Verdict::Missed,
        Verdict::NonFinite,
    ];

    /// Its name in records and tables: `ill_conditioned`.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Ok => "ok",
            Verdict::Unspecified => "unspecified",
            Verdict::IllConditioned => "ill_conditioned",
            Verdict::Inaccurate => "inaccurate",
            Verdict::NotOrthogonal => "not_orthogonal",
            Verdict::NotEnclosing => "not_enclosing",
            Verdict::NotUnit => "not_unit",
            Verdict::WrongSign => "wrong_sign",
            Verdict::OutOfRange => "out_of_range",
            Verdict::Missed => "missed",
            Verdict::NonFinite => "non_finite",
        }
    }

    /// Whether the variant, not the problem, is to blame.
    pub fn is_failure(self) -> bool {
        self > Verdict::IllConditioned
    }
}
