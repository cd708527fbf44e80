//! What a transfer says at each point besides its waves.

use super::SeaAtPoint;
use super::setup::Setup;
use super::shore::{Shore, neighbours, smooth_step};
use super::swash::Swash;
use crate::coast::bathymetry::Bathymetry;
use crate::coast::incident::Incident;
use crate::coast::local_wave::LocalWave;
use crate::coast::losses::Dissipation;

/// Width of the sides at which the waves fade to those of the open sea, as a fraction of the longer side.
const FADE: f64 = 0.06;
/// Least width of these sides, cells.
const MIN_FADE_CELLS: f64 = 4.0;
/// Largest factor on the short waves.
const MAX_SHORT_GAIN: f64 = 1.3;
/// Depth, m, above which waves outside the transfer have their height, if the transfer has none that tell what
/// becomes of them.
const UNTOUCHED_M: f64 = 0.5;
/// Share of the sea's variance from which the shortest third of a transfer's waves tell what becomes of shorter ones. In a
/// sea of short waves, those of the transfer may be so far in the tail of the spectrum that numbers cannot hold them.
const LEAST_SHORT_SHARE: f64 = 1e-8;
/// Largest fraction of waves that break.
const MAX_BREAKING: f64 = 0.97;
/// Least depth of the water in the balance of the set-up, m.
const LEAST_WATER_M: f64 = 0.1;
/// Depth, m, from which a point has water.
const LAND_BELOW_M: f64 = f64::MIN_POSITIVE;
/// Times that maps are smoothed over the nearest points.
const SMOOTHINGS: usize = 2;

/// Variances of the shortest third of a transfer's waves, m^2.
pub(super) struct ShortWaves<'a> {
    /// At its points, as they were solved.
    pub(super) solved_m2: &'a [f64],
    /// In the open sea.
    pub(super) open_m2: f64,
}

/// All points of a transfer.
pub(super) fn points(
    setup: &Setup,
    sea: &Dissipation,
    shore: &Shore,
    swash: &Swash,
    short: &ShortWaves<'_>,
) -> Vec<SeaAtPoint> {
    let grid = &setup.grid;
    let mut breaking: Vec<f64> = sea.breaking_fraction.iter().map(|q| f64::from(*q)).collect();
    // The solver knows no waves in the thinnest water, though the swash runs there.
    shore.continue_map(grid, setup.options.min_depth_m, &mut breaking);
    let mut set_up_m = set_up_m(setup, sea);
    shore.continue_map(grid, LAND_BELOW_M, &mut set_up_m);
    if let Some(run_up) = setup.run_up {
        for (level_m, share) in set_up_m.iter_mut().zip(&swash.set_up_share) {
            *level_m += share * (run_up.set_up_m - *level_m).max(0.0);
        }
    }
    let short_gain = short_gain(setup, short);
    let mut all = swash.variance_m2.clone();
    smooth(grid, &mut all, |point| swash.variance_m2[point] > 0.0);
    let point = |point: usize| {
        let height_m = (8.0 * all[point]).sqrt();
        // The heights of waves have Rayleigh's distribution: the fraction Q is higher than Hrms sqrt(-ln Q).
        let fraction = breaking[point].min(MAX_BREAKING);
        let breaking_height_m =
            if fraction > 0.0 && height_m > 0.0 { height_m * (-fraction.ln()).sqrt() } else { f64::INFINITY };
        SeaAtPoint {
            depth_m: grid.depth_m[point],
            short_gain: short_gain[point] as f32,
            weight: if setup.waves.is_empty() { 0.0 } else { weight(grid, point) as f32 },
            breaking_height_m: breaking_height_m as f32,
            set_up_m: set_up_m[point] as f32,
            level_deviation_m: all[point].sqrt() as f32,
        }
    };
    (0..grid.depth_m.len()).map(point).collect()
}

/// Weight of the transferred waves: 0 at the side of the open sea and at both lateral sides, 1 inside and at the
/// land's.
fn weight(grid: &Bathymetry, point: usize) -> f64 {
    let longer = grid.columns.max(grid.rows) as f64;
    let width = (FADE * longer).max(MIN_FADE_CELLS);
    let (i, j) = (point % grid.columns, point / grid.columns);
    let inside = |cells: usize| smooth_step(cells as f64 / width);
    inside(i) * inside(j) * inside(grid.rows - 1 - j)
}

