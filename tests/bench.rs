//! Times on real drivers: the timing loop evaluates what it says, as often as it says, and ceilings are ceilings.

#![allow(unsafe_code, reason = "one environment variable is set before any thread reads it")]

mod drivers;

use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use rootq::audit::Chunk;
use rootq::bench::{self, Ceilings, Contest, Effort, Entrant, Quartiles, Regime, Setting};
use rootq::catalog::{Catalog, Operations, Variant};
use rootq::device::vulkan::{Instance, VulkanDevice};
use rootq::device::{Clock, Device, Outputs};
use rootq::family::{FAMILIES, Problem};

fn on_every_device(test: impl Fn(&VulkanDevice)) {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        let both = drivers::both().unwrap_or_else(|message| panic!("{message}"));
        // SAFETY: every test comes through here before it opens an instance, and the others wait; nobody else in this
        // process reads or writes the environment meanwhile.
        unsafe { std::env::set_var("VK_DRIVER_FILES", both) };
    });
    let instance = Instance::open(false).unwrap();
    for facts in instance.devices().unwrap() {
        test(&VulkanDevice::open(&instance, facts.index).unwrap());
    }
}

static NOBODY: AtomicBool = AtomicBool::new(false);

/// All output columns of a variant's loop after so many evaluations; `None`: of the kernel without a loop.
fn outputs(
    device: &VulkanDevice,
    problem: &dyn Problem,
    variant: &Variant,
    rows: &[f32],
    evaluations: Option<u32>,
) -> Vec<f32> {
    let signature = problem.signature();
    let compiled = match evaluations {
        None => variant.compile(&signature, false),
        Some(_) => variant.compile_repeating(&signature),
    };
    let mut program = device.program(&compiled.unwrap().kernel).unwrap();
    if let Some(evaluations) = evaluations {
        program = device.repeating(&program, evaluations).unwrap();
    }
    let inputs = device.upload(rows, signature.input_columns().len()).unwrap();
    let outputs = device.wait(device.submit(&program, &inputs).unwrap()).unwrap();
    (0..signature.output_columns().len()).flat_map(|column| outputs.column(column).to_vec()).collect()
}

/// Nothing perturbs the first evaluation, and nothing is left of the others if there is none: the loop is around the very
/// function that is audited. One variant a family, with contraction forbidden: the compiler may contract differently in a
/// loop, and then the bits differ.
#[test]
fn one_turn_of_the_loop_is_the_evaluation() {
    let catalog = Catalog::embedded().unwrap();
    on_every_device(|device| {
        let mut checked = 0;
        for problem in FAMILIES {
            let Some(found) = catalog.family(problem.name()).max_by_key(|variant| variant.precise) else {
                continue;
            };
            let mut variant = found.clone();
            variant.precise = true;
            let rows = Chunk::draw_inputs(*problem, &problem.scenarios()[0], 1, 0, 200);
            let once = outputs(device, *problem, &variant, &rows, None);
            let looped = outputs(device, *problem, &variant, &rows, Some(1));
            assert_eq!(once.len(), looped.len());
            let same =
                once.iter().zip(&looped).all(|(a, b)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan());
            assert!(same, "{}", variant.id());
            checked += 1;
        }
        assert_eq!(checked, FAMILIES.len(), "families without a variant");
    });
}

/// After many evaluations an input is what it was or its neighbour, so a well-conditioned result is what it was, and
/// one that is not finite has spoilt nothing.
#[test]
fn perturbed_inputs_stay_where_they_were() {
    let catalog = Catalog::embedded().unwrap();
    let problem = rootq::family::find("ellipse_axes").unwrap();
    on_every_device(|device| {
        for name in ["cross", "as_printed"] {
            let variant = catalog.family("ellipse_axes").find(|variant| variant.name == name).unwrap();
            let rows = Chunk::draw_inputs(problem, &problem.scenarios()[0], 1, 0, 2000);
            let once = outputs(device, problem, variant, &rows, Some(1));
            let often = outputs(device, problem, variant, &rows, Some(1000));
            // Outputs 6 and 7 are the lengths, whose condition number is at most the aspect, 5: a part in 2^23 of every
            // input, and rounding.
            let lengths = |outputs: &[f32]| outputs[6 * 2000..].to_vec();
            for (a, b) in lengths(&once).into_iter().zip(lengths(&often)) {
                if name == "cross" {
                    assert!((a - b).abs() <= 1e-5 * a, "{a} became {b}");
                }
                assert_eq!(a.is_finite(), b.is_finite(), "{name}: {a} became {b}");
            }
        }
    });
}

/// The timing loop's own arithmetic on the host: what a function of two inputs leaves that mixes them into the bits it has
/// kept from turn to turn.
fn mixed_on_host([c, s]: [f32; 2], evaluations: u32) -> f32 {
    let (mut kept, mut feedback) = (1u32, 0u32);
    for _ in 0..evaluations {
        let factor = f32::from_bits(0x3f80_0000 - (feedback & 1));
        for input in [c * factor, s * factor] {
            kept = kept.wrapping_mul(1_664_525).wrapping_add(input.to_bits());
        }
        feedback = MIXED_EXPONENT | (kept >> 9);
    }
    f32::from_bits(feedback)
}

