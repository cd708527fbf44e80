//! The façade of the crate: [`Ocean`], a simulated sea with its picture, which window, page and command line use.

pub mod about;
mod interpolated;
pub mod maps;
#[cfg(feature = "files")]
pub mod maps_file;
pub mod passes;
pub mod still;

use crate::gpu::Gpu;
use crate::gpu::timer::Timer;
use crate::point::floating::{HullPose, HullWaves, hull_pose};
use crate::render::{Fading, Reference, Renderer, Scene, SeaAppearance};
use crate::shaders::Shaders;
use crate::sim::transition::{Interpolated, TransitionKind, TransitionStep};
use crate::sim::{MAX_STEPS, MapCascade, Simulation};
use crate::state::Params;
use crate::state::camera::View;
use crate::state::params::{Camera, CameraMode};
use crate::waves::colour_scale::ColourScale;
use crate::waves::{Plan, SeaChange};
use interpolated::WeightedPlans;
use std::sync::Arc;

pub use crate::render::{Film, Grid, Part};
pub use crate::sim::maps::{FOAM_LEVELS, Maps, MapsF32};
pub use crate::sim::probe::{Probe, Probed};
pub use interpolated::DrawnSea;

/// Least height of the eye above the still water, m. The picture raises the eye further above approaching waves.
const LOWEST_EYE_M: f64 = 0.5;

/// A simulated sea on a GPU device, with the renderer that draws it.
///
/// ```no_run
/// use seastate::gpu::Gpu;
/// use seastate::ocean::{Film, Ocean};
/// use seastate::state::query;
///
/// # async fn frame() -> Result<(), String> {
/// let gpu = Gpu::request().await?;
/// let (mut params, _) = query::parse("wind=14&fetch=300");
/// let mut ocean = Ocean::new(&gpu, wgpu::TextureFormat::Rgba8Unorm, Film::Screen, &params);
/// // In each frame: set the time, then record the commands.
/// params.clock.t_s += 1.0 / 60.0;
/// ocean.set_params(&params);
/// let mut encoder = gpu.encoder("frame");
/// ocean.encode(&mut encoder, [1280, 720], 6);
/// // Here `ocean.present` draws the picture in a render pass on a target of that format.
/// gpu.submit(encoder);
/// # Ok(())
/// # }
/// ```
pub struct Ocean {
    gpu: Gpu,
    params: Params,
    shaders: Shaders,
    sim: Simulation,
    /// None in an ocean that [`Self::waves_only`] made, until its first frame.
    renderer: Option<Renderer>,
    reference: Option<Reference>,
    format: wgpu::TextureFormat,
    film: Film,
    appearance: Interpolated<SeaAppearance>,
    plans: Interpolated<WeightedPlans>,
    /// Waves that move the floating objects, for each drawn plan.
    waterlines: Vec<(Arc<Plan>, HullWaves)>,
    timer: Timer,
}

