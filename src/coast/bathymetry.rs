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
}
