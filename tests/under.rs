//! A diving eye: Snell's window, total reflection, the attenuation of daylight against Jerlov's tables, the focused
//! sunlight, and the waterline across the lens.

mod common;

use common::wgsl::{self, shaders};
use common::{Pictures, params};
use seastate::gpu::Gpu;
use seastate::gpu::readback::stage_texture;
use seastate::ocean::still::PICTURE_FORMAT;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render::{self, MaterialUniform, Renderer};
use seastate::shaders::Shaders;
use wgpu::BufferUsages;

const MODULE: &str = "water/under";
const INDEX: f64 = 1.333;

/// Linear light of a picture of a sea without waves, ripples and roughness, row by row from the top.
fn flat_light(gpu: &Gpu, state: &str, size: [u32; 2]) -> (Vec<[f32; 4]>, seastate::state::camera::View) {
    flat_light_with(gpu, &shaders(), state, size)
}

/// As [`flat_light`], with some shaders.
fn flat_light_with(
    gpu: &Gpu,
    shaders: &Shaders,
    state: &str,
    size: [u32; 2],
) -> (Vec<[f32; 4]>, seastate::state::camera::View) {
    let params = params(&format!("scale=0&foam=0&n=64&{state}"));
    let mut ocean = Ocean::without_renderer(gpu, &params);
    let mut scene = ocean.scene(size);
    scene.sea.unresolved_slope_variance = [0.0; 2];
    let mut renderer = Renderer::new(gpu, shaders, PICTURE_FORMAT, OutputKind::ReadBack);
    let mut encoder = gpu.encoder("test");
    ocean.simulation().encode_with_f32_maps(gpu, &mut encoder, 0.0);
    renderer.draw(gpu, &mut encoder, ocean.maps(), &scene, size);
    let staged = stage_texture(gpu, &mut encoder, renderer.light_texture().expect("a picture"), 0);
    gpu.submit(encoder);
    (pollster::block_on(staged.read_map(gpu)).expect("read-back"), scene.view)
}

#[test]
fn snells_window_has_its_angle_and_total_reflection_lies_outside() {
    const SIDE: u32 = 640;
    let gpu = common::gpu();
    let (light, view) = flat_light(&gpu, "dive=2&pitch=89&fov=100&sun=30&water=i", [SIDE, SIDE]);
    let critical_deg = (1.0 / INDEX).asin().to_degrees();
    // Green light by its angle from the zenith, in bins of 0.1 degrees.
    let mut bins = vec![(0.0, 0.0); 700];
    for (i, pixel) in (0..).zip(&light) {
        let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(SIDE) - 1.0;
        let ray = view.ray(at(i % SIDE), -at(i / SIDE));
        let bin: &mut (f64, f64) = &mut bins[(10.0 * ray.y.acos().to_degrees()) as usize];
        *bin = (bin.0 + f64::from(pixel[1]), bin.1 + 1.0);
    }
    let mean = |deg: f64| bins[(10.0 * deg) as usize].0 / bins[(10.0 * deg) as usize].1;
    let outside = mean(critical_deg + 0.5);
    let inside = mean(critical_deg - 1.5);
    assert!(inside > 1.5 * outside, "the window is bright: {inside} {outside}");
    let edge = (0..100).map(|i| 51.0 - 0.1 * f64::from(i)).find(|&deg| mean(deg) > outside + 0.2 * (inside - outside));
    let edge_deg = edge.expect("an edge");
    eprintln!("edge at {edge_deg:.2} degrees, theory {critical_deg:.2}");
    assert!((edge_deg - critical_deg).abs() < 0.2, "{edge_deg} {critical_deg}");
    // The mirrored water changes little over the next degrees.
    assert!((mean(critical_deg + 1.5) / outside - 1.0).abs() < 0.05);
}

