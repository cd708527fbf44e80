//! Reference implementation in f64 of shaders/waves/spectrum.wgsl, the initial amplitudes
//! h0(k) = 1/2 (xr + i xi) sqrt(S(k) dkx dkz) with standard normal xr and xi.

use super::{Complex, signed_index};
use crate::waves::noise;
use crate::waves::plan::{Cascade, Plan};

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
        .map(|s| plan.lattice_cell_variance_m2_per_rad(s, cascade, &wave) * s.direction_density(wave.omega, k))
        .sum();
    let amplitude = 0.5 * density.sqrt();
    noise::complex_gaussian(noise::noise_words(plan.sea.seed, cascade.noise_key, ix, iz)).map(|x| x * amplitude)
}
