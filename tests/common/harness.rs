//! The app under egui_kittest on a software adapter.

use egui_kittest::Harness;
use seastate::app::App;

/// The app with a state string in a window of this size, points, after its first frames.
pub fn open(state: &str, size: [f32; 2], pixels_per_point: f32) -> Harness<'static, App> {
    let state = state.to_owned();
    let mut harness = Harness::builder()
        .with_size(egui::Vec2::from(size))
        .with_pixels_per_point(pixels_per_point)
        .with_step_dt(1.0 / 60.0)
        .wgpu_setup(seastate::app::setup::wgpu_configuration().wgpu_setup)
        .build_eframe(move |cc| App::new(cc, &state).expect("a device"));
    harness.run_steps(3);
    harness
}
