//! The sea on the GPU: what is computed, when, and what comes out.
//!
//! A frame is two dispatches for the waves of all cascades (rows, columns), one or two for the mips, and one for the foam
//! (more where barriers are dear); the spectrum pass runs only when the sea changed. [`Maps`] is the read-only product. While
//! one sea fades into another (`glide`) both are evaluated, one after the other, and their maps lie in one another's layers.

pub mod foam;
pub mod glide;
pub mod maps;
pub mod passes;
pub mod probe;
pub mod resources;
mod sea;
pub mod uniforms;

pub use glide::{Moved, Turn};
pub use maps::{FoamLevel, MapCascade, Maps};

use crate::gpu::Gpu;
use crate::gpu::kit::UniformRing;
use crate::gpu::readback;
use crate::gpu::timer::Timer;
use crate::shaders::Shaders;
use crate::waves::Plan;
use crate::waves::overlap::Overlap;
use foam::FoamClock;
use glide::{Drawn, Glide};
use passes::{Passes, Step};
use resources::Resources;
use sea::{Evaluation, Sea};
use uniforms::{FoamUniform, SeaUniform};

/// Evaluations of the sea with foam that one submission may hold.
pub const MAX_STEPS: usize = foam::REPLAY_STEPS;
/// Uniforms of a submission: of those and one without foam, for two seas, and the spectrum's.
const SEA_SLOTS: usize = 2 * (MAX_STEPS + 1) + 1;

/// A sea on a device.
pub struct Simulation {
    sea: Sea,
    /// The sea that it came from, while that fades.
    fading: Option<Sea>,
    /// A sea that has to wait until then.
    next: Option<Plan>,
    glide: Glide,
    /// What the two have in common, in the order of the maps' cascades; none when nothing fades.
    overlaps: Vec<Overlap>,
    /// Buffers and textures, public so that `check` and the tests can feed a pass from the oracle.
    pub resources: Resources,
    /// The passes, public for the same reason.
    pub passes: Passes,
    maps: Maps,
    sea_steps: UniformRing<SeaUniform>,
    foam_steps: UniformRing<FoamUniform>,
    foam: FoamClock,
    foam_numbers: Drawn<foam::Numbers>,
    /// How much of the way to the table h0 has yet to be taken: 1 when it has never been drawn, 0 when it is there.
    spectrum_due: f64,
    spectra: u64,
    timer: Timer,
}

impl Simulation {
    /// Allocates a sea.
    pub fn new(gpu: &Gpu, plan: Plan, shaders: &Shaders) -> Self {
        let resources = Resources::new(gpu, &plan, shaders.way(gpu, plan.n), shaders.maps(gpu));
        let sea_steps = UniformRing::new(gpu, "sea", SEA_SLOTS);
        let foam_steps = UniformRing::new(gpu, "foam", MAX_STEPS);
        let passes = Passes::new(gpu, shaders, &resources, &sea_steps, &foam_steps);
        let maps = Maps::new(&plan, &resources);
        let foam_numbers = Drawn::new(foam::Numbers::new(resources.foam_n, &plan));
        let foam = FoamClock::new(resources.foam_n, foam_numbers.value(1.0));
        let mut sim = Self {
            sea: Sea::new(plan),
            fading: None,
            next: None,
            glide: Glide::default(),
            overlaps: Vec::new(),
            resources,
            passes,
            maps,
            sea_steps,
            foam_steps,
            foam,
            foam_numbers,
            spectrum_due: 1.0,
            spectra: 0,
            timer: Timer::default(),
        };
        sim.upload_tables(gpu);
        sim
    }

    /// Has its passes timed, each by its name.
    pub fn set_timer(&mut self, timer: Timer) {
        self.timer = timer;
    }

