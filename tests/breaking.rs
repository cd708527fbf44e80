//! Breaking crests: they lean forward as measured spilling breakers do, without a change of the sea's height, and their
//! fronts are distributed over their speeds as Phillips (1985) expects.

mod common;

use common::{params, wgsl};
use seastate::gpu::{Gpu, readback};
use seastate::ocean::Ocean;
use seastate::render;
use seastate::shaders::Shaders;
use seastate::sim::{MAX_FOAM_STEPS, Simulation};
use seastate::waves::{Plan, noise, statistics};
use wgpu::BindingResource::{Sampler, TextureView};

/// The question is a point beside the eye's foot (x, z), m. Slopes are those of waves of more than half a metre.
const ANSWER: &str = "
fn answer(question: Question) -> Answer {
  let at = question[0].xy;
  let foot = water_round_footprint(0.12);
  let waves = water_displacement(at, 0.12, false).displacement;
  let slope = water_slope(at, waves, foot);
  let breaker = breaker_motion(at, waves.y, slope.mean * slope.jacobian, surf_motion(at));
  let leaning = water_slope_with_carried(at, waves + breaker.moved, foot, foot, breaker.derivatives, false, 1.0);
  return Answer(
    vec4f(waves, breaker_state(at).value.x),
    vec4f(breaker.moved, slope.jacobian),
    vec4f(slope.mean, leaning.mean),
    vec4f(leaning.jacobian, 0.0, 0.0, 0.0));
}
";

/// The water at a point, without and with the motion of breaking crests.
struct Point {
    height_m: f64,
    excess: f64,
    moved: [f64; 3],
    jacobian: [f64; 2],
    /// Slope along the wind.
    slope: [f64; 2],
}

/// The ocean of a state, with the maps of its time.
fn ocean(gpu: &Gpu, state: &str) -> Ocean {
    let params = params(state);
    let mut ocean = Ocean::without_renderer(gpu, &params);
    let mut encoder = gpu.encoder("test");
    ocean.simulation().encode(gpu, &mut encoder, params.clock.t_s, [0.0; 2], MAX_FOAM_STEPS);
    gpu.submit(encoder);
    ocean
}

/// Answers at random points of an ocean, within 60 m of the eye.
fn ask(ocean: &Ocean, shaders: &Shaders, count: u32, answer: &str) -> Vec<[[f64; 4]; 4]> {
    let gpu = ocean.gpu();
    let mut scene = ocean.scene([1280, 720]);
    scene.sea.unresolved_slope_variance = [0.0; 2];
    let mut kernel = wgsl::Kernel::new(gpu, shaders, "water/light", answer);
    let maps = ocean.maps();
    let frame = render::frame_uniform(&scene, maps, [1280, 720]);
    let frame = wgsl::buffer(gpu, bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
    kernel.bind(0, &[(0, frame.as_entire_binding())]);
    let samplers = [wgpu::MipmapFilterMode::Linear, wgpu::MipmapFilterMode::Nearest]
        .map(|filter| gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], filter));
    let bindings = [
        (0, TextureView(&maps.displacement)),
        (1, TextureView(&maps.gradients)),
        (2, TextureView(&maps.slope_moments)),
        (3, TextureView(&maps.foam)),
        (4, Sampler(&samplers[0])),
        (5, Sampler(&samplers[1])),
        (6, TextureView(&maps.no_coast)),
    ];
    // A kernel must not be given what it does not read.
    if answer.contains("water_displacement") {
        kernel.bind(1, &bindings);
    }
    let place = |i: u32, axis: usize| (f64::from(noise::pcg4d([i, 7, 3, 5])[axis]) / 4_294_967_296.0 - 0.5) * 120.0;
    let questions: Vec<[[f32; 4]; 1]> =
        (0..count).map(|i| [[place(i, 0) as f32, place(i, 1) as f32, 0.0, 0.0]]).collect();
    kernel.ask(&questions)
}

