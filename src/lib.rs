//! rootq audits the precision and measures the throughput of GPU shader variants.
//!
//! The way of the data, from left to right; every arrow is a module of this crate:
//!
//! ```text
//! scenario --(seed, index)--> inputs f32 --> device runs variant --> outputs f32 -+
//!  sample, family |              catalog, device                                  +--> judge --> summary, failures
//!                 +--> oracle f64 with its own error bound -----------------------+     audit
//!                        family, numeric
//! summary + timings --> record (one folder a run) --> tables; two runs --> what changed; many --> what to ship
//!       bench             job: parts of a long one    report                decide
//! a recorded failure --> the same bits again, smaller, elsewhere
//!       case
//! ```
//!
//! Everything on that line is a pure function of (family, scenario, seed, index range, device), works on chunks of at
//! most 2^20 configurations, and merges by integer addition and max.
//!
//! Who may use whom: `cli` -> `report` -> `decide`, `case` -> `record` -> `bench`, `job`, `hunt` -> `audit` -> `device`,
//! `family` -> `catalog` -> `sample` -> `numeric`; `cli` -> `fit` -> `sample`; `cli`, `report` -> `probe` -> `device`,
//! `catalog`, `sample`. Nothing points back. `device` knows no family, `family` knows no device, only `cli` prints.

pub mod audit;
pub mod bench;
pub mod case;
pub mod catalog;
pub mod cli;
pub mod decide;
pub mod device;
pub mod family;
pub mod fit;
pub mod hunt;
pub mod job;
pub mod numeric;
pub mod probe;
pub mod record;
pub mod report;
pub mod sample;
