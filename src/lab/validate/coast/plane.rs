//! Waves over straight contours: a flat bed, a plane beach, friction, and the surf zone.

use super::GRAVITY_M_S2;
use super::theory::{self, group_velocity, wave_number};
use crate::coast::{Bathymetry, Dissipation, Field, Incident, Losses, Options, elliptic, parabolic};
use std::f64::consts::{PI, TAU};

/// A plane beach.
#[derive(Clone, Copy, Debug)]
pub struct Beach {
    /// Depth at the seaward edge of the grid, m.
    pub depth_m: f64,
    /// Slope, height over length.
    pub slope: f64,
    /// Depth down to which waves are compared, m.
    pub end_m: f64,
    /// Distance of the points, m.
    pub cell_m: f64,
}

/// A beach from 10 m of depth to where waves of 1 m would break.
pub const BEACH: Beach = Beach { depth_m: 10.0, slope: 0.01, end_m: 1.4, cell_m: 7.5 };
/// The beach of the test A11 (refraction) of SWAN's suite: 20 m of depth over 4 km.
pub const SWAN_BEACH: Beach = Beach { depth_m: 20.0, slope: 0.005, end_m: 0.19, cell_m: 10.0 };
/// Significant wave height in 0.2 m of depth, m, that SWAN 41.10 gives on [`SWAN_BEACH`] for waves of 1 m and 10 s that
/// come from 30 degrees, without losses: the largest value of the table that comes with the test.
pub const SWAN_HS_M: f64 = 2.402;

/// A wave of amplitude 1 m that travels at `direction_deg` (degrees) from straight shoreward.
pub fn wave(period_s: f64, direction_deg: f64) -> Incident {
    Incident {
        amplitude_m: 1.0,
        phase_rad: 0.7,
        omega_rad_s: TAU / period_s,
        direction_rad: direction_deg.to_radians(),
    }
}

/// Options of a solution without losses.
pub fn without_losses() -> Options {
    Options { losses: Losses::NONE, gravity_m_s2: GRAVITY_M_S2, ..Options::default() }
}

/// A plane wave over a flat bed as a solver gives it.
#[derive(Clone, Copy, Debug)]
pub struct FlatBedError {
    /// Period, s.
    pub period_s: f64,
    /// Direction from straight shoreward, degrees.
    pub direction_deg: f64,
    /// Largest difference from the plane wave over the grid, as a fraction of its amplitude: of the parabolic and of the
    /// elliptic solution.
    pub parabolic: f64,
    /// The same for the elliptic solution.
    pub elliptic: f64,
}

/// Solves plane waves over 12 m of water, 96 x 64 points of 8 m, with both solvers.
pub fn flat_bed() -> Vec<FlatBedError> {
    let bathymetry = Bathymetry::from_fn(96, 64, 8.0, |_, _| 12.0);
    let cases = [(4.0, 0.0), (6.0, -40.0), (9.0, 70.0), (15.0, 25.0)];
    let waves = cases.map(|(period_s, direction_deg)| wave(period_s, direction_deg));
    let (marched, _) = parabolic::solve(&bathymetry, &waves, &without_losses());
    let walls = vec![1.0; bathymetry.depth_m.len()];
    let none = Dissipation::none(&bathymetry);
    let whole = elliptic::solve(&bathymetry, &waves, &none, &walls, &without_losses());
    let largest = |field: &Field, c: usize| {
        let k = wave_number(waves[c].omega_rad_s, 12.0, GRAVITY_M_S2);
        let (sin, cos) = waves[c].direction_rad.sin_cos();
        let error = |point: usize| {
            let (i, j) = (point % field.columns, point / field.columns);
            let phase = k * field.cell_m * (cos * i as f64 + sin * j as f64) + waves[c].phase_rad;
            let at = field.amplitude(c, i, j);
            (at.re - phase.cos()).hypot(at.im - phase.sin())
        };
        (0..field.columns * field.rows).map(error).fold(0.0, f64::max)
    };
    let case = |(c, (period_s, direction_deg)): (usize, (f64, f64))| FlatBedError {
        period_s,
        direction_deg,
        parabolic: largest(&marched, c),
        elliptic: largest(&whole, c),
    };
    cases.into_iter().enumerate().map(case).collect()
}

