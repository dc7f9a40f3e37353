//! HLSL's constant buffers, globals and resources.

use super::{Interface, Role, declarators, span};
use crate::catalog::own::edits::Edits;
use crate::catalog::own::items::{Item, Outline};
use crate::catalog::own::tokens::{Token, close};

/// Words before a global that is the shader's own, or no variable at all.
const OWN: [&str; 6] = ["static", "struct", "typedef", "using", "class", "interface"];

pub(super) fn declaration<'a>(outline: &Outline<'a>, item: &Item, edits: &mut Edits) -> Vec<Interface<'a>> {
    let mut tokens = outline.item_tokens(item);
    let all = outline.span(item);
    // Attributes such as [[vk::binding(0)]].
    while tokens.first().is_some_and(|token| token.is("[")) {
        let end = close(tokens, 0);
        edits.blank(span(&tokens[..end]));
        tokens = &tokens[end..];
    }
    let Some(first) = tokens.first() else {
        return Vec::new();
    };
    if ["cbuffer", "tbuffer"].contains(&first.text) {
        return constants(tokens, edits);
    }
    if first.is(";") || OWN.contains(&first.text) {
        return Vec::new();
    }
    if first.is("groupshared") {
        let names = declarators(&tokens[2..]);
        edits.blank(all);
        return names.into_iter().map(|(name, _)| Interface { name, role: Role::Memory }).collect();
    }
    let qualifiers = tokens.iter().take_while(|token| QUALIFIERS.contains(&token.text)).count();
    let Some(ty) = tokens.get(qualifiers) else {
        return Vec::new();
    };
    // A type may have arguments: Texture2D<float4>.
    let after = tokens[qualifiers + 1..].iter();
    let arguments = match tokens.get(qualifiers + 1) {
        Some(open) if open.is("<") => after.take_while(|token| !token.is(">")).count() + 1,
        _ => 0,
    };
    let names = declarators(&until_register(&tokens[qualifiers + 1 + arguments..], edits));
    let role = match ty.text {
        text if text.starts_with("Texture") => Role::Texture,
        text if text.starts_with("Sampler") || text.starts_with("sampler") => Role::Sampler,
        text if text.starts_with("RW") || text.contains("Buffer") && !text.starts_with("ConstantBuffer") => {
            Role::Memory
        }
        _ => Role::Input,
    };
    if role != Role::Input {
        edits.blank(all);
        return names.into_iter().map(|(name, _)| Interface { name, role }).collect();
    }
    edits.blank(span(&tokens[..qualifiers]));
    if ty.text.starts_with("ConstantBuffer") {
        edits.replace(span(&tokens[qualifiers..qualifiers + 2]), "static ");
        edits.blank(span(&tokens[qualifiers + arguments..=qualifiers + arguments]));
    } else {
        edits.replace(ty.at..ty.at, "static ");
    }
    names
        .into_iter()
        .map(|(name, valued)| Interface { name, role: if valued { Role::Variable } else { Role::Input } })
        .collect()
}

/// Without meaning for a plain variable. `const` goes as well: the adapter may set what has no value.
const QUALIFIERS: [&str; 6] = ["uniform", "const", "extern", "row_major", "column_major", "shared"];

/// `cbuffer Name : register(b0) { members }`: the members by themselves.
fn constants<'a>(tokens: &[Token<'a>], edits: &mut Edits) -> Vec<Interface<'a>> {
    let Some(open) = tokens.iter().position(|token| token.is("{")) else {
        return Vec::new();
    };
    let end = close(tokens, open);
    edits.blank(span(&tokens[..=open]));
    edits.blank(span(&tokens[end - 1..]));
    let members = &tokens[open + 1..end - 1];
    let mut names = Vec::new();
    for member in members.split_inclusive(|token| token.is(";")) {
        let qualifiers = member.iter().take_while(|token| QUALIFIERS.contains(&token.text)).count();
        if qualifiers > 0 {
            edits.blank(span(&member[..qualifiers]));
        }
        let Some(ty) = member.get(qualifiers) else {
            continue;
        };
        edits.replace(ty.at..ty.at, "static ");
        let declared = until_register(&member[qualifiers + 1..], edits);
        names.extend(
            declarators(&declared).into_iter().map(|(name, _)| Interface { name, role: Role::Input }),
        );
    }
    names
}

/// The tokens without `: register(...)` and `: packoffset(...)`, which are taken out of the text, too.
fn until_register<'a>(tokens: &[Token<'a>], edits: &mut Edits) -> Vec<Token<'a>> {
    let mut rest = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        if token.is(":") && tokens.get(at + 2).is_some_and(|open| open.is("(")) {
            let end = close(tokens, at + 2);
            edits.blank(span(&tokens[at..end]));
            at = end;
        } else {
            rest.push(*token);
            at += 1;
        }
    }
    rest
}
