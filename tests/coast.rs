//! Waves marched ashore (`coast::parabolic`) against linear theory and against a direct integration of the energy
//! balance of breaking waves.

#[path = "coast/theory.rs"]
mod theory;

use seastate::coast::{Bathymetry, Field, Incident, Losses, Options, parabolic};
use std::f64::consts::{PI, TAU};
use theory::{group_velocity, wave_number};

const GRAVITY: f64 = 9.81;

fn wave(period_s: f64, direction_deg: f64) -> Incident {
    Incident {
        amplitude_m: 0.5,
        phase_rad: 0.7,
        omega_rad_s: TAU / period_s,
        direction_rad: direction_deg.to_radians(),
    }
}

fn without_losses() -> Options {
    Options { losses: Losses::NONE, ..Options::default() }
}

/// Over a flat bed the field is the plane wave of the open sea, in every direction and for short and long waves.
#[test]
fn flat_bed_is_the_open_sea() {
    let bathymetry = Bathymetry::from_fn(96, 64, 8.0, |_, _| 12.0);
    let waves: Vec<Incident> = [(4.0, 0.0), (6.0, -40.0), (9.0, 70.0), (15.0, 25.0)]
        .map(|(period, direction)| wave(period, direction))
        .to_vec();
    let (field, _) = parabolic::solve(&bathymetry, &waves, &without_losses());
    for (c, wave) in waves.iter().enumerate() {
        let k = wave_number(wave.omega_rad_s, 12.0, GRAVITY);
        let (sin, cos) = wave.direction_rad.sin_cos();
        for (i, j) in [(0, 0), (95, 0), (95, 63), (50, 31), (20, 60), (70, 5)] {
            let phase = k * 8.0 * (cos * i as f64 + sin * j as f64) + wave.phase_rad;
            let [re, im] = [0.5 * phase.cos(), 0.5 * phase.sin()];
            let at = field.amplitude(c, i, j);
            let error = (at.re - re).hypot(at.im - im) / 0.5;
            assert!(error < 1e-3, "wave {c} at ({i}, {j}): error {error}");
        }
    }
}

/// A plane beach from 10 m of depth, 1 in 100: waves of 10 s that come at 30 degrees (and others) keep to Snell's law
/// and to the conservation of the energy flux (Green's law) up to where they break.
#[test]
fn plane_beach_follows_snell_and_green() {
    let (columns, rows, cell_m, slope) = (120, 40, 7.5, 0.01);
    let bathymetry = Bathymetry::from_fn(columns, rows, cell_m, |x, _| 10.0 - slope * x);
    for (period_s, direction_deg) in [(10.0, 30.0), (10.0, 0.0), (6.0, -50.0), (14.0, 60.0)] {
        let incident = wave(period_s, direction_deg);
        let (field, _) = parabolic::solve(&bathymetry, &[incident], &without_losses());
        let omega = incident.omega_rad_s;
        let open = wave_number(omega, 10.0, GRAVITY);
        let ky = open * incident.direction_rad.sin();
        let flux_of = |height: f64, depth: f64| {
            let k = wave_number(omega, depth, GRAVITY);
            let cos = (1.0 - (ky / k).powi(2)).sqrt();
            height * height * group_velocity(omega, depth, GRAVITY) * cos
        };
        // Hs of a sea of one component is 4 a / sqrt(2): heights are compared as amplitudes. Waves break at a depth of
        // about 1.4 times their height.
        for i in (0..columns).filter(|i| 10.0 - slope * cell_m * *i as f64 > 1.4) {
            for j in [0, 13, rows - 1] {
                let depth = f64::from(bathymetry.depth_m[j * columns + i]);
                let amplitude = field.amplitude(0, i, j).modulus();
                let expected = (flux_of(0.5, 10.0) / flux_of(1.0, depth)).sqrt();
                assert!((amplitude / expected - 1.0).abs() < 0.01, "({i}, {j}): {amplitude} not {expected}");
                let flux = flux_of(amplitude, depth) / flux_of(0.5, 10.0);
                assert!((flux - 1.0).abs() < 0.005, "({i}, {j}): flux {flux}");
                let snell = (ky / wave_number(omega, depth, GRAVITY)).asin().to_degrees();
                let travel = direction_deg_of(&field, i, j);
                assert!((travel - snell).abs() < 0.5, "({i}, {j}): direction {travel} not {snell}");
            }
        }
        assert_phase_is_the_integral_of_the_wave_number(&field, &bathymetry, ky);
    }
}

