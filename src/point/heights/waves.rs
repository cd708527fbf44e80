//! Selected waves of a planned sea, and the sums of their heights and displacements at a point.

use crate::state::params::MAX_CASCADES;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::second_order::{CascadeBoundWaves, ProductFactors};
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use crate::waves::tiling::{PatchCopy, Tiling};
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

/// A wave that the seed of a plan generates: a candidate for the selection of the strongest waves.
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

/// For each cascade, the three shifted copies of its patch blended at an undisplaced point, with their weights.
pub(super) type PatchCopyBlends = [[PatchCopy; 3]; MAX_CASCADES];

/// Sums over waves ([`WaveSums`]) at an undisplaced point for each single copy of every patch; `None` for copies that
/// were not evaluated.
pub(super) struct PatchCopySums {
    pub(super) copy_blends: PatchCopyBlends,
    pub(super) sums: [[Option<WaveSums>; 3]; MAX_CASCADES],
}

/// Sums over waves at an undisplaced point: elevation eta, horizontal displacement D (without the chop factors), their
/// derivatives in space and time, and the potential of D.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct WaveSums {
    /// Elevation eta of the surface above the still water, m.
    pub(super) elevation_m: f64,
    /// Slopes d eta/dx and d eta/dz of the elevation eta (m/m), without those that `blend_weight_slope` holds.
    pub(super) slope: [f64; 2],
    /// Horizontal displacement D = (Dx, Dz), m, before multiplication by the chop factors.
    pub(super) displacement_m: [f64; 2],
    /// Strain (dDx/dx, dDz/dz, dDx/dz = dDz/dx) of the horizontal displacement D, without that in
    /// `blend_weight_strain`.
    pub(super) strain: [f64; 3],
    /// Orbital velocity (dDx/dt, d eta/dt, dDz/dt), m/s.
    pub(super) orbital_velocity_m_s: [f64; 3],
    /// Potential whose gradient is the horizontal displacement D, m^2.
    pub(super) displacement_potential_m2: f64,
    /// Slopes (d eta/dx, d eta/dz), to be added to `slope`, that arise because the weights of the blended patch copies
    /// vary in space.
    pub(super) blend_weight_slope: [f64; 2],
    /// Strain (dDx/dx, dDz/dz, dDx/dz, dDz/dx), to be added to `strain`, that arises because the weights of the
    /// blended patch copies vary in space.
    pub(super) blend_weight_strain: [f64; 4],
    /// Height of the bound waves of the second order, m, with its derivatives along x and z (m/m) and in time (m/s).
    pub(super) bound_height_m: [f64; 4],
}

impl WaveSums {
    /// Slopes d eta/dx and d eta/dz of the elevation.
    pub(super) fn whole_slope(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.slope[axis] + self.blend_weight_slope[axis])
    }

    /// Strain (dDx/dx, dDz/dz, dDx/dz, dDz/dx) of the horizontal displacement.
    pub(super) fn whole_strain(&self) -> [f64; 4] {
        let [xx, zz, cross] = self.strain;
        let [tile_xx, tile_zz, tile_xz, tile_zx] = self.blend_weight_strain;
        [xx + tile_xx, zz + tile_zz, cross + tile_xz, cross + tile_zx]
    }

    /// Adds the sums over other waves at the same point.
    fn add(&mut self, other: &Self) {
        self.elevation_m += other.elevation_m;
        add_scaled(&mut self.slope, 1.0, other.slope);
        add_scaled(&mut self.displacement_m, 1.0, other.displacement_m);
        add_scaled(&mut self.strain, 1.0, other.strain);
        add_scaled(&mut self.orbital_velocity_m_s, 1.0, other.orbital_velocity_m_s);
        self.displacement_potential_m2 += other.displacement_potential_m2;
        add_scaled(&mut self.blend_weight_slope, 1.0, other.blend_weight_slope);
        add_scaled(&mut self.blend_weight_strain, 1.0, other.blend_weight_strain);
        add_scaled(&mut self.bound_height_m, 1.0, other.bound_height_m);
    }

    /// Adds the bound waves of a cascade whose waves have the sums `own`, with themselves and with those of longer
    /// cascades (src/waves/second_order.rs). `longer` holds the latter times their factors; this cascade is added to it.
    fn add_bound_waves(&mut self, own: &Self, bound: &CascadeBoundWaves, longer: &mut ScaledWaves) {
        let waves = ScaledWaves::new(own, ProductFactors { elevation: 1.0, displacement: 1.0 });
        let mut others = ScaledWaves::new(own, bound.own);
        let half: f64 = 0.5 * dot(waves.value, others.value);
        others.add(longer);
        self.bound_height_m[0] += bound.level_m + half + dot(waves.value, longer.value);
        let product =
            |slope: [f64; 3], others_slope: [f64; 3]| dot(slope, others.value) + dot(waves.value, others_slope);
        // The product rule: (w (o w / 2 + l))' = w' (o w + l) + w l'.
        for axis in 0..2 {
            self.bound_height_m[1 + axis] += product(waves.along[axis], longer.along[axis]);
        }
        self.bound_height_m[3] += product(waves.per_s, longer.per_s);
        longer.add(&ScaledWaves::new(own, bound.with_shorter));
    }

    /// Adds the wave sums of one of the overlapping copies of the patch, multiplied by the copy's weight. By the
    /// product rule, slope and strain also get the height and the displacement times the gradient of the weight.
    fn add_weighted_copy(&mut self, copy_sums: &Self, copy: &PatchCopy) {
        let (w, [wx, wz], [dx, dz]) = (copy.weight, copy.weight_gradient_per_m, copy_sums.displacement_m);
        self.elevation_m += w * copy_sums.elevation_m;
        add_scaled(&mut self.slope, w, copy_sums.slope);
        add_scaled(&mut self.displacement_m, w, copy_sums.displacement_m);
        add_scaled(&mut self.strain, w, copy_sums.strain);
        add_scaled(&mut self.orbital_velocity_m_s, w, copy_sums.orbital_velocity_m_s);
        self.displacement_potential_m2 += w * copy_sums.displacement_potential_m2;
        add_scaled(&mut self.blend_weight_slope, copy_sums.elevation_m, copy.weight_gradient_per_m);
        add_scaled(&mut self.blend_weight_strain, 1.0, [wx * dx, wz * dz, wz * dx, wx * dz]);
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn add_scaled<const N: usize>(sum: &mut [f64; N], factor: f64, term: [f64; N]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += factor * term);
}

