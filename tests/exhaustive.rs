//! Exhaustive audits: interrupted or not, in any parts, the outcome is the same.

mod drivers;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::tempdir;

/// 2^17 bit patterns, half of them in one part and half in the next: 1.99 to 2.03, where most results of two parabolas are
/// not a sine.
const RANGE: &str = "0x3fff0000..0x4000ffff";

fn rootq(arguments: &[&str], out: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("rootq"));
    command
        .env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")))
        .env_remove("ROOTQ_VULKAN_LOADER")
        .args(["audit", "sin/parabola_refined", "--exhaustive", "--device", "llvmpipe", "--out"])
        .arg(out)
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Standard error of a command that ends with this status.
fn ends(mut command: Command, status: i32) -> String {
    let output = command.output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(status), "{stderr}");
    stderr
}

/// What was counted, and the kept failures, byte for byte.
fn outcome(folder: &Path) -> (String, Vec<u8>) {
    let run: Value = serde_json::from_str(&fs::read_to_string(folder.join("run.json")).unwrap()).unwrap();
    (run["families"].to_string(), fs::read(folder.join("failures.parquet")).unwrap())
}

fn lines(journal: &Path) -> usize {
    fs::read_to_string(journal).map_or(0, |text| text.lines().count())
}

#[cfg(unix)]
#[test]
fn an_interrupted_audit_goes_on_to_the_same_bytes() {
    let folder = tempdir().unwrap();
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    ends(rootq(&["--bits", RANGE], &whole), 0);
    let entries = |folder: &Path| {
        let mut names: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!(entries(&whole), ["bits.parquet", "failures.parquet", "run.json"]);
    let run: Value = serde_json::from_str(&fs::read_to_string(whole.join("run.json")).unwrap()).unwrap();
    let audit = &run["families"][0]["variants"][0]["results"][0]["audit"];
    assert_eq!(audit["configurations"], 1 << 17);
    assert!(
        audit["failed"]["count"].as_u64().unwrap() > 100,
        "more than are kept, so that which are matters: {audit}"
    );

    // Chunks of 16 take seconds, so there is time to interrupt the second part.
    let mut child = rootq(&["--bits", RANGE, "--chunk", "16"], &broken).spawn().unwrap();
    let journal = broken.join("journal.jsonl");
    let start = Instant::now();
    while lines(&journal) < 2 {
        assert!(start.elapsed() < Duration::from_secs(300), "no part was finished");
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be interrupted");
        std::thread::sleep(Duration::from_millis(2));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    assert!(stderr.contains("1 of 2 parts are kept") && stderr.contains("goes on"), "{stderr}");
    assert!(stderr.contains("1 of 2 parts, about ") && stderr.contains(" to go"), "{stderr}");
    assert_eq!((entries(&broken), lines(&journal)), (vec!["journal.jsonl".into()], 2));
    assert_eq!(entries(folder.path()), ["broken", "whole"], "a draft was left behind");

    // What else is in the folder would be in the way of the results.
    let notes = broken.join("notes.txt");
    fs::write(&notes, "mine").unwrap();
    let refused = ends(rootq(&["--bits", RANGE], &broken), 2);
    assert!(refused.contains("notes.txt is beside an unfinished run"), "{refused}");
    fs::remove_file(&notes).unwrap();

    // Another range is another job.
    let refused = ends(rootq(&["--bits", "0x0..0x10"], &broken), 2);
    assert!(refused.contains("its bits differs"), "{refused}");
    let stderr = ends(rootq(&["--bits", RANGE], &broken), 0);
    assert!(stderr.contains("going on after 1 of 2 parts"), "{stderr}");
    // The bar, or on no terminal the estimate, counts from here: after the last part there is nothing to go.
    assert!(!stderr.contains("to go"), "{stderr}");
    assert_eq!(entries(&broken), entries(&whole));
    assert!(outcome(&whole) == outcome(&broken), "an interruption shows in the outcome");
}

#[test]
fn what_cannot_be_exhausted_is_refused() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let refused = ends(rootq(&["ellipse_axes"], &out), 2);
    assert!(refused.contains("ellipse_axes has more than one input; exhaustive can be: acos, "), "{refused}");
    for wrong in [&["--bits", "2..1"][..], &["-n", "10"], &["--seed", "2"]] {
        ends(rootq(wrong, &out), 2);
    }
    assert!(!out.exists());
}
