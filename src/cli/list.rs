//! `rootq list`: families, columns, scenarios, variants.

use std::fmt::Write;

use anyhow::Result;
use clap::Args;
use serde_json::{Map, Value, json};

use super::selection;
use crate::audit::Verdict;
use crate::catalog::{Catalog, Field, Language, Variant, tables};
use crate::family::{FAMILIES, Output, Problem, Relation};

/// What `--json` prints, in the long help.
const JSON: &str = "\
Everything known of each family and variant, as JSON, for editors and scripts. One object:
  schema    1; fields may be added without raising it, never changed in meaning
  version   of rootq
  families  of each: name, summary, declarations { glsl, hlsl, wgsl } of its function, result_type, result_struct (null for
            one result), parameters [name, type, columns], results [the same, quantity, measure, tolerance, headline],
            relations [kind, results], exhaustive (whether 'audit --exhaustive' takes it), scenarios [name, summary],
            landmarks [name, summary, edges], variants [name, id, file, summary, source, tried, precise, tables, defines]
  tables    that a shader may read: name, summary, width, height, channels
  verdicts  in ascending gravity: name, failure (whether the variant is to blame)
Types are GLSL's.";

/// Options of `rootq list`.
#[derive(Args, Debug)]
pub(super) struct Arguments {
    /// Show only this family, in full
    family: Option<String>,
    /// Everything known of each family and variant, as JSON, for editors and scripts
    #[arg(long, long_help = JSON)]
    json: bool,
}

pub(super) fn list(arguments: &Arguments) -> Result<()> {
    let catalog = Catalog::embedded()?;
    let only = arguments.family.as_deref().map(selection::family).transpose()?;
    let families: Vec<&dyn Problem> = match only {
        Some(problem) => vec![problem],
        None => FAMILIES.to_vec(),
    };
    if arguments.json {
        return super::print(&(serde_json::to_string_pretty(&describe(&catalog, &families))? + "\n"));
    }
    let text = match only {
        Some(problem) => whole(&catalog, problem),
        None => families.iter().map(|problem| brief(&catalog, *problem)).collect(),
    };
    super::print(&text)
}

fn brief(catalog: &Catalog, problem: &dyn Problem) -> String {
    let names: Vec<&str> = catalog.family(problem.name()).map(|variant| variant.name.as_str()).collect();
    format!("{}\n    {}\n    {}\n", problem.name(), problem.summary(), names.join(" "))
}

fn whole(catalog: &Catalog, problem: &dyn Problem) -> String {
    let signature = problem.signature();
    let mut text = format!("{}\n    {}\n\n{}\n", problem.name(), problem.summary(), signature.declaration());
    _ = writeln!(text, "    inputs   {}", signature.input_columns().join(","));
    _ = writeln!(text, "    outputs  {}", signature.output_columns().join(","));
    let mut section = |title: &str, rows: Vec<(&str, &str)>| {
        let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        _ = writeln!(text, "\n{title}");
        for (name, summary) in rows {
            _ = writeln!(text, "    {name:width$}  {summary}");
        }
    };
    section("scenarios", problem.scenarios().iter().map(|s| (s.name, s.summary)).collect());
    section("landmark coordinates", problem.landmarks().iter().map(|l| (l.name, l.summary)).collect());
    let variants = catalog.family(problem.name());
    section("variants", variants.map(|v| (v.name.as_str(), v.summary.as_str())).collect());
    text
}

/// Version of what `--json` prints. Fields may be added without raising it, never changed in meaning.
const SCHEMA: u32 = 1;

/// Everything, for editors and scripts.
fn describe(catalog: &Catalog, families: &[&dyn Problem]) -> Value {
    json!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "families": families.iter().map(|problem| family(catalog, *problem)).collect::<Vec<_>>(),
        "tables": tables().iter().map(|table| json!({
            "name": table.name,
            "summary": table.summary,
            "width": table.width,
            "height": table.height,
            "channels": table.channels,
        })).collect::<Vec<_>>(),
        "verdicts": Verdict::ALL.map(|verdict| json!({
            "name": verdict.name(),
            "failure": verdict.is_failure(),
        })),
    })
}

