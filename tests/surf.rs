//! The shape of waves that come ashore (shaders/water/surf.wgsl): as skewed and as asymmetric as measured waves before they
//! break, with the slopes that its motion has, and nothing where waves are small.

mod common;

use common::wgsl;
use seastate::coast::Transfer;
use seastate::gpu::Gpu;
use seastate::oracle::coast::{CoastPoint, height_over_breaking, roller};
use seastate::render;
use seastate::shaders::Shaders;
use seastate::waves::noise;
use std::f64::consts::TAU;
use std::sync::Arc;
use wgpu::BindingResource::{Sampler, TextureView};

/// Shape, at the phase of the question, of a wave with an Ursell number, a height relative to that from which it breaks, and
/// a height times its wave number.
const SHAPE: &str = "
fn answer(q: Question) -> Answer {
  return Answer(vec4f(surf_shape(q[0].x, surf_form(q[0].y, q[0].z, q[0].w)), 0.0, 0.0));
}
";

/// Waves of height 1 and wave number 1 at even phases: position before the crest of the sine, and elevation. Each number
/// is the height of a wave relative to that from which it breaks.
fn waves(shaders: &Shaders, heights: &[f64]) -> Vec<Vec<[f64; 2]>> {
    let kernel = wgsl::Kernel::<1, 1>::new(&common::gpu(), shaders, "water/displace", SHAPE);
    let count = 2048;
    let phase = |i: usize| TAU * (i as f64 / count as f64 - 0.5);
    let question =
        |i, over: f64| [[phase(i), ursell(over * BREAKING_HEIGHT_M), over, STEEPNESS * over].map(|x| x as f32)];
    let of = |(i, [[forward, up, ..]]): (usize, [[f64; 4]; 1])| [phase(i) + forward, 0.5 * phase(i).cos() + up];
    let wave = |over: &f64| -> Vec<[f64; 2]> {
        let answers = kernel.ask(&(0..count).map(|i| question(i, *over)).collect::<Vec<_>>());
        answers.into_iter().enumerate().map(of).collect()
    };
    heights.iter().map(wave).collect()
}

/// Elevation that a gauge records of a wave, at even times: that of the top, where the front folds.
fn record(wave: &[[f64; 2]]) -> Vec<f64> {
    let count = 512;
    let mut top = vec![f64::NEG_INFINITY; count];
    for (&[x, y], &[next, end]) in wave.iter().zip(wave.iter().cycle().skip(1)) {
        let mut next = next;
        if next - x < -0.5 * TAU {
            next += TAU;
        }
        let steps = ((next - x).abs() / TAU * count as f64).ceil().max(1.0) as usize * 2;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let at = (x + share * (next - x)).rem_euclid(TAU) / TAU * count as f64;
            let cell = &mut top[at as usize % count];
            *cell = cell.max(y + share * (end - y));
        }
    }
    // Positions grow towards the shore, so that a gauge sees them in the opposite order.
    top.reverse();
    top
}

/// Means of the second power of a record of one wave, and of the third powers of it and of its Hilbert transform.
fn moments(record: &[f64]) -> [f64; 3] {
    let n = record.len();
    let coefficient = |k: usize| {
        let sum = |f: fn(f64) -> f64| -> f64 {
            record.iter().enumerate().map(|(i, y)| y * f(TAU * (k * i) as f64 / n as f64)).sum::<f64>() * 2.0 / n as f64
        };
        [sum(f64::cos), sum(f64::sin)]
    };
    let waves: Vec<[f64; 2]> = (1..64).map(coefficient).collect();
    let at = |i: usize, quarter: f64| -> f64 {
        let of = |(k, [a, b]): (usize, &[f64; 2])| {
            let (sin, cos) = (TAU * ((k + 1) * i) as f64 / n as f64 - quarter).sin_cos();
            a * cos + b * sin
        };
        waves.iter().enumerate().map(of).sum()
    };
    let mean = |power: i32, quarter: f64| (0..n).map(|i| at(i, quarter).powi(power)).sum::<f64>() / n as f64;
    [mean(2, 0.0), mean(3, 0.0), mean(3, 0.25 * TAU)]
}

