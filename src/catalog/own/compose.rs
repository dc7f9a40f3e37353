//! Puts a shader, its adapter and the generated parts together, and compiles them; mistakes are told where they were
//! made: on the shader's own line, or in the part of the adapter.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::adapter::Adapter;
use super::items::Outline;
use super::neutral::{Missing, Neutral, What, neutral};
use super::tokens::{Kind, tokens};
use super::wrapper::{Callee, Section, WRAPPER, samplers, wrapper};
use super::{Content, Shader, bounds, link};
use crate::catalog::generate::{Main, glsl, hlsl, wgsl};
use crate::catalog::glslang::{self, FrontEnd, Source};
use crate::catalog::kernel::TableBinding;
use crate::catalog::{Define, Error, GENERATED, Language, Signature, locate, naga, reflect, table};

/// What a shader is compiled as.
pub(in crate::catalog) struct Target<'a> {
    /// `family/variant`.
    pub(in crate::catalog) id: &'a str,
    pub(in crate::catalog) signature: &'a Signature,
    /// Of this variant, over the adapter's own.
    pub(in crate::catalog) defines: &'a BTreeMap<String, Define>,
    pub(in crate::catalog) tables: &'a [TableBinding],
    pub(in crate::catalog) main: Main,
    pub(in crate::catalog) debug_lines: bool,
}

impl Shader {
    /// The module, whose entry point is `main`.
    pub(in crate::catalog) fn compile(&self, target: &Target<'_>) -> Result<Vec<u32>, Error> {
        self.check_adapter(target)?;
        match (&self.content, self.language) {
            (Content::Words(words), _) => self.link(words, target),
            (Content::Text(text), Language::Wgsl) => self.compile_wgsl(text, target),
            (Content::Text(text), _) => self.compile_with_glslang(text, target),
        }
    }

    /// The module `words` that this shader compiled to with every index watched, and the places where it may leave an
    /// array; none if there is nothing to watch.
    pub(in crate::catalog) fn watched(
        &self,
        words: &[u32],
        target: &Target<'_>,
        precise: bool,
    ) -> Result<(Vec<u32>, Vec<String>), Error> {
        let watch = |words: &[u32]| bounds::watch(words).map_err(|message| self.fail(message));
        let (plain, places) = watch(words)?;
        if places.is_empty() || target.debug_lines {
            return Ok((plain, places));
        }
        // Once more, with the lines.
        let mut words = self.compile(&Target { debug_lines: true, ..*target })?;
        if precise {
            words = reflect::forbid_contraction(&words).map_err(|message| self.fail(message))?;
        }
        let (words, mut places) = watch(&words)?;
        for place in &mut places {
            if place.is_empty() {
                place.clone_from(&self.file);
            }
        }
        Ok((words, places))
    }

    pub(in crate::catalog) fn language(&self) -> Language {
        self.language
    }

    fn fail(&self, message: impl Into<String>) -> Error {
        Error::Own { file: self.file.clone(), message: message.into() }
    }

    fn fail_adapter(&self, message: impl Into<String>) -> Error {
        Error::Own { file: self.place.clone(), message: message.into() }
    }

    /// What the family has no place for.
    fn check_adapter(&self, target: &Target<'_>) -> Result<(), Error> {
        let Adapter { result, results, uniforms, .. } = &self.adapter;
        let fields = &target.signature.results;
        let names: Vec<&str> = fields.iter().map(|field| field.name).collect();
        if result.is_some() && fields.len() > 1 {
            return Err(self.fail_adapter(format!(
                "the family has several results, {}: give each in [results]",
                names.join(", ")
            )));
        }
        if let Some(unknown) = results.keys().find(|key| !names.contains(&key.as_str())) {
            return Err(self.fail_adapter(format!(
                "[results] has '{unknown}', but the family's results are {}",
                names.join(", ")
            )));
        }
        let parameters = &target.signature.parameters;
        if let Some(clash) = uniforms.keys().find(|key| parameters.iter().any(|field| field.name == **key)) {
            return Err(self.fail_adapter(format!(
                "the uniform '{clash}' has the name of the family's parameter: give it another with [rename]"
            )));
        }
        Ok(())
    }

    /// What the shader's own text is preprocessed with: renamed names and definitions.
    fn defines(&self, target: &Target<'_>) -> BTreeMap<String, String> {
        let mut defines = self.adapter.rename.clone();
        defines.extend(self.definitions(target));
        defines
    }

    /// All definitions: the adapter's, the variant's, the command line's.
    fn definitions(&self, target: &Target<'_>) -> BTreeMap<String, String> {
        let mut defines = BTreeMap::new();
        for more in [&self.adapter.defines, target.defines, &self.defines] {
            defines.extend(more.iter().map(|(name, value)| (name.clone(), value.to_string())));
        }
        defines
    }

