//! GLSL's storage qualifiers and interface blocks.

use super::{Interface, Role, declarators, span};
use crate::catalog::own::edits::Edits;
use crate::catalog::own::items::{Item, Outline};
use crate::catalog::own::tokens::{Kind, Token, close};

/// Qualifiers that say where a variable comes from or goes to.
const INTERFACE: [&str; 6] = ["uniform", "in", "out", "varying", "attribute", "buffer"];
/// Qualifiers that only interfaces have.
const LOOSE: [&str; 13] = [
    "flat",
    "smooth",
    "noperspective",
    "centroid",
    "sample",
    "invariant",
    "patch",
    "readonly",
    "writeonly",
    "restrict",
    "coherent",
    "volatile",
    "shared",
];
const PRECISION: [&str; 3] = ["highp", "mediump", "lowp"];
const OPAQUE: [&str; 8] =
    ["sampler", "isampler", "usampler", "image", "iimage", "uimage", "texture", "subpassInput"];

pub(super) fn declaration<'a>(outline: &Outline<'a>, item: &Item, edits: &mut Edits) -> Vec<Interface<'a>> {
    let tokens = outline.item_tokens(item);
    let mut at = 0;
    let mut role = None;
    let mut shared = false;
    while let Some(token) = tokens.get(at) {
        if token.is("layout") && tokens.get(at + 1).is_some_and(|next| next.is("(")) {
            at = close(tokens, at + 1);
            continue;
        }
        if INTERFACE.contains(&token.text) {
            role = Some(match token.text {
                "out" => Role::Variable,
                "buffer" => Role::Memory,
                _ => Role::Input,
            });
        } else if token.is("shared") {
            shared = true;
        } else if !LOOSE.contains(&token.text) && !PRECISION.contains(&token.text) {
            break;
        }
        at += 1;
    }
    let all = outline.span(item);
    let Some(rest) = tokens.get(at..).filter(|rest| !rest.is_empty()) else {
        return Vec::new();
    };
    if shared {
        let names = declarators(&rest[1..]);
        edits.blank(all);
        return names.into_iter().map(|(name, _)| Interface { name, role: Role::Memory }).collect();
    }
    let Some(role) = role else {
        // `invariant gl_Position;` declares nothing of its own.
        if tokens[0].is("invariant") {
            edits.blank(all);
        }
        return Vec::new();
    };
    if rest[0].is(";") {
        edits.blank(all);
        return Vec::new();
    }
    if rest.get(1).is_some_and(|token| token.is("{")) {
        return block(tokens, at, role, edits);
    }
    let names = declarators(&rest[1..]);
    if OPAQUE.iter().any(|opaque| rest[0].text.starts_with(opaque)) {
        edits.blank(all);
        let role = if rest[0].text.contains("image") { Role::Memory } else { Role::Texture };
        return names.into_iter().map(|(name, _)| Interface { name, role }).collect();
    }
    edits.blank(span(&tokens[..at]));
    names
        .into_iter()
        .map(|(name, valued)| Interface { name, role: if valued { Role::Variable } else { role } })
        .collect()
}

/// `uniform Block { members } instance;`: a struct and its variable, or the members by themselves.
fn block<'a>(tokens: &[Token<'a>], at: usize, role: Role, edits: &mut Edits) -> Vec<Interface<'a>> {
    let open = at + 1;
    let end = close(tokens, open);
    let members = &tokens[open + 1..end - 1];
    let instance = tokens.get(end).filter(|token| token.kind == Kind::Word);
    let mut names = Vec::new();
    let mut member = 0;
    while member < members.len() {
        let length = members[member..]
            .iter()
            .position(|token| token.is(";"))
            .map_or(members.len() - member, |l| l + 1);
        let tokens = &members[member..member + length];
        let mut at = 0;
        while let Some(token) = tokens.get(at) {
            let layout = token.is("layout") && tokens.get(at + 1).is_some_and(|next| next.is("("));
            let next = if layout { close(tokens, at + 1) } else { at + 1 };
            if !layout && !LOOSE.contains(&token.text) && !INTERFACE.contains(&token.text) {
                break;
            }
            edits.blank(span(&tokens[at..next]));
            at = next;
        }
        names.extend(declarators(tokens.get(at + 1..).unwrap_or_default()).into_iter().map(|(name, _)| name));
        member += length;
    }
    if role == Role::Memory {
        edits.blank(span(tokens));
    } else if instance.is_some() {
        edits.blank(span(&tokens[..at]));
        edits.replace(tokens[at].at..tokens[at].at, "struct rootq_block_");
    } else {
        edits.blank(span(&tokens[..=open]));
        edits.blank(span(&tokens[end - 1..]));
    }
    match instance {
        Some(instance) => vec![Interface { name: instance.text, role }],
        None => names.into_iter().map(|name| Interface { name, role }).collect(),
    }
}