/// Random points of an ocean, within 60 m of the eye.
fn points(ocean: &Ocean, shaders: &Shaders, count: u32) -> Vec<Point> {
    let [wind_x, wind_z] = ocean.plan().downwind;
    let point = |[waves, moved, slopes, [jacobian, ..]]: [[f64; 4]; 4]| Point {
        height_m: waves[1],
        excess: waves[3],
        moved: [moved[0], moved[1], moved[2]],
        jacobian: [moved[3], jacobian],
        slope: [0, 2].map(|i| slopes[i] * wind_x + slopes[i + 1] * wind_z),
    };
    ask(ocean, shaders, count, ANSWER).into_iter().map(point).collect()
}

/// Ratio of the mean steepness of lee faces to that of weather faces, of the surface without (0) or with (1) the motion
/// of breaking crests, at points that break. Points count by the area of the displaced surface.
fn asymmetry(points: &[Point], which: usize) -> f64 {
    let [mut lee, mut weather] = [[0.0; 2]; 2];
    for p in points.iter().filter(|p| p.excess > 1.0 && p.height_m > 0.0) {
        let (face, slope) = (if p.slope[which] < 0.0 { &mut lee } else { &mut weather }, p.slope[which].abs());
        let area = p.jacobian[which].max(0.0);
        *face = [face[0] + area, face[1] + area * slope];
    }
    (lee[1] / lee[0]) / (weather[1] / weather[0])
}

/// Three oceans of a wind, m/s, over a fetch, km.
fn oceans(gpu: &Gpu, wind: f64, fetch: f64) -> [Ocean; 3] {
    [1, 2, 3].map(|seed| ocean(gpu, &format!("wind={wind}&fetch={fetch}&n=256&t=40&y=3&seed={seed}")))
}

/// Random points of all these oceans, within 60 m of the eye.
fn points_of(oceans: &[Ocean], shaders: &Shaders) -> Vec<Point> {
    oceans.iter().flat_map(|ocean| points(ocean, shaders, 60_000)).collect()
}

/// Statistics of a sea. Arrays hold the value for the waves alone, then the value for waves whose breaking crests lean
/// and bear rollers of foam.
struct Change {
    /// Steepness of lee faces, relative to that of weather faces.
    asymmetry: [f64; 2],
    /// Number of points at which the surface folds.
    folded: [usize; 2],
    hs_m: [f64; 2],
    /// Ratio of the mean squares of the slopes.
    slope_square: f64,
    /// Change of the mean level, m.
    level_m: f64,
}

/// Moments are over the area of the displaced surface.
fn change(points: &[Point], label: &str) -> Change {
    let mean = |which: usize, f: &dyn Fn(&Point) -> f64| {
        let area: f64 = points.iter().map(|p| p.jacobian[which]).sum();
        points.iter().map(|p| p.jacobian[which] * f(p)).sum::<f64>() / area
    };
    let height = |p: &Point, which: usize| p.height_m + if which == 1 { p.moved[1] } else { 0.0 };
    let hs_m = [0, 1].map(|which| {
        let [level, square] = [1, 2].map(|power| mean(which, &|p| height(p, which).powi(power)));
        4.0 * (square - level * level).sqrt()
    });
    let slopes = [0, 1].map(|which| mean(which, &|p| p.slope[which].powi(2)));
    let out = Change {
        asymmetry: [0, 1].map(|which| asymmetry(points, which)),
        folded: [0, 1].map(|which| points.iter().filter(|p| p.jacobian[which] <= 0.0).count()),
        hs_m,
        slope_square: slopes[1] / slopes[0],
        level_m: mean(1, &|p| height(p, 1)) - mean(0, &|p| height(p, 0)),
    };
    // A boat floats on the waves without the motion of breakers.
    let rms = (points.iter().map(|p| p.moved[1].powi(2)).sum::<f64>() / points.len() as f64).sqrt();
    let most = points.iter().map(|p| p.moved[0].hypot(p.moved[2])).fold(0.0, f64::max);
    eprintln!(
        "{label}: lee faces {:.3} -> {:.3} times as steep as weather faces, folded {:?}, pushed by up to {most:.2} m, \
         mean level {:+.4} m, Hs {:.3} -> {:.3} m, slope variance {:+.4}, rollers {rms:.4} m",
        out.asymmetry[0],
        out.asymmetry[1],
        out.folded,
        out.level_m,
        out.hs_m[0],
        out.hs_m[1],
        out.slope_square - 1.0,
    );
    out
}

