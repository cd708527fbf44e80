//! The sea in the window: recorded off-screen in `prepare`, blitted in `paint`.

use super::gauges::Gauges;
use crate::gpu::Gpu;
use crate::ocean::Ocean;
use crate::state::Params;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use web_time::Instant;

/// Past times that one frame replays for the foam: a cold start is spread over a few frames instead of stalling one. For
/// n = 256 and above; fewer points are soon computed.
const STEPS_PER_FRAME: usize = 6;
/// The same on an adapter that is a CPU.
const CPU_STEPS_PER_FRAME: usize = 1;
/// A glide goes on by no more than this in one frame, s.
const LONGEST_GLIDE_STEP_S: f64 = 0.1;

/// What the frames drawn with a device tell the app.
#[derive(Clone, Default)]
pub struct Progress(Arc<Marks>);

#[derive(Default)]
struct Marks {
    /// The foam of a cold start is still being replayed, or the sea glides.
    catching_up: AtomicBool,
    /// The first picture was painted, so that it is submitted, too.
    begun: AtomicBool,
    /// The GPU was asked to say when it has finished that.
    asked: AtomicBool,
    /// It has.
    seen: AtomicBool,
}

impl Progress {
    /// Whether another frame is needed even if time stands still.
    pub fn wants_frame(&self) -> bool {
        self.is_catching_up() || !self.is_seen()
    }

    /// Whether the foam of a cold start is still being replayed, or the sea glides.
    pub fn is_catching_up(&self) -> bool {
        self.0.catching_up.load(Ordering::Relaxed)
    }

    /// Whether the GPU has finished a picture: compiling what it draws with takes it seconds.
    pub fn is_seen(&self) -> bool {
        self.0.seen.load(Ordering::Relaxed)
    }

    /// Whether the GPU is still at the first picture: no other is ordered meanwhile, which would only take it from that.
    pub fn is_awaited(&self) -> bool {
        self.0.asked.load(Ordering::Relaxed) && !self.is_seen()
    }

    /// Called before a frame is recorded: the one before has been submitted, if it was painted.
    fn ask(&self, gpu: &Gpu) {
        if self.0.begun.load(Ordering::Relaxed) && !self.0.asked.swap(true, Ordering::Relaxed) {
            let marks = self.0.clone();
            gpu.queue.on_submitted_work_done(move || marks.seen.store(true, Ordering::Relaxed));
        }
    }
}

/// Fills what is left of `ui` with the sea; `sense` says what it notices, `pixels` how many it gets. Returns them, too.
pub fn show(
    ui: &mut egui::Ui,
    params: &Params,
    (progress, gauges): (&Progress, &Gauges),
    sense: egui::Sense,
    pixels: impl FnOnce(egui::Vec2) -> [u32; 2],
) -> (egui::Response, [u32; 2]) {
    let response = egui::CentralPanel::default()
        .frame(egui::Frame::NONE)
        .show(ui, |ui| ui.allocate_response(ui.available_size(), sense))
        .inner;
    let size = pixels(response.rect.size()).map(|s| s.max(1));
    if response.rect.is_positive() {
        let dt_s = f64::from(ui.input(|i| i.stable_dt)).min(LONGEST_GLIDE_STEP_S);
        let frame = SeaFrame { params: params.clone(), size, progress: progress.clone(), gauges: gauges.clone(), dt_s };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(response.rect, frame));
    }
    (response, size)
}

fn steps_per_frame(gpu: &Gpu, n: u32) -> usize {
    let is_cpu = gpu.device.adapter_info().device_type == wgpu::DeviceType::Cpu;
    let most = if is_cpu { CPU_STEPS_PER_FRAME } else { STEPS_PER_FRAME };
    most * (256 / n).max(1).pow(2) as usize
}

/// One frame, by value.
struct SeaFrame {
    params: Params,
    size: [u32; 2],
    progress: Progress,
    gauges: Gauges,
    /// Wall time since the last frame, s.
    dt_s: f64,
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
        self.progress.ask(ocean.gpu());
        if self.progress.is_awaited() {
            return Vec::new();
        }
        let mut encoder = ocean.gpu().encoder("ocean");
        let begun = Instant::now();
        self.gauges.begin(ocean, &mut encoder);
        ocean.transition_to(&self.params, self.dt_s);
        let most_steps = steps_per_frame(ocean.gpu(), ocean.plan().n);
        let caught_up = ocean.encode(&mut encoder, self.size, most_steps);
        let is_whole = caught_up && !ocean.in_transition();
        self.gauges.end(ocean, &mut encoder, begun.elapsed().as_secs_f64(), is_whole);
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
            self.gauges.painted();
            self.progress.0.begun.store(true, Ordering::Relaxed);
            // A page still shows that it is loading, or the last picture of a lost device.
            if cfg!(not(target_arch = "wasm32")) || !self.progress.is_awaited() {
                ocean.present(pass);
            }
        }
    }
}
