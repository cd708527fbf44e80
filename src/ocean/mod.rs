//! The façade of the crate: [`Ocean`], a simulated sea with its picture, which window, page and command line use.

mod coast;
pub mod coast_task;
pub mod device_info;
mod hulls;
mod interpolated;
mod land;
pub mod maps;
#[cfg(feature = "files")]
pub mod maps_file;
pub mod passes;
mod reference_samples;
mod shown_coast;
pub mod still;

use crate::coast::PlacedCoast;
use crate::gpu::Gpu;
use crate::gpu::timer::Timer;
use crate::render::{FadingSea, ReferenceRenderer, Renderer, Scene, SeaAppearance};
use crate::shaders::Shaders;
use crate::sim::transition::{Interpolated, TransitionFrameProgress, TransitionKind};
use crate::sim::{MAX_FOAM_STEPS, MapCascade, Simulation};
use crate::state::Params;
use crate::state::camera::View;
use crate::state::params::CameraMode;
use crate::waves::colour_scale::ColourScale;
use crate::waves::{Plan, SeaChange};
use coast_task::{CoastKey, ShownCoast};
use hulls::DrawnHullWaves;
use interpolated::WeightedPlans;
use land::{built_in_land, relative_to_still_water};
use std::sync::Arc;

pub use crate::render::{OutputKind, SampleGrid, TimedPart};
pub use crate::sim::map_statistics::{MapStatistics, PendingMapRead};
pub use crate::sim::maps::{Maps, MapsF32};
pub use crate::waves::foam::FOAM_LEVEL_COUNT;
pub use interpolated::DrawnSea;

/// Least height of the eye above the still water, m. If waves are higher, a GPU pass raises the eye further above them.
const MIN_EYE_HEIGHT_M: f64 = 0.5;
/// How far surf moves the water near the eye, m (shaders/water/surf.wgsl).
const SURF_DISPLACEMENT_M: f64 = 3.0;

/// A simulated sea on a GPU device, with the renderer that draws it.
///
/// ```no_run
/// use seastate::gpu::Gpu;
/// use seastate::ocean::{Ocean, OutputKind};
/// use seastate::state::query;
///
/// # async fn frame() -> Result<(), String> {
/// let gpu = Gpu::request().await?;
/// let (mut params, _) = query::parse("wind=14&fetch=300");
/// let mut ocean = Ocean::new(&gpu, wgpu::TextureFormat::Rgba8Unorm, OutputKind::Screen, &params);
/// // In each frame: set the time, then record the commands, here with at most 6 time steps of the foam.
/// params.clock.t_s += 1.0 / 60.0;
/// ocean.set_params(&params);
/// let mut encoder = gpu.encoder("frame");
/// ocean.record_frame(&mut encoder, [1280, 720], 6);
/// // Here `ocean.present` draws the picture in a render pass on a target of that format.
/// gpu.submit(encoder);
/// # Ok(())
/// # }
/// ```
pub struct Ocean {
    gpu: Gpu,
    params: Params,
    /// This and the next as in [`Scene`].
    may_keep_pipelines: bool,
    is_lean: bool,
    shaders: Shaders,
    sim: Simulation,
    /// Draws the frames. None in an ocean that [`Self::without_renderer`] made, until its first frame.
    renderer: Option<Renderer>,
    reference: Option<ReferenceRenderer>,
    format: wgpu::TextureFormat,
    output: OutputKind,
    appearance: Interpolated<SeaAppearance>,
    plans: Interpolated<WeightedPlans>,
    /// The coast that [`Self::solve_coast`] solved last.
    coast_solved: Option<(CoastKey, ShownCoast)>,
    /// For each plan whose waves are drawn, those of its waves that move the floating objects.
    hull_waves: Vec<DrawnHullWaves>,
    land: Option<Arc<PlacedCoast>>,
    timer: Timer,
}

