//! The sea that the GPU computes, against theory: heights, direction, crests, sameness under n, loops, foam.

use half::f16;
use seastate::cli::stats;
use seastate::gpu::device::Gpu;
use seastate::gpu::readback;
use seastate::gpu::shaders::Shaders;
use seastate::model::{Params, Plan, query, statistics};
use seastate::sim::{MAX_STEPS, MapsF32, Simulation};

fn gpu() -> Gpu {
    pollster::block_on(Gpu::request()).expect("a GPU adapter; install mesa-vulkan-drivers")
}

fn params(state: &str) -> Params {
    let (params, notices) = query::parse(state);
    assert_eq!(notices, Vec::<String>::new());
    params
}

fn maps(gpu: &Gpu, state: &str, t_s: f64) -> MapsF32 {
    let mut sim = Simulation::new(&gpu.device, &gpu.queue, Plan::new(&params(state)), &Shaders::default());
    pollster::block_on(sim.read_f32(&gpu.device, &gpu.queue, t_s)).expect("read-back")
}

/// Theory, resolved and measured height over 64 seeds, and Parseval for each.
fn assert_height(state: &str) -> stats::Report {
    let report = pollster::block_on(stats::run(&gpu(), &params(state), 64)).expect("statistics");
    let (t, r, m) = (report.theory(), report.resolved(), report.measured());
    let text = format!("{state}\n{report}");
    assert!(r.m0_fraction >= 0.99, "{text}");
    assert!((r.hs_m / t.hs_m - 1.0).abs() < 0.01, "{text}");
    assert!(m.parseval_error < 1e-4, "Parseval {}: {text}", m.parseval_error);
    assert!((m.hs_m.value / t.hs_m - 1.0).abs() < 0.03, "{text}");
    let error = m.hs_m.error.expect("64 seeds have a standard error");
    assert!((m.hs_m.value - r.hs_m).abs() < 3.0 * error, "{text}");
    assert!((m.hs_m.value - t.hs_m).abs() < 3.0 * error, "{text}");
    assert!((m.mss.value / r.mss - 1.0).abs() < 0.02, "{text}");
    assert!(m.mean_m.value.abs() < 1e-4 * t.hs_m, "{text}");
    let from = m.from_deg.expect("a sea has a direction").value;
    assert!((from - 240.0).abs() < 3.0, "waves come from where the wind does: {text}");
    report
}

#[test]
fn ten_metres_per_second_over_a_hundred_kilometres() {
    let report = assert_height("wind=10&fetch=100");
    assert!((report.theory().hs_m / 2.139 - 1.0).abs() < 0.005);
    assert!((report.theory().tp_s / 6.23 - 1.0).abs() < 0.005);
}

#[test]
fn a_light_breeze() {
    assert_height("wind=5&fetch=20");
}

#[test]
fn a_gale() {
    assert_height("wind=20&fetch=500");
}

#[test]
fn a_hurricane() {
    assert_height("wind=30&fetch=1000");
}

#[test]
fn twenty_metres_of_water() {
    assert_height("wind=10&fetch=100&spectrum=tma&depth=20");
}

#[test]
fn five_metres_of_water() {
    assert_height("wind=10&fetch=100&spectrum=tma&depth=5");
}

