//! The progress line of long work, on a terminal only.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar on standard error; invisible where that is no terminal.
pub(super) fn bar(length: u64, message: &str, tail: &str) -> ProgressBar {
    let bar = ProgressBar::new(length).with_message(message.to_owned());
    let shape = if length == 0 { "{spinner}" } else { "{wide_bar}" };
    if let Ok(style) = ProgressStyle::with_template(&format!("{{msg:30}} {shape} {tail}")) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
