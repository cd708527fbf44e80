//! Brightness of the picture in a few cells (shaders/film/local_exposure.wgsl), from which the tone pass exposes bright
//! areas less. While local exposure is off, it has no texture and records no pass.

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use wgpu::BindingResource::TextureView;

/// Number of cells along the longer and the shorter side of the picture.
const CELLS: [u32; 2] = [16, 9];

/// Compute pass that measures how bright the picture is in each cell.
pub struct LocalExposurePass {
    kernel: Kernel,
    format: wgpu::TextureFormat,
    cells: Option<Cells>,
}

struct Cells {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
    group: wgpu::BindGroup,
}

impl LocalExposurePass {
    /// Compiles the pass; allocates no texture yet.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let bindings = [BindingType::TextureLoaded, BindingType::StorageTexture(format)];
        let module = shaders.module(gpu, "film/local_exposure");
        let kernel = Kernel::new(gpu, "local exposure", (&module, "main"), &bindings, &[]);
        Self { kernel, format, cells: None }
    }

    /// Sets the HDR picture whose brightness is measured; None turns local exposure off.
    pub fn set_picture(&mut self, gpu: &Gpu, picture: Option<&wgpu::TextureView>) {
        if let Some(old) = self.cells.take() {
            old.texture.destroy();
        }
        self.cells = picture.map(|hdr| {
            let is_tall = hdr.texture().height() > hdr.texture().width();
            let [long, short] = CELLS;
            let [width, height] = if is_tall { [short, long] } else { [long, short] };
            // Tests read the cells back.
            let usage = wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::COPY_SRC;
            let texture = gpu.texture("local exposure", [width, height, 1], 1, self.format, usage);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let group = self.kernel.bind(gpu, &[TextureView(hdr), TextureView(&view)]);
            Cells { texture, view, group }
        });
    }

    /// Texture with the mean binary logarithm of the luminance in each cell; None while local exposure is off.
    pub fn texture_view(&self) -> Option<&wgpu::TextureView> {
        self.cells.as_ref().map(|cells| &cells.view)
    }

    /// Records the compute pass that fills [`Self::texture_view`]; none while local exposure is off.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        let Some(cells) = &self.cells else { return };
        let size = [cells.texture.width(), cells.texture.height(), 1];
        self.kernel.run(encoder, timer.compute_pass("local exposure"), &cells.group, &[], size);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::readback;
    use crate::render::targets::HDR_FORMAT;
    use half::f16;

    /// The cells of a picture whose pixels have the given luminances, row by row, and their means in f64.
    fn cells(size: [u32; 2], luminance: impl Fn(u32, u32) -> f64) -> (Vec<f64>, Vec<f64>) {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let picture = gpu.texture("test", [size[0], size[1], 1], 1, HDR_FORMAT, usage);
        let grey = |i: u32| f16::from_f64(luminance(i % size[0], i / size[0]));
        let greys: Vec<f16> = (0..size[0] * size[1]).map(grey).collect();
        let texels: Vec<[f16; 4]> = greys.iter().map(|&g| [g; 4]).collect();
        gpu.write_texture(&picture, 0, bytemuck::cast_slice(&texels));
        let mut pass = LocalExposurePass::new(&gpu, &Shaders::default());
        pass.set_picture(&gpu, Some(&picture.create_view(&wgpu::TextureViewDescriptor::default())));
        let mut encoder = gpu.encoder("test");
        pass.run(&mut encoder, &Timer::default());
        let texture = pass.texture_view().unwrap().texture().clone();
        let staged = readback::stage_texture(&gpu, &mut encoder, &texture, 0);
        gpu.submit(encoder);
        let found = pollster::block_on(staged.read_map(&gpu)).unwrap().iter().map(|t| f64::from(t[0])).collect();
        let [columns, rows] = [texture.width(), texture.height()];
        let [width, height] = [size[0] / columns, size[1] / rows];
        let mean = |cell: u32| {
            let [left, top] = [cell % columns * width, cell / columns * height];
            let pixels = (0..width * height).map(|i| (top + i / width) * size[0] + left + i % width);
            pixels.map(|p| greys[p as usize].to_f64().max(1e-8).log2()).sum::<f64>() / f64::from(width * height)
        };
        (found, (0..columns * rows).map(mean).collect())
    }

    /// Each thread of a cell of 32 x 32 pixels reads its own four.
    #[test]
    fn a_cell_is_the_mean_logarithm_of_its_pixels() {
        for size in [[512, 288], [288, 512]] {
            let (found, expected) =
                cells(size, |x, y| 0.02 * f64::from(1 + (x * 37 + y * 101) % 97) * f64::from(y + 1));
            assert_eq!(found.len(), 144);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 0.004 * expected.abs().max(1.0), "{found} for {expected}");
            }
        }
    }

    /// The sun fills few pixels, so that its cell is hardly brighter than without it; a black cell is finite.
    #[test]
    fn the_sun_and_darkness_do_no_harm() {
        let (found, _) = cells([512, 288], |x, y| match (x, y) {
            (40..43, 40..43) => 6e4,
            (256.., _) => 0.0,
            _ => 1.0,
        });
        let sun = found[16 + 1];
        assert!((0.05..0.2).contains(&sun), "{sun}");
        assert!(found[0].abs() < 1e-3 && found[15] < -20.0 && found.iter().all(|c| c.is_finite()), "{found:?}");
    }
}
