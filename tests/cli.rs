//! The command line as a user meets it: results, files, and one clear line for every mistake.

mod drivers;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

fn rootq() -> Command {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")));
    command.env_remove("ROOTQ_VULKAN_LOADER").env("NO_COLOR", "1");
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Exit status 2, nothing on standard output, and exactly one line on standard error that holds `expected`.
fn is_refused(command: &mut Command, expected: &str) {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let (stdout, stderr) = (text(&stdout), text(&stderr));
    assert_eq!(status.code(), Some(2), "{stderr}");
    assert_eq!(stdout, "", "{stderr}");
    // The line before says which device it would have been.
    let lines: Vec<&str> = stderr.lines().filter(|line| !line.starts_with("device: ")).collect();
    assert_eq!(lines.len(), 1, "{stderr}");
    assert!(lines[0].starts_with("rootq: ") && lines[0].contains(expected), "{stderr}");
}

fn succeeds(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    assert!(status.success(), "{}", text(&stderr));
    text(&stdout)
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

fn run_json(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("run.json")).unwrap()).unwrap()
}

const TABLE: &str = "v2_x,v2_y,v2_z,v1_x,v1_y,v1_z\n0,0x1p+1,0,3,0,0\n1,1,0x1.8p-1,1e-3,-2.5,4\n";

fn table(folder: &TempDir, text: &str) -> PathBuf {
    let path = folder.path().join("in.csv");
    fs::write(&path, text).unwrap();
    path
}

#[test]
fn wrong_calls_are_refused_in_one_line() {
    let cases: &[(&[&str], &str)] = &[
        (&["run", "-n", "0"], "a whole number from 1 to 2^53"),
        (&["run", "-n", "-5"], "a whole number from 1 to 2^53"),
        (&["run", "-n", "1e30"], "a whole number from 1 to 2^53"),
        (&["run", "-n", "1.5"], "a whole number, such as"),
        (&["run", "-n", "many"], "a count is a number"),
        (&["run", "--bogus"], "unexpected argument '--bogus'"),
        (&["bogus"], "unrecognized subcommand 'bogus'"),
        (&["run", "elipse_axes"], "did you mean 'ellipse_axes'?"),
        (&["run", "ellipse_axes/croos"], "did you mean 'cross'?"),
        (&["run", "ellipse_axes/[a"], "is not a pattern"),
        (&["audit", "--scenario", "aspekt"], "did you mean 'aspect'?"),
        (&["audit", "--device", "GeForce"], "no device matches 'GeForce'; there are: "),
        (&["audit", "--device", "7"], "no device matches '7'"),
        (&["audit", "--threads", "0"], "--threads must be from 1"),
        (&["bench", "--seconds", "0"], "--seconds must be above 0"),
        (&["bench", "ellipse_axes", "--reference", "nave"], "did you mean 'naive'?"),
        (&["bench", "--regime", "random"], "streaming"),
        (&["audit", "--seconds", "1"], "unexpected argument '--seconds'"),
        (&["audit", "--regime", "streaming"], "unexpected argument '--regime'"),
        (&["run", "sin", "--exhaustive"], "unexpected argument '--exhaustive'"),
        (&["bench", "sin", "--exhaustive"], "unexpected argument '--exhaustive'"),
        (&["bench", "-n", "1M"], "unexpected argument '-n'"),
        (&["bench", "--max-failures", "3"], "unexpected argument '--max-failures'"),
        (&["list", "elipse"], "unknown family 'elipse'"),
        (&["eval", "ellipse_axes"], "--inputs"),
        (&["eval", "nothing", "--inputs", "x"], "unknown family 'nothing'"),
        (&["eval", "ellipse_axes", "--inputs", "/nowhere.csv"], "cannot read /nowhere.csv"),
    ];
    let folder = tempdir().unwrap();
    for (arguments, expected) in cases {
        let mut command = rootq();
        command.current_dir(&folder).args(*arguments);
        is_refused(&mut command, expected);
        assert!(entries(folder.path()).is_empty(), "{arguments:?} left something behind");
    }
}

