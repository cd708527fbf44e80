//! The picture: sky, sea and film, from the read-only maps of the simulation. Linear light until the last shader.
//!
//! A frame: the sky's look-up tables (only when the light changed), sky and water into an HDR target, tone curve to the
//! screen. Every pass is a pure function of [`Scene`] and [`Maps`].

mod frame;
mod kit;
mod material;
mod mesh;
mod noise;
pub mod post;
mod sky;
mod targets;
mod water;

pub use frame::{SeaLook, View};

use crate::gpu::layout::Layout;
use crate::gpu::shaders::Shaders;
use crate::model::look::Look;
use crate::sim::Maps;
use frame::FrameUniform;
use kit::Uniform;
use material::MaterialUniform;
use mesh::Mesh;
use noise::NoiseTexture;
use post::present::PresentPass;
use sky::Sky;
use targets::Targets;
use water::WaterPass;

/// What the layout test compares with the shaders.
pub const LAYOUTS: &[Layout] = &[
    FrameUniform::LAYOUT,
    MaterialUniform::LAYOUT,
    sky::SkyUniform::LAYOUT,
    sky::LightBuffer::LAYOUT,
    post::present::LAYOUT,
];

/// Pixels of the picture for which the mesh's default density is made.
const REFERENCE_PIXELS: f64 = 1280.0 * 720.0;

/// Everything that a picture depends on besides the maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Eye and projection.
    pub view: View,
    /// Light, sky and film.
    pub look: Look,
    /// What the maps do not tell of the sea.
    pub sea: SeaLook,
}

/// Draws the sea.
pub struct Renderer {
    frame: Uniform<FrameUniform>,
    material: Uniform<MaterialUniform>,
    sky: Sky,
    water: WaterPass,
    background: sky::Background,
    present: PresentPass,
    targets: Option<Targets>,
}

impl Renderer {
    /// Compiles all passes. `target_format` is what [`Self::present`] draws into.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, target_format: wgpu::TextureFormat) -> Self {
        Self::with_samples(device, queue, target_format, samples(device))
    }

    /// The same with a number of coverage samples a pixel, 1 or 4.
    pub fn with_samples(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        target_format: wgpu::TextureFormat,
        samples: u32,
    ) -> Self {
        let shaders = Shaders::default();
        let frame = Uniform::new(device, "frame");
        let material = Uniform::new(device, "material");
        let noise = NoiseTexture::new(device, queue);
        let sky = Sky::new(device, &shaders, &noise);
        let scene = kit::SceneGroup::new(device, &frame, &material, &sky, &noise, samples);
        let background = sky::Background::new(device, &shaders, &scene);
        let water = WaterPass::new(device, &shaders, scene);
        let present = PresentPass::new(device, &shaders, &sky.light, target_format);
        Self { frame, material, sky, water, background, present, targets: None }
    }

    /// Records the HDR picture of `size` pixels.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        maps: &Maps,
        scene: &Scene,
        size: [u32; 2],
    ) {
        let size = size.map(|s| s.max(1));
        if self.targets.as_ref().is_none_or(|t| t.size != size) {
            let targets = Targets::new(device, size, self.water.scene.samples);
            self.present.bind(device, &targets);
            self.targets = Some(targets);
        }
        let Some(targets) = &self.targets else { return };
        let mesh = mesh(scene, size);
        self.frame.write(queue, &FrameUniform::new(scene, maps, &mesh, size));
        self.material.write(queue, &MaterialUniform::new(scene));
        self.present.write(queue, scene, size);
        self.water.bind_maps(device, maps);
        self.water.set_mesh(device, queue, &mesh);

        self.sky.update(queue, encoder, scene);
        let mut pass = targets.begin(encoder);
        self.background.draw(&mut pass, &self.water.scene);
        self.water.draw(&mut pass);
    }

    /// Linear light of the picture last drawn, for read-back.
    pub fn light(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|t| t.hdr.texture())
    }

    /// Draws the tone-mapped picture into the current viewport.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.present.draw(pass);
    }
}

/// As many vertices as the picture can show: triangles smaller than a pixel cost more than the pixel.
fn mesh(scene: &Scene, size: [u32; 2]) -> Mesh {
    let pixels = f64::from(size[0]) * f64::from(size[1]) / REFERENCE_PIXELS;
    Mesh::new(&scene.view, &scene.sea, scene.look.mesh * pixels.clamp(0.06, 2.0))
}

/// The bytes of WGSL `Frame` for a picture of `size` pixels: for the tests that run the picture's functions by themselves.
pub fn frame_bytes(scene: &Scene, maps: &Maps, size: [u32; 2]) -> Vec<u8> {
    bytemuck::bytes_of(&FrameUniform::new(scene, maps, &mesh(scene, size), size)).to_vec()
}

/// The bytes of WGSL `Material`, for the same tests.
pub fn material_bytes(scene: &Scene) -> Vec<u8> {
    bytemuck::bytes_of(&MaterialUniform::new(scene)).to_vec()
}

/// Coverage samples a pixel: several on a GPU; one in software, where they cost six times the rest of the frame. The page
/// cannot always tell which it has and takes one; the present pass smooths edges in any case.
fn samples(device: &wgpu::Device) -> u32 {
    let in_software = cfg!(target_arch = "wasm32") || device.adapter_info().device_type == wgpu::DeviceType::Cpu;
    if in_software { 1 } else { 4 }
}
