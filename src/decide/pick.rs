//! Which variant of a family to ship: the measured front of accuracy against cost, and the choice on it.

use serde::Serialize;

use super::Quantile;
use crate::audit::Verdict;
use crate::bench::{Setting, rate_interval};
use crate::record::{Rate, Recorded, Result, Run};

/// What the chosen variant must keep on every device and in every scenario that counts.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Of every output in its own measure, at `quantile`.
    pub max_error: Option<f64>,
    pub quantile: Quantile,
    /// Share of configurations wrong by the variant's own fault.
    pub max_failed: Option<f64>,
    pub no_non_finite: bool,
    /// Scenarios that count; all if empty.
    pub scenarios: Vec<String>,
    /// The times that count.
    pub setting: Setting,
}

/// A device and where its figures come from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Seen {
    pub device: String,
    pub path: String,
}

/// A figure and where it was seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct At<T> {
    #[serde(flatten)]
    pub value: T,
    pub scenario: String,
    pub device: String,
}

/// An error, infinite where results are not finite (`null` in JSON).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Error {
    pub error: f64,
}

/// A variant and its figures over all devices and scenarios that count.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidate {
    pub variant: String,
    /// Over all of them together.
    pub failed: Rate,
    /// Where most failed.
    pub worst_failed: At<Rate>,
    /// Where most were not finite.
    pub worst_non_finite: At<Rate>,
    /// The largest error of any output at the chosen quantile, and where.
    pub worst_error: At<Error>,
    /// Time over the fastest variant's, the geometric mean over devices; absent where a time is missing.
    pub cost: Option<f64>,
    /// Nanoseconds a configuration, one a device.
    pub ns: Vec<Option<f64>>,
    /// No other variant is at least as good in failures, error and time, and better in one of them.
    pub on_front: bool,
    /// Which constraints it breaks, in words.
    pub breaks: Vec<String>,
    /// Why it was not chosen; empty for the chosen one.
    pub lost: String,
}

/// The outcome.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Choice {
    pub family: String,
    pub devices: Vec<Seen>,
    /// Those that count, and those that do not because some run lacks them.
    pub scenarios: Vec<String>,
    pub left_out: Vec<String>,
    /// The scenario on which the times were taken, one a device.
    pub timed_on: Vec<Option<String>>,
    pub quantile: Quantile,
    pub setting: Setting,
    /// Times closer than this share are not told apart; from [`USELESS`] on none are, and accuracy alone decides.
    pub noise: f64,
    /// The best first: those that break no constraint by fewest failures and then time (by time alone, if a limit on
    /// failures or errors was given), then the rest.
    pub candidates: Vec<Candidate>,
    /// Whether the first of the candidates keeps every constraint.
    pub found: bool,
    /// Why, in words.
    pub reason: String,
}

