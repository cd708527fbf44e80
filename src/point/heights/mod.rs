//! Height of the sea at a point, computed on the CPU without a read-back from the GPU: for boats, buoys and cameras.
//!
//! The seed of a plan generates more than ten thousand travelling waves, which the GPU draws. [`StrongestWaves`] sums
//! only the strongest of these waves at a point. A thousand waves carry nine tenths of the variance, five thousand
//! 99 %.
//!
//! - **Coordinates**: right-handed, +x east, +y up, -z north, metres and seconds. Heights include the still-water level
//!   (`level_m`).
//! - **Displacement**: the surface is drawn at x = x0 + lambda D(x0) (docs/sea.md, "Synthesis").
//!   [`StrongestWaves::sample`] inverts this equation for a point x of the world;
//!   [`StrongestWaves::sample_undisplaced`] takes x0.
//! - **Second order**: heights, normals and velocities contain the bound waves (`waves::second_order`) of the selected
//!   waves, unless the sea has `order=1`.
//! - **Tiling**: like the drawn sea, the sum blends shifted copies of each patch (`tiling`). Derivatives are those of
//!   the blend.
//! - **Coast**: [`StrongestWaves::with_coast`] adds what a coast makes of the longest waves, as the drawn sea has it.
//! - **Cost**: about 11 ns per wave, copy and evaluation with the vector units of every x86-64. A point sees 1.7 copies
//!   on average, and a sample takes four to six evaluations (one without chop): about 0.1 ms for 1000 waves. The
//!   constructors evaluate all waves of the plan, which takes a few milliseconds at n = 128. A larger FFT size only
//!   adds short waves.
//! - **Accuracy**: the height of a water particle has a Gaussian error with the rms value
//!   [`StrongestWaves::residual_rms_m`]. In a gale (20 m/s, fetch 500 km, Hs 9.7 m) this is 16 % of Hs for 200 waves,
//!   7.5 % for 1000 and 2.1 % for 5000. At a fixed point of the world the error is up to a tenth larger, because the
//!   omitted waves also displace the water sideways. Most of the slope lies in short waves and is lost: see
//!   [`StrongestWaves::residual_slope_rms`].
//! - **Precision**: phases are wrapping integers as on the GPU, and positions are reduced by the patch size, so that
//!   the precision depends neither on the time nor on the distance from the origin. The time resolution is 2^-32 of the
//!   period, 20 microseconds for a day.
//! - **Determinism**: a sample depends only on the plan, the point and the time. Sampling neither allocates nor locks.

use crate::coast::transfer::CoastalWaves;
use crate::waves::Plan;
use crate::waves::lattice::period_fraction_u32;
use crate::waves::plan::Cascade;
pub use record::WaveStaff;
use search::CONVERGED_DISTANCE_M;
use sums::WaveSums;
use waves::{CandidateWave, PatchWaves, candidate_waves};

mod ashore;
mod record;
mod search;
mod sums;
#[cfg(test)]
mod tests;
mod waves;

/// The strongest waves of a sea, from which heights and other properties of the surface are computed at single points.
///
/// ```
/// use seastate::point::StrongestWaves;
/// use seastate::state::query;
/// use seastate::waves::Plan;
///
/// let (params, notices) = query::parse("wind=14&fetch=300&seed=7&n=128");
/// assert!(notices.is_empty());
/// let plan = Plan::new(&params);
/// let sea = StrongestWaves::new(&plan, 1000);
/// // 120 m east and 45 m north of the origin, at 3600 s.
/// let here = sea.sample(120.0, -45.0, 3600.0);
/// assert!(here.converged && here.height_m.abs() < plan.hs_m());
/// println!("{:.2} m high, rising at {:.2} m/s", here.height_m, here.velocity_m_s[1]);
/// assert!(sea.residual_rms_m() < 0.1 * plan.hs_m());
/// // As many waves as an rms error of 10 cm needs.
/// assert!(StrongestWaves::for_height_error(&plan, 0.1).residual_rms_m() <= 0.1);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct StrongestWaves {
    patches: Vec<PatchWaves>,
    /// Waves at a coast.
    coast: Option<Box<CoastalWaves>>,
    /// Fraction by which bound waves increase the elevation (`BoundWaves::elevation_gain`).
    elevation_gain: f64,
    wave_count: usize,
    /// Square roots of the chop factors lambda (factors on the horizontal displacement) along x and z.
    sqrt_chop: [f64; 2],
    still_water_level_m: f64,
    period_s: f64,
    /// Longest Newton step of the search for a particle, in m after division by the square root of the chop
    /// (`sqrt_chop`).
    longest_step_m: f64,
    kept_m2: f64,
    left_out_m2: f64,
    left_out_mss: f64,
}