    /// Turns to another sea at once, and ends a glide. Its foam goes on from the old one's.
    pub fn set_plan(&mut self, gpu: &Gpu, plan: Plan, shaders: &Shaders) {
        if plan == self.sea.plan && !self.is_gliding() {
            return;
        }
        if (plan.n, plan.cascades.len()) != (self.sea.plan.n, self.sea.plan.cascades.len()) {
            let (generation, timer) = (self.maps.generation + 1, self.timer.clone());
            *self = Self::new(gpu, plan, shaders);
            (self.maps.generation, self.timer) = (generation, timer);
            return;
        }
        self.next = None;
        self.turn(gpu, plan, Turn::Jump, 0.0);
        self.follow(&Moved { turn: Some(Turn::Jump), ..Moved::default() });
        self.foam.set_changed();
    }

    /// Goes on by `dt_s` of wall time towards the sea of the last plan that was given, or to another now; at the time `t_s`
    /// of the sea. Call it once a frame, before [`Self::encode`]. A plan of another FFT size or tiling is turned to at once.
    ///
    /// Amplitudes ease in place: one spectrum pass a frame, whatever the goal does meanwhile. Other waves fade in, for which
    /// room for a second sea is allocated once; a plan that comes while other waves fade in waits for its turn.
    pub fn glide_to(&mut self, gpu: &Gpu, plan: Option<Plan>, shaders: &Shaders, t_s: f64, dt_s: f64) -> Moved {
        let goal = plan.or_else(|| self.next.take_if(|_| self.fading.is_none()));
        let mut turn = None;
        if let Some(plan) = goal {
            self.next = None;
            if (plan.n, plan.untile) != (self.sea.plan.n, self.sea.plan.untile) {
                self.set_plan(gpu, plan, shaders);
                return Moved { turn: Some(Turn::Jump), ..Moved::default() };
            }
            match (plan.has_same_waves(&self.sea.plan), &self.fading) {
                (true, _) => turn = (plan != self.sea.plan).then_some(Turn::Ease),
                (false, None) => turn = Some(Turn::Fade),
                (false, Some(_)) => {
                    self.next = Some(plan);
                    return self.advance(None, dt_s);
                }
            }
            if let Some(turn) = turn {
                self.turn(gpu, plan, turn, t_s);
            }
        }
        self.advance(turn, dt_s)
    }

    fn turn(&mut self, gpu: &Gpu, plan: Plan, turn: Turn, t_s: f64) {
        let mut maps_are_new = false;
        if turn == Turn::Fade {
            maps_are_new = self.resources.turn(gpu, &plan);
        }
        let old = std::mem::replace(&mut self.sea, Sea::new(plan));
        if turn == Turn::Fade {
            self.overlaps = Overlap::all(&old.plan, &self.sea.plan, t_s).concat();
        }
        match turn {
            Turn::Jump => self.fading = None,
            Turn::Ease => {}
            Turn::Fade => self.fading = Some(old),
        }
        self.glide.start(turn);
        let buffers_are_new = self.upload_tables(gpu);
        if turn == Turn::Fade || buffers_are_new {
            self.passes.bind_waves(gpu, &self.resources, &self.sea_steps);
        }
        if maps_are_new {
            self.passes.bind_maps(gpu, &self.resources, &self.sea_steps, &self.foam_steps);
            self.maps.rebind(&self.resources);
        }
        self.maps.turn(&self.sea.plan, &self.resources, turn);
        if turn != Turn::Ease {
            self.spectrum_due = 1.0;
        }
    }

    fn upload_tables(&mut self, gpu: &Gpu) -> bool {
        self.resources.upload_tables(gpu, &self.sea.plan)
    }

    /// A step of the glide, after a turn.
    fn advance(&mut self, turn: Option<Turn>, dt_s: f64) -> Moved {
        let was_gliding = self.glide.is_running();
        let moved = Moved { turn, ..self.glide.advance(dt_s) };
        self.spectrum_due = 1.0 - (1.0 - self.spectrum_due) * (1.0 - moved.ease);
        self.follow(&moved);
        if was_gliding && !self.is_gliding() {
            self.foam.set_changed();
        }
        moved
    }

