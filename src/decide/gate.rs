//! Rules that a run must keep, from a TOML file; what breaks one makes `rootq compare --gate` fail.
//!
//! ```toml
//! [[rule]]
//! select = "ltc_disk/secular_*"   # family, family/variant or a glob; absent: every variant
//! scenario = "ggx"                # a name or a glob; absent: every scenario
//! max_failed = 1e-4               # share of configurations wrong by the variant's own fault
//! max_non_finite = 0              # share that is NaN or infinite
//! max_error = 1e-3                # of every output in its own measure, at `quantile`
//! max_ulp = 4                     # likewise in units of the f32 spacing
//! quantile = "p999"               # p50, p90, p99, p999 or worst; absent: worst
//! max_time_ratio = 1.1            # B's time over A's (on a software device relative to the median change of the regime);
//!                                 # broken where the interval's lower end is above it
//! no_worse = ["accuracy", "time"] # what may not be worse than in A
//! same_bits = true                # outputs as in A, to the last bit
//! ```

use globset::{GlobBuilder, GlobMatcher};
use serde::{Deserialize, Serialize};

use super::{Change, Comparison, Quantile, Row};
use crate::audit::Verdict;
use crate::record::{Audit, Recorded};

/// All rules of a file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rules {
    #[serde(rename = "rule")]
    rules: Vec<Rule>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rule {
    #[serde(default = "everything")]
    select: Pattern,
    #[serde(default = "everything")]
    scenario: Pattern,
    max_failed: Option<f64>,
    max_non_finite: Option<f64>,
    max_error: Option<f64>,
    max_ulp: Option<f64>,
    #[serde(default)]
    quantile: Quantile,
    max_time_ratio: Option<f64>,
    #[serde(default)]
    no_worse: Vec<Aspect>,
    #[serde(default)]
    same_bits: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Aspect {
    Accuracy,
    Time,
}

/// A glob, checked when it is read.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "String")]
struct Pattern {
    text: String,
    matcher: GlobMatcher,
}

impl TryFrom<String> for Pattern {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let glob = GlobBuilder::new(&text).literal_separator(true).build();
        let matcher =
            glob.map_err(|error| format!("'{text}' is not a pattern: {}", error.kind()))?.compile_matcher();
        Ok(Pattern { text, matcher })
    }
}

fn everything() -> Pattern {
    let glob = GlobBuilder::new("**").build().map(|glob| glob.compile_matcher());
    // `**` is a valid glob.
    Pattern { text: String::new(), matcher: glob.unwrap_or_else(|_| unreachable!()) }
}

/// A row that breaks a rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Breach {
    /// Position of the rule in the file, from 1.
    pub rule: usize,
    /// `family/variant`.
    pub variant: String,
    pub scenario: String,
    pub file: String,
    /// What is above which limit.
    pub what: String,
}

impl Rules {
    /// Reads rules; an error says where and why.
    pub fn parse(text: &str) -> Result<Rules, String> {
        let rules: Rules = toml::from_str(text).map_err(|error| error.to_string())?;
        for (position, rule) in rules.rules.iter().enumerate() {
            rule.check().map_err(|message| format!("rule {}: {message}", position + 1))?;
        }
        Ok(rules)
    }

    /// What breaks the rules, by rule and row; an error if a rule selects nothing in run B, which then is not what it
    /// was written for.
    pub fn breaches(&self, comparison: &Comparison, b: &Recorded) -> Result<Vec<Breach>, String> {
        let mut breaches = Vec::new();
        for (position, rule) in self.rules.iter().enumerate() {
            let number = position + 1;
            let (mut any, mut compared, mut timed) = (false, false, false);
            for (family, variant, result) in results(b) {
                let id = format!("{family}/{}", variant.name);
                if !rule.selects(family, &id, &result.scenario) {
                    continue;
                }
                any = true;
                let row =
                    comparison.rows.iter().find(|row| row.id() == id && row.scenario == result.scenario);
                compared |= row.is_some_and(|row| row.accuracy.is_some());
                timed |= row.is_some_and(|row| !row.times.is_empty());
                let found = rule.limits(result.audit.as_ref()).into_iter().chain(rule.changes(row));
                breaches.extend(found.map(|what| Breach {
                    rule: number,
                    variant: id.clone(),
                    scenario: result.scenario.clone(),
                    file: variant.path(),
                    what,
                }));
            }
            // What A had and B lacks cannot keep a rule.
            for lost in &comparison.only_a {
                let Some((id, scenario)) = lost.split_once(" . ") else { continue };
                let family = id.split('/').next().unwrap_or(id);
                if rule.selects(family, id, scenario) {
                    any = true;
                    let (variant, scenario) = (id.to_owned(), scenario.to_owned());
                    let what = "is in A and not in B".to_owned();
                    breaches.push(Breach { rule: number, variant, scenario, file: String::new(), what });
                }
            }
            if !any {
                let Rule { select, scenario, .. } = rule;
                return Err(format!(
                    "rule {number} (select '{}', scenario '{}') selects nothing in {}",
                    select.text,
                    scenario.text,
                    b.path.display()
                ));
            }
            // What was never measured keeps no limit.
            let lacks = |what: &str| {
                Err(format!(
                    "rule {number} limits {what}, but no row that it selects has {what} in both runs"
                ))
            };
            if rule.wants_times() && !timed {
                return lacks("times");
            }
            if rule.no_worse.contains(&Aspect::Accuracy) && !compared {
                return lacks("accuracy");
            }
        }
        Ok(breaches)
    }
}

