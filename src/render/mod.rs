//! The renderer: draws sky, sea and film from the maps of the simulation. Light is linear up to the tone pass.
//!
//! A frame computes the sky's look-up tables (only if the light changed), draws sky and water into an HDR target, and
//! applies the tone curve for the screen. Every pass depends only on [`Scene`] and [`Maps`].

mod drops;
mod film;
mod frame;
mod frame_maps;
mod land;
mod reference;
mod scene;
mod scene_group;
mod sky;
mod targets;
mod variants;
mod views;
mod water;

pub use frame::FrameUniform;
pub use land::map::{LandUniform, land_map, no_land_map};
pub use reference::{ReferenceRenderer, SampleGrid};
pub use scene::{FadingSea, Scene, SeaAppearance};
pub use targets::OutputKind;
pub use water::hull_images::HullImages;
pub use water::light::waves_cast_shadows;
pub use water::material::MaterialUniform;
pub use water::noise::NoiseTexture;

use crate::gpu::Gpu;
use crate::gpu::layout::StructDeclaration;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::shaders::Shaders;
use crate::sim::Maps;
use crate::sim::maps::TileLatticePosition;
use crate::state::camera::View;
use crate::state::look::Look;
use crate::state::views::DisplayedView;
use drops::DropPasses;
use drops::rain::RainUniform;
use drops::spray::{SprayLevel, SprayUniform};
use film::present::PresentPass;
use film::tone::{TonePass, ToneUniform};
use frame_maps::{FrameCascade, FrameFoamGrid};
use land::{CoverUniform, LandPass, LandStone, LandVertex};
use scene_group::{SceneGroup, SceneResources};
use sky::background::BackgroundPass;
use sky::clouds::{CloudField, CloudView};
use sky::tables::SkyTables;
use sky::uniform::{FogUniform, LightBuffer, SkyUniform};
use targets::Targets;
use views::{FalseColourPass, ViewTile, ViewUniform};
use water::displace::MeshVertex;
use water::eye::EyePass;
use water::hull_images::{HullImage, HullSection};
use water::hulls::{HullPass, HullVertex};
use water::light::WaterPass;
use water::material::NoiseLayer;
use water::mesh::{self, Mesh, MeshLattice};
use water::under::UnderPass;

/// Structs that Rust and the renderer's shaders share; their WGSL declarations are made from these.
pub const SHARED_STRUCTS: &[StructDeclaration] = &[
    TileLatticePosition::DECLARATION,
    MeshLattice::DECLARATION,
    MeshVertex::DECLARATION,
    HullVertex::DECLARATION,
    HullSection::DECLARATION,
    HullImage::DECLARATION,
    HullImages::DECLARATION,
    FrameCascade::DECLARATION,
    FrameFoamGrid::DECLARATION,
    FrameUniform::DECLARATION,
    NoiseLayer::DECLARATION,
    MaterialUniform::DECLARATION,
    FogUniform::DECLARATION,
    SkyUniform::DECLARATION,
    LightBuffer::DECLARATION,
    CloudField::DECLARATION,
    CloudView::DECLARATION,
    SprayLevel::DECLARATION,
    SprayUniform::DECLARATION,
    RainUniform::DECLARATION,
    LandVertex::DECLARATION,
    LandStone::DECLARATION,
    CoverUniform::DECLARATION,
    LandUniform::DECLARATION,
    ToneUniform::DECLARATION,
    ViewTile::DECLARATION,
    ViewUniform::DECLARATION,
];

/// A part of a frame that can be recorded alone, so that its GPU time can be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimedPart {
    /// Computation of all look-up tables of the sky (clear air, reflected sky, light on the sea), even if up to date.
    SkyTables,
    /// Drawing of the sky behind the sea.
    Background,
    /// Displacement of the water mesh, and its drawing into the G-buffer.
    Mesh,
    /// All of [`Self::Mesh`], then the lighting of the water's pixels.
    Water,
    /// Exposure and tone curve of the picture, with smoothed edges and dither.
    Tone,
}

