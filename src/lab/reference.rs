//! Reference pictures: each pixel is the mean of many unfiltered samples, exposed and filmed as the usual picture.

use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::ocean::still;
use crate::ocean::{Ocean, SampleGrid};
use crate::waves::noise::pcg4d;

/// Largest number of samples that are drawn at once, each as one texel of the render target.
const MAX_SAMPLES_PER_TARGET: u64 = 4_200_000;

/// Number and positions of the samples in a reference picture, whose pixels are means of many unfiltered samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplingSettings {
    /// Minimum number of samples per pixel; the colour of a pixel is their mean.
    pub min_samples_per_pixel: u32,
    /// Seed of the sample positions within a pixel.
    pub seed: u32,
}

impl SamplingSettings {
    /// Sample grids, rendered one after the other, that together give every pixel of a picture of `size` pixels at
    /// least `self.samples` samples. Each grid has at most `most` samples in total and at most `longest` along its
    /// width or height.
    fn sample_grids(self, size: [u32; 2], most: u64, longest: u32) -> impl Iterator<Item = SampleGrid> {
        let fits = |side: &u32| {
            let [w, h] = size.map(|s| u64::from(s) * u64::from(*side));
            side * side <= self.min_samples_per_pixel && w * h <= most && w.max(h) <= u64::from(longest)
        };
        let side = [16, 8, 4, 2].into_iter().find(fits).unwrap_or(1);
        let start = pcg4d([self.seed, 0, 0, 0]).map(|x| f64::from(x) / 4_294_967_296.0);
        (0..self.min_samples_per_pixel.div_ceil(side * side)).map(move |i| {
            // The R2 low-discrepancy sequence (Roberts 2018), shifted by the seed.
            let at = |from: f64, step: f64| (from + step * f64::from(i)).fract();
            SampleGrid {
                size,
                cells_per_pixel_side: side,
                sample_position_in_cell: [at(start[0], 0.754_877_666_246_693), at(start[1], 0.569_840_290_998_053)],
            }
        })
    }
}

/// Sums of linear light over the sky samples and over the water samples of one pixel. The fourth channel of a sample is
/// 0 for sky; for water it is the sample's weight in the mean of the water samples.
#[derive(Clone, Copy, Default)]
struct PixelSum {
    sky: [f64; 3],
    water: [f64; 3],
    weight: f64,
    skies: f64,
    waters: f64,
}

impl PixelSum {
    fn add(&mut self, [r, g, b, weight]: [f32; 4]) {
        // A weight that is not a number counts as water, so that the error is visible in the result.
        let (sum, share) = if weight == 0.0 {
            self.skies += 1.0;
            (&mut self.sky, 1.0)
        } else {
            self.waters += 1.0;
            self.weight += f64::from(weight);
            (&mut self.water, f64::from(weight))
        };
        for (sum, light) in sum.iter_mut().zip([r, g, b]) {
            *sum += share * f64::from(light);
        }
    }

    /// Linear light (RGB) of the pixel: the weighted mean of its water samples and the plain mean of its sky samples,
    /// mixed in proportion to the numbers of water and sky samples.
    fn mean(&self) -> [f32; 3] {
        let all = self.skies + self.waters;
        std::array::from_fn(|i| {
            let water = if self.waters > 0.0 { self.water[i] / self.weight * self.waters } else { 0.0 };
            ((self.sky[i] + water) / all) as f32
        })
    }
}