fn results(
    recorded: &Recorded,
) -> impl Iterator<Item = (&str, &crate::record::Variant, &crate::record::Result)> {
    recorded.run.families.iter().flat_map(|family| {
        let variants = family.variants.iter();
        variants.flat_map(move |variant| {
            variant.results.iter().map(move |result| (family.name.as_str(), variant, result))
        })
    })
}

impl Rule {
    fn check(&self) -> Result<(), String> {
        let limits = [
            ("max_failed", self.max_failed),
            ("max_non_finite", self.max_non_finite),
            ("max_error", self.max_error),
            ("max_ulp", self.max_ulp),
            ("max_time_ratio", self.max_time_ratio),
        ];
        for (name, limit) in limits {
            if limit.is_some_and(|limit| !(limit >= 0.0)) {
                return Err(format!("{name} must not be negative"));
            }
        }
        if limits.iter().all(|(_, limit)| limit.is_none()) && self.no_worse.is_empty() && !self.same_bits {
            return Err("it limits nothing; give it max_failed, max_error, no_worse or the like".to_owned());
        }
        Ok(())
    }

    fn wants_times(&self) -> bool {
        self.max_time_ratio.is_some() || self.no_worse.contains(&Aspect::Time)
    }

    fn selects(&self, family: &str, id: &str, scenario: &str) -> bool {
        (self.select.matcher.is_match(id) || self.select.matcher.is_match(family))
            && self.scenario.matcher.is_match(scenario)
    }

    /// Limits on run B alone.
    fn limits(&self, audit: Option<&Audit>) -> Vec<String> {
        let mut broken = Vec::new();
        let wants_audit =
            [self.max_failed, self.max_non_finite, self.max_error, self.max_ulp].iter().any(Option::is_some);
        let Some(audit) = audit else {
            if wants_audit {
                broken.push("was not audited in B".to_owned());
            }
            return broken;
        };
        let mut share = |name: &str, rate: f64, count: u64, limit: Option<f64>| {
            if let Some(limit) = limit.filter(|limit| rate > *limit) {
                broken.push(format!("{name} {rate} ({count} of {}) is above {limit}", audit.configurations));
            }
        };
        share("failed", audit.failed.rate, audit.failed.count, self.max_failed);
        let non_finite = audit.verdict(Verdict::NonFinite);
        share("not finite", non_finite.rate, non_finite.count, self.max_non_finite);
        for output in &audit.outputs {
            let quantile = self.quantile;
            let mut above = |name: &str, value: f64, limit: Option<f64>| {
                if let Some(limit) = limit.filter(|limit| !(value <= *limit)) {
                    let word = quantile.name();
                    broken.push(format!("{word} {name} of {} {value:.3e} is above {limit:e}", output.name));
                }
            };
            above("error", quantile.of_error(audit, output), self.max_error);
            above("ULP", quantile.of_ulp(audit, output), self.max_ulp);
        }
        broken
    }

    /// Limits on the change from A to B.
    fn changes(&self, row: Option<&Row>) -> Vec<String> {
        let mut broken = Vec::new();
        let Some(row) = row else {
            if self.max_time_ratio.is_some() || !self.no_worse.is_empty() || self.same_bits {
                broken.push("is in B and not in A, so it cannot be compared".to_owned());
            }
            return broken;
        };
        if self.no_worse.contains(&Aspect::Accuracy)
            && let Some(accuracy) = row.accuracy.as_ref().filter(|accuracy| accuracy.change == Change::Worse)
        {
            broken.push(format!("accuracy is worse: {}", accuracy.reason));
        }
        for time in &row.times {
            let told = format!("time {:.2} -> {:.2} ns, ratio {:.3}", time.ns[0], time.ns[1], time.ratio);
            if self.no_worse.contains(&Aspect::Time) && time.change == Change::Worse {
                broken.push(format!("{told}, is worse"));
            }
            if let Some(limit) = self.max_time_ratio.filter(|limit| time.low > *limit) {
                broken.push(format!("{told}, is above {limit}"));
            }
        }
        if self.same_bits {
            match row.bits {
                Some(bits) if bits.identical() => {}
                Some(bits) => {
                    broken.push(format!("about {:.0} configurations have other bits", bits.differing))
                }
                None => {
                    broken.push("bits cannot be compared: other configurations, or an old record".to_owned())
                }
            }
        }
        broken
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Tolerances, compare, sample};

