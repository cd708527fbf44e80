//! Patch sizes and wave-number bands of the cascades, chosen for a sea or set by the user.

use super::dispersion::Dispersion;
use super::energy::Energy;
use crate::state::params::{Grid, MAX_CASCADES};
use std::f64::consts::TAU;

/// Patch sizes are powers (rungs) of the golden ratio, in m. It is irrational, so no two patches share a period.
const GOLDEN: f64 = 1.618_033_988_749_895;
/// Waves per patch at the low edge of a band; fewer would show as a repeated pattern. A circle of this radius,
/// sqrt(177 / pi), encloses exactly as many lattice points (177) as its area. A radius of 7 would pass through four
/// lattice points and give each band 1 % too much variance.
const WAVES_AT_LOW_EDGE: f64 = 7.506_054_213;
/// Rungs of the cascades below the first one. The step of 3 keeps the energetic band inside a 64-point lattice; the
/// steps of 4 leave no gap from 128 points on.
const RUNGS_BELOW_FIRST: [i32; MAX_CASCADES] = [0, 3, 7, 11];
/// Lattice size n for which the number of cascades is chosen; the choice must not depend on the actual n.
const NOMINAL_N: f64 = 256.0;
/// Wave number that the finest cascade should reach, rad/m: 20 cm.
const WANTED_K: f64 = 30.0;
/// Largest wave number of gravity waves, rad/m: the phase-speed minimum between gravity and capillarity, about 1.7 cm.
const MAX_GRAVITY_K: f64 = 370.0;
/// Largest wave number of capillary waves, rad/m: viscosity damps waves shorter than a millimetre.
const MAX_CAPILLARY_K: f64 = 6000.0;
/// Share of m0 that must lie below the nominal high edge of the finest cascade.
const WANTED_SHARE: f64 = 0.995;
/// The first patch is so large that this share of the variance m0 lies in waves of which fewer than `WAVES_AT_LOW_EDGE`
/// fit across it.
const LOW_TAIL: f64 = 5e-4;
/// Smallest patch that the user can set, m.
const MIN_PATCH_M: f64 = 0.1;
/// First noise key of patches that the user sets, beyond the keys of all rungs.
const MANUAL_KEY: u32 = 1000;

/// One square patch of the sea. Its wave vectors form a lattice of n x n points with the spacing 2 pi / patch_m; the
/// band k_low <= |k| < k_high of them is used.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// Side of the square patch, m.
    pub patch_m: f64,
    /// Low edge of the band, rad/m, included.
    pub k_low: f64,
    /// High edge of the band, rad/m, excluded, at most the Nyquist wave number of the lattice. An empty band ends at
    /// `k_low`.
    pub k_high: f64,
    /// Key of the random numbers: the rung of the patch size, so that a wave keeps its amplitude between plans.
    pub key: u32,
}

impl Cascade {
    /// Lattice spacing, rad/m.
    pub fn dk(&self) -> f64 {
        TAU / self.patch_m
    }

    /// Whether the band contains a wave number (rad/m).
    pub fn holds(&self, k: f64) -> bool {
        k >= self.k_low && k < self.k_high
    }
}

/// The cascades of a sea, longest waves first. Band edges that the user has not set depend on the sea alone, so a
/// larger n only adds waves.
pub fn choose(energy: &Energy, dispersion: &Dispersion, grid: &Grid) -> Vec<Cascade> {
    let is_calm = energy.m0() <= 0.0;
    let k_low = if is_calm { TAU / 10.0 } else { dispersion.wave_number(energy.quantile(LOW_TAIL)) };
    let k_wanted = if is_calm { 0.0 } else { dispersion.wave_number(energy.quantile(WANTED_SHARE)) };
    let rung = ((WAVES_AT_LOW_EDGE * TAU / k_low).ln() / GOLDEN.ln()).ceil() as i32;
    let rungs = RUNGS_BELOW_FIRST.map(|below| rung - below);
    let finest = |count: usize| 0.5 * NOMINAL_N * TAU / GOLDEN.powi(rungs[count - 1]);
    let count = match grid.cascades {
        0 if is_calm => 1,
        0 => (2..=3).find(|&c| finest(c) >= WANTED_K.max(k_wanted)).unwrap_or(4),
        set => (set as usize).clamp(1, rungs.len()),
    };
    let mut patches: Vec<_> = (0..count)
        .map(|i| match grid.patches[i].side_m {
            0.0 => (GOLDEN.powi(rungs[i]), (rungs[i] + 64) as u32, grid.patches[i]),
            side_m => (side_m.max(MIN_PATCH_M), MANUAL_KEY + i as u32, grid.patches[i]),
        })
        .collect();
    patches.sort_by(|a, b| b.0.total_cmp(&a.0));
    let k_max = max_wave_number(dispersion);
    // The whole lattice of a patch of a few centimetres can lie beyond k_max: this keeps the bands ordered.
    let low = |i: usize| match patches[i].2.k_low {
        0.0 if i == 0 => 0.0,
        0.0 => (WAVES_AT_LOW_EDGE * TAU / patches[i].0).min(k_max),
        set => set,
    };
    (0..count)
        .map(|i| {
            let (patch_m, key, set) = patches[i];
            let nyquist = f64::from(grid.n / 2) * TAU / patch_m;
            let k_high = match set.k_high {
                0.0 if grid.overlap || i + 1 == count => f64::INFINITY,
                0.0 => low(i + 1),
                k => k,
            };
            let k_low = low(i);
            Cascade { patch_m, k_low, k_high: k_high.min(nyquist).min(k_max).max(k_low), key }
        })
        .collect()
}

/// Largest wave number that a cascade may have, rad/m.
pub fn max_wave_number(dispersion: &Dispersion) -> f64 {
    if dispersion.is_capillary() { MAX_CAPILLARY_K } else { MAX_GRAVITY_K }
}

/// Wave numbers (rad/m) that at least one cascade contains, as ascending intervals without overlap.
pub fn resolved_bands(cascades: &[Cascade]) -> Vec<(f64, f64)> {
    let mut bands: Vec<(f64, f64)> = cascades.iter().map(|c| (c.k_low, c.k_high)).filter(|(a, b)| a < b).collect();
    bands.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out: Vec<(f64, f64)> = Vec::new();
    for (low, high) in bands {
        match out.last_mut() {
            Some(last) if low <= last.1 => last.1 = last.1.max(high),
            _ => out.push((low, high)),
        }
    }
    out
}
