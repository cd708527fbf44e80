//! Motion and pressure of the water below the surface at a fixed point, in linear theory.
//!
//! A wave with the elevation amplitude a and the wave number k moves the water at the height z (m, negative below the
//! still water) over a bed at the depth h: horizontally with the velocity amplitude a omega cosh(k (z + h)) / sinh(k h),
//! vertically with a omega sinh(k (z + h)) / sinh(k h). The dynamic pressure, the pressure less that of still water, has
//! the amplitude rho a omega^2 / k cosh(k (z + h)) / sinh(k h), which for gravity waves is rho g a cosh(k (z + h)) /
//! cosh(k h). In deep water all three fall as e^(k z).

use crate::coast::Transfer;
use crate::coast::local_wave::LocalWave;
use crate::coast::transfer::CoastalWaves;
use crate::waves::Plan;
use crate::waves::lattice::{LatticeWave, period_fraction_u32};
use crate::waves::statistics::{initial_amplitude, lattice_indices};
use crate::waves::table::{SpectrumTable, entry_index};
use std::collections::HashSet;
use std::f64::consts::TAU;
use std::sync::Arc;

/// One wave at a fixed point.
#[derive(Clone, Copy, Debug)]
struct WaveAtPoint {
    /// Complex amplitude (re, im) of the elevation at the point at time 0, m.
    amplitude_m: [f64; 2],
    /// That amplitude times the unit vector (x, z) of travel. Waves of a coast have no single direction, before a wall for
    /// instance: there it is -i grad A / k with the complex amplitude A(x, z).
    along_m: [[f64; 2]; 2],
    cycles_per_period: u32,
    omega_rad_s: f64,
    wave_number_rad_m: f64,
    /// Factors on omega times the elevation: for the horizontal and for the vertical velocity.
    velocity_factors: [f64; 2],
}

/// The strongest waves of a sea at a fixed point below or at the still water, from which the motion of the water there is
/// computed.
#[derive(Clone, Debug)]
pub struct WaterMotion {
    waves: Vec<WaveAtPoint>,
    density_kg_m3: f64,
    period_s: f64,
}

/// Motion of the water at a point and a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaterSample {
    /// Elevation of the surface by linear theory above the point, m: a sum of sines, without the displacement sideways
    /// that sharpens the crests of [`super::StrongestWaves::sample`].
    pub linear_elevation_m: f64,
    /// Velocity of the water (x, y, z), m/s.
    pub velocity_m_s: [f64; 3],
    /// Dynamic pressure, Pa: the pressure less that of still water.
    pub dynamic_pressure_pa: f64,
}

impl WaterMotion {
    /// Takes the `wave_count` strongest waves of a planned sea at the point (x, z) of the world, m, and at `height_m`
    /// from the still water, m. Heights above 0 count as 0, those below the bed as the bed.
    pub fn new(plan: &Plan, at: [f64; 2], height_m: f64, wave_count: usize) -> Self {
        let waves = open_waves(
            plan,
            at,
            |_| 1.0,
            |wave| velocity_factors(wave.k, wave.orbit_width_over_height, plan.sea.depth_m, height_m.min(0.0)),
        );
        Self::strongest(plan, waves, wave_count)
    }

    /// As [`Self::new`], at a coast: with what this makes of the waves, in the depth there. There is no motion on land. A
    /// transfer of another sea changes nothing.
    pub fn at_coast(plan: &Plan, transfer: &Arc<Transfer>, at: [f64; 2], height_m: f64, wave_count: usize) -> Self {
        let Some(coast) = CoastalWaves::new(transfer.clone(), plan) else {
            return Self::new(plan, at, height_m, wave_count);
        };
        let gains = transfer.gains(at);
        let coastal: HashSet<[i32; 2]> = transfer.waves.iter().map(|wave| wave.lattice_index).collect();
        let gain = |index: Option<[i32; 2]>| {
            let is_coastal = index.is_some_and(|index| coastal.contains(&index));
            gains.short_gain * if is_coastal { 1.0 - gains.weight } else { 1.0 }
        };
        // The wave numbers are those of the depth at the point.
        let depth_m = depth_at_coast_m(plan, transfer, at);
        if depth_m <= 0.0 {
            return Self::strongest(plan, Vec::new(), 0);
        }
        let local = |omega_rad_s: f64| {
            let k = LocalWave::new(omega_rad_s, depth_m, plan.sea.gravity_m_s2).k;
            (k, velocity_factors(k, 1.0 / (k * depth_m).tanh(), depth_m, height_m.min(0.0)))
        };
        let mut waves = open_waves(plan, at, gain, |wave| {
            if depth_m == plan.sea.depth_m {
                velocity_factors(wave.k, wave.orbit_width_over_height, depth_m, height_m.min(0.0))
            } else {
                local(wave.omega).1
            }
        });
        waves.extend(coast.at_point(at).into_iter().filter(|_| gains.weight > 0.0).map(|wave| {
            let (k, velocity_factors) = local(wave.omega_rad_s);
            WaveAtPoint {
                amplitude_m: wave.amplitude_m.map(|part| gains.weight * part),
                along_m: wave.gradient.map(|[re, im]| [im, -re].map(|part| gains.weight / k * part)),
                cycles_per_period: wave.cycles_per_period,
                omega_rad_s: wave.omega_rad_s,
                wave_number_rad_m: k,
                velocity_factors,
            }
        }));
        Self::strongest(plan, waves, wave_count)
    }

