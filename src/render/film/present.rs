//! The pass that shows the finished picture on the canvas (shaders/film/present.wgsl): copied, or scaled to its size.

use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, BindingType, RenderProgram};
use crate::shaders::Shaders;

/// The pass that shows the finished picture in the render pass of a caller: it copies the picture if the viewport has
/// the picture's size, else scales it.
pub struct PresentPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    /// The finished picture, and its bind group; None before the first picture.
    picture: Option<(wgpu::TextureView, wgpu::BindGroup)>,
}

impl PresentPass {
    /// Compiles the pass, which draws into a texture of `target_format`.
    pub fn new(gpu: &Gpu, shaders: &Shaders, target_format: wgpu::TextureFormat) -> Self {
        let bindings = [BindingType::Texture, BindingType::Sampler];
        let layout = gpu.bind_group_layout("present", wgpu::ShaderStages::FRAGMENT, &bindings);
        let module = shaders.module(gpu, "film/present");
        let onto = AttachmentFormats { formats: &[target_format], depth: None, blend: None };
        let pipeline = gpu.render_pipeline("present", &RenderProgram::new(&module), &[&layout], &onto);
        let clamp = [wgpu::AddressMode::ClampToEdge; 2];
        let sampler = gpu.sampler("finished picture", clamp, wgpu::MipmapFilterMode::Nearest);
        Self { layout, pipeline, sampler, picture: None }
    }

    /// Sets the finished picture to show: colours of the screen, with their luma in alpha. No-op if unchanged.
    pub fn set_picture(&mut self, gpu: &Gpu, finished: &wgpu::TextureView) {
        use wgpu::BindingResource::{Sampler, TextureView};
        if self.picture.as_ref().is_none_or(|(bound, _)| bound != finished) {
            let resources = [TextureView(finished), Sampler(&self.sampler)];
            self.picture = Some((finished.clone(), gpu.bind_group("present", &self.layout, &resources)));
        }
    }

    /// Draws the picture of [`Self::set_picture`] into the viewport of `pass`; nothing without a picture.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some((_, group)) = &self.picture else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::offscreen::PendingPicture;
    use crate::render::film::tone::FINISHED_FORMAT;

    /// A grey picture: its width, and the value of each pixel, row by row.
    struct Grey {
        width: u32,
        values: Vec<u8>,
    }

    impl Grey {
        fn new([width, height]: [u32; 2], value: impl Fn(u32, u32) -> f64) -> Self {
            let values = (0..width * height).map(|i| value(i % width, i / width).round() as u8).collect();
            Self { width, values }
        }

        /// The value of a pixel, or of the nearest one in the picture.
        fn at(&self, x: i64, y: i64) -> f64 {
            let height = self.values.len() as i64 / i64::from(self.width);
            let [x, y] = [x.clamp(0, i64::from(self.width) - 1), y.clamp(0, height - 1)];
            f64::from(self.values[(y * i64::from(self.width) + x) as usize])
        }

