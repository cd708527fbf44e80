//! The desktop window, and the sky image file that the command line opens for it.

use super::device_loss::{AppCreation, AppHost, ParkedApp};
use super::opened_files;
use super::{App, setup};
use crate::files::input::read_all;
use crate::state::look::SkyFile;
use crate::state::{Params, query};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::rc::Rc;
use std::time::Duration;
use web_time::Instant;

/// Largest number of GPU device losses and failed attempts to get a new device, counted together, that the program
/// survives within [`DEVICE_LOSS_WINDOW`]. One more ends it with an error.
const MAX_DEVICE_LOSSES: usize = 8;
/// Period over which the failures of [`MAX_DEVICE_LOSSES`] are counted; older ones are forgotten.
const DEVICE_LOSS_WINDOW: Duration = Duration::from_secs(60);
/// Pause before another attempt to open a window after a failure: a graphics driver that restarts needs a moment.
const RETRY_DELAY: Duration = Duration::from_secs(1);
/// Environment variable that makes F11 and F12 destroy the GPU device, so that tests can rehearse a device loss.
const REHEARSE_LOSS_VARIABLE: &str = "SEASTATE_REHEARSE_LOSS";
/// Key that destroys the GPU device at the start of a frame, in a rehearsal of a device loss.
const LOSE_DEVICE_AT_START_KEY: egui::Key = egui::Key::F12;
/// Key that destroys the GPU device at the end of a frame, in a rehearsal of a device loss.
const LOSE_DEVICE_AT_END_KEY: egui::Key = egui::Key::F11;

/// Opens the desktop window with the given parameters. Returns when the user closes it. `is_first_sea`: the user named no
/// sea, so these are the parameters of the first one; who sees it for the first time is offered the first steps.
///
/// # Errors
/// One sentence, if there is no display or no GPU, or if the GPU device is lost too often.
#[expect(clippy::disallowed_methods, reason = "no browser runs this one")]
pub fn run(params: &Params, is_first_sea: bool) -> Result<(), String> {
    let sky = params.look.sky.file.clone();
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("warn,wgpu_hal=error")).init();
    let state = query::write(params);
    let (parked, last_window) = (ParkedApp::default(), Rc::default());
    let mut losses: Vec<Instant> = Vec::new();
    loop {
        let opened =
            catch_unwind(AssertUnwindSafe(|| open_window(&state, is_first_sea, sky.as_ref(), &parked, &last_window)));
        // The app is parked only if its GPU device was lost.
        let Some(at) = parked.borrow().as_ref().map(App::state) else {
            return opened.unwrap_or_else(|panic| resume_unwind(panic));
        };
        losses.retain(|then| then.elapsed() < DEVICE_LOSS_WINDOW);
        losses.push(Instant::now());
        if losses.len() > MAX_DEVICE_LOSSES {
            return Err(format!(
                "the GPU was lost {MAX_DEVICE_LOSSES} times within a minute: update its driver, then go on with: \
                 seastate \"{at}\""
            ));
        }
        match opened {
            Ok(Ok(())) | Err(_) => eprintln!("seastate: the GPU was lost; going on with another device"),
            Ok(Err(reason)) => {
                eprintln!("seastate: no other device yet: {reason}");
                wait(RETRY_DELAY);
            }
        }
    }
}

#[expect(clippy::disallowed_methods, reason = "no window is open")]
fn wait(time: Duration) {
    std::thread::sleep(time);
}

/// Reads and decodes the sky image (equirectangular, .hdr or .exr) in the file at `path`.
///
/// # Errors
/// One sentence that names the file and the reason.
pub fn read_sky_file(path: &Path) -> Result<SkyFile, String> {
    let files = read_all(&[path.to_owned()])?;
    opened_files::decode_sky_file(&files[0].0, &files[0].1)
}