/// Draws the sea with sky, floating objects and film (exposure, tone curve), or a false-colour view in its place.
pub struct Renderer {
    frame: Uniform<FrameUniform>,
    material: Uniform<MaterialUniform>,
    hull_images: Uniform<HullImages>,
    sky: SkyTables,
    noise: NoiseTexture,
    eye: EyePass,
    water: WaterPass,
    under: UnderPass,
    land: LandPass,
    background: BackgroundPass,
    hulls: HullPass,
    drops: DropPasses,
    tone: TonePass,
    present_pass: PresentPass,
    targets: Option<Targets>,
    /// Passes of the false-colour views; None until a view is first shown.
    view_pass: Option<FalseColourPass>,
    timer: Timer,
}

impl Renderer {
    /// Compiles what every picture needs from `shaders`; the rest is compiled at first use. `screen_format` is the
    /// format of the texture that [`Self::present`] draws into, `output` the purpose of the pictures.
    pub fn new(gpu: &Gpu, shaders: &Shaders, screen_format: wgpu::TextureFormat, output: OutputKind) -> Self {
        let shaders = shaders.clone().with_structs(SHARED_STRUCTS);
        let frame = Uniform::new(gpu, "frame");
        let material = Uniform::new(gpu, "material");
        let hull_images = Uniform::new(gpu, "hull images");
        let noise = NoiseTexture::new(gpu);
        let sky = SkyTables::new(gpu, &shaders, &noise);
        let land = LandPass::new(gpu, shaders.clone());
        let resources = SceneResources {
            frame: &frame,
            material: &material,
            hull_images: &hull_images,
            sky: &sky,
            noise: &noise,
            land: land.resources(),
        };
        let scene = SceneGroup::new(gpu, &resources, output);
        let background = BackgroundPass::new(gpu, &shaders);
        let water = WaterPass::new(gpu, &shaders, scene, &frame);
        let eye = EyePass::new(gpu, &shaders, &frame, &water);
        let hulls = HullPass::new(gpu, &shaders);
        let drops = DropPasses::new(&shaders);
        let tone = TonePass::new(gpu, &shaders, &sky.light_buffer, output != OutputKind::Reference);
        let present_pass = PresentPass::new(gpu, &shaders, screen_format);
        // The empty submission makes a browser start compiling the pipelines while the CPU computes the noise.
        gpu.queue.submit([]);
        noise.fill(gpu);
        Self {
            frame,
            material,
            hull_images,
            sky,
            noise,
            eye,
            water,
            under: UnderPass::new(shaders),
            land,
            background,
            hulls,
            drops,
            tone,
            present_pass,
            targets: None,
            view_pass: None,
            timer: Timer::default(),
        }
    }

    /// Sets the timer that measures the GPU time of each pass of a frame.
    pub fn set_timer(&mut self, timer: Timer) {
        self.timer = timer;
    }

