//! The waves at a coast on the GPU: over a flat bed they are those of the open sea, the sea around the coast stays as it
//! is, waves that break bear foam, and without a coast nothing is different.

mod common;

use seastate::coast::Transfer;
use seastate::coast::incident::Placement;
use seastate::gpu::{Gpu, readback};
use seastate::lab::check::coast::SyntheticCoast;
use seastate::ocean::still::{PICTURE_FORMAT, draw_ocean_picture};
use seastate::ocean::{Ocean, OutputKind};
use seastate::render;
use seastate::shaders::Shaders;
use seastate::sim::coast::square::CoastSquare;
use seastate::sim::coast::tables;
use seastate::sim::resources::MapKind;
use seastate::sim::{CascadeRole, MAX_FOAM_STEPS, Simulation};
use seastate::state::query;
use seastate::waves::Plan;
use seastate::waves::statistics::initial_amplitude;
use seastate::waves::table::SpectrumTable;
use std::sync::Arc;

const STATE: &str = "wind=12&fetch=200&n=128&coast=beach&whitecaps=1";
const T_S: f64 = 31.7;
/// Time steps of the foam that a test makes: the first of a cold start, which are longest.
const FOAM_STEPS: usize = 6;

fn plan(state: &str) -> Plan {
    Plan::new(&query::parse(state).0)
}

/// A flat bed in the middle of the first patch of a sea, over which waves break from a height.
fn flat(plan: &Plan, breaking_height_m: f32) -> SyntheticCoast {
    let side_m = 0.7 * plan.cascades[0].patch_m;
    let points = 65;
    SyntheticCoast {
        placement: Placement { origin_m: [-1234.5, 345.0], turn_rad: plan.downwind[1].atan2(plan.downwind[0]) - 0.2 },
        size: [points, points],
        cell_m: side_m / (points - 1) as f64,
        shortening: 0.0,
        growth: 0.0,
        set_up_m: 0.0,
        breaking_height_m,
        waves: 60,
        shortest_m: 5.0 * 1.4 * side_m / f64::from(plan.n),
    }
}

fn simulation(gpu: &Gpu, state: &str, transfer: Option<&Arc<Transfer>>) -> Simulation {
    let mut sim = Simulation::new(gpu, plan(state), &Shaders::default());
    assert!(sim.set_coast(gpu, &Shaders::default(), transfer.cloned()));
    sim
}

/// Records the maps at [`T_S`], and `foam_steps` time steps of the foam around a point.
fn encode(gpu: &Gpu, sim: &mut Simulation, centre: [f64; 2], foam_steps: usize) {
    let mut encoder = gpu.encoder("test");
    sim.encode(gpu, &mut encoder, T_S, centre, foam_steps);
    gpu.submit(encoder);
}

/// Texels of all layers of a kind of map.
fn map(gpu: &Gpu, sim: &Simulation, kind: MapKind, level: u32) -> Vec<[f32; 4]> {
    let mut encoder = gpu.encoder("test");
    let copy = sim.resources.stage_maps(gpu, &mut encoder, kind, level);
    gpu.submit(encoder);
    pollster::block_on(copy.read_map(gpu)).expect("read-back")
}

fn foam(gpu: &Gpu, sim: &Simulation) -> Vec<[f32; 4]> {
    let mut encoder = gpu.encoder("test");
    let copy = readback::stage_texture(gpu, &mut encoder, &sim.resources.foam, 0);
    gpu.submit(encoder);
    pollster::block_on(copy.read_map(gpu)).expect("read-back")
}

fn layer(texels: &[[f32; 4]], layer: u32, n: u32) -> &[[f32; 4]] {
    &texels[(layer * n * n) as usize..][..(n * n) as usize]
}

