//! One variant: its text, what its front matter says, and the kernel it compiles to.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::front_matter::{Declaration, Define, FrontMatter};
use super::generate::{Main, glsl};
use super::glslang::{self, FrontEnd, Source};
use super::kernel::{Kernel, TableBinding, TableForm};
use super::own::{self, Request, Shader, compose::Target};
use super::reflect::{self, Facts};
use super::table::{self, TableName};
use super::{Error, GENERATED, Language, Signature, built_in, locate};

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
    text: Text,
}

#[derive(Clone, Debug)]
enum Text {
    /// GLSL: the family's function and what it needs.
    Function(String),
    /// A shader of the user's own.
    Own(Arc<Shader>),
}

/// A compiled variant and its facts.
#[derive(Clone, Debug)]
pub struct Compiled {
    pub kernel: Kernel,
    /// The same for an audit, of a shader of the user's own that indexes arrays: with every index watched, and slower.
    pub watched: Option<Kernel>,
    /// Of `kernel`.
    pub facts: Facts,
}

impl Compiled {
    /// The kernel to evaluate where its time does not matter.
    pub fn into_safe(self) -> Kernel {
        self.watched.unwrap_or(self.kernel)
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
            text: Text::Function(text.to_owned()),
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
        Variant::generated(signature.function, "(null)", summary, glsl::null(signature))
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
            text: Text::Function(text),
        }
    }

    fn compile_in(&self, signature: &Signature, debug_lines: bool, main: Main) -> Result<Compiled, Error> {
        let tables = table::bindings(&self.tables);
        let id = self.id();
        let target =
            Target { id: &id, signature, defines: &self.defines, tables: &tables, main, debug_lines };
        let mut spirv = match &self.text {
            Text::Function(text) => self.compile_function(text, signature, &tables, debug_lines, main)?,
            Text::Own(shader) => shader.compile(&target)?,
        };
        let broken = |message| Error::Reflection { id: self.id(), message };
        if self.precise {
            spirv = reflect::forbid_contraction(&spirv).map_err(broken)?;
        }
        let facts = reflect::facts(&spirv).map_err(broken)?;
        let kernel = |spirv, traps| Kernel {
            id: self.id(),
            spirv,
            inputs: signature.input_columns().len(),
            outputs: signature.output_columns().len(),
            tables: tables.clone(),
            traps,
        };
        let watched = match &self.text {
            Text::Own(shader) if main == Main::Evaluate => {
                let (words, traps) = shader.watched(&spirv, &target, self.precise)?;
                (!traps.is_empty()).then(|| kernel(words, traps))
            }
            _ => None,
        };
        Ok(Compiled { kernel: kernel(spirv, Vec::new()), watched, facts })
    }

    fn compile_function(
        &self,
        text: &str,
        signature: &Signature,
        tables: &[TableBinding],
        debug_lines: bool,
        main: Main,
    ) -> Result<Vec<u32>, Error> {
        // The front matter is a GLSL comment, so the file's own line numbers hold.
        let text = format!(
            "{}{}#line 1 \"{}\"\n{text}\n#line 1 \"{GENERATED}\"\n{}",
            glsl::prologue(signature, self.defines.iter()),
            glsl::tables(tables),
            self.file,
            glsl::epilogue(signature, main),
        );
        let includes = |name: &str, _includer: &str| built_in(name).map(str::to_owned);
        let source = Source { text: &text, front_end: FrontEnd::Glsl, includes: &includes };
        glslang::compile(source, debug_lines).map_err(|log| self.failure(signature, &log))
    }

    /// Variants of a shader of the user's own.
    pub fn own(request: &Request) -> Result<Vec<Variant>, Error> {
        let own::Loaded { family, shader, declarations, source, tried, summary } = own::load(request)?;
        let shader = Arc::new(shader);
        let variant = |declared: Declaration| Variant {
            family: family.clone(),
            name: declared.name,
            summary: declared.summary.unwrap_or_else(|| summary.clone()),
            source: source.clone(),
            tried: tried.clone(),
            file: request.file.display().to_string(),
            defines: declared.defines,
            tables: declared.tables,
            precise: declared.precise,
            text: Text::Own(Arc::clone(&shader)),
        };
        Ok(declarations.into_iter().map(variant).collect())
    }

    /// Whether it is the user's own and not built in.
    pub fn is_own(&self) -> bool {
        matches!(self.text, Text::Own(_))
    }

    /// The family's function and what it needs, with front matter, if it is built in.
    pub(super) fn function(&self) -> Option<&str> {
        match &self.text {
            Text::Function(text) => Some(text),
            Text::Own(_) => None,
        }
    }

    /// What it is written in.
    pub fn language(&self) -> Language {
        match &self.text {
            Text::Function(_) => Language::Glsl,
            Text::Own(shader) => shader.language(),
        }
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

#[cfg(test)]
mod tests {
    use super::super::{Field, Type, kernel};
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
                glsl::prologue(&signature(), [].into_iter()),
                glsl::tables(&[table("grey", 2, 1), table("quad", 3, 4)]),
                glsl::epilogue(&signature(), Main::Evaluate),
            );
            let spirv = glslang::compile(Source::glsl(&text), false).unwrap();
            assert!(reflect::facts(&spirv).unwrap().words > 100);
        }
    }
}