    fn compile_with_glslang(&self, text: &str, target: &Target<'_>) -> Result<Vec<u32>, Error> {
        let signature = target.signature;
        let hlsl = self.language == Language::Hlsl;
        let front_end = if hlsl { FrontEnd::Hlsl } else { FrontEnd::Glsl };
        let mut own = String::new();
        if !hlsl {
            own.push_str(GLSL_HEAD);
        }
        for (name, value) in self.defines(target) {
            _ = writeln!(own, "#define {name} {value}");
        }
        if let Some(preamble) = &self.adapter.preamble {
            _ = writeln!(own, "#line 1 \"{}, 'preamble'\"\n{preamble}", self.place);
        }
        for (position, include) in self.adapter.include.iter().enumerate() {
            _ = writeln!(own, "#line {} \"{}, 'include'\"\n#include \"{include}\"", position + 1, self.place);
        }
        _ = write!(own, "#line 1 \"{}\"\n{}\n", self.file, without_version(text));
        let includes = |name: &str, includer: &str| self.includes.find(name, includer);
        let source = Source { text: &own, front_end, includes: &includes };
        let flat = glslang::preprocess(source).map_err(|log| self.told(&log, target, None))?;

        let outline = Outline::of(&flat);
        let (neutral, wrapper) = self.adapt(&outline, target)?;
        let mut text = String::new();
        if !hlsl {
            text.push_str(GLSL_HEAD);
            for extension in &neutral.extensions {
                _ = writeln!(text, "{extension}");
            }
        }
        let (head, tables, tail) = if hlsl {
            (
                hlsl::result_struct(signature),
                hlsl::tables(target.tables),
                hlsl::epilogue(signature, target.main),
            )
        } else {
            (
                glsl::result_struct(signature),
                glsl::tables(target.tables),
                glsl::epilogue(signature, target.main),
            )
        };
        let aliases = samplers(self.language, &self.adapter, &neutral.reads, target.tables);
        let mut sections = vec![
            Section::new(GENERATED, format!("{head}{tables}{aliases}")),
            Section::new(self.file.clone(), neutral.text),
        ];
        sections.extend(wrapper);
        sections.push(Section::new(GENERATED, tail));
        // The adapter's text may use the definitions, too; the generated part must not meet them.
        let words = self.definitions(target);
        let define: String = words.iter().map(|(name, value)| format!("#define {name} {value}\n")).collect();
        let forget: String = words.keys().map(|name| format!("#undef {name}\n")).collect();
        sections.insert(2, Section::new(GENERATED, define));
        sections.insert(sections.len() - 1, Section::new(GENERATED, forget));
        for Section { name, text: part } in sections {
            _ = write!(text, "#line 1 \"{name}\"\n{part}\n");
        }
        let source = Source { text: &text, front_end, includes: &includes };
        glslang::compile(source, target.debug_lines).map_err(|log| self.told(&log, target, Some(&outline)))
    }

    /// The text without a pipeline, and the family's function around what it calls.
    fn adapt(&self, outline: &Outline<'_>, target: &Target<'_>) -> Result<(Neutral, Vec<Section>), Error> {
        let family = target.signature.function;
        let wraps = self.adapter.calls(family);
        let name = self.adapter.function.as_deref().unwrap_or(family);
        let callee = if self.adapter.body.is_some() { None } else { Some(self.callee(outline, name)?) };
        let mut sections = Vec::new();
        if let Some(declarations) = &self.adapter.declarations {
            sections
                .push(Section::new(format!("{}, 'declarations'", self.place), format!("{declarations}\n")));
        }
        if wraps {
            let callee = callee.as_ref();
            sections.extend(wrapper(self.language, target.signature, &self.adapter, callee, &self.place));
        }
        let words: Vec<&str> = sections
            .iter()
            .flat_map(|section| tokens(&section.text))
            .filter(|token| token.kind == Kind::Word)
            .map(|token| token.text)
            .chain([name])
            .collect();
        let aside = Some(family).filter(|_| wraps);
        let neutral = neutral(outline, self.language, &words, aside, &self.adapter)
            .map_err(|missing| self.missing(outline, &missing))?;
        Ok((neutral, sections))
    }

