//! The inverse FFT on software adapters (shaders/waves/unrolled_*.wgsl).

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::shaders::fft::FftFactors;
use crate::shaders::unrolled::UnrolledKernel;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::{MapKind, Resources, row_input_index};
use crate::sim::uniforms::SimulationUniforms;
use std::sync::OnceLock;

/// Row and column passes of the FFT for software adapters, with two dispatches each, in which threads share no memory.
pub struct UnrolledTransform {
    n: u32,
    rows_first: Kernel,
    rows_second: Kernel,
    columns_first: Kernel,
    columns_second: ColumnsSecondKernels,
    buffers: IntermediateBuffers,
    groups: FftBindGroups,
}

/// GPU buffers that pass values from one of the four FFT dispatches to the next, or to the map textures.
struct IntermediateBuffers {
    /// Result of the first of two dispatches along an axis, first x, then z; as large as `Resources::row_transforms`.
    half_transforms: wgpu::Buffer,
    /// FFT result to be copied to textures: displacement maps, then gradient maps, \[map\]\[cascade\]\[z\]\[x\].
    maps: wgpu::Buffer,
}

struct FftBindGroups {
    /// Bind groups of the first kernel, one for each of `Resources::row_inputs`.
    rows_first: Vec<wgpu::BindGroup>,
    rows_second: wgpu::BindGroup,
    columns_first: wgpu::BindGroup,
    columns_second: wgpu::BindGroup,
}

/// Kernels of the last dispatch, the second round of the FFT along z. `plain` writes the maps; `with_f32` also keeps
/// them in f32. `with_f32` is compiled at its first use, as compiling takes long and few programs need the f32 maps.
struct ColumnsSecondKernels {
    gpu: Gpu,
    module: wgpu::ShaderModule,
    n: u32,
    plain: Kernel,
    with_f32: OnceLock<Kernel>,
}

impl ColumnsSecondKernels {
    fn new(gpu: &Gpu, shaders: &Shaders, n: u32) -> Self {
        let module = shaders.unrolled_module(gpu, UnrolledKernel::ColumnsSecond, n);
        let plain = Self::compile(gpu, &module, n, false);
        Self { gpu: gpu.clone(), module, n, plain, with_f32: OnceLock::new() }
    }

    fn compile(gpu: &Gpu, module: &wgpu::ShaderModule, n: u32, keeps_f32_maps: bool) -> Kernel {
        let constants = [("N", f64::from(n)), ("KEEPS_F32_MAPS", f64::from(u8::from(keeps_f32_maps)))];
        let bindings =
            [BindingType::StorageRead(0), BindingType::StorageReadWrite(0), BindingType::StorageReadWrite(0)];
        Kernel::new(gpu, "sea/columns/second", (module, "main"), &bindings, &constants)
    }

    fn kernel(&self, keeps_f32_maps: bool) -> &Kernel {
        if keeps_f32_maps {
            self.with_f32.get_or_init(|| Self::compile(&self.gpu, &self.module, self.n, true))
        } else {
            &self.plain
        }
    }
}

