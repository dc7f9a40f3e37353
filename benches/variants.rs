//! Every variant by the device's own timestamps: `cargo bench --bench variants -- ellipse_axes/cross`.
//!
//! The same kernels, configurations and clock as `rootq bench`, one variant after another instead of in turns: for a
//! look at one variant's distribution, or a comparison with what criterion kept of an earlier run. ROOTQ_DEVICE chooses the
//! device as `--device` does.

use std::cell::OnceCell;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rootq::audit::Chunk;
use rootq::bench::CONFIGURATIONS;
use rootq::catalog::{Catalog, Kernel, Variant};
use rootq::device::vulkan::{Instance, VulkanDevice};
use rootq::device::{Device, Outputs};
use rootq::family::{FAMILIES, Problem};

/// Configurations and evaluations of the arithmetic regime: some for every lane of a device.
const ROWS: usize = 1 << 12;
const EVALUATIONS: u32 = 16;

fn open() -> VulkanDevice {
    let instance = Instance::open(false).expect("a Vulkan loader");
    let selector = std::env::var("ROOTQ_DEVICE").ok();
    let index = instance.choose(selector.as_deref()).expect("a device");
    VulkanDevice::open(&instance, index).expect("a device that opens")
}

/// Measures a kernel whose program repeats as often as said, on the first `rows` of the family's first scenario. Nothing
/// is compiled or drawn unless criterion wants this one.
fn measure(
    group: &mut BenchmarkGroup<'_, WallTime>,
    device: &VulkanDevice,
    problem: &dyn Problem,
    variant: &Variant,
    (rows, evaluations): (usize, Option<u32>),
    kernel: impl Fn() -> Kernel,
) {
    group.throughput(Throughput::Elements(rows as u64 * u64::from(evaluations.unwrap_or(1))));
    let ready = OnceCell::new();
    let make = || {
        let mut program = device.program(&kernel()).expect("a program");
        if let Some(evaluations) = evaluations {
            program = device.repeating(&program, evaluations).expect("a device that repeats");
        }
        let inputs = Chunk::draw_inputs(problem, &problem.scenarios()[0], 1, 0, rows);
        let inputs = device.upload(&inputs, problem.signature().input_columns().len()).expect("inputs");
        (program, inputs)
    };
    group.bench_function(BenchmarkId::from_parameter(variant.id()), |bencher| {
        let (program, inputs) = ready.get_or_init(make);
        bencher.iter_custom(|iterations| {
            let once = || {
                let pending = device.submit(program, inputs).expect("a submission");
                device.wait(pending).expect("outputs").elapsed().time
            };
            (0..iterations).map(|_| once()).sum::<Duration>()
        });
    });
}

fn variants(criterion: &mut Criterion) {
    let device = open();
    let catalog = Catalog::embedded().expect("a catalogue");
    for regime in ["streaming", "arithmetic"] {
        let mut group = criterion.benchmark_group(regime);
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(200))
            .measurement_time(Duration::from_secs(1));
        for problem in FAMILIES {
            let signature = problem.signature();
            let null = Variant::null(&signature);
            for variant in catalog.family(problem.name()).chain([&null]) {
                if regime == "streaming" {
                    let kernel = || variant.compile(&signature, false).expect("a kernel").kernel;
                    measure(&mut group, &device, *problem, variant, (CONFIGURATIONS, None), kernel);
                } else {
                    let kernel = || variant.compile_repeating(&signature).expect("a kernel").kernel;
                    measure(&mut group, &device, *problem, variant, (ROWS, Some(EVALUATIONS)), kernel);
                }
            }
        }
        group.finish();
    }
}

criterion_group!(benches, variants);
criterion_main!(benches);
