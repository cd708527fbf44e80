//! Depth of the water on a regular grid.

/// Depth of the water at the points of a regular grid in the frame of a coast (see the module [`crate::coast`]).
///
/// Point (i, j) lies at x = i `cell_m` (shoreward from the sea's edge of the grid) and y = j `cell_m` (along the
/// shore).
#[derive(Clone, Debug, PartialEq)]
pub struct Bathymetry {
    /// Number of points along x, at least 2.
    pub columns: usize,
    /// Number of points along y, at least 2.
    pub rows: usize,
    /// Distance between neighbouring points along x and along y, m.
    pub cell_m: f64,
    /// Depth below the still water, m; negative on land. The value of point (i, j) has the index j `columns` + i.
    pub depth_m: Vec<f32>,
}

impl Bathymetry {
    /// Makes a grid from a function of x and y (m) that returns the depth (m, negative on land).
    pub fn from_fn(columns: usize, rows: usize, cell_m: f64, depth_m: impl Fn(f64, f64) -> f64) -> Self {
        let at = |index: usize| depth_m((index % columns) as f64 * cell_m, (index / columns) as f64 * cell_m) as f32;
        Self { columns, rows, cell_m, depth_m: (0..columns * rows).map(at).collect() }
    }

    /// Depth (m) at point (i, j).
    pub fn at(&self, i: usize, j: usize) -> f64 {
        f64::from(self.depth_m[j * self.columns + i])
    }

    /// Depth (m) at the place (`x_m`, `y_m`), m: bilinear between the points, and that of the nearest edge outside.
    pub fn depth_at_m(&self, x_m: f64, y_m: f64) -> f64 {
        let place = |at_m: f64, count: usize| {
            let at = (at_m / self.cell_m).clamp(0.0, (count - 1) as f64);
            let low = (at as usize).min(count - 2);
            (low, at - low as f64)
        };
        let ((i, p), (j, q)) = (place(x_m, self.columns), place(y_m, self.rows));
        let along_x = |j: usize| self.at(i, j) + p * (self.at(i + 1, j) - self.at(i, j));
        along_x(j) + q * (along_x(j + 1) - along_x(j))
    }
}