/// Direction in which the first component travels at a point, degrees, from differences of its phase.
fn direction_deg_of(field: &Field, i: usize, j: usize) -> f64 {
    let [x, y] = field.amplitude_gradient(0, i, j);
    let at = field.amplitude(0, i, j).conj();
    (at * y).im.atan2((at * x).im).to_degrees()
}

/// Compares the phase along the first row with an integration of kx in ten thousand steps.
fn assert_phase_is_the_integral_of_the_wave_number(field: &Field, bathymetry: &Bathymetry, ky: f64) {
    let omega = field.components[0].incident.omega_rad_s;
    let end = bathymetry.columns - 20;
    let steps = 10_000;
    let dx = end as f64 * bathymetry.cell_m / f64::from(steps);
    let kx = |x: f64| {
        let depth = 10.0 - 0.01 * x;
        (wave_number(omega, depth, GRAVITY).powi(2) - ky * ky).sqrt()
    };
    let phase: f64 = (0..steps).map(|step| dx * kx((f64::from(step) + 0.5) * dx)).sum::<f64>() + 0.7;
    let difference = field.amplitude(0, end, 0).argument() - phase;
    assert!(((difference + PI).rem_euclid(TAU) - PI).abs() < 2e-3, "phase differs by {difference}");
}

/// Hs of a random sea across a plane beach against a Runge-Kutta integration of Battjes and Janssen's balance
/// d(Cg m0)/dx = -f Q Hm^2 / 4 in steps of 2 cm, which solves for Q by bisection.
#[test]
fn surf_follows_the_balance_of_battjes_and_janssen() {
    for (hs_m, period_s, slope) in [(1.0, 8.0, 0.02), (2.0, 10.0, 0.0125), (1.5, 6.0, 0.05)] {
        let cell_m = 4.0;
        let columns = (9.5 / slope / cell_m) as usize;
        let bathymetry = Bathymetry::from_fn(columns, 12, cell_m, |x, _| 10.0 - slope * x);
        // Forty waves of nearly one frequency: the balance is that of a narrow spectrum.
        let amplitude_m = (hs_m * hs_m / 8.0 / 40.0_f64).sqrt();
        let component = |n: i32| Incident {
            amplitude_m,
            phase_rad: f64::from(n * n),
            omega_rad_s: TAU / period_s * (1.0 + 1e-5 * f64::from(n)),
            direction_rad: 0.0,
        };
        let waves: Vec<Incident> = (0..40).map(component).collect();
        let options = Options { losses: Losses { friction_m2_s3: 0.0, ..Losses::default() }, ..Options::default() };
        let (field, dissipation) = parabolic::solve(&bathymetry, &waves, &options);
        let expected = theory::battjes_janssen_hs_m(hs_m, TAU / period_s, 10.0, slope, GRAVITY);
        let (mut most, mut lowest) = (0.0_f64, f64::INFINITY);
        for i in (0..columns).filter(|i| 10.0 - slope * cell_m * *i as f64 > 0.5) {
            let variance: f64 = (0..40).map(|c| 0.5 * field.amplitude(c, i, 6).norm_squared()).sum();
            let (hs, theory) = (4.0 * variance.sqrt(), expected(i as f64 * cell_m));
            assert!((hs / theory - 1.0).abs() < 0.05, "x {}: {hs} m, not {theory} m", i as f64 * cell_m);
            most = most.max(dissipation.breaking_fraction[6 * columns + i].into());
            lowest = lowest.min(hs);
        }
        // The waves do break: a good part of them at the end, where little of the height is left.
        assert!(most > 0.3 && lowest < 0.6 * hs_m, "{most} {lowest}");
    }
}

/// Friction takes the energy of swell over a long flat bed as e^(-x rate / Cg).
#[test]
fn friction_damps_swell() {
    let bathymetry = Bathymetry::from_fn(120, 8, 50.0, |_, _| 8.0);
    let losses = Losses { breaker_ratio: 0.0, ..Losses::default() };
    let (field, _) = parabolic::solve(&bathymetry, &[wave(12.0, 0.0)], &Options { losses, ..Options::default() });
    let omega = TAU / 12.0;
    let k = wave_number(omega, 8.0, GRAVITY);
    let rate = 0.038 * (omega / (GRAVITY * (k * 8.0).sinh())).powi(2);
    let expected = (-0.5 * rate * 119.0 * 50.0 / group_velocity(omega, 8.0, GRAVITY)).exp();
    let gain = field.amplitude(0, 119, 4).modulus() / 0.5;
    assert!(expected < 0.95 && (gain / expected - 1.0).abs() < 1e-3, "{gain} not {expected}");
}
