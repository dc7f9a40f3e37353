//! `rootq list`: families, columns, scenarios, variants.

use std::fmt::Write;

use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};

use super::selection;
use crate::catalog::{Catalog, Variant};
use crate::family::{FAMILIES, Problem};

/// Options of `rootq list`.
#[derive(Args, Debug)]
pub(super) struct Arguments {
    /// Show only this family, in full
    family: Option<String>,
    /// Everything known of each family and variant, as JSON
    #[arg(long)]
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
        let all: Vec<Value> = families.iter().map(|problem| describe(&catalog, *problem)).collect();
        return super::print(&(serde_json::to_string_pretty(&all)? + "\n"));
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

fn describe(catalog: &Catalog, problem: &dyn Problem) -> Value {
    let signature = problem.signature();
    json!({
        "name": problem.name(),
        "summary": problem.summary(),
        "function": signature.declaration(),
        "inputs": signature.input_columns(),
        "outputs": signature.output_columns(),
        "scenarios": problem.scenarios().iter().map(|s| json!({ "name": s.name, "summary": s.summary })).collect::<Vec<_>>(),
        "landmarks": problem.landmarks().iter()
            .map(|l| json!({ "name": l.name, "summary": l.summary, "edges": l.edges })).collect::<Vec<_>>(),
        "variants": catalog.family(problem.name()).map(variant).collect::<Vec<_>>(),
    })
}

fn variant(variant: &Variant) -> Value {
    json!({
        "name": variant.name,
        "id": variant.id(),
        "file": variant.file,
        "summary": variant.summary,
        "source": variant.source,
        "tried": variant.tried,
        "precise": variant.precise,
        "defines": variant.defines.iter().map(|(name, value)| (name.clone(), value.to_string().into()))
            .collect::<serde_json::Map<String, Value>>(),
    })
}
