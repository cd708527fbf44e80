//! The mild-slope equation on the grid by bilinear finite elements.
//!
//! The weak form is the integral of p grad A . grad v - (q + i omega loss) A v, minus that of i k p a A v along edges,
//! with p = C Cg, q = k^2 p, and a = (1 - R) / (1 + R) for the reflection coefficient R. The integration points +-
//! sqrt(2/3) give phase errors of fourth order (Guddati and Yue 2004).

use super::grid::Grid;
use super::nested::Stencil;
use super::reference::{Profile, coefficients};
use crate::coast::complex::Complex;
use crate::coast::options::Options;

/// Place of the integration points in an element from -1 to 1: the square root of 2/3.
const POINT: f64 = 0.816_496_580_927_726;

/// The water that a matrix is made for.
#[derive(Clone, Copy)]
pub(super) enum Water<'a> {
    /// The coast.
    Coast,
    /// Straight contours with the profile of one side.
    Straight(&'a Profile),
}

/// Values of the four basis functions and their derivatives (for a cell of length 2) at an integration point.
#[derive(Clone, Copy)]
struct Shape {
    value: [f64; 4],
    along_x: [f64; 4],
    along_y: [f64; 4],
}

/// The integration point in the quarter of the corner `corner`: 0 to 3 for (low x, low y), (high, low), (low, high),
/// (high, high).
fn shape(corner: usize) -> Shape {
    let sign = |bit: usize, n: usize| if n >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let [x, y] = [0, 1].map(|bit| POINT * sign(bit, corner));
    let part = |f: &dyn Fn(f64, f64) -> f64| [0, 1, 2, 3].map(|n| f(sign(0, n), sign(1, n)));
    Shape {
        value: part(&|sx, sy| 0.25 * (1.0 + sx * x) * (1.0 + sy * y)),
        along_x: part(&|sx, sy| 0.25 * sx * (1.0 + sy * y)),
        along_y: part(&|sx, sy| 0.25 * sy * (1.0 + sx * x)),
    }
}

impl Shape {
    /// The shape in a cell with dry corners. Each of them has the mean value of its wet neighbours in the cell, so that
    /// nothing flows towards it: a wall of single points parts the water on both sides. Wet corners that touch only
    /// diagonally are apart; then the value is that of the corner `own` of the integration point.
    fn beside_dry(mut self, wet: [bool; 4], own: usize) -> Self {
        let is_diagonal = wet == [true, false, false, true] || wet == [false, true, true, false];
        for dry in (0..4).filter(|corner| !wet[*corner]) {
            let near: Vec<usize> =
                if is_diagonal { vec![] } else { [dry ^ 1, dry ^ 2].into_iter().filter(|n| wet[*n]).collect() };
            let near = if near.is_empty() { vec![own] } else { near };
            for values in [&mut self.value, &mut self.along_x, &mut self.along_y] {
                let share = values[dry] / near.len() as f64;
                near.iter().for_each(|n| values[*n] += share);
                values[dry] = 0.0;
            }
        }
        if is_diagonal {
            let other = own ^ 3;
            for values in [&mut self.value, &mut self.along_x, &mut self.along_y] {
                values[own] += values[other];
                values[other] = 0.0;
            }
        }
        self
    }
}

/// Assembles the matrix for waves with the angular frequency `omega_rad_s` in `water`.
pub(super) fn assemble(grid: &Grid, water: Water<'_>, omega_rad_s: f64, k_open: f64, options: &Options) -> Stencil {
    let mut matrix = Stencil::zeros(grid.columns, grid.rows);
    let shapes = [0, 1, 2, 3].map(shape);
    let k_cell = k_open * grid.cell_m;
    let state = |index: usize| match water {
        Water::Coast => (grid.is_wet[index], grid.depth_m[index], grid.loss_per_s[index]),
        Water::Straight(profile) => {
            let column = index % grid.columns;
            (column < profile.wet, profile.depth_m[column], profile.loss_per_s[column])
        }
    };
    for j in 0..grid.rows - 1 {
        for i in 0..grid.columns - 1 {
            let first = j * grid.columns + i;
            let points = [first, first + 1, first + grid.columns, first + grid.columns + 1];
            let corners = points.map(state);
            let all_wet = corners.iter().all(|corner| corner.0);
            for (corner, shape) in shapes.iter().enumerate().filter(|(corner, _)| corners[*corner].0) {
                let (depth_m, loss) = if all_wet {
                    let sum = |f: &dyn Fn(usize) -> f64| (0..4).map(|n| shape.value[n] * f(n)).sum::<f64>();
                    (sum(&|n| corners[n].1), sum(&|n| corners[n].2))
                } else {
                    (corners[corner].1, corners[corner].2)
                };
                // The edge cuts corners between the middles of the cell's sides: one dry corner takes an eighth of the
                // cell, three take seven eighths.
                let share = match corners.iter().filter(|corner| corner.0).count() {
                    3 => 7.0 / 6.0,
                    1 => 0.5,
                    _ => 1.0,
                };
                let beside = (!all_wet).then(|| shape.beside_dry(corners.map(|corner| corner.0), corner));
                let shape = beside.as_ref().unwrap_or(shape);
                let water = coefficients(omega_rad_s, depth_m, loss, options);
                let water = [share * water[0], share * water[1], water[2] * share];
                let offset = |bit: usize| 0.5 + 0.5 * POINT * if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
                let stretch = grid.stretch(i as f64 + offset(0), j as f64 + offset(1), k_cell);
                add_element(&mut matrix, points, shape, water, stretch, omega_rad_s, grid.cell_m);
            }
        }
    }
    add_edges(&mut matrix, grid, water, omega_rad_s, k_cell, options);
    matrix
}

