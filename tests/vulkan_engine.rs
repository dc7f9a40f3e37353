//! The Vulkan engine on every driver, under the validation layer.
//!
//! Each test opens an instance of its own, runs on every device in it, closes the devices and then wants no
//! validation message: leaked objects and wrong synchronisation show there.
#![allow(unsafe_code, reason = "a compiler's C interface and one environment variable")]

mod drivers;
mod glsl;

use std::process::Command;
use std::sync::{Arc, OnceLock};

use rootq::catalog::{Field, Kernel, Signature, TableBinding, TableForm, Type, Variant};
use rootq::device::vulkan::{Instance, Options, VulkanDevice};
use rootq::device::{Clock, Device, Error, Facts, Outputs};
use rootq::numeric::binary16;

/// Sum, product and negation: all correctly rounded on any device, so that results compare by bits.
const ARITHMETIC: &str = "o[k] = i[k] + i[stride + k];
    o[stride + k] = i[k] * i[2 * stride + k];
    o[2 * stride + k] = -i[2 * stride + k];";

/// About a thousand dependent operations, to take long enough for several dispatches.
const SLOW: &str = "float x = i[k];
    for (int n = 0; n < 400; ++n) x = x * 0.5 + 1.0;
    o[k] = x + i[k];";

fn kernel(id: &str, body: &str, inputs: usize, outputs: usize) -> Kernel {
    Kernel {
        id: id.to_owned(),
        spirv: glsl::compile(body),
        inputs,
        outputs,
        tables: Vec::new(),
        traps: Vec::new(),
    }
}

fn arithmetic() -> Kernel {
    kernel("test/arithmetic", ARITHMETIC, 3, 3)
}

/// Three columns that no two rows share.
fn rows(count: usize) -> Vec<f32> {
    (0..count)
        .flat_map(|row| [row as f32 * 0.25 + 0.1, 1.0 - row as f32 * 1e-3, (row % 1009) as f32 + 0.3])
        .collect()
}

fn check_arithmetic(rows: &[f32], outputs: &impl Outputs) {
    let (sum, product, negation) = (outputs.column(0), outputs.column(1), outputs.column(2));
    assert_eq!((sum.len(), product.len(), negation.len()), (rows.len() / 3, rows.len() / 3, rows.len() / 3));
    for (index, row) in rows.chunks_exact(3).enumerate() {
        let got = [sum[index], product[index], negation[index]];
        let want = [row[0] + row[1], row[0] * row[2], -row[2]];
        assert_eq!(got.map(f32::to_bits), want.map(f32::to_bits), "row {index}: {row:?} gave {got:?}");
    }
}

/// Makes the loader list lavapipe and SwiftShader, unless the environment says otherwise.
fn install_drivers() {
    static DONE: OnceLock<()> = OnceLock::new();
    DONE.get_or_init(|| {
        if std::env::var_os("VK_DRIVER_FILES").is_some() || std::env::var_os("VK_ICD_FILENAMES").is_some() {
            return;
        }
        let both = drivers::both().unwrap_or_else(|message| panic!("{message}"));
        // SAFETY: every test comes through here before it opens an instance, and the others wait; nobody else in this
        // process reads or writes the environment meanwhile.
        unsafe { std::env::set_var("VK_DRIVER_FILES", both) };
    });
}

/// Runs `test` on every device with `options`, then wants the validation layer to have been silent.
fn on_every_device(options: Options, test: impl Fn(&VulkanDevice)) {
    install_drivers();
    let instance = Instance::open(true).expect("a Vulkan loader with the validation layer");
    let devices = instance.devices().expect("devices");
    assert!(!devices.is_empty(), "no driver has a device");
    for facts in &devices {
        let device = VulkanDevice::open_with(&instance, facts.index, options).expect("a device that opens");
        println!("{}: {} ({} {})", facts.index, facts.name, facts.driver, facts.driver_info);
        test(&device);
        drop(device);
        // The layer tells of objects that a destroyed device left behind; this, that it was destroyed.
        assert_eq!(instance.users(), 0, "something keeps the device open");
    }
    assert_eq!(instance.validation_messages(), Vec::<String>::new());
}

