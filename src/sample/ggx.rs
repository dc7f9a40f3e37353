//! The fitted table of linearly transformed cosines for the GGX material.
//!
//! `data/ggx.csv` holds it: 64 x 64 cells over roughness (alpha = roughness^2) and sqrt(1 - cos theta), each the inverse
//! matrix with a middle element of 1, the magnitude (directional albedo without Fresnel) and the Schlick-Fresnel term.
//! `rootq fit ggx --out data/ggx.csv` made it; its first lines say how well it fits, and `fit` how that compares.

use std::sync::LazyLock;

use glam::DMat3;

/// The embedded table. A test reads it whole, so the message below is never seen.
static EMBEDDED: LazyLock<Table> =
    LazyLock::new(|| Table::parse(include_str!("../../data/ggx.csv")).expect("data/ggx.csv is a table"));

/// Minv, column-major, of a GGX material of `roughness` (alpha = roughness^2, in 0..1) seen at `cos_theta` in 0..1:
/// it takes directions in the shading frame (normal +z, viewer in the xz plane) to where the lobe is a cosine.
///
/// Bilinear in the embedded table, as shaders sample it; the middle element is 1, and only the matrix up to a factor
/// matters. Invertible and finite everywhere: values outside 0..1, and NaN, count as the nearer end, or 0.
pub fn minv(roughness: f64, cos_theta: f64) -> DMat3 {
    EMBEDDED.lookup(roughness, cos_theta).minv()
}

/// The embedded table.
pub fn table() -> &'static Table {
    &EMBEDDED
}

/// The cosine at which cells with index `angle` of a table of `size` x `size` are.
pub fn cos_theta(angle: usize, size: usize) -> f64 {
    let x = angle as f64 / (size - 1) as f64;
    1.0 - x * x
}

/// One cell: what a shader finds in its two textures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Elements 00, 02, 20 and 22 of Minv; `minv_02` is in column 0, row 2.
    pub minv: [f32; 4],
    /// Integral of BRDF times cosine without Fresnel.
    pub magnitude: f32,
    /// The same, weighted with Schlick's (1 - cos)^5: reflectance is f0 (magnitude - fresnel) + fresnel.
    pub fresnel: f32,
}

/// Names of the columns, in order; further columns are for people.
pub const COLUMNS: [&str; 8] =
    ["roughness", "angle", "minv_00", "minv_02", "minv_20", "minv_22", "magnitude", "fresnel"];

impl Cell {
    /// Rounds once. `minv` has the symmetry of an isotropic material and a middle element of 1.
    pub fn new(minv: DMat3, magnitude: f64, fresnel: f64) -> Self {
        let elements = [minv.x_axis.x, minv.x_axis.z, minv.z_axis.x, minv.z_axis.z];
        Cell { minv: elements.map(|e| e as f32), magnitude: magnitude as f32, fresnel: fresnel as f32 }
    }

    /// The inverse matrix, its middle element 1.
    pub fn matrix(&self) -> DMat3 {
        matrix(self.minv.map(f64::from))
    }

    /// The values in the order of [`COLUMNS`], after the two indices.
    pub fn values(&self) -> [f32; 6] {
        let [m00, m02, m20, m22] = self.minv;
        [m00, m02, m20, m22, self.magnitude, self.fresnel]
    }
}

/// Values between cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    /// In the order of [`Cell::values`].
    values: [f64; 6],
}

impl Values {
    /// The inverse matrix, its middle element 1.
    pub fn minv(&self) -> DMat3 {
        let [m00, m02, m20, m22, ..] = self.values;
        matrix([m00, m02, m20, m22])
    }

    /// See [`Cell::magnitude`].
    pub fn magnitude(&self) -> f64 {
        self.values[4]
    }

    /// See [`Cell::fresnel`].
    pub fn fresnel(&self) -> f64 {
        self.values[5]
    }
}

/// A square table. Roughness is i/(size - 1), sqrt(1 - cos theta) is j/(size - 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    size: usize,
    /// Angle fastest.
    cells: Vec<Cell>,
}

