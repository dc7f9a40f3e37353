//! NaN, infinity and the sign of zero: expressions and what came out of them.

use serde::{Deserialize, Serialize};

use super::kernels::{Error, Source, run};
use crate::catalog::Type;
use crate::device::Device;

/// One expression and its value on the device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// As in GLSL: `min(NaN, 1)`.
    pub expression: String,
    /// `NaN`, `inf`, `-0`, `true` or a number.
    pub value: String,
    /// IEEE 754's answer, or that of minimumNumber and maximumNumber; the device need not give it.
    pub ieee: String,
}

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;

const ARITHMETIC: Source = Source {
    function: "arithmetic",
    text: include_str!("kernels/arithmetic.comp"),
    inputs: &[("a", Type::Float), ("b", Type::Float)],
    results: &["sum", "difference", "product", "quotient"],
};
const SPECIAL: Source = Source {
    function: "special",
    text: include_str!("kernels/special.comp"),
    inputs: &[("x", Type::Float), ("y", Type::Float)],
    results: &["least", "largest", "clamped", "equal", "unequal", "less", "is_nan", "is_inf"],
};
const FUNCTIONS: Source = Source {
    function: "functions",
    text: include_str!("kernels/functions.comp"),
    inputs: &[("x", Type::Float)],
    results: &["root", "inverse", "logarithm", "exponential"],
};

/// Kernel, operands, which result, how it is written, and IEEE's answer.
struct Question {
    kernel: &'static Source,
    operands: [f32; 2],
    result: usize,
    expression: &'static str,
    ieee: &'static str,
}

const fn question(
    kernel: &'static Source,
    operands: [f32; 2],
    result: usize,
    expression: &'static str,
    ieee: &'static str,
) -> Question {
    Question { kernel, operands, result, expression, ieee }
}

const QUESTIONS: [Question; 27] = [
    question(&SPECIAL, [NAN, NAN], 3, "NaN == NaN", "false"),
    question(&SPECIAL, [NAN, NAN], 4, "NaN != NaN", "true"),
    question(&SPECIAL, [NAN, 1.0], 5, "NaN < 1", "false"),
    question(&SPECIAL, [NAN, 1.0], 6, "isnan(NaN)", "true"),
    question(&SPECIAL, [INF, 1.0], 6, "isnan(inf)", "false"),
    question(&SPECIAL, [INF, 1.0], 7, "isinf(inf)", "true"),
    question(&SPECIAL, [NAN, 1.0], 0, "min(NaN, 1)", "1"),
    question(&SPECIAL, [1.0, NAN], 0, "min(1, NaN)", "1"),
    question(&SPECIAL, [NAN, 1.0], 1, "max(NaN, 1)", "1"),
    question(&SPECIAL, [1.0, NAN], 1, "max(1, NaN)", "1"),
    question(&SPECIAL, [NAN, 1.0], 2, "clamp(NaN, 0, 1)", "0"),
    question(&SPECIAL, [0.0, -0.0], 3, "0 == -0", "true"),
    question(&ARITHMETIC, [1.0, 0.0], 3, "1 / 0", "inf"),
    question(&ARITHMETIC, [1.0, -0.0], 3, "1 / -0", "-inf"),
    question(&ARITHMETIC, [0.0, 0.0], 3, "0 / 0", "NaN"),
    question(&ARITHMETIC, [1.0, INF], 3, "1 / inf", "0"),
    question(&ARITHMETIC, [INF, INF], 1, "inf - inf", "NaN"),
    question(&ARITHMETIC, [0.0, INF], 2, "0 * inf", "NaN"),
    question(&ARITHMETIC, [f32::MAX, f32::MAX], 0, "largest + largest", "inf"),
    question(&ARITHMETIC, [0.0, -1.0], 2, "0 * -1", "-0"),
    question(&ARITHMETIC, [-0.0, 0.0], 0, "-0 + 0", "0"),
    question(&FUNCTIONS, [-0.0, 0.0], 0, "sqrt(-0)", "-0"),
    question(&FUNCTIONS, [-1.0, 0.0], 0, "sqrt(-1)", "NaN"),
    question(&FUNCTIONS, [0.0, 0.0], 1, "inversesqrt(0)", "inf"),
    question(&FUNCTIONS, [0.0, 0.0], 2, "log(0)", "-inf"),
    question(&FUNCTIONS, [-1.0, 0.0], 2, "log(-1)", "NaN"),
    question(&FUNCTIONS, [1000.0, 0.0], 3, "exp(1000)", "inf"),
];

/// Results that are conditions.
fn is_condition(question: &Question) -> bool {
    question.kernel.function == SPECIAL.function && question.result >= 3
}

pub(super) fn observe<D: Device>(device: &D) -> Result<Vec<Observation>, Error> {
    let mut observations = Vec::new();
    for kernel in [&SPECIAL, &ARITHMETIC, &FUNCTIONS] {
        let asked: Vec<&Question> =
            QUESTIONS.iter().filter(|question| question.kernel.function == kernel.function).collect();
        let rows: Vec<f32> =
            asked.iter().flat_map(|question| &question.operands[..kernel.inputs.len()]).copied().collect();
        let columns = run(device, kernel, &rows)?;
        for (row, question) in asked.into_iter().enumerate() {
            let value = columns[question.result][row];
            observations.push(Observation {
                expression: question.expression.to_owned(),
                value: if is_condition(question) { (value != 0.0).to_string() } else { written(value) },
                ieee: question.ieee.to_owned(),
            });
        }
    }
    Ok(observations)
}

fn written(value: f32) -> String {
    if value.is_nan() { "NaN".to_owned() } else { value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The host follows IEEE 754, so what is expected can be had from it.
    #[test]
    fn expected_answers_are_the_host_s() {
        for Question { kernel, operands: [a, b], result, expression, ieee } in &QUESTIONS {
            let condition = |value: bool| value.to_string();
            let host = match (kernel.function, result) {
                ("special", 0) => written(a.min(*b)),
                ("special", 1) => written(a.max(*b)),
                ("special", 2) => written(f32::min(a.max(0.0), 1.0)),
                ("special", 3) => condition(a == b),
                ("special", 4) => condition(a != b),
                ("special", 5) => condition(a < b),
                ("special", 6) => condition(a.is_nan()),
                ("special", 7) => condition(a.is_infinite()),
                ("arithmetic", 0) => written(a + b),
                ("arithmetic", 1) => written(a - b),
                ("arithmetic", 2) => written(a * b),
                ("arithmetic", 3) => written(a / b),
                ("functions", 0) => written(a.sqrt()),
                ("functions", 1) => written(1.0 / a.sqrt()),
                ("functions", 2) => written(a.ln()),
                _ => written(a.exp()),
            };
            assert_eq!(host, *ieee, "{expression}");
        }
    }
}
