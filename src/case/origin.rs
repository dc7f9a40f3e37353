//! Where failures come from, and the kernels that made them.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::catalog::{self, Catalog, Kernel};
use crate::family::Problem;
use crate::record::{self, RecordedFailure, Run};

/// A run's folder, or the folder of a file with failures, and what is recorded beside them. By default there is none.
#[derive(Default)]
pub struct Origin {
    /// As it was named.
    pub path: PathBuf,
    folder: Option<PathBuf>,
    /// Absent where there is no `run.json`, such as beside what `hunt` and `minimize` write.
    pub run: Option<Run>,
    pub failures: Vec<RecordedFailure>,
}

/// A variant ready to be made a program, or why it cannot be.
#[derive(Debug, thiserror::Error)]
pub enum Lost {
    #[error("{id} is not built into this rootq, and the run kept no module of it; --shader brings it")]
    Absent { id: String },
    #[error("{} is not the shader that the run recorded: its SHA-256 is {is}", path.display())]
    Changed { path: PathBuf, is: String },
    #[error("{id} reads a table that this rootq does not have: {message}")]
    Table { id: String, message: String },
    #[error("{} is not SPIR-V: {message}", path.display())]
    NotSpirv { path: PathBuf, message: &'static str },
    #[error("cannot read {}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Compile(#[from] catalog::Error),
}

/// A kernel and what is to be said of it.
pub struct Module {
    /// As it was audited.
    pub kernel: Kernel,
    /// The same to be run here: one that tells where it would leave its arrays, where there is one.
    pub safe: Kernel,
    /// Where the shader is not that of the run, by its hash: how it differs.
    pub note: Option<String>,
}

impl Origin {
    /// Reads a run's folder, or a file of failures.
    pub fn read(path: &Path) -> Result<Origin, record::Error> {
        let folder = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
        let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() };
        let failures = record::failures(path)?;
        let run = match record::read(&folder) {
            Ok(recorded) => Some(recorded.run),
            Err(record::Error::NoRun { .. }) => None,
            Err(error) => return Err(error),
        };
        Ok(Origin { path: path.to_owned(), folder: Some(folder), run, failures })
    }

    /// Device and driver of the run, if they are recorded.
    pub fn device(&self) -> Option<String> {
        self.run.as_ref().map(|run| device(&run.device))
    }

    /// Where a run keeps the module of a shader that is the user's own.
    pub fn shader(&self, problem: &dyn Problem, variant: &str) -> Option<PathBuf> {
        self.folder.as_ref().map(|folder| record::module_path(folder, problem.name(), variant))
    }

    /// The kernel of a variant: the user's own in the catalogue, else the module that the run kept, else what is built in.
    pub fn kernel(&self, catalog: &Catalog, problem: &dyn Problem, variant: &str) -> Result<Module, Lost> {
        let id = format!("{}/{variant}", problem.name());
        let recorded = self.run.as_ref().and_then(|run| {
            let family = run.families.iter().find(|family| family.name == problem.name())?;
            family.variants.iter().find(|one| one.name == variant)
        });
        let signature = problem.signature();
        let known = catalog.family(problem.name()).find(|one| one.name == variant);
        let path = self.shader(problem, variant).unwrap_or_default();
        if known.is_none_or(|known| !known.is_own()) {
            match std::fs::read(&path) {
                Ok(bytes) => {
                    let sha256 = hash(&bytes);
                    if recorded.is_some_and(|recorded| recorded.spirv.sha256 != sha256) {
                        return Err(Lost::Changed { path, is: sha256 });
                    }
                    let spirv = match words(&bytes) {
                        Ok(spirv) => spirv,
                        Err(message) => return Err(Lost::NotSpirv { path, message }),
                    };
                    let tables = recorded.map(|recorded| catalog::table_bindings(&recorded.tables));
                    let tables =
                        tables.transpose().map_err(|message| Lost::Table { id: id.clone(), message })?;
                    let kernel = Kernel {
                        id,
                        spirv,
                        inputs: signature.input_columns().len(),
                        outputs: signature.output_columns().len(),
                        tables: tables.unwrap_or_default(),
                        traps: Vec::new(),
                    };
                    return Ok(Module { safe: kernel.clone(), kernel, note: None });
                }
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Lost::Io { path, source: error });
                }
                Err(_) => {}
            }
        }
        let compiled = known.ok_or_else(|| Lost::Absent { id: id.clone() })?.compile(&signature, false)?;
        let changed = recorded.is_some_and(|recorded| recorded.spirv.sha256 != compiled.facts.sha256);
        let note = changed.then(|| format!("{id} compiles to other SPIR-V now than in the run"));
        Ok(Module { kernel: compiled.kernel.clone(), safe: compiled.into_safe(), note })
    }
}

/// A device in words: its name, driver and version.
pub fn device(facts: &crate::device::Facts) -> String {
    let driver = format!("{} {}", facts.driver, facts.driver_info);
    format!("{} ({})", facts.name, driver.trim())
}

/// As [`catalog::Facts::sha256`]: of the words in little-endian order, which is the file's.
fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

fn words(bytes: &[u8]) -> Result<Vec<u32>, &'static str> {
    const MAGIC: u32 = 0x0723_0203;
    if !bytes.len().is_multiple_of(4) {
        return Err("its length is no multiple of 4 bytes");
    }
    let words = bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]));
    let words: Vec<u32> = words.collect();
    if words.first() != Some(&MAGIC) {
        return Err("it does not begin with the magic number 0x07230203");
    }
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::family;
    use crate::record::{Evidence, write_failures};

    #[test]
    fn a_runs_own_shader_comes_before_the_catalogues() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("failures.parquet");
        write_failures(&path, &[] as &[Evidence]).unwrap();
        let origin = Origin::read(&path).unwrap();
        let (catalog, problem) = (Catalog::embedded().unwrap(), family::find("sqrt").unwrap());
        let kernel = |name| origin.kernel(&catalog, problem, name);
        let native = kernel("native").unwrap().kernel;
        let lost = kernel("mine").err().unwrap().to_string();
        assert!(lost.starts_with("sqrt/mine is not built into this rootq"), "{lost}");

        let shaders = folder.path().join("shaders");
        std::fs::create_dir(&shaders).unwrap();
        let own = shaders.join("sqrt.mine.spv");
        let bytes: Vec<u8> = native.spirv.iter().flat_map(|word| word.to_le_bytes()).collect();
        std::fs::write(&own, &bytes).unwrap();
        let mine = kernel("mine").unwrap().kernel;
        assert_eq!((mine.spirv, mine.inputs, mine.outputs), (native.spirv, 1, 1));
        std::fs::write(&own, &bytes[1..]).unwrap();
        assert!(kernel("mine").err().unwrap().to_string().contains("no multiple of 4"));
        std::fs::write(&own, b"text").unwrap();
        assert!(kernel("mine").err().unwrap().to_string().contains("magic number"));
    }
}
