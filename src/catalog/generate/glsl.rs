//! The text around a variant's function in GLSL.

use std::fmt::Write;

use super::{Main, MatrixOrder, results};
use crate::catalog::kernel::{
    COLUMNS_SET, INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, TABLES_SET, TableBinding, TableForm,
};
use crate::catalog::{Define, Signature, Type};

/// Text before the variant's own: version, extensions, definitions, result struct.
pub(in crate::catalog) fn prologue<'a>(
    signature: &Signature,
    defines: impl Iterator<Item = (&'a String, &'a Define)>,
) -> String {
    let mut text = String::from(
        "#version 450\n\
         #extension GL_GOOGLE_include_directive : require\n\
         #extension GL_GOOGLE_cpp_style_line_directive : require\n",
    );
    for (name, value) in defines {
        _ = writeln!(text, "#define {name} {value}");
    }
    text.push_str(&result_struct(signature));
    text
}

/// The struct of several results; nothing for one.
pub(in crate::catalog) fn result_struct(signature: &Signature) -> String {
    let mut text = String::new();
    if signature.results.len() > 1 {
        _ = write!(text, "struct {} {{", signature.result_type());
        for field in &signature.results {
            _ = write!(text, " {} {};", field.ty.glsl(), field.name);
        }
        text.push_str(" };\n");
    }
    text
}

/// Declarations of the tables, before the variant's own text. A table `t` of either form has its size `t_size` and
/// `t_at(vec2)`, which interpolates bilinearly at a place counted in texels from the centre of the first, clamped to the
/// edge; besides
///
/// - a buffer has `T_BUFFER` defined and `t_texel(ivec2)`, likewise clamped; `t_at` is f32 arithmetic;
/// - an image has `T_IMAGE` defined and is the sampler2D `t`; `t_at` is the sampler's, with the weights it has.
///
/// Texels are float or vec4.
pub(in crate::catalog) fn tables(bindings: &[TableBinding]) -> String {
    let mut text = String::new();
    for table in bindings {
        let TableBinding { name, binding, width, height, .. } = table;
        let upper = name.to_uppercase();
        let (texel, first) = if table.channels == 4 { ("vec4", "") } else { ("float", ".x") };
        _ = writeln!(text, "const ivec2 {name}_size = ivec2({width}, {height});");
        _ = match table.form {
            TableForm::Buffer => writeln!(
                text,
                "#define {upper}_BUFFER 1\n\
                 layout(std430, set = {TABLES_SET}, binding = {binding}) readonly buffer RootqTable{binding} \
                 {{ {texel} rootq_{name}[]; }};\n\
                 {texel} {name}_texel(ivec2 at) {{\n\
                 \x20   at = clamp(at, ivec2(0), {name}_size - 1);\n\
                 \x20   return rootq_{name}[at.y * {name}_size.x + at.x];\n}}\n\
                 {texel} {name}_at(vec2 at) {{\n\
                 \x20   at = clamp(at, vec2(0.0), vec2({name}_size - 1));\n\
                 \x20   vec2 corner = floor(at);\n\
                 \x20   vec2 weight = at - corner;\n\
                 \x20   ivec2 t = ivec2(corner);\n\
                 \x20   {texel} a = mix({name}_texel(t), {name}_texel(t + ivec2(1, 0)), weight.x);\n\
                 \x20   {texel} b = mix({name}_texel(t + ivec2(0, 1)), {name}_texel(t + ivec2(1, 1)), weight.x);\n\
                 \x20   return mix(a, b, weight.y);\n}}"
            ),
            TableForm::Image => writeln!(
                text,
                "#define {upper}_IMAGE 1\n\
                 layout(set = {TABLES_SET}, binding = {binding}) uniform sampler2D {name};\n\
                 {texel} {name}_at(vec2 at) {{\n\
                 \x20   return textureLod({name}, (at + 0.5) / vec2({name}_size), 0.0){first};\n}}"
            ),
        };
    }
    text
}

