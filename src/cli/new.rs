//! `rootq new`: a shader to begin with.

use std::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, ValueEnum};

use super::draft::is_dash;
use super::selection;
use crate::catalog::{Catalog, Field, Language, Signature, Type};
use crate::family::{Problem, Relation};

/// Options of `rootq new`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    rootq new ellipse_axes/mine                       writes mine.comp\n  \
    rootq new ltc_disk/mine --language wgsl --output - | less")]
pub(super) struct Arguments {
    /// The family whose function it is, and the new variant's name
    #[arg(value_name = "FAMILY/VARIANT")]
    id: String,
    /// Language to write it in [default: by --output's ending, else GLSL]
    #[arg(long, value_enum)]
    language: Option<Written>,
    /// File to write; '-' is standard output [default: VARIANT.comp, .hlsl or .wgsl]
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file if there is one
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Written {
    Glsl,
    Hlsl,
    Wgsl,
}

impl From<Written> for Language {
    fn from(written: Written) -> Self {
        match written {
            Written::Glsl => Language::Glsl,
            Written::Hlsl => Language::Hlsl,
            Written::Wgsl => Language::Wgsl,
        }
    }
}

pub(super) fn new(arguments: &Arguments) -> Result<()> {
    let (family, name) = arguments
        .id
        .split_once('/')
        .ok_or_else(|| anyhow!("'{}' is not FAMILY/VARIANT, such as ellipse_axes/mine", arguments.id))?;
    let problem = selection::family(family)?;
    if name.is_empty() || !name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_') {
        bail!("variant name '{name}' must be lower-case letters, digits and '_'");
    }
    if Catalog::embedded()?.family(family).any(|variant| variant.name == name) {
        bail!("{family}/{name} is built in already; choose another name");
    }
    let by_ending = arguments.output.as_deref().filter(|path| !is_dash(path)).map(|path| {
        Language::of(path).filter(|language| *language != Language::Spirv).ok_or_else(|| {
            anyhow!("the ending of {} is of no language; there are .comp, .hlsl and .wgsl", path.display())
        })
    });
    let by_ending = by_ending.transpose()?;
    let language = match (arguments.language.map(Language::from), by_ending) {
        (Some(language), Some(ending)) if language != ending => bail!(
            "--language says {}, the ending of --output {}; 'rootq run' goes by the ending",
            language.name(),
            ending.name()
        ),
        (language, ending) => language.or(ending).unwrap_or_default(),
    };
    let ending = match language {
        Language::Hlsl => "hlsl",
        Language::Wgsl => "wgsl",
        Language::Glsl | Language::Spirv => "comp",
    };
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.{ending}")));
    let text = template(problem, name, language, &path);
    if is_dash(&path) {
        return super::print(&text);
    }
    write(&path, &text, arguments.force)?;
    eprintln!("{}: next, rootq run --shader {} --family {family}", path.display(), path.display());
    Ok(())
}

/// Writes a file that, without `force`, was not there.
fn write(path: &Path, text: &str, force: bool) -> Result<()> {
    let mut options = OpenOptions::new();
    options.write(true).truncate(true);
    let opened = if force { options.create(true).open(path) } else { options.create_new(true).open(path) };
    let mut file = match opened {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            bail!("{} is there already; --force replaces it, --output names another", path.display())
        }
        opened => opened.with_context(|| format!("cannot write {}", path.display()))?,
    };
    file.write_all(text.as_bytes()).with_context(|| format!("cannot write {}", path.display()))
}

/// The text of a shader that compiles and computes nothing yet.
fn template(problem: &dyn Problem, name: &str, language: Language, path: &Path) -> String {
    let signature = problem.signature();
    let mut text = format!(
        "/*---\n\
         summary = \"What is special about it, one line\"\n\
         source = \"Where it comes from: a publication, or ours\"\n\
         [[variant]]\n\
         name = \"{name}\"\n"
    );
    if language != Language::Wgsl {
        text.push_str(
            "# The same text again, with its own definitions, or with every operation decorated NoContraction:\n\
             # [[variant]]\n\
             # name = \"another\"\n\
             # defines = { STEPS = 2 }\n\
             # precise = true\n",
        );
    }
    text.push_str("---*/\n\n");
    let mut comment = String::new();
    _ = writeln!(comment, "{}.\n", problem.summary());
    _ = writeln!(comment, "Parameters, every component a column of 'rootq eval':");
    fields(&mut comment, &signature.parameters, language, |_| String::new());
    _ = writeln!(comment, "\n{}", results_heading(&signature));
    fields(&mut comment, &signature.results, language, |at| {
        let output = &problem.outputs()[at];
        format!("; {}, tolerance {}", output.quantity.measure(), output.tolerance)
    });
    for relation in problem.relations() {
        _ = writeln!(comment, "{}", relation_in_words(problem, *relation));
    }
    _ = writeln!(comment, "\nConfigurations that it will meet, by scenario:");
    lines(&mut comment, problem.scenarios().iter().map(|scenario| (scenario.name, scenario.summary)));
    if !problem.landmarks().is_empty() {
        _ = writeln!(comment, "\nFailures are told apart along:");
        lines(&mut comment, problem.landmarks().iter().map(|landmark| (landmark.name, landmark.summary)));
    }
    let (family, file) = (problem.name(), path.display());
    let file = if is_dash(path) { format!("{name}.comp") } else { file.to_string() };
    _ = write!(
        comment,
        "\nNext:\n    \
             rootq run --shader {file} --family {family}            errors and times\n    \
             rootq run {family} --shader {file}                     beside the built-in variants\n    \
             rootq hunt --shader {file} --family {family}           its worst configurations\n    \
             rootq eval {family} --inputs in.csv --shader {file}    your configurations\n"
    );
    for line in comment.lines() {
        text.push_str(format!("// {line}").trim_end());
        text.push('\n');
    }
    _ = writeln!(text, "{} {{", signature.declaration_in(language));
    text.push_str(&body(&signature, language));
    text.push_str("}\n");
    text
}

