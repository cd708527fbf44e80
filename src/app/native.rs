//! The desktop window.

use super::dropped::most_bytes;
use super::lifeboat::{Berth, Shell};
use super::{App, setup};
use crate::state::look::SkyFile;
use crate::state::{Params, query};
use std::cell::Cell;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::Duration;
use web_time::Instant;

/// Losses of the device, and refusals of another, that are borne within [`LOSS_WINDOW`] before giving up.
const MOST_LOSSES: usize = 8;
const LOSS_WINDOW: Duration = Duration::from_secs(60);
/// A driver that starts anew needs a moment, s.
const NEXT_TRY: Duration = Duration::from_secs(1);
/// With this in the environment, two keys take the GPU away, at a frame's beginning or end: so what happens then can be tried.
const REHEARSAL: &str = "SEASTATE_REHEARSE_LOSS";
const EARLY: egui::Key = egui::Key::F12;
const LATE: egui::Key = egui::Key::F11;

/// Opens a window on a state; returns when it is closed.
///
/// # Errors
/// One sentence, if there is no display or no GPU.
#[expect(clippy::disallowed_methods, reason = "no browser runs this one")]
pub fn run(params: &Params) -> Result<(), String> {
    let sky = params.look.sky.file.clone();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn,wgpu_hal=error")).init();
    let state = query::write(params);
    let (berth, place) = (Berth::default(), Rc::default());
    let mut losses: Vec<Instant> = Vec::new();
    loop {
        let opened = catch_unwind(AssertUnwindSafe(|| open(&state, sky.as_ref(), &berth, &place)));
        // Left behind when its device was lost; a closed window leaves nothing.
        let Some(at) = berth.borrow().as_ref().map(App::state) else {
            return opened.unwrap_or_else(|panic| resume_unwind(panic));
        };
        losses.retain(|then| then.elapsed() < LOSS_WINDOW);
        losses.push(Instant::now());
        if losses.len() > MOST_LOSSES {
            return Err(format!(
                "the GPU was lost {MOST_LOSSES} times within a minute: update its driver, then go on with: seastate \"{at}\""
            ));
        }
        match opened {
            Ok(Ok(())) | Err(_) => eprintln!("seastate: the GPU was lost; going on with another device"),
            Ok(Err(reason)) => {
                eprintln!("seastate: no other device yet: {reason}");
                wait(NEXT_TRY);
            }
        }
    }
}

#[expect(clippy::disallowed_methods, reason = "no window is open")]
fn wait(time: Duration) {
    std::thread::sleep(time);
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

/// Where a window is, so that the next one opens there.
#[derive(Clone, Copy, Default)]
struct Place {
    position: Option<egui::Pos2>,
    size: Option<egui::Vec2>,
    maximized: bool,
    fullscreen: bool,
}

impl Place {
    fn of(viewport: &egui::ViewportInfo) -> Self {
        Self {
            position: viewport.outer_rect.map(|r| r.min),
            size: viewport.inner_rect.map(|r| r.size()),
            maximized: viewport.maximized.unwrap_or_default(),
            fullscreen: viewport.fullscreen.unwrap_or_default(),
        }
    }

    fn viewport(self) -> egui::ViewportBuilder {
        let viewport = egui::ViewportBuilder::default()
            .with_title("Seastate")
            .with_app_id("seastate")
            .with_inner_size(self.size.unwrap_or(egui::vec2(1280.0, 720.0)))
            .with_min_inner_size([160.0, 120.0])
            .with_maximized(self.maximized)
            .with_fullscreen(self.fullscreen);
        match self.position {
            Some(position) => viewport.with_position(position),
            None => viewport,
        }
    }
}

fn open(state: &str, sky: Option<&SkyFile>, berth: &Berth, place: &Rc<Cell<Place>>) -> Result<(), String> {
    let options = eframe::NativeOptions {
        viewport: place.get().viewport(),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: setup::wgpu_configuration(),
        ..Default::default()
    };
    let (state, sky, berth, place) = (state.to_owned(), sky.cloned(), berth.clone(), place.clone());
    let create = move |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>> {
        let shell = Shell::new(cc, &berth, |cc| App::with_sky(cc, &state, sky))?;
        let rehearses = std::env::var_os(REHEARSAL).is_some();
        Ok(Box::new(Window { shell, berth, place, rehearses, doomed: false }))
    };
    eframe::run_native("Seastate", options, Box::new(create))
        .map_err(|e| format!("cannot open a window: {e} (without a desktop, 'seastate render' writes pictures)"))
}

/// The window, which lets the app go when its device is lost.
struct Window {
    shell: Shell,
    berth: Berth,
    place: Rc<Cell<Place>>,
    /// Whether the keys take the device away.
    rehearses: bool,
    /// Whether the device goes at the end of this frame.
    doomed: bool,
}

impl Window {
    /// Whether the device is lost; asks it.
    fn is_lost(&mut self) -> bool {
        self.shell.app().is_some_and(|app| {
            // Losses are told in here, whatever it returns.
            let _ = app.render_state().device.poll(wgpu::PollType::Poll);
            app.device_lost().is_some()
        })
    }

    fn destroy_device(&mut self) {
        if let Some(app) = self.shell.app() {
            app.render_state().device.destroy();
        }
    }
}

impl eframe::App for Window {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        let rehearsed = |key| self.rehearses && ctx.input(|i| i.key_pressed(key));
        self.doomed = rehearsed(LATE);
        if rehearsed(EARLY) {
            self.destroy_device();
        }
        self.place.set(ctx.input(|i| Place::of(i.viewport())));
        if self.is_lost() {
            // Nothing is left to paint, which egui could not do.
            self.shell.leave(&self.berth);
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        self.shell.logic(ctx, frame);
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.shell.ui(ui, frame);
        if std::mem::take(&mut self.doomed) {
            self.destroy_device();
        }
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        // egui panics where a device is lost between a frame's beginning and its end: the app outlives that, too.
        if std::thread::panicking() && self.is_lost() {
            self.shell.leave(&self.berth);
        }
    }
}