/// Adds the part of one integration point.
fn add_element(
    matrix: &mut Stencil,
    points: [usize; 4],
    shape: &Shape,
    [p, q, loss]: [f64; 3],
    stretch: [f64; 2],
    omega_rad_s: f64,
    cell_m: f64,
) {
    let inside = stretch == [0.0, 0.0];
    let [sx, sy] = stretch.map(|sigma| Complex::new(1.0, sigma));
    let (ratio_x, ratio_y, area) =
        if inside { (Complex::ONE, Complex::ONE, Complex::ONE) } else { (sy * sx.recip(), sx * sy.recip(), sx * sy) };
    // A derivative over a cell of length 2 is 2 / cell that over metres; each point stands for a quarter of the area.
    let (along_x, along_y) = (ratio_x * p, ratio_y * p);
    let mass = Complex::new(q, omega_rad_s * loss) * area * (0.25 * cell_m * cell_m);
    for a in 0..4 {
        for b in a..4 {
            let stiffness =
                along_x * (shape.along_x[a] * shape.along_x[b]) + along_y * (shape.along_y[a] * shape.along_y[b]);
            matrix.add(points[a], points[b], stiffness - mass * (shape.value[a] * shape.value[b]));
        }
    }
}

/// Adds the partly absorbing edges between wet and dry points, and gives dry points a row of their own.
fn add_edges(matrix: &mut Stencil, grid: &Grid, water: Water<'_>, omega_rad_s: f64, k_cell: f64, options: &Options) {
    for j in 0..grid.rows {
        for i in 0..grid.columns {
            let index = j * grid.columns + i;
            let stretch = grid.stretch(i as f64, j as f64, k_cell);
            let [sx, sy] = stretch.map(|sigma| Complex::new(1.0, sigma));
            let absorbed = |r: f64| (1.0 - r) / (1.0 + r);
            let (edge, depth_m) = match water {
                Water::Straight(profile) => {
                    let r = if i + 1 == profile.wet { profile.reflection } else { None };
                    (r.map_or(Complex::ZERO, |r| sy * absorbed(r)), profile.depth_m[i])
                }
                Water::Coast => {
                    if !grid.is_wet[index] {
                        matrix.diagonal[index] = Complex::ONE;
                        continue;
                    }
                    let edge = coast_edges(grid, i, j).map(|r| r.map_or(0.0, absorbed));
                    // Stairs are longer than the oblique edge that they stand for.
                    let oblique = edge[0] > 0.0 && edge[1] > 0.0;
                    let length = if oblique { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 };
                    ((sy * edge[0] + sx * edge[1]) * length, grid.depth_m[index])
                }
            };
            if edge != Complex::ZERO {
                let [p, q, _] = coefficients(omega_rad_s, depth_m, 0.0, options);
                // Half of the edge lies beyond the first and the last row.
                let share = if j == 0 || j + 1 == grid.rows { 0.5 } else { 1.0 };
                matrix.diagonal[index] -= Complex::I * edge * (p * (q / p).sqrt() * grid.cell_m * share);
            }
        }
    }
}

/// Reflection coefficients of the edges of a wet point across x and across y, if its neighbours there are dry. Of two
/// edges the one that reflects less counts.
fn coast_edges(grid: &Grid, i: usize, j: usize) -> [Option<f64>; 2] {
    let dry = |i: usize, j: usize| {
        let index = j * grid.columns + i;
        (!grid.is_wet[index]).then(|| grid.reflection[index])
    };
    let least = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        _ => a.or(b),
    };
    let before = if i > 0 { dry(i - 1, j) } else { None };
    let after = if i + 1 < grid.columns { dry(i + 1, j) } else { (!grid.is_open_behind).then_some(0.0) };
    let below = if j > 0 { dry(i, j - 1) } else { None };
    let above = if j + 1 < grid.rows { dry(i, j + 1) } else { None };
    [least(before, after), least(below, above)]
}

/// The matrix `a` minus `b`.
pub(super) fn difference(a: &Stencil, b: &Stencil) -> Stencil {
    let mut out = a.clone();
    out.diagonal.iter_mut().zip(&b.diagonal).for_each(|(a, b)| *a -= *b);
    for (a, b) in out.forward.iter_mut().zip(&b.forward) {
        a.iter_mut().zip(b).for_each(|(a, b)| *a -= *b);
    }
    out
}
