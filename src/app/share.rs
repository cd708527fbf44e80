//! Ways to share a sea: links, HTML for embedding, saved pictures and saved wave maps.

use super::{App, storage, tasks};
use crate::files::picture;
use crate::gpu::offscreen::PendingPicture;
use crate::ocean::{Ocean, maps_file};
use crate::state::{Params, query, rounding::with_rounded_pose};
use crate::waves::Plan;

impl App {
    /// The link to the current sea: the page's address with the state string; on the desktop the bare state string.
    pub fn link(&self) -> String {
        #[cfg(target_arch = "wasm32")]
        return super::web::page_link(&query::write_to_keep(&with_rounded_pose(&self.params)));
        #[cfg(not(target_arch = "wasm32"))]
        self.state()
    }

    /// Copies the link to the current sea to the clipboard.
    pub(super) fn copy_link(&mut self) {
        self.ctx.copy_text(self.link());
        self.show_brief_message("Link copied.");
    }

    /// Copies the HTML of an iframe that shows the sea in another web page, without the panel.
    pub(super) fn copy_iframe(&mut self) {
        let mut params = with_rounded_pose(&self.params);
        params.screen.panel = false;
        let state = query::write_to_keep(&params);
        #[cfg(target_arch = "wasm32")]
        let link = super::web::page_link(&state);
        #[cfg(not(target_arch = "wasm32"))]
        let link = format!("https://example.org/seastate/?{state}");
        let link = link.replace('&', "&amp;");
        self.ctx.copy_text(format!(
            "<iframe src=\"{link}\" title=\"Seastate\" width=\"960\" height=\"540\" style=\"border:0\" \
             allow=\"fullscreen\" loading=\"lazy\"></iframe>"
        ));
        self.show_brief_message("Frame copied: paste it into a page.");
    }

    /// Opens the sea of a link or of a bare state string. A text without any known key leaves the sea as it is, and the
    /// notices say so.
    pub(super) fn open_link(&mut self, text: &str) {
        let reading = query::parse_with_keys(text);
        if reading.keys_taken.is_empty() && !reading.notices.is_empty() {
            self.notices = reading.notices;
            self.notices.push("that is no sea: this one stays".to_owned());
            return;
        }
        self.set_state(text);
        if self.notices.is_empty() {
            self.show_brief_message("Opened.");
        }
    }

    /// Saves the current picture as a PNG that contains its state string. The result arrives later in `save_results`.
    pub(super) fn save_picture(&mut self) {
        let Some((params, size)) = self.drawn.clone() else { return };
        let params = with_rounded_pose(&params);
        let (state, link) = (query::write_to_keep(&params), self.link());
        let gpu = self.gpu();
        let format = self.render_state.target_format;
        let encoder = gpu.encoder("screenshot");
        let made = {
            let renderer = self.render_state.renderer.read();
            let Some(ocean) = renderer.callback_resources.get::<Ocean>() else { return };
            PendingPicture::submit(&gpu, encoder, format, size, |pass| ocean.present(pass))
        };
        let (inbox, ctx, name) = (self.save_results.clone(), self.ctx.clone(), picture_name(&params));
        let folder = self.save_folder.clone();
        tasks::spawn(async move {
            let made = made.read(&gpu).await.and_then(|pixels| picture::encode(size, &pixels, &state, &link));
            inbox.put(made.and_then(|png| storage::save(folder.as_deref(), &name, &png)), &ctx);
        });
    }

    /// Saves the wave maps of the current moment as an OpenEXR file. The result arrives later in `save_results`.
    pub(super) fn save_maps(&mut self) {
        let params = with_rounded_pose(&self.params);
        let state = query::write(&params);
        let gpu = self.gpu();
        let (inbox, ctx, folder) = (self.save_results.clone(), self.ctx.clone(), self.save_folder.clone());
        tasks::spawn(async move {
            let plan = Plan::new(&params);
            let read = Ocean::without_renderer(&gpu, &params).read_maps().await;
            let made = read.and_then(|read| maps_file::encode_exr(&plan, &read, &state));
            inbox.put(made.and_then(|exr| storage::save(folder.as_deref(), "seastate-maps.exr", &exr)), &ctx);
        });
    }

    /// Shows the results of file saves that have finished since the last frame: the path in a message, a failure in the
    /// notices.
    pub(super) fn take_save_results(&mut self) {
        for result in self.save_results.take() {
            self.show_save_result(result);
        }
    }

    /// Saves bytes as a file called `name` (a download in the browser), and shows a message with the path or the error.
    pub(super) fn save(&mut self, name: &str, bytes: &[u8]) {
        self.show_save_result(storage::save(self.save_folder.as_deref(), name, bytes));
    }

    fn show_save_result(&mut self, result: Result<String, String>) {
        match result {
            Ok(message) => self.show_brief_message(&message),
            Err(reason) => self.notices.push(reason),
        }
    }
}

/// File name of a saved picture, with wind speed (m/s) and time (s), such as `seastate-wind14-t40.png`.
fn picture_name(params: &Params) -> String {
    format!("seastate-wind{:.0}-t{:.0}.png", params.sea.first_system().wind_m_s, params.clock.t_s)
}
