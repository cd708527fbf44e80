//! The page: what JavaScript calls, and the address kept in step with the state.

use super::faults::Faults;
use super::lifeboat::{Berth, Shell};
use super::readers::Item;
use super::{App, setup, tasks, tidy};
use crate::bench::{self, BenchOptions, PassTiming};
use crate::gpu::Gpu;
use crate::ocean;
use crate::state::{Params, query};
use half::f16;
use std::cell::RefCell;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use web_time::Instant;

/// Least time between two writes of the address, s: browsers refuse more than about three a second.
const WRITE_EVERY_S: f32 = 0.7;

/// The running program, as the page sees it.
#[wasm_bindgen]
pub struct WebHandle {
    runner: eframe::WebRunner,
    /// The app between two devices.
    berth: Berth,
    /// Those of the device that the app draws with; known even when the app has panicked.
    faults: Rc<RefCell<Faults>>,
}

#[wasm_bindgen]
impl WebHandle {
    /// Installs the panic hook and the log; starts nothing.
    #[wasm_bindgen(constructor)]
    #[expect(clippy::new_without_default, reason = "made by JavaScript")]
    pub fn new() -> Self {
        console_error_panic_hook::set_once();
        // A second handle on the same page finds the log in place.
        let _ = eframe::WebLogger::init(log::LevelFilter::Warn);
        Self { runner: eframe::WebRunner::new(), berth: Berth::default(), faults: Rc::default() }
    }

    /// Starts on a canvas with the state of the address; or, after a device was lost, goes on there with another. Rejects
    /// with a sentence, and may be called again then.
    ///
    /// # Errors
    /// If there is no usable WebGPU.
    pub async fn start(&self, canvas: web_sys::HtmlCanvasElement) -> Result<(), JsValue> {
        let options = eframe::WebOptions { wgpu_options: setup::wgpu_configuration(), ..Default::default() };
        if let Some(mut shell) = self.runner.app_mut::<Shell>() {
            shell.leave(&self.berth);
        }
        let (berth, faults) = (self.berth.clone(), self.faults.clone());
        let create = move |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>> {
            let mut shell = Shell::new(cc, &berth, from_address)?;
            faults.replace(shell.app().map(|app| app.faults.clone()).unwrap_or_default());
            Ok(Box::new(shell))
        };
        self.runner.start(canvas, options, Box::new(create)).await?;
        tasks::spawn(leave_when_lost(self.runner.clone(), self.berth.clone(), self.faults.borrow().clone()));
        Ok(())
    }

    /// Stops and lets go of the canvas.
    pub fn destroy(&self) {
        self.runner.destroy();
    }

    /// Whether the program has panicked.
    pub fn has_panicked(&self) -> bool {
        self.runner.has_panicked()
    }

    /// The panic's message.
    pub fn panic_message(&self) -> Option<String> {
        self.runner.panic_summary().map(|s| s.message())
    }

    /// The current state string.
    pub fn state(&self) -> String {
        self.with(|app| app.state()).unwrap_or_default()
    }

    /// Turns to another state, as if the user had set every value.
    pub fn set_state(&self, state: &str) {
        self.with(|app| app.set_state(state));
    }

    /// Frames painted so far.
    pub fn frames(&self) -> f64 {
        self.with(|app| app.frames() as f64).unwrap_or_default()
    }

    /// Whether a picture of the device at hand has been finished by the GPU, and not only ordered.
    pub fn seen(&self) -> bool {
        self.with(|app| app.is_seen()).unwrap_or_default()
    }

    /// Asks for one more frame, and says whether the picture is complete: the foam of a cold start takes a few frames.
    pub fn settled(&self) -> bool {
        self.with(|app| app.settled()).unwrap_or_default()
    }

    /// Place of the widget with a label, in points: x, y, width, height. For tests; ask again after a frame.
    pub fn place(&self, label: &str) -> Option<Vec<f64>> {
        let items = self.items();
        let named = || items.iter().filter(|item| item.label == label);
        // A slider comes before its number, and a text is no widget.
        named().find(|item| item.role != "Label").or_else(|| named().next()).map(|item| item.place.to_vec())
    }

    /// Labels and values of all widgets, for tests.
    pub fn labels(&self) -> Vec<String> {
        self.items().iter().map(|item| format!("{}: {}", item.label, item.value)).collect()
    }

