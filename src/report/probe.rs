//! Probes of devices, one column a device.

use comfy_table::{Cell, Color};

use super::numbers::short;
use super::table;
use crate::device::Facts;
use crate::probe::{Exactness, Fusing, Observation, Probe, Rounding, SAMPLES};

/// What each device does.
pub fn probes(probed: &[(Facts, Probe)], colour: bool) -> String {
    let mut header = vec![String::new()];
    header.extend(probed.iter().map(|(facts, _)| facts.name.clone()));
    let mut table = table::table(&header, colour);
    let mut row = |name: &str, cell: &dyn Fn(&Probe) -> Cell| {
        let cells = std::iter::once(Cell::new(name)).chain(probed.iter().map(|(_, probe)| cell(probe)));
        table.add_row(cells);
    };
    row("fma(a, b, c)", &|probe| Cell::new(fusing(probe.fused.fma)));
    row("a * b + c, contraction allowed", &|probe| Cell::new(fusing(probe.fused.expression)));
    row("+", &|probe| Cell::new(rounding(probe.sum)));
    row("-", &|probe| Cell::new(rounding(probe.difference)));
    row("*", &|probe| Cell::new(rounding(probe.product)));
    row("/", &|probe| Cell::new(exactness(&probe.division)));
    row("sqrt", &|probe| Cell::new(exactness(&probe.square_root)));
    row("inversesqrt", &|probe| Cell::new(exactness(&probe.inverse_square_root)));
    let kept = |kept: bool| Cell::new(if kept { "kept" } else { "flushed" });
    row("subnormals: copied", &|probe| kept(probe.subnormals.copied));
    row("subnormals: operand of +", &|probe| kept(probe.subnormals.sum_operand));
    row("subnormals: result of +", &|probe| kept(probe.subnormals.sum_result));
    row("subnormals: operand of *", &|probe| kept(probe.subnormals.product_operand));
    row("subnormals: result of *", &|probe| kept(probe.subnormals.product_result));
    row("subnormals: operand of /", &|probe| kept(probe.subnormals.quotient_operand));
    row("subnormals: result of /", &|probe| kept(probe.subnormals.quotient_result));
    row("subnormals: operand of sqrt", &|probe| kept(probe.subnormals.sqrt_operand));
    let expressions = probed.first().map_or(0, |(_, probe)| probe.special.len());
    for at in 0..expressions {
        row(&probed[0].1.special[at].expression, &|probe| {
            let observed = &probe.special[at];
            let cell = Cell::new(special(observed));
            if observed.value == observed.ieee { cell } else { cell.fg(Color::Yellow) }
        });
    }
    row("bits of a sampler's weight", &|probe| {
        Cell::new(match probe.filter_bits {
            None => "no filter".to_owned(),
            Some(12) => "12 or more".to_owned(),
            Some(bits) => bits.to_string(),
        })
    });
    format!(
        "{}\nAn error \"up to\" so many ULP is the worst of {SAMPLES} samples; other inputs may be further off.\n",
        table::lines(&table)
    )
}

/// Where it departs from IEEE 754, that too.
fn special(observed: &Observation) -> String {
    let Observation { value, ieee, .. } = observed;
    if value == ieee { value.clone() } else { format!("{value} (IEEE: {ieee})") }
}

fn fusing(fusing: Fusing) -> &'static str {
    match fusing {
        Fusing::Fused => "fused",
        Fusing::Separate => "product and sum rounded",
        Fusing::Other => "neither throughout",
    }
}

fn rounding(rounding: Rounding) -> &'static str {
    match rounding {
        Rounding::NearestEven => "to nearest, ties to even",
        Rounding::TowardZero => "toward zero",
        Rounding::Other => "neither nearest nor toward zero throughout",
    }
}

fn exactness(exactness: &Exactness) -> String {
    if exactness.correctly_rounded {
        return "correctly rounded".to_owned();
    }
    format!("up to {} ULP", short(Some(exactness.worst_ulp).filter(|ulp| ulp.is_finite())))
}

#[cfg(test)]
mod tests {
    use super::special;
    use crate::probe::Observation;

    #[test]
    fn departures_are_told_without_colour() {
        let observed = |value: &str| {
            let [expression, value, ieee] = ["log(-1)", value, "NaN"].map(str::to_owned);
            special(&Observation { expression, value, ieee })
        };
        assert_eq!(observed("NaN"), "NaN");
        assert_eq!(observed("0"), "0 (IEEE: NaN)");
    }
}