/// Skewness and asymmetry of waves of the given heights, relative to that from which they break.
fn skewness_and_asymmetry(shaders: &Shaders, heights: &[f64]) -> [f64; 2] {
    let sum = heights.iter().zip(waves(shaders, heights)).fold([0.0; 3], |sum, (height, wave)| {
        let own = moments(&record(&wave));
        let powers = [2, 3, 3].map(|power| height.powi(power) / heights.len() as f64);
        std::array::from_fn(|i| sum[i] + powers[i] * own[i])
    });
    [1, 2].map(|i| sum[i] / sum[0].powf(1.5))
}

/// Skewness and asymmetry of the motion of waves near the bed, by their Ursell number (Ruessink, Ramaekers and van Rijn
/// 2012, fitted to measurements on beaches).
fn measured(ursell: f64) -> [f64; 2] {
    let all = 0.857 / (1.0 + ((-0.471 - ursell.log10()) / 0.297).exp());
    let turn = 0.25 * TAU * ((0.815 / ursell.powf(0.672)).tanh() - 1.0);
    [all * turn.cos(), all * turn.sin()]
}

/// Wave number of waves of 11 s in 3 m of water, rad/m; their depth, m; and height from which they break, m.
const WAVE_NUMBER: f64 = 0.107;
const DEPTH_M: f64 = 3.0;
const BREAKING_HEIGHT_M: f64 = 2.2;
/// Wave number times the height from which they break.
const STEEPNESS: f64 = WAVE_NUMBER * BREAKING_HEIGHT_M;

/// Ursell number of waves of a height or significant height, m.
fn ursell(height_m: f64) -> f64 {
    0.75 * 0.5 * height_m * WAVE_NUMBER / (DEPTH_M * WAVE_NUMBER).powi(3)
}

/// Waves in the surf: their heights are distributed as Rayleigh's up to those that break.
#[test]
fn surf_is_as_skewed_and_asymmetric_as_measured_waves_are() {
    let shaders = wgsl::shaders();
    for hs_m in [0.75, 1.0, 1.5] {
        let of_quantile = |i: usize| hs_m * (-(0.5 * ((i as f64 + 0.5) / 24.0).ln())).sqrt() / BREAKING_HEIGHT_M;
        let heights: Vec<f64> = (0..24).map(|i| of_quantile(i).min(1.0)).collect();
        let want = measured(ursell(hs_m));
        let got = skewness_and_asymmetry(&shaders, &heights);
        eprintln!("Hs {hs_m} m: skewness and asymmetry {got:.2?}, measured {want:.2?}");
        assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() < 0.25), "{got:?} {want:?}");
    }
    let [sine, half, breaks] = [0.002, 0.5, 1.0].map(|over| skewness_and_asymmetry(&shaders, &[over]));
    eprintln!("single waves: {sine:.2?} {half:.2?} {breaks:.2?}");
    assert!(sine.iter().all(|x| x.abs() < 0.01) && half[0] < breaks[0] && half[1] > breaks[1]);
    // The water stays where it is in the mean.
    let [wave] = &waves(&shaders, &[1.0])[..] else { panic!("one wave") };
    let mean = |f: &dyn Fn(&[f64; 2]) -> f64| wave.iter().map(f).sum::<f64>() / wave.len() as f64;
    let (level, variance) = (mean(&|[_, y]| *y), mean(&|[_, y]| y * y) / 0.125);
    eprintln!("mean level {level:.4}, variance {variance:.3} of that of a sine");
    assert!(level.abs() < 5e-3 && (variance - 1.0).abs() < 0.08, "{level} {variance}");
    // A planted fault: the back is squeezed instead of the front.
    let wrong = shaders.patched("water/displace", "let off = phase - SURF_FRONT_PHASE;", "let off = phase + 2.4;");
    let fault = skewness_and_asymmetry(&wrong, &[1.0]);
    assert!(fault[1] > 0.0, "{fault:?}");
}

