//! What the host does for every configuration: draw it, find its truth, judge a variant's answer.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rootq::audit::{Chunk, measure};
use rootq::family::{FAMILIES, Truth};
use rootq::numeric::spacing::f32_spacing;

const ROWS: usize = 1 << 14;

fn oracles(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("oracle");
    group.throughput(Throughput::Elements(ROWS as u64));
    for problem in FAMILIES {
        let width = problem.signature().input_columns().len();
        for scenario in problem.scenarios() {
            let chunk = Chunk::draw(*problem, scenario, 1, 0, ROWS);
            group.bench_function(format!("{}/{}", problem.name(), scenario.name), |bencher| {
                let mut truth = Truth::new(problem.outputs());
                bencher.iter(|| {
                    for row in chunk.inputs().chunks_exact(width) {
                        truth.clear();
                        problem.oracle(black_box(row), &mut truth);
                    }
                    black_box(&truth);
                });
            });
        }
    }
    group.finish();
}

fn draws(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("draw and oracle, all threads");
    group.throughput(Throughput::Elements(1 << 18));
    for problem in FAMILIES {
        let scenario = &problem.scenarios()[0];
        group.bench_function(problem.name(), |bencher| {
            bencher.iter(|| Chunk::draw(*problem, scenario, 1, 0, 1 << 18));
        });
    }
    group.finish();
}

fn judging(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("judge");
    let problem = FAMILIES[0];
    let output = problem.outputs().last().expect("a family has outputs");
    let truths: Vec<f64> = (0..1024).map(|k| 1.0 + f64::from(k) * 1e-3).collect();
    group.throughput(Throughput::Elements(1024));
    group.bench_function("measure", |bencher| {
        bencher.iter(|| {
            truths.iter().map(|truth| measure(output, &[*truth as f32], &[*truth], 1.0).ulp).sum::<f64>()
        });
    });
    group.bench_function("f32 spacing", |bencher| {
        bencher.iter(|| truths.iter().map(|truth| f32_spacing(black_box(*truth))).sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, oracles, draws, judging);
criterion_main!(benches);
