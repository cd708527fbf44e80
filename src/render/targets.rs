//! Render targets of a picture: G-buffer of the water, linear light and depth.

use crate::gpu::Gpu;
use crate::gpu::kit::{AttachmentFormats, DepthState};
use crate::gpu::timer::Timer;

/// Format of textures that hold linear light (RGB in half floats), except for the samples of reference pictures.
pub const HDR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of the depth texture. Depth is reverse-Z: near-plane distance divided by distance along the viewing
/// direction, 0 at infinity.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Formats of the three textures of the G-buffer (WGSL `GBuffer`): undisplaced position, slope and stretch, shear and
/// pixel side of the water in each pixel.
pub const G_BUFFER_FORMATS: [wgpu::TextureFormat; 3] =
    [wgpu::TextureFormat::Rg32Float, wgpu::TextureFormat::Rgba16Float, wgpu::TextureFormat::Rg16Float];
/// Undisplaced position (x and z), m, that the G-buffer holds where there is no water: farther away than any water, so
/// that a pixel at the edge of the water finds that its neighbour shows something else.
const NO_WATER_M: f64 = 1e9;

/// Depth test of water mesh and floating objects: a fragment nearer than those before is drawn and writes its depth.
pub const DEPTH_TEST_OPAQUE: DepthState =
    DepthState { format: DEPTH_FORMAT, compare: wgpu::CompareFunction::GreaterEqual, writes_depth: true };
/// Depth test of the sky (background): visible where nothing nearer was drawn; writes no depth.
pub const DEPTH_TEST_BACKGROUND: DepthState = DepthState { writes_depth: false, ..DEPTH_TEST_OPAQUE };

/// Drops and ropes hide what is behind them by their opacity. The alpha of the picture, from which the tone pass finds edges,
/// stays that of what is behind.
pub const BLEND_OVER: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent::OVER,
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    },
};

/// Use that is made of a picture; decides the precision of its linear light and whether its depth is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// The picture is shown; its depth is discarded after the frame.
    Screen,
    /// The picture is shown, and its depth is kept, so that light and depth can be read back to the CPU.
    ReadBack,
    /// The picture holds the point samples whose mean is a reference picture. Its linear light is in single precision,
    /// because half floats would clip the sun.
    Reference,
}

impl OutputKind {
    /// Format of the texture that holds the picture's linear light: single precision for a reference, else half.
    pub const fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Screen | Self::ReadBack => HDR_FORMAT,
            Self::Reference => wgpu::TextureFormat::Rgba32Float,
        }
    }
}

/// Attachments of a render pipeline that draws into the picture: a colour target of `format` for the linear light, and
/// the depth texture with the depth test `depth`.
pub fn attachments(format: &wgpu::TextureFormat, depth: DepthState) -> AttachmentFormats<'_> {
    AttachmentFormats { formats: std::slice::from_ref(format), depth: Some(depth), blend: None }
}

/// Textures that a picture of one size is drawn into: linear light, depth and G-buffer.
pub struct Targets {
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
    /// Linear light of the picture (HDR), before exposure and tone curve.
    pub hdr: wgpu::TextureView,
    /// Reverse-Z depth: near-plane distance divided by distance along the viewing direction. The depth of floating
    /// objects is discarded if the picture is for [`OutputKind::Screen`].
    pub depth: wgpu::TextureView,
    keeps_depth: bool,
    /// G-buffer (WGSL `GBuffer`) of the water in each pixel, in [`G_BUFFER_FORMATS`].
    pub g_buffer: [wgpu::TextureView; 3],
}

