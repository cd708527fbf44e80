//! The web page: functions that JavaScript calls, and the page's address (URL), which contains the current state.

use super::device_loss::{AppCreation, AppHost, ParkedApp};
use super::gpu_errors::GpuErrors;
use super::screen_readers::AccessibleItem;
use super::web_page::{accessible_item_object, is_automated, is_framed, js_object, page_link, pass_timing_object};
use super::{App, setup, tasks};
use crate::bench::{self, BenchOptions};
use crate::gpu::Gpu;
use crate::ocean::Ocean;
use crate::state::start::given_or_start;
use crate::state::{Params, query, rounding::with_rounded_pose};
use half::f16;
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use web_time::Instant;

/// Least time between two changes of the page's address, s. Browsers refuse more than about three changes per second.
const ADDRESS_WRITE_INTERVAL_S: f32 = 0.7;

/// Handle through which JavaScript starts, queries and stops the app on the web page.
#[wasm_bindgen]
pub struct WebHandle {
    runner: eframe::WebRunner,
    /// Slot that holds the app while it waits for a new GPU device after a device loss; empty while the app runs.
    parked: ParkedApp,
    /// Errors of the current GPU device. They stay readable after the app has panicked.
    gpu_errors: Rc<RefCell<GpuErrors>>,
}

#[wasm_bindgen]
impl WebHandle {
    /// Creates the handle, and installs the panic hook and the logger. The app does not run before [`Self::start`].
    #[wasm_bindgen(constructor)]
    #[expect(clippy::new_without_default, reason = "made by JavaScript")]
    pub fn new() -> Self {
        console_error_panic_hook::set_once();
        // This fails for a second handle on the same page, which shares the logger.
        let _ = eframe::WebLogger::init(log::LevelFilter::Warn);
        Self { runner: eframe::WebRunner::new(), parked: ParkedApp::default(), gpu_errors: Rc::default() }
    }