#[test]
fn wrong_tables_are_refused_with_their_place_and_leave_nothing() {
    let header = "v1_x,v1_y,v1_z,v2_x,v2_y,v2_z\n";
    let cases = [
        (String::new(), "in.csv: the table is empty"),
        ("v1_x,v1_y,v1_z,v2_x,v2_y\n1,2,3,4,5\n".to_owned(), "column 'v2_z' is missing"),
        (format!("w,{header}"), "unknown column 'w'"),
        (format!("{header}1,2,3,4,5,six\n"), "in.csv:2: v2_z = 'six' is not a decimal"),
        (format!("{header}1,2,3,4,5,6\n1,2,NaN,4,5,6\n"), "in.csv:3: v1_z = 'NaN' is not a number"),
        (format!("{header}1,2,3,4,5,1e40\n"), "is infinite as f32"),
        (format!("{header}1,2,3\n"), "in.csv:2: 3 fields where the header has 6"),
    ];
    for (content, expected) in cases {
        let folder = tempdir().unwrap();
        let input = table(&folder, &content);
        let output = folder.path().join("out.csv");
        for target in ["-", output.to_str().unwrap()] {
            let mut command = rootq();
            command
                .args(["eval", "ellipse_axes", "--variant", "cross", "--output", target, "--inputs"])
                .arg(&input);
            is_refused(&mut command, expected);
        }
        assert_eq!(entries(folder.path()), [input], "something was left behind");
    }
}

#[test]
fn places_that_cannot_be_written_are_refused_before_any_work() {
    let folder = tempdir().unwrap();
    let input = table(&folder, TABLE);
    let mut command = rootq();
    command
        .args(["eval", "ellipse_axes", "--oracle-only", "--output", "/nowhere/out.csv", "--inputs"])
        .arg(&input);
    is_refused(&mut command, "cannot write /nowhere/out.csv");
    // A file where a folder would have to be: unwritable for any user.
    is_refused(rootq().args(["audit", "-n", "100", "--out"]).arg(input.join("run")), "cannot create");
    is_refused(rootq().args(["audit", "-n", "100", "--out"]).arg(&input), "cannot use as a folder");
    is_refused(rootq().args(["audit", "-n", "100", "--out"]).arg(folder.path()), "not empty");
    assert_eq!(entries(folder.path()), [input]);
}

#[test]
fn a_machine_without_loader_or_driver_is_told_so() {
    for verb in [&["devices"][..], &["run", "-n", "100"], &["bench"]] {
        is_refused(
            rootq().args(verb).env("ROOTQ_VULKAN_LOADER", "/nowhere/libvulkan.so"),
            "no Vulkan loader",
        );
        is_refused(rootq().args(verb).env("VK_DRIVER_FILES", "/nowhere.json"), "found no device");
    }
    // The oracle needs neither.
    let folder = tempdir().unwrap();
    let input = table(&folder, TABLE);
    let mut command = rootq();
    command.env("ROOTQ_VULKAN_LOADER", "/nowhere/libvulkan.so");
    let output = succeeds(command.args(["eval", "ellipse_axes", "--oracle-only", "--inputs"]).arg(input));
    assert_eq!(output.lines().count(), 3);
}

#[test]
fn eval_answers_in_order_and_reads_back() {
    let folder = tempdir().unwrap();
    let input = table(&folder, TABLE);
    let output = folder.path().join("out.csv");
    let mut command = rootq();
    command.args([
        "eval",
        "ellipse_axes",
        "--variant",
        "cross",
        "--variant",
        "ellipse_axes/naive",
        "--device",
        "llvmpipe",
    ]);
    let stdout = succeeds(command.arg("--inputs").arg(&input).arg("--output").arg(&output));
    assert_eq!(stdout, "");
    let mut csv = csv::Reader::from_path(&output).unwrap();
    let header: Vec<String> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(header.len(), 3 * 8);
    assert_eq!(header[0], "oracle.major_x");
    assert_eq!(header[8 + 7], "cross.minor_len");
    let rows: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2);
    // The first row is an ellipse along the axes, of lengths 3 and 2: exact in every arithmetic.
    let cell = |row: usize, name: &str| -> f64 {
        let place = header.iter().position(|column| column == name).unwrap();
        rows[row][place].parse().unwrap()
    };
    for source in ["oracle", "cross", "naive"] {
        assert_eq!(cell(0, &format!("{source}.major_len")), 3.0);
        assert_eq!(cell(0, &format!("{source}.minor_len")), 2.0);
    }
    assert_eq!(cell(0, "oracle.major_x").abs(), 1.0);
    assert_eq!(cell(0, "cross.major_x").abs(), 1.0);
    // The published form divides 0 by 0 where V1 and V2 are the axes themselves.
    assert!(cell(0, "naive.major_x").is_nan());
    // 17 digits for f64, 9 for f32: what is printed reads back to the same value.
    assert!(rows[1][0].trim_start_matches('-').split('e').next().unwrap().len() == 18, "{}", &rows[1][0]);
    assert!((cell(1, "cross.minor_len") / cell(1, "oracle.minor_len") - 1.0).abs() < 1e-6);
}

