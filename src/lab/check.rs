//! `seastate check`: compares every GPU pass of the simulation with the same calculation on the CPU in f64 (the
//! oracle). Each pass gets the oracle's result of the previous pass as input, so that an error belongs to one pass. The
//! tests run the same comparison, also with deliberate faults.

use crate::gpu::readback::{self, StagedTexture};
use crate::gpu::{Gpu, timer::Timer};
use crate::oracle::{self, Complex, Texel, maps::CascadeMapPair};
use crate::shaders::Shaders;
use crate::sim::Simulation;
use crate::sim::foam::FoamStep;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::{MapKind, Resources};
use crate::sim::transform::FftImplementation;
use crate::state::Params;
use crate::waves::Plan;
use crate::waves::foam::{
    FRONT_DECAY_RATIO, FRONT_GROWTH_RATIO, MEAN_FRONT_RATIO, MEAN_PLUME_RATIO, PLUME_DECAY_RATIO,
};
use crate::waves::foam::{FoamModel, breaker_texel_m};
use crate::waves::plan::Cascade;
use crate::waves::tiling::Tiling;
use std::fmt;

/// One comparison of a GPU pass with the oracle (the same calculation on the CPU in f64): a line of the printed table.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Name of the pass and of the compared quantity, such as `columns displacement`.
    pub pass_and_quantity: &'static str,
    /// Index of the cascade; for foam, index of the foam level.
    pub cascade_or_foam_level: usize,
    /// Relative error: root mean square error divided by the root mean square of the expected values, or for a mip
    /// level by the root mean square of the next finer level; for wave maps and mip levels by at least 2^-12.
    pub relative_error: f64,
    /// Largest accepted relative error.
    pub tolerance: f64,
}

impl Comparison {
    /// Whether the error is within the tolerance. An error that is not a number fails.
    pub fn passes(&self) -> bool {
        self.relative_error <= self.tolerance
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.passes() { "ok" } else { "WRONG" };
        write!(
            f,
            "{:<34} {:>7} {:>12.3e} {:>12.1e}  {verdict}",
            self.pass_and_quantity, self.cascade_or_foam_level, self.relative_error, self.tolerance
        )
    }
}

/// Largest accepted rms error of the GPU's initial wave amplitudes, divided by the rms of the oracle's. The GPU's
/// random numbers are exact; the functions applied to them are off by a few times the rounding error of f32, 6e-8.
const SPECTRUM_TOLERANCE: f64 = 1e-6;
/// Largest accepted rms error of the GPU's FFT along rows or columns, divided by the rms of the oracle's result. It
/// leaves room for the rounding errors of f32.
const FFT_TOLERANCE: f64 = 1e-6;
/// Largest accepted rms error of the GPU's wave maps, divided by the rms of the oracle's maps. Rounding to half floats
/// gives a relative error of at most 2^-11.
const WAVE_MAP_TOLERANCE: f64 = 4.9e-4;
/// Largest accepted rms error of a mip level (rounded to half floats), divided by the rms of the next finer level.
const MIP_TOLERANCE: f64 = 4.9e-4;
/// Largest accepted rms error of the GPU's foam coverage, divided by the rms of the oracle's. The foam pass filters
/// half-float maps with weights of 8 bits, and the steep source term of the foam amplifies the rounding errors.
const FOAM_TOLERANCE: f64 = 5e-3;

/// Lower limit, 2^-12, of the rms by which the rms error of half-float maps is divided. Half floats are at least 2^-24
/// apart, so truncating a texel's four components changes the texel by up to 2^-23: 2^-11 of this limit. The limit
/// matters for maps of very small values, such as slopes of the longest waves of a calm sea.
const MIN_RMS_DIVISOR: f64 = 2.441_406_25e-4;

/// Number of foam steps that are computed before the GPU's foam is compared with the oracle's.
const COMPARED_FOAM_STEPS: usize = 4;
/// Index of the foam level that is compared: 0 is the smallest and finest of the square foam grids around the camera.
const COMPARED_FOAM_LEVEL: usize = 1;

/// Compares all GPU passes (spectrum, FFT, wave maps, mip levels, foam) with the oracle (the same calculation on the
/// CPU in f64), for the sea of `params` at its time. Returns one comparison per quantity and cascade.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn run(gpu: &Gpu, params: &Params) -> Result<Vec<Comparison>, String> {
    run_with(gpu, params, &Shaders::default(), FftImplementation::for_device(gpu)).await
}

