//! The program that people see: one eframe app for the page and the window. The only room that knows egui and the browser.

mod access;
mod camera;
mod caption;
mod dropped;
mod faults;
mod files;
mod gauges;
mod history;
pub mod keys;
pub mod lifeboat;
pub mod maps;
#[cfg(not(target_arch = "wasm32"))]
pub mod native;
mod panel;
mod plots;
mod quality;
#[cfg(target_arch = "wasm32")]
mod readers;
mod report;
pub mod setup;
mod share;
mod tasks;
mod units;
mod viewport;
#[cfg(target_arch = "wasm32")]
pub mod web;

pub use crate::files::picture;

use crate::gpu::Gpu;
use crate::point::Heights;
use crate::point::floating::HullWaves;
use crate::state::floats::{Float, FloatKind, MAX_FLOATS};
use crate::state::look::SkyFile;
use crate::state::params::Camera;
use crate::state::{Params, query};
use crate::waves::Plan;
use crate::waves::statistics::{Resolved, Theory};
use faults::Faults;
use std::cell::OnceCell;

/// Longest step of the simulated time from one frame to the next, s: a page that was hidden goes on where it was.
const LONGEST_STEP_S: f64 = 0.1;

/// Things that float are put no farther away than this, m: nobody would see them.
const FARTHEST_FLOAT_M: f64 = 3000.0;

/// How long an answer stays, s.
const SAID_S: f64 = 4.0;

const NO_WGPU: &str = "eframe was started without wgpu";

/// What is derived from the parameters once, when they change, and not in every frame.
struct Derived {
    of: Params,
    plan: Plan,
    theory: Theory,
    /// Sums over all waves: only when somebody looks.
    resolved: OnceCell<Resolved>,
    /// The waves under what floats: only if something does, or is plotted.
    waterline: OnceCell<HullWaves>,
    /// Directions of the waves: only when their plot is looked at.
    wheel: OnceCell<plots::polar::Wheel>,
}

impl Derived {
    fn new(params: &Params) -> Self {
        let plan = Plan::new(params);
        let theory = Theory::new(&plan);
        Self {
            of: params.clone(),
            plan,
            theory,
            resolved: OnceCell::new(),
            waterline: OnceCell::new(),
            wheel: OnceCell::new(),
        }
    }

    fn resolved(&self) -> &Resolved {
        self.resolved.get_or_init(|| Resolved::new(&self.plan, self.theory.m0_m2))
    }

    fn heights(&self) -> &Heights {
        self.waterline.get_or_init(|| HullWaves::new(&self.plan)).heights()
    }

    fn wheel(&self) -> &plots::polar::Wheel {
        self.wheel.get_or_init(|| plots::polar::Wheel::new(&self.plan))
    }
}

/// The app.
pub struct App {
    params: Params,
    /// What the state string said that could not be taken.
    notices: Vec<String>,
    derived: Derived,
    render_state: egui_wgpu::RenderState,
    ctx: egui::Context,
    faults: Faults,
    frames: u64,
    /// Files of drops, once they are read: a browser takes its time.
    dropped: tasks::Inbox<dropped::Files>,
    panel: panel::Panel,
    seas: panel::Seas,
    history: history::History,
    quality: quality::Quality,
    /// Whether the list of keys is open.
    help: bool,
    /// A short answer, and until when it is shown (time of egui, s).
    said: Option<(String, f64)>,
    /// Camera, and the time if it stands, as they were when nobody moved them.
    rested: Option<(Camera, Option<f64>)>,
    /// What was drawn in the last frame, and in how many pixels.
    drawn: Option<(Params, [u32; 2])>,
    /// The record of the first buoy, or of the water below the camera.
    series: plots::Series,
    /// What the next click puts on the water.
    placing: Option<FloatKind>,
    save_folder: Option<std::path::PathBuf>,
    /// Pictures that have been saved, or why not.
    saved: tasks::Inbox<Result<String, String>>,
    /// The last sky that was read, for links that name it.
    sky: Option<SkyFile>,
    /// Told by the viewport's frames.
    progress: viewport::Progress,
    gauges: gauges::Gauges,
    measured: gauges::Measured,
    /// What the browser calls itself.
    #[cfg(target_arch = "wasm32")]
    browser: String,
    #[cfg(target_arch = "wasm32")]
    address: web::Address,
    #[cfg(target_arch = "wasm32")]
    readers: readers::Readers,
}

