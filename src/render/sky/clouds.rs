//! Volumetric clouds: a dome around the eye that is filled by ray marching (shaders/sky/cloud_dome.wgsl), and the
//! shadows of the clouds on the sea (shaders/sky/cloud_shadow.wgsl). A still gets a complete dome. In a running sea, a
//! second dome is filled by a few rows a frame, which takes about a second; the picture fades to it while the next is
//! filled.

pub use super::cloud_field::CloudField;
use super::cloud_field::Clouds;
use super::cloud_passes::{CloudMaps, CloudPasses, MAP_SIDE, SharedTables};
use super::table_pass::{TABLE_USAGE, workgroups};
use super::uniform::SkyUniform;
use crate::gpu::Gpu;
use crate::gpu::kit::BindingType;
use crate::gpu::layout::gpu_struct;
use crate::gpu::timer::Timer;
use crate::gpu::uniform::Uniform;
use crate::render::scene::Scene;
use crate::shaders::Shaders;
use wgpu::BindingResource::TextureView;

/// Rows of the dome for each pixel of the picture's width, and the fewest and the most rows.
const ROWS_PER_PIXEL: f64 = 0.6;
const ROW_RANGE: [u32; 2] = [128, 1024];
/// Most rows of the dome in the lean tier.
const MOST_LEAN_ROWS: u32 = 512;
/// Columns of the dome for each of its rows.
const COLUMNS_PER_ROW: u32 = 3;
/// Rows that a frame of a running sea fills: at most 49,152 rays.
const ROWS_PER_FRAME: u32 = 16;
/// Layers of the dome texture: the picture fades from one to another while the third is filled.
const DOME_LAYERS: u32 = 3;
/// Distance, km, by which the clouds may have moved since their dome was filled; after a longer leap it is filled anew.
const LONGEST_SHIFT_KM: f64 = 1.0;
/// Cosine of the angle between two directions of narrow columns from which on a dome that is being filled is begun again.
/// It lies between the cosines of one and of two of their steps, 30° and 60°.
const TURN_COS: f32 = 0.7;

gpu_struct! {
    /// WGSL `Clouds`: how the picture reads the dome of clouds and their shadows.
    #[derive(Default)]
    pub struct CloudView as "Clouds" {
        /// Distance (x, z), km, by which the clouds have moved relative to the eye since the newest dome was filled.
        new_shift_km: [f32; 2],
        /// Distance (x, z), km, by which they have moved since the dome before the newest one was filled.
        old_shift_km: [f32; 2],
        /// Horizontal unit vector (x, z) at which the columns of the newest dome are narrowest, and of the one before.
        new_ahead: [f32; 2],
        old_ahead: [f32; 2],
        /// Layer of the newest complete dome, and of the one before.
        new_layer: u32,
        old_layer: u32,
        /// Share of the older dome in the picture.
        old_share: f32,
        /// Height, km, that stands for the clouds where a dome is moved with them; 0 without clouds.
        height_km: f32,
        /// Change of the first and of the second coordinate in the map of shadows along x and z, 1/m.
        shadow_along: [f32; 2],
        shadow_across: [f32; 2],
        /// Coordinates in the map of shadows of the point of the sea below the eye.
        shadow_offset: [f32; 2],
        /// Binary logarithm of the number of texels per metre in the map of shadows.
        log_shadow_texels_per_m: f32,
        unused: u32,
    }
}

/// A dome, complete or being filled: its layer, and the clouds at its time.
#[derive(Clone, Copy)]
struct Dome {
    layer: u32,
    clouds: Clouds,
}

/// What a dome depends on besides the position of the clouds: if it changes, the dome is filled anew at once.
#[derive(Clone, Copy, PartialEq)]
struct Surroundings {
    field: CloudField,
    sky: SkyUniform,
    rows: u32,
}

/// Volumetric clouds: their dome and their shadows.
pub struct CloudPass {
    shaders: Shaders,
    pub view: Uniform<CloudView>,
    /// Uniforms of the passes that fill the maps of weather and shadow, and of the pass that fills the dome.
    map_field: Uniform<CloudField>,
    dome_field: Uniform<CloudField>,
    shadow_texture: wgpu::Texture,
    /// Map of the sunlight that passes between the clouds, with mip levels.
    pub shadow: wgpu::TextureView,
    /// The dome texture: one black texel until there are clouds.
    pub dome: wgpu::TextureView,
    pub layout: wgpu::BindGroupLayout,
    /// Bind group of the dome, for the pass that draws the sky.
    pub group: wgpu::BindGroup,
    rows: u32,
    /// Whether the passes were compiled with shafts of rain.
    has_squalls: bool,
    passes: Option<CloudPasses>,
    /// The field for which the maps of weather and shadow were made, with the direction of the sun.
    maps_made_for: Option<(CloudField, [f32; 3])>,
    dome_made_for: Option<Surroundings>,
    /// The newest complete dome, and the one before.
    shown: Option<[Dome; 2]>,
    /// The dome that is being filled, and the number of its parts that are done.
    filling: Option<(Dome, u32)>,
    /// Number of frames since the newest dome was complete, at most that of its parts. Their quotient is the newest
    /// dome's share in the picture.
    faded: u32,
}

