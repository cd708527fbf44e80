//! The report that a user pastes into a bug report: program, GPU, state, errors and frame rate.

use super::App;
use crate::app::language::tr;
use crate::ocean::device_info::DeviceInfo;

impl App {
    /// Rows (name and value) about the program, its GPU, the picture, the frame rate and the last error.
    pub(super) fn system_information(&self) -> Vec<(&'static str, String)> {
        let mut rows = DeviceInfo::new(&self.render_state.adapter, &self.gpu()).rows();
        #[cfg(target_arch = "wasm32")]
        rows.push(("browser", self.browser.clone()));
        let [width, height] = self.picture_size();
        let quality = self.quality.describe();
        let points = self.params_to_draw().grid.n;
        rows.push(("picture", format!("{width} x {height} pixels, {quality}")));
        rows.push(("sea", format!("{points} x {points} points in {} cascades", self.derived.plan.cascades.len())));
        rows.push(("frames", format!("{}, {:.0} a second", self.frames, self.quality.frames_per_second())));
        rows.push(("recording", format!("{:.2} ms of the CPU", self.frame_measurements.recording_time_ms())));
        let errors = self.errors();
        let last = self.device_lost().or_else(|| errors.last().cloned());
        rows.push(("last error", last.unwrap_or_else(|| "none".to_owned())));
        rows
    }

    /// The whole bug report as plain text: program, GPU and frame rate, then pass times, errors, notices and the state
    /// string.
    pub fn report_text(&self) -> String {
        let mut lines: Vec<String> =
            self.system_information().iter().map(|(name, value)| format!("{name}: {value}")).collect();
        for (pass, ms) in self.frame_measurements.pass_times_ms().unwrap_or_default() {
            lines.push(format!("pass {pass}: {ms:.2} ms"));
        }
        lines.extend(self.errors().iter().map(|error| format!("error: {error}")));
        lines.extend(self.notices.iter().map(|notice| format!("notice: {notice}")));
        lines.push(format!("state: {}", self.state()));
        lines.join("\n") + "\n"
    }

    /// Copies the text for a bug report to the clipboard.
    pub(super) fn copy_report(&mut self) {
        self.ctx.copy_text(self.report_text());
        self.show_brief_message(tr("Report copied: paste it where you tell of the fault."));
    }
}
