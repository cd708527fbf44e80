//! Groups of waves that share a carrier.
//!
//! Between the points of the grid, envelopes are interpolated linearly. For a wave whose phase differs from that of
//! its carrier by delta between two points, this loses delta^2 / 8 of the amplitude half-way. So the groups are made
//! small in the wave numbers, at the edge of the grid and in shallow water: the group with the largest loss is
//! divided again and again.

use super::WaveGroup;
use super::shore::ShoreDepths;
use crate::coast::bathymetry::Bathymetry;
use crate::coast::field::{Carrier, wave_number_along_x};
use crate::coast::incident::Incident;
use crate::coast::local_wave::LocalWave;

/// Depth, m, at which the waves of a group must have similar wave numbers besides those at the edge of the grid.
const SHALLOW_M: f64 = 2.5;
/// Error of the interpolation, relative to the standard deviation of the sea, below which groups are not divided
/// further.
const SMALL_ERROR: f64 = 2e-4;

/// Divides `waves`, those at the edge of the grid with their variance in the open sea (m^2), into at most `max_groups`
/// groups. Returns the indices of the waves of each group, in ascending order.
pub(super) fn divide(
    waves: &[(Incident, f64)],
    edge_depth_m: f64,
    cell_m: f64,
    gravity_m_s2: f64,
    max_groups: usize,
) -> Vec<Vec<usize>> {
    if waves.is_empty() {
        return Vec::new();
    }
    let features: Vec<[f64; 3]> = waves
        .iter()
        .map(|(wave, _)| {
            let k = |depth_m: f64| LocalWave::new(wave.omega_rad_s, depth_m, gravity_m_s2).k;
            let ky = k(edge_depth_m) * wave.direction_rad.sin();
            [ky, wave_number_along_x(k(edge_depth_m), ky), wave_number_along_x(k(SHALLOW_M), ky)].map(|k| k * cell_m)
        })
        .collect();
    let total: f64 = waves.iter().map(|wave| wave.1).sum();
    let group = |members: Vec<usize>| {
        let spread = Spread::of(&members, &features, waves);
        (members, spread)
    };
    let mut groups = vec![group((0..waves.len()).collect())];
    while groups.len() < max_groups {
        let error = groups.iter().map(|(_, spread)| spread.squared_error_m2).sum::<f64>();
        if error <= SMALL_ERROR * SMALL_ERROR * total {
            break;
        }
        let worst = (0..groups.len())
            .reduce(|a, b| if groups[b].1.squared_error_m2 > groups[a].1.squared_error_m2 { b } else { a });
        let Some(worst) = worst else { break };
        let (members, spread) = groups.swap_remove(worst);
        let (low, high) = members.into_iter().partition(|w| features[*w][spread.axis] <= spread.middle);
        groups.extend([group(low), group(high)].into_iter().filter(|(members, _)| !members.is_empty()));
    }
    let mut out: Vec<Vec<usize>> = groups.into_iter().map(|(members, _)| members).collect();
    out.sort();
    out
}

/// How far the wave numbers of a group spread.
struct Spread {
    /// Sum over the waves of their variance times the square of the error of their interpolation.
    squared_error_m2: f64,
    /// The feature that spreads most, and its mean.
    axis: usize,
    middle: f64,
}

impl Spread {
    fn of(members: &[usize], features: &[[f64; 3]], waves: &[(Incident, f64)]) -> Self {
        let weights = || members.iter().map(|w| (w, waves[*w].1.max(f64::MIN_POSITIVE)));
        let sum: f64 = weights().map(|(_, weight)| weight).sum();
        let middle = [0, 1, 2].map(|axis| weights().map(|(w, weight)| weight * features[*w][axis]).sum::<f64>() / sum);
        let mut out = Self { squared_error_m2: 0.0, axis: 0, middle: 0.0 };
        let mut variance = [0.0; 3];
        for (w, weight) in weights() {
            let square = [0, 1, 2].map(|axis| (features[*w][axis] - middle[axis]).powi(2));
            variance = [0, 1, 2].map(|axis| variance[axis] + weight * square[axis]);
            out.squared_error_m2 += weight * ((square[0] + square[1].max(square[2])) / 8.0).powi(2);
        }
        out.axis = if variance[1] > variance[0] { 1 } else { 0 };
        out.axis = if variance[2] > variance[out.axis] { 2 } else { out.axis };
        out.middle = middle[out.axis];
        out
    }
}

/// The depth of each column over which the carriers refract, m: that in which a long wave has the mean wave number of
/// the waves in the column's water, and on its land as far as the swash comes. Where there is neither, the carriers go on
/// as the swash does.
pub(super) fn carrier_profile_m(grid: &Bathymetry, depths: ShoreDepths) -> Vec<f64> {
    let column = |i: usize| {
        let reached = (0..grid.rows).map(|j| grid.at(i, j)).filter(|depth_m| *depth_m > -depths.reach_m);
        let (count, sum) = reached
            .fold((0.0, 0.0), |(count, sum), depth_m| (count + 1.0, sum + depths.of_waves_m(depth_m).powf(-0.5)));
        if count > 0.0 { (count / sum).powi(2) } else { depths.swash_m }
    };
    (0..grid.columns).map(column).collect()
}

/// The group of `members`, waves at the edge of the grid with their variance (m^2), of which the first has the index
/// `first_wave`.
pub(super) fn group(
    members: &[(Incident, f64)],
    first_wave: usize,
    edge_depth_m: f64,
    profile_m: &[f64],
    cell_m: f64,
    gravity_m_s2: f64,
) -> WaveGroup {
    let k = |omega: f64, depth_m: f64| LocalWave::new(omega, depth_m, gravity_m_s2).k;
    let mut sums = [0.0; 3];
    for (wave, variance_m2) in members {
        let weight = variance_m2.max(f64::MIN_POSITIVE);
        let ky = k(wave.omega_rad_s, edge_depth_m) * wave.direction_rad.sin();
        sums = [sums[0] + weight, sums[1] + weight * wave.omega_rad_s, sums[2] + weight * ky];
    }
    let (omega_rad_s, ky) = (sums[1] / sums[0], sums[2] / sums[0]);
    // The carrier takes its direction over the first depth of the profile.
    let direction_rad = (ky / k(omega_rad_s, profile_m[0])).clamp(-1.0, 1.0).asin();
    let middle = Incident { omega_rad_s, direction_rad, ..Incident::default() };
    let carrier = Carrier::new(&middle, profile_m, cell_m, gravity_m_s2);
    WaveGroup { first_wave, wave_count: members.len(), ky_rad_m: carrier.ky_rad_m, column_phase_rad: carrier.phase_rad }
}
