//! Built-in tables: texels that a shader reads where it would otherwise compute.
//!
//! A variant asks for them in its front matter, `tables = { sphere_lut = "buffer" }`, and so says how it wants to read
//! them; [`super::generate`] declares them and devices upload them.

use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

use serde::Deserialize;

use super::kernel::{FIRST_TABLE_BINDING, TableBinding, TableForm};
use crate::numeric::clipped_sphere;
use crate::sample::ggx;

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
const GGX_SIDE: u32 = 64;

static TABLES: [Table; 4] = [
    Table {
        name: "ggx_amplitude",
        summary: "of the fitted GGX table: magnitude, Schlick-Fresnel term, 0, and sphere_lut; x: roughness, \
                  y: sqrt(1 - cosine)",
        width: GGX_SIDE,
        height: GGX_SIDE,
        channels: 4,
        texels: LazyLock::new(|| {
            let sphere = clipped_sphere::table_by_form_factor(GGX_SIDE as usize);
            by_roughness(|cell, at| [cell.magnitude, cell.fresnel, 0.0, sphere[at]])
        }),
    },
    Table {
        name: "ggx_minv",
        summary: "of the fitted GGX table: elements 00, 02, 20 and 22 of Minv (column, row); x: roughness, \
                  y: sqrt(1 - cosine)",
        width: GGX_SIDE,
        height: GGX_SIDE,
        channels: 4,
        texels: LazyLock::new(|| by_roughness(|cell, _| cell.minv)),
    },
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

/// Texels of the embedded GGX table with roughness along x, from its cells and their places in the new order.
fn by_roughness(texel: impl Fn(&ggx::Cell, usize) -> [f32; 4]) -> Arc<[f32]> {
    let (table, side) = (ggx::table(), GGX_SIDE as usize);
    assert_eq!(table.size(), side, "data/ggx.csv has other sides than its texture");
    let cell = |at: usize| texel(&table.cells()[at % side * side + at / side], at);
    (0..side * side).flat_map(cell).collect()
}

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

/// The bindings of tables by name, as a record has them; the error says which there is none of.
pub fn table_bindings(wanted: &BTreeMap<String, TableForm>) -> Result<Vec<TableBinding>, String> {
    let named = wanted.iter().map(|(name, form)| Ok((TableName::try_from(name.clone())?, *form)));
    Ok(bindings(&named.collect::<Result<_, String>>()?))
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
    fn roughness_runs_along_x() {
        let (minv, cells) = (TableName::try_from("ggx_minv".to_owned()).unwrap(), ggx::table().cells());
        let texels = minv.table().texels();
        // Roughness 5, angle 2.
        assert_eq!(texels[4 * (2 * 64 + 5)..][..4], cells[5 * 64 + 2].minv);
        let amplitude = TableName::try_from("ggx_amplitude".to_owned()).unwrap().table().texels();
        let sphere = TableName::try_from("sphere_lut".to_owned()).unwrap().table().texels();
        let cell = &cells[5 * 64 + 2];
        assert_eq!(
            amplitude[4 * (2 * 64 + 5)..][..4],
            [cell.magnitude, cell.fresnel, 0.0, sphere[2 * 64 + 5]]
        );
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
