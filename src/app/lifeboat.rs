//! How the app outlives the device that it draws with. eframe cannot make another device, so whoever runs the app starts
//! eframe anew and brings the app along: state, time, undo, panel, record. Only what lives on the GPU is made again, and the
//! foam's past is replayed from the time, as at any start.

use super::faults::Faults;
use super::{App, gauges, setup, viewport};
use crate::gpu::Gpu;
use crate::ocean::{Film, Ocean};
use crate::state::Params;
use std::cell::RefCell;
use std::rc::Rc;

/// Where an app waits for another device.
pub type Berth = Rc<RefCell<Option<App>>>;

/// What eframe runs: an app that can be taken out.
pub struct Shell(Option<App>);

impl Shell {
    /// The app that waits, moved to eframe's new device, or else a new one.
    ///
    /// # Errors
    /// If eframe has no wgpu device, or no new app can be made.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        berth: &Berth,
        fresh: impl FnOnce(&eframe::CreationContext<'_>) -> Result<App, String>,
    ) -> Result<Self, String> {
        if let Some(app) = berth.borrow_mut().as_mut() {
            app.move_to(cc)?;
        }
        // It stays in its berth until it has moved.
        let waiting = berth.take();
        waiting.map_or_else(|| fresh(cc), Ok).map(|app| Self(Some(app)))
    }

    /// The app, unless it has left.
    pub fn app(&mut self) -> Option<&mut App> {
        self.0.as_mut()
    }

    /// Takes the app out, to wait for another device.
    pub fn leave(&mut self, berth: &Berth) {
        if let Some(app) = self.0.take() {
            // One that was merely too small holds its memory still.
            app.render_state.device.destroy();
            berth.replace(Some(app));
        }
    }
}

impl eframe::App for Shell {
    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(self)
    }

    fn logic(&mut self, ctx: &egui::Context, frame: &mut eframe::Frame) {
        if let Some(app) = &mut self.0 {
            app.logic(ctx, frame);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        if let Some(app) = &mut self.0 {
            app.ui(ui, frame);
        }
    }
}

/// Lays a sea out on a device, and watches for what goes wrong there.
pub fn lay_out(render_state: &egui_wgpu::RenderState, params: &Params) -> Faults {
    let faults = Faults::watch(&render_state.device);
    let gpu = Gpu { device: render_state.device.clone(), queue: render_state.queue.clone() };
    let ocean = Ocean::new(&gpu, render_state.target_format, Film::Screen, params);
    render_state.renderer.write().callback_resources.insert(ocean);
    faults
}

impl App {
    /// Goes on with another device and another egui, after the last device was lost.
    ///
    /// # Errors
    /// If eframe has no wgpu device; the app is as it was, then.
    pub fn move_to(&mut self, cc: &eframe::CreationContext<'_>) -> Result<(), String> {
        self.render_state = cc.wgpu_render_state.clone().ok_or(super::NO_WGPU)?;
        let refused = self.faults.refused();
        if refused {
            self.quality.refuse();
        }
        self.faults = lay_out(&self.render_state, &self.to_draw());
        // What is open, scrolled and half typed; but the button that was held may be up by now.
        let memory = self.ctx.memory(Clone::clone);
        let ctx = cc.egui_ctx.clone();
        ctx.memory_mut(|m| *m = memory);
        ctx.stop_dragging();
        setup::style(&ctx);
        #[cfg(target_arch = "wasm32")]
        self.readers.move_to(&ctx);
        self.ctx = ctx;
        // Another window counts its time from zero.
        self.history.commit();
        self.progress = viewport::Progress::default();
        self.gauges = gauges::Gauges::default();
        self.measured = gauges::Measured::default();
        if refused {
            self.say_next("The graphics card is short of memory, so the picture is less sharp: close other programs or tabs and start again.");
        } else if self.params.screen.panel {
            self.say_next("The graphics card was lost for a moment; the sea goes on.");
        }
        Ok(())
    }
}
