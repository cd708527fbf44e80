//! Ways to share a sea: links, HTML for embedding and saved wave maps.

use super::{App, storage, tasks};
use crate::app::language::{say, tr};
use crate::ocean::{Ocean, maps_file};
use crate::state::params::{Interface, SpectrumKind};
use crate::state::{query, rounding::with_rounded_pose};
use crate::waves::{Plan, beaufort};

/// Address of a page in the HTML that the desktop window copies: the window does not know where the page is served.
#[cfg(not(target_arch = "wasm32"))]
const EXAMPLE_PAGE: &str = "https://example.org/seastate/";

impl App {
    /// The link to the current sea: the page's address with the state string; on the desktop the bare state string.
    pub fn link(&self) -> String {
        #[cfg(target_arch = "wasm32")]
        return super::web_page::page_link(&query::write_to_keep(&with_rounded_pose(&self.params)));
        #[cfg(not(target_arch = "wasm32"))]
        self.state()
    }

    /// The sea in a few words, such as `Force 5 sea, waves 1.9 m high`.
    pub(super) fn sea_in_words(&self) -> String {
        let force = beaufort::beaufort_number(self.params.sea.first_system().wind_m_s);
        let height = self.length_scale().format(self.derived.theoretical_statistics.hs_m, 1);
        let sea = if self.has_measured_waves() {
            say!("Measured waves, {height} high", height = height)
        } else {
            say!("Force {force} sea, waves {height} high", force = force, height = height)
        };
        match self.coast_in_words() {
            Some(coast) => say!("{sea}, coast: {coast}", sea = sea, coast = coast),
            None => sea,
        }
    }

    /// Title of the browser's tab, such as `Force 5, 1.9 m: Seastate`.
    #[cfg(target_arch = "wasm32")]
    pub(super) fn tab_title(&self) -> String {
        let force = beaufort::beaufort_number(self.params.sea.first_system().wind_m_s);
        let sea = if self.has_measured_waves() { tr("Measured waves").to_owned() } else { format!("Force {force}") };
        format!("{sea}, {}: Seastate", self.length_scale().format(self.derived.theoretical_statistics.hs_m, 1))
    }

    /// Whether the waves are those of an opened spectrum, and not made by the wind of the parameters.
    pub(super) fn has_measured_waves(&self) -> bool {
        let sea = &self.params.sea;
        sea.first_system().spectrum == SpectrumKind::Measured && sea.measured.is_some()
    }

    /// Copies the link to the current sea to the clipboard.
    pub(super) fn copy_link(&mut self) {
        self.ctx.copy_text(self.link());
        self.show_brief_message(tr("Link copied."));
    }

    /// Copies a line for a message to a friend: the sea in words, and the link to it.
    pub(super) fn copy_link_with_words(&mut self) {
        self.ctx.copy_text(format!("{}: {}", self.sea_in_words(), self.link()));
        self.show_brief_message(tr("Link copied, with a line about the sea."));
    }

    /// The link to the current sea with what is shown over it: on the page its address, on the desktop one of a made-up
    /// page, whose place the user fills in.
    fn page_link_with(&self, interface: Interface) -> String {
        let mut params = with_rounded_pose(&self.params);
        params.screen.interface = interface;
        let state = query::write_to_keep(&params);
        #[cfg(target_arch = "wasm32")]
        return super::web_page::page_link(&state);
        #[cfg(not(target_arch = "wasm32"))]
        format!("{EXAMPLE_PAGE}?{state}")
    }

    /// The link to the current sea with the panel.
    pub(super) fn whole_page_link(&self) -> String {
        self.page_link_with(Interface::Panel)
    }

    /// Copies the HTML of an iframe that shows the sea in another web page, with a caption instead of the panel.
    pub(super) fn copy_iframe(&mut self) {
        let link = self.page_link_with(Interface::Mini).replace('&', "&amp;");
        self.ctx.copy_text(format!(
            "<iframe src=\"{link}\" title=\"{}\" width=\"960\" height=\"540\" style=\"border:0\" \
             allow=\"fullscreen\" loading=\"lazy\"></iframe>",
            self.sea_in_words()
        ));
        self.show_brief_message(tr("Frame copied: paste it into a page."));
    }

    /// Copies the HTML of the element `<sea-state>`, which a script of the page can talk to (docs/embed.md).
    pub(super) fn copy_element(&mut self) {
        let link = self.page_link_with(Interface::Mini);
        let (page, state) = link.split_once('?').unwrap_or((&link, ""));
        let state = state.replace('&', "&amp;");
        self.ctx.copy_text(format!(
            "<script type=\"module\" src=\"{page}sea-state.js\"></script>\n\
             <sea-state state=\"{state}\" style=\"width: 100%; aspect-ratio: 16 / 9\"></sea-state>"
        ));
        self.show_brief_message(tr("Element copied: paste it into a page."));
    }

    /// Opens the sea of a link or of a bare state string. A text without any known key leaves the sea as it is, and the
    /// notices say so.
    pub(super) fn open_link(&mut self, text: &str) {
        let reading = query::parse_with_keys(text);
        if reading.keys_taken.is_empty() && !reading.notices.is_empty() {
            self.notices = reading.notices;
            let reason = tr("that is no sea: this one stays");
            self.notices.push(reason.to_owned());
            self.show_brief_message(reason);
            return;
        }
        self.set_state(text);
        if self.notices.is_empty() {
            self.show_brief_message(tr("Opened."));
        }
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
            Ok(name) => self.show_brief_message(&say!("Saved: {name}", name = name)),
            Err(reason) => self.notices.push(reason),
        }
    }
}
