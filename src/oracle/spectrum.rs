//! Reference implementation in f64 of shaders/waves/spectrum.wgsl, the initial amplitudes
//! h0(k) = 1/2 (xr + i xi) sqrt(S(k) dkx dkz) with standard normal xr and xi.

use super::{Complex, signed_index};
use crate::waves::noise;
use crate::waves::plan::{Cascade, Plan};
use crate::waves::system::WaveSystem;
use std::f64::consts::{PI, TAU};

/// Initial complex amplitudes h0(k), m, of all n x n wave vectors of one cascade, row by row in FFT order.
pub fn initial_spectrum(plan: &Plan, cascade: &Cascade) -> Vec<Complex> {
    let n = plan.n as usize;
    (0..n * n).map(|i| initial_amplitude(plan, cascade, signed_index(i % n, n), signed_index(i / n, n))).collect()
}

fn initial_amplitude(plan: &Plan, cascade: &Cascade, ix: i32, iz: i32) -> Complex {
    let nyquist = -(plan.n as i32) / 2;
    let k = [f64::from(ix) * cascade.dk(), f64::from(iz) * cascade.dk()];
    let length = k[0].hypot(k[1]);
    // The wave number is computed from the squared index as in the plan, so that it rounds alike at the band's edges.
    let i2 = (ix * ix + iz * iz) as u32;
    let radius = cascade.dk() * f64::from(i2).sqrt();
    let outside = i2 == 0 || radius < cascade.k_low || radius >= cascade.k_high;
    if outside || ix == nyquist || iz == nyquist {
        return [0.0, 0.0];
    }
    let wave = plan.wave_at_squared_index(cascade, i2);
    debug_assert!((wave.k / length - 1.0).abs() < 1e-12);
    let density: f64 = (plan.systems.iter())
        .map(|s| {
            plan.lattice_cell_variance_m2_per_rad(s, cascade, &wave) * direction_density(s, wave.omega, k, cascade)
        })
        .sum();
    let amplitude = 0.5 * density.sqrt();
    noise::complex_gaussian(noise::noise_words(plan.sea.seed, cascade.noise_key, ix, iz)).map(|x| x * amplitude)
}

/// Directional spreading D, per rad, of the lattice cell of the wave vector `k` (rad/m). For densities over frequency and
/// direction it is written out here: bilinear between bands and directions, averaged over the angle dk / |k|.
fn direction_density(system: &WaveSystem, omega: f64, k: [f64; 2], cascade: &Cascade) -> f64 {
    let Some((measured, table)) = system.spectrum.measured.as_ref().and_then(|m| Some((m, m.directional_table()?)))
    else {
        return system.direction_density(omega, k);
    };
    // E(f, direction) of one band in all directions, m^2/Hz/rad: S(f) D.
    let energy = |band: usize| -> Vec<f64> {
        table.distribution_of_band(band).iter().map(|d| measured.bands()[band].1 * d).collect()
    };
    let frequencies: Vec<f64> = measured.bands().iter().map(|b| b.0).collect();
    let f = (omega / TAU).clamp(frequencies[0], frequencies[frequencies.len() - 1]);
    let upper = (1..frequencies.len() - 1).find(|&i| frequencies[i] > f).unwrap_or(frequencies.len() - 1);
    let t = (f - frequencies[upper - 1]) / (frequencies[upper] - frequencies[upper - 1]);
    let (below, above) = (energy(upper - 1), energy(upper));
    let row: Vec<f64> = below.iter().zip(&above).map(|(a, b)| (1.0 - t) * a + t * b).collect();
    let total: f64 = row.iter().sum::<f64>() * table.step_rad();
    if total <= 0.0 {
        return system.direction_density_in_cell(omega, k.map(|k| k / cascade.dk()));
    }
    let n = row.len();
    let at = |theta: f64| {
        // The direction that these waves come from, as a bearing, in steps of the table.
        let from_deg = (theta - 0.5 * PI).to_degrees() - table.first_from_deg();
        let steps = from_deg.rem_euclid(360.0) / 360.0 * n as f64;
        let (i, t) = (steps as usize % n, steps.fract());
        ((1.0 - t) * row[i] + t * row[(i + 1) % n]) / total
    };
    let (theta, half) = (k[1].atan2(k[0]), 0.5 * cascade.dk() / k[0].hypot(k[1]));
    // Gauss and Legendre's rule with four points: the roots of the polynomial 35 x^4 - 30 x^2 + 3 and their weights.
    let (inner, outer) =
        ((3.0_f64 / 7.0 - 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt(), (3.0_f64 / 7.0 + 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt());
    let root = 30.0_f64.sqrt();
    let pair = |x: f64, w: f64| 0.5 * w * (at(theta - half * x) + at(theta + half * x));
    pair(inner, (18.0 + root) / 36.0) + pair(outer, (18.0 - root) / 36.0)
}
