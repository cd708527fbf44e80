//! The land of a coast in the picture, and the water over its depths.

mod common;

use common::wgsl::{self, shaders};
use common::{Pictures, params};
use seastate::coast::{Bathymetry, PlacedCoast};
use seastate::gpu::Gpu;
use seastate::gpu::readback::stage_texture;
use seastate::ocean::still::PICTURE_FORMAT;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render::{LandUniform, NoiseTexture, Renderer, land_map};
use seastate::shaders::Shaders;
use std::sync::Arc;
use wgpu::{BindingResource, BufferUsages};

/// A plane that rises by 1 in 20 towards the bearing 127 degrees and by 1 in 80 across, before the middle of the world.
fn plane() -> PlacedCoast {
    let depth_m = |x: f64, y: f64| 20.0 - x / 20.0 - y / 80.0;
    PlacedCoast {
        title: "plane".into(),
        built_in: None,
        about: "A plane.".into(),
        bathymetry: Bathymetry::from_fn(81, 81, 10.0, depth_m),
        structures: Vec::new(),
        toward_deg: 127.0,
        middle_m: [30.0, -50.0],
        notices: Vec::new(),
    }
}

/// A scene of a flat sea with the land of `coast`.
fn flat_scene(gpu: &Gpu, state: &str, coast: &PlacedCoast, size: [u32; 2]) -> (Ocean, seastate::render::Scene) {
    let mut ocean = Ocean::without_renderer(gpu, &params(&format!("scale=0&foam=0&n=64&{state}")));
    ocean.set_land(Some(Arc::new(coast.clone())));
    let mut scene = ocean.scene(size);
    scene.sea.unresolved_slope_variance = [0.0; 2];
    (ocean, scene)
}

/// Depth, m, of ground so high that it has dunes.
const DUNES_FROM_M: f64 = -1.9;

#[test]
fn shaders_find_the_depth_and_where_a_ray_meets_the_bed() {
    let (gpu, coast) = (common::gpu(), plane());
    let (_, scene) = flat_scene(&gpu, "x=40&z=25", &coast, [64, 64]);
    let text = "fn answer(q: Question) -> Answer {
        let depth = land_depth_m(q[0].xy, 1.0);
        let column = land_column_m(q[0].xy, q[1].xy, q[0].z, 1.0);
        return Answer(
            vec4f(depth, column, land_to_world(land_place(q[0].xy) - land.eye_place)),
            vec4f(land_to_world(land.toward_sun), 0.0, 0.0));
    }";
    let mut kernel = wgsl::Kernel::<2, 2>::new(&gpu, &shaders(), "water/light", text);
    let uniform = wgsl::buffer(&gpu, bytemuck::bytes_of(&LandUniform::new(&coast, &scene)), BufferUsages::UNIFORM);
    let (map, noise) = (land_map(&gpu, &coast), NoiseTexture::new(&gpu));
    let group = [
        (7, BindingResource::Sampler(&noise.sampler)),
        (13, BindingResource::TextureView(&map)),
        (15, uniform.as_entire_binding()),
    ];
    kernel.bind(0, &group);
    let mut questions = Vec::new();
    for i in 0..200 {
        let part = |step: f64| (f64::from(i) * step).fract() - 0.5;
        let [x, z] = [500.0 * part(0.7548), 500.0 * part(0.5698)];
        let run = [1.1 * part(0.819), 1.1 * part(0.671)];
        questions.push([[x, z, 2.0 * part(0.55), 0.0], [run[0], run[1], 0.0, 0.0]].map(|v| v.map(|v| v as f32)));
    }
    let eye = [scene.view.eye.x, scene.view.eye.z];
    let [sun_x, _, sun_z] = scene.look.sky.sun_direction();
    for (question, [[depth_m, column_m, x, z], [toward_x, toward_z, ..]]) in
        questions.iter().zip(kernel.ask(&questions))
    {
        let level = sun_x.hypot(sun_z);
        assert!((toward_x - sun_x / level).hypot(toward_z - sun_z / level) < 1e-6, "{toward_x} {toward_z}");
        let [at, run] = [question[0], question[1]].map(|q| q.map(f64::from));
        let want = |off: [f64; 2]| coast.depth_at_m([eye[0] + at[0] + off[0], eye[1] + at[1] + off[1]]);
        // Dunes have hummocks that the bathymetry does not know.
        if want([0.0; 2]) < DUNES_FROM_M {
            continue;
        }
        assert!((depth_m - want([0.0; 2])).abs() < 0.02, "{depth_m}, not {}", want([0.0; 2]));
        assert!((x - at[0]).abs() < 1e-3 && (z - at[1]).abs() < 1e-3, "the axes are turned back: {x} {z}");
        // The bed under the point where the ray meets it, by bisection.
        let (mut low, mut high) = (0.0, 60.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            let below = want([run[0] * middle, run[1] * middle]) + at[2];
            if below > middle { low = middle } else { high = middle }
        }
        assert!((column_m - low).abs() < 0.03 + 0.01 * low, "{column_m}, not {low}");
    }
}

