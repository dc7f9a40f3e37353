//! The GLSL around a variant's function: tables and result struct before it, buffers and `main()` after it.
//!
//! No binding is written by hand anywhere else; devices share only the constants of [`super::kernel`].

use std::fmt::Write;

use super::kernel::{
    COLUMNS_SET, INPUTS_BINDING, LOCAL_SIZE, OUTPUTS_BINDING, TABLES_SET, TableBinding, TableForm,
};
use super::{Define, Signature, Type};

/// Text before the variant's own: version, extensions, definitions, result struct.
pub(super) fn prologue<'a>(
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
pub(super) fn tables(bindings: &[TableBinding]) -> String {
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
pub(super) fn epilogue(signature: &Signature) -> String {
    let mut text = format!(
        "\nlayout(local_size_x = {LOCAL_SIZE}) in;\n\
         layout(std430, set = {COLUMNS_SET}, binding = {INPUTS_BINDING}) readonly buffer RootqInputs {{ float rootq_inputs[]; }};\n\
         layout(std430, set = {COLUMNS_SET}, binding = {OUTPUTS_BINDING}) writeonly buffer RootqOutputs {{ float rootq_outputs[]; }};\n\
         layout(push_constant) uniform RootqRange {{ uint rootq_first; uint rootq_count; uint rootq_stride; }};\n\
         void main() {{\n\
         \x20   if (gl_GlobalInvocationID.x >= rootq_count) return;\n\
         \x20   uint i = rootq_first + gl_GlobalInvocationID.x;\n"
    );
    let mut column = 0;
    let arguments: Vec<String> = signature
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
    _ = writeln!(text, "    {} r = {}(", signature.result_type(), signature.function);
    _ = writeln!(text, "        {});", arguments.join(",\n        "));
    let mut column = 0;
    for field in &signature.results {
        let value = if signature.results.len() == 1 { "r".to_owned() } else { format!("r.{}", field.name) };
        for component in 0..field.ty.components() {
            let component = match field.ty {
                Type::Float => String::new(),
                Type::Mat3 => format!("[{}][{}]", component / 3, component % 3),
                Type::Vec2 | Type::Vec3 | Type::Vec4 => format!("[{component}]"),
            };
            _ = writeln!(text, "    rootq_outputs[{column}u * rootq_stride + i] = {value}{component};");
            column += 1;
        }
    }
    text.push_str("}\n");
    text
}
