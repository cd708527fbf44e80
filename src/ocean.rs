//! The façade: a sea and its picture. The only type that the shells use.

use crate::gpu::shaders::Shaders;
use crate::model::afloat::{Pose, Waterline};
use crate::model::camera::View;
use crate::model::params::{Camera, CameraMode};
use crate::model::slopes::{self, SlopeVariance};
use crate::model::views::Scale;
use crate::model::{Params, Plan};
use crate::render::{Reference, Renderer, Scene, SeaLook};
use crate::sim::{MAX_STEPS, Simulation};

pub use crate::render::{Grid, Part};

/// Lowest eye above the still water, m; the picture raises it over the waves that come.
const LOWEST_EYE_M: f64 = 0.5;

/// Speed of low clouds over the wind 10 m above the sea: the logarithmic profile up to the top of the boundary layer.
const CLOUDS_OVER_WIND: f64 = 1.4;

/// A sea on a device, with its renderer.
pub struct Ocean {
    params: Params,
    shaders: Shaders,
    sim: Simulation,
    renderer: Renderer,
    reference: Option<Reference>,
    format: wgpu::TextureFormat,
    slopes: Slopes,
    /// The waves under what floats, once something does.
    waterline: Option<Waterline>,
}

/// Slopes of a plan, for the shading.
struct Slopes {
    residual: SlopeVariance,
    finest: SlopeVariance,
}

impl Slopes {
    fn new(plan: &Plan) -> Self {
        let finest = plan.cascades.last().map_or([0.0; 2], |c| slopes::between(plan, c.k_low, c.k_high));
        Self { residual: slopes::residual(plan, slopes::resolved(plan)), finest }
    }
}

impl Ocean {
    /// Allocates a sea whose picture goes to targets of `format`.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, format: wgpu::TextureFormat, params: &Params) -> Self {
        let shaders = Shaders::default();
        let sim = Simulation::new(device, queue, Plan::new(params), &shaders);
        let renderer = Renderer::new(device, queue, format);
        let slopes = Slopes::new(sim.plan());
        Self { params: params.clone(), shaders, sim, renderer, reference: None, format, slopes, waterline: None }
    }

    /// The same, with light and depth of the picture to be read back.
    pub fn with_layers(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        format: wgpu::TextureFormat,
        params: &Params,
    ) -> Self {
        Self { renderer: Renderer::with_layers(device, queue, format), ..Self::new(device, queue, format, params) }
    }

    /// Turns to other parameters; costs nothing when only the time, the camera or the light changed.
    pub fn set_params(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, params: &Params) {
        if (&params.grid, &params.sea) != (&self.params.grid, &self.params.sea) {
            self.sim.set_plan(device, queue, Plan::new(params), &self.shaders);
            self.slopes = Slopes::new(self.sim.plan());
            self.waterline = None;
        }
        self.params = params.clone();
    }

    /// What is computed.
    pub fn plan(&self) -> &Plan {
        self.sim.plan()
    }

    /// The simulation, for read-back.
    pub fn simulation(&mut self) -> &mut Simulation {
        &mut self.sim
    }

    /// Records one frame of `size` pixels. At most `most_steps` past times are replayed for the foam; returns whether
    /// it has caught up.
    pub fn encode(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
        most_steps: usize,
    ) -> bool {
        if !self.params.floats.is_empty() && self.waterline.is_none() {
            self.waterline = Some(Waterline::new(&self.params));
        }
        let scene = self.scene(size);
        let centre = [self.params.camera.x_m, self.params.camera.z_m];
        let caught_up = self.sim.encode(queue, encoder, self.params.clock.t_s, centre, most_steps);
        self.renderer.draw(device, queue, encoder, self.sim.maps(), &scene, size);
        caught_up
    }

    /// Records one frame whose foam is complete: a still that depends on the parameters alone.
    pub fn encode_fully(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        size: [u32; 2],
    ) {
        self.encode(device, queue, encoder, size, MAX_STEPS);
    }

    /// Linear light of the recorded frame, half floats, for read-back.
    pub fn light(&self) -> Option<&wgpu::Texture> {
        self.renderer.light()
    }

    /// Depth of the recorded frame, see [`Renderer::depth`].
    pub fn depth(&self) -> Option<&wgpu::Texture> {
        self.renderer.depth()
    }

    /// Draws the recorded frame into the viewport of a pass.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.renderer.present(pass);
    }

    /// Records one part of the last picture by itself, to be timed.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, part: Part) {
        self.renderer.record(encoder, part);
    }

    /// Records unfiltered samples of the sea as the last frame left it; see [`Reference::draw`].
    pub fn encode_samples(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        grid: &Grid,
    ) -> wgpu::Texture {
        let scene = self.scene(grid.size);
        let reference = self.reference.get_or_insert_with(|| Reference::new(device, queue, self.format));
        reference.draw(device, queue, encoder, self.sim.maps(), &scene, grid)
    }

    /// Draws a picture in linear light (RGB, row by row) as the film shows it, with the exposure of the state.
    pub fn present_light(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        pass: &mut wgpu::RenderPass<'_>,
        size: [u32; 2],
        light: &[[f32; 3]],
    ) {
        let scene = self.scene(size);
        if let Some(reference) = &mut self.reference {
            reference.show(device, queue, &scene, size, light);
            reference.present(pass);
        }
    }

    /// What the renderer draws in `width` x `height` pixels.
    pub fn scene(&self, [width, height]: [u32; 2]) -> Scene {
        let plan = self.sim.plan();
        let sea = &self.params.sea;
        let hs_m = plan.hs_m();
        let wind_m_s = sea.local().wind_m_s;
        let aspect = f64::from(width.max(1)) / f64::from(height.max(1));
        let peak_k = plan.dispersion.wave_number(plan.omega_p);
        let mirror = &self.params.look.surface.mirror;
        let reach_m = sea.depth_m * (1.0 - mirror.index_air / mirror.index_water);
        Scene {
            view: View::new(&above_water(&self.params), aspect, LOWEST_EYE_M),
            look: self.params.look.clone(),
            rides: self.params.camera.mode == CameraMode::Buoy,
            floats: self.poses(),
            level_m: sea.level_m,
            scales: std::array::from_fn(|layer| Scale::new(self.params.look.view.shown, plan, layer)),
            sea: SeaLook {
                chop: sea.lambda().map(|l| l as f32),
                hs_m: hs_m as f32,
                depth_m: sea.depth_m as f32,
                wind_m_s: wind_m_s as f32,
                downwind: plan.downwind.map(|x| x as f32),
                residual: self.slopes.residual,
                finest: self.slopes.finest,
                focusing_m: slopes::focusing_m(plan, reach_m.max(0.0)) as f32,
                mean_foam: self.sim.foam_coverage() as f32,
                lambda_p_m: (std::f64::consts::TAU / peak_k) as f32,
                cloud_drift_m: plan.downwind.map(|w| w * CLOUDS_OVER_WIND * wind_m_s * self.params.clock.t_s),
            },
        }
    }
}

impl Ocean {
    /// How what floats lies on the water at the time of the parameters; empty before the first frame with it.
    pub fn poses(&self) -> Vec<Pose> {
        let Some(waterline) = &self.waterline else { return Vec::new() };
        self.params.floats.iter().map(|f| waterline.pose(f, self.params.clock.t_s)).collect()
    }
}

/// The camera with its height over the still water: the surface is drawn around 0, wherever its level lies in the world.
fn above_water(params: &Params) -> Camera {
    let camera = &params.camera;
    Camera { y_m: camera.y_m - params.sea.level_m, ..camera.clone() }
}
