//! The grid of the elliptic solver: that of the coast, perhaps finer, with borders that absorb the scattered waves.

use crate::coast::bathymetry::Bathymetry;
use crate::coast::losses::Dissipation;
use crate::coast::options::Options;

/// Smallest and largest number of cells of an absorbing border.
const BORDER_CELLS: [usize; 2] = [10, 48];
/// Width of a border, in rad of the longest wave of the open sea, if the cells allow it.
const BORDER_RAD: f64 = 4.0;
/// Cells at the open sea, and at an open end of the grid, in which the depth changes to that of the border.
const RAMP_CELLS: usize = 6;
/// Attenuation (nepers) of a wave that crosses a border once, for a wave number of 1 rad in a cell and more; longer
/// waves get it, too.
const ATTENUATION: f64 = 6.0;

/// Points of the elliptic solver, and the properties of the water there.
pub(super) struct Grid {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Length of a cell, m.
    pub(super) cell_m: f64,
    /// Number of cells in a cell of the coast's grid.
    pub(super) refinement: usize,
    /// Number of cells of an absorbing border.
    pub(super) border: usize,
    /// Column and row of the coast's first point.
    pub(super) first: [usize; 2],
    /// Depth of each point, m: positive where it is wet.
    pub(super) depth_m: Vec<f64>,
    pub(super) is_wet: Vec<bool>,
    /// Rate at which breaking takes energy, 1/s.
    pub(super) loss_per_s: Vec<f64>,
    /// Reflection coefficient (0 to 1) of the edge of each dry point.
    pub(super) reflection: Vec<f64>,
    /// Whether the sea goes on beyond the last column.
    pub(super) is_open_behind: bool,
}

impl Grid {
    /// Makes the grid of a coast with `refinement` cells in each of its cells. `open_depth_m` is the depth of the open
    /// sea, `k_low` the wave number (rad/m) of its longest wave; `reflection` belongs to the points of `bathymetry`.
    pub(super) fn new(
        bathymetry: &Bathymetry,
        dissipation: &Dissipation,
        reflection: &[f32],
        (refinement, open_depth_m, k_low): (usize, f64, f64),
        options: &Options,
    ) -> Self {
        let (last_i, last_j) = (bathymetry.columns - 1, bathymetry.rows - 1);
        let is_wet = |i: usize, j: usize| bathymetry.at(i, j) >= options.min_depth_m;
        let is_open_behind = is_wet(last_i, 0) && is_wet(last_i, last_j);
        let behind_m = 0.5 * (bathymetry.at(last_i, 0) + bathymetry.at(last_i, last_j));
        let cell_m = bathymetry.cell_m / refinement as f64;
        let border = ((BORDER_RAD / (k_low * cell_m)).ceil() as usize).clamp(BORDER_CELLS[0], BORDER_CELLS[1]);
        let ahead = RAMP_CELLS + border;
        let behind = if is_open_behind { ahead } else { 0 };
        let columns = last_i * refinement + 1 + ahead + behind;
        let rows = last_j * refinement + 1 + 2 * border;
        let mut out = Self {
            columns,
            rows,
            cell_m,
            refinement,
            border,
            first: [ahead, border],
            depth_m: Vec::with_capacity(columns * rows),
            is_wet: Vec::with_capacity(columns * rows),
            loss_per_s: Vec::with_capacity(columns * rows),
            reflection: Vec::with_capacity(columns * rows),
            is_open_behind,
        };
        let (fine_columns, fine_rows) = (last_i * refinement + 1, last_j * refinement + 1);
        for row in 0..rows {
            let y = row.saturating_sub(border).min(fine_rows - 1);
            for column in 0..columns {
                let x = column.saturating_sub(ahead).min(fine_columns - 1);
                let before = ahead.saturating_sub(column);
                let after = (column + 1).saturating_sub(ahead + fine_columns);
                let (near, wet) = sample(bathymetry, [x, y], refinement, &is_wet);
                let outside = (before.max(after) as f64 / RAMP_CELLS as f64).min(1.0);
                let far_m = if before > 0 { open_depth_m } else { behind_m };
                out.depth_m.push((near + outside * (far_m - near)).max(options.min_depth_m));
                out.is_wet.push(wet || outside > 0.0);
                let nearest = (y + refinement / 2) / refinement * (last_i + 1) + (x + refinement / 2) / refinement;
                out.loss_per_s.push(f64::from(dissipation.rate_per_s[nearest]) * (1.0 - outside));
                out.reflection.push(f64::from(reflection[nearest]).clamp(0.0, 1.0));
            }
        }
        out
    }

    /// Complex stretching 1 + i sigma of the coordinates x and y (absorbing borders, Berenger 1994, in the form of Chew
    /// and Weedon) at the place (`x`, `y`), in cells, for waves with the phase `k_cell` (rad) in a cell: returns both
    /// sigmas.
    pub(super) fn stretch(&self, x: f64, y: f64, k_cell: f64) -> [f64; 2] {
        let width = self.border as f64;
        let behind = if self.is_open_behind { x - ((self.columns - 1) as f64 - width) } else { 0.0 };
        let depth_x = (width - x).max(behind).max(0.0) / width;
        let depth_y = (width - y).max(y - ((self.rows - 1) as f64 - width)).max(0.0) / width;
        // The integral of sigma over the border is a third of its largest value.
        let largest = 3.0 * ATTENUATION / (k_cell * width);
        [largest * depth_x * depth_x, largest * depth_y * depth_y]
    }
}

/// Depth (m) at a fine point of the coast's grid, and whether it is wet: interpolated where the four points around are
/// alike, and that of the nearest point beside edges, so that walls stay vertical.
fn sample(
    bathymetry: &Bathymetry,
    [x, y]: [usize; 2],
    refinement: usize,
    is_wet: &impl Fn(usize, usize) -> bool,
) -> (f64, bool) {
    let [i, j] = [x / refinement, y / refinement];
    let [p, q] = [x % refinement, y % refinement].map(|part| part as f64 / refinement as f64);
    let (i1, j1) = (if p > 0.0 { i + 1 } else { i }, if q > 0.0 { j + 1 } else { j });
    let corners = [(i, j), (i1, j), (i, j1), (i1, j1)];
    let near = (if p < 0.5 { i } else { i1 }, if q < 0.5 { j } else { j1 });
    let wet = is_wet(near.0, near.1);
    if corners.iter().any(|(i, j)| is_wet(*i, *j) != wet) {
        return (bathymetry.at(near.0, near.1), wet);
    }
    let [a, b, c, d] = corners.map(|(i, j)| bathymetry.at(i, j));
    ((1.0 - q) * (a + p * (b - a)) + q * (c + p * (d - c)), wet)
}
