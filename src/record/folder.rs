//! A run's folder: written aside and moved into place when it is whole, so that there is never half a run.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::bits::{self, Bits};
use super::{Error, Evidence, Run, SCHEMA, failures};

const RUN: &str = "run.json";
const FAILURES: &str = "failures.parquet";
const BITS: &str = "bits.parquet";

/// A folder being written.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    draft: TempDir,
    replace: bool,
    /// A file in the target that ends with the run.
    journal: Option<&'static str>,
}

impl Folder {
    /// Makes sure, before any work is done, that a run can be written to `target`.
    ///
    /// The target may not exist, be an empty folder, or with `replace` hold an earlier run.
    pub fn create(target: &Path, replace: bool) -> Result<Folder, Error> {
        let io = |action, source| Error::Io { action, path: target.to_owned(), source };
        if let Ok(mut entries) = fs::read_dir(target) {
            if entries.next().is_some() && !(replace && target.join(RUN).is_file()) {
                return Err(Error::Occupied { path: target.to_owned() });
            }
        } else if target.exists() {
            return Err(io("use as a folder", std::io::ErrorKind::NotADirectory.into()));
        }
        Self::beside(target, replace, None)
    }

    /// As [`create`](Self::create), for a run that keeps the file `journal` in its target until it is finished: a folder
    /// that holds one is a run to go on with.
    pub fn resume(target: &Path, replace: bool, journal: &'static str) -> Result<Folder, Error> {
        if target.join(journal).is_file() {
            return Self::beside(target, replace, Some(journal));
        }
        Ok(Folder { journal: Some(journal), ..Self::create(target, replace)? })
    }

    fn beside(target: &Path, replace: bool, journal: Option<&'static str>) -> Result<Folder, Error> {
        let io = |action, source| Error::Io { action, path: target.to_owned(), source };
        let parent = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        fs::create_dir_all(parent).map_err(|source| io("create", source))?;
        let draft = tempfile::Builder::new()
            .prefix(".rootq-")
            .tempdir_in(parent)
            .map_err(|source| io("write to", source))?;
        Ok(Folder { target: target.to_owned(), draft, replace, journal })
    }

    /// Writes the record and moves the folder into place; returns where that is.
    pub fn finish(self, run: &Run, evidence: &[Evidence]) -> Result<PathBuf, Error> {
        let path = self.draft.path().join(RUN);
        let io = |action, path: &Path| {
            let path = path.to_owned();
            move |source| Error::Io { action, path, source }
        };
        let mut text =
            serde_json::to_string(run).map_err(|source| Error::Json { path: path.clone(), source })?;
        text.push('\n');
        fs::write(&path, text).map_err(io("write", &path))?;
        failures::write(&self.draft.path().join(FAILURES), evidence)?;
        bits::write(&self.draft.path().join(BITS), evidence)?;

        if let Some(journal) = self.journal.map(|name| self.target.join(name)).filter(|path| path.is_file()) {
            fs::remove_file(&journal).map_err(io("remove", &journal))?;
        }
        if self.replace && self.target.join(RUN).is_file() {
            fs::remove_dir_all(&self.target).map_err(io("replace", &self.target))?;
        } else if self.target.is_dir() {
            fs::remove_dir(&self.target).map_err(io("replace", &self.target))?;
        }
        let draft = self.draft.keep();
        fs::rename(&draft, &self.target).map_err(io("write", &self.target))?;
        open_permissions(&self.target);
        Ok(self.target)
    }
}

/// A run read back.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// As it was named.
    pub path: PathBuf,
    pub run: Run,
    /// Empty in runs of versions that did not keep them, and where nothing was audited.
    pub bits: Bits,
}

/// Reads the run in folder `path`.
pub fn read(path: &Path) -> Result<Recorded, Error> {
    let file = path.join(RUN);
    let text = match fs::read(&file) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(Error::NoRun { path: path.to_owned() });
        }
        Err(source) => return Err(Error::Io { action: "read", path: file, source }),
    };
    let unreadable = |message| Error::Unreadable { path: path.to_owned(), message };
    /// Only the version, so that a newer schema is told apart from a broken file.
    #[derive(serde::Deserialize)]
    struct Version {
        schema: u32,
    }
    let version: Version = serde_json::from_slice(&text).map_err(|error| unreadable(error.to_string()))?;
    if version.schema > SCHEMA {
        let newer =
            format!("its schema is {}, this version knows {SCHEMA}; use a newer rootq", version.schema);
        return Err(unreadable(newer));
    }
    let run = serde_json::from_slice(&text).map_err(|error| unreadable(error.to_string()))?;
    let bits = bits::read(&path.join(BITS)).map_err(|error| unreadable(error.to_string()))?;
    Ok(Recorded { path: path.to_owned(), run, bits })
}

/// Temporary folders are private; a finished run is as readable as any other folder.
fn open_permissions(folder: &Path) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // A folder that stays private is still a whole run.
        _ = fs::set_permissions(folder, fs::Permissions::from_mode(0o755));
    }
    #[cfg(not(unix))]
    let _ = folder;
}

/// Where a run goes if nobody says otherwise: `bench_results/<device>/<date>-<commit>`, with a number if that is taken.
pub fn default_path(run_device: &str, date: &str, revision: &str) -> PathBuf {
    let commit = if revision.is_empty() { "unknown" } else { &revision[..revision.len().min(9)] };
    let folder = Path::new("bench_results").join(slug(run_device));
    let name = format!("{date}-{commit}");
    let candidates = std::iter::once(name.clone()).chain((2..1000).map(|number| format!("{name}-{number}")));
    candidates
        .map(|name| folder.join(name))
        .find(|path| !path.exists())
        .unwrap_or_else(|| folder.join(format!("{name}-1000")))
}

/// Lower-case letters and digits, everything else one hyphen: `llvmpipe-llvm-15-0-6-256-bits`.
fn slug(name: &str) -> String {
    let mut slug = String::new();
    for letter in name.chars() {
        if letter.is_ascii_alphanumeric() {
            slug.push(letter.to_ascii_lowercase());
        } else if !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
    }
    slug.trim_end_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn device_names_become_folders() {
        assert_eq!(slug("llvmpipe (LLVM 15.0.6, 256 bits)"), "llvmpipe-llvm-15-0-6-256-bits");
    }

    #[test]
    fn an_occupied_folder_is_refused_and_an_empty_one_taken() {
        let parent = tempfile::tempdir().unwrap();
        assert!(Folder::create(parent.path(), false).is_ok());
        fs::write(parent.path().join("notes.txt"), "mine").unwrap();
        assert!(matches!(Folder::create(parent.path(), false), Err(Error::Occupied { .. })));
        // Even with `replace`, only runs are replaced.
        assert!(matches!(Folder::create(parent.path(), true), Err(Error::Occupied { .. })));
        assert!(matches!(Folder::create(&parent.path().join("notes.txt"), true), Err(Error::Io { .. })));
    }
}
