//! The HDR picture and its depth.

/// Format of linear light.
pub const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Reverse-Z: near / distance.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Of what the mesh leaves for the light: the point; the sides of the pixel there and the slopes that the mesh carries (`MeshShown`).
pub const SHOWN_FORMATS: [wgpu::TextureFormat; 2] = [wgpu::TextureFormat::Rgba32Uint; 2];

/// What the passes of the picture draw into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Film {
    /// Coverage samples a pixel.
    pub samples: u32,
    /// Format of the light.
    pub format: wgpu::TextureFormat,
    /// What is done with the light besides drawing and presenting it.
    pub usage: wgpu::TextureUsages,
    /// The sea is lit once a pixel after its mesh was drawn, not while it is drawn.
    pub deferred: bool,
}

impl Film {
    /// The picture of a screen.
    pub fn screen(samples: u32) -> Self {
        Self { samples, format: HDR_FORMAT, usage: wgpu::TextureUsages::empty(), deferred: samples == 1 }
    }

    /// A picture whose light and depth are read back: one sample a pixel.
    pub fn layers() -> Self {
        Self { samples: 1, format: HDR_FORMAT, usage: wgpu::TextureUsages::COPY_SRC, deferred: true }
    }

    /// Light of single samples, for a reference: half floats would cut off the sun.
    pub const fn reference() -> Self {
        let format = wgpu::TextureFormat::Rgba32Float;
        Self { samples: 1, format, usage: wgpu::TextureUsages::COPY_SRC, deferred: false }
    }
}

/// Attachments of one size.
pub struct Targets {
    pub size: [u32; 2],
    /// One sample a pixel, to be presented.
    pub hdr: wgpu::TextureView,
    /// Several coverage samples a pixel, if there are any.
    samples: Option<wgpu::TextureView>,
    /// Near / distance, kept only on a film that is read back.
    pub depth: wgpu::TextureView,
    keeps_depth: bool,
    /// What the mesh shows, if the sea is lit afterwards.
    pub shown: Option<[wgpu::TextureView; 2]>,
}

impl Targets {
    pub fn new(device: &wgpu::Device, size: [u32; 2], film: Film) -> Self {
        let Film { samples, format: hdr, usage, deferred } = film;
        let texture = |label, format, sample_count, usage| {
            device
                .create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                    view_formats: &[],
                })
                .create_view(&wgpu::TextureViewDescriptor::default())
        };
        let none = wgpu::TextureUsages::empty();
        Self {
            size,
            hdr: texture("hdr", hdr, 1, wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC | usage),
            samples: (samples > 1).then(|| texture("hdr samples", hdr, samples, none)),
            depth: texture("depth", DEPTH_FORMAT, samples, usage),
            keeps_depth: !usage.is_empty(),
            shown: deferred
                .then(|| SHOWN_FORMATS.map(|format| texture("shown", format, 1, wgpu::TextureUsages::TEXTURE_BINDING))),
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
        let (view, resolve_target, store) = match &self.samples {
            Some(samples) => (samples, Some(&self.hdr), wgpu::StoreOp::Discard),
            None => (&self.hdr, None, wgpu::StoreOp::Store),
        };
        let load = if after_mesh { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(0.0) };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store },
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
