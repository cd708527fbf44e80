//! Files dropped on the window or the page: spectra of a buoy or a wave model, a sky image, a saved picture or a list of seas.

#[cfg(target_arch = "wasm32")]
use super::tasks;
use super::{App, tasks::Inbox};
use crate::files::measured::{MAX_FILES_PER_SPECTRUM, MeasuredSpectrum};
use crate::files::{input, panorama, picture};
use crate::state::look::SkyFile;
use crate::state::presets;
use egui::DroppedFileHandle;
use std::sync::Arc;

/// Result of reading the files that the user dropped at once: name and contents of each, or a sentence that says why
/// they cannot be read.
pub type OpenedFiles = Result<Vec<(String, Vec<u8>)>, String>;

/// Decodes the contents `bytes` of a sky image file (.hdr or .exr) called `name`.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn decode_sky_file(name: &str, bytes: &[u8]) -> Result<SkyFile, String> {
    let image = panorama::read(name, bytes)?;
    let file = SkyFile::from_path(name).ok_or("the sky's file has no name")?;
    Ok(SkyFile { image: Some(Arc::new(image)), ..file })
}

/// Reads files that were dropped on the desktop window, and puts their contents into `inbox`.
#[cfg(not(target_arch = "wasm32"))]
fn read_dropped_files(inbox: &Inbox<OpenedFiles>, handles: &[DroppedFileHandle], ctx: &egui::Context) {
    let paths: Vec<_> = handles.iter().map(|h| h.path().to_owned()).collect();
    inbox.put(input::read_all(&paths), ctx);
}

/// Reads files that were dropped on the web page, and puts their contents into `inbox` when they are read.
#[cfg(target_arch = "wasm32")]
fn read_dropped_files(inbox: &Inbox<OpenedFiles>, handles: &[DroppedFileHandle], ctx: &egui::Context) {
    let (inbox, handles, ctx) = (inbox.clone(), handles.to_vec(), ctx.clone());
    tasks::spawn(async move {
        let mut files = Vec::new();
        for handle in &handles {
            let name = handle.path().to_string_lossy().into_owned();
            // The size is checked before the file is read: a large video would fill the tab's memory.
            let size = handle.web_file().map_or(0.0, |f| f.size());
            if size > input::max_file_bytes(&name) as f64 {
                let reason = format!(
                    "{name}: too large for any file that Seastate reads: a spectrum (16 MiB) or a sky (.hdr, .exr)"
                );
                return inbox.put(Err(reason), &ctx);
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
    /// Begins to read files that were dropped on the window, and opens those whose contents have arrived. Every frame
    /// calls this. A file that cannot be read changes only the notices.
    pub(super) fn take_opened_files(&mut self, ctx: &egui::Context) {
        let handles = ctx.input(|i| i.raw.dropped_files.clone());
        if handles.len() > MAX_FILES_PER_SPECTRUM {
            self.notices =
                vec![format!("a buoy has at most {MAX_FILES_PER_SPECTRUM} files: {} were dropped", handles.len())];
        } else if !handles.is_empty() {
            read_dropped_files(&self.dropped_files, &handles, ctx);
        }
        let Some(files) = self.dropped_files.take().pop() else { return };
        if let Err(reason) = files.and_then(|files| self.open_files(&files)) {
            self.notices = vec![reason];
        }
    }

    /// Opens a saved picture, a list of seas or a sky image, recognised by its contents; other files are read as measured
    /// spectra.
    fn open_files(&mut self, files: &[(String, Vec<u8>)]) -> Result<(), String> {
        if let [(name, bytes)] = files {
            if picture::is_png(bytes) {
                let state = picture::state_from_png(bytes).map_err(|reason| format!("{name}: {reason}"))?;
                // Like a link, a picture without a version is one of the first version.
                let state = format!("?{state}");
                self.open_link(&state);
                return Ok(());
            }
            if let Some(text) = std::str::from_utf8(bytes).ok().filter(|text| presets::is_preset_file(text)) {
                self.import_seas(text);
                return Ok(());
            }
            if panorama::is_sky_file(name, bytes) {
                self.use_sky_file(decode_sky_file(name, bytes)?);
                return Ok(());
            }
        }
        self.use_spectra(MeasuredSpectrum::read_list(files)?);
        Ok(())
    }

    /// Adds the seas of a text file, which the panel's button "Export" saved, to the user's own named seas, in place of
    /// those of equal name.
    fn import_seas(&mut self, text: &str) {
        let (seas, notices) = presets::read_kept(text);
        let count = seas.len();
        self.notices = notices;
        match self.own_seas.add(seas) {
            Ok(()) => self.show_brief_message(&format!("{count} seas imported")),
            Err(reason) => self.notices.push(reason),
        }
    }

    /// Makes an opened image the sky of the sea, and shows its size (pixels) and the elevation of its sun in the
    /// notices. A `file` whose image is not loaded changes nothing.
    fn use_sky_file(&mut self, file: SkyFile) {
        let Some(panorama) = &file.image else { return };
        let sun = panorama.sun.as_ref().map(|s| format!(", sun {:.0}° high", s.elevation_deg)).unwrap_or_default();
        self.news = vec![format!("{}: {} x {}{sun}", file.name, panorama.width, panorama.height)];
        self.notices.clone_from(&panorama.notices);
        self.params.look.sky.file = Some(file.clone());
        self.sky = Some(file);
    }
}

/// Draws a list of the kinds of files that can be dropped, while the user drags files over the window.
pub fn show_drop_hint(ctx: &egui::Context) {
    if ctx.input(|i| i.raw.hovered_files.is_empty()) {
        return;
    }
    let painter = ctx.debug_painter();
    let screen = ctx.content_rect();
    painter.rect_filled(screen, 0.0, egui::Color32::from_black_alpha(140));
    painter.text(
        screen.center(),
        egui::Align2::CENTER_CENTER,
        "Drop a sky (.hdr, .exr), a picture saved here, a file of seas,\n\
         or a spectrum: a buoy's (NDBC text, Spotter JSON, CSV of f, S, direction, spread)\n\
         or a model's (SWAN .spc .sp2, WAVEWATCH III text or NetCDF, ERA5 NetCDF, CSV)",
        egui::FontId::proportional(20.0),
        egui::Color32::WHITE,
    );
}
