//! The user's configurations: a table with the family's input columns in any order, as CSV or Parquet, read in batches, so
//! that one of any length needs little memory.

mod csv;
mod parquet;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::Error;

/// The bytes with which a Parquet file begins.
const MAGIC: [u8; 4] = *b"PAR1";

/// Reads configurations, whatever they are written as.
pub struct Reader(Form);

enum Form {
    Csv(Box<csv::Reader<Box<dyn Read>>>),
    Parquet(Box<parquet::Reader>),
}

impl Reader {
    /// Opens the table at `path` of `family`'s input columns: Parquet if it is named `.parquet` or begins like one, else CSV.
    pub fn open(path: &Path, family: &str, columns: Vec<String>) -> Result<Self, Error> {
        let name = path.display().to_string();
        let io = |source| Error::Io { action: "read", path: path.to_owned(), source };
        let mut file = File::open(path).map_err(io)?;
        let (head, is_parquet) = head(&mut file).map_err(io)?;
        if is_parquet || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet")) {
            let file = File::open(path).map_err(io)?;
            return Ok(Reader(Form::Parquet(Box::new(parquet::Reader::new(file, &name, family, columns)?))));
        }
        // The file may be a pipe, which cannot go back to its beginning.
        Reader::csv(Box::new(io::Cursor::new(head).chain(file)), &name, columns)
    }

    /// The table that comes on standard input, as CSV: of Parquet the end is read first.
    pub fn standard_input(columns: Vec<String>) -> Result<Self, Error> {
        let name = "standard input";
        let fail = |message: String| Error::Table { place: name.to_owned(), message };
        let mut input = io::stdin();
        let (head, is_parquet) =
            head(&mut input).map_err(|error| fail(format!("cannot be read: {error}")))?;
        if is_parquet {
            return Err(fail("Parquet is read from its end, so give it as a file".to_owned()));
        }
        Reader::csv(Box::new(io::Cursor::new(head).chain(input)), name, columns)
    }

    fn csv(source: Box<dyn Read>, name: &str, columns: Vec<String>) -> Result<Self, Error> {
        Ok(Reader(Form::Csv(Box::new(csv::Reader::new(source, name, columns)?))))
    }

    /// Up to `rows` configurations, row-major; empty at the end.
    pub fn batch(&mut self, rows: usize) -> Result<Vec<f32>, Error> {
        match &mut self.0 {
            Form::Csv(reader) => reader.batch(rows),
            Form::Parquet(reader) => reader.batch(rows),
        }
    }
}

/// The first bytes, and whether they are those of a Parquet file.
fn head(source: &mut dyn Read) -> io::Result<(Vec<u8>, bool)> {
    let mut head = Vec::new();
    source.take(MAGIC.len() as u64).read_to_end(&mut head)?;
    let is_parquet = head == MAGIC;
    Ok((head, is_parquet))
}
