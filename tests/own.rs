//! Shaders of the user's own on both drivers: shapes that ship, adapted without a change to their text, and everything
//! that can be wrong with one.

mod drivers;

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

const DEVICES: [&str; 2] = ["llvmpipe", "SwiftShader"];

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

fn stand_in(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shaders").join(name)
}

/// What `rootq audit` recorded of these arguments.
fn audit(device: &str, arguments: &[&str]) -> (TempDir, Value) {
    let folder = tempdir().unwrap();
    let path = folder.path().join("run");
    let mut command = rootq();
    command.args(["audit", "-n", "20K", "--validation", "--device", device, "--out"]).arg(&path);
    let (code, _, words) = outcome(command.args(arguments));
    assert_eq!(code, 0, "{words}");
    let run = serde_json::from_str(&fs::read_to_string(path.join("run.json")).unwrap()).unwrap();
    (folder, run)
}

fn variant<'a>(run: &'a Value, name: &str) -> &'a Value {
    let variants = run["families"][0]["variants"].as_array().unwrap();
    variants.iter().find(|variant| variant["name"] == name).unwrap_or_else(|| panic!("no {name}"))
}

/// The share of a scenario's configurations that a variant gets wrong by its own fault.
fn failed(run: &Value, name: &str, scenario: &str) -> f64 {
    let results = variant(run, name)["results"].as_array().unwrap();
    let result = results.iter().find(|result| result["scenario"] == scenario).unwrap();
    result["audit"]["failed"]["rate"].as_f64().unwrap()
}

fn adapted(shader: &str, adapter: &str) -> [String; 4] {
    let path = |name| stand_in(name).display().to_string();
    ["--shader".to_owned(), path(shader), "--adapter".to_owned(), path(adapter)]
}

fn audit_adapted(device: &str, shader: &str, adapter: &str, more: &[&str]) -> (TempDir, Value) {
    let adapted = adapted(shader, adapter);
    let arguments: Vec<&str> = adapted.iter().map(String::as_str).chain(more.iter().copied()).collect();
    audit(device, &arguments)
}

/// The function of a fragment shader with its uniforms, sampler, varyings and derivatives, reading a table in the middle:
/// the table's own formula, so as often wrong as the built-in variant of it, but for the sampler's weights.
#[test]
fn a_fragment_shaders_polygon_light() {
    for device in DEVICES {
        let more = ["ltc_polygon/clipless_sphere", "--scenario", "ggx", "--scenario", "far"];
        let (_folder, run) = audit_adapted(device, "quad_light.frag", "quad_light.toml", &more);
        let apart = failed(&run, "quad_light", "ggx") - failed(&run, "clipless_sphere", "ggx");
        assert!(apart.abs() < 0.03, "{device}: {apart}");
        assert!(failed(&run, "quad_light", "far") < 1e-3, "{device}");
        assert_eq!(variant(&run, "quad_light")["own"], "glsl");
        assert_eq!(variant(&run, "quad_light")["tables"]["ggx_amplitude"], "image");
    }
}

/// Three corners for semi-axes, a struct, a shared global, a uniform and y up: a light far away is a point for everybody,
/// one overhead and close is not.
#[test]
fn a_disk_light_with_y_up() {
    for device in DEVICES {
        let (_folder, run) = audit_adapted(device, "disk_light.glsl", "disk_light.toml", &[]);
        assert!(failed(&run, "disk_light", "far") < 0.01, "{device}");
        assert!(failed(&run, "disk_light", "inside_out") > 0.9, "{device}");
    }
}

/// Polygon lights of HLSL without a horizon are right for seven in ten; the component-wise product for hardly any.
#[test]
fn a_trap_of_hlsl_is_seen() {
    for device in DEVICES {
        let (_folder, run) =
            audit_adapted(device, "minv_rows.hlsl", "minv_rows.toml", &["--scenario", "ggx"]);
        assert!(failed(&run, "rows", "ggx") < 0.4, "{device}");
        assert!(failed(&run, "components", "ggx") > 0.9, "{device}");
    }
}