/// State of the sea surface at a point: height, normal, velocity and position of the water particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSample {
    /// Height (y) of the surface in the world, m; it includes the still-water level.
    pub height_m: f64,
    /// Unit normal (x, y, z) of the drawn surface. It points up, except inside a fold (negative `jacobian`).
    pub normal: [f64; 3],
    /// Orbital velocity (x, y, z) of the water particle at the surface in linear theory, m/s: (dDx/dt, d eta/dt,
    /// dDz/dt) with the elevation eta and the horizontal displacement D without the chop factor.
    pub velocity_m_s: [f64; 3],
    /// Position (x, z) of the water particle before displacement by the waves, m.
    pub undisplaced_xz: [f64; 2],
    /// Position (x, z) of the water particle after displacement by the waves, m; the requested point if `converged`.
    pub world_xz: [f64; 2],
    /// Jacobian of the horizontal displacement: 1 in undeformed water, below 1 at crests, negative inside a fold.
    pub jacobian: f64,
    /// Whether the search has found the particle at the requested point: `world_xz` is within 1e-8 m of it.
    pub converged: bool,
}

/// The waves of a plan by decreasing variance.
fn ranked_waves(plan: &Plan) -> Vec<CandidateWave> {
    let mut waves = candidate_waves(plan);
    waves.sort_unstable_by(CandidateWave::by_decreasing_variance);
    waves
}

/// Number of the first of `waves`, sorted by decreasing variance, that keep the rms height of the others at or below
/// `rms_m` (m).
fn count_for_height_error(waves: &[CandidateWave], rms_m: f64) -> usize {
    let allowed_m2 = if rms_m > 0.0 { rms_m * rms_m } else { 0.0 };
    let mut left_out_m2 = 0.0;
    let dropped = waves.iter().rev().take_while(|wave| {
        left_out_m2 += wave.variance();
        left_out_m2 <= allowed_m2
    });
    waves.len() - dropped.count()
}

impl StrongestWaves {
    /// Selects the strongest waves of a planned sea, those of the largest variance, at most `wave_count` of them.
    pub fn new(plan: &Plan, wave_count: usize) -> Self {
        let mut waves = candidate_waves(plan);
        let count = wave_count.min(waves.len());
        if count > 0 && count < waves.len() {
            waves.select_nth_unstable_by(count - 1, CandidateWave::by_decreasing_variance);
        }
        Self::from_waves(plan, waves, count)
    }

    /// Selects the strongest waves of a planned sea, as few as keep the rms height of the omitted waves at or below
    /// `rms_m` (m). If `rms_m` is 0, negative or NaN, all waves are selected.
    pub fn for_height_error(plan: &Plan, rms_m: f64) -> Self {
        let waves = ranked_waves(plan);
        let count = count_for_height_error(&waves, rms_m);
        Self::from_waves(plan, waves, count)
    }

    /// The waves of [`Self::for_height_error`] and those of [`Self::new`], in this order, for the time that one of them
    /// takes: a plan has many thousand waves to choose from.
    pub(crate) fn for_height_error_and_count(plan: &Plan, rms_m: f64, wave_count: usize) -> [Self; 2] {
        let waves = ranked_waves(plan);
        let counts = [count_for_height_error(&waves, rms_m), wave_count.min(waves.len())];
        counts.map(|count| Self::from_waves(plan, waves.clone(), count))
    }