fn evaluate(device: &VulkanDevice, kernel: &Kernel, rows: &[f32]) -> impl Outputs + use<> {
    let program = device.program(kernel).expect("a program");
    let inputs = device.upload(rows, kernel.inputs).expect("inputs");
    let pending = device.submit(&program, &inputs).expect("a submission");
    device.wait(pending).expect("outputs")
}

const COUNTS: [usize; 5] = [1, 63, 64, 65, 1_000_003];

fn staged() -> Options {
    Options { force_staging: true, poison_outputs: true, ..Options::default() }
}

#[test]
fn both_drivers_are_here() {
    on_every_device(Options::default(), |device| {
        let facts: &Facts = device.facts();
        println!("{facts:#?}");
        assert!(facts.validation && facts.unified_memory && facts.kind == "cpu");
        assert!(
            facts.uuid.len() == 32 && facts.subgroup_size > 0 && facts.max_storage_buffer_range >= 1 << 27
        );
        assert!(device.max_rows(6, 8) >= 1 << 20 && device.max_rows(0, 0) >= 1);
        assert!(device.max_rows(usize::MAX, 1) == 1);
    });
    let instance = Instance::open(false).expect("a Vulkan loader");
    let facts = instance.devices().expect("devices");
    assert!(instance.validation_messages().is_empty() && !facts[0].validation);
    for device in &facts {
        assert_eq!(instance.choose(Some(&device.index.to_string())).expect("an index"), device.index);
        assert_eq!(instance.choose(Some(&device.name)).expect("a name"), device.index);
    }
    assert_eq!(instance.choose(None).expect("the first"), 0);
    assert!(matches!(
        VulkanDevice::open(&instance, facts.len()),
        Err(Error::UnknownDevice { known, .. }) if known.len() == facts.len()
    ));
}

/// Without this, silence in the other tests would prove nothing.
#[test]
fn validation_messages_are_heard() {
    install_drivers();
    let instance = Instance::open(true).expect("a Vulkan loader with the validation layer");
    let device = VulkanDevice::open(&instance, 0).expect("a device");
    // Twenty bytes of push constants where the layout has sixteen: wrong, and harmless to compile.
    let spirv =
        glsl::compile_with("uint first, count, stride, evaluations, more;", "o[k] = i[k] + float(more);");
    let kernel = Kernel {
        id: "test/greedy".to_owned(),
        spirv,
        inputs: 1,
        outputs: 1,
        tables: Vec::new(),
        traps: Vec::new(),
    };
    let _program = device.program(&kernel);
    let messages = instance.validation_messages();
    assert!(messages.iter().any(|message| message.contains("VUID")), "{messages:?}");
    // The name that the engine gave the module is in the message.
    assert!(messages.iter().any(|message| message.contains("test/greedy")), "{messages:?}");
}

#[test]
fn results_are_right_for_any_count() {
    let options = Options { poison_outputs: true, ..Options::default() };
    on_every_device(options, |device| {
        for count in COUNTS {
            let rows = rows(count);
            let outputs = evaluate(device, &arithmetic(), &rows);
            check_arithmetic(&rows, &outputs);
            assert_eq!(outputs.elapsed().clock, Clock::DeviceTimestamps);
            assert!(!outputs.elapsed().time.is_zero());
        }
    });
}

#[test]
fn staging_gives_the_same() {
    on_every_device(staged(), |device| {
        assert!(!device.facts().unified_memory);
        for count in COUNTS {
            let rows = rows(count);
            check_arithmetic(&rows, &evaluate(device, &arithmetic(), &rows));
        }
    });
}

