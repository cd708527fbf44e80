//! `point::StrongestWaves` against the oracle and the GPU, its stated error, and the geometry of the displaced surface.

mod common;

use seastate::oracle::surface::{self, WaveFields};
use seastate::oracle::{Texel, maps, spectrum};
use seastate::point::{StrongestWaves, SurfaceSample};
use seastate::waves::plan::Cascade;
use seastate::waves::{Plan, noise};

const GALE: &str = "wind=20&fetch=500&n=128";
/// Deep water; two wave systems; shallow water and different chop along x; capillary waves; a loop; plain patches.
const SEAS: [&str; 6] = [
    "wind=10&fetch=100&n=64&dispersion=deep",
    "wind=12&scale2=1&n=64&dir=13",
    "spectrum=tma&depth=5&wind=15&n=64&swell=0.5&chopx=0.4",
    "spectrum=elfouhaily&dispersion=capillary&wind=8&n=64&seed=5",
    "wind=14&n=64&loop=60",
    "wind=12&n=64&untile=0",
];

fn plan(state: &str) -> Plan {
    Plan::new(&common::params(state))
}

/// The plan of a state without bound waves, whose heights are sums over cascades.
fn linear_plan(state: &str) -> Plan {
    plan(&format!("{state}&order=1"))
}

/// Pseudo-random number in [0, 1): number `i` of the given stream.
fn random(i: usize, stream: u32) -> f64 {
    f64::from(noise::pcg4d([i as u32, stream, 3, 4])[0]) / 4_294_967_296.0
}

