//! The desktop window.

use super::dropped::most_bytes;
use super::{App, setup};
use crate::model::look::SkyFile;
use crate::model::{Params, query};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// Tries to come back after a lost device before giving up.
const MOST_LOSSES: usize = 3;

/// Opens a window on a state; returns when it is closed.
///
/// # Errors
/// One sentence, if there is no display or no GPU.
pub fn run(params: &Params) -> Result<(), String> {
    let sky = params.look.sky.file.clone();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn,wgpu_hal=error")).init();
    let mut state = query::write(params);
    for _ in 0..MOST_LOSSES {
        let lost: Arc<Mutex<Option<String>>> = Arc::default();
        open(&state, sky.as_ref(), &lost)?;
        // Left behind by the app when its device was lost; a closed window leaves nothing.
        match lost.lock().ok().and_then(|mut lost| lost.take()) {
            Some(at) => state = at,
            None => return Ok(()),
        }
        eprintln!("seastate: the GPU was lost; opening '{state}' again");
    }
    Err(format!("the GPU was lost {MOST_LOSSES} times; the sea was '{state}'"))
}

/// Reads files with their names; nothing larger than the program takes may be.
///
/// # Errors
/// One sentence, naming the file.
pub fn read_files(paths: &[PathBuf]) -> Result<Vec<(String, Vec<u8>)>, String> {
    let read = |path: &PathBuf| {
        let name = path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned());
        let fault = |e: std::io::Error| format!("cannot read {}: {e}", path.display());
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(fault)?;
        // One byte more than is allowed is enough to be refused.
        file.take(most_bytes(&name) as u64 + 1).read_to_end(&mut bytes).map_err(fault)?;
        Ok((name, bytes))
    };
    paths.iter().map(read).collect()
}

/// Reads the sky of a file.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn read_sky(path: &Path) -> Result<SkyFile, String> {
    let files = read_files(&[path.to_owned()])?;
    super::dropped::sky(&files[0].0, &files[0].1)
}

fn open(state: &str, sky: Option<&SkyFile>, lost: &Arc<Mutex<Option<String>>>) -> Result<(), String> {
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Seastate")
            .with_app_id("seastate")
            .with_inner_size([1280.0, 720.0])
            .with_min_inner_size([160.0, 120.0]),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: setup::wgpu_configuration(),
        ..Default::default()
    };
    let (state, sky, lost) = (state.to_owned(), sky.cloned(), Arc::clone(lost));
    let create = move |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>> {
        Ok(Box::new(Window { app: App::with_sky(cc, &state, sky)?, lost }))
    };
    eframe::run_native("Seastate", options, Box::new(create)).map_err(|e| format!("cannot open a window: {e}"))
}

/// The app, leaving its state behind when the device is lost.
struct Window {
    app: App,
    lost: Arc<Mutex<Option<String>>>,
}

impl eframe::App for Window {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        if self.app.device_lost().is_some()
            && let Ok(mut lost) = self.lost.lock()
        {
            *lost = Some(self.app.state());
        }
        self.app.logic(ctx, frame);
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.app.ui(ui, frame);
    }
}
