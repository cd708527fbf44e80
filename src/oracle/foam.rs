//! Reference implementation in f64 of the foam pass, shaders/foam/foam.wgsl.

use super::Texel;

/// Displacement map and gradient map of one cascade at one mip level, the input of the foam pass.
#[derive(Clone, Debug)]
pub struct MipLevel<'a> {
    /// Number of texels along a side of both maps at this mip level.
    pub n: usize,
    /// Displacement map, n x n texels (Dx, eta, Dz, dDx/dz): horizontal displacement D and elevation eta, m.
    pub displacement: &'a [Texel],
    /// Gradient map, n x n texels (d eta/dx, d eta/dz, dDx/dx, dDz/dz): elevation eta, horizontal displacement D.
    pub gradients: &'a [Texel],
}

/// Returns the displacement texel and the gradient texel at the position `uv` = (x, z) in units of the patch's side, by
/// bilinear filtering. The maps repeat outside 0 to 1.
pub fn sample_bilinear(level: &MipLevel<'_>, uv: [f64; 2]) -> [Texel; 2] {
    let n = level.n as i64;
    let [u, v] = uv.map(|c| c * level.n as f64 - 0.5);
    let (x, z) = (u.floor(), v.floor());
    let (fx, fz) = (u - x, v - z);
    let mut out = [[0.0; 4]; 2];
    for (dx, dz, weight) in
        [(0, 0, (1.0 - fx) * (1.0 - fz)), (1, 0, fx * (1.0 - fz)), (0, 1, (1.0 - fx) * fz), (1, 1, fx * fz)]
    {
        let i = ((z as i64 + dz).rem_euclid(n) * n + (x as i64 + dx).rem_euclid(n)) as usize;
        for (out, map) in out.iter_mut().zip([level.displacement, level.gradients]) {
            *out = std::array::from_fn(|k| out[k] + weight * map[i][k]);
        }
    }
    out
}

/// Jacobian (1 + lx dDx/dx)(1 + lz dDz/dz) - lx lz dDx/dz dDz/dx of the horizontal displacement (lx Dx, lz Dz). The
/// arguments are the strains dDx/dx, dDz/dz, dDx/dz and dDz/dx at one point, summed over all cascades and without the
/// chop factors, and the chop factors lx and lz.
pub fn displacement_jacobian([xx, zz, xz, zx]: [f64; 4], [lx, lz]: [f64; 2]) -> f64 {
    (1.0 + lx * xx) * (1.0 + lz * zz) - lx * lz * xz * zx
}

/// Amount of foam F (0 to 1) after a time step of `dt_s` seconds, from its amount `before` the step: the exact solution
/// of dF/dt = `rate_per_s` `source` (1 - F) - F / `decay_s`, with the foam source `source` (0 to 1) constant in time,
/// the formation rate `rate_per_s` in 1/s and the decay time `decay_s` in s.
pub fn foam_after_step(before: f64, source: f64, rate_per_s: f64, decay_s: f64, dt_s: f64) -> f64 {
    let loss = rate_per_s * source + 1.0 / decay_s;
    let goal = rate_per_s * source / loss;
    goal + (before - goal) * (-loss * dt_s).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foam_does_not_depend_on_the_frame_rate_and_stays_bounded() {
        let run = |rate_hz: i32| {
            (0..10 * rate_hz).fold(0.0, |f, i| {
                let t = f64::from(i) / f64::from(rate_hz);
                foam_after_step(f, if (t as i32) % 3 == 0 { 0.8 } else { 0.0 }, 2.0, 4.0, 1.0 / f64::from(rate_hz))
            })
        };
        assert!((run(30) / run(144) - 1.0).abs() < 1e-6);
        assert!(run(30) > 0.0 && (0..1000).fold(0.0, |f, _| foam_after_step(f, 1.0, 10.0, 4.0, 0.1)) <= 1.0);
    }
}
