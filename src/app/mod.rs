//! The program that people see: one eframe app for the page and the window. The only room that knows egui and the browser.

mod camera;
mod caption;
mod dropped;
mod faults;
#[cfg(not(target_arch = "wasm32"))]
pub mod native;
mod panel;
mod plots;
mod setup;
mod viewport;
#[cfg(target_arch = "wasm32")]
pub mod web;

use crate::model::look::SkyFile;
use crate::model::statistics::{Resolved, Theory};
use crate::model::{Params, Plan, query};
use crate::ocean::Ocean;
use faults::Faults;
use std::cell::OnceCell;

/// Longest step of the simulated time from one frame to the next, s: a page that was hidden goes on where it was.
const LONGEST_STEP_S: f64 = 0.1;

/// What is derived from the parameters once, when they change, and not in every frame.
struct Derived {
    of: Params,
    plan: Plan,
    theory: Theory,
    /// Sums over all waves: only when somebody looks.
    resolved: OnceCell<Resolved>,
}

impl Derived {
    fn new(params: &Params) -> Self {
        let plan = Plan::new(params);
        let theory = Theory::new(&plan);
        Self { of: params.clone(), plan, theory, resolved: OnceCell::new() }
    }

    fn resolved(&self) -> &Resolved {
        self.resolved.get_or_init(|| Resolved::new(&self.plan, self.theory.m0_m2))
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
    dropped: dropped::Dropped,
    /// The last sky that was read, for links that name it.
    sky: Option<SkyFile>,
    /// Set by the viewport while the foam has yet to catch up.
    catching_up: viewport::CatchingUp,
    #[cfg(target_arch = "wasm32")]
    address: web::Address,
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
        let render_state = cc.wgpu_render_state.clone().ok_or("eframe was started without wgpu")?;
        let (mut params, notices) = query::parse(state);
        params.look.sky.attach(sky.as_ref());
        let faults = Faults::watch(&render_state.device);
        let ocean = Ocean::new(&render_state.device, &render_state.queue, render_state.target_format, &params);
        render_state.renderer.write().callback_resources.insert(ocean);
        setup::style(&cc.egui_ctx);
        Ok(Self {
            derived: Derived::new(&params),
            notices,
            render_state,
            ctx: cc.egui_ctx.clone(),
            faults,
            frames: 0,
            dropped: dropped::Dropped::default(),
            sky: sky.filter(|s| s.image.is_some()),
            catching_up: viewport::CatchingUp::default(),
            #[cfg(target_arch = "wasm32")]
            address: web::Address::new(&params),
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
        // Called from outside a frame too, when time stands still and nothing else asks for one.
        self.ctx.request_repaint();
    }

    /// Frames painted so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Asks for one more frame, and says whether the picture is complete: whether the foam of a cold start has caught up.
    pub fn settled(&self) -> bool {
        self.ctx.request_repaint();
        self.frames > 0 && !self.catching_up.is_set()
    }

    /// Why the GPU was lost, if it was.
    pub fn device_lost(&self) -> Option<String> {
        self.faults.lost()
    }

    /// The distinct GPU errors so far.
    pub fn errors(&self) -> Vec<String> {
        self.faults.errors()
    }

    /// The device that the app draws with.
    pub fn render_state(&self) -> &egui_wgpu::RenderState {
        &self.render_state
    }

    fn advance(&mut self, ctx: &egui::Context) {
        if self.params.clock.paused {
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
        if ctx.input(|i| i.key_pressed(egui::Key::Space)) {
            self.params.clock.paused = !self.params.clock.paused;
        }
        let back = caption::keys(&mut self.params.look.view, ctx);
        if !back && cfg!(not(target_arch = "wasm32")) && ctx.input(|i| i.key_pressed(egui::Key::Escape)) {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
        camera::keys(&mut self.params.camera, ctx);
    }
}

impl eframe::App for App {
    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn logic(&mut self, _ctx: &egui::Context, _frame: &mut eframe::Frame) {
        #[cfg(target_arch = "wasm32")]
        self.keep_address();
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if self.faults.lost().is_some() {
            // Painting anything with a lost device panics inside egui-wgpu; the shell says what happened.
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            return;
        }
        self.keys(&ctx);
        self.advance(&ctx);
        self.take_dropped(&ctx);
        if (&self.derived.of.grid, &self.derived.of.sea) != (&self.params.grid, &self.params.sea) {
            self.derived = Derived::new(&self.params);
        }
        let response = viewport::show(ui, &self.params, &self.catching_up);
        camera::pointer(&mut self.params.camera, &response, &ctx);
        caption::show(&self.params, &self.derived.plan, &ctx);
        panel::show(self, &ctx);
        dropped::invite(&ctx);
        if self.catching_up.is_set() {
            ctx.request_repaint();
        }
        self.frames += 1;
    }
}

/// The parameters as a link writes them: without digits that nobody can see.
fn tidy(params: &Params) -> Params {
    let round = |x: f64, unit: f64| (x / unit).round() * unit;
    // Decimal units are not exact in binary: format and read once, so that the shortest text comes out.
    let tidy =
        |x: f64, digits: usize| format!("{:.digits$}", round(x, 10f64.powi(-(digits as i32)))).parse().unwrap_or(x);
    let mut p = params.clone();
    p.clock.t_s = tidy(p.clock.t_s, 1);
    for metres in [&mut p.camera.x_m, &mut p.camera.y_m, &mut p.camera.z_m] {
        *metres = tidy(*metres, 1);
    }
    for degrees in [&mut p.camera.heading_deg, &mut p.camera.pitch_deg, &mut p.camera.fov_deg] {
        *degrees = tidy(*degrees, 1);
    }
    p
}
