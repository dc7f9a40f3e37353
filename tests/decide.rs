//! Decisions from recorded runs of both drivers: what changed, what breaks a rule, what to ship.

mod drivers;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

fn rootq() -> Command {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")));
    command.env_remove("ROOTQ_VULKAN_LOADER").env("NO_COLOR", "1");
    command
}

/// Exit status, standard output, standard error.
fn outcome(command: &mut Command) -> (i32, String, String) {
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

const VARIANTS: &str = "ellipse_axes/{naive,sqrtq,cross,cross_dekker_scaled,as_printed}";

/// Runs of the same variants: twice on lavapipe, the second time with another seed, and on SwiftShader.
fn runs() -> &'static [PathBuf; 3] {
    static RUNS: OnceLock<(TempDir, [PathBuf; 3])> = OnceLock::new();
    let (_, runs) = RUNS.get_or_init(|| {
        let folder = tempdir().unwrap();
        let run = |name: &str, device: &str, seed: &str| {
            let path = folder.path().join(name);
            let mut command = rootq();
            command.args([
                "run",
                VARIANTS,
                "-n",
                "20K",
                "--seconds",
                "0.2",
                "--device",
                device,
                "--seed",
                seed,
            ]);
            let (code, _, words) = outcome(command.arg("--out").arg(&path));
            assert_eq!(code, 0, "{words}");
            path
        };
        let runs = [run("a", "llvmpipe", "1"), run("b", "llvmpipe", "2"), run("c", "SwiftShader", "1")];
        (folder, runs)
    });
    runs
}

fn compare(a: &Path, b: &Path, more: &[&str]) -> (i32, String, String) {
    outcome(rootq().arg("compare").args([a, b]).args(more))
}

fn json(a: &Path, b: &Path) -> Value {
    let (code, text, words) = compare(a, b, &["--format", "json"]);
    assert_eq!(code, 0, "{words}");
    serde_json::from_str(&text).unwrap()
}

#[test]
fn a_run_is_the_same_as_itself_to_the_last_bit() {
    let [a, ..] = runs();
    let (code, text, _) = compare(a, a, &[]);
    assert_eq!(code, 0);
    assert!(
        text.contains("Nothing got better or worse.") && text.contains("25 of 25 rows identical"),
        "{text}"
    );
}

/// Another seed draws other configurations: rates are samples of the same ones, and bits are not compared.
#[test]
fn another_seed_changes_nothing_that_counts() {
    let [a, b, _] = runs();
    let told = json(a, b);
    let rows = told["comparison"]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 25);
    for row in rows {
        let change = row["accuracy"]["change"].as_str().unwrap();
        assert!(["same", "cannot_tell"].contains(&change), "{row}");
        assert!(row["bits"].is_null(), "{row}");
    }
    let notes = told["comparison"]["notes"].to_string();
    assert!(notes.contains("other configurations"), "{notes}");
}

/// Two drivers round differently, so bits differ; error-free arithmetic stays accurate on both.
#[test]
fn two_devices_differ_in_bits() {
    let [a, _, c] = runs();
    let told = json(a, c);
    let rows = told["comparison"]["rows"].as_array().unwrap();
    let naive = rows.iter().find(|row| row["variant"] == "naive" && row["scenario"] == "aspect").unwrap();
    assert!(naive["bits"]["differing"].as_f64().unwrap() > 100.0, "{naive}");
    let exact = |row: &&Value| row["variant"] == "cross_dekker_scaled" && row["scenario"] == "aspect";
    for row in rows.iter().filter(exact) {
        assert_eq!(row["accuracy"]["failed"][1]["count"], 0, "{row}");
    }
    let (_, markdown, _) = compare(a, c, &["--format", "markdown", "--all"]);
    assert!(markdown.lines().filter(|line| line.starts_with('|')).count() > 25, "{markdown}");
}

