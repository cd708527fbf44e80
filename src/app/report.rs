//! The report that a user pastes into a bug report: program, GPU, state, errors and frame rate.

use super::App;
use crate::app::language::{in_english, local_number, say, text, tr};
use crate::ocean::device_info::DeviceInfo;

impl App {
    /// Rows (name and value) about the program, its GPU, the picture, the frame rate and the last error.
    pub(super) fn system_information(&self) -> Vec<(&'static str, String)> {
        let mut rows = DeviceInfo::new(&self.render_state.adapter, &self.gpu()).rows();
        #[cfg(target_arch = "wasm32")]
        rows.push(("browser", self.browser.clone()));
        let ([width, height], quality) = (self.picture_size(), self.quality.describe());
        let picture = say!("{width} x {height} pixels, {quality}", width = width, height = height, quality = quality);
        rows.push((text!("picture"), picture));
        let (points, cascades) = (self.params_to_draw().grid.n, self.derived.plan.cascades.len());
        let sea = say!("{points} x {points} points in {cascades} cascades", points = points, cascades = cascades);
        rows.push((text!("sea"), sea));
        let rate = format!("{:.0}", self.quality.frames_per_second());
        rows.push((text!("frames"), say!("{count}, {rate} a second", count = self.frames, rate = rate)));
        let ms = local_number(format!("{:.2}", self.frame_measurements.recording_time_ms()));
        rows.push((text!("recording"), say!("{ms} ms of the CPU", ms = ms)));
        let errors = self.errors();
        let last = self.device_lost().or_else(|| errors.last().cloned());
        rows.push((text!("last error"), last.unwrap_or_else(|| tr("none").to_owned())));
        rows
    }

    /// The whole bug report as plain text: program, GPU and frame rate, then pass times, errors, notices and the state
    /// string. It is English in every language of the interface, because those who mend the fault read it.
    pub fn report_text(&self) -> String {
        in_english(|| self.report_in_english())
    }

    fn report_in_english(&self) -> String {
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
