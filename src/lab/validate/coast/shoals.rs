//! Waves over beds that are not straight: an island, a slope between two depths, an elliptic shoal.

use super::GRAVITY_M_S2;
use super::berkhoff::{ARRIVING_MM, SECTIONS};
use super::plane::{wave, without_losses};
use super::structures::{AmplitudeFigure, compare, solve};
use super::theory::{self, wave_number};
use crate::coast::{Bathymetry, Dissipation, Field, Incident, Options, elliptic, parabolic};
use std::f64::consts::TAU;

/// Radius of the island at the waterline and of the shoal around it, and the depth beyond, m.
pub const ISLAND_M: [f64; 3] = [30.0, 90.0, 9.0];
/// Period of the waves at the island, s.
pub const ISLAND_PERIOD_S: f64 = 12.0;

/// Waves around an island on a paraboloidal shoal (the geometry of Homma 1950), from one cell beside it, against angular
/// modes that are each integrated along the radius by Runge-Kutta steps: the mild-slope equation separates in polar
/// coordinates.
pub fn island() -> AmplitudeFigure {
    let [island_m, shoal_m, deep_m] = ISLAND_M;
    let depth = move |r: f64| deep_m * (r / shoal_m).powi(2).min(1.0);
    let (cell_m, centre) = (1.0, [116.0, 111.0]);
    let at = |x: f64, y: f64| (x - centre[0]).hypot(y - centre[1]);
    let island = |x: f64, y: f64| if at(x, y) < island_m { -3.0 } else { depth(at(x, y)) };
    let bathymetry = Bathymetry::from_fn(233, 223, cell_m, island);
    let incident = wave(ISLAND_PERIOD_S, 0.0);
    let field = solve(&bathymetry, incident, 1.0);
    let modes = theory::Island::new(incident.omega_rad_s, island_m, shoal_m, depth, GRAVITY_M_S2);
    let wavelength_m = TAU / wave_number(incident.omega_rad_s, deep_m, GRAVITY_M_S2);
    compare(&field, wavelength_m, centre, |x, y| {
        (x.hypot(y) > island_m + cell_m).then(|| modes.amplitude(x.hypot(y), y.atan2(x)))
    })
}

/// Reflection and transmission of a slope.
#[derive(Clone, Copy, Debug)]
pub struct SlopeCase {
    /// Horizontal length of the slope, m.
    pub width_m: f64,
    /// Amplitude of the reflected and of the transmitted wave by the solver.
    pub solved: [f64; 2],
    /// The same by a Runge-Kutta integration.
    pub expected: [f64; 2],
}

/// Depths before and behind the slope, m.
pub const SLOPE_DEPTHS_M: [f64; 2] = [0.6, 0.2];
/// Period of the waves over the slope, s.
pub const SLOPE_PERIOD_S: f64 = 2.0;

/// A slope between two depths (the geometry of Booij 1983), whose ends are not on grid points.
pub fn slope(width_m: f64) -> SlopeCase {
    let [deep_m, shallow_m] = SLOPE_DEPTHS_M;
    let start = 9.03;
    let depth = move |x: f64| deep_m - (deep_m - shallow_m) * ((x - start) / width_m).clamp(0.0, 1.0);
    let bathymetry = Bathymetry::from_fn(150, 24, 0.15, |x, _| depth(x));
    let incident = wave(SLOPE_PERIOD_S, 0.0);
    let field = solve(&bathymetry, incident, 0.0);
    let (reflected, transmitted) = theory::slope(incident.omega_rad_s, depth, [start, start + width_m], GRAVITY_M_S2);
    // Nodes and antinodes before the slope differ by twice the reflected amplitude.
    let heights = (0..58).map(|i| field.amplitude(0, i, 12).modulus());
    let [low, high] = heights.fold([f64::INFINITY, 0.0_f64], |[low, high], h| [low.min(h), high.max(h)]);
    SlopeCase {
        width_m,
        solved: [0.5 * (high - low), field.amplitude(0, 140, 12).modulus()],
        expected: [reflected, transmitted],
    }
}