/// A wave at a point of the plane beach, beside the laws of Snell and Green.
#[derive(Clone, Copy, Debug)]
pub struct BeachPoint {
    /// Depth, m.
    pub depth_m: f64,
    /// Height over that at the edge of the grid.
    pub height: f64,
    /// The same by the conservation of the energy flux.
    pub expected_height: f64,
    /// Direction of travel, degrees from straight shoreward.
    pub direction_deg: f64,
    /// The same by Snell's law.
    pub expected_direction_deg: f64,
    /// Energy flux shoreward over that at the edge of the grid.
    pub flux: f64,
}

/// A wave over the plane beach.
#[derive(Clone, Debug)]
pub struct PlaneBeach {
    /// The points of three rows of the grid, seaward ones first.
    pub rows: [Vec<BeachPoint>; 3],
    /// Difference of the phase in shallow water from an integration of the wave number, rad.
    pub phase_error_rad: f64,
}

/// Solves a wave over a plane beach with the parabolic equation.
pub fn plane_beach(beach: &Beach, period_s: f64, direction_deg: f64) -> PlaneBeach {
    let (rows, depth_at) = (40, |x: f64| beach.depth_m - beach.slope * x);
    // A few columns more than are compared.
    let columns = ((beach.depth_m - 0.7 * beach.end_m) / beach.slope / beach.cell_m) as usize;
    let bathymetry = Bathymetry::from_fn(columns, rows, beach.cell_m, |x, _| depth_at(x));
    let incident = wave(period_s, direction_deg);
    let (field, _) = parabolic::solve(&bathymetry, &[incident], &without_losses());
    let omega = incident.omega_rad_s;
    let ky = wave_number(omega, beach.depth_m, GRAVITY_M_S2) * incident.direction_rad.sin();
    let flux_of = |height: f64, depth_m: f64| {
        let cos = (1.0 - (ky / wave_number(omega, depth_m, GRAVITY_M_S2)).powi(2)).sqrt();
        height * height * group_velocity(omega, depth_m, GRAVITY_M_S2) * cos
    };
    let open_flux = flux_of(1.0, beach.depth_m);
    let point = |i: usize, j: usize| {
        let depth_m = bathymetry.at(i, j);
        let height = field.amplitude(0, i, j).modulus();
        BeachPoint {
            depth_m,
            height,
            expected_height: (open_flux / flux_of(1.0, depth_m)).sqrt(),
            direction_deg: direction_deg_of(&field, i, j),
            expected_direction_deg: (ky / wave_number(omega, depth_m, GRAVITY_M_S2)).asin().to_degrees(),
            flux: flux_of(height, depth_m) / open_flux,
        }
    };
    let compared: Vec<usize> = (0..columns).filter(|i| depth_at(beach.cell_m * *i as f64) > beach.end_m).collect();
    let row = |j: usize| compared.iter().map(|i| point(*i, j)).collect();
    let end = compared.len() - 1;
    PlaneBeach { rows: [0, 13, rows - 1].map(row), phase_error_rad: phase_error_rad(&field, end, ky, depth_at) }
}

/// Direction in which the first component travels at a point, degrees, from differences of its phase.
fn direction_deg_of(field: &Field, i: usize, j: usize) -> f64 {
    let [x, y] = field.amplitude_gradient(0, i, j);
    let at = field.amplitude(0, i, j).conj();
    (at * y).im.atan2((at * x).im).to_degrees()
}

