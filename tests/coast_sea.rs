//! A random sea on a coast: its components from a plan, its maps, and its statistics over many seeds.

use seastate::coast::incident::{Placement, spectrum_bins, strongest_waves};
use seastate::coast::{Bathymetry, Incident, Losses, Options, SeaMaps, parabolic};
use seastate::lab::validate::coast::{random, runup};
use seastate::state::query;
use seastate::waves::Plan;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn plan(state: &str) -> Plan {
    Plan::new(&query::parse(state).0)
}

/// The sum of the bins is the sea, and their mean direction is that of the waves as seen from the coast.
#[test]
fn bins_hold_the_sea() {
    // Waves from the west travel towards +x, which is straight shoreward for a coast that is not turned.
    let plan = plan("wind=12&fetch=200&dir=270&n=128");
    let bins = spectrum_bins(&plan, 0.0, 24, 24, FRAC_PI_2);
    let variance: f64 = bins.iter().map(Incident::variance_m2).sum();
    let captured = variance / plan.spectrum_integrals.m0();
    assert!(captured > 0.93 && captured <= 1.0 + 1e-9, "{captured}");
    let mean: f64 = bins.iter().map(|b| b.variance_m2() * b.direction_rad).sum::<f64>() / variance;
    assert!(mean.abs() < 0.01, "{mean}");
    // A coast turned by 30 degrees towards south sees them come from 30 degrees on the other side.
    let turned = spectrum_bins(&plan, 30.0_f64.to_radians(), 24, 24, FRAC_PI_2);
    let sine: f64 = turned.iter().map(|b| b.variance_m2() * b.direction_rad.sin()).sum();
    let cosine: f64 = turned.iter().map(|b| b.variance_m2() * b.direction_rad.cos()).sum();
    assert!((sine.atan2(cosine).to_degrees() + 29.0).abs() < 2.5, "{}", sine.atan2(cosine).to_degrees());
}

/// The strongest waves are those of the seed: their sum at a point far from the origin follows the placement.
#[test]
fn strongest_waves_follow_the_placement() {
    let plan = plan("wind=12&fetch=200&dir=270&n=64&untile=0&order=1");
    let here = strongest_waves(&plan, Placement::default(), 300, 20.0, PI);
    assert_eq!(here.len(), 300);
    assert!(here.windows(2).all(|pair| pair[0].amplitude_m >= pair[1].amplitude_m));
    let elevation = |waves: &[Incident], x: f64, y: f64| -> f64 {
        let wave = |w: &Incident| {
            let k = plan.dispersion.wave_number(w.omega_rad_s);
            let (sin, cos) = w.direction_rad.sin_cos();
            w.amplitude_m * (k * (cos * x + sin * y) + w.phase_rad).cos()
        };
        waves.iter().map(wave).sum()
    };
    // The point (x, y) of a turned coast is this point of the world.
    let (turn_rad, origin_m) = (0.6_f64, [130.0, -70.0]);
    let there = strongest_waves(&plan, Placement { origin_m, turn_rad }, 300, 20.0, PI);
    for (x, y) in [(0.0, 0.0), (55.0, 20.0), (-30.0, 80.0)] {
        let (sin, cos) = turn_rad.sin_cos();
        let world = [origin_m[0] + cos * x - sin * y, origin_m[1] + sin * x + cos * y];
        let (a, b) = (elevation(&there, x, y), elevation(&here, world[0], world[1]));
        // The frequencies are rounded to multiples of one over the period of the sea, and with them the wave numbers
        // here.
        assert!((a - b).abs() < 0.01, "{a} and {b}");
    }
}

/// Maps of a directional sea over a plane beach: what comes ashore is what the spectrum of the open sea holds, it turns
/// towards the shore, and it breaks there.
#[test]
fn maps_of_a_beach() {
    let plan = plan("wind=14&fetch=200&dir=240&n=128&depth=15");
    let bathymetry = Bathymetry::from_fn(64, 32, 12.0, |x, _| 15.0 - 0.0195 * x);
    let bins = spectrum_bins(&plan, 0.0, 12, 18, 1.3);
    let options = Options::default();
    let (field, dissipation) = parabolic::solve(&bathymetry, &bins, &options);
    let maps = SeaMaps::new(&bathymetry, &field, &dissipation, options.gravity_m_s2);
    let variance: f64 = bins.iter().map(Incident::variance_m2).sum();
    let at = |i: usize| 16 * 64 + i;
    assert!((f64::from(maps.hs_m[at(0)]) / (4.0 * variance.sqrt()) - 1.0).abs() < 0.02);
    assert!(maps.direction_rad[at(60)].abs() < 0.5 * maps.direction_rad[at(0)].abs());
    // Waves from west-south-west travel towards north, which is -y.
    assert!(maps.direction_rad[at(0)] < -0.3);
    assert!(maps.breaking_fraction[at(60)] > 0.1 && maps.breaking_fraction[at(0)] < 0.01);
    let period = f64::from(maps.peak_period_s[at(0)]);
    assert!((period / (TAU / plan.omega_p) - 1.0).abs() < 0.12, "{period}");
}