impl Targets {
    /// Creates render targets of `width` x `height` pixels; `output` decides precision and whether the depth is kept.
    pub fn new(gpu: &Gpu, [width, height]: [u32; 2], output: OutputKind) -> Self {
        use wgpu::TextureUsages as Usage;
        let texture = |label, format, usage| {
            let texture = gpu.texture(label, [width, height, 1], 1, format, Usage::RENDER_ATTACHMENT | usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let keeps_depth = output != OutputKind::Screen;
        let depth_usage = if keeps_depth { Usage::COPY_SRC } else { Usage::empty() };
        Self {
            size: [width, height],
            hdr: texture("hdr", output.format(), Usage::TEXTURE_BINDING | Usage::COPY_SRC),
            depth: texture("depth", DEPTH_FORMAT, Usage::TEXTURE_BINDING | depth_usage),
            keeps_depth,
            g_buffer: G_BUFFER_FORMATS.map(|format| texture("g-buffer", format, Usage::TEXTURE_BINDING)),
        }
    }

    /// Frees the memory of the textures, which a later picture does not use. Without this, a browser keeps them until it
    /// collects its garbage, and a phone runs out of memory while the height of the picture follows a finger.
    pub fn destroy(&self) {
        for view in self.g_buffer.iter().chain([&self.hdr, &self.depth]) {
            view.texture().destroy();
        }
    }

    /// Begins the render pass that draws the water mesh into the G-buffer and the depth texture; clears both first.
    pub fn begin_mesh<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, timer: &Timer) -> wgpu::RenderPass<'a> {
        let far = wgpu::Color { r: NO_WATER_M, g: NO_WATER_M, b: 0.0, a: 0.0 };
        let [undisplaced, slope_and_stretch, shear_and_side] = &self.g_buffer;
        let attachments = [
            (undisplaced, far),
            (slope_and_stretch, wgpu::Color::TRANSPARENT),
            (shear_and_side, wgpu::Color::TRANSPARENT),
        ]
        .map(|(view, clear)| Some(cleared_attachment(view, clear)));
        let depth = self.depth_attachment(wgpu::LoadOp::Clear(0.0), true);
        begin_pass(encoder, ("mesh", timer.render_pass("mesh")), &attachments, Some(depth))
    }

    /// Begins the render pass that draws sky and water into `hdr`, cleared to black, after [`Self::begin_mesh`]. It
    /// tests against the depth of the mesh but cannot write depth, so that its shaders can read the depth texture.
    pub fn begin_light<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, timer: &Timer) -> wgpu::RenderPass<'a> {
        let depth = wgpu::RenderPassDepthStencilAttachment { view: &self.depth, depth_ops: None, stencil_ops: None };
        let light = cleared_attachment(&self.hdr, wgpu::Color::BLACK);
        begin_pass(encoder, ("light", timer.render_pass("light")), &[Some(light)], Some(depth))
    }

    /// Begins the render pass that draws drops over everything else. It cannot write depth, so that shaders can read it.
    pub fn begin_drops<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, timer: &Timer) -> wgpu::RenderPass<'a> {
        let depth = wgpu::RenderPassDepthStencilAttachment { view: &self.depth, depth_ops: None, stencil_ops: None };
        let light = colour_attachment(&self.hdr, wgpu::LoadOp::Load);
        begin_pass(encoder, ("drops", timer.render_pass("drops")), &[Some(light)], Some(depth))
    }

    /// Begins the render pass that draws floating objects over the light and depth of sky and water. `needs_depth` tells
    /// that a later pass reads their depth.
    pub fn begin_hulls<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        timer: &Timer,
        needs_depth: bool,
    ) -> wgpu::RenderPass<'a> {
        let light = colour_attachment(&self.hdr, wgpu::LoadOp::Load);
        let depth = self.depth_attachment(wgpu::LoadOp::Load, self.keeps_depth || needs_depth);
        begin_pass(encoder, ("hulls", timer.render_pass("hulls")), &[Some(light)], Some(depth))
    }

    /// Begins a render pass that draws into `hdr` without a mesh drawn before; clears it to black, and the depth to
    /// infinity. The pass writes `timestamps`, if given.
    pub fn begin_alone<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'a> {
        let depth = self.depth_attachment(wgpu::LoadOp::Clear(0.0), self.keeps_depth);
        let light = cleared_attachment(&self.hdr, wgpu::Color::BLACK);
        begin_pass(encoder, ("picture", timestamps), &[Some(light)], Some(depth))
    }

    fn depth_attachment(&self, load: wgpu::LoadOp<f32>, keep: bool) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let store = if keep { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
        wgpu::RenderPassDepthStencilAttachment {
            view: &self.depth,
            depth_ops: Some(wgpu::Operations { load, store }),
            stencil_ops: None,
        }
    }
}

/// A colour attachment of `view` that is cleared to `clear` at the start of the pass and stored at its end.
pub fn cleared_attachment(view: &wgpu::TextureView, clear: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
    colour_attachment(view, wgpu::LoadOp::Clear(clear))
}

/// A colour attachment of `view` whose contents at the start of the pass are given by `load`, and stored at its end.
fn colour_attachment(view: &wgpu::TextureView, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }
}

/// Begins a render pass with the given attachments. `label` is its name in debuggers; it writes `timestamps`, if given.
pub fn begin_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    (label, timestamps): (&str, Option<wgpu::RenderPassTimestampWrites<'_>>),
    colours: &[Option<wgpu::RenderPassColorAttachment<'_>>],
    depth: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: colours,
        depth_stencil_attachment: depth,
        timestamp_writes: timestamps,
        ..Default::default()
    })
}
