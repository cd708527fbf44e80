//! `seastate check`: every GPU pass against its f64 twin. A pass is fed from the oracle's previous stage, so that an
//! error names one pass (rows and columns are one where they are merged). The tests run the same comparison, also with planted
//! faults.

use crate::gpu::Gpu;
use crate::gpu::readback::{self, TextureCopy};
use crate::oracle::{self, Complex, Texel, maps::MapPair};
use crate::shaders::Shaders;
use crate::shaders::fft::Way;
use crate::sim::Simulation;
use crate::sim::resources::{MapKind, Resources};
use crate::state::Params;
use crate::waves::Plan;
use crate::waves::foam::FoamModel;
use std::fmt;

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Line {
    /// Pass and quantity.
    pub what: &'static str,
    /// Cascade.
    pub cascade: usize,
    /// Root mean square error over the root mean square of the oracle's values.
    pub error: f64,
    /// Largest that is accepted.
    pub tolerance: f64,
}

impl Line {
    /// Whether the error is within the tolerance; not-a-number is not.
    pub fn passes(&self) -> bool {
        self.error <= self.tolerance
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.passes() { "ok" } else { "WRONG" };
        write!(f, "{:<34} {:>7} {:>12.3e} {:>12.1e}  {verdict}", self.what, self.cascade, self.error, self.tolerance)
    }
}

/// Tolerances, with their reasons. f32 carries 6e-8 of relative rounding per operation.
mod tolerance {
    /// Hash exact; logarithm, sine, arc tangent and exponential of a few units in the last place each.
    pub const SPECTRUM: f64 = 1e-6;
    /// log2(n) butterflies: the demand on the transform.
    pub const TRANSFORM: f64 = 1e-6;
    /// The rounding of a half float, 2^-11 at most and 2^-12 on average.
    pub const HALF: f64 = 4.9e-4;
    /// A mean of four half floats, rounded again.
    pub const MIP: f64 = 4.9e-4;
    /// Bilinear weights of 8 bits and half-float maps, before the threshold's slope.
    pub const FOAM: f64 = 5e-3;
}

/// Half floats are 2^-24 apart or more. A texel of four that are cut off there is off by up to 2^-23, 2^-11 of this:
/// errors in smaller numbers (the slopes of the longest waves of a calm sea) count against it.
const SMALLEST_HALF: f64 = 2.441_406_25e-4;

