use super::evaluate::CoastalWaves;
use super::*;
use crate::coast::placed::{PlacedCoast, PlacingOptions};
use crate::coast::{Bathymetry, BuiltInCoast};
use crate::state::query;
use crate::waves::Plan;
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use std::f64::consts::TAU;
use std::sync::Arc;

fn plan(state: &str) -> Plan {
    let (params, notices) = query::parse(state);
    assert!(notices.is_empty(), "{notices:?}");
    Plan::new(&params)
}

fn flat(depth_m: f64, toward_deg: f64, columns: usize, cell_m: f64) -> PlacedCoast {
    PlacedCoast {
        title: "flat".into(),
        built_in: None,
        about: "A flat bed.".into(),
        bathymetry: Bathymetry::from_fn(columns, columns, cell_m, |_, _| depth_m),
        structures: Vec::new(),
        toward_deg,
        middle_m: [123.0, -45.0],
        notices: Vec::new(),
    }
}

fn solved(plan: &Plan, coast: &PlacedCoast, limits: &TransferLimits) -> Transfer {
    let mut solver = TransferSolver::new(plan, coast, limits);
    let mut before = 0.0;
    loop {
        let done = solver.step();
        assert!((before..=1.0).contains(&done), "progress {before} then {done}");
        before = done;
        if done >= 1.0 {
            return solver.finish();
        }
    }
}

/// Elevation, slopes and displacements of the same waves in the open sea, by their sum.
fn open_sea(plan: &Plan, transfer: &Transfer, at: [f64; 2], t_s: f64) -> [f64; 5] {
    let cascade = &plan.cascades[0];
    let table = SpectrumTable::new(plan, cascade);
    let mut out = [0.0; 5];
    for wave in &transfer.waves {
        let [ix, iz] = wave.lattice_index;
        let [re, im] = initial_amplitude(plan, cascade, &table, ix, iz);
        let k = wave.lattice_index.map(|i| f64::from(i) * cascade.dk());
        let phase = k[0] * at[0] + k[1] * at[1] - wave.omega_rad_s * t_s;
        let (sin, cos) = phase.sin_cos();
        let orbit = table.waves[entry_index(ix, iz)].orbit_width_over_height / k[0].hypot(k[1]);
        let (eta, along) = (2.0 * (re * cos - im * sin), -2.0 * (re * sin + im * cos));
        let terms = [eta, k[0] * along, k[1] * along, orbit * k[0] * along, orbit * k[1] * along];
        out.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
    }
    out
}

