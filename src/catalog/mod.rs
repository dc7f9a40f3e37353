//! Finds variants, reads their front matter, generates `main()`, compiles to SPIR-V and reflects facts from it.
//!
//! `glsl/<family>/<stem>.comp` holds front matter and one function; [`Catalog::embedded`] has them all, and
//! [`Variant::compile`] turns one into a [`Kernel`].

mod flatten;
mod front_matter;
mod generate;
mod glslang;
pub mod kernel;
mod operations;
mod reflect;
pub mod signature;
mod table;

use std::collections::BTreeMap;
use std::path::Path;

use include_dir::{Dir, include_dir};

use generate::Main;

pub use flatten::compile_standalone;
pub use front_matter::{Declaration, Define, FrontMatter};
pub use kernel::{Kernel, TableBinding, TableForm};
pub use operations::Operations;
pub use reflect::Facts;
pub use signature::{Field, Signature, Type};
pub use table::{Table, TableName, tables};

static BUILT_IN: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/glsl");

/// Folder of shared steps: included by variants, holding none.
const COMMON: &str = "common";
const EXTENSION: &str = "comp";
/// The name under which glslang reports the generated part of a text.
const GENERATED: &str = "generated main()";

/// A variant's text and what its front matter says of it.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Family name, the folder's.
    pub family: String,
    pub name: String,
    pub summary: String,
    pub source: String,
    pub tried: Option<String>,
    /// File below `glsl/`, as messages name it: `ellipse_axes/cross.comp`.
    pub file: String,
    pub defines: BTreeMap<String, Define>,
    /// Built-in tables that it reads, and how.
    pub tables: BTreeMap<TableName, TableForm>,
    /// Whether every floating-point operation is decorated NoContraction.
    pub precise: bool,
    text: String,
}

/// A compiled variant and its facts.
#[derive(Clone, Debug)]
pub struct Compiled {
    pub kernel: Kernel,
    pub facts: Facts,
}

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
        for (position, variant) in variants.iter().enumerate() {
            let same = |other: &&Variant| other.family == variant.family && other.name == variant.name;
            if let Some(earlier) = variants[..position].iter().find(same) {
                return Err(Error::Duplicate {
                    id: variant.id(),
                    first: earlier.file.clone(),
                    second: variant.file.clone(),
                });
            }
        }
        Ok(Catalog { variants })
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

impl Variant {
    /// The variants that one file declares.
    pub fn parse(family: &str, file: &str, text: &str) -> Result<Vec<Variant>, Error> {
        let front = FrontMatter::parse(file, text)?;
        let variant = |declared: Declaration| Variant {
            family: family.to_owned(),
            name: declared.name,
            summary: declared.summary.unwrap_or_else(|| front.summary.clone()),
            source: front.source.clone(),
            tried: front.tried.clone(),
            file: file.to_owned(),
            defines: declared.defines,
            tables: declared.tables,
            precise: declared.precise,
            text: text.to_owned(),
        };
        Ok(front.variants.iter().cloned().map(variant).collect())
    }

