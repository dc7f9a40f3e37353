//! Shaders of the user's own, as every verb takes them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Result, anyhow, bail};
use clap::Args;

use super::selection::{self, Selected};
use crate::catalog::{Catalog, Define, Request, Variant};
use crate::family;

/// The reference of adapters, in the long help.
const ADAPTER: &str = "\
TOML that says how to call a shader that was written for something else: one for all shaders, or one for each in their \
order. The shader's own front matter (/*--- ... ---*/ at its head) may hold the same keys; all are optional, and none edits \
the shader's file. Its entry points, stage inputs and outputs, and all functions that the call does not reach are left out.
  family, summary, source        what it is
  function  = \"theirs\"           to call [default: the family's name]
  arguments = [\"a\", \"vec3(0)\"]   of the family's parameters [default: they]
  before    = \"vec3 p[4] = ...;\" statements before the call
  result    = \"r.x\"              the result; r is what the function returns
  results   = { major = \"r.a\" }  the same of a family with several
  body      = \"...\"              instead: the whole body of the function
  preamble, declarations         text at file scope, before and after
  include   = [\"common.glsl\"]    before it: beside it, in -I, or built in
  defines   = { half = \"float\" }
  rename    = { minv = \"their_minv\" }
  uniforms  = { gain = \"0.5\" }   values of uniforms and stage inputs
  samplers  = { lut = \"ggx_minv\" } tables for textures; or
              { lut = { table = \"ggx_minv\", form = \"buffer\" } }
  up        = \"y\"                the shader's up axis; the families' is z
  [[variant]]                    name, defines, precise: several of one text
Example, a polygon light that samples a table in the middle:
  function  = \"evaluate_light\"
  before    = \"vec3 N = vec3(0, 0, 1); vec3 P[4] = vec3[4](p0, p1, p2, p3);\"
  arguments = [\"N\", \"N.yzx\", \"vec3(0)\", \"minv\", \"P\", \"true\"]
  result    = \"r.x\"
  samplers  = { ltc_2 = \"ggx_amplitude\" }";

/// Options that bring shaders.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Your own shaders")]
pub(super) struct ShaderArguments {
    /// A shader of yours, as a variant like any other; may be given again. By its ending GLSL (.comp, .glsl, .frag ...),
    /// HLSL (.hlsl ...), WGSL (.wgsl) or SPIR-V (.spv). NAME is the variant's, else the file's stem is
    #[arg(long, value_name = "[NAME=]FILE")]
    shader: Vec<String>,
    /// The family whose function the shaders are, unless they say so themselves
    #[arg(id = "shader_family", long = "family", value_name = "FAMILY", requires = "shader")]
    family: Option<String>,
    /// TOML that says how to call a shader that was written for something else: one for all shaders, or one for each in
    /// their order
    #[arg(long, value_name = "FILE", requires = "shader", long_help = ADAPTER)]
    adapter: Vec<PathBuf>,
    /// Folder of files that the shaders include; may be given again
    #[arg(short = 'I', value_name = "DIR", requires = "shader")]
    include: Vec<PathBuf>,
    /// Preprocessor definition for the shaders; may be given again
    #[arg(short = 'D', value_name = "NAME[=VALUE]", requires = "shader")]
    define: Vec<String>,
}

impl ShaderArguments {
    /// The built-in variants that match `patterns`, and these shaders.
    pub(super) fn select(&self, patterns: &[String]) -> Result<Vec<Selected>> {
        let mut catalog = Catalog::embedded()?;
        // A family that is selected by name is the shaders', too.
        let only = match patterns {
            [only] if family::find(only).is_some() => Some(only.as_str()),
            _ => None,
        };
        let own = self.bring(&mut catalog, only)?;
        selection::variants(&catalog, patterns, &own)
    }

    /// Adds the shaders to the catalogue and returns their identifiers. `only` is the family of a verb that has one.
    pub(super) fn bring(&self, catalog: &mut Catalog, only: Option<&str>) -> Result<Vec<String>> {
        if self.adapter.len() > 1 && self.adapter.len() != self.shader.len() {
            bail!(
                "--adapter is given {} times for {} shaders: once, or once for each",
                self.adapter.len(),
                self.shader.len()
            );
        }
        let mut ids = Vec::new();
        for (position, shader) in self.shader.iter().enumerate() {
            let (name, file) = named(shader);
            let request = Request {
                file,
                name,
                family: self.family.clone().or_else(|| only.map(str::to_owned)),
                adapter: self.adapter.get(position).or(self.adapter.first()).cloned(),
                folders: self.include.clone(),
                defines: self.defines()?,
            };
            let variants = Variant::own(&request)?;
            for variant in &variants {
                selection::family(&variant.family)?;
                if only.is_some_and(|only| only != variant.family) {
                    bail!("{} is a shader of the family {}", variant.file, variant.family);
                }
                ids.push(variant.id());
            }
            catalog
                .add(variants)
                .map_err(|error| anyhow!("{error}; --shader NAME=FILE gives it another name"))?;
        }
        Ok(ids)
    }

    fn defines(&self) -> Result<BTreeMap<String, Define>> {
        let mut defines = BTreeMap::new();
        for define in &self.define {
            let (name, value) = define.split_once('=').unwrap_or((define, "1"));
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
            if name.is_empty() || !name.chars().all(plain) || name.starts_with(|c: char| c.is_ascii_digit()) {
                bail!("-D {define}: '{name}' is not a name");
            }
            defines.insert(name.to_owned(), Define::Text(value.to_owned()));
        }
        Ok(defines)
    }
}

/// `NAME=FILE`, where FILE alone may hold '=' after a separator.
fn named(shader: &str) -> (Option<String>, PathBuf) {
    match shader.split_once('=') {
        Some((name, file)) if !name.is_empty() && !name.contains(['/', '\\', '.']) => {
            (Some(name.to_owned()), file.into())
        }
        _ => (None, shader.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_before_files() {
        assert_eq!(named("mine=a/b.comp"), (Some("mine".to_owned()), "a/b.comp".into()));
        assert_eq!(named("a/b=c.comp"), (None, "a/b=c.comp".into()));
        assert_eq!(named("b.comp"), (None, "b.comp".into()));
    }
}
