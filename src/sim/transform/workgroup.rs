//! The transforms on GPUs (shaders/waves/rows.wgsl and columns.wgsl).

use crate::gpu::Gpu;
use crate::gpu::kit::{Kernel, Slot};
use crate::shaders::Shaders;
use crate::shaders::fft::Factors;
use crate::sim::planned_sea::EvaluationSlot;
use crate::sim::resources::{Resources, Waves, array_view};
use crate::sim::uniforms::UniformRings;

/// Workgroup memory that a kernel may use, in vec4f: WebGPU's base limit of 16 KiB.
const EXCHANGE_LIMIT: u32 = 1024;
/// Threads that a workgroup should have at least: a warp on any GPU.
const LEAST_THREADS: u32 = 64;

/// The row pass and the column pass.
pub struct WorkgroupTransform {
    rows: Kernel,
    columns: Kernel,
    /// Workgroups per cascade.
    workgroups: u32,
    groups: Groups,
}

struct Groups {
    /// One bind group for each sea; there are two during a cross-fade.
    rows: Vec<wgpu::BindGroup>,
    columns: wgpu::BindGroup,
}

/// Lines of `n` points that share a workgroup.
fn lines_per_workgroup(n: u32) -> u32 {
    (LEAST_THREADS / Factors::new(n).second).clamp(1, EXCHANGE_LIMIT / n)
}

impl WorkgroupTransform {
    /// Compiles and binds both passes.
    pub fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, rings: &UniformRings) -> Self {
        let (lines, Factors { first, second }) = (lines_per_workgroup(r.n), Factors::new(r.n));
        let constants = [("N", r.n), ("R1", first), ("R2", second), ("LINES", lines), ("EXCHANGE", lines * r.n)]
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

    /// Binds resources that have been replaced.
    pub fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        self.groups = Groups::new(gpu, &self.rows, &self.columns, r, rings);
    }

    /// Records the waves at the evaluation's time and their transform along x.
    pub fn rows(&self, encoder: &mut wgpu::CommandEncoder, slot: EvaluationSlot) {
        let size = [self.workgroups, 1, slot.count];
        self.rows.run(encoder, &self.groups.rows[slot.waves], &[slot.uniform], size);
    }

    /// Records the transform along z and the maps.
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