/// Settings of the desktop window to open. After a device loss `last` describes the previous window, whose position,
/// size and full-screen state are kept.
fn viewport_builder(last: &egui::ViewportInfo) -> egui::ViewportBuilder {
    let usual_size = egui::vec2(1280.0, 720.0);
    let mut viewport = egui::ViewportBuilder::default()
        .with_title("Seastate")
        .with_app_id("seastate")
        .with_inner_size(last.inner_rect.map_or(usual_size, |r| r.size()))
        .with_min_inner_size([160.0, 120.0])
        .with_maximized(last.maximized.unwrap_or_default())
        .with_fullscreen(last.fullscreen.unwrap_or_default());
    viewport.position = last.outer_rect.map(|r| r.min);
    viewport
}

type LastWindow = Rc<RefCell<egui::ViewportInfo>>;

fn open_window(
    state: &str,
    is_first_sea: bool,
    sky: Option<&SkyFile>,
    parked: &ParkedApp,
    last_window: &LastWindow,
) -> Result<(), String> {
    let options = eframe::NativeOptions {
        viewport: viewport_builder(&last_window.borrow()),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: setup::wgpu_configuration(),
        ..Default::default()
    };
    let (state, sky, parked, last_window) = (state.to_owned(), sky.cloned(), parked.clone(), last_window.clone());
    let create = move |cc: &eframe::CreationContext<'_>| -> AppCreation {
        let host = AppHost::new(cc, &parked, |cc| {
            let mut app = App::with_sky(cc, &state, sky)?;
            app.load_preferences();
            app.allow_slow_camera();
            if is_first_sea {
                app.offer_first_steps();
            }
            Ok(app)
        })?;
        let rehearses = std::env::var_os(REHEARSE_LOSS_VARIABLE).is_some();
        Ok(Box::new(Window { host, parked, last_window, rehearses, loses_device: false }))
    };
    eframe::run_native("Seastate", options, Box::new(create))
        .map_err(|e| format!("cannot open a window: {e} (without a desktop, 'seastate render' writes pictures)"))
}

/// The eframe app of the desktop window. It parks the inner app when the GPU device is lost.
struct Window {
    host: AppHost,
    parked: ParkedApp,
    last_window: LastWindow,
    /// Whether the keys F11 and F12 destroy the GPU device on purpose, to test the recovery from a device loss. The
    /// variable [`REHEARSE_LOSS_VARIABLE`] sets it.
    rehearses: bool,
    /// Whether the GPU device is to be destroyed at the end of this frame, as a test.
    loses_device: bool,
}

impl Window {
    /// Whether the GPU device is lost. Polls the device first, because wgpu reports a loss only then.
    fn is_lost(&mut self) -> bool {
        self.host.app().is_some_and(|app| {
            // The loss callback runs during the poll; its result does not matter.
            let _ = app.render_state().device.poll(wgpu::PollType::Poll);
            app.device_lost().is_some()
        })
    }

    fn destroy_device(&mut self) {
        if let Some(app) = self.host.app() {
            app.render_state().device.destroy();
        }
    }
}

impl eframe::App for Window {
    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        let rehearsed = |key| self.rehearses && ctx.input(|i| i.key_pressed(key));
        self.loses_device = rehearsed(LOSE_DEVICE_AT_END_KEY);
        if rehearsed(LOSE_DEVICE_AT_START_KEY) {
            self.destroy_device();
        }
        self.last_window.replace(ctx.input(|i| i.viewport().clone()));
        if self.is_lost() {
            // egui-wgpu panics when it paints with a lost device.
            self.host.park(&self.parked);
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        self.host.logic(ctx, frame);
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        self.host.ui(ui, frame);
        if std::mem::take(&mut self.loses_device) {
            self.destroy_device();
        }
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        // egui-wgpu panics if the device is lost during a frame. Parking the app here lets it survive this, too.
        if std::thread::panicking() && self.is_lost() {
            self.host.park(&self.parked);
        }
    }
}
