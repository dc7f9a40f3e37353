//! The text around a variant's function in HLSL.
//!
//! A mat3 is a float3x3 with the same rows, so that `mul(m, v)` is what `m * v` is in GLSL.

use std::fmt::Write;

use super::{Main, MatrixOrder, results};
use crate::catalog::kernel::{
    COLUMNS_SET, INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, TABLES_SET, TableBinding,
};
use crate::catalog::{Language, Signature, Type};

/// The struct of several results; nothing for one.
pub(in crate::catalog) fn result_struct(signature: &Signature) -> String {
    let mut text = String::new();
    if signature.results.len() > 1 {
        _ = write!(text, "struct {} {{", signature.result_type());
        for field in &signature.results {
            _ = write!(text, " {} {};", Language::Hlsl.type_name(field.ty), field.name);
        }
        text.push_str(" };\n");
    }
    text
}

/// Declarations of the tables as buffers, with `t_texel(int2)` and `t_at(float2)` as in GLSL.
pub(in crate::catalog) fn tables(bindings: &[TableBinding]) -> String {
    let mut text = String::new();
    for TableBinding { name, binding, width, height, channels, .. } in bindings {
        let texel = if *channels == 4 { "float4" } else { "float" };
        _ = writeln!(
            text,
            "static const int2 {name}_size = int2({width}, {height});\n\
             [[vk::binding({binding}, {TABLES_SET})]] StructuredBuffer<{texel}> rootq_{name};\n\
             {texel} {name}_texel(int2 at) {{\n\
             \x20   at = clamp(at, int2(0, 0), {name}_size - 1);\n\
             \x20   return rootq_{name}[at.y * {name}_size.x + at.x];\n}}\n\
             {texel} {name}_at(float2 at) {{\n\
             \x20   at = clamp(at, float2(0.0, 0.0), float2({name}_size - 1));\n\
             \x20   float2 corner = floor(at);\n\
             \x20   float2 weight = at - corner;\n\
             \x20   int2 t = int2(corner);\n\
             \x20   {texel} a = lerp({name}_texel(t), {name}_texel(t + int2(1, 0)), weight.x);\n\
             \x20   {texel} b = lerp({name}_texel(t + int2(0, 1)), {name}_texel(t + int2(1, 1)), weight.x);\n\
             \x20   return lerp(a, b, weight.y);\n}}"
        );
    }
    text
}

/// Text after the variant's own: buffers, push constants and `main()`.
pub(in crate::catalog) fn epilogue(signature: &Signature, main: Main) -> String {
    let mut text = format!(
        "\n[[vk::binding({INPUTS_BINDING}, {COLUMNS_SET})]] StructuredBuffer<float> rootq_inputs;\n\
         [[vk::binding({OUTPUTS_BINDING}, {COLUMNS_SET})]] RWStructuredBuffer<float> rootq_outputs;\n\
         [[vk::push_constant]] cbuffer RootqRange {{ uint rootq_first; uint rootq_count; uint rootq_stride; \
         uint rootq_evaluations; }};\n\
         [numthreads({LOCAL_SIZE}, 1, 1)]\n\
         void main(uint3 rootq_id : SV_DispatchThreadID) {{\n\
         \x20   if (rootq_id.x >= rootq_count) return;\n\
         \x20   uint i = rootq_first + rootq_id.x;\n"
    );
    let mut column = 0;
    let loads: Vec<String> = signature
        .parameters
        .iter()
        .map(|parameter| {
            let components = parameter.ty.components();
            // A matrix is built from its rows.
            let place = |c: usize| if parameter.ty == Type::Mat3 { c % 3 * 3 + c / 3 } else { c };
            let loads: Vec<String> = (0..components)
                .map(|c| format!("rootq_inputs[{}u * rootq_stride + i]", column + place(c)))
                .collect();
            column += components;
            if components == 1 {
                return loads.join("");
            }
            format!("{}({})", Language::Hlsl.type_name(parameter.ty), loads.join(", "))
        })
        .collect();
    let (function, result) = (signature.function, signature.result_type_in(Language::Hlsl));
    match main {
        Main::Evaluate => {
            _ = writeln!(text, "    {result} r = {function}(\n        {});", loads.join(",\n        "));
        }
        Main::Repeat => {
            for (position, (parameter, load)) in signature.parameters.iter().zip(&loads).enumerate() {
                _ = writeln!(text, "    {} a{position} = {load};", Language::Hlsl.type_name(parameter.ty));
            }
            _ = write!(
                text,
                "    {result} r = ({result})0;\n    uint feedback = 0u;\n\
                 \x20   [loop] for (uint k = 0u; k < rootq_evaluations; ++k) {{\n\
                 \x20       float factor = asfloat(0x3f800000u - (feedback & 1u));\n"
            );
            for (position, parameter) in signature.parameters.iter().enumerate() {
                let ty = Language::Hlsl.type_name(parameter.ty);
                _ = writeln!(text, "        precise {ty} b{position} = a{position} * factor;");
            }
            let arguments: Vec<String> =
                (0..signature.parameters.len()).map(|position| format!("b{position}")).collect();
            let bits: Vec<String> = results(signature, MatrixOrder::Rows)
                .iter()
                .map(|value| format!("asuint({value})"))
                .collect();
            _ = write!(
                text,
                "        r = {function}({});\n        feedback = {};\n    }}\n",
                arguments.join(", "),
                bits.join(" ^ ")
            );
        }
    }
    for (column, value) in results(signature, MatrixOrder::Rows).iter().enumerate() {
        _ = writeln!(text, "    rootq_outputs[{column}u * rootq_stride + i] = {value};");
    }
    text.push_str("}\n");
    text
}