impl UnrolledTransform {
    /// Allocates the intermediate buffers, compiles the four kernels, and binds buffers of `r` and `uniforms` to them.
    pub fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) -> Self {
        let n = r.n;
        let kernel = |label, kernel, bindings: &[BindingType]| {
            let module = shaders.unrolled_module(gpu, kernel, n);
            Kernel::new(gpu, label, (&module, "main"), bindings, &[("N", f64::from(n))])
        };
        let (read, write) = (BindingType::StorageRead(0), BindingType::StorageReadWrite(0));
        let rows_first = [SimulationUniforms::SEA_BINDING, read, read, read, write];
        let rows_first = kernel("sea/rows/first", UnrolledKernel::RowsFirst, &rows_first);
        let rows_second = kernel("sea/rows/second", UnrolledKernel::RowsSecond, &[read, write]);
        let columns_first = kernel("sea/columns/first", UnrolledKernel::ColumnsFirst, &[read, read, write]);
        let columns_second = ColumnsSecondKernels::new(gpu, shaders, n);
        let buffers = IntermediateBuffers::new(gpu, r);
        let kernels = [&rows_first, &rows_second, &columns_first, &columns_second.plain];
        let groups = FftBindGroups::new(gpu, kernels, &buffers, r, uniforms);
        Self { n, rows_first, rows_second, columns_first, columns_second, buffers, groups }
    }

    /// Creates the bind groups anew, and the intermediate buffers if their size has changed. Call this after buffers of
    /// `r` have been replaced.
    pub fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        if self.buffers.half_transforms.size() != r.row_transforms.size() {
            self.buffers = IntermediateBuffers::new(gpu, r);
        }
        let kernels = [&self.rows_first, &self.rows_second, &self.columns_first, &self.columns_second.plain];
        self.groups = FftBindGroups::new(gpu, kernels, &self.buffers, r, uniforms);
    }

    /// Records the row pass for one sea: the Fourier amplitudes of its waves at one time, and their inverse FFT along
    /// x.
    pub fn record_rows(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, dispatch: SeaDispatch) {
        let (n, FftFactors { first_round_points: first, second_round_points: second }) =
            (self.n, FftFactors::new(self.n));
        // One row of threads computes two rows of opposite wave vectors: n / 2 + 1 rows in workgroups of 8.
        let size = [second / 8, n / 16 + 1, dispatch.cascade_count];
        self.rows_first.run(
            encoder,
            timer.compute_pass("rows"),
            &self.groups.rows_first[row_input_index(dispatch.wave_buffers_index, dispatch.is_offshore)],
            &[dispatch.uniform_offset],
            size,
        );
        self.rows_second.run(
            encoder,
            timer.compute_pass("rows"),
            &self.groups.rows_second,
            &[],
            [first / 8, n / 8, 2 * dispatch.cascade_count],
        );
    }

    /// Records the column pass for one sea: inverse FFT along z, and a copy of its results to mip level 0 of the maps.
    pub fn record_columns(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        r: &Resources,
        dispatch: SeaDispatch,
    ) {
        let (n, FftFactors { first_round_points: first, second_round_points: second }) =
            (self.n, FftFactors::new(self.n));
        self.columns_first.run(
            encoder,
            timer.compute_pass("columns"),
            &self.groups.columns_first,
            &[],
            [n / 64, second, 2 * dispatch.cascade_count],
        );
        let kernel = self.columns_second.kernel(dispatch.keeps_f32_maps);
        kernel.run(
            encoder,
            timer.compute_pass("columns"),
            &self.groups.columns_second,
            &[],
            [n / 64, first, 2 * dispatch.cascade_count],
        );
        for (kind, index) in [(MapKind::Displacement, 0), (MapKind::Gradients, 1)] {
            let offset = index * u64::from(r.format.bytes_per_texel() * n * n * dispatch.cascade_count);
            let first_layer = r.layers_of_kind(kind).start + dispatch.first_layer;
            encoder.copy_buffer_to_texture(
                wgpu::TexelCopyBufferInfo {
                    buffer: &self.buffers.maps,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset,
                        bytes_per_row: Some(r.format.bytes_per_texel() * n),
                        rows_per_image: Some(n),
                    },
                },
                wgpu::TexelCopyTextureInfo {
                    origin: wgpu::Origin3d { x: 0, y: 0, z: first_layer },
                    ..r.maps.as_image_copy()
                },
                wgpu::Extent3d { width: n, height: n, depth_or_array_layers: dispatch.cascade_count },
            );
        }
    }
}

impl IntermediateBuffers {
    fn new(gpu: &Gpu, r: &Resources) -> Self {
        // Each vec4f in `row_transforms` becomes one texel of a map.
        let texels = r.row_transforms.size() / size_of::<[f32; 4]>() as u64;
        Self {
            half_transforms: gpu.storage_buffer("halves", r.row_transforms.size()),
            maps: gpu.storage_buffer("maps", texels * u64::from(r.format.bytes_per_texel())),
        }
    }
}

impl FftBindGroups {
    /// Creates the bind groups of the four FFT kernels, which are given in the order of their dispatches.
    fn new(
        gpu: &Gpu,
        kernels: [&Kernel; 4],
        buffers: &IntermediateBuffers,
        r: &Resources,
        uniforms: &SimulationUniforms,
    ) -> Self {
        let [rows_first, rows_second, columns_first, columns_second] = kernels;
        let [twiddle, lines] = [&r.twiddle_factors, &r.row_transforms].map(wgpu::Buffer::as_entire_binding);
        let [half_transforms, maps] = [&buffers.half_transforms, &buffers.maps].map(wgpu::Buffer::as_entire_binding);
        let of_waves = |input: [&wgpu::Buffer; 2]| {
            let [h0, wave] = input.map(wgpu::Buffer::as_entire_binding);
            rows_first.bind(gpu, &[uniforms.sea.binding(), h0, wave, twiddle.clone(), half_transforms.clone()])
        };
        Self {
            rows_first: r.row_inputs().map(of_waves).collect(),
            rows_second: rows_second.bind(gpu, &[half_transforms.clone(), lines.clone()]),
            columns_first: columns_first.bind(gpu, &[twiddle.clone(), lines.clone(), half_transforms.clone()]),
            columns_second: columns_second.bind(gpu, &[half_transforms.clone(), maps, lines.clone()]),
        }
    }
}
