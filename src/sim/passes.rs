//! The compute passes, in the order of the frame. A pass is a kernel, its bindings and its number of workgroups.

use super::resources::{Resources, Waves, view};
use super::transform::Transform;
use crate::gpu::kernel::{Kernel, Slot, UniformRing};
use crate::gpu::layout::{FOAM_LEVELS, FoamUniform, SeaUniform};
use crate::gpu::shaders::Shaders;

const SEA: Slot = Slot::Uniform(size_of::<SeaUniform>() as u64);
const FOAM: Slot = Slot::Uniform(size_of::<FoamUniform>() as u64);

/// One evaluation of a sea: its uniform and what it goes over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Dynamic offset of the uniform.
    pub uniform: u32,
    /// Cascades.
    pub count: u32,
    /// Whether it is the sea that fades.
    pub fades: bool,
}

/// All passes of a simulation.
pub struct Passes {
    /// h0 of every wave.
    pub spectrum: SpectrumPass,
    /// Waves at a time, transformed along x.
    pub rows: RowsPass,
    /// Transformed along z, and the maps.
    pub columns: ColumnsPass,
    /// Filtered maps and slope moments.
    pub mips: MipsPass,
    /// Foam.
    pub foam: FoamPass,
}

impl Passes {
    /// Compiles and binds everything.
    pub fn new(
        device: &wgpu::Device,
        shaders: &Shaders,
        resources: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> Self {
        Self {
            spectrum: SpectrumPass::new(device, shaders, resources, sea),
            rows: RowsPass::new(device, shaders, resources, sea),
            columns: ColumnsPass::new(device, shaders, resources, sea),
            mips: MipsPass::new(device, shaders, resources, sea),
            foam: FoamPass::new(device, shaders, resources, sea, foam),
        }
    }

    /// Binds anew what belongs to a sea: its buffers are others.
    pub fn bind_waves(&mut self, device: &wgpu::Device, r: &Resources, sea: &UniformRing<SeaUniform>) {
        self.spectrum.group = SpectrumPass::group(device, &self.spectrum.kernel, r, sea);
        self.rows.groups = RowsPass::groups(device, &self.rows.kernel, r, sea);
    }

    /// Binds anew what reads and writes maps, and the intermediate buffer.
    pub fn bind_maps(
        &mut self,
        device: &wgpu::Device,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) {
        self.columns.group = ColumnsPass::group(device, &self.columns.kernel, r, sea);
        self.mips.groups = MipsPass::groups(device, [&self.mips.first, &self.mips.next], r, sea);
        self.foam.group = FoamPass::group(device, &self.foam.kernel, r, sea, foam);
    }
}

/// shaders/spectrum.wgsl
pub struct SpectrumPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl SpectrumPass {
    fn new(device: &wgpu::Device, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let module = shaders.module(device, "spectrum");
        let kernel = Kernel::new(device, "sea/spectrum", &module, &[SEA, Slot::Read, Slot::Write], &[]);
        let group = Self::group(device, &kernel, r, sea);
        Self { kernel, group }
    }

    fn group(device: &wgpu::Device, kernel: &Kernel, r: &Resources, sea: &UniformRing<SeaUniform>) -> wgpu::BindGroup {
        kernel.bind(device, &[sea.binding(), r.sea.radial.as_entire_binding(), r.sea.h0.as_entire_binding()])
    }

    /// Draws h0 of all cascades.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        self.kernel.run(encoder, &self.group, &[sea.uniform], [r.n / 64, r.n, sea.count]);
    }
}

/// shaders/rows.wgsl
pub struct RowsPass {
    kernel: Kernel,
    /// Of the sea, and of the one that fades.
    groups: [Option<wgpu::BindGroup>; 2],
    transform: Transform,
}

impl RowsPass {
    fn new(device: &wgpu::Device, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let transform = Transform::new(r.n);
        let module = shaders.module(device, "rows");
        let slots = [SEA, Slot::Read, Slot::Read, Slot::Read, Slot::Write];
        let kernel = Kernel::new(device, "sea/rows", &module, &slots, &transform.constants());
        let groups = Self::groups(device, &kernel, r, sea);
        Self { kernel, groups, transform }
    }

    fn groups(
        device: &wgpu::Device,
        kernel: &Kernel,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
    ) -> [Option<wgpu::BindGroup>; 2] {
        let group = |waves: &Waves| {
            kernel.bind(
                device,
                &[
                    sea.binding(),
                    waves.h0.as_entire_binding(),
                    waves.wave.as_entire_binding(),
                    r.twiddle.as_entire_binding(),
                    r.lines.as_entire_binding(),
                ],
            )
        };
        [Some(group(&r.sea)), r.other.as_ref().map(group)]
    }