/// The sand is wet as far as the drawn waves run up at its place; before these are known, as far as those of the sea run
/// up an open beach.
#[test]
fn wet_sand_follows_the_drawn_run_up() {
    let (gpu, coast) = (common::gpu(), plane());
    let text = "fn answer(q: Question) -> Answer { return Answer(vec4f(land_run_up_m(q[0].xy), 0.0, 0.0, 0.0)); }";
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    let gains = gpu.texture("gains", [1, 1, 1], 1, wgpu::TextureFormat::Rgba16Float, usage);
    gpu.write_texture(&gains, 0, bytemuck::cast_slice(&[1.0, 0.0, 1.0, 0.75].map(half::f16::from_f32)));
    let gains = gains.create_view(&wgpu::TextureViewDescriptor::default());
    let sampler = gpu.sampler("gains", [wgpu::AddressMode::ClampToEdge; 2], wgpu::MipmapFilterMode::Nearest);
    let run_up_m = |has_coast: bool, state: &str| {
        let ocean = Ocean::without_renderer(&gpu, &params(&format!("n=64&{state}")));
        let mut scene = ocean.scene([64, 64]);
        scene.has_coast = has_coast;
        let mut kernel = wgsl::Kernel::<1, 1>::new(&gpu, &shaders(), "land/light", text);
        let bytes = |bytes: &[u8]| wgsl::buffer(&gpu, bytes, BufferUsages::UNIFORM);
        let land = bytes(bytemuck::bytes_of(&LandUniform::new(&coast, &scene)));
        let frame = seastate::render::frame_uniform(&scene, ocean.maps(), [64, 64]);
        let frame = bytes(bytemuck::bytes_of(&frame));
        kernel.bind(0, &[(0, frame.as_entire_binding()), (15, land.as_entire_binding())]);
        kernel.bind(1, &[(5, BindingResource::Sampler(&sampler)), (6, BindingResource::TextureView(&gains))]);
        kernel.ask(&[[[3.0, 4.0, 0.0, 0.0]]])[0][0][0]
    };
    // Stockdon et al. 2006: 2 m and 10 s on a slope of 0.08 give 1.39 m.
    let of_sea = run_up_m(false, "hs=2&tp=10&depth=200");
    assert!((of_sea - 1.39).abs() < 0.05, "{of_sea}");
    assert!((run_up_m(true, "hs=2&tp=10&depth=200") - 0.75).abs() < 1e-3);
}

