//! How the app survives a lost device. eframe cannot replace its device, so the host starts eframe again and moves the
//! app into it with state, time, undo history, panel and record. Only GPU resources are created anew; the foam's past
//! is replayed from the time, as at any start.

use super::gpu_errors::GpuErrors;
use super::measurements::{FrameMeasurements, SeaMeasurement};
use super::viewport::Progress;
use super::{App, setup};
use crate::gpu::Gpu;
use crate::ocean::{Film, Ocean};
use crate::state::Params;
use std::cell::RefCell;
use std::rc::Rc;

/// Result of the closure with which eframe creates its app.
pub type Created = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;

/// Holds the app between two runs of eframe.
pub type ParkedApp = Rc<RefCell<Option<App>>>;

/// The app as eframe runs it; the app can be taken out.
pub struct AppHost(Option<App>);

impl AppHost {
    /// Moves the parked app to eframe's new device, or creates an app with `create` if none is parked.
    ///
    /// # Errors
    /// If eframe has no wgpu device, or `create` fails. A parked app stays parked then.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        parked: &ParkedApp,
        create: impl FnOnce(&eframe::CreationContext<'_>) -> Result<App, String>,
    ) -> Result<Self, String> {
        if let Some(app) = parked.borrow_mut().as_mut() {
            app.move_to(cc)?;
        }
        let waiting = parked.take();
        waiting.map_or_else(|| create(cc), Ok).map(|app| Self(Some(app)))
    }

    /// The app, unless it was taken out.
    pub fn app(&mut self) -> Option<&mut App> {
        self.0.as_mut()
    }

    /// Takes the app out and parks it until another device exists.
    pub fn park(&mut self, parked: &ParkedApp) {
        if let Some(app) = self.0.take() {
            // A device that ran out of memory still holds its memory.
            app.render_state.device.destroy();
            parked.replace(Some(app));
        }
    }
}

impl eframe::App for AppHost {
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

/// Creates the ocean in eframe's renderer, and listens to the device's errors.
pub fn create_ocean(render_state: &egui_wgpu::RenderState, params: &Params) -> GpuErrors {
    let errors = GpuErrors::watch(&render_state.device);
    let gpu = Gpu { device: render_state.device.clone(), queue: render_state.queue.clone() };
    let ocean = Ocean::new(&gpu, render_state.target_format, Film::Screen, params);
    render_state.renderer.write().callback_resources.insert(ocean);
    errors
}

impl App {
    /// Moves to another device and another egui context after the device was lost.
    ///
    /// # Errors
    /// If eframe has no wgpu device; the app is unchanged then.
    fn move_to(&mut self, cc: &eframe::CreationContext<'_>) -> Result<(), String> {
        self.render_state = cc.wgpu_render_state.clone().ok_or(super::NO_WGPU)?;
        let out_of_memory = self.gpu_errors.is_out_of_memory();
        if out_of_memory {
            self.quality.refuse();
        }
        self.gpu_errors = create_ocean(&self.render_state, &self.params_to_draw());
        // Keeps open sections, scroll positions and typed text; a held button may have been released meanwhile.
        let memory = self.ctx.memory(Clone::clone);
        let ctx = cc.egui_ctx.clone();
        ctx.memory_mut(|m| *m = memory);
        ctx.stop_dragging();
        setup::style(&ctx);
        #[cfg(target_arch = "wasm32")]
        self.screen_readers.move_to(&ctx);
        self.ctx = ctx;
        // The clock of the new egui context starts at zero.
        self.history.commit(&self.params);
        self.progress = Progress::default();
        self.frame_measurements = FrameMeasurements::default();
        self.sea_measurement = SeaMeasurement::default();
        if out_of_memory {
            self.say(
                "The graphics card is short of memory, so the picture is less sharp: close other programs or tabs and \
                 start again.",
            );
        } else if self.params.screen.panel {
            self.say("The graphics card was lost for a moment; the sea goes on.");
        }
        Ok(())
    }
}