/// What is wrong with a table's text.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// A line that is not what the format says.
    #[error("line {line}: {what}")]
    Line { line: usize, what: &'static str },
    /// A number of cells that is no square, or less than four.
    #[error("{0} cells make no square table")]
    NotSquare(usize),
}

impl Table {
    /// From cells with the angle fastest.
    ///
    /// # Panics
    /// Unless there are `size` x `size` cells and `size` is at least 2.
    pub fn new(size: usize, cells: Vec<Cell>) -> Self {
        assert!(size >= 2 && cells.len() == size * size, "{} cells, size {size}", cells.len());
        Table { size, cells }
    }

    /// Cells a side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// All cells, angle fastest.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Reads what 'rootq fit ggx' writes: '#' lines, a header with at least [`COLUMNS`], and one line a cell.
    pub fn parse(text: &str) -> Result<Self, TableError> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
        let fault = |line: usize, what| TableError::Line { line: line + 1, what };
        let (at, header) = lines.next().ok_or(TableError::NotSquare(0))?;
        if !header.split(',').take(COLUMNS.len()).eq(COLUMNS) {
            return Err(fault(at, "the header does not start with the columns of a GGX table"));
        }
        let mut cells = Vec::new();
        let mut indices = Vec::new();
        for (at, line) in lines {
            let mut fields = line.split(',');
            let mut index = || fields.next().and_then(|field| field.parse::<usize>().ok());
            let (Some(roughness), Some(angle)) = (index(), index()) else {
                return Err(fault(at, "a cell starts with its two indices"));
            };
            let mut values = [0.0; 6];
            for value in &mut values {
                *value = fields
                    .next()
                    .and_then(|field| field.parse().ok())
                    .filter(|value: &f32| value.is_finite())
                    .ok_or(fault(at, "a cell has six finite values"))?;
            }
            let [m00, m02, m20, m22, magnitude, fresnel] = values;
            indices.push((at, roughness, angle));
            cells.push(Cell { minv: [m00, m02, m20, m22], magnitude, fresnel });
        }
        let size = cells.len().isqrt();
        if size < 2 || size * size != cells.len() {
            return Err(TableError::NotSquare(cells.len()));
        }
        for (position, (at, roughness, angle)) in indices.into_iter().enumerate() {
            if (roughness, angle) != (position / size, position % size) {
                return Err(fault(at, "cells are in order, the angle fastest"));
            }
        }
        Ok(Table { size, cells })
    }

    /// Bilinear interpolation in f64, cells at the ends included.
    pub fn lookup(&self, roughness: f64, cos_theta: f64) -> Values {
        let (i, u) = self.place(roughness);
        // Cosines that rounding left above 1 give NaN, which counts as 0.
        let (j, v) = self.place((1.0 - cos_theta).sqrt());
        let row = |i: usize| {
            let first = self.cells[i * self.size + j].values();
            let second = self.cells[i * self.size + j + 1].values();
            std::array::from_fn::<f64, 6, _>(|at| mix(f64::from(first[at]), f64::from(second[at]), v))
        };
        let (smoother, rougher) = (row(i), row(i + 1));
        Values { values: std::array::from_fn(|at| mix(smoother[at], rougher[at], u)) }
    }

    /// The cell below a coordinate in 0..1 and the way to the next.
    fn place(&self, coordinate: f64) -> (usize, f64) {
        // NaN is not above 0.
        let inside = if coordinate > 0.0 { coordinate.min(1.0) } else { 0.0 };
        let position = inside * (self.size - 1) as f64;
        let below = (position as usize).min(self.size - 2);
        (below, position - below as f64)
    }
}

fn matrix([m00, m02, m20, m22]: [f64; 4]) -> DMat3 {
    DMat3::from_cols_array(&[m00, 0.0, m02, 0.0, 1.0, 0.0, m20, 0.0, m22])
}

