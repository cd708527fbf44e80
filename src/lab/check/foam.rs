//! Compares the foam pass with the oracle.

use super::{Comparison, comparison, read, read_map, relative_rms_error};
use crate::gpu::{Gpu, readback};
use crate::oracle::{self, Texel};
use crate::sim::Simulation;
use crate::sim::foam::FoamStep;
use crate::sim::resources::{MapKind, Resources};
use crate::waves::Plan;
use crate::waves::foam::{
    FRONT_DECAY_RATIO, FRONT_GROWTH_RATIO, FoamModel, MEAN_FRONT_RATIO, MEAN_PLUME_RATIO, PLUME_DECAY_RATIO,
    breaker_texel_m,
};
use crate::waves::plan::Cascade;
use crate::waves::tiling::Tiling;

/// Largest accepted rms error of the GPU's foam coverage, divided by the rms of the oracle's. The foam pass filters
/// half-float maps with weights of 8 bits, and the steep source term of the foam amplifies the rounding errors.
const FOAM_TOLERANCE: f64 = 5e-3;
/// Number of foam steps that are computed before the GPU's foam is compared with the oracle's.
const COMPARED_FOAM_STEPS: usize = 4;
/// Index of the foam level that is compared: 0 is the smallest and finest of the square foam grids around the camera.
const COMPARED_FOAM_LEVEL: usize = 1;

/// Compares foam after some steps with the oracle's, which reads the GPU's wave maps: only errors of its pass count.
pub async fn compare_foam(gpu: &Gpu, plan: &Plan, t_s: f64, mut sim: Simulation) -> Result<Comparison, String> {
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
        let s = source.at(j);
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

async fn read_foam(gpu: &Gpu, r: &Resources) -> Result<Vec<Texel>, String> {
    let mut encoder = gpu.encoder("check");
    let copy = readback::stage_texture(gpu, &mut encoder, &r.foam, 0);
    read(gpu, encoder, copy).await
}