/// A kernel of the module, whose frame, material and light are variables.
fn kernel(ocean: &mut Ocean, text: &str) -> wgsl::Kernel<2, 1> {
    let gpu = ocean.gpu().clone();
    let shaders =
        shaders().patched(MODULE, "@group(0) @binding(2) var<uniform> light: Light;", "var<private> light: Light;");
    let text = format!(
        "fn answer(q: Question) -> Answer {{
          let a = q[0];
          let b = q[1];
          light.sun_irradiance = vec3f(1.0);
          light.sky_irradiance = vec3f(0.2);
          if frame.hs_m + material.relative_index < 0.0 {{
            return Answer(vec4f(0.0));
          }}
          {text}
        }}"
    );
    let mut kernel = wgsl::Kernel::new(&gpu, &shaders, MODULE, &text);
    let scene = ocean.scene([320, 200]);
    let frame = render::frame_uniform(&scene, ocean.maps(), [320, 200]);
    let frame = wgsl::buffer(&gpu, bytemuck::bytes_of(&frame), BufferUsages::UNIFORM);
    let material = wgsl::buffer(&gpu, bytemuck::bytes_of(&MaterialUniform::new(&scene)), BufferUsages::UNIFORM);
    kernel.bind(0, &[(0, frame.as_entire_binding()), (9, material.as_entire_binding())]);
    kernel
}

/// Unpolarised reflectance for a ray in the water, by Snell's law and the two polarisations.
fn reflectance_from_below(cosine: f64) -> f64 {
    let square = 1.0 - INDEX * INDEX * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return 1.0;
    }
    let above = square.sqrt();
    let s = (INDEX * cosine - above) / (INDEX * cosine + above);
    let p = (cosine - INDEX * above) / (cosine + INDEX * above);
    0.5 * (s * s + p * p)
}

#[test]
fn facets_reflect_from_below_as_the_formula_says() {
    let mut ocean = Ocean::without_renderer(&common::gpu(), &params("n=64&dive=2"));
    let text = "let facet = ceiling_facet(a.xyz, vec3f(0.0, 1.0, 0.0));
        return Answer(vec4f(facet.above, facet.reflectance));";
    let cosines: Vec<f64> = (0..200).map(|i| 0.005 + 0.99 * f64::from(i) / 199.0).collect();
    let asked: Vec<[[f32; 4]; 2]> =
        cosines.iter().map(|c| [[(1.0 - c * c).sqrt() as f32, *c as f32, 0.0, 0.0], [0.0; 4]]).collect();
    for (cosine, [got]) in cosines.iter().zip(kernel_answers(&mut ocean, text, &asked)) {
        assert!((got[3] - reflectance_from_below(*cosine)).abs() < 1e-4, "{cosine}: {got:?}");
        if got[3] < 1.0 {
            assert!((got[0] - INDEX * (1.0 - cosine * cosine).sqrt()).abs() < 1e-4, "Snell: {cosine} {got:?}");
        }
    }
}

fn kernel_answers(ocean: &mut Ocean, text: &str, asked: &[[[f32; 4]; 2]]) -> Vec<[[f64; 4]; 1]> {
    kernel(ocean, text).ask(asked)
}

/// Kd of Jerlov (1976) at 450, 475, 550, 600 and 625 nm, 1/m.
const JERLOV: [(&str, [f64; 5]); 10] = [
    ("i", [0.019, 0.018, 0.063, 0.235, 0.305]),
    ("ia", [0.026, 0.025, 0.067, 0.24, 0.31]),
    ("ib", [0.036, 0.033, 0.072, 0.245, 0.315]),
    ("ii", [0.068, 0.062, 0.089, 0.26, 0.335]),
    ("iii", [0.135, 0.116, 0.12, 0.295, 0.375]),
    ("1c", [0.25, 0.17, 0.12, 0.30, 0.37]),
    ("3c", [0.39, 0.29, 0.19, 0.33, 0.40]),
    ("5c", [0.56, 0.43, 0.30, 0.40, 0.48]),
    ("7c", [0.89, 0.71, 0.46, 0.48, 0.54]),
    ("9c", [1.60, 1.23, 0.63, 0.60, 0.65]),
];

