//! Takes a shader out of its pipeline: what stages, uniforms, textures and entry points it declares becomes plain
//! variables, tables or nothing, and its functions stay as they are, on their own lines.
//!
//! Only functions that the adapter's call reaches are kept, so that what only their `main` needs (derivatives, stage
//! inputs, textures without a table) is nobody's concern.

mod glsl;
mod hlsl;
mod wgsl;

use std::ops::Range;

use super::adapter::Adapter;
use super::edits::Edits;
use super::items::{Item, ItemKind, Outline};
use super::tokens::{Kind, Token, close};
use crate::catalog::Language;
use crate::catalog::kernel::TableForm;

/// What a shader's function is called from now on whose name the generated parts need.
pub(super) fn set_aside(name: &str) -> String {
    format!("rootq_their_{name}")
}

/// The shader's own entry point, in the way of ours.
pub(super) const MAIN: &str = "main";

/// A text without a pipeline.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Neutral {
    pub(super) text: String,
    /// `#extension` lines, which have to come before everything else.
    pub(super) extensions: Vec<String>,
    /// Calls of the language that read a table instead of a texture.
    pub(super) reads: Vec<Read>,
}

/// One way in which a texture is read.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Read {
    /// The texture's name in the shader.
    pub(super) texture: String,
    /// The language's function or method: `texture`, `SampleLevel`.
    pub(super) call: String,
}

impl Read {
    /// The generated function that is called instead.
    pub(super) fn function(&self) -> String {
        format!("rootq_{}_{}", self.call, self.texture)
    }
}

/// Something outside the shader that it cannot do without.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Missing {
    pub(super) name: String,
    pub(super) what: What,
    /// Where it is used.
    pub(super) at: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    /// A uniform or an input without a value.
    Value,
    /// A texture without a table.
    Table,
    /// A storage buffer or image, or shared memory.
    Memory,
}

/// One name that a declaration takes from or gives to a pipeline.
#[derive(Clone, Copy, Debug)]
struct Interface<'a> {
    name: &'a str,
    role: Role,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Read, and without a value unless the adapter gives one.
    Input,
    /// Written, or has a value of its own.
    Variable,
    Texture,
    /// A sampler apart from its texture: means nothing by itself.
    Sampler,
    Memory,
}

/// Makes the text neutral for a caller whose own text has the words `roots`. Functions called `aside` or `main` get
/// [other names](set_aside).
pub(super) fn neutral(
    outline: &Outline<'_>,
    language: Language,
    roots: &[&str],
    aside: Option<&str>,
    adapter: &Adapter,
) -> Result<Neutral, Missing> {
    let kept = outline.reachable(roots.iter().copied());
    let mut edits = Edits::default();
    let mut extensions = Vec::new();
    let mut interfaces = Vec::new();
    for (item, kept) in outline.items.iter().zip(&kept) {
        match &item.kind {
            ItemKind::Directive => {
                let text = &outline.text[outline.span(item)];
                let word = text.trim_start_matches('#').split_whitespace().next().unwrap_or_default();
                if word == "extension" {
                    extensions.push(text.to_owned());
                }
                if word == "extension" || word == "version" {
                    edits.blank(outline.span(item));
                }
            }
            ItemKind::Function { .. } if !kept => edits.blank(outline.span(item)),
            ItemKind::Function { .. } => {
                strip_attributes(outline, item, language, &mut edits);
                let tokens = outline.item_tokens(item);
                for (at, token) in tokens.iter().enumerate() {
                    let called = tokens.get(at + 1).is_some_and(|next| next.is("("));
                    if called && (token.is(MAIN) || aside == Some(token.text)) {
                        edits.replace(token.at..token.end(), &set_aside(token.text));
                    }
                }
            }
            ItemKind::Declaration => interfaces.extend(match language {
                Language::Hlsl => hlsl::declaration(outline, item, &mut edits),
                Language::Wgsl => wgsl::declaration(outline, item, &mut edits),
                Language::Glsl | Language::Spirv => glsl::declaration(outline, item, &mut edits),
            }),
        }
    }
    let functions = || {
        outline.items.iter().zip(&kept).filter(|(item, kept)| **kept && item.kind != ItemKind::Declaration)
    };
    let mut reads = Vec::new();
    for (item, _) in functions() {
        for (read, call, rest) in texture_reads(outline.item_tokens(item), language) {
            let sampler = adapter.samplers.get(&read.texture);
            let form = sampler.map(|sampler| sampler.form(default_form(language)));
            // Real images are read by the language's own functions.
            if form == Some(TableForm::Buffer) {
                edits.replace(call, &read.function());
                edits.replace(rest, "(");
                reads.push(read);
            }
        }
    }
    reads.sort();
    reads.dedup();
    for interface in interfaces {
        let what = match interface.role {
            Role::Variable | Role::Sampler => continue,
            Role::Input if has_value(adapter, interface.name) => continue,
            Role::Texture if adapter.samplers.contains_key(interface.name) => continue,
            Role::Input => What::Value,
            Role::Texture => What::Table,
            Role::Memory => What::Memory,
        };
        let mut used = functions()
            .flat_map(|(item, _)| outline.item_tokens(item))
            .filter(|token| token.kind == Kind::Word && token.is(interface.name));
        if let Some(token) = used.next() {
            return Err(Missing { name: interface.name.to_owned(), what, at: token.at });
        }
    }
    Ok(Neutral { text: edits.apply(outline.text), extensions, reads })
}

