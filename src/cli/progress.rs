//! One line of progress on standard error; nothing in a pipe.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use smash::batch::{BatchProgress, Outcome};
use smash::reconstruct::{Progress, Stage};

/// The line; it disappears when the work is done.
pub struct ProgressLine(ProgressBar);

impl ProgressLine {
    /// A line that is only drawn on a terminal.
    pub fn new() -> Self {
        ProgressLine::with_template("{wide_bar} {msg}")
    }

    /// A line that says what is done, and for how long by now.
    pub fn of_work(what: &'static str) -> Self {
        let line = ProgressLine::with_template("{spinner} {msg}, {elapsed}");
        line.0.set_message(what);
        line.0.enable_steady_tick(Duration::from_millis(250));
        line
    }

    /// The same, for many scenes and with the time left.
    pub fn of_batch() -> Self {
        let line = ProgressLine::with_template("{wide_bar} {pos} of {len} scenes, {eta} left");
        // The time left runs down between the scenes.
        line.0.enable_steady_tick(Duration::from_secs(1));
        line
    }

    fn with_template(template: &str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template(template);
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

    /// Shows how far a batch is, from any thread.
    pub fn show_batch(&self, progress: BatchProgress) {
        match progress {
            BatchProgress::Found(scenes) => self.0.set_length(scenes as u64),
            // It took no time: counted as work, it would spoil the estimate of the time left.
            BatchProgress::Done(Outcome::Kept) => self.0.dec_length(1),
            BatchProgress::Done(_) => self.0.inc(1),
        }
    }

    /// Shows that one of `of` steps is done, from any thread.
    pub fn step(&self, of: usize) {
        self.0.set_length(of as u64);
        self.0.inc(1);
        self.0.set_message(format!("{} of {of} questions", self.0.position()));
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
