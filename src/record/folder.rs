//! A run's folder: written aside and moved into place when it is whole, so that there is never half a run, and no file of
//! another kind is touched.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::bits::{self, Bits};
use super::{Error, Evidence, Run, SCHEMA, failures};

const RUN: &str = "run.json";
pub(super) const FAILURES: &str = "failures.parquet";
const BITS: &str = "bits.parquet";
/// A folder of modules, in runs of shaders that are not built in.
const SHADERS: &str = "shaders";

/// A run's files; the record, without which a folder holds no run, is the last to come.
const FILES: [&str; 3] = [FAILURES, BITS, RUN];

/// A folder to be written.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    /// A file in the target that ends with the run.
    journal: Option<&'static str>,
    /// File names and words of modules to be kept.
    modules: Vec<(String, Vec<u32>)>,
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
            return Err(io("use as a folder", io::ErrorKind::NotADirectory.into()));
        }
        // Whatever ends the program, nothing is left behind until there is a run: this draft goes again at once.
        draft(target)?;
        Ok(Folder { target: target.to_owned(), journal: None, modules: Vec::new() })
    }

    /// As [`create`](Self::create), for a run that keeps the file `journal` in its target until it is finished: a folder
    /// that holds one is a run to go on with, and may hold the earlier run that is to be replaced, but nothing else.
    pub fn resume(target: &Path, replace: bool, journal: &'static str) -> Result<Folder, Error> {
        if !target.join(journal).is_file() {
            return Ok(Folder { journal: Some(journal), ..Self::create(target, replace)? });
        }
        let io = |source| Error::Io { action: "read", path: target.to_owned(), source };
        for entry in fs::read_dir(target).map_err(io)? {
            let name = entry.map_err(io)?.file_name();
            if !FILES.iter().chain([&journal, &SHADERS]).any(|own| name == **own) {
                return Err(Error::Foreign { path: target.join(name) });
            }
        }
        draft(target)?;
        Ok(Folder { target: target.to_owned(), journal: Some(journal), modules: Vec::new() })
    }

    /// Keeps a variant's module in the run, for whoever repeats it without the variant's text.
    pub fn keep_module(&mut self, family: &str, variant: &str, words: &[u32]) {
        self.modules.push((module_name(family, variant), words.to_owned()));
    }

    /// Writes the record and moves it into place; returns where that is.
    pub fn finish(self, run: &Run, evidence: &[Evidence]) -> Result<PathBuf, Error> {
        let draft = draft(&self.target)?;
        let path = draft.path().join(RUN);
        let mut text =
            serde_json::to_string(run).map_err(|source| Error::Json { path: path.clone(), source })?;
        text.push('\n');
        fs::write(&path, text).map_err(|source| Error::Io { action: "write", path, source })?;
        failures::write(&draft.path().join(FAILURES), evidence)?;
        bits::write(&draft.path().join(BITS), evidence)?;
        if !self.modules.is_empty() {
            let folder = draft.path().join(SHADERS);
            let io = |action| move |source| Error::Io { action, path: folder.clone(), source };
            fs::create_dir(draft.path().join(SHADERS)).map_err(io("create"))?;
            for (name, words) in &self.modules {
                let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
                let path = draft.path().join(SHADERS).join(name);
                fs::write(&path, bytes).map_err(|source| Error::Io { action: "write", path, source })?;
            }
        }
        // The run is whole: from here on it outlives whatever goes wrong.
        let draft = draft.keep();
        self.place(&draft).map_err(|source| Error::Left { draft, path: self.target.clone(), source })?;
        Ok(self.target)
    }

    /// The journal goes last: until then the work can be repeated from it.
    fn place(&self, draft: &Path) -> io::Result<()> {
        if self.target.is_dir() {
            // There is no run while there are files of two.
            remove(&self.target.join(RUN))?;
            for file in FILES {
                fs::rename(draft.join(file), self.target.join(file))?;
            }
            remove_modules(&self.target.join(SHADERS))?;
            if !self.modules.is_empty() {
                fs::rename(draft.join(SHADERS), self.target.join(SHADERS))?;
            }
            fs::remove_dir(draft)?;
        } else {
            fs::rename(draft, &self.target)?;
            open_permissions(&self.target);
        }
        self.journal.map_or(Ok(()), |journal| remove(&self.target.join(journal)))
    }
}