    /// Records the passes that draw a picture or view of `size` (width, height) pixels into the renderer's own
    /// textures; [`Self::present`] then shows it.
    pub fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, maps: &Maps, scene: &Scene, size: [u32; 2]) {
        let size = size.map(|s| s.max(1));
        let hdr = self.ensure_targets(gpu, size).hdr.clone();
        let shows_view = scene.look.view.displayed != DisplayedView::Picture;
        self.set_picture(gpu, scene, &hdr, shows_view);
        let mesh = mesh_for_picture(&scene.view, &scene.sea, &scene.look, size);
        self.prepare_frame(gpu, maps, scene, &mesh, &FrameUniform::new(scene, maps, &mesh, size));
        if shows_view {
            self.record_view(gpu, encoder, maps, scene);
        } else {
            self.record_picture(gpu, encoder, scene);
            self.tone.record_measures(encoder, &self.timer);
        }
        self.tone.record(encoder, &self.timer);
    }

    /// Sets the picture `hdr` that the tone pass reads with the film of `scene`, and the finished picture that
    /// [`Self::present`] shows. `hdr` is linear light or, if `is_encoded`, screen colours of a false-colour view.
    fn set_picture(&mut self, gpu: &Gpu, scene: &Scene, hdr: &wgpu::TextureView, is_encoded: bool) {
        let finished = self.tone.set_picture(gpu, hdr, &scene.look.film);
        self.present_pass.set_picture(gpu, finished);
        self.tone.write_uniform(gpu, scene, [hdr.texture().width(), hdr.texture().height()], is_encoded);
    }

    /// Render targets for a picture of `size` (width, height) pixels, created anew if the size has changed.
    fn ensure_targets(&mut self, gpu: &Gpu, size: [u32; 2]) -> &Targets {
        if let Some(old) = self.targets.take_if(|targets| targets.size != size) {
            old.destroy();
        }
        let output = self.water.scene.output;
        self.targets.get_or_insert_with(|| Targets::new(gpu, size, output))
    }

    /// Prepares a frame: writes the uniform buffers, selects the pipelines, binds the maps, sets water mesh and hulls.
    fn prepare_frame(&mut self, gpu: &Gpu, maps: &Maps, scene: &Scene, mesh: &Mesh, frame: &FrameUniform) {
        self.material.write(gpu, &MaterialUniform::new(scene));
        if !scene.hulls.is_empty() {
            self.hull_images.write(gpu, &HullImages::new(scene));
        }
        self.frame.write(gpu, frame);
        if let Some(targets) = &self.targets {
            self.sky.prepare_clouds(gpu, scene, targets.size[0], &self.noise);
        }
        if water::material::is_bed_visible(scene) {
            self.noise.fill_bed_once(gpu);
        }
        self.prepare_land(gpu, scene);
        self.water.select_pipeline(gpu, scene);
        self.eye.select_pipeline(gpu, scene);
        self.under.prepare(gpu, scene, &self.water);
        self.background.select_pipeline(gpu, &self.water.scene, &self.sky, scene);
        self.water.bind_maps(gpu, maps);
        if let Some(targets) = &self.targets {
            self.water.bind_targets(gpu, targets);
            self.under.bind_targets(gpu, targets);
            self.drops.prepare(gpu, &self.water, targets, scene);
        }
        self.water.mesh.set_mesh(gpu, mesh);
        self.hulls.upload_hulls(gpu, &self.water.scene, scene);
    }

    /// Uploads the land of a scene, if it has another one than the last, and selects its pipelines.
    fn prepare_land(&mut self, gpu: &Gpu, scene: &Scene) {
        if self.land.upload(gpu, scene) {
            let resources = SceneResources {
                frame: &self.frame,
                material: &self.material,
                hull_images: &self.hull_images,
                sky: &self.sky,
                noise: &self.noise,
                land: self.land.resources(),
            };
            self.water.scene.bind(gpu, &resources);
        }
        self.land.select_pipelines(gpu, scene, &self.water);
    }

    /// Records the passes that draw the false-colour view selected in `scene.look`, in place of the picture.
    fn record_view(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, maps: &Maps, scene: &Scene) {
        let Some(targets) = &self.targets else { return };
        self.eye.run(encoder, &self.timer, scene, &self.water);
        if let DisplayedView::Surface(_) = scene.look.view.displayed {
            self.water.displace(encoder, &self.timer);
        }
        let make = |has_coast| {
            FalseColourPass::new(gpu, &Shaders::default().with_structs(SHARED_STRUCTS), &self.water, has_coast)
        };
        self.view_pass.take_if(|view| view.has_coast != scene.has_coast);
        let view = self.view_pass.get_or_insert_with(|| make(scene.has_coast));
        view.draw(gpu, (encoder, &self.timer), (maps, scene), &self.water, targets);
    }

    /// Records the passes that draw the picture's linear light into the render targets, before bloom and exposure: eye
    /// height, sky tables that are out of date, water, sky and floating objects.
    fn record_picture(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, scene: &Scene) {
        let Some(targets) = &self.targets else { return };
        let timer = &self.timer;
        self.eye.run(encoder, timer, scene, &self.water);
        self.sky.record_outdated_tables(gpu, encoder, timer, scene);
        self.record_water_mesh(encoder, timer, targets);
        let mut pass = targets.begin_light(encoder, timer);
        if !scene.is_submerged() {
            self.background.draw(&mut pass, &self.water.scene, &self.sky);
            self.water.draw_light(&mut pass);
            self.land.draw_light(&mut pass, &self.water);
        }
        self.under.draw_light(&mut pass, &self.water);
        if !self.hulls.is_needed() {
            self.drops.draw(&mut pass, &self.water);
            return;
        }
        drop(pass);
        let has_drops = self.drops.are_needed();
        self.hulls.draw(&mut targets.begin_hulls(encoder, timer, has_drops), &self.water.scene);
        if has_drops {
            self.drops.draw(&mut targets.begin_drops(encoder, timer), &self.water);
        }
    }

    /// Records the drawing of the water mesh into the G-buffer and, if the eye dives, of the map of light shafts.
    fn record_water_mesh(&self, encoder: &mut wgpu::CommandEncoder, timer: &Timer, targets: &Targets) {
        self.under.record_shafts(encoder, timer, &self.water);
        self.water.record_g_buffer(encoder, timer, targets, (&self.land, self.under.g_buffer_pipeline()));
    }

    /// Records one part of the last picture again, alone, even if its results are up to date, to measure its GPU time.
    pub fn record_part(&self, encoder: &mut wgpu::CommandEncoder, part: TimedPart) {
        let (Some(targets), timer) = (&self.targets, &Timer::default()) else { return };
        match part {
            TimedPart::SkyTables => self.sky.record_all_tables(encoder, timer),
            TimedPart::Background => {
                self.background.draw(&mut targets.begin_alone(encoder, None), &self.water.scene, &self.sky);
            }
            TimedPart::Mesh => self.record_water_mesh(encoder, timer, targets),
            TimedPart::Water => {
                self.record_water_mesh(encoder, timer, targets);
                let mut pass = targets.begin_light(encoder, timer);
                self.water.draw_light(&mut pass);
                self.under.draw_light(&mut pass, &self.water);
            }
            TimedPart::Tone => self.tone.record(encoder, timer),
        }
    }

    /// Number of vertices of the water mesh in the last frame; 0 before the first frame.
    pub fn vertex_count(&self) -> u32 {
        self.water.mesh.vertex_count()
    }

    /// Texture with the linear light (RGB radiance before exposure and tone curve) of the last frame, which can be
    /// copied to the CPU; None before the first frame.
    pub fn light_texture(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|t| t.hdr.texture())
    }

    /// Depth texture of the last picture, None before the first: near-plane distance (0.1 m) divided by the distance
    /// along the viewing direction, 0 for the sky. It can be copied to the CPU unless the output is
    /// [`OutputKind::Screen`].
    pub fn depth_texture(&self) -> Option<&wgpu::Texture> {
        self.targets.as_ref().map(|t| t.depth.texture())
    }

    /// Draws the last frame into the viewport of `pass`, scaled to its size: the finished picture, or the view that
    /// replaces it.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.present_pass.draw(pass);
    }
}

/// The water mesh for a picture of `size` (width, height) pixels. Its density depends on the size only in steps, so
/// that a picture whose size changes a little, as the adaptive resolution does, keeps its lattice and index buffer.
fn mesh_for_picture(view: &View, sea: &SeaAppearance, look: &Look, size: [u32; 2]) -> Mesh {
    let density = look.mesh_detail * mesh::mesh_density(f64::from(size[0]) * f64::from(size[1]));
    Mesh::new(view, sea, density, look.extent_km)
}

/// Number of vertices of the water mesh in a picture of `size` (width, height) pixels that `view` shows of a sea.
pub fn planned_mesh_vertices(view: &View, sea: &SeaAppearance, look: &Look, size: [u32; 2]) -> u32 {
    let mesh = mesh_for_picture(view, sea, look, size);
    (mesh.drawn_columns + 1) * mesh.lattice.rows
}

/// The frame uniform of a picture of `size` (width, height) pixels, for tests that call WGSL functions of the renderer.
pub fn frame_uniform(scene: &Scene, maps: &Maps, size: [u32; 2]) -> FrameUniform {
    FrameUniform::new(scene, maps, &mesh_for_picture(&scene.view, &scene.sea, &scene.look, size), size)
}