/// Motion at the point of the question, its change over a step along x and z, and the derivatives that go with it.
const MOTION: &str = "
fn answer(q: Question) -> Answer {
  let at = q[0].xy;
  let step = q[0].z;
  let here = surf_motion(at);
  let east = surf_motion(at + vec2f(step, 0.0)).moved - surf_motion(at - vec2f(step, 0.0)).moved;
  let south = surf_motion(at + vec2f(0.0, step)).moved - surf_motion(at - vec2f(0.0, step)).moved;
  let c = frame.choppiness;
  let d = here.derivatives;
  return Answer(
    vec4f(here.moved, 0.0),
    vec4f(east, 0.0) / (2.0 * step), vec4f(south, 0.0) / (2.0 * step),
    vec4f(c.x * d.stretch.x, d.slope.x, c.y * d.shear.y, 0.0),
    vec4f(c.x * d.shear.x, d.slope.y, c.y * d.stretch.y, 0.0));
}
";

const STATE: &str = "coast=beach&depth=12&wind=3&fetch=10&dir=255&scale2=1&hs2=1.5&tp2=12&dir2=245&n=256&order=1";

/// Motions of points around `eye`: displacement, its differences along x and z, and its derivatives along x and z.
fn motions(gpu: &Gpu, shaders: &Shaders, transfer: &Arc<Transfer>, eye: [f64; 2], step_m: f32) -> Vec<[[f64; 4]; 5]> {
    let ocean = common::ocean_at_coast(gpu, STATE, transfer, eye, 40.0);
    let scene = ocean.scene([640, 360]);
    let maps = ocean.maps();
    let frame = render::frame_uniform(&scene, maps, [640, 360]);
    let frame = wgsl::buffer(gpu, bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
    let shaders =
        shaders.clone().patched("water/displace", "override WATER_COAST: bool = false;", "const WATER_COAST = true;");
    let mut kernel = wgsl::Kernel::<1, 5>::new(gpu, &shaders, "water/displace", MOTION);
    kernel.bind(0, &[(0, frame.as_entire_binding())]);
    let sampler = gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Nearest);
    let gains = &maps.coast.as_ref().expect("a coast").gains;
    kernel.bind(1, &[(0, TextureView(&maps.displacement)), (5, Sampler(&sampler)), (6, TextureView(gains))]);
    let place = |i: u32, axis: usize| (f64::from(noise::pcg4d([i, 7, 3, 5])[axis]) / 4_294_967_296.0 - 0.5) * 200.0;
    let places = (0..8000).map(|i| [place(i, 0), place(i, 1)]);
    // Nearer to the eye the squeeze changes with the distance from it, which slopes leave out.
    let places = places.filter(|[x, z]| x.hypot(*z) > 16.0);
    let questions: Vec<_> = places.map(|[x, z]| [[x as f32, z as f32, step_m, 0.0]]).collect();
    kernel.ask(&questions)
}

/// Relative rms difference between differences of the motion and its derivatives.
fn error(motions: &[[[f64; 4]; 5]]) -> f64 {
    let sum = |f: &dyn Fn(&[[f64; 4]; 5], usize, usize) -> f64| -> f64 {
        let of =
            |m| (0..2).flat_map(|axis| (0..3).map(move |i| (axis, i))).map(|(a, i)| f(m, a, i).powi(2)).sum::<f64>();
        motions.iter().map(of).sum()
    };
    (sum(&|m, axis, i| m[1 + axis][i] - m[3 + axis][i]) / sum(&|m, axis, i| m[1 + axis][i])).sqrt()
}