/// Measured spilling breakers are 1.2 to 2 times as steep in front as behind (Bonmarin 1989; Babanin and others 2010).
/// Here crests without their motion differ by up to 17 % by chance. The billows of the roller, which are the relief of
/// its foam, are evened out for the measurement of slopes; with them, the sea keeps its height and does not fold.
#[test]
fn breaking_crests_lean_forward() {
    let gpu = common::gpu();
    let even = wgsl::shaders().patched("water/light", "breaker_relief(at, thickness.y * crest)", "vec3f(0.0)");
    // A planted fault: crests that lean back.
    let wrong = even.clone().patched("water/light", "let along = direction /", "let along = -direction /");
    for (wind, fetch) in [(20.0, 500.0), (14.0, 300.0)] {
        let oceans = oceans(&gpu, wind, fetch);
        let lean = change(&points_of(&oceans, &even), &format!("wind {wind}, rollers evened out"));
        let [before, after] = lean.asymmetry;
        let steeper = after / before;
        assert!(steeper > 1.15 && after > 1.1 && after < 2.0, "{before} {after}");
        assert!(lean.slope_square < 1.1, "{}", lean.slope_square);
        let whole = change(&points_of(&oceans, &wgsl::shaders()), &format!("wind {wind}, with billows"));
        for found in [&lean, &whole] {
            let [hs_m, moved_hs_m] = found.hs_m;
            assert_eq!(found.folded[0], found.folded[1], "no crest folds");
            assert!(found.level_m.abs() < 0.002 * hs_m && moved_hs_m / hs_m < 1.015);
        }
        assert!(whole.slope_square > lean.slope_square + 0.01, "billows are rough");
        let all = points_of(&oceans, &wrong);
        let fault = asymmetry(&all, 1) / asymmetry(&all, 0);
        eprintln!("{steeper:.3} times as steep, with the fault {fault:.3} times");
        assert!(fault < 1.1 && fault < steeper - 0.1, "the fault is found");
    }
    // Without breaking, nothing moves by even one bit.
    let swell = points(&ocean(&gpu, "wind=0&scale2=1&hs2=3&tp2=12&n=128&t=40&y=3"), &wgsl::shaders(), 20_000);
    assert!(swell.iter().all(|p| p.moved == [0.0; 3] && p.slope[0] == p.slope[1]));
}

/// Height of billows of one length, its derivatives and the distance from the eye, m; the derivatives as differences of
/// the height over 2 mm; then the same of the billows of all lengths that a place has.
const BILLOWS: &str = "
fn rise_at(at: vec2f) -> vec3f {
  return vec3f(0.5 + 0.3 * sin(3.0 * at.x), 0.9 * cos(3.0 * at.x), 0.0);
}
fn relief_at(at: vec2f) -> f32 {
  return breaker_relief(at, rise_at(at)).x;
}
fn answer(question: Question) -> Answer {
  let at = question[0].xy;
  let step = vec2f(0.001, 0.0);
  let along_x = breaker_billows(at + step, 1.4).x - breaker_billows(at - step, 1.4).x;
  let along_z = breaker_billows(at + step.yx, 1.4).x - breaker_billows(at - step.yx, 1.4).x;
  let relief_x = relief_at(at + step) - relief_at(at - step);
  let relief_z = relief_at(at + step.yx) - relief_at(at - step.yx);
  return Answer(
    vec4f(breaker_billows(at, 1.4), length(at)), vec4f(along_x, along_z, 0.0, 0.0) / 0.002,
    vec4f(breaker_relief(at, rise_at(at)), length(at)), vec4f(relief_x, relief_z, 0.0, 0.0) / 0.002);
}
";