#[test]
fn without_timestamps_the_host_takes_the_time() {
    let options = Options { ignore_timestamps: true, ..staged() };
    on_every_device(options, |device| {
        for count in COUNTS {
            let rows = rows(count);
            let outputs = evaluate(device, &arithmetic(), &rows);
            check_arithmetic(&rows, &outputs);
            assert_eq!(outputs.elapsed().clock, Clock::HostFence);
            assert!(!outputs.elapsed().time.is_zero());
        }
    });
}

#[test]
fn submissions_overlap_and_share_inputs() {
    for options in [Options::default(), staged()] {
        on_every_device(options, |device| {
            let program = device.program(&arithmetic()).expect("a program");
            let (first, second) = (rows(200_001), rows(100_000));
            let inputs = device.upload(&first, 3).expect("inputs");
            let a = device.submit(&program, &inputs).expect("a");
            let b = device.submit(&program, &inputs.clone()).expect("b");
            let others = device.upload(&second, 3).expect("inputs while others are in flight");
            let c = device.submit(&program, &others).expect("c");
            // Each submission keeps what it needs, whatever its maker drops.
            drop((inputs, others, program));
            check_arithmetic(&second, &device.wait(c).expect("c"));
            check_arithmetic(&first, &device.wait(a).expect("a"));
            check_arithmetic(&first, &device.wait(b).expect("b"));
        });
    }
}

#[test]
fn threads_share_a_device() {
    for options in [Options::default(), Options { ignore_timestamps: true, ..staged() }] {
        on_every_device(options, |device| {
            let program = device.program(&arithmetic()).expect("a program");
            std::thread::scope(|scope| {
                for thread in 0..4 {
                    let program = &program;
                    scope.spawn(move || {
                        for round in 0..6 {
                            let rows = rows(1000 * (thread + 1) + 7 * round);
                            let inputs = device.upload(&rows, 3).expect("inputs");
                            let pending = device.submit(program, &inputs).expect("a submission");
                            check_arithmetic(&rows, &device.wait(pending).expect("outputs"));
                        }
                    });
                }
            });
        });
    }
}

#[test]
fn a_dropped_submission_is_waited_for() {
    for options in [Options::default(), staged()] {
        on_every_device(options, |device| {
            let program = device.program(&kernel("test/slow", SLOW, 3, 1)).expect("a program");
            let inputs = device.upload(&rows(300_000), 3).expect("inputs");
            for _ in 0..3 {
                drop(device.submit(&program, &inputs).expect("a submission"));
            }
            // Uploaded and never used.
            drop(device.upload(&rows(1000), 3).expect("inputs"));
        });
    }
}

#[test]
fn a_long_evaluation_is_split_and_complete() {
    let options = Options { poison_outputs: true, ..Options::default() };
    on_every_device(options, |device| {
        let program = device.program(&kernel("test/slow", SLOW, 3, 1)).expect("a program");
        let rows = rows(700_001);
        let inputs = device.upload(&rows, 3).expect("inputs");
        for _ in 0..2 {
            let outputs =
                device.wait(device.submit(&program, &inputs).expect("a submission")).expect("outputs");
            // The iteration has converged to 2 long before its end; the sum is then rounded once.
            for (index, (&got, row)) in outputs.column(0).iter().zip(rows.chunks_exact(3)).enumerate() {
                assert_eq!(got, 2.0 + row[0], "row {index}");
            }
        }
    });
}

#[test]
fn outputs_outlive_their_device() {
    install_drivers();
    let instance = Instance::open(true).expect("a Vulkan loader with the validation layer");
    let rows = rows(5000);
    let outputs = {
        let device = VulkanDevice::open(&instance, 0).expect("a device");
        evaluate(&device, &arithmetic(), &rows)
    };
    check_arithmetic(&rows, &outputs);
    drop(outputs);
    assert_eq!(instance.validation_messages(), Vec::<String>::new());
}

