//! Files that are dropped on the window or the page, or chosen in a dialog: spectra of a buoy or a wave model, a sky
//! image, a bathymetry, a saved picture or a list of seas.

#[cfg(target_arch = "wasm32")]
use super::tasks;
use super::{App, notices, tasks::Inbox};
use crate::app::language::{say, text, tr};
use crate::files::measured::{MAX_FILES_PER_SPECTRUM, MeasuredSpectrum};
use crate::files::panorama::{self, Panorama};
use crate::files::{bathymetry, input, picture};
use crate::state::look::SkyFile;
use crate::state::presets;
use egui::DroppedFileHandle;
use std::sync::Arc;

/// What can be opened, in words, for the panel.
pub const OPENABLE_FILES: &str = text!(
    "A sky (.hdr, .exr), a picture saved here, a file of seas, a coast (GeoTIFF, NetCDF, ESRI ASCII grid, text of \
    x, y, z), or a spectrum: a buoy's (NDBC text, Spotter JSON, CSV) or a wave model's (SWAN, WAVEWATCH III, ERA5). \
    Dropping works, too."
);
/// Extensions of the files that the dialog offers first. Files of NDBC have others, which its second filter shows.
#[cfg(not(target_arch = "wasm32"))]
const USUAL_EXTENSIONS: [&str; 18] = [
    "hdr",
    "exr",
    "png",
    "txt",
    "csv",
    "json",
    "nc",
    "spc",
    "sp2",
    "spec",
    "data_spec",
    "swden",
    "spt",
    "tif",
    "tiff",
    "asc",
    "grd",
    "xyz",
];
/// A buoy's spectrum to try: swell and a wind sea (assets/spectra).
const SAMPLE_SPECTRUM: (&str, &str) = ("two-systems.txt", include_str!("../../assets/spectra/two-systems.txt"));
/// Name of the sky to try.
const SAMPLE_SKY_NAME: &str = "sample-dusk.hdr";
/// Width and height of the sky to try, pixels.
const SAMPLE_SKY_SIZE: [usize; 2] = [256, 128];

/// Result of reading the files that the user opened at once: name and contents of each, or a sentence that says why
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
    read_web_files(inbox, handles.iter().filter_map(|h| h.web_file().cloned()).collect(), ctx);
}