/// Slopes of billows are those of their height, but for points at a crease; and their mean height is what coarse meshes
/// take for it.
#[test]
fn billows_have_the_slopes_of_their_height() {
    // Fractions of the points with right slopes: of billows of one length, of shortened ones near the eye, and far ones.
    let ocean = ocean(&common::gpu(), "wind=20&fetch=500&n=64&t=40&y=3");
    let shares = |shaders: &Shaders| {
        let answers = ask(&ocean, shaders, 20_000, BILLOWS);
        let right = [(0, 0.0..80.0), (2, 0.0..30.0), (2, 32.0..80.0)].map(|(first, range)| {
            // Where the mesh is too coarse for billows, there are none.
            let shown = |a: &&[[f64; 4]; 4]| a[first][..3] != [0.0; 3] && range.contains(&a[first][3]);
            let shown: Vec<_> = answers.iter().filter(shown).collect();
            assert!(shown.len() > 3000, "{}", shown.len());
            let squares: f64 = shown.iter().map(|a| a[first][1].powi(2) + a[first][2].powi(2)).sum();
            let tolerance = 0.03 * (squares / shown.len() as f64).sqrt();
            let off = |a: &[[f64; 4]; 4]| (a[first][1] - a[first + 1][0]).hypot(a[first][2] - a[first + 1][1]);
            shown.iter().filter(|a| off(a) < tolerance).count() as f64 / shown.len() as f64
        });
        let mean = answers.iter().map(|[b, ..]| b[0]).sum::<f64>() / answers.len() as f64;
        assert!(answers.iter().all(|[b, ..]| (0.0..=1.0).contains(&b[0])));
        eprintln!("mean height {mean:.3}, slopes right at {right:.3?} of the points");
        (right, mean)
    };
    let (right, mean) = shares(&wgsl::shaders());
    assert!(right.iter().all(|r| *r > 0.95) && (mean - 0.44).abs() < 0.02, "{right:?} {mean}");
    // Planted faults: rows do not bend, and the slopes leave out that billows rise along a crest.
    let (right, _) = shares(&wgsl::shaders().patched("water/light", "rows_x - bent * bends_x", "rows_x"));
    assert!(right.iter().all(|r| *r < 0.5), "{right:?}");
    let (right, _) = shares(&wgsl::shaders().patched("water/light", "billows.yz + rise.yz * over", "billows.yz"));
    assert!(right[2] < 0.5, "{right:?}");
}

/// Foam, excess over the breaking criterion and front of a foam level, after a step to a time.
fn level(gpu: &Gpu, sim: &mut Simulation, t_s: f64, index: usize) -> Vec<[f64; 3]> {
    let mut encoder = gpu.encoder("test");
    assert!(sim.encode(gpu, &mut encoder, t_s, [0.0; 2], MAX_FOAM_STEPS));
    let copy = readback::stage_texture(gpu, &mut encoder, &sim.resources.foam, 0);
    gpu.submit(encoder);
    let texels = pollster::block_on(copy.read_map(gpu)).expect("read-back");
    let cells = (sim.resources.foam_n as usize).pow(2);
    texels[index * cells..][..cells].iter().map(|t| [t[0], t[1], t[2]].map(f64::from)).collect()
}

/// Distribution of the length of fronts over their speeds, and what the foam is made of.
struct Fronts {
    /// Length of fronts per area in each bin of speed, 1/m.
    length_per_m: [f64; SPEED_BINS],
    /// Area that fronts sweep in a second, relative to the area of the sea, 1/s.
    swept_per_s: f64,
    foam: f64,
    source: f64,
    /// Means of fronts as they are drawn (`foam_amount` in shaders/water/foam.wgsl), and of the foam beside them.
    drawn_front: f64,
    beside: f64,
}