impl PatchCopySums {
    /// Returns the wave sums of all `patches`, blended with the weights in `blends`, and a flag that is false if the
    /// sums of a copy with a weight above 0 are missing. `elevation_gain` is that of the bound waves.
    pub(super) fn blended(
        &self,
        blends: &PatchCopyBlends,
        patches: &[PatchWaves],
        elevation_gain: f64,
    ) -> (WaveSums, bool) {
        let (mut all, mut complete) = (WaveSums::default(), true);
        let mut longer = ScaledWaves { value: [elevation_gain, 0.0, 0.0], ..ScaledWaves::default() };
        for (((blend, known), sums), patch) in blends.iter().zip(&self.copy_blends).zip(&self.sums).zip(patches) {
            let mut own = WaveSums::default();
            for copy in blend.iter().filter(|c| c.weight > 0.0) {
                match known
                    .iter()
                    .zip(sums)
                    .find_map(|(k, sums)| sums.as_ref().filter(|_| k.lattice_vertex == copy.lattice_vertex))
                {
                    Some(sums) => own.add_weighted_copy(sums, copy),
                    None => complete = false,
                }
            }
            all.add(&own);
            all.add_bound_waves(&own, &patch.bound, &mut longer);
        }
        (all, complete)
    }
}

/// Elevation and horizontal displacement (eta, Dx, Dz) at a point, each times a factor, with their derivatives along x
/// and z and in time.
#[derive(Clone, Copy, Default)]
struct ScaledWaves {
    value: [f64; 3],
    along: [[f64; 3]; 2],
    per_s: [f64; 3],
}

impl ScaledWaves {
    /// The waves in `sums`, with the factors p and q on elevation and displacement.
    fn new(sums: &WaveSums, factors: ProductFactors) -> Self {
        let (p, q) = (factors.elevation, factors.displacement);
        let scaled = |eta: f64, [x, z]: [f64; 2]| [p * eta, q * x, q * z];
        let [xx, zz, xz, zx] = sums.whole_strain();
        let [sx, sz] = sums.whole_slope();
        let [ux, uy, uz] = sums.orbital_velocity_m_s;
        Self {
            value: scaled(sums.elevation_m, sums.displacement_m),
            along: [scaled(sx, [xx, zx]), scaled(sz, [xz, zz])],
            per_s: scaled(uy, [ux, uz]),
        }
    }

    fn add(&mut self, other: &Self) {
        add_scaled(&mut self.value, 1.0, other.value);
        add_scaled(&mut self.per_s, 1.0, other.per_s);
        self.along.iter_mut().zip(other.along).for_each(|(sum, term)| add_scaled(sum, 1.0, term));
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
        }
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