#[test]
fn buffers_are_recycled() {
    for (options, buffers) in [(Options::default(), 2), (staged(), 4)] {
        on_every_device(options, |device| {
            let rows = rows(4096);
            let program = device.program(&arithmetic()).expect("a program");
            for round in 0..10 {
                let inputs = device.upload(&rows, 3).expect("inputs");
                let pending = device.submit(&program, &inputs).expect("a submission");
                check_arithmetic(&rows, &device.wait(pending).expect("outputs"));
                let usage = device.buffer_usage();
                assert!(usage.created <= buffers, "round {round}: {usage:?}");
            }
            assert!(device.buffer_usage().recycled >= 9 * (buffers - 1), "{:?}", device.buffer_usage());
        });
    }
}

/// A timing loop gets its count, whatever the dispatches it is split in.
#[test]
fn a_loop_runs_as_often_as_it_is_told() {
    for options in [Options::default(), staged(), Options { ignore_timestamps: true, ..Options::default() }] {
        on_every_device(options, |device| {
            let spirv = glsl::compile_with(
                "uint first, count, stride, evaluations;",
                "float x = i[k]; for (uint n = 0; n < evaluations; ++n) x += 1.0; o[k] = x;",
            );
            let kernel = Kernel {
                id: "test/loop".to_owned(),
                spirv,
                inputs: 3,
                outputs: 1,
                tables: Vec::new(),
                traps: Vec::new(),
            };
            let once = device.program(&kernel).expect("a program");
            let often = device.repeating(&once, 100).expect("a device that loops");
            let rows: Vec<f32> = (0..3 * 20_000).map(|value| value as f32).collect();
            let inputs = device.upload(&rows, 3).expect("inputs");
            for (program, added) in [(&once, 1.0), (&often, 100.0), (&often, 100.0)] {
                let outputs =
                    device.wait(device.submit(program, &inputs).expect("a submission")).expect("outputs");
                for (row, value) in outputs.column(0).iter().enumerate() {
                    assert_eq!(*value, rows[3 * row] + added, "row {row}");
                }
            }
        });
    }
}

#[test]
fn unwritten_rows_show_as_poison() {
    let options = Options { poison_outputs: true, ..Options::default() };
    on_every_device(options, |device| {
        let kernel = kernel("test/half", "if (k % 2 == 0) o[k] = i[k];", 3, 1);
        let rows = rows(3000);
        for _ in 0..2 {
            let outputs = evaluate(device, &kernel, &rows);
            for (index, value) in outputs.column(0).iter().enumerate() {
                assert_eq!(value.is_nan(), index % 2 == 1, "row {index} is {value}");
            }
        }
    });
}

#[test]
fn no_rows_give_empty_columns() {
    for options in [Options::default(), staged()] {
        on_every_device(options, |device| {
            let outputs = evaluate(device, &arithmetic(), &[]);
            assert!(outputs.column(0).is_empty() && outputs.column(2).is_empty());
            assert!(outputs.elapsed().time.is_zero());
        });
    }
}

#[test]
fn what_a_device_lacks_is_said_and_what_it_has_works() {
    on_every_device(Options::default(), |device| {
        let kernel = kernel("test/double", "o[k] = float(double(i[k]) * 3.0LF);", 3, 1);
        match device.program(&kernel) {
            Ok(_) => {
                assert!(device.facts().shader_float64);
                let rows = rows(100);
                let outputs = evaluate(device, &kernel, &rows);
                for (&got, row) in outputs.column(0).iter().zip(rows.chunks_exact(3)) {
                    assert_eq!(got, (f64::from(row[0]) * 3.0) as f32);
                }
            }
            Err(Error::NotSupported { kernel, what }) => {
                assert!(!device.facts().shader_float64);
                assert_eq!(kernel, "test/double");
                assert!(what.contains("Float64"), "{what}");
            }
            Err(other) => panic!("{other}"),
        }
    });
}