/// The textbook's eigenvalues in WGSL fail where the built-in text of the same formula does.
#[test]
fn a_wgsl_port() {
    for device in DEVICES {
        let more = ["ellipse_axes/naive", "--scenario", "aspect", "--scenario", "scene"];
        let (_folder, run) = audit_adapted(device, "axes.wgsl", "axes.toml", &more);
        for scenario in ["aspect", "scene"] {
            let apart = failed(&run, "axes", scenario) - failed(&run, "naive", scenario);
            assert!(apart.abs() < 0.01, "{device} {scenario}: {apart}");
        }
    }
}

/// A cubic's solver by itself, between built-in steps; and its module, linked again, to the same bits.
#[test]
fn a_cubic_solver_and_its_module() {
    for device in DEVICES {
        let more = ["cone_axes/wikipedia"];
        let (folder, run) = audit_adapted(device, "solve_cubic.glsl", "solve_cubic.toml", &more);
        // The same formula for the roots.
        let apart = failed(&run, "solve_cubic", "scene") - failed(&run, "wikipedia", "scene");
        assert!(apart.abs() < 0.15 && failed(&run, "solve_cubic", "far") > 0.9, "{device}: {apart}");
        let module = folder.path().join("run/shaders/cone_axes.solve_cubic.spv");
        let shader = format!("solve_cubic={}", module.display());
        let (again, second) = audit(device, &["--shader", &shader, "--family", "cone_axes"]);
        assert_eq!(variant(&second, "solve_cubic")["own"], "spirv");
        let mut compare = rootq();
        compare
            .args(["compare", "--format", "json"])
            .arg(folder.path().join("run"))
            .arg(again.path().join("run"));
        let (code, told, words) = outcome(&mut compare);
        assert_eq!(code, 0, "{words}");
        let told: Value = serde_json::from_str(&told).unwrap();
        let rows = told["comparison"]["rows"].as_array().unwrap();
        assert!(!rows.is_empty() && rows.iter().all(|row| row["bits"]["differing"] == 0.0), "{told}");
    }
}

/// The shader is a variant like any other: in a run with times, in comparisons, and with its own configurations.
#[test]
fn every_verb_takes_it() {
    let folder = tempdir().unwrap();
    let run = folder.path().join("run");
    let adapted = adapted("axes.wgsl", "axes.toml");
    let mut command = rootq();
    command.args([
        "run",
        "ellipse_axes/cross",
        "-n",
        "5K",
        "--seconds",
        "0.2",
        "--scenario",
        "scene",
        "--out",
    ]);
    let (code, table, words) = outcome(command.arg(&run).args(&adapted));
    assert_eq!(code, 0, "{words}");
    assert!(table.contains("\n axes ") && table.contains("\n cross "), "{table}");
    let (code, table, words) = outcome(rootq().arg("compare").args([&run, &run]).arg("--all"));
    assert!(code == 0 && table.contains("ellipse_axes/axes"), "{words}{table}");
    let (code, table, words) = outcome(rootq().args(["pick", "ellipse_axes"]).arg(&run));
    assert!(code == 0 && table.contains("axes"), "{words}{table}");

    let inputs = folder.path().join("in.csv");
    fs::write(&inputs, "v1_x,v1_y,v1_z,v2_x,v2_y,v2_z\n3,0,0,0,2,0\n").unwrap();
    let mut command = rootq();
    command.args(["eval", "ellipse_axes", "--variant", "cross", "--inputs"]).arg(&inputs).args(&adapted);
    let (code, table, words) = outcome(&mut command);
    assert_eq!(code, 0, "{words}");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let at = rows[0].iter().position(|column| *column == "axes.major_len").unwrap();
    assert_eq!(rows[1][at].parse::<f32>(), Ok(3.0));
    assert!(rows[0].contains(&"cross.major_len"));
}