/// Runs all passes of a state at its time. `shaders` are the program's own, or a test's with a fault.
///
/// # Errors
/// If the GPU does not give its memory back.
pub async fn run(gpu: &Gpu, params: &Params, shaders: &Shaders) -> Result<Vec<Line>, String> {
    let plan = Plan::new(params);
    let n = plan.n as usize;
    let t_s = params.clock.t_s;
    let mut sim = Simulation::new(gpu, plan.clone(), shaders);
    let mut lines = Vec::new();
    let h0: Vec<Vec<Complex>> = plan.cascades.iter().map(|c| oracle::spectrum::h0(&plan, c)).collect();
    let rows: Vec<MapPair> =
        plan.cascades.iter().zip(&h0).map(|(c, h0)| oracle::maps::rows(&plan, c, h0, t_s)).collect();
    let maps: Vec<MapPair> = rows.iter().map(|rows| oracle::maps::columns(n, rows)).collect();

    let step = sim.push_step(gpu, t_s, true);
    // Spectrum.
    let got: Vec<[f32; 2]> = {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        sim.passes.spectrum.run(&mut encoder, &sim.resources, step);
        let staging = readback::stage_buffer(gpu, &mut encoder, &sim.resources.sea.h0);
        gpu.submit(encoder);
        bytemuck::pod_collect_to_vec(&readback::read(gpu, staging).await?)
    };
    for (c, want) in h0.iter().enumerate() {
        let got = got[c * n * n..][..n * n].iter().map(|h| h.map(f64::from));
        lines.push(line("spectrum h0", c, error(got, want.iter().copied()), tolerance::SPECTRUM));
    }
    // Rows, from the oracle's h0.
    let flat: Vec<[f32; 2]> = h0.iter().flatten().map(|h| h.map(|x| x as f32)).collect();
    gpu.queue.write_buffer(&sim.resources.sea.h0, 0, bytemuck::cast_slice(&flat));
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    sim.passes.rows.run(&mut encoder, step);
    let is_merged = sim.resources.way == Way::Merged;
    if !is_merged {
        let got = read_lines(gpu, &sim, encoder).await?;
        for (c, want) in rows.iter().enumerate() {
            for (pair, what) in [(0, "rows Dx Dz eta Dxz"), (1, "rows eta_x eta_z Dxx Dzz")] {
                let got = plane(&got, c, pair, n);
                lines.push(line(what, c, error(got, want[pair].iter().copied()), tolerance::TRANSFORM));
            }
        }
        // Columns, from the oracle's rows. Where the two are merged there are no rows between them.
        let flat: Vec<[f32; 4]> = rows.iter().flatten().flatten().map(|t| t.map(|x| x as f32)).collect();
        gpu.queue.write_buffer(&sim.resources.lines, 0, bytemuck::cast_slice(&flat));
        encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    }
    // And mips of what the columns made.
    sim.passes.columns.run(&mut encoder, &sim.resources, step);
    sim.passes.mips.run(&mut encoder, &sim.resources, step);
    let got = read_lines(gpu, &sim, encoder).await?;
    for (c, want) in maps.iter().enumerate() {
        let [displacement, gradients] = match is_merged {
            false => ["columns displacement", "columns gradients"],
            true => ["waves displacement", "waves gradients"],
        };
        for (pair, what) in [(0, displacement), (1, gradients)] {
            let got = plane(&got, c, pair, n);
            lines.push(line(what, c, error(got, want[pair].iter().copied()), tolerance::TRANSFORM));
        }
    }
    let r = &sim.resources;
    let level0 = [read_map(gpu, r, MapKind::Displacement, 0).await?, read_map(gpu, r, MapKind::Gradients, 0).await?];
    for (c, want) in maps.iter().enumerate() {
        for (pair, what) in [(0, "maps displacement"), (1, "maps gradients")] {
            let got = level0[pair][c * n * n..][..n * n].iter().copied();
            let rms = root_mean_square(want[pair].iter().copied()).max(SMALLEST_HALF);
            lines.push(line(what, c, distance(got, want[pair].iter().copied()) / rms, tolerance::HALF));
        }
    }
    for level in 1..r.mips() {
        let above = n >> (level - 1);
        let below = above / 2;
        let scale = |c: usize| f64::from(sim.maps().cascades[c].moment_scale);
        for (what, kind) in [
            ("mips displacement", MapKind::Displacement),
            ("mips gradients", MapKind::Gradients),
            ("mips moments", MapKind::Moments),
        ] {
            let moments_from_slopes = kind == MapKind::Moments && level == 1;
            let source = if moments_from_slopes { MapKind::Gradients } else { kind };
            let from = read_map(gpu, r, source, level - 1).await?;
            let got = read_map(gpu, r, kind, level).await?;
            for c in 0..plan.cascades.len() {
                let from = &from[c * above * above..][..above * above];
                let from = if moments_from_slopes { oracle::maps::moments(from, scale(c)) } else { from.to_vec() };
                let want = oracle::maps::mip(above, &from);
                let got = got[c * below * below..][..below * below].iter().copied();
                // A wave that the mean removes leaves rounding behind: errors count against the level above.
                let rms = root_mean_square(from.iter().copied()).max(SMALLEST_HALF);
                lines.push(line(what, c, distance(got, want.iter().copied()) / rms, tolerance::MIP));
            }
        }
    }
    lines.push(foam(gpu, &plan, t_s, shaders).await?);
    Ok(lines)
}