/// Bins of the speed of fronts, from 1 m/s, each wider than the one before by this factor.
const SPEED_RATIO: f64 = 1.2;
const SPEED_BINS: usize = 18;
/// The foam level whose fronts are measured, 256 m wide.
const LEVEL: usize = 1;

/// Measures the fronts of a sea at `times` times, as cameras do (Melville and Matusov 2002): the speed of a front is
/// that with which the pattern around it moves along the wind.
fn fronts(gpu: &Gpu, state: &str, times: u32) -> Fronts {
    let plan = Plan::new(&params(state));
    let mut sim = common::simulation(gpu, state);
    let size = sim.resources.foam_n as usize;
    let mut out = Fronts {
        length_per_m: [0.0; SPEED_BINS],
        swept_per_s: 0.0,
        foam: 0.0,
        source: 0.0,
        drawn_front: 0.0,
        beside: 0.0,
    };
    let dt_s = 0.1;
    for i in 0..times {
        let t_s = 40.0 + 0.95 * f64::from(i);
        let pair = [t_s - dt_s, t_s].map(|t_s| level(gpu, &mut sim, t_s, LEVEL));
        let cell_m = sim.maps().foam_levels[LEVEL].cell_m;
        let reach = (2.0 * seastate::waves::foam::breaker_texel_m(&plan) / cell_m).ceil().max(2.0) as usize;
        let share = 1.0 / (f64::from(times) * (size * size) as f64);
        // Excess up to full source: mean of both times, its derivatives along and across the wind, and in time.
        let cut = |e: f64| e.clamp(0.0, 2.0);
        let at = |which: usize, x: usize, z: usize| cut(pair[which][(z % size) * size + x % size][1]);
        let mean = |x: usize, z: usize| 0.5 * (at(0, x, z) + at(1, x, z));
        let cells: Vec<[f64; 4]> = (0..size * size)
            .map(|i| {
                let (x, z) = (i % size, i / size);
                let gx = (mean(x + 1, z) - mean(x + size - 1, z)) / (2.0 * cell_m);
                let gz = (mean(x, z + 1) - mean(x, z + size - 1)) / (2.0 * cell_m);
                let [wx, wz] = plan.downwind;
                [mean(x, z), gx * wx + gz * wz, gz * wx - gx * wz, (at(1, x, z) - at(0, x, z)) / dt_s]
            })
            .collect();
        for (i, [excess, along, across, _]) in cells.iter().enumerate() {
            let [foam, _, front] = pair[1][i];
            let f = ((front - 0.3) / 0.35).clamp(0.0, 1.0);
            let f = 0.96 * f * f * (3.0 - 2.0 * f);
            out.foam += share * foam;
            out.source += share * (excess - 1.0).clamp(0.0, 1.0);
            out.drawn_front += share * f;
            out.beside += share * (1.0 - f) * foam;
            // The contour of the criterion: a band of the excess around 1, divided by its width.
            if (excess - 1.0).abs() > 0.25 || *along >= 0.0 {
                continue;
            }
            let (x, z) = (i % size, i / size);
            let mut sums = [0.0; 2];
            for dz in 0..=2 * reach {
                for dx in 0..=2 * reach {
                    let at = ((z + dz + size - reach) % size) * size + (x + dx + size - reach) % size;
                    let [_, along, _, rate] = cells[at];
                    sums = [sums[0] - rate * along, sums[1] + along * along];
                }
            }
            let speed = sums[0] / sums[1];
            let per_m = share * along.hypot(*across) / 0.5;
            out.swept_per_s += share * along.abs() / 0.5 * speed.max(0.0);
            let bin = (speed.max(1e-9).ln() / SPEED_RATIO.ln()).floor();
            if bin >= 0.0 && bin < SPEED_BINS as f64 {
                out.length_per_m[bin as usize] += per_m;
            }
        }
    }
    out
}

