//! The simulated sea against theory: wave heights, direction, crests, independence of the FFT size, loops and foam.

mod common;

use common::{gpu, maps, params, read};
use seastate::gpu::Gpu;
use seastate::gpu::readback;
use seastate::gpu::timer::Timer;
use seastate::lab::stats;
use seastate::shaders::Shaders;
use seastate::sim::{MAX_FOAM_STEPS, Simulation};
use seastate::state::Params;
use seastate::state::fields::{FIELDS, FieldKind};
use seastate::waves::{Plan, statistics};

/// Compares theory, resolved and measured statistics over 64 seeds, and checks Parseval's theorem for each seed. An FFT
/// size of 128 resolves over 99 % of the variance, in a quarter of the time of the usual size.
fn assert_height(state: &str) -> stats::SeaStatistics {
    let state = &format!("{state}&n=128");
    let report = pollster::block_on(stats::run(&gpu(), &params(state), 64, None)).expect("statistics");
    let (t, r, m) = (&report.theory, &report.resolved, &report.measured);
    let text = format!("{state}\n{report}");
    assert!(r.m0_fraction >= 0.99, "{text}");
    assert!((r.hs_m / t.hs_m - 1.0).abs() < 0.01, "{text}");
    assert!(m.parseval_error < 1e-4, "Parseval {}: {text}", m.parseval_error);
    assert!((m.hs_m.value / t.hs_m - 1.0).abs() < 0.03, "{text}");
    let error = m.hs_m.standard_error.expect("64 seeds have a standard error");
    assert!((m.hs_m.value - r.hs_m).abs() < 3.0 * error, "{text}");
    assert!((m.hs_m.value - t.hs_m).abs() < 3.0 * error, "{text}");
    assert!((m.mss.value / r.mss - 1.0).abs() < 0.02, "{text}");
    assert!(m.mean_elevation_m.value.abs() < 1e-4 * t.hs_m, "{text}");
    let from = m.mean_from_deg.expect("a sea has a direction").value;
    assert!((from - 240.0).abs() < 3.0, "waves come from where the wind does: {text}");
    report
}

#[test]
fn ten_metres_per_second_over_a_hundred_kilometres() {
    let report = assert_height("wind=10&fetch=100");
    assert!((report.theory.hs_m / 2.139 - 1.0).abs() < 0.005);
    assert!((report.theory.tp_s / 6.23 - 1.0).abs() < 0.005);
}

#[test]
fn heights_from_a_light_breeze_to_a_hurricane() {
    for state in ["wind=5&fetch=20", "wind=20&fetch=500", "wind=30&fetch=1000"] {
        assert_height(state);
    }
}

#[test]
fn heights_in_shallow_water() {
    for depth_m in [20, 5] {
        assert_height(&format!("wind=10&fetch=100&spectrum=tma&depth={depth_m}"));
    }
}

#[test]
fn waves_travel_downwind() {
    let gpu = gpu();
    for dir in [0.0, 90.0, 215.0] {
        // A moving pattern has d eta/dt = -speed x slope: fit the speed along the wind to two maps 0.4 s apart.
        let state = format!("wind=10&fetch=100&n=128&spread=donelan-banner&swell=1&dir={dir}");
        let plan = Plan::new(&params(&state));
        let (a, b) = (maps(&gpu, &state, 10.0), maps(&gpu, &state, 10.4));
        let [x, z] = plan.downwind;
        let (mut along, mut slope2) = (0.0, 0.0);
        for (i, d) in a.displacement(0).iter().enumerate() {
            let g = a.gradients(0)[i];
            let slope = x * f64::from(g[0]) + z * f64::from(g[1]);
            along -= f64::from(b.displacement(0)[i][1] - d[1]) / 0.4 * slope;
            slope2 += slope * slope;
        }
        // The phase speed at the peak is 9.7 m/s; shorter waves dominate the slopes and are slower.
        let speed = along / slope2;
        assert!((5.0..11.0).contains(&speed), "dir {dir}: {speed} m/s");
    }
}

