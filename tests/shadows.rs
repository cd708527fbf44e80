//! Shadows of waves on waves: the march over the height maps against rays cast over the same surface in f64.

mod common;

use common::wgsl;
use glam::DVec2;
use seastate::ocean::{Ocean, OutputKind};
use seastate::render;
use seastate::shaders::Shaders;
use wgpu::BindingResource::{Sampler, TextureView};
use wgpu::BufferUsages;

const MODULE: &str = "water/light";
/// Displacement of a point beside the eye's foot (x, z), filtered over some metres; or the visible fraction of the sun.
const ANSWER: &str = "
fn answer(question: Question) -> Answer {
  frame = picture_frame;
  let at = question[0];
  frame.sun_direction = question[1].xyz;
  var answer = vec4f(water_displacement(at.xy, at.z, false).displacement, 0.0);
  if question[1].w > 0.0 {
    answer.x = shadow_visible_sun(at.xy, water_round_footprint(at.z).mean_m);
  }
  return Answer(answer);
}
";

/// Distance between the points of a line, m; number of points, and of lines.
const STEP_M: f64 = 0.1;
const POINTS: usize = 8000;
const LINES: usize = 5;
/// Width over which the surface is filtered, m.
const FILTER_M: f64 = 0.3;
/// Points at the end of a line for which obstacles may be missing.
const LAST: usize = 2100;

/// A sea with a kernel that reads its surface.
struct Bench {
    kernel: wgsl::Kernel<2, 1>,
    toward: DVec2,
}

impl Bench {
    fn new(state: &str, shaders: Shaders) -> Self {
        let gpu = common::gpu();
        let params = common::params(state);
        let mut ocean = Ocean::new(&gpu, wgpu::TextureFormat::Rgba8Unorm, OutputKind::Screen, &params);
        let mut encoder = gpu.encoder("test");
        ocean.simulation().encode_with_f32_maps(&gpu, &mut encoder, params.clock.t_s);
        gpu.submit(encoder);
        let size = [640, 360];
        let frame = render::frame_uniform(&ocean.scene(size), ocean.simulation().maps(), size);
        let frame = wgsl::buffer(&gpu, bytemuck::bytes_of(&frame), BufferUsages::UNIFORM);
        let shaders = shaders.patched(
            MODULE,
            "var<uniform> frame: Frame;",
            "var<uniform> picture_frame: Frame;\nvar<private> frame: Frame;",
        );
        let mut kernel = wgsl::Kernel::new(&gpu, &shaders, MODULE, ANSWER);
        kernel.bind(0, &[(0, frame.as_entire_binding())]);
        let levels = gpu.sampler("levels", [wgpu::AddressMode::Repeat; 2], wgpu::MipmapFilterMode::Nearest);
        let simulation = ocean.simulation();
        let maps = simulation.maps();
        let resources = [
            (0, TextureView(&maps.displacement)),
            (1, TextureView(&maps.gradients)),
            (4, Sampler(&simulation.resources.repeating_sampler)),
            (5, Sampler(&levels)),
            (6, TextureView(&maps.no_coast)),
        ];
        kernel.bind(1, &resources);
        let [x, z] = ocean.scene(size).sea.downwind;
        Self { kernel, toward: DVec2::new(x, z).rotate(DVec2::from_angle(0.5)) }
    }

    fn ask(&self, points: &[DVec2], sun: Option<f64>) -> Vec<[f64; 4]> {
        let (sin, cos) = sun.unwrap_or(0.0).sin_cos();
        let sun = [self.toward.x * cos, sin, self.toward.y * cos, f64::from(u8::from(sun.is_some()))];
        let ask = |p: &DVec2| [[p.x as f32, p.y as f32, FILTER_M as f32, 0.0], sun.map(|s| s as f32)];
        let questions: Vec<_> = points.iter().map(ask).collect();
        self.kernel.ask(&questions).into_iter().map(|[answer]| answer).collect()
    }

    /// Undisplaced positions and heights of the water at points of a vertical plane that holds the sun.
    fn profile(&self, line: usize) -> (Vec<DVec2>, Vec<f64>) {
        let side = self.toward.perp() * (211.0 * (line as f64 - 2.0));
        let places: Vec<_> = (0..POINTS).map(|i| side + self.toward * (STEP_M * (i as f64 - 4000.0))).collect();
        let mut points = places.clone();
        let mut heights = Vec::new();
        for _ in 0..8 {
            let moved = self.ask(&points, None);
            points = places.iter().zip(&moved).map(|(p, d)| *p - DVec2::new(d[0], d[2])).collect();
            heights = moved.iter().map(|d| d[1]).collect();
        }
        (points, heights)
    }
}

/// Fractions of the water that lies in shadow, by rays and by the march, and of the points where the two disagree.
fn shadows(bench: &Bench, profiles: &[(Vec<DVec2>, Vec<f64>)], elevation_deg: f64) -> [f64; 3] {
    let elevation = elevation_deg.to_radians();
    let (mut sums, mut count) = ([0.0; 3], 0.0);
    for (points, heights) in profiles {
        let visible = bench.ask(points, Some(elevation));
        let mut highest = f64::NEG_INFINITY;
        for i in (0..POINTS).rev() {
            // Height over a plane that slopes with the sun's rays: a ray keeps its own.
            let own = heights[i] - STEP_M * i as f64 * elevation.tan();
            if i < POINTS - LAST {
                let hidden = f64::from(u8::from(highest > own));
                let marched = 1.0 - visible[i][0];
                sums = [sums[0] + hidden, sums[1] + marched, sums[2] + (hidden - marched).abs()];
                count += 1.0;
            }
            highest = highest.max(own);
        }
    }
    sums.map(|sum| sum / count)
}

const STATES: [&str; 3] = ["n=128&t=20", "wind=16&fetch=300&n=128&t=20", "wind=5&fetch=30&n=128&t=20"];
const ELEVATIONS_DEG: [f64; 5] = [2.0, 4.0, 6.0, 10.0, 15.0];

#[test]
fn marched_shadows_cover_what_rays_find_in_shadow() {
    let mut wrong = Vec::new();
    for state in STATES {
        let bench = Bench::new(state, wgsl::shaders());
        let profiles: Vec<_> = (0..LINES).map(|line| bench.profile(line)).collect();
        for elevation_deg in ELEVATIONS_DEG {
            let [cast, marched, apart] = shadows(&bench, &profiles, elevation_deg);
            let line = format!(
                "{state} at {elevation_deg} deg: {cast:.3} by rays, {marched:.3} by the march, {apart:.3} apart"
            );
            eprintln!("{line}");
            if !((marched - cast).abs() < 0.04 && apart < 0.09) {
                wrong.push(line);
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn a_march_of_few_steps_is_found() {
    let shaders = wgsl::shaders().patched(MODULE, "const SHADOW_STEPS = 12;", "const SHADOW_STEPS = 4;");
    let bench = Bench::new(STATES[1], shaders);
    let profiles: Vec<_> = (0..LINES).map(|line| bench.profile(line)).collect();
    let [cast, marched, apart] = shadows(&bench, &profiles, 6.0);
    assert!((marched - cast).abs() > 0.04 || apart > 0.09, "{cast} {marched} {apart}");
}