/// Reads files of the browser, and puts their contents into `inbox` when they are read.
#[cfg(target_arch = "wasm32")]
pub fn read_web_files(inbox: &Inbox<OpenedFiles>, handles: Vec<web_sys::File>, ctx: &egui::Context) {
    let (inbox, ctx) = (inbox.clone(), ctx.clone());
    tasks::spawn(async move {
        let mut files = Vec::new();
        for file in &handles {
            let name = file.name();
            // The size is checked before the file is read: a large video would fill the tab's memory.
            let size = file.size();
            if size > input::max_file_bytes(&name) as f64 {
                let reason = format!(
                    "{name}: too large for any file that Seastate reads: a spectrum (16 MiB), a coast (64 MiB) or a sky (.hdr, \
                     .exr)"
                );
                return inbox.put(Err(reason), &ctx);
            }
            match wasm_bindgen_futures::JsFuture::from(file.array_buffer()).await {
                Ok(buffer) => files.push((name, js_sys::Uint8Array::new(&buffer).to_vec())),
                Err(reason) => return inbox.put(Err(format!("cannot read {name}: {reason:?}")), &ctx),
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
            self.refuse(too_many_files(handles.len()));
        } else if !handles.is_empty() {
            read_dropped_files(&self.opened_files, &handles, ctx);
        }
        let Some(files) = self.opened_files.take().pop() else { return };
        match files {
            Ok(files) => self.open_or_notify(&files),
            Err(reason) => self.refuse(reason),
        }
    }

    /// Says over the sea that a file was opened, and keeps `details` of it in the panel.
    pub(super) fn tell_opened(&mut self, message: &str, details: String) {
        self.news = vec![details];
        self.show_brief_message(message);
    }

    /// Says over the sea, and in the panel, why a file was not opened.
    fn refuse(&mut self, reason: String) {
        self.show_brief_message(&notices::translate(&reason));
        self.notices = vec![reason];
    }

    /// Takes the files at `paths` as the user's choice whenever a dialog would ask for one: a test cannot answer the
    /// system's dialog. An empty list stands for a dialog that was closed.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn answer_file_dialogs(&mut self, paths: Vec<std::path::PathBuf>) {
        self.chosen_files = Some(paths);
    }

    /// Lets the user choose files to open, with the system's dialog. They are opened when they have been read.
    #[cfg(not(target_arch = "wasm32"))]
    pub(super) fn choose_files(&self) {
        if let Some(paths) = &self.chosen_files {
            if !paths.is_empty() {
                self.opened_files.put(input::read_all(paths), &self.ctx);
            }
            return;
        }
        let dialog = rfd::AsyncFileDialog::new()
            .set_title("Open a sky, a coast, a spectrum, a picture or seas")
            .add_filter("Skies, coasts, spectra, pictures and seas", &USUAL_EXTENSIONS)
            .add_filter("All files", &["*"]);
        // The dialog is made on this thread, as macOS demands, and waited for on another.
        let (chosen, inbox, ctx) = (dialog.pick_files(), self.opened_files.clone(), self.ctx.clone());
        super::tasks::spawn(async move {
            let paths: Vec<_> = chosen.await.unwrap_or_default().iter().map(|file| file.path().to_owned()).collect();
            if paths.len() > MAX_FILES_PER_SPECTRUM {
                inbox.put(Err(too_many_files(paths.len())), &ctx);
            } else if !paths.is_empty() {
                inbox.put(input::read_all(&paths), &ctx);
            }
        });
    }

    /// Lets the user choose files to open: clicks the page's file input, whose files come back by [`Self::open_chosen`].
    #[cfg(target_arch = "wasm32")]
    pub(super) fn choose_files(&self) {
        super::web_page::tell_page("seastate-choose-files");
    }

    /// Opens the files that the user has chosen in the page's file input.
    #[cfg(target_arch = "wasm32")]
    pub(super) fn open_chosen(&mut self, files: Vec<web_sys::File>) {
        if files.len() > MAX_FILES_PER_SPECTRUM {
            self.refuse(too_many_files(files.len()));
        } else {
            read_web_files(&self.opened_files, files, &self.ctx);
        }
        self.ctx.request_repaint();
    }

    /// Opens the sample spectrum.
    pub(super) fn open_sample_spectrum(&mut self) {
        let (name, text) = SAMPLE_SPECTRUM;
        self.open_or_notify(&[(name.to_owned(), text.as_bytes().to_vec())]);
    }

    /// Makes the sample sky that of the sea: clear, with a low sun.
    pub(super) fn open_sample_sky(&mut self) {
        match sample_sky() {
            Ok(file) => self.use_sky_file(file),
            Err(reason) => self.refuse(reason),
        }
    }

    fn open_or_notify(&mut self, files: &[(String, Vec<u8>)]) {
        if let Err(reason) = self.open_files(files) {
            self.refuse(reason);
        }
    }

    /// Opens a saved picture, a list of seas, a sky image or a bathymetry, recognised by its contents; other files are read
    /// as measured spectra, and what is none as a bathymetry.
    fn open_files(&mut self, files: &[(String, Vec<u8>)]) -> Result<(), String> {
        if let [(name, bytes)] = files {
            if picture::is_png(bytes) {
                let state = picture::state_from_png(bytes).map_err(|reason| format!("{name}: {reason}"))?;
                // Like a link, a picture without a version is one of the first version.
                let state = format!("?{state}");
                self.open_link(&state);
                if self.notices.is_empty() {
                    self.show_brief_message(tr("This is the sea of your picture."));
                }
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
            if bathymetry::is_bathymetry_file(name, bytes) {
                return self.use_coast_file(name, bytes);
            }
        }
        match (MeasuredSpectrum::read_list(files), files) {
            (Ok(list), _) => self.use_spectra(list),
            // NetCDF and text hold either. What is neither is refused as what most such files are.
            (Err(reason), [(name, bytes)]) => self.use_coast_file(name, bytes).map_err(|_| reason)?,
            (Err(reason), _) => return Err(reason),
        }
        Ok(())
    }

    /// Adds the seas of a text file, which the panel's button "Export" saved, to the user's own named seas, in place of
    /// those of equal name.
    fn import_seas(&mut self, text: &str) {
        let (seas, notices) = presets::read_kept(text);
        let count = seas.len();
        let reason = notices.first().filter(|_| count == 0).map(|reason| notices::translate(reason));
        self.notices = notices;
        if let Some(reason) = reason {
            self.show_brief_message(&reason);
            return;
        }
        match self.own_seas.add(seas) {
            Ok(()) => self.show_brief_message(&say!("{count} seas imported", count = count)),
            Err(reason) => self.notices.push(reason),
        }
    }

    /// Makes an opened image the sky of the sea, and shows its size (pixels) and the elevation of its sun in the
    /// panel. A `file` whose image is not loaded changes nothing.
    fn use_sky_file(&mut self, file: SkyFile) {
        let Some(panorama) = &file.image else { return };
        let size = format!("{}: {} x {}", file.name, panorama.width, panorama.height);
        let details = match &panorama.sun {
            Some(sun) => {
                let degrees = format!("{:.0}", sun.elevation_deg);
                say!("{size}, sun {degrees}° high", size = size, degrees = degrees)
            }
            None => size,
        };
        self.tell_opened(&say!("{name} is the sky now.", name = file.name), details);
        self.notices.clone_from(&panorama.notices);
        self.params.look.sky.file = Some(file.clone());
        self.sky = Some(file);
    }
}

/// The notice that more files were opened at once than a buoy's spectrum has.
fn too_many_files(count: usize) -> String {
    format!("a buoy has at most {MAX_FILES_PER_SPECTRUM} files: {count} were opened")
}

/// A sky of dusk to try: orange at the horizon around the sun, blue above, in relative units of light.
fn sample_sky() -> Result<SkyFile, String> {
    let [width, height] = SAMPLE_SKY_SIZE;
    let (sun_x, sun_y) = (0.5 * width as f64, 0.44 * height as f64);
    let pixel = |i: usize| {
        let (x, y) = ((i % width) as f64 + 0.5, (i / width) as f64 + 0.5);
        let up = (1.0 - 2.0 * y / height as f64).clamp(0.0, 1.0);
        let from_sun = (x - sun_x).hypot(y - sun_y) / height as f64;
        let (glow, band) = ((-9.0 * from_sun).exp(), (-7.0 * up).exp());
        let sky = [0.05, 0.13, 0.32];
        let dusk = [0.75, 0.36, 0.16];
        let sun = if from_sun < 0.012 { 900.0 } else { 0.0 };
        [0, 1, 2].map(|c| (sky[c] + dusk[c] * (0.45 * band + 1.6 * glow) + sun * [1.0, 0.62, 0.35][c]) as f32)
    };
    let image = Panorama::new(width, height, (0..width * height).map(pixel).collect())?;
    let file = SkyFile::from_path(SAMPLE_SKY_NAME).ok_or("the sky's file has no name")?;
    Ok(SkyFile { image: Some(Arc::new(image)), ..file })
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
        tr("Drop a sky (.hdr, .exr), a picture saved here, a file of seas,\n\
         a coast (GeoTIFF, NetCDF, ESRI ASCII grid, text of x, y, z)\n\
         or a spectrum: a buoy's (NDBC text, Spotter JSON, CSV of f, S, direction, spread)\n\
         or a model's (SWAN .spc .sp2, WAVEWATCH III text or NetCDF, ERA5 NetCDF, CSV)"),
        egui::FontId::proportional(20.0),
        egui::Color32::WHITE,
    );
}
