//! The picture: sky, sea and film, from the read-only maps of the simulation. Linear light until the last shader.
//!
//! A frame: the sky's look-up tables (only when the light changed), sky and water into an HDR target, tone curve to the
//! screen. Every pass is a pure function of [`Scene`] and [`Maps`].

pub mod film;
mod frame;
mod kit;
mod reference;
mod sky;
mod targets;
mod views;
mod water;

pub use frame::{Fading, SeaLook, View};
pub use reference::{Grid, Reference};
pub use targets::Film;

use crate::gpu::Gpu;
use crate::gpu::layout::Layout;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::point::floating::HullPose;
use crate::shaders::Shaders;
use crate::sim::Maps;
use crate::sim::maps::MAX_CASCADES;
use crate::state::look::Look;
use crate::state::views::Shown;
use crate::waves::colour_scale::ColourScale;
use film::present::PresentPass;
use frame::FrameUniform;
use sky::Sky;
use sky::background::Background;
use targets::Targets;
use views::DebugPass;
use water::eye::EyePass;
use water::floats::FloatsPass;
use water::light::WaterPass;
use water::material::MaterialUniform;
use water::mesh::Mesh;
use water::noise::NoiseTexture;

/// What the layout test compares with the shaders.
pub const LAYOUTS: &[Layout] = &[
    FrameUniform::LAYOUT,
    MaterialUniform::LAYOUT,
    sky::SkyUniform::LAYOUT,
    sky::LightBuffer::LAYOUT,
    film::present::PresentUniform::LAYOUT,
    views::DebugTile::LAYOUT,
    views::DebugUniform::LAYOUT,
];

/// Pixels of the picture for which the mesh's default density is made.
const REFERENCE_PIXELS: f64 = 1280.0 * 720.0;

/// Everything that a picture depends on besides the maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Eye and projection.
    pub view: View,
    /// Whether the eye's height counts from the water below it.
    pub rides: bool,
    /// Light, sky and film.
    pub look: Look,
    /// What the maps do not tell of the sea.
    pub sea: SeaLook,
    /// What the colours of a view stand for, layer by layer of its maps; the picture has no use for it.
    pub scales: [ColourScale; MAX_CASCADES],
    /// What floats, in the world.
    pub floats: Vec<HullPose>,
    /// Height of the still water in the world, m.
    pub level_m: f64,
}

/// A part of the picture that can be recorded by itself, to be timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The sky's tables, as when the light changed.
    Light,
    /// What stands behind the sea.
    Background,
    /// The mesh of the sea and, where the sea is lit afterwards, what it shows.
    Mesh,
    /// The sea, its mesh with it.
    Water,
}

/// Draws the sea.
pub struct Renderer {
    frame: Uniform<FrameUniform>,
    material: Uniform<MaterialUniform>,
    sky: Sky,
    eye: EyePass,
    water: WaterPass,
    background: Background,
    floats: FloatsPass,
    present: PresentPass,
    targets: Option<Targets>,
    target_format: wgpu::TextureFormat,
    /// Since the first view was asked for.
    debug: Option<DebugPass>,
    /// Whether a view was drawn last.
    shows_view: bool,
    timer: Timer,
}

impl Renderer {
    /// Compiles all passes. `target_format` is what [`Self::present`] draws into.
    pub fn new(gpu: &Gpu, target_format: wgpu::TextureFormat, film: Film) -> Self {
        let shaders = Shaders::default();
        let frame = Uniform::new(gpu, "frame");
        let material = Uniform::new(gpu, "material");
        let noise = NoiseTexture::new(gpu);
        let sky = Sky::new(gpu, &shaders, &noise);
        let scene = kit::SceneGroup::new(gpu, &frame, &material, &sky, &noise, film);
        let background = Background::new(gpu, &shaders);
        let water = WaterPass::new(gpu, &shaders, scene, &frame);
        let eye = EyePass::new(gpu, &shaders, &frame, &water);
        let floats = FloatsPass::new(gpu, &shaders);
        let present = PresentPass::new(gpu, &shaders, &sky.light, target_format, film.is_deferred());
        // A browser hears of the pipelines, and compiles them while the noise is made.
        gpu.queue.submit([]);
        noise.fill(gpu);
        Self {
            frame,
            material,
            sky,
            eye,
            water,
            background,
            floats,
            present,
            targets: None,
            target_format,
            debug: None,
            shows_view: false,
            timer: Timer::default(),
        }
    }

    /// Has its passes timed, each by its name.
    pub fn set_timer(&mut self, timer: Timer) {
        self.timer = timer;
    }

