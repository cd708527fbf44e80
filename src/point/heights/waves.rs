//! Selected waves of a planned sea, and the sums of their heights and displacements in a patch.

use super::sums::WaveSums;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::second_order::CascadeBoundWaves;
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use crate::waves::tiling::Tiling;
use glam::DVec4;
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_2;

/// The strongest waves of one cascade, and the tiling that blends shifted copies of its patch into a sea.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PatchWaves {
    pub(super) side_m: f64,
    pub(super) tiling: Tiling,
    pub(super) dk_rad_m: f64,
    pub(super) waves_by_four: Vec<FourWaves>,
    /// Bound waves of the second order of this cascade; its level is that of the selected waves.
    pub(super) bound: CascadeBoundWaves,
    /// Whether these are waves of the first cascade that a coast transforms; the other waves of this cascade follow.
    pub(super) is_offshore: bool,
}

/// Four travelling waves eta = Re[h e^{i (k.x - omega t)}], one per lane of the CPU's vector units. h is twice the
/// initial Fourier amplitude h0 of the wave vector k; unused lanes have h = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FourWaves {
    /// Components `ix` and `iz` of the wave vector of each lane, in units of the lattice spacing dk; whole numbers.
    ix: DVec4,
    iz: DVec4,
    /// Real (`re`) and imaginary part (`im`) of the complex amplitude h of each lane, m.
    pub(super) amplitude_re_m: DVec4,
    pub(super) amplitude_im_m: DVec4,
    /// Factor coth(k depth) / |(ix, iz)| of each lane, which turns h (ix, iz) into the amplitude of D = (Dx, Dz).
    orbit_width_over_height: DVec4,
    omega_rad_s: DVec4,
    /// Angular frequency of each lane as a multiple of 2 pi / period: number of cycles in the period of the sea.
    cycles_per_period: [u32; 4],
}

impl FourWaves {
    /// Elevation variance of a lane, m^2.
    fn variance(&self, lane: usize) -> f64 {
        0.5 * (self.amplitude_re_m[lane].powi(2) + self.amplitude_im_m[lane].powi(2))
    }

    /// Takes the wave of the lane `from` of other waves into the lane `to`.
    fn set(&mut self, to: usize, other: &Self, from: usize) {
        self.ix[to] = other.ix[from];
        self.iz[to] = other.iz[from];
        self.amplitude_re_m[to] = other.amplitude_re_m[from];
        self.amplitude_im_m[to] = other.amplitude_im_m[from];
        self.orbit_width_over_height[to] = other.orbit_width_over_height[from];
        self.omega_rad_s[to] = other.omega_rad_s[from];
        self.cycles_per_period[to] = other.cycles_per_period[from];
    }
}

/// A wave that the seed of a plan generates: a candidate for the selection of the strongest waves.
#[derive(Clone)]
pub(super) struct CandidateWave {
    /// Index of the cascade to which the wave belongs.
    pub(super) cascade_index: usize,
    ix: i32,
    iz: i32,
    h0: [f64; 2],
}

impl CandidateWave {
    /// Elevation variance of the wave, 2 |h0|^2 with its initial amplitude h0, m^2.
    pub(super) fn variance(&self) -> f64 {
        2.0 * (self.h0[0] * self.h0[0] + self.h0[1] * self.h0[1])
    }

    /// Whether the wave belongs to the cascade `cascade_index`, and `has_index` holds for its lattice indices.
    pub(super) fn is_of(&self, cascade_index: usize, has_index: impl Fn([i32; 2]) -> bool) -> bool {
        self.cascade_index == cascade_index && has_index([self.ix, self.iz])
    }

    /// Square of the wave number in units of the lattice spacing, ix^2 + iz^2.
    pub(super) fn squared_wave_vector_index(&self) -> u32 {
        (self.ix * self.ix + self.iz * self.iz) as u32
    }

    /// Ordering of waves by decreasing variance; waves of equal variance are ordered by cascade, iz and ix.
    pub(super) fn by_decreasing_variance(&self, other: &Self) -> Ordering {
        let place = |c: &Self| (c.cascade_index, c.iz, c.ix);
        other.variance().total_cmp(&self.variance()).then_with(|| place(self).cmp(&place(other)))
    }
}