#[test]
fn a_gate_fails_with_the_rows_that_broke_it() {
    let [a, b, _] = runs();
    let folder = tempdir().unwrap();
    let rules = folder.path().join("rules.toml");
    let gate = |text: &str, format: &str| {
        fs::write(&rules, text).unwrap();
        compare(a, b, &["--gate", rules.to_str().unwrap(), "--format", format])
    };
    let strict = "[[rule]]\nselect = \"ellipse_axes/cross_*\"\nmax_non_finite = 0\nmax_failed = 0\n";
    let (code, text, _) = gate(strict, "table");
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("gate: every rule is kept"), "{text}");

    // The control must be caught.
    let (code, text, words) = gate("[[rule]]\nscenario = \"aspect\"\nmax_failed = 0.9\n", "github");
    assert_eq!(code, 1, "{text}");
    assert!(words.starts_with("rootq: ") && words.lines().count() == 1, "{words}");
    let errors: Vec<&str> = text.lines().filter(|line| line.starts_with("::error ")).collect();
    assert!(!errors.is_empty() && errors.iter().all(|line| line.contains("as_printed")), "{text}");
    assert!(errors[0].contains("file=glsl/ellipse_axes/as_printed.comp"), "{text}");

    for (bad, expected) in [
        ("[[rule]]\nmax_fialed = 1\n", "max_fialed"),
        ("[[rule]]\nselect = \"ltc_disk\"\nmax_failed = 1\n", "selects nothing"),
        ("no rules", "rules.toml"),
    ] {
        let (code, text, words) = gate(bad, "table");
        assert_eq!((code, text.as_str(), words.lines().count()), (2, "", 1), "{words}");
        assert!(words.contains(expected), "{words}");
    }
}

#[test]
fn what_is_no_run_is_refused() {
    let [a, ..] = runs();
    let folder = tempdir().unwrap();
    let (code, _, words) = compare(a, folder.path(), &[]);
    assert!(code == 2 && words.contains("holds no run"), "{words}");
    fs::write(folder.path().join("run.json"), "{\"schema\": 99}").unwrap();
    let (code, _, words) = compare(a, folder.path(), &[]);
    assert!(code == 2 && words.contains("use a newer rootq"), "{words}");
    fs::write(folder.path().join("run.json"), "{\"schema\": 1").unwrap();
    let (code, _, words) = compare(a, folder.path(), &[]);
    assert!(code == 2 && words.contains("is not a run"), "{words}");
}

#[test]
fn pick_chooses_over_both_devices_and_says_why() {
    let [a, _, c] = runs();
    let pick = |more: &[&str]| outcome(rootq().args(["pick", "ellipse_axes"]).args([a, c]).args(more));
    let (code, text, words) = pick(&["--no-non-finite"]);
    assert_eq!(code, 0, "{words}");
    let chosen = text.lines().next().unwrap();
    // It alone finds the minor length from the area and keeps lengths of any size from overflowing.
    assert!(chosen.starts_with("cross_dekker_scaled: ") && chosen.contains("no NaN or infinity"), "{text}");
    let naive = text.lines().find(|line| line.trim_start().starts_with("naive")).unwrap();
    assert!(naive.contains("is NaN or infinite in"), "{text}");

    let (code, text, _) = pick(&["--json", "--scenario", "aspect", "--max-error", "1e-3"]);
    let choice: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        (code, &choice["candidates"][0]["variant"]),
        (0, &Value::from("cross_dekker_scaled")),
        "{text}"
    );

    let (code, text, _) = pick(&["--max-error", "1e-30"]);
    assert!(code == 1 && text.contains("no variant keeps the constraints"), "{text}");
    for (more, expected) in [
        (["--devices", "GeForce"], "GeForce"),
        (["--scenario", "nowhere"], "nowhere"),
        (["--max-error", "-1"], "negative"),
    ] {
        let (code, text, words) = pick(&more);
        assert_eq!((code, text.as_str(), words.lines().count()), (2, "", 1), "{words}");
        assert!(words.contains(expected), "{words}");
    }
    let empty = tempdir().unwrap();
    let (code, _, words) = outcome(rootq().current_dir(&empty).args(["pick", "ellipse_axes"]));
    assert!(code == 2 && words.contains("'rootq run ellipse_axes' makes one"), "{words}");
}
