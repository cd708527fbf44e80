use super::*;
use crate::coast::incident::{Incident, spectrum_bins};
use crate::coast::open_sea::{Arrival, MAX_OPEN_ANGLE_RAD, Solver, edge_depth_m};
use crate::coast::placed::{PlacedCoast, PlacingOptions};
use crate::coast::transfer::{TransferLimits, TransferSolver};
use crate::coast::{BuiltInCoast, Losses, Options, parabolic};
use crate::state::query;

const LIMITS: TransferLimits = TransferLimits {
    max_waves: 200,
    max_bytes: 64 << 20,
    max_groups: 64,
    points: 80,
    points_with_structures: 80,
    losses: Losses { breaker_ratio: 0.73, breaker_strength: 1.0, friction_m2_s3: 0.038 },
    threads: 2,
};

fn plan(state: &str) -> Plan {
    Plan::new(&query::parse(state).0)
}

fn statistics(plan: &Plan, coast: &PlacedCoast, limits: &TransferLimits) -> TransferStatistics {
    let transfer = Arc::new(TransferSolver::new(plan, coast, limits).finish());
    StatisticsSolver::new(transfer, plan).expect("the same lattice").finish()
}

fn flat() -> PlacedCoast {
    PlacedCoast {
        title: "flat".into(),
        built_in: None,
        about: "A flat bed.".into(),
        bathymetry: Bathymetry::from_fn(61, 61, 12.0, |_, _| 20.0),
        structures: Vec::new(),
        toward_deg: 50.0,
        middle_m: [123.0, -45.0],
        notices: Vec::new(),
    }
}

/// Over a flat bed the sea is the open sea at every point: its height, its direction and its spectrum.
#[test]
fn over_a_flat_bed_the_sea_is_the_open_sea() {
    let sea = plan("depth=20&hs=2&tp=10&dir=250&n=64&spread=donelan-banner");
    let limits = TransferLimits { points: 61, losses: Losses::NONE, ..LIMITS };
    let found = statistics(&sea, &flat(), &limits);
    assert!((found.open_hs_m() / 2.0 - 1.0).abs() < 0.02, "{}", found.open_hs_m());
    assert!((0.3..0.95).contains(&found.held_share()), "{}", found.held_share());
    // Waves that travel towards 70 degrees, in a frame of which x points towards 50.
    let direction = 20.0_f64.to_radians();
    for (hs_m, angle) in found.maps.hs_m.iter().zip(&found.maps.direction_rad) {
        assert!((f64::from(*hs_m) / found.open_hs_m() - 1.0).abs() < 0.01, "{hs_m}");
        assert!((f64::from(*angle) - direction).abs() < 0.06, "{angle}");
    }
    assert!(found.maps.peak_period_s.iter().all(|tp| (tp / 10.0 - 1.0).abs() < 0.06));
    assert!(found.maps.breaking_fraction.iter().all(|q| *q == 0.0));
    for band in found.spectrum(40, 30) {
        assert!((band.here_m2 - band.open_m2).abs() < 0.03 * band.open_m2 + 1e-6, "{band:?}");
    }
}

/// The sea that a transfer draws beside that of `seastate coast`, which solves all bins of the spectrum: in water of at
/// least 2.5 m, inside the zone of the blend.
#[derive(Debug)]
struct Comparison {
    /// Share of the open sea's variance in the waves of the transfer.
    held_share: f64,
    /// Mean of the ratio of the heights, and its standard deviation.
    ratio: [f64; 2],
    /// Rms difference of the directions, degrees.
    angle_deg: f64,
    /// Largest difference of the breaking fractions.
    breaking: f64,
}

