//! Reading `failures.parquet` back: recorded failures with their exact bits.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use parquet::column::reader::get_typed_column_reader;
use parquet::data_type::{ByteArrayType, DataType, DoubleType, FloatType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use super::Error;
use super::folder::FAILURES;
use crate::audit::{Failure, Verdict};
use crate::family::{self, Problem};

/// One failure as a run, a hunt or a minimization left it.
#[derive(Clone)]
pub struct RecordedFailure {
    pub problem: &'static dyn Problem,
    pub variant: String,
    pub scenario: String,
    pub failure: Failure,
}

impl RecordedFailure {
    /// `family/variant`.
    pub fn id(&self) -> String {
        format!("{}/{}", self.problem.name(), self.variant)
    }
}

/// The failures in `path`, a file or the folder that holds one, in the order in which they were written.
pub fn failures(path: &Path) -> Result<Vec<RecordedFailure>, Error> {
    let file = if path.is_dir() { path.join(FAILURES) } else { path.to_owned() };
    let fail = |message: String| Error::Table { place: file.display().to_string(), message };
    let source = match File::open(&file) {
        Ok(source) => source,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(Error::NoFailures { path: path.to_owned() });
        }
        Err(source) => return Err(Error::Io { action: "read", path: file, source }),
    };
    let reader = SerializedFileReader::new(source).map_err(|error| {
        fail(format!("not the Parquet file of failures that run, audit, hunt and minimize write: {error}"))
    })?;
    Table::new(&reader).rows().map_err(fail)
}

/// A Parquet file's columns by name.
struct Table<'a> {
    reader: &'a SerializedFileReader<File>,
    places: BTreeMap<String, usize>,
}

/// The columns of one family, each one value a row of the file, null in other families' rows.
struct Columns {
    inputs: Vec<Vec<Option<f32>>>,
    outputs: Vec<Vec<Option<f32>>>,
    truth: Vec<Vec<Option<f64>>>,
    errors: Vec<Vec<Option<f64>>>,
    ulps: Vec<Vec<Option<f64>>>,
}

impl<'a> Table<'a> {
    fn new(reader: &'a SerializedFileReader<File>) -> Self {
        let schema = reader.metadata().file_metadata().schema_descr();
        let names = schema.columns().iter().map(|column| column.path().string());
        Table { reader, places: names.enumerate().map(|(place, name)| (name, place)).collect() }
    }

