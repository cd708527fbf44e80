//! The inverse FFT on GPUs (shaders/waves/rows.wgsl and columns.wgsl).

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::{Resources, array_view, row_input_index};
use crate::sim::uniforms::SimulationUniforms;

/// Number of points that a thread holds in registers.
const POINTS_PER_THREAD: u32 = 4;
/// Largest number of vec4f in workgroup memory, where threads exchange FFT points: WebGPU's base limit of 16 KiB.
const MAX_EXCHANGE_VECTORS: u32 = 1024;
/// Smallest number of threads per workgroup: enough to fill a warp (the threads that run together) on any GPU.
const MIN_WORKGROUP_THREADS: u32 = 64;
/// Number of neighbouring columns that a workgroup of the column pass transforms, if they fit: their points of a row
/// fill the 64 bytes of a cache line.
const COLUMNS_PER_WORKGROUP: u32 = 4;

/// Row and column pass of the FFT for GPUs, with one dispatch each, in which threads share workgroup memory.
pub struct WorkgroupTransform {
    rows: Kernel,
    columns: Kernel,
    /// Number of workgroups of the row pass for each cascade.
    row_workgroups: u32,
    /// Number of workgroups of the column pass for each cascade.
    column_workgroups: u32,
    groups: FftBindGroups,
}

struct FftBindGroups {
    /// Bind groups of the row pass, one for each of `Resources::row_inputs`.
    rows: Vec<wgpu::BindGroup>,
    columns: wgpu::BindGroup,
}

/// Number of rows that a workgroup of the row pass transforms, for an FFT of `n` points per line.
fn rows_per_workgroup(n: u32) -> u32 {
    (MIN_WORKGROUP_THREADS * POINTS_PER_THREAD / n).max(1)
}

/// Number of columns that a workgroup of the column pass transforms, for an FFT of `n` points per line.
fn columns_per_workgroup(n: u32) -> u32 {
    COLUMNS_PER_WORKGROUP.min(MAX_EXCHANGE_VECTORS / n)
}

impl WorkgroupTransform {
    /// Compiles the row pass and the column pass and binds the buffers and maps of `r` and `uniforms` to them.
    pub fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) -> Self {
        let kernel = |label, module, lines, bindings: &[BindingType]| {
            let constants = [
                ("N", r.n),
                ("THREADS_PER_LINE", r.n / POINTS_PER_THREAD),
                ("LINES_PER_WORKGROUP", lines),
                ("EXCHANGE_VECTORS", lines * r.n),
            ]
            .map(|(name, value)| (name, f64::from(value)));
            Kernel::new(gpu, label, (&shaders.module(gpu, module), "main"), bindings, &constants)
        };
        let (rows_each, columns_each) = (rows_per_workgroup(r.n), columns_per_workgroup(r.n));
        let rows = [
            SimulationUniforms::SEA_BINDING,
            BindingType::StorageRead(0),
            BindingType::StorageRead(0),
            BindingType::StorageRead(0),
            BindingType::StorageReadWrite(0),
        ];
        let rows = kernel("sea/rows", "waves/rows", rows_each, &rows);
        let columns = [
            SimulationUniforms::SEA_BINDING,
            BindingType::StorageRead(0),
            BindingType::StorageReadWrite(0),
            BindingType::StorageTextureArray(r.format.texture_format()),
        ];
        let columns = kernel("sea/columns", "waves/columns", columns_each, &columns);
        let groups = FftBindGroups::new(gpu, &rows, &columns, r, uniforms);
        Self { rows, columns, row_workgroups: r.n / rows_each, column_workgroups: r.n / columns_each, groups }
    }

    /// Creates the bind groups anew after buffers or textures of `r` have been replaced.
    pub fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        self.groups = FftBindGroups::new(gpu, &self.rows, &self.columns, r, uniforms);
    }

    /// Records the row pass for one sea: the Fourier amplitudes of its waves at one time, and their inverse FFT along
    /// x.
    pub fn record_rows(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, dispatch: SeaDispatch) {
        let size = [self.row_workgroups, 1, dispatch.cascade_count];
        self.rows.run(
            encoder,
            timer.compute_pass("rows"),
            &self.groups.rows[row_input_index(dispatch.wave_buffers_index, dispatch.is_offshore)],
            &[dispatch.uniform_offset],
            size,
        );
    }

    /// Records the column pass for one sea: inverse FFT along z, to mip level 0 of its displacement and gradient maps.
    pub fn record_columns(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, dispatch: SeaDispatch) {
        let size = [self.column_workgroups, 1, dispatch.cascade_count];
        self.columns.run(
            encoder,
            timer.compute_pass("columns"),
            &self.groups.columns,
            &[dispatch.uniform_offset],
            size,
        );
    }
}

impl FftBindGroups {
    fn new(gpu: &Gpu, rows: &Kernel, columns: &Kernel, r: &Resources, uniforms: &SimulationUniforms) -> Self {
        let (sea, twiddle, lines) =
            (uniforms.sea.binding(), r.twiddle_factors.as_entire_binding(), r.row_transforms.as_entire_binding());
        let of_waves = |input: [&wgpu::Buffer; 2]| {
            let [h0, wave] = input.map(wgpu::Buffer::as_entire_binding);
            rows.bind(gpu, &[sea.clone(), h0, wave, twiddle.clone(), lines.clone()])
        };
        let maps = array_view(&r.maps, Some(0));
        let maps = wgpu::BindingResource::TextureView(&maps);
        Self {
            rows: r.row_inputs().map(of_waves).collect(),
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
            for lines in [rows_per_workgroup(n), columns_per_workgroup(n)] {
                let threads = lines * n / POINTS_PER_THREAD;
                assert!((MIN_WORKGROUP_THREADS..=256).contains(&threads) && n % lines == 0, "{n}");
                assert!(lines * n <= MAX_EXCHANGE_VECTORS, "{n}");
            }
        }
    }
}