    fn strongest(plan: &Plan, mut waves: Vec<WaveAtPoint>, wave_count: usize) -> Self {
        let energy = |w: &WaveAtPoint| w.amplitude_m[0].powi(2) + w.amplitude_m[1].powi(2);
        waves.sort_by(|a, b| energy(b).total_cmp(&energy(a)));
        waves.truncate(wave_count);
        Self { waves, density_kg_m3: plan.sea.density_kg_m3, period_s: plan.repeat_period_s }
    }

    /// Motion of the water at time `t_s`, s.
    pub fn sample(&self, t_s: f64) -> WaterSample {
        let time = period_fraction_u32(self.period_s, t_s);
        let mut sum = WaterSample::default();
        for wave in &self.waves {
            let turns = f64::from(wave.cycles_per_period.wrapping_mul(time)) / 4_294_967_296.0;
            let (sin, cos) = (-TAU * turns).sin_cos();
            let [re, im] = wave.amplitude_m;
            let (elevation, quadrature) = (re * cos - im * sin, re * sin + im * cos);
            let along = wave.along_m.map(|[re, im]| re * cos - im * sin);
            let [horizontal, vertical] = wave.velocity_factors.map(|f| f * wave.omega_rad_s);
            sum.linear_elevation_m += elevation;
            sum.velocity_m_s[0] += horizontal * along[0];
            sum.velocity_m_s[1] += vertical * quadrature;
            sum.velocity_m_s[2] += horizontal * along[1];
            sum.dynamic_pressure_pa +=
                self.density_kg_m3 * wave.omega_rad_s / wave.wave_number_rad_m * horizontal * elevation;
        }
        sum
    }
}

/// Depth of the still water, m, at the point `at` (x, z) of the world, m; negative on land. Around the coast it is that of
/// the open sea.
pub fn depth_at_coast_m(plan: &Plan, transfer: &Transfer, at: [f64; 2]) -> f64 {
    let gains = transfer.gains(at);
    if gains.weight > 0.0 { gains.depth_m } else { plan.sea.depth_m }
}

/// All waves of the open sea at a point, times `gain`, which gets the lattice indices of waves of the first cascade.
fn open_waves(
    plan: &Plan,
    [x_m, z_m]: [f64; 2],
    gain: impl Fn(Option<[i32; 2]>) -> f64,
    velocity_factors: impl Fn(&LatticeWave) -> [f64; 2],
) -> Vec<WaveAtPoint> {
    let mut waves = Vec::new();
    for (number, cascade) in plan.cascades.iter().enumerate() {
        let table = SpectrumTable::new(plan, cascade);
        let copies = plan.tiling(cascade).patch_copies_at([x_m, z_m]);
        let place = [x_m, z_m].map(|v| v % cascade.patch_m / cascade.patch_m);
        for (ix, iz) in lattice_indices(plan.n) {
            let wave = table.waves[entry_index(ix, iz)];
            if wave.k == 0.0 {
                continue;
            }
            // A blend of shifted copies of the patch is one wave at a fixed point.
            let mut phasor = [0.0; 2];
            for copy in copies.iter().filter(|c| c.weight > 0.0) {
                let at = [0, 1].map(|i| place[i] + copy.shift_in_patches[i]);
                let (sin, cos) = (TAU * (f64::from(ix) * at[0] + f64::from(iz) * at[1]).fract()).sin_cos();
                phasor = [phasor[0] + copy.weight * cos, phasor[1] + copy.weight * sin];
            }
            let scale = 2.0 * gain((number == 0).then_some([ix, iz]));
            let [re, im] = initial_amplitude(plan, cascade, &table, ix, iz).map(|part| scale * part);
            let amplitude_m = [re * phasor[0] - im * phasor[1], re * phasor[1] + im * phasor[0]];
            if amplitude_m == [0.0; 2] {
                continue;
            }
            waves.push(WaveAtPoint {
                amplitude_m,
                along_m: [ix, iz].map(|i| amplitude_m.map(|part| f64::from(i) * cascade.dk() / wave.k * part)),
                cycles_per_period: wave.cycles_per_period,
                omega_rad_s: wave.omega,
                wave_number_rad_m: wave.k,
                velocity_factors: velocity_factors(&wave),
            });
        }
    }
    waves
}

