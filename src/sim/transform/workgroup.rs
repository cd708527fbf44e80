//! The inverse FFT on GPUs (shaders/waves/rows.wgsl and columns.wgsl).

use crate::gpu::Gpu;
use crate::gpu::kit::{Kernel, Slot};
use crate::shaders::Shaders;
use crate::shaders::fft::Factors;
use crate::sim::planned_sea::EvaluationSlot;
use crate::sim::resources::{Resources, Waves, array_view};
use crate::sim::uniforms::UniformRings;

/// Largest number of vec4f in the memory of a workgroup: WebGPU's base limit of 16 KiB.
const EXCHANGE_LIMIT: u32 = 1024;
/// Smallest number of threads per workgroup, so that it fills a warp on any GPU.
const LEAST_THREADS: u32 = 64;

/// Row and column pass of the FFT for GPUs, with one dispatch each.
pub struct WorkgroupTransform {
    rows: Kernel,
    columns: Kernel,
    /// Number of workgroups for each cascade.
    workgroups: u32,
    groups: Groups,
}

struct Groups {
    /// One bind group for each sea. The second one exists from the first cross-fade on.
    rows: Vec<wgpu::BindGroup>,
    columns: wgpu::BindGroup,
}

/// Number of lines that one workgroup transforms, for an FFT of `n` points per line.
fn lines_per_workgroup(n: u32) -> u32 {
    (LEAST_THREADS / Factors::new(n).second).clamp(1, EXCHANGE_LIMIT / n)
}

impl WorkgroupTransform {
    /// Compiles both passes and creates their bind groups.
    pub fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, rings: &UniformRings) -> Self {
        let (lines, Factors { first, second }) = (lines_per_workgroup(r.n), Factors::new(r.n));
        let constants = [("N", r.n), ("RADIX_1", first), ("RADIX_2", second), ("LINES_PER_WORKGROUP", lines), ("EXCHANGE_VECTORS", lines * r.n)]
            .map(|(name, value)| (name, f64::from(value)));
        let kernel = |label, module, slots: &[Slot]| {
            Kernel::new(gpu, label, (&shaders.module(gpu, module), "main"), slots, &constants)
        };
        let rows = [UniformRings::SEA, Slot::Read(0), Slot::Read(0), Slot::Read(0), Slot::Write(0)];
        let rows = kernel("sea/rows", "waves/rows", &rows);
        let columns = [UniformRings::SEA, Slot::Read(0), Slot::Write(0), Slot::ImageArray(r.format.texture())];
        let columns = kernel("sea/columns", "waves/columns", &columns);
        let groups = Groups::new(gpu, &rows, &columns, r, rings);
        Self { rows, columns, workgroups: r.n / lines, groups }
    }

    /// Creates the bind groups anew after buffers or textures have been replaced.
    pub fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        self.groups = Groups::new(gpu, &self.rows, &self.columns, r, rings);
    }

    /// Records the row pass: computes the waves at the evaluation's time and transforms them along x.
    pub fn rows(&self, encoder: &mut wgpu::CommandEncoder, slot: EvaluationSlot) {
        let size = [self.workgroups, 1, slot.count];
        self.rows.run(encoder, &self.groups.rows[slot.waves], &[slot.uniform], size);
    }

    /// Records the column pass: transforms along z and writes mip level 0 of the displacement and gradient maps.
    pub fn columns(&self, encoder: &mut wgpu::CommandEncoder, slot: EvaluationSlot) {
        let size = [self.workgroups, 1, slot.count];
        self.columns.run(encoder, &self.groups.columns, &[slot.uniform], size);
    }
}

impl Groups {
    fn new(gpu: &Gpu, rows: &Kernel, columns: &Kernel, r: &Resources, rings: &UniformRings) -> Self {
        let (sea, twiddle, lines) = (rings.sea.binding(), r.twiddle.as_entire_binding(), r.lines.as_entire_binding());
        let of_waves = |waves: &Waves| {
            let [h0, wave] = [&waves.h0, &waves.wave].map(wgpu::Buffer::as_entire_binding);
            rows.bind(gpu, &[sea.clone(), h0, wave, twiddle.clone(), lines.clone()])
        };
        let maps = array_view(&r.maps, Some(0));
        let maps = wgpu::BindingResource::TextureView(&maps);
        Self {
            rows: r.waves.iter().map(of_waves).collect(),
            columns: columns.bind(gpu, &[sea.clone(), twiddle.clone(), lines.clone(), maps]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_fit_the_base_limits() {
        for n in [64, 128, 256, 512, 1024] {
            let (lines, Factors { first, second }) = (lines_per_workgroup(n), Factors::new(n));
            assert_eq!(first * second, n);
            assert!(first >= second && [8, 16, 32].contains(&first) && [8, 16, 32].contains(&second));
            assert!(lines * n <= EXCHANGE_LIMIT && n % lines == 0 && lines * second <= 256);
        }
    }
}
