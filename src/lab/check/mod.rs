//! `seastate check`: compares every GPU pass of the simulation with the same calculation on the CPU in f64 (the
//! oracle). Each pass gets the oracle's result of the previous pass as input, so that an error belongs to one pass. The
//! tests run the same comparison, also with deliberate faults.

pub mod coast;
mod foam;

use crate::gpu::readback::{self, StagedTexture};
use crate::gpu::{Gpu, timer::Timer};
use crate::oracle::{self, Complex, Texel, maps::CascadeMapPair};
use crate::shaders::Shaders;
use crate::sim::Simulation;
use crate::sim::planned_sea::SeaDispatch;
use crate::sim::resources::{MapKind, Resources};
use crate::sim::transform::FftImplementation;
use crate::state::Params;
use crate::waves::Plan;
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
/// Lower limit, 2^-12, of the rms by which the rms error of half-float maps is divided. Half floats are at least 2^-24
/// apart, so truncating a texel's four components changes the texel by up to 2^-23: 2^-11 of this limit. The limit
/// matters for maps of very small values, such as slopes of the longest waves of a calm sea.
const MIN_RMS_DIVISOR: f64 = 2.441_406_25e-4;

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
    let another = || Simulation::with_fft_implementation(gpu, plan.clone(), shaders, implementation);
    lines.push(foam::compare_foam(gpu, &plan, t_s, another()).await?);
    if plan.has_coast && !plan.is_calm() {
        lines.extend(coast::compare(gpu, &mut another(), shaders, &h0[0], t_s).await?);
    }
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