    /// Starts the app on a canvas with the state string in the page's address. After a device loss, continues the
    /// parked app on a new GPU device.
    ///
    /// # Errors
    /// One sentence, if WebGPU cannot be used. The caller may try again.
    pub async fn start(&self, canvas: web_sys::HtmlCanvasElement) -> Result<(), JsValue> {
        let mut options = eframe::WebOptions { wgpu_options: setup::wgpu_configuration(), ..Default::default() };
        if is_framed() {
            // A finger that moves up or down scrolls the other page, so its first touches stay the browser's, too.
            options.should_prevent_default = Box::new(|event| {
                !matches!(event, egui::Event::PointerButton { pressed: true, .. } | egui::Event::PointerMoved(_))
            });
        }
        if let Some(mut host) = self.runner.app_mut::<AppHost>() {
            host.park(&self.parked);
        }
        let (parked, gpu_errors) = (self.parked.clone(), self.gpu_errors.clone());
        let create = move |cc: &eframe::CreationContext<'_>| -> AppCreation {
            let mut host = AppHost::new(cc, &parked, app_from_address)?;
            gpu_errors.replace(host.app().map(|app| app.gpu_errors.clone()).unwrap_or_default());
            Ok(Box::new(host))
        };
        self.runner.start(canvas, options, Box::new(create)).await?;
        tasks::spawn(park_when_lost(self.runner.clone(), self.parked.clone(), self.gpu_errors.borrow().clone()));
        Ok(())
    }

    /// Stops the app and releases the canvas. A parked app (one that waits for a new GPU device) is kept.
    pub fn destroy(&self) {
        self.runner.destroy();
    }

    /// Whether the app has panicked.
    pub fn has_panicked(&self) -> bool {
        self.runner.has_panicked()
    }

    /// The message of the app's panic; `None` if it has not panicked.
    pub fn panic_message(&self) -> Option<String> {
        self.runner.panic_summary().map(|s| s.message())
    }

    /// The current parameters as a state string; empty if the app does not run.
    pub fn state(&self) -> String {
        self.with_app(|app| app.state()).unwrap_or_default()
    }

    /// Replaces all parameters by those of a state string. Keys that are missing there get their default values.
    pub fn set_state(&self, state: &str) {
        self.with_app(|app| app.set_state(state));
    }

    /// The current parameters as the state string of a link, with a version where one is needed; empty if the app does not
    /// run.
    pub fn link_state(&self) -> String {
        self.with_app(|app| query::write_to_keep(&with_rounded_pose(&app.params))).unwrap_or_default()
    }

    /// The sea in a few words, such as `Force 5 sea, waves 1.9 m high`; empty if the app does not run.
    pub fn sea_in_words(&self) -> String {
        self.with_current_sea(|app| app.sea_in_words()).unwrap_or_default()
    }

    /// Heights of the sea above the still water, m, at points and a time, from its strongest waves. `places` holds x
    /// (east) and z (south) of one point after the other, m; `t_s` is the simulated time, s, without one the present.
    pub fn heights(&self, places: &[f64], t_s: Option<f64>) -> Vec<f64> {
        self.with_current_sea(|app| app.heights_m(places, t_s)).unwrap_or_default()
    }

    /// Opens files, which the user has chosen, as if they had been dropped on the page.
    pub fn open_files(&self, files: Vec<web_sys::File>) {
        self.with_app(|app| app.open_chosen(files));
    }

    /// Shows a message for a few seconds.
    pub fn show_message(&self, text: &str) {
        self.with_app(|app| app.show_brief_message(text));
    }

    /// Number of frames that the app has laid out and painted since it was created, also while simulated time is
    /// stopped.
    pub fn frames(&self) -> f64 {
        self.with_app(|app| app.frames() as f64).unwrap_or_default()
    }

    /// Whether the GPU has finished the first picture since the start or since the last device loss.
    pub fn has_first_picture(&self) -> bool {
        self.with_app(|app| app.has_first_picture()).unwrap_or_default()
    }

    /// Requests one more frame. Returns whether the picture is complete: the GPU has finished the first one, all past
    /// foam steps are computed, and no cross-fade between two seas is in progress.
    pub fn is_picture_complete(&self) -> bool {
        self.with_app(|app| app.is_picture_complete()).unwrap_or_default()
    }

    /// Bounds of the widget with the given label, in CSS pixels: x and y of the top left corner, width, height; `None` if
    /// there is no such widget. Browser tests use it; the bounds are valid until the next frame.
    pub fn widget_bounds(&self, label: &str) -> Option<Vec<f64>> {
        let items = self.items();
        let named = || items.iter().filter(|item| item.label == label);
        // A parameter has a slider, then a number field and a text with the same label: this takes the slider.
        let item = named().find(|item| item.role != "Label").or_else(|| named().next())?;
        let zoom = self.with_app(|app| f64::from(app.ctx.zoom_factor()))?;
        Some(item.bounds.iter().map(|x| zoom * x).collect())
    }

    /// Widgets and texts for screen readers: an array of objects in reading order, with `id`, `role` (AccessKit's
    /// name), `label`, `value` (text), `now`, `least`, `greatest`, `step` (numbers), `on` (of a check box), `open` (of
    /// a section), `disabled` and `clickable`. Empty until the frame after the first call.
    pub fn accessible_items(&self) -> js_sys::Array {
        self.items().iter().map(accessible_item_object).collect()
    }

    /// One line for screen readers: wave height, Beaufort number and the current message.
    pub fn announcement(&self) -> String {
        self.with_app(|app| app.announcement()).unwrap_or_default()
    }

    /// Applies a screen reader's action to the widget with the given `id`: `click`, `focus`, `more` or `less` (one step
    /// of its value), `set` (to the number `value`) or `type` (enters the string `text` and confirms it).
    pub fn perform_widget_action(&self, id: &str, action: &str, value: f64, text: &str) {
        self.with_app(|app| app.screen_readers.perform_widget_action(&app.ctx, id, action, value, text));
    }

    /// The reason why the GPU device was lost; `None` while it works.
    pub fn device_lost(&self) -> Option<String> {
        self.gpu_errors.borrow().lost()
    }

    /// Computes the wave maps of the sea of a state string at its time, for tests. Returns an object with `n` (FFT
    /// size), `cascades` (their number) and, one cascade after the other, `heights` (f32, m) and `displacement` (texels
    /// Dx, height, Dz (m) and dDx/dz, as the bits of half floats).
    ///
    /// # Errors
    /// If the app does not run, or reading back from the GPU fails.
    pub async fn read_back(&self, state: String) -> Result<JsValue, JsValue> {
        let render_state = self.with_app(|app| app.render_state().clone()).ok_or("the program is not running")?;
        let gpu = Gpu { device: render_state.device, queue: render_state.queue };
        let (params, _) = query::parse(&state);
        let mut ocean = Ocean::without_renderer(&gpu, &params);
        let maps = ocean.read_maps().await?;
        let heights: Vec<f32> =
            (0..maps.cascade_count()).flat_map(|c| maps.displacement(c).iter().map(|d| d[1])).collect();
        let texels = ocean.read_displacement().await?;
        let halves: Vec<u16> = texels.iter().flatten().map(|&x| f16::from_f32(x).to_bits()).collect();
        Ok(js_object([
            ("n", (maps.n as u32).into()),
            ("cascades", (maps.cascade_count() as u32).into()),
            ("heights", js_sys::Float32Array::from(&heights[..]).into()),
            ("displacement", js_sys::Uint16Array::from(&halves[..]).into()),
        ]))
    }

    /// Measures the time of each GPU pass for the sea of a state string on a second device of this browser, as
    /// `seastate bench --baseline` does, from `repeat` GPU submissions. Calls `progress` with the name of each
    /// measurement.
    ///
    /// Returns an object with `text` (the table) and `passes`, objects with `pass` (its name), `n` (FFT size),
    /// `cascades` (their number), `width` and `height` (of the picture, pixels) and `ms` (GPU time; wall time where the
    /// GPU time is unknown).
    ///
    /// # Errors
    /// If there is no GPU, or its device is lost during the measurement.
    pub async fn bench(&self, state: String, repeat: u32, progress: js_sys::Function) -> Result<JsValue, JsValue> {
        let gpu = Gpu::request().await?;
        let errors = GpuErrors::watch(&gpu.device);
        let options = BenchOptions {
            picture_sizes_px: vec![[1280, 720]],
            submissions_per_measurement: repeat,
            matrix: false,
            baseline: true,
        };
        // An exception thrown by `progress` is ignored.
        let tell = |what: &str| drop(progress.call1(&JsValue::NULL, &what.into()));
        let report = bench::run(&gpu, &query::parse(&state).0, &options, tell).await?;
        // A lost device completes every pass immediately without computing anything, so its times are worthless.
        if let Some(reason) = errors.lost().or_else(|| errors.errors().first().cloned()) {
            return Err(reason.into());
        }
        let passes: js_sys::Array = report.rows.iter().map(pass_timing_object).collect();
        Ok(js_object([("text", report.to_string().into()), ("passes", passes.into())]))
    }

    fn items(&self) -> Vec<AccessibleItem> {
        self.with_app(|app| app.screen_readers.items(&app.ctx)).unwrap_or_default()
    }

    /// As [`Self::with_app`], after the statistics and waves of a sea that was set since the last frame are computed.
    fn with_current_sea<T>(&self, f: impl FnOnce(&mut App) -> T) -> Option<T> {
        self.with_app(|app| {
            app.update_derived_sea_data();
            f(app)
        })
    }

    pub(super) fn with_app<T>(&self, f: impl FnOnce(&mut App) -> T) -> Option<T> {
        if let Some(app) = self.parked.borrow_mut().as_mut() {
            return Some(f(app));
        }
        let mut host = self.runner.app_mut::<AppHost>()?;
        host.app().map(f)
    }
}

