//! Files written aside and moved into place when whole: a mistake must leave nothing behind.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use tempfile::NamedTempFile;

/// Whether a path means standard input or output.
pub(super) fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// A file beside the target, or anywhere if the target is standard output.
pub(super) fn draft(target: &Path) -> Result<NamedTempFile> {
    if is_dash(target) {
        return NamedTempFile::new().map_err(|error| anyhow!("no temporary file: {error}"));
    }
    if target.is_dir() {
        bail!("cannot write {}: it is a folder", target.display());
    }
    let parent = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    NamedTempFile::new_in(parent).map_err(|error| anyhow!("cannot write {}: {}", target.display(), error))
}

/// Moves a draft to where it belongs.
pub(super) fn deliver(mut draft: NamedTempFile, target: &Path) -> Result<()> {
    if is_dash(target) {
        let mut file = draft.reopen()?;
        io::copy(&mut file, &mut io::stdout().lock())?;
        return Ok(());
    }
    draft.flush()?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        draft.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))?;
    }
    draft.persist(target).map_err(|error| anyhow!("cannot write {}: {}", target.display(), error.error))?;
    Ok(())
}
