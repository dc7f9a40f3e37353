//! The probe against devices whose behaviour is known by construction: host arithmetic with one habit changed.

use std::time::Duration;

use super::*;
use crate::catalog::Kernel;
use crate::device::{Clock, Elapsed, Error as DeviceError, Facts, Outputs};

/// A device's habits.
#[derive(Clone, Copy, Default)]
struct Habits {
    fuses: bool,
    truncates: bool,
    flushes: bool,
    careless_division: bool,
    /// Comparisons, min and max as x86's instructions have them: the second operand where either is NaN.
    second_operand: bool,
    filter_bits: u32,
}

struct Host {
    facts: Facts,
    habits: Habits,
}

struct Columns(Vec<Vec<f32>>);

impl Outputs for Columns {
    fn column(&self, column: usize) -> &[f32] {
        &self.0[column]
    }

    fn elapsed(&self) -> Elapsed {
        Elapsed { time: Duration::ZERO, clock: Clock::HostFence }
    }
}

impl Device for Host {
    type Program = Kernel;
    type Inputs = (Vec<f32>, usize);
    type Pending = Columns;
    type Outputs = Columns;

    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn max_rows(&self, _: usize, _: usize) -> usize {
        usize::MAX
    }

    fn program(&self, kernel: &Kernel) -> Result<Kernel, DeviceError> {
        Ok(kernel.clone())
    }

    fn upload(&self, rows: &[f32], columns: usize) -> Result<(Vec<f32>, usize), DeviceError> {
        Ok((rows.to_vec(), columns))
    }

    fn submit(&self, kernel: &Kernel, (rows, width): &(Vec<f32>, usize)) -> Result<Columns, DeviceError> {
        let mut columns = vec![Vec::new(); kernel.outputs];
        for row in rows.chunks_exact(*width) {
            let results = self.habits.results(&kernel.id, row);
            assert_eq!(results.len(), kernel.outputs, "{}", kernel.id);
            for (column, result) in columns.iter_mut().zip(results) {
                column.push(result);
            }
        }
        Ok(Columns(columns))
    }

    fn wait(&self, columns: Columns) -> Result<Columns, DeviceError> {
        Ok(columns)
    }
}

impl Habits {
    fn flush(self, value: f32) -> f32 {
        if self.flushes && value.is_subnormal() { 0.0 * value } else { value }
    }

    /// A result that is exact in f64, in f32.
    fn round(self, exact: f64) -> f32 {
        let nearest = exact as f32;
        let beyond = f64::from(nearest).abs() > exact.abs() && nearest.is_finite();
        let rounded = match (self.truncates && beyond, nearest > 0.0) {
            (true, true) => nearest.next_down(),
            (true, false) => nearest.next_up(),
            _ => nearest,
        };
        self.flush(rounded)
    }

    fn results(self, id: &str, row: &[f32]) -> Vec<f32> {
        let operand = |at: usize| f64::from(self.flush(row[at]));
        let truth = |condition: bool| f32::from(u8::from(condition));
        match id {
            "probe/copy" => vec![row[0]],
            "probe/arithmetic" => {
                let (a, b) = (operand(0), operand(1));
                let quotient = if self.careless_division {
                    self.round(a * f64::from(1.0 / b as f32))
                } else {
                    self.round(a / b)
                };
                vec![self.round(a + b), self.round(a - b), self.round(a * b), quotient]
            }
            "probe/roots" | "probe/functions" => {
                let x = operand(0);
                let all = [self.round(x.sqrt()), self.round(1.0 / x.sqrt()), x.ln() as f32, x.exp() as f32];
                all[..if id == "probe/roots" { 2 } else { 4 }].to_vec()
            }
            "probe/fused" => {
                let [a, b, c] = [row[0], row[1], row[2]];
                let fma = if self.fuses { a.mul_add(b, c) } else { a * b + c };
                vec![fma, a * b + c]
            }
            "probe/special" => {
                let (x, y) = (row[0], row[1]);
                let (least, largest) = match self.second_operand {
                    true => (if x < y { x } else { y }, if x > y { x } else { y }),
                    false => (x.min(y), x.max(y)),
                };
                let conditions = [x == y, x != y, x < y, x.is_nan(), x.is_infinite()].map(truth);
                [vec![least, largest, f32::min(x.max(0.0), 1.0)], conditions.to_vec()].concat()
            }
            "probe/filter" => {
                let steps = f32::from(1u16 << self.filter_bits);
                vec![(row[0].fract() * steps).floor() / steps]
            }
            _ => panic!("no kernel {id}"),
        }
    }
}

