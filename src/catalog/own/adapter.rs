//! How a shader that was written for something else becomes a family's function.
//!
//! An adapter is TOML, in the shader's own front matter or in a file beside it. It renames, defines, includes and calls;
//! it never edits the shader's text and never runs anything but the shader.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;

use crate::catalog::front_matter::{Declaration, Define};
use crate::catalog::kernel::TableForm;
use crate::catalog::table::TableName;

/// Everything that front matter or an adapter file may say of one shader. All of it is optional.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Adapter {
    pub(super) summary: Option<String>,
    pub(super) source: Option<String>,
    pub(super) tried: Option<String>,
    /// The family whose function this is.
    pub(super) family: Option<String>,
    #[serde(rename = "variant", default)]
    pub(super) variants: Vec<Declaration>,

    /// The shader's function to call, by default the one with the family's name.
    pub(super) function: Option<String>,
    /// One expression a parameter of it, in the family's parameters; by default these in their order.
    pub(super) arguments: Option<Vec<String>>,
    /// The family's one result, as an expression in `r`, which is what the function returns.
    pub(super) result: Option<String>,
    /// The same of several results, by their names.
    #[serde(default)]
    pub(super) results: BTreeMap<String, String>,
    /// Statements before the call, such as variables for `out` parameters.
    pub(super) before: Option<String>,
    /// Instead of all these: the whole body of the family's function.
    pub(super) body: Option<String>,
    /// Text at file scope before and after the shader's.
    pub(super) preamble: Option<String>,
    pub(super) declarations: Option<String>,
    /// Files put before the shader's text, found as `#include` finds them.
    #[serde(default)]
    pub(super) include: Vec<String>,
    #[serde(default)]
    pub(super) defines: BTreeMap<String, Define>,
    /// Names in the shader's text, and what they are called instead.
    #[serde(default)]
    pub(super) rename: BTreeMap<String, String>,
    /// Values of uniforms and stage inputs, as expressions in the family's parameters.
    #[serde(default)]
    pub(super) uniforms: BTreeMap<String, String>,
    /// Tables that take the place of the shader's textures.
    #[serde(default)]
    pub(super) samplers: BTreeMap<String, Sampler>,
    /// The shader's up axis; the families' is z.
    pub(super) up: Option<Up>,
}

/// A table for a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub(super) enum Sampler {
    Table(TableName),
    Formed { table: TableName, form: TableForm },
}

impl Sampler {
    pub(super) fn table(self) -> TableName {
        match self {
            Sampler::Table(table) | Sampler::Formed { table, .. } => table,
        }
    }

    /// A filtered image where nothing else is asked for, which is what a texture is.
    pub(super) fn form(self, default: TableForm) -> TableForm {
        match self {
            Sampler::Table(_) => default,
            Sampler::Formed { form, .. } => form,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Up {
    #[default]
    Z,
    Y,
}

impl Adapter {
    /// This one, with what it leaves open taken from `other`.
    pub(super) fn or(self, other: Adapter) -> Adapter {
        let map = |mut first: BTreeMap<String, String>, second: BTreeMap<String, String>| {
            for (key, value) in second {
                first.entry(key).or_insert(value);
            }
            first
        };
        let mut defines = other.defines;
        defines.extend(self.defines);
        let mut samplers = other.samplers;
        samplers.extend(self.samplers);
        Adapter {
            summary: self.summary.or(other.summary),
            source: self.source.or(other.source),
            tried: self.tried.or(other.tried),
            family: self.family.or(other.family),
            variants: if self.variants.is_empty() { other.variants } else { self.variants },
            function: self.function.or(other.function),
            arguments: self.arguments.or(other.arguments),
            result: self.result.or(other.result),
            results: map(self.results, other.results),
            before: self.before.or(other.before),
            body: self.body.or(other.body),
            preamble: self.preamble.or(other.preamble),
            declarations: self.declarations.or(other.declarations),
            include: if self.include.is_empty() { other.include } else { self.include },
            defines,
            rename: map(self.rename, other.rename),
            uniforms: map(self.uniforms, other.uniforms),
            samplers,
            up: self.up.or(other.up),
        }
    }

    /// Whether the shader's function is called by another one, rather than being the family's itself.
    pub(super) fn calls(&self, family: &str) -> bool {
        self.function.as_deref().is_some_and(|function| function != family)
            || self.arguments.is_some()
            || self.result.is_some()
            || !self.results.is_empty()
            || self.before.is_some()
            || self.body.is_some()
            || !self.uniforms.is_empty()
            || self.up.is_some_and(|up| up != Up::Z)
    }

    /// What cannot be meant together.
    pub(super) fn contradiction(&self) -> Option<&'static str> {
        let called = self.function.is_some() || self.arguments.is_some() || self.before.is_some();
        let resulted = self.result.is_some() || !self.results.is_empty();
        if self.body.is_some() && (called || resulted) {
            Some(
                "'body' is the whole function: 'function', 'arguments', 'before', 'result' and 'results' say nothing beside it",
            )
        } else if self.result.is_some() && !self.results.is_empty() {
            Some("'result' is for a family with one result, 'results' for one with several")
        } else {
            None
        }
    }
}

/// Where included files are looked for, and what was found.
#[derive(Clone, Debug, Default)]
pub(super) struct Includes {
    /// Folder of the shader, then those of `-I`.
    pub(super) folders: Vec<PathBuf>,
}

impl Includes {
    /// The text of `name` as included by `includer`: beside that file, beside the shader, in the folders of `-I`, and
    /// among the built-in steps.
    pub(super) fn find(&self, name: &str, includer: &str) -> Option<String> {
        let beside = std::path::Path::new(includer).parent().map(|folder| folder.join(name));
        let elsewhere = self.folders.iter().map(|folder| folder.join(name));
        let read = |path: PathBuf| std::fs::read_to_string(path).ok();
        beside
            .into_iter()
            .chain(elsewhere)
            .find_map(read)
            .or_else(|| crate::catalog::built_in(name).map(str::to_owned))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_beside_wins() {
        let own: Adapter = toml::from_str(
            "function = \"f\"\nup = \"y\"\n[uniforms]\na = \"1.0\"\n[samplers]\nlut = \"sphere_lut\"\n\
             other = { table = \"sphere_lut\", form = \"buffer\" }",
        )
        .unwrap();
        let front: Adapter =
            toml::from_str("function = \"g\"\nresult = \"r.x\"\n[uniforms]\na = \"2.0\"\nb = \"3.0\"")
                .unwrap();
        let both = own.or(front);
        assert_eq!((both.function.as_deref(), both.result.as_deref()), (Some("f"), Some("r.x")));
        assert_eq!(both.uniforms.values().collect::<Vec<_>>(), ["1.0", "3.0"]);
        assert_eq!(both.samplers["lut"].form(TableForm::Image), TableForm::Image);
        assert_eq!(both.samplers["other"].form(TableForm::Image), TableForm::Buffer);
    }

    #[test]
    fn contradictions_are_told() {
        let told = |text: &str| toml::from_str::<Adapter>(text).unwrap().contradiction();
        assert!(told("body = \"return 1.0;\"\nfunction = \"f\"").is_some());
        assert!(told("result = \"r\"\n[results]\na = \"r\"").is_some());
        assert!(told("function = \"f\"\nresult = \"r.x\"").is_none());
    }
}