/// Compares all GPU passes with the oracle as [`run`] does, but with the given FFT implementation and the given shaders
/// (in which tests plant faults).
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn run_with(
    gpu: &Gpu,
    params: &Params,
    shaders: &Shaders,
    implementation: FftImplementation,
) -> Result<Vec<Comparison>, String> {
    let plan = Plan::new(params);
    let t_s = params.clock.t_s;
    let mut sim = Simulation::with_fft_implementation(gpu, plan.clone(), shaders, implementation);
    let dispatch = sim.upload_sea_uniform(gpu, t_s, true);
    let mut check = OracleCheck { gpu, plan: &plan, sim: &sim, dispatch, lines: Vec::new() };
    let h0: Vec<Vec<Complex>> = plan.cascades.iter().map(|c| oracle::spectrum::initial_spectrum(&plan, c)).collect();
    let rows: Vec<CascadeMapPair> =
        plan.cascades.iter().zip(&h0).map(|(c, h0)| oracle::maps::transform_rows(&plan, c, h0, t_s)).collect();
    let maps: Vec<CascadeMapPair> =
        rows.iter().map(|rows| oracle::maps::transform_columns(plan.n as usize, rows)).collect();
    check.compare_spectrum(&h0).await?;
    check.compare_rows(&h0, &rows).await?;
    check.compare_columns(&rows, &maps).await?;
    check.compare_maps(&maps).await?;
    for level in 1..sim.resources.mip_level_count() {
        check.compare_mips(level).await?;
    }
    let mut lines = check.lines;
    lines.push(
        compare_foam(gpu, &plan, t_s, Simulation::with_fft_implementation(gpu, plan.clone(), shaders, implementation))
            .await?,
    );
    Ok(lines)
}

/// A check in progress: the simulation that is compared with the oracle at one time, and the comparisons made so far.
struct OracleCheck<'a> {
    gpu: &'a Gpu,
    plan: &'a Plan,
    sim: &'a Simulation,
    dispatch: SeaDispatch,
    lines: Vec<Comparison>,
}