fn family(catalog: &Catalog, problem: &dyn Problem) -> Value {
    let signature = problem.signature();
    let declarations: Map<String, Value> = [Language::Glsl, Language::Hlsl, Language::Wgsl]
        .into_iter()
        .map(|language| (language.name().to_lowercase(), signature.declaration_in(language).into()))
        .collect();
    json!({
        "name": problem.name(),
        "summary": problem.summary(),
        "declarations": declarations,
        "result_type": signature.result_type(),
        // Several results are the fields of a struct, which is declared for the shader.
        "result_struct": (signature.results.len() > 1).then(|| signature.result_type()),
        "parameters": problem.inputs().iter().map(field).collect::<Vec<_>>(),
        "results": problem.outputs().iter().map(output).collect::<Vec<_>>(),
        "relations": problem.relations().iter().map(|one| relation(problem, *one)).collect::<Vec<_>>(),
        "exhaustive": problem.takes_all_bits(),
        "scenarios": problem.scenarios().iter()
            .map(|scenario| json!({ "name": scenario.name, "summary": scenario.summary })).collect::<Vec<_>>(),
        "landmarks": problem.landmarks().iter()
            .map(|l| json!({ "name": l.name, "summary": l.summary, "edges": l.edges })).collect::<Vec<_>>(),
        "variants": catalog.family(problem.name()).map(variant).collect::<Vec<_>>(),
    })
}

fn field(field: &Field) -> Value {
    json!({ "name": field.name, "type": field.ty.glsl(), "columns": field.columns().collect::<Vec<_>>() })
}

fn output(output: &Output) -> Value {
    let mut described = field(&output.field);
    described["quantity"] = output.quantity.name().into();
    described["measure"] = output.quantity.measure().into();
    described["tolerance"] = output.tolerance.into();
    described["headline"] = output.headline.into();
    described
}

fn relation(problem: &dyn Problem, relation: Relation) -> Value {
    let name = |at: usize| problem.outputs()[at].field.name;
    match relation {
        Relation::Orthogonal(a, b) => json!({ "kind": "orthogonal", "results": [name(a), name(b)] }),
        Relation::Encloses { min, max } => json!({ "kind": "encloses", "results": [name(min), name(max)] }),
    }
}

fn variant(variant: &Variant) -> Value {
    let tables = variant.tables.iter().map(|(name, form)| (name.as_str().to_owned(), json!(form)));
    let defines = variant.defines.iter().map(|(name, value)| (name.clone(), value.to_string().into()));
    json!({
        "name": variant.name,
        "id": variant.id(),
        "file": variant.file,
        "summary": variant.summary,
        "source": variant.source,
        "tried": variant.tried,
        "precise": variant.precise,
        "tables": tables.collect::<Map<String, Value>>(),
        "defines": defines.collect::<Map<String, Value>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(values: &Value, key: &str) -> Vec<String> {
        values.as_array().unwrap().iter().map(|value| value[key].as_str().unwrap().to_owned()).collect()
    }

    /// Every family, column, scenario and variant is there, and comes back from the text.
    #[test]
    fn json_tells_everything() {
        let catalog = Catalog::embedded().unwrap();
        let text = serde_json::to_string(&describe(&catalog, FAMILIES)).unwrap();
        let all: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(all["schema"], SCHEMA);
        assert_eq!(names(&all["tables"], "name").len(), tables().len());
        let mut ids = Vec::new();
        for (problem, told) in FAMILIES.iter().zip(all["families"].as_array().unwrap()) {
            let signature = problem.signature();
            assert_eq!(told["name"], problem.name());
            assert_eq!(told["declarations"]["glsl"], signature.declaration());
            let columns = |fields: &Value| -> Vec<String> {
                let fields = fields.as_array().unwrap().iter();
                let columns = fields.flat_map(|field| field["columns"].as_array().unwrap());
                columns.map(|column| column.as_str().unwrap().to_owned()).collect()
            };
            assert_eq!(columns(&told["parameters"]), signature.input_columns());
            assert_eq!(columns(&told["results"]), signature.output_columns());
            for (output, told) in problem.outputs().iter().zip(told["results"].as_array().unwrap()) {
                assert_eq!(
                    (&told["tolerance"], &told["headline"]),
                    (&json!(output.tolerance), &json!(output.headline))
                );
            }
            assert_eq!(told["relations"].as_array().unwrap().len(), problem.relations().len());
            let scenarios: Vec<&str> = problem.scenarios().iter().map(|scenario| scenario.name).collect();
            assert_eq!(names(&told["scenarios"], "name"), scenarios);
            assert_eq!(told["landmarks"].as_array().unwrap().len(), problem.landmarks().len());
            ids.extend(names(&told["variants"], "id"));
        }
        assert_eq!(ids, catalog.variants().iter().map(Variant::id).collect::<Vec<_>>());
    }
}