/// Picks among the variants of `family` in runs of one or several devices, one run a device.
///
/// # Errors
/// In words, if the runs hold no audit of the family in the scenarios asked for.
pub fn pick(
    family: &str,
    runs: &[&Recorded],
    constraints: &Constraints,
) -> std::result::Result<Choice, String> {
    let found: Vec<(&Run, &crate::record::Family)> = runs
        .iter()
        .filter_map(|recorded| {
            let found = recorded.run.families.iter().find(|recorded| recorded.name == family)?;
            Some((&recorded.run, found))
        })
        .collect();
    if found.len() != runs.len() || found.is_empty() {
        return Err(format!("no audit of {family} in {} of {} runs", runs.len() - found.len(), runs.len()));
    }
    for (position, run) in runs.iter().enumerate() {
        let device = |run: &Recorded| (run.run.device.uuid.clone(), run.run.device.name.clone());
        if let Some(twin) = runs[..position].iter().find(|twin| device(twin) == device(run)) {
            let (name, paths) = (&run.run.device.name, [twin.path.display(), run.path.display()]);
            return Err(format!("{} and {} are both of {name}; name one run a device", paths[0], paths[1]));
        }
    }
    let wanted =
        |name: &str| constraints.scenarios.is_empty() || constraints.scenarios.iter().any(|s| s == name);
    let audited = |family: &crate::record::Family, name: &str| {
        let mut results = family.variants.iter().flat_map(|variant| &variant.results);
        results.any(|result| result.scenario == name && result.audit.is_some())
    };
    // What counts is audited in every run.
    let (mut scenarios, mut left_out) = (Vec::<String>::new(), Vec::<String>::new());
    for scenario in found.iter().flat_map(|(_, family)| &family.scenarios).filter(|s| wanted(&s.name)) {
        let everywhere = found.iter().all(|(_, family)| audited(family, &scenario.name));
        let list = if everywhere { &mut scenarios } else { &mut left_out };
        if !list.contains(&scenario.name) {
            list.push(scenario.name.clone());
        }
    }
    for name in &constraints.scenarios {
        if !scenarios.contains(name) {
            return Err(format!("scenario '{name}' of {family} is not audited in every run"));
        }
    }
    if scenarios.is_empty() {
        return Err(format!(
            "no scenario of {family} is audited in every run; 'rootq run {family}' audits all"
        ));
    }
    let names: std::collections::BTreeSet<&str> =
        found.iter().flat_map(|(_, family)| &family.variants).map(|variant| variant.name.as_str()).collect();
    let timed_on: Vec<Option<String>> =
        found.iter().map(|(_, family)| timed_on(family, &scenarios, constraints.setting)).collect();
    let noise = noise(&found, &timed_on, constraints.setting);
    let told_apart = if noise < USELESS { noise } else { f64::INFINITY };

    let mut candidates: Vec<Candidate> = names
        .into_iter()
        .filter_map(|name| candidate(name, &found, &scenarios, &timed_on, constraints))
        .collect();
    if candidates.is_empty() {
        return Err(format!("no audit of {family} in these runs; 'rootq run {family}' makes one"));
    }
    set_costs(&mut candidates);
    for position in 0..candidates.len() {
        let dominated = candidates.iter().any(|other| dominates(other, &candidates[position], told_apart));
        candidates[position].on_front = !dominated;
    }
    let limited = constraints.max_error.is_some() || constraints.max_failed.is_some();
    sort(&mut candidates, limited, told_apart);
    let found_one = candidates[0].breaks.is_empty();
    let (chosen, others) = candidates.split_at_mut(1);
    for other in others {
        other.lost = lost(other, &chosen[0], found_one, told_apart);
    }
    let reason = reason(&candidates, &scenarios, runs.len(), found_one, limited, noise);
    Ok(Choice {
        family: family.to_owned(),
        devices: runs
            .iter()
            .map(|run| Seen { device: run.run.device.name.clone(), path: run.path.display().to_string() })
            .collect(),
        scenarios,
        left_out,
        timed_on,
        quantile: constraints.quantile,
        setting: constraints.setting,
        noise,
        candidates,
        found: found_one,
        reason,
    })
}

/// With this much noise times decide nothing.
pub const USELESS: f64 = 0.25;

/// The scenario whose times count in a run: of those that count the first with times, or the first at all.
fn timed_on(family: &crate::record::Family, scenarios: &[String], setting: Setting) -> Option<String> {
    let mut timed: Vec<&String> = Vec::new();
    for scenario in &family.scenarios {
        let mut results = family.variants.iter().flat_map(|variant| &variant.results);
        if results.any(|result| result.scenario == scenario.name && result.timing_in(setting).is_some()) {
            timed.push(&scenario.name);
        }
    }
    let counted = timed.iter().find(|name| scenarios.contains(name));
    counted.or(timed.first()).map(|name| (*name).clone())
}

/// The largest noise of the rankings whose times count; two per cent where none is recorded.
fn noise(found: &[(&Run, &crate::record::Family)], timed_on: &[Option<String>], setting: Setting) -> f64 {
    let rankings = found.iter().zip(timed_on).filter_map(|((_, family), on)| {
        family.scenarios.iter().find(|scenario| Some(&scenario.name) == on.as_ref())?.ranking(setting)
    });
    rankings.map(|ranking| ranking.noise).reduce(f64::max).unwrap_or(0.02)
}