    /// What screen readers are told: an array of objects for widgets and texts in reading order, with `id`, `role` (that of
    /// AccessKit), `label`, `value`, `now`, `least`, `greatest`, `step`, `on`, `open`, `disabled`; empty until a frame after the
    /// first question.
    pub fn described(&self) -> js_sys::Array {
        self.items().iter().map(described).collect()
    }

    /// The sea in one line, and what the program said last.
    pub fn told(&self) -> String {
        self.with(|app| app.told()).unwrap_or_default()
    }

    /// Does to a widget what a screen reader asks for: `click`, `focus`, `more`, `less`, `set` a number, `type` a text.
    pub fn act(&self, id: &str, action: &str, value: f64, text: &str) {
        self.with(|app| app.readers.act(&app.ctx, id, action, value, text));
    }

    /// Why the GPU was lost, if it was.
    pub fn device_lost(&self) -> Option<String> {
        self.faults.borrow().lost()
    }

    /// The maps of a state at its time, for tests: `n`, `cascades`, `heights` (f32 copy of eta) and `displacement`
    /// (the bits of the half-float map), cascade by cascade.
    ///
    /// # Errors
    /// If the program does not run or the GPU does not give its memory back.
    pub async fn read_back(&self, state: String) -> Result<JsValue, JsValue> {
        let render_state = self.with(|app| app.render_state().clone()).ok_or("the program is not running")?;
        let gpu = Gpu { device: render_state.device, queue: render_state.queue };
        let (params, _) = query::parse(&state);
        let maps = ocean::maps::read(&gpu, &params).await?;
        let heights: Vec<f32> = (0..maps.cascades()).flat_map(|c| maps.displacement(c).iter().map(|d| d[1])).collect();
        let texels = ocean::maps::read_displacement(&gpu, &params).await?;
        let halves: Vec<u16> = texels.iter().flatten().map(|&x| f16::from_f32(x).to_bits()).collect();
        let out = js_sys::Object::new();
        let set = |key: &str, value: &JsValue| js_sys::Reflect::set(&out, &key.into(), value);
        set("n", &JsValue::from(maps.n as u32))?;
        set("cascades", &JsValue::from(maps.cascades() as u32))?;
        set("heights", &js_sys::Float32Array::from(&heights[..]))?;
        set("displacement", &js_sys::Uint16Array::from(&halves[..]))?;
        Ok(out.into())
    }

    /// Measures what a state costs on this browser's GPU, on a device of its own; `seastate bench --baseline` of the page.
    /// `progress` is told what comes next. Gives an object with `text`, the table, and `passes`, objects with `pass`, `n`,
    /// `cascades`, `width`, `height`, `ms`.
    ///
    /// # Errors
    /// If there is no GPU, or it is lost meanwhile.
    pub async fn bench(&self, state: String, repeat: u32, progress: js_sys::Function) -> Result<JsValue, JsValue> {
        let gpu = Gpu::request().await?;
        let faults = Faults::watch(&gpu.device);
        let options = BenchOptions { sizes: vec![[1280, 720]], repeat, matrix: false, baseline: true };
        // What a listener does is its own affair.
        let tell = |what: &str| drop(progress.call1(&JsValue::NULL, &what.into()));
        let report = bench::run(&gpu, &query::parse(&state).0, &options, tell).await?;
        // A lost device does all at once, and nothing.
        if let Some(reason) = faults.lost().or_else(|| faults.errors().first().cloned()) {
            return Err(reason.into());
        }
        let passes: js_sys::Array = report.rows.iter().map(measured).collect();
        let out = js_sys::Object::new();
        js_sys::Reflect::set(&out, &"text".into(), &report.to_string().into())?;
        js_sys::Reflect::set(&out, &"passes".into(), &passes)?;
        Ok(out.into())
    }

    fn items(&self) -> Vec<Item> {
        self.with(|app| app.readers.items(&app.ctx)).unwrap_or_default()
    }

    fn with<T>(&self, f: impl FnOnce(&mut App) -> T) -> Option<T> {
        if let Some(app) = self.berth.borrow_mut().as_mut() {
            return Some(f(app));
        }
        let mut shell = self.runner.app_mut::<Shell>()?;
        shell.app().map(f)
    }
}

fn measured(row: &PassTiming) -> JsValue {
    let out = js_sys::Object::new();
    // Setting a property of a fresh object cannot fail.
    let set = |key: &str, value: JsValue| drop(js_sys::Reflect::set(&out, &key.into(), &value));
    set("pass", row.pass.into());
    set("n", row.sea.map(|[n, _]| n).into());
    set("cascades", row.sea.map(|[_, cascades]| cascades).into());
    set("width", row.size.map(|[width, _]| width).into());
    set("height", row.size.map(|[_, height]| height).into());
    set("ms", row.timing.ms().into());
    out.into()
}

