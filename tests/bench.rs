//! Times on real drivers: the timing loop evaluates what it says, as often as it says, and ceilings are ceilings.

#![allow(unsafe_code, reason = "one environment variable is set before any thread reads it")]

mod drivers;

use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use rootq::audit::Chunk;
use rootq::bench::{self, Bound, Contest, Effort, Entrant, Setting, Stop};
use rootq::catalog::{Catalog, Operations, Variant};
use rootq::device::vulkan::{Instance, VulkanDevice};
use rootq::device::{Device, Outputs};
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

/// Four times the evaluations take about four times the time: nothing is folded away or left out. Twice off is allowed for
/// a busy machine, the least of several samples being compared.
#[test]
fn every_turn_takes_its_time() {
    let catalog = Catalog::embedded().unwrap();
    let problem = rootq::family::find("ellipse_axes").unwrap();
    let signature = problem.signature();
    on_every_device(|device| {
        let null = Variant::null(&signature);
        for variant in catalog.family("ellipse_axes").filter(|variant| variant.name == "cross").chain([&null])
        {
            let program = device.program(&variant.compile_repeating(&signature).unwrap().kernel).unwrap();
            let rows = Chunk::draw_inputs(problem, &problem.scenarios()[0], 1, 0, 4096);
            let inputs = device.upload(&rows, 6).unwrap();
            let time = |evaluations: u32| {
                let program = device.repeating(&program, evaluations).unwrap();
                let once = |_| device.wait(device.submit(&program, &inputs).unwrap()).unwrap().elapsed().time;
                (0..12).map(once).min().unwrap().as_secs_f64()
            };
            let factor = time(1024) / time(256);
            assert!((2.0..8.0).contains(&factor), "{}: {factor}", variant.id());
        }
    });
}

/// More than a few operations a second, and in an order that no processor reverses: a root or a sine is never cheaper than
/// a multiply-add.
#[test]
fn ceilings_are_plausible() {
    on_every_device(|device| {
        let ceilings = bench::ceilings(device, &NOBODY).unwrap();
        println!("{}: {ceilings:#?}", device.facts().name);
        for special in [&ceilings.inverse_sqrt, &ceilings.divide, &ceilings.sine, &ceilings.exp2] {
            assert!(special.per_second > 1e6 && special.per_second < ceilings.multiply_add.per_second);
        }
        assert!(ceilings.copy.per_second > 1e7 && ceilings.copy.per_second < 1e14);
    });
}

/// A variant entered under two names shares places with itself, and one that does the work of it ten times comes last.
#[test]
fn a_contest_tells_what_differs_from_what_does_not() {
    let problem = rootq::family::find("horizon_sphere").unwrap();
    let signature = problem.signature();
    let text = |turns: usize| {
        format!(
            "float horizon_sphere(float c, float s) {{ float x = c; \
             for (int n = 0; n < {turns}; ++n) x = sqrt(x * x + s) - 0.5; return x; }}"
        )
    };
    let variants = [("one", 10), ("two", 10), ("slow", 100)]
        .map(|(name, turns)| Variant::generated("horizon_sphere", name, "", text(turns)));
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
            entrants: (0..3).map(entrant).collect(),
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
        let effort = Effort { time: Duration::from_millis(300), ..Effort::default() };
        for setting in [Setting::COHERENT, Setting::DIVERGENT] {
            // A false positive is allowed one time in twenty, three in a row are not.
            let (ranking, timings) = (0..3)
                .map(|_| contest.run(setting, &effort, &|| (), &NOBODY).unwrap())
                .find(|(ranking, timings)| {
                    let ranks = [timings[0].rank.unwrap(), timings[1].rank.unwrap()];
                    let shared = ranks[0].last >= ranks[1].first && ranks[1].last >= ranks[0].first;
                    shared && ranking.null_ns.median < timings[0].ns.median
                })
                .expect("the same variant ranks before itself, or nothing takes longer than it");
            // Many times the work: how certain that is depends on what else the machine does, the middle hardly.
            assert_eq!(timings[2].rank.unwrap().last, 3);
            let ratio = timings[2].ratio.unwrap();
            assert!(ratio.median > 2.0, "{ratio:?}");
            assert_eq!(timings[2].bound, Some(Bound::Compute));
            assert_ne!(ranking.stopped, Stop::Rounds);
        }
    });
}