/// Where a wave has passed, sand bears a film of water that drains with the wave's foam. It ends below the run-up, and
/// rock has none.
#[test]
fn a_wave_leaves_a_film_on_sand_that_drains_with_its_foam() {
    let text = "fn answer(q: Question) -> Answer {
        return Answer(vec4f(swash_film(q[0].x, q[0].y, q[0].z, q[1].x, q[0].w), 0.0, 0.0));
    }";
    let kernel = wgsl::Kernel::<2, 1>::new(&common::gpu(), &shaders(), "land/light", text);
    // Cover of the foam, height of the place, m, slope of the land, and noise of the lobes. The run-up is 1.2 m.
    let bent = |cover: f32, height: f32, steep: f32, bend: f32| {
        kernel.ask(&[[[cover, height, 1.2, steep], [bend, 0.0, 0.0, 0.0]]])[0][0][0]
    };
    let film = |cover, height, steep| bent(cover, height, steep, 0.0);
    let drains: Vec<f64> = [0.6, 0.35, 0.15, 0.02].map(|cover| film(cover, 0.5, 0.05)).to_vec();
    assert_eq!((drains[0], drains[3]), (1.0, 0.0));
    assert!(drains.windows(2).all(|pair| pair[1] < pair[0]), "{drains:?}");
    assert_eq!([film(0.6, 1.2, 0.05), film(0.6, 0.5, 0.6)], [0.0; 2], "above the run-up, and on rock");
    assert!(film(0.6, 0.8, 0.05) > 0.0);
    assert!(bent(0.6, 1.2, 0.05, -3.0) < 1e-5, "no lobe reaches beyond the run-up");
    // A narrow lip of foam lies along the upper edge of the film, drains with it, and is not on rock.
    let lips = |cover: f32, steep: f32| -> Vec<f64> {
        let heights = (0..750).map(|i| [[cover, 0.002 * i as f32, 1.2, steep], [0.0; 4]]);
        kernel.ask(&heights.collect::<Vec<_>>()).iter().map(|[answer]| answer[1]).collect()
    };
    let lip = lips(0.6, 0.05);
    let seen: Vec<usize> = (0..lip.len()).filter(|i| lip[*i] > 0.0).collect();
    let (low, high) = (seen[0], seen[seen.len() - 1]);
    assert!(low >= 471 && high <= 489 && high - low <= 8, "between {low} and {high} times 2 mm");
    let largest = |lips: &[f64]| lips.iter().copied().fold(0.0, f64::max);
    let drained = largest(&lips(0.15, 0.05));
    assert!(largest(&lip) > 0.8 && drained > 0.05 && drained < 0.5, "{drained}");
    assert_eq!([largest(&lips(0.02, 0.05)), largest(&lips(0.6, 0.6))], [0.0; 2], "drained, and on rock");
}

/// Height, m, of the ridge of [`ridge`], and its distance from the sea's edge of the coast.
const RIDGE_M: [f64; 2] = [12.0, 400.0];

/// A ridge along the shore, 12 m high, with water on both sides.
fn ridge() -> PlacedCoast {
    let depth_m = |x: f64, _: f64| 8.0 - (8.0 + RIDGE_M[0]) * (-((x - RIDGE_M[1]) / 60.0).powi(2)).exp();
    PlacedCoast {
        title: "ridge".into(),
        bathymetry: Bathymetry::from_fn(161, 161, 5.0, depth_m),
        toward_deg: 90.0,
        middle_m: [400.0, 400.0],
        ..plane()
    }
}

/// Answers about a ray from a point of the water: the visible fraction of a sun in its direction, and the share of a
/// bundle of mirrored rays around it that meets the land. Nothing shines, so the land is black in a sky of radiance 1.
const RAY_ANSWER: &str = "
fn answer(q: Question) -> Answer {
  frame.sun_direction = q[1].xyz;
  let place = land_place(q[0].xy);
  let rays = WaterMirroredRays(q[1].xyz, vec2f(q[0].w));
  let mirror = land_mirrored(WaterMirror(vec3f(1.0), 1.0), place, q[0].z, rays);
  return Answer(vec4f(land_visible_sun(place, q[0].z), 1.0 - mirror.radiance.x, 0.0, 0.0));
}
";

