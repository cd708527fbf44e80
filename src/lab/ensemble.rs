//! Measures statistics of the sea in the GPU's wave maps over an ensemble of seeds.

use super::estimate::EstimateWithError;
use crate::gpu::{Gpu, readback};
use crate::oracle::foam::displacement_jacobian;
use crate::oracle::surface::bound_height_m;
use crate::oracle::{self, transform};
use crate::shaders::Shaders;
use crate::sim::{MAX_FOAM_STEPS, MapsF32, Simulation};
use crate::state::Params;
use crate::waves::plan::Cascade;
use crate::waves::statistics::{self, SpectralMoments};
use crate::waves::{Plan, noise};
use std::f64::consts::{PI, TAU};

/// Phase by which the wave of highest frequency advances between the two read-backs of a seed's wave maps, rad. The
/// change of phase tells waves of opposite directions apart.
const HIGHEST_FREQUENCY_PHASE_ADVANCE_RAD: f64 = 1.0;
/// Number of random points of the displaced surface that each seed contributes to skewness and kurtosis.
const SURFACE_POINTS_PER_SEED: u32 = 1 << 16;

/// Statistics measured in the GPU's f32 wave maps. Heights and slopes are those of the undisplaced grid. Periods and
/// directions come from maps at two times, which tell waves of opposite directions apart. Skewness and kurtosis belong
/// to the displaced surface, whose points are weighted by the Jacobian.
#[derive(Debug)]
pub struct MeasuredStatistics {
    /// Significant wave height, m, from the variance averaged over the seeds.
    pub hs_m: EstimateWithError,
    /// Mean elevation of the surface, m.
    pub mean_elevation_m: EstimateWithError,
    /// Mean square slope of the undisplaced surface: mean of (d eta/dx)^2 + (d eta/dz)^2, dimensionless.
    pub mss: EstimateWithError,
    /// Mean wave period Tm01 = 2 pi m0 / m1, s, with the spectral moments m0 and m1.
    pub tm01_s: EstimateWithError,
    /// Mean zero-crossing period Tm02 = 2 pi sqrt(m0 / m2), s, with the spectral moments m0 and m2.
    pub tm02_s: EstimateWithError,
    /// Mean direction that the waves come from, degrees clockwise from north; `None` without a mean direction.
    pub mean_from_deg: Option<EstimateWithError>,
    /// First directional moment r1: 0 without a mean direction, 1 if all waves travel in one direction.
    pub r1: EstimateWithError,
    /// Directional spread sqrt(2 (1 - r1)), converted to degrees, with the first directional moment r1.
    pub spread_deg: EstimateWithError,
    /// Skewness of the surface's elevation; 0 for a Gaussian.
    pub skewness: EstimateWithError,
    /// Kurtosis of the surface's elevation; 3 for a Gaussian.
    pub kurtosis: EstimateWithError,
    /// Largest difference, over the seeds, between the variance of the heights in the maps and that of the plan's waves
    /// at the same time, divided by the latter. Apart from rounding it is 0 by Parseval's theorem.
    pub parseval_error: f64,
    /// Number of seeds that were measured.
    pub seed_count: u32,
}

/// Statistics measured in the GPU's wave maps of one seed; `summarise_seeds` averages them.
pub struct SeedStatistics {
    variance: f64,
    mean: f64,
    mss: f64,
    skewness: f64,
    kurtosis: f64,
    travelling: SpectralMoments,
    parseval_error: f64,
}

/// A wave of the sea with one wave vector. The wave that travels in the opposite direction is a separate one.
#[derive(Clone, Copy, Debug)]
pub struct TravellingWave {
    /// Variance of the surface elevation that this wave alone causes, m^2.
    pub variance_m2: f64,
    /// Wave number, rad/m.
    pub k: f64,
    /// Angular frequency, rad/s.
    pub omega: f64,
    /// Unit vector (x, z) of the direction in which the wave travels.
    pub travel_direction: [f64; 2],
}

