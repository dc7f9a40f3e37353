//! Evaluations of the user's configurations: one row a configuration, `oracle.<column>` and `<variant>.<column>`, as CSV or
//! Parquet, written in batches.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

/// Why a batch could not be written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    Io(#[from] io::Error),
    #[error(transparent)]
    Csv(#[from] csv::Error),
    #[error(transparent)]
    Parquet(#[from] ParquetError),
}

/// A batch of evaluations, by columns.
pub struct Batch<'a> {
    /// The oracle's, each with a value a configuration.
    pub truth: Vec<Vec<f64>>,
    /// All columns of the first variant, then of the next.
    pub outputs: Vec<&'a [f32]>,
}

/// Writes batches.
pub struct Writer(Form);

enum Form {
    Csv(Box<csv::Writer<BufWriter<File>>>),
    Parquet(Box<SerializedFileWriter<File>>),
}

impl Writer {
    /// Begins a table in `file`: Parquet if its place `target` is named `.parquet`, else CSV.
    pub fn new(file: File, target: &Path, variants: &[String], columns: &[String]) -> Result<Writer, Error> {
        let named = |source: &str| -> Vec<String> {
            columns.iter().map(|column| format!("{source}.{column}")).collect()
        };
        let truth = named("oracle");
        let outputs: Vec<String> = variants.iter().flat_map(|variant| named(variant)).collect();
        if !target.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("parquet")) {
            let mut csv = csv::Writer::from_writer(BufWriter::new(file));
            csv.write_record(truth.iter().chain(&outputs))?;
            return Ok(Writer(Form::Csv(Box::new(csv))));
        }
        let typed = truth.iter().map(|name| (name, Physical::DOUBLE));
        let typed = typed.chain(outputs.iter().map(|name| (name, Physical::FLOAT)));
        let fields = typed.map(|(name, physical)| {
            let builder = Type::primitive_type_builder(name, physical);
            Ok(Arc::new(builder.with_repetition(Repetition::REQUIRED).build()?))
        });
        let fields = fields.collect::<Result<_, ParquetError>>()?;
        let schema = Arc::new(Type::group_type_builder("evaluation").with_fields(fields).build()?);
        let properties = Arc::new(WriterProperties::builder().set_compression(Compression::SNAPPY).build());
        Ok(Writer(Form::Parquet(Box::new(SerializedFileWriter::new(file, schema, properties)?))))
    }

    /// Writes a batch: lines, or a row group.
    pub fn write(&mut self, batch: &Batch<'_>) -> Result<(), Error> {
        match &mut self.0 {
            Form::Csv(csv) => lines(csv, batch),
            Form::Parquet(file) => row_group(file, batch).map_err(Error::from),
        }
    }

    /// Writes what is left to write.
    pub fn finish(self) -> Result<(), Error> {
        match self.0 {
            Form::Csv(mut csv) => csv.flush()?,
            Form::Parquet(file) => {
                file.close()?;
            }
        }
        Ok(())
    }
}

/// 17 digits of f64 and 9 of f32 read back to the same bits.
fn lines(csv: &mut csv::Writer<BufWriter<File>>, batch: &Batch<'_>) -> Result<(), Error> {
    for row in 0..batch.truth.first().map_or(0, Vec::len) {
        for column in &batch.truth {
            csv.write_field(format!("{:.16e}", column[row]))?;
        }
        for column in &batch.outputs {
            csv.write_field(format!("{:.8e}", column[row]))?;
        }
        csv.write_record(None::<&[u8]>)?;
    }
    Ok(())
}

fn row_group(file: &mut SerializedFileWriter<File>, batch: &Batch<'_>) -> Result<(), ParquetError> {
    let mut rows = file.next_row_group()?;
    let (mut truth, mut outputs) = (batch.truth.iter(), batch.outputs.iter());
    while let Some(mut column) = rows.next_column()? {
        match column.untyped() {
            ColumnWriter::DoubleColumnWriter(writer) => {
                writer.write_batch(truth.next().map_or(&[], Vec::as_slice), None, None)?;
            }
            ColumnWriter::FloatColumnWriter(writer) => {
                writer.write_batch(outputs.next().copied().unwrap_or_default(), None, None)?;
            }
            _ => return Err(ParquetError::General("column and writer differ in type".to_owned())),
        }
        column.close()?;
    }
    rows.close()?;
    Ok(())
}