fn candidate(
    name: &str,
    found: &[(&Run, &crate::record::Family)],
    scenarios: &[String],
    timed_on: &[Option<String>],
    constraints: &Constraints,
) -> Option<Candidate> {
    let mut breaks = Vec::new();
    let (mut failed, mut total) = (0, 0);
    let mut worst_failed: Option<At<Rate>> = None;
    let mut worst_non_finite: Option<At<Rate>> = None;
    let mut worst_error: Option<At<Error>> = None;
    let mut ns = Vec::new();
    for ((run, family), timed_on) in found.iter().zip(timed_on) {
        let device = &run.device.name;
        let variant = family.variants.iter().find(|variant| variant.name == name);
        let results: &[Result] = variant.map_or(&[], |variant| &variant.results);
        if results.is_empty() {
            let why = variant
                .and_then(|variant| variant.skipped.clone())
                .unwrap_or_else(|| "not in the run".to_owned());
            breaks.push(format!("{why} ({device})"));
        }
        for scenario in scenarios.iter().filter(|_| !results.is_empty()) {
            if !results.iter().any(|result| result.scenario == *scenario && result.audit.is_some()) {
                breaks.push(format!("is not audited in {scenario} ({device})"));
            }
        }
        for result in results.iter().filter(|result| scenarios.contains(&result.scenario)) {
            let Some(audit) = &result.audit else { continue };
            failed += audit.failed.count;
            total += audit.configurations;
            let at = |rate| At { value: rate, scenario: result.scenario.clone(), device: device.clone() };
            raise(&mut worst_failed, at(audit.failed), |at| at.value.rate);
            raise(&mut worst_non_finite, at(audit.verdict(Verdict::NonFinite)), |at| at.value.rate);
            for output in &audit.outputs {
                let error = Error { error: constraints.quantile.of_error(audit, output) };
                let at = At { value: error, scenario: result.scenario.clone(), device: device.clone() };
                raise(&mut worst_error, at, |at| at.value.error);
            }
        }
        let on = |result: &&Result| Some(&result.scenario) == timed_on.as_ref();
        let time = results.iter().find(on).and_then(|result| result.timing_in(constraints.setting));
        ns.push(time.map(|time| time.ns.median));
    }
    let (worst_failed, worst_non_finite, worst_error) = (worst_failed?, worst_non_finite?, worst_error?);
    if constraints.no_non_finite && worst_non_finite.value.count > 0 {
        breaks.push(format!("is NaN or infinite in {}", told(&worst_non_finite)));
    }
    if let Some(limit) = constraints.max_failed.filter(|limit| worst_failed.value.rate > *limit) {
        breaks.push(format!("fails more than {limit:e}: {}", told(&worst_failed)));
    }
    if let Some(limit) = constraints.max_error.filter(|limit| !(worst_error.value.error <= *limit)) {
        let At { value, scenario, device } = &worst_error;
        let word = constraints.quantile.name();
        breaks.push(format!("{word} error {:.2e} in {scenario} ({device}) is above {limit:e}", value.error));
    }
    let (low, high) = rate_interval(failed, total);
    let failed = Rate { count: failed, rate: failed as f64 / total.max(1) as f64, low, high };
    Some(Candidate {
        variant: name.to_owned(),
        failed,
        worst_failed,
        worst_non_finite,
        worst_error,
        cost: None,
        ns,
        on_front: false,
        breaks,
        lost: String::new(),
    })
}

fn raise<T>(worst: &mut Option<At<T>>, at: At<T>, key: fn(&At<T>) -> f64) {
    if worst.as_ref().is_none_or(|worst| key(&at) > key(worst)) {
        *worst = Some(at);
    }
}

fn told(at: &At<Rate>) -> String {
    format!("{} of {} ({})", percent(at.value.rate), at.scenario, at.device)
}

fn percent(rate: f64) -> String {
    if rate == 0.0 { "none".to_owned() } else { format!("{:.3} %", 100.0 * rate) }
}

