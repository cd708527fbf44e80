//! The drawn surface, from the WGSL functions of the picture in a compute kernel: it equals the sea of
//! `point::StrongestWaves`, does not depend on the camera position, and does not repeat.

mod common;

use common::{params, wgsl};
use seastate::gpu::Gpu;
use seastate::ocean::{Ocean, OutputKind};
use seastate::oracle::foam::MipLevel;
use seastate::oracle::{self, Texel, surface};
use seastate::point::{StrongestWaves, SurfaceSample};
use seastate::render;
use seastate::shaders::Shaders;
use seastate::state::Params;
use seastate::waves::{Plan, noise};
use std::f64::consts::TAU;

/// The question is a point beside the eye's foot (x, z), the texel size of a sample, m, and the length of the pixel, m.
const ANSWER: &str = "
// A covariance is a sum of products of slopes, and is mapped as these slopes are.
fn covariance_error() -> f32 {
  let sums = WaterDerivatives(vec2f(0.0), vec2f(-0.2, 0.1), vec2f(0.15, 0.1));
  let sides = 1.0 + frame.choppiness * sums.stretch;
  let jacobian = water_jacobian(sums, sides);
  let a = vec2f(0.1, 0.02);
  let b = vec2f(-0.03, 0.08);
  let of_slopes = maths_self_products(water_slope_displaced(a, sums, sides) / jacobian)
    + maths_self_products(water_slope_displaced(b, sums, sides) / jacobian);
  let mapped = water_covariance_displaced(maths_self_products(a) + maths_self_products(b), sums, jacobian);
  return length(mapped - of_slopes) / length(of_slopes);
}
fn answer(question: Question) -> Answer {
  let q = question[0];
  let width_m = q.z / WATER_TAP_TEXEL_RATIO;
  let foot = water_footprint(vec2f(max(q.w, width_m), 0.0), vec2f(0.0, width_m));
  let moved = water_displacement(q.xy, q.z, false).displacement;
  let slope = water_slope(q.xy, moved, foot);
  let vertex = water_displacement(q.xy, 1.5 * mesh_spacing(length(q.xy)), true);
  let split = water_slope_with_carried(q.xy, moved, foot, foot, vertex.carried, true, 1.0);
  return Answer(
    vec4f(moved, covariance_error()),
    vec4f(slope.mean, slope.jacobian, 0.0),
    vec4f(slope.variance, 0.0),
    vec4f(split.mean, length(vertex.carried.slope), 0.0));
}
";

/// The drawn sea at an undisplaced point.
#[derive(Clone, Copy)]
struct Drawn {
    moved: [f64; 3],
    slope: [f64; 2],
    jacobian: f64,
    /// xx, zz, xz.
    variance: [f64; 3],
    /// Slope as the sum of the vertex's and the pixel's part, and the length of the vertex's part before chop.
    split: [f64; 2],
    carried: f64,
    /// Relative error of a covariance that is mapped to the displaced surface.
    covariance_error: f64,
}

/// Size of the picture in the frame uniform.
const PIXELS: [u32; 2] = [1280, 720];

/// A sea at one time, with the kernel that reads its surface.
struct Bench {
    gpu: Gpu,
    ocean: Ocean,
    params: Params,
    kernel: wgsl::Kernel<1, 4>,
}

impl Bench {
    fn new(state: &str) -> Self {
        Self::with_shaders(state, &wgsl::shaders())
    }

    fn with_shaders(state: &str, shaders: &Shaders) -> Self {
        let gpu = common::gpu();
        let params = params(state);
        let mut ocean = Ocean::new(&gpu, wgpu::TextureFormat::Rgba8Unorm, OutputKind::Screen, &params);
        let mut kernel = wgsl::Kernel::new(&gpu, shaders, "water/light", ANSWER);
        common::bind_maps(&mut kernel, &gpu, ocean.simulation());
        let mut bench = Self { gpu, ocean, params, kernel };
        bench.evolve();
        bench
    }

    fn evolve(&mut self) {
        let mut encoder = self.gpu.encoder("test");
        self.ocean.simulation().encode_with_f32_maps(&self.gpu, &mut encoder, self.params.clock.t_s);
        self.gpu.submit(encoder);
    }