fn probed(habits: Habits) -> Probe {
    let facts = Facts {
        index: 0,
        name: "host".to_owned(),
        kind: "cpu".to_owned(),
        uuid: String::new(),
        vendor_id: 0,
        device_id: 0,
        driver: String::new(),
        driver_info: String::new(),
        driver_version: 0,
        api_version: String::new(),
        subgroup_size: 1,
        shader_float64: true,
        shader_float16: true,
        float_controls: None,
        max_storage_buffer_range: u64::MAX,
        unified_memory: true,
        timestamp_period: 1.0,
        timestamp_bits: 0,
        table_image_bits: if habits.filter_bits == 0 { 0 } else { 32 },
        validation: false,
    };
    probe(&Host { facts, habits }).unwrap()
}

fn answer(probe: &Probe, expression: &str) -> String {
    let mut found = probe.special.iter().filter(|observed| observed.expression == expression);
    let observed = found.next().unwrap_or_else(|| panic!("{expression}"));
    assert!(found.next().is_none(), "{expression} twice");
    observed.value.clone()
}

#[test]
fn plain_host_arithmetic_is_ieee_without_fusing() {
    let probe = probed(Habits::default());
    assert_eq!(probe.fused, Fused { fma: Fusing::Separate, expression: Fusing::Separate });
    for rounding in [probe.sum, probe.difference, probe.product] {
        assert_eq!(rounding, Rounding::NearestEven);
    }
    for exactness in [probe.division, probe.square_root, probe.inverse_square_root] {
        assert!(
            exactness.correctly_rounded && (0.49..=0.500_001).contains(&exactness.worst_ulp),
            "{exactness:?}"
        );
    }
    let all = Subnormals {
        copied: true,
        sum_operand: true,
        sum_result: true,
        product_operand: true,
        product_result: true,
        quotient_operand: true,
        quotient_result: true,
        sqrt_operand: true,
    };
    assert_eq!(probe.subnormals, all);
    assert!(probe.special.iter().all(|observed| observed.value == observed.ieee), "{:?}", probe.special);
    assert_eq!(probe.filter_bits, None);
}

#[test]
fn each_habit_is_found() {
    let fused = probed(Habits { fuses: true, ..Habits::default() }).fused;
    assert_eq!(fused, Fused { fma: Fusing::Fused, expression: Fusing::Separate });

    let probe = probed(Habits { truncates: true, ..Habits::default() });
    assert_eq!([probe.sum, probe.difference, probe.product], [Rounding::TowardZero; 3]);
    assert!(!probe.division.correctly_rounded && probe.division.worst_ulp > 0.9, "{:?}", probe.division);

    let flushed = probed(Habits { flushes: true, ..Habits::default() }).subnormals;
    assert_eq!(
        flushed,
        Subnormals {
            copied: true,
            sum_operand: false,
            sum_result: false,
            product_operand: false,
            product_result: false,
            quotient_operand: false,
            quotient_result: false,
            sqrt_operand: false,
        }
    );

    let division = probed(Habits { careless_division: true, ..Habits::default() }).division;
    // A reciprocal and a product, each rounded: more than one rounding, less than two of the coarser spacing.
    assert!(!division.correctly_rounded && (0.6..=1.5).contains(&division.worst_ulp), "{division:?}");

    let probe = probed(Habits { second_operand: true, ..Habits::default() });
    assert_eq!(answer(&probe, "min(1, NaN)"), "NaN");
    assert_eq!(answer(&probe, "min(NaN, 1)"), "1");

    for filter_bits in [4, 8] {
        assert_eq!(probed(Habits { filter_bits, ..Habits::default() }).filter_bits, Some(filter_bits));
    }
}