/// Elevation, m, its slopes, the horizontal displacement and its derivatives dDx/dx, dDz/dz, dDx/dz of plane waves.
fn plane_waves(plan: &Plan, waves: &[([i32; 2], [f64; 2])], at: [f64; 2]) -> [f64; 8] {
    let cascade = &plan.cascades[0];
    waves.iter().fold([0.0; 8], |mut sum, ([ix, iz], [re, im])| {
        let [kx, kz] = [ix, iz].map(|i| f64::from(*i) * cascade.dk());
        let wave = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32);
        let phase = kx * at[0] + kz * at[1] - wave.omega * T_S;
        let (eta, quadrature) =
            (2.0 * (re * phase.cos() - im * phase.sin()), 2.0 * (re * phase.sin() + im * phase.cos()));
        let o = wave.orbit_width_over_height / wave.k;
        let of = [
            eta,
            -kx * quadrature,
            -kz * quadrature,
            -o * kx * quadrature,
            -o * kz * quadrature,
            -o * kx * kx * eta,
            -o * kz * kz * eta,
            -o * kx * kz * eta,
        ];
        sum.iter_mut().zip(of).for_each(|(sum, value)| *sum += value);
        sum
    })
}

#[test]
fn over_a_flat_bed_the_waves_are_those_of_the_open_sea() {
    let gpu = common::gpu();
    for n in [128, 256] {
        let plan = plan(&format!("{STATE}&n={n}"));
        let coast = flat(&plan, f32::INFINITY);
        let transfer = Arc::new(coast.transfer(&plan));
        assert!(transfer.waves.len() >= 20, "{} waves", transfer.waves.len());
        let mut sim = simulation(&gpu, &format!("{STATE}&n={n}"), Some(&transfer));
        encode(&gpu, &mut sim, [0.0; 2], 0);
        let coastal = sim.maps().cascades.iter().find(|c| c.role == CascadeRole::Coast).expect("a layer").layer;
        let (displacement, gradients) =
            (map(&gpu, &sim, MapKind::Displacement, 0), map(&gpu, &sim, MapKind::Gradients, 0));
        let table = SpectrumTable::new(&plan, &plan.cascades[0]);
        let amplitude = |[ix, iz]: [i32; 2]| initial_amplitude(&plan, &plan.cascades[0], &table, ix, iz);
        let waves: Vec<_> = transfer.waves.iter().map(|w| (w.lattice_index, amplitude(w.lattice_index))).collect();
        let square = CoastSquare::around(&transfer, n);
        let wide_m = coast.cell_m * (coast.size[0] - 1) as f64;
        let (mut errors, mut squares, mut count) = ([0.0; 8], [0.0; 8], 0);
        for i in 0..n * n {
            let world = square.texel_position_m([i % n, i / n], n);
            let [x, y] = transfer.placement.in_frame_m(world);
            // Where the waves at the coast have the whole weight.
            if !(0.25 * wide_m..wide_m - 3.0 * coast.cell_m).contains(&x) || (y / wide_m - 0.5).abs() > 0.25 {
                continue;
            }
            let [dx, eta, dz, dxz] = layer(&displacement, coastal, n)[i as usize].map(f64::from);
            let [sx, sz, dxx, dzz] = layer(&gradients, coastal, n)[i as usize].map(f64::from);
            let want = plane_waves(&plan, &waves, world);
            count += 1;
            for (k, got) in [eta, sx, sz, dx, dz, dxx, dzz, dxz].into_iter().enumerate() {
                errors[k] += (got - want[k]).powi(2);
                squares[k] += want[k].powi(2);
            }
        }
        let relative: [f64; 8] = std::array::from_fn(|k| (errors[k] / squares[k]).sqrt());
        eprintln!("n {n}, {} waves, {count} texels: {relative:.5?}", waves.len());
        assert!(count > 100);
        // Elevations are exact but for linear envelopes, the sampler's weights of 8 bits and half floats; derivatives of
        // waves of five texels and more have the error of differences of fourth order.
        assert!(relative[0] < 1e-3, "{relative:?}");
        assert!(relative[1..].iter().all(|e| *e < 0.03), "{relative:?}");
    }
}

