//! Configurations as Parquet: flat columns of float32 or float64, in row groups of any size, page by page.
//!
//! A run's `failures.parquet` is such a table, too: its inputs are called `input.<column>`, or `input.<family>.<column>` where
//! it holds several families, and its other columns are passed over, as are the rows of other families.

use std::fs::File;

use parquet::basic::{Compression, Type as Physical};
use parquet::column::reader::ColumnReader;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::Error;

/// Reads one row group after the other, of each a batch of every column at a time.
pub(super) struct Reader {
    file: SerializedFileReader<File>,
    /// As messages name it.
    name: String,
    /// The input columns as the file names them.
    columns: Vec<String>,
    /// For each input column, its place in the file.
    places: Vec<usize>,
    /// Whether these are a run's failures.
    failures: bool,
    /// The next row group.
    group: usize,
    /// Of the row group that is being read: a reader a column, and rows that they have left.
    readers: Vec<ColumnReader>,
    left: usize,
    /// Rows read so far.
    row: u64,
}

/// The compressions that are compiled in: zstd would add half a minute to every build.
fn is_readable(compression: Compression) -> bool {
    use Compression::{GZIP, LZ4, LZ4_RAW, SNAPPY, UNCOMPRESSED};
    matches!(compression, UNCOMPRESSED | SNAPPY | GZIP(_) | LZ4 | LZ4_RAW)
}

impl Reader {
    /// Reads the file's metadata and matches its columns with the input columns, each of which must be there once, and in a
    /// table that is no run's failures nothing else.
    pub(super) fn new(file: File, name: &str, family: &str, columns: Vec<String>) -> Result<Self, Error> {
        let fail = |message: String| Error::Table { place: name.to_owned(), message };
        let file = SerializedFileReader::new(file)
            .map_err(|error| fail(format!("cannot be read as Parquet: {error}")))?;
        let metadata = file.metadata();
        let schema = metadata.file_metadata().schema_descr();
        let found: Vec<String> = schema.columns().iter().map(|column| column.path().string()).collect();
        let prefix = [format!("input.{family}."), "input.".to_owned()].into_iter().find(|prefix| {
            columns.first().is_some_and(|column| found.contains(&format!("{prefix}{column}")))
        });
        let failures = prefix.is_some();
        let prefix = prefix.unwrap_or_default();
        let columns: Vec<String> = columns.iter().map(|column| format!("{prefix}{column}")).collect();
        let known = || format!("the columns are {}", columns.join(","));
        if let Some(unknown) = found.iter().find(|column| !failures && !columns.contains(column)) {
            return Err(fail(format!("unknown column '{unknown}'; {}", known())));
        }
        let mut places = Vec::new();
        for column in &columns {
            let mut matching = found.iter().enumerate().filter(|(_, name)| *name == column);
            let Some((place, _)) = matching.next() else {
                return Err(fail(format!("column '{column}' is missing; {}", known())));
            };
            if matching.next().is_some() {
                return Err(fail(format!("column '{column}' is there twice")));
            }
            let facts = schema.column(place);
            if !matches!(facts.physical_type(), Physical::FLOAT | Physical::DOUBLE)
                || facts.max_rep_level() > 0
                || facts.path().parts().len() > 1
            {
                return Err(fail(format!(
                    "column '{column}' is {}; inputs are flat columns of float32 or float64",
                    facts.physical_type()
                )));
            }
            for group in metadata.row_groups() {
                let compression = group.column(place).compression();
                if !is_readable(compression) {
                    let codec = compression.to_string();
                    let codec = codec.split('(').next().unwrap_or_default();
                    return Err(fail(format!(
                        "column '{column}' is compressed by {codec}, which is not read here; write it with snappy, gzip, \
                         lz4 or no compression"
                    )));
                }
            }
            places.push(place);
        }
        let name = name.to_owned();
        let (group, readers, left, row) = (0, Vec::new(), 0, 0);
        Ok(Reader { file, name, columns, places, failures, group, readers, left, row })
    }

    /// Up to `rows` configurations, row-major; empty at the end.
    pub(super) fn batch(&mut self, rows: usize) -> Result<Vec<f32>, Error> {
        let width = self.places.len();
        let mut values = Vec::new();
        while values.len() < rows * width && self.open_group()? {
            let count = self.left.min(rows - values.len() / width);
            let mut cells = vec![Cell::Null; count * width];
            for at in 0..width {
                let column = read(&mut self.readers[at], count);
                let column = column.map_err(|error| Error::Table {
                    place: self.name.clone(),
                    message: format!("column '{}' cannot be read: {error}", self.columns[at]),
                })?;
                for (row, cell) in column.into_iter().enumerate() {
                    cells[row * width + at] = cell;
                }
            }
            for row in cells.chunks_exact(width) {
                self.row += 1;
                // Of another family.
                if self.failures && row.iter().all(|cell| matches!(cell, Cell::Null)) {
                    continue;
                }
                for (cell, column) in row.iter().zip(&self.columns) {
                    values.push(self.input(*cell, column)?);
                }
            }
            self.left -= count;
        }
        Ok(values)
    }