    /// The shader's function of that name.
    fn callee<'a>(&self, outline: &Outline<'_>, name: &'a str) -> Result<Callee<'a>, Error> {
        let Some(item) = outline.functions(name).next() else {
            let names = outline.function_names().into_iter().filter(|name| !name.starts_with("rootq_"));
            let names: Vec<&str> = names.collect();
            return Err(self.fail(if names.is_empty() {
                format!("there is no function in it; '{name}' is asked for")
            } else {
                format!(
                    "there is no function '{name}' in it, but: {} ('function = \"...\"' in the adapter names the one)",
                    names.join(", ")
                )
            }));
        };
        let super::items::ItemKind::Function { name: at, .. } = item.kind else {
            return Err(self.fail("no function"));
        };
        if self.language == Language::Wgsl {
            let tokens = outline.item_tokens(item);
            let head = tokens.iter().take_while(|token| !token.is("{"));
            let arrows = head.clone().zip(head.skip(1)).filter(|(a, b)| a.is("-") && b.is(">"));
            return Ok(Callee { name, returns: None, value: arrows.count() > 0 });
        }
        let mut words = Vec::new();
        let mut position = item.range.start;
        while position < at {
            if outline.tokens[position].is("[") && words.is_empty() {
                position = super::tokens::close(&outline.tokens, position);
                continue;
            }
            if !["static", "inline", "precise", "const"].contains(&outline.tokens[position].text) {
                words.push(outline.tokens[position].text);
            }
            position += 1;
        }
        let returns = Some(words.join(" ")).filter(|returns| returns != "void");
        Ok(Callee { name, value: returns.is_some(), returns })
    }

    fn missing(&self, outline: &Outline<'_>, missing: &Missing) -> Error {
        let (file, line) = outline.line(missing.at);
        let file = format!("{}:{line}", file.unwrap_or_else(|| self.file.clone()));
        let name = &missing.name;
        let message = match missing.what {
            What::Value => format!(
                "'{name}' is set by the application; give it a value in the adapter: [uniforms] {name} = \"...\""
            ),
            What::Table => format!(
                "'{name}' is a texture; name a table for it in the adapter: [samplers] {name} = \"...\"; there are: {}",
                table::tables().iter().map(|table| table.name).collect::<Vec<_>>().join(", ")
            ),
            What::Memory => format!(
                "'{name}' is memory outside of the function, which only evaluates: name another function or include \
                 what does without it"
            ),
        };
        Error::Own { file, message }
    }

    fn compile_wgsl(&self, text: &str, target: &Target<'_>) -> Result<Vec<u32>, Error> {
        let signature = target.signature;
        // There is no preprocessor: definitions are constants, names are replaced word by word, files come before.
        let mut defines = String::new();
        for more in [&self.adapter.defines, target.defines, &self.defines] {
            for (name, value) in more {
                _ = writeln!(defines, "const {name} = {value};");
            }
        }
        let mut sections = vec![Section::new(GENERATED, defines + &wgsl::result_struct(signature))];
        sections.push(Section::new(GENERATED, wgsl::tables(target.tables)));
        if let Some(preamble) = &self.adapter.preamble {
            sections.push(Section::new(format!("{}, 'preamble'", self.place), format!("{preamble}\n")));
        }
        let mut own = String::new();
        for name in &self.adapter.include {
            let file = self.includes.find(name, &self.file);
            let file =
                file.ok_or_else(|| self.fail_adapter(format!("'include': there is no file '{name}'")))?;
            _ = write!(own, "#line 1 \"{name}\"\n{file}\n");
        }
        _ = write!(own, "#line 1 \"{}\"\n{}\n", self.file, renamed(text, &self.adapter.rename));
        let outline = Outline::of(&own);
        let (neutral, wrapper) = self.adapt(&outline, target)?;
        let aliases = samplers(self.language, &self.adapter, &neutral.reads, target.tables);
        sections.push(Section::new(GENERATED, aliases));
        sections.push(Section::new(self.file.clone(), neutral.text.replace("#line ", "//line ")));
        sections.extend(wrapper);
        sections.push(Section::new(GENERATED, wgsl::epilogue(signature, target.main)));
        let whole: String = sections.iter().map(|section| section.text.clone() + "\n").collect();
        let words = naga::compile(&whole, wgsl::ENTRY).map_err(|mistake| {
            let (file, line) = place_in(&sections, &own, mistake.line);
            self.mistake(&file, line, &mistake.message, target, Some(&outline))
        })?;
        reflect::rename_entry_point(&words, wgsl::ENTRY, "main").map_err(|message| self.fail(message))
    }

    fn link(&self, words: &[u32], target: &Target<'_>) -> Result<Vec<u32>, Error> {
        let Adapter { function, .. } = &self.adapter;
        let plain = Adapter {
            summary: self.adapter.summary.clone(),
            source: self.adapter.source.clone(),
            tried: self.adapter.tried.clone(),
            family: self.adapter.family.clone(),
            variants: self.adapter.variants.clone(),
            function: function.clone(),
            ..Adapter::default()
        };
        if self.adapter != plain || !self.defines.is_empty() {
            return Err(self.fail_adapter(
                "a SPIR-V module has no text to adapt: only 'function' can be told, and it must have the family's shape",
            ));
        }
        let theirs = rspirv::dr::load_words(words)
            .map_err(|error| self.fail(format!("not a SPIR-V module that can be read: {error}")))?;
        let signature = target.signature;
        let stub = glsl::stub(signature);
        let text = format!(
            "{}{stub}{}",
            glsl::prologue(signature, [].into_iter()),
            glsl::epilogue(signature, target.main)
        );
        let ours = glslang::compile(Source::glsl(&text), target.debug_lines)
            .map_err(|log| self.fail(format!("the generated part does not compile: {log}")))?;
        let ours = rspirv::dr::load_words(&ours).map_err(|error| self.fail(error.to_string()))?;
        let name = function.as_deref().unwrap_or(signature.function);
        link::link(ours, signature.function, &theirs, name).map_err(|message| self.fail(message))
    }

