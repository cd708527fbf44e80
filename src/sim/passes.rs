//! The compute passes, in the order of the frame. A pass is a kernel, its bindings and its number of workgroups.

use super::maps::FOAM_LEVELS;
use super::resources::{MapKind, Resources, Straight, Waves, map, view};
use super::uniforms::{FoamUniform, STRUCTS, SeaUniform};
use crate::gpu::Gpu;
use crate::gpu::kit::{Kernel, Slot, UniformRing};
use crate::shaders::Shaders;
use crate::shaders::fft::{Transform, Way};
use std::ops::Range;
use std::sync::OnceLock;

const SEA: Slot = Slot::UniformAt(size_of::<SeaUniform>());
const FOAM: Slot = Slot::UniformAt(size_of::<FoamUniform>());

/// One evaluation of a sea: its uniform and what it goes over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Dynamic offset of the uniform.
    pub uniform: u32,
    /// Cascades.
    pub count: u32,
    /// Whether it is the sea that fades.
    pub fades: bool,
    /// First layer of its maps.
    pub first_layer: u32,
    /// Whether the column pass leaves its result in the intermediate buffer.
    pub keep_f32: bool,
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
        gpu: &Gpu,
        shaders: &Shaders,
        resources: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> Self {
        let shaders = &shaders.clone().with_structs(STRUCTS);
        Self {
            spectrum: SpectrumPass::new(gpu, shaders, resources, sea),
            rows: RowsPass::new(gpu, shaders, resources, sea),
            columns: ColumnsPass::new(gpu, shaders, resources, sea),
            mips: MipsPass::new(gpu, shaders, resources, sea),
            foam: FoamPass::new(gpu, shaders, resources, sea, foam),
        }
    }

    /// Compute dispatches of a frame at rest: waves, mips and foam.
    pub fn dispatches(&self) -> u32 {
        let halves =
            u32::from(self.rows.second.is_some()) + u32::from(matches!(self.columns, ColumnsPass::Straight(_)));
        3 + halves + self.mips.steps.len() as u32
    }

    /// Binds anew what belongs to a sea: its buffers are others.
    pub fn bind_waves(&mut self, gpu: &Gpu, r: &Resources, sea: &UniformRing<SeaUniform>) {
        self.spectrum.group = SpectrumPass::group(gpu, &self.spectrum.kernel, r, sea);
        self.rows.bind(gpu, r, sea);
    }

    /// Binds anew what reads and writes maps, and the intermediate buffer.
    pub fn bind_maps(
        &mut self,
        gpu: &Gpu,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) {
        self.rows.bind(gpu, r, sea);
        self.columns.bind(gpu, r, sea);
        self.mips.bind(gpu, r, sea);
        self.foam.group = FoamPass::group(gpu, &self.foam.kernel, r, sea, foam);
    }
}

/// shaders/waves/spectrum.wgsl
pub struct SpectrumPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl SpectrumPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let module = shaders.module(gpu, "spectrum");
        let kernel = Kernel::new(gpu, "sea/spectrum", (&module, "main"), &[SEA, Slot::Read(0), Slot::Write(0)], &[]);
        let group = Self::group(gpu, &kernel, r, sea);
        Self { kernel, group }
    }

    fn group(gpu: &Gpu, kernel: &Kernel, r: &Resources, sea: &UniformRing<SeaUniform>) -> wgpu::BindGroup {
        kernel.bind(gpu, &[sea.binding(), r.sea.radial.as_entire_binding(), r.sea.h0.as_entire_binding()])
    }

    /// Draws h0 of all cascades.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        self.kernel.run(encoder, &self.group, &[sea.uniform], [r.n / 64, r.n, sea.count]);
    }
}

/// One half of a transform, or all of it.
pub struct Half {
    kernel: Kernel,
    size: [u32; 3],
    has_uniform: bool,
}

impl Half {
    fn run(&self, encoder: &mut wgpu::CommandEncoder, group: &wgpu::BindGroup, sea: Step) {
        let [x, y, layers] = self.size;
        let offsets: &[u32] = if self.has_uniform { &[sea.uniform] } else { &[] };
        self.kernel.run(encoder, group, offsets, [x, y, layers * sea.count]);
    }
}

/// shaders/waves/rows.wgsl, or rows_first.wgsl and lines_second.wgsl, or only rows_first.wgsl where the rest is merged with the columns.
pub struct RowsPass {
    first: Half,
    second: Option<Half>,
    /// Of the sea, and of the one that fades.
    groups: [Option<wgpu::BindGroup>; 2],
    second_group: Option<wgpu::BindGroup>,
}

