//! Groups of waves that share a carrier.
//!
//! Between the points of the grid, envelopes are interpolated linearly. For a wave whose phase differs from that of
//! its carrier by delta between two points, this loses delta^2 / 8 of the amplitude half-way. So the groups are made
//! small in the wave numbers, at the edge of the grid and in shallow water: the group with the largest loss is
//! divided again and again.

use super::WaveGroup;
use super::shore::ShoreWaves;
use crate::coast::bathymetry::Bathymetry;
use crate::coast::field::wave_number_along_x;
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

/// Means over a column of the grid, from which the wave numbers of the carriers in that column follow.
pub(super) struct Column {
    /// Depth, m, in which a long wave has the mean wave number of the column's water of at least the least depth.
    depth_m: f64,
    /// Share of that water in the column without its high land; the rest is shore.
    wet_share: f64,
    /// Mean time in which waves run a metre of that shore, s. A column of high land has that of the swash.
    slowness_s_m: f64,
}

impl Column {
    fn wave_number(&self, omega_rad_s: f64, gravity_m_s2: f64) -> f64 {
        let wet = LocalWave::new(omega_rad_s, self.depth_m, gravity_m_s2).k;
        self.wet_share * wet + (1.0 - self.wet_share) * omega_rad_s * self.slowness_s_m
    }
}

/// The columns of a grid whose shore has the waves `shore`.
pub(super) fn columns(grid: &Bathymetry, shore: ShoreWaves) -> Vec<Column> {
    let column = |i: usize| {
        let (mut wet, mut wet_sum, mut shallow, mut slowness_sum) = (0.0, 0.0, 0.0, 0.0);
        for depth_m in (0..grid.rows).map(|j| grid.at(i, j)) {
            if depth_m >= shore.least_depth_m {
                (wet, wet_sum) = (wet + 1.0, wet_sum + depth_m.powf(-0.5));
            } else if depth_m > -shore.reach_m {
                (shallow, slowness_sum) = (shallow + 1.0, slowness_sum + shore.slowness_at_s_m(depth_m));
            }
        }
        Column {
            depth_m: if wet > 0.0 { f64::powi(wet / wet_sum, 2) } else { shore.least_depth_m },
            wet_share: if wet > 0.0 { wet / (wet + shallow) } else { 0.0 },
            slowness_s_m: if shallow > 0.0 { slowness_sum / shallow } else { shore.slowness_s_m[1] },
        }
    };
    (0..grid.columns).map(column).collect()
}

/// The group of `members`, waves at the edge of the grid with their variance (m^2), of which the first has the index
/// `first_wave`. Its carrier refracts over the columns.
pub(super) fn group(
    members: &[(Incident, f64)],
    first_wave: usize,
    edge_depth_m: f64,
    columns: &[Column],
    cell_m: f64,
    gravity_m_s2: f64,
) -> WaveGroup {
    let mut sums = [0.0; 3];
    for (wave, variance_m2) in members {
        let weight = variance_m2.max(f64::MIN_POSITIVE);
        let k = LocalWave::new(wave.omega_rad_s, edge_depth_m, gravity_m_s2).k;
        let ky = k * wave.direction_rad.sin();
        sums = [sums[0] + weight, sums[1] + weight * wave.omega_rad_s, sums[2] + weight * ky];
    }
    let (omega_rad_s, ky_rad_m) = (sums[1] / sums[0], sums[2] / sums[0]);
    let along_x = |column: &Column| wave_number_along_x(column.wave_number(omega_rad_s, gravity_m_s2), ky_rad_m);
    let kx_rad_m: Vec<f64> = columns.iter().map(along_x).collect();
    let mut column_phase_rad = vec![0.0];
    for pair in kx_rad_m.windows(2) {
        column_phase_rad.push(column_phase_rad[column_phase_rad.len() - 1] + 0.5 * cell_m * (pair[0] + pair[1]));
    }
    WaveGroup { first_wave, wave_count: members.len(), ky_rad_m, column_phase_rad }
}
