//! Spray at a coast (shaders/drops/spray_coast.wgsl): puffs of surf are born on the lip of a wave and stay born there, surf
//! throws them up in any wind, and waves burst on stone that they reach.

mod common;

use common::wgsl;
use seastate::coast::Transfer;
use seastate::gpu::Gpu;
use seastate::ocean::still::{PICTURE_FORMAT, present_and_read_back};
use seastate::ocean::{Ocean, OutputKind};
use seastate::render;
use seastate::shaders::Shaders;
use seastate::waves::noise;
use std::sync::Arc;
use wgpu::BindingResource::{Sampler, TextureView};

const BEACH: &str = "coast=beach&depth=12&wind=3&fetch=10&dir=255&scale2=1&hs2=1.5&tp2=12&dir2=245&order=1";

/// The waves at the coast of a state.
fn transfer(state: &str) -> Arc<Transfer> {
    common::coast_transfer(&common::params(state), 60, 64)
}

/// The lip near the place q[0].xy, q[0].z seconds after the birth of a puff there: where it was at the birth, whether it was
/// found, and the phase and the relative height of the wave there now.
const LIP: &str = "
fn answer(q: Question) -> Answer {
  spray.gravity_m_s2 = 9.80665;
  for (var c = 0u; c < frame.cascade_count; c++) {
    let map = frame.cascades[c];
    if map.coast_gains.z > 0.0 {
      let lip = spray_lip(map, q[0].xy, q[0].z, 0.1);
      let now = surf_sample(map, lip.now);
      return Answer(vec4f(lip.then, lip.found, 0.0), vec4f(atan2(now.y, now.x), now.z, 0.0, 0.0));
    }
  }
  return Answer(vec4f(0.0), vec4f(0.0));
}
";

/// Lips around `eye` at a time, `age_s` after the birth of their puffs.
fn lips(
    gpu: &Gpu,
    shaders: &Shaders,
    transfer: &Arc<Transfer>,
    eye: [f64; 2],
    t_s: f64,
    age_s: f32,
) -> Vec<[[f64; 4]; 2]> {
    let ocean = common::ocean_at_coast(gpu, &format!("{BEACH}&n=256"), transfer, eye, t_s);
    let maps = ocean.maps();
    let frame = render::frame_uniform(&ocean.scene([640, 360]), maps, [640, 360]);
    let frame = wgsl::buffer(gpu, bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM);
    let module = "drops/spray";
    let shaders = shaders
        .clone()
        .patched(module, "override WATER_COAST: bool = false;", "const WATER_COAST = true;")
        .patched(module, "@group(2) @binding(0) var<uniform> spray: Spray;", "var<private> spray: Spray;")
        .patched(module, "@group(2) @binding(1) var depth_map", "@group(3) @binding(1) var depth_map");
    let mut kernel = wgsl::Kernel::<1, 2>::new(gpu, &shaders, module, LIP);
    kernel.bind(0, &[(0, frame.as_entire_binding())]);
    let sampler = gpu.sampler("waves", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Nearest);
    kernel.bind(1, &[(0, TextureView(&maps.displacement)), (5, Sampler(&sampler))]);
    let place = |i: u32, axis: usize| (noise::pcg4d([i, 5, 3, 2])[axis] as f32 / 4_294_967_296.0 - 0.5) * 200.0;
    kernel.ask(&(0..6000).map(|i| [[place(i, 0), place(i, 1), age_s, 0.0]]).collect::<Vec<_>>())
}

/// Root mean square, m, of the way that the births of the same puffs seem to move between two times, and their number.
fn drift_m(first: &[[[f64; 4]; 2]], later: &[[[f64; 4]; 2]]) -> (f64, usize) {
    let breaks = |lip: &[[f64; 4]; 2]| lip[0][2] > 0.9 && lip[1][1] > 0.8;
    let squares: Vec<f64> = first
        .iter()
        .zip(later)
        .filter(|(a, b)| breaks(a) && breaks(b))
        .map(|(a, b)| (a[0][0] - b[0][0]).powi(2) + (a[0][1] - b[0][1]).powi(2))
        .collect();
    ((squares.iter().sum::<f64>() / squares.len() as f64).sqrt(), squares.len())
}