    /// `family/variant`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.family, self.name)
    }

    /// Compiles the variant as `signature`'s function; `debug_lines` keeps source lines in the module.
    pub fn compile(&self, signature: &Signature, debug_lines: bool) -> Result<Compiled, Error> {
        self.compile_in(signature, debug_lines, Main::Evaluate)
    }

    /// Compiles the variant inside a loop, as many evaluations a configuration as its device is told
    /// ([`Device::repeating`](crate::device::Device::repeating)), each with inputs that depend on the last one's results.
    pub fn compile_repeating(&self, signature: &Signature) -> Result<Compiled, Error> {
        self.compile_in(signature, false, Main::Repeat)
    }

    /// What both kernels are but for the evaluation: the harness's own part of a time.
    pub fn null(signature: &Signature) -> Variant {
        let summary = "no evaluation: loads, stores and, repeating, the loop";
        Variant::generated(signature.function, "(null)", summary, generate::null(signature))
    }

    /// A variant that is in no file: `text` is a function of the signature it is going to be compiled with, and what
    /// that needs.
    pub fn generated(family: &str, name: &str, summary: &str, text: String) -> Variant {
        Variant {
            family: family.to_owned(),
            name: name.to_owned(),
            summary: summary.to_owned(),
            source: "generated".to_owned(),
            tried: None,
            file: format!("{family}/{name}"),
            defines: BTreeMap::new(),
            tables: BTreeMap::new(),
            precise: false,
            text,
        }
    }

    fn compile_in(&self, signature: &Signature, debug_lines: bool, main: Main) -> Result<Compiled, Error> {
        let tables = table::bindings(&self.tables);
        // The front matter is a GLSL comment, so the file's own line numbers hold.
        let text = format!(
            "{}{}#line 1 \"{}\"\n{}\n#line 1 \"{GENERATED}\"\n{}",
            generate::prologue(signature, self.defines.iter()),
            generate::tables(&tables),
            self.file,
            self.text,
            generate::epilogue(signature, main),
        );
        let includes = |name: &str, _includer: &str| {
            BUILT_IN.get_file(name).and_then(|file| file.contents_utf8()).map(str::to_owned)
        };
        let mut spirv =
            glslang::compile(&text, &includes, debug_lines).map_err(|log| self.failure(signature, &log))?;
        let broken = |message| Error::Reflection { id: self.id(), message };
        if self.precise {
            spirv = reflect::forbid_contraction(&spirv).map_err(broken)?;
        }
        let facts = reflect::facts(&spirv).map_err(broken)?;
        let kernel = Kernel {
            id: self.id(),
            spirv,
            inputs: signature.input_columns().len(),
            outputs: signature.output_columns().len(),
            tables,
        };
        Ok(Compiled { kernel, facts })
    }

    /// The first error of glslang's log, with file and line.
    fn failure(&self, signature: &Signature, log: &str) -> Error {
        let first = log.lines().find_map(|line| line.strip_prefix("ERROR: ")).unwrap_or(log).trim();
        let (file, line, message) = locate(first).unwrap_or((self.file.clone(), 0, first));
        if file == GENERATED {
            // The text itself is sound: its function is missing or has another signature.
            return Error::Signature {
                file: self.file.clone(),
                expected: signature.declaration(),
                message: message.to_owned(),
            };
        }
        Error::Compile { id: self.id(), file, line, message: message.to_owned() }
    }
}

/// A kernel that copies its columns as fast as a device may: what bandwidth is measured with.
pub fn copy_kernel() -> Result<Kernel, Error> {
    let id = "ceiling/copy".to_owned();
    let spirv = glslang::compile(&generate::copy(), &|_, _| None, false)
        .map_err(|message| Error::Reflection { id: id.clone(), message })?;
    let columns = generate::COPIED_COLUMNS;
    Ok(Kernel { id, spirv, inputs: columns, outputs: columns, tables: Vec::new() })
}