    /// Evolves and transforms all cascades in one dispatch.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        let Some(group) = &self.groups[usize::from(sea.fades)] else { return };
        self.kernel.run(encoder, group, &[sea.uniform], [r.n / self.transform.lines, 1, sea.count]);
    }
}

/// shaders/columns.wgsl
pub struct ColumnsPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
    transform: Transform,
}

impl ColumnsPass {
    fn new(device: &wgpu::Device, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let transform = Transform::new(r.n);
        let module = shaders.module(device, "columns");
        let slots = [SEA, Slot::Read, Slot::Write, Slot::Image, Slot::Image];
        let kernel = Kernel::new(device, "sea/columns", &module, &slots, &transform.constants());
        let group = Self::group(device, &kernel, r, sea);
        Self { kernel, group, transform }
    }

    fn group(device: &wgpu::Device, kernel: &Kernel, r: &Resources, sea: &UniformRing<SeaUniform>) -> wgpu::BindGroup {
        kernel.bind(
            device,
            &[
                sea.binding(),
                r.twiddle.as_entire_binding(),
                r.lines.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&r.displacement, Some(0))),
                wgpu::BindingResource::TextureView(&view(&r.gradients, Some(0))),
            ],
        )
    }

    /// Transforms and unpacks all cascades in one dispatch.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        self.kernel.run(encoder, &self.group, &[sea.uniform], [r.n / self.transform.lines, 1, sea.count]);
    }
}

/// shaders/mips.wgsl
pub struct MipsPass {
    first: Kernel,
    next: Kernel,
    groups: Vec<wgpu::BindGroup>,
}

impl MipsPass {
    fn new(device: &wgpu::Device, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let module = shaders.module(device, "mips");
        let slots = [SEA, Slot::Texture, Slot::Texture, Slot::Texture, Slot::Image, Slot::Image, Slot::Image];
        let first = Kernel::new(device, "sea/mips", &module, &slots, &[("FIRST", 1.0)]);
        let next = Kernel::new(device, "sea/mips", &module, &slots, &[("FIRST", 0.0)]);
        let groups = Self::groups(device, [&first, &next], r, sea);
        Self { first, next, groups }
    }

    fn groups(
        device: &wgpu::Device,
        [first, next]: [&Kernel; 2],
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
    ) -> Vec<wgpu::BindGroup> {
        (1..r.mips())
            .map(|level| {
                let (kernel, moments) = match level {
                    // The first level makes the moments from slopes; what is bound for them is not read.
                    1 => (first, view(&r.gradients, Some(0))),
                    _ => (next, view(&r.moments, Some(level - 2))),
                };
                let inputs = [view(&r.displacement, Some(level - 1)), view(&r.gradients, Some(level - 1)), moments];
                let outputs = [
                    view(&r.displacement, Some(level)),
                    view(&r.gradients, Some(level)),
                    view(&r.moments, Some(level - 1)),
                ];
                let views = inputs.iter().chain(&outputs).map(wgpu::BindingResource::TextureView);
                kernel.bind(device, &std::iter::once(sea.binding()).chain(views).collect::<Vec<_>>())
            })
            .collect()
    }

    /// Fills every level above 0, one dispatch each.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        for (level, group) in (1..).zip(&self.groups) {
            let kernel = if level == 1 { &self.first } else { &self.next };
            let groups = (r.n >> level).div_ceil(8);
            kernel.run(encoder, group, &[sea.uniform], [groups, groups, sea.count]);
        }
    }
}

/// shaders/foam.wgsl
pub struct FoamPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl FoamPass {
    fn new(
        device: &wgpu::Device,
        shaders: &Shaders,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> Self {
        let module = shaders.module(device, "foam");
        let slots = [SEA, FOAM, Slot::Texture, Slot::Texture, Slot::Sampler, Slot::Write, Slot::Image];
        let kernel = Kernel::new(device, "sea/foam", &module, &slots, &[]);
        let group = Self::group(device, &kernel, r, sea, foam);
        Self { kernel, group }
    }

    fn group(
        device: &wgpu::Device,
        kernel: &Kernel,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> wgpu::BindGroup {
        kernel.bind(
            device,
            &[
                sea.binding(),
                foam.binding(),
                wgpu::BindingResource::TextureView(&view(&r.displacement, None)),
                wgpu::BindingResource::TextureView(&view(&r.gradients, None)),
                wgpu::BindingResource::Sampler(&r.repeat),
                r.foam_history.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&r.foam, Some(0))),
            ],
        )
    }

    /// One step of all levels. Any sea's uniform will do: the chop is the same.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step, foam: u32) {
        self.kernel.run(encoder, &self.group, &[sea.uniform, foam], [r.foam_n / 8, r.foam_n / 8, FOAM_LEVELS as u32]);
    }
}