#[test]
fn around_the_coast_the_sea_stays_as_it_is() {
    let gpu = common::gpu();
    let plan = plan(STATE);
    let transfer = Arc::new(flat(&plan, 1.0).transfer(&plan));
    let [mut open, mut coastal] = [None, Some(&transfer)].map(|transfer| simulation(&gpu, STATE, transfer));
    let [want, got] = [&mut open, &mut coastal]
        .map(|sim| pollster::block_on(sim.read_maps_f32(&gpu, T_S)).expect("read-back").texels);
    assert_eq!(want.len(), got.len());
    let square = |texels: &[[f32; 4]]| texels.iter().flatten().map(|x| f64::from(*x).powi(2)).sum::<f64>();
    let rest: Vec<[f32; 4]> = want.iter().zip(&got).map(|(a, b)| std::array::from_fn(|i| a[i] - b[i])).collect();
    let error = (square(&rest) / square(&want)).sqrt();
    assert!(error < 1e-6, "offshore and other waves together are the open sea: {error:e}");
    // The two parts are not the same sea: offshore waves have some of the energy, and the first cascade the rest.
    encode(&gpu, &mut coastal, [0.0; 2], 0);
    let displacement = map(&gpu, &coastal, MapKind::Displacement, 0);
    let cascades = &coastal.maps().cascades;
    assert_eq!(cascades[..2].iter().map(|c| c.role).collect::<Vec<_>>(), [CascadeRole::Coast, CascadeRole::Offshore]);
    let variance = |layer_index: u32| {
        layer(&displacement, layer_index, plan.n).iter().map(|t| f64::from(t[1]).powi(2)).sum::<f64>()
    };
    let (offshore, first) = (variance(cascades[1].layer), variance(cascades[2].layer));
    assert!(offshore > 0.2 * first && first > 0.1 * offshore, "{offshore} {first}");
    // Far from the coast, ordinary cascades and offshore waves count in full, and the waves at the coast not at all.
    let gains = tables::gain_texels(&transfer, &CoastSquare::around(&transfer, plan.n));
    let side = tables::GAINS_MAP_SIDE as usize;
    let corner = |i: usize| gains[i].map(f32::from);
    // The land lies downwind; the corner opposite to it lies in the open sea.
    let sea = [0, side - 1, side * (side - 1), side * side - 1].map(corner);
    assert!(sea.iter().any(|g| g[..3] == [1.0, 1.0, 0.0]), "{sea:?}");
    assert!(sea.iter().all(|g| g[2] == 0.0), "{sea:?}");
}

#[test]
fn without_a_coast_the_maps_are_the_same_bit_for_bit() {
    let gpu = common::gpu();
    let state = format!("{STATE}&n=64");
    let plan = plan(&state);
    let transfer = Arc::new(flat(&plan, 1.0).transfer(&plan));
    let mut never = Simulation::new(&gpu, plan, &Shaders::default());
    let mut before = simulation(&gpu, &state, Some(&transfer));
    encode(&gpu, &mut before, [0.0; 2], MAX_FOAM_STEPS);
    let with = foam(&gpu, &before);
    assert!(before.set_coast(&gpu, &Shaders::default(), None));
    for sim in [&mut never, &mut before] {
        encode(&gpu, sim, [0.0; 2], MAX_FOAM_STEPS);
    }
    for kind in [MapKind::Displacement, MapKind::Gradients] {
        for level in 0..3 {
            assert!(map(&gpu, &never, kind, level) == map(&gpu, &before, kind, level), "{kind:?} {level}");
        }
    }
    assert_eq!(never.passes.dispatch_count(), before.passes.dispatch_count());
    let without = foam(&gpu, &never);
    assert!(without == foam(&gpu, &before) && without != with);
}

/// Significant height of the waves of a transfer in the open sea, m.
fn own_hs_m(plan: &Plan, transfer: &Transfer) -> f64 {
    let table = SpectrumTable::new(plan, &plan.cascades[0]);
    let square = |[ix, iz]: [i32; 2]| -> f64 {
        initial_amplitude(plan, &plan.cascades[0], &table, ix, iz).iter().map(|x| x * x).sum()
    };
    4.0 * (2.0 * transfer.waves.iter().map(|wave| square(wave.lattice_index)).sum::<f64>()).sqrt()
}

