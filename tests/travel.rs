//! A single wave on the GPU travels downwind at the phase speed omega / k of each dispersion relation. Loops are not
//! tested, because they round omega to multiples of 2 pi / period. Without a loop the period is a day, and the error at
//! most 4e-5 rad/s.

mod common;

use common::{gpu, simulation};
use seastate::gpu::readback;
use seastate::gpu::timer::Timer;
use std::f64::consts::TAU;

const N: usize = 64;

/// Phase in rad of the wave with the lattice indices (ix, iz) in the heights of the first cascade.
fn phase(heights: &[f64], ix: i32, iz: i32) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (i, eta) in heights.iter().enumerate() {
        let turn = TAU * (f64::from(ix) * (i % N) as f64 + f64::from(iz) * (i / N) as f64) / N as f64;
        re += eta * turn.cos();
        im -= eta * turn.sin();
    }
    im.atan2(re)
}

/// Angular frequency of the wave (ix, iz) in a sea without other waves, rad/s; `about` is an estimate of it.
fn speed(state: &str, ix: i32, iz: i32, about: f64) -> f64 {
    let gpu = gpu();
    let mut sim = simulation(&gpu, state);
    let at = (iz.rem_euclid(N as i32) as usize) * N + ix.rem_euclid(N as i32) as usize;
    let mut h0 = vec![[0.0f32; 2]; N * N * sim.plan().cascades.len()];
    h0[at] = [0.3, -0.1];
    let mut heights = |t_s: f64| -> Vec<f64> {
        let slot = sim.upload_sea_uniform(&gpu, t_s, true);
        gpu.queue.write_buffer(&sim.resources.current_waves().h0, 0, bytemuck::cast_slice(&h0));
        let mut encoder = gpu.encoder("test");
        sim.passes.transform.record_rows(&mut encoder, &Timer::default(), slot);
        sim.passes.transform.record_columns(&mut encoder, &Timer::default(), &sim.resources, slot);
        let staging = readback::stage_buffer(&gpu, &mut encoder, &sim.resources.row_transforms);
        gpu.submit(encoder);
        let bytes = pollster::block_on(readback::read(&gpu, staging)).expect("read-back");
        let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        texels[..N * N].iter().map(|t| f64::from(t[1])).collect()
    };
    let (start, step_s) = (5000.0, 0.5 / about);
    let (before, after) = (phase(&heights(start), ix, iz), phase(&heights(start + step_s), ix, iz));
    // The phase of a wave that travels along +k decreases.
    (before - after + 3.0 * TAU / 2.0).rem_euclid(TAU) / step_s - TAU / 2.0 / step_s
}

#[test]
fn every_dispersion_has_its_speed() {
    // With wind from the west the waves travel along +x. A cascade set by hand has a known lattice.
    for (more, patch_m, depth_m, tension) in [
        ("dispersion=deep&depth=3", 200.0, f64::INFINITY, 0.0),
        ("dispersion=finite&depth=3", 200.0, 3.0, 0.0),
        ("dispersion=finite&depth=20", 500.0, 20.0, 0.0),
        ("dispersion=capillary&depth=4000", 0.4, 4000.0, 0.074 / 1025.0),
        ("dispersion=capillary&depth=1&tension=0.03&density=900", 0.8, 1.0, 0.03 / 900.0),
    ] {
        let state = format!("{more}&n=64&cascades=1&patch1={patch_m}&high1=10000&dir=270&wind=10");
        for (ix, iz) in [(3, 0), (9, 4), (20, -7)] {
            let k = TAU / patch_m * f64::from(ix).hypot(f64::from(iz));
            let want = ((9.81 * k + tension * k.powi(3)) * (k * depth_m).tanh()).sqrt();
            let got = speed(&state, ix, iz, want);
            assert!((got / want - 1.0).abs() < 1e-3, "{state} k {k}: {got} rad/s instead of {want}");
        }
    }
}