/// Hs at gauges from records of random seas over a shoal: over 64 seeds its mean square is the sum over the components
/// within two standard errors.
#[test]
fn hs_at_gauges_is_the_sum_of_the_components() {
    let shoal = |x: f64, y: f64| 8.0 - 5.0 * (-((x - 200.0).powi(2) + (y - 160.0).powi(2)) / 6000.0).exp();
    let bathymetry = Bathymetry::from_fn(48, 33, 10.0, shoal);
    let options = Options { losses: Losses::NONE, ..Options::default() };
    let components = 60;
    let sea = |seed: u32| -> Vec<Incident> {
        let wave = |n: u32| Incident {
            amplitude_m: 0.1,
            phase_rad: TAU * hash(seed * components + n),
            omega_rad_s: 0.6 + 0.01 * f64::from(n),
            direction_rad: 0.5 * (f64::from(n * 37 % components) / f64::from(components) - 0.5),
        };
        (0..components).map(wave).collect()
    };
    let gauges = [(2, 3), (20, 16), (30, 16), (44, 10), (40, 30)];
    // The equation is linear: phases turn the solution of one seed.
    let (field, _) = parabolic::solve(&bathymetry, &sea(0), &options);
    let expected = gauges
        .map(|(i, j)| (0..components as usize).map(|c| 0.5 * field.amplitude(c, i, j).norm_squared()).sum::<f64>());
    let mut records = [[0.0; 64]; 5];
    for seed in 0..64 {
        let mut field = field.clone();
        for (component, wave) in field.components.iter_mut().zip(sea(seed)) {
            let turn = wave.phase_rad - component.incident.phase_rad;
            for value in &mut component.envelope {
                let [re, im] = value.map(f64::from);
                let (sin, cos) = turn.sin_cos();
                *value = [(re * cos - im * sin) as f32, (re * sin + im * cos) as f32];
            }
        }
        for (gauge, (i, j)) in gauges.into_iter().enumerate() {
            let square = |step: u32| field.elevation_m(i, j, 3.1 * f64::from(step)).powi(2);
            records[gauge][seed as usize] = (0..32).map(square).sum::<f64>() / 32.0;
        }
    }
    for (record, expected) in records.iter().zip(expected) {
        let mean = record.iter().sum::<f64>() / 64.0;
        let deviation = (record.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 63.0).sqrt();
        assert!((mean - expected).abs() < 2.0 * deviation / 8.0, "{mean} not {expected}, one deviation {deviation}");
        assert!(deviation / 8.0 < 0.1 * mean);
    }
}

/// A number from 0 to 1 that looks random (the mixer of MurmurHash3).
fn hash(n: u32) -> f64 {
    let mut h = n.wrapping_mul(0x9e37_79b9);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    f64::from(h ^ (h >> 16)) / f64::from(u32::MAX)
}

/// A random sea over the six built-in coasts: Hs at 20 gauges each over 64 seeds is that of the component sum, and the
/// solved waves are enough for the kurtosis and the groups of the open sea.
#[test]
fn records_over_the_built_in_coasts() {
    let open = random::open_sea().expect("a sea");
    assert!(open.deviation().abs() < 2.0, "{open:?}");
    let coasts = random::all_coasts().expect("six coasts");
    assert_eq!(coasts.len(), 6);
    let mut beyond = 0;
    for coast in &coasts {
        assert_eq!(coast.gauges.len(), random::GAUGES, "{}", coast.title);
        assert!(coast.share > 0.6, "{}: {}", coast.title, coast.share);
        for g in &coast.gauges {
            eprintln!(
                "{} h {:.1} hs {:.2} dev {:.2} k {:.3} g {:.3} s {:.3}",
                coast.title,
                g.depth_m,
                g.hs_m().0,
                g.deviation(),
                g.kurtosis.value,
                g.groupiness.value,
                g.succession.value
            );
        }
        for gauge in &coast.gauges {
            beyond += usize::from(gauge.deviation().abs() > 2.0);
            assert!(gauge.deviation().abs() < 4.5, "{}: {gauge:?}", coast.title);
            assert!(gauge.kurtosis.value > open.kurtosis.value - 0.1, "{}: {gauge:?}", coast.title);
            assert!(gauge.groupiness.value > open.groupiness.value - 0.1, "{}: {gauge:?}", coast.title);
            assert!(gauge.succession.value > open.succession.value - 0.1, "{}: {gauge:?}", coast.title);
        }
    }
    // One in twenty of the 120 gauges is expected beyond two standard errors; neighbours share their waves.
    assert!(beyond <= 12, "{beyond}");
}

/// Run-up on plane beaches as the command prints it is within 10 % of the formula of Stockdon et al. 2006.
#[test]
fn run_up_over_the_range_of_the_formula() {
    for case in runup::cases().expect("beaches") {
        assert!((case.run_up_m / case.expected_m - 1.0).abs() < 0.1, "{case:?}");
    }
}