    /// Opens the next row group with rows, if the one before is done; false at the end.
    fn open_group(&mut self) -> Result<bool, Error> {
        while self.left == 0 {
            if self.group == self.file.num_row_groups() {
                return Ok(false);
            }
            let broken = |error: ParquetError| Error::Table {
                place: self.name.clone(),
                message: format!("row group {} cannot be read: {error}", self.group),
            };
            let group = self.file.get_row_group(self.group).map_err(broken)?;
            let readers = self.places.iter().map(|place| group.get_column_reader(*place));
            self.readers = readers.collect::<Result<_, _>>().map_err(broken)?;
            self.left = group.metadata().num_rows() as usize;
            self.group += 1;
        }
        Ok(true)
    }

    /// The cell of the row that was counted last, as f32.
    fn input(&self, cell: Cell, column: &str) -> Result<f32, Error> {
        let (value, text) = match cell {
            Cell::Single(value) => (value, value.to_string()),
            // The one rounding, to nearest.
            Cell::Double(value) => (value as f32, format!("{value:e}")),
            Cell::Null => (f32::NAN, "null".to_owned()),
        };
        if value.is_finite() {
            return Ok(value);
        }
        let what = match cell {
            Cell::Null => "; inputs must be numbers",
            _ if value.is_nan() => " is not a number; inputs must be finite",
            _ => " is infinite as f32; inputs must be finite",
        };
        let place = format!("{}, row {}", self.name, self.row);
        Err(Error::Table { place, message: format!("{column} = {text}{what}") })
    }
}

#[derive(Clone, Copy)]
enum Cell {
    Null,
    Single(f32),
    Double(f64),
}