#[test]
fn standard_input_gives_the_same_as_a_file() {
    let folder = tempdir().unwrap();
    let input = table(&folder, TABLE);
    let from_file = succeeds(rootq().args(["eval", "ellipse_axes", "--oracle-only", "--inputs"]).arg(input));
    let mut command = rootq();
    let command = command.args(["eval", "ellipse_axes", "--oracle-only", "--inputs", "-"]).write_stdin(TABLE);
    assert_eq!(succeeds(command), from_file);
}

/// Everything that counts; not times, paths and thread numbers.
fn counts(folder: &Path) -> String {
    let mut run = run_json(folder);
    for volatile in ["seconds", "started", "command", "host", "settings"] {
        run.as_object_mut().unwrap().remove(volatile);
    }
    serde_json::to_string(&run).unwrap()
}

#[test]
fn threads_and_chunks_change_no_byte_of_the_counts() {
    let folder = tempdir().unwrap();
    let mut seen: Option<(String, Vec<u8>)> = None;
    for (threads, chunk) in [("1", "1M"), ("2", "65536"), ("16", "9999")] {
        let out = folder.path().join(format!("{threads}-{chunk}"));
        let mut command = rootq();
        command.args([
            "audit",
            "ellipse_axes/{naive,cross*}",
            "-n",
            "100K",
            "--seed",
            "9",
            "--device",
            "llvmpipe",
        ]);
        succeeds(command.args(["--threads", threads, "--chunk", chunk, "--out"]).arg(&out));
        let this = (counts(&out), fs::read(out.join("failures.parquet")).unwrap());
        match &seen {
            None => seen = Some(this),
            Some(first) => assert!(*first == this, "{threads} threads, chunks of {chunk}"),
        }
    }
    // Another seed must not give the same.
    let out = folder.path().join("seed");
    let mut command = rootq();
    command.args([
        "audit",
        "ellipse_axes/{naive,cross*}",
        "-n",
        "100K",
        "--seed",
        "10",
        "--device",
        "llvmpipe",
    ]);
    succeeds(command.arg("--out").arg(&out));
    assert_ne!(seen.unwrap().0, counts(&out));
}

#[test]
fn a_run_leaves_a_whole_record() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("some/where");
    let mut command = rootq();
    command.args(["run", "ellipse_axes/naive", "ellipse_axes/cross", "-n", "20K", "--scenario", "aspect"]);
    let stdout = succeeds(command.args(["--seconds", "0.05", "--device", "swiftshader", "--out"]).arg(&out));
    assert!(stdout.contains("naive") && stdout.contains("cross") && stdout.contains("minor_len"), "{stdout}");
    assert!(
        stdout.contains("A software device: times rank only within the same machine and run."),
        "{stdout}"
    );
    assert_eq!(entries(&folder.path().join("some")), std::slice::from_ref(&out), "a draft was left behind");

    let run = run_json(&out);
    assert_eq!(run["schema"], 1);
    assert_eq!(run["settings"]["seed"], 1);
    assert_eq!(run["device"]["uuid"].as_str().unwrap().len(), 32);
    assert!(run["device"]["name"].as_str().unwrap().contains("SwiftShader"));
    let family = &run["families"][0];
    assert_eq!(family["scenarios"].as_array().unwrap().len(), 1);
    let variants = family["variants"].as_array().unwrap();
    assert_eq!(variants.len(), 2);
    let result = |name: &str| {
        let variant = variants.iter().find(|variant| variant["name"] == name).unwrap();
        assert_eq!(variant["spirv"]["sha256"].as_str().unwrap().len(), 64);
        variant["results"][0].clone()
    };
    let naive = result("naive");
    let verdicts: u64 = naive["audit"]["verdicts"]
        .as_object()
        .unwrap()
        .values()
        .map(|rate| rate["count"].as_u64().unwrap())
        .sum();
    assert_eq!(verdicts, 20_000);
    assert!(naive["audit"]["failed"]["rate"].as_f64().unwrap() > 0.1);
    assert_eq!(result("cross")["audit"]["failed"]["count"], 0);
    assert!(naive["timing"]["ns"]["median"].as_f64().unwrap() > 0.0);
    for output in naive["audit"]["outputs"].as_array().unwrap() {
        let counts = output["error"]["buckets"]["counts"].as_array().unwrap();
        assert_eq!(counts.iter().map(|count| count.as_u64().unwrap()).sum::<u64>(), 20_000);
    }

    // The failures can be evaluated again: the same truth from the recorded inputs.
    let reader = SerializedFileReader::new(fs::File::open(out.join("failures.parquet")).unwrap()).unwrap();
    let schema = reader.metadata().file_metadata().schema().clone();
    let place = |name: &str| schema.get_fields().iter().position(|field| field.name() == name).unwrap();
    let row = reader.get_row_iter(None).unwrap().next().unwrap().unwrap();
    assert_eq!(row.get_string(place("variant")).unwrap(), "naive");
    let columns = ["v1_x", "v1_y", "v1_z", "v2_x", "v2_y", "v2_z"];
    let inputs = columns.map(|column| row.get_float(place(&format!("input.{column}"))).unwrap().to_string());
    let table = format!("{}\n{}\n", columns.join(","), inputs.join(","));
    let mut command = rootq();
    let command = command.args(["eval", "ellipse_axes", "--oracle-only", "--inputs", "-"]).write_stdin(table);
    let again = succeeds(command);
    let minor_len: f64 = again.lines().nth(1).unwrap().split(',').nth(7).unwrap().parse().unwrap();
    assert_eq!(minor_len, row.get_double(place("truth.minor_len")).unwrap());
}

