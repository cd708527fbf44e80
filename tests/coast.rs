//! Waves marched ashore (`coast::parabolic`) against linear theory and against a direct integration of the energy
//! balance of breaking waves. The validation page shows the same cases.

use seastate::lab::validate::coast::plane;

/// Over a flat bed the field is the plane wave of the open sea, in every direction and for short and long waves.
#[test]
fn flat_bed_is_the_open_sea() {
    for case in plane::flat_bed() {
        assert!(case.parabolic < 1e-3 && case.elliptic < 1e-3, "{case:?}");
    }
}

/// A plane beach from 10 m of depth, 1 in 100: waves of 10 s that come at 30 degrees (and others) keep to Snell's law
/// and to the conservation of the energy flux (Green's law) up to where they break.
#[test]
fn plane_beach_follows_snell_and_green() {
    for (period_s, direction_deg) in [(10.0, 30.0), (10.0, 0.0), (6.0, -50.0), (14.0, 60.0)] {
        let beach = plane::plane_beach(&plane::BEACH, period_s, direction_deg);
        for point in beach.rows.iter().flatten() {
            assert!((point.height / point.expected_height - 1.0).abs() < 0.01, "{point:?}");
            assert!((point.flux - 1.0).abs() < 0.005, "{point:?}");
            assert!((point.direction_deg - point.expected_direction_deg).abs() < 0.5, "{point:?}");
        }
        let shallowest = beach.rows[1].last().expect("points");
        assert!(shallowest.depth_m < 1.5 && beach.rows[1][0].depth_m == 10.0);
        assert!(beach.phase_error_rad.abs() < 2e-3, "phase differs by {}", beach.phase_error_rad);
    }
    // In SWAN's test A11 waves come from 20 m of depth, and SWAN gives their height where it is 0.2 m.
    let beach = plane::plane_beach(&plane::SWAN_BEACH, 10.0, 30.0);
    let last = beach.rows[1].last().expect("points");
    assert!((last.depth_m - 0.2).abs() < 1e-4, "{last:?}");
    assert!((last.height / plane::SWAN_HS_M - 1.0).abs() < 0.01, "{last:?}");
    assert!((last.direction_deg - last.expected_direction_deg).abs() < 0.5, "{last:?}");
}

/// Hs of a random sea across a plane beach against a Runge-Kutta integration of Battjes and Janssen's balance
/// d(Cg m0)/dx = -f Q Hm^2 / 4 in steps of 2 cm, which solves for Q by bisection.
#[test]
fn surf_follows_the_balance_of_battjes_and_janssen() {
    for (hs_m, period_s, slope) in [(1.0, 8.0, 0.02), (2.0, 10.0, 0.0125), (1.5, 6.0, 0.05)] {
        let points = plane::surf(hs_m, period_s, slope);
        for point in &points {
            assert!((point.hs_m / point.expected_hs_m - 1.0).abs() < 0.05, "{point:?}");
        }
        // The waves do break: a good part of them at the end, where little of the height is left.
        let most = points.iter().map(|p| p.breaking_fraction).fold(0.0, f64::max);
        let lowest = points.iter().map(|p| p.hs_m).fold(f64::INFINITY, f64::min);
        assert!(most > 0.3 && lowest < 0.6 * hs_m, "{most} {lowest}");
    }
}

/// Friction takes the energy of swell over a long flat bed as e^(-x rate / Cg).
#[test]
fn friction_damps_swell() {
    let [gain, expected] = plane::friction_gain();
    assert!(expected < 0.95 && (gain / expected - 1.0).abs() < 1e-3, "{gain} not {expected}");
}