impl App {
    /// Starts on a state string, or a pasted URL.
    ///
    /// # Errors
    /// If eframe has no wgpu device.
    pub fn new(cc: &eframe::CreationContext<'_>, state: &str) -> Result<Self, String> {
        Self::with_sky(cc, state, None)
    }

    /// The same with a sky that has been read, in case the state names it.
    ///
    /// # Errors
    /// If eframe has no wgpu device.
    pub fn with_sky(cc: &eframe::CreationContext<'_>, state: &str, sky: Option<SkyFile>) -> Result<Self, String> {
        let render_state = cc.wgpu_render_state.clone().ok_or(NO_WGPU)?;
        let (mut params, notices) = query::parse(state);
        params.look.sky.attach(sky.as_ref());
        let seas = panel::Seas::load();
        let quality = quality::Quality::on(render_state.adapter.get_info().device_type, params.clock.paused);
        let grid = quality.grid(&params.grid, &params.screen);
        let faults = lifeboat::lay_out(&render_state, &Params { grid, ..params.clone() });
        setup::style(&cc.egui_ctx);
        #[cfg(target_arch = "wasm32")]
        let readers = readers::Readers::default();
        #[cfg(target_arch = "wasm32")]
        cc.egui_ctx.add_plugin(readers.clone());
        Ok(Self {
            derived: Derived::new(&params),
            notices: [notices, seas.notices()].concat(),
            render_state,
            ctx: cc.egui_ctx.clone(),
            faults,
            frames: 0,
            dropped: tasks::Inbox::default(),
            panel: panel::Panel::default(),
            seas,
            history: history::History::default(),
            quality,
            help: false,
            said: None,
            drawn: None,
            rested: Some(standing(&params)),
            series: plots::Series::default(),
            placing: None,
            save_folder: None,
            saved: tasks::Inbox::default(),
            sky: sky.filter(|s| s.image.is_some()),
            progress: viewport::Progress::default(),
            gauges: gauges::Gauges::default(),
            measured: gauges::Measured::default(),
            #[cfg(target_arch = "wasm32")]
            browser: cc.integration_info.web_info.user_agent.clone(),
            #[cfg(target_arch = "wasm32")]
            address: web::Address::new(&params),
            #[cfg(target_arch = "wasm32")]
            readers,
            params,
        })
    }

    /// The current state string.
    pub fn state(&self) -> String {
        query::write(&tidy(&self.params))
    }

    /// Turns to another state, as if the user had set every value.
    pub fn set_state(&mut self, state: &str) {
        (self.params, self.notices) = query::parse(state);
        self.params.look.sky.attach(self.sky.as_ref());
        self.rested = Some(standing(&self.params));
        // Called from outside a frame too, when time stands still and nothing else asks for one.
        self.ctx.request_repaint();
    }

    /// Pixels of the last picture.
    pub fn picture_size(&self) -> [u32; 2] {
        self.quality.size()
    }

    /// Where pictures and tables are saved, instead of the folder for pictures; a page downloads them.
    pub fn set_save_folder(&mut self, folder: std::path::PathBuf) {
        self.save_folder = Some(folder);
    }

    /// Significant wave height in the GPU's maps, m, once it has been measured while its number or its plot is shown.
    pub fn measured_hs_m(&self) -> Option<f64> {
        self.measured.hs_m()
    }

    /// Frames painted so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Whether a picture has been finished on the device that the app draws with.
    pub fn is_seen(&self) -> bool {
        self.progress.is_seen()
    }

