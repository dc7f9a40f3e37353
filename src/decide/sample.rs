//! Made-up runs for tests.

use std::collections::BTreeMap;

use serde_json::json;

use crate::audit::{Fingerprint, Verdict};
use crate::bench::{Ranking, rate_interval};
use crate::record::{Rate, Recorded};

/// Configurations of every row.
pub(super) const N: u64 = 1_000_000;

/// A run of `family` on a device of this kind, with scenarios `one` and `two`; of each variant: name, failures (those
/// not finite included), results not finite, p999 of the error, nanoseconds.
pub(super) fn run(kind: &str, variants: &[(&str, u64, u64, f64, f64)]) -> Recorded {
    let scenario = |name: &str| json!({ "name": name, "summary": "", "inputs": "0123", "oracle": null });
    let variants_json: Vec<_> = variants
        .iter()
        .map(|(name, failed, non_finite, p999, ns)| {
            let result = |scenario: &str| result(scenario, *failed, *non_finite, *p999, *ns);
            json!({
                "name": name, "file": format!("family/{name}.comp"), "summary": "", "source": "",
                "precise": false,
                "spirv": { "sha256": "", "words": 0, "local_size": [64, 1, 1], "capabilities": [],
                           "float_operations": {}, "no_contraction": 0, "arithmetic": 0 },
                "results": [result("one"), result("two")],
            })
        })
        .collect();
    let run = json!({
        "schema": 1,
        "program": { "version": "0", "revision": "abc", "dirty": false, "compiler": "" },
        "command": [], "started": "2026-01-01T00:00:00Z", "seconds": 1.0,
        "host": { "os": "", "arch": "", "threads": 1 },
        "device": {
            "index": 0, "name": format!("a {kind}"), "kind": kind, "uuid": "", "vendor_id": 0, "device_id": 0, "driver": "d",
            "driver_info": "", "driver_version": 0, "api_version": "1.3", "subgroup_size": 8,
            "shader_float64": false, "shader_float16": false, "float_controls": null,
            "max_storage_buffer_range": 0, "unified_memory": true, "timestamp_period": 1.0, "timestamp_bits": 64,
            "validation": false
        },
        "settings": { "seed": 1, "configurations": N, "chunk": 1, "max_failures": 1 },
        "families": [{
            "name": "family", "summary": "",
            "outputs": [{ "name": "x", "quantity": "irradiance", "tolerance": 1e-4, "headline": true }],
            "landmarks": [], "scenarios": [scenario("one"), scenario("two")], "variants": variants_json,
        }],
    });
    let mut bits = BTreeMap::new();
    for (name, ..) in variants {
        for scenario in ["one", "two"] {
            let key = ("family".to_owned(), (*name).to_owned(), scenario.to_owned());
            let mut fingerprint = Fingerprint::default();
            variants
                .iter()
                .filter(|other| other.0 == *name)
                .for_each(|v| fingerprint.add(v.1 + v.2, &[v.3 as f32]));
            bits.insert(key, fingerprint);
        }
    }
    Recorded { path: kind.into(), run: serde_json::from_value(run).unwrap(), bits }
}

/// A ranking by streaming times whose null kernel took so many nanoseconds.
pub(super) fn ranking(null_ns: f64) -> Ranking {
    let ratio = json!({ "low": 1.0, "median": 1.0, "high": 1.0 });
    serde_json::from_value(json!({
        "regime": "streaming", "inputs": "divergent", "reference": "v1",
        "null_ns": { "lower": null_ns, "median": null_ns, "upper": null_ns }, "control": ratio, "noise": 0.01,
        "self_comparisons": 0, "false_positives": 0, "stopped": "time", "rounds": 25, "discarded": 0, "seconds": 1.0,
    }))
    .unwrap()
}

fn rate(count: u64) -> Rate {
    let (low, high) = rate_interval(count, N);
    Rate { count, rate: count as f64 / N as f64, low, high }
}

fn result(scenario: &str, failed: u64, non_finite: u64, p999: f64, ns: f64) -> serde_json::Value {
    // One error in 500 below p999, the others below 2^-64.
    let distribution = |p999: f64| {
        let bucket = if p999.is_finite() { (4.0 * (p999.log2() + 64.0)) as usize } else { 513 };
        let mut counts = vec![0; bucket + 1];
        counts[0] += N - N / 500;
        counts[bucket] += N / 500;
        json!({ "p50": 0.0, "p90": 0.0, "p99": 0.0,
                "p999": if p999.is_finite() { json!(p999) } else { json!(null) },
                "buckets": { "first": 0, "counts": counts } })
    };
    let mut verdicts = BTreeMap::new();
    for (verdict, count) in
        [(Verdict::NonFinite, non_finite), (Verdict::Inaccurate, failed.saturating_sub(non_finite))]
    {
        if count > 0 {
            verdicts.insert(verdict, rate(count));
        }
    }
    json!({
        "scenario": scenario,
        "audit": {
            "configurations": N, "verdicts": verdicts, "failed": rate(failed), "landmarks": [],
            "outputs": [{
                "name": "x", "beyond": rate(failed), "visible": { "bits8": 0, "bits10": 0, "half": 0 },
                "error": distribution(p999), "ulp": distribution(p999 * 1e7), "conditioned": distribution(1.0),
                "worst": p999.is_finite().then(|| json!({ "error": p999 * 3.0, "index": 0, "ulp": 1.0 })),
            }],
        },
        "timing": {
            "ns": { "lower": ns * 0.99, "median": ns, "upper": ns * 1.01 }, "clock": "device_timestamps",
            "rounds": 25, "configurations": 1000, "repeats": 1,
        },
    })
}
