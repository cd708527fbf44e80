//! Waves at structures in water of constant depth, solved with the elliptic equation: a breakwater, a gap, a pile.

use super::GRAVITY_M_S2;
use super::gap::Gap;
use super::plane::{wave, without_losses};
use super::theory::{self, wave_number};
use crate::coast::{Bathymetry, Dissipation, Field, Incident, elliptic};

/// Depth of the water, m.
const DEPTH_M: f64 = 10.0;
/// Period of the waves at the breakwater and the gap, s.
pub const WALL_PERIOD_S: f64 = 6.0;
/// Radius of the pile, m.
pub const PILE_RADIUS_M: f64 = 20.0;
/// Width of the gap in wavelengths.
pub const GAP_WIDTHS: [f64; 2] = [1.0, 2.0];
/// Distance of the points of the grids with walls, m.
pub const WALL_CELL_M: f64 = 1.25;
/// Column of the wall, and number of columns.
const WALL_COLUMNS: [usize; 2] = [60, 169];
/// Distance behind a wall from which on the figures are compared, m.
pub const LEE_M: f64 = 8.5;

/// The amplitude at one point of a figure, as a fraction of that of the arriving wave.
#[derive(Clone, Copy, Debug)]
pub struct AmplitudePoint {
    /// Place relative to the middle of the structure (or its head), along the axes of the coast, m.
    pub at_m: [f64; 2],
    /// By the solver.
    pub solved: f64,
    /// By theory.
    pub expected: f64,
}

/// Amplitudes over a whole figure.
#[derive(Clone, Debug)]
pub struct AmplitudeFigure {
    /// The points: one row along x after the other.
    pub points: Vec<AmplitudePoint>,
    /// Wavelength, m.
    pub wavelength_m: f64,
}

impl AmplitudeFigure {
    /// The point with the largest difference from theory.
    pub fn worst(&self) -> AmplitudePoint {
        let error = |p: &AmplitudePoint| (p.solved - p.expected).abs();
        let none = AmplitudePoint { at_m: [0.0; 2], solved: f64::NAN, expected: f64::NAN };
        self.points.iter().copied().max_by(|a, b| error(a).total_cmp(&error(b))).unwrap_or(none)
    }

    /// Largest difference from theory.
    pub fn largest_error(&self) -> f64 {
        let worst = self.worst();
        (worst.solved - worst.expected).abs()
    }

    /// Root of the mean square difference from theory.
    pub fn rms_error(&self) -> f64 {
        let sum: f64 = self.points.iter().map(|p| (p.solved - p.expected).powi(2)).sum();
        (sum / self.points.len() as f64).sqrt()
    }

    /// Largest amplitude by theory.
    pub fn highest(&self) -> f64 {
        self.points.iter().map(|p| p.expected).fold(0.0, f64::max)
    }

    /// The points along the line on which `across` gives nearly `at` (m): x or y of the line (the other coordinate than
    /// `across`), solved and expected amplitude.
    pub fn line(&self, across: usize, at: f64) -> Vec<[f64; 3]> {
        let distance = |p: &AmplitudePoint| (p.at_m[across] - at).abs();
        let nearest = self.points.iter().map(distance).fold(f64::INFINITY, f64::min);
        let on_line = self.points.iter().filter(|p| distance(p) < nearest + 1e-6);
        // Two lines may be equally near; the one on the positive side counts.
        let side = on_line.clone().map(|p| p.at_m[across]).fold(f64::NEG_INFINITY, f64::max);
        on_line
            .filter(|p| (p.at_m[across] - side).abs() < 1e-6)
            .map(|p| [p.at_m[1 - across], p.solved, p.expected])
            .collect()
    }
}

/// Solves a wave at structures that all reflect as `reflection` says.
pub fn solve(bathymetry: &Bathymetry, incident: Incident, reflection: f32) -> Field {
    let walls = vec![reflection; bathymetry.depth_m.len()];
    elliptic::solve(bathymetry, &[incident], &Dissipation::none(bathymetry), &walls, &without_losses())
}

/// Compares the solution with `expected` at the points of the grid for which it gives an amplitude. `origin_m` is the
/// place on the grid from which `expected` counts x and y.
pub fn compare(
    field: &Field,
    wavelength_m: f64,
    origin_m: [f64; 2],
    expected: impl Fn(f64, f64) -> Option<f64>,
) -> AmplitudeFigure {
    let point = |index: usize| {
        let (i, j) = (index % field.columns, index / field.columns);
        let at_m = [i as f64 * field.cell_m - origin_m[0], j as f64 * field.cell_m - origin_m[1]];
        let expected = expected(at_m[0], at_m[1])?;
        Some(AmplitudePoint { at_m, solved: field.amplitude(0, i, j).modulus(), expected })
    };
    AmplitudeFigure { points: (0..field.columns * field.rows).filter_map(point).collect(), wavelength_m }
}