/// For bundles of rays from the water towards the ridge: the tangents of the elevations of the middle ray and of the
/// ridge as seen from there; and, by `shaders`, the visible fraction of the sun in the direction of that ray, and the
/// share of the rays that meet the ridge. The tangents of the rays have a deviation of `blur` times that of the ridge.
fn rays_towards_a_ridge(shaders: Shaders, blur: f64) -> Vec<[f64; 4]> {
    let (gpu, coast) = (common::gpu(), ridge());
    let size = [64, 64];
    let (ocean, scene) = flat_scene(&gpu, "x=200&z=400", &coast, size);
    let frame = "var<uniform> frame: Frame;";
    let shaders =
        shaders.patched("water/light", frame, "var<uniform> picture_frame: Frame;\nvar<private> frame: Frame;");
    let mut kernel = wgsl::Kernel::<2, 1>::new(&gpu, &shaders, "water/light", RAY_ANSWER);
    let uniform = wgsl::buffer(&gpu, bytemuck::bytes_of(&LandUniform::new(&coast, &scene)), BufferUsages::UNIFORM);
    let dark = wgsl::buffer(&gpu, &[0; 4096], BufferUsages::UNIFORM);
    let (map, noise) = (land_map(&gpu, &coast), NoiseTexture::new(&gpu));
    let group = [
        (2, dark.as_entire_binding()),
        (7, BindingResource::Sampler(&noise.sampler)),
        (9, dark.as_entire_binding()),
        (13, BindingResource::TextureView(&map)),
        (15, uniform.as_entire_binding()),
    ];
    kernel.bind(0, &group);
    drop(ocean);
    let (mut questions, mut expected) = (Vec::new(), Vec::new());
    for i in 0..400 {
        let part = |step: f64| (f64::from(i) * step).fract();
        let [x, z] = [180.0 + 140.0 * part(0.7548), 300.0 + 200.0 * part(0.5698)];
        let turn = 0.8 * (part(0.819) - 0.5);
        let (sin, cos) = turn.sin_cos();
        // The highest elevation of the ridge along the ray.
        let top = (1..4000).map(|i| {
            let far_m = 0.2 * f64::from(i);
            (-coast.depth_at_m([x + cos * far_m, z + sin * far_m]) / far_m, far_m)
        });
        let top = top.map(|(top, _)| top).fold(0.0, f64::max);
        let rise = top * (0.3 + 1.4 * part(0.671));
        let eye = [scene.view.eye.x, scene.view.eye.z];
        let ray = glam::DVec3::new(cos, rise, sin).normalize();
        questions
            .push([[x - eye[0], z - eye[1], 0.0, blur * top], [ray.x, ray.y, ray.z, 0.0]].map(|v| v.map(|v| v as f32)));
        expected.push([rise, top]);
    }
    let answers = kernel.ask(&questions);
    expected.iter().zip(answers).map(|([rise, top], [[sun, met, ..]])| [*rise, *top, sun, met]).collect()
}

#[test]
fn land_hides_the_sun_and_is_mirrored_up_to_its_height() {
    let rays = rays_towards_a_ridge(shaders(), 0.02);
    // The penumbra is 0.022 wide on either side. The rays take long steps, and the ridge has hummocks.
    let wrong = |rays: &[[f64; 4]]| {
        let is_wrong = |[rise, top, sun, met]: &&[f64; 4]| {
            let (low, high) = (0.8 * top, 1.25 * top);
            (*rise < low && *met < 0.9)
                || (*rise > high && *met > 0.1)
                || (*rise < low - 0.022 && *sun > 0.01)
                || (*rise > high + 0.022 && *sun < 0.99)
        };
        rays.iter().filter(is_wrong).count()
    };
    assert_eq!(wrong(&rays), 0);
    for fault in [
        ("low + horizon.rise * sharp", "low + 0.5 * horizon.rise * sharp"),
        ("(rise - horizon.rise) *", "(rise - 0.5 * horizon.rise) *"),
    ] {
        let faulty = shaders().patched("water/light", fault.0, fault.1);
        let found = wrong(&rays_towards_a_ridge(faulty, 0.02));
        assert!(found > 20, "{fault:?}: {found} wrong rays");
    }
}

