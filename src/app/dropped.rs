//! Files dropped on the window or the page: the spectra of a buoy.

use super::App;
use crate::model::measured::{MAX_FILES, Measured};
use egui::DroppedFileHandle;
use std::sync::{Arc, Mutex, PoisonError};

/// Names and contents, or why there are none.
type Files = Result<Vec<(String, Vec<u8>)>, String>;

/// The files of the last drop, once they are read: a browser takes its time.
#[derive(Clone, Default)]
pub struct Dropped(Arc<Mutex<Option<Files>>>);

impl Dropped {
    fn put(&self, files: Files) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(files);
    }

    fn take(&self) -> Option<Files> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Reads what was dropped on a window.
    #[cfg(not(target_arch = "wasm32"))]
    fn read(&self, handles: &[DroppedFileHandle], _ctx: &egui::Context) {
        let paths: Vec<_> = handles.iter().map(|h| h.path().to_owned()).collect();
        self.put(super::native::read_files(&paths));
    }

    /// Reads what was dropped on the page, and asks for a frame when it is there.
    #[cfg(target_arch = "wasm32")]
    fn read(&self, handles: &[DroppedFileHandle], ctx: &egui::Context) {
        let (dropped, handles, ctx) = (self.clone(), handles.to_vec(), ctx.clone());
        wasm_bindgen_futures::spawn_local(async move {
            let mut files = Vec::new();
            for handle in &handles {
                let name = handle.path().to_string_lossy().into_owned();
                // Asked before it is read: a film dropped by mistake would fill the tab's memory.
                let size = handle.web_file().map_or(0.0, |f| f.size());
                if size > crate::model::measured::MAX_FILE_BYTES as f64 {
                    return dropped.finish(Err(format!("{name}: too large for a buoy's file")), &ctx);
                }
                match handle.bytes_async().await {
                    Ok(bytes) => files.push((name, bytes)),
                    Err(reason) => return dropped.finish(Err(format!("cannot read {name}: {reason}")), &ctx),
                }
            }
            dropped.finish(Ok(files), &ctx);
        });
    }

    #[cfg(target_arch = "wasm32")]
    fn finish(&self, files: Files, ctx: &egui::Context) {
        self.put(files);
        ctx.request_repaint();
    }
}

impl App {
    /// Takes files that were dropped. What cannot be read changes nothing but the notices.
    pub(super) fn take_dropped(&mut self, ctx: &egui::Context) {
        let handles = ctx.input(|i| i.raw.dropped_files.clone());
        if handles.len() > MAX_FILES {
            self.notices = vec![format!("a buoy has at most {MAX_FILES} files: {} were dropped", handles.len())];
        } else if !handles.is_empty() {
            self.dropped.read(&handles, ctx);
        }
        let Some(files) = self.dropped.take() else { return };
        match files.and_then(|files| Measured::read(&files)) {
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
        "Drop a buoy's spectrum: NDBC text or CSV of f, S, direction, spread",
        egui::FontId::proportional(20.0),
        egui::Color32::WHITE,
    );
}