/// Factors cosh(k (z + h)) / sinh(k h) and sinh(k (z + h)) / sinh(k h) at the height z = `height_m` <= 0 over a bed at
/// the depth h, written without overflow. A wave whose orbits are circles at the surface is one of deep water.
fn velocity_factors(k: f64, orbit_width_over_height: f64, depth_m: f64, height_m: f64) -> [f64; 2] {
    let height_m = height_m.max(-depth_m);
    let decay = (k * height_m).exp();
    if orbit_width_over_height <= 1.0 {
        return [decay; 2];
    }
    let (reflected, divisor) = ((-2.0 * k * (height_m + depth_m)).exp(), 1.0 - (-2.0 * k * depth_m).exp());
    [decay * (1.0 + reflected) / divisor, decay * (1.0 - reflected) / divisor]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::StrongestWaves;
    use crate::state::query;

    /// The motion is that of linear theory, so the sea is of first order.
    fn plan(state: &str) -> Plan {
        Plan::new(&query::parse(&format!("{state}&order=1")).0)
    }

    #[test]
    fn at_the_surface_it_is_the_drawn_sea_without_chop() {
        for state in ["wind=12&fetch=200&n=64&chop=0", "wind=8&depth=6&spectrum=tma&n=64&chop=0&untile=0"] {
            let plan = plan(state);
            let all = StrongestWaves::for_height_error(&plan, 0.0);
            for (x, z, t) in [(0.0, 0.0, 0.0), (123.4, -567.8, 33.3), (-9000.0, 20.0, 5000.25)] {
                let (want, got) = (all.sample(x, z, t), WaterMotion::new(&plan, [x, z], 0.0, usize::MAX).sample(t));
                assert!((got.linear_elevation_m - want.height_m).abs() < 1e-9, "{state}: {got:?} {want:?}");
                for (a, b) in got.velocity_m_s.iter().zip(want.velocity_m_s) {
                    assert!((a - b).abs() < 1e-9, "{state}: {got:?} {want:?}");
                }
            }
        }
    }

    #[test]
    fn the_motion_obeys_the_equations() {
        for state in ["wind=12&fetch=200&n=64", "wind=12&depth=8&n=64&spectrum=tma"] {
            let plan = plan(&format!("{state}&untile=0"));
            let (at, t, d) = ([31.0, -17.0], 12.5, 1e-3);
            let motion = |dx: f64, dy: f64, dz: f64| WaterMotion::new(&plan, [at[0] + dx, at[1] + dz], -3.0 + dy, 3000);
            let v = |dx, dy, dz| motion(dx, dy, dz).sample(t).velocity_m_s;
            let difference = |axis: usize, a: [f64; 3], b: [f64; 3]| (a[axis] - b[axis]) / (2.0 * d);
            let divergence = difference(0, v(d, 0.0, 0.0), v(-d, 0.0, 0.0))
                + difference(1, v(0.0, d, 0.0), v(0.0, -d, 0.0))
                + difference(2, v(0.0, 0.0, d), v(0.0, 0.0, -d));
            let scale = v(0.0, 0.0, 0.0).iter().map(|u| u.abs()).fold(0.1, f64::max);
            assert!(divergence.abs() < 1e-4 * scale, "{state}: {divergence}");
            // Euler's equation without the quadratic terms: rho du/dt = -grad p.
            let here = motion(0.0, 0.0, 0.0);
            let pressure = |dx, dy, dz| motion(dx, dy, dz).sample(t).dynamic_pressure_pa;
            let gradient = [
                pressure(d, 0.0, 0.0) - pressure(-d, 0.0, 0.0),
                pressure(0.0, d, 0.0) - pressure(0.0, -d, 0.0),
                pressure(0.0, 0.0, d) - pressure(0.0, 0.0, -d),
            ]
            .map(|p| p / (2.0 * d));
            let h = 0.01;
            let (later, before) = (here.sample(t + h).velocity_m_s, here.sample(t - h).velocity_m_s);
            for axis in 0..3 {
                let force = plan.sea.density_kg_m3 * (later[axis] - before[axis]) / (2.0 * h);
                assert!(
                    (force + gradient[axis]).abs() < 2e-2 * plan.sea.density_kg_m3,
                    "{state} {axis}: {force} {}",
                    gradient[axis]
                );
            }
        }
    }

    #[test]
    fn nothing_moves_through_the_bed_and_shallow_water_is_hydrostatic() {
        let shallow = plan("wind=0&hs=0.2&tp=14&depth=4&n=64&chop=0");
        for t in [0.0, 7.0, 40.0] {
            let bed = WaterMotion::new(&shallow, [5.0, 6.0], -4.0, usize::MAX).sample(t);
            assert!(bed.velocity_m_s[1].abs() < 1e-12);
            let surface = WaterMotion::new(&shallow, [5.0, 6.0], 0.0, usize::MAX).sample(t);
            let head_m = surface.dynamic_pressure_pa / (1025.0 * 9.81);
            assert!((head_m - surface.linear_elevation_m).abs() < 2e-3, "{head_m} {surface:?}");
        }
    }
}