impl RowsPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let t = Transform::new(r.n, r.way);
        let slots = [SEA, Slot::Read(0), Slot::Read(0), Slot::Read(0), Slot::Write(0)];
        let first = if r.way == Way::Exchanged {
            let module = shaders.module(gpu, "rows");
            let kernel = Kernel::new(gpu, "sea/rows", (&module, "main"), &slots, &t.exchanged_constants());
            Half { kernel, size: [r.n / t.lines, 1, 1], has_uniform: true }
        } else {
            let module = shaders.straight(gpu, "rows_first", t);
            let kernel = Kernel::new(gpu, "sea/rows/first", (&module, "main"), &slots, &t.straight_constants());
            Half { kernel, size: [t.x.second / 8, r.n / 16 + 1, 1], has_uniform: true }
        };
        let second = (r.way == Way::Straight).then(|| {
            let (module, slots) = (shaders.straight(gpu, "lines_second", t), [Slot::Read(0), Slot::Write(0)]);
            let kernel = Kernel::new(gpu, "sea/rows/second", (&module, "main"), &slots, &t.straight_constants());
            Half { kernel, size: [t.x.first / 8, r.n / 8, 2], has_uniform: false }
        });
        let mut pass = Self { first, second, groups: [None, None], second_group: None };
        pass.bind(gpu, r, sea);
        pass
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, sea: &UniformRing<SeaUniform>) {
        // Halves are read from there by whatever comes second.
        let to = r.straight.as_ref().filter(|_| r.way == Way::Straight).map_or(&r.lines, |s| &s.halves);
        let group = |waves: &Waves| {
            let buffers = [&waves.h0, &waves.wave, &r.twiddle, to].map(wgpu::Buffer::as_entire_binding);
            let bound: Vec<_> = std::iter::once(sea.binding()).chain(buffers).collect();
            self.first.kernel.bind(gpu, &bound)
        };
        self.groups = [Some(group(&r.sea)), r.other.as_ref().map(group)];
        self.second_group =
            self.second.as_ref().zip(r.straight.as_ref()).map(|(second, s)| {
                second.kernel.bind(gpu, &[s.halves.as_entire_binding(), r.lines.as_entire_binding()])
            });
    }

    /// Evolves and transforms all cascades.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, sea: Step) {
        let Some(group) = &self.groups[usize::from(sea.fades)] else { return };
        self.first.run(encoder, group, sea);
        if let (Some(second), Some(group)) = (&self.second, &self.second_group) {
            second.run(encoder, group, sea);
        }
    }
}

/// shaders/waves/columns.wgsl, or columns_first.wgsl and columns_second.wgsl, or middle.wgsl and columns_last.wgsl.
pub enum ColumnsPass {
    /// In one dispatch.
    Exchanged(Half, wgpu::BindGroup),
    /// In two, and a copy.
    Straight(Box<StraightColumns>),
}

/// The halves of the transform along z, each with what it is bound to.
pub struct StraightColumns {
    first: (Half, wgpu::BindGroup),
    second: Half,
    second_group: wgpu::BindGroup,
    /// With a copy in f32, compiled when it is first wanted: a window never does.
    kept: OnceLock<Half>,
    code: SecondCode,
}

/// What second halves of columns are compiled from.
struct SecondCode {
    gpu: Gpu,
    module: wgpu::ShaderModule,
    transform: Transform,
}

impl SecondCode {
    fn compile(&self, keep_f32: bool) -> Half {
        let Transform { n, z, .. } = self.transform;
        let keep = [("KEEP_F32", f64::from(u8::from(keep_f32)))];
        let constants = [self.transform.straight_constants(), keep].concat();
        let slots = [Slot::Read(0), Slot::Write(0), Slot::Write(0)];
        let kernel = Kernel::new(&self.gpu, "sea/columns/second", (&self.module, "main"), &slots, &constants);
        Half { kernel, size: [n / 64, z.first, 2], has_uniform: false }
    }
}

impl StraightColumns {
    fn second(&self, keep_f32: bool) -> &Half {
        if keep_f32 { self.kept.get_or_init(|| self.code.compile(true)) } else { &self.second }
    }
}

