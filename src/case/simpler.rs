//! Simpler configurations than a given one: what minimization tries.

use std::collections::BTreeSet;
use std::ops::Range;

use super::cost::cost;
use crate::catalog::{Signature, Type};

/// A configuration to try.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    pub values: Vec<f32>,
    pub cost: u64,
    /// The only component that differs, if there is only one.
    pub alone: Option<usize>,
}

/// The most candidates a step that change several components; those that change one are always all tried.
const SEVERAL: usize = 4096;

/// A parameter's type and its columns.
type Parameter = (Type, Range<usize>);

/// The columns of each parameter.
pub(super) fn parameters(signature: &Signature) -> Vec<Parameter> {
    let mut start = 0;
    let next = |field: &crate::catalog::Field| {
        let columns = start..start + field.ty.components();
        start = columns.end;
        (field.ty, columns)
    };
    signature.parameters.iter().map(next).collect()
}

/// Every candidate that is cheaper than `values`, each once, the cheapest first: among equals, the earlier one made.
pub(super) fn candidates(parameters: &[Parameter], values: &[f32]) -> Vec<Candidate> {
    let mut made = Made { from: values, limit: cost(values), seen: BTreeSet::new(), all: Vec::new() };
    for at in 0..values.len() {
        for value in simpler(values, at) {
            made.set(&[at], |_| value);
        }
    }
    let alone = made.all.len();
    sets(&mut made, parameters, values);
    scaled(&mut made, parameters, values);
    // A stable sort: order of making decides among equals.
    made.all[alone..].sort_by_key(|candidate| candidate.cost);
    made.all.truncate(alone + SEVERAL);
    made.all.sort_by_key(|candidate| candidate.cost);
    made.all
}

/// Values for one component.
fn simpler(values: &[f32], at: usize) -> Vec<f32> {
    let value = values[at];
    let mut simpler = vec![0.0, 1.0, -1.0, -value];
    simpler.extend(shorter(value));
    for other in values {
        simpler.extend([*other, -other]);
    }
    simpler
}

/// Shorter numbers near this one: powers of two, integers, few bits, few digits; each on both sides.
fn shorter(value: f32) -> Vec<f32> {
    let mut shorter = Vec::new();
    if value == 0.0 || !value.is_normal() {
        return shorter;
    }
    let wide = f64::from(value);
    for bits in 1..24 {
        let step = 1u64 << (53 - bits);
        let below = wide.to_bits() & !(step - 1);
        // Of a number as short as this, its neighbours.
        shorter.extend([below - step, below, below + step].map(|bits| f64::from_bits(bits) as f32));
    }
    shorter.extend([wide.trunc(), wide.round()].map(|value| value as f32));
    // Decimals are read from text, so that they are the nearest f32 to what is written.
    for digits in 0..7 {
        let text = format!("{value:.digits$e}");
        shorter.extend(text.parse::<f32>());
        if let Some((mantissa, power)) = text.split_once('e')
            && let Ok(mantissa) = mantissa.parse::<f64>()
        {
            let unit = 10f64.powi(-(digits as i32));
            for near in [mantissa - unit, mantissa + unit] {
                shorter.extend(format!("{near:.digits$}e{power}").parse::<f32>());
            }
        }
    }
    shorter
}

/// Changes of several components together.
fn sets(made: &mut Made<'_>, parameters: &[Parameter], values: &[f32]) {
    let all: Vec<usize> = (0..values.len()).collect();
    let mut sets: Vec<Vec<usize>> = vec![all.clone()];
    sets.extend(parameters.iter().map(|(_, columns)| columns.clone().collect()));
    // Halves, quarters and so on, as in delta debugging.
    let mut length = values.len() / 2;
    while length > 1 {
        sets.extend(all.chunks(length).map(<[usize]>::to_vec));
        length /= 2;
    }
    for first in 0..values.len() {
        // Components of one magnitude change together, lest a step undo what they have in common.
        sets.push(all.iter().copied().filter(|at| values[*at].abs() == values[first].abs()).collect());
        sets.extend((0..first).map(|second| vec![second, first]));
    }
    for set in &sets {
        made.set(set, |_| 0.0);
        made.set(set, |_| 1.0);
        made.set(set, |value| 1f32.copysign(value));
        made.set(set, f32::abs);
        made.set(set, |value| -value);
        for bits in [1, 2, 3, 4, 6, 8, 12] {
            made.set(set, |value| rounded(value, bits));
        }
        for digits in [0, 1, 2, 3] {
            made.set(set, |value| format!("{value:.digits$e}").parse().unwrap_or(value));
        }
        made.set(set, f32::round);
    }
    for set in &sets {
        let same = set.iter().all(|at| values[*at].abs() == values[set[0]].abs());
        if same && set.len() > 1 {
            for value in simpler(values, set[0]) {
                made.set(set, |old| value.abs().copysign(old));
            }
        }
    }
    for (ty, columns) in parameters {
        match ty {
            Type::Vec2 | Type::Vec3 | Type::Vec4 => axes(made, columns.clone(), values),
            Type::Mat3 => matrices(made, columns.start, values),
            Type::Float => {}
        }
    }
}

