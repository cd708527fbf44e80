//! The sea on the GPU: buffers, compute passes, and the order in which they run.
//!
//! Every frame runs a row pass and a column pass, which are the FFT of the waves of all cascades, then the mip levels,
//! then one time step of the foam. The spectrum pass runs only when the waves change. [`Maps`] is the read-only result.
//! During a cross-fade (`transition`) two seas are evaluated one after the other into different layers of the maps. With a
//! `coast`, some of the waves have layers of their own.

mod bound_waves;
mod change;
pub mod coast;
pub mod foam;
pub mod map_statistics;
pub mod maps;
pub mod passes;
pub mod planned_sea;
pub mod resources;
pub mod transform;
pub mod transition;
pub mod uniforms;

pub use maps::{CascadeRole, FoamLevel, MapCascade, MapCoast, Maps, MapsF32};

use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::waves::Plan;
use crate::waves::overlap::SeaCovariance;
use foam::{FoamParameters, FoamScheduler, FoamStep};
use map_statistics::with_offshore_waves;
use passes::Passes;
use planned_sea::{SeaDispatch, SeaUniformParameters, SeaUniformSource};
use resources::Resources;
use transform::FftImplementation;
use transition::{Interpolated, Transition};
use uniforms::SimulationUniforms;

/// Largest number of foam time steps in one submission to the GPU.
pub const MAX_FOAM_STEPS: usize = foam::COLD_START_STEPS;

/// A sea that is simulated on the GPU: its plan (the waves, divided among cascades), GPU buffers, compute passes, and
/// the maps that these write.
pub struct Simulation {
    sea: SeaUniformSource,
    /// Old sea of a cross-fade: its plan, and its spectrum in the form that shaders read. None without a cross-fade.
    fading: Option<SeaUniformSource>,
    /// Plan that waits for the end of the current cross-fade, when a cross-fade to it starts. None if no plan waits.
    next: Option<Plan>,
    transition: Transition,
    /// Variances and covariance of the surface elevation of both seas of a cross-fade, per drawn cascade; else empty.
    overlaps: Vec<SeaCovariance>,
    /// GPU buffers and textures. Public, so that the checks in `lab` and the tests can replace the input of a pass.
    pub resources: Resources,
    /// Compute passes. Public, so that the checks in `lab` and the tests can run each pass alone.
    pub passes: Passes,
    maps: Maps,
    uniforms: SimulationUniforms,
    foam: FoamScheduler,
    foam_parameters: Interpolated<FoamParameters>,
    /// Fraction of the way that the next spectrum pass moves the Fourier amplitudes h0 in their buffer towards those of
    /// the plan: 1 replaces them; with 0 the pass is left out.
    spectrum_blend: f64,
    /// Whether the amplitudes h0 are to be parted for a coast anew, though the spectrum pass is left out.
    needs_split: bool,
    /// Whether the foam is computed anew when the running transition ends.
    restarts_foam: bool,
    spectrum_pass_count: u64,
    timer: Timer,
}

impl Simulation {
    /// Allocates GPU memory for the sea of a plan and compiles the passes. Chooses the FFT that is faster on the
    /// device: one for GPUs, or one for software adapters.
    pub fn new(gpu: &Gpu, plan: Plan, shaders: &Shaders) -> Self {
        Self::with_fft_implementation(gpu, plan, shaders, FftImplementation::for_device(gpu))
    }

    /// Allocates GPU memory for the sea of a plan and compiles the passes, with the given implementation of the FFT.
    pub fn with_fft_implementation(
        gpu: &Gpu,
        plan: Plan,
        shaders: &Shaders,
        implementation: FftImplementation,
    ) -> Self {
        let mut resources = Resources::new(gpu, &plan, shaders.map_format(gpu));
        resources.upload_wave_tables(gpu, &plan);
        let uniforms = SimulationUniforms::new(gpu, MAX_FOAM_STEPS);
        let passes = Passes::new(gpu, shaders, implementation, &resources, &uniforms);
        let maps = Maps::new(&plan, &resources);
        let parameters = FoamParameters::new(resources.foam_n, &plan);
        let foam = FoamScheduler::new(resources.foam_n, parameters.clone());
        Self {
            sea: SeaUniformSource::new(plan),
            fading: None,
            next: None,
            transition: Transition::default(),
            overlaps: Vec::new(),
            resources,
            passes,
            maps,
            uniforms,
            foam,
            foam_parameters: Interpolated::new(parameters),
            spectrum_blend: 1.0,
            needs_split: false,
            restarts_foam: false,
            spectrum_pass_count: 0,
            timer: Timer::default(),
        }
    }