    fn rows(&self) -> Result<Vec<RecordedFailure>, String> {
        let (families, variants, scenarios) =
            (self.text("family")?, self.text("variant")?, self.text("scenario")?);
        let (indices, verdicts) = (self.required::<Int64Type>("index")?, self.text("verdict")?);
        let mut rows = Vec::with_capacity(families.len());
        let mut known: BTreeMap<&str, (&'static dyn Problem, Columns)> = BTreeMap::new();
        for row in 0..families.len() {
            let place = |message: String| format!("row {}: {message}", row + 1);
            let family = families[row].as_str();
            if !known.contains_key(family) {
                let problem = family::find(family).ok_or_else(|| {
                    place(format!("this rootq has no family '{family}'; 'rootq list' shows what it has"))
                })?;
                known.insert(family, (problem, self.columns(problem)?));
            }
            let (problem, columns) = &known[family];
            let verdict = Verdict::ALL.into_iter().find(|verdict| verdict.name() == verdicts[row]);
            let missing = || place(format!("a column of {family} is empty"));
            let failure = Failure {
                index: indices[row] as u64,
                verdict: verdict.ok_or_else(|| place(format!("unknown verdict '{}'", verdicts[row])))?,
                inputs: across(&columns.inputs, row).ok_or_else(missing)?,
                outputs: across(&columns.outputs, row).ok_or_else(missing)?,
                truth: across(&columns.truth, row).ok_or_else(missing)?,
                errors: across(&columns.errors, row).ok_or_else(missing)?,
                ulps: across(&columns.ulps, row).ok_or_else(missing)?,
            };
            if !problem.takes_all_bits() && failure.inputs.iter().any(|value| !value.is_finite()) {
                return Err(place(format!("inputs of {family} must be finite")));
            }
            let (variant, scenario) = (variants[row].clone(), scenarios[row].clone());
            rows.push(RecordedFailure { problem: *problem, variant, scenario, failure });
        }
        Ok(rows)
    }

    /// All columns of one family, whether or not the family's name is part of theirs.
    fn columns(&self, problem: &dyn Problem) -> Result<Columns, String> {
        let family = problem.name();
        let prefixed = |kind: &str, name: &str| format!("{kind}.{family}.{name}");
        let signature = problem.signature();
        let (inputs, outputs) = (signature.input_columns(), signature.output_columns());
        let results: Vec<String> = signature.results.iter().map(|field| field.name.to_owned()).collect();
        let several = inputs.iter().any(|name| self.places.contains_key(&prefixed("input", name)));
        let named = |kind: &str, name: &String| {
            if several { prefixed(kind, name) } else { format!("{kind}.{name}") }
        };
        let single = |kind, names: &[String]| -> Result<Vec<_>, String> {
            names.iter().map(|name| self.cells::<FloatType>(&named(kind, name))).collect()
        };
        let double = |kind, names: &[String]| -> Result<Vec<_>, String> {
            names.iter().map(|name| self.cells::<DoubleType>(&named(kind, name))).collect()
        };
        Ok(Columns {
            inputs: single("input", &inputs)?,
            outputs: single("output", &outputs)?,
            truth: double("truth", &outputs)?,
            errors: double("error", &results)?,
            ulps: double("ulp", &results)?,
        })
    }

    fn text(&self, name: &str) -> Result<Vec<String>, String> {
        let cells = self.required::<ByteArrayType>(name)?;
        let text = cells.iter().map(|cell| cell.as_utf8().map(str::to_owned));
        text.collect::<Result<_, _>>().map_err(|_| format!("column '{name}' is not UTF-8 text"))
    }

    fn required<T: DataType>(&self, name: &str) -> Result<Vec<T::T>, String> {
        let cells: Option<Vec<T::T>> = self.cells::<T>(name)?.into_iter().collect();
        cells.ok_or_else(|| format!("column '{name}' has empty cells"))
    }

    fn cells<T: DataType>(&self, name: &str) -> Result<Vec<Option<T::T>>, String> {
        let place = *self.places.get(name).ok_or_else(|| {
            format!("column '{name}' is missing; replay reads what run, audit, hunt and minimize write")
        })?;
        let column = self.reader.metadata().file_metadata().schema_descr().column(place);
        let (is, wanted) = (column.physical_type(), T::get_physical_type());
        if is != wanted || column.max_rep_level() > 0 {
            return Err(format!("column '{name}' is {is}, not {wanted} with one value a row"));
        }
        let broken = |error: ParquetError| format!("column '{name}' cannot be read: {error}");
        let present = column.max_def_level();
        let mut cells = Vec::new();
        for group in 0..self.reader.num_row_groups() {
            let group = self.reader.get_row_group(group).map_err(broken)?;
            let rows = group.metadata().num_rows() as usize;
            let mut reader = get_typed_column_reader::<T>(group.get_column_reader(place).map_err(broken)?);
            let (mut values, mut levels) = (Vec::new(), Vec::new());
            let mut read = 0;
            while read < rows {
                let kept = (present > 0).then_some(&mut levels);
                let (records, ..) =
                    reader.read_records(rows - read, kept, None, &mut values).map_err(broken)?;
                if records == 0 {
                    return Err(format!("column '{name}' ends after {read} of {rows} rows"));
                }
                read += records;
            }
            let mut values = values.into_iter();
            if present == 0 {
                cells.extend(values.map(Some));
            } else {
                cells.extend(levels.iter().map(|level| if *level == present { values.next() } else { None }));
            }
        }
        Ok(cells)
    }
}

/// One row of several columns; `None` if any of them is empty there.
fn across<T: Copy>(columns: &[Vec<Option<T>>], row: usize) -> Option<Vec<T>> {
    columns.iter().map(|column| column.get(row).copied().flatten()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::Fingerprint;
    use crate::record::{Evidence, write_failures};

    /// A failure of that family, every value of which is another one, NaN with a payload among them.
    fn failure(problem: &dyn Problem, index: u64) -> Failure {
        let signature = problem.signature();
        let seed = index as f64;
        let double = |count: usize| (0..count).map(|at| seed + at as f64 / 3.0).collect::<Vec<f64>>();
        let (inputs, outputs) = (signature.input_columns().len(), signature.output_columns().len());
        let mut wrong: Vec<f32> = double(outputs).iter().map(|value| -*value as f32).collect();
        wrong[0] = f32::from_bits(0x7fc1_2345);
        if let Some(last) = wrong.get_mut(1) {
            *last = f32::from_bits(0xff80_0001);
        }
        Failure {
            index,
            verdict: Verdict::NonFinite,
            inputs: double(inputs).iter().map(|value| *value as f32).collect(),
            outputs: wrong,
            truth: double(outputs),
            errors: vec![f64::INFINITY; signature.results.len()],
            ulps: double(signature.results.len()),
        }
    }

    fn evidence(problem: &dyn Problem, scenario: &'static str, failures: Vec<Failure>) -> Evidence {
        let (family, variant) = (problem.name(), "v".to_owned());
        Evidence {
            family: family::find(family).unwrap().name(),
            variant,
            scenario,
            failures,
            bits: Fingerprint::default(),
        }
    }

    fn bits(failure: &Failure) -> (Vec<u32>, Vec<u32>, Vec<u64>) {
        let single = |values: &[f32]| values.iter().map(|value| value.to_bits()).collect();
        let doubles = [&failure.truth, &failure.errors, &failure.ulps];
        let double = doubles.into_iter().flatten().map(|value| value.to_bits()).collect();
        (single(&failure.inputs), single(&failure.outputs), double)
    }

    fn round_trip(evidence: &[Evidence]) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FAILURES);
        write_failures(&path, evidence).unwrap();
        let written: Vec<(&Evidence, &Failure)> =
            evidence.iter().flat_map(|one| one.failures.iter().map(move |failure| (one, failure))).collect();
        for path in [path.as_path(), folder.path()] {
            let read = failures(path).unwrap();
            assert_eq!(read.len(), written.len());
            for (read, (one, failure)) in read.iter().zip(&written) {
                assert_eq!((read.problem.name(), read.variant.as_str()), (one.family, one.variant.as_str()));
                assert_eq!((read.scenario.as_str(), read.failure.index), (one.scenario, failure.index));
                assert_eq!(read.failure.verdict, failure.verdict);
                assert_eq!(bits(&read.failure), bits(failure));
            }
        }
    }

