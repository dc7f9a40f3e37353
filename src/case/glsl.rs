//! A failure as one compute shader for a bug report.

use std::fmt::Write;

use super::evaluate::Answer;
use super::story::Story;
use crate::catalog::{self, Signature, Type, Variant};
use crate::family::Problem;
use crate::record::decimal_f32;

/// Why there is no GLSL of a failure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Impossible {
    #[error("it is not one of rootq's own functions; --amber exports its SPIR-V")]
    NoText,
    #[error("it reads tables, which a snippet cannot hold; --amber exports them where they are buffers")]
    Tables,
    #[error("what was made of it does not compile: {0}")]
    Broken(String),
}

/// The shader: the variant's function with what it includes, and a `main()` with the exact inputs that writes every output
/// column. Run on one workgroup, with a storage buffer of as many floats at set 0, binding 0.
pub fn snippet(
    problem: &dyn Problem,
    variant: Option<&Variant>,
    story: &Story,
    seen: &Answer,
) -> Result<String, Impossible> {
    let signature = problem.signature();
    let variant = variant.ok_or(Impossible::NoText)?;
    if !variant.tables.is_empty() {
        return Err(Impossible::Tables);
    }
    let function = variant.standalone(&signature).ok_or(Impossible::NoText)?;
    // The version must come first.
    let (version, function) = function.split_once('\n').unwrap_or((function.as_str(), ""));
    let mut text = format!("{version}\n");
    for line in words(story) {
        _ = writeln!(text, "// {line}");
    }
    if variant.precise {
        text.push_str("// rootq decorates every operation of this variant NoContraction, which GLSL cannot say of a whole shader.\n");
    }
    _ = write!(
        text,
        "//\n// Dispatch one workgroup, with a buffer of {} floats at set 0, binding 0.\n\n{function}\n",
        seen.outputs.len()
    );
    _ = write!(
        text,
        "layout(local_size_x = 1) in;\n\
         layout(std430, set = 0, binding = 0) writeonly buffer Outputs {{ float outputs[]; }};\n\n\
         void main()\n{{\n\
         \x20   // 0 in a dispatch of one workgroup, but no compiler knows: else it might evaluate all of this itself.\n\
         \x20   uint zero = gl_WorkGroupID.x;\n"
    );
    let mut inputs = story.inputs.iter();
    for parameter in &signature.parameters {
        let count = parameter.ty.components();
        let numbers: Vec<_> = inputs.by_ref().take(count).collect();
        let bits: Vec<String> =
            numbers.iter().map(|number| format!("uintBitsToFloat({}u ^ zero)", number.bits)).collect();
        let decimals: Vec<String> = numbers.iter().map(|number| decimal_f32(number.value)).collect();
        let ty = parameter.ty.glsl();
        _ = writeln!(
            text,
            "    {ty} {} = {ty}({}); // {}",
            parameter.name,
            bits.join(", "),
            decimals.join(", ")
        );
    }
    let arguments: Vec<&str> = signature.parameters.iter().map(|parameter| parameter.name).collect();
    _ = writeln!(
        text,
        "    {} result = {}({});",
        signature.result_type(),
        signature.function,
        arguments.join(", ")
    );
    for (column, value) in components(&signature).iter().enumerate() {
        _ = writeln!(
            text,
            "    outputs[{column}] = {value}; // {}: exactly {:.16e}, seen {} (0x{:08x})",
            story.truth.columns[column],
            story.truth.values[column],
            decimal_f32(seen.outputs[column]),
            seen.outputs[column].to_bits()
        );
    }
    text.push_str("}\n");
    catalog::compile_standalone(&text).map_err(Impossible::Broken)?;
    Ok(text)
}

/// What failed where, one line each.
pub(super) fn words(story: &Story) -> Vec<String> {
    let mut words = vec![
        format!("{}/{}: {}", story.family, story.variant, story.recorded.verdict.name()),
        format!("scenario {}, configuration {}; found by rootq", story.scenario, story.index),
    ];
    if let Some(device) = &story.recorded_on {
        words.push(format!("recorded on {device}"));
    }
    if let Some(fate) = story.fate {
        words.push(format!("on {} it {}", story.device, fate.words()));
    }
    // Names come from drivers and files: none may end a comment's line.
    words.iter().map(|line| line.replace(['\n', '\r', '\\'], " ")).collect()
}

/// The components of `result`, in column order.
fn components(signature: &Signature) -> Vec<String> {
    let mut values = Vec::new();
    for field in &signature.results {
        let value = match signature.results.len() {
            1 => "result".to_owned(),
            _ => format!("result.{}", field.name),
        };
        values.extend((0..field.ty.components()).map(|component| match field.ty {
            Type::Float => value.clone(),
            Type::Mat3 => format!("{value}[{}][{}]", component / 3, component % 3),
            Type::Vec2 | Type::Vec3 | Type::Vec4 => format!("{value}[{component}]"),
        }));
    }
    values
}
