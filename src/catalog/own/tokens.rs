//! The words of a shader's text, in any of the C-like languages: enough to find what stands at file scope.
//!
//! Nothing is parsed that a compiler parses again: types, expressions and statements stay text.

/// One token; its text's place in the whole tells its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    pub(super) text: &'a str,
    /// Offset in bytes.
    pub(super) at: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// An identifier or keyword.
    Word,
    /// A number or a quoted string.
    Literal,
    /// One character of punctuation.
    Mark,
    /// A whole line of the preprocessor.
    Directive,
}

impl Token<'_> {
    pub(super) fn is(&self, text: &str) -> bool {
        self.text == text
    }

    pub(super) fn end(&self) -> usize {
        self.at + self.text.len()
    }
}

/// The tokens of `text`, blanks and comments left out. Comments nest, as in WGSL: after a preprocessor none are left.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let bytes = text.as_bytes();
    let mut tokens = Vec::new();
    let mut at = 0;
    let mut first_on_line = true;
    while let Some(byte) = bytes.get(at) {
        let rest = &text[at..];
        let (kind, length) = match byte {
            b'\n' => {
                first_on_line = true;
                at += 1;
                continue;
            }
            b' ' | b'\t' | b'\r' => {
                at += 1;
                continue;
            }
            b'/' if rest.starts_with("//") => {
                at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            b'/' if rest.starts_with("/*") => {
                at += comment(rest);
                continue;
            }
            b'#' if first_on_line => (Kind::Directive, rest.find('\n').unwrap_or(rest.len())),
            b'"' => (Kind::Literal, rest[1..].find('"').map_or(rest.len(), |end| end + 2)),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => (Kind::Word, run(rest, |c| c.is_alphanumeric() || c == '_')),
            b'0'..=b'9' => (Kind::Literal, run(rest, |c| c.is_alphanumeric() || c == '.' || c == '_')),
            _ => (Kind::Mark, rest.chars().next().map_or(1, char::len_utf8)),
        };
        first_on_line = false;
        tokens.push(Token { kind, text: &text[at..at + length], at });
        at += length;
    }
    tokens
}

fn run(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

/// Length of the comment at the start of `text`, whatever is open at the end closed.
fn comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    while at < text.len() {
        if text[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if text[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += text[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// The position after the bracket that closes the one at `open`, or after the last token.
pub(super) fn close(tokens: &[Token<'_>], open: usize) -> usize {
    let mut depth = 0i32;
    for (position, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth <= 0 {
            return position + 1;
        }
    }
    tokens.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_their_places() {
        let text = "#define A b\nfloat f(vec2 x) { return 1.0e-3*x.x; } // end\n/* a /* b */ c */ @group(0)";
        let texts: Vec<&str> = tokens(text).iter().map(|token| token.text).collect();
        let expected = [
            "#define A b",
            "float",
            "f",
            "(",
            "vec2",
            "x",
            ")",
            "{",
            "return",
            "1.0e",
            "-",
            "3",
            "*",
            "x",
            ".",
            "x",
            ";",
            "}",
            "@",
            "group",
            "(",
            "0",
            ")",
        ];
        assert_eq!(texts, expected);
        assert!(tokens(text).iter().all(|token| &text[token.at..token.end()] == token.text));
    }

    #[test]
    fn brackets_close() {
        let text = tokens("f(a[(1)], {b}) c");
        assert_eq!(text[close(&text, 1)].text, "c");
        assert_eq!(close(&tokens("(a"), 0), 2);
        assert!(tokens("/* open").is_empty());
    }
}