/// Whether a media query fits this browser, such as that the user has asked for reduced motion.
pub(super) fn media_matches(query: &str) -> bool {
    let asked = web_sys::window().and_then(|w| w.match_media(query).ok().flatten());
    asked.is_some_and(|m| m.matches())
}

/// Waits for a loss of the GPU device, then parks the app and stops eframe: presenting a frame with a lost device hangs
/// a Firefox tab.
async fn park_when_lost(runner: eframe::WebRunner, parked: ParkedApp, gpu_errors: GpuErrors) {
    gpu_errors.when_lost().await;
    if let Some(mut host) = runner.app_mut::<AppHost>() {
        host.park(&parked);
    }
    runner.destroy();
}

/// Creates an app with the state string in the page's address. Its clock is stopped if the user prefers reduced motion.
fn app_from_address(cc: &eframe::CreationContext<'_>) -> Result<App, String> {
    let mut app = App::new(cc, &address_link(&address_query()))?;
    if media_matches("(pointer: coarse)") {
        super::panel::touch::remember(&cc.egui_ctx);
    }
    if media_matches("(prefers-reduced-motion: reduce)") {
        app.params.clock.paused = true;
    } else if !(is_framed() || is_automated()) {
        app.allow_slow_camera();
    }
    app.load_preferences();
    if address_query().is_empty() && !(is_framed() || is_automated()) {
        app.offer_first_steps();
    }
    Ok(app)
}