/// Factor on the waves outside the transfer: the growth of its shortest waves, which is 0 on land.
fn short_gain(setup: &Setup, short: &ShortWaves<'_>) -> Vec<f64> {
    let grid = &setup.grid;
    let is_wet = |point: usize| grid.depth_m[point] > 0.0;
    let sea_m2: f64 = setup.bins.iter().map(Incident::variance_m2).sum();
    let are_known = short.open_m2 > LEAST_SHORT_SHARE * sea_m2;
    let gain = |point: usize| {
        let depth_m = f64::from(grid.depth_m[point]);
        if are_known {
            (short.solved_m2[point] / short.open_m2).sqrt().min(MAX_SHORT_GAIN)
        } else {
            smooth_step(depth_m / UNTOUCHED_M)
        }
    };
    let mut out: Vec<f64> = (0..grid.depth_m.len()).map(|p| if is_wet(p) { gain(p) } else { 0.0 }).collect();
    smooth(grid, &mut out, is_wet);
    for (point, gain) in out.iter_mut().enumerate() {
        *gain *= smooth_step(f64::from(grid.depth_m[point]) / setup.shore.least_depth_m);
    }
    out
}

/// Mean level of the water, m, by the balance of its slope with the radiation stress (Longuet-Higgins and Stewart
/// 1962): dS/dx = -(h + level) dlevel/dx with S = m0 (n (1 + cos^2) - 1/2), where density and gravity are taken as one.
/// It is integrated along each row from the set-down of the open sea, -m0 k / sinh(2 k h), and again behind land,
/// from 0; currents along the shore and flow between the rows are left out. Land has 0.
fn set_up_m(setup: &Setup, sea: &Dissipation) -> Vec<f64> {
    let grid = &setup.grid;
    let gravity_m_s2 = setup.options.gravity_m_s2;
    let mut out = vec![0.0; grid.depth_m.len()];
    for j in 0..grid.rows {
        // Level and stress of the point before; none at the beginning and behind land.
        let mut before: Option<(f64, f64, f64)> = None;
        for i in 0..grid.columns {
            let point = j * grid.columns + i;
            let (depth_m, m0) = (f64::from(grid.depth_m[point]), f64::from(sea.variance_m2[point]));
            if depth_m <= 0.0 {
                before = None;
                continue;
            }
            let mut stress = 0.0;
            let mut set_down_m = 0.0;
            if m0 > 0.0 {
                let omega = f64::from(sea.mean_omega_rad_s[point]);
                let wave = LocalWave::new(omega, depth_m, gravity_m_s2);
                let ratio = wave.group_velocity_m_s * wave.k / omega;
                let cos = (f64::from(sea.shoreward_flux_m3_s[point]) / (m0 * wave.group_velocity_m_s)).min(1.0);
                stress = m0 * (ratio * (1.0 + cos * cos) - 0.5);
                set_down_m = -m0 * wave.k / (2.0 * wave.k * depth_m).min(20.0).sinh();
            }
            let level_m = match before {
                Some((level_m, stress_before, depth_before_m)) => {
                    let water_m = (0.5 * (depth_before_m + depth_m) + level_m).max(LEAST_WATER_M);
                    level_m - (stress - stress_before) / water_m
                }
                None if i == 0 => set_down_m,
                None => 0.0,
            };
            out[point] = level_m;
            before = Some((level_m, stress, depth_m));
        }
    }
    smooth(grid, &mut out, |point| grid.depth_m[point] > 0.0);
    out
}

/// Smooths a map over the points for which `counts`, by means of each point and those around it.
fn smooth(grid: &Bathymetry, map: &mut [f64], counts: impl Fn(usize) -> bool) {
    for _ in 0..SMOOTHINGS {
        let before = map.to_vec();
        for point in (0..before.len()).filter(|point| counts(*point)) {
            let (mut sum, mut weight) = (before[point], 1.0);
            for next in neighbours(grid, point).filter(|next| counts(*next)) {
                (sum, weight) = (sum + 0.5 * before[next], weight + 0.5);
            }
            map[point] = sum / weight;
        }
    }
}
