//! Shaders of the user's own: as they ship, in any language, made a family's function by an adapter.
//!
//! [`load`] reads a file, its front matter and its adapter; what comes of it is a [`Variant`](super::Variant) like any
//! other. Reading and adapting runs nothing: texts are put together and compiled.

mod adapter;
mod bounds;
pub(super) mod compose;
mod edits;
mod items;
mod link;
mod neutral;
mod tokens;
mod wrapper;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::front_matter::{self, Declaration};
use super::{Define, Error, Language};
use adapter::{Adapter, Includes};

/// What a caller says of one shader.
#[derive(Clone, Debug, Default)]
pub struct Request {
    pub file: PathBuf,
    /// Instead of the file's stem, or of the names in its front matter.
    pub name: Option<String>,
    /// Unless the file or its adapter names one.
    pub family: Option<String>,
    /// A file that says what front matter says, and wins where both do.
    pub adapter: Option<PathBuf>,
    /// Folders of included files, after the shader's own.
    pub folders: Vec<PathBuf>,
    /// Preprocessor definitions, which win over all others.
    pub defines: BTreeMap<String, Define>,
}

/// A shader and how it is adapted.
#[derive(Clone, Debug)]
pub(super) struct Shader {
    /// As messages name it.
    file: String,
    language: Language,
    content: Content,
    adapter: Adapter,
    /// As messages name it: its file, or the shader's with a remark.
    place: String,
    includes: Includes,
    defines: BTreeMap<String, Define>,
}

#[derive(Clone, Debug)]
enum Content {
    Text(String),
    Words(Vec<u32>),
}

/// What [`load`] found: a family's name and its new variants.
#[derive(Clone, Debug)]
pub(super) struct Loaded {
    pub(super) family: String,
    pub(super) shader: Shader,
    pub(super) declarations: Vec<Declaration>,
    pub(super) source: String,
    pub(super) tried: Option<String>,
    pub(super) summary: String,
}

/// Reads a shader of the user's own.
pub(super) fn load(request: &Request) -> Result<Loaded, Error> {
    let file = request.file.display().to_string();
    let fail = |message: String| Error::Own { file: file.clone(), message };
    let language = Language::of(&request.file).ok_or_else(|| {
        let endings: Vec<String> = Language::ENDINGS
            .iter()
            .map(|(language, endings)| format!("{} ({})", language.name(), endings.join(", ")))
            .collect();
        fail(format!("the file's ending does not tell its language; there are {}", endings.join("; ")))
    })?;
    let bytes = read(&request.file)?;
    let (content, front) = if language == Language::Spirv {
        (Content::Words(words(&bytes).map_err(fail)?), None)
    } else {
        let text = String::from_utf8(bytes).map_err(|_| fail("not UTF-8 text".to_owned()))?;
        if text.contains('\0') {
            return Err(fail("the text holds a NUL character".to_owned()));
        }
        let front = front_matter::block(&file, &text)?.map(|block| front_matter::read(&file, block));
        (Content::Text(text), front.transpose()?)
    };
    let (adapter, place): (Adapter, String) = match &request.adapter {
        Some(path) => {
            let name = path.display().to_string();
            let text = String::from_utf8(read(path)?)
                .map_err(|_| Error::Own { file: name.clone(), message: "not UTF-8 text".to_owned() })?;
            let beside: Adapter = front_matter::read(&name, &text)?;
            (beside.or(front.unwrap_or_default()), name)
        }
        None => (front.unwrap_or_default(), format!("{file} (front matter)")),
    };
    if let Some(message) = adapter.contradiction() {
        return Err(Error::Own { file: place, message: message.to_owned() });
    }
    let family = request.family.clone().or_else(|| adapter.family.clone()).ok_or_else(|| {
        fail(
            "which family's function is it? --family tells, or 'family = \"...\"' in its front matter"
                .to_owned(),
        )
    })?;
    let stem = request.file.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
    let mut declarations = adapter.variants.clone();
    if declarations.is_empty() {
        declarations.push(Declaration { name: variant_name(stem), ..Declaration::default() });
    }
    front_matter::check_names(&place, &declarations)?;
    if let Some(name) = &request.name {
        match declarations.as_mut_slice() {
            [only] => only.name = variant_name(name),
            several => {
                several.iter_mut().for_each(|one| one.name = format!("{}_{}", variant_name(name), one.name))
            }
        }
    }
    for declaration in &mut declarations {
        for sampler in adapter.samplers.values() {
            let form = sampler.form(neutral::default_form(language));
            declaration.tables.insert(sampler.table(), form);
        }
    }
    let mut folders: Vec<PathBuf> = request.file.parent().map(Path::to_owned).into_iter().collect();
    folders.extend(request.folders.iter().cloned());
    Ok(Loaded {
        family,
        declarations,
        source: adapter.source.clone().unwrap_or_else(|| "yours".to_owned()),
        tried: adapter.tried.clone(),
        summary: adapter.summary.clone().unwrap_or_else(|| format!("{} from {file}", language.name())),
        shader: Shader {
            file,
            language,
            content,
            adapter,
            place,
            includes: Includes { folders },
            defines: request.defines.clone(),
        },
    })
}

fn read(path: &Path) -> Result<Vec<u8>, Error> {
    std::fs::read(path).map_err(|error| Error::Own {
        file: path.display().to_string(),
        message: format!("cannot be read: {error}"),
    })
}

/// A module's words, in either byte order.
fn words(bytes: &[u8]) -> Result<Vec<u32>, String> {
    const MAGIC: u32 = 0x0723_0203;
    let chunks = bytes.chunks_exact(4);
    if !chunks.remainder().is_empty() || bytes.len() < 20 {
        return Err(
            "not a SPIR-V module: its size is no multiple of four bytes, or less than a header".to_owned()
        );
    }
    let word = |chunk: &[u8]| u32::from_le_bytes([chunk[0], chunk[1], chunk[2], chunk[3]]);
    let words: Vec<u32> = chunks.map(word).collect();
    match words[0] {
        MAGIC => Ok(words),
        magic if magic == MAGIC.swap_bytes() => Ok(words.into_iter().map(u32::swap_bytes).collect()),
        _ => Err("not a SPIR-V module: it does not begin with the magic number".to_owned()),
    }
}

/// A file's stem as a variant's name: lower-case letters, digits and '_'.
fn variant_name(stem: &str) -> String {
    let name: String =
        stem.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if name.is_empty() { "own".to_owned() } else { name }
}