    /// Sets the timer that measures the GPU times of the passes "spectrum", "rows", "columns", "coast", "mips" and "foam".
    pub fn set_timer(&mut self, timer: Timer) {
        self.timer = timer;
    }

    /// Whether a transition between two seas is running, or a plan is waiting for the end of one.
    pub fn in_transition(&self) -> bool {
        self.transition.is_running() || self.next.is_some()
    }

    /// Weight of the current sea in a cross-fade: its fraction of the sum of both seas' elevation variances; else 1.
    pub fn cross_fade_weight(&self) -> f64 {
        self.transition.cross_fade_weight()
    }

    /// Number of spectrum passes (computations of the Fourier amplitudes h0 at time 0) that have been recorded so far.
    pub fn spectrum_pass_count(&self) -> u64 {
        self.spectrum_pass_count
    }

    /// Expected mean of the foam over the sea, 0 (no foam) to 1 (all covered). The renderer draws this mean outside the
    /// square that the foam levels cover.
    pub fn mean_foam(&self) -> f64 {
        self.foam.parameters().mean_foam
    }

    /// Plan (waves, divided among cascades) of the current sea: during a transition, of the sea at which it ends.
    pub fn plan(&self) -> &Plan {
        &self.sea.plan
    }

    /// Plan that was set last: the plan of the current sea or, if one waits for the end of a cross-fade, that one.
    pub fn latest_plan(&self) -> &Plan {
        self.next.as_ref().unwrap_or(&self.sea.plan)
    }

    /// Maps of the waves and the foam, the result of the simulation. The most recently recorded passes write them.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }

    /// Records the compute passes for the waves at time `t_s`, s, and for the foam around the world position `centre`
    /// (x, z), m, with at most `max_foam_steps` foam time steps. Returns whether the foam has reached `t_s`; if not,
    /// call again. The waves are at `t_s` in any case.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
        max_foam_steps: usize,
    ) -> bool {
        let steps = self.foam.steps_to(t_s, centre, max_foam_steps.min(MAX_FOAM_STEPS));
        self.begin_submission(encoder, t_s);
        for step in &steps {
            self.encode_foam_step(encoder, step, centre);
        }
        let caught_up = self.foam.has_reached(t_s);
        if steps.is_empty() || !caught_up {
            self.encode_waves(encoder, t_s, false);
        }
        self.uniforms.upload(gpu);
        caught_up
    }

    /// Records the next single time step of the foam around the world position `centre` (x, z), m, towards time `t_s`,
    /// s, and returns the step; None if the foam has reached `t_s`. The wave maps are then those of the step's end, so
    /// that `seastate check` can compare foam and waves.
    pub fn encode_next_foam_step(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
    ) -> Option<FoamStep> {
        let step = self.foam.steps_to(t_s, centre, 1).into_iter().next()?;
        self.begin_submission(encoder, t_s);
        self.encode_foam_step(encoder, &step, centre);
        self.uniforms.upload(gpu);
        Some(step)
    }

    /// Records the passes that compute the maps at time `t_s`, s. They also write the maps as f32, before these are
    /// rounded to the half floats of the textures, to the buffer `Resources::row_transforms`: for each cascade the
    /// displacement map, then the gradient map. In a cross-fade, only those of the new sea are written.
    pub fn encode_with_f32_maps(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.begin_submission(encoder, t_s);
        self.encode_waves(encoder, t_s, true);
        self.uniforms.upload(gpu);
    }

    /// Computes the maps at time `t_s`, s, and reads back the current sea's, as f32 before rounding for textures. They are
    /// those of the open sea, also if it runs up to a coast.
    ///
    /// # Errors
    /// If mapping the read-back buffer fails.
    pub async fn read_maps_f32(&mut self, gpu: &Gpu, t_s: f64) -> Result<MapsF32, String> {
        let offshore = if self.sea.has_coast { self.read_offshore_f32(gpu, t_s).await? } else { Vec::new() };
        let mut encoder = gpu.encoder("read maps");
        self.encode_with_f32_maps(gpu, &mut encoder, t_s);
        let staging = readback::stage_buffer(gpu, &mut encoder, &self.resources.row_transforms);
        gpu.submit(encoder);
        let bytes = readback::read(gpu, staging).await?;
        let n = self.plan().n as usize;
        let mut texels = bytemuck::pod_collect_to_vec(&bytes);
        // The buffer is larger if it has been allocated for a cross-fade.
        texels.truncate(2 * n * n * self.plan().cascades.len());
        texels.extend(offshore);
        Ok(MapsF32 { n, texels: with_offshore_waves(texels, 2 * n * n, self.plan().cascades.len()) })
    }

    /// Reads back the maps, displacement and then gradients, of the waves that a coast transforms in the open sea, in f32.
    async fn read_offshore_f32(&mut self, gpu: &Gpu, t_s: f64) -> Result<Vec<[f32; 4]>, String> {
        let mut encoder = gpu.encoder("read maps");
        self.begin_submission(&mut encoder, t_s);
        let parameters = SeaUniformParameters { t_s, keeps_f32_maps: true, spectrum_blend: 1.0 };
        if let (_, Some(offshore)) = self.add_sea_uniforms(parameters, false) {
            self.encode_transform(&mut encoder, offshore);
        }
        let staging = readback::stage_buffer(gpu, &mut encoder, &self.resources.row_transforms);
        self.uniforms.upload(gpu);
        gpu.submit(encoder);
        let mut texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&readback::read(gpu, staging).await?);
        texels.truncate(2 * (self.resources.n * self.resources.n) as usize);
        Ok(texels)
    }

    /// Uploads the uniform for the current sea's waves at time `t_s`, s, so that passes can be run alone. With
    /// `keeps_f32_maps`, the column pass also keeps the maps in f32. Returns where uniform, wave buffers and map layers
    /// are.
    pub fn upload_sea_uniform(&mut self, gpu: &Gpu, t_s: f64, keeps_f32_maps: bool) -> SeaDispatch {
        self.uniforms.sea.clear();
        let parameters = SeaUniformParameters { t_s, keeps_f32_maps, spectrum_blend: 1.0 };
        let (dispatch, _) = self.add_sea_uniforms(parameters, false);
        self.uniforms.sea.upload(gpu);
        dispatch
    }

    /// Uploads the uniform of a foam time step at time `t_s`, s, of length 0, around the world position `centre` (x,
    /// z), m, so that the foam pass can be run alone. Returns the dynamic offset of the uniform in its buffer, bytes.
    pub fn upload_foam_uniform(&mut self, gpu: &Gpu, t_s: f64, centre: [f64; 2]) -> u32 {
        self.uniforms.foam.clear();
        let step = FoamStep { t_s, dt_s: 0.0, discards_history: false };
        let offset = self.uniforms.foam.add(&self.foam.uniform(&step, centre, &self.maps));
        self.uniforms.foam.upload(gpu);
        offset
    }

    /// Starts recording commands for one submission: discards the uniforms of the previous submission, and records the
    /// spectrum pass (Fourier amplitudes h0) if the waves have changed.
    fn begin_submission(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.uniforms.clear();
        if self.spectrum_blend > 0.0 {
            let (dispatch, _) = self.add_sea_uniforms(
                SeaUniformParameters { t_s, keeps_f32_maps: false, spectrum_blend: self.spectrum_blend },
                false,
            );
            self.passes.spectrum.run(encoder, &self.timer, &self.resources, dispatch);
            self.spectrum_blend = 0.0;
            self.spectrum_pass_count += 1;
            self.needs_split = true;
        }
        if std::mem::take(&mut self.needs_split)
            && let Some(coast) = &self.passes.coast
        {
            let index = self.resources.current_wave_buffers_index;
            coast.record_split(encoder, &self.timer, &self.resources, index);
        }
    }

    /// Records the wave passes for the time at the end of a foam time step, and then the foam pass for this step, with
    /// the foam levels around the world position `centre` (x, z), m.
    fn encode_foam_step(&mut self, encoder: &mut wgpu::CommandEncoder, step: &FoamStep, centre: [f64; 2]) {
        let dispatch = self.encode_waves(encoder, step.t_s, false);
        let foam = self.uniforms.foam.add(&self.foam.uniform(step, centre, &self.maps));
        self.passes.foam.run(encoder, &self.timer, &self.resources, dispatch, foam);
        self.maps.foam_levels = self.foam.levels(centre);
    }

    /// Records the passes that write the maps of all drawn cascades at time `t_s`, s, first those of the old sea of a
    /// cross-fade. Returns where uniform, wave buffers and map layers of the current sea are, for the foam pass.
    fn encode_waves(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64, keeps_f32_maps: bool) -> SeaDispatch {
        let parameters = SeaUniformParameters { t_s, keeps_f32_maps, spectrum_blend: 1.0 };
        if self.fading.is_some() {
            self.encode_wave_passes(encoder, parameters, true);
        }
        self.maps.period_fraction_u32 = self.sea.plan.period_fraction_u32(t_s);
        self.encode_wave_passes(encoder, parameters, false)
    }

    fn encode_wave_passes(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        parameters: SeaUniformParameters,
        fades: bool,
    ) -> SeaDispatch {
        let (dispatch, offshore) = self.add_sea_uniforms(parameters, fades);
        if let Some(offshore) = offshore {
            self.encode_transform(encoder, offshore);
        }
        self.encode_transform(encoder, dispatch);
        if let (Some(coast), Some(_)) = (&self.passes.coast, offshore) {
            coast.record(encoder, &self.timer, &self.resources, dispatch);
        }
        self.passes.mips.run(encoder, &self.timer, &self.resources, dispatch);
        dispatch
    }

    fn encode_transform(&self, encoder: &mut wgpu::CommandEncoder, dispatch: SeaDispatch) {
        self.passes.transform.record_rows(encoder, &self.timer, dispatch);
        self.passes.transform.record_columns(encoder, &self.timer, &self.resources, dispatch);
    }

    /// Adds the uniform that describes one sea's waves at one time to the buffer `uniforms.sea`: those of the current
    /// sea or, if `fades`, of a cross-fade's old sea. Returns its offset there, and the sea's wave buffers and map
    /// layers; with a coast, also those for the waves that it transforms.
    fn add_sea_uniforms(
        &mut self,
        parameters: SeaUniformParameters,
        fades: bool,
    ) -> (SeaDispatch, Option<SeaDispatch>) {
        let (fading, own) = self.maps.cascades.split_at(self.maps.fading_cascade_count);
        let current = self.resources.current_wave_buffers_index;
        let (sea, maps, waves) = match &self.fading {
            Some(sea) if fades => (sea, fading, 1 - current),
            _ => (&self.sea, own, current),
        };
        let uniform = sea.uniform(maps, self.foam.parameters().choppiness, parameters);
        let all = SeaDispatch {
            uniform_offset: self.uniforms.sea.add(&uniform),
            cascade_count: uniform.cascade_count,
            layer_count: maps.len() as u32,
            wave_buffers_index: waves,
            is_offshore: false,
            first_layer: uniform.first_layer,
            keeps_f32_maps: parameters.keeps_f32_maps,
        };
        let offshore = sea.has_coast.then(|| {
            let uniform = sea.offshore_uniform(&uniform);
            SeaDispatch {
                uniform_offset: self.uniforms.sea.add(&uniform),
                cascade_count: uniform.cascade_count,
                is_offshore: true,
                first_layer: uniform.first_layer,
                ..all
            }
        });
        (all, offshore)
    }
}