/// Compares the sea `waves`, which comes at 20 degrees from straight shoreward, on a built-in coast.
fn compared(name: &str, waves: &str, limits: &TransferLimits) -> Comparison {
    let coast = PlacedCoast::built_in(BuiltInCoast::find(name).expect("a coast"), &PlacingOptions::default());
    let coast = coast.expect("a place");
    let from = (coast.toward_deg + 200.0) % 360.0;
    let depth_m = edge_depth_m(&coast);
    let sea = plan(&format!("depth={depth_m:.1}&dir={from}&{waves}"));
    let found = statistics(&sea, &coast, limits);
    let placed = PlacedCoast { bathymetry: found.bathymetry.clone(), ..coast };
    let arrival = Arrival::new(&sea, &placed, Solver::Parabolic);
    let bins = spectrum_bins(&sea, placed.turn_rad(), 16, 35, MAX_OPEN_ANGLE_RAD);
    let bins: Vec<Incident> = bins.iter().filter_map(|bin| arrival.arriving(bin)).collect();
    let (field, dissipation) = parabolic::solve(&placed.bathymetry, &bins, &Options::default());
    let want = SeaMaps::new(&placed.bathymetry, &field, &dissipation, sea.sea.gravity_m_s2);
    let (mut count, mut ratio, mut squares, mut angles, mut breaking) = (0.0, 0.0, 0.0, 0.0, 0.0_f64);
    for (index, point) in found.transfer().points.iter().enumerate() {
        if point.depth_m < 2.5 || point.weight < 1.0 || want.hs_m[index] < 0.3 {
            continue;
        }
        let of = f64::from(found.maps.hs_m[index] / want.hs_m[index]);
        let turn = f64::from(found.maps.direction_rad[index] - want.direction_rad[index]);
        (count, ratio, squares) = (count + 1.0, ratio + of, squares + of * of);
        angles += turn.sin().powi(2);
        breaking = breaking.max(f64::from((found.maps.breaking_fraction[index] - want.breaking_fraction[index]).abs()));
    }
    assert!(count > 300.0, "{count} points");
    let mean = ratio / count;
    Comparison {
        held_share: found.held_share(),
        ratio: [mean, (squares / count - mean * mean).max(0.0).sqrt()],
        angle_deg: (angles / count).sqrt().to_degrees(),
        breaking,
    }
}

/// A swell, of which the transfer holds the greater part. Its height is that of all waves; the command line leaves out the
/// few that come at more than 75 degrees.
#[test]
fn the_drawn_swell_is_that_of_the_command_line() {
    for name in ["beach", "headland", "bar"] {
        let found = compared(name, "hs=1.2&tp=13&swell=0.8&n=128", &TransferLimits { max_waves: 400, ..LIMITS });
        eprintln!("{name}: {found:?}");
        let [mean, spread] = found.ratio;
        assert!(found.held_share > 0.65, "{name}: {found:?}");
        assert!((mean - 1.0).abs() < 0.03 && spread < 0.05, "{name}: {found:?}");
        assert!(found.angle_deg < 3.0 && found.breaking < 0.1, "{name}: {found:?}");
    }
}

/// Usual seas, of which the transfer holds about half. The rest does not turn towards the shore, and the map counts waves
/// that run away from the land.
#[test]
#[ignore = "prints differences: cargo test --release --lib usual_seas -- --ignored --nocapture"]
fn usual_seas_and_the_command_line() {
    for name in ["beach", "headland", "bar", "island", "shoal"] {
        eprintln!("{name}: {:?}", compared(name, "hs=1.5&tp=9&n=256", &TransferLimits::default()));
    }
}

/// The spectrum at a point has the variance of the map there, also where the waves of the open sea are blended in.
#[test]
fn a_spectrum_has_the_variance_of_the_map() {
    let coast = PlacedCoast::built_in(BuiltInCoast::find("bar").expect("a coast"), &PlacingOptions::default());
    let coast = coast.expect("a place");
    let sea = plan("depth=11.4&hs=1.2&tp=8&dir=250&n=64");
    let found = statistics(&sea, &coast, &TransferLimits { max_waves: 60, points: 48, ..LIMITS });
    let (mut blended, mut inside) = (0, 0);
    for (i, j) in (0..48).step_by(3).flat_map(|i| (0..48).step_by(5).map(move |j| (i, j))) {
        let index = j * 48 + i;
        let sum: f64 = found.spectrum(i, j).iter().map(|band| band.here_m2).sum();
        let hs_m = f64::from(found.maps.hs_m[index]);
        assert!((4.0 * sum.max(0.0).sqrt() - hs_m).abs() < 1e-3 * hs_m + 1e-6, "{i} {j}: {sum} {hs_m}");
        let point = &found.transfer().points[index];
        blended += usize::from(point.weight > 0.0 && point.weight < 1.0);
        inside += usize::from(point.weight == 1.0 && point.depth_m > 0.0);
    }
    assert!(blended > 10 && inside > 30, "{blended} {inside}");
    assert!(StatisticsSolver::new(found.transfer().clone(), &plan("depth=11.4&hs=1.2&tp=8&seed=9&n=64")).is_none());
}

