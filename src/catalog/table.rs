//! Built-in tables: texels that a shader reads where it would otherwise compute.
//!
//! A variant asks for them in its front matter, `tables = { sphere_lut = "buffer" }`, and so says how it wants to read
//! them; [`super::generate`] declares them and devices upload them.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use serde::Deserialize;

use super::kernel::{FIRST_TABLE_BINDING, TableBinding, TableForm};
use crate::numeric::clipped_sphere;

/// A table's shape and where its texels come from.
pub struct Table {
    /// Its name in front matter and GLSL.
    pub name: &'static str,
    /// What a texel holds, one line.
    pub summary: &'static str,
    pub width: u32,
    pub height: u32,
    /// Floats a texel, 1 or 4.
    pub channels: u32,
    texels: LazyLock<Arc<[f32]>>,
}

impl Table {
    /// Row-major texels, computed when first asked for.
    pub fn texels(&self) -> Arc<[f32]> {
        Arc::clone(&self.texels)
    }
}

const SPHERE_LUT_SIDE: u32 = 64;

static TABLES: [Table; 2] = [
    Table {
        name: "sphere_lut",
        summary: "irradiance of a horizon-clipped sphere over its form factor; x: cosine -1..1, y: form factor 0..1",
        width: SPHERE_LUT_SIDE,
        height: SPHERE_LUT_SIDE,
        channels: 1,
        texels: LazyLock::new(|| clipped_sphere::table_by_form_factor(SPHERE_LUT_SIDE as usize).into()),
    },
    Table {
        name: "sphere_lut_solid_angle",
        summary: "the same; x: cosine -1..1, y: solid angle over the hemisphere's, 0..1",
        width: SPHERE_LUT_SIDE,
        height: SPHERE_LUT_SIDE,
        channels: 1,
        texels: LazyLock::new(|| clipped_sphere::table_by_solid_angle(SPHERE_LUT_SIDE as usize).into()),
    },
];

/// Every built-in table, sorted by name.
pub fn tables() -> &'static [Table] {
    &TABLES
}

/// The name of a table that exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(try_from = "String")]
pub struct TableName {
    /// Position among [`tables`].
    position: usize,
}

impl TableName {
    pub fn as_str(self) -> &'static str {
        self.table().name
    }

    pub fn table(self) -> &'static Table {
        &TABLES[self.position]
    }
}

impl TryFrom<String> for TableName {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        match tables().iter().position(|table| table.name == name) {
            Some(position) => Ok(TableName { position }),
            None => {
                let known: Vec<&str> = tables().iter().map(|table| table.name).collect();
                Err(format!("no table '{name}'; there are: {}", known.join(", ")))
            }
        }
    }
}

/// The bindings of what a variant asks for, in order of names.
pub(super) fn bindings(wanted: &BTreeMap<TableName, TableForm>) -> Vec<TableBinding> {
    (FIRST_TABLE_BINDING..)
        .zip(wanted)
        .map(|(binding, (name, form))| {
            let table = name.table();
            TableBinding {
                name: table.name,
                binding,
                form: *form,
                width: table.width,
                height: table.height,
                channels: table.channels,
                texels: table.texels(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_sorted() {
        assert!(tables().is_sorted_by(|a, b| a.name < b.name));
    }

    #[test]
    fn every_table_has_the_texels_its_shape_says() {
        for table in tables() {
            assert!(table.channels == 1 || table.channels == 4, "{}", table.name);
            let expected = table.width * table.height * table.channels;
            assert_eq!(table.texels().len(), expected as usize, "{}", table.name);
            assert!(table.texels().iter().all(|texel| texel.is_finite()), "{}", table.name);
        }
    }
}
