//! Where the waves go on beyond the water that the solvers treat: over the shallowest water, and up the beach.

use crate::coast::bathymetry::Bathymetry;
use std::f64::consts::TAU;

/// Largest delay of the waves at the waterline, s, and the lengths of the lobes along the coast's y axis, m, into which it
/// bends their crests, each with its share and its phase, rad. Cusps of a beach, which are smaller than the cells of a
/// grid, do so in nature; without them, crests and the edge of the water would be straight lines.
const LOBE_DELAY_S: f64 = 1.3;
const LOBES: [[f64; 3]; 3] = [[127.0, 0.4, 0.3], [71.0, 0.35, 2.1], [43.0, 0.25, 4.4]];

/// How waves run where the shore is shallow or dry: from the least depth to the waterline they become swash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ShoreWaves {
    /// Depth, m, below which waves are no longer those of the solvers.
    pub(super) least_depth_m: f64,
    /// Height, m, of land up to which the swash may come.
    pub(super) reach_m: f64,
    /// Times, s, in which waves run a metre: in the least depth, and from the waterline on.
    pub(super) slowness_s_m: [f64; 2],
}

impl ShoreWaves {
    /// How far waves have become swash where the water is `depth_m` (m) deep: 0 from the least depth on, 1 from the
    /// waterline on.
    fn swash_share(&self, depth_m: f64) -> f64 {
        smooth_step(1.0 - depth_m / self.least_depth_m)
    }

    /// Time, s, in which long waves run a metre where the water is `depth_m` (m) deep.
    pub(super) fn slowness_at_s_m(&self, depth_m: f64) -> f64 {
        if depth_m > self.least_depth_m {
            return self.slowness_s_m[0] * (self.least_depth_m / depth_m).sqrt();
        }
        let share = self.swash_share(depth_m);
        (1.0 - share) * self.slowness_s_m[0] + share * self.slowness_s_m[1]
    }
}

/// The points of a shore, those nearest to the open water first.
pub(super) struct Shore {
    pub(super) places: Vec<Place>,
    /// How much later waves come to a point than they would without the lobes of the beach, s, of all points of the grid.
    pub(super) delay_s: Vec<f64>,
    /// Time in which long waves run a metre, s, at all points of the grid.
    pub(super) slowness_s_m: Vec<f64>,
}

/// A point of the shore.
pub(super) struct Place {
    /// Its index.
    pub(super) point: usize,
    /// Points around it that are nearer to the open water, from which its waves come, each with its share: the shares
    /// add up to 1.
    pub(super) sources: Vec<(usize, f64)>,
}

impl Shore {
    /// The shore of a grid: water shallower than the least depth, land in reach of the swash, and the first points of
    /// higher land, between which and the water the waves are interpolated.
    pub(super) fn new(grid: &Bathymetry, waves: ShoreWaves) -> Self {
        let mut is_reached: Vec<bool> = grid.depth_m.iter().map(|h| f64::from(*h) >= waves.least_depth_m).collect();
        let mut places = Vec::new();
        loop {
            let mut layer = Vec::new();
            for point in (0..is_reached.len()).filter(|point| !is_reached[*point]) {
                let is_low = |at: usize| f64::from(grid.depth_m[at]) > -waves.reach_m;
                let can_come = |at: &usize| is_reached[*at] && (is_low(*at) || is_low(point));
                let around: Vec<usize> = neighbours(grid, point).filter(can_come).collect();
                if !around.is_empty() {
                    layer.push(Place { point, sources: sources(grid, point, &around) });
                }
            }
            if layer.is_empty() {
                let slowness_s_m =
                    grid.depth_m.iter().map(|depth_m| waves.slowness_at_s_m(f64::from(*depth_m))).collect();
                return Self { places, delay_s: delays_s(grid, waves), slowness_s_m };
            }
            layer.iter().for_each(|place| is_reached[place.point] = true);
            places.extend(layer);
        }
    }