#[test]
fn an_earlier_run_is_replaced_only_on_request() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let audit = |seed: &str| {
        let mut command = rootq();
        command.args([
            "audit",
            "ellipse_axes/cross",
            "-n",
            "1K",
            "--scenario",
            "scene",
            "--seed",
            seed,
            "--out",
        ]);
        command.arg(&out);
        command
    };
    succeeds(&mut audit("1"));
    is_refused(&mut audit("2"), "--force");
    assert_eq!(run_json(&out)["settings"]["seed"], 1);
    succeeds(audit("2").arg("--force"));
    assert_eq!(run_json(&out)["settings"]["seed"], 2);
    assert_eq!(entries(folder.path()), [out]);
}

#[test]
fn devices_are_listed_in_words_and_json() {
    let words = succeeds(rootq().arg("devices"));
    assert!(words.contains("llvmpipe") && words.contains("SwiftShader"), "{words}");
    let devices: Value = serde_json::from_str(&succeeds(rootq().args(["devices", "--json"]))).unwrap();
    let devices = devices.as_array().unwrap();
    assert_eq!(devices.len(), 2);
    // Each selector of one device finds it, and nothing else.
    for device in devices {
        for selector in [device["index"].to_string(), device["uuid"].as_str().unwrap().to_owned()] {
            let folder = tempdir().unwrap();
            let out = folder.path().join("run");
            let mut command = rootq();
            command
                .args(["audit", "ellipse_axes/cross", "-n", "100", "--device", &selector, "--out"])
                .arg(&out);
            succeeds(&mut command);
            assert_eq!(run_json(&out)["device"]["name"], device["name"]);
        }
    }
}

#[test]
fn probes_are_told_in_words_and_json() {
    let words = succeeds(rootq().args(["devices", "--probe"]));
    assert!(words.contains("llvmpipe") && words.contains("SwiftShader"), "{words}");
    for line in ["fma(a, b, c)", "subnormals: result of *", "min(1, NaN)", "bits of a sampler's weight"] {
        assert!(words.lines().any(|text| text.trim().starts_with(line)), "{line}: {words}");
    }
    let devices: Value = serde_json::from_str(&succeeds(
        rootq().args(["devices", "--probe", "--json", "--device", "llvmpipe"]),
    ))
    .unwrap();
    let devices = devices.as_array().unwrap();
    assert_eq!(devices.len(), 1);
    assert!(devices[0]["name"].as_str().unwrap().contains("llvmpipe"));
    assert_eq!(devices[0]["probe"]["subnormals"]["copied"], true);
    assert!(devices[0]["probe"]["special"].as_array().unwrap().len() > 20);
    is_refused(rootq().args(["devices", "--probe", "--device", "GeForce"]), "no device matches 'GeForce'");
}