/// Text after the variant's own: buffers, push constants and `main()`.
pub(in crate::catalog) fn epilogue(signature: &Signature, main: Main) -> String {
    let evaluations = if main == Main::Repeat { " uint rootq_evaluations;" } else { "" };
    let mut text = format!(
        "\nlayout(local_size_x = {LOCAL_SIZE}) in;\n\
         layout(std430, set = {COLUMNS_SET}, binding = {INPUTS_BINDING}) readonly buffer RootqInputs {{ float rootq_inputs[]; }};\n\
         layout(std430, set = {COLUMNS_SET}, binding = {OUTPUTS_BINDING}) writeonly buffer RootqOutputs {{ float rootq_outputs[]; }};\n\
         layout(push_constant) uniform RootqRange {{ uint rootq_first; uint rootq_count; uint rootq_stride;{evaluations} }};\n\
         void main() {{\n\
         \x20   if (gl_GlobalInvocationID.x >= rootq_count) return;\n\
         \x20   uint i = rootq_first + gl_GlobalInvocationID.x;\n"
    );
    let mut column = 0;
    let loads: Vec<String> = signature
        .parameters
        .iter()
        .map(|parameter| {
            let loads: Vec<String> = (column..column + parameter.ty.components())
                .map(|c| format!("rootq_inputs[{c}u * rootq_stride + i]"))
                .collect();
            column += parameter.ty.components();
            format!("{}({})", parameter.ty.glsl(), loads.join(", "))
        })
        .collect();
    let (result, function) = (signature.result_type(), signature.function);
    match main {
        Main::Evaluate => {
            _ = writeln!(text, "    {result} r = {function}(\n        {});", loads.join(",\n        "));
        }
        Main::Repeat => {
            for (position, (parameter, load)) in signature.parameters.iter().zip(&loads).enumerate() {
                _ = writeln!(text, "    {} a{position} = {load};", parameter.ty.glsl());
            }
            _ = write!(
                text,
                "    {result} r;\n    uint feedback = 0u;\n    for (uint k = 0u; k < rootq_evaluations; ++k) {{\n\
                 \x20       float factor = uintBitsToFloat(0x3f800000u - (feedback & 1u));\n"
            );
            for (position, parameter) in signature.parameters.iter().enumerate() {
                _ = writeln!(
                    text,
                    "        precise {} b{position} = a{position} * factor;",
                    parameter.ty.glsl()
                );
            }
            let arguments: Vec<String> =
                (0..signature.parameters.len()).map(|position| format!("b{position}")).collect();
            let bits: Vec<String> = results(signature, MatrixOrder::Columns)
                .iter()
                .map(|value| format!("floatBitsToUint({value})"))
                .collect();
            _ = write!(
                text,
                "        r = {function}({});\n        feedback = {};\n    }}\n",
                arguments.join(", "),
                bits.join(" ^ ")
            );
        }
    }
    for (column, value) in results(signature, MatrixOrder::Columns).iter().enumerate() {
        _ = writeln!(text, "    rootq_outputs[{column}u * rootq_stride + i] = {value};");
    }
    text.push_str("}\n");
    text
}

/// A function of `signature` that returns zeros: a place to put another one.
pub(in crate::catalog) fn stub(signature: &Signature) -> String {
    let values: Vec<String> =
        signature.results.iter().map(|field| format!("{}(0.0)", field.ty.glsl())).collect();
    let value = match values.as_slice() {
        [only] => only.clone(),
        several => format!("{}({})", signature.result_type(), several.join(", ")),
    };
    format!("{} {{ return {value}; }}\n", signature.declaration())
}

/// Columns that [`copy`] copies.
pub(in crate::catalog) const COPIED_COLUMNS: usize = 8;

/// A whole kernel that copies [`COPIED_COLUMNS`] columns without regard to which is which: four floats at once.
pub(in crate::catalog) fn copy() -> String {
    let mut text = format!(
        "#version 450\n\
         layout(local_size_x = {LOCAL_SIZE}) in;\n\
         layout(std430, set = {COLUMNS_SET}, binding = {INPUTS_BINDING}) readonly buffer RootqInputs {{ vec4 rootq_inputs[]; }};\n\
         layout(std430, set = {COLUMNS_SET}, binding = {OUTPUTS_BINDING}) writeonly buffer RootqOutputs {{ vec4 rootq_outputs[]; }};\n\
         layout(push_constant) uniform RootqRange {{ uint rootq_first; uint rootq_count; uint rootq_stride; }};\n\
         void main() {{\n\
         \x20   if (gl_GlobalInvocationID.x >= rootq_count) return;\n\
         \x20   uint i = rootq_first + gl_GlobalInvocationID.x;\n"
    );
    for part in 0..COPIED_COLUMNS / 4 {
        let at = format!("{part}u * rootq_stride + i");
        _ = writeln!(text, "    rootq_outputs[{at}] = rootq_inputs[{at}];");
    }
    text.push_str("}\n");
    text
}

/// A function of `signature` that evaluates nothing: every result is an input's bits, or several inputs' together, so
/// that all of them are loaded and all of the results stored. What it takes is what the harness takes.
pub(in crate::catalog) fn null(signature: &Signature) -> String {
    let inputs: Vec<String> = signature
        .parameters
        .iter()
        .flat_map(|parameter| {
            (0..parameter.ty.components()).map(move |component| match parameter.ty {
                Type::Float => parameter.name.to_owned(),
                Type::Mat3 => format!("{}[{}][{}]", parameter.name, component / 3, component % 3),
                Type::Vec2 | Type::Vec3 | Type::Vec4 => format!("{}[{component}]", parameter.name),
            })
        })
        .collect();
    let mut text = format!("{} {{\n    {} r;\n", signature.declaration(), signature.result_type());
    let results = results(signature, MatrixOrder::Columns);
    for (position, result) in results.iter().enumerate() {
        let mut bits: Vec<String> = inputs
            .iter()
            .skip(position)
            .step_by(results.len())
            .map(|input| format!("floatBitsToUint({input})"))
            .collect();
        if bits.is_empty() {
            bits.push(format!("floatBitsToUint({})", inputs[position % inputs.len()]));
        }
        _ = writeln!(text, "    {result} = uintBitsToFloat({});", bits.join(" ^ "));
    }
    text.push_str("    return r;\n}\n");
    text
}
