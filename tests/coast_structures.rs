//! Waves near structures (`coast::elliptic`) against analytic solutions.

#[path = "coast/theory.rs"]
mod theory;

use seastate::coast::{Bathymetry, Dissipation, Field, Incident, Losses, Options, elliptic};
use std::f64::consts::TAU;
use theory::wave_number;

const GRAVITY: f64 = 9.81;

fn options() -> Options {
    Options { losses: Losses::NONE, ..Options::default() }
}

fn wave(period_s: f64, direction_deg: f64) -> Incident {
    Incident {
        amplitude_m: 1.0,
        phase_rad: 0.0,
        omega_rad_s: TAU / period_s,
        direction_rad: direction_deg.to_radians(),
    }
}

/// Solves a coast whose walls all reflect as `reflection` says.
fn solve(bathymetry: &Bathymetry, waves: &[Incident], reflection: f32) -> Field {
    let walls = vec![reflection; bathymetry.depth_m.len()];
    elliptic::solve(bathymetry, waves, &Dissipation::none(bathymetry), &walls, &options())
}

#[test]
fn flat_bed_is_the_open_sea() {
    let bathymetry = Bathymetry::from_fn(60, 50, 8.0, |_, _| 12.0);
    let waves = [(6.0, 0.0), (8.0, -40.0), (9.0, 70.0), (15.0, 25.0)].map(|(t, d)| wave(t, d));
    let field = solve(&bathymetry, &waves, 1.0);
    for (c, wave) in waves.iter().enumerate() {
        let k = wave_number(wave.omega_rad_s, 12.0, GRAVITY);
        let (sin, cos) = wave.direction_rad.sin_cos();
        for (i, j) in [(0, 0), (59, 0), (59, 49), (30, 31), (20, 40)] {
            let phase = k * 8.0 * (cos * i as f64 + sin * j as f64);
            let at = field.amplitude(c, i, j);
            let error = (at.re - phase.cos()).hypot(at.im - phase.sin());
            assert!(error < 1e-3, "wave {c} at ({i}, {j}): error {error}");
        }
    }
}

/// A vertical pile in water of constant depth (MacCamy and Fuchs 1954): amplitudes within 5 % over the whole figure.
#[test]
fn pile_of_maccamy_and_fuchs() {
    let (cell_m, centre, radius_m) = (1.25, [75.0, 62.0], 20.0);
    let pile = |x: f64, y: f64| if (x - centre[0]).hypot(y - centre[1]) < radius_m { -3.0 } else { 10.0 };
    let bathymetry = Bathymetry::from_fn(121, 100, cell_m, pile);
    for (period_s, direction_deg) in [(8.0, 0.0), (5.5, 20.0)] {
        let incident = wave(period_s, direction_deg);
        let field = solve(&bathymetry, &[incident], 1.0);
        let k = wave_number(incident.omega_rad_s, 10.0, GRAVITY);
        let (mut worst, mut highest, mut sum, mut count) = (0.0_f64, 0.0_f64, 0.0, 0.0);
        for j in 0..100 {
            for i in 0..121 {
                let (x, y) = (i as f64 * cell_m - centre[0], j as f64 * cell_m - centre[1]);
                let r = x.hypot(y);
                if r > radius_m + cell_m {
                    let expected = theory::pile(k * r, k * radius_m, y.atan2(x) - incident.direction_rad);
                    let error = (field.amplitude(0, i, j).modulus() - expected).abs();
                    (worst, highest) = (worst.max(error), highest.max(expected));
                    (sum, count) = (sum + error * error, count + 1.0);
                }
            }
        }
        println!("T {period_s} s: worst {worst:.4}, rms {:.4}, highest {highest:.3}", (sum / count as f64).sqrt());
        assert!(worst < 0.05, "worst error {worst}");
        assert!(highest > 1.5);
    }
}

/// A semi-infinite breakwater (Sommerfeld's solution; Penney and Price 1952): diffraction coefficients within 0.03 over
/// the figure. The thin wall stands along y at x = 0 and begins at y = 0.
#[test]
fn breakwater_of_penney_and_price() {
    let (cell_m, wall, tip) = (2.0, 50, 60);
    let at_wall = |x: f64, y: f64| (x / cell_m - f64::from(wall)).abs() < 0.5 && y / cell_m > f64::from(tip) - 0.25;
    let bathymetry = Bathymetry::from_fn(141, 121, cell_m, |x, y| if at_wall(x, y) { -3.0 } else { 10.0 });
    for direction_deg in [0.0, 30.0, -30.0] {
        let incident = wave(6.0, direction_deg);
        let field = solve(&bathymetry, &[incident], 1.0);
        let k = wave_number(incident.omega_rad_s, 10.0, GRAVITY);
        let (mut worst, mut place) = (0.0_f64, (0, 0));
        for j in 0..121 {
            for i in wall as usize + 3..141 {
                let (x, y) = (cell_m * (i as f64 - f64::from(wall)), cell_m * (j as f64 - f64::from(tip) + 0.5));
                let expected = theory::breakwater(k, x, y, incident.direction_rad);
                let error = (field.amplitude(0, i, j).modulus() - expected).abs();
                if error > worst {
                    (worst, place) = (error, (i, j));
                }
            }
        }
        println!("{direction_deg} degrees: worst {worst:.4} at {place:?}");
        assert!(worst < 0.03, "worst error {worst} at {place:?}");
    }
}

/// A vertical wall along the shore, with the reflection coefficients 1, 0.5 and 0: nodes and antinodes are
/// 1 - R and 1 + R high.
#[test]
fn walls_reflect_in_part() {
    for r in [1.0, 0.5, 0.0] {
        let bathymetry = Bathymetry::from_fn(70, 30, 3.0, |x, _| if x > 170.0 { -2.0 } else { 9.0 });
        let field = solve(&bathymetry, &[wave(7.0, 0.0)], r as f32);
        let heights: Vec<f64> = (0..57).map(|i| field.amplitude(0, i, 15).modulus()).collect();
        let (low, high) = (heights.iter().copied().fold(9.0, f64::min), heights.iter().copied().fold(0.0, f64::max));
        assert!((high - 1.0 - r).abs() < 0.01 && (low - 1.0 + r).abs() < 0.06, "R {r}: {low} to {high}");
    }
}
