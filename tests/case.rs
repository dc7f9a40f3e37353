//! Recorded failures again: replayed, exported, and what the exports do when they are run.

#![allow(unsafe_code, reason = "one environment variable is set before any thread reads it")]

mod drivers;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::OnceLock;

use assert_cmd::Command;
use rootq::audit::Verdict;
use rootq::case::{self, Answer, Origin, Story, amber, glsl, origin};
use rootq::catalog::{Catalog, Kernel, compile_standalone};
use rootq::device::vulkan::{Instance, VulkanDevice};
use rootq::device::{Device, Outputs};
use rootq::record::RecordedFailure;
use serde_json::Value;

fn rootq() -> Command {
    let mut command = Command::cargo_bin("rootq").unwrap();
    command.env("VK_DRIVER_FILES", drivers::both().unwrap_or_else(|message| panic!("{message}")));
    command.env_remove("ROOTQ_VULKAN_LOADER").env("NO_COLOR", "1");
    command
}

fn succeeds(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A run of `select` on the device of that name.
fn audit(device: &str, select: &[&str], out: &Path) {
    let mut command = rootq();
    command.arg("audit").args(select).args(["-n", "20K", "--max-failures", "8", "--device", device]);
    succeeds(command.arg("--out").arg(out));
}

/// Runs `test` on lavapipe and on SwiftShader, by a part of the name that chooses them.
fn on_every_device(test: impl Fn(&str, &VulkanDevice)) {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        let both = drivers::both().unwrap_or_else(|message| panic!("{message}"));
        // SAFETY: every test comes through here before it opens an instance, and the others wait; nobody else in this
        // process reads or writes the environment meanwhile.
        unsafe { std::env::set_var("VK_DRIVER_FILES", both) };
    });
    let instance = Instance::open(true).unwrap();
    for name in ["llvmpipe", "SwiftShader"] {
        let index = instance.choose(Some(name)).unwrap();
        test(name, &VulkanDevice::open(&instance, index).unwrap());
    }
    assert_eq!(instance.validation_messages(), Vec::<String>::new());
}

/// Outputs of a shader with one configuration, as many as it has.
fn outputs(device: &VulkanDevice, spirv: Vec<u32>, inputs: &[f32], outputs: usize) -> Vec<f32> {
    let kernel = Kernel {
        id: "test/export".to_owned(),
        spirv,
        inputs: inputs.len(),
        outputs,
        tables: Vec::new(),
        traps: Vec::new(),
    };
    let program = device.program(&kernel).unwrap();
    let columns = device.upload(inputs, inputs.len()).unwrap();
    let finished = device.wait(device.submit(&program, &columns).unwrap()).unwrap();
    (0..outputs).map(|column| finished.column(column)[0]).collect()
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn a_run_replayed_where_it_was_made_is_the_same_to_the_last_bit() {
    on_every_device(|name, _| {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        audit(name, &["ellipse_axes/{naive,sqrtq}", "sqrt"], &run);
        let replay = |arguments: &[&str]| {
            let mut command = rootq();
            command.arg("replay").arg(&run).args(["--device", name, "--validation"]).args(arguments);
            succeeds(&mut command)
        };
        let all: Value = serde_json::from_str(&replay(&["--json"])).unwrap();
        let failures = all["failures"].as_array().unwrap();
        assert!(failures.len() > 10);
        for (at, failure) in failures.iter().enumerate() {
            assert_eq!(failure["failure"], at + 1);
            assert_eq!(failure["now"]["fate"], "same", "{failure}");
            assert_eq!(failure["now"]["same_bits"], true, "{failure}");
        }
        let last = failures.last().unwrap();
        let number = last["failure"].to_string();
        let told = replay(&["--failure", &number]);
        assert!(
            told.contains("fails again with the same verdict; the outputs have the recorded bits"),
            "{told}"
        );
        // Every input in all three forms.
        let one: Value = serde_json::from_str(&replay(&["--failure", &number, "--json"])).unwrap();
        for input in one["inputs"].as_array().unwrap() {
            let line = told.lines().find(|line| line.contains(input["column"].as_str().unwrap())).unwrap();
            let words: Vec<&str> = line.split_whitespace().collect();
            assert_eq!(
                words[2..],
                [input["hex"].as_str().unwrap(), input["bits"].as_str().unwrap()],
                "{line}"
            );
            let decimal: f32 = words[1].parse().unwrap();
            assert_eq!(format!("0x{:08x}", decimal.to_bits()), input["bits"], "{line}");
        }
        // The failing variant first, and every other one of the family.
        let variants = one["variants"].as_array().unwrap();
        assert_eq!(variants[0]["variant"], last["variant"]);
        assert!(variants.len() > 5);
        let some = replay(&["--scenario", last["scenario"].as_str().unwrap(), "--variant", "naive"]);
        assert!(some.contains("'--failure K'") && !some.contains("sqrtq"), "{some}");
    });
}

#[test]
fn what_cannot_be_replayed_is_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    audit("llvmpipe", &["ellipse_axes/naive"], &run);
    let run = run.to_str().unwrap();
    let cases: &[(&[&str], &str)] = &[
        (&["/nowhere"], "/nowhere holds no failures"),
        (&[run, "--failure", "0"], "has no failure 0: they go from 1 to "),
        (&[run, "--failure", "1000000"], "has no failure 1000000"),
        (&[run, "--variant", "nave"], "did you mean 'naive'?"),
        (&[run, "--scenario", "scen"], "no failure of scenario 'scen' was recorded"),
        (&[run, "--amber", "x"], "--failure"),
        (&[run, "--failure", "1", "--device", "GeForce"], "no device matches 'GeForce'"),
        (&[run, "--failure", "1", "--glsl", "/nowhere/x"], "cannot write /nowhere/x"),
        (&[run, "--failure", "1", "--glsl", "-", "--amber", "-"], "only one of --amber and --glsl"),
    ];
    for (arguments, expected) in cases {
        let output = rootq().arg("replay").args(*arguments).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{stderr}");
        let lines: Vec<&str> = stderr.lines().filter(|line| !line.starts_with("device: ")).collect();
        assert!(lines.len() == 1 && lines[0].contains(expected), "{stderr}");
    }
}