/// Difference of the phase at the column `end` of the first row from an integration of kx in ten thousand steps, rad.
fn phase_error_rad(field: &Field, end: usize, ky: f64, depth_at: impl Fn(f64) -> f64) -> f64 {
    let incident = field.components[0].incident;
    let steps = 10_000;
    let dx = end as f64 * field.cell_m / f64::from(steps);
    let kx = |x: f64| (wave_number(incident.omega_rad_s, depth_at(x), GRAVITY_M_S2).powi(2) - ky * ky).sqrt();
    let phase: f64 = (0..steps).map(|step| dx * kx((f64::from(step) + 0.5) * dx)).sum::<f64>() + incident.phase_rad;
    let difference = field.amplitude(0, end, 0).argument() - phase;
    (difference + PI).rem_euclid(TAU) - PI
}

/// Amplitude of swell of 12 s after 6 km over a flat bed in 8 m of water with friction, as a fraction of that before: of
/// the parabolic solution, and e^(-x rate / (2 Cg)).
pub fn friction_gain() -> [f64; 2] {
    let bathymetry = Bathymetry::from_fn(120, 8, 50.0, |_, _| 8.0);
    let losses = Losses { breaker_ratio: 0.0, ..Losses::default() };
    let swell = wave(12.0, 0.0);
    let (field, _) = parabolic::solve(&bathymetry, &[swell], &Options { losses, ..without_losses() });
    let omega = swell.omega_rad_s;
    let k = wave_number(omega, 8.0, GRAVITY_M_S2);
    let rate = 0.038 * (omega / (GRAVITY_M_S2 * (k * 8.0).sinh())).powi(2);
    let expected = (-0.5 * rate * 119.0 * 50.0 / group_velocity(omega, 8.0, GRAVITY_M_S2)).exp();
    [field.amplitude(0, 119, 4).modulus(), expected]
}

/// A breaking sea at a point of a plane beach.
#[derive(Clone, Copy, Debug)]
pub struct SurfPoint {
    /// Depth, m.
    pub depth_m: f64,
    /// Significant wave height, m.
    pub hs_m: f64,
    /// The same by a direct integration of the energy balance of Battjes and Janssen 1978.
    pub expected_hs_m: f64,
    /// Fraction of the waves that break.
    pub breaking_fraction: f64,
}

/// Marches a sea of a narrow spectrum with the height `hs_m` (m) straight over a plane beach from 10 m to 0.5 m of depth.
/// Forty waves of nearly one frequency stand for the sea.
pub fn surf(hs_m: f64, period_s: f64, slope: f64) -> Vec<SurfPoint> {
    let cell_m = 4.0;
    let columns = (9.5 / slope / cell_m) as usize;
    let bathymetry = Bathymetry::from_fn(columns, 12, cell_m, |x, _| BEACH.depth_m - slope * x);
    let amplitude_m = (hs_m * hs_m / 8.0 / 40.0_f64).sqrt();
    let component = |n: i32| Incident {
        amplitude_m,
        phase_rad: f64::from(n * n),
        omega_rad_s: TAU / period_s * (1.0 + 1e-5 * f64::from(n)),
        direction_rad: 0.0,
    };
    let waves: Vec<Incident> = (0..40).map(component).collect();
    let losses = Losses { friction_m2_s3: 0.0, ..Losses::default() };
    let (field, dissipation) = parabolic::solve(&bathymetry, &waves, &Options { losses, ..without_losses() });
    let expected = theory::battjes_janssen_hs_m(hs_m, TAU / period_s, BEACH.depth_m, slope, GRAVITY_M_S2);
    let point = |i: usize| {
        let variance: f64 = (0..40).map(|c| 0.5 * field.amplitude(c, i, 6).norm_squared()).sum();
        SurfPoint {
            depth_m: bathymetry.at(i, 6),
            hs_m: 4.0 * variance.sqrt(),
            expected_hs_m: expected(i as f64 * cell_m),
            breaking_fraction: dissipation.breaking_fraction[6 * columns + i].into(),
        }
    };
    (0..columns).filter(|i| bathymetry.at(*i, 6) > 0.5).map(point).collect()
}
