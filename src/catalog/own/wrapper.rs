//! The family's function, where it calls a shader's own.

use std::fmt::Write;

use super::adapter::{Adapter, Up};
use super::neutral::{MAIN, Read, set_aside};
use crate::catalog::kernel::{TableBinding, TableForm};
use crate::catalog::{Field, Language, Signature, Type};

/// A part of a composed text, and what messages call it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Section {
    pub(super) name: String,
    pub(super) text: String,
}

impl Section {
    pub(super) fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Section { name: name.into(), text: text.into() }
    }
}

/// What is called.
pub(super) struct Callee<'a> {
    pub(super) name: &'a str,
    /// Its result's type; nothing in WGSL, which finds that out, and for what returns nothing.
    pub(super) returns: Option<String>,
    /// Whether it returns anything.
    pub(super) value: bool,
}

/// The name of generated parts that a mistake cannot be in.
pub(super) const WRAPPER: &str = "generated call";

/// The function that the family asks for, made of the adapter's parts. `place` names the adapter in messages.
pub(super) fn wrapper(
    language: Language,
    signature: &Signature,
    adapter: &Adapter,
    callee: Option<&Callee<'_>>,
    place: &str,
) -> Vec<Section> {
    let part = |key: &str, text: String| Section::new(format!("{place}, '{key}'"), text);
    let own = |text: String| Section::new(WRAPPER, text);
    let up = adapter.up.unwrap_or_default();
    let mut sections = Vec::new();
    if up == Up::Y {
        sections.push(own(turns(language)));
    }
    sections.push(own(head(language, signature, up)));
    for (name, value) in &adapter.uniforms {
        sections.push(part(&format!("uniforms.{name}"), format!("{name} = {value};\n")));
    }
    if let Some(body) = &adapter.body {
        sections.push(part("body", format!("{body}\n")));
        sections.push(own("}\n".to_owned()));
        return sections;
    }
    if let Some(before) = &adapter.before {
        sections.push(part("before", format!("{before}\n")));
    }
    if let Some(callee) = callee {
        let parameters = || signature.parameters.iter().map(|field| field.name.to_owned()).collect();
        let arguments = adapter.arguments.clone().unwrap_or_else(parameters);
        let taken = callee.name == MAIN || callee.name == signature.function;
        let name = if taken { set_aside(callee.name) } else { callee.name.to_owned() };
        let call = format!("{name}({});\n", arguments.join(", "));
        let result = match (language, &callee.returns) {
            (Language::Wgsl, _) if callee.value => "let r = ".to_owned(),
            (_, Some(returns)) => format!("{returns} r = "),
            _ => String::new(),
        };
        sections.push(part("arguments", format!("{result}{call}")));
    }
    let plain = "r".to_owned();
    let value = |field: &Field| {
        let several = signature.results.len() > 1;
        let given = adapter.results.get(field.name).or(adapter.result.as_ref().filter(|_| !several));
        let (key, text) = match given {
            Some(text) if several => (format!("results.{}", field.name), text.clone()),
            Some(text) => ("result".to_owned(), text.clone()),
            // What has the family's own struct has its members.
            None if several => ("results".to_owned(), format!("r.{}", field.name)),
            None => ("result".to_owned(), plain.clone()),
        };
        let text = if up == Up::Y && turned(field.ty) { format!("rootq_to_z({text})") } else { text };
        (key, text)
    };
    let result_type = signature.result_type_in(language);
    match signature.results.as_slice() {
        [only] => {
            let (key, text) = value(only);
            sections.push(part(&key, format!("return {text};\n")));
        }
        several => {
            let declare = if language == Language::Wgsl {
                format!("var rootq_result: {result_type};\n")
            } else {
                format!("{result_type} rootq_result;\n")
            };
            sections.push(own(declare));
            for field in several {
                let (key, text) = value(field);
                sections.push(part(&key, format!("rootq_result.{} = {text};\n", field.name)));
            }
            sections.push(own("return rootq_result;\n".to_owned()));
        }
    }
    sections.push(own("}\n".to_owned()));
    sections
}

/// The declaration, its opening brace, and the parameters in the shader's axes.
fn head(language: Language, signature: &Signature, up: Up) -> String {
    let function = signature.function;
    let fields = signature.parameters.iter();
    let mut text = match language {
        Language::Wgsl => {
            let parameters: Vec<String> = fields
                .map(|field| format!("rootq_{}: {}", field.name, language.type_name(field.ty)))
                .collect();
            format!("fn {function}({}) -> {} {{\n", parameters.join(", "), signature.result_type_in(language))
        }
        _ => {
            let parameters: Vec<String> =
                fields.map(|field| format!("{} {}", language.type_name(field.ty), field.name)).collect();
            let result = signature.result_type_in(language);
            format!("{result} {function}({}) {{\n", parameters.join(", "))
        }
    };
    for Field { name, ty } in &signature.parameters {
        if language == Language::Wgsl {
            _ = writeln!(text, "var {name} = rootq_{name};");
        }
        if up == Up::Y && turned(*ty) {
            let turn = if *ty == Type::Mat3 { "rootq_matrix_to_y" } else { "rootq_to_y" };
            _ = writeln!(text, "{name} = {turn}({name});");
        }
    }
    text
}