    /// Takes over what a step changed.
    fn follow(&mut self, moved: &Moved) {
        if moved.faded {
            self.fading = None;
            self.maps.end_fade();
            self.overlaps.clear();
        }
        let (size, plan) = (self.resources.foam_n, &self.sea.plan);
        self.foam_numbers.follow(moved, || foam::Numbers::new(size, plan));
        self.foam.set_numbers(self.foam_numbers.value(self.glide.share()));
        self.maps.weigh(&self.overlaps, self.glide.share());
    }

    /// Whether the sea has not come to its plan yet.
    pub fn is_gliding(&self) -> bool {
        self.glide.is_running() || self.next.is_some()
    }

    /// Share of the sea in the variance of what is drawn; the rest is that of the sea that it fades out of.
    pub fn share(&self) -> f64 {
        self.glide.share()
    }

    /// How often the spectrum pass has run.
    pub fn spectra(&self) -> u64 {
        self.spectra
    }

    /// Mean foam to be expected: what lies beyond the foam levels.
    pub fn foam_coverage(&self) -> f64 {
        self.foam.numbers().coverage
    }

    /// The sea that is computed, or that is being turned to.
    pub fn plan(&self) -> &Plan {
        &self.sea.plan
    }

    /// What the renderer sees.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }

    /// Brings the sea to time `t_s`, with the foam around `centre` (world x, z). At most `most_steps` evaluations are
    /// recorded; returns whether the foam has caught up, else call again (the waves are always those of `t_s`).
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
        most_steps: usize,
    ) -> bool {
        let steps = self.foam.steps_to(t_s, centre, most_steps.min(MAX_STEPS));
        self.begin(encoder, t_s);
        for step in &steps {
            self.encode_foam_step(encoder, step, centre);
        }
        let caught_up = self.foam.is_at(t_s);
        if steps.is_empty() || !caught_up {
            self.encode_waves(encoder, t_s, false);
        }
        self.end(gpu);
        caught_up
    }

    /// The waves at the time of a step, and the foam with them.
    fn encode_foam_step(&mut self, encoder: &mut wgpu::CommandEncoder, step: &foam::Step, centre: [f64; 2]) {
        let sea = self.encode_waves(encoder, step.t_s, false);
        let foam = self.foam_steps.push(&self.foam.uniform(step, centre, &self.maps));
        self.passes.foam.run(encoder, &self.resources, sea, foam);
        self.timer.mark(encoder, "foam");
        self.maps.foam_levels = self.foam.levels(centre);
    }

    /// Starts a submission; draws h0 if the sea changed.
    fn begin(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.sea_steps.restart();
        self.foam_steps.restart();
        if self.spectrum_due > 0.0 {
            let step = self.push(Evaluation { t_s, keep_f32: false, ease: self.spectrum_due }, false);
            self.passes.spectrum.run(encoder, &self.resources, step);
            self.timer.mark(encoder, "spectrum");
            self.spectrum_due = 0.0;
            self.spectra += 1;
        }
    }

    /// Sends the uniforms of a submission.
    fn end(&self, gpu: &Gpu) {
        self.sea_steps.upload(gpu);
        self.foam_steps.upload(gpu);
    }

    /// The next step of the foam towards `t_s` alone, for `check`: the maps stay those that the foam saw. None at its end.
    pub fn encode_next_foam_step(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
    ) -> Option<foam::Step> {
        let step = self.foam.steps_to(t_s, centre, 1).into_iter().next()?;
        self.begin(encoder, t_s);
        self.encode_foam_step(encoder, &step, centre);
        self.end(gpu);
        Some(step)
    }

    /// The waves of all cascades at one time: two dispatches, and their mips; the same before that for a sea that fades.
    /// Returns the step of the sea.
    fn encode_waves(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64, keep_f32: bool) -> Step {
        let evaluation = Evaluation { t_s, keep_f32, ease: 1.0 };
        if self.fading.is_some() {
            let step = self.push(evaluation, true);
            self.encode_evaluation(encoder, step);
        }
        let step = self.push(evaluation, false);
        self.maps.phase_time = self.sea.plan.phase_time(t_s);
        self.encode_evaluation(encoder, step);
        step
    }

    fn encode_evaluation(&self, encoder: &mut wgpu::CommandEncoder, step: Step) {
        self.passes.rows.run(encoder, step);
        self.timer.mark(encoder, "rows");
        self.passes.columns.run(encoder, &self.resources, step);
        self.timer.mark(encoder, "columns");
        self.passes.mips.run(encoder, &self.resources, step);
        self.timer.mark(encoder, "mips");
    }

    /// Records the waves at `t_s` with an f32 copy of the maps left in the intermediate buffer (layout: cascade, pair,
    /// z, x; pair 0 is the displacement map, pair 1 the gradients). A sea that fades leaves none.
    pub fn encode_f32(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.begin(encoder, t_s);
        self.encode_waves(encoder, t_s, true);
        self.end(gpu);
    }

    /// The maps at `t_s` in f32, read back: for statistics, export and comparisons between GPUs.
    ///
    /// # Errors
    /// If the GPU refuses to map the memory.
    pub async fn read_f32(&mut self, gpu: &Gpu, t_s: f64) -> Result<MapsF32, String> {
        let mut encoder = gpu.encoder("read maps");
        self.encode_f32(gpu, &mut encoder, t_s);
        let staging = readback::stage_buffer(gpu, &mut encoder, &self.resources.lines);
        gpu.submit(encoder);
        let bytes = readback::read(gpu, staging).await?;
        let plan = &self.sea.plan;
        let n = plan.n as usize;
        let mut texels = bytemuck::pod_collect_to_vec(&bytes);
        // The buffer may have room for more.
        texels.truncate(2 * n * n * plan.cascades.len());
        Ok(MapsF32 { n, texels })
    }

    /// The uniform of one evaluation, for `check` and the tests that run a pass alone.
    pub fn push_step(&mut self, gpu: &Gpu, t_s: f64, keep_f32: bool) -> Step {
        self.sea_steps.restart();
        let step = self.push(Evaluation { t_s, keep_f32, ease: 1.0 }, false);
        self.sea_steps.upload(gpu);
        step
    }

    /// The uniform of one step of the foam on the maps as they are, for `bench`.
    pub fn push_foam_step(&mut self, gpu: &Gpu, t_s: f64, centre: [f64; 2]) -> u32 {
        self.foam_steps.restart();
        let step = foam::Step { t_s, dt_s: 0.0, fresh: false };
        let foam = self.foam_steps.push(&self.foam.uniform(&step, centre, &self.maps));
        self.foam_steps.upload(gpu);
        foam
    }

    fn push(&mut self, evaluation: Evaluation, fades: bool) -> Step {
        let (fading, own) = self.maps.cascades.split_at(self.maps.fading);
        let (sea, maps) = match &self.fading {
            Some(sea) if fades => (sea, fading),
            _ => (&self.sea, own),
        };
        let uniform = sea.uniform(maps, self.foam.numbers().chop, evaluation);
        Step {
            uniform: self.sea_steps.push(&uniform),
            count: uniform.count,
            fades,
            first_layer: uniform.first_layer,
            keep_f32: evaluation.keep_f32,
        }
    }
}

/// The maps in f32. Texels are cascade by cascade; n x n displacement (Dx, eta, Dz, dDx/dz), then n x n gradients
/// (d eta/dx, d eta/dz, dDx/dx, dDz/dz); rows along z, columns along x; chop not applied.
#[derive(Clone, Debug)]
pub struct MapsF32 {
    /// Side of a map.
    pub n: usize,
    /// All texels.
    pub texels: Vec<[f32; 4]>,
}

impl MapsF32 {
    /// Number of cascades.
    pub fn cascades(&self) -> usize {
        self.texels.len() / (2 * self.n * self.n)
    }

    /// Dx, eta, Dz, dDx/dz of one cascade.
    pub fn displacement(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[2 * cascade * self.n * self.n..][..self.n * self.n]
    }

    /// d eta/dx, d eta/dz, dDx/dx, dDz/dz of one cascade.
    pub fn gradients(&self, cascade: usize) -> &[[f32; 4]] {
        &self.texels[(2 * cascade + 1) * self.n * self.n..][..self.n * self.n]
    }
}
