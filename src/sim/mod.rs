//! The sea on the GPU: what is computed, when, and what comes out.
//!
//! A frame is two dispatches for the waves of all cascades (rows, columns), the mips, and the foam; the spectrum pass runs
//! only when the sea changed. [`Maps`] is the read-only product.

pub mod foam;
pub mod maps;
pub mod passes;
pub mod resources;
pub mod transform;

pub use maps::{FoamLevel, MapCascade, Maps};

use crate::gpu::kernel::UniformRing;
use crate::gpu::layout::{FoamUniform, MAX_CASCADES, MAX_TERMS, SeaCascade, SeaTerm, SeaUniform};
use crate::gpu::readback;
use crate::gpu::shaders::Shaders;
use crate::model::spreading::Cosine;
use crate::model::waves::TermKind;
use crate::model::{Plan, table};
use foam::FoamClock;
use passes::Passes;
use resources::Resources;

/// Evaluations of the sea with foam that one submission may hold.
pub const MAX_STEPS: usize = foam::REPLAY_STEPS;
/// Uniforms of a submission: those, the spectrum's, and one evaluation without foam.
const SLOTS: usize = MAX_STEPS + 2;

/// A sea on a device.
pub struct Simulation {
    plan: Plan,
    /// Buffers and textures, public so that `check` and the tests can feed a pass from the oracle.
    pub resources: Resources,
    /// The passes, public for the same reason.
    pub passes: Passes,
    maps: Maps,
    sea_steps: UniformRing<SeaUniform>,
    foam_steps: UniformRing<FoamUniform>,
    foam: FoamClock,
    terms: Terms,
    spectrum_is_stale: bool,
}