/// The waves of a transfer are the strongest of many random ones, so that over many seeds they have more variance than the
/// spectrum gives them: the expected variance counts this.
#[test]
fn the_strongest_waves_have_the_expected_variance() {
    let limits = TransferLimits { max_waves: 40, points: 61, losses: Losses::NONE, ..LIMITS };
    let (mut plain, mut expected, mut drawn) = (0.0, 0.0, 0.0);
    for seed in 0..12 {
        let sea = plan(&format!("depth=20&hs=2&tp=10&dir=250&n=64&spread=donelan-banner&seed={seed}"));
        let transfer = Arc::new(TransferSolver::new(&sea, &flat(), &limits).finish());
        let found = OpenSea::new(transfer.clone(), &sea).expect("the same lattice");
        let (cascade, half) = (&sea.cascades[0], 0.5);
        let table = SpectrumTable::new(&sea, cascade);
        for [ix, iz] in transfer.waves.iter().map(|wave| wave.lattice_index) {
            let [re, im] = initial_amplitude(&sea, cascade, &table, ix, iz);
            plain += 4.0 * table.variance(ix, iz);
            drawn += (2.0 * re).mul_add(2.0 * re, 4.0 * im * im) * half;
        }
        expected += found.waves.iter().map(|wave| wave.variance_m2).sum::<f64>();
    }
    eprintln!("plain {plain:.3}, expected {expected:.3}, drawn {drawn:.3} m^2");
    // 480 waves: the standard error of their variance beyond the threshold is below 5 %.
    assert!((expected / drawn - 1.0).abs() < 0.1, "{expected} {drawn}");
    assert!(plain < 0.8 * drawn, "without the selection {plain} of {drawn}");
}

/// The time of the preparation, of the longest step and of all steps.
#[test]
#[ignore = "measures time: cargo test --release --lib load_of_the_statistics -- --ignored --nocapture"]
fn load_of_the_statistics() {
    let now = || {
        #[allow(clippy::disallowed_methods, reason = "a test on the desktop")]
        std::time::Instant::now()
    };
    for name in ["beach", "harbour"] {
        let coast = PlacedCoast::built_in(BuiltInCoast::find(name).expect("a coast"), &PlacingOptions::default());
        let coast = coast.expect("a place");
        let from = (coast.toward_deg + 180.0) % 360.0;
        let sea = plan(&format!("depth={:.1}&hs=1.5&tp=9&dir={from}", edge_depth_m(&coast)));
        let limits = TransferLimits { max_waves: 100, ..TransferLimits::default() };
        let transfer = Arc::new(TransferSolver::new(&sea, &coast, &limits).finish());
        let begun = now();
        let mut solver = StatisticsSolver::new(transfer.clone(), &sea).expect("the same lattice");
        let (prepared, mut longest_s) = (begun.elapsed(), 0.0_f64);
        let stepping = now();
        loop {
            let step = now();
            let done = solver.step();
            longest_s = longest_s.max(step.elapsed().as_secs_f64());
            if done >= 1.0 {
                break;
            }
        }
        let values = (transfer.waves.len() * transfer.points.len()) as f64;
        let per_value_ns = 1e9 * stepping.elapsed().as_secs_f64() / values;
        let finishing = now();
        drop(solver.finish());
        eprintln!(
            "{name}: prepared in {prepared:.1?}, a step takes at most {:.2} ms, {per_value_ns:.0} ns a value, the end {:.1?}",
            1e3 * longest_s,
            finishing.elapsed()
        );
    }
}