/// Costs relative to the fastest of all on each device.
fn set_costs(candidates: &mut [Candidate]) {
    let devices = candidates[0].ns.len();
    let fastest: Vec<Option<f64>> = (0..devices)
        .map(|device| candidates.iter().filter_map(|candidate| candidate.ns[device]).reduce(f64::min))
        .collect();
    for candidate in candidates {
        let logs: Option<Vec<f64>> = candidate
            .ns
            .iter()
            .zip(&fastest)
            .map(|(ns, fastest)| Some(f64::ln((*ns)? / (*fastest)?)))
            .collect();
        candidate.cost = logs.map(|logs| f64::exp(logs.iter().sum::<f64>() / logs.len() as f64));
    }
}

/// Whether rates differ beyond their intervals.
fn fewer(a: &Rate, b: &Rate) -> bool {
    a.high < b.low
}

fn dominates(a: &Candidate, b: &Candidate, noise: f64) -> bool {
    // A bucket of the histogram is a quarter wide.
    const CLEARLY: f64 = 1.25;
    let costs = a.cost.zip(b.cost);
    let no_slower = noise.is_infinite() || costs.is_none_or(|(a, b)| a <= b);
    let no_worse = a.failed.rate <= b.failed.rate && a.worst_error.value.error <= b.worst_error.value.error;
    let faster = costs.is_some_and(|(a, b)| a * (1.0 + noise) < b);
    let better =
        fewer(&a.failed, &b.failed) || a.worst_error.value.error * CLEARLY < b.worst_error.value.error;
    no_slower && no_worse && (faster || better)
}

/// The best first. Where nothing limits failures and errors, the fewest failures count before time: those that cannot be
/// told from the fewest are equals.
fn sort(candidates: &mut [Candidate], limited: bool, noise: f64) {
    let fewest = candidates
        .iter()
        .filter(|candidate| candidate.breaks.is_empty())
        .map(|candidate| candidate.failed)
        .reduce(|a, b| if b.rate < a.rate { b } else { a });
    let class = |candidate: &Candidate| {
        let more = fewest.is_some_and(|fewest| fewer(&fewest, &candidate.failed));
        (!candidate.breaks.is_empty(), !limited && more)
    };
    let cost = |candidate: &Candidate| candidate.cost.unwrap_or(f64::INFINITY);
    candidates.sort_by(|a, b| {
        let by_failures =
            if class(a).1 { a.failed.rate.total_cmp(&b.failed.rate) } else { std::cmp::Ordering::Equal };
        class(a).cmp(&class(b)).then(by_failures).then(cost(a).total_cmp(&cost(b)))
    });
    // Within the noise of the fastest of the first class, the most accurate leads.
    let first = class(&candidates[0]);
    let limit = cost(&candidates[0]) * (1.0 + noise);
    let near = candidates
        .iter()
        .take_while(|c| class(c) == first && (cost(c) <= limit || cost(c).is_infinite()))
        .count();
    candidates[..near].sort_by(|a, b| {
        let key = |c: &Candidate| (c.failed.rate, c.worst_error.value.error, cost(c));
        let ((fa, ea, ca), (fb, eb, cb)) = (key(a), key(b));
        fa.total_cmp(&fb).then(ea.total_cmp(&eb)).then(ca.total_cmp(&cb))
    });
}

/// Why `other` was not chosen.
fn lost(other: &Candidate, chosen: &Candidate, found: bool, noise: f64) -> String {
    if !other.breaks.is_empty() {
        return other.breaks.join("; ");
    }
    debug_assert!(found, "what breaks nothing comes before what breaks something");
    let mut lacks = Vec::new();
    if other.worst_non_finite.value.count > chosen.worst_non_finite.value.count {
        lacks.push(format!("is NaN or infinite in {}", told(&other.worst_non_finite)));
    }
    if fewer(&chosen.failed, &other.failed) {
        lacks.push(format!(
            "fails {} of all, most {}",
            percent(other.failed.rate),
            told(&other.worst_failed)
        ));
    }
    match chosen.cost.zip(other.cost) {
        Some((chosen, other)) if other > chosen * (1.0 + noise) => {
            lacks.push(format!("takes {:.2} times the time", other / chosen));
        }
        _ if other.cost.is_none() && chosen.cost.is_some() => lacks.push("has no time".to_owned()),
        _ => {}
    }
    let error = [other, chosen].map(|candidate| candidate.worst_error.value.error);
    if lacks.is_empty() && error[0] > error[1] {
        lacks.push(format!("has a largest error of {:.1e} against {:.1e}", error[0], error[1]));
    }
    if lacks.is_empty() {
        lacks.push("is no better in failures, time or error, within the noise".to_owned());
    }
    lacks.join("; ")
}

