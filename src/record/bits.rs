//! `bits.parquet`: one row a variant and scenario, with the fingerprint of all its outputs' bits, so that two runs can
//! be compared to the last bit without either device.
//!
//! Columns: `family`, `variant`, `scenario`, and `fingerprint` (bytes of [`Fingerprint`]).

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::record::RowAccessor;
use parquet::schema::types::Type;

use super::{Error, Evidence};
use crate::audit::Fingerprint;

/// Fingerprints by family, variant and scenario.
pub type Bits = BTreeMap<(String, String, String), Fingerprint>;

const TEXT: [&str; 3] = ["family", "variant", "scenario"];
const FINGERPRINT: &str = "fingerprint";

/// Writes the fingerprints to a new file at `path`.
pub(super) fn write(path: &Path, evidence: &[Evidence]) -> Result<(), Error> {
    let file =
        File::create(path).map_err(|source| Error::Io { action: "write", path: path.to_owned(), source })?;
    write_to(file, evidence).map_err(|source| Error::Parquet { path: path.to_owned(), source })
}

fn write_to(file: File, evidence: &[Evidence]) -> Result<(), ParquetError> {
    let required =
        |name| Type::primitive_type_builder(name, Physical::BYTE_ARRAY).with_repetition(Repetition::REQUIRED);
    let mut fields = Vec::new();
    for name in TEXT {
        fields.push(Arc::new(required(name).with_logical_type(Some(LogicalType::String)).build()?));
    }
    fields.push(Arc::new(required(FINGERPRINT).build()?));
    let schema = Arc::new(Type::group_type_builder("bits").with_fields(fields).build()?);
    let properties = Arc::new(WriterProperties::builder().set_compression(Compression::SNAPPY).build());
    let mut file = SerializedFileWriter::new(file, schema, properties)?;
    let mut rows = file.next_row_group()?;
    let cells: [fn(&Evidence) -> ByteArray; 4] = [
        |row| row.family.as_bytes().to_vec().into(),
        |row| row.variant.as_bytes().to_vec().into(),
        |row| row.scenario.as_bytes().to_vec().into(),
        |row| row.bits.bytes().into(),
    ];
    for cell in cells {
        let Some(mut writer) = rows.next_column()? else {
            return Err(ParquetError::General("fewer columns than declared".to_owned()));
        };
        let values: Vec<ByteArray> = evidence.iter().map(cell).collect();
        writer.typed::<ByteArrayType>().write_batch(&values, None, None)?;
        writer.close()?;
    }
    rows.close()?;
    file.close()?;
    Ok(())
}

/// Reads the fingerprints at `path`; none where there is no such file.
pub(super) fn read(path: &Path) -> Result<Bits, ParquetError> {
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Bits::new()),
        Err(error) => return Err(error.into()),
    };
    let reader = SerializedFileReader::new(file)?;
    let mut bits = Bits::new();
    for row in reader.get_row_iter(None)? {
        let row = row?;
        let text = |at| row.get_string(at).cloned();
        let fingerprint = Fingerprint::from_bytes(row.get_bytes(TEXT.len())?.data());
        let fingerprint =
            fingerprint.ok_or_else(|| ParquetError::General("a fingerprint of another length".to_owned()))?;
        bits.insert((text(0)?, text(1)?, text(2)?), fingerprint);
    }
    Ok(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_back() {
        let mut bits = Fingerprint::default();
        bits.add(3, &[1.0, f32::NAN]);
        let of = |scenario, bits: &Fingerprint| Evidence {
            family: "f",
            variant: "v".to_owned(),
            scenario,
            failures: Vec::new(),
            bits: bits.clone(),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bits.parquet");
        write(&path, &[of("one", &bits), of("two", &Fingerprint::default())]).unwrap();
        let back = read(&path).unwrap();
        let key = |scenario: &str| ("f".to_owned(), "v".to_owned(), scenario.to_owned());
        assert_eq!(back.len(), 2);
        assert_eq!(back[&key("one")], bits);
        assert_eq!(back[&key("two")], Fingerprint::default());
        assert!(read(&folder.path().join("absent")).unwrap().is_empty());
    }
}