    fn broken(rules: &str) -> Result<Vec<(String, String)>, String> {
        let a = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0), ("bad", 400_000, 90_000, 0.5, 5.0)]);
        let b = sample::run("gpu", &[("good", 0, 0, 1e-6, 20.0), ("bad", 400_000, 90_000, 0.5, 5.0)]);
        let comparison = compare(&a, &b, Tolerances::default());
        let breaches = Rules::parse(rules)?.breaches(&comparison, &b)?;
        Ok(breaches.into_iter().map(|breach| (breach.variant, breach.scenario)).collect())
    }

    fn pairs(variant: &str) -> Vec<(String, String)> {
        ["one", "two"].map(|scenario| (format!("family/{variant}"), scenario.to_owned())).to_vec()
    }

    #[test]
    fn limits_name_the_rows_that_break_them() {
        assert_eq!(broken("[[rule]]\nmax_failed = 0.1").unwrap(), pairs("bad"));
        assert_eq!(broken("[[rule]]\nmax_failed = 0.5").unwrap(), []);
        assert_eq!(broken("[[rule]]\nmax_non_finite = 0").unwrap(), pairs("bad"));
        assert_eq!(broken("[[rule]]\nmax_error = 1e-4\nquantile = \"p999\"").unwrap(), pairs("bad"));
        assert_eq!(broken("[[rule]]\nselect = \"family/g*\"\nmax_error = 1e-4").unwrap(), []);
        assert_eq!(broken("[[rule]]\nmax_time_ratio = 1.5").unwrap(), pairs("good"));
        assert_eq!(
            broken("[[rule]]\nno_worse = [\"time\"]\nscenario = \"one\"").unwrap(),
            pairs("good")[..1]
        );
        assert_eq!(broken("[[rule]]\nno_worse = [\"accuracy\"]\nsame_bits = true").unwrap(), []);
    }

    #[test]
    fn bad_rules_are_told() {
        assert!(
            broken("[[rule]]\nselect = \"elsewhere\"\nmax_failed = 0")
                .unwrap_err()
                .contains("selects nothing")
        );
        assert!(broken("[[rule]]\nmax_fialed = 0").unwrap_err().contains("max_fialed"));
        assert!(broken("[[rule]]\nselect = \"family\"").unwrap_err().contains("limits nothing"));
        assert!(broken("[[rule]]\nmax_failed = -1").unwrap_err().contains("negative"));
        assert!(broken("[[rule]]\nselect = \"[\"\nmax_failed = 1").unwrap_err().contains("not a pattern"));
        assert!(broken("").is_err());
    }

    /// A limit on what was not measured is not kept by that.
    #[test]
    fn what_was_not_measured_keeps_nothing() {
        let full = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0)]);
        let without = |times: bool| {
            let mut run = full.clone();
            for result in
                run.run.families.iter_mut().flat_map(|f| &mut f.variants).flat_map(|v| &mut v.results)
            {
                if times { result.timing = None } else { result.audit = None }
            }
            run
        };
        let judge = |rules: &str, run: &Recorded| {
            let comparison = compare(run, run, Tolerances::default());
            Rules::parse(rules).unwrap().breaches(&comparison, run)
        };
        for rules in ["[[rule]]\nmax_time_ratio = 2", "[[rule]]\nno_worse = [\"time\"]"] {
            assert!(judge(rules, &full).unwrap().is_empty());
            assert!(judge(rules, &without(true)).unwrap_err().contains("limits times"));
        }
        let accuracy = "[[rule]]\nno_worse = [\"accuracy\"]";
        assert!(judge(accuracy, &full).unwrap().is_empty());
        assert!(judge(accuracy, &without(false)).unwrap_err().contains("limits accuracy"));
    }

    #[test]
    fn what_vanished_breaks_its_rule() {
        let a = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0), ("gone", 0, 0, 1e-6, 5.0)]);
        let b = sample::run("gpu", &[("good", 0, 0, 1e-6, 10.0)]);
        let comparison = compare(&a, &b, Tolerances::default());
        let breaches = Rules::parse("[[rule]]\nmax_failed = 0").unwrap().breaches(&comparison, &b).unwrap();
        assert_eq!(breaches.len(), 2);
        assert!(breaches.iter().all(|breach| breach.variant == "family/gone"));
    }
}