        /// The four pixels around the middle of pixel (x, y) of the same picture drawn with `size` pixels, and the
        /// fractions of the way from the left ones to the right ones and from the upper ones to the lower ones.
        fn around(&self, [x, y]: [u32; 2], size: [u32; 2]) -> ([f64; 4], [f64; 2]) {
            let own = [self.width, self.values.len() as u32 / self.width];
            let place = |i: usize, at: u32| (f64::from(at) + 0.5) * f64::from(own[i]) / f64::from(size[i]) - 0.5;
            let [px, py] = [place(0, x), place(1, y)];
            let [left, top] = [px.floor() as i64, py.floor() as i64];
            let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| self.at(left + dx, top + dy));
            (corners, [px - px.floor(), py - py.floor()])
        }
    }

    /// Shows a picture given as RGBA bytes on a canvas; returns the pixels of the canvas.
    fn show(bytes: &[u8], [width, height]: [u32; 2], canvas: [u32; 2]) -> Vec<[u8; 4]> {
        let gpu = pollster::block_on(Gpu::request()).unwrap();
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let picture = gpu.texture("test", [width, height, 1], 1, FINISHED_FORMAT, usage);
        gpu.write_texture(&picture, 0, bytes);
        let mut pass = PresentPass::new(&gpu, &Shaders::default(), FINISHED_FORMAT);
        pass.set_picture(&gpu, &picture.create_view(&wgpu::TextureViewDescriptor::default()));
        let drawn = PendingPicture::submit(&gpu, gpu.encoder("test"), FINISHED_FORMAT, canvas, |p| pass.draw(p));
        pollster::block_on(drawn.read(&gpu)).unwrap().chunks(4).map(|p| [p[0], p[1], p[2], p[3]]).collect()
    }

    fn show_grey(picture: &Grey, canvas: [u32; 2]) -> Vec<f64> {
        let bytes: Vec<u8> = picture.values.iter().flat_map(|&v| [v; 4]).collect();
        let size = [picture.width, picture.values.len() as u32 / picture.width];
        show(&bytes, size, canvas).iter().map(|p| f64::from(p[1])).collect()
    }

    #[test]
    fn a_canvas_of_the_same_size_gets_the_same_pixels() {
        for size in [[37u32, 23], [1280, 3], [3, 1500]] {
            let bytes: Vec<u8> =
                (0..4 * size[0] * size[1]).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
            let shown = show(&bytes, size, size);
            for (pixel, picture) in shown.iter().zip(bytes.chunks(4)) {
                assert_eq!((&pixel[..3], pixel[3]), (&picture[..3], 255), "{size:?}");
            }
        }
    }

    #[test]
    fn a_constant_picture_stays_constant_at_every_size() {
        let bytes = [200, 30, 90, 70].repeat(24 * 16);
        for canvas in [[24, 16], [31, 21], [48, 32], [100, 61], [17, 12], [12, 8]] {
            let shown = show(&bytes, [24, 16], canvas);
            assert!(shown.iter().all(|p| *p == [200, 30, 90, 255]), "{canvas:?}");
        }
    }

    /// A slanted edge between two greys that goes through (0.5, 0.46), averaged over the area of each pixel.
    fn slanted_edge(size: [u32; 2], slope: f64) -> Grey {
        Grey::new(size, |x, y| {
            let is_bright = |i: u32| {
                let u = (f64::from(x) + (f64::from(i % 16) + 0.5) / 16.0) / f64::from(size[0]);
                let v = (f64::from(y) + (f64::from(i / 16) + 0.5) / 16.0) / f64::from(size[1]);
                v - 0.46 > slope * (u - 0.5)
            };
            let bright = (0..256).filter(|&i| is_bright(i)).count() as f64 / 256.0;
            40.0 + 170.0 * bright
        })
    }

    /// Sum of the squared differences between neighbours along both axes, of a picture `width` pixels wide.
    fn sharpness(values: &[f64], width: usize) -> f64 {
        let along_rows = values.chunks(width).flat_map(|row| row.windows(2)).map(|w| (w[1] - w[0]).powi(2));
        let along_columns = values.iter().zip(&values[width..]).map(|(a, b)| (b - a).powi(2));
        along_rows.chain(along_columns).sum()
    }

    #[test]
    fn an_enlarged_edge_is_sharper_than_interpolated_and_does_not_ring() {
        for (small, canvas) in [([40, 40], [80, 80]), ([49, 49], [64, 64])] {
            for slope in [0.0, 0.3, 0.8, 1.0, 3.0] {
                let picture = slanted_edge(small, slope);
                let shown = show_grey(&picture, canvas);
                let mut interpolated = Vec::new();
                for (i, shown) in (0u32..).zip(&shown) {
                    let at = [i % canvas[0], i / canvas[0]];
                    let ([nw, ne, sw, se], [fx, fy]) = picture.around(at, canvas);
                    let [least, most] = [nw.min(ne).min(sw).min(se), nw.max(ne).max(sw).max(se)];
                    assert!((least - 1.0..=most + 1.0).contains(shown), "{slope} at {at:?}: {shown}");
                    let upper = nw + (ne - nw) * fx;
                    interpolated.push(upper + (sw + (se - sw) * fx - upper) * fy);
                }
                let width = canvas[0] as usize;
                let ratio = sharpness(&shown, width) / sharpness(&interpolated, width);
                eprintln!("slope {slope}, {small:?} to {canvas:?}: {ratio:.2} times as sharp as interpolated");
                assert!(ratio > 1.1, "slope {slope}, {small:?} to {canvas:?}: {ratio}");
            }
        }
    }

    #[test]
    fn a_larger_picture_is_averaged() {
        let picture = Grey::new([64, 48], |x, y| f64::from((x * 7919 + y * 104_729) % 256));
        for (i, shown) in (0i64..).zip(show_grey(&picture, [32, 24])) {
            let [x, y] = [2 * (i % 32), 2 * (i / 32)];
            let mean =
                (picture.at(x, y) + picture.at(x + 1, y) + picture.at(x, y + 1) + picture.at(x + 1, y + 1)) / 4.0;
            assert!((shown - mean).abs() < 1.01, "{x} {y}: {shown} instead of {mean}");
        }
    }
}
