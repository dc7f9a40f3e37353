//! `rootq fit ggx` as users call it.

use std::path::Path;

use assert_cmd::Command;
use rootq::sample::ggx::Table;

fn fit(arguments: &[&str], folder: &Path) -> std::process::Output {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.current_dir(folder).args(["fit", "ggx"]).args(arguments).output().unwrap()
}

#[test]
fn a_table_statistics_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let output = fit(&["--size", "4", "--threads", "1", "--out", "a.csv"], folder.path());
    assert_eq!(output.status.code(), Some(0));
    let statistics = String::from_utf8(output.stdout).unwrap();
    assert!(statistics.starts_with("residual ") && statistics.lines().count() == 3, "{statistics}");
    let text = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert!(text.starts_with("# rootq fit ggx --size 4\n"), "{text}");
    assert_eq!(Table::parse(&text).unwrap().size(), 4);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);

    let again = fit(&["--size", "4", "--threads", "2", "--out", "-"], folder.path());
    assert_eq!(String::from_utf8(again.stdout).unwrap(), text);
    assert!(String::from_utf8(again.stderr).unwrap().contains(&statistics));
}

#[test]
fn what_cannot_be_is_one_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for wrong in [
        &["--out", "absent/a.csv"][..],
        &["--out", "."],
        &["--out", "/dev/null/a.csv"],
        &["--size", "1"],
        &["--size", "257"],
        &["--size", "x"],
        &["--threads", "0"],
    ] {
        let output = fit(wrong, folder.path());
        let words = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{wrong:?}: {words}");
        assert!(words.starts_with("rootq: ") && words.trim_end().lines().count() == 1, "{wrong:?}: {words}");
        assert!(output.stdout.is_empty());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{wrong:?}");
    }
}