/// Reflection of the same slope by the Runge-Kutta integration alone.
pub fn slope_reflection(width_m: f64) -> f64 {
    let [deep_m, shallow_m] = SLOPE_DEPTHS_M;
    let depth = move |x: f64| deep_m - (deep_m - shallow_m) * (x / width_m).clamp(0.0, 1.0);
    theory::slope(TAU / SLOPE_PERIOD_S, depth, [0.0, width_m], GRAVITY_M_S2).0
}

/// Times that the solution with the speed of high waves is repeated.
const HEIGHT_ROUNDS: usize = 12;

/// A measured section of the elliptic shoal. All amplitudes are fractions of that of the arriving waves.
#[derive(Clone, Debug)]
pub struct ShoalSection {
    /// Its number, 1 to 8.
    pub number: usize,
    /// Place along the section, m; amplitude by the parabolic and by the fine elliptic solution, and by the parabolic one
    /// with the speed of high waves.
    pub points: Vec<[f64; 4]>,
    /// Place along the section, m, and measured amplitude.
    pub measured: Vec<[f64; 2]>,
}

impl ShoalSection {
    /// Index of agreement of both solutions.
    pub fn agreement(&self) -> f64 {
        agreement(self.points.iter().map(|p| [p[1], p[2]]))
    }

    /// Index of agreement of a solution (1 parabolic, 2 elliptic, 3 parabolic with the speed of high waves) with the
    /// measurements.
    pub fn agreement_with_measured(&self, solution: usize) -> f64 {
        agreement(self.measured.iter().filter_map(|[place, amplitude]| {
            let point = self.points.iter().find(|p| (p[0] - place).abs() < 1e-6)?;
            Some([point[solution], *amplitude])
        }))
    }
}

/// Index of agreement (Willmott 1981) of pairs of a predicted and a true value, 1 for equal ones.
fn agreement(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let pairs: Vec<[f64; 2]> = pairs.collect();
    let mean = pairs.iter().map(|p| p[1]).sum::<f64>() / pairs.len() as f64;
    let apart: f64 = pairs.iter().map(|p| (p[0] - p[1]).powi(2)).sum();
    let spread: f64 = pairs.iter().map(|p| ((p[0] - mean).abs() + (p[1] - mean).abs()).powi(2)).sum();
    1.0 - apart / spread
}

/// Depth in the basin of Berkhoff, Booij and Radder 1982, m, x and y from the middle of the shoal. Waves of 1 s travel
/// towards +x. The slope of 1:50 is turned by 20 degrees.
fn berkhoff_depth_m(x: f64, y: f64) -> f64 {
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let (along, across) = (cos * x - sin * y, sin * x + cos * y);
    let slope = 0.45 - 0.02 * (5.82 + along).max(0.0);
    let inside = (along / 3.0).powi(2) + (across / 4.0).powi(2);
    let rise =
        if inside < 1.0 { 0.5 * (1.0 - (along / 3.75).powi(2) - (across / 5.0).powi(2)).sqrt() - 0.3 } else { 0.0 };
    (slope - rise).max(0.07)
}

/// Depth in which a wave of the linear theory is as long as a wave of the amplitude `amplitude_m` (m) in water of `depth_m`
/// (m), by the dispersion relation of Kirby and Dalrymple 1986: omega^2 = g k (1 + f1 e^2 D) tanh(k h + f2 e) with
/// e = k a, f1 = tanh^5(k h), f2 = (k h / sinh(k h))^4 and D of Stokes' third order.
fn depth_of_same_length_m(omega: f64, depth_m: f64, amplitude_m: f64) -> f64 {
    let square = |k: f64| {
        let (kh, e) = (k * depth_m, k * amplitude_m);
        let d = ((4.0 * kh).cosh() + 8.0 - 2.0 * kh.tanh().powi(2)) / (8.0 * kh.sinh().powi(4));
        let (f1, f2) = (kh.tanh().powi(5), (kh / kh.sinh()).powi(4));
        GRAVITY_M_S2 * k * (1.0 + f1 * e * e * d) * (kh + f2 * e).tanh()
    };
    let (mut low, mut high) = (0.0, 1.01 * wave_number(omega, depth_m, GRAVITY_M_S2));
    for _ in 0..60 {
        let k = 0.5 * (low + high);
        if square(k) < omega * omega { low = k } else { high = k }
    }
    (omega * omega / (GRAVITY_M_S2 * low)).min(1.0 - 1e-9).atanh() / low
}