    /// Selects the first `count` of `waves`; the others only count in `residual_rms_m` and `residual_slope_rms`.
    fn from_waves(plan: &Plan, mut waves: Vec<CandidateWave>, count: usize) -> Self {
        let left_out = waves.split_off(count);
        waves.sort_unstable_by(CandidateWave::by_decreasing_variance);
        let variance = |waves: &[CandidateWave]| waves.iter().fold(0.0, |sum, w| sum + w.variance());
        let slope = |w: &CandidateWave| {
            w.variance() * f64::from(w.squared_wave_vector_index()) * plan.cascades[w.cascade_index].dk().powi(2)
        };
        let bound_waves = plan.bound_waves();
        let patch = |(i, cascade): (usize, &Cascade)| {
            let of_cascade = |waves: &'_ [CandidateWave]| {
                waves.iter().filter(|w| w.cascade_index == i).fold(0.0, |sum, w| sum + w.variance())
            };
            let (kept, omitted) = (of_cascade(&waves), of_cascade(&left_out));
            let mut bound = bound_waves.cascades.get(i).copied().unwrap_or_default();
            bound.level_m *= kept / (kept + omitted).max(f64::MIN_POSITIVE);
            PatchWaves::new(plan, cascade, bound, waves.iter().filter(|w| w.cascade_index == i))
        };
        let patches: Vec<PatchWaves> =
            (plan.cascades.iter().enumerate()).map(patch).filter(|patch| !patch.waves_by_four.is_empty()).collect();
        let displacement_m2 = waves.iter().map(|w| {
            let orbit = plan
                .wave_at_squared_index(&plan.cascades[w.cascade_index], w.squared_wave_vector_index())
                .orbit_width_over_height;
            w.variance() * orbit * orbit
        });
        let sqrt_chop = plan.sea.choppiness_xz().map(|l| l.max(0.0).sqrt());
        Self {
            longest_step_m: 2.0 * sqrt_chop[0].max(sqrt_chop[1]) * displacement_m2.sum::<f64>().sqrt(),
            patches,
            coast: None,
            elevation_gain: bound_waves.totals.elevation_gain,
            wave_count: count,
            sqrt_chop,
            still_water_level_m: plan.sea.still_water_level_m,
            period_s: plan.repeat_period_s,
            kept_m2: variance(&waves),
            left_out_m2: variance(&left_out),
            left_out_mss: left_out.iter().map(slope).fold(0.0, |sum, s| sum + s),
        }
    }

    /// Number of selected waves.
    pub fn wave_count(&self) -> usize {
        self.wave_count
    }

    /// Rms height of the omitted waves, m: the rms error of the heights.
    pub fn residual_rms_m(&self) -> f64 {
        self.left_out_m2.sqrt()
    }

    /// Rms slope of the omitted waves (m/m), the rms length of their height gradient: the error of the slope.
    pub fn residual_slope_rms(&self) -> f64 {
        self.left_out_mss.sqrt()
    }

    /// Fraction (0 to 1) of the elevation variance of all waves that the selected ones carry; 1 for a calm sea.
    pub fn variance_fraction(&self) -> f64 {
        let all = self.kept_m2 + self.left_out_m2;
        if all > 0.0 { self.kept_m2 / all } else { 1.0 }
    }

    /// Samples the surface at the point (`x_m`, `z_m`) of the world, m, at time `t_s`, s.
    ///
    /// Where the surface is folded, several water particles lie at one point. The sample describes one where the
    /// surface is not overturned. It depends only on the arguments, but can jump from one point to the next. If the
    /// search fails, `converged` is false and the sample describes a particle near the point, at `world_xz`. Infinite
    /// or NaN arguments give still water, with `converged` false. All numbers of a sample are finite in every case.
    pub fn sample(&self, x_m: f64, z_m: f64, t_s: f64) -> SurfaceSample {
        if ![x_m, z_m, t_s].iter().all(|v| v.is_finite()) {
            return self.still_water();
        }
        let time = period_fraction_u32(self.period_s, t_s);
        let (offset, sums, converged) = self.find_particle_offset([x_m, z_m], time, [0.0; 2], CONVERGED_DISTANCE_M);
        self.surface_sample([x_m, z_m], offset, &sums, converged)
    }

    /// Samples the surface at many points (x, z) of the world, m, at time `t_s`, s.
    pub fn sample_many(&self, points: &[[f64; 2]], t_s: f64) -> Vec<SurfaceSample> {
        points.iter().map(|&[x_m, z_m]| self.sample(x_m, z_m, t_s)).collect()
    }

    /// Describes the water particle that has the position (`x0_m`, `z0_m`), m, before displacement, at time `t_s`, s.
    /// It needs no search, only one evaluation of the waves. Infinite and NaN arguments give still water.
    pub fn sample_undisplaced(&self, x0_m: f64, z0_m: f64, t_s: f64) -> SurfaceSample {
        if ![x0_m, z0_m, t_s].iter().all(|v| v.is_finite()) {
            return self.still_water();
        }
        let blends = self.patch_copy_blends([x0_m, z0_m], [0.0; 2]);
        let sums = self.wave_sums_at([x0_m, z0_m], [0.0; 2], period_fraction_u32(self.period_s, t_s), &blends);
        self.surface_sample([x0_m, z0_m], [0.0; 2], &sums, true)
    }

    fn still_water(&self) -> SurfaceSample {
        self.surface_sample([0.0; 2], [0.0; 2], &WaveSums::default(), false)
    }

    /// Makes the sample of the particle at the undisplaced position `point - offset` from its wave sums.
    fn surface_sample(&self, point: [f64; 2], offset: [f64; 2], sums: &WaveSums, converged: bool) -> SurfaceSample {
        let [lx, lz] = self.sqrt_chop.map(|r| r * r);
        let [xx, zz, xz, zx] = sums.whole_strain();
        let [bound_m, bound_x, bound_z, bound_m_s] = sums.bound_height_m;
        let [sx, sz] = sums.whole_slope();
        let [sx, sz] = [sx + bound_x, sz + bound_z];
        let [ux, uy, uz] = sums.orbital_velocity_m_s;
        // Jacobian and normal by docs/sea.md, "Synthesis".
        let jacobian = (1.0 + lx * xx) * (1.0 + lz * zz) - lx * lz * xz * zx;
        let normal = [-(sx * (1.0 + lz * zz) - sz * lz * zx), jacobian, -(sz * (1.0 + lx * xx) - sx * lx * xz)];
        let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
        SurfaceSample {
            height_m: self.still_water_level_m + sums.elevation_m + bound_m,
            normal: if length > 0.0 { normal.map(|c| c / length) } else { [0.0, 1.0, 0.0] },
            velocity_m_s: [ux, uy + bound_m_s, uz],
            undisplaced_xz: [point[0] - offset[0], point[1] - offset[1]],
            // Offset and displacement nearly cancel. Taking their difference first keeps the digits of far points.
            world_xz: [
                point[0] + (lx * sums.displacement_m[0] - offset[0]),
                point[1] + (lz * sums.displacement_m[1] - offset[1]),
            ],
            jacobian,
            converged,
        }
    }
}