#[test]
fn waves_travel_downwind() {
    let gpu = gpu();
    for dir in [0.0, 90.0, 215.0] {
        // The pattern of the long waves moves by the phase speed: correlate two times along the wind.
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
        // Phase speed of the slopes' dominant waves: near that of the peak, 9.7 m/s, and downwind.
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
    let mut crest = (0.0, 0.0);
    let mut trough = (0.0, 0.0);
    for (d, g) in maps.displacement(0).iter().zip(maps.gradients(0)) {
        let j = f64::from((1.0 + g[2]) * (1.0 + g[3]) - d[3] * d[3]);
        let side = if f64::from(d[1]) > sigma { &mut crest } else { &mut trough };
        if f64::from(d[1]).abs() > sigma {
            *side = (side.0 + j, side.1 + 1.0);
        }
    }
    let (crest, trough) = (crest.0 / crest.1, trough.0 / trough.1);
    assert!(
        crest < 0.95 && trough > 1.05,
        "the surface is squeezed at crests ({crest}) and stretched in troughs ({trough})"
    );
}

#[test]
fn raising_n_keeps_every_wave() {
    // The 64-point sea is the 128-point one without its shorter waves: compare coefficients by their transform.
    let gpu = gpu();
    let read = |state: &str| {
        let plan = Plan::new(&params(state));
        let mut sim = Simulation::new(&gpu.device, &gpu.queue, plan, &Shaders::default());
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let step = sim.push_step(&gpu.queue, 0.0, false);
        sim.passes.spectrum.run(&mut encoder, &sim.resources, step);
        let staging = readback::stage_buffer(&gpu.device, &mut encoder, &sim.resources.h0);
        gpu.queue.submit([encoder.finish()]);
        let bytes = pollster::block_on(readback::read(&gpu.device, staging)).expect("read-back");
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

#[test]
fn the_height_does_not_depend_on_n_or_cascades() {
    let height = |state: &str| {
        let plan = Plan::new(&params(state));
        statistics::Resolved::new(&plan, 1.0).hs_m
    };
    let reference = height("wind=12");
    for state in [
        "wind=12&n=64",
        "wind=12&n=128",
        "wind=12&n=512",
        "wind=12&cascades=2",
        "wind=12&cascades=3",
        "wind=12&cascades=4",
    ] {
        assert!((height(state) / reference - 1.0).abs() < 0.02, "{state}: {} against {reference}", height(state));
    }
}

#[test]
fn a_loop_closes() {
    let gpu = gpu();
    let state = "wind=12&n=64&loop=120";
    let (a, b) = (maps(&gpu, state, 7.0), maps(&gpu, state, 127.0));
    assert_eq!(a.texels, b.texels, "bit for bit");
}

/// Mean foam of each level after a cold start, and after running there from `from_s` in steps of `dt_s`.
fn foam(gpu: &Gpu, state: &str, run: Option<(f64, f64)>) -> Vec<f64> {
    let p = params(state);
    let mut sim = Simulation::new(&gpu.device, &gpu.queue, Plan::new(&p), &Shaders::default());
    let mut times = Vec::new();
    if let Some((from_s, dt_s)) = run {
        let steps = ((p.clock.t_s - from_s) / dt_s).round() as u32;
        times.extend((0..steps).map(|i| from_s + dt_s * f64::from(i)));
    }
    times.push(p.clock.t_s);
    for t_s in times {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        assert!(sim.encode(&gpu.queue, &mut encoder, t_s, [0.0; 2], MAX_STEPS));
        gpu.queue.submit([encoder.finish()]);
    }
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let copy = readback::stage_texture(&gpu.device, &mut encoder, &sim.resources.foam, 0);
    gpu.queue.submit([encoder.finish()]);
    let bytes = pollster::block_on(copy.read(&gpu.device)).expect("read-back");
    let texels: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let size = sim.resources.foam_n as usize;
    let values: Vec<f64> = texels.iter().map(|t| t[0].to_f64()).collect();
    assert!(values.iter().all(|f| (0.0..=1.0).contains(f)), "foam is bounded");
    values.chunks(size * size).map(|level| level.iter().sum::<f64>() / level.len() as f64).collect()
}

#[test]
fn a_calm_sea_has_no_foam_and_a_storm_has() {
    let gpu = gpu();
    assert_eq!(foam(&gpu, "wind=0&n=64&t=5", None), vec![0.0; 4]);
    let storm = foam(&gpu, "wind=20&fetch=500&n=64&t=5", None);
    let mean = storm.iter().sum::<f64>() / 4.0;
    let monahan = statistics::monahan_coverage(20.0);
    assert!(mean / monahan > 1.0 / 1.5 && mean / monahan < 1.5, "{storm:?} against {monahan}");
}

#[test]
fn foam_does_not_depend_on_how_one_came_there() {
    let gpu = gpu();
    let state = "wind=20&fetch=500&n=64&t=30";
    let mean = |f: Vec<f64>| f.iter().sum::<f64>() / 4.0;
    let cold = mean(foam(&gpu, state, None));
    let run = mean(foam(&gpu, state, Some((26.0, 1.0 / 30.0))));
    assert!((run / cold - 1.0).abs() < 0.03, "cold start {cold}, running {run}");
}

#[test]
fn maps_are_finite_at_the_corners_of_every_range() {
    use seastate::model::fields::{FIELDS, Kind};
    let gpu = gpu();
    for field in FIELDS.iter() {
        let Kind::Number { min, max, .. } = field.kind else { continue };
        for corner in [min, max] {
            let mut p = params("n=64");
            (field.set)(&mut p, corner);
            let t_s = p.clock.t_s;
            let mut sim = Simulation::new(&gpu.device, &gpu.queue, Plan::new(&p), &Shaders::default());
            let maps = pollster::block_on(sim.read_f32(&gpu.device, &gpu.queue, t_s)).expect("read-back");
            let finite = maps.texels.iter().flatten().all(|x| x.is_finite());
            assert!(finite, "{} = {corner}", field.key);
        }
    }
}