impl ColumnsPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let t = Transform::new(r.n, r.way);
        let Some(straight) = &r.straight else {
            let module = shaders.module(gpu, "columns");
            let slots = [SEA, Slot::Read(0), Slot::Write(0), Slot::ImageArray(r.format.texture())];
            let kernel = Kernel::new(gpu, "sea/columns", (&module, "main"), &slots, &t.exchanged_constants());
            let group = Self::group(gpu, &kernel, r, sea);
            return Self::Exchanged(Half { kernel, size: [r.n / t.lines, 1, 1], has_uniform: true }, group);
        };
        let slots = [Slot::Read(0), Slot::Read(0), Slot::Write(0)];
        let ([first, second], size) = match r.way {
            Way::Merged => (["middle", "columns_last"], [t.x.first / 8, t.z.second / 8, 2]),
            _ => (["columns_first", "columns_second"], [r.n / 64, t.z.second, 2]),
        };
        let module = shaders.straight(gpu, first, t);
        let kernel = Kernel::new(gpu, "sea/columns/first", (&module, "main"), &slots, &t.straight_constants());
        let first_group = Self::first_group(gpu, &kernel, r, straight);
        let first = Half { kernel, size, has_uniform: false };
        let module = shaders.straight(gpu, second, t);
        let code = SecondCode { gpu: gpu.clone(), module, transform: t };
        let second = code.compile(false);
        let second_group = Self::second_group(gpu, &second.kernel, r, straight);
        let first = (first, first_group);
        Self::Straight(Box::new(StraightColumns { first, second, second_group, kept: OnceLock::new(), code }))
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, sea: &UniformRing<SeaUniform>) {
        match (self, &r.straight) {
            (Self::Straight(columns), Some(straight)) => {
                columns.first.1 = Self::first_group(gpu, &columns.first.0.kernel, r, straight);
                columns.second_group = Self::second_group(gpu, &columns.second.kernel, r, straight);
            }
            (Self::Exchanged(all, group), _) => *group = Self::group(gpu, &all.kernel, r, sea),
            (Self::Straight(_), None) => {}
        }
    }

    fn first_group(gpu: &Gpu, kernel: &Kernel, r: &Resources, s: &Straight) -> wgpu::BindGroup {
        kernel.bind(gpu, &[&r.twiddle, &r.lines, &s.halves].map(wgpu::Buffer::as_entire_binding))
    }

    fn second_group(gpu: &Gpu, kernel: &Kernel, r: &Resources, s: &Straight) -> wgpu::BindGroup {
        kernel.bind(gpu, &[&s.halves, &s.maps, &r.lines].map(wgpu::Buffer::as_entire_binding))
    }

    fn group(gpu: &Gpu, kernel: &Kernel, r: &Resources, sea: &UniformRing<SeaUniform>) -> wgpu::BindGroup {
        kernel.bind(
            gpu,
            &[
                sea.binding(),
                r.twiddle.as_entire_binding(),
                r.lines.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&r.maps, Some(0))),
            ],
        )
    }

    /// Transforms and unpacks all cascades.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        match (self, &r.straight) {
            (Self::Straight(columns), Some(straight)) => {
                columns.first.0.run(encoder, &columns.first.1, sea);
                columns.second(sea.keep_f32).run(encoder, &columns.second_group, sea);
                let bytes = u64::from(r.format.bytes()) * u64::from(r.n * r.n * sea.count);
                for (kind, at) in [(MapKind::Displacement, 0), (MapKind::Gradients, bytes)] {
                    let first = r.layers(kind).start + sea.first_layer;
                    copy_layers(encoder, (&straight.maps, at), &r.maps, first..first + sea.count);
                }
            }
            (Self::Exchanged(all, group), _) => all.run(encoder, group, sea),
            (Self::Straight(_), None) => {}
        }
    }
}

/// Copies layers from a place in a buffer to level 0 of the maps.
fn copy_layers(
    encoder: &mut wgpu::CommandEncoder,
    (buffer, offset): (&wgpu::Buffer, u64),
    texture: &wgpu::Texture,
    layers: Range<u32>,
) {
    let side = texture.width();
    let texel = texture.format().block_copy_size(None).unwrap_or(8);
    let rows = (Some(texel * side), Some(side));
    encoder.copy_buffer_to_texture(
        wgpu::TexelCopyBufferInfo {
            buffer,
            layout: wgpu::TexelCopyBufferLayout { offset, bytes_per_row: rows.0, rows_per_image: rows.1 },
        },
        wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x: 0, y: 0, z: layers.start },
            ..texture.as_image_copy()
        },
        wgpu::Extent3d { width: side, height: side, depth_or_array_layers: layers.end - layers.start },
    );
}

