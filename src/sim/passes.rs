//! Compute passes of the simulation, in the order of a frame. A pass has a pipeline, bind groups and a dispatch size.

use super::maps::FOAM_LEVELS;
use super::planned_sea::EvaluationSlot;
use super::resources::{MapKind, Resources, Waves, array_view, map};
use super::transform::{Transform, TransformWay};
use super::uniforms::{STRUCTS, UniformRings};
use crate::gpu::Gpu;
use crate::gpu::kit::{Kernel, Slot};
use crate::shaders::Shaders;

/// All compute passes of a simulation.
pub struct Passes {
    /// Computes h0, the random Fourier amplitude of every wave at time 0.
    pub spectrum: SpectrumPass,
    /// Row and column passes: the inverse FFT of the waves at a time, which gives the displacement and gradient maps.
    pub transform: Transform,
    /// Computes the mip levels of the displacement and gradient maps, and the slope moments.
    pub mips: MipsPass,
    /// Advances the foam by one time step.
    pub foam: FoamPass,
}

impl Passes {
    /// Compiles all passes and creates their bind groups.
    pub fn new(gpu: &Gpu, shaders: &Shaders, way: TransformWay, r: &Resources, rings: &UniformRings) -> Self {
        let shaders = &shaders.clone().with_structs(STRUCTS);
        Self {
            spectrum: SpectrumPass::new(gpu, shaders, r, rings),
            transform: Transform::new(gpu, shaders, way, r, rings),
            mips: MipsPass::new(gpu, shaders, way, r, rings),
            foam: FoamPass::new(gpu, shaders, r, rings),
        }
    }

    /// Number of compute dispatches of an ordinary frame: one sea with unchanged waves, one foam time step.
    pub fn dispatches(&self) -> u32 {
        self.transform.dispatches() + self.mips.steps.len() as u32 + 1
    }

    /// Creates the bind groups anew after buffers or textures have been replaced.
    pub fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        self.spectrum.bind(gpu, r, rings);
        self.transform.bind(gpu, r, rings);
        self.mips.bind(gpu, r, rings);
        self.foam.bind(gpu, r, rings);
    }
}

/// Pass that computes h0, the Fourier amplitudes at time 0, from the spectrum (shaders/waves/spectrum.wgsl).
pub struct SpectrumPass {
    kernel: Kernel,
    /// One bind group for each sea. The second one exists from the first cross-fade on.
    groups: Vec<wgpu::BindGroup>,
}

impl SpectrumPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, rings: &UniformRings) -> Self {
        let module = shaders.module(gpu, "waves/spectrum");
        let slots = [UniformRings::SEA, Slot::Read(0), Slot::Write(0)];
        let kernel = Kernel::new(gpu, "sea/spectrum", (&module, "main"), &slots, &[]);
        let mut pass = Self { kernel, groups: Vec::new() };
        pass.bind(gpu, r, rings);
        pass
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        let group = |waves: &Waves| {
            let [radial, h0] = [&waves.radial, &waves.h0].map(wgpu::Buffer::as_entire_binding);
            self.kernel.bind(gpu, &[rings.sea.binding(), radial, h0])
        };
        self.groups = r.waves.iter().map(group).collect();
    }

    /// Records the computation of h0, the Fourier amplitudes at time 0, for all cascades of a sea.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, slot: EvaluationSlot) {
        self.kernel.run(encoder, &self.groups[slot.waves], &[slot.uniform], [r.n / 64, r.n, slot.count]);
    }
}

/// Pass that computes mip levels and slope moments (shaders/waves/mips.wgsl, or unrolled_mips.wgsl in software).
pub struct MipsPass {
    steps: Vec<MipsStep>,
    /// Number of mip levels that one dispatch can write.
    images: u32,
    /// Small unused texture, bound in place of mip levels that the maps do not have.
    nothing: wgpu::TextureView,
}

/// One dispatch of the mip pass, which reads one mip level and writes the next ones.
struct MipsStep {
    kernel: Kernel,
    group: wgpu::BindGroup,
    /// Mip level that the dispatch reads.
    above: u32,
    /// Number of mip levels that the dispatch writes.
    levels: u32,
}

