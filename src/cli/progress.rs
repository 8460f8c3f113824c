//! One line of progress on standard error; nothing in a pipe.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use smash::reconstruct::{Progress, Stage};

/// The line; it disappears when the work is done.
pub struct ProgressLine(ProgressBar);

impl ProgressLine {
    /// A line that is only drawn on a terminal.
    pub fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{wide_bar} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        ProgressLine(bar)
    }

    /// Shows a step that was done, from any thread.
    pub fn show(&self, progress: Progress) {
        let cost = progress.cost;
        match progress.stage {
            Stage::Segment { of, .. } => {
                // Two phases follow the search. Segments end in any order: count them.
                self.0.set_length(of as u64 + 2);
                self.0.inc(1);
                let done = self.0.position().min(of as u64);
                self.0.set_message(format!("phase 1, segment {done} of {of}, cost {cost:.3e}"));
            }
            Stage::Impulse => {
                self.0.inc(1);
                self.0.set_message(format!("phase 2, the impulse, cost {cost:.3e}"));
            }
            Stage::ContactPoint => {
                self.0.inc(1);
                self.0.set_message(format!("phase 3, the contact point, cost {cost:.3e}"));
            }
        }
    }

    /// Takes the line away.
    pub fn clear(&self) {
        self.0.finish_and_clear();
    }
}

impl Drop for ProgressLine {
    /// An error message must not stand behind a bar.
    fn drop(&mut self) {
        self.clear();
    }
}
