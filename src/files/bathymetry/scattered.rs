//! Scattered points, such as soundings: Delaunay triangles between them, and linear interpolation in each triangle, as
//! geographic programs do it.

use super::grid::{Axis, RawGrid};
use super::{ReadAs, words};
use delaunator::{Point, triangulate};

/// Largest number of points along a side of the grid.
const MAX_SIDE: usize = 1024;
/// Longest side of a triangle, in cells of the grid. Longer ones bridge places where nobody sounded.
const MAX_TRIANGLE_CELLS: f64 = 40.0;

/// Puts points (x, y, z) onto a grid whose cells are as large as the mean distance of neighbouring points.
pub(super) fn grid(points: &[[f64; 3]], head: &str, read_as: ReadAs) -> Result<RawGrid, String> {
    let known: Vec<[f64; 3]> = points.iter().copied().filter(|p| !p[2].is_nan()).collect();
    let range = |axis: usize| {
        known.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[axis]), high.max(p[axis])))
    };
    let ((west, east), (south, north)) = (range(0), range(1));
    let (wide, high) = (east - west, north - south);
    if known.len() < 4 || !(wide > 0.0 && high > 0.0) {
        return Err("its points lie on one line: a bathymetry covers an area".into());
    }
    // Degrees of longitude are shorter than those of latitude: triangles are chosen in true proportions.
    let in_degrees = read_as.is_in_degrees.or_else(|| words::says_degrees(head));
    let middle = 0.5 * (south + north);
    let squeeze = if in_degrees == Some(true) && middle.abs() < 89.0 { middle.to_radians().cos() } else { 1.0 };
    let area = wide * squeeze * high;
    let cell = (area / known.len() as f64).sqrt().max((wide * squeeze).max(high) / (MAX_SIDE - 1) as f64);
    let axis = |first: f64, length: f64, cell: f64| {
        let count = ((length / cell).round() as usize).clamp(1, MAX_SIDE - 1);
        Axis { first, step: length / count as f64, count: count + 1 }
    };
    let (x, y) = (axis(west, wide, cell / squeeze), axis(south, high, cell));
    // Positions in cells of the grid, which are near 1 whatever the unit of the file.
    let places: Vec<Point> =
        known.iter().map(|p| Point { x: (p[0] - west) / x.step, y: (p[1] - south) / y.step }).collect();
    let mut values = vec![f32::NAN; x.count * y.count];
    let triangles = triangulate(&places).triangles;
    for corners in triangles.chunks_exact(3) {
        let corner = |i: usize| [places[corners[i]].x, places[corners[i]].y, known[corners[i]][2]];
        paint([corner(0), corner(1), corner(2)], &mut values, x.count, y.count);
    }
    let mut grid = RawGrid::new(x, y, values);
    grid.notices.push(format!(
        "{} scattered points become a grid of {} x {} points, linear in the triangles between them",
        known.len(),
        x.count,
        y.count
    ));
    Ok(grid)
}

/// Gives the points of the grid inside a triangle their values. Corners are x, y in cells, and the value.
fn paint([a, b, c]: [[f64; 3]; 3], values: &mut [f32], columns: usize, rows: usize) {
    let side = |p: [f64; 3], q: [f64; 3]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if twice_area.abs() < 1e-9 || side(a, b).max(side(b, c)).max(side(c, a)) > MAX_TRIANGLE_CELLS {
        return;
    }
    let clamped = |low: f64, high: f64, count: usize| {
        ((low - 1e-9).ceil().max(0.0) as usize)..=((high + 1e-9).floor().clamp(-1.0, (count - 1) as f64) + 1.0) as usize
    };
    let rows_between = clamped(a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]), rows);
    for j in rows_between.filter(|j| *j < rows) {
        let y = j as f64;
        // Where the row enters and leaves the triangle.
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if (p[1] - y) * (q[1] - y) <= 1e-9 {
                let t = if p[1] == q[1] { 0.0 } else { ((y - p[1]) / (q[1] - p[1])).clamp(0.0, 1.0) };
                let crossing = p[0] + t * (q[0] - p[0]);
                low = low.min(crossing).min(if p[1] == q[1] { q[0] } else { crossing });
                high = high.max(crossing).max(if p[1] == q[1] { q[0] } else { crossing });
            }
        }
        for i in clamped(low, high, columns).filter(|i| *i < columns) {
            let x = i as f64;
            let u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / twice_area;
            let v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / twice_area;
            if u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 {
                values[j * columns + i] = (a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])) as f32;
            }
        }
    }
}