impl OracleCheck<'_> {
    async fn compare_spectrum(&mut self, h0: &[Vec<Complex>]) -> Result<(), String> {
        let r = &self.sim.resources;
        let mut encoder = self.gpu.encoder("check");
        self.sim.passes.spectrum.run(&mut encoder, &Timer::default(), r, self.dispatch);
        let staging = readback::stage_buffer(self.gpu, &mut encoder, &r.current_waves().h0);
        self.gpu.submit(encoder);
        let got: Vec<[f32; 2]> = bytemuck::pod_collect_to_vec(&readback::read(self.gpu, staging).await?);
        for (c, (want, got)) in h0.iter().zip(got.chunks((r.n * r.n) as usize)).enumerate() {
            let got = got.iter().map(|h| h.map(f64::from));
            self.lines.push(comparison(
                "spectrum h0",
                c,
                relative_rms_error(got, want.iter().copied()),
                SPECTRUM_TOLERANCE,
            ));
        }
        Ok(())
    }

    /// Runs the GPU's FFT along rows on `h0`, the oracle's initial wave amplitudes of each cascade, and adds
    /// comparisons of the result with `rows`, the oracle's FFT along rows, to `lines`.
    async fn compare_rows(&mut self, h0: &[Vec<Complex>], rows: &[CascadeMapPair]) -> Result<(), String> {
        let flat: Vec<[f32; 2]> = h0.iter().flatten().map(|h| h.map(|x| x as f32)).collect();
        self.gpu.queue.write_buffer(&self.sim.resources.current_waves().h0, 0, bytemuck::cast_slice(&flat));
        let mut encoder = self.gpu.encoder("check");
        self.sim.passes.transform.record_rows(&mut encoder, &Timer::default(), self.dispatch);
        self.compare_transform(encoder, rows, ["rows Dx Dz eta Dxz", "rows eta_x eta_z Dxx Dzz"]).await
    }

    /// Runs the GPU's FFT along columns on `rows`, the oracle's FFT along rows, and compares the result with `maps`,
    /// the oracle's wave maps. Also lets the GPU compute the mip levels of its own maps, for [`Self::compare_mips`].
    async fn compare_columns(&mut self, rows: &[CascadeMapPair], maps: &[CascadeMapPair]) -> Result<(), String> {
        let r = &self.sim.resources;
        let flat: Vec<[f32; 4]> = rows.iter().flatten().flatten().map(|t| t.map(|x| x as f32)).collect();
        self.gpu.queue.write_buffer(&r.row_transforms, 0, bytemuck::cast_slice(&flat));
        let mut encoder = self.gpu.encoder("check");
        self.sim.passes.transform.record_columns(&mut encoder, &Timer::default(), r, self.dispatch);
        self.sim.passes.mips.run(&mut encoder, &Timer::default(), r, self.dispatch);
        self.compare_transform(encoder, maps, ["columns displacement", "columns gradients"]).await
    }

    /// Submits the commands of `encoder`, reads back the buffer `row_transforms`, which the FFT passes write, and
    /// compares it with `want`, the oracle's pair of maps of each cascade. `names` are the names of the two maps of a
    /// pair in the printed table.
    async fn compare_transform(
        &mut self,
        mut encoder: wgpu::CommandEncoder,
        want: &[CascadeMapPair],
        names: [&'static str; 2],
    ) -> Result<(), String> {
        let staging = readback::stage_buffer(self.gpu, &mut encoder, &self.sim.resources.row_transforms);
        self.gpu.submit(encoder);
        let got: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&readback::read(self.gpu, staging).await?);
        let points = (self.plan.n * self.plan.n) as usize;
        for (c, want) in want.iter().enumerate() {
            for (pair, what) in names.into_iter().enumerate() {
                let got = got[(2 * c + pair) * points..][..points].iter().map(|t| t.map(f64::from));
                self.lines.push(comparison(
                    what,
                    c,
                    relative_rms_error(got, want[pair].iter().copied()),
                    FFT_TOLERANCE,
                ));
            }
        }
        Ok(())
    }

    /// Compares mip level 0 of the half-float wave maps, which the column pass has written, with `maps`, the oracle's
    /// result.
    async fn compare_maps(&mut self, maps: &[CascadeMapPair]) -> Result<(), String> {
        let points = (self.plan.n * self.plan.n) as usize;
        let kinds = [(MapKind::Displacement, "maps displacement"), (MapKind::Gradients, "maps gradients")];
        for (pair, (kind, what)) in kinds.into_iter().enumerate() {
            let got = read_map(self.gpu, &self.sim.resources, kind, 0).await?;
            for (c, want) in maps.iter().enumerate() {
                let got = got[c * points..][..points].iter().copied();
                let rms = root_mean_square(want[pair].iter().copied()).max(MIN_RMS_DIVISOR);
                let error = rms_difference(got, want[pair].iter().copied()) / rms;
                self.lines.push(comparison(what, c, error, WAVE_MAP_TOLERANCE));
            }
        }
        Ok(())
    }

    /// Compares mip level `level` of the GPU's displacement, gradient and slope moment maps with the means that the
    /// oracle computes from 2 x 2 texels of the GPU's next finer level.
    async fn compare_mips(&mut self, level: u32) -> Result<(), String> {
        let (gpu, r) = (self.gpu, &self.sim.resources);
        let above = self.plan.n as usize >> (level - 1);
        let below = above / 2;
        for (what, kind) in [
            ("mips displacement", MapKind::Displacement),
            ("mips gradients", MapKind::Gradients),
            ("mips moments", MapKind::Moments),
        ] {
            let moments_from_slopes = kind == MapKind::Moments && level == 1;
            let source = if moments_from_slopes { MapKind::Gradients } else { kind };
            let from = read_map(gpu, r, source, level - 1).await?;
            let got = read_map(gpu, r, kind, level).await?;
            for (c, cascade) in self.sim.maps().cascades.iter().enumerate() {
                let from = &from[c * above * above..][..above * above];
                let scale = f64::from(cascade.moment_unit);
                let from = if moments_from_slopes { oracle::maps::slope_moments(from, scale) } else { from.to_vec() };
                let want = oracle::maps::next_mip_level(above, &from);
                let got = got[c * below * below..][..below * below].iter().copied();
                // Waves that cancel in the mean leave rounding errors, so the error is divided by the rms of the next
                // finer level.
                let rms = root_mean_square(from.iter().copied()).max(MIN_RMS_DIVISOR);
                self.lines.push(comparison(what, c, rms_difference(got, want.iter().copied()) / rms, MIP_TOLERANCE));
            }
        }
        Ok(())
    }
}

