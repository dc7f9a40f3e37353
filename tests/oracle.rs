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

fn text(family: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{family}.csv"));
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn golden(family: &str) -> Vec<Row> {
    let text = text(family);
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

/// What a golden file's tolerance lines add to [`SCALAR`]: a number, and a condition to divide it by.
fn tolerances(family: &str) -> HashMap<String, (f64, Option<String>)> {
    text(family)
        .lines()
        .filter_map(|line| line.strip_prefix("# tolerance "))
        .map(|line| {
            let (what, reason) = line.split_once(": ").unwrap_or_else(|| panic!("{family}: {line}"));
            assert!(!reason.is_empty(), "{family}: {line}");
            let (output, number) = what.split_once(' ').unwrap_or_else(|| panic!("{family}: {line}"));
            let (number, condition) = match number.split_once('/') {
                Some((number, condition)) => (number, Some(condition.to_owned())),
                None => (number, None),
            };
            (output.to_owned(), (number.parse().unwrap_or_else(|_| panic!("{family}: {line}")), condition))
        })
        .collect()
}

/// The relative error allowed of an output, of a vector's distance relative to its length; an angle in radians of a
/// direction.
fn tolerance(tolerances: &HashMap<String, (f64, Option<String>)>, output: &str, row: &Row) -> f64 {
    SCALAR
        + match tolerances.get(output) {
            None => 0.0,
            Some((number, None)) => *number,
            Some((number, Some(condition))) => row.number(condition).map_or(0.0, |by| number / by),
        }
}

fn check(problem: &dyn Problem) -> usize {
    let family = problem.name();
    let signature = problem.signature();
    let rows = golden(family);
    let tolerances = tolerances(family);
    for name in tolerances.keys() {
        let output = problem.outputs().iter().find(|output| output.field.name == name);
        let output = output.unwrap_or_else(|| panic!("{family}: a tolerance of {name}, which is no output"));
        let fixed = matches!(output.quantity, Quantity::Property | Quantity::Builtin);
        assert!(!fixed, "{family}: {name} takes no tolerance");
    }
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
                    let allowed = tolerance(&tolerances, name, row) * expected[0].abs();
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
                    let allowed = tolerance(&tolerances, name, row) * expected.length();
                    assert!(error <= allowed, "{place}: {name} {got} for {expected}");
                }
                Quantity::Vector { sign_free } => {
                    let (got, expected) = (glam::DVec3::from_slice(got), glam::DVec3::from_slice(&expected));
                    let sign = if sign_free && got.dot(expected) < 0.0 { -1.0 } else { 1.0 };
                    let error = (got - sign * expected).length();
                    let allowed = tolerance(&tolerances, name, row) * expected.length();
                    assert!(
                        error <= allowed,
                        "{place}: {name} {got} for {expected}: {error:e} > {allowed:e}"
                    );
                }
                Quantity::UnitVector { sign_free } => {
                    let (got, expected) = (glam::DVec3::from_slice(got), glam::DVec3::from_slice(&expected));
                    let sign = if sign_free { got.dot(expected).signum() } else { 1.0 };
                    let angle = (got - sign * expected).length();
                    let allowed = tolerance(&tolerances, name, row);
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