/// Exact at both ends.
fn mix(a: f64, b: f64, t: f64) -> f64 {
    a * (1.0 - t) + b * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_table_is_whole() {
        assert_eq!(table().size(), 64);
        for cell in table().cells() {
            assert!(cell.magnitude > 0.0 && cell.magnitude <= 1.0, "{cell:?}");
            assert!(cell.fresnel >= 0.0 && cell.fresnel <= cell.magnitude, "{cell:?}");
        }
    }

    #[test]
    fn every_matrix_can_be_inverted() {
        let steps = 1000;
        for i in 0..=steps {
            for j in 0..=steps {
                // Squared, so that grazing angles and smooth materials are reached as finely as the rest.
                let (a, b) = (f64::from(i) / f64::from(steps), f64::from(j) / f64::from(steps));
                let minv = minv(a * a, b * b);
                let [m00, m02, m20, m22] = [minv.x_axis.x, minv.x_axis.z, minv.z_axis.x, minv.z_axis.z];
                // The lobe of the smoothest mirror at grazing: minv_00 is cos^2, minv_22 is alpha.
                let (det, terms) = (m00 * m22 - m02 * m20, (m00 * m22).abs() + (m02 * m20).abs());
                assert!(det > 1e-12 && det > 0.5 * terms, "{a} {b} {minv}");
                assert!(minv.inverse().is_finite(), "{a} {b} {minv}");
            }
        }
    }

    #[test]
    fn at_normal_incidence_the_lobe_is_symmetric() {
        for i in 0..=100 {
            let minv = minv(f64::from(i) / 100.0, 1.0);
            assert_eq!((minv.x_axis.x, minv.x_axis.z, minv.z_axis.x), (1.0, 0.0, 0.0), "{minv}");
            // Widths up to that of alpha = 1, a little flatter than a cosine.
            assert!(minv.z_axis.z > 0.0 && minv.z_axis.z <= 1.13, "{minv}");
        }
    }

    #[test]
    fn cells_are_met_exactly_and_ends_are_held() {
        let cell = |i: usize, j: usize| table().cells()[i * 64 + j];
        let exact = |values: Values, cell: Cell| assert_eq!(values.values, cell.values().map(f64::from));
        // 1 - 0^2 and 1 - 1^2 have exact roots.
        exact(table().lookup(1.0, 0.0), cell(63, 63));
        exact(table().lookup(0.0, 1.0), cell(0, 0));
        exact(table().lookup(2.0, -1.0), cell(63, 63));
        exact(table().lookup(f64::NAN, f64::NAN), cell(0, 0));
        exact(table().lookup(-1.0, 1.0 + 1e-16), cell(0, 0));
        // In between: the mean of two cells, within the rounding of the coordinate.
        let between = table().lookup(10.5 / 63.0, 1.0).minv().z_axis.z;
        let mean = 0.5 * (f64::from(cell(10, 0).minv[3]) + f64::from(cell(11, 0).minv[3]));
        assert!((between - mean).abs() < 1e-14, "{between} {mean}");
    }

    #[test]
    fn a_smooth_lobe_points_where_a_mirror_does() {
        // The direction that Minv takes to +z, against the mirrored viewer: within the width of the lobe.
        for cos in [0.3, 0.7, 0.95] {
            let axis = (minv(0.05, cos).inverse() * glam::DVec3::Z).normalize();
            let mirror = glam::DVec3::new(-f64::sqrt(1.0 - cos * cos), 0.0, cos);
            assert!(axis.dot(mirror) > 1.0 - 1e-4, "{cos}: {axis} {mirror}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let header = COLUMNS.join(",");
        let fault = |text: &str| Table::parse(text).unwrap_err();
        assert_eq!(fault(""), TableError::NotSquare(0));
        assert!(matches!(fault("a,b"), TableError::Line { line: 1, .. }));
        assert_eq!(fault(&format!("# x\n{header}\n0,0,1,0,0,1,1,0\n")), TableError::NotSquare(1));
        assert!(matches!(fault(&format!("{header}\n0,0,1,0,0,nan,1,0\n")), TableError::Line { line: 2, .. }));
        assert!(matches!(fault(&format!("{header}\n0,0,1,0,0,1,1\n")), TableError::Line { line: 2, .. }));
        let disordered = format!("{header}\n{}", "0,0,1,0,0,1,1,0\n".repeat(4));
        assert!(matches!(fault(&disordered), TableError::Line { line: 3, .. }));
    }
}
