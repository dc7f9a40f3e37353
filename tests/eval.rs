//! `rootq eval` from and to Parquet: the same evaluations as by CSV, and a run's failures as configurations.

mod drivers;

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use tempfile::tempdir;

fn rootq() -> Command {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")));
    command.env_remove("ROOTQ_VULKAN_LOADER").env("NO_COLOR", "1");
    command
}

fn rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(fs::File::open(path).unwrap()).unwrap();
    reader.get_row_iter(None).unwrap().map(Result::unwrap).collect()
}

/// The values of the columns whose names begin with `prefix`, by what follows it; f32 are exact in f64.
fn values(row: &Row, prefix: &str) -> Vec<(String, u64)> {
    let value = |field: &Field| match field {
        Field::Float(value) => f64::from(*value).to_bits(),
        Field::Double(value) => value.to_bits(),
        other => panic!("{other:?}"),
    };
    let columns = row.get_column_iter();
    columns.filter_map(|(name, field)| Some((name.strip_prefix(prefix)?.to_owned(), value(field)))).collect()
}

fn eval(arguments: &[&str], inputs: &Path, output: &Path) {
    let mut command = rootq();
    command.args(["eval", "ellipse_axes"]).args(arguments).arg("--inputs").arg(inputs);
    command.arg("--output").arg(output).assert().success().stdout("");
}

/// The outputs of a run's failures come out again, and so do their truths; the same by CSV as by Parquet.
#[test]
fn a_runs_failures_can_be_evaluated() {
    let folder = tempdir().unwrap();
    let run = folder.path().join("run");
    let arguments =
        ["audit", "ellipse_axes/cross_dekker", "ellipse_axes/naive", "ltc_line/heitz2017", "-n", "30K"];
    let scenarios = ["--scenario", "scale", "--scenario", "ggx", "--device", "llvmpipe", "--out"];
    rootq().args(arguments).args(scenarios).arg(&run).assert().success();
    let failures = run.join("failures.parquet");
    let recorded: Vec<Row> = rows(&failures);
    let family =
        |row: &&Row| row.get_column_iter().any(|(_, field)| *field == Field::Str("ellipse_axes".into()));
    let recorded: Vec<&Row> = recorded.iter().filter(family).collect();
    assert!(recorded.len() >= 100, "{}", recorded.len());
    // Of one family the columns have no family in their names; of two they have.
    let named = recorded[0].get_column_iter().any(|(name, _)| name == "input.ellipse_axes.v1_x");
    let prefix = if named { "ellipse_axes." } else { "" };

    let out = folder.path().join("out.parquet");
    eval(&["--variant", "naive", "--device", "llvmpipe"], &failures, &out);
    let evaluated = rows(&out);
    assert_eq!(evaluated.len(), recorded.len());
    let mut repeated = 0;
    for (recorded, evaluated) in recorded.iter().zip(&evaluated) {
        assert_eq!(values(evaluated, "oracle."), values(recorded, &format!("truth.{prefix}")));
        let is_naive = recorded.get_column_iter().any(|(_, field)| *field == Field::Str("naive".into()));
        let outputs = values(recorded, &format!("output.{prefix}"));
        // The bits of NaN are nobody's promise.
        let finite = outputs.iter().all(|(_, bits)| f64::from_bits(*bits).is_finite());
        if is_naive && finite {
            assert_eq!(values(evaluated, "naive."), outputs);
            repeated += 1;
        }
    }
    assert!(repeated > 10, "{repeated}");

    let text = folder.path().join("out.csv");
    eval(&["--variant", "naive", "--device", "llvmpipe"], &failures, &text);
    let mut csv = csv::Reader::from_path(&text).unwrap();
    let header = csv.headers().unwrap().clone();
    for (line, row) in csv.records().map(Result::unwrap).zip(&evaluated) {
        for ((name, field), (column, cell)) in row.get_column_iter().zip(header.iter().zip(&line)) {
            assert_eq!(name, column);
            match field {
                Field::Double(value) => assert_eq!(cell.parse::<f64>().unwrap().to_bits(), value.to_bits()),
                Field::Float(value) if value.is_nan() => assert!(cell.parse::<f32>().unwrap().is_nan()),
                Field::Float(value) => assert_eq!(cell.parse::<f32>().unwrap().to_bits(), value.to_bits()),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// More rows than a batch; what went in as CSV.
#[test]
fn long_tables_come_out_whole() {
    let folder = tempdir().unwrap();
    let input = folder.path().join("in.csv");
    let rows_in = 150_001;
    let mut text = "x\n".to_owned();
    for row in 0..rows_in {
        text.push_str(&format!("{row}\n"));
    }
    fs::write(&input, text).unwrap();
    let out = folder.path().join("out.PARQUET");
    rootq()
        .args(["eval", "sqrt", "--oracle-only", "--inputs"])
        .arg(&input)
        .arg("--output")
        .arg(&out)
        .assert()
        .success();
    let reader = SerializedFileReader::new(fs::File::open(&out).unwrap()).unwrap();
    assert_eq!(reader.num_row_groups(), 3);
    let roots = rows(&out);
    assert_eq!(roots.len(), rows_in);
    for (row, root) in roots.iter().enumerate() {
        let [(_, bits)] = values(root, "oracle.")[..] else { panic!("{root:?}") };
        assert!((f64::from_bits(bits) - (row as f64).sqrt()).abs() <= 1e-12 * (row as f64));
    }
}

#[test]
fn wrong_tables_are_refused_and_leave_nothing() {
    let folder = tempdir().unwrap();
    let text = folder.path().join("text.parquet");
    fs::write(&text, "v1_x\n1\n").unwrap();
    let out = folder.path().join("out.csv");
    for (inputs, input, expected) in [
        (text.to_str().unwrap(), "", "cannot be read as Parquet"),
        ("-", "PAR1 and so on", "standard input: Parquet is read from its end, so give it as a file"),
        ("absent.parquet", "", "cannot read absent.parquet"),
    ] {
        let mut command = rootq();
        command.args(["eval", "ellipse_axes", "--oracle-only", "--inputs", inputs, "--output"]).arg(&out);
        let output = command.write_stdin(input).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(stderr.lines().count() == 1 && stderr.contains(expected), "{stderr}");
        assert!(!out.exists());
    }
}