    /// The first error of glslang's log.
    fn told(&self, log: &str, target: &Target<'_>, outline: Option<&Outline<'_>>) -> Error {
        let mut lines = log.lines().skip_while(|line| !line.starts_with("ERROR: "));
        let first = lines.next().and_then(|line| line.strip_prefix("ERROR: ")).unwrap_or(log).trim();
        let Some((file, line, message)) = locate(first) else {
            // The linker's: which functions, is told on the lines that follow.
            let rest: Vec<&str> =
                lines.take_while(|line| !line.starts_with("ERROR: ")).map(str::trim).collect();
            let message = first.rsplit_once("stage: ").map_or(first, |(_, message)| message);
            return self.fail(format!("{message} {}", rest.join(" ")).trim().to_owned());
        };
        self.mistake(&file, line, message, target, outline)
    }

    fn mistake(
        &self,
        file: &str,
        line: usize,
        message: &str,
        target: &Target<'_>,
        outline: Option<&Outline<'_>>,
    ) -> Error {
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let name = self.adapter.function.as_deref().unwrap_or(target.signature.function);
        let head = outline.and_then(|outline| {
            let item = outline.functions(name).next()?;
            let text = &outline.text[outline.span(item)];
            Some(text.split('{').next()?.split_whitespace().collect::<Vec<_>>().join(" "))
        });
        let generated = file == GENERATED || file == WRAPPER;
        match head {
            Some(head) if generated && !self.adapter.calls(target.signature.function) => Error::Own {
                file: self.file.clone(),
                message: format!(
                    "the function is '{head}'; the family's is '{}'. Write it so, or say with 'function', 'arguments' \
                     and 'result' in an adapter how to call yours ({message})",
                    target.signature.declaration_in(self.language)
                ),
            },
            Some(head) if file.ends_with("'arguments'") => Error::Own {
                file: file.to_owned(),
                message: format!("the call does not fit '{head}' ({message})"),
            },
            _ if generated => Error::Own { file: self.file.clone(), message },
            _ => Error::Compile { id: target.id.to_owned(), file: file.to_owned(), line, message },
        }
    }
}

const GLSL_HEAD: &str = "#version 450\n#extension GL_GOOGLE_include_directive : require\n\
                         #extension GL_GOOGLE_cpp_style_line_directive : require\n";

/// The text with its `#version` line empty: there is one already.
fn without_version(text: &str) -> String {
    let keep = |line: &str| {
        let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
        !directive.is_some_and(|rest| rest.starts_with("version"))
    };
    text.split('\n').map(|line| if keep(line) { line } else { "" }).collect::<Vec<_>>().join("\n")
}

/// The text with words replaced.
fn renamed(text: &str, names: &BTreeMap<String, String>) -> String {
    let mut edits = super::edits::Edits::default();
    for token in tokens(text).iter().filter(|token| token.kind == Kind::Word) {
        if let Some(new) = names.get(token.text) {
            edits.replace(token.at..token.end(), new);
        }
    }
    edits.apply(text)
}

/// The part and the line in it that a line of the whole text is.
fn place_in(sections: &[Section], own: &str, line: Option<usize>) -> (String, usize) {
    let Some(line) = line else {
        return (GENERATED.to_owned(), 0);
    };
    let mut first = 1;
    let mut found = (GENERATED.to_owned(), 0);
    for Section { name, text } in sections {
        let lines = text.matches('\n').count() + 1;
        if line < first + lines {
            found = (name.clone(), line - first + 1);
            break;
        }
        first += lines;
    }
    // The shader's own part may hold several files.
    let starts: Vec<(usize, &str)> = own
        .lines()
        .enumerate()
        .filter_map(|(at, text)| Some((at + 1, text.strip_prefix("#line 1 \"")?.trim_end_matches('"'))))
        .collect();
    let (name, line) = found;
    if starts.last().is_some_and(|(_, last)| *last == name)
        && let Some((at, file)) = starts.iter().rev().find(|(at, _)| *at <= line)
    {
        return ((*file).to_owned(), line - at);
    }
    (name, line)
}