#[test]
fn misuse_is_an_error() {
    on_every_device(Options::default(), |device| {
        let program = device.program(&arithmetic()).expect("a program");
        assert!(matches!(device.upload(&[0.0; 7], 3), Err(Error::Shape(_))));
        assert!(matches!(device.upload(&[0.0; 7], 0), Err(Error::Shape(_))));
        let inputs = device.upload(&[0.0; 8], 2).expect("inputs");
        assert!(matches!(device.submit(&program, &inputs), Err(Error::Shape(_))));
        // More outputs than fit beside inputs that do.
        let wide = Kernel { outputs: 1 << 28, ..arithmetic() };
        let program = device.program(&wide).expect("a program");
        let inputs = device.upload(&[0.0; 300], 3).expect("inputs");
        assert!(matches!(device.submit(&program, &inputs), Err(Error::Shape(_))));
        let broken = Kernel { spirv: vec![1, 2, 3], ..arithmetic() };
        assert!(matches!(device.program(&broken), Err(Error::InvalidKernel { .. })));
        let again = Instance::open(false).expect("a Vulkan loader");
        let other = VulkanDevice::open(&again, device.facts().index).expect("a device");
        let foreign = other.program(&arithmetic()).expect("a program");
        assert!(matches!(device.submit(&foreign, &inputs), Err(Error::Shape(_))));
        let nothing = Kernel { outputs: 0, ..arithmetic() };
        assert!(matches!(device.program(&nothing), Err(Error::InvalidKernel { .. })));
    });
}

/// A kernel that reads the 64 x 64 table `sphere_lut`, here with texels of the test's own, in the form given.
fn table_kernel(form: &str, body: &str, texels: Vec<f32>) -> Kernel {
    let text = format!(
        "/*---\nsummary = \"test\"\nsource = \"ours\"\n[[variant]]\nname = \"{form}\"\n\
         tables = {{ sphere_lut = \"{form}\" }}\n---*/\nfloat look(vec2 at) {{ return {body}; }}"
    );
    let signature = Signature {
        function: "look",
        parameters: vec![Field::new("at", Type::Vec2)],
        results: vec![Field::new("texel", Type::Float)],
    };
    let variants = Variant::parse("look", "look/test.comp", &text).expect("a variant");
    let mut kernel = variants[0].compile(&signature, false).expect("a kernel").kernel;
    assert_eq!(kernel.tables.len(), 1);
    kernel.tables[0].texels = texels.into();
    kernel
}

const SAMPLED: &str = "textureLod(sphere_lut, at, 0.0).x";
const SIDE: usize = 64;

/// Texels that say where they are and lie within 1.
fn numbered_texels() -> Vec<f32> {
    (0..SIDE * SIDE).map(|texel| ((texel * 2_654_435_761) % 65_521) as f32 / 65_536.0).collect()
}

#[test]
fn texels_of_a_buffer_are_exact() {
    for options in [Options::default(), staged()] {
        on_every_device(options, |device| {
            let texels = numbered_texels();
            let kernel = table_kernel("buffer", "sphere_lut_texel(ivec2(at))", texels.clone());
            // Also beyond every edge, where the nearest texel is meant.
            let rows: Vec<f32> =
                (-3..67).flat_map(|y| (-3..67).flat_map(move |x| [x as f32, y as f32])).collect();
            let outputs = evaluate(device, &kernel, &rows);
            for (&got, at) in outputs.column(0).iter().zip(rows.chunks_exact(2)) {
                let [x, y] = [at[0], at[1]].map(|coordinate| coordinate.clamp(0.0, 63.0) as usize);
                assert_eq!(got.to_bits(), texels[y * SIDE + x].to_bits(), "{at:?}");
            }
        });
    }
}