/// An empty folder beside `target`, from where files can be moved to it.
fn draft(target: &Path) -> Result<TempDir, Error> {
    let io = |action| move |source| Error::Io { action, path: target.to_owned(), source };
    let parent = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).map_err(io("create"))?;
    tempfile::Builder::new().prefix(".rootq-").tempdir_in(parent).map_err(io("write to"))
}

/// Removes a file, if it is there.
fn remove(file: &Path) -> io::Result<()> {
    match fs::remove_file(file) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Removes an earlier run's modules and their folder; anything else in it stays and is an error.
fn remove_modules(folder: &Path) -> io::Result<()> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == MODULE) {
            fs::remove_file(path)?;
        }
    }
    fs::remove_dir(folder)
}

const MODULE: &str = "spv";

fn module_name(family: &str, variant: &str) -> String {
    format!("{family}.{variant}.{MODULE}")
}

/// Where the run in folder `path` keeps a variant's module, if it keeps it.
pub fn module_path(path: &Path, family: &str, variant: &str) -> PathBuf {
    path.join(SHADERS).join(module_name(family, variant))
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
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
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

    const JOURNAL: &str = "journal";

    fn run() -> Run {
        serde_json::from_value(serde_json::json!({
            "schema": SCHEMA,
            "program": { "version": "", "revision": "", "dirty": false, "compiler": "" },
            "command": [],
            "started": "",
            "seconds": 0.0,
            "host": { "os": "", "arch": "", "threads": 1 },
            "device": {
                "index": 0, "name": "", "kind": "", "uuid": "", "vendor_id": 0, "device_id": 0, "driver": "",
                "driver_info": "", "driver_version": 0, "api_version": "", "subgroup_size": 1,
                "shader_float64": false, "shader_float16": false, "float_controls": null,
                "max_storage_buffer_range": 0, "unified_memory": true, "timestamp_period": 1.0,
                "timestamp_bits": 0, "validation": false
            },
            "settings": { "seed": 1, "configurations": 0, "chunk": 1, "max_failures": 0 },
            "families": []
        }))
        .unwrap()
    }

    fn entries(folder: &Path) -> Vec<String> {
        let names =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_is_left_behind_before_there_is_a_run() {
        let parent = tempfile::tempdir().unwrap();
        let _folder = Folder::create(&parent.path().join("run"), false).unwrap();
        assert!(entries(parent.path()).is_empty());
    }

    #[test]
    fn a_journal_among_other_files_is_refused() {
        let parent = tempfile::tempdir().unwrap();
        for file in [JOURNAL, RUN, FAILURES] {
            fs::write(parent.path().join(file), "").unwrap();
            assert!(Folder::resume(parent.path(), false, JOURNAL).is_ok(), "{file}");
        }
        fs::write(parent.path().join("notes.txt"), "mine").unwrap();
        let error = Folder::resume(parent.path(), true, JOURNAL).unwrap_err();
        assert!(matches!(&error, Error::Foreign { path } if path.ends_with("notes.txt")), "{error}");
    }

    /// Also when they come while the work is done.
    #[test]
    fn other_files_neither_hinder_a_run_nor_go_with_one() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("run");
        fs::create_dir(&target).unwrap();
        fs::write(target.join(JOURNAL), "").unwrap();
        let folder = Folder::resume(&target, false, JOURNAL).unwrap();
        fs::write(target.join("notes.txt"), "mine").unwrap();
        folder.finish(&run(), &[]).unwrap();
        assert_eq!(entries(&target), [BITS, FAILURES, "notes.txt", RUN]);
        Folder::create(&target, true).unwrap().finish(&run(), &[]).unwrap();
        assert_eq!(entries(&target), [BITS, FAILURES, "notes.txt", RUN]);
        assert_eq!(entries(parent.path()), ["run"]);
    }

    #[test]
    fn a_run_that_cannot_be_moved_is_kept_with_its_journal() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("run");
        fs::create_dir(&target).unwrap();
        fs::write(target.join(JOURNAL), "").unwrap();
        let folder = Folder::resume(&target, false, JOURNAL).unwrap();
        // A folder that is not empty cannot be replaced by a file.
        fs::create_dir_all(target.join(FAILURES).join("inner")).unwrap();
        let error = folder.finish(&run(), &[]).unwrap_err();
        let Error::Left { draft, .. } = &error else { panic!("{error}") };
        assert_eq!(entries(draft), [BITS, FAILURES, RUN]);
        assert!(target.join(JOURNAL).is_file());
    }
}
