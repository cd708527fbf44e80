//! The compute passes of a coast (shaders/coast).

use super::resources::CoastResources;
use super::uniform::CoastUniform;
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::{Resources, SplitAmplitudes, WaveBuffers, array_view};
use crate::sim::uniforms::SimulationUniforms;
use wgpu::BindingResource::{Sampler, TextureView};

/// Number of threads of a workgroup of the passes over waves or points.
const WORKGROUP_THREADS: u32 = 64;

/// The passes that compute the waves at a coast.
pub struct CoastPasses {
    split: Kernel,
    phasors: Kernel,
    envelopes: Kernel,
    sum: Kernel,
    gradients: Kernel,
    groups: CoastBindGroups,
}

struct CoastBindGroups {
    /// One for each set in `Resources::wave_buffers`.
    split: Vec<wgpu::BindGroup>,
    phasors: Vec<wgpu::BindGroup>,
    envelopes: wgpu::BindGroup,
    sum: wgpu::BindGroup,
    gradients: wgpu::BindGroup,
}

impl CoastPasses {
    /// Compiles the passes for the coast of `r`; None if there is none.
    pub fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) -> Option<Self> {
        let coast = r.coast.as_ref()?;
        let own = BindingType::Uniform(size_of::<CoastUniform>());
        let (read, write) = (BindingType::StorageRead(0), BindingType::StorageReadWrite(0));
        let (map, sea) = (BindingType::StorageTextureArray(r.format.texture_format()), SimulationUniforms::SEA_BINDING);
        let kernel = |label, module, bindings: &[BindingType]| {
            Kernel::new(gpu, label, (&shaders.module(gpu, module), "main"), bindings, &[])
        };
        let (texture, array, sampler) = (BindingType::Texture, BindingType::TextureArray, BindingType::Sampler);
        let split = kernel("coast/split", "coast/split", &[own, read, read, write, write]);
        let phasors = kernel("coast/phasors", "coast/phasors", &[sea, own, read, read, read, write]);
        let envelopes = kernel("coast/envelopes", "coast/envelopes", &[own, read, read, read, map]);
        let sum = kernel("coast/sum", "coast/sum", &[sea, own, read, read, array, texture, sampler, write, map]);
        let gradients = kernel("coast/gradients", "coast/gradients", &[sea, own, read, map]);
        let groups = CoastBindGroups::new(gpu, [&split, &phasors, &envelopes, &sum, &gradients], (r, coast), uniforms);
        Some(Self { split, phasors, envelopes, sum, gradients, groups })
    }

    /// Creates the bind groups anew after buffers or textures of `r` have been replaced.
    pub fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        if let Some(coast) = &r.coast {
            let kernels = [&self.split, &self.phasors, &self.envelopes, &self.sum, &self.gradients];
            self.groups = CoastBindGroups::new(gpu, kernels, (r, coast), uniforms);
        }
    }

    /// Records the pass that parts the amplitudes h0 of the waves that the coast transforms from those of all others,
    /// after the amplitudes have changed. `waves` is the set with the index `index` in `Resources::wave_buffers`.
    pub fn record_split(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, r: &Resources, index: usize) {
        let (Some(coast), waves) = (&r.coast, &r.wave_buffers[index]) else { return };
        let Some(SplitAmplitudes { others, offshore }) = &waves.split else { return };
        encoder.copy_buffer_to_buffer(&waves.h0, 0, others, 0, waves.h0.size());
        encoder.clear_buffer(offshore, 0, None);
        let workgroups = (coast.transfer.waves.len() as u32).div_ceil(WORKGROUP_THREADS);
        self.split.run(encoder, timer.compute_pass("coast"), &self.groups.split[index], &[], [workgroups, 1, 1]);
    }

    /// Records the passes that write mip level 0 of the coast's layer of one sea.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, r: &Resources, dispatch: SeaDispatch) {
        let Some(coast) = &r.coast else { return };
        let transfer = &coast.transfer;
        let [waves, points] = [transfer.waves.len(), transfer.columns * transfer.rows]
            .map(|threads| (threads as u32).div_ceil(WORKGROUP_THREADS));
        let mut run = |kernel: &Kernel, group: &wgpu::BindGroup, offsets: &[u32], size: [u32; 3]| {
            kernel.run(encoder, timer.compute_pass("coast"), group, offsets, size);
        };
        let sea = [dispatch.uniform_offset];
        let texels = [r.n / 8, r.n / 8, 1];
        run(&self.phasors, &self.groups.phasors[dispatch.wave_buffers_index], &sea, [waves, 1, 1]);
        run(&self.envelopes, &self.groups.envelopes, &[], [points, 1, transfer.groups.len() as u32]);
        run(&self.sum, &self.groups.sum, &sea, texels);
        run(&self.gradients, &self.groups.gradients, &sea, texels);
    }
}

impl CoastBindGroups {
    fn new(
        gpu: &Gpu,
        [split, phasors, envelopes, sum, gradients]: [&Kernel; 5],
        (r, coast): (&Resources, &CoastResources),
        uniforms: &SimulationUniforms,
    ) -> Self {
        let own = coast.uniform.buffer.as_entire_binding();
        let sea = uniforms.sea.binding();
        let [waves, transfer, groups, carriers, amplitudes, fields] =
            [&coast.waves, &coast.transfer_envelopes, &coast.groups, &coast.carriers, &coast.phasors, &coast.fields]
                .map(wgpu::Buffer::as_entire_binding);
        let [sums, maps] = [&coast.envelopes, &r.maps].map(|texture| array_view(texture, Some(0)));
        let of_split = |of: &WaveBuffers| {
            let SplitAmplitudes { others, offshore } = of.split.as_ref()?;
            let [h0, others, offshore] = [&of.h0, others, offshore].map(wgpu::Buffer::as_entire_binding);
            Some(split.bind(gpu, &[own.clone(), waves.clone(), h0, others, offshore]))
        };
        let of_phasors = |of: &WaveBuffers| {
            let [h0, table] = [&of.h0, &of.wave_table].map(wgpu::Buffer::as_entire_binding);
            phasors.bind(gpu, &[sea.clone(), own.clone(), waves.clone(), h0, table, amplitudes.clone()])
        };
        Self {
            split: r.wave_buffers.iter().filter_map(of_split).collect(),
            phasors: r.wave_buffers.iter().map(of_phasors).collect(),
            envelopes: envelopes
                .bind(gpu, &[own.clone(), amplitudes.clone(), transfer, groups.clone(), TextureView(&sums)]),
            sum: sum.bind(
                gpu,
                &[
                    sea.clone(),
                    own.clone(),
                    groups.clone(),
                    carriers,
                    TextureView(&sums),
                    TextureView(&coast.points),
                    Sampler(&coast.sampler),
                    fields.clone(),
                    TextureView(&maps),
                ],
            ),
            gradients: gradients.bind(gpu, &[sea, own.clone(), fields, TextureView(&maps)]),
        }
    }
}