impl MipsPass {
    fn new(gpu: &Gpu, shaders: &Shaders, way: TransformWay, r: &Resources, rings: &UniformRings) -> Self {
        let (module, images): (_, u32) = match way {
            // WebGPU's base limits allow four storage textures.
            TransformWay::Workgroup => (shaders.module(gpu, "waves/mips"), 4),
            TransformWay::Unrolled => (shaders.module(gpu, "waves/unrolled_mips"), 1),
        };
        let written = (0..images).map(|_| Slot::ImageArray(r.format.texture()));
        let slots: Vec<Slot> = [UniformRings::SEA, Slot::TextureArray].into_iter().chain(written).collect();
        let nothing = array_view(&map(gpu, "nothing", [1; 3], 1, r.format), None);
        let steps = (0..r.mips() - 1).step_by(images as usize).map(|above| {
            let levels = images.min(r.mips() - 1 - above);
            let mut constants = vec![("READS_LEVEL_0", f64::from(u8::from(above == 0)))];
            if way == TransformWay::Workgroup {
                constants.push(("LEVELS_WRITTEN", f64::from(levels)));
            }
            let kernel = Kernel::new(gpu, "sea/mips", (&module, "main"), &slots, &constants);
            let group = Self::group(gpu, &kernel, r, rings, (above, levels, images), &nothing);
            MipsStep { kernel, group, above, levels }
        });
        Self { steps: steps.collect(), images, nothing }
    }

    fn group(
        gpu: &Gpu,
        kernel: &Kernel,
        r: &Resources,
        rings: &UniformRings,
        (above, levels, images): (u32, u32, u32),
        nothing: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        let views: Vec<_> = (0..=levels).map(|i| array_view(&r.maps, Some(above + i))).collect();
        let views = views.iter().chain((levels..images).map(|_| nothing)).map(wgpu::BindingResource::TextureView);
        kernel.bind(gpu, &std::iter::once(rings.sea.binding()).chain(views).collect::<Vec<_>>())
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        for step in &mut self.steps {
            let levels = (step.above, step.levels, self.images);
            step.group = Self::group(gpu, &step.kernel, r, rings, levels, &self.nothing);
        }
    }

    /// Records the computation of all mip levels above 0.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, slot: EvaluationSlot) {
        for step in &self.steps {
            let groups = (r.n >> (step.above + 1)).div_ceil(8);
            step.kernel.run(encoder, &step.group, &[slot.uniform], [groups, groups, slot.count]);
        }
    }
}

/// Pass that advances the foam by one time step (shaders/foam/foam.wgsl).
pub struct FoamPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl FoamPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, rings: &UniformRings) -> Self {
        let module = shaders.module(gpu, "foam/foam");
        let slots = [
            UniformRings::SEA,
            UniformRings::FOAM,
            Slot::TextureArray,
            Slot::TextureArray,
            Slot::Sampler,
            Slot::Write(0),
            Slot::ImageArray(r.format.texture()),
        ];
        let kernel = Kernel::new(gpu, "sea/foam", (&module, "main"), &slots, &[]);
        let group = Self::group(gpu, &kernel, r, rings);
        Self { kernel, group }
    }

    fn group(gpu: &Gpu, kernel: &Kernel, r: &Resources, rings: &UniformRings) -> wgpu::BindGroup {
        kernel.bind(
            gpu,
            &[
                rings.sea.binding(),
                rings.foam.binding(),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Displacement)),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Gradients)),
                wgpu::BindingResource::Sampler(&r.repeat),
                r.foam_history.as_entire_binding(),
                wgpu::BindingResource::TextureView(&array_view(&r.foam, Some(0))),
            ],
        )
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, rings: &UniformRings) {
        self.group = Self::group(gpu, &self.kernel, r, rings);
    }

    /// Records one time step of all foam levels. `foam` is the dynamic offset of the step's uniform, bytes. During a
    /// cross-fade, `slot` may belong to either sea, because both have the same choppiness.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, slot: EvaluationSlot, foam: u32) {
        let size = [r.foam_n / 8, r.foam_n / 8, FOAM_LEVELS as u32];
        self.kernel.run(encoder, &self.group, &[slot.uniform, foam], size);
    }
}
