//! Stand-in until the renderer is merged.
use crate::model::camera::View;
use crate::model::params::Look;
/// Scene.
pub struct Scene {
    #[expect(missing_docs)]
    pub view: View,
    #[expect(missing_docs)]
    pub look: Look,
    #[expect(missing_docs)]
    pub sea: SeaLook,
    #[expect(missing_docs)]
    pub time_s: f64,
}
/// Sea.
#[expect(missing_docs)]
pub struct SeaLook {
    pub chop: f32,
    pub hs_m: f32,
    pub depth_m: f32,
    pub wind_m_s: f32,
    pub downwind: [f32; 2],
    pub residual_mss: f32,
    pub mean_foam: f32,
    pub lambda_p_m: f32,
}
/// Renderer.
pub struct Renderer;
#[expect(missing_docs, clippy::too_many_arguments)]
impl Renderer {
    pub fn new(_: &wgpu::Device, _: &wgpu::Queue, _: wgpu::TextureFormat) -> Self {
        Self
    }
    pub fn draw(
        &mut self,
        _: &wgpu::Device,
        _: &wgpu::Queue,
        _: &mut wgpu::CommandEncoder,
        _: &crate::sim::Maps,
        _: &Scene,
        _: [u32; 2],
    ) {
    }
    pub fn present(&self, _: &mut wgpu::RenderPass<'_>) {}
}
