//! How many configurations fit in one dispatch: long enough to be worth it, short enough for any watchdog.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::catalog::kernel::LOCAL_SIZE;

/// What a dispatch should take. Watchdogs kill at 500 ms and more; estimates can be off by a few times when
/// inputs differ in cost.
pub(super) const TARGET_NS: f64 = 40e6;
/// The first dispatch of a kernel ever: it pays for the driver's last compile step, so it teaches nothing.
pub(super) const WARM_ROWS: u32 = 1 << 10;
/// The second one, from which the first estimate comes.
pub(super) const PROBE_ROWS: u32 = 1 << 14;
/// No dispatch is made smaller than this for time's sake.
const LEAST_ROWS: u32 = 1 << 10;

/// What a kernel costs on a device, learned from its dispatches.
pub(super) struct Pace {
    /// Bits of nanoseconds a configuration; NaN: not known yet.
    ns_per_row: AtomicU64,
}

impl Pace {
    pub(super) fn new() -> Self {
        Self { ns_per_row: AtomicU64::new(f64::NAN.to_bits()) }
    }

    pub(super) fn estimate(&self) -> Option<f64> {
        let estimate = f64::from_bits(self.ns_per_row.load(Ordering::Relaxed));
        (!estimate.is_nan()).then_some(estimate)
    }

    /// Takes in a measurement. A rise is believed at once, a fall to a quarter at most: inputs that differ in
    /// cost by four times then still make no dispatch longer than four times its target.
    pub(super) fn learn(&self, ns: f64, rows: u32) {
        if rows == 0 || !ns.is_finite() {
            return;
        }
        let measured = ns / f64::from(rows);
        let next = self.estimate().map_or(measured, |before| measured.max(before / 4.0));
        // Two threads may each take in theirs and one be lost: both are measurements of the same thing.
        self.ns_per_row.store(next.to_bits(), Ordering::Relaxed);
    }

    /// The most rows for one dispatch, at most `limit`.
    fn batch(&self, limit: u32) -> u32 {
        let fitting = match self.estimate() {
            Some(ns) if ns > 0.0 => (TARGET_NS / ns).min(f64::from(u32::MAX)) as u32,
            Some(_) => u32::MAX,
            None => PROBE_ROWS,
        };
        fitting.max(LEAST_ROWS).min(limit)
    }

    /// Splits `first..rows` in dispatches `(first, count)` of equal size, whole workgroups but for the last.
    pub(super) fn split(&self, first: u32, rows: u32, limit: u32) -> Vec<(u32, u32)> {
        let remaining = rows - first;
        if remaining == 0 {
            return Vec::new();
        }
        let dispatches = remaining.div_ceil(self.batch(limit));
        let size = remaining.div_ceil(dispatches).next_multiple_of(LOCAL_SIZE).min(limit);
        let mut parts = Vec::new();
        let mut at = first;
        while at < rows {
            let count = size.min(rows - at);
            parts.push((at, count));
            at += count;
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(parts: &[(u32, u32)], first: u32, rows: u32) {
        let mut at = first;
        for &(start, count) in parts {
            assert_eq!(start, at);
            assert!(count > 0);
            at += count;
        }
        assert_eq!(at, rows);
    }

    #[test]
    fn dispatches_cover_every_row_once() {
        let pace = Pace::new();
        for rows in [0, 1, 63, 64, 65, 1024, 1_000_003, 1 << 20] {
            for limit in [64, 1 << 22] {
                covered(&pace.split(0, rows, limit), 0, rows);
            }
        }
        pace.learn(1e9, 1_000_000);
        let parts = pace.split(17_408, 1 << 20, 1 << 22);
        covered(&parts, 17_408, 1 << 20);
        assert!(parts.iter().rev().skip(1).all(|(_, count)| count % LOCAL_SIZE == 0));
    }

    #[test]
    fn dispatches_keep_to_their_time() {
        let pace = Pace::new();
        // 1000 ns a row: 40 ms are 40,000 rows.
        pace.learn(1e9, 1_000_000);
        let parts = pace.split(0, 1 << 20, u32::MAX / 2);
        assert!(parts.iter().all(|&(_, count)| count <= 40_064), "{parts:?}");
        assert_eq!(parts.len(), (1usize << 20).div_ceil(40_000));
        // Cheap kernels are bounded by the workgroup count alone.
        let pace = Pace::new();
        pace.learn(1.0, 1 << 20);
        assert_eq!(pace.split(0, 1 << 20, 65_535 * 64), [(0, 1 << 20)]);
    }

    #[test]
    fn a_rise_is_believed_at_once_and_a_fall_to_a_quarter() {
        let pace = Pace::new();
        assert_eq!(pace.estimate(), None);
        pace.learn(100.0, 1);
        pace.learn(900.0, 1);
        assert_eq!(pace.estimate(), Some(900.0));
        pace.learn(100.0, 1);
        assert_eq!(pace.estimate(), Some(225.0));
        pace.learn(100.0, 1);
        assert_eq!(pace.estimate(), Some(100.0));
    }
}