fn described(item: &Item) -> JsValue {
    let out = js_sys::Object::new();
    // Setting a property of a fresh object cannot fail.
    let set = |key: &str, value: JsValue| drop(js_sys::Reflect::set(&out, &key.into(), &value));
    set("id", item.id.as_str().into());
    set("role", item.role.as_str().into());
    set("label", item.label.as_str().into());
    set("value", item.value.as_str().into());
    if let Some((now, [least, greatest, step])) = item.number {
        set("now", now.into());
        set("least", least.into());
        set("greatest", greatest.into());
        set("step", step.into());
    }
    set("on", item.on.into());
    set("open", item.open.into());
    set("disabled", item.disabled.into());
    out.into()
}

/// Whether the visitor has asked for less motion.
fn prefers_stillness() -> bool {
    let asked = web_sys::window().and_then(|w| w.match_media("(prefers-reduced-motion: reduce)").ok().flatten());
    asked.is_some_and(|m| m.matches())
}

/// Stops eframe before its next frame: one that a lost device presents halts all of Firefox's tab.
async fn leave_when_lost(runner: eframe::WebRunner, berth: Berth, faults: Faults) {
    faults.when_lost().await;
    if let Some(mut shell) = runner.app_mut::<Shell>() {
        shell.leave(&berth);
    }
    runner.destroy();
}

/// The app on the state of the address.
fn from_address(cc: &eframe::CreationContext<'_>) -> Result<App, String> {
    let mut app = App::new(cc, &address_query())?;
    if prefers_stillness() {
        app.params.clock.paused = true;
    }
    Ok(app)
}

fn address_query() -> String {
    eframe::web::web_location().query
}

/// The page's address with another state.
pub fn link(state: &str) -> String {
    let location = eframe::web::web_location();
    let base = location.url.split(['?', '#']).next().unwrap_or_default().to_owned();
    if state.is_empty() { base } else { format!("{base}?{state}") }
}

/// What the address says, so that only changes are written and going back is noticed.
pub struct Address {
    /// The query as last read or written.
    query: String,
    /// The parameters of the current entry of the history.
    entry: Params,
    written: Instant,
}

impl Address {
    /// The address that the program was started with.
    pub fn new(params: &Params) -> Self {
        Self { query: address_query(), entry: tidy(params), written: Instant::now() }
    }
}

impl App {
    /// The sea in one line, and what was said last.
    fn told(&self) -> String {
        let sea = super::panel::summary(self);
        self.said.as_ref().map_or_else(|| sea.clone(), |(said, _)| format!("{sea}. {said}"))
    }

    /// Follows the address when the user went back or forward; else writes the state to it. A change of the sea or the
    /// light is a new entry of the history, time and camera replace the current one.
    pub(super) fn keep_address(&mut self) {
        let query = address_query();
        if query != self.address.query {
            let clock = self.params.clock.clone();
            self.set_state(&query);
            // Going back means the sea and the view, not the time, unless time was part of the question.
            if !clock.paused && !self.params.clock.paused {
                self.params.clock.t_s = clock.t_s;
            }
            self.address.query = query;
            self.address.entry = tidy(&self.params);
            return;
        }
        let now = tidy(&self.params);
        let state = query::write(&now);
        if state == query::write(&self.address.entry) {
            return;
        }
        if self.address.written.elapsed().as_secs_f32() < WRITE_EVERY_S {
            // Written a little later, even if nothing else asks for a frame until then.
            self.ctx.request_repaint_after(std::time::Duration::from_secs_f32(WRITE_EVERY_S));
            return;
        }
        let same_entry = Params { clock: now.clock.clone(), camera: now.camera.clone(), ..self.address.entry.clone() };
        let address = link(&state);
        let Some(history) = web_sys::window().and_then(|w| w.history().ok()) else { return };
        let written = if same_entry == now {
            history.replace_state_with_url(&JsValue::NULL, "", Some(&address))
        } else {
            history.push_state_with_url(&JsValue::NULL, "", Some(&address))
        };
        // A refusal (too many writes) is tried again at the next turn.
        if written.is_ok() {
            self.address.query = address_query();
            self.address.entry = now;
        }
        self.address.written = Instant::now();
    }
}
