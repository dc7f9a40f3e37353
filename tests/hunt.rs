//! The hunt on a real device: what it finds is worse than as much sampling does, is repeated by the same seed, and is
//! judged the same again from its recorded bits.

mod drivers;

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;
use rootq::audit::{Chunk, Judgement, Verdict};
use rootq::family;
use serde_json::Value;

fn rootq() -> Command {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")));
    command.env_remove("ROOTQ_VULKAN_LOADER").env("NO_COLOR", "1");
    command
}

fn hunt(out: &Path, device: &str, more: &[&str]) -> Output {
    let arguments =
        ["hunt", "ellipse_axes/naive", "--scenario", "scene", "--evaluations", "200K", "--device"];
    rootq().args(arguments).arg(device).args(more).arg("--out").arg(out).output().unwrap()
}

fn record(out: &Path) -> Value {
    let run: Value = serde_json::from_str(&std::fs::read_to_string(out.join("run.json")).unwrap()).unwrap();
    run["families"][0]["variants"][0]["results"][0]["hunt"].clone()
}

/// The size of the worst finite failure, 0 without one.
fn worst(finds: &Value) -> f64 {
    let sizes = finds.as_array().unwrap().iter().filter_map(|find| find["size"].as_f64());
    sizes.fold(0.0, f64::max)
}

#[test]
fn finds_worse_than_sampling_and_the_same_again() {
    for device in ["llvmpipe", "SwiftShader"] {
        let folder = tempfile::tempdir().unwrap();
        let (first, second) = (folder.path().join("first"), folder.path().join("second"));
        let Output { status, stdout, stderr } = hunt(&first, device, &["--validation"]);
        let (stdout, stderr) = (String::from_utf8(stdout).unwrap(), String::from_utf8(stderr).unwrap());
        assert_eq!(status.code(), Some(0), "{stderr}");
        assert!(stdout.contains("worst hunted") && stdout.contains("naive, "), "{stdout}");

        // Near a circle this variant's axes are anything; a light that near to one is rare among a scene's.
        let hunted = record(&first);
        let (found, random) = (worst(&hunted["search"]), worst(&hunted["random"]));
        assert!(found >= 1.0 && found > 1.5 * random, "{device}: {found} against {random}");
        assert_eq!(hunted["evaluations"], 200_000);

        assert!(hunt(&second, device, &[]).status.success());
        assert_eq!(record(&second), hunted, "{device}");
    }
}

/// What the record holds is enough to judge again, without the device and without the search.
#[test]
fn a_find_is_judged_again_from_its_bits() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("hunt");
    assert!(hunt(&out, "llvmpipe", &[]).status.success());
    let file = std::fs::File::open(out.join("failures.parquet")).unwrap();
    let problem = family::find("ellipse_axes").unwrap();
    let signature = problem.signature();
    let mut failures = 0;
    for row in SerializedFileReader::new(file).unwrap().get_row_iter(None).unwrap() {
        let row = row.unwrap();
        let place = |name: &str| row.get_column_iter().position(|(column, _)| column == name).unwrap();
        let values = |kind: &str, columns: Vec<String>| -> Vec<f32> {
            columns.iter().map(|column| row.get_float(place(&format!("{kind}.{column}"))).unwrap()).collect()
        };
        let chunk = Chunk::of_inputs(problem, 0, values("input", signature.input_columns()));
        let outputs = values("output", signature.output_columns());
        let judged = Judgement::new(problem, chunk.row(0), &outputs).verdict;
        assert_eq!(judged.name(), row.get_string(place("verdict")).unwrap());
        assert!(judged.is_failure());
        assert_eq!(row.get_long(place("index")).unwrap(), 0);
        failures += 1;
    }
    let hunted = record(&out);
    let recorded = hunted["search"].as_array().unwrap().iter();
    let failing = recorded.filter(|find| {
        let verdict: Verdict = serde_json::from_value(find["verdict"].clone()).unwrap();
        verdict.is_failure()
    });
    assert_eq!(failing.count(), failures);
    assert!(failures > 0);
}

/// The random configurations are the stream's that an audit draws.
#[test]
fn sampling_is_the_audits() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("hunt");
    let arguments =
        ["hunt", "ellipse_axes/naive", "--scenario", "aspect", "--evaluations", "3K", "--seed", "5", "--out"];
    assert!(rootq().args(arguments).arg(&out).output().unwrap().status.success());
    let problem = family::find("ellipse_axes").unwrap();
    let scenario = problem.scenario("aspect").unwrap();
    let random = record(&out)["random"].clone();
    let finds = random.as_array().unwrap();
    assert!(!finds.is_empty());
    for find in finds {
        let index = find["index"].as_u64().unwrap();
        assert!(index < 3_000 && find["evaluation"] == index + 1);
        let drawn = Chunk::draw_inputs(problem, scenario, 5, index, 1);
        let recorded: Vec<f32> = serde_json::from_value(find["inputs"].clone()).unwrap();
        assert_eq!(drawn, recorded);
    }
}

#[test]
fn wrong_calls_are_refused_in_one_line() {
    for (arguments, expected) in [
        (&["hunt"][..], "SELECT"),
        (&["hunt", "ellipse_axes/naiv"], "did you mean 'naive'?"),
        (&["hunt", "ellipse_axes/naive", "--seconds", "0"], "--seconds must be above 0"),
        (&["hunt", "ellipse_axes/naive", "--evaluations", "0"], "a count is a whole number"),
        (&["hunt", "ellipse_axes/naive", "--evaluations", "1K", "--seconds", "1"], "cannot be used with"),
        (&["hunt", "ellipse_axes/naive", "--scenario", "scen"], "did you mean 'scene'?"),
    ] {
        let Output { status, stdout, stderr } = rootq().args(arguments).output().unwrap();
        let stderr = String::from_utf8(stderr).unwrap();
        assert_eq!((status.code(), stdout.as_slice()), (Some(2), &b""[..]), "{stderr}");
        assert!(stderr.lines().count() == 1 && stderr.contains(expected), "{stderr}");
    }
}

/// Ctrl-C keeps what was found by then.
#[cfg(unix)]
#[test]
fn an_interrupted_hunt_is_a_whole_record() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;

    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("hunt");
    // Five hunts of seconds each.
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin("rootq"))
        .args(["hunt", "ellipse_axes/naive", "--evaluations", "1M", "--out"])
        .arg(&out)
        .env("VK_DRIVER_FILES", drivers::both().unwrap())
        .env_remove("ROOTQ_VULKAN_LOADER")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stderr = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    // The first of them is done, the next under way.
    assert!(stderr.any(|line| line == "done: ellipse_axes/naive . scene"));
    let killed = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(record(&out)["evaluations"], 1_000_000);
    let told: Vec<String> = stderr.collect();
    assert!(told.iter().any(|line| line.starts_with("interrupted; what was found so far")), "{told:?}");
    assert!(String::from_utf8(output.stdout).unwrap().contains("worst hunted"));
}
