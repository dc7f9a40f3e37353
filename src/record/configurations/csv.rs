//! Configurations as CSV: a header of column names in any order.

use std::io::Read;

use super::Error;
use crate::record::parse_f32;

/// Reads line by line.
pub(super) struct Reader<R> {
    csv: csv::Reader<R>,
    /// As messages name it.
    name: String,
    columns: Vec<String>,
    /// For each input column, its place in the file.
    places: Vec<usize>,
    record: csv::StringRecord,
}

impl<R: Read> Reader<R> {
    /// Reads the header and matches it with the input columns, each of which must be there once and nothing else.
    pub(super) fn new(source: R, name: &str, columns: Vec<String>) -> Result<Self, Error> {
        let fail = |message: String| Error::Table { place: name.to_owned(), message };
        let mut csv = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(source);
        let header = csv.headers().map_err(|error| broken(name, &error))?.clone();
        if header.is_empty() {
            return Err(fail(format!(
                "the table is empty; its first line must name the columns: {}",
                columns.join(",")
            )));
        }
        if let Some(unknown) = header.iter().find(|column| !columns.iter().any(|known| known == column)) {
            return Err(fail(format!("unknown column '{unknown}'; the columns are {}", columns.join(","))));
        }
        let mut places = Vec::new();
        for column in &columns {
            let mut found =
                header.iter().enumerate().filter(|(_, name)| name == column).map(|(place, _)| place);
            let place = found.next().ok_or_else(|| {
                fail(format!("column '{column}' is missing; the columns are {}", columns.join(",")))
            })?;
            if found.next().is_some() {
                return Err(fail(format!("column '{column}' is there twice")));
            }
            places.push(place);
        }
        Ok(Reader { csv, name: name.to_owned(), columns, places, record: csv::StringRecord::new() })
    }

    /// Up to `rows` configurations, row-major; empty at the end.
    pub(super) fn batch(&mut self, rows: usize) -> Result<Vec<f32>, Error> {
        let mut values = Vec::with_capacity(rows.min(1 << 16) * self.places.len());
        for _ in 0..rows {
            if !self.csv.read_record(&mut self.record).map_err(|error| broken(&self.name, &error))? {
                break;
            }
            for (column, place) in self.columns.iter().zip(&self.places) {
                let text = self.record.get(*place).unwrap_or_default();
                let problem = match parse_f32(text) {
                    Some(value) if value.is_finite() => {
                        values.push(value);
                        continue;
                    }
                    Some(value) if value.is_nan() => "is not a number; inputs must be finite",
                    Some(_) => "is infinite as f32; inputs must be finite",
                    None => "is not a decimal or hexadecimal float",
                };
                let line = self.record.position().map_or(0, csv::Position::line);
                return Err(Error::Table {
                    place: format!("{}:{line}", self.name),
                    message: format!("{column} = '{text}' {problem}"),
                });
            }
        }
        Ok(values)
    }
}

fn broken(name: &str, error: &csv::Error) -> Error {
    let (line, message) = match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => (
            pos.as_ref().map(csv::Position::line),
            format!("{len} fields where the header has {expected_len}"),
        ),
        csv::ErrorKind::Utf8 { pos, .. } => {
            (pos.as_ref().map(csv::Position::line), "not UTF-8 text".to_owned())
        }
        csv::ErrorKind::Io(error) => (None, format!("cannot be read: {error}")),
        _ => (None, error.to_string()),
    };
    let place = line.map_or_else(|| name.to_owned(), |line| format!("{name}:{line}"));
    Error::Table { place, message }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<f32>, String> {
        let columns = vec!["a".to_owned(), "b".to_owned()];
        let all = Reader::new(text.as_bytes(), "in.csv", columns).and_then(|mut reader| reader.batch(100));
        all.map_err(|error| error.to_string())
    }

    #[test]
    fn columns_in_any_order() {
        assert_eq!(read("b, a\n1,0x1p-1\n# words\n3,4e0\n"), Ok(vec![0.5, 1.0, 4.0, 3.0]));
        assert_eq!(read("a,b\n"), Ok(vec![]));
    }

    #[test]
    fn every_mistake_is_one_line_with_its_place() {
        for (text, expected) in [
            ("", "in.csv: the table is empty"),
            ("a\n1\n", "in.csv: column 'b' is missing"),
            ("a,b,c\n1,2,3\n", "in.csv: unknown column 'c'"),
            ("a,b,a\n1,2,3\n", "in.csv: column 'a' is there twice"),
            ("a,b\n1,2\n3,x\n", "in.csv:3: b = 'x' is not a decimal"),
            ("a,b\nNaN,2\n", "in.csv:2: a = 'NaN' is not a number"),
            ("a,b\n1e39,2\n", "in.csv:2: a = '1e39' is infinite"),
            ("a,b\n1\n", "in.csv:2: 1 fields where the header has 2"),
            ("a,b\n1,\n", "in.csv:2: b = '' is not a decimal"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.starts_with(expected) && !error.contains('\n'), "{error}");
        }
    }
}
