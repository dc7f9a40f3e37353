//! What stands at file scope of a shader: functions, and everything else.

use std::collections::BTreeSet;
use std::ops::Range;

use super::tokens::{Kind, Token, close, tokens};

/// A shader's text, cut at file scope.
#[derive(Debug)]
pub(super) struct Outline<'a> {
    pub(super) text: &'a str,
    pub(super) tokens: Vec<Token<'a>>,
    pub(super) items: Vec<Item>,
}

/// One definition or declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Item {
    /// Its tokens.
    pub(super) range: Range<usize>,
    pub(super) kind: ItemKind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ItemKind {
    /// A function; its name's token, and whether it has a body.
    Function {
        name: usize,
        body: bool,
    },
    Directive,
    /// A variable, type, block or lone qualifier.
    Declaration,
}

/// Words before a bracket that are no function's name.
const NOT_CALLED: [&str; 5] = ["layout", "register", "packoffset", "__attribute__", "location"];

impl<'a> Outline<'a> {
    pub(super) fn of(text: &'a str) -> Outline<'a> {
        let tokens = tokens(text);
        let mut items = Vec::new();
        let mut at = 0;
        while at < tokens.len() {
            let item = item(&tokens, at);
            at = item.range.end;
            items.push(item);
        }
        Outline { text, tokens, items }
    }

    pub(super) fn item_tokens(&self, item: &Item) -> &[Token<'a>] {
        &self.tokens[item.range.clone()]
    }

    /// The item's part of the text.
    pub(super) fn span(&self, item: &Item) -> Range<usize> {
        let tokens = self.item_tokens(item);
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => first.at..last.end(),
            _ => 0..0,
        }
    }

    pub(super) fn name(&self, item: &Item) -> Option<&'a str> {
        match item.kind {
            ItemKind::Function { name, .. } => Some(self.tokens[name].text),
            _ => None,
        }
    }

    /// The functions of that name that have bodies.
    pub(super) fn functions(&self, name: &str) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(move |item| {
            matches!(item.kind, ItemKind::Function { body: true, .. }) && self.name(item) == Some(name)
        })
    }

    /// Names of all functions that have bodies.
    pub(super) fn function_names(&self) -> BTreeSet<&'a str> {
        let bodied = |item: &&Item| matches!(item.kind, ItemKind::Function { body: true, .. });
        self.items.iter().filter(bodied).filter_map(|item| self.name(item)).collect()
    }

    /// Whether each item can matter to who uses the words `roots`: everything that is no function, and the functions
    /// that these and the roots name, directly or through others. By name alone, so overloads stay together.
    pub(super) fn reachable<'b>(&self, roots: impl Iterator<Item = &'b str>) -> Vec<bool> {
        let mut words: BTreeSet<&str> = roots.collect();
        let mut kept = vec![false; self.items.len()];
        loop {
            let mut grown = false;
            for (item, kept) in self.items.iter().zip(&mut kept) {
                if *kept || self.name(item).is_some_and(|name| !words.contains(name)) {
                    continue;
                }
                (*kept, grown) = (true, true);
                let tokens = &self.tokens[item.range.clone()];
                words.extend(tokens.iter().filter(|token| token.kind == Kind::Word).map(|token| token.text));
            }
            if !grown {
                return kept;
            }
        }
    }

    /// The line, from 1, of a place in the text, and the file that `#line` directives before it name.
    pub(super) fn line(&self, at: usize) -> (Option<String>, usize) {
        line(self.text, at)
    }
}

/// See [`Outline::line`].
pub(super) fn line(text: &str, at: usize) -> (Option<String>, usize) {
    let before = &text[..at.min(text.len())];
    let (mut file, mut number) = (None, 1);
    for (position, line) in before.split('\n').enumerate() {
        if position > 0 {
            number += 1;
        }
        if let Some(told) = line.trim_start().strip_prefix("#line ") {
            let mut words = told.trim().splitn(2, ' ');
            if let Some(next) = words.next().and_then(|word| word.parse::<usize>().ok()) {
                number = next.saturating_sub(1);
            }
            if let Some(name) = words.next() {
                file = Some(name.trim().trim_matches('"').to_owned());
            }
        }
    }
    (file, number)
}