/// Nothing failed: that is no mistake.
#[test]
fn a_run_without_failures_has_nothing_to_replay() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    audit("llvmpipe", &["horizon_sphere/stable"], &run);
    assert_eq!(succeeds(rootq().arg("replay").arg(&run)), "");
}

/// One failure of each verdict and family that these have, and everything of it.
fn exemplars(run: &Path) -> (Origin, Vec<usize>) {
    let origin = Origin::read(run).unwrap();
    let mut seen = BTreeSet::new();
    let first = |failure: &RecordedFailure| seen.insert((failure.problem.name(), failure.failure.verdict));
    let new: Vec<bool> = origin.failures.iter().map(first).collect();
    let places = (0..new.len()).filter(|place| new[*place]).collect();
    (origin, places)
}

/// Together they have all verdicts but one, and on every failure some of them is right.
const SEVERAL: [&str; 5] = [
    "ellipse_axes/{naive,cross_dekker,jacobi}",
    "ellipse_bounds",
    "orthonormal_basis",
    "ray_ellipse",
    "sym3_eigen/{wikipedia,jacobi}",
];

/// Amber's reading of its own lines: buffers of bits, shaders, and comparisons in C++.
struct Script<'a> {
    text: &'a str,
}

impl<'a> Script<'a> {
    fn shader(&self, head: &str) -> &'a str {
        let (_, rest) = self.text.split_once(&format!("SHADER compute {head}\n")).unwrap();
        // As Amber does: the first END ends it.
        rest.split_once("END").unwrap().0
    }

    fn inputs(&self) -> Vec<u32> {
        let (_, rest) = self.text.split_once("BUFFER inputs DATA_TYPE uint32 DATA\n").unwrap();
        let lines = rest.lines().take_while(|line| *line != "END");
        let word =
            |line: &str| line.split_whitespace().next().unwrap().strip_prefix("0x").unwrap().to_owned();
        lines.map(|line| u32::from_str_radix(&word(line), 16).unwrap()).collect()
    }

    /// Whether what the checking shader wrote is as expected. A number without a point would be an integer.
    fn accepts(&self, checks: &[f32]) -> bool {
        let lines = self.text.lines().filter(|line| line.starts_with("EXPECT "));
        let mut compared = 0;
        let kept = lines.map(|line| {
            compared += 1;
            let words: Vec<&str> = line.split_whitespace().collect();
            let ["EXPECT", "checks", "IDX", at, comparator, bound] = words[..] else { panic!("{line}") };
            let at: usize = at.parse().unwrap();
            assert!(at.is_multiple_of(4) && bound.contains('.'), "{line}");
            let (value, bound) = (checks[at / 4], bound.parse::<f64>().unwrap() as f32);
            match comparator {
                "GE" => !(value < bound),
                "LE" => !(value > bound),
                _ => panic!("{line}"),
            }
        });
        let kept: Vec<bool> = kept.collect();
        assert_eq!(compared, 2 * checks.len());
        kept.iter().all(|kept| *kept)
    }
}