impl PatchWaves {
    pub(super) fn new<'a>(
        plan: &Plan,
        cascade: &Cascade,
        bound: CascadeBoundWaves,
        waves: impl Iterator<Item = &'a CandidateWave>,
    ) -> Self {
        let mut blocks: Vec<FourWaves> = Vec::new();
        for (i, candidate) in waves.enumerate() {
            let lane = i % 4;
            if lane == 0 {
                blocks.push(FourWaves::default());
            }
            let block = &mut blocks[i / 4];
            let wave = plan.wave_at_squared_index(cascade, candidate.squared_wave_vector_index());
            block.ix[lane] = f64::from(candidate.ix);
            block.iz[lane] = f64::from(candidate.iz);
            block.amplitude_re_m[lane] = 2.0 * candidate.h0[0];
            block.amplitude_im_m[lane] = 2.0 * candidate.h0[1];
            block.orbit_width_over_height[lane] =
                wave.orbit_width_over_height / f64::from(candidate.squared_wave_vector_index()).sqrt();
            block.omega_rad_s[lane] = wave.omega;
            block.cycles_per_period[lane] = wave.cycles_per_period;
        }
        Self {
            side_m: cascade.patch_m,
            tiling: plan.tiling(cascade),
            dk_rad_m: cascade.dk(),
            waves_by_four: blocks,
            bound,
            is_offshore: false,
        }
    }

    /// Parts the waves into those for whose lattice indices (along x and z) `is_first` holds, and the others, each
    /// with its share of the level of the bound waves.
    pub(super) fn parted(&self, is_first: impl Fn([i32; 2]) -> bool) -> [Self; 2] {
        let mut parts: [Vec<FourWaves>; 2] = Default::default();
        let (mut counts, mut variances) = ([0; 2], [0.0; 2]);
        for block in &self.waves_by_four {
            for lane in (0..4).filter(|lane| block.variance(*lane) > 0.0) {
                let part = usize::from(!is_first([block.ix[lane] as i32, block.iz[lane] as i32]));
                let to = counts[part] % 4;
                if to == 0 {
                    parts[part].push(FourWaves::default());
                }
                parts[part][counts[part] / 4].set(to, block, lane);
                counts[part] += 1;
                variances[part] += block.variance(lane);
            }
        }
        let all = (variances[0] + variances[1]).max(f64::MIN_POSITIVE);
        let [first, others] = parts;
        let part = |waves_by_four: Vec<FourWaves>, variance: f64| {
            let bound = CascadeBoundWaves { level_m: self.bound.level_m * variance / all, ..self.bound };
            Self { waves_by_four, bound, ..*self }
        };
        [part(first, variances[0]), part(others, variances[1])]
    }

    /// Number of the waves.
    pub(super) fn wave_count(&self) -> usize {
        self.waves_by_four.iter().map(|block| (0..4).filter(|lane| block.variance(*lane) > 0.0).count()).sum()
    }

    /// Elevation variance of the waves, m^2.
    pub(super) fn variance_m2(&self) -> f64 {
        self.waves_by_four.iter().map(|block| (0..4).map(|lane| block.variance(lane)).sum::<f64>()).sum()
    }

    /// Sums over the patch's waves at the undisplaced point (`x`, `z`), in units of the patch's side; `time` counts
    /// 2^32 ticks per period of the sea.
    pub(super) fn wave_sums_in_patch(&self, x: f64, z: f64, time: u32) -> WaveSums {
        // Sums per lane, without common factors: eta, its slopes, D, strain (xx, zz, xz), velocity, potential.
        let mut sums = [DVec4::ZERO; 12];
        for &FourWaves {
            ix,
            iz,
            amplitude_re_m: re,
            amplitude_im_m: im,
            orbit_width_over_height,
            omega_rad_s,
            cycles_per_period,
        } in &self.waves_by_four
        {
            // Signed integers convert to f64 with vector instructions; a subtracted whole turn has no effect.
            let turned = DVec4::from_array(cycles_per_period.map(|t| f64::from(t.wrapping_mul(time) as i32)));
            let (sin, cos) = sin_cos_turns(ix * x + iz * z - turned * (1.0 / 4_294_967_296.0));
            // Complex elevation h e^{i (k.x - omega t)}.
            let (h_re, h_im) = (re * cos - im * sin, re * sin + im * cos);
            let (d_re, d_im) = (orbit_width_over_height * h_re, orbit_width_over_height * h_im);
            let speed = omega_rad_s * d_re;
            let (along_x, along_z) = (ix * d_re, iz * d_re);
            sums[0] += h_re;
            sums[1] += ix * h_im;
            sums[2] += iz * h_im;
            sums[3] += ix * d_im;
            sums[4] += iz * d_im;
            sums[5] += ix * along_x;
            sums[6] += iz * along_z;
            sums[7] += iz * along_x;
            sums[8] += ix * speed;
            sums[9] += omega_rad_s * h_im;
            sums[10] += iz * speed;
            sums[11] += d_re;
        }
        let [eta, sx, sz, dx, dz, xx, zz, xz, ux, uy, uz, potential] = sums.map(DVec4::element_sum);
        WaveSums {
            elevation_m: eta,
            slope: [-self.dk_rad_m * sx, -self.dk_rad_m * sz],
            displacement_m: [-dx, -dz],
            strain: [-self.dk_rad_m * xx, -self.dk_rad_m * zz, -self.dk_rad_m * xz],
            orbital_velocity_m_s: [ux, uy, uz],
            displacement_potential_m2: potential / self.dk_rad_m,
            ..WaveSums::default()
        }
    }
}