/// The item that begins at a token.
fn item(tokens: &[Token<'_>], start: usize) -> Item {
    if tokens[start].kind == Kind::Directive {
        return Item { range: start..start + 1, kind: ItemKind::Directive };
    }
    let mut at = start;
    let (mut name, mut initialised, mut block) = (None, false, false);
    while at < tokens.len() {
        match tokens[at].text {
            ";" => {
                at += 1;
                break;
            }
            // An attribute: `[numthreads(8, 8, 1)]`.
            "[" if name.is_none() => at = close(tokens, at),
            "(" => {
                let before = (at > start).then(|| tokens[at - 1]);
                let called = before.filter(|token| {
                    let attribute = at >= start + 2 && tokens[at - 2].is("@");
                    token.kind == Kind::Word && !NOT_CALLED.contains(&token.text) && !attribute
                });
                if called.is_some() && name.is_none() && !initialised && !block {
                    name = Some(at - 1);
                }
                at = close(tokens, at);
            }
            "{" => {
                at = close(tokens, at);
                if name.is_some() && !initialised {
                    return Item { range: start..at, kind: function(name, true) };
                }
                block = true;
                // What follows a block without a name and semicolon is the next item.
                let variable = tokens.get(at).is_some_and(|token| {
                    token.is(";")
                        || token.is("[")
                        || token.is(",")
                        || token.is("=")
                        || (token.kind == Kind::Word && declares(tokens, start, at))
                });
                if !variable && !initialised {
                    break;
                }
            }
            "=" => {
                initialised = true;
                at += 1;
            }
            _ if tokens[at].kind == Kind::Directive && at > start => break,
            _ => at += 1,
        }
    }
    let kind = if initialised || block { ItemKind::Declaration } else { function(name, false) };
    Item { range: start..at.max(start + 1), kind }
}

fn function(name: Option<usize>, body: bool) -> ItemKind {
    name.map_or(ItemKind::Declaration, |name| ItemKind::Function { name, body })
}

/// Whether the word after a block is its variable's name (`uniform B { ... } b;`), not the next item's first: a name
/// is followed by a semicolon, a comma, an array's size or a value.
fn declares(tokens: &[Token<'_>], start: usize, at: usize) -> bool {
    let next = tokens.get(at + 1);
    let own_end = next.is_some_and(|token| [";", ",", "[", "="].contains(&token.text));
    let cbuffer = ["cbuffer", "tbuffer"].contains(&tokens[start].text);
    own_end && !cbuffer
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spans(text: &str) -> Vec<String> {
        let outline = Outline::of(text);
        outline.items.iter().map(|item| outline.text[outline.span(item)].to_owned()).collect()
    }

    #[test]
    fn file_scope_is_cut_into_items() {
        let text = "#version 450\nlayout(local_size_x = 8) in;\nlayout(set = 0, binding = 1) uniform B { mat4 m; } b;\n\
                    const float K = sqrt(2.0);\nstruct S { int a; };\nvec3 f(vec3 x);\nvec3 f(vec3 x) { if (x.x > 0.0) { return x; } return -x; }\n\
                    vec2 a[2] = vec2[](vec2(0), vec2(1));\nuniform C { float c; };\n";
        let expected = [
            "#version 450",
            "layout(local_size_x = 8) in;",
            "layout(set = 0, binding = 1) uniform B { mat4 m; } b;",
            "const float K = sqrt(2.0);",
            "struct S { int a; };",
            "vec3 f(vec3 x);",
            "vec3 f(vec3 x) { if (x.x > 0.0) { return x; } return -x; }",
            "vec2 a[2] = vec2[](vec2(0), vec2(1));",
            "uniform C { float c; };",
        ];
        assert_eq!(spans(text), expected);
        let outline = Outline::of(text);
        let functions: Vec<_> = outline.items.iter().filter_map(|item| outline.name(item)).collect();
        assert_eq!(functions, ["f", "f"]);
    }

    #[test]
    fn other_languages_too() {
        let text = "cbuffer A : register(b0) { float3 p; }\nTexture2D<float4> t : register(t0);\n\
                    [numthreads(8, 8, 1)]\nvoid CS(uint3 id : SV_DispatchThreadID) { t.Load(id); }\n\
                    float4 PS(float2 uv : TEXCOORD0) : SV_Target { return 0; }";
        assert_eq!(spans(text).len(), 4, "{:?}", spans(text));
        let outline = Outline::of(text);
        assert_eq!(outline.function_names().into_iter().collect::<Vec<_>>(), ["CS", "PS"]);
        let text = "struct S { a: f32 }\n@group(0) @binding(0) var<uniform> u: S;\n\
                    const K = vec3f(1.0);\n@fragment\nfn main(@location(0) p: vec3f) -> vec4f { return f(p); }\n\
                    fn f(p: vec3f) -> vec4f { return vec4f(p, u.a); }";
        assert_eq!(spans(text).len(), 5, "{:?}", spans(text));
        assert_eq!(Outline::of(text).function_names().into_iter().collect::<Vec<_>>(), ["f", "main"]);
    }

    #[test]
    fn only_what_is_called_is_kept() {
        let text = "float k = g();\nfloat a() { return b(); }\nfloat b() { return 1.0; }\nfloat c() { return a(); }\n\
                    float g() { return 2.0; }\nvoid main() { c(); }";
        let outline = Outline::of(text);
        let kept = outline.reachable(["a"].into_iter());
        assert_eq!(kept, [true, true, true, false, true, false]);
    }

    #[test]
    fn lines_follow_directives() {
        let text = "a\nb\n#line 7 \"x.glsl\"\nc\nd";
        assert_eq!(line(text, 2), (None, 2));
        assert_eq!(line(text, text.find('c').unwrap()), (Some("x.glsl".to_owned()), 7));
        assert_eq!(line(text, text.find('d').unwrap()), (Some("x.glsl".to_owned()), 8));
    }
}