/// Both exports, run: the snippet gives the recorded bits; the script refuses them and takes every right answer.
#[test]
fn exports_do_what_they_say() {
    on_every_device(|name, device| {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        audit(name, &SEVERAL, &run);
        let catalog = Catalog::embedded().unwrap();
        let (origin, places) = exemplars(&run);
        let mut verdicts = BTreeSet::new();
        let mut programs = BTreeMap::new();
        for failure in &origin.failures {
            programs.entry((failure.problem.name(), failure.variant.clone())).or_insert_with(|| {
                let kernel = origin.kernel(&catalog, failure.problem, &failure.variant).unwrap().kernel;
                let program = device.program(&kernel).unwrap();
                (kernel, program)
            });
        }
        for place in places {
            let recorded = &origin.failures[place];
            let (problem, failure) = (recorded.problem, &recorded.failure);
            verdicts.insert(failure.verdict);
            let what = format!("{}, {:?} on {name}", recorded.id(), failure.verdict);
            let evaluate =
                |program| case::evaluate(device, program, problem, &failure.inputs).unwrap().remove(0);
            let (kernel, program) = &programs[&(problem.name(), recorded.variant.clone())];
            let seen = evaluate(program);
            assert!(seen.same_bits(&failure.outputs), "{what}");
            let answers = [(recorded.variant.clone(), Ok(seen.clone()))];
            let here = origin::device(device.facts());
            let story = Story::new(place + 1, recorded, origin.device(), here, &answers);

            let variant = catalog.family(problem.name()).find(|one| one.name == recorded.variant);
            let snippet = glsl::snippet(problem, variant, &story, &seen).unwrap();
            // What is run here has its outputs beside the inputs that it does not read.
            let moved = snippet.replace("set = 0, binding = 0)", "set = 0, binding = 1)");
            let again = outputs(device, compile_standalone(&moved).unwrap(), &[0.0], failure.outputs.len());
            assert_eq!(bits(&again), bits(&failure.outputs), "{what}\n{snippet}");

            let text = amber::script(problem, kernel, recorded, &story, &seen).unwrap();
            let script = Script { text: &text };
            assert!(text.starts_with("#!amber\n"));
            assert_eq!(script.inputs(), bits(&failure.inputs), "{what}");
            assert!(script.shader("audited SPIRV-ASM").contains("OpEntryPoint GLCompute %4 \"main\""));
            let checking = compile_standalone(script.shader("checking GLSL")).unwrap();
            let count = text.lines().filter(|line| line.starts_with("EXPECT ")).count() / 2;
            let accepts = |values: &[f32]| script.accepts(&outputs(device, checking.clone(), values, count));
            assert!(!accepts(&failure.outputs), "{what}: the wrong answer passes\n{text}");
            let mut nan = failure.outputs.clone();
            nan[0] = f32::NAN;
            assert!(!accepts(&nan), "{what}: NaN passes");
            // The truth, where rounding it keeps it right (a box must enclose), and what other variants do right.
            let truth = case::truth(problem, &failure.inputs);
            let rounded: Vec<f32> = truth.values().iter().map(|value| *value as f32).collect();
            let rounded = Answer::judged(problem, &failure.inputs, &truth, rounded);
            let own = programs.iter().filter(|((family, _), _)| *family == problem.name());
            let others = own.map(|(_, (_, program))| evaluate(program));
            let right: Vec<Answer> =
                others.chain([rounded]).filter(|answer| answer.verdict == Verdict::Ok).collect();
            assert!(!right.is_empty(), "{what}");
            for answer in right {
                assert!(accepts(&answer.outputs), "{what}: {:?} is refused\n{text}", answer.outputs);
            }
        }
        for verdict in [Verdict::Inaccurate, Verdict::NotOrthogonal, Verdict::NotUnit, Verdict::NonFinite] {
            assert!(verdicts.contains(&verdict), "no {verdict:?} among the failures");
        }
        assert!(
            verdicts.contains(&Verdict::NotEnclosing) && verdicts.contains(&Verdict::Missed),
            "{verdicts:?}"
        );
    });
}

