//! The sea in the window: a paint callback of egui. It records the frame off-screen in `prepare` and copies it to the
//! window in `paint`.

use super::measurements::FrameMeasurements;
use crate::gpu::Gpu;
use crate::ocean::Ocean;
use crate::ocean::coast_task::ShownCoast;
use crate::state::Params;
use crate::state::params::Detail;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::time::Duration;
use web_time::Instant;

/// Number of foam time steps of the past that one frame computes after a start or a jump in time, because foam depends
/// on earlier waves. It applies to FFT sizes from 256; smaller sizes allow more.
const MAX_FOAM_STEPS_PER_FRAME: usize = 6;
/// Number of foam time steps of the past that one frame computes on a software adapter, for FFT sizes from 256.
const SOFTWARE_ADAPTER_MAX_FOAM_STEPS_PER_FRAME: usize = 1;
/// Number of foam time steps of the past that one frame computes while a picture is drawn to be saved, for FFT sizes
/// from 256. All of these frames have full quality, so that few of them matter more than short ones.
const MAX_FOAM_STEPS_PER_FRAME_OF_PICTURE: usize = 24;
/// Time between the frames of the interface while the GPU works on the first picture. Frames at full rate would queue up
/// on a slow GPU, and the second picture would wait for all of them.
const FIRST_PICTURE_FRAME_INTERVAL: Duration = Duration::from_millis(100);
/// Number of frames at full rate before that. They tell the display's refresh interval.
const FIRST_PICTURE_FULL_RATE_FRAMES: u32 = 10;
/// Upper limit of the wall-clock time by which one frame advances a cross-fade between two seas, s.
const MAX_FADE_STEP_S: f64 = 0.1;

/// Flags about the first picture, the replay of past foam and the cross-fade on one GPU device. The paint callback sets
/// them; the app reads them.
#[derive(Clone, Default)]
pub struct DrawingProgress(Arc<ProgressFlags>);

#[derive(Default)]
struct ProgressFlags {
    /// Whether foam steps of earlier times are still being computed, or a cross-fade between two seas is in progress.
    catching_up: AtomicBool,
    /// Whether the first picture was painted, and so will be submitted to the GPU.
    painted: AtomicBool,
    /// Whether the first picture was submitted and wgpu was asked to report when the GPU has finished it.
    callback_installed: AtomicBool,
    /// Whether the GPU has finished the first picture.
    finished: AtomicBool,
    /// Number of frames since the first picture was submitted, until it is finished.
    pending_frames: AtomicU32,
}

impl DrawingProgress {
    /// Whether another frame is needed even while simulated time is stopped: the first picture, the replay of past foam
    /// or a cross-fade is unfinished.
    pub fn wants_frame(&self) -> bool {
        self.is_replaying_foam_or_fading() || !self.has_first_picture()
    }

    /// Whether foam steps of earlier times are still being computed, or a cross-fade between two seas is in progress.
    pub fn is_replaying_foam_or_fading(&self) -> bool {
        self.0.catching_up.load(Ordering::Relaxed)
    }

    /// Whether the GPU has finished the first picture. This takes seconds, because the pipelines must be compiled.
    pub fn has_first_picture(&self) -> bool {
        self.0.finished.load(Ordering::Relaxed)
    }

    /// Whether the first picture was submitted and the GPU has not finished it. No other frame is recorded meanwhile.
    pub fn is_first_picture_pending(&self) -> bool {
        self.0.callback_installed.load(Ordering::Relaxed) && !self.has_first_picture()
    }

    /// Requests the next frame if one is needed even while simulated time is stopped.
    pub fn request_wanted_frame(&self, ctx: &egui::Context) {
        let is_pending = self.is_first_picture_pending();
        if is_pending && self.0.pending_frames.fetch_add(1, Ordering::Relaxed) >= FIRST_PICTURE_FULL_RATE_FRAMES {
            ctx.request_repaint_after(FIRST_PICTURE_FRAME_INTERVAL);
        } else if self.wants_frame() {
            ctx.request_repaint();
        }
    }

    /// Once the first picture has been submitted, asks wgpu to set `finished` and to request a frame when the GPU has
    /// finished it. Call this before each frame is recorded.
    fn watch_first_submission(&self, gpu: &Gpu, ctx: &egui::Context) {
        if self.0.painted.load(Ordering::Relaxed) && !self.0.callback_installed.swap(true, Ordering::Relaxed) {
            let (marks, ctx) = (self.0.clone(), ctx.clone());
            gpu.queue.on_submitted_work_done(move || {
                marks.finished.store(true, Ordering::Relaxed);
                ctx.request_repaint();
            });
        }
    }
}