#[test]
fn waves_that_break_bear_foam() {
    let gpu = common::gpu();
    let plan = plan(STATE);
    let hs_m = own_hs_m(&plan, &flat(&plan, 1.0).transfer(&plan)) as f32;
    let at = |height_m: f32| {
        let coast = flat(&plan, height_m);
        let transfer = Arc::new(coast.transfer(&plan));
        let half = 0.5 * coast.cell_m * (coast.size[0] - 1) as f64;
        let middle = coast.placement.world_m([half, half]);
        let mut sim = simulation(&gpu, STATE, Some(&transfer));
        encode(&gpu, &mut sim, middle, FOAM_STEPS);
        // The two finest levels lie within the coast.
        let cells = foam(&gpu, &sim);
        let cells = &cells[..2 * (sim.resources.foam_n * sim.resources.foam_n) as usize];
        cells.iter().map(|cell| f64::from(cell[0])).sum::<f64>() / cells.len() as f64
    };
    let [never, few, some, most] = [f32::INFINITY, 0.7 * hs_m, 0.6 * hs_m, 0.3 * hs_m].map(at);
    eprintln!("mean foam: {never:.4} without breaking, {few:.4}, {some:.4} and {most:.4} with it");
    assert!(2.0 * never < few && few < some, "{never} {few} {some}");
    assert!(never + 0.01 < some && some + 0.01 < most, "{never} {some} {most}");
}

#[test]
fn another_sea_does_not_take_the_waves_of_this_one() {
    let gpu = common::gpu();
    let shaders = Shaders::default();
    let transfer = Arc::new(flat(&plan(STATE), 1.0).transfer(&plan(STATE)));
    let mut sim = simulation(&gpu, STATE, Some(&transfer));
    // Another number of points keeps the coast, another height of the same waves too, and another seed does not.
    sim.set_plan(&gpu, plan(&format!("{STATE}&n=64")), &shaders);
    assert!(sim.transfer().is_some() && sim.maps().coast.is_some());
    sim.set_plan(&gpu, plan(&format!("{STATE}&scale=0.9&n=64")), &shaders);
    assert!(sim.transfer().is_some());
    sim.set_plan(&gpu, plan(&format!("{STATE}&seed=5&n=64")), &shaders);
    assert!(sim.transfer().is_none() && sim.maps().coast.is_none() && !sim.has_coast());
    assert!(!sim.set_coast(&gpu, &shaders, Some(transfer)));
    // A cross-fade to another sea draws the coast until the other sea has taken over.
    let fade = format!("{STATE}&n=64&seed=5");
    let transfer = Arc::new(flat(&plan(&fade), 1.0).transfer(&plan(&fade)));
    assert!(sim.set_coast(&gpu, &shaders, Some(transfer)));
    sim.transition_to(&gpu, Some(plan(&format!("{STATE}&n=64&seed=6"))), &shaders, T_S, 0.1);
    let roles = |sim: &Simulation| sim.maps().cascades.iter().filter(|c| c.role == CascadeRole::Coast).count();
    assert_eq!((sim.in_transition(), roles(&sim), sim.has_coast()), (true, 1, false));
    encode(&gpu, &mut sim, [0.0; 2], 0);
    while sim.in_transition() {
        sim.transition_to(&gpu, None, &shaders, T_S, 0.1);
    }
    assert_eq!(roles(&sim), 0);
    encode(&gpu, &mut sim, [0.0; 2], 0);
}

/// Displacement and slopes of the drawn surface, from the WGSL functions of the water.
const ANSWER: &str = "
fn answer(q: Question) -> Answer {
  let at = q[0].xy;
  let moved = water_displacement(at, q[0].z, false).displacement;
  let slope = water_slope(at, moved, water_round_footprint(q[0].z));
  return Answer(vec4f(moved, 0.0), vec4f(slope.mean, slope.jacobian, 0.0));
}";