/// A function that has the family's signature already, and a uniform: the adapter need say nothing but its value.
#[test]
fn a_uniform_of_a_function_of_the_family() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("in.csv"), "x\n9\n").unwrap();
    for (file, text) in [
        ("a.comp", "uniform real gain;\nreal builtin_sqrt(real x) { return gain * sqrt(x); }\n"),
        ("b.hlsl", "cbuffer B { real gain; };\nreal builtin_sqrt(real x) { return gain * sqrt(x); }\n"),
    ] {
        fs::write(folder.path().join(file), text).unwrap();
        fs::write(folder.path().join("a.toml"), "uniforms = { gain = \"real(2.0)\" }\n").unwrap();
        let mut command = rootq();
        command.current_dir(folder.path());
        command.args([
            "eval",
            "sqrt",
            "--inputs",
            "in.csv",
            "--shader",
            file,
            "--adapter",
            "a.toml",
            "-D",
            "real=float",
        ]);
        let (code, table, words) = outcome(&mut command);
        assert_eq!(code, 0, "{words}");
        let last = table.lines().last().unwrap().split(',').next_back().unwrap();
        assert_eq!(last.parse::<f32>(), Ok(6.0), "{table}");
    }
}

/// Included files are found beside the shader, in folders of -I, and among the built-in steps; -D wins over all else.
#[test]
fn includes_and_definitions() {
    let folder = tempdir().unwrap();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    fs::write(inner.join("gain.glsl"), "#include \"more.glsl\"\n#ifndef GAIN\n#define GAIN MORE\n#endif\n")
        .unwrap();
    fs::write(inner.join("more.glsl"), "const float MORE = 2.0;\n").unwrap();
    let text = "#include <gain.glsl>\n#include \"common/hypot.glsl\"\n\
                float builtin_sqrt(float x) { return GAIN * hypot(sqrt(x), 0.0); }\n";
    fs::write(folder.path().join("mine.comp"), text).unwrap();
    let inputs = folder.path().join("in.csv");
    fs::write(&inputs, "x\n9\n").unwrap();
    for (define, expected) in [(None, 6.0), (Some("GAIN=0.5"), 1.5), (Some("GAIN=float(1)"), 3.0)] {
        let mut command = rootq();
        command.current_dir(folder.path());
        command.args(["eval", "sqrt", "--inputs", "in.csv", "--shader", "mine.comp", "-I", "inner"]);
        let (code, table, words) = outcome(command.args(define.iter().flat_map(|define| ["-D", *define])));
        assert_eq!(code, 0, "{words}");
        let last = table.lines().last().unwrap().split(',').next_back().unwrap();
        assert_eq!(last.parse::<f32>(), Ok(expected), "{table}");
    }
}