/// Over a flat bed the waves of the transfer are those of the open sea: elevations differ by half floats and by the
/// interpolation alone.
#[test]
fn over_a_flat_bed_the_transfer_is_the_open_sea() {
    let plan = plan("depth=20&hs=2&tp=10&dir=250&n=64&spread=donelan-banner");
    let coast = flat(20.0, 50.0, 121, 4.0);
    let limits = TransferLimits { points: 121, max_waves: 250, losses: Losses::NONE, ..TransferLimits::default() };
    let transfer = Arc::new(solved(&plan, &coast, &limits));
    assert!(transfer.waves.len() == 250 && transfer.groups.len() <= 64, "{}", transfer.waves.len());
    let waves = CoastalWaves::new(transfer.clone(), &plan).expect("the same lattice");
    let (mut worst, mut squares) = ([0.0_f64; 5], [0.0; 5]);
    let mut samples = 0.0;
    for step in 0..300_u32 {
        let [x, y] = [0.618_034, 0.754_878].map(|r| 480.0 * (r * f64::from(step)).fract());
        let (at, t_s) = (transfer.world_m([x, y]), 7000.0 + 3.1 * f64::from(step));
        let sums = waves.sums(at, plan.period_fraction_u32(t_s));
        let want = open_sea(&plan, &transfer, at, t_s);
        let got = [sums.elevation_m, sums.slope[0], sums.slope[1], sums.displacement_m[0], sums.displacement_m[1]];
        for i in 0..5 {
            worst[i] = worst[i].max((got[i] - want[i]).abs());
            squares[i] += want[i] * want[i];
        }
        samples += 1.0;
        // The waves at the point, one by one, add up to the same elevation and velocity.
        let turns = f64::from(plan.period_fraction_u32(t_s));
        let mut alone = [0.0; 4];
        for wave in waves.at_point(at) {
            let angle = TAU * (f64::from(wave.cycles_per_period) * turns / 4_294_967_296.0).fract();
            let of_time = |[re, im]: [f64; 2]| re * angle.cos() + im * angle.sin();
            let rate = |[re, im]: [f64; 2]| wave.omega_rad_s * (im * angle.cos() - re * angle.sin());
            let [gx, gz] = wave.gradient.map(|[re, im]| of_time([im, -re]) * 9.81 / wave.omega_rad_s);
            let terms = [of_time(wave.amplitude_m), gx, rate(wave.amplitude_m), gz];
            alone.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
        let [u, w, v] = sums.orbital_velocity_m_s;
        for (a, b) in alone.into_iter().zip([sums.elevation_m, u, w, v]) {
            assert!((a - b).abs() < 2e-3, "{alone:?} {sums:?}");
        }
        let gains = transfer.gains(at);
        assert!((gains.short_gain - 1.0).abs() < 0.01 && gains.set_up_m.abs() < 0.02, "{gains:?}");
    }
    let relative: Vec<f64> = (0..5).map(|i| worst[i] / (squares[i] / samples).sqrt()).collect();
    // The first derivatives of linear envelopes are constant in a cell: their errors are larger.
    assert!(relative[0] < 1e-3, "{relative:?}");
    assert!(relative.iter().all(|error| *error < 0.02), "{relative:?}");
    // The waves take the greater part of the energy of their lattice that travels shoreward.
    let table = SpectrumTable::new(&plan, &plan.cascades[0]);
    let all: f64 = lattice_indices(64).map(|(ix, iz)| 4.0 * table.variance(ix, iz)).sum();
    assert!(squares[0] / samples > 0.5 * all, "{} of {all}", squares[0] / samples);
}

#[test]
fn a_transfer_of_another_sea_is_refused() {
    let sea = plan("depth=20&hs=2&tp=10&dir=250&n=64");
    let limits = TransferLimits { points: 16, max_waves: 4, ..TransferLimits::default() };
    let transfer = Arc::new(solved(&sea, &flat(20.0, 50.0, 41, 20.0), &limits));
    assert!(CoastalWaves::new(transfer.clone(), &sea).is_some());
    assert!(CoastalWaves::new(transfer.clone(), &plan("depth=20&hs=2&tp=10&dir=250&n=64&seed=2")).is_none());
    assert!(CoastalWaves::new(transfer, &plan("depth=20&hs=2&tp=4&dir=250&n=64")).is_none());
}

/// A plane beach: in open water the packed waves have the height that the solver gives them, and near the shore the
/// level varies as the swash of Stockdon et al. 2006.
#[test]
fn the_beach_has_surf_and_swash() {
    let sea = plan("depth=12&hs=1.5&tp=9&dir=250&n=128&seed=3");
    let placed = |name: &str| {
        PlacedCoast::built_in(BuiltInCoast::find(name).expect("a coast"), &PlacingOptions::default()).expect("a place")
    };
    let coast = placed("beach");
    let limits = TransferLimits { max_waves: 60, points: 96, ..TransferLimits::default() };
    let transfer = solved(&sea, &coast, &limits);
    let setup = setup::Setup::new(&sea, &coast, &limits);
    let run_up = setup.run_up.expect("a shore");
    let (bins, options) = (&setup.bins, &setup.options);
    let (_, dissipation) = crate::coast::parabolic::solve(&setup.grid, bins, options);
    let march = crate::coast::parabolic::LoneMarch::new(&setup.grid, dissipation, options);
    let fields: Vec<_> = setup.waves.iter().map(|wave| march.march(&wave.incident)).collect();
    let points = transfer.columns * transfer.rows;
    let variance = |point: usize| -> f64 {
        let of_wave = |(index, wave): (usize, &setup::Wave)| {
            let t = half_float::unpack(transfer.envelopes[index * points + point]);
            0.5 * wave.open_amplitude_m.powi(2) * t.norm_squared()
        };
        setup.waves.iter().enumerate().map(of_wave).sum()
    };
    let (mut deep, mut swash) = (0, 0);
    for point in (0..points).step_by(7) {
        let depth_m = setup.grid.depth_m[point];
        let got = variance(point);
        let solver: f64 = fields
            .iter()
            .map(|field| field.envelope[point].iter().map(|part| f64::from(*part).powi(2)).sum::<f64>() * 0.5)
            .sum();
        if depth_m > 4.0 {
            assert!(
                (got / solver).sqrt() - 1.0 < 0.01 && (got / solver).sqrt() > 0.99,
                "depth {depth_m}: {got} {solver}"
            );
            deep += 1;
        } else if (-0.5..0.2).contains(&depth_m) {
            let sigma_m = run_up.swash_m / 4.0;
            assert!((got.sqrt() / sigma_m - 1.0).abs() < 0.1, "depth {depth_m}: {} of {sigma_m}", got.sqrt());
            let level_m = f64::from(transfer.points[point].set_up_m);
            assert!((0.9..1.1).contains(&(level_m / run_up.set_up_m)), "{level_m} {run_up:?}");
            swash += 1;
        }
        let p = &transfer.points[point];
        assert!((0.0..=1.3).contains(&p.short_gain) && (depth_m > 0.0 || p.short_gain == 0.0), "{p:?}");
        assert!((0.0..=1.0).contains(&p.weight) && p.breaking_height_m > 0.0);
    }
    assert!(deep > 300 && swash > 5, "{deep} {swash}");
    // The same sea gives the same transfer, whatever the number of threads.
    let alone = solved(&sea, &coast, &TransferLimits { threads: 1, ..limits });
    assert_eq!(alone, transfer);
}

/// The water that runs up the beach is joined to the sea: in at least 98 % of the rows and times, no water deeper than
/// 2 cm lies on the sand behind its edge, seen from the sea. Its edge is higher than the run-up R2 of Stockdon et al.
/// 2006 for about 2 % of the time: on such a beach R2 is 1.1 times the sum of the mean level and two standard
/// deviations, and a normal level is higher than 2.05 deviations for 2 % of the time.
#[test]
fn the_swash_is_joined_to_the_sea() {
    let sea = plan("depth=12&wind=4&fetch=15&dir=255&scale2=1&hs2=2.2&tp2=10&dir2=245");
    let beach = BuiltInCoast::find("beach").expect("a beach");
    let coast = PlacedCoast::built_in(beach, &PlacingOptions::default()).expect("a place");
    let limits = TransferLimits { max_waves: 120, ..TransferLimits::default() };
    let run_up = setup::Setup::new(&sea, &coast, &limits).run_up.expect("a shore");
    let transfer = Arc::new(solved(&sea, &coast, &limits));
    let waves = CoastalWaves::new(transfer.clone(), &sea).expect("the same lattice");
    let width_m = transfer.columns as f64 * transfer.cell_m;
    let (mut edges_m, mut cut_off) = (Vec::new(), 0);
    for step in 0..12 {
        let time = sea.period_fraction_u32(1000.0 + 7.3 * f64::from(step));
        for row in (12..transfer.rows - 12).step_by(8) {
            let y_m = row as f64 * transfer.cell_m;
            // From the waterline of the still water inland: height of the ground, and depth of the water on it.
            let (mut is_dry, mut edge_m) = (false, 0.0);
            let on_land = (0..width_m as u32)
                .map(|i| transfer.world_m([f64::from(i), y_m]))
                .map(|at| (at, transfer.gains(at)))
                .skip_while(|(_, gains)| gains.depth_m > 0.0)
                .take(60);
            let mut has_cut_off = false;
            for (at, gains) in on_land {
                let level_m = gains.set_up_m + waves.sums(at, time).elevation_m;
                let water_m = level_m + gains.depth_m;
                has_cut_off |= is_dry && water_m > 0.02;
                if !is_dry && water_m > 0.0 {
                    edge_m = -gains.depth_m;
                }
                is_dry |= water_m <= 0.0;
            }
            cut_off += usize::from(has_cut_off);
            edges_m.push(edge_m);
        }
    }
    let pairs = edges_m.len();
    assert!(
        pairs > 150 && cut_off * 50 < pairs,
        "{cut_off} of {pairs} pairs of a row and a time have water that is cut off"
    );
    edges_m.sort_by(f64::total_cmp);
    let highest_m = edges_m[pairs * 98 / 100];
    assert!((0.8..1.2).contains(&(highest_m / run_up.two_percent_m)), "{highest_m} m of {run_up:?}");
}

/// The solver takes water thinner than 0.1 m for land. There, too, the swash breaks as it does beside it, on the side of
/// the sea and up the beach: rollers run to the edge of the water.
#[test]
fn waves_break_in_the_thinnest_water() {
    let sea = plan("depth=8&hs=1.5&tp=9&dir=270&n=64");
    // 1 in 20, with a column of points in 0.05 m of water.
    let depth_m = |x: f64| 0.05 * (161.0 - x);
    let bathymetry = Bathymetry::from_fn(49, 17, 4.0, |x, _| depth_m(x));
    let coast = PlacedCoast { bathymetry, toward_deg: 90.0, ..flat(8.0, 90.0, 2, 4.0) };
    let limits = TransferLimits { max_waves: 12, points: 49, ..TransferLimits::default() };
    let transfer = solved(&sea, &coast, &limits);
    let heights_m = |column: usize| transfer.points[8 * transfer.columns + column].breaking_height_m;
    let (thin, before, land) = (heights_m(40), heights_m(39), heights_m(41));
    assert!((transfer.points[8 * transfer.columns + 40].depth_m - 0.05).abs() < 1e-3);
    assert!(before.is_finite() && (thin / before - 1.0).abs() < 0.2 && (land / thin - 1.0).abs() < 0.2);
    // Out at sea no wave of this height breaks, and none on land that no wave reaches.
    assert!(heights_m(5) > 5.0 * thin && heights_m(48) >= 10.0 * thin, "{} {} {thin}", heights_m(5), heights_m(48));
}

/// All waves of a transfer may be longer than those of a sea of short waves, whose energy is then none of theirs. Such a
/// sea keeps its height in deep water.
#[test]
fn a_sea_of_short_waves_does_not_vanish() {
    let sea = plan("wind=6&fetch=20&depth=11.4&n=64");
    let bar = BuiltInCoast::find("bar").expect("a coast");
    let coast = PlacedCoast::built_in(bar, &PlacingOptions::default()).expect("a coast");
    let transfer = solved(&sea, &coast, &TransferLimits { points: 60, ..TransferLimits::default() });
    let deep: Vec<f32> = transfer.points.iter().filter(|p| p.depth_m > 2.0).map(|p| p.short_gain).collect();
    assert!(deep.len() > 500 && deep.iter().all(|gain| *gain > 0.9), "{deep:?}");
}

#[test]
fn every_built_in_coast_has_a_transfer() {
    for coast in &crate::coast::built_in::BUILT_IN {
        let placed = PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("a place");
        let depth_m = crate::coast::open_sea::edge_depth_m(&placed);
        let from = (placed.toward_deg + 180.0) % 360.0;
        let sea = plan(&format!("depth={depth_m:.1}&hs=1.5&tp=9&dir={from}&n=64"));
        let limits =
            TransferLimits { max_waves: 24, points: 64, points_with_structures: 96, ..TransferLimits::default() };
        let transfer = solved(&sea, &placed, &limits);
        let points = transfer.columns * transfer.rows;
        assert_eq!((transfer.waves.len(), transfer.envelopes.len()), (24, 24 * points), "{}", coast.name);
        assert_eq!(transfer.groups.iter().map(|g| g.wave_count).sum::<usize>(), 24);
        for (index, wave) in transfer.waves.iter().enumerate() {
            let group = &transfer.groups[wave.group as usize];
            assert!((group.first_wave..group.first_wave + group.wave_count).contains(&index));
        }
        // The few waves of this test carry the swash of the whole sea, so that they are several times as high there.
        let square = |index: usize| half_float::unpack(transfer.envelopes[index]).norm_squared();
        let mean = |point: usize| (0..24).map(|wave| square(wave * points + point)).sum::<f64>() / 24.0;
        let highest = (0..points).map(mean).fold(0.0, f64::max).sqrt();
        assert!(highest > 1.0 && highest < 8.0, "{}: {highest}", coast.name);
        let finite = |p: &SeaAtPoint| p.set_up_m.is_finite() && p.set_up_m.abs() < 1.5 && p.short_gain.is_finite();
        assert!(transfer.points.iter().all(finite), "{}", coast.name);
    }
}

/// A sea that runs away from the land has no waves to transform, and its waves fade in the shallowest water.
#[test]
fn a_sea_without_shoreward_waves_has_an_empty_transfer() {
    let sea = plan("depth=12&hs=1&tp=8&dir=90&spread=cos2-positive&n=64");
    let beach = BuiltInCoast::find("beach").expect("a beach");
    let coast = PlacedCoast::built_in(beach, &PlacingOptions::default()).expect("a place");
    let transfer = solved(&sea, &coast, &TransferLimits { points: 40, ..TransferLimits::default() });
    assert!(transfer.waves.is_empty() && transfer.envelopes.is_empty());
    for point in &transfer.points {
        assert!(point.weight == 0.0 && (point.depth_m > 2.0) <= (point.short_gain > 0.99), "{point:?}");
    }
}

/// The time of a whole transfer, with one thread as on the page, and of its longest step.
#[test]
#[ignore = "measures time: cargo test --release --lib load_of_a_transfer -- --ignored --nocapture"]
fn load_of_a_transfer() {
    for coast in &crate::coast::built_in::BUILT_IN {
        let placed = PlacedCoast::built_in(coast, &PlacingOptions::default()).expect("a place");
        let depth_m = crate::coast::open_sea::edge_depth_m(&placed);
        let from = (placed.toward_deg + 180.0) % 360.0;
        let sea = plan(&format!("depth={depth_m:.1}&hs=1.5&tp=9&dir={from}"));
        let limits = TransferLimits { threads: 1, ..TransferLimits::default() };
        let now = || {
            #[allow(clippy::disallowed_methods, reason = "a test on the desktop")]
            std::time::Instant::now()
        };
        let begun = now();
        let mut solver = TransferSolver::new(&sea, &placed, &limits);
        let prepared_s = begun.elapsed().as_secs_f64();
        let (mut longest_s, mut steps) = (0.0_f64, 0);
        loop {
            let step = now();
            let done = solver.step();
            (longest_s, steps) = (longest_s.max(step.elapsed().as_secs_f64()), steps + 1);
            if done >= 1.0 {
                break;
            }
        }
        let transfer = solver.finish();
        let total_s = begun.elapsed().as_secs_f64();
        eprintln!(
            "{}: {} waves, {} groups, {} x {} points of {:.1} m: {total_s:.2} s, prepared in {prepared_s:.3} s, {steps} \
             steps of at most {longest_s:.3} s",
            coast.name,
            transfer.waves.len(),
            transfer.groups.len(),
            transfer.columns,
            transfer.rows,
            transfer.cell_m,
        );
    }
}