/// Measures the statistics of the sea of `params` on the GPU over `seeds` random seeds: its own seed and those after
/// it. Calls `visit` for every wave of every seed, with the index of the seed (from 0).
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn measure(
    gpu: &Gpu,
    sim: &mut Simulation,
    params: &Params,
    seeds: u32,
    visit: &mut dyn FnMut(usize, &TravellingWave),
) -> Result<MeasuredStatistics, String> {
    let shaders = Shaders::default();
    let t_s = params.clock.t_s;
    let plan = Plan::new(params);
    let later_s = t_s + HIGHEST_FREQUENCY_PHASE_ADVANCE_RAD / plan.dispersion.omega(plan.k_max());
    let mut all = Vec::new();
    for i in 0..seeds {
        let mut params = params.clone();
        params.sea.seed = params.sea.seed.wrapping_add(i);
        let plan = Plan::new(&params);
        sim.set_plan(gpu, plan.clone(), &shaders);
        let maps = [sim.read_maps_f32(gpu, t_s).await?, sim.read_maps_f32(gpu, later_s).await?];
        all.push(seed_statistics(&plan, &maps, [t_s, later_s], &mut |wave| visit(i as usize, wave)));
    }
    Ok(summarise_seeds(&all))
}

/// Statistics over all seeds with standard errors: means over the seeds; for periods and r1, ratios of such means.
fn summarise_seeds(all: &[SeedStatistics]) -> MeasuredStatistics {
    let values = |f: &dyn Fn(&SeedStatistics) -> f64| all.iter().map(f).collect::<Vec<_>>();
    let over = |f: &dyn Fn(&SeedStatistics) -> f64| EstimateWithError::mean(&values(f));
    let variance = over(&|s| s.variance);
    let hs_m = 4.0 * variance.value.sqrt();
    let [m0, m1, m2] = [0, 1, 2].map(|p| values(&|s| s.travelling.moments[p]));
    let [east, south] = [0, 1].map(|axis| values(&|s| s.travelling.first_moment[axis]));
    let (x, z) = (east.iter().sum::<f64>(), south.iter().sum::<f64>());
    let length = x.hypot(z).max(f64::MIN_POSITIVE);
    let component =
        |a: f64, b: f64| -> Vec<f64> { east.iter().zip(&south).map(|(e, s)| (e * a + s * b) / length).collect() };
    // Components of the directional moments along the mean direction and across it.
    let (along, across) = (component(x, z), component(-z, x));
    let r1 = EstimateWithError::ratio(&along, &m0);
    let turn_deg = EstimateWithError::ratio(&across, &along).scaled(180.0 / PI);
    let tm02 = EstimateWithError::ratio(&m0, &m2);
    MeasuredStatistics {
        hs_m: variance.with_propagated_error(hs_m, 0.5 * hs_m / variance.value.max(f64::MIN_POSITIVE)),
        mean_elevation_m: over(&|s| s.mean),
        mss: over(&|s| s.mss),
        tm01_s: EstimateWithError::ratio(&m0, &m1).scaled(TAU),
        tm02_s: tm02.with_propagated_error(TAU * tm02.value.sqrt(), TAU * 0.5 / tm02.value.sqrt().max(1e-9)),
        mean_from_deg: (r1.value > statistics::MIN_R1_FOR_DIRECTION)
            .then(|| turn_deg.with_propagated_error(statistics::bearing_waves_come_from_deg([x, z]), 1.0)),
        r1,
        spread_deg: spread_deg(r1),
        skewness: over(&|s| s.skewness),
        kurtosis: over(&|s| s.kurtosis),
        parseval_error: all.iter().map(|s| s.parseval_error).fold(0.0, f64::max),
        seed_count: all.len() as u32,
    }
}