fn dome_texture(gpu: &Gpu, format: wgpu::TextureFormat, [width, height, layers]: [u32; 3]) -> wgpu::Texture {
    gpu.texture("sky/cloud dome", [width, height, layers], 1, format, TABLE_USAGE)
}

fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

impl CloudPass {
    /// Creates the small resources that every picture binds; the others follow with the first clouds.
    pub fn new(gpu: &Gpu, shaders: &Shaders) -> Self {
        let format = shaders.map_format(gpu).texture_format();
        let mips = MAP_SIDE.ilog2() + 1;
        let shadow_texture = gpu.texture("sky/cloud shadow", [MAP_SIDE, MAP_SIDE, 1], mips, format, TABLE_USAGE);
        let dome = array_view(&dome_texture(gpu, format, [1, 1, 1]));
        let layout =
            gpu.bind_group_layout("sky/cloud dome", wgpu::ShaderStages::FRAGMENT, &[BindingType::TextureArray]);
        Self {
            shaders: shaders.clone(),
            view: Uniform::new(gpu, "clouds"),
            map_field: Uniform::new(gpu, "cloud field of the maps"),
            dome_field: Uniform::new(gpu, "cloud field of the dome"),
            shadow: shadow_texture.create_view(&wgpu::TextureViewDescriptor::default()),
            shadow_texture,
            group: gpu.bind_group("sky/cloud dome", &layout, &[TextureView(&dome)]),
            dome,
            layout,
            rows: 0,
            has_squalls: false,
            passes: None,
            maps_made_for: None,
            dome_made_for: None,
            shown: None,
            filling: None,
            faded: 0,
        }
    }

    /// Number of rows of the dome for a picture `width` pixels wide.
    fn wanted_rows(width: u32, is_lean: bool) -> u32 {
        let wanted = (ROWS_PER_PIXEL * f64::from(width)) as u32;
        let most = if is_lean { MOST_LEAN_ROWS } else { ROW_RANGE[1] };
        wanted.next_power_of_two().clamp(ROW_RANGE[0], most)
    }

    /// Creates the dome for a picture of `scene` that is `width` pixels wide. Returns whether there is a new texture.
    pub fn prepare(&mut self, gpu: &Gpu, scene: &Scene, width: u32, tables: &SharedTables<'_>) -> bool {
        let rows = Self::wanted_rows(width, scene.is_lean);
        let has_squalls = scene.look.sky.drawn_squalls() > 0.0;
        if Clouds::new(scene).is_none() || (rows, has_squalls) == (self.rows, self.has_squalls) {
            return false;
        }
        (self.rows, self.has_squalls) = (rows, has_squalls);
        let columns = rows * COLUMNS_PER_ROW;
        let format = self.shaders.map_format(gpu).texture_format();
        self.dome = array_view(&dome_texture(gpu, format, [columns, rows, DOME_LAYERS]));
        self.group = gpu.bind_group("sky/cloud dome", &self.layout, &[TextureView(&self.dome)]);
        let fields = [&self.map_field.buffer, &self.dome_field.buffer];
        let maps = CloudMaps { fields, shadow: &self.shadow_texture, dome: &self.dome };
        self.passes = Some(CloudPasses::new(gpu, &self.shaders, tables, &maps, ([columns, rows], has_squalls)));
        (self.maps_made_for, self.dome_made_for, self.shown) = (None, None, None);
        (self.filling, self.faded) = (None, 0);
        true
    }

    /// Records the maps of weather and shadow if they do not match the clouds and the sun. Returns whether it did.
    pub fn record_maps(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        clouds: &Clouds,
        sky: &SkyUniform,
    ) -> bool {
        let Some(passes) = &mut self.passes else { return false };
        let wanted = (clouds.fixed(), sky.sun_direction());
        if self.maps_made_for == Some(wanted) {
            return false;
        }
        self.map_field.write(gpu, &clouds.field);
        if !passes.has_noise {
            passes.noise.run(encoder, timer);
            passes.noise_mips.iter().for_each(|pass| pass.run(encoder, timer));
            passes.has_noise = true;
        }
        passes.weather.run(encoder, timer);
        passes.shadow.run(encoder, timer);
        passes.shadow_mips.iter().for_each(|pass| pass.run(encoder, timer));
        self.maps_made_for = Some(wanted);
        true
    }