#[test]
fn crests_are_sharper_than_troughs() {
    let gpu = gpu();
    let state = "wind=15&fetch=300&n=128";
    let maps = maps(&gpu, state, 20.0);
    let plan = Plan::new(&params(state));
    let sigma = plan.hs_m() / 4.0;
    // Mean Jacobian where the elevation times `sign` exceeds one standard deviation.
    let mean_jacobian = |sign: f64| {
        let texels = maps.displacement(0).iter().zip(maps.gradients(0));
        let beyond = texels.filter(|(d, _)| sign * f64::from(d[1]) > sigma);
        mean(&beyond.map(|(d, g)| f64::from((1.0 + g[2]) * (1.0 + g[3]) - d[3] * d[3])).collect::<Vec<_>>())
    };
    let (crest, trough) = (mean_jacobian(1.0), mean_jacobian(-1.0));
    assert!(crest < 0.95 && trough > 1.05, "squeezed at crests ({crest}), stretched in troughs ({trough})");
}

#[test]
fn raising_n_keeps_every_wave() {
    // Compare the initial amplitudes h0 of the waves that both lattices hold.
    let gpu = gpu();
    let read = |state: &str| {
        let mut sim = common::simulation(&gpu, state);
        let mut encoder = gpu.encoder("test");
        let step = sim.upload_sea_uniform(&gpu, 0.0, false);
        sim.passes.spectrum.run(&mut encoder, &Timer::default(), &sim.resources, step);
        let staging = readback::stage_buffer(&gpu, &mut encoder, &sim.resources.current_waves().h0);
        gpu.submit(encoder);
        let bytes = pollster::block_on(readback::read(&gpu, staging)).expect("read-back");
        bytemuck::pod_collect_to_vec::<u8, [f32; 2]>(&bytes)
    };
    let (small, large) = (read("wind=12&n=64"), read("wind=12&n=128"));
    let mut kept = 0;
    for c in 0..3 {
        for iz in -31i32..32 {
            for ix in -31i32..32 {
                let at = |n: i32, h: &[[f32; 2]]| h[((c * n + iz.rem_euclid(n)) * n + ix.rem_euclid(n)) as usize];
                let (a, b) = (at(64, &small), at(128, &large));
                if a != [0.0; 2] {
                    assert_eq!(a, b, "cascade {c}, wave {ix} {iz}");
                    kept += 1;
                }
            }
        }
    }
    assert!(kept > 5000, "{kept}");
}

/// FFT sizes and choices of cascades.
const GRIDS: &str = "n=128 n=256 n=1024 cascades=3 cascades=4 overlap=1 overlap=1&n=512 \
    cascades=3&patch1=1500&patch2=260&patch3=31 cascades=4&patch1=1500&patch2=260&patch3=31&patch4=6&overlap=1 \
    cascades=2&patch1=1500&patch2=140&high1=0.5&low2=0.3";

#[test]
fn the_sea_does_not_depend_on_how_it_is_cut_into_waves() {
    for sea in ["wind=12", "wind=7&fetch=50&spectrum=tma&depth=6&spread=hasselmann", "wind=10&scale2=1&hs2=1.5&tp2=11"]
    {
        let resolved = |how: &str| {
            let plan = Plan::new(&params(&format!("{sea}&{how}")));
            (statistics::LatticeStatistics::new(&plan, 1.0), plan)
        };
        let (reference, _) = resolved("n=512");
        for how in GRIDS.split(' ') {
            let (r, plan) = resolved(how);
            let text = format!("{sea}&{how}: {r:?} against {reference:?}, {:?}", plan.notices);
            assert!((r.hs_m / reference.hs_m - 1.0).abs() < 0.02, "{text}");
            assert!((r.spread_deg / reference.spread_deg - 1.0).abs() < 0.05, "{text}");
            let turned = r.mean_from_deg.unwrap_or(f64::NAN) - reference.mean_from_deg.unwrap_or(f64::NAN);
            assert!(turned.abs() < 2.0, "{text}");
            // The mean square slope depends on the cut-off: compare it up to 2 rad/m, which all plans resolve.
            let (a, b) = (
                plan.resolved_slope_variance_below(2.0),
                Plan::new(&params(&format!("{sea}&n=512"))).resolved_slope_variance_below(2.0),
            );
            assert!((a / b - 1.0).abs() < 0.02, "{text}: mss to 2 rad/m {a} against {b}");
        }
    }
}