/// Converts a first directional moment r1 to the directional spread sqrt(2 (1 - r1)), degrees, with its standard error.
pub fn spread_deg(r1: EstimateWithError) -> EstimateWithError {
    let deg = statistics::spread_deg(r1.value);
    r1.with_propagated_error(deg, 180.0 / PI / deg.to_radians().max(1e-9))
}

/// Computes the statistics of one seed from its wave maps at two times (s), and calls `visit` for every wave of it.
fn seed_statistics(
    plan: &Plan,
    maps: &[MapsF32; 2],
    times: [f64; 2],
    visit: &mut dyn FnMut(&TravellingWave),
) -> SeedStatistics {
    let (mut variance, mut mean, mut mss) = (0.0, 0.0, 0.0);
    let now = &maps[0];
    let count = (now.n * now.n) as f64;
    let mut travelling = SpectralMoments::default();
    for (c, cascade) in plan.cascades.iter().enumerate() {
        let level = now.displacement(c).iter().map(|d| f64::from(d[1])).sum::<f64>() / count;
        mean += level;
        variance += now.displacement(c).iter().map(|d| (f64::from(d[1]) - level).powi(2)).sum::<f64>() / count;
        mss += now.gradients(c).iter().map(|g| f64::from(g[0]).powi(2) + f64::from(g[1]).powi(2)).sum::<f64>() / count;
        let displacements = [0, 1].map(|i: usize| maps[i].displacement(c));
        travelling_waves(plan, cascade, displacements, times, &mut |wave| {
            travelling.add(wave.variance_m2, wave.k, wave.omega, wave.travel_direction);
            visit(wave);
        });
    }
    let expected = statistics::realised_variance(plan, times[0]);
    let parseval_error = if expected == 0.0 { variance } else { (variance - expected).abs() / expected };
    let mut sums = [0.0; 5];
    visit_surface_points(plan, now, &mut |eta, weight| {
        sums.iter_mut().zip(0..).for_each(|(sum, power)| *sum += weight * eta.powi(power));
    });
    let [_, _, skewness, kurtosis] = statistics::mean_sd_skewness_kurtosis(sums);
    SeedStatistics { variance, mean, mss, skewness, kurtosis, travelling, parseval_error }
}

/// Separates the waves of a cascade by direction of travel, and calls `visit` for each. `displacements` are its maps at
/// two `times` (s). At the wave vector k, the Fourier coefficient of the heights is A e^{-i w t} + B* e^{+i w t}, with
/// the angular frequency w and the amplitudes A and B of the waves that travel along k and -k. Its values at two times
/// determine A. The variance of the wave is 2 |A|^2.
fn travelling_waves(
    plan: &Plan,
    cascade: &Cascade,
    displacements: [&[[f32; 4]]; 2],
    times: [f64; 2],
    visit: &mut dyn FnMut(&TravellingWave),
) {
    let n = plan.n as usize;
    let [first, second] = displacements.map(|d| fourier_transform_of_heights(n, d));
    let passed = plan.period_fraction_u32(times[1]).wrapping_sub(plan.period_fraction_u32(times[0]));
    let scale = 1.0 / (n * n) as f64;
    for z in 0..n {
        for x in 0..n {
            let (ix, iz) = (oracle::signed_index(x, n), oracle::signed_index(z, n));
            let wave = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32);
            if (ix, iz) == (0, 0)
                || !cascade.contains_wave_number(wave.k)
                || ix == -(n as i32) / 2
                || iz == -(n as i32) / 2
            {
                continue;
            }
            let at = z * n + x;
            let turn = TAU * f64::from(wave.cycles_per_period.wrapping_mul(passed)) / 4_294_967_296.0;
            let (sin, cos) = turn.sin_cos();
            // The transforms are conjugates: A* = (X2* - X1* e^{-i turn}) / (2 i sin turn).
            let (a, b) = (first[at], second[at]);
            let re = b[0] - (a[0] * cos + a[1] * sin);
            let im = b[1] - (a[1] * cos - a[0] * sin);
            let amplitude = scale / (2.0 * sin);
            let variance = 2.0 * (re * re + im * im) * amplitude * amplitude;
            let unit = [f64::from(ix), f64::from(iz)].map(|i| i * cascade.dk() / wave.k);
            visit(&TravellingWave { variance_m2: variance, k: wave.k, omega: wave.omega, travel_direction: unit });
        }
    }
}