/// Compares foam after some steps with the oracle's, which reads the GPU's wave maps: only errors of its pass count.
async fn compare_foam(gpu: &Gpu, plan: &Plan, t_s: f64, mut sim: Simulation) -> Result<Comparison, String> {
    let centre = [1234.5, -67.8];
    let size = sim.resources.foam_n as usize;
    let mean = FoamModel::new(plan).expected_mean_foam;
    let mut want = vec![[1.0, MEAN_FRONT_RATIO, MEAN_PLUME_RATIO].map(|ratio| ratio * mean); size * size];
    let mut got = Vec::new();
    for _ in 0..COMPARED_FOAM_STEPS {
        let mut encoder = gpu.encoder("check");
        let Some(step) = sim.encode_next_foam_step(gpu, &mut encoder, t_s, centre) else { break };
        gpu.submit(encoder);
        let level = sim.maps().foam_levels[COMPARED_FOAM_LEVEL];
        let corner = level.centre_m.map(|c| c - 0.5 * size as f64 * level.cell_m);
        let pyramid = SampledMaps::read(gpu, &sim, level.cell_m.max(breaker_texel_m(plan))).await?;
        step_oracle_foam(&mut want, plan, &pyramid, (corner, level.cell_m), step);
        let texels = read_foam(gpu, &sim.resources).await?;
        // A cell is stored at its index modulo the size of the level.
        let first = corner.map(|o| (o / level.cell_m).round() as i64);
        let stored = |i: usize| {
            let place = [i % size, i / size];
            let at = [0, 1].map(|a| (first[a] + place[a] as i64).rem_euclid(size as i64) as usize);
            let [foam, _, front, plume] = texels[COMPARED_FOAM_LEVEL * size * size + at[1] * size + at[0]];
            [foam, front, plume]
        };
        got = (0..size * size).map(stored).collect();
    }
    Ok(comparison("foam", COMPARED_FOAM_LEVEL, relative_rms_error(got.into_iter(), want.into_iter()), FOAM_TOLERANCE))
}

/// Advances foam, front and plume of all cells of a level by one time step: corner (x, z) and side of a cell in metres.
fn step_oracle_foam(
    foam: &mut [[f64; 3]],
    plan: &Plan,
    pyramid: &SampledMaps,
    (corner, texel_m): ([f64; 2], f64),
    step: FoamStep,
) {
    let source = FoamModel::new(plan).foam_source_for_texel(plan, texel_m);
    let size = foam.len().isqrt();
    for (i, cell) in foam.iter_mut().enumerate() {
        let world = [0, 1].map(|a| corner[a] + ([i % size, i / size][a] as f64 + 0.5) * texel_m);
        let j = oracle::foam::displacement_jacobian(pyramid.wave_fields_at(world).strain, plan.sea.choppiness_xz());
        let s = ((source.jacobian_threshold - j) * source.source_slope).clamp(0.0, 1.0);
        let ratios = [[1.0; 2], [FRONT_GROWTH_RATIO, FRONT_DECAY_RATIO], [1.0, PLUME_DECAY_RATIO]];
        for (quantity, [growth, decay]) in cell.iter_mut().zip(ratios) {
            let (rate_per_s, decay_s) = (growth * plan.sea.foam.rate_per_s, decay * plan.sea.foam.decay_s);
            *quantity = oracle::foam::foam_after_step(*quantity, s, rate_per_s, decay_s, step.dt_s);
        }
    }
}

/// Copy of the GPU's wave maps at all mip levels, from which the oracle computes foam. For each cascade it also has the
/// tiling (how shifted copies of the patch cover the sea) and the mip level that the foam pass samples; a fractional
/// mip level stands for interpolation between two levels.
struct SampledMaps {
    n: usize,
    /// For each mip level: texels of all displacement maps, and of all gradient maps, one cascade after the other.
    levels: Vec<[Vec<Texel>; 2]>,
    cascades: Vec<(Tiling, f64)>,
}