/// The drawn surface at points relative to `eye`, filtered over half a metre: displacement (x, y, z), slope (x, z), Jacobian.
fn surface(gpu: &Gpu, transfer: Option<&Arc<Transfer>>, state: &str, eye: [f64; 2], at: &[[f32; 2]]) -> Vec<[f64; 6]> {
    use wgpu::BindingResource::{Sampler, TextureView};
    let mut params = query::parse(state).0;
    (params.camera.x_m, params.camera.z_m, params.clock.t_s) = (eye[0], eye[1], T_S);
    let mut ocean = Ocean::new(gpu, wgpu::TextureFormat::Rgba8Unorm, OutputKind::Screen, &params);
    assert!(ocean.set_coast(transfer.cloned()) && ocean.transfer() == transfer);
    encode(gpu, ocean.simulation(), eye, 0);
    let mut scene = ocean.scene([640, 360]);
    assert_eq!(scene.has_coast, transfer.is_some());
    scene.sea.unresolved_slope_variance = [0.0; 2];
    let is_coastal = format!("override WATER_COAST: bool = {};", transfer.is_some());
    let shaders = common::wgsl::shaders().patched("water/light", "override WATER_COAST: bool = false;", &is_coastal);
    let mut kernel = common::wgsl::Kernel::<1, 2>::new(gpu, &shaders, "water/light", ANSWER);
    let maps = ocean.maps();
    let frame = render::frame_uniform(&scene, maps, [640, 360]);
    let frame = common::wgsl::buffer(gpu, bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
    kernel.bind(0, &[(0, frame.as_entire_binding())]);
    let samplers = [wgpu::MipmapFilterMode::Linear, wgpu::MipmapFilterMode::Nearest]
        .map(|filter| gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], filter));
    let gains = maps.coast.as_ref().map_or(&maps.no_coast, |coast| &coast.gains);
    kernel.bind(
        1,
        &[
            (0, TextureView(&maps.displacement)),
            (1, TextureView(&maps.gradients)),
            (2, TextureView(&maps.slope_moments)),
            (4, Sampler(&samplers[0])),
            (5, Sampler(&samplers[1])),
            (6, TextureView(gains)),
        ],
    );
    let questions: Vec<[[f32; 4]; 1]> = at.iter().map(|[x, z]| [[*x, *z, 0.5, 0.0]]).collect();
    let answers = kernel.ask(&questions).into_iter();
    answers.map(|[[x, y, z, _], [sx, sz, jacobian, _]]| [x, y, z, sx, sz, jacobian - 1.0]).collect()
}

/// Ratio of the rms difference of two surfaces to the rms of the first: of displacement, of slope, of Jacobian.
fn differences(a: &[[f64; 6]], b: &[[f64; 6]]) -> [f64; 3] {
    [0..3, 3..5, 5..6].map(|range| {
        let sum = |f: &dyn Fn(usize, usize) -> f64| -> f64 {
            (0..a.len()).map(|i| range.clone().map(|k| f(i, k).powi(2)).sum::<f64>()).sum()
        };
        (sum(&|i, k| a[i][k] - b[i][k]) / sum(&|i, k| a[i][k])).sqrt()
    })
}

