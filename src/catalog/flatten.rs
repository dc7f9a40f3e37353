//! A variant's text by itself: includes in place, no front matter, for whoever has no rootq.

use std::collections::BTreeSet;

use super::generate::glsl;
use super::glslang::{self, Source};
use super::{Signature, Variant, built_in};

/// Lines that a compiler other than the harness's own need not know.
const OWN: &str = "#extension GL_GOOGLE_";

impl Variant {
    /// The whole GLSL of the variant's function, from `#version` on, to which only a `main()` is missing. It includes
    /// nothing and declares nothing else; `None` for a variant that reads tables, or whose text is not GLSL.
    pub fn standalone(&self, signature: &Signature) -> Option<String> {
        if !self.tables.is_empty() {
            return None;
        }
        let prologue = glsl::prologue(signature, self.defines.iter());
        let mut text = String::new();
        for line in prologue.lines().filter(|line| !line.starts_with(OWN)) {
            text.push_str(line);
            text.push('\n');
        }
        text.push_str(&flattened(self.function()?));
        Some(text)
    }
}

/// The text after its front matter, with its includes in place.
fn flattened(text: &str) -> String {
    let body = text.split_once(FRONT_MATTER_ENDS).map_or(text, |(_, body)| body);
    let mut flat = String::new();
    flatten(body.trim_start(), 0, 0, &mut BTreeSet::new(), &mut flat);
    flat
}

/// Compiles a whole compute shader that includes nothing. The error is the compiler's first.
pub fn compile_standalone(text: &str) -> Result<Vec<u32>, String> {
    glslang::compile(Source::glsl(text), false).map_err(|log| {
        log.lines().find_map(|line| line.strip_prefix("ERROR: ")).unwrap_or(&log).trim().to_owned()
    })
}

const FRONT_MATTER_ENDS: &str = "---*/";

/// Appends `source` with its includes in place. It is inside so many `#if` of its includers, and `guards` of its own are
/// no conditions.
///
/// Every shared step is guarded: a second inclusion is empty. It is left out where the first was certainly compiled.
fn flatten(source: &str, outer: usize, guards: usize, seen: &mut BTreeSet<String>, text: &mut String) {
    let mut own = 0usize;
    for line in source.lines() {
        let directive = line.trim_start();
        if directive.starts_with("#if") {
            own += 1;
        } else if directive.starts_with("#endif") {
            own = own.saturating_sub(1);
        }
        let conditions = outer + own.saturating_sub(guards);
        let name = directive.strip_prefix("#include").map(|rest| rest.trim().trim_matches('"'));
        let included = name.and_then(|name| Some((name, built_in(name)?)));
        match included {
            Some((name, _)) if seen.contains(name) => {}
            Some((name, included)) => {
                if conditions == 0 {
                    seen.insert(name.to_owned());
                }
                // Its own guard is no condition.
                let guarded = included.lines().any(|line| line.starts_with("#ifndef ROOTQ_"));
                flatten(included, conditions, usize::from(guarded), seen, text);
            }
            None => {
                text.push_str(line);
                text.push('\n');
            }
        }
    }
}
#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::generate::Main;
    use crate::catalog::{Catalog, Field, Type, reflect, table};
    use crate::family;

    /// Every built-in variant, word by word: what is included, and in which order, is what the compiler would include.
    #[test]
    fn the_text_alone_is_the_same_shader() {
        for variant in Catalog::embedded().unwrap().variants() {
            let signature = family::find(&variant.family).unwrap().signature();
            let text = flattened(variant.function().unwrap());
            assert!(!text.contains("#include"), "{}", variant.id());
            let whole = format!(
                "{}{}{text}{}",
                glsl::prologue(&signature, variant.defines.iter()),
                glsl::tables(&table::bindings(&variant.tables)),
                glsl::epilogue(&signature, Main::Evaluate),
            );
            let mut alone = compile_standalone(&whole).unwrap();
            if variant.precise {
                alone = reflect::forbid_contraction(&alone).unwrap();
            }
            let spirv = variant.compile(&signature, false).unwrap().kernel.spirv;
            assert!(alone == spirv, "{}", variant.id());
        }
    }

    #[test]
    fn includes_are_replaced_once_and_front_matter_goes() {
        let text = "/*---\nsummary = \"s\"\nsource = \"o\"\n[[variant]]\nname = \"a\"\n---*/\n\
                    #include \"common/ellipsoid_disk.glsl\"\n#include \"common/power_of_two.glsl\"\n\
                    float f(float x) { return x; }\n";
        let variant = &Variant::parse("f", "f/a.comp", text).unwrap()[0];
        let signature = Signature {
            function: "f",
            parameters: vec![Field::new("x", Type::Float)],
            results: vec![Field::new("y", Type::Float)],
        };
        let text = variant.standalone(&signature).unwrap();
        assert!(text.starts_with("#version 450\n"), "{text}");
        assert!(
            !text.contains("#include") && !text.contains("---*/") && !text.contains("GL_GOOGLE"),
            "{text}"
        );
        let main = glsl::epilogue(&signature, Main::Evaluate);
        compile_standalone(&format!("{text}{main}")).unwrap();
        let told = compile_standalone(&text).unwrap_err();
        assert!(told.contains("entry point") && !told.contains('\n'), "{told}");
    }
}
