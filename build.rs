//! Tells the build which revision it is, and that `glsl/` is part of the program.

use std::process::Command;

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn main() {
    println!("cargo:rerun-if-changed=glsl");
    println!("cargo:rerun-if-changed=src");
    println!("cargo:rerun-if-changed=data");
    for path in ["HEAD", "index"] {
        if let Some(path) = git(&["rev-parse", "--git-path", path]) {
            println!("cargo:rerun-if-changed={path}");
        }
    }
    let revision = git(&["rev-parse", "HEAD"]).unwrap_or_default();
    let dirty = git(&["status", "--porcelain", "--", "src", "glsl", "data", "Cargo.toml", "Cargo.lock"])
        .is_some_and(|changes| !changes.is_empty());
    println!("cargo:rustc-env=ROOTQ_REVISION={revision}");
    println!("cargo:rustc-env=ROOTQ_DIRTY={dirty}");
}