/// The largest error of the filter's weights, measured where one column of texels meets another of 1 instead of 0.
fn weight_error(device: &VulkanDevice) -> f64 {
    let edge = |texel: usize| if texel % SIDE >= 32 { 1.0 } else { 0.0 };
    let kernel = table_kernel("image", SAMPLED, (0..SIDE * SIDE).map(edge).collect());
    // Between the centres of texels 31 and 32; the coordinate's own rounding in f32 is 64 * 2^-25 of a texel.
    let steps = 1 << 16;
    let weight = |step: usize| step as f32 / steps as f32;
    let rows: Vec<f32> =
        (0..steps).flat_map(|step| [(31.5 + weight(step)) / SIDE as f32, 0.5 + 0.5 / SIDE as f32]).collect();
    let outputs = evaluate(device, &kernel, &rows);
    let errors =
        outputs.column(0).iter().enumerate().map(|(step, got)| f64::from((got - weight(step)).abs()));
    errors.fold(0.0, f64::max)
}

#[test]
fn a_sampled_image_is_bilinear() {
    for half_images in [false, true] {
        on_every_device(Options { half_images, ..Options::default() }, |device| {
            let bits = device.facts().table_image_bits;
            assert!(bits == 32 && !half_images || bits == 16, "{bits}");
            let weight_error = weight_error(device);
            match weight_error {
                0.0 => println!("{bits}-bit texels, filter weights exact to 16 bits"),
                error => println!("{bits}-bit texels, filter weights good to {:.2} bits", -error.log2()),
            }
            // The least that Vulkan lets a device have (subTexelPrecisionBits), rounded either way.
            assert!(weight_error <= 1.0 / 16.0, "{weight_error}");

            let texels = numbered_texels();
            let rounded: Vec<f64> = match bits {
                32 => texels.iter().map(|texel| f64::from(*texel)).collect(),
                _ => texels
                    .iter()
                    .map(|texel| f64::from(binary16::to_f32(binary16::from_f32(*texel))))
                    .collect(),
            };
            let kernel = table_kernel("image", SAMPLED, texels);
            // A lattice that meets no texel twice at the same weights, and reaches beyond every edge.
            let rows: Vec<f32> = (0..100_000)
                .flat_map(|row| {
                    let along = |step: f64| ((f64::from(row) * step).fract() * 1.2 - 0.1) as f32;
                    [along(0.618_033_988_749_895), along(0.754_877_666_246_693)]
                })
                .collect();
            let outputs = evaluate(device, &kernel, &rows);
            // Both directions' weights may be off, over texels that differ by at most 1; the coordinate's and the
            // filter's own rounding is below 2^-16 (a half's, should the filter work in them: 2^-10).
            let allowed = 2.0 * weight_error + if bits == 32 { 2f64.powi(-16) } else { 2f64.powi(-10) };
            let mut worst: f64 = 0.0;
            for (&got, at) in outputs.column(0).iter().zip(rows.chunks_exact(2)) {
                let [x, y] = [at[0], at[1]].map(|c| (f64::from(c) * SIDE as f64 - 0.5).clamp(0.0, 63.0));
                let texel = |dx: usize, dy: usize| {
                    rounded[(y as usize + dy).min(63) * SIDE + (x as usize + dx).min(63)]
                };
                let along = |dy| texel(0, dy) * (1.0 - x.fract()) + texel(1, dy) * x.fract();
                let expected = along(0) * (1.0 - y.fract()) + along(1) * y.fract();
                worst = worst.max((f64::from(got) - expected).abs());
            }
            println!("worst difference from bilinear: {worst:e}");
            assert!(worst <= allowed, "{worst:e} > {allowed:e}");
        });
    }
}