/// The exponent of 1: whatever is mixed is a normal number, which no driver flushes.
const MIXED_EXPONENT: u32 = 0x3f80_0000;

/// As many turns as were asked for, each of the inputs that the last turn's result decides: a function that keeps what it
/// saw leaves the very bits that the host's loop leaves, which one turn more or less, or one input not perturbed, would
/// change beyond recognition. No time is compared: how long a turn takes is the machine's affair.
#[test]
fn every_turn_is_taken() {
    let problem = rootq::family::find("horizon_sphere").unwrap();
    let text = format!(
        "uint kept = 1u;\n\
         float horizon_sphere(float c, float s) {{\n\
         \x20   kept = kept * 1664525u + floatBitsToUint(c);\n\
         \x20   kept = kept * 1664525u + floatBitsToUint(s);\n\
         \x20   return uintBitsToFloat({MIXED_EXPONENT}u | (kept >> 9));\n}}\n"
    );
    let variant = Variant::generated("horizon_sphere", "mixing", "", text);
    on_every_device(|device| {
        let rows = Chunk::draw_inputs(problem, &problem.scenarios()[0], 1, 0, 1000);
        for evaluations in [1, 2, 3, 256, 1000] {
            let looped = outputs(device, problem, &variant, &rows, Some(evaluations));
            assert_eq!(looped.len(), 1000);
            for (row, result) in rows.chunks_exact(2).zip(looped) {
                let expected = mixed_on_host([row[0], row[1]], evaluations);
                assert_eq!(result.to_bits(), expected.to_bits(), "{row:?}, {evaluations} times");
            }
        }
    });
}

/// Operations and bytes a second, of all that there is to measure: in units that a processor and the fastest GPU for
/// decades are within. Which is faster than which is for the figures to say.
#[test]
fn ceilings_are_counted_in_seconds() {
    on_every_device(|device| {
        let ceilings = bench::ceilings(device, &NOBODY).unwrap();
        println!("{}: {ceilings:#?}", device.facts().name);
        let Ceilings { copy, multiply_add, inverse_sqrt, divide, sine, exp2 } = &ceilings;
        for ceiling in [copy, multiply_add, inverse_sqrt, divide, sine, exp2] {
            assert!((1e4..1e17).contains(&ceiling.per_second), "{ceiling:?}");
            assert!(!ceiling.kernel.is_empty());
        }
    });
}

/// Real programs in both regimes, entered twice under two names: samples of all of them, by the device's clock, around one
/// another as they must be. What a ranking makes of times is tested on times that are known.
#[test]
fn a_contest_is_held() {
    let problem = rootq::family::find("horizon_sphere").unwrap();
    let signature = problem.signature();
    let text = "float horizon_sphere(float c, float s) { return sqrt(c * c + s) - 0.5; }";
    let variants = ["one", "two"].map(|name| Variant::generated("horizon_sphere", name, "", text.to_owned()));
    on_every_device(|device| {
        let ready = |variant: &Variant| {
            let streaming = variant.compile(&signature, false).unwrap().kernel;
            let repeating = variant.compile_repeating(&signature).unwrap().kernel;
            (device.program(&streaming).unwrap(), device.program(&repeating).unwrap())
        };
        let programs: Vec<_> = variants.iter().map(ready).collect();
        let null = Variant::null(&signature);
        let null_programs = ready(&null);
        let entrant = |at: usize| Entrant {
            name: &variants[at].name,
            streaming: &programs[at].0,
            repeating: Some(&programs[at].1),
            operations: Operations::default(),
        };
        let configurations = Chunk::draw_inputs(problem, &problem.scenarios()[0], 1, 0, 1 << 14);
        let contest = Contest {
            device,
            entrants: (0..2).map(entrant).collect(),
            null: Entrant {
                name: &null.name,
                streaming: &null_programs.0,
                repeating: Some(&null_programs.1),
                operations: Operations::default(),
            },
            inputs: 2,
            outputs: 1,
            configurations: &configurations,
            reference: Some(0),
            ceilings: None,
        };
        let effort = Effort { time: Duration::from_millis(20), ..Effort::default() };
        for setting in [Setting::STREAMING, Setting::COHERENT, Setting::DIVERGENT] {
            let (ranking, timings) = contest.run(setting, &effort, &|| (), &NOBODY).unwrap();
            assert_eq!((ranking.setting, ranking.reference.as_str()), (setting, "one"));
            assert!(ranking.rounds >= effort.min_rounds, "{ranking:?}");
            let looped = setting.regime == Regime::Arithmetic;
            for timing in &timings {
                assert_eq!((timing.setting, timing.clock), (setting, Clock::DeviceTimestamps));
                assert_eq!(timing.rounds, ranking.rounds);
                assert_eq!(timing.evaluations > 1, looped);
                let Quartiles { lower, median, upper } = timing.ns;
                assert!(0.0 < lower && lower <= median && median <= upper, "{timing:?}");
                let (ratio, rank) = (timing.ratio.unwrap(), timing.rank.unwrap());
                assert!(0.0 < ratio.low && ratio.low <= ratio.median && ratio.median <= ratio.high);
                assert!(1 <= rank.first && rank.first <= rank.last && rank.last <= 2, "{rank:?}");
            }
            assert_eq!(timings[0].ratio.unwrap().median, 1.0);
        }
    });
}