/// How a texture is read unless the adapter says otherwise: by a sampler where the language has them together.
pub(super) fn default_form(language: Language) -> TableForm {
    if language == Language::Glsl { TableForm::Image } else { TableForm::Buffer }
}

/// Whether the adapter sets the variable, or a member of it.
fn has_value(adapter: &Adapter, name: &str) -> bool {
    adapter.uniforms.keys().any(|place| place.split(['.', '[']).next() == Some(name))
}

/// Entry points are plain functions now: what says otherwise before their types goes.
fn strip_attributes(outline: &Outline<'_>, item: &Item, language: Language, edits: &mut Edits) {
    let tokens = outline.item_tokens(item);
    let mut at = 0;
    match language {
        Language::Hlsl => {
            while tokens.get(at).is_some_and(|token| token.is("[")) {
                let end = close(tokens, at);
                edits.blank(span(&tokens[at..end]));
                at = end;
            }
        }
        Language::Wgsl => wgsl::strip_attributes(tokens, edits),
        Language::Glsl | Language::Spirv => {}
    }
}

/// Where textures are read: what and how, the tokens to be replaced by the function's name and those by its bracket.
fn texture_reads<'a>(
    tokens: &'a [Token<'a>],
    language: Language,
) -> impl Iterator<Item = (Read, Range<usize>, Range<usize>)> + 'a {
    let word = |token: &Token<'_>| token.kind == Kind::Word;
    (0..tokens.len()).filter_map(move |at| {
        let rest = &tokens[at..];
        let read = |texture: &Token<'_>, call: &Token<'_>| Read {
            texture: texture.text.to_owned(),
            call: call.text.to_owned(),
        };
        let (read, name_length, length) = match (language, rest) {
            (Language::Hlsl, [texture, dot, call, open, _, comma, ..])
                if dot.is(".")
                    && open.is("(")
                    && ["Sample", "SampleLevel"].contains(&call.text)
                    && comma.is(",") =>
            {
                (read(texture, call), 3, 6)
            }
            (Language::Hlsl, [texture, dot, call, open, ..])
                if dot.is(".") && open.is("(") && call.is("Load") && word(texture) =>
            {
                (read(texture, call), 3, 4)
            }
            (Language::Wgsl, [call, open, texture, comma, _, second, ..])
                if ["textureSample", "textureSampleLevel"].contains(&call.text)
                    && open.is("(")
                    && comma.is(",")
                    && second.is(",") =>
            {
                (read(texture, call), 1, 6)
            }
            (Language::Wgsl, [call, open, texture, comma, ..])
                if call.is("textureLoad") && open.is("(") && comma.is(",") =>
            {
                (read(texture, call), 1, 4)
            }
            (Language::Glsl, [call, open, texture, comma, ..])
                if ["texture", "textureLod", "texelFetch"].contains(&call.text)
                    && open.is("(")
                    && comma.is(",") =>
            {
                (read(texture, call), 1, 4)
            }
            _ => return None,
        };
        Some((read, span(&rest[..name_length]), span(&rest[name_length..length])))
    })
}

/// The part of the text that tokens, at least one, cover.
fn span(tokens: &[Token<'_>]) -> Range<usize> {
    match (tokens.first(), tokens.last()) {
        (Some(first), Some(last)) => first.at..last.end(),
        _ => 0..0,
    }
}

/// Names declared by `a, b[2] = x, c;`, each with whether it has a value, and whatever follows them skipped.
fn declarators<'a>(tokens: &[Token<'a>]) -> Vec<(&'a str, bool)> {
    let mut names: Vec<(&str, bool)> = Vec::new();
    let (mut at, mut expected) = (0, true);
    while let Some(token) = tokens.get(at) {
        match token.text {
            "," => expected = true,
            "=" => {
                if let Some(last) = names.last_mut() {
                    last.1 = true;
                }
            }
            "(" | "[" | "{" => {
                at = close(tokens, at);
                continue;
            }
            _ if token.kind == Kind::Word && expected => {
                names.push((token.text, false));
                expected = false;
            }
            _ => {}
        }
        at += 1;
    }
    names
}

#[cfg(test)]
mod tests;
