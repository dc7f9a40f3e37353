//! The TOML block at the head of a variant's file.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::Error;
use super::kernel::TableForm;
use super::table::TableName;

const OPENING: &str = "/*---";
const CLOSING: &str = "---*/";

/// What a file declares of its variants.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrontMatter {
    /// What the text computes and what is special about it, one line.
    pub summary: String,
    /// Where it comes from: a publication, or `ours`.
    pub source: String,
    /// What else was tried to better it, and how that went.
    pub tried: Option<String>,
    /// The variants of this text, at least one.
    #[serde(rename = "variant", default)]
    pub variants: Vec<Declaration>,
}

/// One `[[variant]]`.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declaration {
    pub name: String,
    /// Replaces the file's summary.
    pub summary: Option<String>,
    /// Preprocessor definitions.
    #[serde(default)]
    pub defines: BTreeMap<String, Define>,
    /// Built-in tables that the text reads, and how: `tables = { sphere_lut = "image" }`.
    #[serde(default)]
    pub tables: BTreeMap<TableName, TableForm>,
    /// Every floating-point operation is decorated NoContraction, as if each were `precise`.
    #[serde(default)]
    pub precise: bool,
}

/// The value of a preprocessor definition.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Define {
    Integer(i64),
    Float(f64),
    Text(String),
}

impl std::fmt::Display for Define {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Define::Integer(value) => write!(f, "{value}"),
            // `{:?}` keeps the point: GLSL would read "1" as an integer.
            Define::Float(value) => write!(f, "{value:?}"),
            Define::Text(value) => f.write_str(value),
        }
    }
}

impl FrontMatter {
    /// Reads the block at the head of `text`; errors name `file` and the line.
    pub fn parse(file: &str, text: &str) -> Result<FrontMatter, Error> {
        let Some(block) = block(file, text)? else {
            return Err(fail(file, 1, format!("front matter must begin the file: '{OPENING}'")));
        };
        let parsed: FrontMatter = read(file, block)?;
        if parsed.variants.is_empty() {
            return Err(fail(file, 1, "at least one [[variant]] is needed".to_owned()));
        }
        check_names(file, &parsed.variants).map_err(|error| match error {
            // Told on the line of the name.
            Error::FrontMatter { file, message, .. } => {
                let name = message.split('\'').nth(1).unwrap_or_default();
                let at = block.rfind(&format!("\"{name}\"")).unwrap_or(0);
                Error::FrontMatter { file, line: 1 + block[..at].matches('\n').count(), message }
            }
            other => other,
        })?;
        Ok(parsed)
    }
}

fn fail(file: &str, line: usize, message: String) -> Error {
    Error::FrontMatter { file: file.to_owned(), line, message }
}

/// The TOML between the marks at the head of `text`, if it begins with one; its first line is the text's.
pub(super) fn block<'a>(file: &str, text: &'a str) -> Result<Option<&'a str>, Error> {
    let Some(rest) = text.strip_prefix(OPENING) else {
        return Ok(None);
    };
    match rest.find(CLOSING) {
        Some(end) => Ok(Some(&rest[..end])),
        None => Err(fail(file, 1, format!("front matter is not closed by '{CLOSING}'"))),
    }
}

/// Reads TOML; errors name `file` and the line.
pub(super) fn read<T: DeserializeOwned>(file: &str, block: &str) -> Result<T, Error> {
    toml::from_str(block).map_err(|error| {
        let offset = error.span().map_or(0, |span| span.start);
        let line = 1 + block[..offset.min(block.len())].matches('\n').count();
        fail(file, line, error.message().replace('\n', " "))
    })
}

/// Names must be plain and all different.
pub(super) fn check_names(file: &str, variants: &[Declaration]) -> Result<(), Error> {
    for (position, variant) in variants.iter().enumerate() {
        let name = &variant.name;
        if name.is_empty() || !name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
        {
            let message = format!("variant name '{name}' must be lower-case letters, digits and '_'");
            return Err(fail(file, 1, message));
        }
        if variants[..position].iter().any(|earlier| earlier.name == *name) {
            return Err(fail(file, 1, format!("variant '{name}' is declared twice")));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<FrontMatter, String> {
        FrontMatter::parse("f.comp", text).map_err(|error| error.to_string())
    }

    #[test]
    fn reads_variants_and_defines() {
        let text = "/*---\nsummary = \"s\"\nsource = \"o\"\n[[variant]]\nname = \"a\"\n[[variant]]\nname = \"b\"\n\
                    defines = { N = 1, T = 1.0, W = \"x + y\" }\nprecise = true\n---*/\nfloat f;";
        let read = parse(text).unwrap();
        assert_eq!(read.variants[0].name, "a");
        assert!(!read.variants[0].precise);
        let defines: Vec<String> = read.variants[1].defines.values().map(Define::to_string).collect();
        assert_eq!(defines, ["1", "1.0", "x + y"]);
    }

    #[test]
    fn every_mistake_has_its_line() {
        let cases = [
            ("float f;", "f.comp:1: front matter must begin"),
            ("/*---\nsummary = \"s\"\n", "f.comp:1: front matter is not closed"),
            ("/*---\nsummary = \"s\"\nsource = \"o\"\nauthor = \"x\"\n---*/", "f.comp:4: unknown field"),
            ("/*---\nsummary = 3\nsource = \"o\"\n---*/", "f.comp:2: invalid type"),
            ("/*---\nsummary = \"s\"\nsource = \"o\"\n---*/", "f.comp:1: at least one [[variant]]"),
            (
                "/*---\nsummary = \"s\"\nsource = \"o\"\n[[variant]]\nname = \"A\"\n---*/",
                "f.comp:5: variant name 'A'",
            ),
            (
                "/*---\nsummary = \"s\"\nsource = \"o\"\n[[variant]]\nname = \"a\"\n\
                 tables = { cube_lut = \"buffer\" }\n---*/",
                "f.comp:6: no table 'cube_lut'; there are: ",
            ),
            (
                "/*---\nsummary = \"s\"\nsource = \"o\"\n[[variant]]\nname = \"a\"\n\
                 tables = { sphere_lut = \"texture\" }\n---*/",
                "f.comp:6: unknown variant `texture`, expected `buffer` or `image`",
            ),
        ];
        for (text, expected) in cases {
            let error = parse(text).unwrap_err();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