impl SampledMaps {
    /// Reads back the wave maps of `sim`, and computes at which mip level of each cascade a foam level with cells of
    /// `texel_m` metres samples them.
    async fn read(gpu: &Gpu, sim: &Simulation, texel_m: f64) -> Result<Self, String> {
        let (r, plan) = (&sim.resources, sim.plan());
        let mut levels = Vec::new();
        for mip in 0..r.mip_level_count() {
            levels.push([
                read_map(gpu, r, MapKind::Displacement, mip).await?,
                read_map(gpu, r, MapKind::Gradients, mip).await?,
            ]);
        }
        let cascade = |cascade: &Cascade| {
            let texels = 0.5 * texel_m * f64::from(plan.n) / cascade.patch_m;
            (plan.tiling(cascade), texels.log2().clamp(0.0, f64::from(r.mip_level_count() - 1)))
        };
        Ok(Self { n: plan.n as usize, levels, cascades: plan.cascades.iter().map(cascade).collect() })
    }

    /// Displacement, slope and strain (derivatives of the horizontal displacement) at an undisplaced position (x, z in
    /// m): the sum over all cascades of the GPU's maps, interpolated between texels and between mip levels.
    fn wave_fields_at(&self, world: [f64; 2]) -> oracle::surface::WaveFields {
        let mut sum = oracle::surface::WaveFields::default();
        for (c, (tiling, lod)) in self.cascades.iter().enumerate() {
            let low = lod.floor();
            let mips = [(low as usize, 1.0 - (lod - low)), (low as usize + 1, lod - low)];
            let read = |place: [f64; 2]| {
                let uv = place.map(|p| p + 0.5 / self.n as f64);
                let mut texels = [[0.0; 4]; 2];
                for (mip, weight) in mips.into_iter().filter(|(_, weight)| *weight > 0.0) {
                    let n = self.n >> mip;
                    let [displacement, gradients] =
                        self.levels[mip].each_ref().map(|texels| &texels[c * n * n..][..n * n]);
                    let add = oracle::foam::sample_bilinear(&oracle::foam::MipLevel { n, displacement, gradients }, uv);
                    for (texel, add) in texels.iter_mut().zip(add) {
                        *texel = std::array::from_fn(|k| texel[k] + weight * add[k]);
                    }
                }
                texels
            };
            sum = sum.plus(&oracle::surface::blend_patch_copies(tiling, world, read));
        }
        sum
    }
}

fn comparison(pass_and_quantity: &'static str, cascade: usize, relative_error: f64, tolerance: f64) -> Comparison {
    Comparison { pass_and_quantity, cascade_or_foam_level: cascade, relative_error, tolerance }
}

/// Reads back mip level `level` of the GPU's wave maps of one kind (displacement, gradients or slope moments): the
/// texels of all cascades, one cascade after the other.
async fn read_map(gpu: &Gpu, r: &Resources, kind: MapKind, level: u32) -> Result<Vec<Texel>, String> {
    let mut encoder = gpu.encoder("check");
    let copy = r.stage_maps(gpu, &mut encoder, kind, level);
    read(gpu, encoder, copy).await
}

async fn read_foam(gpu: &Gpu, r: &Resources) -> Result<Vec<Texel>, String> {
    let mut encoder = gpu.encoder("check");
    let copy = readback::stage_texture(gpu, &mut encoder, &r.foam, 0);
    read(gpu, encoder, copy).await
}

async fn read(gpu: &Gpu, encoder: wgpu::CommandEncoder, copy: StagedTexture) -> Result<Vec<Texel>, String> {
    gpu.submit(encoder);
    let texels = copy.read_map(gpu).await?;
    Ok(texels.into_iter().map(|t| t.map(f64::from)).collect())
}

/// Root mean square length of the difference vectors of two sequences of vectors.
fn rms_difference<const C: usize>(got: impl Iterator<Item = [f64; C]>, want: impl Iterator<Item = [f64; C]>) -> f64 {
    root_mean_square::<C>(got.zip(want).map(|(g, w)| std::array::from_fn(|c| g[c] - w[c])))
}

/// [`rms_difference`] divided by the root mean square length of the vectors in `want`, or by 1 if that length is 0.
fn relative_rms_error<const C: usize>(
    got: impl Iterator<Item = [f64; C]>,
    want: impl Iterator<Item = [f64; C]> + Clone,
) -> f64 {
    let rms = root_mean_square(want.clone());
    rms_difference(got, want) / if rms > 0.0 { rms } else { 1.0 }
}

fn root_mean_square<const C: usize>(values: impl Iterator<Item = [f64; C]>) -> f64 {
    let (sum, count) = values.fold((0.0, 0usize), |(s, n), v| (s + v.iter().map(|x| x * x).sum::<f64>(), n + 1));
    (sum / count.max(1) as f64).sqrt()
}
