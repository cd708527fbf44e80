//! Waves near structures and over shoals (`coast::elliptic`) against analytic solutions and independent integrations.
//! The validation page shows the same cases.

use seastate::coast::{Bathymetry, Incident, Options, elliptic};
use seastate::lab::validate::coast::plane::wave;
use seastate::lab::validate::coast::{shoals, structures};

/// A vertical pile in water of constant depth (MacCamy and Fuchs 1954): amplitudes within 5 % over the whole figure.
#[test]
fn pile_of_maccamy_and_fuchs() {
    for (period_s, direction_deg) in [(8.0, 0.0), (5.5, 20.0)] {
        let figure = structures::pile(period_s, direction_deg);
        assert!(figure.largest_error() < 0.05, "{:?}", figure.worst());
        assert!(figure.highest() > 1.5);
    }
}

/// A semi-infinite breakwater (Sommerfeld's solution; Penney and Price 1952): diffraction coefficients within 0.03 over
/// the figure.
#[test]
fn breakwater_of_penney_and_price() {
    for direction_deg in [0.0, 30.0, -30.0] {
        let figure = structures::breakwater(direction_deg);
        assert!(figure.largest_error() < 0.03, "{direction_deg} degrees: {:?}", figure.worst());
        assert!(figure.points.len() > 10_000);
    }
}

/// Gaps of about one and two wavelengths: diffraction coefficients within 0.03 over the figure.
#[test]
fn gap_between_breakwaters() {
    for (widths, direction_deg) in [(1.0, 0.0), (2.0, 0.0), (2.0, 30.0)] {
        let (figure, _) = structures::gap(widths, direction_deg);
        assert!(figure.largest_error() < 0.03, "{widths} wavelengths, {direction_deg} degrees: {:?}", figure.worst());
        assert!(figure.points.len() > 10_000 && figure.highest() > 0.5);
    }
}

/// A vertical wall along the shore, with the reflection coefficients 1, 0.5 and 0: nodes and antinodes are
/// 1 - R and 1 + R high.
#[test]
fn walls_reflect_in_part() {
    for r in [1.0, 0.5, 0.0] {
        let [low, high] = structures::nodes(r);
        assert!((high - 1.0 - r).abs() < 0.01 && (low - 1.0 + r).abs() < 0.06, "R {r}: {low} to {high}");
    }
}

/// Waves over the elliptic shoal of Berkhoff, Booij and Radder 1982: the parabolic solution has an index of agreement
/// (Willmott 1981) of at least 0.95 in each of the eight measured sections with the elliptic one on a grid twice as
/// fine.
#[test]
fn elliptic_shoal_of_berkhoff_booij_and_radder() {
    let sections = shoals::elliptic_shoal();
    assert_eq!(sections.len(), 8);
    for section in &sections {
        assert!(section.agreement() > 0.95, "section {}: {}", section.number, section.agreement());
        let measured = [1, 2].map(|solution| section.agreement_with_measured(solution));
        eprintln!("section {}: {:.3}, measured {measured:.3?}", section.number, section.agreement());
    }
    // The shoal focuses: the waves behind it are more than twice as high.
    let highest = sections.iter().flat_map(|s| &s.points).map(|p| p[2]).fold(0.0, f64::max);
    assert!(highest > 2.0, "{highest}");
}

/// A slope between two depths (Booij 1983): reflection and transmission against a fourth-order Runge-Kutta integration
/// of the one-dimensional mild-slope equation, for slopes of 1:3 (steep, with a reflection that can be seen) and 1:10.
#[test]
fn slope_of_booij_reflects_and_transmits() {
    for width_m in [1.2, 4.0] {
        let case = shoals::slope(width_m);
        assert!((case.solved[0] - case.expected[0]).abs() < 0.01, "{case:?}");
        assert!((case.solved[1] / case.expected[1] - 1.0).abs() < 0.01, "{case:?}");
    }
}

/// An island on a paraboloidal shoal (the geometry of Homma 1950): amplitudes within 5 % of the highest.
#[test]
fn island_of_homma() {
    let figure = shoals::island();
    assert!(figure.largest_error() < 0.05 * figure.highest(), "{:?}, highest {}", figure.worst(), figure.highest());
}

/// The load of a page: 500 components on 128 x 128 points. Prints the time; run it alone with
/// `cargo test --release --test coast_structures -- --ignored --nocapture load`.
#[test]
#[ignore = "measures time; run it alone"]
fn load_of_500_components() {
    let bathymetry = Bathymetry::from_fn(128, 128, 10.0, |x, y| {
        let wall = (x - 700.0).abs() < 12.0 && y > 500.0;
        if wall { -3.0 } else { 12.0 - 0.0085 * x - 1.5 * (y / 170.0).sin() }
    });
    let component = |n: i32| Incident {
        omega_rad_s: 0.45 + 0.001 * f64::from(n),
        direction_rad: 0.6 * f64::from(n).sin(),
        ..wave(10.0, 0.0)
    };
    let waves: Vec<Incident> = (0..500).map(component).collect();
    let start = web_time();
    let (_, dissipation) = seastate::coast::parabolic::solve(&bathymetry, &waves, &Options::default());
    eprintln!("parabolic: {:.2} s", start.elapsed().as_secs_f64());
    let start = web_time();
    let walls = elliptic::reflection_by_slope(&bathymetry, 2.0, 150.0);
    let field = elliptic::solve(&bathymetry, &waves, &dissipation, &walls, &Options::default());
    eprintln!("elliptic: {:.2} s", start.elapsed().as_secs_f64());
    assert!(field.components.iter().all(|c| c.envelope.iter().flatten().all(|v| v.is_finite())));
}

fn web_time() -> std::time::Instant {
    #[allow(clippy::disallowed_methods, reason = "a test on the desktop")]
    std::time::Instant::now()
}
