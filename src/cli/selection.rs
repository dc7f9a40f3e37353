//! SELECT: which variants a command means, and what to say when it means none.

use anyhow::{Result, anyhow, bail};
use globset::GlobBuilder;

use crate::catalog::{Catalog, Variant};
use crate::family::{self, Problem, Scenario};

/// A family and the variants of it that were selected, in the catalogue's order.
pub(super) struct Selected {
    pub(super) problem: &'static dyn Problem,
    pub(super) variants: Vec<Variant>,
}

/// The variants matching any of `patterns` (`family`, `family/variant` or a glob), and those named `besides`; all of them
/// without either.
pub(super) fn variants(catalog: &Catalog, patterns: &[String], besides: &[String]) -> Result<Vec<Selected>> {
    let all = patterns.is_empty() && besides.is_empty();
    let mut chosen: Vec<bool> =
        catalog.variants().iter().map(|variant| all || besides.contains(&variant.id())).collect();
    for pattern in patterns {
        let matcher = GlobBuilder::new(pattern)
            .literal_separator(true)
            .build()
            .map_err(|error| anyhow!("'{pattern}' is not a pattern: {}", error.kind()))?
            .compile_matcher();
        let mut any = false;
        for (variant, chosen) in catalog.variants().iter().zip(&mut chosen) {
            if variant.family == *pattern
                || matcher.is_match(variant.id())
                || matcher.is_match(&variant.family)
            {
                *chosen = true;
                any = true;
            }
        }
        if !any {
            return Err(nothing_matches(catalog, pattern));
        }
    }
    let mut selected = Vec::new();
    for problem in family::FAMILIES {
        let variants: Vec<Variant> = catalog
            .variants()
            .iter()
            .zip(&chosen)
            .filter(|(variant, chosen)| **chosen && variant.family == problem.name())
            .map(|(variant, _)| variant.clone())
            .collect();
        if !variants.is_empty() {
            selected.push(Selected { problem: *problem, variants });
        }
    }
    Ok(selected)
}

/// The family of that name.
pub(super) fn family(name: &str) -> Result<&'static dyn Problem> {
    family::find(name).ok_or_else(|| {
        let names = family::FAMILIES.iter().map(|family| family.name().to_owned());
        anyhow!("unknown family '{name}'{}", suggestion(name, names))
    })
}

/// One variant of a family.
pub(super) fn variant(catalog: &Catalog, problem: &dyn Problem, name: &str) -> Result<Variant> {
    let family = problem.name();
    let short = name.strip_prefix(family).and_then(|rest| rest.strip_prefix('/')).unwrap_or(name);
    catalog.family(family).find(|variant| variant.name == short).cloned().ok_or_else(|| {
        let names = catalog.family(family).map(|variant| variant.name.clone());
        anyhow!("unknown variant '{name}' of {family}{}", suggestion(short, names))
    })
}

/// The scenarios of that names; all without names. Each name must be one of some selected family.
pub(super) fn scenarios(problem: &dyn Problem, names: &[String]) -> Vec<&'static Scenario> {
    let wanted = |scenario: &&Scenario| names.is_empty() || names.iter().any(|name| name == scenario.name);
    problem.scenarios().iter().filter(wanted).collect()
}

/// Fails on a scenario name that no selected family has.
pub(super) fn check_scenarios(selected: &[Selected], names: &[String]) -> Result<()> {
    for name in names {
        let known = || {
            selected.iter().flat_map(|selected| selected.problem.scenarios()).map(|scenario| scenario.name)
        };
        if !known().any(|scenario| scenario == name) {
            bail!("unknown scenario '{name}'{}", suggestion(name, known().map(str::to_owned)));
        }
    }
    Ok(())
}

fn nothing_matches(catalog: &Catalog, pattern: &str) -> anyhow::Error {
    if let Some((family_name, name)) = pattern.split_once('/')
        && let Some(problem) = family::find(family_name)
        && !name.contains(['*', '?', '[', '{'])
    {
        return match variant(catalog, problem, name) {
            Err(error) => error,
            Ok(variant) => anyhow!("'{}' cannot be selected", variant.id()),
        };
    }
    let families = family::FAMILIES.iter().map(|family| family.name().to_owned());
    let ids = catalog.variants().iter().map(Variant::id);
    let known: Vec<String> = if pattern.contains('/') { ids.collect() } else { families.collect() };
    anyhow!("nothing matches '{pattern}'{}", suggestion(pattern, known.into_iter()))
}

/// "; did you mean 'x'?" for a near miss, else what there is, if that is short, or where to look.
pub(super) fn suggestion(wrong: &str, known: impl Iterator<Item = String>) -> String {
    let mut known: Vec<String> = known.collect();
    known.dedup();
    let nearest =
        known.iter().max_by(|a, b| strsim::jaro_winkler(wrong, a).total_cmp(&strsim::jaro_winkler(wrong, b)));
    match nearest {
        Some(name) if strsim::jaro_winkler(wrong, name) > 0.8 => format!("; did you mean '{name}'?"),
        _ if known.len() <= 12 => format!("; there are: {}", known.join(", ")),
        _ => "; 'rootq list' shows what there is".to_owned(),
    }
}
