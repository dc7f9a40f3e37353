//! The languages that shaders come in.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::Type;

/// What a shader is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Language {
    #[default]
    Glsl,
    Hlsl,
    Wgsl,
    Spirv,
}

impl Language {
    /// Every language, with the endings of its files; the first is the usual one.
    pub const ENDINGS: [(Language, &'static [&'static str]); 4] = [
        (
            Language::Glsl,
            &["comp", "glsl", "frag", "vert", "fs", "vs", "fsh", "vsh", "glslf", "inc", "glslinc"],
        ),
        (Language::Hlsl, &["hlsl", "hlsli", "fx", "fxh", "usf", "ush", "cginc"]),
        (Language::Wgsl, &["wgsl"]),
        (Language::Spirv, &["spv"]),
    ];

    /// By the ending of a file's name.
    pub fn of(path: &Path) -> Option<Language> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        Language::ENDINGS.iter().find(|(_, endings)| endings.contains(&ending.as_str())).map(|(one, _)| *one)
    }

    pub fn name(self) -> &'static str {
        match self {
            Language::Glsl => "GLSL",
            Language::Hlsl => "HLSL",
            Language::Wgsl => "WGSL",
            Language::Spirv => "SPIR-V",
        }
    }

    /// What a type is called; in SPIR-V, which has no names for them, as in GLSL.
    pub fn type_name(self, ty: Type) -> &'static str {
        match (self, ty) {
            (Language::Glsl | Language::Spirv, ty) => ty.glsl(),
            (Language::Hlsl, Type::Float) => "float",
            (Language::Hlsl, Type::Vec2) => "float2",
            (Language::Hlsl, Type::Vec3) => "float3",
            (Language::Hlsl, Type::Vec4) => "float4",
            (Language::Hlsl, Type::Mat3) => "float3x3",
            (Language::Wgsl, Type::Float) => "f32",
            (Language::Wgsl, Type::Vec2) => "vec2<f32>",
            (Language::Wgsl, Type::Vec3) => "vec3<f32>",
            (Language::Wgsl, Type::Vec4) => "vec4<f32>",
            (Language::Wgsl, Type::Mat3) => "mat3x3<f32>",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_tell() {
        assert_eq!(Language::of(Path::new("a/b.FRAG")), Some(Language::Glsl));
        assert_eq!(Language::of(Path::new("b.hlsl")), Some(Language::Hlsl));
        assert_eq!(Language::of(Path::new("b.spv")), Some(Language::Spirv));
        assert_eq!(Language::of(Path::new("b.txt")), None);
        assert_eq!(Language::of(Path::new("b")), None);
    }
}
