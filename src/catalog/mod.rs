//! Finds variants, reads their front matter, generates `main()`, compiles to SPIR-V and reflects facts from it.
//!
//! `glsl/<family>/<stem>.comp` holds front matter and one function; [`Catalog::embedded`] has them all, and
//! [`Variant::compile`] turns one into a [`Kernel`].

mod flatten;
mod front_matter;
mod generate;
mod glslang;
pub mod kernel;
mod language;
mod naga;
mod operations;
mod own;
mod reflect;
pub mod signature;
mod table;
mod variant;

use std::path::Path;

use include_dir::{Dir, include_dir};

use generate::glsl;
use glslang::Source;

pub use flatten::compile_standalone;
pub use front_matter::{Declaration, Define, FrontMatter};
pub use kernel::{Kernel, TableBinding, TableForm};
pub use language::Language;
pub use operations::Operations;
pub use own::Request;
pub use reflect::Facts;
pub use signature::{Field, Signature, Type};
pub use table::{Table, TableName, table_bindings, tables};
pub use variant::{Compiled, Variant};

static BUILT_IN: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/glsl");

/// Folder of shared steps: included by variants, holding none.
const COMMON: &str = "common";
const EXTENSION: &str = "comp";
/// The name under which glslang reports the generated part of a text.
const GENERATED: &str = "generated main()";

/// All variants, by family and then by file and place in it.
#[derive(Clone, Debug)]
pub struct Catalog {
    variants: Vec<Variant>,
}

impl Catalog {
    /// The variants built into the program.
    pub fn embedded() -> Result<Catalog, Error> {
        let mut files = Vec::new();
        collect(&BUILT_IN, &mut files);
        files.sort();
        let mut variants = Vec::new();
        for (path, text) in files {
            let file = path.replace('\\', "/");
            let Some((family, name)) = file.split_once('/') else {
                return Err(Error::Stray { file });
            };
            if family == COMMON {
                continue;
            }
            if name.contains('/')
                || Path::new(name).extension().is_none_or(|extension| extension != EXTENSION)
            {
                return Err(Error::Stray { file });
            }
            variants.extend(Variant::parse(family, &file, text)?);
        }
        let mut catalog = Catalog { variants: Vec::new() };
        catalog.add(variants)?;
        Ok(catalog)
    }

    /// Adds variants; no two may have the same family and name.
    pub fn add(&mut self, variants: Vec<Variant>) -> Result<(), Error> {
        for variant in variants {
            let same = |other: &&Variant| other.family == variant.family && other.name == variant.name;
            if let Some(earlier) = self.variants.iter().find(same) {
                return Err(Error::Duplicate {
                    id: variant.id(),
                    first: earlier.file.clone(),
                    second: variant.file.clone(),
                });
            }
            self.variants.push(variant);
        }
        Ok(())
    }

    /// Every variant, sorted by family.
    pub fn variants(&self) -> &[Variant] {
        &self.variants
    }

    /// The variants of one family.
    pub fn family<'a>(&'a self, family: &'a str) -> impl Iterator<Item = &'a Variant> {
        self.variants.iter().filter(move |variant| variant.family == family)
    }
}

fn collect<'a>(folder: &'a Dir<'a>, files: &mut Vec<(String, &'a str)>) {
    for file in folder.files() {
        let text = file.contents_utf8().unwrap_or_default();
        files.push((file.path().display().to_string(), text));
    }
    for folder in folder.dirs() {
        collect(folder, files);
    }
}

/// A kernel that copies its columns as fast as a device may: what bandwidth is measured with.
pub fn copy_kernel() -> Result<Kernel, Error> {
    let id = "ceiling/copy".to_owned();
    let spirv = glslang::compile(Source::glsl(&glsl::copy()), false)
        .map_err(|message| Error::Reflection { id: id.clone(), message })?;
    let columns = glsl::COPIED_COLUMNS;
    Ok(Kernel { id, spirv, inputs: columns, outputs: columns, tables: Vec::new(), traps: Vec::new() })
}

/// Splits `file:line: message`, where the message may hold colons.
fn locate(diagnostic: &str) -> Option<(String, usize, &str)> {
    let (place, message) = diagnostic.split_once(": ")?;
    let (file, line) = place.rsplit_once(':')?;
    Some((file.to_owned(), line.parse().ok()?, message))
}

/// A built-in file below `glsl/`: `common/clip.glsl`.
fn built_in(name: &str) -> Option<&'static str> {
    BUILT_IN.get_file(name).and_then(|file| file.contents_utf8())
}

/// Version of the GLSL compiler, for the record.
pub fn compiler_version() -> String {
    format!("glslang {}", glslang::version())
}

/// What is wrong with a variant's file. Always the file's fault, never the machine's.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("{file}:{line}: {message}")]
    FrontMatter { file: String, line: usize, message: String },
    #[error("{file}:{line}: {message} (compiling {id})")]
    Compile { id: String, file: String, line: usize, message: String },
    #[error("{file}: the function must be '{expected}' ({message})")]
    Signature { file: String, expected: String, message: String },
    #[error("{id} is declared in {first} and again in {second}")]
    Duplicate { id: String, first: String, second: String },
    #[error("{file}: variants live in glsl/<family>/<name>.{EXTENSION}, shared steps in glsl/{COMMON}/")]
    Stray { file: String },
    /// A shader of the user's own, or its adapter, cannot be used as it is.
    #[error("{file}: {message}")]
    Own { file: String, message: String },
    #[error("{id}: {message}")]
    Reflection { id: String, message: String },
}
