//! Reference implementation in f64 of the passes of a coast (shaders/coast): the sum over all its waves at each texel.

use super::maps::CascadeMapPair;
use super::{Complex, add, mul, scale, unit_phasor};
use crate::coast::Transfer;
use crate::waves::Plan;
use std::f64::consts::TAU;

/// The waves of a transfer at one time.
pub struct CoastWaves<'a> {
    transfer: &'a Transfer,
    /// For each wave h0 e^(-i omega t), m, and the ratio of its orbit axes divided by its wave number, m.
    phasors: Vec<(Complex, f64)>,
}

/// What the waves of a transfer make at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CoastPoint {
    /// Sum Z of h0 T e^(-i omega t), m: the waves have the elevation 2 Re Z.
    pub half_amplitude_m: Complex,
    /// Elevation with the set-up, m.
    pub elevation_m: f64,
    /// Potential of the horizontal displacement, m^2: its gradient is (Dx, Dz).
    pub potential_m2: f64,
    /// Reciprocal of the height from which waves break, 1/m.
    pub inverse_breaking_height: f64,
    /// Depth, m.
    pub depth_m: f64,
}

impl<'a> CoastWaves<'a> {
    /// The waves of `transfer` at time `t_s` (s), from the initial amplitudes `h0` (m) of the first cascade of `plan`.
    pub fn new(transfer: &'a Transfer, plan: &Plan, h0: &[Complex], t_s: f64) -> Self {
        let n = plan.n as i32;
        let phasor = |[ix, iz]: [i32; 2]| {
            let wave = plan.wave_at_squared_index(&plan.cascades[0], (ix * ix + iz * iz) as u32);
            let turns = wave.cycles_per_period.wrapping_mul(plan.period_fraction_u32(t_s));
            let turned = unit_phasor(-TAU * f64::from(turns) / 4_294_967_296.0);
            let amplitude = h0[(iz.rem_euclid(n) * n + ix.rem_euclid(n)) as usize];
            (mul(amplitude, turned), wave.orbit_width_over_height / wave.k)
        };
        Self { transfer, phasors: transfer.waves.iter().map(|wave| phasor(wave.lattice_index)).collect() }
    }

    /// The sum at a point (x, y) of the frame of the coast, m. Beyond the grid, the envelopes of its edge go on.
    pub fn at(&self, [x, y]: [f64; 2]) -> CoastPoint {
        let t = self.transfer;
        let (gx, gy) = (x / t.cell_m, y / t.cell_m);
        let [column, row] = [(gx, t.columns), (gy, t.rows)].map(|(g, count)| (g.max(0.0) as usize).min(count - 2));
        let beyond = gx - column as f64;
        let [fx, fy] = [beyond, gy - row as f64].map(|f| f.clamp(0.0, 1.0));
        let corners =
            [(0, 0, (1.0 - fx) * (1.0 - fy)), (1, 0, fx * (1.0 - fy)), (0, 1, (1.0 - fx) * fy), (1, 1, fx * fy)];
        let places = corners.map(|(dx, dy, share)| ((row + dy) * t.columns + column + dx, share));
        let mut out = CoastPoint::default();
        let mut potential = [0.0; 2];
        for (j, (wave, (phasor, slant))) in t.waves.iter().zip(&self.phasors).enumerate() {
            let group = &t.groups[wave.group as usize];
            let [here, next] = [0, 1].map(|step| group.column_phase_rad[column + step]);
            let phase = here + beyond * (next - here) + group.ky_rad_m * y;
            let envelopes = places.map(|(place, share)| scale(envelope(t, j, place), share));
            let envelope = envelopes.into_iter().fold([0.0; 2], add);
            let wave = mul(*phasor, mul(envelope, unit_phasor(phase)));
            out.half_amplitude_m = add(out.half_amplitude_m, wave);
            potential = add(potential, scale(wave, *slant));
        }
        for (place, share) in places {
            let point = &t.points[place];
            out.elevation_m += share * f64::from(point.set_up_m);
            out.inverse_breaking_height += share / f64::from(point.breaking_height_m);
            out.depth_m += share * f64::from(point.depth_m);
        }
        out.elevation_m += 2.0 * out.half_amplitude_m[0];
        out.potential_m2 = 2.0 * potential[0];
        out
    }
}

/// Envelope of a wave at a point of the grid.
fn envelope(transfer: &Transfer, wave: usize, place: usize) -> Complex {
    let packed = transfer.envelopes[wave * transfer.columns * transfer.rows + place];
    [packed as u16, (packed >> 16) as u16].map(half_float)
}

fn half_float(bits: u16) -> f64 {
    half::f16::from_bits(bits).to_f64()
}

/// Rolling foam, 0 to 1, where waves with the sum Z break: it lies on their fronts, which the crest reaches next.
pub fn roller(point: &CoastPoint) -> f64 {
    let [re, im] = point.half_amplitude_m;
    let over = ((height_over_breaking(point) - 0.9) / 0.2).clamp(0.0, 1.0);
    // The phase falls with time, and is 0 at the crest. The roller is strongest a sixth of a turn before it.
    let before = im.atan2(re) - 0.866_f64.atan2(0.5);
    over * over * (3.0 - 2.0 * over) * (0.5 + 0.5 * before.cos()).powi(8)
}

