//! The façade: a sea and its picture. The only type that the shells use.

pub mod about;
mod drawn;
pub mod maps;
pub mod still;

use crate::gpu::Gpu;
use crate::gpu::timer::Timer;
use crate::point::afloat::{self, Pose, Waterline};
use crate::render::{Fading, Reference, Renderer, Scene, SeaAppearance};
use crate::shaders::Shaders;
use crate::sim::glide::Drawn;
use crate::sim::{MAX_STEPS, MapCascade, Moved, Simulation, Turn};
use crate::state::Params;
use crate::state::camera::View;
use crate::state::params::{Camera, CameraMode};
use crate::waves::Plan;
use crate::waves::scale::Scale;
use drawn::Mixture;
use std::sync::Arc;

pub use crate::render::{Film, Grid, Part};
pub use crate::sim::probe::{Probe, Probed};
pub use drawn::DrawnSea;

/// Lowest eye above the still water, m; the picture raises it over the waves that come.
const LOWEST_EYE_M: f64 = 0.5;

/// A sea on a device, with its renderer.
pub struct Ocean {
    gpu: Gpu,
    params: Params,
    shaders: Shaders,
    sim: Simulation,
    renderer: Renderer,
    reference: Option<Reference>,
    format: wgpu::TextureFormat,
    appearance: Drawn<SeaAppearance>,
    seas: Drawn<Mixture>,
    /// The waves under what floats, of the seas that are drawn.
    waterlines: Vec<(Arc<Plan>, Waterline)>,
    timer: Timer,
}