fn reason(
    candidates: &[Candidate],
    scenarios: &[String],
    devices: usize,
    found: bool,
    limited: bool,
    noise: f64,
) -> String {
    let Candidate { variant, failed, worst_non_finite, worst_failed, .. } = &candidates[0];
    if !found {
        let nearest = candidates[0].breaks.join("; ");
        return format!("no variant keeps the constraints; {variant} comes nearest but for: {nearest}");
    }
    let keeping = candidates.iter().filter(|candidate| candidate.breaks.is_empty()).count();
    let finite = match worst_non_finite.value.count {
        0 => "no NaN or infinity".to_owned(),
        _ => format!("NaN or infinite at most {}", told(worst_non_finite)),
    };
    let failures = match failed.count {
        0 => format!("no failure, so with 95 % confidence at most {:.0e} of all", failed.high),
        count => format!("{count} failures ({} of all, most {})", percent(failed.rate), told(worst_failed)),
    };
    let place = match (limited, candidates[0].cost) {
        (_, None) => format!("the fewest failures of {keeping} variants; times are missing"),
        _ if noise >= USELESS => format!(
            "the fewest failures of {keeping} variants; times differ from themselves by {:.0} % and decide nothing",
            100.0 * noise
        ),
        (true, Some(_)) => format!("the fastest of {keeping} variants that keep the constraints"),
        (false, Some(_)) => {
            format!(
                "the fastest of those with the fewest failures, of {keeping} variants (noise {:.1} %)",
                100.0 * noise
            )
        }
    };
    let on = if devices == 1 { "1 device".to_owned() } else { format!("{devices} devices") };
    let runner_up = candidates.get(1).filter(|other| other.breaks.is_empty());
    let runner_up = runner_up
        .map_or_else(String::new, |other| format!(". Runner-up: {}, which {}", other.variant, other.lost));
    let count =
        if scenarios.len() == 1 { "1 scenario".to_owned() } else { format!("{} scenarios", scenarios.len()) };
    format!("{variant}: {place}; {finite}; {failures}; {count} on {on}{runner_up}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::sample;

    const VARIANTS: [(&str, u64, u64, f64, f64); 5] = [
        ("exact", 0, 0, 1e-6, 20.0),
        ("close", 0, 0, 1e-5, 18.0),
        ("rough", 5_000, 0, 1e-3, 10.0),
        ("slow", 0, 0, 1e-5, 60.0),
        ("nan", 300_000, 200_000, f64::INFINITY, 9.0),
    ];

    fn names(choice: &Choice) -> Vec<&str> {
        choice.candidates.iter().map(|candidate| candidate.variant.as_str()).collect()
    }

    #[test]
    fn without_limits_the_fewest_failures_lead() {
        let run = sample::run("gpu", &VARIANTS);
        let choice = pick("family", &[&run], &Constraints::default()).unwrap();
        assert_eq!(names(&choice), ["close", "exact", "slow", "rough", "nan"]);
        assert!(choice.found && choice.reason.contains("no NaN"), "{}", choice.reason);
        let front = |name: &str| choice.candidates.iter().find(|c| c.variant == name).unwrap().on_front;
        assert_eq!(["exact", "close", "rough", "slow", "nan"].map(front), [true, true, true, false, true]);
        let lost = |name: &str| choice.candidates.iter().find(|c| c.variant == name).unwrap().lost.clone();
        assert!(lost("nan").contains("is NaN or infinite in 20.000 %"), "{}", lost("nan"));
        assert!(lost("slow").contains("3.33 times"), "{}", lost("slow"));
    }

    #[test]
    fn constraints_choose() {
        let run = sample::run("gpu", &VARIANTS);
        let chosen =
            |constraints: Constraints| names(&pick("family", &[&run], &constraints).unwrap())[0].to_owned();
        let p999 = |limit| Constraints {
            max_error: Some(limit),
            quantile: Quantile::P999,
            ..Constraints::default()
        };
        assert_eq!(chosen(p999(2e-6)), "exact");
        assert_eq!(chosen(p999(1e-2)), "rough");
        assert_eq!(chosen(Constraints { max_failed: Some(0.5), ..Constraints::default() }), "nan");
        let finite = Constraints { max_failed: Some(0.5), no_non_finite: true, ..Constraints::default() };
        assert_eq!(chosen(finite), "rough");
        let none = pick("family", &[&run], &p999(1e-9)).unwrap();
        assert!(!none.found && none.reason.contains("no variant keeps"), "{}", none.reason);
    }

    /// Failing on one device is failing; and a cost is the mean over devices.
    #[test]
    fn every_device_counts() {
        let gpu = sample::run("gpu", &VARIANTS);
        let mut other = VARIANTS;
        (other[1].1, other[1].2) = (9_000, 9_000);
        let cpu = sample::run("cpu", &other);
        let choice = pick("family", &[&gpu, &cpu], &Constraints::default()).unwrap();
        assert_eq!(names(&choice)[0], "exact");
        let close = choice.candidates.iter().find(|candidate| candidate.variant == "close").unwrap();
        assert!(close.lost.contains("a cpu"), "{}", close.lost);
        assert!((close.cost.unwrap() - 2.0).abs() < 1e-12);
    }

    /// Times that differ from themselves by a half rank nothing.
    #[test]
    fn noise_can_make_times_useless() {
        let mut run = sample::run("gpu", &VARIANTS);
        let ratio = serde_json::json!({ "median": 1.0, "low": 0.6, "high": 1.5 });
        let ranking = serde_json::json!({
            "regime": "streaming", "inputs": "divergent", "reference": "exact",
            "null_ns": { "lower": 1.0, "median": 1.0, "upper": 1.0 }, "control": ratio, "noise": 0.5,
            "self_comparisons": 1, "false_positives": 0, "stopped": "time", "rounds": 11, "discarded": 0, "seconds": 1.0,
        });
        run.run.families[0].scenarios[0].rankings = vec![serde_json::from_value(ranking).unwrap()];
        let choice = pick("family", &[&run], &Constraints::default()).unwrap();
        assert_eq!(names(&choice)[0], "exact");
        assert!(choice.reason.contains("decide nothing"), "{}", choice.reason);
    }

    /// What a run lacks is neither right nor wrong: it does not count, and a variant that lacks it is not chosen.
    #[test]
    fn what_was_not_audited_counts_for_nothing() {
        let (gpu, mut cpu) = (sample::run("gpu", &VARIANTS), sample::run("cpu", &VARIANTS));
        for variant in &mut cpu.run.families[0].variants {
            variant.results.retain(|result| result.scenario == "one");
        }
        let choice = pick("family", &[&gpu, &cpu], &Constraints::default()).unwrap();
        assert_eq!((choice.scenarios, choice.left_out), (vec!["one".to_owned()], vec!["two".to_owned()]));
        let two = Constraints { scenarios: vec!["two".to_owned()], ..Constraints::default() };
        assert!(pick("family", &[&gpu, &cpu], &two).unwrap_err().contains("every run"));
        cpu.run.families[0].variants[1].results.clear();
        let choice = pick("family", &[&gpu, &cpu], &Constraints::default()).unwrap();
        assert!(choice.candidates.iter().any(|c| c.variant == "close" && c.lost.contains("not in the run")));
        assert!(
            pick("family", &[&gpu, &gpu], &Constraints::default()).unwrap_err().contains("both of a gpu")
        );
    }

    #[test]
    fn what_is_not_there_is_told() {
        let run = sample::run("gpu", &VARIANTS);
        let scenario = Constraints { scenarios: vec!["three".to_owned()], ..Constraints::default() };
        assert!(pick("family", &[&run], &scenario).unwrap_err().contains("three"));
        assert!(pick("other", &[&run], &Constraints::default()).is_err());
        assert!(pick("family", &[], &Constraints::default()).is_err());
    }
}
