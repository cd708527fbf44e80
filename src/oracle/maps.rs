//! Reference implementations in f64 of the map passes rows.wgsl, columns.wgsl and mips.wgsl in shaders/waves.

use super::transform::inverse_dft;
use super::{Complex, Texel, add, apply_to_columns, mul, scale, signed_index, times_i, unit_phasor};
use crate::waves::plan::{Cascade, Plan};
use std::f64::consts::TAU;

/// Displacement map, texels (Dx, eta, Dz, dDx/dz), and gradient map, texels (d eta/dx, d eta/dz, dDx/dx, dDz/dz), of a
/// cascade: n x n texels each, row by row, with the elevation eta and the horizontal displacement D in m. After the
/// transform along rows only, each texel is two complex numbers instead.
pub type CascadeMapPair = [Vec<Texel>; 2];

/// Complex amplitudes h(k, t), m, of a cascade's n x n waves at time `t_s` (s), from the initial amplitudes `h0` (m);
/// both are row by row in FFT order.
pub fn evolved_spectrum(plan: &Plan, cascade: &Cascade, h0: &[Complex], t_s: f64) -> Vec<Complex> {
    let n = plan.n as usize;
    let phase_time = plan.period_fraction_u32(t_s);
    (0..n * n)
        .map(|i| {
            let (x, z) = (i % n, i / n);
            let (ix, iz) = (signed_index(x, n), signed_index(z, n));
            if ix == 0 && iz == 0 {
                return [0.0, 0.0];
            }
            let turns = plan
                .wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32)
                .cycles_per_period
                .wrapping_mul(phase_time);
            let phase = unit_phasor(TAU * f64::from(turns) / 4_294_967_296.0);
            let back = h0[(n - z) % n * n + (n - x) % n];
            add(mul(h0[i], [phase[0], -phase[1]]), mul([back[0], -back[1]], phase))
        })
        .collect()
}

/// First of the two passes of a cascade's inverse Fourier transform at time `t_s` (s), along rows (x): computes the
/// spectra of the eight map channels from the initial amplitudes `h0` (m), packs pairs of real channels f and g as f +
/// i g, and transforms every row.
pub fn transform_rows(plan: &Plan, cascade: &Cascade, h0: &[Complex], t_s: f64) -> CascadeMapPair {
    let n = plan.n as usize;
    let h = evolved_spectrum(plan, cascade, h0, t_s);
    let packed = |pair: usize, i: usize| -> Texel {
        let (ix, iz) = (signed_index(i % n, n), signed_index(i / n, n));
        let (kx, kz) = (f64::from(ix) * cascade.dk(), f64::from(iz) * cascade.dk());
        let k = kx.hypot(kz);
        if k == 0.0 {
            return [0.0; 4];
        }
        let orbit = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32).orbit_width_over_height;
        // docs/sea.md, "Synthesis": D = i k/|k| coth(k depth) h, dDx/dz = -(kx kz/|k|) coth(k depth) h.
        let h = h[i];
        let pack = |f: Complex, g: Complex| add(f, times_i(g));
        let (first, second) = if pair == 0 {
            let (dx, dz) = (scale(times_i(h), orbit * kx / k), scale(times_i(h), orbit * kz / k));
            (pack(dx, dz), pack(h, scale(h, -orbit * kx * kz / k)))
        } else {
            let (dxx, dzz) = (scale(h, -orbit * kx * kx / k), scale(h, -orbit * kz * kz / k));
            (pack(scale(times_i(h), kx), scale(times_i(h), kz)), pack(dxx, dzz))
        };
        [first[0], first[1], second[0], second[1]]
    };
    [0, 1].map(|pair| {
        let plane: Vec<Texel> = (0..n * n).map(|i| packed(pair, i)).collect();
        plane.chunks(n).flat_map(transform_line).collect()
    })
}

/// Second of the two passes of the inverse Fourier transform, along columns (z): transforms every column of the result
/// `rows` of [`transform_rows`] and unpacks the displacement map and the gradient map.
pub fn transform_columns(n: usize, rows: &CascadeMapPair) -> CascadeMapPair {
    let [displacement, gradients] = [0, 1].map(|pair| apply_to_columns(n, &rows[pair], transform_line));
    // The packed displacement texel is (Dx + i Dz, eta + i dDx/dz).
    [displacement.into_iter().map(|t| [t[0], t[2], t[1], t[3]]).collect(), gradients]
}

/// Returns the next coarser mip level, n/2 x n/2 texels, of the n x n image `plane`: each texel is the mean of 2 x 2.
pub fn next_mip_level(n: usize, plane: &[Texel]) -> Vec<Texel> {
    let half = n / 2;
    (0..half * half)
        .map(|i| {
            let at = 2 * (i / half) * n + 2 * (i % half);
            std::array::from_fn(|c| 0.25 * [at, at + 1, at + n, at + n + 1].map(|j| plane[j][c]).iter().sum::<f64>())
        })
        .collect()
}

/// Slope moments (slope_x^2, slope_z^2, slope_x slope_z, 0) of each texel of a gradient map, divided by `scale`, the
/// unit in which the GPU's map stores them.
pub fn slope_moments(gradients: &[Texel], scale: f64) -> Vec<Texel> {
    gradients.iter().map(|g| [g[0] * g[0] / scale, g[1] * g[1] / scale, g[0] * g[1] / scale, 0.0]).collect()
}

fn transform_line(line: &[Texel]) -> Vec<Texel> {
    let first = inverse_dft(&line.iter().map(|t| [t[0], t[1]]).collect::<Vec<_>>());
    let second = inverse_dft(&line.iter().map(|t| [t[2], t[3]]).collect::<Vec<_>>());
    first.into_iter().zip(second).map(|(a, b)| [a[0], a[1], b[0], b[1]]).collect()
}
