//! WGSL's resource variables and entry points.

use super::{Interface, Role, span};
use crate::catalog::own::edits::Edits;
use crate::catalog::own::items::{Item, Outline};
use crate::catalog::own::tokens::{Token, close};

pub(super) fn declaration<'a>(outline: &Outline<'a>, item: &Item, edits: &mut Edits) -> Vec<Interface<'a>> {
    let all = outline.span(item);
    let mut tokens = outline.item_tokens(item);
    let attributes = attributes(tokens);
    if attributes > 0 {
        edits.blank(span(&tokens[..attributes]));
        tokens = &tokens[attributes..];
    }
    let valued = tokens.iter().any(|token| token.is("="));
    match tokens {
        [first, name, ..] if first.is("override") => {
            edits.replace(first.at..first.end(), if valued { "const" } else { "var<private>" });
            let role = if valued { Role::Variable } else { Role::Input };
            vec![Interface { name: name.text, role }]
        }
        [first, open, space, rest @ ..] if first.is("var") && open.is("<") => {
            let closing = rest.iter().position(|token| token.is(">")).unwrap_or(0);
            let Some(name) = rest.get(closing + 1) else {
                return Vec::new();
            };
            let role = match space.text {
                "uniform" | "immediate" | "push_constant" => {
                    edits.replace(space.at..space.end(), "private");
                    Role::Input
                }
                "storage" | "workgroup" => {
                    edits.blank(all);
                    Role::Memory
                }
                _ => return Vec::new(),
            };
            vec![Interface { name: name.text, role }]
        }
        [first, name, colon, ty, ..] if first.is("var") && colon.is(":") => {
            let role = match ty.text {
                text if text.starts_with("texture_storage") => Role::Memory,
                text if text.starts_with("texture_") => Role::Texture,
                text if text.starts_with("sampler") => Role::Sampler,
                _ => return Vec::new(),
            };
            edits.blank(all);
            vec![Interface { name: name.text, role }]
        }
        _ => Vec::new(),
    }
}

/// Attributes of entry points, before them and on their parameters and results.
pub(super) fn strip_attributes(tokens: &[Token<'_>], edits: &mut Edits) {
    let mut at = 0;
    while at < tokens.len() {
        let count = attributes(&tokens[at..]);
        if count > 0 {
            edits.blank(span(&tokens[at..at + count]));
        }
        at += count.max(1);
    }
}

/// How many of the first tokens are attributes: `@group(0) @binding(1)`.
fn attributes(tokens: &[Token<'_>]) -> usize {
    let mut at = 0;
    while tokens.get(at).is_some_and(|token| token.is("@")) {
        at += 2;
        if tokens.get(at).is_some_and(|token| token.is("(")) {
            at = close(tokens, at);
        }
    }
    at.min(tokens.len())
}