#[test]
fn surf_moves_as_its_slopes_tell_and_small_waves_do_not() {
    let gpu = common::gpu();
    let shaders = wgsl::shaders();
    let transfer = common::coast_transfer(&common::params(STATE), 120, 100);
    let beach = |shaders: &Shaders, step_m| motions(&gpu, shaders, &transfer, [470.0, 150.0], step_m);
    let patched = |right: &str, wrong: &str| shaders.clone().patched("water/displace", right, wrong);
    let ahead = "const SURF_LOBES_AHEAD = vec2f(1.8, 0.22);";
    let even = patched(ahead, "const SURF_LOBES_AHEAD = vec2f(0.0);");
    let surf = beach(&even, 0.1);
    let moving = surf.iter().filter(|m| m[0] != [0.0; 4]).count();
    let most = surf.iter().map(|m| m[0][0].hypot(m[0][2])).fold(0.0, f64::max);
    let own = error(&surf);
    let wrong =
        even.clone().patched("water/displace", "forward_change = (change.x", "forward_change = (0.8 * change.x");
    let fault = error(&beach(&wrong, 0.1));
    eprintln!(
        "{moving} of {} points move, by up to {most:.1} m; derivatives {own:.3}, with a fault {fault:.3}",
        surf.len()
    );
    assert!(moving > surf.len() / 4 && most > 2.0 && most < 20.0, "{moving} {most}");
    assert!(own < 0.1 && fault > 1.5 * own, "{own} {fault}");
    // The shape fades towards the waterline, which the derivatives know.
    let unfaded = error(&beach(&even.patched("water/displace", "shown.y * wave.deepening", "vec2f(0.0)"), 0.1));
    eprintln!("derivatives without the fading {unfaded:.3}");
    assert!(unfaded > 1.2 * own, "{own} {unfaded}");
    // Lobes meet in creases, so a step must be short.
    let lobed = error(&beach(&shaders, 0.01));
    let forgotten = error(&beach(&patched("let turn = wave.turn - ahead.yz;", "let turn = wave.turn;"), 0.01));
    eprintln!("derivatives with lobes {lobed:.3}, with those of the lobes forgotten {forgotten:.3}");
    assert!(lobed < 0.15 && forgotten > 2.0 * lobed, "{lobed} {forgotten}");
    // Seaward of the coast's square nothing moves by even one bit.
    let offshore = motions(&gpu, &shaders, &transfer, [-4000.0, 0.0], 0.1);
    assert!(offshore.iter().all(|m| m[0] == [0.0; 4] && m[3] == [0.0; 4]));
}

/// Rolling foam of the wave whose half amplitude and relative height the question holds.
const ROLLER: &str = "
fn answer(q: Question) -> Answer {
  return Answer(vec4f(foam_roller(q[0].xy, q[0].z)));
}
";

#[test]
fn rollers_are_those_of_the_oracle() {
    let point = |i: u32| {
        let [phase, height, ..] = noise::pcg4d([i, 1, 2, 3]).map(|h| f64::from(h) / 4_294_967_296.0);
        let (sin, cos) = (TAU * phase).sin_cos();
        let size_m = 0.25 * (1.0 + 2.0 * height);
        CoastPoint {
            half_amplitude_m: [size_m * cos, size_m * sin],
            inverse_breaking_height: 0.5,
            ..CoastPoint::default()
        }
    };
    let points: Vec<CoastPoint> = (0..2000).map(point).collect();
    let error = |shaders: &Shaders| {
        let kernel = wgsl::Kernel::<1, 1>::new(&common::gpu(), shaders, "foam/foam", ROLLER);
        let question = |p: &CoastPoint| {
            let [re, im] = p.half_amplitude_m;
            [[re, im, height_over_breaking(p), 0.0].map(|x| x as f32)]
        };
        let got = kernel.ask(&points.iter().map(question).collect::<Vec<_>>());
        points.iter().zip(got).map(|(p, [[got, ..]])| (got - roller(p)).abs()).fold(0.0, f64::max)
    };
    let own = error(&wgsl::shaders());
    let wrong = wgsl::shaders().patched("foam/foam", "vec2f(0.5, 0.866)", "vec2f(0.57, 0.82)");
    let fault = error(&wrong);
    eprintln!("largest error {own:.1e}, with a fault {fault:.3}");
    assert!(own < 1e-4 && fault > 0.02, "{own} {fault}");
}
