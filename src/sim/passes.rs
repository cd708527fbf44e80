//! Compute passes of the simulation, in the order of a frame. A pass has a pipeline, bind groups and a dispatch size.

use super::coast::passes::CoastPasses;
use super::planned_sea::SeaDispatch;
use super::resources::{MapKind, Resources, WaveBuffers, array_view, create_array_texture};
use super::transform::{FftImplementation, Transform};
use super::uniforms::{SHARED_STRUCTS, SimulationUniforms};
use crate::gpu::Gpu;
use crate::gpu::kit::{BindingType, Kernel};
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::waves::foam::FOAM_LEVEL_COUNT;

/// All compute passes of the simulation, which turn a wave spectrum into displacement, gradient and foam maps.
pub struct Passes {
    /// Pass that computes h0, the random Fourier amplitude of every wave at time 0, when the waves change.
    pub spectrum: SpectrumPass,
    /// Row and column pass: the inverse FFT of the waves at one time, which gives the displacement and gradient maps.
    pub transform: Transform,
    /// Pass that computes all smaller mip levels of the displacement and gradient maps, and the slope moments.
    pub mips: MipsPass,
    /// Passes that compute the waves at a coast; None in the open sea.
    pub coast: Option<CoastPasses>,
    /// Pass that advances the foam of all foam levels (nested square grids) by one time step.
    pub foam: FoamPass,
}

impl Passes {
    /// Compiles all passes and creates their bind groups with the resources `r` and the uniform buffers `uniforms`.
    pub fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        implementation: FftImplementation,
        r: &Resources,
        uniforms: &SimulationUniforms,
    ) -> Self {
        let shaders = &shaders.clone().with_structs(SHARED_STRUCTS);
        Self {
            spectrum: SpectrumPass::new(gpu, shaders, r, uniforms),
            transform: Transform::new(gpu, shaders, implementation, r, uniforms),
            mips: MipsPass::new(gpu, shaders, implementation, r, uniforms),
            coast: CoastPasses::new(gpu, shaders, r, uniforms),
            foam: FoamPass::new(gpu, shaders, r, uniforms),
        }
    }

    /// Number of compute dispatches of an ordinary frame: one sea with unchanged waves, one foam time step.
    pub fn dispatch_count(&self) -> u32 {
        self.transform.dispatch_count() + self.mips.steps.len() as u32 + 1
    }

    /// Compiles the passes that a coast changes or adds, after `r` has got another coast or none, and renews all bind
    /// groups.
    pub fn set_coast(&mut self, gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) {
        let shaders = &shaders.clone().with_structs(SHARED_STRUCTS);
        if self.coast.is_some() != r.coast.is_some() {
            self.coast = CoastPasses::new(gpu, shaders, r, uniforms);
            self.foam = FoamPass::new(gpu, shaders, r, uniforms);
        }
        self.recreate_bind_groups(gpu, r, uniforms);
    }

    /// Creates the bind groups of all passes anew. Call this after buffers or textures of `r` have been replaced.
    pub fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        self.spectrum.recreate_bind_groups(gpu, r, uniforms);
        self.transform.recreate_bind_groups(gpu, r, uniforms);
        self.mips.recreate_bind_groups(gpu, r, uniforms);
        self.coast.iter_mut().for_each(|coast| coast.recreate_bind_groups(gpu, r, uniforms));
        self.foam.recreate_bind_groups(gpu, r, uniforms);
    }
}

/// Pass that computes h0, the Fourier amplitudes at time 0, from the spectrum (shaders/waves/spectrum.wgsl).
pub struct SpectrumPass {
    kernel: Kernel,
    /// Bind groups of the pass, one per set in `Resources::wave_buffers`: two from the first cross-fade on.
    groups: Vec<wgpu::BindGroup>,
}