/// The next `count` cells of a column.
fn read(reader: &mut ColumnReader, count: usize) -> Result<Vec<Cell>, ParquetError> {
    fn cells<T: Copy>(
        (read, _, _): (usize, usize, usize),
        count: usize,
        (levels, values): (&[i16], &[T]),
        cell: fn(T) -> Cell,
    ) -> Result<Vec<Cell>, ParquetError> {
        if read != count {
            return Err(ParquetError::General("it ends before its row group does".to_owned()));
        }
        let mut values = values.iter().map(|value| cell(*value));
        // A required column has no levels.
        if levels.is_empty() {
            return Ok(values.collect());
        }
        let cell = |level: &i16| if *level == 0 { Some(Cell::Null) } else { values.next() };
        Ok(levels.iter().filter_map(cell).collect())
    }
    let mut levels = Vec::new();
    match reader {
        ColumnReader::FloatColumnReader(reader) => {
            let mut values = Vec::new();
            let read = reader.read_records(count, Some(&mut levels), None, &mut values)?;
            cells(read, count, (&levels, &values), Cell::Single)
        }
        ColumnReader::DoubleColumnReader(reader) => {
            let mut values = Vec::new();
            let read = reader.read_records(count, Some(&mut levels), None, &mut values)?;
            cells(read, count, (&levels, &values), Cell::Double)
        }
        _ => Err(ParquetError::General("it is not of float32 or float64".to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Seek, Write};
    use std::sync::Arc;

    use parquet::basic::Repetition;
    use parquet::column::writer::ColumnWriter;
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;

    use super::*;

    /// A column of a file to be written: its name and type, and its values in each row group, `None` for null.
    struct Column(&'static str, Physical, Vec<Vec<Option<f64>>>);

    fn file(compression: Compression, columns: &[Column]) -> File {
        let field = |Column(name, physical, _): &Column| {
            let builder = Type::primitive_type_builder(name, *physical);
            Arc::new(builder.with_repetition(Repetition::OPTIONAL).build().unwrap())
        };
        let fields = columns.iter().map(field).collect();
        let schema = Type::group_type_builder("table").with_fields(fields).build().unwrap();
        let properties = WriterProperties::builder().set_compression(compression).build();
        let mut file = tempfile::tempfile().unwrap();
        let mut writer =
            SerializedFileWriter::new(file.try_clone().unwrap(), Arc::new(schema), Arc::new(properties))
                .unwrap();
        for group in 0..columns[0].2.len() {
            let mut rows = writer.next_row_group().unwrap();
            for Column(_, _, groups) in columns {
                let levels: Vec<i16> = groups[group].iter().map(|value| i16::from(value.is_some())).collect();
                let values = groups[group].iter().flatten();
                let mut column = rows.next_column().unwrap().unwrap();
                match column.untyped() {
                    ColumnWriter::FloatColumnWriter(writer) => {
                        let values: Vec<f32> = values.map(|value| *value as f32).collect();
                        writer.write_batch(&values, Some(&levels), None).unwrap();
                    }
                    ColumnWriter::DoubleColumnWriter(writer) => {
                        let values: Vec<f64> = values.copied().collect();
                        writer.write_batch(&values, Some(&levels), None).unwrap();
                    }
                    ColumnWriter::Int64ColumnWriter(writer) => {
                        let values: Vec<i64> = values.map(|value| *value as i64).collect();
                        writer.write_batch(&values, Some(&levels), None).unwrap();
                    }
                    _ => panic!("no such column here"),
                }
                column.close().unwrap();
            }
            rows.close().unwrap();
        }
        writer.close().unwrap();
        file.rewind().unwrap();
        file
    }

    fn some(values: &[f64]) -> Vec<Option<f64>> {
        values.iter().copied().map(Some).collect()
    }

    fn reader(file: File) -> Result<Reader, String> {
        let columns = vec!["a".to_owned(), "b".to_owned()];
        Reader::new(file, "in.parquet", "f", columns).map_err(|error| error.to_string())
    }

    fn read_all(file: File) -> Result<Vec<f32>, String> {
        reader(file)?.batch(100).map_err(|error| error.to_string())
    }

    #[test]
    fn row_groups_and_types_in_any_order() {
        // Half-way between two f32 but for the last bit.
        let above = 1.0 + f64::from(f32::EPSILON) / 2.0 + f64::EPSILON;
        for compression in [
            Compression::UNCOMPRESSED,
            Compression::SNAPPY,
            Compression::GZIP(Default::default()),
            Compression::LZ4_RAW,
        ] {
            let columns = || {
                let doubles = vec![some(&[1.0, above]), some(&[]), some(&[0.1, 4.0, 5.0])];
                let singles = vec![some(&[-1.0, 2.0]), some(&[]), some(&[3.0, 4.0, 0.1])];
                [Column("b", Physical::DOUBLE, doubles), Column("a", Physical::FLOAT, singles)]
            };
            let whole = [-1.0, 1.0, 2.0, 1.0 + f32::EPSILON, 3.0, 0.1, 4.0, 4.0, 0.1, 5.0];
            assert_eq!(read_all(file(compression, &columns())), Ok(whole.to_vec()));
            // Batches end within and at the ends of row groups.
            let mut parts = reader(file(compression, &columns())).unwrap();
            let mut batch = || parts.batch(3).unwrap();
            assert_eq!((batch(), batch(), batch()), (whole[..6].to_vec(), whole[6..].to_vec(), vec![]));
        }
    }

    #[test]
    fn a_runs_failures_are_configurations() {
        let columns = |names: [&'static str; 3]| {
            let [text, a, b] = names;
            [
                Column(text, Physical::INT64, vec![some(&[1.0, 2.0])]),
                Column(a, Physical::FLOAT, vec![vec![Some(1.0), None]]),
                Column(b, Physical::FLOAT, vec![vec![Some(2.0), None]]),
            ]
        };
        for names in [["index", "input.a", "input.b"], ["index", "input.f.a", "input.f.b"]] {
            assert_eq!(read_all(file(Compression::SNAPPY, &columns(names))), Ok(vec![1.0, 2.0]));
        }
        let error = read_all(file(Compression::SNAPPY, &columns(["index", "input.a", "input.c"])));
        assert!(error.unwrap_err().contains("column 'input.b' is missing"));
    }

    #[test]
    fn every_mistake_is_one_line_with_its_place() {
        let one = |value| vec![vec![Some(1.0)], vec![Some(1.0), value]];
        let good = || Column("a", Physical::FLOAT, one(Some(1.0)));
        let b = |physical, value| Column("b", physical, one(value));
        for (columns, expected) in [
            (vec![good()], "in.parquet: column 'b' is missing; the columns are a,b"),
            (
                vec![good(), b(Physical::FLOAT, Some(1.0)), Column("c", Physical::INT64, one(None))],
                "in.parquet: unknown column 'c'; the columns are a,b",
            ),
            (vec![good(), b(Physical::FLOAT, None), good()], "in.parquet: column 'a' is there twice"),
            (
                vec![good(), b(Physical::INT64, Some(1.0))],
                "in.parquet: column 'b' is INT64; inputs are flat columns of float32 or float64",
            ),
            (vec![good(), b(Physical::FLOAT, None)], "in.parquet, row 3: b = null; inputs must be numbers"),
            (
                vec![good(), b(Physical::DOUBLE, Some(f64::NAN))],
                "in.parquet, row 3: b = NaN is not a number; inputs must be finite",
            ),
            (
                vec![good(), b(Physical::DOUBLE, Some(1e39))],
                "in.parquet, row 3: b = 1e39 is infinite as f32; inputs must be finite",
            ),
        ] {
            let error = read_all(file(Compression::SNAPPY, &columns)).unwrap_err();
            assert_eq!(error, expected);
        }
        let mut text = tempfile::tempfile().unwrap();
        text.write_all(b"a,b\n1,2\n").unwrap();
        let error = read_all(text).unwrap_err();
        assert!(
            error.starts_with("in.parquet: cannot be read as Parquet: ") && !error.contains('\n'),
            "{error}"
        );
    }

    #[test]
    fn compressions_that_are_not_compiled_in_are_named() {
        assert!(!is_readable(Compression::ZSTD(Default::default())));
        assert!(!is_readable(Compression::BROTLI(Default::default())));
    }
}