/// Whether values of that type are places or directions, or take one to another.
fn turned(ty: Type) -> bool {
    matches!(ty, Type::Vec3 | Type::Mat3)
}

/// Turns about x that take the z axis to y and back: no rounding, only signs and places.
fn turns(language: Language) -> String {
    let vector = language.type_name(Type::Vec3);
    let matrix = language.type_name(Type::Mat3);
    match language {
        Language::Wgsl => format!(
            "fn rootq_to_y(v: {vector}) -> {vector} {{ return {vector}(v.x, v.z, -v.y); }}\n\
             fn rootq_to_z(v: {vector}) -> {vector} {{ return {vector}(v.x, -v.z, v.y); }}\n\
             fn rootq_matrix_to_y(m: {matrix}) -> {matrix} {{\n\
             return {matrix}(rootq_to_y(m[0]), rootq_to_y(m[2]), rootq_to_y(-m[1]));\n}}\n"
        ),
        // Rows here, columns there: a turned matrix is turned on both sides, so the same text does.
        _ => format!(
            "{vector} rootq_to_y({vector} v) {{ return {vector}(v.x, v.z, -v.y); }}\n\
             {vector} rootq_to_z({vector} v) {{ return {vector}(v.x, -v.z, v.y); }}\n\
             {matrix} rootq_matrix_to_y({matrix} m) {{\n\
             return {matrix}(rootq_to_y(m[0]), rootq_to_y(m[2]), rootq_to_y(-m[1]));\n}}\n"
        ),
    }
}

/// Functions that read tables in the place of textures, and the textures' names for images.
pub(super) fn samplers(
    language: Language,
    adapter: &Adapter,
    reads: &[Read],
    bindings: &[TableBinding],
) -> String {
    let mut text = String::new();
    for (texture, sampler) in &adapter.samplers {
        let table = sampler.table().as_str();
        let Some(binding) = bindings.iter().find(|binding| binding.name == table) else {
            continue;
        };
        if binding.form == TableForm::Image {
            if texture != table {
                _ = writeln!(text, "#define {texture} {table}");
            }
            continue;
        }
        for read in reads.iter().filter(|read| read.texture == *texture) {
            text.push_str(&reader(language, read, binding));
        }
    }
    text
}

/// One function of that kind: the texture's call without the texture and its sampler.
fn reader(language: Language, read: &Read, binding: &TableBinding) -> String {
    let (name, table) = (read.function(), binding.name);
    let whole = |texel: String| match (binding.channels, language) {
        (4, _) => texel,
        (_, Language::Glsl | Language::Spirv) => format!("vec4({texel}, 0.0, 0.0, 1.0)"),
        (_, Language::Hlsl) => format!("float4({texel}, 0.0, 0.0, 1.0)"),
        (_, Language::Wgsl) => format!("vec4<f32>({texel}, 0.0, 0.0, 1.0)"),
    };
    let vec2 = language.type_name(Type::Vec2);
    let vec4 = language.type_name(Type::Vec4);
    let sampled = whole(format!("{table}_at(uv * {vec2}({table}_size) - 0.5)"));
    match (language, read.call.as_str()) {
        (Language::Glsl, "texelFetch") => {
            let texel = whole(format!("{table}_texel(at)"));
            format!("{vec4} {name}(ivec2 at, int lod) {{ return {texel}; }}\n")
        }
        (Language::Glsl, "texture") => format!(
            "{vec4} {name}({vec2} uv) {{ return {sampled}; }}\n\
             {vec4} {name}({vec2} uv, float bias) {{ return {name}(uv); }}\n"
        ),
        (Language::Glsl, _) => format!("{vec4} {name}({vec2} uv, float lod) {{ return {sampled}; }}\n"),
        (Language::Hlsl, "Load") => {
            let texel = whole(format!("{table}_texel(at.xy)"));
            format!("{vec4} {name}(int3 at) {{ return {texel}; }}\n")
        }
        (Language::Hlsl, "Sample") => format!("{vec4} {name}({vec2} uv) {{ return {sampled}; }}\n"),
        (Language::Hlsl, _) => format!("{vec4} {name}({vec2} uv, float lod) {{ return {sampled}; }}\n"),
        (_, "textureLoad") => {
            let texel = whole(format!("{table}_texel(vec2<i32>(at))"));
            format!("fn {name}(at: vec2<i32>, level: i32) -> {vec4} {{ return {texel}; }}\n")
        }
        (_, "textureSample") => format!("fn {name}(uv: {vec2}) -> {vec4} {{ return {sampled}; }}\n"),
        _ => format!("fn {name}(uv: {vec2}, level: f32) -> {vec4} {{ return {sampled}; }}\n"),
    }
}
