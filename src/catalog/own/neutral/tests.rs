use super::*;

fn neutral_text(language: Language, text: &str, root: &str, adapter: &str) -> Result<Neutral, Missing> {
    let adapter: Adapter = toml::from_str(adapter).unwrap();
    neutral(&Outline::of(text), language, &[root], None, &adapter)
}

/// The text with runs of blanks as one, and none at the ends of lines.
fn squeezed(text: &str) -> Vec<String> {
    text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

#[test]
fn a_fragment_shader_keeps_its_function() {
    let text = "#version 330\n#extension GL_X : enable\nuniform sampler2D lut;\nlayout(location = 0) in vec2 uv;\n\
                out vec4 color;\nuniform Block {\n  layout(offset = 0) mat4 view;\n  float gain;\n} block;\n\
                uniform Loose { vec3 tint; };\nuniform float roughness = 0.5, other;\n\
                float used(float x) {\n  return x * gain_of(x) * block.gain;\n}\nfloat gain_of(float x) { return x * tint.x; }\n\
                void main() { color = vec4(dFdx(uv), texture(lut, uv).xy); }\n";
    let adapter = "[uniforms]\n\"block.gain\" = \"1.0\"\ntint = \"vec3(1)\"";
    let neutral = neutral_text(Language::Glsl, text, "used", adapter).unwrap();
    assert_eq!(neutral.extensions, ["#extension GL_X : enable"]);
    let expected = [
        "",
        "",
        "",
        "vec2 uv;",
        "vec4 color;",
        "struct rootq_block_Block {",
        "mat4 view;",
        "float gain;",
        "} block;",
        "vec3 tint;",
        "float roughness = 0.5, other;",
        "float used(float x) {",
        "return x * gain_of(x) * block.gain;",
        "}",
        "float gain_of(float x) { return x * tint.x; }",
        "",
    ];
    assert_eq!(squeezed(&neutral.text), expected);
    assert_eq!(neutral.text.lines().count(), text.lines().count());
}

#[test]
fn what_is_missing_is_named_where_it_is_used() {
    let text = "uniform sampler2D lut;\nuniform vec3 l;\nbuffer B { float b[]; };\n\
                float f(vec2 p) { return texture(lut, p).x; }\nfloat g() { return l.x; }\nfloat h() { return b[0]; }\n";
    for (root, name, what) in [("f", "lut", What::Table), ("g", "l", What::Value), ("h", "b", What::Memory)] {
        let missing = neutral_text(Language::Glsl, text, root, "").unwrap_err();
        assert_eq!((missing.name.as_str(), missing.what), (name, what));
        assert_eq!(&text[missing.at..missing.at + name.len()], name);
    }
    assert!(neutral_text(Language::Glsl, text, "f", "[samplers]\nlut = \"sphere_lut\"").is_ok());
}

#[test]
fn a_table_in_a_buffer_is_read_by_a_function() {
    let text =
        "uniform sampler2D lut;\nfloat f(vec2 p) { return texture(lut, p).x + textureLod(lut, p, 0.0).y; }\n";
    let adapter = "[samplers]\nlut = { table = \"sphere_lut\", form = \"buffer\" }";
    let neutral = neutral_text(Language::Glsl, text, "f", adapter).unwrap();
    let body = "float f(vec2 p) { return rootq_texture_lut( p).x + rootq_textureLod_lut( p, 0.0).y; }";
    assert_eq!(squeezed(&neutral.text)[1], body);
    assert_eq!(neutral.reads.len(), 2);
}

#[test]
fn hlsl_globals_become_static() {
    let text = "cbuffer Frame : register(b0) {\n  row_major float4x4 view : packoffset(c0);\n  float3 light;\n};\n\
                float gain : register(c1);\nconst float PI = 3.14;\nstatic const float E = 2.7;\n\
                Texture2D<float4> lut : register(t0);\nSamplerState linear_clamp : register(s0);\n\
                [numthreads(8, 8, 1)]\nvoid main(uint3 id : SV_DispatchThreadID) { }\n\
                float f(float2 uv) { return lut.SampleLevel(linear_clamp, uv, 0).x * light.x * gain * PI; }\n";
    let adapter = "[uniforms]\nlight = \"0\"\ngain = \"1\"\n[samplers]\nlut = \"sphere_lut\"";
    let neutral = neutral_text(Language::Hlsl, text, "f", adapter).unwrap();
    let expected = [
        "",
        "static float4x4 view ;",
        "static float3 light;",
        "",
        "static float gain ;",
        "static float PI = 3.14;",
        "static const float E = 2.7;",
        "",
        "",
        "",
        "",
        "float f(float2 uv) { return rootq_SampleLevel_lut( uv, 0).x * light.x * gain * PI; }",
    ];
    assert_eq!(squeezed(&neutral.text), expected);
}

#[test]
fn wgsl_resources_become_private() {
    let text = "struct U { gain: f32 }\n@group(0) @binding(0) var<uniform> u: U;\n\
                @group(0) @binding(1) var lut: texture_2d<f32>;\n@group(0) @binding(2) var s: sampler;\n\
                override K: f32 = 2.0;\n@fragment\nfn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n  return vec4f(f(uv));\n}\n\
                fn f(uv: vec2f) -> f32 { return textureSampleLevel(lut, s, uv, 0.0).x * u.gain * K; }\n";
    let adapter = "[uniforms]\n\"u.gain\" = \"1.0\"\n[samplers]\nlut = \"sphere_lut\"";
    let neutral = neutral_text(Language::Wgsl, text, "f", adapter).unwrap();
    let lines = squeezed(&neutral.text);
    assert_eq!(lines[1], "var<private> u: U;");
    assert_eq!(lines[4], "const K: f32 = 2.0;");
    assert_eq!(lines[5..9], ["", "", "", ""]);
    assert_eq!(
        lines[9],
        "fn f(uv: vec2f) -> f32 { return rootq_textureSampleLevel_lut( uv, 0.0).x * u.gain * K; }"
    );
    let entry = neutral_text(Language::Wgsl, text, "main", adapter).unwrap();
    assert_eq!(squeezed(&entry.text)[6], "fn rootq_their_main( uv: vec2f) -> vec4f {");
}

#[test]
fn a_name_that_is_needed_is_given_up() {
    let text = "uniform float gain;\nfloat f(float x);\nfloat f(float x) { return x > 1.0 ? gain : 2.0 * f(); }\n\
                float f() { return 1.0; }\n";
    let adapter: Adapter = toml::from_str("[uniforms]\ngain = \"2.0\"").unwrap();
    let neutral = neutral(&Outline::of(text), Language::Glsl, &["f"], Some("f"), &adapter).unwrap();
    let expected = [
        "float gain;",
        "float rootq_their_f(float x);",
        "float rootq_their_f(float x) { return x > 1.0 ? gain : 2.0 * rootq_their_f(); }",
        "float rootq_their_f() { return 1.0; }",
    ];
    assert_eq!(squeezed(&neutral.text), expected);
}
