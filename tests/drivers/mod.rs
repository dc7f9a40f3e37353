//! The two real drivers that every device test runs on. A missing one is an error here, never a skip.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// Lavapipe's manifest, from the folders in which the Vulkan loader looks.
fn lavapipe() -> Result<PathBuf, String> {
    let folders = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"];
    let manifests = folders.iter().filter_map(|folder| fs::read_dir(folder).ok()).flatten().flatten();
    manifests
        .map(|entry| entry.path())
        .find(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("lvp_icd.")))
        .ok_or_else(|| "lavapipe is missing: run 'make test', which installs mesa-vulkan-drivers".to_owned())
}

/// SwiftShader's manifest, unpacked by `make test`.
fn swiftshader() -> Result<PathBuf, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/swiftshader/vk_swiftshader_icd.json");
    if path.exists() {
        return Ok(path);
    }
    Err(format!("SwiftShader is missing at {}: run 'make test', which unpacks it there", path.display()))
}

/// Both, as `VK_DRIVER_FILES` wants them.
pub(crate) fn both() -> Result<OsString, String> {
    std::env::join_paths([lavapipe()?, swiftshader()?]).map_err(|error| error.to_string())
}