/// Wave number of the waves at the walls, rad/m.
fn wall_wave_number() -> f64 {
    wave_number(wave(WALL_PERIOD_S, 0.0).omega_rad_s, DEPTH_M, GRAVITY_M_S2)
}

/// The lee of a thin wall along x = 0, y > 0 (Sommerfeld 1896; Penney and Price 1952), from [`LEE_M`] behind it, for waves
/// that travel at `direction_deg` (degrees).
pub fn breakwater(direction_deg: f64) -> AmplitudeFigure {
    let ([wall, columns], head) = (WALL_COLUMNS, 72);
    let at_wall =
        |x: f64, y: f64| (x / WALL_CELL_M - wall as f64).abs() < 0.5 && y / WALL_CELL_M > f64::from(head) - 0.25;
    let depth = |x: f64, y: f64| if at_wall(x, y) { -3.0 } else { DEPTH_M };
    let bathymetry = Bathymetry::from_fn(columns, 145, WALL_CELL_M, depth);
    let incident = wave(WALL_PERIOD_S, direction_deg);
    let field = solve(&bathymetry, incident, 1.0);
    let k = wall_wave_number();
    // The wall ends halfway between the last point of water and the first of land.
    let origin_m = [wall as f64 * WALL_CELL_M, (f64::from(head) - 0.5) * WALL_CELL_M];
    compare(&field, std::f64::consts::TAU / k, origin_m, |x, y| {
        (x > LEE_M).then(|| theory::breakwater(k, x, y, incident.direction_rad))
    })
}

/// The lee of a thin wall along x = 0 with a gap around y = 0, from [`LEE_M`] behind it. The gap is about `widths` wavelengths
/// wide; returns its width in wavelengths, too.
pub fn gap(widths: f64, direction_deg: f64) -> (AmplitudeFigure, f64) {
    let k = wall_wave_number();
    let wavelength_m = std::f64::consts::TAU / k;
    // An odd number of points of water lies around the middle row.
    let ([wall, columns], rows, middle) = (WALL_COLUMNS, 193, 96.0);
    let half = (0.5 * widths * wavelength_m / WALL_CELL_M - 0.5).round();
    let width_m = (2.0 * half + 1.0) * WALL_CELL_M;
    let at_wall =
        |x: f64, y: f64| (x / WALL_CELL_M - wall as f64).abs() < 0.5 && (y / WALL_CELL_M - middle).abs() > half + 0.25;
    let depth = |x: f64, y: f64| if at_wall(x, y) { -3.0 } else { DEPTH_M };
    let bathymetry = Bathymetry::from_fn(columns, rows, WALL_CELL_M, depth);
    let incident = wave(WALL_PERIOD_S, direction_deg);
    let field = solve(&bathymetry, incident, 1.0);
    let exact = Gap::new(k, width_m, incident.direction_rad);
    let origin_m = [wall as f64 * WALL_CELL_M, middle * WALL_CELL_M];
    (compare(&field, wavelength_m, origin_m, |x, y| (x > LEE_M).then(|| exact.amplitude(x, y))), width_m / wavelength_m)
}

/// Waves around a vertical pile of the radius [`PILE_RADIUS_M`] (MacCamy and Fuchs 1954), from one cell beside it.
pub fn pile(period_s: f64, direction_deg: f64) -> AmplitudeFigure {
    let (cell_m, centre) = (0.8, [70.0, 47.0]);
    let at = |x: f64, y: f64| if (x - centre[0]).hypot(y - centre[1]) < PILE_RADIUS_M { -3.0 } else { DEPTH_M };
    let bathymetry = Bathymetry::from_fn(145, 120, cell_m, at);
    let incident = wave(period_s, direction_deg);
    let field = solve(&bathymetry, incident, 1.0);
    let k = wave_number(incident.omega_rad_s, DEPTH_M, GRAVITY_M_S2);
    compare(&field, std::f64::consts::TAU / k, centre, |x, y| {
        let r = x.hypot(y);
        let angle = y.atan2(x) - incident.direction_rad;
        (r > PILE_RADIUS_M + cell_m).then(|| theory::pile(k * r, k * PILE_RADIUS_M, angle))
    })
}

/// Heights of the nodes and antinodes before a vertical wall with the reflection coefficient `reflection`, which are
/// 1 - R and 1 + R high.
pub fn nodes(reflection: f64) -> [f64; 2] {
    let bathymetry = Bathymetry::from_fn(70, 30, 3.0, |x, _| if x > 170.0 { -2.0 } else { 9.0 });
    let field = solve(&bathymetry, wave(7.0, 0.0), reflection as f32);
    let heights = (0..57).map(|i| field.amplitude(0, i, 15).modulus());
    heights.fold([f64::INFINITY, 0.0], |[low, high], height| [low.min(height), high.max(height)])
}