/// Splits `file:line: message`, where the message may hold colons.
fn locate(diagnostic: &str) -> Option<(String, usize, &str)> {
    let (place, message) = diagnostic.split_once(": ")?;
    let (file, line) = place.rsplit_once(':')?;
    Some((file.to_owned(), line.parse().ok()?, message))
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
    #[error("{id}: {message}")]
    Reflection { id: String, message: String },
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "/*---\nsummary = \"s\"\nsource = \"ours\"\n[[variant]]\nname = \"plain\"\n[[variant]]\n\
                        name = \"exact\"\nprecise = true\n---*/\n";

    fn signature() -> Signature {
        Signature {
            function: "scaled_sum",
            parameters: vec![Field::new("m", Type::Mat3), Field::new("v", Type::Vec3)],
            results: vec![Field::new("sum", Type::Vec3), Field::new("length_squared", Type::Float)],
        }
    }

    fn variants(body: &str) -> Vec<Variant> {
        Variant::parse("scaled_sum", "scaled_sum/a.comp", &format!("{HEAD}{body}")).unwrap()
    }

    const BODY: &str = "ScaledSum scaled_sum(mat3 m, vec3 v) {\n    vec3 s = m * v;\n    \
                        return ScaledSum(s, dot(s, s));\n}\n";

    #[test]
    fn precise_decorates_all_arithmetic() {
        let variants = variants(BODY);
        let plain = variants[0].compile(&signature(), false).unwrap().facts;
        let exact = variants[1].compile(&signature(), false).unwrap().facts;
        assert_eq!((plain.no_contraction, plain.arithmetic), (0, 2));
        assert_eq!((exact.no_contraction, exact.arithmetic), (2, 2));
        assert_eq!(plain.local_size, [kernel::LOCAL_SIZE, 1, 1]);
        assert_eq!(plain.float_operations, exact.float_operations);
        assert_ne!(plain.sha256, exact.sha256);
    }

    /// The loop's own arithmetic is the perturbation, uncontracted: one multiplication a parameter.
    #[test]
    fn a_timing_loop_repeats_the_same_arithmetic() {
        let variants = variants(BODY);
        let once = variants[0].compile(&signature(), false).unwrap().facts;
        let repeated = variants[0].compile_repeating(&signature()).unwrap();
        assert_eq!(repeated.facts.arithmetic, once.arithmetic + 2);
        // glslang decorates the integer subtraction behind the factor, too.
        assert_eq!(repeated.facts.no_contraction, 3);
        let null = Variant::null(&signature());
        assert_eq!(null.compile(&signature(), false).unwrap().facts.arithmetic, 0);
        assert_eq!(null.compile_repeating(&signature()).unwrap().facts.arithmetic, 2);
    }

    #[test]
    fn debug_lines_only_on_request() {
        let variant = &variants(BODY)[0];
        let without = variant.compile(&signature(), false).unwrap().kernel.spirv;
        let with = variant.compile(&signature(), true).unwrap().kernel.spirv;
        let has_lines = |words: &[u32]| {
            let module = rspirv::dr::load_words(words).unwrap();
            module
                .functions
                .iter()
                .flat_map(|f| f.all_inst_iter())
                .any(|i| i.class.opcode == rspirv::spirv::Op::Line)
        };
        assert!(!has_lines(&without));
        assert!(has_lines(&with));
    }

    #[test]
    fn an_error_names_the_authors_line() {
        let error = variants(&BODY.replace("m * v", "m * w"))[0].compile(&signature(), false).unwrap_err();
        assert!(
            error.to_string().starts_with("scaled_sum/a.comp:11: 'w' : undeclared identifier"),
            "{error}"
        );
    }

    #[test]
    fn a_wrong_signature_is_told_as_such() {
        let error = variants(&BODY.replace("vec3 v)", "vec2 w)").replace("m * v", "m * vec3(w, 0)"))[0]
            .compile(&signature(), false)
            .unwrap_err();
        let message = error.to_string();
        assert!(message.contains("must be 'ScaledSum scaled_sum(mat3 m, vec3 v)'"), "{message}");
    }

    /// No built-in table has four channels yet, so their declarations are compiled here.
    #[test]
    fn tables_of_either_shape_and_form_compile() {
        for form in [TableForm::Buffer, TableForm::Image] {
            let table = |name, binding, channels| TableBinding {
                name,
                binding,
                form,
                width: 8,
                height: 4,
                channels,
                texels: std::sync::Arc::from(vec![0.0; 32 * channels as usize]),
            };
            let text = format!(
                "{}{}ScaledSum scaled_sum(mat3 m, vec3 v) {{\n    return ScaledSum(grey_at(v.xy) * v, quad_at(v.yz).w);\n}}\n{}",
                generate::prologue(&signature(), [].into_iter()),
                generate::tables(&[table("grey", 2, 1), table("quad", 3, 4)]),
                generate::epilogue(&signature(), Main::Evaluate),
            );
            let spirv = glslang::compile(&text, &|_, _| None, false).unwrap();
            assert!(reflect::facts(&spirv).unwrap().words > 100);
        }
    }
}
