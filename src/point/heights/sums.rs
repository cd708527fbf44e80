//! Sums over waves at a point, and their blend over the copies of the patches.

use super::waves::PatchWaves;
use crate::coast::transfer::{CoastalGains, CoastalSums};
use crate::state::params::MAX_CASCADES;
use crate::waves::second_order::{CascadeBoundWaves, ProductFactors};
use crate::waves::tiling::PatchCopy;

/// Largest number of patches: one for each cascade, and one for the waves that a coast transforms.
pub(super) const MAX_PATCHES: usize = MAX_CASCADES + 1;

/// What is blended at an undisplaced point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PatchCopyBlends {
    /// For each patch its three shifted copies, with their weights.
    pub(super) copies: [[PatchCopy; 3]; MAX_PATCHES],
    /// What a coast does to the waves; `None` in the open sea.
    pub(super) gains: Option<CoastalGains>,
}

/// Sums over waves ([`WaveSums`]) at an undisplaced point for each single copy of every patch; `None` for copies that
/// were not evaluated.
pub(super) struct PatchCopySums {
    pub(super) copy_blends: PatchCopyBlends,
    pub(super) sums: [[Option<WaveSums>; 3]; MAX_PATCHES],
    /// Sums over the waves at a coast, without their weight; 0 in the open sea.
    pub(super) coast: CoastalSums,
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

    /// Adds `factor` times the sums over other waves at the same point.
    fn add(&mut self, factor: f64, other: &Self) {
        self.elevation_m += factor * other.elevation_m;
        add_scaled(&mut self.slope, factor, other.slope);
        add_scaled(&mut self.displacement_m, factor, other.displacement_m);
        add_scaled(&mut self.strain, factor, other.strain);
        add_scaled(&mut self.orbital_velocity_m_s, factor, other.orbital_velocity_m_s);
        self.displacement_potential_m2 += factor * other.displacement_potential_m2;
        add_scaled(&mut self.blend_weight_slope, factor, other.blend_weight_slope);
        add_scaled(&mut self.blend_weight_strain, factor, other.blend_weight_strain);
        add_scaled(&mut self.bound_height_m, factor, other.bound_height_m);
    }

    /// The waves at a coast with the gains there: without their gradients, as the waves of the open sea, and without
    /// bound waves.
    fn at_coast(coast: &CoastalSums, gains: &CoastalGains) -> Self {
        let mut out = Self::default();
        let waves = Self {
            elevation_m: coast.elevation_m + gains.set_up_m,
            slope: coast.slope,
            displacement_m: coast.displacement_m,
            strain: coast.strain,
            orbital_velocity_m_s: coast.orbital_velocity_m_s,
            displacement_potential_m2: coast.displacement_potential_m2,
            ..Self::default()
        };
        out.add(gains.weight, &waves);
        out
    }

    /// Adds the bound waves of a cascade whose waves have the sums `own`, with themselves and with those of longer
    /// cascades (src/waves/second_order.rs). `longer` holds the latter times their factors; this cascade is added to
    /// it.
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
        let mut offshore = None;
        let places = blends.copies.iter().zip(&self.copy_blends.copies);
        for (((blend, known), sums), patch) in places.zip(&self.sums).zip(patches) {
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
            let mut bound = patch.bound;
            if let Some(gains) = &blends.gains {
                let gain = gains.short_gain * if patch.is_offshore { 1.0 - gains.weight } else { 1.0 };
                let waves = std::mem::take(&mut own);
                own.add(gain, &waves);
                bound.level_m *= gain * gain;
            }
            all.add(1.0, &own);
            if patch.is_offshore {
                all.bound_height_m[0] += bound.level_m;
                offshore = Some(own);
                continue;
            }
            if let Some(offshore) = offshore.take() {
                own.add(1.0, &offshore);
            }
            all.add_bound_waves(&own, &bound, &mut longer);
        }
        if let Some(gains) = &blends.gains {
            all.add(1.0, &WaveSums::at_coast(&self.coast, gains));
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