fn address_query() -> String {
    eframe::web::web_location().query
}

/// Link to the sea of the page's address with the query `query`.
fn address_link(query: &str) -> String {
    format!("?{}", given_or_start(query))
}

/// The page's address (URL) as the app last read or wrote it. If the browser's address then differs, the user went back
/// or forward.
pub struct Address {
    /// State string in the page's address (the query, without `?`) as the app last read or wrote it.
    query: String,
    /// Parameters of the current entry in the browser's history, with camera and time rounded as in a link. If more
    /// than time and camera changes, a new entry is added.
    history_entry_params: Params,
    last_write: Instant,
    /// Title of the browser's tab as the app last wrote it.
    title: String,
}

impl Address {
    /// Reads the page's address at the start of the app, whose parameters are `params`.
    pub fn new(params: &Params) -> Self {
        Self {
            query: address_query(),
            history_entry_params: with_rounded_pose(params),
            last_write: Instant::now(),
            title: String::new(),
        }
    }
}

impl App {
    /// One line for screen readers: wave height, Beaufort number and the current message.
    fn announcement(&self) -> String {
        let sea = super::panel::sea_summary(self);
        self.message.as_ref().map_or_else(|| sea.clone(), |message| format!("{sea}. {}", message.text))
    }

    /// Makes the sea in words the title of the browser's tab.
    pub(super) fn write_tab_title(&mut self) {
        let title = self.tab_title();
        if title != self.address.title
            && let Some(document) = web_sys::window().and_then(|w| w.document())
        {
            document.set_title(&title);
            self.address.title = title;
        }
    }

    /// Keeps the state string in the page's address and the app's parameters equal. After back or forward it opens the
    /// address; otherwise it writes the parameters to it. A change of sea or light adds an entry to the browser's
    /// history; a change of only time or camera replaces the current entry.
    pub(super) fn sync_address_and_state(&mut self) {
        let query = address_query();
        if query != self.address.query {
            let clock = self.params.clock.clone();
            self.set_state(&address_link(&query));
            // A running clock keeps its time, unless the opened link stops the clock.
            if !clock.paused && !self.params.clock.paused {
                self.params.clock.t_s = clock.t_s;
            }
            self.address.query = query;
            self.address.history_entry_params = with_rounded_pose(&self.params);
            return;
        }
        let now = with_rounded_pose(&self.params);
        let state = query::write_to_keep(&now);
        if state == query::write_to_keep(&self.address.history_entry_params) {
            return;
        }
        if self.address.last_write.elapsed().as_secs_f32() < ADDRESS_WRITE_INTERVAL_S {
            // It is too early: a later frame writes the address.
            self.ctx.request_repaint_after(std::time::Duration::from_secs_f32(ADDRESS_WRITE_INTERVAL_S));
            return;
        }
        let same_entry = Params {
            clock: now.clock.clone(),
            camera: now.camera.clone(),
            ..self.address.history_entry_params.clone()
        };
        let address = page_link(&state);
        let Some(history) = web_sys::window().and_then(|w| w.history().ok()) else { return };
        // In a frame, entries would make the visitor leave the other page by "back" only after many steps.
        let written = if same_entry == now || is_framed() {
            history.replace_state_with_url(&JsValue::NULL, "", Some(&address))
        } else {
            history.push_state_with_url(&JsValue::NULL, "", Some(&address))
        };
        // The browser refuses too frequent changes; a later frame tries again.
        if written.is_ok() {
            self.address.query = address_query();
            self.address.history_entry_params = now;
        }
        self.address.last_write = Instant::now();
    }
}