#[test]
fn a_builtin_s_table_says_whether_it_keeps_the_specification() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let mut command = rootq();
    command.args(["audit", "inversesqrt/{native,quake_1}", "-n", "20K", "--scenario", "domain"]);
    let words = succeeds(command.args(["--device", "llvmpipe", "--out"]).arg(&out));
    let line = |name: &str| {
        let line =
            words.lines().find(|line| line.trim().starts_with(name)).unwrap_or_else(|| panic!("{words}"));
        line.split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(line("native")[1], "keeps");
    assert_eq!(line("quake_1")[1], "breaks");
    // The configuration of the worst ULP is in the record, and its output is that far off.
    let run = run_json(&out);
    let result = &run["families"][0]["variants"][0]["results"][0]["audit"];
    let worst = &result["outputs"][0]["extremes"]["ulp"];
    let number = |value: &Value| value.as_f64().unwrap();
    // The decimals are those of f32.
    let single = |value: &Value| f64::from(number(value) as f32);
    let (x, got) = (single(&worst["inputs"][0]), single(&worst["output"][0]));
    let truth = 1.0 / x.sqrt();
    assert!((number(&worst["truth"][0]) / truth - 1.0).abs() < 1e-15);
    let off = ((got - truth) / truth).abs() * 2f64.powi(24);
    // A unit in the last place is between one and two parts in 2^24.
    let ulp = number(&worst["size"]);
    assert!(off > 1000.0 && (0.999 * off / 2.0..=1.001 * off).contains(&ulp), "{off} {ulp}");
}

#[test]
fn help_says_what_each_verb_is_for() {
    for verb in ["devices", "list", "run", "audit", "bench", "eval", "hunt", "replay", "minimize", "new"] {
        let help = succeeds(rootq().args([verb, "--help"]));
        assert!(help.contains("Usage: rootq") && help.lines().count() > 5, "{help}");
    }
    let list: Value = serde_json::from_str(&succeeds(rootq().args(["list", "--json"]))).unwrap();
    assert_eq!(list["schema"], 1);
    let first = &list["families"][0];
    assert!(first["variants"].as_array().unwrap().iter().all(|variant| variant["source"].is_string()));
    assert!(
        succeeds(rootq().args(["list", "ellipse_axes"]))
            .contains("EllipseAxes ellipse_axes(vec3 v1, vec3 v2)")
    );
}

/// What `new` writes runs as it is, stays as it is, and is named in every wrong call.
#[test]
fn a_new_shader_runs_at_once() {
    let folder = tempdir().unwrap();
    let new = |arguments: &[&str]| {
        let mut command = rootq();
        command.current_dir(folder.path()).arg("new").args(arguments);
        command
    };
    for (arguments, file) in [
        (&["ellipse_axes/mine"][..], "mine.comp"),
        (&["ellipse_axes/mine", "--language", "hlsl"], "mine.hlsl"),
        (&["ellipse_axes/mine", "--output", "other.wgsl"], "other.wgsl"),
    ] {
        assert_eq!(succeeds(&mut new(arguments)), "");
        let path = folder.path().join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(&format!("rootq run --shader {file} --family ellipse_axes")), "{text}");
        is_refused(&mut new(arguments), "is there already");
        fs::write(&path, "mine").unwrap();
        succeeds(new(arguments).arg("--force"));
        assert_eq!(fs::read_to_string(&path).unwrap(), text);

        let inputs = table(&folder, TABLE);
        let mut eval = rootq();
        eval.args(["eval", "ellipse_axes", "--shader"]).arg(&path).arg("--inputs").arg(inputs);
        let evaluated = succeeds(&mut eval);
        let mut csv = csv::Reader::from_reader(evaluated.as_bytes());
        let header = csv.headers().unwrap().clone();
        let own: Vec<usize> = (0..header.len()).filter(|at| header[*at].starts_with("mine.")).collect();
        assert_eq!(own.len(), 8, "{header:?}");
        for line in csv.records().map(Result::unwrap) {
            assert!(own.iter().all(|at| line[*at].parse::<f32>() == Ok(0.0)), "{line:?}");
        }
    }
    let left = entries(folder.path()).len();
    for (arguments, expected) in [
        (&["ellipse_axes"][..], "'ellipse_axes' is not FAMILY/VARIANT"),
        (&["elipse_axes/mine"], "did you mean 'ellipse_axes'?"),
        (&["ellipse_axes/Mine"], "must be lower-case"),
        (&["ellipse_axes/cross"], "is built in already"),
        (&["ellipse_axes/x", "--output", "x.txt"], "is of no language"),
        (&["ellipse_axes/x", "--output", "x.wgsl", "--language", "glsl"], "--language says GLSL"),
        (&["ellipse_axes/x", "--output", "no/x.comp"], "cannot write no/x.comp"),
        (&["ellipse_axes/x", "--language", "metal"], "invalid value 'metal'"),
    ] {
        is_refused(&mut new(arguments), expected);
    }
    assert_eq!(entries(folder.path()).len(), left);
    let text = succeeds(&mut new(&["ltc_line/mine", "--output", "-"]));
    assert!(text.starts_with("/*---") && text.contains("float ltc_line("), "{text}");
}

