//! The catalogue without a device: everything compiles, identifiers are unique, and facts are as reviewed.

use std::fmt::Write;

use rootq::catalog::Catalog;
use rootq::family::{FAMILIES, find};

#[test]
fn families_are_sorted_and_unique() {
    let names: Vec<&str> = FAMILIES.iter().map(|family| family.name()).collect();
    let mut sorted = names.clone();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(names, sorted);
}

#[test]
fn every_folder_is_a_family_and_every_family_has_variants() {
    let catalog = Catalog::embedded().unwrap();
    for variant in catalog.variants() {
        assert!(find(&variant.family).is_some(), "{} is of no family", variant.file);
    }
    for family in FAMILIES {
        assert!(catalog.family(family.name()).next().is_some(), "{} has no variant", family.name());
    }
}

/// Every variant compiles, and a change of any shader's shape is a change of this snapshot that somebody reviews.
#[test]
fn facts_reflected_from_spirv() {
    let catalog = Catalog::embedded().unwrap();
    let mut snapshot = String::new();
    for variant in catalog.variants() {
        let signature = find(&variant.family).unwrap().signature();
        let facts = variant.compile(&signature, false).unwrap_or_else(|error| panic!("{error}")).facts;
        assert_eq!(facts.local_size, [64, 1, 1], "{}", variant.id());
        if variant.precise {
            assert_eq!(facts.no_contraction, facts.arithmetic, "{}", variant.id());
        }
        let operations: usize = facts.float_operations.values().sum();
        _ = writeln!(
            snapshot,
            "{}: {operations} float operations, {} of {} uncontracted, needs {}",
            variant.id(),
            facts.no_contraction,
            facts.arithmetic,
            facts.capabilities.join(" ")
        );
    }
    insta::assert_snapshot!(snapshot);
}

#[test]
fn debug_information_changes_no_arithmetic() {
    let catalog = Catalog::embedded().unwrap();
    for variant in catalog.variants() {
        let signature = find(&variant.family).unwrap().signature();
        let plain = variant.compile(&signature, false).unwrap().facts;
        let debug = variant.compile(&signature, true).unwrap().facts;
        assert_eq!(plain.float_operations, debug.float_operations, "{}", variant.id());
        assert!(debug.words > plain.words, "{}", variant.id());
    }
}