    /// Continues a map over the points of the shore that are shallower than `known_from_m` (m), where it says nothing,
    /// by the means of the sources.
    pub(super) fn continue_map(&self, grid: &Bathymetry, known_from_m: f64, map: &mut [f64]) {
        for place in self.places.iter().filter(|place| f64::from(grid.depth_m[place.point]) < known_from_m) {
            map[place.point] = place.sources.iter().map(|(source, weight)| weight * map[*source]).sum();
        }
    }
}

/// Delays of the waves, s, at the points of a grid: 0 where they are not yet swash, and whole from the waterline on.
fn delays_s(grid: &Bathymetry, waves: ShoreWaves) -> Vec<f64> {
    let lobes = |y_m: f64| LOBES.iter().map(|[length_m, share, rad]| share * (TAU * y_m / length_m + rad).sin()).sum();
    let rows: Vec<f64> = (0..grid.rows).map(|j| lobes(j as f64 * grid.cell_m)).collect();
    let delay = |(point, depth_m): (usize, &f32)| {
        LOBE_DELAY_S * rows[point / grid.columns] * waves.swash_share(f64::from(*depth_m))
    };
    grid.depth_m.iter().enumerate().map(delay).collect()
}

/// Rises smoothly from 0 at 0 to 1 at 1.
pub(super) fn smooth_step(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The indices of the up to eight points around a point.
pub(super) fn neighbours(grid: &Bathymetry, point: usize) -> impl Iterator<Item = usize> + use<> {
    let (columns, rows) = (grid.columns, grid.rows);
    let (i, j) = (point % columns, point / columns);
    (j.saturating_sub(1)..(j + 2).min(rows))
        .flat_map(move |y| (i.saturating_sub(1)..(i + 2).min(columns)).map(move |x| y * columns + x))
        .filter(move |at| *at != point)
}

/// The shares of the points `around`: a nearer one counts for more.
fn sources(grid: &Bathymetry, point: usize, around: &[usize]) -> Vec<(usize, f64)> {
    let weight = |at: usize| {
        let is_diagonal = at % grid.columns != point % grid.columns && at / grid.columns != point / grid.columns;
        if is_diagonal { 0.5 } else { 1.0 }
    };
    let sum: f64 = around.iter().map(|at| weight(*at)).sum();
    around.iter().map(|at| (*at, weight(*at) / sum)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A beach of 1 in 10 with a cliff at its upper half: the low beach is reached row by row, the cliff only at its
    /// edge.
    #[test]
    fn the_shore_reaches_from_shallow_water_up_to_the_run_up() {
        let grid = Bathymetry::from_fn(30, 12, 5.0, |x, y| if y < 30.0 { 5.0 - 0.1 * x } else { 5.0 - 0.1 * x - 9.0 });
        let waves = ShoreWaves { least_depth_m: 1.0, reach_m: 2.0, slowness_s_m: [0.3, 0.1] };
        let shore = Shore::new(&grid, waves);
        let place = |i: usize, j: usize| shore.places.iter().position(|place| place.point == j * 30 + i);
        // Depths of row 2: 1.0 at column 8, 0.5 at 9, 0 at 10, -2 at 14, -2.5 at 15.
        assert!(place(8, 2).is_none() && place(9, 2).is_some() && place(9, 2) < place(10, 2));
        assert!(place(13, 2).is_some() && place(14, 2).is_some() && place(15, 2).is_none());
        // The cliff is 4 m high at the sea's edge of the grid: only its first row beside the water is reached.
        assert!(place(3, 6).is_some() && place(3, 7).is_none());
        // In 4 times the least depth, waves are twice as fast. Half-way to the waterline, they are half swash.
        let slowness_s_m = [2, 8, 9, 10, 12].map(|i| shore.slowness_s_m[60 + i]);
        for (got, want) in slowness_s_m.into_iter().zip([0.15, 0.3, 0.2, 0.1, 0.1]) {
            assert!((got - want).abs() < 1e-6, "{slowness_s_m:?}");
        }
        for place in &shore.places {
            let sum: f64 = place.sources.iter().map(|source| source.1).sum();
            assert!((sum - 1.0).abs() < 1e-12 && !place.sources.is_empty());
        }
    }
}