#[test]
fn exports_are_written_whole_and_beside_the_story() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    audit("llvmpipe", &["ellipse_axes/naive", "ltc_disk/{secular_lut,talk2017}"], &run);
    let (script, snippet) = (folder.path().join("x.amber"), folder.path().join("x.comp"));
    let replay = |number: &str| {
        let mut command = rootq();
        command.arg("replay").arg(&run).args(["--failure", number]);
        command
    };
    let story = succeeds(replay("1").arg("--amber").arg(&script).arg("--glsl").arg(&snippet));
    assert!(story.starts_with("failure 1: ellipse_axes/naive"), "{story}");
    let glsl = std::fs::read_to_string(&snippet).unwrap();
    assert!(glsl.starts_with("#version 450\n// ellipse_axes/naive: "), "{glsl}");
    assert_eq!(succeeds(replay("1").args(["--glsl", "-"])), glsl);
    assert!(std::fs::read_to_string(&script).unwrap().starts_with("#!amber\n"));

    // Tables: a buffer goes with the script, an image does not, and neither fits a snippet.
    let origin = Origin::read(&run).unwrap();
    let first = |variant: &str| {
        let place = origin.failures.iter().position(|failure| failure.variant == variant).unwrap();
        (place + 1).to_string()
    };
    let told = |command: &mut Command| {
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8(output.stderr).unwrap()
    };
    let script = succeeds(replay(&first("secular_lut")).args(["--amber", "-"]));
    assert!(script.contains("  BIND BUFFER sphere_lut AS storage DESCRIPTOR_SET 1 BINDING 2\n"));
    assert!(told(replay(&first("secular_lut")).args(["--glsl", "-"])).contains("it reads tables"));
    assert!(told(replay(&first("talk2017")).args(["--amber", "-"])).contains("sphere_lut as an image"));
}

/// A failure of each becomes simpler, fails in the same way, and does so to the same bits every time; and what is
/// written is replayed.
#[test]
fn minimized_failures_are_simpler_and_fail_in_the_same_way() {
    on_every_device(|name, _| {
        let folder = tempfile::tempdir().unwrap();
        let run = folder.path().join("run");
        audit(name, &["ellipse_axes/{naive,cross_dekker}", "ltc_disk/{talk2017,direct_exact}"], &run);
        let origin = Origin::read(&run).unwrap();
        for id in ["ellipse_axes/naive", "ltc_disk/talk2017"] {
            let place = origin.failures.iter().position(|failure| failure.id() == id).unwrap();
            let verdict = origin.failures[place].failure.verdict.name();
            let minimize = |out: &Path| {
                let mut command = rootq();
                command.arg("minimize").arg(&run).args(["--failure", &(place + 1).to_string(), "--json"]);
                command.args(["--device", name, "--validation", "--out"]).arg(out);
                serde_json::from_str::<Value>(&succeeds(&mut command)).unwrap()
            };
            let (once, again) =
                (folder.path().join(format!("{place}")), folder.path().join(format!("{place}.parquet")));
            let shrunk = minimize(&once);
            assert_eq!(shrunk, minimize(&again), "another time, another result");
            let cost = |side: &str| shrunk[side]["cost"].as_u64().unwrap();
            assert!(cost("after") < cost("before") / 2, "{id}: {} -> {}", cost("before"), cost("after"));
            assert_eq!(shrunk["before"]["told"]["verdict"], verdict);
            assert_eq!(shrunk["after"]["told"]["verdict"], verdict);
            for written in [once, again] {
                let mut command = rootq();
                command.arg("replay").arg(&written).args(["--json", "--device", name]);
                let replay: Value = serde_json::from_str(&succeeds(&mut command)).unwrap();
                let [failure] = &replay["failures"].as_array().unwrap()[..] else { panic!("{replay}") };
                assert_eq!(
                    (&failure["recorded"], &failure["scenario"]),
                    (&verdict.into(), &"minimized".into())
                );
                assert_eq!(
                    (&failure["now"]["fate"], &failure["now"]["same_bits"]),
                    (&"same".into(), &true.into())
                );
            }
        }
    });
}