#[test]
fn the_drawn_surface_is_that_of_the_open_sea_over_a_flat_bed_and_around_it() {
    let gpu = common::gpu();
    let state = format!("{STATE}&n=256&order=1");
    let plan = plan(&state);
    let coast = flat(&plan, f32::INFINITY);
    let half_m = 0.5 * coast.cell_m * (coast.size[0] - 1) as f64;
    let points: Vec<[f32; 2]> = (0..400)
        .map(|i| seastate::waves::noise::pcg4d([i, 1, 2, 3]))
        .map(|h| [h[0], h[1]].map(|h| (60.0 * (f64::from(h) / 4_294_967_296.0 - 0.5)) as f32))
        .collect();
    let mut transfer = coast.transfer(&plan);
    // Other waves count in full, too, so that all of the open sea is there.
    transfer.points.iter_mut().for_each(|point| point.short_gain = 1.0);
    let transfer = Arc::new(transfer);
    // In the middle of the coast; in the zone where both fade into each other; and in the open sea.
    for (frame, most) in
        [([1.0, 1.0], [0.01, 0.05, 0.08]), ([0.2, 1.0], [0.01, 0.05, 0.08]), ([-1.0, 1.0], [1e-3, 1e-3, 1e-3])]
    {
        let eye = coast.placement.world_m(frame.map(|x| x * half_m));
        let [open, coastal] = [None, Some(&transfer)].map(|transfer| surface(&gpu, transfer, &state, eye, &points));
        let found = differences(&open, &coastal);
        eprintln!("{frame:?}: {found:.4?}");
        assert!((0..3).all(|k| found[k] < most[k]), "{frame:?}: {found:?}");
    }
    // Waves that grow are seen: they are half as high again in the middle.
    let grown = Arc::new(SyntheticCoast { growth: 1.0, ..coast }.transfer(&plan));
    let eye = coast.placement.world_m([half_m, half_m]);
    let [open, coastal] = [None, Some(&grown)].map(|transfer| surface(&gpu, transfer, &state, eye, &points));
    let found = differences(&open, &coastal);
    assert!(found[0] > 0.1, "{found:?}");
}

#[test]
fn behind_the_waterline_there_are_no_waves() {
    let gpu = common::gpu();
    let plan = plan(STATE);
    let coast = flat(&plan, f32::INFINITY);
    let mut transfer = coast.transfer(&plan);
    let points = coast.size[0];
    // Land in the shoreward half.
    for (i, point) in transfer.points.iter_mut().enumerate() {
        if i % points > points / 2 {
            (point.short_gain, point.weight) = (0.0, 1.0);
        }
    }
    for (i, envelope) in transfer.envelopes.iter_mut().enumerate() {
        if i % points > points / 2 {
            *envelope = 0;
        }
    }
    let half_m = 0.5 * coast.cell_m * (points - 1) as f64;
    let eye = coast.placement.world_m([1.7 * half_m, half_m]);
    let at: Vec<[f32; 2]> = (0..100).map(|i| [(i % 10) as f32 - 5.0, (i / 10) as f32 - 5.0]).collect();
    let found = surface(&gpu, Some(&Arc::new(transfer)), STATE, eye, &at);
    let most = found.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
    assert!(most < 1e-3, "{most}");
}

#[test]
#[ignore = "draws pictures to look at after a change of the waves at a coast"]
fn pictures_of_a_slope() {
    let gpu = common::gpu();
    let state = format!("{STATE}&n=256&order=1");
    let mut params = query::parse(&state).0;
    let plan = Plan::new(&params);
    let coast = SyntheticCoast { shortening: 1.0, growth: 0.6, set_up_m: 0.2, waves: 200, ..flat(&plan, 1.0) };
    let mut transfer = coast.transfer(&plan);
    let breaking_m = 0.8 * own_hs_m(&plan, &transfer) as f32;
    transfer.points.iter_mut().for_each(|point| point.breaking_height_m = breaking_m);
    let transfer = Arc::new(transfer);
    let half_m = 0.5 * coast.cell_m * (coast.size[0] - 1) as f64;
    let eye = coast.placement.world_m([1.2 * half_m, half_m]);
    (params.camera.x_m, params.camera.z_m, params.camera.y_m) = (eye[0], eye[1], 25.0);
    // North is 0 degrees, and the land lies along the frame's x axis.
    params.camera.heading_deg = coast.placement.turn_rad.to_degrees() + 90.0 + 150.0;
    params.camera.pitch_deg = -14.0;
    params.clock.t_s = T_S;
    let size = [640, 360];
    for (name, transfer) in [("open", None), ("coast", Some(transfer))] {
        let mut ocean = Ocean::new(&gpu, PICTURE_FORMAT, OutputKind::Screen, &params);
        assert!(ocean.set_coast(transfer));
        let pixels = pollster::block_on(draw_ocean_picture(&gpu, &mut ocean, size)).expect("read-back");
        let png = seastate::files::picture::encode(size, &pixels, "", "").expect("a picture");
        let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("coast-{name}.png"));
        std::fs::write(path, png).expect("a file");
    }
}
