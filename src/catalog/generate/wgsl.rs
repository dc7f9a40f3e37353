//! The text around a variant's function in WGSL.

use std::fmt::Write;

use super::{Main, MatrixOrder, results};
use crate::catalog::kernel::{
    COLUMNS_SET, INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, TABLES_SET, TableBinding,
};
use crate::catalog::{Language, Signature};

/// Name of the generated entry point; a shader's own may be called `main`.
pub(in crate::catalog) const ENTRY: &str = "rootq_main";

/// The struct of several results; nothing for one.
pub(in crate::catalog) fn result_struct(signature: &Signature) -> String {
    let mut text = String::new();
    if signature.results.len() > 1 {
        _ = write!(text, "struct {} {{", signature.result_type());
        for field in &signature.results {
            _ = write!(text, " {}: {},", field.name, Language::Wgsl.type_name(field.ty));
        }
        text.push_str(" }\n");
    }
    text
}

/// Declarations of the tables as buffers, with `t_texel(vec2<i32>)` and `t_at(vec2<f32>)` as in GLSL.
pub(in crate::catalog) fn tables(bindings: &[TableBinding]) -> String {
    let mut text = String::new();
    for TableBinding { name, binding, width, height, channels, .. } in bindings {
        let texel = if *channels == 4 { "vec4<f32>" } else { "f32" };
        _ = writeln!(
            text,
            "const {name}_size = vec2<i32>({width}, {height});\n\
             @group({TABLES_SET}) @binding({binding}) var<storage, read> rootq_{name}: array<{texel}>;\n\
             fn {name}_texel(place: vec2<i32>) -> {texel} {{\n\
             \x20   let at = clamp(place, vec2<i32>(0), {name}_size - 1);\n\
             \x20   return rootq_{name}[at.y * {name}_size.x + at.x];\n}}\n\
             fn {name}_at(place: vec2<f32>) -> {texel} {{\n\
             \x20   let at = clamp(place, vec2<f32>(0.0), vec2<f32>({name}_size - 1));\n\
             \x20   let corner = floor(at);\n\
             \x20   let weight = at - corner;\n\
             \x20   let t = vec2<i32>(corner);\n\
             \x20   let a = mix({name}_texel(t), {name}_texel(t + vec2<i32>(1, 0)), weight.x);\n\
             \x20   let b = mix({name}_texel(t + vec2<i32>(0, 1)), {name}_texel(t + vec2<i32>(1, 1)), weight.x);\n\
             \x20   return mix(a, b, weight.y);\n}}"
        );
    }
    text
}

/// Text after the variant's own: buffers, push constants and the entry point.
pub(in crate::catalog) fn epilogue(signature: &Signature, main: Main) -> String {
    let mut text = format!(
        "\n@group({COLUMNS_SET}) @binding({INPUTS_BINDING}) var<storage, read> rootq_inputs: array<f32>;\n\
         @group({COLUMNS_SET}) @binding({OUTPUTS_BINDING}) var<storage, read_write> rootq_outputs: array<f32>;\n\
         struct RootqRange {{ first: u32, count: u32, stride: u32, evaluations: u32 }}\n\
         var<immediate> rootq_range: RootqRange;\n\
         @compute @workgroup_size({LOCAL_SIZE})\n\
         fn {ENTRY}(@builtin(global_invocation_id) rootq_id: vec3<u32>) {{\n\
         \x20   if rootq_id.x >= rootq_range.count {{ return; }}\n\
         \x20   let i = rootq_range.first + rootq_id.x;\n"
    );
    let mut column = 0;
    let loads: Vec<String> = signature
        .parameters
        .iter()
        .map(|parameter| {
            let loads: Vec<String> = (column..column + parameter.ty.components())
                .map(|c| format!("rootq_inputs[{c}u * rootq_range.stride + i]"))
                .collect();
            column += parameter.ty.components();
            format!("{}({})", Language::Wgsl.type_name(parameter.ty), loads.join(", "))
        })
        .collect();
    let function = signature.function;
    match main {
        Main::Evaluate => {
            _ = writeln!(text, "    let r = {function}(\n        {});", loads.join(",\n        "));
        }
        Main::Repeat => {
            for (position, load) in loads.iter().enumerate() {
                _ = writeln!(text, "    let a{position} = {load};");
            }
            _ = write!(
                text,
                "    var r: {};\n    var feedback = 0u;\n\
                 \x20   for (var k = 0u; k < rootq_range.evaluations; k = k + 1u) {{\n\
                 \x20       let factor = bitcast<f32>(0x3f800000u - (feedback & 1u));\n",
                signature.result_type_in(Language::Wgsl)
            );
            let arguments: Vec<String> =
                (0..loads.len()).map(|position| format!("a{position} * factor")).collect();
            let bits: Vec<String> = results(signature, MatrixOrder::Columns)
                .iter()
                .map(|value| format!("bitcast<u32>({value})"))
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
        _ = writeln!(text, "    rootq_outputs[{column}u * rootq_range.stride + i] = {value};");
    }
    text.push_str("}\n");
    text
}
