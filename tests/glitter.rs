//! Mean square slopes from the sun glitter in rendered pictures, by the method of Cox and Munk (1954): the brightness
//! of a pixel is proportional to the probability density of the slope that reflects the sun there.

mod common;

use glam::DVec3;
use half::f16;
use seastate::gpu::Gpu;
use seastate::gpu::readback;
use seastate::ocean::still::PICTURE_FORMAT;
use seastate::ocean::{Ocean, OutputKind};
use seastate::waves::slopes::{SlopeVariance, cox_munk_slope_variance};

const SIZE: [u32; 2] = [192, 192];
const INDEX: f64 = 1.333;

fn fresnel(cosine: f64) -> f64 {
    let inside = (1.0 - (1.0 - cosine * cosine) / (INDEX * INDEX)).sqrt();
    let s = (cosine - INDEX * inside) / (cosine + INDEX * inside);
    let p = (INDEX * cosine - inside) / (INDEX * cosine + inside);
    0.5 * (s * s + p * p)
}

/// Linear red radiance and view direction of every pixel.
fn light(gpu: &Gpu, state: &str) -> (Vec<f64>, Vec<DVec3>) {
    let mut ocean = Ocean::new(gpu, PICTURE_FORMAT, OutputKind::Screen, &common::params(state));
    let mut encoder = gpu.encoder("test");
    // No foam replay.
    ocean.record_frame(&mut encoder, SIZE, 0);
    let copy = readback::stage_texture(gpu, &mut encoder, ocean.lit_picture_texture().expect("a picture"), 0);
    gpu.submit(encoder);
    let bytes = pollster::block_on(copy.read(gpu)).expect("read-back");
    let texels: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    let view = ocean.scene(SIZE).view;
    let dirs = (0..SIZE[0] * SIZE[1]).map(|i| {
        let x = 2.0 * (f64::from(i % SIZE[0]) + 0.5) / f64::from(SIZE[0]) - 1.0;
        let y = 1.0 - 2.0 * (f64::from(i / SIZE[0]) + 0.5) / f64::from(SIZE[1]);
        (view.forward + view.right * (view.tan_half_fov[0] * x) + view.up * (view.tan_half_fov[1] * y)).normalize()
    });
    (texels.iter().map(|t| t[0].to_f64()).collect(), dirs.collect())
}

/// Slope variances along and across the wind from a picture looking down, with the sun in the zenith: the fit of a
/// normal density to the brightness in bins of slope.
fn measured(gpu: &Gpu, wind: f64, more: &str) -> SlopeVariance {
    // Waves come from the north, so z is along the wind. The camera sees many waves but little air.
    let state = format!("wind={wind}&dir=0&n=128&t=20&foam=0&y=1500&pitch=-89&heading=0&fov=100&sun=90&haze=0{more}");
    let (bright, dirs) = light(gpu, &state);
    let (dark, _) = light(gpu, &format!("{state}&glitter=0"));
    const BINS: usize = 25;
    let reach = 2.2 * cox_munk_slope_variance(wind)[0].max(cox_munk_slope_variance(wind)[1]).sqrt();
    let mut bins = vec![(0.0, 0.0); BINS * BINS];
    let bin = |s: f64| ((s / reach + 1.0) * 0.5 * BINS as f64).floor();
    for ((b, d), dir) in bright.iter().zip(&dark).zip(&dirs) {
        let v = -*dir;
        let h = (v + DVec3::Y).normalize();
        let (along, across) = (bin(-h.z / h.y), bin(-h.x / h.y));
        let inside = 0.0..BINS as f64;
        if inside.contains(&along) && inside.contains(&across) {
            let density = (b - d) * v.y * h.y.powi(4) / fresnel(v.dot(h));
            let (sum, count) = &mut bins[along as usize * BINS + across as usize];
            *sum += density;
            *count += 1.0;
        }
    }
    let most = bins.iter().filter(|(_, n)| *n > 3.0).map(|(s, n)| s / n).fold(0.0, f64::max);
    // Weighted least squares: ln density = a + b u + c w + d u^2 + e w^2.
    let mut normal = [[0.0; 6]; 5];
    for (i, (sum, count)) in bins.iter().enumerate() {
        let density = sum / count;
        if *count > 3.0 && density > 0.05 * most {
            let slope = |i: usize| (2.0 * (i as f64 + 0.5) / BINS as f64 - 1.0) * reach;
            let (u, w) = (slope(i / BINS), slope(i % BINS));
            let row = [1.0, u, w, u * u, w * w, density.ln()];
            for (a, line) in normal.iter_mut().enumerate() {
                for (b, cell) in line.iter_mut().enumerate() {
                    *cell += count * density * row[a] * row[b];
                }
            }
        }
    }
    let fit = solve(normal);
    [-0.5 / fit[3], -0.5 / fit[4]]
}

/// Gaussian elimination without pivoting, for a positive definite matrix.
fn solve(mut m: [[f64; 6]; 5]) -> [f64; 5] {
    for i in 0..5 {
        let pivot = m[i];
        for line in m.iter_mut().skip(i + 1) {
            let factor = line[i] / pivot[i];
            line.iter_mut().zip(pivot).for_each(|(x, p)| *x -= factor * p);
        }
    }
    let mut out = [0.0; 5];
    for i in (0..5).rev() {
        let rest: f64 = (i + 1..5).map(|j| m[i][j] * out[j]).sum();
        out[i] = (m[i][5] - rest) / m[i][i];
    }
    out
}

#[test]
fn the_glitter_is_as_wide_as_cox_and_munk_found_it() {
    let gpu = common::gpu();
    for wind in [3.0, 7.0, 14.0] {
        let (got, want) = (measured(&gpu, wind, ""), cox_munk_slope_variance(wind));
        let off = [got[0] / want[0] - 1.0, got[1] / want[1] - 1.0];
        eprintln!("{wind} m/s: upwind {:.5} of {:.5}, crosswind {:.5} of {:.5}", got[0], want[0], got[1], want[1]);
        assert!(off.iter().all(|o| o.abs() < 0.15), "{wind} m/s: {off:?}");
    }
}

/// Check of the method: the measured variances grow by the variance of the added roughness on both axes.
#[test]
fn the_measure_sees_added_roughness() {
    let gpu = common::gpu();
    // alpha = 0.35^2, variance alpha^2 / 2 on each axis.
    let (plain, rough) = (measured(&gpu, 5.0, ""), measured(&gpu, 5.0, "&roughness=0.35"));
    let added = 0.5 * 0.35f64.powi(4);
    for (axis, (a, b)) in plain.iter().zip(&rough).enumerate() {
        assert!(((b - a) / added - 1.0).abs() < 0.25, "axis {axis}: {a} to {b}, added {added}");
    }
}