    /// The surface at undisplaced points (x, z), m, for a camera above `foot` and samples with texels of `size`
    /// metres, in pixels that are `long` metres long in one direction if that is longer.
    fn ask(&mut self, foot: [f64; 2], points: &[[f64; 2]], size: f64, long: f64) -> Vec<Drawn> {
        [self.params.camera.x_m, self.params.camera.z_m] = foot;
        self.ocean.set_params(&self.params);
        let mut scene = self.ocean.scene(PIXELS);
        // Without the slopes that the cascades do not resolve.
        scene.sea.unresolved_slope_variance = [0.0; 2];
        let frame = render::frame_uniform(&scene, self.ocean.simulation().maps(), PIXELS);
        let frame = wgsl::buffer(&self.gpu, bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
        self.kernel.bind(0, &[(0, frame.as_entire_binding())]);
        let questions: Vec<[[f32; 4]; 1]> = (points.iter())
            .map(|p| [[(p[0] - foot[0]) as f32, (p[1] - foot[1]) as f32, size as f32, long as f32]])
            .collect();
        let drawn = |a: [[f64; 4]; 4]| {
            let [[x, y, z, covariance_error], [sx, sz, jacobian, _], [xx, zz, xz, _], [split_x, split_z, carried, _]] =
                a;
            let split = [split_x, split_z];
            Drawn {
                moved: [x, y, z],
                slope: [sx, sz],
                jacobian,
                variance: [xx, zz, xz],
                split,
                carried,
                covariance_error,
            }
        };
        self.kernel.ask(&questions).into_iter().map(drawn).collect()
    }
}

/// Random points in a square around `middle`, m.
fn places(count: usize, middle: [f64; 2], side_m: f64) -> Vec<[f64; 2]> {
    let place = |i: usize| {
        let hash = noise::pcg4d([i as u32, 77, 3, 5]);
        [0, 1].map(|axis| middle[axis] + (f64::from(hash[axis]) / 4_294_967_296.0 - 0.5) * side_m)
    };
    (0..count).map(place).collect()
}

/// The position of the cascade's texel nearest to each point.
fn texels(plan: &Plan, cascade: usize, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let texel_m = plan.cascades[cascade].patch_m / f64::from(plan.n);
    points.iter().map(|p| p.map(|x| (x / texel_m).round() * texel_m)).collect()
}

/// Rms errors of the displacement, slope and Jacobian against `sea`, relative to their rms values. Slopes near folds,
/// which the shader limits, do not count.
fn errors(drawn: &[Drawn], sea: &StrongestWaves, points: &[[f64; 2]], t_s: f64) -> [f64; 3] {
    let mut sums = [[0.0; 2]; 3];
    for (drawn, at) in drawn.iter().zip(points) {
        let SurfaceSample { height_m, normal, world_xz, jacobian, .. } = sea.sample_undisplaced(at[0], at[1], t_s);
        let mut add = |what: usize, got: f64, want: f64| {
            sums[what][0] += (got - want).powi(2);
            sums[what][1] += want.powi(2);
        };
        let moved = [world_xz[0] - at[0], height_m, world_xz[1] - at[1]];
        (0..3).for_each(|i| add(0, drawn.moved[i], moved[i]));
        if jacobian > 0.35 {
            let slope = [-normal[0] / normal[1], -normal[2] / normal[1]];
            if slope[0].hypot(slope[1]) < 1.5 {
                (0..2).for_each(|i| add(1, drawn.slope[i], slope[i]));
            }
        }
        add(2, drawn.jacobian - 1.0, jacobian - 1.0);
    }
    sums.map(|[error, size]| (error / size).sqrt())
}

#[test]
fn the_drawn_surface_is_the_sea_of_heights() {
    // At the texels of a single cascade the surface is exact, for any position and time.
    for (state, foot) in [
        ("wind=12&fetch=200&t=20&n=64&cascades=1", [12.3, -45.6]),
        ("wind=12&fetch=200&t=1000000.25&n=64&cascades=1&chopx=0.6", [100_000.0, -99_987.7]),
        ("wind=12&fetch=200&t=20&n=64&cascades=1&seed=9", [-1e6, 1e6]),
        ("wind=12&fetch=200&t=20&n=64&cascades=1&untile=0", [1e6, 1e6]),
    ] {
        let mut bench = Bench::new(state);
        let plan = bench.ocean.plan().clone();
        let points = texels(&plan, 0, &places(4000, foot, 12_000.0));
        let drawn = bench.ask(foot, &points, 1e-3, 0.0);
        let errors = errors(&drawn, &StrongestWaves::new(&plan, usize::MAX), &points, bench.params.clock.t_s);
        eprintln!("{state}: {errors:?}");
        // Errors of half floats, and of positions in f32 relative to the camera.
        assert!(errors[0] < 1e-3 && errors[1] < 2e-3 && errors[2] < 2e-3, "{state}: {errors:?}");
    }
    // Between texels of all cascades: the interpolation error, which is largest for the shortest waves.
    let mut bench = Bench::new("wind=12&fetch=200&t=20&n=256");
    let plan = bench.ocean.plan().clone();
    let points = places(600, [300.0, 500.0], 8_000.0);
    let drawn = bench.ask([300.0, 500.0], &points, 1e-3, 0.0);
    let errors = errors(&drawn, &StrongestWaves::new(&plan, usize::MAX), &points, 20.0);
    eprintln!("between texels: {errors:?}");
    assert!(errors[0] < 2e-3 && errors[1] < 0.15 && errors[2] < 0.15, "{errors:?}");
}

/// Relative rms error of the bound waves' height that the shaders draw, against the oracle, at texels of both cascades.
fn bound_wave_error(shaders: &Shaders) -> f64 {
    // Every texel of the first cascade is one of the second.
    let state = "wind=12&fetch=200&t=20&n=64&cascades=2&patch1=512&patch2=128";
    let heights = |order: u32| -> (Bench, Vec<[f64; 2]>, Vec<f64>) {
        let mut bench = Bench::with_shaders(&format!("{state}&order={order}"), shaders);
        let points = texels(bench.ocean.plan(), 0, &places(2000, [0.0; 2], 12_000.0));
        let drawn = bench.ask([0.0; 2], &points, 1e-3, 0.0).iter().map(|d| d.moved[1]).collect();
        (bench, points, drawn)
    };
    let ((_, _, first), (bench, points, second)) = (heights(1), heights(2));
    let plan = bench.ocean.plan();
    let [linear, whole] = [1, 2].map(|order| {
        let mut plan = plan.clone();
        plan.sea.wave_order = order;
        StrongestWaves::new(&plan, usize::MAX)
    });
    let mut sums = [0.0; 2];
    for (i, at) in points.iter().enumerate() {
        let [a, b] = [&linear, &whole].map(|sea| sea.sample_undisplaced(at[0], at[1], 20.0).height_m);
        sums = [sums[0] + (second[i] - first[i] - (b - a)).powi(2), sums[1] + (b - a).powi(2)];
    }
    (sums[0] / sums[1]).sqrt()
}

/// Half floats give the bound waves an error of 2.5e-4; faults of 1 % are found.
#[test]
fn bound_waves_are_drawn() {
    const TOLERANCE: f64 = 8e-4;
    let right = bound_wave_error(&wgsl::shaders());
    eprintln!("bound waves: {right:.2e}");
    assert!(right < TOLERANCE, "{right}");
    for (line, fault) in [
        ("0.5 * map.bound_own.yxy * own", "0.505 * map.bound_own.yxy * own"),
        ("longer += map.bound_with_shorter.yxy * own", "longer += 1.01 * map.bound_with_shorter.yxy * own"),
        ("map.bound_own.yxy * own + longer", "map.bound_own.yxy * own + 0.99 * longer"),
        ("0.5 * map.bound_own.yxy", "0.5 * map.bound_own.xxx"),
        ("+ level * map.bound_level_m", "+ 0.9 * map.bound_level_m"),
    ] {
        let shaders = wgsl::shaders().patched("water/light", line, fault);
        let wrong = bound_wave_error(&shaders);
        eprintln!("{fault}: {wrong:.2e}");
        assert!(wrong > TOLERANCE, "not found: {fault}: {wrong}");
    }
}

#[test]
fn the_sea_stays_where_it_is() {
    for middle in [[0.0, 0.0], [100_000.0, 100_000.0], [999_000.0, -999_000.0]] {
        let mut bench = Bench::new("wind=10&fetch=100&t=5&n=64");
        let points = places(2000, middle, 300.0);
        let eye = |dx: f64, dz: f64| [middle[0] + dx, middle[1] + dz];
        let hs = bench.ocean.plan().hs_m();
        let here = bench.ask(eye(0.0, 0.0), &points, 1e-3, 0.0);
        for foot in [eye(37.31, -81.92), eye(-900.7, 450.3)] {
            let there = bench.ask(foot, &points, 1e-3, 0.0);
            for (a, b) in here.iter().zip(&there) {
                let off = (0..3).map(|i| (a.moved[i] - b.moved[i]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-3 * hs, "{middle:?} {foot:?}: {off} m");
            }
            let rms = |f: &dyn Fn(&Drawn, &Drawn) -> f64| {
                (here.iter().zip(&there).map(|(a, b)| f(a, b).powi(2)).sum::<f64>() / here.len() as f64).sqrt()
            };
            let slope = rms(&|a, b| a.slope[0] - b.slope[0]) / rms(&|a, _| a.slope[0]);
            assert!(slope < 2e-2, "{middle:?} {foot:?}: {slope}");
        }
    }
}

#[test]
fn the_mesh_is_finer_than_what_it_shows() {
    for (state, pixels) in
        [("wind=12&fetch=150&n=256&t=20", 720.0), ("wind=12&fetch=150&n=256&t=20&y=60&pitch=-10", 720.0)]
    {
        let mut bench = Bench::new(state);
        let scene = bench.ocean.scene([1280, 720]);
        let lattice = render::frame_uniform(&scene, bench.ocean.simulation().maps(), [1280, 720]).mesh_lattice;
        let [scale, turn, step] =
            [lattice.linear_radius_m, lattice.azimuth_step, lattice.log_radius_step].map(f64::from);
        let pixel = 2.0 * scene.view.tan_half_fov[1] / pixels;
        for radius in [10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0] {
            // The formula of `mesh_spacing` in WGSL.
            let spacing = f64::max((radius + scale) * step, radius * turn);
            let rest: Vec<[f64; 2]> = (0..1000)
                .map(|i| {
                    let (sin, cos) = (TAU * f64::from(i) / 1000.0).sin_cos();
                    [radius * sin, -radius * cos]
                })
                .collect();
            let beside = |sign: f64| -> Vec<[f64; 2]> {
                rest.iter().map(|p| p.map(|x| x * (1.0 + sign * 0.5 * spacing / radius))).collect()
            };
            let mut heights = |points: &[[f64; 2]]| -> Vec<f64> {
                bench.ask([0.0; 2], points, spacing, 0.0).iter().map(|d| d.moved[1]).collect()
            };
            let [middle, before, after] = [&rest, &beside(-1.0), &beside(1.0)].map(|points| heights(points));
            let bend = (0..rest.len()).map(|i| (middle[i] - 0.5 * (before[i] + after[i])).powi(2)).sum::<f64>();
            let seen = (bend / rest.len() as f64).sqrt() / radius.hypot(scene.view.eye.y) / pixel;
            eprintln!("{state}: at {radius} m, {spacing:.2} m from row to row: {seen:.3} pixels");
            assert!(seen < 0.5, "{state} at {radius} m: {seen} pixels");
        }
    }
}

/// Vertices carry the slopes of long waves and pixels add the slopes of short waves. At a vertex their sum is the slope
/// of all waves, for any resolution of the maps.
#[test]
fn a_vertex_and_a_pixel_share_the_slopes() {
    for state in ["n=64", "n=256", "n=256&y=60", "n=512&y=60", "n=1024&cascades=2&y=60"] {
        let mut bench = Bench::new(&format!("wind=12&fetch=150&t=20&{state}"));
        for side_m in [20.0, 200.0, 2000.0] {
            let points = places(2000, [0.0; 2], side_m);
            let drawn = bench.ask([0.0; 2], &points, 1e-3, 0.0);
            let drawn = drawn.iter().filter(|d| d.jacobian > 0.35);
            let [mut whole, mut off, mut carried] = [0.0; 3];
            for d in drawn {
                whole += d.slope[0].hypot(d.slope[1]);
                off += (d.split[0] - d.slope[0]).hypot(d.split[1] - d.slope[1]);
                carried += d.carried;
            }
            eprintln!("{state}, over {side_m} m: off by {:.4}, {:.2} carried", off / whole, carried / whole);
            assert!(off < 0.01 * whole, "{state}, over {side_m} m: {off} of {whole}");
            assert!(side_m > 20.0 || carried > 0.1 * whole, "{state}: {carried} of {whole}");
        }
    }
}

/// Pixels of a chopless sea for [`mean_squares`].
fn pixels(bench: &mut Bench, size: f64, long: f64) -> Vec<Drawn> {
    bench.ask([0.0; 2], &places(20_000, [0.0; 2], 60_000.0), size, long)
}

/// Mean square slope that a pixel resolves, and the total with the variance inside the pixel, without chop.
fn mean_squares(bench: &mut Bench, size: f64, long: f64) -> [f64; 2] {
    let drawn = pixels(bench, size, long);
    let resolved: f64 = drawn.iter().map(|d| d.slope[0].powi(2) + d.slope[1].powi(2)).sum();
    let hidden: f64 = drawn.iter().map(|d| d.variance[0] + d.variance[1]).sum();
    [resolved, resolved + hidden].map(|s| s / drawn.len() as f64)
}

#[test]
fn slopes_that_a_pixel_cannot_resolve_are_not_lost() {
    for untile in ["", "&untile=0"] {
        let mut bench = Bench::new(&format!("wind=10&fetch=100&t=5&n=256&chop=0{untile}"));
        let plan = bench.ocean.plan().clone();
        let whole = plan.resolved_slope_variance_below(f64::INFINITY);
        let mut before = f64::INFINITY;
        // Pixels from a fraction of the finest texel to more than the largest patch; long pixels too.
        let texel = plan.cascades[plan.cascades.len() - 1].patch_m / f64::from(plan.n);
        for step in -1..9 {
            let size = texel * 3.5f64.powi(step);
            let [resolved, all] = mean_squares(&mut bench, size, 0.0);
            let [_, oblong] = mean_squares(&mut bench, size, 2.9 * size);
            let [_, long] = mean_squares(&mut bench, size, 5.0 * size);
            let [_, longest] = mean_squares(&mut bench, size, 40.0 * size);
            eprintln!(
                "pixel of {size:.3} m{untile}: {:.4} of {:.4}, {:.4}, {:.4}, {:.4}",
                resolved / whole,
                all / whole,
                oblong / whole,
                long / whole,
                longest / whole
            );
            // The largest pixels resolve no slope at all.
            assert!(resolved < before || (resolved, before) == (0.0, 0.0), "{size} m{untile}");
            if step < 0 {
                // Between texels the spline damps the shortest waves.
                assert!((0.96..1.01).contains(&(all / whole)), "{size} m{untile}");
            } else {
                let off = [all, oblong, long].map(|sum| (sum / whole - 1.0).abs()).into_iter().fold(0.0, f64::max);
                assert!(off < 0.03, "{size} m{untile}: {off}");
                // A sample of a very long pixel may be steeper than the mean around it. A part of the variance is left
                // then, too, so that the sum is a little too large.
                assert!((longest / whole - 1.0).abs() < 0.04, "{size} m{untile}");
            }
            before = resolved;
        }
        assert!(before < 1e-3 * whole, "{before}");
    }
}

/// Steep pixels keep a part of the variance: those that lost it were dots, dark or bright, among pixels that have it.
#[test]
fn steep_pixels_keep_variance() {
    // Share of the pixels, as long as waves that they resolve in part, with less than a tenth of the mean variance.
    let without = |shaders: &Shaders| {
        let mut bench = Bench::with_shaders("wind=10&fetch=100&t=5&n=256&chop=0", shaders);
        let plan = bench.ocean.plan();
        let texel = plan.cascades[plan.cascades.len() - 1].patch_m / f64::from(plan.n);
        let drawn = pixels(&mut bench, texel, 4.0 * texel);
        let mean = drawn.iter().map(|d| d.variance[0]).sum::<f64>() / drawn.len() as f64;
        drawn.iter().filter(|d| d.variance[0] < 0.1 * mean).count() as f64 / drawn.len() as f64
    };
    let fault =
        [("LEAST_UNRESOLVED = 0.2;", "LEAST_UNRESOLVED = 0.0;"), ("RESOLVED_FACTOR = 1.2;", "RESOLVED_FACTOR = 1.0;")]
            .into_iter()
            .fold(wgsl::shaders(), |shaders, (from, to)| shaders.patched("water/light", from, to));
    let [right, wrong] = [without(&wgsl::shaders()), without(&fault)];
    eprintln!("pixels without variance: {right:.4}; {wrong:.4} with the difference of moments");
    assert!(right < 0.03 && wrong > 0.06, "{right} {wrong}");
}

/// Mean square slope in pixels as the shaders tell it, divided by that of the displaced surface in them by area: for
/// the tenth of the pixels that lie most squeezed on crests, and for the tenth most stretched in troughs. Then the
/// error of a covariance that is mapped.
fn steepness_of_pixels(shaders: &Shaders) -> [f64; 3] {
    const PIXEL_M: f64 = 1.5;
    const SIDE: usize = 12;
    let mut bench = Bench::with_shaders("wind=10&fetch=100&t=5&n=256", shaders);
    let places = places(1500, [0.0; 2], 3000.0);
    // The texels of a sample of the pixel: WATER_TAP_TEXEL_RATIO times its width.
    let pixels = bench.ask([0.0; 2], &places, 0.58 * PIXEL_M, 0.0);
    let inner: Vec<[f64; 2]> = places
        .iter()
        .flat_map(|p| {
            (0..SIDE * SIDE).map(move |i| {
                let off = [i % SIDE, i / SIDE].map(|k| (k as f64 + 0.5) / SIDE as f64 - 0.5);
                [p[0] + PIXEL_M * off[0], p[1] + PIXEL_M * off[1]]
            })
        })
        .collect();
    let square = |d: &Drawn| d.slope[0].powi(2) + d.slope[1].powi(2);
    let fine = bench.ask([0.0; 2], &inner, 1e-3, 0.0);
    let mut ratios: Vec<[f64; 3]> = pixels
        .iter()
        .zip(fine.chunks(SIDE * SIDE))
        .map(|(pixel, inner)| {
            let area: f64 = inner.iter().map(|d| d.jacobian).sum();
            let steep: f64 = inner.iter().map(|d| d.jacobian * square(d)).sum();
            [pixel.jacobian, square(pixel) + pixel.variance[0] + pixel.variance[1], steep / area]
        })
        .collect();
    ratios.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let tenth = ratios.len() / 10;
    let [crests, troughs] = [&ratios[..tenth], &ratios[ratios.len() - tenth..]]
        .map(|set| set.iter().map(|r| r[1]).sum::<f64>() / set.iter().map(|r| r[2]).sum::<f64>());
    [crests, troughs, pixels[0].covariance_error]
}

/// Waves inside a pixel are steeper on the crest of a longer wave and flatter in its trough.
#[test]
fn slopes_in_a_pixel_are_those_of_the_displaced_surface() {
    const TOLERANCE: f64 = 0.08;
    let off = |shaders: &Shaders| {
        let [crests, troughs, mapped] = steepness_of_pixels(shaders);
        eprintln!("steepness told by steepness found: {crests:.3} on crests, {troughs:.3} in troughs; {mapped:.1e}");
        [(crests - 1.0).abs(), (troughs - 1.0).abs(), 1e3 * mapped].into_iter().fold(0.0, f64::max)
    };
    let right = off(&wgsl::shaders());
    assert!(right < TOLERANCE, "{right}");
    for (line, fault) in [
        ("var out = water_covariance_displaced(of_maps, waves.sums, jacobian);", "var out = of_maps;"),
        ("let shear = -frame.choppiness", "let shear = frame.choppiness"),
        ("over * mat2x2f(sides.y, shear.x, shear.y, sides.x)", "over * mat2x2f(sides.x, shear.x, shear.y, sides.y)"),
        ("with_bound * with_bound * waves.variance", "waves.variance"),
    ] {
        let wrong = off(&wgsl::shaders().patched("water/light", line, fault));
        assert!(wrong > TOLERANCE, "not found: {line}: {wrong}");
    }
}

/// Oracle of the drawn fields of a sea at 30 s, for each cascade.
struct Twin {
    plan: Plan,
    maps: Vec<oracle::maps::CascadeMapPair>,
}

impl Twin {
    fn new(state: &str) -> Self {
        let plan = Plan::new(&params(state));
        let map = |cascade| {
            let h0 = oracle::spectrum::initial_spectrum(&plan, cascade);
            oracle::maps::transform_columns(plan.n as usize, &oracle::maps::transform_rows(&plan, cascade, &h0, 30.0))
        };
        let maps = plan.cascades.iter().map(map).collect();
        Self { plan, maps }
    }

    fn at(&self, cascade: usize, at: [f64; 2]) -> surface::WaveFields {
        let [displacement, gradients] = &self.maps[cascade];
        let level = MipLevel { n: self.plan.n as usize, displacement, gradients };
        let half = 0.5 / f64::from(self.plan.n);
        surface::blend_patch_copies(&self.plan.tiling(&self.plan.cascades[cascade]), at, |place| {
            oracle::foam::sample_bilinear(&level, place.map(|p| p + half))
        })
    }

    fn heave_waves(&self, at: [f64; 2]) -> Vec<f64> {
        (0..self.maps.len()).map(|c| self.at(c, at).displacement[1]).collect()
    }

    /// Mean of a function over the texels of one map of a cascade.
    fn mean(&self, cascade: usize, plane: usize, f: impl Fn(&Texel) -> f64) -> f64 {
        let texels: &[Texel] = &self.maps[cascade][plane];
        texels.iter().map(f).sum::<f64>() / texels.len() as f64
    }
}

/// A lag along a lattice vector of a cascade, with the autocorrelations of the cascade's heights and of the whole sea.
struct Lag {
    cascade: usize,
    length_m: f64,
    own: f64,
    whole: f64,
}

/// Autocorrelations of the drawn heights along the lattice vectors of every cascade, for lags up to 20 km.
fn correlations(sea: &Twin) -> Vec<Lag> {
    let points = places(3000, [0.0; 2], 400_000.0);
    let here: Vec<Vec<f64>> = points.iter().map(|&p| sea.heave_waves(p)).collect();
    let cascades = 0..sea.plan.cascades.len();
    let square: Vec<f64> = cascades.clone().map(|c| here.iter().map(|h| h[c] * h[c]).sum()).collect();
    let sum = |h: &[f64]| h.iter().sum::<f64>();
    let whole: f64 = here.iter().map(|h| sum(h).powi(2)).sum();
    let mut out = Vec::new();
    for c in cascades {
        let patch_m = sea.plan.cascades[c].patch_m;
        for [a, b] in [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, -1.0], [2.0, 1.0]] {
            let mut times = 1.0f64;
            while times * patch_m * f64::hypot(a, b) <= 20_000.0 {
                let lag = [a, b].map(|i| i * times * patch_m);
                let there: Vec<Vec<f64>> =
                    points.iter().map(|p| sea.heave_waves([p[0] + lag[0], p[1] + lag[1]])).collect();
                let pairs = || here.iter().zip(&there);
                let own: f64 = pairs().map(|(h, t)| h[c] * t[c]).sum();
                let all: f64 = pairs().map(|(h, t)| sum(h) * sum(t)).sum();
                out.push(Lag { cascade: c, length_m: lag[0].hypot(lag[1]), own: own / square[c], whole: all / whole });
                // All small multiples, then increasingly sparse ones.
                times = (1.4 * times).floor().max(times + 1.0);
            }
        }
    }
    out
}

const SEA: &str = "wind=12&fetch=150&n=64";

#[test]
fn nothing_repeats() {
    let sea = Twin::new(SEA);
    // Lags longer than the groups of the peak waves.
    let groups_m = 6.0 * TAU / sea.plan.dispersion.wave_number(sea.plan.omega_p);
    let (mut own, mut whole) = (0.0f64, 0.0f64);
    let lags = correlations(&sea);
    assert!(lags.len() > 150);
    for lag in &lags {
        own = own.max(lag.own.abs());
        if lag.length_m > groups_m {
            whole = whole.max(lag.whole.abs());
        }
    }
    eprintln!("{} lags: largest correlation of a cascade {own:.3}, of the sea {whole:.3}", lags.len());
    assert!(own < 0.2 && whole < 0.2, "{own} {whole}");

    // Without tiling the same measure finds the period of every patch.
    let plain = Twin::new(&format!("{SEA}&untile=0"));
    let m0: Vec<f64> = (0..plain.maps.len()).map(|c| plain.mean(c, 0, |d| d[1] * d[1])).collect();
    let total: f64 = m0.iter().sum();
    let plain_lags = correlations(&plain);
    assert!(plain_lags.iter().all(|lag| lag.own > 0.999));
    for (c, m0) in m0.iter().enumerate() {
        // The other cascades have arbitrary phases there and increase or decrease the correlation.
        let far = plain_lags.iter().filter(|lag| lag.cascade == c && lag.length_m > groups_m);
        let (peak, share) = (far.map(|lag| lag.whole).fold(0.0, f64::max), m0 / total);
        eprintln!("cascade {c} repeats with up to {peak:.3}, and holds {share:.3} of the energy");
        assert!(peak > share - 0.05 && (c > 0 || peak > 0.5), "cascade {c}: {peak} {share}");
    }
}

#[test]
fn the_blend_keeps_heights_and_slopes() {
    for state in [SEA, "wind=12&n=64&scale2=1&scale=0.3"] {
        let sea = Twin::new(state);
        let (mut m0, mut mss, mut exact) = (0.0, 0.0, [0.0; 2]);
        let points = places(40_000, [0.0; 2], 1_000_000.0);
        for c in 0..sea.maps.len() {
            exact[0] += sea.mean(c, 0, |d| d[1] * d[1]);
            exact[1] += sea.mean(c, 1, |g| g[0] * g[0] + g[1] * g[1]);
            // At texels, where interpolation is exact.
            for at in texels(&sea.plan, c, &points) {
                let point = sea.at(c, at);
                m0 += point.displacement[1].powi(2) / points.len() as f64;
                mss += (point.slope[0].powi(2) + point.slope[1].powi(2)) / points.len() as f64;
            }
        }
        let hs = (m0 / exact[0]).sqrt();
        eprintln!("{state}: Hs {hs:.4}, mss {:.4} of the patches'", mss / exact[1]);
        assert!((hs - 1.0).abs() < 0.02 && (mss / exact[1] - 1.0).abs() < 0.02, "{state}: {hs} {}", mss / exact[1]);
    }
}

/// A buoy floats on the drawn surface with an rms error below 3 % of Hs.
#[test]
fn a_buoy_floats_on_what_is_drawn() {
    use seastate::point::floating::{HullWaves, hull_pose};
    use seastate::state::floats::{FloatingObject, FloatingObjectKind};
    for state in ["wind=10&fetch=100&n=128&t=20", "wind=24&fetch=500&n=128&t=900", "wind=3&fetch=20&n=128&level=5&t=7"]
    {
        let mut bench = Bench::new(state);
        let plan = bench.ocean.plan().clone();
        let waves = HullWaves::new(&plan);
        let buoys: Vec<[f64; 2]> = places(24, [0.0; 2], 400.0);
        let (mut sum, mut count, mut lost) = (0.0, 0, 0);
        // Frames of 1/60 s, then frames of 1/10 s.
        let times = (0..6).map(|i| f64::from(i) / 60.0).chain((1..6).map(|i| f64::from(i) / 10.0));
        let start_s = bench.params.clock.t_s;
        for t_s in times.map(|t| start_s + t) {
            bench.params.clock.t_s = t_s;
            bench.evolve();
            // Iterate for the undisplaced positions of the water drawn at the buoys.
            let mut rest = buoys.clone();
            let mut drawn = bench.ask([0.0; 2], &rest, 0.02, 0.0);
            for _ in 0..40 {
                for (i, at) in rest.iter_mut().enumerate() {
                    for (axis, side) in [0, 2].into_iter().enumerate() {
                        at[axis] -= 0.7 * (at[axis] + drawn[i].moved[side] - buoys[i][axis]);
                    }
                }
                drawn = bench.ask([0.0; 2], &rest, 0.02, 0.0);
            }
            for ((at, rest), drawn) in buoys.iter().zip(&rest).zip(&drawn) {
                if (rest[0] + drawn.moved[0] - at[0]).hypot(rest[1] + drawn.moved[2] - at[1]) > 0.01 {
                    lost += 1;
                    continue;
                }
                let float = FloatingObject { kind: FloatingObjectKind::Buoy, x_m: at[0], z_m: at[1] };
                let pose = hull_pose(&[(&waves, 1.0)], &float, t_s, plan.sea.still_water_level_m);
                sum += (pose.position_m[1] - plan.sea.still_water_level_m - drawn.moved[1]).powi(2);
                count += 1;
            }
        }
        let apart = (sum / f64::from(count)).sqrt() / plan.hs_m();
        eprintln!("{state}: {:.2} % of Hs, {lost} of {} in folds", 100.0 * apart, count + lost);
        assert!(apart < 0.03 && lost * 20 < count, "{state}: {apart}");
    }
}
