//! The HDR picture and its depth.

use crate::gpu::kit::{Attachments, Depth};

use crate::gpu::Gpu;

/// Format of linear light.
pub const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Reverse-Z: near / distance.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Of what the mesh leaves for the light: the point; the sides of the pixel there and the slopes that the mesh carries (`MeshShown`).
pub const SHOWN_FORMATS: [wgpu::TextureFormat; 2] = [wgpu::TextureFormat::Rgba32Uint; 2];

/// The depth test of what is drawn into the picture: the nearest fragment is seen.
pub const NEAREST: Depth = Depth { format: DEPTH_FORMAT, compare: wgpu::CompareFunction::GreaterEqual, write: true };
/// The depth test of what stands behind everything that was drawn.
pub const BEHIND: Depth = Depth { write: false, ..NEAREST };

/// What becomes of a picture's light and depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Film {
    /// They are only presented.
    Screen,
    /// They can also be read back.
    Layers,
    /// Light of the single samples of a reference, in single precision: half floats would cut off the sun.
    Reference,
    /// The mean light of a reference, written to be presented.
    Mean,
}

impl Film {
    /// Format of the linear light.
    pub const fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Reference => wgpu::TextureFormat::Rgba32Float,
            _ => HDR_FORMAT,
        }
    }

    /// Uses of light and depth beyond drawing and presenting.
    const fn usage(self) -> wgpu::TextureUsages {
        match self {
            Self::Screen => wgpu::TextureUsages::empty(),
            Self::Layers | Self::Reference => wgpu::TextureUsages::COPY_SRC,
            Self::Mean => wgpu::TextureUsages::COPY_DST,
        }
    }

    /// Whether the water is lit once a pixel after its mesh was drawn. A reference lights every fragment of the mesh, because a
    /// sample needs the exact point and slopes, which the deferred pass packs.
    pub const fn is_deferred(self) -> bool {
        matches!(self, Self::Screen | Self::Layers)
    }
}

/// The attachments of a pipeline that draws into a picture whose light has this format.
pub fn attachments(format: &wgpu::TextureFormat, depth: Depth) -> Attachments<'_> {
    Attachments { formats: std::slice::from_ref(format), depth: Some(depth) }
}

/// Attachments of one size.
pub struct Targets {
    pub size: [u32; 2],
    /// Linear light, to be presented.
    pub hdr: wgpu::TextureView,
    /// Near / distance, kept only on a film that is read back.
    pub depth: wgpu::TextureView,
    keeps_depth: bool,
    /// What the mesh shows, if the sea is lit afterwards.
    pub shown: Option<[wgpu::TextureView; 2]>,
}

impl Targets {
    pub fn new(gpu: &Gpu, size: [u32; 2], film: Film) -> Self {
        let usage = film.usage();
        let texture = |label, format, usage| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | usage;
            let texture = gpu.texture(label, [size[0], size[1], 1], 1, format, usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let sampled = wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            size,
            hdr: texture("hdr", film.format(), sampled | wgpu::TextureUsages::COPY_SRC | usage),
            depth: texture("depth", DEPTH_FORMAT, usage),
            keeps_depth: !usage.is_empty(),
            shown: film.is_deferred().then(|| SHOWN_FORMATS.map(|format| texture("shown", format, sampled))),
        }
    }

    /// Opens the pass that draws the mesh of the sea, to be lit in that of [`Self::begin`].
    pub fn begin_mesh<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> Option<wgpu::RenderPass<'a>> {
        let [point, slopes] = self.shown.as_ref()?;
        let attachment = |view| {
            let ops =
                wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store };
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
        };
        Some(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("mesh"),
            color_attachments: &[attachment(point), attachment(slopes)],
            depth_stencil_attachment: Some(self.depth(wgpu::LoadOp::Clear(0.0), true)),
            ..Default::default()
        }))
    }

    /// Opens the pass of the picture, which finds the depth that the mesh left, or none.
    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, after_mesh: bool) -> wgpu::RenderPass<'a> {
        let load = if after_mesh { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(0.0) };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.hdr,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(self.depth(load, self.keeps_depth)),
            ..Default::default()
        })
    }

    fn depth(&self, load: wgpu::LoadOp<f32>, keep: bool) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let store = if keep { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
        wgpu::RenderPassDepthStencilAttachment {
            view: &self.depth,
            depth_ops: Some(wgpu::Operations { load, store }),
            stencil_ops: None,
        }
    }
}