/// Lambda(c), s/m2, the length of fronts per area and unit speed, with the speed of each bin, m/s.
fn lambda(fronts: &Fronts) -> Vec<[f64; 2]> {
    let bin = |(i, length): (i32, &f64)| {
        let low = SPEED_RATIO.powi(i);
        [low * SPEED_RATIO.sqrt(), length / (low * (SPEED_RATIO - 1.0))]
    };
    (0..).zip(&fronts.length_per_m).map(bin).collect()
}

/// Mean speed of the fronts, m/s, and the slope of Lambda(c) in logarithms from 1.2 to 2.4 times this speed, weighted
/// by the length of the fronts.
fn mean_speed_and_slope(fronts: &Fronts) -> (f64, f64) {
    let all = lambda(fronts);
    let lengths: f64 = fronts.length_per_m.iter().sum();
    let mean = all.iter().zip(&fronts.length_per_m).map(|([c, _], length)| c * length).sum::<f64>() / lengths;
    let is_beyond = |&[c, l]: &[f64; 2]| c > 1.2 * mean && c < 2.4 * mean && l > 0.0;
    let points: Vec<[f64; 3]> = all.into_iter().filter(is_beyond).map(|[c, l]| [c.ln(), l.ln(), l * c]).collect();
    let sum = |f: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(|p| p[2] * f(p)).sum::<f64>();
    let weight = sum(&|_| 1.0);
    let [x, y] = [0, 1].map(|i| sum(&|p| p[i]) / weight);
    (mean, sum(&|p| (p[0] - x) * (p[1] - y)) / sum(&|p| (p[0] - x).powi(2)))
}

/// Fronts travel at 0.15 to 0.5 of the phase speed of the peak (Gemmrich and others 2008; Kleiss and Melville 2010).
/// Beyond their mean speed, Lambda(c) falls about as c^-6 (Phillips 1985), and its integral is the foam that is there.
#[test]
fn fronts_have_the_speeds_of_breakers() {
    let gpu = common::gpu();
    for (wind, fetch) in [(10.0, 200.0), (15.0, 300.0)] {
        let state = format!("wind={wind}&fetch={fetch}&n=256");
        let plan = Plan::new(&params(&state));
        let cp = 9.81 / plan.omega_p;
        let fronts = fronts(&gpu, &state, 24);
        for [c, l] in lambda(&fronts) {
            eprintln!("  c {c:5.2} m/s ({:.2} cp): {l:.3e} s/m2", c / cp);
        }
        // The area that fronts sweep stays white for the foam's decay time, as much as the source makes it.
        let foam = &plan.sea.foam;
        let exposure_s = fronts.source / fronts.swept_per_s;
        let white = fronts.swept_per_s * (1.0 - (-foam.rate_per_s * exposure_s).exp()) * foam.decay_s;
        let (speed, slope) = mean_speed_and_slope(&fronts);
        let drawn = [fronts.drawn_front, fronts.beside].map(|x| x / fronts.foam);
        // `foam_amount` with its constants.
        let shown = drawn[0] + drawn[1] * (1.0 - 0.32) / (1.0 - 0.18);
        eprintln!(
            "wind {wind}: cp {cp:.1} m/s, mean speed {speed:.2} m/s, then slope {slope:.2}; foam {:.5} (Monahan {:.5}), \
             from its fronts {white:.5}; exposure {exposure_s:.2} s; drawn fronts {:.3} and foam beside {:.3}, shown \
             {shown:.3}",
            fronts.foam,
            statistics::monahan_coverage(wind),
            drawn[0],
            drawn[1],
        );
        assert!(speed / cp > 0.15 && speed / cp < 0.5, "{speed} of {cp} m/s");
        assert!(slope > -8.5 && slope < -4.0, "slope {slope}");
        assert!((white / fronts.foam - 1.0).abs() < 0.25, "{white} of {}", fronts.foam);
        assert!((shown - 1.0).abs() < 0.04, "{shown}");
    }
}
