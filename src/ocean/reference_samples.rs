//! Reference pictures: the mean of many unfiltered samples in each pixel.

use super::{Ocean, SampleGrid};
use crate::render::ReferenceRenderer;

impl Ocean {
    /// Records the drawing of unfiltered samples, one per cell of `grid`, for a reference picture (mean of many samples
    /// per pixel) of the last frame. Returns a texture with one sample per texel, as [`ReferenceRenderer::draw`] does.
    pub fn record_frame_samples(&mut self, encoder: &mut wgpu::CommandEncoder, grid: &SampleGrid) -> wgpu::Texture {
        let scene = self.scene(grid.size);
        let reference = self.reference.get_or_insert_with(|| ReferenceRenderer::new(&self.gpu, self.format));
        reference.draw(&self.gpu, encoder, self.sim.maps(), &scene, grid)
    }

    /// Draws a picture of `size` (width, height) pixels given as linear light (RGB, row by row from the top), such as
    /// the mean of several [`Self::record_frame_samples`], with the exposure and tone curve of the parameters. Draws
    /// nothing before the first call of [`Self::record_frame_samples`].
    pub fn present_linear_light(&mut self, pass: &mut wgpu::RenderPass<'_>, size: [u32; 2], light: &[[f32; 3]]) {
        let scene = self.scene(size);
        if let Some(reference) = &mut self.reference {
            reference.set_linear_light(&self.gpu, &scene, size, light);
            reference.present(pass);
        }
    }
}
