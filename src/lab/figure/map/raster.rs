//! The coloured area of a map as a picture of palette indices.

use super::{MapFigure, MapPanel};

/// Colours an area of `size` pixels (to the right and down). Returns the index of each pixel among
/// [`super::ColourScale::colours`], row by row from the top, which is the land's side.
pub(super) fn raster(figure: &MapFigure, panel: &MapPanel, [width, height]: [usize; 2]) -> Vec<u8> {
    let at = |px: usize, py: usize| {
        // The x axis points up, the y axis to the right.
        let along = |p: f64, pixels: usize, count: usize| (p + 0.5) / pixels as f64 * (count - 1) as f64;
        let x = along((height - 1 - py) as f64, height, figure.columns);
        let y = along(px as f64, width, figure.rows);
        let (i, j) = ((x as usize).min(figure.columns - 2), (y as usize).min(figure.rows - 2));
        let (u, v) = (x - i as f64, y - j as f64);
        let corners = [
            (i, j, (1.0 - u) * (1.0 - v)),
            (i + 1, j, u * (1.0 - v)),
            (i, j + 1, (1.0 - u) * v),
            (i + 1, j + 1, u * v),
        ];
        let point = |(i, j, _): (usize, usize, f64)| j * figure.columns + i;
        let depth = |corner| f64::from(figure.depth_m[point(corner)]);
        let depth_m: f64 = corners.iter().map(|c| c.2 * depth(*c)).sum();
        if depth_m <= 0.0 {
            let [a, b, c, d] = corners.map(depth);
            // Light from the sea's side on the left.
            let lit = ((a + c - b - d) + (a + b - c - d)) / (2.0 * figure.cell_m);
            return panel.scale.land_index(-depth_m, lit) as u8;
        }
        // The mean of the corners in water.
        let (mut sum, mut weight) = (0.0, 0.0);
        for corner in corners.into_iter().filter(|c| depth(*c) > 0.0) {
            let value = f64::from(panel.values[point(corner)]);
            if value.is_finite() {
                (sum, weight) = (sum + (corner.2 + 1e-9) * value, weight + corner.2 + 1e-9);
            }
        }
        panel.scale.band(if weight > 0.0 { sum / weight } else { panel.scale.low }) as u8
    };
    (0..width * height).map(|pixel| at(pixel % width, pixel / width)).collect()
}