    /// Asks for one more frame, and says whether the picture is complete: whether the foam of a cold start has caught up.
    pub fn settled(&self) -> bool {
        self.ctx.request_repaint();
        self.progress.is_seen() && !self.progress.is_catching_up()
    }

    /// Why the GPU was lost, if it was.
    pub fn device_lost(&self) -> Option<String> {
        self.faults.lost()
    }

    /// The distinct GPU errors so far.
    pub fn errors(&self) -> Vec<String> {
        self.faults.errors()
    }

    fn gpu(&self) -> Gpu {
        Gpu { device: self.render_state.device.clone(), queue: self.render_state.queue.clone() }
    }

    /// The device that the app draws with.
    pub fn render_state(&self) -> &egui_wgpu::RenderState {
        &self.render_state
    }

    fn advance(&mut self, ctx: &egui::Context) {
        // Nor does time go on while the first picture is still being made.
        if self.params.clock.paused || self.progress.is_awaited() {
            return;
        }
        let dt = f64::from(ctx.input(|i| i.stable_dt)).min(LONGEST_STEP_S);
        self.params.clock.t_s += dt * self.params.clock.speed;
        ctx.request_repaint();
    }

    fn keys(&mut self, ctx: &egui::Context) {
        if ctx.egui_wants_keyboard_input() {
            return;
        }
        let pressed = |key| ctx.input(|i| i.key_pressed(key));
        let plain = |key| ctx.input(|i| i.key_pressed(key) && !i.modifiers.command && !i.modifiers.alt);
        let command = |key| ctx.input_mut(|i| i.consume_key(egui::Modifiers::COMMAND, key));
        if ctx.input_mut(|i| i.consume_key(egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, egui::Key::Z))
            || command(egui::Key::Y)
        {
            self.history.redo(&mut self.params);
        } else if command(egui::Key::Z) {
            self.history.undo(&mut self.params);
        }
        let clock = &mut self.params.clock;
        // Space presses the button that has the keyboard's focus, arrows move its slider.
        let free = ctx.memory(|m| m.focused().is_none());
        if free && pressed(egui::Key::Space) {
            clock.paused = !clock.paused;
        }
        if free && pressed(egui::Key::Home) {
            clock.t_s = 0.0;
        }
        if pressed(egui::Key::Period) {
            panel::time::step(clock, 1.0);
        }
        if pressed(egui::Key::Comma) {
            panel::time::step(clock, -1.0);
        }
        if plain(egui::Key::H) {
            self.params.screen.panel = !self.params.screen.panel;
        }
        if plain(egui::Key::L) {
            self.copy_link();
        }
        if plain(egui::Key::P) {
            self.save_picture();
        }
        if pressed(egui::Key::F1) || pressed(egui::Key::Questionmark) {
            self.help = !self.help;
        }
        let help = self.help && pressed(egui::Key::Escape);
        if help {
            self.help = false;
        }
        let back = help || caption::keys(&mut self.params.look.view, ctx);
        if !back && cfg!(not(target_arch = "wasm32")) && pressed(egui::Key::Escape) {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        if free {
            camera::keys(&mut self.params.camera, ctx);
        }
    }

    /// Where the record is taken: its name, m east and m south.
    fn series_place(&self) -> (&'static str, [f64; 2]) {
        match self.params.floats.first() {
            Some(float) => ("the first buoy", [float.x_m, float.z_m]),
            None => ("the camera's foot", [self.params.camera.x_m, self.params.camera.z_m]),
        }
    }

    /// Keeps the record of a buoy while there is one, or while its plot is looked at.
    fn record(&mut self, ctx: &egui::Context) {
        let wanted = !self.params.floats.is_empty() || gauges::is_looked_at(ctx, gauges::Look::Record);
        if !wanted || self.params.clock.paused && self.series.is_current(self.params.clock.t_s) {
            return;
        }
        let (_, place) = self.series_place();
        let (sea, level_m) = (self.derived.heights(), self.params.sea.level_m);
        let height = |t_s| sea.sample(place[0], place[1], t_s).height_m - level_m;
        self.series.advance(self.params.clock.t_s, place, height);
    }

    /// Puts a buoy where the pointer is (B), or what the panel has asked for where the sea is clicked.
    fn place(&mut self, response: &egui::Response, ctx: &egui::Context) {
        if self.placing.is_some() && response.hovered() {
            ctx.set_cursor_icon(egui::CursorIcon::Crosshair);
        }
        let key = !ctx.egui_wants_keyboard_input() && ctx.input(|i| i.key_pressed(egui::Key::B));
        let (kind, at) = match (response.clicked().then_some(self.placing).flatten(), key) {
            (Some(kind), _) => (kind, response.interact_pointer_pos()),
            (None, true) => (FloatKind::Buoy, response.hover_pos().or(Some(response.rect.center()))),
            (None, false) => return,
        };
        self.placing = None;
        let Some(at) = at else { return };
        let Some([x_m, z_m]) = self.sea_at(at, response.rect) else {
            self.say("There is no water there.");
            return;
        };
        if self.params.floats.len() >= MAX_FLOATS {
            self.say("There is no room for more.");
            return;
        }
        let round = |x: f64| (10.0 * x).round() / 10.0;
        self.params.floats.push(Float { kind, x_m: round(x_m), z_m: round(z_m) });
    }

    /// The place on the sea under a point of the window, m east and south.
    fn sea_at(&self, at: egui::Pos2, rect: egui::Rect) -> Option<[f64; 2]> {
        let camera = &self.params.camera;
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        let view = crate::state::camera::View::new(camera, aspect, 0.0);
        let to = (at - rect.center()) / (0.5 * rect.size());
        let ray = view.ray(f64::from(to.x), -f64::from(to.y));
        let level_m = self.params.sea.level_m;
        let mut height_m = level_m;
        let mut place = None;
        // The ray meets the waves, not the still water.
        for _ in 0..8 {
            let distance = (height_m - camera.y_m) / ray.y;
            if !(ray.y < -1e-3 && distance < FARTHEST_FLOAT_M) {
                return place;
            }
            let [x, z] = [camera.x_m + distance * ray.x, camera.z_m + distance * ray.z];
            height_m = self.derived.heights().sample(x, z, self.params.clock.t_s).height_m.min(camera.y_m - 0.3);
            place = Some([x, z]);
        }
        place
    }

    /// Says something for a few seconds.
    fn say(&mut self, text: &str) {
        let until = self.ctx.input(|i| i.time) + SAID_S;
        self.said = Some((text.to_owned(), until));
        self.ctx.request_repaint_after(std::time::Duration::from_secs_f64(SAID_S));
    }

    /// The same in the next frame, of an egui that does not know the time yet.
    fn say_next(&mut self, text: &str) {
        self.said = Some((text.to_owned(), f64::INFINITY));
    }

    /// A view that nobody moves is exactly the one that the link names, and so is a time that stands still.
    fn rest(&mut self, ctx: &egui::Context) {
        if ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty() || i.any_touches()) {
            return;
        }
        // What a link said to more digits stays as it is until somebody moves.
        if self.rested.as_ref() == Some(&standing(&self.params)) {
            return;
        }
        let named = tidy(&self.params);
        self.params.camera = named.camera;
        if self.params.clock.paused {
            self.params.clock.t_s = named.clock.t_s;
        }
        self.rested = Some(standing(&self.params));
    }

