//! Small helpers of the passes: uniforms, bind groups, pipelines of the HDR pass.

use super::frame::FrameUniform;
use super::sky::{LightBuffer, Sky, SkyUniform};
use super::targets::{DEPTH_FORMAT, Film};
use super::water::material::MaterialUniform;
use super::water::noise::NoiseTexture;
use crate::gpu::map_format::MapFormat;
use bytemuck::Pod;
use std::marker::PhantomData;
use std::num::NonZeroU64;

/// A uniform buffer of one struct.
pub struct Uniform<T> {
    pub buffer: wgpu::Buffer,
    kind: PhantomData<T>,
}

impl<T: Pod> Uniform<T> {
    pub fn new(device: &wgpu::Device, label: &str) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: size_of::<T>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, kind: PhantomData }
    }

    pub fn write(&self, queue: &wgpu::Queue, value: &T) {
        queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(value));
    }
}

/// What stands at a binding.
#[derive(Clone, Copy)]
pub enum Slot {
    Uniform(usize),
    Read(usize),
    Write(usize),
    Texture,
    /// A texture of words, which are not sampled.
    Words,
    Array,
    /// A texture that is written.
    Image(MapFormat),
    Sampler,
}

impl Slot {
    fn binding_type(self) -> wgpu::BindingType {
        let buffer = |ty, size| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: NonZeroU64::new(size as u64),
        };
        let texture = |view_dimension| wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension,
            multisampled: false,
        };
        match self {
            Self::Uniform(size) => buffer(wgpu::BufferBindingType::Uniform, size),
            Self::Read(size) => buffer(wgpu::BufferBindingType::Storage { read_only: true }, size),
            Self::Write(size) => buffer(wgpu::BufferBindingType::Storage { read_only: false }, size),
            Self::Texture => texture(wgpu::TextureViewDimension::D2),
            Self::Words => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Uint,
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            Self::Array => texture(wgpu::TextureViewDimension::D2Array),
            Self::Image(maps) => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: maps.texture(),
                view_dimension: wgpu::TextureViewDimension::D2,
            },
            Self::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// A layout of these slots, in order from binding 0.
pub fn layout(
    device: &wgpu::Device,
    label: &str,
    visibility: wgpu::ShaderStages,
    slots: &[Slot],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(slots)
        .map(|(binding, slot)| wgpu::BindGroupLayoutEntry { binding, visibility, ty: slot.binding_type(), count: None })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// Resources for a layout, in order from binding 0.
pub fn group(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

/// The bind group that every pass of the HDR picture shares.
pub struct SceneGroup {
    pub layout: wgpu::BindGroupLayout,
    pub group: wgpu::BindGroup,
    /// What the passes draw into.
    pub film: Film,
}

impl SceneGroup {
    pub fn new(
        device: &wgpu::Device,
        frame: &Uniform<FrameUniform>,
        material: &Uniform<MaterialUniform>,
        sky: &Sky,
        noise: &NoiseTexture,
        film: Film,
    ) -> Self {
        let slots = [
            Slot::Uniform(size_of::<FrameUniform>()),
            Slot::Uniform(size_of::<SkyUniform>()),
            Slot::Uniform(size_of::<LightBuffer>()),
            Slot::Texture,
            Slot::Texture,
            Slot::Sampler,
            Slot::Texture,
            Slot::Sampler,
            Slot::Texture,
            Slot::Uniform(size_of::<MaterialUniform>()),
        ];
        let layout = layout(device, "scene", wgpu::ShaderStages::VERTEX_FRAGMENT, &slots);
        let group = group(
            device,
            "scene",
            &layout,
            &[
                frame.buffer.as_entire_binding(),
                sky.uniform.buffer.as_entire_binding(),
                sky.light.as_entire_binding(),
                wgpu::BindingResource::TextureView(&sky.view),
                wgpu::BindingResource::TextureView(&sky.environment),
                wgpu::BindingResource::Sampler(&sky.sampler),
                wgpu::BindingResource::TextureView(&noise.view),
                wgpu::BindingResource::Sampler(&noise.sampler),
                wgpu::BindingResource::TextureView(&sky.transmittance),
                material.buffer.as_entire_binding(),
            ],
        );
        Self { layout, group, film }
    }
}

/// What a pipeline runs.
pub struct Program<'a> {
    /// Where its entry points are.
    pub module: &'a wgpu::ShaderModule,
    /// Names of the vertex and the fragment shader.
    pub entries: [&'a str; 2],
    /// Overridable constants of the module.
    pub constants: &'a [(&'a str, f64)],
}

impl<'a> Program<'a> {
    /// Entry points `vertex` and `fragment`, constants as the module has them.
    pub fn new(module: &'a wgpu::ShaderModule) -> Self {
        Self { module, entries: ["vertex", "fragment"], constants: &[] }
    }
}

/// The pipelines of a pass, one for each set of parts that was needed so far: what is not there is not in it, because a
/// software GPU pays for both sides of a branch, and any GPU for its registers.
pub struct Variants<P>(Vec<(P, wgpu::RenderPipeline)>);

impl<P> Default for Variants<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P: Copy + PartialEq> Variants<P> {
    /// Turns to the pipeline of these parts, and makes it if there is none yet.
    pub fn choose(&mut self, parts: P, make: impl FnOnce(P) -> wgpu::RenderPipeline) {
        // The last is the one to draw with.
        match self.0.iter().position(|(made, _)| *made == parts) {
            Some(at) => {
                let last = self.0.len() - 1;
                self.0.swap(at, last);
            }
            None => self.0.push((parts, make(parts))),
        }
    }

    /// The pipeline to draw with.
    pub fn chosen(&self) -> Option<&wgpu::RenderPipeline> {
        self.0.last().map(|(_, pipeline)| pipeline)
    }
}

/// A constant of a module that says whether a part is there.
pub fn part(name: &str, is_there: bool) -> (&str, f64) {
    (name, f64::from(u8::from(is_there)))
}

/// How a pipeline of the picture meets its attachments.
pub struct Onto<'a> {
    pub formats: &'a [wgpu::TextureFormat],
    /// Coverage samples a pixel.
    pub samples: u32,
    /// Reverse-Z.
    pub depth: wgpu::CompareFunction,
    pub depth_write: bool,
}

impl<'a> Onto<'a> {
    /// The light of a film: what is nearest is seen.
    pub fn film(film: &'a Film, depth_write: bool) -> Self {
        let formats = std::slice::from_ref(&film.format);
        Self { formats, samples: film.samples, depth: wgpu::CompareFunction::GreaterEqual, depth_write }
    }
}

/// A pipeline of the picture.
pub fn hdr_pipeline(
    device: &wgpu::Device,
    label: &str,
    program: &Program<'_>,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    onto: &Onto<'_>,
) -> wgpu::RenderPipeline {
    let Program { module, entries: [vertex, fragment], constants } = *program;
    let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: layouts,
        immediate_size: 0,
    });
    let targets: Vec<_> = onto.formats.iter().map(|&format| Some(format.into())).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: compilation_options.clone(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(onto.depth_write),
            depth_compare: Some(onto.depth),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: onto.samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options,
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pipeline that draws one triangle over a target of `format`: entry points `vertex` and `fragment`, no depth.
pub fn screen_pipeline(
    device: &wgpu::Device,
    label: &str,
    module: &wgpu::ShaderModule,
    layout: &wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
    constants: &[(&str, f64)],
) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