/// Renders the reference picture (each pixel the mean of many unfiltered samples) of the frame that `ocean` drew last.
/// Returns the linear light (RGB) of every pixel, row by row.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn reference_light(
    gpu: &Gpu,
    ocean: &mut Ocean,
    size: [u32; 2],
    sampling: SamplingSettings,
) -> Result<Vec<[f32; 3]>, String> {
    let width = size[0] as usize;
    let mut sums = vec![PixelSum::default(); width * size[1] as usize];
    for grid in sampling.sample_grids(size, MAX_SAMPLES_PER_TARGET, gpu.device.limits().max_texture_dimension_2d) {
        let mut encoder = gpu.encoder("samples");
        let texture = ocean.record_frame_samples(&mut encoder, &grid);
        let copy = readback::stage_texture(gpu, &mut encoder, &texture, 0);
        gpu.submit(encoder);
        let bytes = copy.read(gpu).await?;
        let side = grid.cells_per_pixel_side as usize;
        for (y, row) in bytes.chunks(16 * width * side).enumerate() {
            let sums = &mut sums[y / side * width..][..width];
            for (sum, texels) in sums.iter_mut().zip(row.chunks(16 * side)) {
                texels.chunks(16).for_each(|texel| sum.add(bytemuck::pod_read_unaligned(texel)));
            }
        }
    }
    Ok(sums.iter().map(PixelSum::mean).collect())
}

/// Renders the reference picture (each pixel the mean of many unfiltered samples) of the frame that `ocean` drew last.
/// Returns RGBA bytes, row by row, with the exposure and film response of the usual picture.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn reference_picture(
    gpu: &Gpu,
    ocean: &mut Ocean,
    size: [u32; 2],
    sampling: SamplingSettings,
) -> Result<Vec<u8>, String> {
    let light = reference_light(gpu, ocean, size, sampling).await?;
    expose_light(gpu, ocean, size, &light).await
}

/// Applies the exposure and film response of the usual, real-time picture to linear light (RGB, row by row). Returns
/// RGBA bytes, row by row.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn expose_light(gpu: &Gpu, ocean: &mut Ocean, size: [u32; 2], light: &[[f32; 3]]) -> Result<Vec<u8>, String> {
    let encoder = gpu.encoder("reference");
    still::present_and_read_back(gpu, encoder, size, |pass| ocean.present_linear_light(pass, size, light)).await
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_hold_the_samples_that_were_asked_for() {
        for samples in [1, 3, 4, 64, 256, 1000] {
            for size in [[16, 9], [192, 108], [1280, 720], [8192, 8192]] {
                let grids: Vec<SampleGrid> = SamplingSettings { min_samples_per_pixel: samples, seed: 1 }
                    .sample_grids(size, MAX_SAMPLES_PER_TARGET, 8192)
                    .collect();
                let count: u32 = grids.iter().map(|g| g.cells_per_pixel_side * g.cells_per_pixel_side).sum();
                assert!(
                    (samples..samples + grids[0].cells_per_pixel_side.pow(2)).contains(&count),
                    "{samples} {size:?} {count}"
                );
                assert!(grids.iter().all(|g| g.sample_counts().iter().all(|&s| s <= 8192)), "{size:?}");
            }
        }
        let at = |seed| {
            SamplingSettings { min_samples_per_pixel: 8, seed }
                .sample_grids([8192; 2], MAX_SAMPLES_PER_TARGET, 8192)
                .map(|g| g.sample_position_in_cell)
                .collect::<Vec<_>>()
        };
        assert_ne!(at(1), at(2));
        let mean = at(3).iter().map(|o| o[0]).sum::<f64>() / 8.0;
        assert!((mean - 0.5).abs() < 0.1, "spread evenly: {mean}");
    }

    #[test]
    fn a_pixel_of_water_and_sky_is_shared_by_their_places() {
        let mut sum = PixelSum::default();
        sum.add([1.0, 0.0, 0.0, 0.0]);
        sum.add([0.0, 1.0, 0.0, 3.0]);
        sum.add([0.0, 0.0, 1.0, 1.0]);
        let [r, g, b] = sum.mean();
        assert!((r - 1.0 / 3.0).abs() < 1e-6 && (g - 0.5).abs() < 1e-6 && (b - 1.0 / 6.0).abs() < 1e-6, "{r} {g} {b}");
        sum.add([0.0, f32::NAN, 0.0, 1.0]);
        assert!(sum.mean()[1].is_nan());
    }
}