/// How one frame of the sea is drawn.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameKind {
    /// Tag of the frame's GPU time: its quality (see [`super::quality::AdaptiveQuality::level`]). `None` if the quality
    /// does not adapt, so that the time is not needed.
    pub quality_level: Option<u32>,
    /// Whether the foam is made anew, after the transition to this sea if there is one.
    pub restarts_foam: bool,
    /// Whether the frame belongs to a picture that is drawn to be saved.
    pub is_saved: bool,
}

/// Fills the rest of `ui` with the sea of `params` and its coast. `pixels` converts the size of that area in points to
/// the picture's size in pixels. Returns egui's response of the area to pointer input of the kind `sense`, and the
/// picture's size in pixels.
pub fn show_sea(
    ui: &mut egui::Ui,
    (params, coast): (&Params, ShownCoast),
    (progress, measurements): (&DrawingProgress, &FrameMeasurements),
    sense: egui::Sense,
    kind: FrameKind,
    pixels: impl FnOnce(egui::Vec2) -> [u32; 2],
) -> (egui::Response, [u32; 2]) {
    let response = egui::CentralPanel::default()
        .frame(egui::Frame::NONE)
        .show(ui, |ui| ui.allocate_response(ui.available_size(), sense))
        .inner;
    let size = pixels(response.rect.size()).map(|s| s.max(1));
    if response.rect.is_positive() {
        let dt_s = f64::from(ui.input(|i| i.stable_dt)).min(MAX_FADE_STEP_S);
        let (progress, measurements) = (progress.clone(), measurements.clone());
        let ctx = ui.ctx().clone();
        let frame = SeaFrame { ctx, params: params.clone(), coast, size, progress, measurements, dt_s, kind };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(response.rect, frame));
    }
    (response, size)
}

fn foam_steps_per_frame(gpu: &Gpu, n: u32, is_saved: bool) -> usize {
    let most = match (is_saved, gpu.is_software()) {
        (true, _) => MAX_FOAM_STEPS_PER_FRAME_OF_PICTURE,
        (false, true) => SOFTWARE_ADAPTER_MAX_FOAM_STEPS_PER_FRAME,
        (false, false) => MAX_FOAM_STEPS_PER_FRAME,
    };
    most * (256 / n).max(1).pow(2) as usize
}

/// Everything with which egui's paint callback records one frame of the sea: egui's context, parameters, size of the
/// picture in pixels, and the state that it shares with the app.
struct SeaFrame {
    ctx: egui::Context,
    params: Params,
    coast: ShownCoast,
    size: [u32; 2],
    progress: DrawingProgress,
    measurements: FrameMeasurements,
    /// Wall-clock time since the last frame, at most [`MAX_FADE_STEP_S`], s. A cross-fade advances by it.
    dt_s: f64,
    kind: FrameKind,
}

impl egui_wgpu::CallbackTrait for SeaFrame {
    #[cfg_attr(not(target_arch = "wasm32"), expect(clippy::disallowed_methods, reason = "no browser runs this one"))]
    fn prepare(
        &self,
        _device: &wgpu::Device,
        _queue: &wgpu::Queue,
        _screen: &egui_wgpu::ScreenDescriptor,
        _egui_encoder: &mut wgpu::CommandEncoder,
        resources: &mut egui_wgpu::CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let Some(ocean) = resources.get_mut::<Ocean>() else { return Vec::new() };
        self.progress.watch_first_submission(ocean.gpu(), &self.ctx);
        if self.progress.is_first_picture_pending() {
            return Vec::new();
        }
        let mut encoder = ocean.gpu().encoder("ocean");
        let begun = Instant::now();
        self.measurements.begin_frame(ocean, self.kind.quality_level);
        ocean.set_may_keep_pipelines(!self.params.clock.paused);
        ocean.transition_to(&self.params, self.dt_s);
        ocean.show_coast(self.coast.clone());
        if self.kind.restarts_foam {
            ocean.restart_foam_after_transition();
        }
        ocean.set_lean(self.params.screen.detail == Detail::Lean);
        let most_steps = foam_steps_per_frame(ocean.gpu(), ocean.plan().n, self.kind.is_saved);
        let caught_up = ocean.record_frame(&mut encoder, self.size, most_steps);
        let is_whole = caught_up && !ocean.in_transition();
        self.measurements.end_frame(ocean, &mut encoder, begun.elapsed().as_secs_f64(), is_whole);
        self.measurements.watch_completion(&encoder, self.kind.quality_level);
        self.progress.0.catching_up.store(!is_whole, Ordering::Relaxed);
        vec![encoder.finish()]
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &egui_wgpu::CallbackResources,
    ) {
        if let Some(ocean) = resources.get::<Ocean>() {
            self.measurements.note_painted();
            self.progress.0.painted.store(true, Ordering::Relaxed);
            // Before the first picture is finished, the page shows its loading screen, or the picture before a device
            // loss.
            if cfg!(not(target_arch = "wasm32")) || !self.progress.is_first_picture_pending() {
                ocean.present(pass);
            }
        }
    }
}