/// Inverse Fourier transform (real, imaginary) of the heights in a displacement map of n x n texels, without the factor
/// 1/n^2. Heights are real, so it is the complex conjugate of the forward transform.
pub fn fourier_transform_of_heights(n: usize, displacement: &[[f32; 4]]) -> Vec<[f64; 2]> {
    let heights: Vec<[f64; 2]> = displacement.iter().map(|d| [f64::from(d[1]), 0.0]).collect();
    transform::inverse_2d(n, &heights)
}

/// Calls `visit` at `SURFACE_POINTS_PER_SEED` random points of the sea, with the elevation (m) and the Jacobian (area
/// of a displaced surface element over its area at rest). Cascades are independent and homogeneous, so a point is the
/// sum of a random texel of each.
pub fn visit_surface_points(plan: &Plan, maps: &MapsF32, visit: &mut dyn FnMut(f64, f64)) {
    let n = maps.n as u32;
    let bound = plan.bound_waves();
    let mut displacements = vec![[0.0; 3]; maps.cascade_count()];
    for i in 0..SURFACE_POINTS_PER_SEED {
        let (mut eta, mut strain) = (0.0, [0.0; 3]);
        for c in 0..maps.cascade_count() {
            let at = noise::pcg4d([i, c as u32, plan.sea.seed, 17]);
            let at = ((at[0] % n) * n + at[1] % n) as usize;
            let (d, g) = (maps.displacement(c)[at], maps.gradients(c)[at]);
            displacements[c] = [d[0], d[1], d[2]].map(f64::from);
            eta += displacements[c][1];
            strain[0] += f64::from(g[2]);
            strain[1] += f64::from(g[3]);
            strain[2] += f64::from(d[3]);
        }
        eta += bound_height_m(&displacements, &bound);
        visit(eta, displacement_jacobian([strain[0], strain[1], strain[2], strain[2]], plan.sea.choppiness_xz()));
    }
}

/// Mean foam coverage (0 to 1) over all cells of all foam levels at time `t_s`, s. Computes the foam steps before that
/// time first, because foam depends on earlier waves.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn mean_foam(gpu: &Gpu, sim: &mut Simulation, t_s: f64) -> Result<f64, String> {
    let levels = foam_levels(gpu, sim, t_s, [0.0; 2]).await?;
    let count: usize = levels.iter().map(Vec::len).sum();
    Ok(levels.iter().flatten().map(|&f| f64::from(f)).sum::<f64>() / count as f64)
}

/// Foam coverage (0 to 1) of every cell, for each foam level (a square grid around `centre`, x and z in m) at time
/// `t_s`, s. Computes the foam steps before that time first. With n cells along a side, a cell whose corner lies at x =
/// i and z = j cell sides from the world's origin is stored in column i modulo n of row j modulo n.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn foam_levels(gpu: &Gpu, sim: &mut Simulation, t_s: f64, centre: [f64; 2]) -> Result<Vec<Vec<f32>>, String> {
    let mut encoder = gpu.encoder("foam");
    sim.encode(gpu, &mut encoder, t_s, centre, MAX_FOAM_STEPS);
    let copy = readback::stage_texture(gpu, &mut encoder, &sim.resources.foam, 0);
    gpu.submit(encoder);
    let texels = copy.read_map(gpu).await?;
    let size = sim.resources.foam_n as usize;
    Ok(texels.chunks(size * size).map(|level| level.iter().map(|t| t[0]).collect()).collect())
}
