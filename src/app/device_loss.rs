//! Recovery of the app from a lost GPU device. eframe cannot replace its device, so the host restarts eframe and moves
//! the app into the new run, with its state, time, undo history, panel and buoy record. Only GPU resources are created
//! anew. Foam is computed again by replaying past foam steps, as at any start.

use super::gpu_errors::GpuErrors;
use super::measurements::{FrameMeasurements, SeaMeasurement};
use super::viewport::DrawingProgress;
use super::{App, setup};
use crate::app::language::tr;
use crate::gpu::Gpu;
use crate::ocean::{Ocean, OutputKind};
use crate::state::Params;
use crate::state::params::Interface;
use std::cell::RefCell;
use std::rc::Rc;

/// Return type of the closure with which eframe creates the app: the app, or the reason for the failure.
pub type AppCreation = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;

/// Slot that holds the app between two runs of eframe, after a device loss; empty while the app runs.
pub type ParkedApp = Rc<RefCell<Option<App>>>;

/// Wrapper of the app that eframe runs. After a device loss the app is taken out and parked, and the wrapper stays
/// empty.
pub struct AppHost(Option<App>);

impl AppHost {
    /// Moves the app that a device loss parked to eframe's new device, or creates an app with `create` if none is
    /// parked.
    ///
    /// # Errors
    /// If eframe was started without a wgpu device, or `create` fails. A parked app then stays parked.
    pub fn new(
        cc: &eframe::CreationContext<'_>,
        parked: &ParkedApp,
        create: impl FnOnce(&eframe::CreationContext<'_>) -> Result<App, String>,
    ) -> Result<Self, String> {
        if let Some(app) = parked.borrow_mut().as_mut() {
            app.move_to_new_device(cc)?;
        }
        let waiting = parked.take();
        waiting.map_or_else(|| create(cc), Ok).map(|app| Self(Some(app)))
    }

    /// The app; `None` after it was taken out and parked.
    pub fn app(&mut self) -> Option<&mut App> {
        self.0.as_mut()
    }

    /// Takes the app out of its wrapper, destroys its GPU device, and keeps it in `parked` until there is another
    /// device.
    pub fn park(&mut self, parked: &ParkedApp) {
        if let Some(app) = self.0.take() {
            // A device that ran out of memory still occupies that memory until it is destroyed.
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

    fn raw_input_hook(&mut self, ctx: &egui::Context, input: &mut egui::RawInput) {
        if let Some(app) = &mut self.0 {
            app.raw_input_hook(ctx, input);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, frame: &mut eframe::Frame) {
        if let Some(app) = &mut self.0 {
            app.ui(ui, frame);
        }
    }
}

/// Creates the ocean renderer with `params` and stores it in eframe's callback resources, where the paint callback of
/// the sea finds it. Returns the list that collects all errors of the GPU device from now on.
pub fn create_ocean(render_state: &egui_wgpu::RenderState, params: &Params) -> GpuErrors {
    let errors = GpuErrors::watch(&render_state.device);
    let gpu = Gpu { device: render_state.device.clone(), queue: render_state.queue.clone() };
    let ocean = Ocean::new(&gpu, render_state.target_format, OutputKind::Screen, params);
    render_state.renderer.write().callback_resources.insert(ocean);
    errors
}

impl App {
    /// Moves the app to the GPU device and egui context of `cc`, a new run of eframe after a device loss.
    ///
    /// # Errors
    /// If eframe was started without a wgpu device. The app is unchanged then.
    fn move_to_new_device(&mut self, cc: &eframe::CreationContext<'_>) -> Result<(), String> {
        self.render_state = cc.wgpu_render_state.clone().ok_or(super::NO_WGPU_MESSAGE)?;
        let out_of_memory = self.gpu_errors.is_out_of_memory();
        if out_of_memory {
            self.quality.note_out_of_memory();
        }
        self.gpu_errors = create_ocean(&self.render_state, &self.params_to_draw());
        // The new context takes over open sections, scroll positions and typed text, but not a drag: the button may
        // have been released meanwhile.
        let memory = self.ctx.memory(Clone::clone);
        let ctx = cc.egui_ctx.clone();
        ctx.memory_mut(|m| *m = memory);
        ctx.stop_dragging();
        setup::apply_style(&ctx);
        self.languages = super::language::Languages::default();
        #[cfg(target_arch = "wasm32")]
        self.screen_readers.install_in_context(&ctx);
        self.ctx = ctx;
        // The undo history compares times, and the clock of the new egui context starts at zero: pending changes become
        // a step now.
        self.history.commit(&self.params);
        self.progress = DrawingProgress::default();
        self.frame_measurements = FrameMeasurements::default();
        self.sea_measurement = SeaMeasurement::default();
        if out_of_memory {
            self.show_brief_message(tr(
                "The graphics card is short of memory, so the picture is less sharp: close other programs or tabs and \
                 start again.",
            ));
        } else if self.params.screen.interface == Interface::Panel {
            self.show_brief_message(tr("The graphics card was lost for a moment; the sea goes on."));
        }
        Ok(())
    }
}