#[test]
fn daylight_falls_with_depth_as_in_jerlovs_tables() {
    const DEPTH_M: f64 = 3.0;
    let mut ocean = Ocean::without_renderer(&common::gpu(), &params("n=64&dive=2"));
    for (name, table) in JERLOV {
        ocean.set_params(&params(&format!("n=64&dive=2&water={name}")));
        let ask = [[0.0, 0.0, 0.0, 0.0], [DEPTH_M as f32, 0.0, 0.0, 0.0]].map(|depth| [depth, [0.0; 4]]);
        let answers = kernel_answers(&mut ocean, "return Answer(vec4f(medium_downwelling(a.x), 0.0));", &ask);
        // The display's primaries: 610, 550 and 465 nm.
        let wanted = [table[3] + 0.4 * (table[4] - table[3]), table[2], table[0] + 0.6 * (table[1] - table[0])];
        for (channel, kd) in wanted.into_iter().enumerate() {
            let got = (answers[0][0][channel] / answers[1][0][channel]).ln() / DEPTH_M;
            assert!((got / kd - 1.0).abs() < 0.02, "{name} {channel}: {got} for {kd}");
        }
    }
}

/// Waves focus the sunlight, but its mean over an area stays: so the shafts have the mean of even light.
#[test]
fn shafts_keep_the_mean_of_the_sunlight() {
    let gpu = common::gpu();
    let mut ocean = Ocean::without_renderer(&gpu, &params("wind=5&fetch=20&n=64&dive=4"));
    let mut encoder = gpu.encoder("test");
    ocean.simulation().encode_with_f32_maps(&gpu, &mut encoder, 3.0);
    gpu.submit(encoder);
    // The maps that the gain does not need are bound, too.
    let text = "if a.w > 0.0 {
            let foot = water_round_footprint(1.0);
            return Answer(vec4f(water_slope(a.xy, a.xyz, foot).mean, 0.0, 0.0));
        }
        return Answer(vec4f(bed_caustic_gain(a.xy, b.x, SHAFTS_FILTER * b.x)));";
    let mut kernel = kernel(&mut ocean, text);
    common::bind_maps(&mut kernel, &gpu, ocean.simulation());
    for depth_m in [0.7, 2.1, 6.3, 18.9] {
        const POINTS: u32 = 128;
        let asked: Vec<[[f32; 4]; 2]> = (0..POINTS * POINTS)
            .map(|i| [[0.37 * (i % POINTS) as f32, 0.37 * (i / POINTS) as f32, 0.0, 0.0], [depth_m, 0.0, 0.0, 0.0]])
            .collect();
        let gains: Vec<f64> = kernel.ask(&asked).into_iter().map(|[gain]| gain[0]).collect();
        let mean = gains.iter().sum::<f64>() / gains.len() as f64;
        let deviation = (gains.iter().map(|g| (g - mean).powi(2)).sum::<f64>() / gains.len() as f64).sqrt();
        eprintln!("{depth_m} m: mean {mean:.3}, deviation {deviation:.3}");
        assert!((mean - 1.0).abs() < 0.02 && deviation > 0.05, "{depth_m} m: {mean} {deviation}");
    }
}

/// On a flat sea, the surface crosses the lens where geometry says, all along, and the picture has no hole. Here
/// no water climbs the lens.
#[test]
fn the_waterline_is_where_the_surface_cuts_the_lens() {
    const SIZE: [u32; 2] = [96, 128];
    let gpu = common::gpu();
    let dry = shaders().patched("water/under", "const CEILING_CLIMB_M = 0.0038;", "const CEILING_CLIMB_M = 1e-9;");
    for dive_m in [0.005, 0.01, 0.02] {
        let (light, view) = flat_light_with(&gpu, &dry, &format!("dive={dive_m}&pitch=0&sun=50&heading=200"), SIZE);
        assert!(light.iter().all(|p| p.iter().all(|c| c.is_finite()) && p[3] >= 0.99), "a hole at {dive_m} m");
        // The lens is 0.1 m before the eye.
        let line = 0.5 * f64::from(SIZE[1]) * (1.0 - dive_m / 0.1 / view.tan_half_fov[1]);
        for x in 0..SIZE[0] {
            // Water is much less red than the air and what it mirrors.
            let ratio = |y: u32| light[(y * SIZE[0] + x) as usize][0] / light[(y * SIZE[0] + x) as usize][2];
            let rows: Vec<u32> = (1..SIZE[1]).filter(|&y| ratio(y) < 0.3 && ratio(y - 1) >= 0.3).collect();
            assert_eq!(rows.len(), 1, "one waterline in column {x} at {dive_m} m: {rows:?}");
            assert!((f64::from(rows[0]) - line).abs() <= 2.0, "column {x}: {rows:?} for {line}");
        }
    }
}