impl Ocean {
    /// Creates a sea with the given parameters, and compiles a renderer that presents to textures of `format`. `output`
    /// says whether frames can be read back.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, output: OutputKind, params: &Params) -> Self {
        Self::with_shaders(gpu, format, output, params, Shaders::default())
    }

    /// Like [`Self::new`], but with the given shaders in place of the program's own. Tests change shaders with it.
    pub fn with_shaders(
        gpu: &Gpu,
        format: wgpu::TextureFormat,
        output: OutputKind,
        params: &Params,
        shaders: Shaders,
    ) -> Self {
        let mut ocean = Self { format, output, shaders, ..Self::without_renderer(gpu, params) };
        ocean.renderer = Some(ocean.create_renderer());
        ocean
    }

    /// Allocates a sea without a renderer, to read back its maps. If a frame is drawn nevertheless, a renderer for
    /// [`still::PICTURE_FORMAT`] is compiled.
    pub fn without_renderer(gpu: &Gpu, params: &Params) -> Self {
        let shaders = Shaders::default();
        let mut sim = Simulation::new(gpu, Plan::new(params), &shaders);
        let timer = Timer::new(gpu);
        sim.set_timer(timer.clone());
        let appearance = Interpolated::new(SeaAppearance::new(sim.plan(), &params.look));
        let plans = Interpolated::new(WeightedPlans::new(sim.plan()));
        Self {
            gpu: gpu.clone(),
            params: params.clone(),
            may_keep_pipelines: false,
            is_lean: false,
            shaders,
            sim,
            renderer: None,
            reference: None,
            format: still::PICTURE_FORMAT,
            output: OutputKind::Screen,
            appearance,
            plans,
            coast_solved: None,
            hull_waves: Vec::new(),
            land: built_in_land(params),
            timer,
        }
    }

    fn create_renderer(&self) -> Renderer {
        let mut renderer = Renderer::new(&self.gpu, &self.shaders, self.format, self.output);
        renderer.set_timer(self.timer.clone());
        renderer
    }

    /// Sets the parameters, without a transition. A change of only the time, the camera or the light costs nothing;
    /// after a change of the sea, only what its kind ([`SeaChange`]) requires is computed again.
    pub fn set_params(&mut self, params: &Params) {
        let change = SeaChange::between(&self.params, params);
        if change.is_some() || self.in_transition() {
            let plan = self.plan_for(params, change);
            self.sim.set_plan(&self.gpu, plan, &self.shaders);
            self.apply_transition_step(params, &TransitionFrameProgress::IMMEDIATE);
        }
        self.store_params(params);
    }

    /// Sets the parameters for an animation, `dt_s` seconds of wall time after the previous frame: the sea changes
    /// gradually and ends exactly on the new parameters. Look, camera, time and a changed grid (any setting of
    /// [`Params::grid`]) apply at once. Call this method once per frame before [`Self::record_frame`], also while the
    /// simulated time stands still, until [`Self::in_transition`] is false.
    pub fn transition_to(&mut self, params: &Params, dt_s: f64) {
        if params.grid != self.params.grid {
            return self.set_params(params);
        }
        let change = SeaChange::between(&self.params, params);
        if change.is_some() || self.in_transition() {
            let plan = change.map(|_| self.plan_for(params, change));
            let step = self.sim.transition_to(&self.gpu, plan, &self.shaders, params.clock.t_s, dt_s);
            self.apply_transition_step(params, &step);
        }
        self.store_params(params);
    }

    /// Whether the drawn sea is still changing towards that of the parameters.
    pub fn in_transition(&self) -> bool {
        self.sim.in_transition()
    }

    /// The plan of the sea of `params`; `change` tells how that sea differs from the one set last (None: not at all).
    /// Only other waves need a new plan; else the latest plan is copied with the new surface and foam.
    fn plan_for(&self, params: &Params, change: Option<SeaChange>) -> Plan {
        match change {
            Some(SeaChange::Waves) => Plan::new(params),
            Some(SeaChange::Foam | SeaChange::Surface) | None => {
                self.sim.latest_plan().with_surface_and_foam_of(&params.sea)
            }
        }
    }

    fn apply_transition_step(&mut self, params: &Params, step: &TransitionFrameProgress) {
        let plan = self.sim.plan();
        self.appearance.apply_transition_step(step, |goal| match step.started {
            Some(TransitionKind::Foam) => goal.clone(),
            Some(TransitionKind::Surface) => goal.with_surface_of(plan),
            _ => SeaAppearance::new(plan, &params.look),
        });
        self.plans.apply_transition_step(step, |goal| match step.started {
            Some(TransitionKind::Foam) => goal.clone(),
            _ => WeightedPlans::new(plan),
        });
    }

    fn store_params(&mut self, params: &Params) {
        if !interpolated::has_same_refraction(params, &self.params) {
            let caustic_filter_m = SeaAppearance::caustic_filter_m(self.sim.plan(), &params.look);
            self.appearance.change_all(|sea| sea.caustic_filter_m = caustic_filter_m);
        }
        self.place_land(params);
        self.params = params.clone();
    }

    /// Sets [`Scene::may_keep_pipelines`] of the frames from now on. A new ocean waits for its pipelines.
    pub fn set_may_keep_pipelines(&mut self, may: bool) {
        self.may_keep_pipelines = may;
    }

    /// Whether frames from now on have the light of the lean tier. A new ocean has full detail, so has every reference.
    pub fn set_lean(&mut self, is_lean: bool) {
        self.is_lean = is_lean;
    }

    /// The GPU device, with its queue, on which this ocean is simulated and drawn.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The plan of the sea (its waves, divided among cascades); during a transition, of the sea that it leads to.
    pub fn plan(&self) -> &Plan {
        self.sim.plan()
    }

    /// The plans whose waves are drawn at this moment. The height of a water particle above
    /// [`Self::still_water_level_m`] (and its displacement, slope and velocity) is the sum over these plans, each
    /// cascade times its amplitude factor. Outside transitions there is one plan, with factors of 1. While a slider is
    /// dragged, similar plans are merged.
    pub fn drawn_seas(&self) -> Vec<DrawnSea> {
        let maps = self.sim.maps();
        let (fading, own) = maps.cascades.split_at(maps.fading_cascade_count);
        let (old, now) = self.plans.fading_and_current();
        let of = |plans: &WeightedPlans, cascades| -> Vec<DrawnSea> {
            let factors = || MapCascade::ordinary(cascades).map(|c| f64::from(c.cross_fade_amplitude_factor));
            let weights = |share: f64| factors().map(|factor| share * factor).collect();
            plans
                .0
                .iter()
                .map(|(plan, share)| DrawnSea { plan: plan.clone(), amplitude_factors: weights(*share) })
                .collect()
        };
        old.into_iter().flat_map(|old| of(old, fading)).chain(of(now, own)).collect()
    }

    /// World height of the still water that is drawn, m; during a transition it moves towards that of the parameters.
    pub fn still_water_level_m(&self) -> f64 {
        self.appearance.cross_faded_value(self.sim.cross_fade_weight()).still_water_level_m
    }

    /// The timer that measures the GPU times of the parts of a frame; the passes of simulation and renderer write to it.
    pub fn timer(&self) -> &Timer {
        &self.timer
    }

    /// Records copies of the displacement, gradient and foam maps as the commands recorded before leave them; the
    /// returned value reads them on the CPU. During a transition it records nothing and returns None.
    pub fn record_map_copies(&self, encoder: &mut wgpu::CommandEncoder) -> Option<PendingMapRead> {
        self.sim.record_map_copies(&self.gpu, encoder)
    }

    /// The GPU textures of the wave and foam maps; they hold the maps of the last recorded frame once its commands ran.
    pub fn maps(&self) -> &Maps {
        self.sim.maps()
    }

    /// The GPU simulation of waves and foam behind this ocean, for measurements and tests.
    pub fn simulation(&mut self) -> &mut Simulation {
        &mut self.sim
    }

    /// Records one frame of `size` (width, height) pixels, with at most `max_foam_steps` time steps of the foam;
    /// missing steps follow in later frames. Returns whether the foam has reached the time of the parameters.
    pub fn record_frame(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2], max_foam_steps: usize) -> bool {
        self.select_hull_waves();
        let scene = self.scene(size);
        let caught_up = self.encode_waves(encoder, max_foam_steps);
        if self.renderer.is_none() {
            self.renderer = Some(self.create_renderer());
        }
        let Some(renderer) = &mut self.renderer else { return caught_up };
        renderer.draw(&self.gpu, encoder, self.sim.maps(), &scene, size);
        caught_up
    }

    /// Records one frame, with all foam time steps up to its time: a still picture that depends only on the parameters.
    pub fn record_frame_with_complete_foam(&mut self, encoder: &mut wgpu::CommandEncoder, size: [u32; 2]) {
        self.record_frame(encoder, size, MAX_FOAM_STEPS);
    }

    /// Records the wave maps at the time of the parameters, and at most `max_foam_steps` time steps of the foam.
    /// Returns whether the foam has reached that time.
    fn encode_waves(&mut self, encoder: &mut wgpu::CommandEncoder, max_foam_steps: usize) -> bool {
        let centre = [self.params.camera.x_m, self.params.camera.z_m];
        self.sim.encode(&self.gpu, encoder, self.params.clock.t_s, centre, max_foam_steps)
    }

    /// Texture with the linear light (before exposure) of the last recorded frame; None before the first frame.
    pub fn lit_picture_texture(&self) -> Option<&wgpu::Texture> {
        self.renderer.as_ref().and_then(Renderer::light_texture)
    }

    /// Depth texture of the last recorded frame, None before the first; [`Renderer::depth_texture`] tells its contents.
    pub fn depth_texture(&self) -> Option<&wgpu::Texture> {
        self.renderer.as_ref().and_then(Renderer::depth_texture)
    }

    /// Draws the last recorded frame into the viewport of `pass`; nothing before the first frame.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(renderer) = &self.renderer {
            renderer.present(pass);
        }
    }

    /// All that determines a picture of `width` x `height` pixels with the present parameters, besides the maps:
    /// camera, look, sea properties and floating objects.
    pub fn scene(&self, [width, height]: [u32; 2]) -> Scene {
        let plan = self.sim.plan();
        let share = self.sim.cross_fade_weight();
        let (old, now) = self.appearance.fading_and_current();
        let has_coast = self.sim.maps().coast.is_some();
        let sea = SeaAppearance {
            surf_displacement_m: if has_coast { SURF_DISPLACEMENT_M } else { 0.0 },
            finest_cascade_slope_variance: now.finest_cascade_slope_variance,
            ..self.appearance.cross_faded_value(share)
        };
        let aspect = f64::from(width.max(1)) / f64::from(height.max(1));
        let camera = relative_to_still_water(&self.params.camera, &sea, self.land.as_deref());
        Scene {
            view: View::new(&camera, aspect, MIN_EYE_HEIGHT_M),
            look: self.params.look.at_time(self.params.clock.t_s),
            height_from_waves: self.params.camera.mode == CameraMode::Buoy,
            hulls: self.hull_poses(),
            land: self.land.clone(),
            colour_scales: std::array::from_fn(|layer| ColourScale::new(self.params.look.view.displayed, plan, layer)),
            fading_sea: old.map(|old| FadingSea {
                finest_cascade_slope_variance: old.finest_cascade_slope_variance,
                variance_fraction: 1.0 - share,
            }),
            mean_foam: self.sim.mean_foam(),
            has_coast,
            may_keep_pipelines: self.may_keep_pipelines,
            is_lean: self.is_lean,
            t_s: self.params.clock.t_s,
            cloud_drift_m: sea.cloud_velocity_m_s.map(|v| v * self.params.clock.t_s),
            sea,
        }
    }
}
