//! Compute passes that fill the look-up tables of the sky.

use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;

/// Usage of a table: passes write it, and shaders read it.
pub const TABLE_USAGE: wgpu::TextureUsages =
    wgpu::TextureUsages::TEXTURE_BINDING.union(wgpu::TextureUsages::STORAGE_BINDING);

/// A 3D table of the given size, texels, with mip levels.
pub fn volume_texture(
    gpu: &Gpu,
    label: &str,
    [width, height, depth_or_array_layers]: [u32; 3],
    mip_level_count: u32,
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format,
        usage: TABLE_USAGE,
        view_formats: &[],
    })
}

/// Number of workgroups of 8 x 8 threads, along x, y and z, that cover a 2d table of `size` texels.
pub fn workgroups([width, height]: [u32; 2]) -> [u32; 3] {
    [width.div_ceil(8), height.div_ceil(8), 1]
}

/// A compute pass that fills a look-up table of the sky or adds up its light, with its bind group.
pub struct TablePass {
    kernel: Kernel,
    group: wgpu::BindGroup,
    workgroups: [u32; 3],
}

impl TablePass {
    /// Compiles the pass from a shader module and its entry point, with its bindings.
    pub fn new(
        gpu: &Gpu,
        label: &'static str,
        program: (&wgpu::ShaderModule, &str),
        bindings: &[(BindingType, wgpu::BindingResource<'_>)],
        workgroups: [u32; 3],
    ) -> Self {
        Self::with_constants(gpu, label, program, &[], bindings, workgroups)
    }

    /// As [`Self::new`], with names and values of override constants.
    pub fn with_constants(
        gpu: &Gpu,
        label: &'static str,
        program: (&wgpu::ShaderModule, &str),
        constants: &[(&str, f64)],
        bindings: &[(BindingType, wgpu::BindingResource<'_>)],
        workgroups: [u32; 3],
    ) -> Self {
        let (bindings, resources): (Vec<BindingType>, Vec<_>) = bindings.iter().cloned().unzip();
        let kernel = Kernel::new(gpu, label, program, &bindings, constants);
        let group = kernel.bind(gpu, &resources);
        Self { kernel, group, workgroups }
    }

    /// Makes a pass with the pipeline of this one, for other resources of the same types.
    pub fn with_resources(&self, gpu: &Gpu, resources: &[wgpu::BindingResource<'_>], workgroups: [u32; 3]) -> Self {
        Self { kernel: self.kernel.clone(), group: self.kernel.bind(gpu, resources), workgroups }
    }

    /// Records the pass.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer) {
        self.run_workgroups(encoder, timer, self.workgroups);
    }

    /// Records the pass with another number of workgroups along x, y and z.
    pub fn run_workgroups(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, workgroups: [u32; 3]) {
        self.kernel.run(encoder, timer.compute_pass("sky tables"), &self.group, &[], workgroups);
    }
}