#[test]
fn puffs_of_surf_are_born_on_the_lip_and_stay_born_there() {
    let gpu = common::gpu();
    let shaders = wgsl::shaders();
    let transfer = transfer(&format!("{BEACH}&n=256"));
    let eye = [470.0, 150.0];
    let at = |shaders: &Shaders, age_s: f32| lips(&gpu, shaders, &transfer, eye, 40.0 + f64::from(age_s), age_s);
    let (first, later) = (at(&shaders, 0.2), at(&shaders, 0.7));
    let found: Vec<_> = first.iter().filter(|lip| lip[0][2] > 0.9).collect();
    let worst = found.iter().map(|lip| (lip[1][0] - 0.1).abs()).fold(0.0, f64::max);
    let (own, count) = drift_m(&first, &later);
    let wrong = shaders.patched("drops/spray", "out.velocity = sqrt(", "out.velocity = 0.5 * sqrt(");
    let (fault, _) = drift_m(&at(&wrong, 0.2), &at(&wrong, 0.7));
    eprintln!(
        "{} of {} lips found, {worst:.2} rad beside it at most; births of {count} puffs move by {own:.2} m in half a \
         second, with waves of half the speed by {fault:.2} m",
        found.len(),
        first.len()
    );
    assert!(found.len() > 1000 && worst < 0.3 && count > 100);
    assert!(own < 0.8 && fault > 2.0 * own, "{own} {fault}");
}

/// Number of pixels that spray changes in the picture of a state with a coast, whose waves are those of [`transfer`].
/// `ocean` keeps the pipelines.
fn sprayed(gpu: &Gpu, ocean: &mut Option<Ocean>, state: &str) -> usize {
    let params = |more: &str| common::params(&format!("{state}{more}&dither=0"));
    let ocean = ocean.get_or_insert_with(|| Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, &params("")));
    ocean.set_params(&params(""));
    // Both pictures show the same foam, which is computed once.
    assert!(ocean.set_coast(Some(transfer(state))));
    let mut picture = |more: &str| {
        ocean.set_params(&params(more));
        let mut encoder = gpu.encoder("picture");
        ocean.record_frame_with_complete_foam(&mut encoder, [240, 135]);
        let picture = present_and_read_back(gpu, encoder, [240, 135], |pass| ocean.present(pass));
        pollster::block_on(picture).expect("a picture")
    };
    let (without, with) = (picture(""), picture("&spray=1"));
    without.chunks(4).zip(with.chunks(4)).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2)).count()
}

#[test]
fn surf_throws_up_spray_in_any_wind_and_waves_burst_on_stone() {
    let gpu = common::gpu();
    let mut ocean = None;
    let [high, low] = [1.8, 0.15].map(|hs_m| {
        let sea = BEACH.replace("hs2=1.5", &format!("hs2={hs_m}"));
        sprayed(&gpu, &mut ocean, &format!("{sea}&n=256&x=530&z=150&y=2.5&heading=215&pitch=1.5&fov=32&t=38"))
    });
    // A crest of the high waves meets the breakwater at this time.
    let [bursts, laps] = [2.6, 0.3].map(|hs_m| {
        let state = format!(
            "coast=harbour&depth=10.9&wind=3&fetch=10&dir=225&scale2=1&hs2={hs_m}&tp2=9&dir2=220&n=256&x=0&z=-5&y=4\
             &heading=97&pitch=2&fov=36&t=48"
        );
        sprayed(&gpu, &mut ocean, &state)
    });
    eprintln!("pixels with spray: surf {high}, small waves {low}; breakwater {bursts}, small waves {laps}");
    assert!(high > 500 && low == 0, "{high} {low}");
    assert!(bursts > 150 && laps == 0, "{bursts} {laps}");
}