#[cfg(unix)]
#[test]
fn interruption_leaves_nothing() {
    use std::io::BufRead;
    use std::os::unix::process::ExitStatusExt;
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin("rootq"))
        .env("VK_DRIVER_FILES", drivers::both().unwrap())
        .args(["run", "-n", "1G", "--out"])
        .arg(&out)
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // That it names the device is the sign that work has begun.
    let mut stderr = std::io::BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    stderr.read_line(&mut line).unwrap();
    assert!(line.starts_with("device: "), "{line}");
    std::thread::sleep(Duration::from_millis(500));
    // `timeout` sends two.
    for _ in 0..2 {
        let killed = std::process::Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
        assert!(killed.unwrap().success());
        std::thread::sleep(Duration::from_millis(50));
    }
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        // One chunk of every variant may be under way on a slow machine.
        assert!(start.elapsed() < Duration::from_secs(300), "it does not stop");
        std::thread::sleep(Duration::from_millis(50));
    };
    assert_eq!((status.code(), status.signal()), (Some(130), None));
    assert!(entries(folder.path()).is_empty(), "{:?}", entries(folder.path()));
}

#[test]
fn bench_ranks_and_says_what_is_noise() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let mut command = rootq();
    command.args(["bench", "ellipse_axes/{naive,cross,jacobi}", "--reference", "naive", "--seconds", "0.05"]);
    let stdout = succeeds(command.args(["--device", "llvmpipe", "--out"]).arg(&out));
    for expected in ["(null)", "divergent: ratios to naive; against itself", "Ceilings of this run", "places"]
    {
        assert!(stdout.contains(expected), "no '{expected}' in {stdout}");
    }
    assert!(stdout.contains("times rank only within the same machine and run."), "{stdout}");

    let run = run_json(&out);
    let positive = |value: &Value| assert!(value.as_f64().unwrap() > 0.0, "{value}");
    let ceilings = run["ceilings"].as_object().unwrap();
    assert_eq!(ceilings.len(), 6);
    ceilings.values().for_each(|ceiling| positive(&ceiling["per_second"]));
    let family = &run["families"][0];
    let rankings = family["scenarios"][0]["rankings"].as_array().unwrap();
    assert_eq!(rankings.len(), 3);
    for ranking in rankings {
        assert_eq!(ranking["reference"], "naive");
        positive(&ranking["null_ns"]["median"]);
        assert!(ranking["noise"].as_f64().unwrap() >= 0.0);
        assert!(ranking["rounds"].as_u64().unwrap() >= 11, "{ranking}");
    }
    for variant in family["variants"].as_array().unwrap() {
        positive(&variant["spirv"]["operations"]["flops"]);
        let result = &variant["results"][0];
        let arithmetic = result["arithmetic"].as_array().unwrap();
        assert_eq!(arithmetic.len(), 2);
        for timing in arithmetic.iter().chain([&result["timing"]]) {
            positive(&timing["ns"]["median"]);
            let ratio = |name: &str| timing["ratio"][name].as_f64().unwrap();
            assert!(ratio("low") <= ratio("median") && ratio("median") <= ratio("high"), "{timing}");
            let place = |name: &str| timing["rank"][name].as_u64().unwrap();
            assert!(1 <= place("first") && place("first") <= place("last") && place("last") <= 3, "{timing}");
            positive(&timing["share"]["arithmetic"]);
            positive(&timing["share"]["bandwidth"]);
        }
        assert!(arithmetic[0]["evaluations"].as_u64().unwrap() >= 16);
    }
}

#[test]
fn one_regime_and_the_hosts_clock_can_be_asked_for() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("run");
    let mut command = rootq();
    command.args(["bench", "horizon_sphere/{stable,rational}", "--regime", "streaming", "--seconds", "0.05"]);
    let stdout = succeeds(command.args(["--host-clock", "--device", "llvmpipe", "--out"]).arg(&out));
    assert!(stdout.contains("by the host's clock"), "{stdout}");
    let run = run_json(&out);
    let result = &run["families"][0]["variants"][0]["results"][0];
    assert_eq!(result["timing"]["clock"], "host_fence");
    assert!(result.get("arithmetic").is_none(), "{result}");
}