/// Rays that spread widely below and above the level: of those above it, a part meets the ridge. The others meet other
/// waves, which are taken to mirror the ridge as often.
#[test]
fn rough_water_mirrors_the_land_with_the_rays_above_the_level() {
    let is_wrong = |[rise, top, _, met]: &&[f64; 4]| {
        let density = |tangent: f64| (-0.5 * ((tangent - rise) / top).powi(2)).exp();
        let sum = |to: f64| (0..2000).map(|i| to / 2000.0 * density(to * (f64::from(i) + 0.5) / 2000.0)).sum::<f64>();
        (met - sum(*top) / sum(rise + 7.0 * top)).abs() > 0.1
    };
    let wrong = |shaders: Shaders| rays_towards_a_ridge(shaders, 1.0).iter().filter(is_wrong).count();
    // The long steps of nearly level rays miss the top of the ridge by up to a quarter.
    let few = wrong(shaders());
    assert!(few < 8, "{few} wrong rays");
    let found = wrong(shaders().patched("water/light", "/ (1.0 - below);", ";"));
    assert!(found > 80, "{found} wrong rays");
}

/// Heights above the still water, m, and linear light of the pixels of a picture.
fn heights_and_light(gpu: &Gpu, state: &str, coast: &PlacedCoast, size: [u32; 2]) -> Vec<([f64; 3], [f32; 4])> {
    let (mut ocean, scene) = flat_scene(gpu, state, coast, size);
    let mut renderer = Renderer::new(gpu, &shaders(), PICTURE_FORMAT, OutputKind::ReadBack);
    let mut encoder = gpu.encoder("test");
    ocean.simulation().encode_with_f32_maps(gpu, &mut encoder, 0.0);
    renderer.draw(gpu, &mut encoder, ocean.maps(), &scene, size);
    let light = stage_texture(gpu, &mut encoder, renderer.light_texture().expect("a picture"), 0);
    let depth = stage_texture(gpu, &mut encoder, renderer.depth_texture().expect("a picture"), 0);
    gpu.submit(encoder);
    let light = pollster::block_on(light.read_map(gpu)).expect("light");
    let depth: Vec<f32> = bytemuck::pod_collect_to_vec(&pollster::block_on(depth.read(gpu)).expect("depth"));
    let view = scene.view;
    let place = |i: usize| {
        let at = |pixel: usize, count: u32| 2.0 * (pixel as f64 + 0.5) / f64::from(count) - 1.0;
        let (x, y) = (at(i % size[0] as usize, size[0]), -at(i / size[0] as usize, size[1]));
        let ray = view.forward + view.right * (x * view.tan_half_fov[0]) + view.up * (y * view.tan_half_fov[1]);
        let p = view.eye + ray * (0.1 / f64::from(depth[i]));
        [p.x, p.y + (ray.x.hypot(ray.z) * 0.1 / f64::from(depth[i])).powi(2) / (2.0 * 6_371_000.0), p.z]
    };
    (0..depth.len()).map(|i| (place(i), light[i])).collect()
}

#[test]
fn the_waterline_is_where_the_ground_rises_above_the_water_and_has_no_dark_rim() {
    let gpu = common::gpu();
    let size = [240, 160];
    let beach = PlacedCoast::of_state(&params("coast=beach").coast, None).expect("a beach").expect("a beach");
    let state = "y=40&x=540&z=0&heading=90&pitch=-50&sun=50&sunaz=180&bedcover=0";
    let pixels = heights_and_light(&gpu, state, &beach, size);
    let (mut land, mut water) = (Vec::new(), Vec::new());
    for ([x, height_m, z], light) in &pixels {
        let ground_m = -beach.depth_at_m([*x, *z]);
        // The grid of the coast has 7.5 m between its points, between which the picture follows the formula. Higher up the
        // picture adds hummocks, which the waves do not know.
        let want = ground_m.max(0.0);
        let is_smooth = ground_m < 1.9;
        assert!(!is_smooth || (height_m - want).abs() < 0.12, "{height_m} m at {x} {z}, not {want}");
        if ground_m.abs() < 0.5 {
            if *height_m > 0.02 { land.push(light[1]) } else { water.push((ground_m, light[1])) }
        }
    }
    assert!(land.len() > 200 && water.len() > 200, "{} {}", land.len(), water.len());
    let mean = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
    let thin: Vec<f32> = water.iter().filter(|(ground_m, _)| *ground_m > -0.1).map(|(_, light)| *light).collect();
    let deeper: Vec<f32> = water.iter().filter(|(ground_m, _)| *ground_m < -0.3).map(|(_, light)| *light).collect();
    let (land, thin, deeper) = (mean(&land), mean(&thin), mean(&deeper));
    eprintln!("green light: land {land:.4}, thin water {thin:.4}, deeper water {deeper:.4}");
    assert!(thin > 0.97 * deeper && thin < 1.02 * land, "{land} {thin} {deeper}");
}

