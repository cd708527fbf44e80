//! Wave heights before a coast and at their highest, and the depth and distance from the shore at which waves begin to
//! break.

use super::bathymetry::Bathymetry;
use super::sea_maps::usual_largest;
use super::transfer::TransferStatistics;

/// How a coast changes the waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoastEffect {
    /// Mean significant wave height at the seaward edge, m.
    pub offshore_hs_m: f64,
    /// Significant wave height that only one wet point in 200 exceeds, m.
    pub highest_hs_m: f64,
    /// Mean depth of the points that exceed it, m.
    pub highest_depth_m: f64,
    /// Depth in which one wave in twenty breaks, on the way from the sea, m; `None` if they break nowhere.
    pub breaking_depth_m: Option<f64>,
    /// Distance from there to the shore, straight on to the land, m: the median along the coast. `None` if they break
    /// nowhere, or less than a quarter of the coast has a shore behind that depth.
    pub breaking_distance_m: Option<f64>,
}

/// Step of the depths at which breaking is looked for, m.
const DEPTH_STEP_M: f64 = 0.25;
/// Significant wave height in depths from which waves are said to break. One wave in twenty breaks there: its root mean
/// square is 0.56 of the largest height, 0.73 depths (Battjes and Janssen 1978).
const BREAKING_BEGINS: f64 = 0.58;

impl CoastEffect {
    /// Reads the numbers off the maps; `None` without water at the seaward edge.
    pub fn new(statistics: &TransferStatistics) -> Option<Self> {
        let (grid, maps) = (&statistics.bathymetry, &statistics.maps);
        let index = |[i, j]: [usize; 2]| j * grid.columns + i;
        let edge: Vec<usize> = (0..grid.rows).map(|j| index([0, j])).filter(|i| grid.depth_m[*i] > 0.0).collect();
        let mean = |points: &[usize], value: &dyn Fn(usize) -> f32| {
            points.iter().map(|i| f64::from(value(*i))).sum::<f64>() / points.len() as f64
        };
        if edge.is_empty() {
            return None;
        }
        let highest_hs_m = usual_largest(&maps.hs_m);
        let (mut highest, mut heights_in_depths) = (Vec::new(), Vec::<(f64, f64)>::new());
        for (i, depth_m) in grid.depth_m.iter().map(|depth_m| f64::from(*depth_m)).enumerate() {
            if depth_m > 0.0 {
                let (hs_m, step) = (f64::from(maps.hs_m[i]), (depth_m / DEPTH_STEP_M) as usize);
                heights_in_depths.resize(heights_in_depths.len().max(step + 1), (0.0, 0.0));
                let (sum, count) = heights_in_depths[step];
                heights_in_depths[step] = (sum + hs_m / depth_m, count + 1.0);
                if hs_m >= highest_hs_m {
                    highest.push(i);
                }
            }
        }
        let step = heights_in_depths.iter().rposition(|(sum, count)| *sum > BREAKING_BEGINS * count);
        let breaking_depth_m = step.map(|step| (step + 1) as f64 * DEPTH_STEP_M);
        Some(Self {
            offshore_hs_m: mean(&edge, &|i| maps.hs_m[i]),
            highest_hs_m,
            highest_depth_m: mean(&highest, &|i| grid.depth_m[i]),
            breaking_depth_m,
            breaking_distance_m: breaking_depth_m.and_then(|depth_m| distance_to_shore_m(grid, depth_m)),
        })
    }
}

/// Distance from where the water is first `depth_m` deep or less, on the way from the sea, to the land behind it, m:
/// the median of the rows of the grid. `None` if less than a quarter of the rows has both.
fn distance_to_shore_m(grid: &Bathymetry, depth_m: f64) -> Option<f64> {
    let in_row = |j: usize| {
        let shallow = (0..grid.columns).find(|i| grid.at(*i, j) <= depth_m)?;
        let land = (shallow..grid.columns).find(|i| grid.at(*i, j) <= 0.0)?;
        (land > shallow).then(|| (land - shallow) as f64 * grid.cell_m)
    };
    let mut distances_m: Vec<f64> = (0..grid.rows).filter_map(in_row).collect();
    distances_m.sort_by(f64::total_cmp);
    (4 * distances_m.len() >= grid.rows).then(|| distances_m.get(distances_m.len() / 2).copied()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of 1 in 50 with land from 5 m behind its end; one row has land nowhere.
    #[test]
    fn the_distance_to_the_shore_is_that_of_most_rows() {
        let (columns, rows, cell_m) = (60, 5, 2.0);
        let depth = |i: usize, j: usize| if j == 4 { 2.0 } else { 2.0 - 0.04 * i as f32 };
        let depth_m = (0..rows).flat_map(|j| (0..columns).map(move |i| depth(i, j))).collect();
        let grid = Bathymetry { columns, rows, cell_m, depth_m };
        // One metre of water begins at 50 m, and the water ends at 100 m.
        let distance_m = distance_to_shore_m(&grid, 1.0).expect("a shore");
        assert!((distance_m - 50.0).abs() <= cell_m, "{distance_m}");
        let flat = Bathymetry { depth_m: vec![0.5; columns * rows], ..grid };
        assert_eq!(distance_to_shore_m(&flat, 1.0), None);
    }
}