/// A line a field: type, name and columns.
fn fields(text: &mut String, fields: &[Field], language: Language, more: impl Fn(usize) -> String) {
    let types: Vec<&str> = fields.iter().map(|field| language.type_name(field.ty)).collect();
    let widest = |lengths: &mut dyn Iterator<Item = usize>| lengths.max().unwrap_or(0);
    let type_width = widest(&mut types.iter().map(|ty| ty.len()));
    let name_width = widest(&mut fields.iter().map(|field| field.name.len()));
    for (at, (field, ty)) in fields.iter().zip(types).enumerate() {
        let columns = match field.ty {
            Type::Float => String::new(),
            Type::Mat3 => format!("  {}_CR: column C, row R", field.name),
            Type::Vec2 | Type::Vec3 | Type::Vec4 => {
                format!("  {}", field.columns().collect::<Vec<_>>().join(" "))
            }
        };
        let line = format!("    {ty:type_width$} {:name_width$}{columns}{}", field.name, more(at));
        _ = writeln!(text, "{}", line.trim_end());
    }
}

fn results_heading(signature: &Signature) -> String {
    match signature.results.len() {
        1 => "Result:".to_owned(),
        _ => format!("Results, the fields of {}, which is declared for you:", signature.result_type()),
    }
}

fn relation_in_words(problem: &dyn Problem, relation: Relation) -> String {
    let name = |at: usize| problem.outputs()[at].field.name;
    match relation {
        Relation::Orthogonal(a, b) => format!("{} and {} must be orthogonal.", name(a), name(b)),
        Relation::Encloses { min, max } => {
            format!("{} and {} must enclose the exact box, to the last bit.", name(min), name(max))
        }
    }
}

/// Names and what they mean, in two columns.
fn lines<'a>(text: &mut String, rows: impl Iterator<Item = (&'a str, &'a str)> + Clone) {
    let width = rows.clone().map(|(name, _)| name.len()).max().unwrap_or(0);
    for (name, summary) in rows {
        _ = writeln!(text, "    {name:width$}  {summary}");
    }
}

/// Zero for every result.
fn body(signature: &Signature, language: Language) -> String {
    let zero = |ty: Type| {
        let name = language.type_name(ty);
        match (language, ty) {
            (_, Type::Float) => "0.0".to_owned(),
            (Language::Hlsl, _) => format!("({name})0.0"),
            (Language::Wgsl, _) => format!("{name}()"),
            (Language::Glsl | Language::Spirv, _) => format!("{name}(0.0)"),
        }
    };
    if let [only] = signature.results.as_slice() {
        return format!("    return {};\n", zero(only.ty));
    }
    let mut text = match language {
        Language::Wgsl => format!("    var r: {};\n", signature.result_type()),
        _ => format!("    {} r;\n", signature.result_type()),
    };
    for field in &signature.results {
        _ = writeln!(text, "    r.{} = {};", field.name, zero(field.ty));
    }
    text.push_str("    return r;\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalog::{Request, Variant};
    use crate::family::FAMILIES;

    /// In its own file, and in GLSL as a built-in one, too.
    #[test]
    fn every_familys_template_compiles_in_every_language() {
        let folder = tempfile::tempdir().unwrap();
        for problem in FAMILIES {
            for language in [Language::Glsl, Language::Hlsl, Language::Wgsl] {
                let ending = match language {
                    Language::Hlsl => "hlsl",
                    Language::Wgsl => "wgsl",
                    _ => "comp",
                };
                let path = folder.path().join(format!("{}.{ending}", problem.name()));
                let text = template(*problem, "mine", language, &path);
                std::fs::write(&path, &text).unwrap();
                let family = Some(problem.name().to_owned());
                let mut variants =
                    Variant::own(&Request { file: path, family, ..Request::default() }).unwrap();
                if language == Language::Glsl {
                    variants.extend(Variant::parse(problem.name(), "mine.comp", &text).unwrap());
                }
                for variant in variants {
                    assert_eq!(variant.id(), format!("{}/mine", problem.name()));
                    let compiled = variant.compile(&problem.signature(), false);
                    assert!(compiled.is_ok(), "{language:?}: {}\n{text}", compiled.unwrap_err());
                }
                for column in problem.scenarios() {
                    assert!(text.contains(column.summary));
                }
            }
        }
    }
}