/// One replay of the foam on the GPU against the oracle's, from the GPU's own maps at each step.
async fn foam(gpu: &Gpu, plan: &Plan, t_s: f64, shaders: &Shaders) -> Result<Line, String> {
    let mut sim = Simulation::new(gpu, plan.clone(), shaders);
    let centre = [1234.5, -67.8];
    let level = 1;
    let size = sim.resources.foam_n as usize;
    let foam = FoamModel::new(plan);
    let mut want: Vec<f64> = vec![foam.coverage; size * size];
    let sea = &plan.sea;
    let mut got = Vec::new();
    for _ in 0..FOAM_STEPS {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let Some(step) = sim.encode_next_foam_step(gpu, &mut encoder, t_s, centre) else { break };
        gpu.submit(encoder);
        let foam_level = sim.maps().foam_levels[level];
        let source = foam.source(plan, foam_level.texel_m);
        let mut cascades = Vec::new();
        for cascade in &plan.cascades {
            let texels = 0.5 * foam_level.texel_m * f64::from(plan.n) / cascade.patch_m;
            let lod = texels.log2().clamp(0.0, f64::from(sim.resources.mips() - 1));
            cascades.push((plan.tiling(cascade), lod));
        }
        let mut maps = Vec::new();
        for mip in 0..sim.resources.mips() {
            maps.push([
                read_map(gpu, &sim.resources, MapKind::Displacement, mip).await?,
                read_map(gpu, &sim.resources, MapKind::Gradients, mip).await?,
            ]);
        }
        let origin = foam_level.centre.map(|c| c - 0.5 * size as f64 * foam_level.texel_m);
        for i in 0..size * size {
            let at = [i % size, i / size];
            let world: [f64; 2] = std::array::from_fn(|a| origin[a] + (at[a] as f64 + 0.5) * foam_level.texel_m);
            let mut sum = oracle::surface::WaveFields::default();
            for (c, (tiling, lod)) in cascades.iter().enumerate() {
                let read = |place: [f64; 2]| {
                    let uv = place.map(|p| p + 0.5 / f64::from(plan.n));
                    let low = lod.floor();
                    let mut texels = [[0.0; 4]; 2];
                    for (mip, weight) in [(low as usize, 1.0 - (lod - low)), (low as usize + 1, lod - low)] {
                        if weight > 0.0 {
                            let n = plan.n as usize >> mip;
                            let part = |plane: usize| &maps[mip][plane][c * n * n..][..n * n];
                            let of = oracle::foam::MipLevel { n, displacement: part(0), gradients: part(1) };
                            let add = oracle::foam::sample_bilinear(&of, uv);
                            for (texel, add) in texels.iter_mut().zip(add) {
                                *texel = std::array::from_fn(|k| texel[k] + weight * add[k]);
                            }
                        }
                    }
                    texels
                };
                sum = sum.plus(&oracle::surface::blend(tiling, world, read));
            }
            let j = oracle::foam::jacobian(sum.strain, sea.lambda());
            let s = ((source.threshold - j) * source.slope).clamp(0.0, 1.0);
            want[i] = oracle::foam::foam_after(want[i], s, sea.foam.rate_per_s, sea.foam.decay_s, step.dt_s);
        }
        // Places of the cells: toroidal.
        let texels = read_foam(gpu, &sim.resources).await?;
        let first = origin.map(|o| (o / foam_level.texel_m).round() as i64);
        got = (0..size * size)
            .map(|i| {
                let place = [(i % size) as i64, (i / size) as i64];
                let at: [usize; 2] = std::array::from_fn(|a| (first[a] + place[a]).rem_euclid(size as i64) as usize);
                texels[level * size * size + at[1] * size + at[0]][0]
            })
            .collect();
    }
    let pack = |v: &[f64]| v.iter().map(|&f| [f]).collect::<Vec<_>>();
    Ok(line("foam", level, error(pack(&got).into_iter(), pack(&want).into_iter()), tolerance::FOAM))
}

/// Steps of the replay that the foam is followed for.
const FOAM_STEPS: usize = 4;

fn line(what: &'static str, cascade: usize, error: f64, tolerance: f64) -> Line {
    Line { what, cascade, error, tolerance }
}

async fn read_lines(gpu: &Gpu, sim: &Simulation, mut encoder: wgpu::CommandEncoder) -> Result<Vec<[f32; 4]>, String> {
    let staging = readback::stage_buffer(gpu, &mut encoder, &sim.resources.lines);
    gpu.submit(encoder);
    Ok(bytemuck::pod_collect_to_vec(&readback::read(gpu, staging).await?))
}

/// One mip level of a map as f64.
async fn read_map(gpu: &Gpu, r: &Resources, kind: MapKind, level: u32) -> Result<Vec<Texel>, String> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let copy = r.stage(gpu, &mut encoder, kind, level);
    read(gpu, encoder, copy).await
}

async fn read_foam(gpu: &Gpu, r: &Resources) -> Result<Vec<Texel>, String> {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let copy = readback::stage_texture(gpu, &mut encoder, &r.foam, 0);
    read(gpu, encoder, copy).await
}

async fn read(gpu: &Gpu, encoder: wgpu::CommandEncoder, copy: TextureCopy) -> Result<Vec<Texel>, String> {
    gpu.submit(encoder);
    let texels = copy.read_map(gpu).await?;
    Ok(texels.into_iter().map(|t| t.map(f64::from)).collect())
}

fn plane(texels: &[[f32; 4]], cascade: usize, pair: usize, n: usize) -> impl Iterator<Item = Texel> + '_ {
    texels[(2 * cascade + pair) * n * n..][..n * n].iter().map(|t| t.map(f64::from))
}

/// Root mean square difference.
fn distance<const C: usize>(got: impl Iterator<Item = [f64; C]>, want: impl Iterator<Item = [f64; C]>) -> f64 {
    root_mean_square::<C>(got.zip(want).map(|(g, w)| std::array::from_fn(|c| g[c] - w[c])))
}

/// Root mean square difference over the root mean square of `want`; the plain difference where that is 0.
fn error<const C: usize>(got: impl Iterator<Item = [f64; C]>, want: impl Iterator<Item = [f64; C]> + Clone) -> f64 {
    let rms = root_mean_square(want.clone());
    distance(got, want) / if rms > 0.0 { rms } else { 1.0 }
}

fn root_mean_square<const C: usize>(values: impl Iterator<Item = [f64; C]>) -> f64 {
    let (sum, count) = values.fold((0.0, 0usize), |(s, n), v| (s + v.iter().map(|x| x * x).sum::<f64>(), n + 1));
    (sum / count.max(1) as f64).sqrt()
}
