//! The sea in the window: recorded off-screen in `prepare`, blitted in `paint`.

use super::gauges::Gauges;
use crate::model::Params;
use crate::ocean::Ocean;
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

/// Whether the foam of a cold start is still being replayed, or the sea glides.
#[derive(Clone, Default)]
pub struct CatchingUp(Arc<AtomicBool>);

impl CatchingUp {
    /// Whether another frame is needed even if time stands still.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Fills what is left of `ui` with the sea; `sense` says what it notices, `pixels` how many it gets. Returns them, too.
pub fn show(
    ui: &mut egui::Ui,
    params: &Params,
    (catching_up, gauges): (&CatchingUp, &Gauges),
    sense: egui::Sense,
    pixels: impl FnOnce(egui::Vec2) -> [u32; 2],
) -> (egui::Response, [u32; 2]) {
    let response = egui::CentralPanel::default()
        .frame(egui::Frame::NONE)
        .show(ui, |ui| ui.allocate_response(ui.available_size(), sense))
        .inner;
    let size = pixels(response.rect.size());
    if size[0] > 0 && size[1] > 0 {
        let dt_s = f64::from(ui.input(|i| i.stable_dt)).min(LONGEST_GLIDE_STEP_S);
        let frame =
            SeaFrame { params: params.clone(), size, catching_up: catching_up.clone(), gauges: gauges.clone(), dt_s };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(response.rect, frame));
    }
    (response, size)
}

fn steps_per_frame(device: &wgpu::Device, n: u32) -> usize {
    let is_cpu = device.adapter_info().device_type == wgpu::DeviceType::Cpu;
    let most = if is_cpu { CPU_STEPS_PER_FRAME } else { STEPS_PER_FRAME };
    most * (256 / n).max(1).pow(2) as usize
}

/// One frame, by value.
struct SeaFrame {
    params: Params,
    size: [u32; 2],
    catching_up: CatchingUp,
    gauges: Gauges,
    /// Wall time since the last frame, s.
    dt_s: f64,
}

impl egui_wgpu::CallbackTrait for SeaFrame {
    #[cfg_attr(not(target_arch = "wasm32"), expect(clippy::disallowed_methods, reason = "no browser runs this one"))]
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        _screen: &egui_wgpu::ScreenDescriptor,
        _egui_encoder: &mut wgpu::CommandEncoder,
        resources: &mut egui_wgpu::CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let Some(ocean) = resources.get_mut::<Ocean>() else { return Vec::new() };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("ocean") });
        let begun = Instant::now();
        self.gauges.begin(ocean, &mut encoder);
        ocean.glide_to(device, queue, &self.params, self.dt_s);
        let caught_up = ocean.encode(device, queue, &mut encoder, self.size, steps_per_frame(device, ocean.plan().n));
        let is_whole = caught_up && !ocean.is_gliding();
        self.gauges.end(ocean, device, &mut encoder, begun.elapsed().as_secs_f64(), is_whole);
        self.catching_up.0.store(!is_whole, Ordering::Relaxed);
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
            ocean.present(pass);
        }
    }
}