#[test]
fn a_loop_closes() {
    let gpu = gpu();
    let state = "wind=12&n=64&loop=120";
    let (a, b) = (maps(&gpu, state, 7.0), maps(&gpu, state, 127.0));
    assert_eq!(a.texels, b.texels, "bit for bit");
}

/// Mean foam of each level after a cold start, or after a run from `from_s` to the state's time in steps of `dt_s`.
fn foam(gpu: &Gpu, state: &str, run: Option<(f64, f64)>) -> Vec<f64> {
    let mut sim = common::simulation(gpu, state);
    let end_s = params(state).clock.t_s;
    let (from_s, dt_s) = run.unwrap_or((end_s, 1.0));
    let steps = ((end_s - from_s) / dt_s).round() as u32;
    for t_s in (0..steps).map(|i| from_s + dt_s * f64::from(i)).chain([end_s]) {
        let mut encoder = gpu.encoder("test");
        assert!(sim.encode(gpu, &mut encoder, t_s, [0.0; 2], MAX_FOAM_STEPS));
        gpu.submit(encoder);
    }
    let mut encoder = gpu.encoder("test");
    let copy = readback::stage_texture(gpu, &mut encoder, &sim.resources.foam, 0);
    gpu.submit(encoder);
    let texels = pollster::block_on(copy.read_map(gpu)).expect("read-back");
    let size = sim.resources.foam_n as usize;
    let values: Vec<f64> = texels.iter().map(|t| f64::from(t[0])).collect();
    assert!(values.iter().all(|f| (0.0..=1.0).contains(f)), "foam is bounded");
    values.chunks(size * size).map(|level| level.iter().sum::<f64>() / level.len() as f64).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn the_maps_of_a_frame_are_read_back_as_they_are() {
    use seastate::waves::map_spectrum::MapSpectrumEstimator;
    let gpu = gpu();
    let mut sim = common::simulation(&gpu, "wind=12&n=128&t=9");
    let mut encoder = gpu.encoder("test");
    assert!(sim.encode(&gpu, &mut encoder, 9.0, [0.0; 2], MAX_FOAM_STEPS));
    let probe = sim.record_map_copies(&gpu, &mut encoder).expect("one sea");
    gpu.submit(encoder);
    let probed = pollster::block_on(probe.read(&gpu)).expect("read-back");
    let maps = read(&gpu, &mut sim, 9.0);
    let variance = |of: &dyn Fn(usize) -> f64| (0..maps.cascade_count()).map(of).sum::<f64>();
    let mean = |texels: &[[f32; 4]], channel: usize| {
        texels.iter().map(|t| f64::from(t[channel]).powi(2)).sum::<f64>() / texels.len() as f64
    };
    let m0 = variance(&|c| mean(maps.displacement(c), 1));
    let mss = variance(&|c| mean(maps.gradients(c), 0) + mean(maps.gradients(c), 1));
    // The probe reads half-float maps.
    assert!((probed.mean_square_slope / mss - 1.0).abs() < 0.02, "{} {mss}", probed.mean_square_slope);
    let foam = sim.mean_foam();
    assert!(probed.mean_foam / foam > 0.5 && probed.mean_foam / foam < 2.0, "{} {foam}", probed.mean_foam);
    // The estimated spectrum has all of the variance and overlaps with the theoretical spectrum.
    let width = probed.plan.omega_p / 8.0;
    let mut estimator = MapSpectrumEstimator::new(&probed.plan, width, 4000);
    let found =
        estimator.advance(&probed.plan, usize::MAX, |c, z| probed.heights_in_row(c, z)).expect("all at once").clone();
    assert!((found.variance_m2 / m0 - 1.0).abs() < 1e-3, "{} {m0}", found.variance_m2);
    assert!((found.bin_variances_m2.iter().sum::<f64>() / m0 - 1.0).abs() < 2e-3);
    let theory = |i: usize| probed.plan.density((i as f64 + 0.5) * width) * width;
    let both: f64 = found.bin_variances_m2.iter().enumerate().map(|(i, x)| x.min(theory(i))).sum();
    eprintln!("overlap with theory: {:.3} of m0", both / m0);
    assert!(both / m0 > 0.8, "{}", both / m0);
}

#[test]
fn a_calm_sea_has_no_foam() {
    let gpu = gpu();
    for state in ["wind=0", "wind=0&whitecaps=fixed&foamthreshold=1&foambias=1"] {
        assert_eq!(foam(&gpu, &format!("{state}&n=64&t=5"), None), vec![0.0; 4], "{state}");
    }
}

#[test]
fn whitecaps_cover_what_the_wind_makes_them() {
    let gpu = gpu();
    for (wind, fetch) in [(7.0, 100.0), (10.0, 200.0), (14.0, 300.0), (20.0, 500.0)] {
        // The mean at two times, because a light breeze has few whitecaps on the finest level.
        let at = |t: f64| mean(&foam(&gpu, &format!("wind={wind}&fetch={fetch}&n=128&t={t}"), None));
        let (cover, monahan) = (0.5 * (at(5.0) + at(40.0)), statistics::monahan_coverage(wind));
        eprintln!("wind {wind} m/s: {cover:.5}, Monahan {monahan:.5}");
        assert!(cover / monahan > 1.0 / 1.5 && cover / monahan < 1.5, "wind {wind}: {cover} against {monahan}");
    }
}

/// A short fetch leaves the waves shorter than the cells of the wide levels. These have the mean foam then: what is left
/// of the waves there is mostly rounding, and would turn most of the distant sea white.
#[test]
fn short_waves_whiten_every_level_alike() {
    let gpu = gpu();
    // Waves of a second break for less time than the fit of the mean foam supposes, so the finest level has more.
    for (wind, fetch, most) in [(8.0, 0.5, 2.5), (14.0, 0.5, 1.5), (14.0, 10.0, 1.5)] {
        let at = |t: f64| foam(&gpu, &format!("wind={wind}&fetch={fetch}&n=128&t={t}"), None);
        let levels: Vec<f64> = at(5.0).iter().zip(at(40.0)).map(|(a, b)| 0.5 * (a + b)).collect();
        let monahan = statistics::monahan_coverage(wind);
        eprintln!("wind {wind} m/s, fetch {fetch} km: {levels:.5?}, Monahan {monahan:.5}");
        assert!(levels.iter().all(|f| f / monahan > 1.0 / most && f / monahan < most), "{wind} {fetch}: {levels:?}");
    }
}

#[test]
fn every_control_of_the_foam_works() {
    let gpu = gpu();
    let sea = "wind=14&fetch=300&n=128&t=12";
    let cover = |more: &str| mean(&foam(&gpu, &format!("{sea}{more}"), None));
    let usual = cover("");
    for (more, grows) in [
        ("&foambias=0.1", true),
        ("&foambias=-0.1", false),
        ("&foamdecay=8", true),
        ("&foamdecay=2", false),
        ("&foamrate=4", true),
        ("&foamrate=1", false),
        ("&whitecaps=fixed&foamthreshold=0.9", true),
        ("&whitecaps=fixed&foamthreshold=-0.2", false),
    ] {
        let other = cover(more);
        assert_eq!(other > usual, grows, "{more}: {other} instead of {usual}");
        // The expected coverage, which is used beyond the levels, follows the measured one.
        let plan = |more: &str| seastate::waves::foam::FoamModel::new(&Plan::new(&params(&format!("{sea}{more}"))));
        let guess = plan(more).expected_mean_foam;
        assert!(
            guess / other < 2.0 && other / guess.max(1e-6) < 2.0 || other < 1e-3,
            "{more}: {other}, guessed {guess}"
        );
    }
}

#[test]
fn foam_does_not_depend_on_how_one_came_there() {
    let gpu = gpu();
    let state = "wind=20&fetch=500&n=64&t=36";
    let cold = mean(&foam(&gpu, state, None));
    let slow = mean(&foam(&gpu, state, Some((26.0, 1.0 / 30.0))));
    let fast = mean(&foam(&gpu, state, Some((26.0, 1.0 / 144.0))));
    eprintln!("cold start {cold}, at 30 steps a second {slow}, at 144 {fast}");
    assert!((slow / fast - 1.0).abs() < 0.02, "30 steps a second: {slow}, 144: {fast}");
    assert!((fast / cold - 1.0).abs() < 0.03, "cold start {cold}, running {fast}");
}

/// Reads maps of many seas and keeps one simulation per number of cascades.
struct Probe {
    gpu: Gpu,
    sims: Vec<Option<Simulation>>,
}

impl Probe {
    fn new() -> Self {
        Self { gpu: gpu(), sims: (0..=4).map(|_| None).collect() }
    }

    /// Fails unless the statistics and the maps of a sea are finite and within the range of half floats.
    fn assert_finite(&mut self, p: &Params) {
        let plan = Plan::new(p);
        let t = statistics::SpectrumStatistics::new(&plan);
        let numbers = [t.hs_m, t.tp_s, t.tm01_s, t.tm02_s, t.lambda_mean_m, t.mss, t.spread_deg, t.benjamin_feir];
        assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0), "{t:?}");
        let gpu = &self.gpu;
        let shaders = Shaders::default();
        let sim = self.sims[plan.cascades.len()].get_or_insert_with(|| Simulation::new(gpu, plan.clone(), &shaders));
        sim.set_plan(gpu, plan, &shaders);
        let state = seastate::state::query::write(p);
        let maps = read(&self.gpu, sim, p.clock.t_s);
        let largest = maps
            .texels
            .iter()
            .flatten()
            .fold(0.0f32, |most, x| if x.is_finite() { most.max(x.abs()) } else { f32::NAN });
        assert!(largest < 65504.0, "{state}: {largest}");
        assert!(sim.mean_foam().is_finite(), "{state}");
    }
}

#[test]
fn maps_are_finite_at_the_corners_of_every_range() {
    let mut probe = Probe::new();
    for field in FIELDS.iter() {
        let corners = match field.kind {
            FieldKind::Number { min, max, .. } => vec![min, max],
            FieldKind::Integer { min, max } => vec![f64::from(min), f64::from(max)],
            FieldKind::Choice(words) => (0..words.len()).map(|i| i as f64).collect(),
            FieldKind::Heading | FieldKind::Flag => vec![0.0, 1.0],
            FieldKind::Colour => vec![0.0],
        };
        for corner in corners {
            for start in ["n=64", "n=64&scale2=1&dispersion=capillary&hs2=3&tp2=10"] {
                let mut p = params(start);
                (field.set)(&mut p, corner);
                p.grid.n = 64;
                probe.assert_finite(&p);
            }
        }
    }
}

#[test]
fn maps_are_finite_in_two_thousand_random_states() {
    // Two threads, because the plans of these seas take most of the time.
    std::thread::scope(|scope| {
        for first in 0..2 {
            scope.spawn(move || {
                let mut probe = Probe::new();
                (first..2000).step_by(2).for_each(|i| probe.assert_finite(&common::random_params("n=64", i)));
            });
        }
    });
}