/// Height of the waves with the sum Z, relative to that from which they break.
pub fn height_over_breaking(point: &CoastPoint) -> f64 {
    let [re, im] = point.half_amplitude_m;
    4.0 * re.hypot(im) * point.inverse_breaking_height
}

/// Displacement and gradient maps of n x n texels from the sums at these texels, `texel_m` apart (m). Rows run along the
/// world's x axis. Derivatives are differences of fourth order.
pub fn maps(points: &[CoastPoint], texel_m: f64) -> CascadeMapPair {
    let n = points.len().isqrt();
    let at = |i: usize, x: i64, z: i64| {
        let [column, row] = [(i % n, x), (i / n, z)].map(|(at, step)| (at as i64 + step).rem_euclid(n as i64) as usize);
        &points[row * n + column]
    };
    const FIRST: [(i64, f64); 4] = [(-2, 1.0 / 12.0), (-1, -2.0 / 3.0), (1, 2.0 / 3.0), (2, -1.0 / 12.0)];
    const SECOND: [(i64, f64); 5] = [(-2, -1.0 / 12.0), (-1, 4.0 / 3.0), (0, -2.5), (1, 4.0 / 3.0), (2, -1.0 / 12.0)];
    let elevation = |i: usize, x: i64, z: i64| at(i, x, z).elevation_m;
    let potential = |i: usize, x: i64, z: i64| at(i, x, z).potential_m2;
    let along =
        |rule: &[(i64, f64)], value: &dyn Fn(i64) -> f64| rule.iter().map(|(step, w)| w * value(*step)).sum::<f64>();
    let texel = |i: usize| {
        let [eta_x, eta_z] =
            [along(&FIRST, &|s| elevation(i, s, 0)) / texel_m, along(&FIRST, &|s| elevation(i, 0, s)) / texel_m];
        let [dx, dz] =
            [along(&FIRST, &|s| potential(i, s, 0)) / texel_m, along(&FIRST, &|s| potential(i, 0, s)) / texel_m];
        let square = texel_m * texel_m;
        let xx = along(&SECOND, &|s| potential(i, s, 0)) / square;
        let zz = along(&SECOND, &|s| potential(i, 0, s)) / square;
        let xz = along(&FIRST, &|a| along(&FIRST, &|b| potential(i, a, b))) / square;
        [[dx, elevation(i, 0, 0), dz, xz], [eta_x, eta_z, xx, zz]]
    };
    let texels: Vec<_> = (0..points.len()).map(texel).collect();
    [0, 1].map(|kind| texels.iter().map(|texel| texel[kind]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_3, PI};

    #[test]
    fn half_floats_have_their_values() {
        let cases = [
            (0x0000, 0.0),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x3555, 0.333_251_953_125),
            (0x7bff, 65504.0),
            (0x0001, 2f64.powi(-24)),
        ];
        for (bits, value) in cases {
            assert_eq!(half_float(bits), value, "{bits:x}");
        }
    }

    #[test]
    fn a_roller_lies_before_the_crest_of_a_wave_that_breaks() {
        let point = |phase: f64, height_m: f64| CoastPoint {
            half_amplitude_m: scale(unit_phasor(phase), 0.25 * height_m),
            inverse_breaking_height: 0.5,
            ..CoastPoint::default()
        };
        assert_eq!(roller(&point(FRAC_PI_3, 1.7)), 0.0);
        assert!(roller(&point(FRAC_PI_3, 2.3)) > 0.99 && roller(&point(FRAC_PI_3 + PI, 2.3)) < 1e-3);
        assert!((roller(&point(FRAC_PI_3, 2.0)) - 0.5).abs() < 1e-3);
        assert!(roller(&point(1.4, 2.3)) > roller(&point(0.4, 2.3)));
    }

    #[test]
    fn differences_are_of_fourth_order() {
        let points = |n: usize| -> Vec<CoastPoint> {
            let value = |i: usize| (TAU * (2 * (i % n) + i / n) as f64 / n as f64).sin();
            let of = |i| CoastPoint { elevation_m: value(i), potential_m2: value(i), ..Default::default() };
            (0..n * n).map(of).collect()
        };
        // Slope 2 along x and 1 along z, and curvatures -4, -1 and -2 times the value, in radians.
        let error = |n: usize| {
            let [displacement, gradients] = maps(&points(n), TAU / n as f64);
            let at = n + 3;
            let ([dx, value, dz, xz], [sx, sz, xx, zz]) = (displacement[at], gradients[at]);
            let cos = (TAU * 7.0 / n as f64).cos();
            [dx - 2.0 * cos, dz - cos, sx - 2.0 * cos, sz - cos, xx + 4.0 * value, zz + value, xz + 2.0 * value]
                .into_iter()
                .fold(0.0, |most: f64, e| most.max(e.abs()))
        };
        let (coarse, fine) = (error(32), error(64));
        assert!(coarse < 0.01 && fine < coarse / 12.0, "{coarse} {fine}");
    }
}