/// shaders/waves/mips.wgsl with mips_chain.wgsl, or with mips_level.wgsl where barriers are dear.
pub struct MipsPass {
    steps: Vec<MipsStep>,
    /// Stands for levels that a chain does not reach.
    nothing: wgpu::TextureView,
}

/// One dispatch.
struct MipsStep {
    kernel: Kernel,
    group: wgpu::BindGroup,
    /// Level that it starts from, and levels that it makes.
    above: u32,
    levels: u32,
}

/// Levels of a chain: base limits allow so many storage textures.
const CHAIN: u32 = 4;

impl MipsPass {
    fn new(gpu: &Gpu, shaders: &Shaders, r: &Resources, sea: &UniformRing<SeaUniform>) -> Self {
        let chained = r.straight.is_none();
        let module = shaders.module(gpu, if chained { "mips_chain" } else { "mips_level" });
        let images = if chained { CHAIN } else { 1 };
        let slots: Vec<Slot> = [SEA, Slot::TextureArray]
            .into_iter()
            .chain((0..images).map(|_| Slot::ImageArray(r.format.texture())))
            .collect();
        let nothing = view(&map(gpu, "nothing", 1, 1, 1, r.format), None);
        let steps = (0..r.mips() - 1).step_by(images as usize).map(|above| {
            let levels = images.min(r.mips() - 1 - above);
            let mut constants = vec![("FIRST", f64::from(u32::from(above == 0)))];
            if chained {
                constants.push(("LEVELS", f64::from(levels)));
            }
            let kernel = Kernel::new(gpu, "sea/mips", (&module, "main"), &slots, &constants);
            let group = Self::group(gpu, &kernel, r, sea, (above, levels, images), &nothing);
            MipsStep { kernel, group, above, levels }
        });
        Self { steps: steps.collect(), nothing }
    }

    fn group(
        gpu: &Gpu,
        kernel: &Kernel,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        (above, levels, images): (u32, u32, u32),
        nothing: &wgpu::TextureView,
    ) -> wgpu::BindGroup {
        let views: Vec<_> = (0..=levels).map(|i| view(&r.maps, Some(above + i))).collect();
        let spare = (levels..images).map(|_| nothing);
        let views = views.iter().chain(spare).map(wgpu::BindingResource::TextureView);
        kernel.bind(gpu, &std::iter::once(sea.binding()).chain(views).collect::<Vec<_>>())
    }

    fn bind(&mut self, gpu: &Gpu, r: &Resources, sea: &UniformRing<SeaUniform>) {
        let images = if r.straight.is_none() { CHAIN } else { 1 };
        for step in &mut self.steps {
            let levels = (step.above, step.levels, images);
            step.group = Self::group(gpu, &step.kernel, r, sea, levels, &self.nothing);
        }
    }

    /// Fills every level above 0.
    pub fn run(&self, encoder: &mut wgpu::CommandEncoder, r: &Resources, sea: Step) {
        for step in &self.steps {
            let groups = (r.n >> (step.above + 1)).div_ceil(8);
            step.kernel.run(encoder, &step.group, &[sea.uniform], [groups, groups, sea.count]);
        }
    }
}

/// shaders/foam/foam.wgsl
pub struct FoamPass {
    kernel: Kernel,
    group: wgpu::BindGroup,
}

impl FoamPass {
    fn new(
        gpu: &Gpu,
        shaders: &Shaders,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> Self {
        let module = shaders.module(gpu, "foam/foam");
        let slots = [
            SEA,
            FOAM,
            Slot::TextureArray,
            Slot::TextureArray,
            Slot::Sampler,
            Slot::Write(0),
            Slot::ImageArray(r.format.texture()),
        ];
        let kernel = Kernel::new(gpu, "sea/foam", (&module, "main"), &slots, &[]);
        let group = Self::group(gpu, &kernel, r, sea, foam);
        Self { kernel, group }
    }

    fn group(
        gpu: &Gpu,
        kernel: &Kernel,
        r: &Resources,
        sea: &UniformRing<SeaUniform>,
        foam: &UniformRing<FoamUniform>,
    ) -> wgpu::BindGroup {
        kernel.bind(
            gpu,
            &[
                sea.binding(),
                foam.binding(),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Displacement)),
                wgpu::BindingResource::TextureView(&r.map_view(MapKind::Gradients)),
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