impl Simulation {
    /// Allocates a sea.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, plan: Plan, shaders: &Shaders) -> Self {
        let resources = Resources::new(device, queue, &plan);
        let sea_steps = UniformRing::new(device, "sea", SLOTS);
        let foam_steps = UniformRing::new(device, "foam", SLOTS);
        let passes = Passes::new(device, shaders, &resources, &sea_steps, &foam_steps);
        let maps = Maps::new(&plan, &resources);
        let foam = FoamClock::new(resources.foam_n, &plan);
        let terms = Terms::new(&plan);
        let mut sim =
            Self { plan, resources, passes, maps, sea_steps, foam_steps, foam, terms, spectrum_is_stale: true };
        sim.upload_tables(device, queue);
        sim
    }

    /// Turns to another sea. Its foam goes on from the old one's.
    pub fn set_plan(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, plan: Plan, shaders: &Shaders) {
        if plan == self.plan {
            return;
        }
        if (plan.n, plan.cascades.len()) != (self.plan.n, self.plan.cascades.len()) {
            let generation = self.maps.generation + 1;
            *self = Self::new(device, queue, plan, shaders);
            self.maps.generation = generation;
            return;
        }
        self.plan = plan;
        self.upload_tables(device, queue);
        self.maps.update(&self.plan);
        self.foam.set_plan(&self.plan);
        self.spectrum_is_stale = true;
    }

    fn upload_tables(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) {
        self.terms = Terms::new(&self.plan);
        if self.resources.upload_tables(device, queue, &self.plan) {
            self.passes.spectrum.bind(device, &self.resources, &self.sea_steps);
        }
    }

    /// Mean foam to be expected: what lies beyond the foam levels.
    pub fn foam_coverage(&self) -> f64 {
        self.foam.coverage()
    }

    /// The sea that is computed.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// What the renderer sees.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }

    /// Brings the sea to time `t_s`, with the foam around `centre` (world x, z). At most `most_steps` evaluations are
    /// recorded; returns whether the foam has caught up, else call again (the waves are always those of `t_s`).
    pub fn encode(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
        most_steps: usize,
    ) -> bool {
        let steps = self.foam.steps_to(t_s, centre, &self.plan, most_steps.min(MAX_STEPS));
        self.begin(encoder, t_s);
        for step in &steps {
            self.encode_foam_step(encoder, step, centre);
        }
        let caught_up = self.foam.is_at(t_s);
        if steps.is_empty() || !caught_up {
            self.encode_waves(encoder, t_s);
        }
        self.end(queue);
        caught_up
    }

    /// The waves at the time of a step, and the foam with them.
    fn encode_foam_step(&mut self, encoder: &mut wgpu::CommandEncoder, step: &foam::Step, centre: [f64; 2]) {
        let sea = self.encode_waves(encoder, step.t_s);
        let foam = self.foam_steps.push(&self.foam.uniform(step, centre, &self.plan));
        self.passes.foam.run(encoder, &self.resources, sea, foam);
        self.maps.foam_levels = self.foam.levels(centre);
    }

    /// Starts a submission; draws h0 if the sea changed.
    fn begin(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.sea_steps.restart();
        self.foam_steps.restart();
        if self.spectrum_is_stale {
            let step = self.sea_steps.push(&self.sea_uniform(t_s, false));
            self.passes.spectrum.run(encoder, &self.resources, step);
            self.spectrum_is_stale = false;
        }
    }

    /// Sends the uniforms of a submission.
    fn end(&self, queue: &wgpu::Queue) {
        self.sea_steps.upload(queue);
        self.foam_steps.upload(queue);
    }

    /// The next step of the foam towards `t_s` alone, for `check`: the maps stay those that the foam saw. None at its end.
    pub fn encode_next_foam_step(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        t_s: f64,
        centre: [f64; 2],
    ) -> Option<foam::Step> {
        let step = self.foam.steps_to(t_s, centre, &self.plan, 1).into_iter().next()?;
        self.begin(encoder, t_s);
        self.encode_foam_step(encoder, &step, centre);
        self.end(queue);
        Some(step)
    }

    /// The waves of all cascades at one time: two dispatches, and their mips. Returns the uniform's offset.
    fn encode_waves(&mut self, encoder: &mut wgpu::CommandEncoder, t_s: f64) -> u32 {
        let step = self.sea_steps.push(&self.sea_uniform(t_s, false));
        self.maps.phase_time = self.plan.phase_time(t_s);
        self.passes.rows.run(encoder, &self.resources, step);
        self.passes.columns.run(encoder, &self.resources, step);
        self.passes.mips.run(encoder, &self.resources, step);
        step
    }

    /// Records the waves at `t_s` with an f32 copy of the maps left in the intermediate buffer (layout: cascade, pair,
    /// z, x; pair 0 is the displacement map, pair 1 the gradients).
    pub fn encode_f32(&mut self, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, t_s: f64) {
        self.begin(encoder, t_s);
        let step = self.sea_steps.push(&self.sea_uniform(t_s, true));
        self.maps.phase_time = self.plan.phase_time(t_s);
        self.passes.rows.run(encoder, &self.resources, step);
        self.passes.columns.run(encoder, &self.resources, step);
        self.passes.mips.run(encoder, &self.resources, step);
        self.end(queue);
    }

    /// The maps at `t_s` in f32, read back: for statistics, export and comparisons between GPUs.
    ///
    /// # Errors
    /// If the GPU refuses to map the memory.
    pub async fn read_f32(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, t_s: f64) -> Result<MapsF32, String> {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("read maps") });
        self.encode_f32(queue, &mut encoder, t_s);
        let staging = readback::stage_buffer(device, &mut encoder, &self.resources.lines);
        queue.submit([encoder.finish()]);
        let bytes = readback::read(device, staging).await?;
        Ok(MapsF32 { n: self.plan.n as usize, texels: bytemuck::pod_collect_to_vec(&bytes) })
    }

    /// The uniform of one evaluation, for `check` and the tests that run a pass alone.
    pub fn push_step(&mut self, queue: &wgpu::Queue, t_s: f64, keep_f32: bool) -> u32 {
        self.sea_steps.restart();
        let step = self.sea_steps.push(&self.sea_uniform(t_s, keep_f32));
        self.sea_steps.upload(queue);
        step
    }

    fn sea_uniform(&self, t_s: f64, keep_f32: bool) -> SeaUniform {
        let plan = &self.plan;
        let mut cascades = [SeaCascade::default(); MAX_CASCADES];
        for (out, (cascade, map)) in cascades.iter_mut().zip(plan.cascades.iter().zip(&self.maps.cascades)) {
            *out = SeaCascade {
                patch_m: cascade.patch_m as f32,
                dk: cascade.dk() as f32,
                key: cascade.key,
                moment_scale: map.moment_scale,
            };
        }
        SeaUniform {
            cascades,
            terms: self.terms.parts,
            chop: plan.sea.lambda().map(|l| l as f32),
            n: plan.n,
            count: plan.cascades.len() as u32,
            seed: plan.sea.seed,
            phase_time: plan.phase_time(t_s),
            keep_f32: u32::from(keep_f32),
            term_count: self.terms.count,
            stride: self.terms.stride,
            unused: [0; 3],
        }
    }
}

/// The parts of a plan's spectrum as the spectrum pass sees them.
struct Terms {
    parts: [SeaTerm; MAX_TERMS],
    count: u32,
    stride: u32,
}

impl Terms {
    fn new(plan: &Plan) -> Self {
        let (terms, stride) = table::terms(plan);
        let mut parts = [SeaTerm::default(); MAX_TERMS];
        for (out, part) in parts.iter_mut().zip(&terms) {
            let kind = match part.kind {
                TermKind::Lobe(Cosine::None) => 0,
                TermKind::Lobe(Cosine::Full) => 1,
                TermKind::Lobe(Cosine::Forward) => 2,
                TermKind::Measured => 3,
            };
            *out = SeaTerm { travel: part.travel.map(|x| x as f32), kind, slot: part.slot as u32 };
        }
        Self { parts, count: terms.len() as u32, stride: stride as u32 }
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
