use rootq::audit::Chunk;
use rootq::family::{CERTIFIED, FAMILIES, Truth};
use std::io::Write;
// dump family scenario n [uncertified|csv|time]
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let p = *FAMILIES.iter().find(|p| p.name() == a[1]).unwrap();
    let n: usize = a[3].parse().unwrap();
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    let w = p.signature().input_columns().len();
    if a[4] == "head" { writeln!(out, "{}", p.signature().input_columns().join(",")).unwrap(); }
    for s in p.scenarios().iter().filter(|s| a[2] == "all" || s.name == a[2]) {
        let seed: u64 = a.get(5).map_or(1, |s| s.parse().unwrap());
        let chunk = Chunk::draw(p, s, seed, 0, n);
        let rows = chunk.inputs();
        if a[4] == "time" {
            let mut best = f64::INFINITY;
            let mut truth = Truth::new(p.outputs());
            for _ in 0..5 {
                let t = std::time::Instant::now();
                for row in rows.chunks_exact(w) { truth.clear(); p.oracle(row, &mut truth); std::hint::black_box(&truth); }
                best = best.min(t.elapsed().as_secs_f64() / n as f64);
            }
            writeln!(out, "{} {} {:.3} us", p.name(), s.name, best * 1e6).unwrap();
            continue;
        }
        for (i, row) in rows.chunks_exact(w).enumerate() {
            let mut truth = Truth::new(p.outputs());
            truth.clear();
            p.oracle(row, &mut truth);
            let v = truth.values()[0];
            if a[4] == "uncertified" && truth.worst_bound() <= CERTIFIED { continue; }
            let cols: Vec<String> = row.iter().map(|x| format!("{:?}", x)).collect();
            if a[4] == "head" { writeln!(out, "{}", cols.join(",")).unwrap(); continue; }
            writeln!(out, "{},{:e},{:e},{:e},{}", cols.join(","), v, truth.sensitivities()[0] * 2f64.powi(-22), truth.worst_bound(), i).unwrap();
        }
    }
}
