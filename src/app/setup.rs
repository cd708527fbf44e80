//! Configuration of eframe's wgpu device, and the visual style of the user interface.

use crate::gpu::device;
use egui::epaint::text::{GlyphBitmap, GlyphRasterizer, GlyphRasterizerRequest, RasterizedGlyph};
use std::sync::Arc;

/// eframe's configuration of wgpu for the web page, the desktop window and the tests: which backends and GPU are used,
/// and with which limits and features.
pub fn wgpu_configuration() -> egui_wgpu::WgpuConfiguration {
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = device::backends();
    setup.device_descriptor = Arc::new(device::device_descriptor);
    setup.power_preference = wgpu::PowerPreference::HighPerformance;
    #[cfg(not(target_arch = "wasm32"))]
    if let Some(name) = std::env::var("WGPU_ADAPTER_NAME").ok().filter(|name| !name.is_empty()) {
        let name = name.to_lowercase();
        setup.native_adapter_selector = Some(Arc::new(move |adapters: &[wgpu::Adapter], _surface| {
            let found = adapters.iter().find(|a| a.get_info().name.to_lowercase().contains(&name));
            found.cloned().ok_or_else(|| format!("WGPU_ADAPTER_NAME: no GPU is called \"{name}\""))
        }));
    }
    egui_wgpu::WgpuConfiguration { wgpu_setup: egui_wgpu::WgpuSetup::CreateNew(setup), ..Default::default() }
}

/// Draws the clipboard symbol (U+1F4CB), which egui's colour picker uses and the fonts lack. `None` for other glyphs.
fn clipboard_sign(request: &GlyphRasterizerRequest<'_>) -> Option<RasterizedGlyph> {
    if request.cluster != "\u{1f4cb}" {
        return None;
    }
    let height = request.font_size_px.round().max(8.0) as usize;
    let width = height * 3 / 4;
    let line = (height / 10).max(1);
    let board = |x: usize, y: usize| {
        let edge = |at: usize, end: usize| at < line || at >= end - line;
        let clip = y < 3 * line && x.abs_diff(width / 2) <= width / 4;
        clip || y >= line && (edge(x, width) || edge(y - line, height - line))
    };
    let ink = |i: usize| if board(i % width, i / width) { egui::Color32::WHITE } else { egui::Color32::TRANSPARENT };
    let image = egui::ColorImage::new([width, height], (0..width * height).map(ink).collect());
    // The offset is measured from the base line.
    let offset_px = egui::vec2(0.0, line as f32 - height as f32);
    let advance_px = (width + line) as f32;
    Some(RasterizedGlyph { bitmap: GlyphBitmap { image, offset_px, is_color: false }, advance_px })
}

/// Whether the user has asked the system for reduced motion, as far as the browser tells.
fn prefers_reduced_motion() -> bool {
    #[cfg(target_arch = "wasm32")]
    return super::web::media_matches("(prefers-reduced-motion: reduce)");
    #[cfg(not(target_arch = "wasm32"))]
    false
}

/// Sets the visual style of the user interface: dark and slightly translucent.
pub fn apply_style(ctx: &egui::Context) {
    super::icons::install(ctx);
    ctx.add_glyph_rasterizer(GlyphRasterizer::new("seastate::clipboard", clipboard_sign));
    ctx.set_theme(egui::Theme::Dark);
    ctx.all_styles_mut(|style| {
        // Opaque enough that text is legible over a sunlit sea.
        style.visuals.window_fill = egui::Color32::from_rgba_unmultiplied(12, 20, 28, 242);
        style.visuals.panel_fill = style.visuals.window_fill;
        style.visuals.override_text_color = Some(egui::Color32::from_gray(225));
        style.visuals.weak_text_alpha = 0.75;
        style.visuals.widgets.inactive.weak_bg_fill = egui::Color32::from_rgb(38, 54, 68);
        style.visuals.widgets.inactive.bg_fill = egui::Color32::from_rgb(52, 70, 86);
        style.visuals.selection.bg_fill = egui::Color32::from_rgb(0, 92, 128);
        style.visuals.window_shadow = egui::Shadow::NONE;
        style.visuals.slider_trailing_fill = true;
        style.visuals.handle_shape = egui::style::HandleShape::Circle;
        style.visuals.window_corner_radius = 14.into();
        style.spacing.slider_width = 130.0;
        if prefers_reduced_motion() {
            style.animation_time = 0.0;
        }
    });
}