    /// Shows what was said last, as long as it counts.
    fn answer(&mut self, ctx: &egui::Context) {
        let now_s = ctx.input(|i| i.time);
        match &mut self.said {
            Some((_, until)) if now_s > *until => self.said = None,
            Some((_, until)) if until.is_infinite() => {
                *until = now_s + SAID_S;
                ctx.request_repaint_after(std::time::Duration::from_secs_f64(SAID_S));
            }
            _ => {}
        }
        let Some((text, _)) = &self.said else { return };
        let area = egui::Area::new(egui::Id::unique("said")).anchor(egui::Align2::CENTER_TOP, egui::vec2(0.0, 16.0));
        area.interactable(false).show(ctx, |ui| {
            egui::Frame::window(ui.style()).show(ui, |ui| ui.label(text));
        });
    }

    /// The parameters of the frame at hand: those of the state, on the grid that the machine keeps up with.
    fn to_draw(&self) -> Params {
        let grid = self.quality.grid(&self.params.grid, &self.params.screen);
        Params { grid, ..self.params.clone() }
    }
}

impl eframe::App for App {
    fn logic(&mut self, _ctx: &egui::Context, _frame: &mut eframe::Frame) {
        #[cfg(target_arch = "wasm32")]
        self.keep_address();
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if self.faults.lost().is_some() {
            // Painting anything with a lost device panics inside egui-wgpu; the shell takes the app to another.
            return;
        }
        self.keys(&ctx);
        self.advance(&ctx);
        self.take_dropped(&ctx);
        self.take_saved();
        let (held, now_s, dt) = ctx.input(|i| (i.pointer.any_down(), i.time, f64::from(i.unstable_dt)));
        self.history.watch(&self.params, held, now_s);
        if self.history.is_open() {
            ctx.request_repaint();
        }
        if (&self.derived.of.grid, &self.derived.of.sea) != (&self.params.grid, &self.params.sea) {
            self.derived = Derived::new(&self.params);
            self.series.clear();
            self.forget_measured();
        }
        self.record(&ctx);
        self.measure(&ctx);
        if !self.progress.is_awaited() {
            self.quality.watch(dt, self.params.clock.paused, self.params.screen.adaptive);
        }
        let params = self.to_draw();
        let limit = self.render_state.device.limits().max_texture_dimension_2d;
        let pixels = |points| self.quality.picture_size(points, ctx.pixels_per_point(), &params.screen, limit);
        // Clicks only where one is waited for: a finger that rests before it moves would be a long press, and no drag.
        let sense = if self.placing.is_some() { egui::Sense::click_and_drag() } else { egui::Sense::drag() };
        let (response, size) = viewport::show(ui, &params, (&self.progress, &self.gauges), sense, pixels);
        self.drawn = Some((params, size));
        self.place(&response, &ctx);
        camera::pointer(&mut self.params.camera, &response, &ctx);
        caption::show(&self.params, &self.derived.plan, &ctx);
        if self.params.screen.panel {
            panel::show(self, &ctx);
        }
        keys::help(&mut self.help, &ctx);
        self.answer(&ctx);
        dropped::invite(&ctx);
        if self.progress.wants_frame() {
            ctx.request_repaint();
        }
        self.rest(&ctx);
        self.frames += 1;
    }
}

/// The camera, and the time if it stands.
fn standing(params: &Params) -> (Camera, Option<f64>) {
    (params.camera.clone(), params.clock.paused.then_some(params.clock.t_s))
}

/// The parameters as a link writes them: without digits that nobody can see.
fn tidy(params: &Params) -> Params {
    let round = |x: f64, unit: f64| (x / unit).round() * unit;
    // Decimal units are not exact in binary: format and read once, so that the shortest text comes out.
    let tidy =
        |x: f64, digits: usize| format!("{:.digits$}", round(x, 10f64.powi(-(digits as i32)))).parse().unwrap_or(x);
    let mut p = params.clone();
    // Steps of single frames are kept apart; a time that runs is another one when it is read.
    p.clock.t_s = tidy(p.clock.t_s, if p.clock.paused { 3 } else { 1 });
    for metres in [&mut p.camera.x_m, &mut p.camera.y_m, &mut p.camera.z_m] {
        *metres = tidy(*metres, 1);
    }
    for degrees in [&mut p.camera.heading_deg, &mut p.camera.pitch_deg, &mut p.camera.fov_deg] {
        *degrees = tidy(*degrees, 1);
    }
    p
}
