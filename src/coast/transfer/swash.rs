//! How much the water level varies near the shore: as the waves do, or as the swash of the sea.
//!
//! The swash has the significant height S of Stockdon et al. 2006, with its incident and infragravity parts; the
//! standard deviation of the level is S / 4. It begins where the waves of the surf are no higher than S. In calm
//! corners the swash is no higher than the waves nearby allow.

use super::setup::Setup;
use super::shore::{Shore, neighbours, smooth_step};
use crate::coast::bathymetry::Bathymetry;
use crate::coast::losses::Dissipation;
use std::collections::VecDeque;

/// Step of the depths at which wave height and swash are compared, m.
const DEPTH_STEP_M: f64 = 0.1;
/// Largest depth of the beginning of the swash, in heights of the swash.
const LARGEST_DEPTH: f64 = 4.0;
/// Height of the swash over that of the highest waves nearby, at most.
const SWASH_TO_WAVES: f64 = 1.25;
/// Range of the number of cells over which waves count as nearby.
const NEARBY_CELLS: [usize; 2] = [3, 24];
/// Fraction of the depth at which the swash begins below which it has its whole height.
const WHOLE_BELOW: f64 = 0.4;

/// How the level should vary at each point.
pub(super) struct Swash {
    /// Depth at which it begins, m; 0 if there is none.
    pub(super) begin_m: f64,
    /// Variance of the level, m^2.
    pub(super) variance_m2: Vec<f64>,
    /// Share of the set-up of the beach, by the formula of Stockdon et al. 2006, in the mean level: 0 where the waves
    /// break, to the height of the swash here over that of an open beach.
    pub(super) set_up_share: Vec<f64>,
}

impl Swash {
    /// The swash of a sea whose waves have the variance `solved_m2` (m^2) by the solution.
    pub(super) fn new(setup: &Setup, sea: &Dissipation, solved_m2: &[f64], shore: &Shore) -> Self {
        let grid = &setup.grid;
        let mut out = Self { begin_m: 0.0, variance_m2: solved_m2.to_vec(), set_up_share: vec![0.0; solved_m2.len()] };
        if let Some(run_up) = setup.run_up.filter(|run_up| run_up.swash_m > 0.0) {
            let height_m: Vec<f64> = sea.variance_m2.iter().map(|m0| 4.0 * f64::from(*m0).sqrt()).collect();
            let begin_m = beginning_m(grid, &sea.variance_m2, run_up.swash_m);
            out.begin_m = begin_m;
            let cells = nearby_cells(grid, begin_m);
            for point in 0..solved_m2.len() {
                let depth_m = f64::from(grid.depth_m[point]);
                if depth_m > 0.0 && depth_m < begin_m {
                    let nearby_m = highest_nearby_m(grid, &height_m, point, cells);
                    let swash_m = run_up.swash_m.min(SWASH_TO_WAVES * nearby_m);
                    let part = smooth_step((begin_m - depth_m) / ((1.0 - WHOLE_BELOW) * begin_m));
                    let wanted = &mut out.variance_m2[point];
                    *wanted += part * ((swash_m / 4.0).powi(2) - *wanted).max(0.0);
                    out.set_up_share[point] = part * swash_m / run_up.swash_m;
                }
            }
        }
        let known_from_m = setup.options.min_depth_m;
        shore.continue_map(grid, known_from_m, &mut out.variance_m2);
        shore.continue_map(grid, known_from_m, &mut out.set_up_share);
        out
    }
}

/// Depth, m, in which the sea is as high as the swash of the height `swash_m` (m), seen from the shore; where the sea
/// is highest if it is nowhere so high.
fn beginning_m(grid: &Bathymetry, variance_m2: &[f32], swash_m: f64) -> f64 {
    let count = ((LARGEST_DEPTH * swash_m / DEPTH_STEP_M) as usize).max(1);
    let mut sums = vec![[0.0; 2]; count];
    for (depth_m, m0) in grid.depth_m.iter().zip(variance_m2).filter(|(depth_m, m0)| **depth_m > 0.0 && **m0 > 0.0) {
        if let Some(sum) = sums.get_mut((f64::from(*depth_m) / DEPTH_STEP_M) as usize) {
            *sum = [sum[0] + 1.0, sum[1] + f64::from(*m0)];
        }
    }
    let (mut highest, mut place) = (0.0, 0);
    for (class, [count, sum]) in sums.iter().enumerate().filter(|(_, sum)| sum[0] > 0.0) {
        let height_m = 4.0 * (sum / count).sqrt();
        if height_m > highest {
            (highest, place) = (height_m, class);
        }
        if height_m >= swash_m {
            break;
        }
    }
    (place + 1) as f64 * DEPTH_STEP_M
}

/// Number of cells from the shore to the depth `depth_m` (m): the median of the rows, and two more.
fn nearby_cells(grid: &Bathymetry, depth_m: f64) -> usize {
    let row = |j: usize| {
        let land = (0..grid.columns).find(|i| grid.at(*i, j) <= 0.0)?;
        Some((0..land).rev().take_while(|i| grid.at(*i, j) < depth_m).count())
    };
    let mut cells: Vec<usize> = (0..grid.rows).filter_map(row).collect();
    cells.sort_unstable();
    (cells.get(cells.len() / 2).copied().unwrap_or(0) + 2).clamp(NEARBY_CELLS[0], NEARBY_CELLS[1])
}

/// The largest of the heights (m) at the points that are up to `cells` steps through water away from `point`.
fn highest_nearby_m(grid: &Bathymetry, height_m: &[f64], point: usize, cells: usize) -> f64 {
    let side = 2 * cells + 1;
    let (i0, j0) = (point % grid.columns, point / grid.columns);
    let place = |at: usize| (at / grid.columns + cells - j0) * side + at % grid.columns + cells - i0;
    let mut is_seen = vec![false; side * side];
    is_seen[place(point)] = true;
    let mut queue = VecDeque::from([(point, 0)]);
    let mut highest = height_m[point];
    while let Some((at, steps)) = queue.pop_front() {
        highest = highest.max(height_m[at]);
        if steps < cells {
            for next in neighbours(grid, at).filter(|next| grid.depth_m[*next] > 0.0) {
                if !std::mem::replace(&mut is_seen[place(next)], true) {
                    queue.push_back((next, steps + 1));
                }
            }
        }
    }
    highest
}
