//! `failures.parquet`: one row a kept failure, flat columns that any reader opens.
//!
//! `family`, `variant`, `scenario`, `index`, `verdict`; then, for every column of every family in the file,
//! `input.<column>` and `output.<column>` (f32, exact bits), `truth.<column>`, `error.<output>` in the output's own
//! measure and `ulp.<output>` (f64). Columns of other families than the row's are null. The index is the configuration's in
//! its scenario's stream, but 0 for what a hunt's search found, which is in no stream.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use super::{Error, Evidence};
use crate::audit::Failure;
use crate::family;

/// A column's name and its value in a row, if the row has one.
enum Column {
    Text(&'static str, fn(&Evidence, &Failure) -> String),
    Index,
    Single(String, &'static str, fn(&Failure) -> &[f32], usize),
    Double(String, &'static str, fn(&Failure) -> &[f64], usize),
}

impl Column {
    fn schema(&self) -> Result<Type, ParquetError> {
        let (name, physical) = match self {
            Column::Text(name, _) => (*name, Physical::BYTE_ARRAY),
            Column::Index => ("index", Physical::INT64),
            Column::Single(name, ..) => (name.as_str(), Physical::FLOAT),
            Column::Double(name, ..) => (name.as_str(), Physical::DOUBLE),
        };
        let builder = Type::primitive_type_builder(name, physical);
        match self {
            Column::Text(..) => {
                builder.with_logical_type(Some(LogicalType::String)).with_repetition(Repetition::REQUIRED)
            }
            Column::Index => builder.with_repetition(Repetition::REQUIRED),
            Column::Single(..) | Column::Double(..) => builder.with_repetition(Repetition::OPTIONAL),
        }
        .build()
    }

    fn write(&self, writer: &mut ColumnWriter<'_>, evidence: &[Evidence]) -> Result<(), ParquetError> {
        let rows = || evidence.iter().flat_map(|one| one.failures.iter().map(move |failure| (one, failure)));
        match (self, writer) {
            (Column::Text(_, text), ColumnWriter::ByteArrayColumnWriter(writer)) => {
                let values: Vec<ByteArray> =
                    rows().map(|(one, failure)| text(one, failure).into_bytes().into()).collect();
                writer.write_batch(&values, None, None)?;
            }
            (Column::Index, ColumnWriter::Int64ColumnWriter(writer)) => {
                let values: Vec<i64> = rows().map(|(_, failure)| failure.index as i64).collect();
                writer.write_batch(&values, None, None)?;
            }
            (Column::Single(_, family, of, at), ColumnWriter::FloatColumnWriter(writer)) => {
                let (values, levels) =
                    optional(rows().map(|(one, f)| (one.family == *family).then(|| of(f)[*at])));
                writer.write_batch(&values, Some(&levels), None)?;
            }
            (Column::Double(_, family, of, at), ColumnWriter::DoubleColumnWriter(writer)) => {
                let (values, levels) =
                    optional(rows().map(|(one, f)| (one.family == *family).then(|| of(f)[*at])));
                writer.write_batch(&values, Some(&levels), None)?;
            }
            _ => {
                return Err(ParquetError::General("column and writer differ in type".to_owned()));
            }
        }
        Ok(())
    }
}

/// Values that are there, and a definition level for each row.
fn optional<T>(cells: impl Iterator<Item = Option<T>>) -> (Vec<T>, Vec<i16>) {
    let mut values = Vec::new();
    let levels = cells
        .map(|cell| {
            cell.map_or(0, |value| {
                values.push(value);
                1
            })
        })
        .collect();
    (values, levels)
}

/// Writes all evidence to a new file at `path`.
pub fn write(path: &Path, evidence: &[Evidence]) -> Result<(), Error> {
    let file =
        File::create(path).map_err(|source| Error::Io { action: "write", path: path.to_owned(), source })?;
    write_to(file, evidence).map_err(|source| Error::Parquet { path: path.to_owned(), source })
}

fn write_to(file: File, evidence: &[Evidence]) -> Result<(), ParquetError> {
    let columns = columns(evidence);
    let fields = columns.iter().map(|column| column.schema().map(Arc::new)).collect::<Result<_, _>>()?;
    let schema = Arc::new(Type::group_type_builder("failure").with_fields(fields).build()?);
    let properties = Arc::new(WriterProperties::builder().set_compression(Compression::SNAPPY).build());
    let mut file = SerializedFileWriter::new(file, schema, properties)?;
    let mut rows = file.next_row_group()?;
    for column in &columns {
        let Some(mut writer) = rows.next_column()? else {
            return Err(ParquetError::General("fewer columns than declared".to_owned()));
        };
        column.write(writer.untyped(), evidence)?;
        writer.close()?;
    }
    rows.close()?;
    file.close()?;
    Ok(())
}

fn columns(evidence: &[Evidence]) -> Vec<Column> {
    let mut columns = vec![
        Column::Text("family", |one, _| one.family.to_owned()),
        Column::Text("variant", |one, _| one.variant.clone()),
        Column::Text("scenario", |one, _| one.scenario.to_owned()),
        Column::Index,
        Column::Text("verdict", |_, failure| failure.verdict.name().to_owned()),
    ];
    let mut families: Vec<&'static str> = evidence.iter().map(|one| one.family).collect();
    families.sort_unstable();
    families.dedup();
    // Several families may share a column's name; with more than one in the file the family's name goes before it.
    let several = families.len() > 1;
    for problem in families.iter().filter_map(|name| family::find(name)) {
        let family = problem.name();
        let named = |kind: &str, column: &str| {
            if several { format!("{kind}.{family}.{column}") } else { format!("{kind}.{column}") }
        };
        let signature = problem.signature();
        for (at, column) in signature.input_columns().iter().enumerate() {
            columns.push(Column::Single(named("input", column), family, |f| &f.inputs, at));
        }
        for (at, column) in signature.output_columns().iter().enumerate() {
            columns.push(Column::Single(named("output", column), family, |f| &f.outputs, at));
            columns.push(Column::Double(named("truth", column), family, |f| &f.truth, at));
        }
        for (at, field) in signature.results.iter().enumerate() {
            columns.push(Column::Double(named("error", field.name), family, |f| &f.errors, at));
            columns.push(Column::Double(named("ulp", field.name), family, |f| &f.ulps, at));
        }
    }
    columns
}