impl Ocean {
    /// Allocates a sea whose picture is presented to targets of `format`; `film` says whether its light can be read back.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, film: Film, params: &Params) -> Self {
        let shaders = Shaders::default();
        let mut sim = Simulation::new(gpu, Plan::new(params), &shaders);
        let mut renderer = Renderer::new(gpu, format, film);
        let timer = Timer::new(gpu);
        sim.set_timer(timer.clone());
        renderer.set_timer(timer.clone());
        let appearance = Drawn::new(SeaAppearance::new(sim.plan(), &params.look));
        let seas = Drawn::new(Mixture::new(sim.plan()));
        Self {
            gpu: gpu.clone(),
            params: params.clone(),
            shaders,
            sim,
            renderer,
            reference: None,
            format,
            appearance,
            seas,
            waterlines: Vec::new(),
            timer,
        }
    }

    /// Turns to other parameters at once; costs nothing when only the time, the camera or the light changed.
    pub fn set_params(&mut self, params: &Params) {
        if (&params.grid, &params.sea) != (&self.params.grid, &self.params.sea) || self.is_gliding() {
            self.sim.set_plan(&self.gpu, Plan::new(params), &self.shaders);
            self.follow(params, &Moved { turn: Some(Turn::Jump), ..Moved::default() });
        }
        self.take(params);
    }

    /// Turns to other parameters as a window does, `dt_s` of wall time after its last frame: the sea glides to what they say
    /// and ends exactly there. Look, camera and time are taken at once, and so is another grid. Call it once a frame, before
    /// [`Self::encode`], and go on while [`Self::is_gliding`], even if time stands still.
    pub fn glide_to(&mut self, params: &Params, dt_s: f64) {
        if params.grid != self.params.grid {
            return self.set_params(params);
        }
        let plan = (params.sea != self.params.sea).then(|| Plan::new(params));
        if plan.is_some() || self.is_gliding() {
            let moved = self.sim.glide_to(&self.gpu, plan, &self.shaders, params.clock.t_s, dt_s);
            self.follow(params, &moved);
        }
        self.take(params);
    }

    /// Whether the sea is on its way to what the parameters say.
    pub fn is_gliding(&self) -> bool {
        self.sim.is_gliding()
    }

    fn follow(&mut self, params: &Params, moved: &Moved) {
        let plan = self.sim.plan();
        self.appearance.follow(moved, || SeaAppearance::new(plan, &params.look));
        self.seas.follow(moved, || Mixture::new(plan));
    }

    fn take(&mut self, params: &Params) {
        if !drawn::refracts_alike(params, &self.params) {
            let focusing_m = SeaAppearance::focusing_m(self.sim.plan(), &params.look);
            self.appearance.change(|sea| sea.focusing_m = focusing_m);
        }
        self.params = params.clone();
    }

    /// The device and queue of the sea.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// What is computed, or glided to.
    pub fn plan(&self) -> &Plan {
        self.sim.plan()
    }

    /// The seas that are drawn at this moment. Heights of water particles over [`Self::level_m`] (and displacements, slopes,
    /// velocities) are the sum of those of their plans, each cascade times its weight: what a boat needs to stay on the
    /// water while the sea glides. At rest one sea with weights of 1. Where a slider is dragged, seas of neighbouring frames
    /// stand for one another.
    pub fn drawn_seas(&self) -> Vec<DrawnSea> {
        let maps = self.sim.maps();
        let (fading, own) = maps.cascades.split_at(maps.fading);
        let (old, now) = self.seas.parts();
        let of = |mixture: &Mixture, cascades: &[MapCascade]| -> Vec<DrawnSea> {
            let weights = |share: f64| cascades.iter().map(|c| share * f64::from(c.weight)).collect();
            mixture.0.iter().map(|(plan, share)| DrawnSea { plan: plan.clone(), weights: weights(*share) }).collect()
        };
        old.into_iter().flat_map(|old| of(old, fading)).chain(of(now, own)).collect()
    }

    /// Height of the still water that is drawn, m: on its way to the state's while the sea glides.
    pub fn level_m(&self) -> f64 {
        self.appearance.value(self.sim.share()).level_m
    }

    /// Times the passes of frames that are recorded between its `begin` and `end`; see [`Timer`].
    pub fn timer(&self) -> &Timer {
        &self.timer
    }

    /// Records copies of the maps of the frame that has been recorded; see [`Probe`].
    pub fn probe(&self, encoder: &mut wgpu::CommandEncoder) -> Option<Probe> {
        self.sim.probe(&self.gpu, encoder)
    }

    /// The simulation, for read-back.
    pub fn simulation(&mut self) -> &mut Simulation {
        &mut self.sim
    }

    /// Records one frame of `size` pixels. At most `most_steps` past times are replayed for the foam; returns whether
    /// it has caught up.
    pub fn encode(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2], most_steps: usize) -> bool {
        self.lay_waterlines();
        let scene = self.scene(size);
        let centre = [self.params.camera.x_m, self.params.camera.z_m];
        let caught_up = self.sim.encode(&self.gpu, encoder, self.params.clock.t_s, centre, most_steps);
        self.renderer.draw(&self.gpu, encoder, self.sim.maps(), &scene, size);
        caught_up
    }

    /// Records one frame whose foam is complete: a still that depends on the parameters alone.
    pub fn encode_fully(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2]) {
        self.encode(encoder, size, MAX_STEPS);
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

    /// Vertices of the mesh of the last picture.
    pub fn vertices(&self) -> u32 {
        self.renderer.vertices()
    }

    /// Records unfiltered samples of the sea as the last frame left it; see [`Reference::draw`].
    pub fn encode_samples(&mut self, encoder: &mut wgpu::CommandEncoder, grid: &Grid) -> wgpu::Texture {
        let scene = self.scene(grid.size);
        let reference = self.reference.get_or_insert_with(|| Reference::new(&self.gpu, self.format));
        reference.draw(&self.gpu, encoder, self.sim.maps(), &scene, grid)
    }

    /// Draws a picture in linear light (RGB, row by row) as the film shows it, with the exposure of the state.
    pub fn present_light(&mut self, pass: &mut wgpu::RenderPass<'_>, size: [u32; 2], light: &[[f32; 3]]) {
        let scene = self.scene(size);
        if let Some(reference) = &mut self.reference {
            reference.show(&self.gpu, &scene, size, light);
            reference.present(pass);
        }
    }

    /// What the renderer draws in `width` x `height` pixels.
    pub fn scene(&self, [width, height]: [u32; 2]) -> Scene {
        let plan = self.sim.plan();
        let share = self.sim.share();
        let (old, now) = self.appearance.parts();
        let sea = SeaAppearance { finest: now.finest, ..self.appearance.value(share) };
        let aspect = f64::from(width.max(1)) / f64::from(height.max(1));
        Scene {
            view: View::new(&above_water(&self.params.camera, sea.level_m), aspect, LOWEST_EYE_M),
            look: self.params.look.clone(),
            rides: self.params.camera.mode == CameraMode::Buoy,
            floats: self.poses(),
            scales: std::array::from_fn(|layer| Scale::new(self.params.look.view.shown, plan, layer)),
            fading: old.map(|old| Fading { finest: old.finest, share: 1.0 - share }),
            mean_foam: self.sim.foam_coverage(),
            cloud_drift_m: sea.clouds_m_s.map(|v| v * self.params.clock.t_s),
            sea,
        }
    }

    /// How what floats lies on the water at the time of the parameters; empty before the first frame with it.
    pub fn poses(&self) -> Vec<Pose> {
        let (seas, level_m) = (self.drawn_seas(), self.level_m());
        let on = |sea: &DrawnSea| self.waterlines.iter().find(|(plan, _)| Arc::ptr_eq(plan, &sea.plan)).map(|(_, w)| w);
        let lines: Option<Vec<_>> = seas.iter().map(|sea| Some((on(sea)?, sea.weights[0]))).collect();
        let Some(lines) = lines else { return Vec::new() };
        self.params.floats.iter().map(|f| afloat::pose(&lines, f, self.params.clock.t_s, level_m)).collect()
    }

    /// Keeps a waterline for every sea that is drawn while something floats.
    fn lay_waterlines(&mut self) {
        if self.params.floats.is_empty() {
            self.waterlines.clear();
            return;
        }
        let seas = self.drawn_seas();
        self.waterlines.retain(|(plan, _)| seas.iter().any(|sea| Arc::ptr_eq(plan, &sea.plan)));
        for sea in seas {
            if !self.waterlines.iter().any(|(plan, _)| Arc::ptr_eq(plan, &sea.plan)) {
                let line = Waterline::new(&sea.plan);
                self.waterlines.push((sea.plan, line));
            }
        }
    }
}

/// The camera with its height over the still water: the surface is drawn around 0, wherever its level lies in the world.
fn above_water(camera: &Camera, level_m: f64) -> Camera {
    Camera { y_m: camera.y_m - level_m, ..camera.clone() }
}
