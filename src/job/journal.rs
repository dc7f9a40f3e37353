//! `journal.jsonl`: what an unfinished job is, on the first line, and one line a finished part.
//!
//! A line is written whole or counts for nothing: a journal that ends in the middle of one is cut back to the line before.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::audit::{OracleSummary, Summary};

/// The journal's name in the folder of its run.
pub const JOURNAL: &str = "journal.jsonl";

/// One finished part.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Part {
    pub family: String,
    pub range: Range<u64>,
    pub oracle: OracleSummary,
    /// Digest of the configurations.
    pub inputs: u64,
    /// One a program.
    pub summaries: Vec<Summary>,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error("cannot {action} {}", path.display())]
    Io { action: &'static str, path: PathBuf, source: io::Error },
    #[error("{} is of another run: its {what} differs; choose another --out, or --force to start anew", path.display())]
    Other { path: PathBuf, what: String },
    #[error("{}:{line} is no line of a journal ({reason}); --force starts anew", path.display())]
    Broken { path: PathBuf, line: usize, reason: String },
}

/// An open journal.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    parts: Vec<Part>,
}

impl Journal {
    /// Opens the journal in `folder`, which is made if need be, or begins one.
    ///
    /// `job` says all that the results depend on; a journal of another job is refused, and one that is there is forgotten
    /// with `anew`.
    pub fn open(folder: &Path, job: &Map<String, Value>, anew: bool) -> Result<Journal, Error> {
        let path = folder.join(JOURNAL);
        let io = |action, path: &Path| {
            let path = path.to_owned();
            move |source| Error::Io { action, path, source }
        };
        fs::create_dir_all(folder).map_err(io("create", folder))?;
        let text = match fs::read_to_string(&path) {
            Ok(text) if !anew => text,
            Err(error) if error.kind() != io::ErrorKind::NotFound && !anew => {
                return Err(io("read", &path)(error));
            }
            _ => String::new(),
        };
        // What follows the last newline was being written when the program ended.
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        let parts = if whole == 0 { Vec::new() } else { read(&path, &text[..whole], job)? };
        let options = OpenOptions::new().create(true).write(true).truncate(false).open(&path);
        let mut file = options.map_err(io("write", &path))?;
        file.set_len(whole as u64).map_err(io("write", &path))?;
        io::Seek::seek(&mut file, io::SeekFrom::End(0)).map_err(io("write", &path))?;
        let mut journal = Journal { path, file, parts };
        if whole == 0 {
            journal.write(&Value::Object(job.clone()))?;
        }
        Ok(journal)
    }

    /// The finished parts of a family, in order.
    pub fn parts(&self, family: &str) -> impl Iterator<Item = &Part> {
        self.parts.iter().filter(move |part| part.family == family)
    }

    /// How many parts are finished.
    pub fn finished(&self) -> usize {
        self.parts.len()
    }

    /// Notes a finished part; once it returns, the part outlives the program.
    pub fn add(&mut self, part: Part) -> Result<(), Error> {
        self.write(&part)?;
        self.parts.push(part);
        Ok(())
    }

    fn write<T: Serialize>(&mut self, line: &T) -> Result<(), Error> {
        let io = |source| Error::Io { action: "write", path: self.path.clone(), source };
        let mut text = serde_json::to_string(line).map_err(|error| io(error.into()))?;
        text.push('\n');
        self.file.write_all(text.as_bytes()).and_then(|()| self.file.sync_data()).map_err(io)
    }
}

fn read(path: &Path, text: &str, job: &Map<String, Value>) -> Result<Vec<Part>, Error> {
    let broken = |line: usize, error: &dyn std::fmt::Display| Error::Broken {
        path: path.to_owned(),
        line: line + 1,
        reason: error.to_string(),
    };
    let mut lines = text.lines().enumerate();
    let (_, first) = lines.next().unwrap_or((0, ""));
    let theirs: Map<String, Value> = serde_json::from_str(first).map_err(|error| broken(0, &error))?;
    let differs = |key: &&String| theirs.get(*key) != job.get(*key);
    if let Some(what) = job.keys().chain(theirs.keys()).find(differs) {
        return Err(Error::Other { path: path.to_owned(), what: what.clone() });
    }
    lines.map(|(line, text)| serde_json::from_str(text).map_err(|error| broken(line, &error))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(device: &str) -> Map<String, Value> {
        Map::from_iter([("device".to_owned(), device.into()), ("seed".to_owned(), 1.into())])
    }

    fn part(start: u64) -> Part {
        let oracle = OracleSummary { worst_bound: f64::INFINITY, ..OracleSummary::default() };
        Part { family: "f".to_owned(), range: start..start + 1, oracle, inputs: 0, summaries: Vec::new() }
    }

    #[test]
    fn what_was_written_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        let mut journal = Journal::open(folder.path(), &job("a"), false).unwrap();
        journal.add(part(0)).unwrap();
        journal.add(part(1)).unwrap();
        drop(journal);
        let journal = Journal::open(folder.path(), &job("a"), false).unwrap();
        let starts: Vec<u64> = journal.parts("f").map(|part| part.range.start).collect();
        assert_eq!(starts, [0, 1]);
        assert!(journal.parts("f").all(|part| part.oracle.worst_bound == f64::INFINITY));
        assert_eq!(journal.parts("g").count(), 0);
    }

    #[test]
    fn half_a_line_counts_for_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut journal = Journal::open(folder.path(), &job("a"), false).unwrap();
        journal.add(part(0)).unwrap();
        journal.add(part(1)).unwrap();
        drop(journal);
        let path = folder.path().join(JOURNAL);
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, &text[..text.len() - 5]).unwrap();
        let mut journal = Journal::open(folder.path(), &job("a"), false).unwrap();
        assert_eq!(journal.finished(), 1);
        journal.add(part(1)).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }

    #[test]
    fn another_job_s_journal_is_refused_unless_told() {
        let folder = tempfile::tempdir().unwrap();
        Journal::open(folder.path(), &job("a"), false).unwrap().add(part(0)).unwrap();
        let error = Journal::open(folder.path(), &job("b"), false).unwrap_err().to_string();
        assert!(error.contains("its device differs"), "{error}");
        assert_eq!(Journal::open(folder.path(), &job("b"), true).unwrap().finished(), 0);
        fs::write(folder.path().join(JOURNAL), "{}\nno\n").unwrap();
        let error = Journal::open(folder.path(), &Map::new(), false).unwrap_err().to_string();
        assert!(error.contains(":2 is no line of a journal"), "{error}");
    }
}