/// A buffer and an image of four channels beside each other, neither square nor of an even number of texels.
#[test]
fn tables_of_four_channels_keep_their_order() {
    for options in [Options::default(), staged(), Options { half_images: true, ..staged() }] {
        on_every_device(options, |device| {
            let (width, height) = (5, 3);
            // Whole numbers below 2048: exact as halves too.
            let texels: Arc<[f32]> = (0..width * height * 4).map(|value| value as f32).collect();
            let table = |name, binding, form| TableBinding {
                name,
                binding,
                form,
                width,
                height,
                channels: 4,
                texels: Arc::clone(&texels),
            };
            let spirv = glsl::compile_reading(
                "layout(std430, set = 1, binding = 2) readonly buffer Texels { vec4 texels[]; };
                layout(set = 1, binding = 3) uniform sampler2D image;",
                "vec2 at = vec2(i[k], i[stride + k]);
                vec4 a = texels[int(at.y) * 5 + int(at.x)];
                vec4 b = textureLod(image, (at + 0.5) / vec2(5.0, 3.0), 0.0);
                for (int c = 0; c < 4; ++c) { o[c * stride + k] = a[c]; o[(c + 4) * stride + k] = b[c]; }",
            );
            let tables = vec![table("texels", 2, TableForm::Buffer), table("image", 3, TableForm::Image)];
            let kernel = Kernel {
                id: "test/tables".to_owned(),
                spirv,
                inputs: 2,
                outputs: 8,
                tables,
                traps: Vec::new(),
            };
            let rows: Vec<f32> =
                (0..height).flat_map(|y| (0..width).flat_map(move |x| [x as f32, y as f32])).collect();
            let outputs = evaluate(device, &kernel, &rows);
            for (texel, expected) in texels.chunks_exact(4).enumerate() {
                for (channel, expected) in expected.iter().enumerate() {
                    assert_eq!(outputs.column(channel)[texel], *expected);
                    // The centre's coordinate is rounded: a weight of 2^-20 for neighbours that differ by up to 20.
                    let sampled = outputs.column(channel + 4)[texel];
                    assert!((sampled - expected).abs() < 1e-4, "{sampled} for {expected}");
                }
            }
        });
    }
}

#[test]
fn a_table_of_the_wrong_size_is_an_error() {
    on_every_device(Options::default(), |device| {
        for form in ["buffer", "image"] {
            let body = if form == "buffer" { "sphere_lut_texel(ivec2(at))" } else { SAMPLED };
            let kernel = table_kernel(form, body, vec![0.0; 100]);
            assert!(matches!(device.program(&kernel), Err(Error::InvalidKernel { .. })));
            let mut huge = table_kernel(form, body, vec![0.0; 1 << 14]);
            (huge.tables[0].width, huge.tables[0].height) = (1 << 14, 1);
            match device.program(&huge) {
                Ok(_) => assert_eq!(form, "buffer"),
                Err(Error::NotSupported { .. }) => assert_eq!(form, "image"),
                Err(other) => panic!("{other}"),
            }
        }
    });
}

/// What the loader finds depends on the environment, so these run in processes of their own.
#[test]
fn a_machine_without_drivers_or_layer_is_told_so() {
    const CASE: &str = "ROOTQ_TEST_MISSING";
    match std::env::var(CASE).as_deref() {
        Ok("driver") => assert!(matches!(no_instance(false), Error::NoDevice)),
        Ok("layer") => assert!(matches!(no_instance(true), Error::NoValidationLayer)),
        _ => {
            for (case, variable) in [("driver", "VK_DRIVER_FILES"), ("layer", "VK_LAYER_PATH")] {
                let status = Command::new(std::env::current_exe().expect("this test's program"))
                    .args(["--exact", "a_machine_without_drivers_or_layer_is_told_so"])
                    .env(CASE, case)
                    .env(variable, "/nowhere")
                    .status()
                    .expect("a process");
                assert!(status.success(), "without a {case}");
            }
        }
    }
}

/// Why there is nothing to work with here.
fn no_instance(validation: bool) -> Error {
    match Instance::open(validation) {
        Err(error) => error,
        Ok(instance) => instance.choose(None).expect_err("a device"),
    }
}