    #[test]
    fn what_was_written_is_read_back_bit_for_bit() {
        let [one, other] = ["ellipse_axes", "sym3_eigen"].map(|name| family::find(name).unwrap());
        let scenario = |problem: &dyn Problem, at: usize| problem.scenarios()[at].name;
        round_trip(&[evidence(one, scenario(one, 0), vec![failure(one, 3), failure(one, 7)])]);
        round_trip(&[
            evidence(one, scenario(one, 0), vec![failure(one, 3)]),
            evidence(other, scenario(other, 1), vec![failure(other, 1 << 40), failure(other, 9)]),
            evidence(other, scenario(other, 0), vec![]),
            evidence(one, scenario(one, 1), vec![failure(one, 0)]),
        ]);
        round_trip(&[evidence(one, scenario(one, 0), vec![])]);
        round_trip(&[]);
    }

    #[test]
    fn what_is_from_elsewhere_is_told_in_one_line() {
        use parquet::file::properties::WriterProperties;
        use parquet::file::writer::SerializedFileWriter;
        use parquet::schema::parser::parse_message_type;
        use std::sync::Arc;

        let folder = tempfile::tempdir().unwrap();
        let told = |path: &Path| failures(path).err().unwrap().to_string();
        assert!(told(&folder.path().join("absent")).contains("holds no failures"));
        assert!(told(folder.path()).contains("holds no failures"));
        let path = folder.path().join("text.parquet");
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(told(&path).contains("not the Parquet file of failures"), "{}", told(&path));
        let family = "REQUIRED BYTE_ARRAY family (UTF8);";
        for (columns, expected) in [
            ("REQUIRED FLOAT x;", "column 'family' is missing; replay reads"),
            ("REQUIRED INT64 family;", "column 'family' is INT64, not BYTE_ARRAY"),
            ("REPEATED BYTE_ARRAY family;", "with one value a row"),
            (family, "column 'variant' is missing"),
        ] {
            let path = folder.path().join("other.parquet");
            let schema = Arc::new(parse_message_type(&format!("message m {{ {columns} }}")).unwrap());
            let file = File::create(&path).unwrap();
            let writer =
                SerializedFileWriter::new(file, schema, Arc::new(WriterProperties::builder().build()));
            writer.unwrap().close().unwrap();
            let told = told(&path);
            assert!(told.contains(expected) && !told.contains('\n'), "{told}");
        }
        // A family of another version, and a verdict.
        let problem = family::find("ellipse_axes").unwrap();
        let mut other = evidence(problem, "scene", vec![failure(problem, 1)]);
        other.failures[0].inputs[2] = f32::INFINITY;
        let path = folder.path().join(FAILURES);
        write_failures(&path, &[other.clone()]).unwrap();
        assert!(told(&path).ends_with("row 1: inputs of ellipse_axes must be finite"), "{}", told(&path));
        other.family = "teapots";
        write_failures(&path, &[other]).unwrap();
        assert!(told(&path).contains("row 1: this rootq has no family 'teapots'"), "{}", told(&path));
    }
}