impl SpectrumPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) -> Self {
        let module = shaders.module(gpu, "waves/spectrum");
        let bindings = [SimulationUniforms::SEA_BINDING, BindingType::StorageRead(0), BindingType::StorageReadWrite(0)];
        let kernel = Kernel::new(gpu, "sea/spectrum", (&module, "main"), &bindings, &[]);
        let mut pass = Self { kernel, groups: Vec::new() };
        pass.recreate_bind_groups(gpu, r, uniforms);
        pass
    }

    fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        let group = |waves: &WaveBuffers| {
            let [spectrum_table, h0] = [&waves.spectrum_table, &waves.h0].map(wgpu::Buffer::as_entire_binding);
            self.kernel.bind(gpu, &[uniforms.sea.binding(), spectrum_table, h0])
        };
        self.groups = r.wave_buffers.iter().map(group).collect();
    }

    /// Records the computation of h0, the Fourier amplitudes at time 0 of the waves of all cascades of one sea.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, r: &Resources, dispatch: SeaDispatch) {
        self.kernel.run(
            encoder,
            timer.compute_pass("spectrum"),
            &self.groups[dispatch.wave_buffers_index],
            &[dispatch.uniform_offset],
            [r.n / 64, r.n, dispatch.cascade_count],
        );
    }
}

/// Pass that computes the maps' mip levels and slope moments (shaders/waves/mips.wgsl; on software adapters
/// shaders/waves/unrolled_mips.wgsl).
pub struct MipsPass {
    steps: Vec<MipsDispatch>,
    /// Number of mip levels that one dispatch can write: the number of storage textures in its bind group.
    levels_per_dispatch: u32,
    /// Small unused texture, bound in place of mip levels that the maps do not have.
    placeholder_view: wgpu::TextureView,
}

/// One dispatch of the mip pass, which reads one mip level of the maps and writes the next smaller ones.
struct MipsDispatch {
    kernel: Kernel,
    group: wgpu::BindGroup,
    /// Mip level of the maps that the dispatch reads.
    source_level: u32,
    /// Number of mip levels that the dispatch writes: those that follow `source_level`.
    levels: u32,
}

impl MipsPass {
    fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        implementation: FftImplementation,
        r: &Resources,
        uniforms: &SimulationUniforms,
    ) -> Self {
        let (module, levels_per_dispatch): (_, u32) = match implementation {
            // WebGPU's base limits allow four storage textures.
            FftImplementation::Workgroup => (shaders.module(gpu, "waves/mips"), 4),
            FftImplementation::Unrolled => (shaders.module(gpu, "waves/unrolled_mips"), 1),
        };
        let written = (0..levels_per_dispatch).map(|_| BindingType::StorageTextureArray(r.format.texture_format()));
        let bindings: Vec<BindingType> =
            [SimulationUniforms::SEA_BINDING, BindingType::TextureArray].into_iter().chain(written).collect();
        let placeholder_view = array_view(&create_array_texture(gpu, "placeholder", [1; 3], 1, r.format), None);
        let mut compiled: Vec<(Vec<(&str, f64)>, Kernel)> = Vec::new();
        let steps = (0..r.mip_level_count() - 1).step_by(levels_per_dispatch as usize).map(|source_level| {
            let levels = levels_per_dispatch.min(r.mip_level_count() - 1 - source_level);
            let mut constants = vec![("READS_LEVEL_0", f64::from(u8::from(source_level == 0)))];
            if implementation == FftImplementation::Workgroup {
                constants.push(("LEVELS_WRITTEN", f64::from(levels)));
            }
            let kernel = match compiled.iter().find(|(with, _)| *with == constants) {
                Some((_, kernel)) => kernel.clone(),
                None => {
                    let kernel = Kernel::new(gpu, "sea/mips", (&module, "main"), &bindings, &constants);
                    compiled.push((constants, kernel.clone()));
                    kernel
                }
            };
            let group = Self::create_bind_group(
                gpu,
                &kernel,
                r,
                uniforms,
                (source_level, levels, levels_per_dispatch),
                &placeholder_view,
            );
            MipsDispatch { kernel, group, source_level, levels }
        });
        Self { steps: steps.collect(), levels_per_dispatch, placeholder_view }
    }

    fn create_bind_group(
        gpu: &Gpu,
        kernel: &Kernel,
        r: &Resources,
        uniforms: &SimulationUniforms,
        (source_level, levels, levels_per_dispatch): (u32, u32, u32),
        placeholder_view: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        let views: Vec<_> = (0..=levels).map(|i| array_view(&r.maps, Some(source_level + i))).collect();
        let views = views
            .iter()
            .chain((levels..levels_per_dispatch).map(|_| placeholder_view))
            .map(wgpu::BindingResource::TextureView);
        kernel.bind(gpu, &std::iter::once(uniforms.sea.binding()).chain(views).collect::<Vec<_>>())
    }

    fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        for step in &mut self.steps {
            let levels = (step.source_level, step.levels, self.levels_per_dispatch);
            step.group = Self::create_bind_group(gpu, &step.kernel, r, uniforms, levels, &self.placeholder_view);
        }
    }

    /// Records the computation of all mip levels above 0 of one sea's displacement, gradient and slope-moment maps.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, r: &Resources, dispatch: SeaDispatch) {
        for step in &self.steps {
            let groups = (r.n >> (step.source_level + 1)).div_ceil(8);
            step.kernel.run(
                encoder,
                timer.compute_pass("mips"),
                &step.group,
                &[dispatch.uniform_offset],
                [groups, groups, dispatch.layer_count],
            );
        }
    }
}