/// The water that climbs the lens lies above the line of the surface, no higher than water climbs glass, and the picture
/// has no hole. It may look like air or like water.
#[test]
fn water_climbs_the_lens_as_it_climbs_glass() {
    const SIZE: [u32; 2] = [96, 128];
    let gpu = common::gpu();
    for dive_m in [0.005, 0.01, 0.02] {
        let (light, view) = flat_light(&gpu, &format!("dive={dive_m}&pitch=0&sun=50&heading=200"), SIZE);
        assert!(light.iter().all(|p| p.iter().all(|c| c.is_finite()) && p[3] >= 0.99), "a hole at {dive_m} m");
        // The lens is 0.1 m before the eye.
        let line = 0.5 * f64::from(SIZE[1]) * (1.0 - dive_m / 0.1 / view.tan_half_fov[1]);
        // Water climbs glass by 3.8 mm (WGSL `CEILING_CLIMB_M`), on a port at 10 cm / 1.4 (`CEILING_NEARER`).
        let climb = 0.5 * f64::from(SIZE[1]) * 1.4 * 0.0038 / 0.1 / view.tan_half_fov[1];
        for x in 0..SIZE[0] {
            // Water is much less red than the air and what it mirrors.
            let ratio = |y: u32| light[(y * SIZE[0] + x) as usize][0] / light[(y * SIZE[0] + x) as usize][2];
            let rows: Vec<u32> = (1..SIZE[1]).filter(|&y| ratio(y) < 0.3 && ratio(y - 1) >= 0.3).collect();
            let [first, last] = [line - climb - 2.0, line + 2.0];
            let are_here = !rows.is_empty() && rows.iter().all(|y| (first..=last).contains(&f64::from(*y)));
            assert!(are_here, "column {x} at {dive_m} m: {rows:?} for {line}");
            let mut below = last.ceil() as u32..SIZE[1];
            assert!(below.all(|y| ratio(y) < 0.3), "water below the line in column {x} at {dive_m} m");
        }
    }
}

/// Among waves, an eye just above and just below the still water sees pictures without holes, and a still depends on its
/// state alone.
#[test]
fn pictures_at_the_surface_have_no_holes_and_depend_on_their_state() {
    let mut pictures = Pictures::default();
    let state = |t: u32, dive_m: f64| params(&format!("wind=6&fetch=30&n=64&t={t}&dive={dive_m}&sun=40&pitch=3"));
    let mut seen = Vec::new();
    for t in [2, 4, 7] {
        for dive_m in [0.01, 0.2, 0.6] {
            let picture = pictures.render(&state(t, dive_m), [96, 54]);
            assert!(!picture.iter().any(|p| p[..3] == [255, 0, 255]), "not a number at {t} s, {dive_m} m");
            seen.push((t, dive_m, picture));
        }
    }
    for (t, dive_m, before) in seen.into_iter().rev() {
        assert!(pictures.render(&state(t, dive_m), [96, 54]) == before, "another picture at {t} s, {dive_m} m");
    }
}

/// The deeper, the darker and bluer: in the direction of the horizon, at a fixed exposure.
#[test]
fn the_deep_is_dark_and_blue() {
    let gpu = common::gpu();
    let mut before = [f64::INFINITY; 3];
    for dive_m in [5.0, 15.0, 40.0] {
        let (light, _) = flat_light(&gpu, &format!("dive={dive_m}&pitch=0&sun=50&heading=90"), [32, 18]);
        let level = light[32 * 9 + 16];
        let now = [0, 1, 2].map(|i| f64::from(level[i]));
        assert!((0..3).all(|i| now[i] < before[i]), "{dive_m} m: {now:?} after {before:?}");
        assert!(now[2] > now[0], "{dive_m} m: {now:?}");
        before = now;
    }
}
