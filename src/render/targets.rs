//! What a picture is drawn into: the G-buffer of the water, linear light and depth.

use crate::gpu::Gpu;
use crate::gpu::kit::{Attachments, Depth};

/// Format of linear light.
pub const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of the depth, which is reverse-Z: near / distance.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Formats of the G-buffer (WGSL `GBuffer`).
pub const G_BUFFER_FORMATS: [wgpu::TextureFormat; 2] = [wgpu::TextureFormat::Rgba32Uint; 2];

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
    /// The light is that of single samples of a reference, in single precision: half floats would cut off the sun.
    Reference,
}

impl Film {
    /// Format of the linear light.
    pub const fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Screen | Self::Layers => HDR_FORMAT,
            Self::Reference => wgpu::TextureFormat::Rgba32Float,
        }
    }
}

/// The attachments of a pipeline that draws into a picture whose light has this format.
pub fn attachments(format: &wgpu::TextureFormat, depth: Depth) -> Attachments<'_> {
    Attachments { formats: std::slice::from_ref(format), depth: Some(depth) }
}

/// Attachments of one size.
pub struct Targets {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Linear light.
    pub hdr: wgpu::TextureView,
    /// Near / distance, kept only on a film that is read back.
    pub depth: wgpu::TextureView,
    keeps_depth: bool,
    /// The G-buffer of the water.
    pub g_buffer: [wgpu::TextureView; 2],
}

impl Targets {
    /// Attachments of `size` pixels for a film.
    pub fn new(gpu: &Gpu, [width, height]: [u32; 2], film: Film) -> Self {
        use wgpu::TextureUsages as Usage;
        let texture = |label, format, usage| {
            let texture = gpu.texture(label, [width, height, 1], 1, format, Usage::RENDER_ATTACHMENT | usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let keeps_depth = film != Film::Screen;
        let depth_usage = if keeps_depth { Usage::COPY_SRC } else { Usage::empty() };
        Self {
            size: [width, height],
            hdr: texture("hdr", film.format(), Usage::TEXTURE_BINDING | Usage::COPY_SRC),
            depth: texture("depth", DEPTH_FORMAT, depth_usage),
            keeps_depth,
            g_buffer: G_BUFFER_FORMATS.map(|format| texture("g-buffer", format, Usage::TEXTURE_BINDING)),
        }
    }

    /// Opens the pass that draws the mesh of the water into the G-buffer and the depth.
    pub fn begin_mesh<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        let attachments = self.g_buffer.each_ref().map(|view| Some(attachment(view, wgpu::Color::TRANSPARENT)));
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("mesh"),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(self.depth(wgpu::LoadOp::Clear(0.0), true)),
            ..Default::default()
        })
    }

    /// Opens the pass of the picture, whose depth is that of the mesh or, without it, infinitely far.
    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, after_mesh: bool) -> wgpu::RenderPass<'a> {
        let load = if after_mesh { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(0.0) };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(attachment(&self.hdr, wgpu::Color::BLACK))],
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

/// A colour attachment that is cleared and kept.
fn attachment(view: &wgpu::TextureView, clear: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
    let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store };
    wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }
}
