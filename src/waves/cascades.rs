//! Patch sizes and bands: by the plan for the sea at hand, or by hand.

use super::dispersion::Dispersion;
use super::energy::Energy;
use crate::state::params::Grid;
use std::f64::consts::TAU;

/// Ratio of neighbouring rungs of the ladder of patch sizes: irrational, so that no two patches share a period.
const GOLDEN: f64 = 1.618_033_988_749_895;
/// Waves that a patch holds at the low edge of its band; fewer would show as a repeated pattern. Where exactly the edge
/// lies matters: a circle of this radius, sqrt(177 / pi), holds just as many lattice points (177) as its area says, while
/// one of radius 7 runs through four points and gives each band 1 % too much.
const WAVES_AT_LOW_EDGE: f64 = 7.506_054_213;
/// Rungs between neighbouring cascades. The first step keeps the energetic band inside a 64-point lattice, the later
/// ones leave no gap with 128 points and more.
const STEPS: [i32; 3] = [3, 4, 4];
/// n for which the number of cascades is chosen; the choice must not depend on the actual n.
const NOMINAL_N: f64 = 256.0;
/// Waves as short as this (rad/m) are wanted; the number of cascades follows.
const WANTED_K: f64 = 30.0;
/// Where gravity waves end: the phase-speed minimum between gravity and capillarity, about 1.7 cm (rad/m).
const SHORTEST_GRAVITY_K: f64 = 370.0;
/// And capillary waves: a millimetre, where viscosity leaves nothing (rad/m).
const SHORTEST_CAPILLARY_K: f64 = 6000.0;
/// Share of m0 that the cascades reach up to, however short its waves.
const MOST: f64 = 0.995;
/// Share of m0 below the low edge of the first cascade.
const LOW_TAIL: f64 = 5e-4;
/// Smallest patch that can be set by hand, m.
const SMALLEST_PATCH_M: f64 = 0.1;
/// Noise keys of patches set by hand begin here, beyond every rung of the ladder.
const MANUAL_KEY: u32 = 1000;

/// One patch: n x n waves on a lattice of 2 pi / patch_m, of which those with k_low <= |k| < k_high are used.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascade {
    /// Side of the square patch, m.
    pub patch_m: f64,
    /// Low edge of the band, rad/m, included.
    pub k_low: f64,
    /// High edge of the band, rad/m, excluded, at most the lattice's Nyquist wave number; an empty band has it at `k_low`.
    pub k_high: f64,
    /// What the noise is drawn with: the rung of the ladder.
    pub key: u32,
}

impl Cascade {
    /// Lattice spacing, rad/m.
    pub fn dk(&self) -> f64 {
        TAU / self.patch_m
    }

    /// Whether the band holds a wave number (rad/m).
    pub fn holds(&self, k: f64) -> bool {
        k >= self.k_low && k < self.k_high
    }
}

/// The cascades of a sea, longest waves first. The edges that the plan chooses depend on the sea alone, so that raising n
/// only adds waves.
pub fn choose(energy: &Energy, dispersion: &Dispersion, grid: &Grid) -> Vec<Cascade> {
    let is_calm = energy.m0() <= 0.0;
    let k_low = if is_calm { TAU / 10.0 } else { dispersion.wave_number(energy.quantile(LOW_TAIL)) };
    let k_most = if is_calm { 0.0 } else { dispersion.wave_number(energy.quantile(MOST)) };
    let rung = ((WAVES_AT_LOW_EDGE * TAU / k_low).ln() / GOLDEN.ln()).ceil() as i32;
    let rungs: Vec<i32> = std::iter::once(0)
        .chain(STEPS.iter().scan(0, |sum, step| {
            *sum += step;
            Some(*sum)
        }))
        .map(|below| rung - below)
        .collect();
    let finest = |count: usize| 0.5 * NOMINAL_N * TAU / GOLDEN.powi(rungs[count - 1]);
    let count = match grid.cascades {
        0 if is_calm => 1,
        0 => (2..=3).find(|&c| finest(c) >= WANTED_K.max(k_most)).unwrap_or(4),
        some => (some as usize).clamp(1, rungs.len()),
    };
    let mut patches: Vec<_> = (0..count)
        .map(|i| match grid.patches[i].side_m {
            0.0 => (GOLDEN.powi(rungs[i]), (rungs[i] + 64) as u32, grid.patches[i]),
            side_m => (side_m.max(SMALLEST_PATCH_M), MANUAL_KEY + i as u32, grid.patches[i]),
        })
        .collect();
    patches.sort_by(|a, b| b.0.total_cmp(&a.0));
    let shortest = shortest(dispersion);
    // A patch of a few centimetres can have its whole lattice beyond the shortest wave: keep the bands ordered.
    let low = |i: usize| match patches[i].2.k_low {
        0.0 if i == 0 => 0.0,
        0.0 => (WAVES_AT_LOW_EDGE * TAU / patches[i].0).min(shortest),
        by_hand => by_hand,
    };
    (0..count)
        .map(|i| {
            let (patch_m, key, by_hand) = patches[i];
            let nyquist = f64::from(grid.n / 2) * TAU / patch_m;
            let k_high = match by_hand.k_high {
                0.0 if grid.overlap || i + 1 == count => f64::INFINITY,
                0.0 => low(i + 1),
                k => k,
            };
            let k_low = low(i);
            Cascade { patch_m, k_low, k_high: k_high.min(nyquist).min(shortest).max(k_low), key }
        })
        .collect()
}

/// The largest wave number (rad/m) that any cascade holds.
pub fn shortest(dispersion: &Dispersion) -> f64 {
    if dispersion.is_capillary() { SHORTEST_CAPILLARY_K } else { SHORTEST_GRAVITY_K }
}

/// The wave numbers that at least one cascade holds, as ascending intervals without overlap.
pub fn held(cascades: &[Cascade]) -> Vec<(f64, f64)> {
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
