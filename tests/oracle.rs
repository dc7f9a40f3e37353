//! Oracles against golden values: 50 digits and more, by another method, in another language (tools/golden.py).

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use rootq::family::{CERTIFIED, FAMILIES, Problem, Quantity, Truth};
use rootq::record::parse_f32;

/// Relative error allowed of a scalar: 450 roundings of f64, where an oracle takes a few dozen steps.
const SCALAR: f64 = 1e-13;

struct Row {
    line: usize,
    /// By column name; of an input and an output of one name the output counts.
    cells: HashMap<String, String>,
    /// The same, where the input counts.
    inputs: HashMap<String, String>,
}

impl Row {
    /// An empty cell is a value that the problem does not define.
    fn number(&self, column: &str) -> Option<f64> {
        let cell = self.cells.get(column).unwrap_or_else(|| panic!("no column {column}"));
        (!cell.is_empty())
            .then(|| cell.parse().unwrap_or_else(|_| panic!("line {}: {column} = {cell}", self.line)))
    }
}

fn golden(family: &str) -> Vec<Row> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{family}.csv"));
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().expect("a header").1.split(',').collect();
    lines
        .map(|(number, line)| {
            let cells: Vec<(String, String)> = header
                .iter()
                .map(|name| (*name).to_owned())
                .zip(line.split(',').map(str::to_owned))
                .collect();
            // Of equal keys the last counts.
            let inputs = cells.iter().rev().cloned().collect();
            Row { line: number + 1, cells: cells.into_iter().collect(), inputs }
        })
        .collect()
}

/// The relative error allowed of a scalar output: wider than [`SCALAR`] only where the problem's own conditioning in
/// f64 says so, with the reason beside it.
fn scalar_tolerance(family: &str, output: &str, row: &Row) -> f64 {
    match (family, output) {
        // Terms of up to 1 cancel down to the value, and below 1e-6 certainty is promised in absolute terms only.
        ("ltc_disk" | "ltc_ellipsoid" | "ltc_sphere", _) => {
            SCALAR + row.number(output).map_or(0.0, |value| if value > 0.0 { 2e-15 / value } else { 0.0 })
        }
        // A contour's sum is off by a few roundings of its terms, which are angles over 2 pi: 4e-15 absolutely.
        ("ltc_cylinder" | "ltc_strip", _) => {
            SCALAR + row.number("irradiance").filter(|value| *value > 0.0).map_or(0.0, |value| 4e-15 / value)
        }
        // Edges of lights that are small, thin or close cancel, and more precision is taken beyond 2^-36; below 2^-52
        // the error is absolute.
        ("ltc_polygon", "irradiance") => row
            .number("irradiance")
            .map_or(0.0, |value| 2f64.powi(-36) * (2f64.powi(-52) / value.max(1e-300)).max(1.0)),
        // Plain f64 is taken while its own bound stays below 1e-11 of the value, twofold numbers beyond.
        ("sym3_eigen", _) => 1e-11,
        _ => SCALAR,
    }
}

/// The angle allowed of a direction, in radians: what conditioning lets a certified oracle be off by.
fn direction_tolerance(family: &str, row: &Row) -> f64 {
    match family {
        // Where the relative gap of the lengths is wide, dot products in f64 do, and turn the axes by at most
        // 2^-51/gap; where it is narrow they are summed exactly.
        "ellipse_axes" => SCALAR + row.number("gap").map_or(0.0, |gap| 2f64.powi(-51) / gap),
        // As for its values: plain f64 is taken while its bound stays below 1e-11.
        "sym3_eigen" => 1e-11,
        _ => SCALAR,
    }
}

/// The distance allowed of a vector that has a length, relative to it.
fn vector_tolerance(family: &str, output: &str, row: &Row) -> f64 {
    _ = (family, output, row);
    SCALAR
}