/// Pass that advances the foam of all foam levels (nested square grids) by one time step (shaders/foam/foam.wgsl).
pub struct FoamPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl FoamPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, uniforms: &SimulationUniforms) -> Self {
        let module = shaders.module(gpu, "foam/foam");
        let bindings = [
            SimulationUniforms::SEA_BINDING,
            SimulationUniforms::FOAM_BINDING,
            BindingType::TextureArray,
            BindingType::TextureArray,
            BindingType::Sampler,
            BindingType::StorageReadWrite(0),
            BindingType::StorageTextureArray(r.format.texture_format()),
            BindingType::Texture,
        ];
        let constants = [("FOAM_COAST", f64::from(u8::from(r.coast.is_some())))];
        let kernel = Kernel::new(gpu, "sea/foam", (&module, "main"), &bindings, &constants);
        let group = Self::create_bind_group(gpu, &kernel, r, uniforms);
        Self { kernel, group }
    }

    fn create_bind_group(gpu: &Gpu, kernel: &Kernel, r: &Resources, uniforms: &SimulationUniforms) -> wgpu::BindGroup {
        let gains = r.coast.as_ref().map_or(&r.placeholder, |coast| &coast.gains);
        kernel.bind(
            gpu,
            &[
                uniforms.sea.binding(),
                uniforms.foam.binding(),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Displacement)),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Gradients)),
                wgpu::BindingResource::Sampler(&r.repeating_sampler),
                r.foam_history.as_entire_binding(),
                wgpu::BindingResource::TextureView(&array_view(&r.foam, Some(0))),
                wgpu::BindingResource::TextureView(gains),
            ],
        )
    }

    fn recreate_bind_groups(&mut self, gpu: &Gpu, r: &Resources, uniforms: &SimulationUniforms) {
        self.group = Self::create_bind_group(gpu, &self.kernel, r, uniforms);
    }

    /// Records one time step of all foam levels, from the present wave maps. `dispatch` selects the uniform with the
    /// choppiness, common to both seas of a cross-fade; `foam` is the byte offset of the step's uniform in its buffer.
    pub fn run(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        r: &Resources,
        dispatch: SeaDispatch,
        foam: u32,
    ) {
        let size = [r.foam_n / 8, r.foam_n / 8, FOAM_LEVEL_COUNT as u32];
        self.kernel.run(encoder, timer.compute_pass("foam"), &self.group, &[dispatch.uniform_offset, foam], size);
    }
}
