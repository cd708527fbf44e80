//! Structures in the water: breakwaters, quays and piers, which reflect waves.

use super::bathymetry::Bathymetry;

/// A wall or a mound along a line, in the frame of a coast.
///
/// The reflection coefficient is the ratio of the amplitudes of the reflected and the incident wave: 0.9 to 1 for a
/// vertical wall, 0.3 to 0.5 for a mound of rubble (U.S. Army Corps of Engineers, Coastal Engineering Manual, part II-7).
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// What it is, such as "breakwater".
    pub name: &'static str,
    /// Corners of its middle line (x, y), m.
    pub line_m: Vec<[f64; 2]>,
    /// Width of its top, m.
    pub top_width_m: f64,
    /// Height of its top above the still water, m.
    pub top_height_m: f64,
    /// Horizontal metres for each metre of height of its sides: 0 for a vertical wall, 1.5 for rubble.
    pub side_slope: f64,
    /// Amplitude of the reflected wave as a fraction of that of the incident one, 0 to 1.
    pub reflection: f64,
}

impl Structure {
    /// Distance (m) of a point (m) from the middle line.
    pub fn distance_m(&self, x_m: f64, y_m: f64) -> f64 {
        let to_piece = |pair: &[[f64; 2]]| {
            let ([ax, ay], [bx, by]) = (pair[0], pair[1]);
            let (dx, dy) = (bx - ax, by - ay);
            let t = (((x_m - ax) * dx + (y_m - ay) * dy) / (dx * dx + dy * dy).max(1e-12)).clamp(0.0, 1.0);
            (x_m - ax - t * dx).hypot(y_m - ay - t * dy)
        };
        self.line_m.windows(2).map(to_piece).fold(f64::INFINITY, f64::min)
    }

    /// Height (m above the still water, negative below) of the structure at a distance (m) from its middle line; `None`
    /// beyond a vertical side. `least_width_m` widens a structure that is narrower than the cells of a grid.
    pub fn height_m(&self, distance_m: f64, least_width_m: f64) -> Option<f64> {
        let beyond_m = distance_m - 0.5 * self.top_width_m.max(least_width_m);
        if beyond_m <= 0.0 {
            return Some(self.top_height_m);
        }
        (self.side_slope > 0.0).then(|| self.top_height_m - beyond_m / self.side_slope)
    }

    /// Raises the bed to the structure wherever this is higher. A structure narrower than the cells becomes as wide as
    /// their diagonal, so that it has no gaps.
    pub fn build_in(&self, bathymetry: &mut Bathymetry) {
        let cell_m = bathymetry.cell_m;
        // The sides of a mound meet the bed nearer than this; points farther away are left out.
        let deepest = bathymetry.depth_m.iter().copied().fold(0.0, f32::max);
        let reach_m =
            0.5 * self.top_width_m + 1.5 * cell_m + self.side_slope * (self.top_height_m + f64::from(deepest));
        let range = |axis: usize, count: usize| {
            let values = self.line_m.iter().map(|p| p[axis]);
            let (low, high) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
            let at = |v: f64| (v / cell_m).clamp(0.0, (count - 1) as f64);
            (at(low - reach_m).floor() as usize)..=(at(high + reach_m).ceil() as usize)
        };
        for j in range(1, bathymetry.rows) {
            for i in range(0, bathymetry.columns) {
                let distance_m = self.distance_m(i as f64 * cell_m, j as f64 * cell_m);
                if let Some(height_m) = self.height_m(distance_m, std::f64::consts::SQRT_2 * cell_m) {
                    let depth_m = &mut bathymetry.depth_m[j * bathymetry.columns + i];
                    *depth_m = depth_m.min(-height_m as f32);
                }
            }
        }
    }
}

/// Reflection coefficient of the nearest structure whose waterline is within `reach_m` (m) of a point (m); `None` if there
/// is none.
pub fn reflection_at(structures: &[Structure], x_m: f64, y_m: f64, reach_m: f64) -> Option<f64> {
    let near = structures.iter().map(|s| {
        let foot_m = 0.5 * s.top_width_m + s.side_slope * s.top_height_m;
        (s.distance_m(x_m, y_m) - foot_m, s.reflection)
    });
    near.filter(|(distance_m, _)| *distance_m <= reach_m).min_by(|a, b| a.0.total_cmp(&b.0)).map(|s| s.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(side_slope: f64) -> Structure {
        Structure {
            name: "wall",
            line_m: vec![[50.0, 20.0], [50.0, 60.0], [90.0, 60.0]],
            top_width_m: 4.0,
            top_height_m: 3.0,
            side_slope,
            reflection: 0.95,
        }
    }

    #[test]
    fn a_wall_stands_in_the_water_without_gaps() {
        assert_eq!(wall(0.0).distance_m(53.0, 30.0), 3.0);
        assert_eq!(wall(0.0).distance_m(93.0, 64.0), 5.0);
        // Cells of 7 m are wider than the wall. Each row between its ends still has land where the wall is.
        let mut bed = Bathymetry::from_fn(20, 14, 7.0, |_, _| 6.0);
        wall(0.0).build_in(&mut bed);
        for j in 3..=8 {
            let land = (0..bed.columns).filter(|i| bed.at(*i, j) == -3.0).count();
            assert!(land >= 1, "row {j}");
        }
        assert_eq!((bed.at(0, 0), bed.at(12, 3)), (6.0, 6.0));
        // A mound slopes down to the bed: 1.5 m for each metre.
        let mut bed = Bathymetry::from_fn(101, 81, 1.0, |_, _| 6.0);
        wall(1.5).build_in(&mut bed);
        assert_eq!((bed.at(50, 40), bed.at(52, 40), bed.at(48, 40)), (-3.0, -3.0, -3.0));
        assert!((bed.at(45, 40) - (-3.0 + 2.0)).abs() < 1e-6 && (bed.at(40, 40) - (-3.0 + 8.0 / 1.5)).abs() < 1e-5);
        assert_eq!(bed.at(34, 40), 6.0);
    }

    #[test]
    fn the_nearest_structure_reflects() {
        let walls = [wall(0.0), Structure { reflection: 0.4, line_m: vec![[0.0, 0.0], [0.0, 9.0]], ..wall(0.0) }];
        assert_eq!(reflection_at(&walls, 47.0, 30.0, 5.0), Some(0.95));
        assert_eq!(reflection_at(&walls, 4.0, 5.0, 5.0), Some(0.4));
        assert_eq!(reflection_at(&walls, 25.0, 5.0, 5.0), None);
    }
}
