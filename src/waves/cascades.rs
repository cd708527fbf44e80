//! Choice of the cascades, the square patches of different sizes whose sum is the sea: side lengths and wave-number
//! bands, derived from the spectrum or set by the user.

use super::dispersion::Dispersion;
use super::energy::SpectrumIntegrals;
use crate::state::params::{Grid, MAX_CASCADES};
use std::f64::consts::TAU;

/// Golden ratio. The side of an automatic patch, in m, is an integer power of it; the exponent is called the rung. The
/// ratio is irrational, so the sum of two patches never repeats.
const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;
/// Number of wavelengths that fit across a patch at the low edge of its band; fewer would show as a repeated pattern.
///
/// The low edge is a circle of this radius in the lattice of wave vectors, in units of the lattice spacing. The radius
/// is sqrt(177 / pi), so the circle has the area 177, and it encloses 177 lattice points. A circle of radius 7 would
/// pass through four lattice points, which would add 1 % to the variance of the sea.
const MIN_WAVELENGTHS_PER_PATCH: f64 = 7.506_054_213;
/// Decrease of the golden ratio's exponent from the first (largest) patch to that of each cascade. The first step, 3,
/// fits the first and most energetic band into an FFT of 64 x 64 points. The other steps, 4, leave no gaps between the
/// bands from 128 x 128 points on.
const PATCH_SIDE_EXPONENT_DECREASES: [i32; MAX_CASCADES] = [0, 3, 7, 11];
/// FFT size assumed when the number of cascades is chosen, so that this number does not depend on the user's FFT size.
const NOMINAL_FFT_SIZE: f64 = 256.0;
/// Wave number, rad/m (wavelength 20 cm), that the finest cascade should reach; up to 4 cascades are used for it.
const FINEST_CASCADE_MIN_NYQUIST_RAD_M: f64 = 30.0;
/// Largest wave number simulated without surface tension, rad/m (wavelength 1.7 cm). Above it waves are capillary.
const MAX_GRAVITY_WAVE_NUMBER_RAD_M: f64 = 370.0;
/// Largest wave number simulated with surface tension, rad/m (wavelength 1 mm). Viscosity damps shorter waves.
const MAX_CAPILLARY_K: f64 = 6000.0;
/// Fraction of the elevation variance m0 that must lie below the Nyquist wave number of the finest cascade. Cascades
/// are added until it does.
const MIN_VARIANCE_FRACTION: f64 = 0.995;
/// Fraction of the elevation variance m0 that may lie in waves too long for the first (largest) patch: waves of which
/// fewer than `MIN_WAVELENGTHS_PER_PATCH` fit across it.
const MAX_OVERLONG_VARIANCE_FRACTION: f64 = 5e-4;
/// Smallest side of a patch, m; smaller values that the user sets are raised to it.
const MIN_PATCH_M: f64 = 0.1;
/// First noise key (input of the random-number hash) for patches with sides set by the user, above all automatic keys.
const FIRST_MANUAL_PATCH_NOISE_KEY: u32 = 1000;

/// One square patch of waves; the sea is the sum of several patches of different sizes. The wave vectors k of a patch
/// form a lattice of n x n points, 2 pi / patch_m apart. Only those with k_low <= |k| < k_high carry waves.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// Side of the square patch, m.
    pub patch_m: f64,
    /// Lower end of the band of wave numbers that the cascade carries, rad/m (inclusive).
    pub k_low: f64,
    /// Upper end of the band of wave numbers that the cascade carries, rad/m (exclusive), at most the Nyquist wave
    /// number; equal to `k_low` if the band is empty.
    pub k_high: f64,
    /// Key of the cascade in the hash that makes its random numbers, so that cascades differ. An automatic patch of a
    /// given size has the same key in every sea.
    pub noise_key: u32,
}

impl Cascade {
    /// Distance between neighbouring wave vectors of the lattice, 2 pi / patch_m, rad/m.
    pub fn dk(&self) -> f64 {
        TAU / self.patch_m
    }

    /// Whether the wave number `k` (rad/m) lies in the band that the cascade carries: k_low <= k < k_high.
    pub fn contains_wave_number(&self, k: f64) -> bool {
        k >= self.k_low && k < self.k_high
    }
}

/// Chooses the cascades for a spectrum, longest waves first; settings of the user in `grid` take precedence. Automatic
/// band edges do not depend on the FFT size, except that a larger FFT adds short waves up to its Nyquist wave number.
pub fn choose_cascades(energy: &SpectrumIntegrals, dispersion: &Dispersion, grid: &Grid) -> Vec<Cascade> {
    let is_calm = energy.m0() <= 0.0;
    let k_low = if is_calm {
        TAU / 10.0
    } else {
        dispersion.wave_number(energy.omega_at_variance_fraction(MAX_OVERLONG_VARIANCE_FRACTION))
    };
    let k_wanted =
        if is_calm { 0.0 } else { dispersion.wave_number(energy.omega_at_variance_fraction(MIN_VARIANCE_FRACTION)) };
    let rung = ((MIN_WAVELENGTHS_PER_PATCH * TAU / k_low).ln() / GOLDEN_RATIO.ln()).ceil() as i32;
    let rungs = PATCH_SIDE_EXPONENT_DECREASES.map(|below| rung - below);
    let finest = |count: usize| 0.5 * NOMINAL_FFT_SIZE * TAU / GOLDEN_RATIO.powi(rungs[count - 1]);
    let count = match grid.cascades {
        0 if is_calm => 1,
        0 => (2..=3).find(|&c| finest(c) >= FINEST_CASCADE_MIN_NYQUIST_RAD_M.max(k_wanted)).unwrap_or(4),
        set => (set as usize).clamp(1, rungs.len()),
    };
    let mut patches: Vec<_> = (0..count)
        .map(|i| match grid.patches[i].side_m {
            0.0 => (GOLDEN_RATIO.powi(rungs[i]), (rungs[i] + 64) as u32, grid.patches[i]),
            side_m => (side_m.max(MIN_PATCH_M), FIRST_MANUAL_PATCH_NOISE_KEY + i as u32, grid.patches[i]),
        })
        .collect();
    patches.sort_by(|a, b| b.0.total_cmp(&a.0));
    let k_max = max_wave_number(dispersion);
    // All wave numbers of a patch of a few centimetres can exceed k_max. The limit keeps the bands in order.
    let low = |i: usize| match patches[i].2.k_low {
        0.0 if i == 0 => 0.0,
        0.0 => (MIN_WAVELENGTHS_PER_PATCH * TAU / patches[i].0).min(k_max),
        set => set,
    };
    (0..count)
        .map(|i| {
            let (patch_m, noise_key, set) = patches[i];
            let nyquist = f64::from(grid.n / 2) * TAU / patch_m;
            let k_high = match set.k_high {
                0.0 if grid.overlap || i + 1 == count => f64::INFINITY,
                0.0 => low(i + 1),
                k => k,
            };
            let k_low = low(i);
            Cascade { patch_m, k_low, k_high: k_high.min(nyquist).min(k_max).max(k_low), noise_key }
        })
        .collect()
}

/// Largest wave number that any cascade may hold, rad/m; it is higher with surface tension (capillary waves).
pub fn max_wave_number(dispersion: &Dispersion) -> f64 {
    if dispersion.includes_surface_tension() { MAX_CAPILLARY_K } else { MAX_GRAVITY_WAVE_NUMBER_RAD_M }
}

/// Union of the bands of all cascades: (lowest, highest) wave number, rad/m, ascending and without overlap.
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