/// A vector along an axis, of its own length, of length 1, or what it has there.
fn axes(made: &mut Made<'_>, columns: Range<usize>, values: &[f32]) {
    let length = columns.clone().map(|at| f64::from(values[at]).powi(2)).sum::<f64>().sqrt() as f32;
    for axis in columns.clone() {
        for size in [values[axis], 1.0, -1.0, length.copysign(values[axis]), rounded(length, 1)] {
            let mut changed = values.to_vec();
            changed[columns.clone()].fill(0.0);
            changed[axis] = size;
            made.add(changed);
        }
    }
}

/// The identity, the diagonal, the upper and the lower triangle.
fn matrices(made: &mut Made<'_>, start: usize, values: &[f32]) {
    let mut add = |keep: fn(usize, usize) -> bool, identity: bool| {
        let mut changed = values.to_vec();
        for at in 0..9 {
            let (column, row) = (at / 3, at % 3);
            if identity {
                changed[start + at] = if column == row { 1.0 } else { 0.0 };
            } else if !keep(column, row) {
                changed[start + at] = 0.0;
            }
        }
        made.add(changed);
    };
    add(|_, _| true, true);
    add(|column, row| column == row, false);
    add(|column, row| column >= row, false);
    add(|column, row| column <= row, false);
}

/// Everything, all parameters of one type, or one parameter, times a power of two so that its largest component is
/// 1 or a little more; and times every power of two from 1/16 to 16.
fn scaled(made: &mut Made<'_>, parameters: &[Parameter], values: &[f32]) {
    let mut sets: Vec<Vec<usize>> = vec![(0..values.len()).collect()];
    for ty in [Type::Float, Type::Vec2, Type::Vec3, Type::Vec4, Type::Mat3] {
        let of_type = parameters.iter().filter(|(own, _)| *own == ty);
        sets.push(of_type.flat_map(|(_, columns)| columns.clone()).collect());
    }
    sets.extend(parameters.iter().map(|(_, columns)| columns.clone().collect()));
    for set in sets {
        let largest = set.iter().map(|at| values[*at].abs()).fold(0.0, f32::max);
        if largest == 0.0 {
            continue;
        }
        let unit = -libm::ilogb(largest.into());
        for power in (-4..=4).chain([unit, unit - 1, unit + 1]) {
            made.set(&set, |value| libm::ldexp(value.into(), power) as f32);
        }
    }
}

/// The nearest number of so many significant bits.
fn rounded(value: f32, bits: u32) -> f32 {
    let step = 1u64 << (53 - bits);
    let wide = f64::from(value).to_bits();
    f64::from_bits((wide + step / 2) & !(step - 1)) as f32
}

/// Candidates made so far.
struct Made<'a> {
    from: &'a [f32],
    limit: u64,
    seen: BTreeSet<Vec<u32>>,
    all: Vec<Candidate>,
}

impl Made<'_> {
    /// With the components of `set` changed.
    fn set(&mut self, set: &[usize], change: impl Fn(f32) -> f32) {
        let mut changed = self.from.to_vec();
        for at in set {
            changed[*at] = change(changed[*at]);
        }
        self.add(changed);
    }

    /// Only if it is finite, cheaper, and new.
    fn add(&mut self, mut values: Vec<f32>) {
        for value in &mut values {
            // There is one zero.
            *value += 0.0;
        }
        let cost = cost(&values);
        if cost >= self.limit || values.iter().any(|value| !value.is_finite()) {
            return;
        }
        if self.seen.insert(values.iter().map(|value| value.to_bits()).collect()) {
            let differs = |at: &usize| values[*at].to_bits() != self.from[*at].to_bits();
            let mut differing = (0..values.len()).filter(differs);
            let alone = differing.next().filter(|_| differing.next().is_none());
            self.all.push(Candidate { values, cost, alone });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn round_numbers_are_among_what_is_tried() {
        let near = shorter(0.100_97);
        for expected in [0.1, 0.125, 0.0625, 0.101, 0.09375] {
            assert!(near.contains(&expected), "{expected} is not tried");
        }
        assert!(shorter(-2.7).contains(&-3.0) && shorter(-2.7).contains(&-2.0));
        assert_eq!((rounded(2.9, 1), rounded(3.1, 1), rounded(-0.3, 2)), (2.0, 4.0, -0.25));
    }

    #[test]
    fn vectors_are_turned_and_scaled_as_wholes() {
        let parameters = [(Type::Vec3, 0..3), (Type::Float, 3..4)];
        let tried = candidates(&parameters, &[26.0, -36.0, 6.0, 1.7]);
        let has = |values: [f32; 4]| tried.iter().any(|candidate| candidate.values == values);
        assert!(has([0.0, -36.0, 0.0, 1.7]) && has([0.0, 1.0, 0.0, 1.7]));
        assert!(has([0.812_5, -1.125, 0.1875, 1.7]), "scaled to unit size");
        assert!(has([0.0; 4]) && tried[0].values == [0.0; 4]);
    }

    proptest! {
        #[test]
        fn every_candidate_is_finite_cheaper_and_another(bits in proptest::array::uniform4(any::<u32>())) {
            let values = bits.map(f32::from_bits);
            prop_assume!(values.iter().all(|value| value.is_finite()));
            let tried = candidates(&[(Type::Vec3, 0..3), (Type::Float, 3..4)], &values);
            prop_assert!(tried.is_sorted_by_key(|candidate| candidate.cost));
            for candidate in tried {
                prop_assert!(candidate.cost < cost(&values) && candidate.cost == cost(&candidate.values));
                prop_assert!(candidate.values.iter().all(|value| value.is_finite()));
            }
        }
    }
}