/// Random points (x, z) in a square around the origin, m, with times within an hour, s.
fn places(count: usize, side_m: f64) -> impl Iterator<Item = ([f64; 2], f64)> {
    (0..count).map(move |i| ([0, 1].map(|axis| (random(i, axis) - 0.5) * side_m), 3600.0 * random(i, 2)))
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// All waves of each cascade separately. The bands must not overlap.
fn by_cascade(plan: &Plan) -> Vec<StrongestWaves> {
    let one = |cascade: &Cascade| {
        let mut alone = plan.clone();
        alone.cascades = vec![cascade.clone()];
        StrongestWaves::new(&alone, usize::MAX)
    };
    plan.cascades.iter().map(one).collect()
}

/// A world position of texel `i` of a cascade, m, and the blended fields of its maps there.
fn drawn(plan: &Plan, cascade: &Cascade, i: usize, read: impl Fn(usize) -> [Texel; 2]) -> ([f64; 2], WaveFields) {
    let n = plan.n as usize;
    let patches = noise::pcg4d([i as u32, 8, 9, 10]);
    let at = [i % n, i / n].map(|i| i as f64 / n as f64);
    let at = [0, 1].map(|axis| (at[axis] + f64::from(patches[axis] % 100) - 50.0) * cascade.patch_m);
    // Copies are shifted by whole texels.
    let texel = |place: f64| ((place * n as f64).round() as usize) % n;
    (at, surface::blend_patch_copies(&plan.tiling(cascade), at, |place| read(texel(place[1]) * n + texel(place[0]))))
}

/// Largest difference between a sample and the drawn fields: lengths in units of Hs, normals and Jacobians as they are.
fn difference(sea: &SurfaceSample, at: [f64; 2], drawn: &WaveFields, plan: &Plan) -> f64 {
    let [lx, lz] = plan.sea.choppiness_xz();
    let WaveFields { displacement: d, slope: [sx, sz], strain: [xx, zz, xz, zx] } = *drawn;
    let world = [at[0] + lx * d[0], at[1] + lz * d[2]];
    let jacobian = (1.0 + lx * xx) * (1.0 + lz * zz) - lx * lz * xz * zx;
    let normal = [-(sx * (1.0 + lz * zz) - sz * lz * zx), jacobian, -(sz * (1.0 + lx * xx) - sx * lx * xz)];
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    let lengths = [sea.height_m - d[1], sea.world_xz[0] - world[0], sea.world_xz[1] - world[1]];
    let lengths = lengths.map(|e| e / plan.hs_m());
    let normals = [0, 1, 2].map(|i| length * (sea.normal[i] - normal[i] / length));
    lengths.into_iter().chain(normals).chain([sea.jacobian - jacobian]).fold(0.0, |worst, e| worst.max(e.abs()))
}

/// Largest difference between `sea` and the maps of a cascade, at every 97th texel.
fn largest_difference(
    sea: &StrongestWaves,
    plan: &Plan,
    cascade: &Cascade,
    t_s: f64,
    read: impl Fn(usize) -> [Texel; 2],
) -> f64 {
    let at_texel = |i: usize| {
        let (at, drawn) = drawn(plan, cascade, i, &read);
        difference(&sea.sample_undisplaced(at[0], at[1], t_s), at, &drawn, plan)
    };
    (0..(plan.n * plan.n) as usize).step_by(97).map(at_texel).fold(0.0, f64::max)
}

#[test]
fn all_waves_are_the_oracles_sea() {
    for state in SEAS {
        let plan = linear_plan(state);
        for t_s in [0.0, 100_000.25] {
            for (cascade, sea) in plan.cascades.iter().zip(by_cascade(&plan)) {
                let h0 = spectrum::initial_spectrum(&plan, cascade);
                let [d, g] = maps::transform_columns(plan.n as usize, &maps::transform_rows(&plan, cascade, &h0, t_s));
                let worst = largest_difference(&sea, &plan, cascade, t_s, |i| [d[i], g[i]]);
                // The table interpolates norms, with an error of 1e-6.
                assert!(worst < 2e-6, "{state} t {t_s}: {worst}");
            }
        }
    }
}

#[test]
fn all_waves_are_the_gpus_sea() {
    let gpu = common::gpu();
    for state in SEAS {
        let plan = linear_plan(state);
        let mut sim = common::simulation(&gpu, &format!("{state}&order=1"));
        for t_s in [0.0, 100_000.25] {
            let read = common::read(&gpu, &mut sim, t_s);
            for (c, (cascade, sea)) in plan.cascades.iter().zip(by_cascade(&plan)).enumerate() {
                let texels = |i: usize| [read.displacement(c)[i], read.gradients(c)[i]].map(|t| t.map(f64::from));
                let worst = largest_difference(&sea, &plan, cascade, t_s, texels);
                assert!(worst < 1e-5, "{state} t {t_s} cascade {c}: {worst}");
            }
        }
    }
}

#[test]
fn cascades_add() {
    for state in SEAS {
        let plan = linear_plan(state);
        let (all, each) = (StrongestWaves::new(&plan, usize::MAX), by_cascade(&plan));
        for ([x, z], t_s) in places(10, 5000.0) {
            let parts: f64 = each.iter().map(|sea| sea.sample_undisplaced(x, z, t_s).height_m).sum();
            assert!((all.sample_undisplaced(x, z, t_s).height_m - parts).abs() < 1e-11 * plan.hs_m(), "{state}");
        }
    }
}

#[test]
fn overlapping_cascades_share_their_waves() {
    let plan = linear_plan("wind=14&n=64&overlap=1");
    let sea = StrongestWaves::new(&plan, usize::MAX).sample_undisplaced(0.0, 0.0, 50.0);
    let oracle = plan.cascades.iter().map(|cascade| {
        let h0 = spectrum::initial_spectrum(&plan, cascade);
        let [d, g] = maps::transform_columns(64, &maps::transform_rows(&plan, cascade, &h0, 50.0));
        let texel = |place: f64| ((place * 64.0).round() as usize) % 64;
        let read = |place: [f64; 2]| [&d, &g].map(|map| map[texel(place[1]) * 64 + texel(place[0])]);
        surface::blend_patch_copies(&plan.tiling(cascade), [0.0; 2], read).displacement[1]
    });
    assert!((sea.height_m - oracle.sum::<f64>()).abs() < 1e-5 * plan.hs_m());
}

/// The bound waves are the oracle's double sum over the cascades.
#[test]
fn bound_waves_are_the_oracles() {
    for state in SEAS {
        let (plan, linear) = (plan(state), linear_plan(state));
        let each = by_cascade(&linear);
        let [first, second] = [&linear, &plan].map(|plan| StrongestWaves::new(plan, usize::MAX));
        let (bound, chop) = (plan.bound_waves(), plan.sea.choppiness_xz());
        let mut largest = 0.0f64;
        for (at, t_s) in places(100, 5000.0) {
            let displacements: Vec<[f64; 3]> = each
                .iter()
                .map(|sea| {
                    let here = sea.sample_undisplaced(at[0], at[1], t_s);
                    let [x, z] = [0, 1].map(|axis| (here.world_xz[axis] - at[axis]) / chop[axis]);
                    [x, here.height_m, z]
                })
                .collect();
            let want = surface::bound_height_m(&displacements, &bound);
            let [a, b] = [&first, &second].map(|sea| sea.sample_undisplaced(at[0], at[1], t_s).height_m);
            assert!((b - a - want).abs() < 1e-9 * plan.hs_m(), "{state}: {} for {want}", b - a);
            largest = largest.max(want.abs());
        }
        assert!(largest > 0.01 * plan.hs_m(), "{state}: {largest}");
    }
}

#[test]
fn the_error_is_the_one_promised() {
    let plan = plan(GALE);
    let full = StrongestWaves::new(&plan, usize::MAX);
    let places: Vec<_> = places(3000, 200_000.0).collect();
    let truth: Vec<f64> = places.iter().map(|&([x, z], t)| full.sample_undisplaced(x, z, t).height_m).collect();
    let sigma = (truth.iter().map(|h| h * h).sum::<f64>() / truth.len() as f64).sqrt();
    assert!((4.0 * sigma / plan.hs_m() - 1.0).abs() < 0.05, "{sigma}");
    let mut before = f64::INFINITY;
    for modes in [50, 200, 1000, 5000] {
        let some = StrongestWaves::new(&plan, modes);
        let errors: Vec<f64> = (places.iter().zip(&truth))
            .map(|(&([x, z], t), truth)| some.sample_undisplaced(x, z, t).height_m - truth)
            .collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        let most = errors.iter().fold(0.0f64, |most, e| most.max(e.abs()));
        let promised = some.residual_rms_m();
        // At fixed points of the world the omitted waves also displace the water sideways.
        let world = places.iter().take(300).map(|&([x, z], t)| {
            let [a, b] = [&some, &full].map(|sea| sea.sample(x, z, t).height_m);
            (a - b) * (a - b)
        });
        let world = (world.sum::<f64>() / 300.0).sqrt();
        eprintln!(
            "{modes} of {}: share {:.5}, promised {promised:.4} m, measured {rms:.4} m, most {most:.3} m, \
             world {world:.4} m, \
             slope {:.4}",
            full.wave_count(),
            some.variance_fraction(),
            some.residual_slope_rms()
        );
        assert!((rms / promised - 1.0).abs() < 0.1, "{modes}: {rms} against {promised}");
        assert!(rms < before && most < 6.0 * promised, "{modes}: {rms} {most}");
        assert!((0.9..1.6).contains(&(world / promised)), "{modes}: {world} against {promised}");
        before = rms;
    }
}

#[test]
fn a_sample_lies_where_it_was_asked_for() {
    for (state, modes) in [(GALE, usize::MAX), (GALE, 300), ("wind=30&fetch=1000&n=64&chop=1.3", usize::MAX)] {
        let sea = StrongestWaves::new(&plan(state), modes);
        let (mut upright, mut lost) = (0, 0);
        for (at, t_s) in places(400, 10_000.0) {
            let here = sea.sample(at[0], at[1], t_s);
            lost += usize::from(!here.converged);
            let again = sea.sample_undisplaced(here.undisplaced_xz[0], here.undisplaced_xz[1], t_s);
            assert!(distance(here.world_xz, again.world_xz) < 1e-6 && (here.height_m - again.height_m).abs() < 1e-6);
            if here.jacobian > 0.1 {
                upright += 1;
                assert!(here.converged && distance(here.world_xz, at) < 1e-6, "{state}: {at:?} {here:?}");
            }
            assert!(!here.converged || here.jacobian > -1e-3, "{state}: a minimum is upright water: {here:?}");
        }
        eprintln!("{state}, {} waves: upright {upright}, lost {lost} of 400", sea.wave_count());
        assert!(upright > 300 && lost <= 4, "{state}: upright {upright}, lost {lost}");
    }
}

#[test]
fn the_normal_is_that_of_the_surface_in_the_world() {
    for state in [GALE, "wind=12&n=64&chopx=1.2&chopz=0.3", "wind=12&n=64&chop=0"] {
        let sea = StrongestWaves::new(&plan(state), 1000);
        let (step, mut compared) = (1e-3, 0);
        for ([x, z], t_s) in places(300, 5000.0) {
            let height = |x, z| sea.sample(x, z, t_s).height_m;
            let here = sea.sample(x, z, t_s);
            if here.jacobian < 0.3 {
                continue;
            }
            let slope = [
                (height(x + step, z) - height(x - step, z)) / (2.0 * step),
                (height(x, z + step) - height(x, z - step)) / (2.0 * step),
            ];
            let length = (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
            let want = [-slope[0] / length, 1.0 / length, -slope[1] / length];
            let worst = (0..3).map(|i| (here.normal[i] - want[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-3, "{state} at {x} {z}: {:?} against {want:?}", here.normal);
            compared += 1;
        }
        assert!(compared > 250, "{state}: {compared}");
    }
}

#[test]
fn the_velocity_is_that_of_the_water() {
    for state in ["wind=20&fetch=500&n=64", SEAS[1], "spectrum=tma&depth=5&wind=15&n=64", SEAS[3]] {
        let plan = plan(state);
        let sea = StrongestWaves::new(&plan, usize::MAX);
        // The time resolution of the phases.
        let tick = plan.repeat_period_s / 4_294_967_296.0;
        let dt = 100.0 * tick;
        for (i, ([x, z], _)) in places(50, 5000.0).enumerate() {
            let t_s = (random(i, 9) * 1e7).floor() * tick;
            let [before, after] = [-dt, dt].map(|dt| sea.sample_undisplaced(x, z, t_s + dt));
            let along = |a: f64, b: f64| (b - a) / (2.0 * dt);
            let want = [
                along(before.world_xz[0], after.world_xz[0]),
                along(before.height_m, after.height_m),
                along(before.world_xz[1], after.world_xz[1]),
            ];
            let got = sea.sample_undisplaced(x, z, t_s).velocity_m_s;
            let worst = (0..3).map(|i| (got[i] - want[i]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-4, "{state}: {got:?} against {want:?}");
        }
    }
}

#[test]
fn the_same_question_has_the_same_answer() {
    let plan = plan(GALE);
    let (a, b) = (StrongestWaves::new(&plan, 300), StrongestWaves::new(&plan, 300));
    assert_eq!(a, b);
    let points: Vec<[f64; 2]> = places(100, 3000.0).map(|(at, _)| at).collect();
    let many = a.sample_many(&points, 77.7);
    let thread = std::thread::spawn(move || (b.sample_many(&points, 77.7), points));
    let (others, points) = thread.join().expect("no panic");
    assert_eq!(many, others);
    for (point, sample) in points.iter().zip(&many).rev() {
        assert_eq!(*sample, a.sample(point[0], point[1], 77.7));
    }
    // A loop closes bit for bit.
    let looped = StrongestWaves::new(&self::plan("wind=12&n=64&loop=120"), 300);
    assert_eq!(looped.sample(3.0, 4.0, 7.0), looped.sample(3.0, 4.0, 127.0));
}

fn is_finite(s: &SurfaceSample) -> bool {
    let numbers = [s.height_m, s.jacobian].into_iter();
    let pairs = s.undisplaced_xz.into_iter().chain(s.world_xz);
    numbers.chain(s.normal).chain(s.velocity_m_s).chain(pairs).all(f64::is_finite)
}

#[test]
fn extremes() {
    // Still water: a calm, and a sum of no waves.
    for (state, modes) in [("wind=0&n=64&level=3", 500), ("wind=12&n=64&level=3", 0)] {
        let sea = StrongestWaves::new(&plan(state), modes);
        let here = sea.sample(10.0, -20.0, 30.0);
        let still = SurfaceSample {
            height_m: 3.0,
            normal: [0.0, 1.0, 0.0],
            velocity_m_s: [0.0; 3],
            undisplaced_xz: [10.0, -20.0],
            world_xz: [10.0, -20.0],
            jacobian: 1.0,
            converged: true,
        };
        assert_eq!((sea.wave_count(), here), (0, still));
        assert_eq!(sea.variance_fraction(), if modes == 0 { 0.0 } else { 1.0 });
    }
    // Heights include the still-water level.
    let [low, high] =
        ["level=0", "level=3"].map(|l| StrongestWaves::new(&plan(&format!("n=64&{l}")), 50).sample(1.0, 2.0, 3.0));
    assert!((high.height_m - low.height_m - 3.0).abs() < 1e-12);
    // A surface with many folds.
    let torn = StrongestWaves::new(&plan("wind=25&fetch=800&n=64&chop=2&height=3"), usize::MAX);
    let (mut lost, mut folds) = (0, 0);
    for ([x, z], t_s) in places(300, 5000.0) {
        let (here, water) = (torn.sample(x, z, t_s), torn.sample_undisplaced(x, z, t_s));
        assert!(is_finite(&here) && is_finite(&water), "{here:?} {water:?}");
        folds += usize::from(water.jacobian < 0.0);
        lost += usize::from(!here.converged);
        assert!(!here.converged || distance(here.world_xz, [x, z]) < 1e-6 && here.jacobian > -1e-3, "{here:?}");
    }
    eprintln!("torn: {folds} of 300 places lie in folds, lost {lost}");
    assert!(folds > 20 && lost <= 3, "{folds} {lost}");
    // Infinite and NaN arguments.
    let sea = StrongestWaves::new(&plan("n=64&level=3"), 100);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (x, z, t) in [(bad, 0.0, 0.0), (0.0, bad, 0.0), (0.0, 0.0, bad)] {
            for here in [sea.sample(x, z, t), sea.sample_undisplaced(x, z, t)] {
                assert!(is_finite(&here) && !here.converged && here.height_m == 3.0);
            }
        }
    }
    for huge in [1e17, -1e300, f64::MAX] {
        assert!(is_finite(&sea.sample(huge, 1.0, 2.0)) && is_finite(&sea.sample(1.0, 2.0, huge)));
    }
}

#[test]
fn far_away_is_as_good_as_here() {
    // A single cascade without tiling repeats with its patch, also 10 000 km away.
    let plan = plan("wind=20&fetch=500&n=64&cascades=1&patch1=512&untile=0");
    let sea = StrongestWaves::new(&plan, usize::MAX);
    for (i, ([x, z], t_s)) in places(100, 512.0).enumerate() {
        // Multiples of 2^-20 m are exact at that distance.
        let [x, z] = [x, z].map(|v| (v * 1_048_576.0).round() / 1_048_576.0);
        let away = 512.0 * (19_531.0 + i as f64);
        let (here, far) = (sea.sample(x, z, t_s), sea.sample(x + away, z - away, t_s));
        assert!(far.converged && (here.height_m - far.height_m).abs() < 1e-9, "{here:?} {far:?}");
        assert!((far.undisplaced_xz[0] - away - here.undisplaced_xz[0]).abs() < 1e-8);
    }
}