/// What may be wrong with a shader, each told by one line that says where, and nothing is left behind.
#[test]
fn every_mistake_is_one_line() {
    let folder = tempdir().unwrap();
    let cases: &[(&str, &str, &str)] = &[
        ("a.comp", "\nfloat builtin_sin(float x) { return y; }", "a.comp:2: 'y' : undeclared identifier"),
        (
            "b.comp",
            "float sinus(float x) { return x; }",
            "b.comp: there is no function 'builtin_sin' in it, but: sinus",
        ),
        (
            "c.comp",
            "vec2 builtin_sin(vec2 x) { return x; }",
            "c.comp: the function is 'vec2 builtin_sin(vec2 x)'; the family's is 'float builtin_sin(float x)'",
        ),
        (
            "d.comp",
            "float builtin_sin(float x) { float a[4]; return a[4]; }",
            "d.comp:1: '[' : array index out of range '4'",
        ),
        (
            "e.comp",
            "float builtin_sin(float x) {\n  float a[4] = float[4](x, x, x, x);\n  a[int(x)] = 1.0;\n  return a[0]; }",
            "sin/e indexes outside of one of its own arrays, at ",
        ),
        (
            "f.comp",
            "buffer B { float b[]; };\nfloat builtin_sin(float x) { b[1 << 30] = x; return x; }",
            "f.comp:2: 'b' is memory outside of the function",
        ),
        (
            "g.comp",
            "#extension GL_X_absent : require\nfloat builtin_sin(float x) { return x; }",
            "g.comp:1: '#extension' : extension not supported: GL_X_absent",
        ),
        (
            "h.comp",
            "float f(float x) { return f(x); }\nfloat builtin_sin(float x) { return f(x); }",
            "h.comp: Recursion detected",
        ),
        (
            "i.comp",
            "uniform float gain;\nfloat builtin_sin(float x) { return gain * x; }",
            "i.comp:2: 'gain' is set by the application; give it a value in the adapter: [uniforms] gain",
        ),
        ("j.comp", "#include \"absent.glsl\"\nfloat builtin_sin(float x) { return x; }", "j.comp:1: "),
        (
            "k.comp",
            "/*---\nfamily = \"sin\"\nfunctoin = \"f\"\n---*/\nfloat f(float x) { return x; }",
            "k.comp:3: unknown field `functoin`",
        ),
        ("l.hlsl", "\n\nfloat builtin_sin(float x) { return y; }", "l.hlsl:3: 'y' : unknown variable"),
        (
            "m.hlsl",
            "float builtin_sin(float x) { float a[2] = { x, x }; return a[int(x)]; }",
            "sin/m indexes outside of one of its own arrays, at ",
        ),
        (
            "n.wgsl",
            "\nfn builtin_sin(x: f32) -> f32 { return y; }",
            "n.wgsl:2: no definition in scope for identifier",
        ),
        (
            "o.wgsl",
            "fn builtin_sin(x: f32) -> f32 { return builtin_sin(x); }",
            "o.wgsl:1: declaration of `builtin_sin` is recursive",
        ),
        (
            "p.wgsl",
            "fn builtin_sin(x: f32) -> f32 { var a = array<f32, 2>(x, x); return a[u32(x)]; }",
            "sin/p indexes outside of one of its own arrays, at ",
        ),
        ("q.spv", "no module at all", "q.spv: not a SPIR-V module"),
        (
            "r.txt",
            "float builtin_sin(float x) { return x; }",
            "r.txt: the file's ending does not tell its language",
        ),
    ];
    for (name, text, expected) in cases {
        let file = folder.path().join(name);
        fs::write(&file, text).unwrap();
        let run = folder.path().join("run");
        let mut command = rootq();
        command.current_dir(folder.path());
        command.args([
            "audit", "--family", "sin", "-n", "10K", "--device", "llvmpipe", "--shader", name, "--out",
        ]);
        let (code, table, words) = outcome(command.arg(&run));
        let told: Vec<&str> = words.lines().filter(|line| line.starts_with("rootq: ")).collect();
        assert_eq!((code, told.len(), table.as_str()), (2, 1, ""), "{name}: {words}");
        assert!(told[0].strip_prefix("rootq: ").unwrap().starts_with(expected), "{name}: {words}");
        assert!(!run.exists(), "{name}");
    }
    let told = |arguments: &[&str]| outcome(rootq().current_dir(folder.path()).args(arguments)).2;
    assert!(told(&["audit", "--shader", "a.comp"]).contains("which family's function is it?"));
    assert!(told(&["audit", "--shader", "a.comp", "--family", "sine"]).contains("unknown family 'sine'"));
    assert!(
        told(&["audit", "--shader", "absent.comp", "--family", "sin"])
            .contains("absent.comp: cannot be read")
    );
    assert!(told(&["audit", "--shader", "native=a.comp", "--family", "sin"]).contains("--shader NAME=FILE"));
    assert!(told(&["audit", "--family", "sin"]).contains("--shader"));
}

/// What a device lacks is the caller's affair, and not a row that is missing from a table.
#[test]
fn what_the_device_lacks_is_told() {
    let folder = tempdir().unwrap();
    let text = "float builtin_sin(float x) { return float(double(x) * 2.0lf); }";
    fs::write(folder.path().join("double.comp"), text).unwrap();
    let mut command = rootq();
    command.current_dir(folder.path());
    command.args([
        "audit",
        "--family",
        "sin",
        "-n",
        "1K",
        "--device",
        "SwiftShader",
        "--shader",
        "double.comp",
    ]);
    let (code, _, words) = outcome(&mut command);
    assert!(code == 2 && words.contains("sin/double needs "), "{words}");
}