#[test]
fn a_configuration_of_the_users_own_is_minimized() {
    let folder = tempfile::tempdir().unwrap();
    let tables = std::cell::Cell::new(0);
    let minimize = |variant: &str, rows: &str| {
        tables.set(tables.get() + 1);
        let table = folder.path().join(format!("{}.csv", tables.get()));
        std::fs::write(&table, format!("v1_x,v1_y,v1_z,v2_x,v2_y,v2_z\n{rows}")).unwrap();
        let mut command = rootq();
        command.args(["minimize", variant, "--device", "llvmpipe", "--inputs"]).arg(&table);
        command
    };
    // Aspect a million: the square of the minor length is below what the others' rounding leaves.
    let thin = "0.3712345,1.2345678,-0.7654321,0.3712346e-6,-1.1e-6,0.8e-6\n";
    let told = succeeds(&mut minimize("ellipse_axes/naive", thin));
    assert!(told.starts_with("ellipse_axes/naive is ") && told.contains("why not simpler"), "{told}");
    let taken = folder.path().join("taken");
    std::fs::create_dir(&taken).unwrap();
    std::fs::write(taken.join("notes.txt"), "mine").unwrap();
    let mut occupied = minimize("ellipse_axes/naive", thin);
    occupied.arg("--out").arg(&taken);
    let mut neither = rootq();
    neither.args(["minimize", "ellipse_axes/naive"]);
    for (mut command, expected) in [
        (minimize("ellipse_axes/cross_dekker", thin), "does not fail here: its verdict is ok"),
        (minimize("ellipse_axes/naive", ""), "must hold one configuration, and has none"),
        (
            minimize("ellipse_axes/naive", &format!("{thin}{thin}")),
            "must hold one configuration, and has several",
        ),
        (minimize("ellipse_axes/nave", thin), "did you mean 'naive'?"),
        (minimize("ellipse_axes", thin), "'ellipse_axes' is no FAMILY/VARIANT"),
        (occupied, "is there already; choose another --out"),
        (neither, "--failure <K>"),
    ] {
        let output = command.output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{stderr}");
        let lines: Vec<&str> = stderr.lines().filter(|line| !line.starts_with("device: ")).collect();
        assert!(lines.len() == 1 && lines[0].contains(expected), "{stderr}");
    }
}

/// The run keeps the module of a shader that is not built in: it is replayed without the file, and goes with what is
/// made smaller.
#[test]
fn a_shader_of_the_users_own_needs_no_file_to_be_replayed() {
    let folder = tempfile::tempdir().unwrap();
    let (run, small) = (folder.path().join("run"), folder.path().join("small"));
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shaders");
    let brought = ["--shader", "mine=axes.wgsl", "--adapter", "axes.toml"];
    let mut audit = rootq();
    audit.current_dir(&shaders).args(["audit", "ellipse_axes/mine", "-n", "5K", "--max-failures", "3"]);
    succeeds(audit.args(brought).args(["--device", "llvmpipe", "--out"]).arg(&run));
    let told = |path: &Path, more: &[&str]| {
        let mut command = rootq();
        command.current_dir(&shaders).args(["replay", "--json", "--device", "llvmpipe"]).arg(path).args(more);
        let value: Value = serde_json::from_str(&succeeds(&mut command)).unwrap();
        value["groups"].as_array().unwrap().clone()
    };
    let again = |groups: &[Value]| {
        assert!(!groups.is_empty());
        let same = |group: &Value| group["same_bits"] == group["failures"] && group.get("skipped").is_none();
        assert!(groups.iter().all(same), "{groups:?}");
    };
    again(&told(&run, &[]));
    again(&told(&run, &brought));
    let mut minimize = rootq();
    minimize.args(["minimize", "--failure", "1", "--device", "llvmpipe"]).arg(&run).arg("--out").arg(&small);
    succeeds(&mut minimize);
    again(&told(&small, &[]));

    let module = run.join("shaders/ellipse_axes.mine.spv");
    let mut bytes = std::fs::read(&module).unwrap();
    bytes[20] ^= 1;
    std::fs::write(&module, bytes).unwrap();
    let skipped = told(&run, &[])[0]["skipped"].as_str().unwrap().to_owned();
    assert!(skipped.contains("is not the shader that the run recorded: its SHA-256 is "), "{skipped}");
    std::fs::remove_file(&module).unwrap();
    let skipped = told(&run, &[])[0]["skipped"].as_str().unwrap().to_owned();
    assert!(skipped.ends_with("kept no module of it; --shader brings it"), "{skipped}");
    again(&told(&run, &brought));
}