impl Ocean {
    /// Allocates a sea, and compiles its renderer for targets of `format`. `film` says whether frames can be read back.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, film: Film, params: &Params) -> Self {
        let mut ocean = Self::waves_only(gpu, params);
        (ocean.format, ocean.film) = (format, film);
        ocean.renderer = Some(renderer(gpu, format, film, &ocean.timer));
        ocean
    }

    /// Allocates a sea without a renderer, to read back its maps. If a frame is drawn nevertheless, a renderer for
    /// [`still::FORMAT`] is compiled.
    pub fn waves_only(gpu: &Gpu, params: &Params) -> Self {
        let shaders = Shaders::default();
        let mut sim = Simulation::new(gpu, Plan::new(params), &shaders);
        let timer = Timer::new(gpu);
        sim.set_timer(timer.clone());
        let appearance = Interpolated::new(SeaAppearance::new(sim.plan(), &params.look));
        let plans = Interpolated::new(WeightedPlans::new(sim.plan()));
        Self {
            gpu: gpu.clone(),
            params: params.clone(),
            shaders,
            sim,
            renderer: None,
            reference: None,
            format: still::FORMAT,
            film: Film::Screen,
            appearance,
            plans,
            waterlines: Vec::new(),
            timer,
        }
    }

    /// Applies parameters at once. A change of only the time, the camera or the light costs nothing; a change of the
    /// sea costs what its level ([`SeaChange`]) needs.
    pub fn set_params(&mut self, params: &Params) {
        let change = SeaChange::between(&self.params, params);
        if change.is_some() || self.in_transition() {
            let plan = self.plan_of(params, change);
            self.sim.set_plan(&self.gpu, plan, &self.shaders);
            self.follow(params, &TransitionStep::IMMEDIATE);
        }
        self.take(params);
    }

    /// Applies parameters as a window does, `dt_s` seconds of wall time after the previous frame: the sea makes a
    /// transition and ends exactly on the new parameters. Look, camera, time and a changed grid apply at once. Call it
    /// once per frame before [`Self::encode`], and go on while [`Self::in_transition`], even if time stands still.
    pub fn transition_to(&mut self, params: &Params, dt_s: f64) {
        if params.grid != self.params.grid {
            return self.set_params(params);
        }
        let change = SeaChange::between(&self.params, params);
        if change.is_some() || self.in_transition() {
            let plan = change.map(|_| self.plan_of(params, change));
            let step = self.sim.transition_to(&self.gpu, plan, &self.shaders, params.clock.t_s, dt_s);
            self.follow(params, &step);
        }
        self.take(params);
    }

    /// Whether a transition to the parameters is under way.
    pub fn in_transition(&self) -> bool {
        self.sim.in_transition()
    }

    /// The plan for new parameters. `change` is the level in which their sea differs from the present one.
    fn plan_of(&self, params: &Params, change: Option<SeaChange>) -> Plan {
        match change {
            Some(SeaChange::Waves) => Plan::new(params),
            Some(SeaChange::Foam | SeaChange::Surface) | None => self.sim.goal().with_surface_and_foam_of(&params.sea),
        }
    }

    fn follow(&mut self, params: &Params, step: &TransitionStep) {
        let plan = self.sim.plan();
        self.appearance.follow(step, |goal| match step.start {
            Some(TransitionKind::Foam) => goal.clone(),
            Some(TransitionKind::Surface) => goal.with_surface(plan),
            _ => SeaAppearance::new(plan, &params.look),
        });
        self.plans.follow(step, |goal| match step.start {
            Some(TransitionKind::Foam) => goal.clone(),
            _ => WeightedPlans::new(plan),
        });
    }

    fn take(&mut self, params: &Params) {
        if !interpolated::refracts_alike(params, &self.params) {
            let focusing_m = SeaAppearance::focusing_m(self.sim.plan(), &params.look);
            self.appearance.change(|sea| sea.focusing_m = focusing_m);
        }
        self.params = params.clone();
    }

    /// The GPU device and its queue.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The plan of the sea; during a transition, of the sea that it leads to.
    pub fn plan(&self) -> &Plan {
        self.sim.plan()
    }

    /// The plans that are drawn at this moment. The height of a water particle above [`Self::level_m`] (and its
    /// displacement, slope and velocity) is the sum over these plans, each cascade times its weight. Outside
    /// transitions there is one plan with weights of 1. While a slider is dragged, plans of neighbouring frames merge.
    pub fn drawn_seas(&self) -> Vec<DrawnSea> {
        let maps = self.sim.maps();
        let (fading, own) = maps.cascades.split_at(maps.fading);
        let (old, now) = self.plans.parts();
        let of = |plans: &WeightedPlans, cascades: &[MapCascade]| -> Vec<DrawnSea> {
            let weights = |share: f64| cascades.iter().map(|c| share * f64::from(c.weight)).collect();
            plans.0.iter().map(|(plan, share)| DrawnSea { plan: plan.clone(), weights: weights(*share) }).collect()
        };
        old.into_iter().flat_map(|old| of(old, fading)).chain(of(now, own)).collect()
    }

    /// Height of the still water that is drawn, m; during a transition it moves towards that of the parameters.
    pub fn level_m(&self) -> f64 {
        self.appearance.value(self.sim.share()).level_m
    }

    /// The timer that measures the GPU time of the passes.
    pub fn timer(&self) -> &Timer {
        &self.timer
    }

    /// Records copies of the maps of the recorded frame, for measurements on them. None during a transition.
    pub fn probe(&self, encoder: &mut wgpu::CommandEncoder) -> Option<Probe> {
        self.sim.probe(&self.gpu, encoder)
    }

    /// The wave and foam maps, as computed by the last recorded evaluation of the sea.
    pub fn maps(&self) -> &Maps {
        self.sim.maps()
    }

    /// The simulation, for measurements and tests.
    pub fn simulation(&mut self) -> &mut Simulation {
        &mut self.sim
    }

    /// Records one frame of `size` (width, height) pixels, with at most `most_steps` time steps of the foam. Returns
    /// whether the foam has reached the time of the parameters.
    pub fn encode(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2], most_steps: usize) -> bool {
        self.lay_waterlines();
        let scene = self.scene(size);
        let caught_up = self.encode_waves(encoder, most_steps);
        let renderer = self.renderer.get_or_insert_with(|| renderer(&self.gpu, self.format, self.film, &self.timer));
        renderer.draw(&self.gpu, encoder, self.sim.maps(), &scene, size);
        caught_up
    }

    /// Records one frame with complete foam: a still picture that depends on the parameters alone.
    pub fn encode_fully(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2]) {
        self.encode(encoder, size, MAX_STEPS);
    }

    /// Records the maps and the foam of a frame. Returns whether the foam has reached the time of the parameters.
    fn encode_waves(&mut self, encoder: &mut wgpu::CommandEncoder, most_steps: usize) -> bool {
        let centre = [self.params.camera.x_m, self.params.camera.z_m];
        self.sim.encode(&self.gpu, encoder, self.params.clock.t_s, centre, most_steps)
    }

    /// Texture with the linear light of the recorded frame in half floats; None before the first frame.
    pub fn light(&self) -> Option<&wgpu::Texture> {
        self.renderer.as_ref().and_then(Renderer::light)
    }

    /// Depth texture of the recorded frame; see [`Renderer::depth`].
    pub fn depth(&self) -> Option<&wgpu::Texture> {
        self.renderer.as_ref().and_then(Renderer::depth)
    }

    /// Draws the recorded frame into the viewport of a render pass.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(renderer) = &self.renderer {
            renderer.present(pass);
        }
    }

    /// Records one part of the last frame alone, so that its GPU time can be measured.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, part: Part) {
        if let Some(renderer) = &self.renderer {
            renderer.record(encoder, part);
        }
    }

    /// Number of vertices of the water mesh in the last frame.
    pub fn vertices(&self) -> u32 {
        self.renderer.as_ref().map_or(0, Renderer::vertices)
    }

    /// Records one grid of unfiltered samples for a reference of the last frame; see [`Reference::draw`].
    pub fn encode_samples(&mut self, encoder: &mut wgpu::CommandEncoder, grid: &Grid) -> wgpu::Texture {
        let scene = self.scene(grid.size);
        let reference = self.reference.get_or_insert_with(|| Reference::new(&self.gpu, self.format));
        reference.draw(&self.gpu, encoder, self.sim.maps(), &scene, grid)
    }

    /// Draws a picture given as linear light (RGB, row by row), with the exposure and tone curve of the parameters.
    pub fn present_light(&mut self, pass: &mut wgpu::RenderPass<'_>, size: [u32; 2], light: &[[f32; 3]]) {
        let scene = self.scene(size);
        if let Some(reference) = &mut self.reference {
            reference.show(&self.gpu, &scene, size, light);
            reference.present(pass);
        }
    }

    /// The scene that the renderer draws in a picture of `width` x `height` pixels.
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
            scales: std::array::from_fn(|layer| ColourScale::new(self.params.look.view.displayed, plan, layer)),
            fading: old.map(|old| Fading { finest: old.finest, share: 1.0 - share }),
            mean_foam: self.sim.foam_coverage(),
            cloud_drift_m: sea.clouds_m_s.map(|v| v * self.params.clock.t_s),
            sea,
        }
    }

    /// Poses of the floating objects at the time of the parameters; empty until a frame with them was recorded.
    pub fn poses(&self) -> Vec<HullPose> {
        let (seas, level_m) = (self.drawn_seas(), self.level_m());
        let on = |sea: &DrawnSea| self.waterlines.iter().find(|(plan, _)| Arc::ptr_eq(plan, &sea.plan)).map(|(_, w)| w);
        let lines: Option<Vec<_>> = seas.iter().map(|sea| Some((on(sea)?, sea.weights[0]))).collect();
        let Some(lines) = lines else { return Vec::new() };
        self.params.floats.iter().map(|f| hull_pose(&lines, f, self.params.clock.t_s, level_m)).collect()
    }

    /// Selects the waves that move the floating objects, for each drawn plan; removes them if nothing floats.
    fn lay_waterlines(&mut self) {
        if self.params.floats.is_empty() {
            self.waterlines.clear();
            return;
        }
        let seas = self.drawn_seas();
        self.waterlines.retain(|(plan, _)| seas.iter().any(|sea| Arc::ptr_eq(plan, &sea.plan)));
        for sea in seas {
            if !self.waterlines.iter().any(|(plan, _)| Arc::ptr_eq(plan, &sea.plan)) {
                let line = HullWaves::new(&sea.plan);
                self.waterlines.push((sea.plan, line));
            }
        }
    }
}

/// The camera with its height relative to the still water, because the surface is drawn around height 0.
fn above_water(camera: &Camera, level_m: f64) -> Camera {
    Camera { y_m: camera.y_m - level_m, ..camera.clone() }
}

fn renderer(gpu: &Gpu, format: wgpu::TextureFormat, film: Film, timer: &Timer) -> Renderer {
    let mut renderer = Renderer::new(gpu, format, film);
    renderer.set_timer(timer.clone());
    renderer
}