/// All waves with a non-zero amplitude, of all cascades, that the seed of a plan generates.
pub(super) fn candidate_waves(plan: &Plan) -> Vec<CandidateWave> {
    let mut waves = Vec::new();
    for (i, cascade) in plan.cascades.iter().enumerate() {
        let table = SpectrumTable::new(plan, cascade);
        let filled = lattice_indices(plan.n).filter(|&(ix, iz)| table.waves[entry_index(ix, iz)].k > 0.0);
        let candidate =
            |(ix, iz)| CandidateWave { cascade_index: i, ix, iz, h0: initial_amplitude(plan, cascade, &table, ix, iz) };
        waves.extend(filled.map(candidate).filter(|wave| wave.variance() > 0.0));
    }
    waves
}

/// Returns the sines and the cosines of four angles 2 pi `turns`, with an error below 2e-15, for |turns| below 2^50.
///
/// It has no branches or calls, so the compiler can vectorise it: a Taylor series at a quarter of the angle is followed
/// by two doublings of the angle.
#[inline]
pub(super) fn sin_cos_turns(turns: DVec4) -> (DVec4, DVec4) {
    // Adding and subtracting 1.5 x 2^52 rounds to a whole number.
    const ROUNDING_MAGIC: f64 = 6_755_399_441_055_744.0;
    // Factorials 3!, 5! ... 15! and 2!, 4! ... 16!; the truncated terms are below 5e-17.
    const ODD_FACTORIALS: [f64; 7] =
        [6.0, 120.0, 5_040.0, 362_880.0, 39_916_800.0, 6_227_020_800.0, 1_307_674_368_000.0];
    const EVEN_FACTORIALS: [f64; 8] =
        [2.0, 24.0, 720.0, 40_320.0, 3_628_800.0, 479_001_600.0, 87_178_291_200.0, 20_922_789_888_000.0];
    let angle = (turns - ((turns + ROUNDING_MAGIC) - ROUNDING_MAGIC)) * FRAC_PI_2;
    let square = angle * angle;
    let series = |factorials: &[f64]| factorials.iter().rev().fold(DVec4::ZERO, |sum, f| 1.0 / f - square * sum);
    let (mut sin, mut cos) =
        (angle - angle * square * series(&ODD_FACTORIALS), 1.0 - square * series(&EVEN_FACTORIALS));
    for _ in 0..2 {
        (sin, cos) = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
    }
    (sin, cos)
}