    /// Records the passes that fill the dome, whole or in part, and writes how the picture reads it. Returns whether a
    /// new dome is complete.
    pub fn record_dome(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &Timer,
        scene: &Scene,
        (clouds, sky): (&Clouds, &SkyUniform),
    ) -> bool {
        let Some(passes) = &self.passes else { return false };
        let field = CloudField { downwind: [0.0; 2], ..clouds.fixed() };
        let wanted = Surroundings { field, sky: sky.for_clouds(), rows: self.rows };
        let (is_other, is_running) = (self.dome_made_for != Some(wanted), scene.may_keep_pipelines);
        let mut is_complete = false;
        let near = self.shown.filter(|[new, _]| is_running && !is_other && is_near(&new.clouds, clouds));
        if let Some([new, old]) = near {
            let free = (0..DOME_LAYERS).find(|&layer| layer != new.layer && layer != old.layer).unwrap_or(0);
            let parts = self.rows / ROWS_PER_FRAME;
            // A view that keeps turning does not begin the dome again for ever.
            let may_begin_again = self.faded < parts;
            let begun = self.filling.filter(|(dome, _)| !may_begin_again || !is_turned(&dome.clouds, clouds));
            let (dome, part) = begun.unwrap_or((Dome { layer: free, clouds: *clouds }, 0));
            let field = CloudField { layer: dome.layer, first_row: part, row_step: parts, ..dome.clouds.field };
            self.dome_field.write(gpu, &field);
            passes.dome.run_workgroups(encoder, timer, workgroups([self.rows * COLUMNS_PER_ROW, ROWS_PER_FRAME]));
            (self.filling, self.faded) = (Some((dome, part + 1)), (self.faded + 1).min(parts));
            if part + 1 == parts {
                (self.shown, self.filling, self.faded) = (Some([dome, new]), None, 0);
                is_complete = true;
            }
        } else if is_other || self.shown.is_none_or(|[new, _]| new.clouds != *clouds) {
            self.dome_field.write(gpu, &clouds.field);
            passes.dome.run(encoder, timer);
            let dome = Dome { layer: 0, clouds: *clouds };
            (self.shown, self.filling, self.dome_made_for) = (Some([dome, dome]), None, Some(wanted));
            self.faded = 0;
            is_complete = true;
        } else {
            // The picture shows the newest dome alone.
            (self.shown, self.filling) = (self.shown.map(|[new, _]| [new, new]), None);
            self.faded = 0;
        }
        self.write_view(gpu, clouds, sky);
        is_complete
    }

    fn write_view(&self, gpu: &Gpu, clouds: &Clouds, sky: &SkyUniform) {
        let Some([new, old]) = self.shown else { return };
        let shift = |dome: &Dome| std::array::from_fn(|i| (dome.clouds.eye_km[i] - clouds.eye_km[i]) as f32);
        let parts = self.rows / ROWS_PER_FRAME;
        let done = self.faded as f32 / parts as f32;
        let [shadow_along, shadow_across, shadow_offset] = clouds.shadow_axes(sky.sun_direction());
        let texels_per_m = 0.001 * clouds.field.tiles_per_km * MAP_SIDE as f32;
        self.view.write(
            gpu,
            &CloudView {
                new_shift_km: shift(&new),
                old_shift_km: shift(&old),
                new_ahead: new.clouds.field.ahead,
                old_ahead: old.clouds.field.ahead,
                new_layer: new.layer,
                old_layer: old.layer,
                old_share: if new.layer == old.layer { 0.0 } else { 1.0 - done },
                height_km: clouds.height_km(),
                shadow_along,
                shadow_across,
                shadow_offset,
                log_shadow_texels_per_m: texels_per_m.log2(),
                unused: 0,
            },
        );
    }

    /// Tells the picture that there are no clouds.
    pub fn clear(&mut self, gpu: &Gpu) {
        if self.shown.take().is_some() {
            self.view.write(gpu, &CloudView::default());
            (self.dome_made_for, self.filling, self.faded) = (None, None, 0);
        }
    }
}

/// Whether the view has turned so far since a dome was begun that its narrow columns do not lie ahead.
fn is_turned(begun: &Clouds, wanted: &Clouds) -> bool {
    let [[a, b], [c, d]] = [begun.field.ahead, wanted.field.ahead];
    a * c + b * d < TURN_COS
}

/// Whether a dome of the clouds `made` can be moved to show `wanted`.
fn is_near(made: &Clouds, wanted: &Clouds) -> bool {
    (0..2).all(|i| (made.eye_km[i] - wanted.eye_km[i]).abs() < LONGEST_SHIFT_KM)
}