fn check(problem: &dyn Problem) -> usize {
    let family = problem.name();
    let signature = problem.signature();
    let rows = golden(family);
    assert!(rows.len() >= 20 * problem.scenarios().len(), "{family}: only {} golden rows", rows.len());
    let mut compared = 0;
    for row in &rows {
        let place = format!("{family}.csv:{}", row.line);
        let inputs: Vec<f32> = signature
            .input_columns()
            .iter()
            .map(|column| parse_f32(&row.inputs[column]).unwrap_or_else(|| panic!("{place}: {column}")))
            .collect();
        let mut truth = Truth::new(problem.outputs());
        problem.oracle(&inputs, &mut truth);
        assert!(truth.worst_bound() <= CERTIFIED, "{place}: {truth:?}");
        for (position, output) in problem.outputs().iter().enumerate() {
            let expected: Option<Vec<f64>> =
                output.field.columns().map(|column| row.number(&column)).collect();
            let got = truth.output(position);
            let name = output.field.name;
            let Some(expected) = expected else {
                assert!(
                    truth.sensitivities()[position].is_infinite(),
                    "{place}: {name} is not defined, yet {truth:?}"
                );
                continue;
            };
            compared += 1;
            match output.quantity {
                Quantity::Magnitude
                | Quantity::Scalar
                | Quantity::Irradiance
                | Quantity::Coordinate
                | Quantity::SolidAngle => {
                    let error = (got[0] - expected[0]).abs();
                    let allowed = scalar_tolerance(family, name, row) * expected[0].abs();
                    assert!(error <= allowed, "{place}: {name} {} for {}", got[0], expected[0]);
                }
                // The golden values are an answer, right or wrong, exact in f32, and a condition is its residual. The
                // residuals of answers near 1 round to 2^-53 a few times, as those of the oracle's own answer do.
                Quantity::Property => {
                    const ROUNDINGS: f64 = 12.0 * f64::EPSILON;
                    let answer: Vec<f64> =
                        signature.output_columns().iter().filter_map(|column| row.number(column)).collect();
                    let expected = row.number(&format!("{name}_residual")).expect("a residual");
                    let residual = problem.residual(position, &inputs, &answer);
                    let allowed = SCALAR * expected + ROUNDINGS;
                    assert!(
                        (residual - expected).abs() <= allowed,
                        "{place}: {name} {residual} for {expected}"
                    );
                    let own = problem.residual(position, &inputs, truth.values());
                    assert!(own <= ROUNDINGS, "{place}: the oracle's {name} is off by {own:e}");
                }
                // Of all components together: the limit is one of lengths.
                Quantity::Builtin => {
                    let size = expected.iter().map(|c| c * c).sum::<f64>().sqrt();
                    for (got, expected) in got.iter().zip(&expected) {
                        let error = (got - expected).abs();
                        assert!(error <= SCALAR * size, "{place}: {name} {got} for {expected}");
                    }
                }
                Quantity::VectorIrradiance => {
                    let (got, expected) = (glam::DVec3::from_slice(got), glam::DVec3::from_slice(&expected));
                    let error = (got - expected).length();
                    let allowed = scalar_tolerance(family, name, row) * expected.length();
                    assert!(error <= allowed, "{place}: {name} {got} for {expected}");
                }
                Quantity::Vector { sign_free } => {
                    let (got, expected) = (glam::DVec3::from_slice(got), glam::DVec3::from_slice(&expected));
                    let sign = if sign_free && got.dot(expected) < 0.0 { -1.0 } else { 1.0 };
                    let error = (got - sign * expected).length();
                    let allowed = vector_tolerance(family, name, row) * expected.length();
                    assert!(
                        error <= allowed,
                        "{place}: {name} {got} for {expected}: {error:e} > {allowed:e}"
                    );
                }
                Quantity::UnitVector { sign_free } => {
                    let (got, expected) = (glam::DVec3::from_slice(got), glam::DVec3::from_slice(&expected));
                    let sign = if sign_free { got.dot(expected).signum() } else { 1.0 };
                    let angle = (got - sign * expected).length();
                    let allowed = direction_tolerance(family, row);
                    assert!(
                        angle <= allowed,
                        "{place}: {name} {got} for {expected}: {angle:e} > {allowed:e}"
                    );
                }
            }
        }
    }
    compared
}

#[test]
fn every_family_agrees_with_its_golden_values() {
    for problem in FAMILIES {
        let compared = check(*problem);
        println!("{}: {compared} values compared", problem.name());
    }
}

#[test]
fn every_golden_file_belongs_to_a_family() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for entry in fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let family = name.strip_suffix(".csv").unwrap_or_else(|| panic!("{name} is not a table"));
        assert!(rootq::family::find(family).is_some(), "{name} is of no family");
    }
}