/// The parabolic solution over a bed with waves of the amplitude `arriving_m` (m), whose speed grows with their height:
/// the solution is repeated over the depths in which waves of the linear theory have that speed.
fn solve_with_height(bathymetry: &Bathymetry, incident: Incident, arriving_m: f64, options: &Options) -> Field {
    let mut depths = bathymetry.clone();
    let mut amplitude_m = vec![arriving_m; depths.depth_m.len()];
    let mut round = 0;
    loop {
        for ((depth, amplitude_m), bed_m) in depths.depth_m.iter_mut().zip(&amplitude_m).zip(&bathymetry.depth_m) {
            *depth = depth_of_same_length_m(incident.omega_rad_s, f64::from(*bed_m), *amplitude_m) as f32;
        }
        let (field, _) = parabolic::solve(&depths, &[incident], options);
        round += 1;
        if round == HEIGHT_ROUNDS {
            return field;
        }
        for (index, amplitude_m) in amplitude_m.iter_mut().enumerate() {
            let solved = arriving_m * field.amplitude(0, index % field.columns, index / field.columns).modulus();
            // The mean with the round before, so that the rounds do not swing.
            *amplitude_m = 0.5 * (*amplitude_m + solved);
        }
    }
}

/// The eight sections of the elliptic shoal of Berkhoff, Booij and Radder 1982: the parabolic solution on points 25 cm
/// apart, and the elliptic one on points 12.5 cm apart.
pub fn elliptic_shoal() -> Vec<ShoalSection> {
    let depth = |x: f64, y: f64| berkhoff_depth_m(x - 10.0, y - 10.0);
    let incident = wave(1.0, 0.0);
    let coarse = Bathymetry::from_fn(89, 81, 0.25, depth);
    let fine = Bathymetry::from_fn(177, 161, 0.125, depth);
    let options = Options { min_depth_m: 0.02, ..without_losses() };
    let (marched, _) = parabolic::solve(&coarse, &[incident], &options);
    let beaches = vec![0.0; fine.depth_m.len()];
    let exact = elliptic::solve(&fine, &[incident], &Dissipation::none(&fine), &beaches, &options);
    let high = solve_with_height(&coarse, incident, 1e-3 * ARRIVING_MM, &options);
    let point = |(x, y): (f64, f64), place: f64| {
        let [i, j] = [x, y].map(|v| ((v + 10.0) / 0.25).round() as usize);
        let at = |field: &Field, i: usize, j: usize| field.amplitude(0, i, j).modulus();
        [place, at(&marched, i, j), at(&exact, 2 * i, 2 * j), at(&high, i, j)]
    };
    // Sections 1 to 5 run across the waves behind the shoal, 6 to 8 along them.
    let across = [1.0, 3.0, 5.0, 7.0, 9.0].map(|x| {
        let places = (-20..=20).map(|n| 0.25 * f64::from(n));
        places.map(|y| point((x, y), y)).collect::<Vec<_>>()
    });
    let along = [-2.0, 0.0, 2.0].map(|y| {
        let places = (0..=44).map(|n| 0.25 * f64::from(n));
        places.map(|x| point((x, y), x)).collect::<Vec<_>>()
    });
    let section = |(index, points): (usize, Vec<[f64; 4]>)| {
        let measured = SECTIONS[index].iter().map(|[place, mm]| [*place, mm / ARRIVING_MM]).collect();
        ShoalSection { number: index + 1, points, measured }
    };
    across.into_iter().chain(along).enumerate().map(section).collect()
}
