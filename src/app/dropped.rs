//! Files dropped on the window or the page: the spectra of a buoy, or a sky.

#[cfg(target_arch = "wasm32")]
use super::tasks;
use super::tasks::Inbox;
use super::{App, picture};
use crate::files::measured::{MAX_FILE_BYTES, MAX_FILES, MeasuredSpectrum};
use crate::files::panorama;
use crate::state::look::SkyFile;
use crate::state::presets;
use egui::DroppedFileHandle;
use std::sync::Arc;

/// Names and contents, or why there are none.
pub type Files = Result<Vec<(String, Vec<u8>)>, String>;

/// The largest file of a name that is read.
pub fn most_bytes(name: &str) -> usize {
    // A picture that carries its state may be large, too.
    let large = panorama::is_sky(name, &[]) || name.to_ascii_lowercase().ends_with(".png");
    if large { panorama::MAX_BYTES } else { MAX_FILE_BYTES }
}

/// The sky of a file's contents.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn sky(name: &str, bytes: &[u8]) -> Result<SkyFile, String> {
    let image = panorama::read(name, bytes)?;
    let file = SkyFile::named(name).ok_or("the sky's file has no name")?;
    Ok(SkyFile { image: Some(Arc::new(image)), ..file })
}

/// Reads what was dropped on a window.
#[cfg(not(target_arch = "wasm32"))]
fn read(inbox: &Inbox<Files>, handles: &[DroppedFileHandle], ctx: &egui::Context) {
    let paths: Vec<_> = handles.iter().map(|h| h.path().to_owned()).collect();
    inbox.put(super::native::read_files(&paths), ctx);
}

/// Reads what was dropped on the page, and asks for a frame when it is there.
#[cfg(target_arch = "wasm32")]
fn read(inbox: &Inbox<Files>, handles: &[DroppedFileHandle], ctx: &egui::Context) {
    let (inbox, handles, ctx) = (inbox.clone(), handles.to_vec(), ctx.clone());
    tasks::spawn(async move {
        let mut files = Vec::new();
        for handle in &handles {
            let name = handle.path().to_string_lossy().into_owned();
            // Asked before it is read: a film dropped by mistake would fill the tab's memory.
            let size = handle.web_file().map_or(0.0, |f| f.size());
            if size > most_bytes(&name) as f64 {
                return inbox.put(Err(format!("{name}: too large for any file that Seastate reads: a buoy's spectrum (text) or a sky (.hdr, .exr)")), &ctx);
            }
            match handle.bytes_async().await {
                Ok(bytes) => files.push((name, bytes)),
                Err(reason) => return inbox.put(Err(format!("cannot read {name}: {reason}")), &ctx),
            }
        }
        inbox.put(Ok(files), &ctx);
    });
}

impl App {
    /// Takes files that were dropped. What cannot be read changes nothing but the notices.
    pub(super) fn take_dropped(&mut self, ctx: &egui::Context) {
        let handles = ctx.input(|i| i.raw.dropped_files.clone());
        if handles.len() > MAX_FILES {
            self.notices = vec![format!("a buoy has at most {MAX_FILES} files: {} were dropped", handles.len())];
        } else if !handles.is_empty() {
            read(&self.dropped, &handles, ctx);
        }
        let Some(files) = self.dropped.take().pop() else { return };
        if let Ok([(name, bytes)]) = files.as_deref()
            && picture::is_png(bytes)
        {
            match picture::state_of(bytes) {
                Ok(state) => self.open_link(&state),
                Err(reason) => self.notices = vec![format!("{name}: {reason}")],
            }
            return;
        }
        if let Ok([(_, bytes)]) = files.as_deref()
            && let Some(text) = std::str::from_utf8(bytes).ok().filter(|text| presets::is_file(text))
        {
            let (seas, notices) = presets::read(text);
            let count = seas.len();
            self.notices = notices;
            match self.seas.add(seas) {
                Ok(()) => self.say(&format!("{count} seas imported")),
                Err(reason) => self.notices.push(reason),
            }
            return;
        }
        if let Ok([(name, bytes)]) = files.as_deref()
            && panorama::is_sky(name, bytes)
        {
            match sky(name, bytes) {
                Ok(file) => self.show_sky(file),
                Err(reason) => self.notices = vec![reason],
            }
            return;
        }
        match files.and_then(|files| MeasuredSpectrum::read(&files)) {
            Ok((measured, notices)) => {
                let name = if measured.title().is_empty() { "the buoy's sea" } else { measured.title() };
                let bands = measured.f_hz().len();
                self.notices = vec![format!("{name}: {bands} bands, Hs {:.2} m", measured.hs_m())];
                self.notices.extend(notices);
                self.params.sea.show_measured(measured);
            }
            Err(reason) => self.notices = vec![reason],
        }
    }

    /// Shows a sky that was read, and says what it is.
    fn show_sky(&mut self, file: SkyFile) {
        let Some(panorama) = &file.image else { return };
        let sun = panorama.sun.as_ref().map(|s| format!(", sun {:.0}° high", s.elevation_deg)).unwrap_or_default();
        self.notices = vec![format!("{}: {} x {}{sun}", file.name, panorama.width, panorama.height)];
        self.notices.extend(panorama.notices.iter().cloned());
        self.params.look.sky.file = Some(file.clone());
        self.sky = Some(file);
    }
}

/// Says what may be dropped while something hovers over the sea.
pub fn invite(ctx: &egui::Context) {
    if ctx.input(|i| i.raw.hovered_files.is_empty()) {
        return;
    }
    let painter = ctx.debug_painter();
    let screen = ctx.content_rect();
    painter.rect_filled(screen, 0.0, egui::Color32::from_black_alpha(140));
    painter.text(
        screen.center(),
        egui::Align2::CENTER_CENTER,
        "Drop a sky (.hdr, .exr), a picture saved here, a file of seas,\nor a buoy's spectrum (NDBC text or CSV of f, S, direction, spread)",
        egui::FontId::proportional(20.0),
        egui::Color32::WHITE,
    );
}