    /// Records the HDR picture of `size` pixels.
    pub fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, maps: &Maps, scene: &Scene, size: [u32; 2]) {
        let size = size.map(|s| s.max(1));
        let film = self.water.scene.film;
        if self.targets.as_ref().is_none_or(|t| t.size != size) {
            let targets = Targets::new(gpu, size, film);
            self.present.unbind();
            self.targets = Some(targets);
        }
        if let Some(targets) = &self.targets {
            self.water.bind_targets(gpu, targets);
            self.present.bind(gpu, targets, &scene.look.film);
            self.present.write(gpu, scene, size);
        }
        let mesh = mesh(scene, size);
        self.prepare(gpu, maps, scene, &mesh, &FrameUniform::new(scene, maps, &mesh, size));
        self.shows_view = scene.look.view.shown != Shown::Picture;
        if self.shows_view {
            self.record_view(gpu, encoder, maps, scene);
            self.timer.mark(encoder, "view");
        } else {
            self.record_picture(gpu, encoder, scene);
            self.present.spread(encoder);
            self.timer.mark(encoder, "bloom");
        }
    }

    /// Takes maps, look, mesh and view.
    fn prepare(&mut self, gpu: &Gpu, maps: &Maps, scene: &Scene, mesh: &Mesh, frame: &FrameUniform) {
        self.material.write(gpu, &MaterialUniform::new(scene));
        self.frame.write(gpu, frame);
        self.water.choose(gpu, scene);
        self.background.choose(gpu, &self.water.scene, &self.sky, scene);
        self.water.bind_maps(gpu, maps);
        self.water.mesh.set(gpu, mesh);
        let foot = [scene.view.eye.x, scene.view.eye.z];
        self.floats.write(gpu, &self.water.scene, &scene.floats, foot, scene.level_m);
    }

    /// Records the view that the look asks for instead of the picture.
    fn record_view(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, maps: &Maps, scene: &Scene) {
        let Some(targets) = &self.targets else { return };
        self.eye.run(encoder, scene, &self.water);
        if let (Shown::Surface(_), Some(maps)) = (&scene.look.view.shown, self.water.maps_group()) {
            self.water.mesh.run(encoder, maps);
        }
        let make = || DebugPass::new(gpu, &Shaders::default(), &self.water, self.target_format);
        let debug = self.debug.get_or_insert_with(make);
        debug.draw(gpu, encoder, (maps, scene), &self.water, targets);
    }

    /// Records the passes of the picture into the targets.
    fn record_picture(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, scene: &Scene) {
        let Some(targets) = &self.targets else { return };
        self.eye.run(encoder, scene, &self.water);
        self.timer.mark(encoder, "eye");
        self.sky.update(gpu, encoder, scene);
        self.timer.mark(encoder, "sky tables");
        let after_mesh = self.water.prepare(encoder, targets);
        self.timer.mark(encoder, "mesh");
        let mut pass = targets.begin(encoder, after_mesh);
        self.background.draw(&mut pass, &self.water.scene, &self.sky);
        self.water.draw(&mut pass);
        self.floats.draw(&mut pass, &self.water.scene);
        drop(pass);
        self.timer.mark(encoder, "picture");
    }

    /// Records one part of the picture last drawn, by itself, whether it is stale or not.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, part: Part) {
        let Some(targets) = &self.targets else { return };
        match part {
            Part::Light => self.sky.record(encoder),
            Part::Background => {
                self.background.draw(&mut targets.begin(encoder, false), &self.water.scene, &self.sky);
            }
            Part::Mesh => {
                self.water.prepare(encoder, targets);
            }
            Part::Water => {
                let after_mesh = self.water.prepare(encoder, targets);
                self.water.draw(&mut targets.begin(encoder, after_mesh));
            }
        }
    }

    /// Vertices of the mesh last drawn.
    pub fn vertices(&self) -> u32 {
        self.water.mesh.vertices()
    }

    /// Linear light of the picture last drawn, for read-back.
    pub fn light(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|t| t.hdr.texture())
    }

    /// Depth of the picture last drawn, near (0.1 m) over the distance along the view, 0 for the sky; to be read back from a
    /// renderer for [`Film::Layers`].
    pub fn depth(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|t| t.depth.texture())
    }

    /// Draws the tone-mapped picture, or the view, into the current viewport.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        match &self.debug {
            Some(debug) if self.shows_view => debug.show(pass),
            _ => self.present.draw(pass),
        }
    }
}

/// As many vertices as the picture can show: triangles smaller than a pixel cost more than the pixel. Small pictures have
/// more of them a pixel, because they cost little there.
fn mesh(scene: &Scene, size: [u32; 2]) -> Mesh {
    let pixels = f64::from(size[0]) * f64::from(size[1]) / REFERENCE_PIXELS;
    Mesh::new(&scene.view, &scene.sea, scene.look.mesh_detail * pixels.sqrt().clamp(0.05, 2.0), scene.look.extent_km)
}

/// The bytes of WGSL `Frame` for a picture of `size` pixels: for the tests that run the picture's functions by themselves.
pub fn frame_bytes(scene: &Scene, maps: &Maps, size: [u32; 2]) -> Vec<u8> {
    bytemuck::bytes_of(&FrameUniform::new(scene, maps, &mesh(scene, size), size)).to_vec()
}

/// The bytes of WGSL `Material`, for the same tests.
pub fn material_bytes(scene: &Scene) -> Vec<u8> {
    bytemuck::bytes_of(&MaterialUniform::new(scene)).to_vec()
}