#[test]
fn a_picture_without_a_coast_does_not_know_that_there_was_one() {
    let size = [160, 90];
    let mut pictures = Pictures::default();
    let sea = params("n=64&depth=12&foam=0");
    let first = pictures.render(&sea, size);
    let with_land = pictures.render(&params("n=64&depth=12&foam=0&coast=beach&x=500&heading=90"), size);
    assert_ne!(first, with_land);
    assert_eq!(first, pictures.render(&sea, size));
}

/// A lighthouse stands where its coast is placed, the house beside it on the right side, and its lens flashes.
#[test]
fn a_lighthouse_stands_on_its_coast_and_flashes() {
    let gpu = common::gpu();
    let size = [160, 120];
    let place = "coast=island&coastx=120&coastz=-70&coastturn=25";
    let island = PlacedCoast::of_state(&params(place).coast, None).expect("an island").expect("an island");
    let [mark] = island.seamarks() else { panic!("{} seamarks", island.seamarks().len()) };
    let [x, z] = island.placement().world_m(mark.at_m);
    let state = |t_s: f64| {
        format!("{place}&x={x:.3}&z={:.3}&y={}&heading=0&pitch=-5&fov=50&t={t_s}", z + 40.0, mark.ground_m + 14.0)
    };
    let drawn = |t_s: f64| heights_and_light(&gpu, &state(t_s), &island, size);
    let (flash, dark) = (drawn(0.0), drawn(5.0));
    // Above the grass, and not the keeper's house, which is lower.
    let tower: Vec<_> = (0..flash.len())
        .map(|i| (i, flash[i].0))
        .filter(|(_, at)| at[1] > mark.ground_m + 7.0 && (at[0] - x).hypot(at[2] - z) < 30.0)
        .collect();
    let widest_m = tower.iter().map(|(_, at)| (at[0] - x).hypot(at[2] - z)).fold(0.0, f64::max);
    let top_m = tower.iter().map(|(_, at)| at[1] - mark.ground_m).fold(0.0, f64::max);
    eprintln!("{} pixels of the tower, widest {widest_m:.2} m, top {top_m:.2} m", tower.len());
    assert!(tower.len() > 400 && widest_m < 2.95, "{} pixels, {widest_m} m", tower.len());
    assert!((20.0..20.9).contains(&top_m), "{top_m} m");
    // Where one who looks out to sea from the tower has the house: to the left, and a little inland.
    let [house_x, house_z] = island.placement().world_m([mark.at_m[0] + 3.0, mark.at_m[1] + 10.5]);
    let of_house =
        |at: &[f64; 3]| (at[0] - house_x).hypot(at[2] - house_z) < 6.5 && (3.0..6.7).contains(&(at[1] - mark.ground_m));
    let house = flash.iter().filter(|(at, _)| of_house(at)).count();
    assert!(house > 200, "{house} pixels of the house");
    let brighter: Vec<_> = tower.iter().filter(|(i, _)| flash[*i].1[1] > 4.0 * dark[*i].1[1]).collect();
    let is_lens = |height_m: f64| (16.9..18.6).contains(&(height_m - mark.ground_m));
    assert!(brighter.len() > 10 && brighter.iter().all(|(_, at)| is_lens(at[1])), "{} pixels", brighter.len());
}
