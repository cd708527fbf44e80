//! Heights at a coast (`point::StrongestWaves::with_coast`) against the sum over all waves, written from the
//! definitions.

mod common;

use seastate::coast::Transfer;
use seastate::point::StrongestWaves;
use seastate::point::floating::{HullWaves, hull_pose};
use seastate::point::kinematics::WaterMotion;
use seastate::state::floats::{FloatingObject, FloatingObjectKind};
use seastate::waves::Plan;
use seastate::waves::statistics::{initial_amplitude, lattice_indices};
use seastate::waves::table::{SpectrumTable, entry_index};
use std::collections::HashSet;
use std::sync::Arc;

/// A sea on the beach whose shortest cascade is left out: the sum over the others takes a moment only.
const STATE: &str = "coast=beach&depth=12&hs=1.5&tp=9&dir=250&n=64&cascades=2&order=1&coastturn=25&coastx=300&untile=0";

fn sea(state: &str) -> (Plan, Arc<Transfer>) {
    let params = common::params(state);
    let plan = Plan::new(&params);
    (plan, common::coast_transfer(&params, 30, 80))
}

/// The value of a half float.
fn half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let size = if exponent == 0 { fraction * 2f64.powi(-14) } else { (1.0 + fraction) * 2f64.powi(exponent - 15) };
    if bits >> 15 == 0 { size } else { -size }
}

/// Place in cells of the grid of a point of the world.
fn cells(transfer: &Transfer, at: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = transfer.placement.turn_rad.sin_cos();
    let [x, z] = [0, 1].map(|axis| at[axis] - transfer.placement.origin_m[axis]);
    [x * cos + z * sin, z * cos - x * sin].map(|v| v / transfer.cell_m)
}

/// Elevation (m) of the coastal waves at a place of the grid, in cells: each envelope is bilinear, and turns with its
/// group's carrier.
fn coastal_elevation(plan: &Plan, transfer: &Transfer, [gx, gy]: [f64; 2], t_s: f64) -> f64 {
    let cascade = &plan.cascades[0];
    let table = SpectrumTable::new(plan, cascade);
    let (i, j) = (gx as usize, gy as usize);
    let (p, q) = (gx - i as f64, gy - j as f64);
    let shares = [(0, 0, (1.0 - p) * (1.0 - q)), (1, 0, p * (1.0 - q)), (0, 1, (1.0 - p) * q), (1, 1, p * q)];
    let mut sum = 0.0;
    for (w, wave) in transfer.waves.iter().enumerate() {
        let group = &transfer.groups[wave.group as usize];
        let mut envelope = [0.0; 2];
        for (di, dj, share) in shares {
            let packed = transfer.envelopes[(w * transfer.rows + j + dj) * transfer.columns + i + di];
            envelope = [envelope[0] + share * half(packed as u16), envelope[1] + share * half((packed >> 16) as u16)];
        }
        let phases = &group.column_phase_rad;
        let carrier = phases[i] + p * (phases[i + 1] - phases[i]) + group.ky_rad_m * gy * transfer.cell_m;
        let [ix, iz] = wave.lattice_index;
        let h0 = initial_amplitude(plan, cascade, &table, ix, iz);
        let (sin, cos) = (carrier - wave.omega_rad_s * t_s).sin_cos();
        let re = h0[0] * envelope[0] - h0[1] * envelope[1];
        let im = h0[0] * envelope[1] + h0[1] * envelope[0];
        sum += 2.0 * (re * cos - im * sin);
    }
    sum
}

/// Elevation (m) of the waves of the lattices at a point of the world: those of the transfer, and all others.
fn open_elevations(plan: &Plan, transfer: &Transfer, at: [f64; 2], t_s: f64) -> [f64; 2] {
    let coastal: HashSet<[i32; 2]> = transfer.waves.iter().map(|wave| wave.lattice_index).collect();
    let mut sums = [0.0; 2];
    for (c, cascade) in plan.cascades.iter().enumerate() {
        let table = SpectrumTable::new(plan, cascade);
        for (ix, iz) in lattice_indices(plan.n) {
            let wave = &table.waves[entry_index(ix, iz)];
            if wave.k > 0.0 {
                let [re, im] = initial_amplitude(plan, cascade, &table, ix, iz);
                let phase = cascade.dk() * (f64::from(ix) * at[0] + f64::from(iz) * at[1]) - wave.omega * t_s;
                let (sin, cos) = phase.sin_cos();
                let is_other = c > 0 || !coastal.contains(&[ix, iz]);
                sums[usize::from(is_other)] += 2.0 * (re * cos - im * sin);
            }
        }
    }
    sums
}

#[test]
fn heights_at_a_coast_are_the_weighted_sum() {
    let (plan, transfer) = sea(STATE);
    let heights = StrongestWaves::new(&plan, usize::MAX).with_coast(&plan, &transfer);
    assert!((heights.variance_fraction() - 1.0).abs() < 1e-9);
    let (mut inside, mut blended, mut dry, mut outside) = (0, 0, 0, 0);
    for step in 0..160_u32 {
        let (x, y) = (
            1700.0 * (0.618_034 * f64::from(step)).fract() - 100.0,
            1700.0 * (0.754_878 * f64::from(step)).fract() - 100.0,
        );
        let (sin, cos) = transfer.placement.turn_rad.sin_cos();
        let [east, south] = transfer.placement.origin_m;
        let at = [east + x * cos - y * sin, south + x * sin + y * cos];
        let t_s = 500.0 + 7.7 * f64::from(step);
        let grid = cells(&transfer, at);
        let last = [transfer.columns, transfer.rows].map(|count| (count - 1) as f64);
        let is_inside = (0..2).all(|axis| grid[axis] > 0.0 && grid[axis] < last[axis]);
        let gains = transfer.gains(at);
        let [offshore, others] = open_elevations(&plan, &transfer, at, t_s);
        let mut want = gains.short_gain * (others + (1.0 - gains.weight) * offshore);
        if is_inside {
            want += gains.weight * (coastal_elevation(&plan, &transfer, grid, t_s) + gains.set_up_m);
        } else {
            assert_eq!(gains.weight, 0.0);
            outside += 1;
        }
        let got = heights.sample_undisplaced(at[0], at[1], t_s).height_m;
        // The phase of the sea is a 32-bit integer of a day: 20 microseconds.
        assert!((got - want).abs() < 2e-3, "{at:?}: {got}, not {want}");
        inside += u32::from(gains.weight == 1.0);
        blended += u32::from(gains.weight > 0.0 && gains.weight < 1.0);
        dry += u32::from(gains.weight > 0.0 && gains.short_gain == 0.0);
    }
    assert!(inside > 50 && blended > 10 && dry > 3 && outside > 5, "{inside} {blended} {dry} {outside}");
}

/// The search for the water at a point ends at it, at the coast too, and slopes are those of the heights.
#[test]
fn water_is_found_at_a_coast() {
    let (plan, transfer) = sea("coast=beach&depth=12&hs=1.5&tp=9&dir=250&n=64");
    let heights = StrongestWaves::new(&plan, 400).with_coast(&plan, &transfer);
    let mut found = 0;
    for step in 0..200_u32 {
        let [x, z] = [0.618_034, 0.754_878].map(|r| 1400.0 * ((r * f64::from(step)).fract() - 0.5));
        let sample = heights.sample(x, z, 100.0 + f64::from(step));
        assert!(sample.height_m.abs() < 4.0 && sample.normal[1].is_finite());
        found += u32::from(sample.converged);
        let again =
            heights.sample_undisplaced(sample.undisplaced_xz[0], sample.undisplaced_xz[1], 100.0 + f64::from(step));
        assert!((again.height_m - sample.height_m).abs() < 1e-6, "{sample:?} {again:?}");
    }
    assert!(found >= 190, "{found} of 200 searches end");
    // Without choppiness the normal has the slopes of the heights.
    let (plan, transfer) = sea("coast=beach&depth=12&hs=1.5&tp=9&dir=250&n=64&chop=0");
    let heights = StrongestWaves::new(&plan, 400).with_coast(&plan, &transfer);
    let at = |x: f64, z: f64| heights.sample_undisplaced(x, z, 77.0);
    let (x, z, step) = (-200.0, 31.0, 0.01);
    let [nx, ny, nz] = at(x, z).normal;
    for (slope, beside, before) in
        [(-nx / ny, at(x + step, z), at(x - step, z)), (-nz / ny, at(x, z + step), at(x, z - step))]
    {
        let want = (beside.height_m - before.height_m) / (2.0 * step);
        assert!((slope - want).abs() < 1e-3, "{slope}, not {want}");
    }
}

#[test]
fn hulls_float_on_the_waves_at_the_coast() {
    let (plan, transfer) = sea(STATE);
    let [open, coastal] = [HullWaves::new(&plan), HullWaves::new(&plan).with_coast(&plan, &transfer)];
    // Some 80 m before the shore.
    let float = FloatingObject { kind: FloatingObjectKind::Buoy, x_m: 753.0, z_m: 211.0 };
    let height = |waves: &HullWaves, t: f64| hull_pose(&[(waves, 1.0)], &float, t, 0.0).position_m[1];
    let mut differs = 0.0_f64;
    for t in (0..40).map(f64::from) {
        let sample = coastal.heave_waves().sample(float.x_m, float.z_m, t);
        assert!((height(&coastal, t) - sample.height_m).abs() < 1e-9);
        differs = differs.max((height(&coastal, t) - height(&open, t)).abs());
    }
    assert!(differs > 0.1, "{differs}");
}

/// Below the surface the water moves as linear waves of the depth there move it: in shallow water along the surface's
/// slope, without a vertical velocity at the bed, and with the pressure of the elevation.
#[test]
fn water_moves_below_the_surface_at_a_coast() {
    let (plan, transfer) = sea(STATE);
    let heights = StrongestWaves::new(&plan, usize::MAX).with_coast(&plan, &transfer);
    // In the open water of the coast, before the shore, and on land.
    for (at, is_land) in [([300.0, 0.0], false), ([753.0, 211.0], false), ([950.0, 303.0], true)] {
        let depth_m = transfer.gains(at).depth_m;
        assert_eq!(depth_m < 0.0, is_land, "{depth_m}");
        let [surface, bed] = [0.0, -100.0].map(|z| WaterMotion::at_coast(&plan, &transfer, at, z, usize::MAX));
        for t in [3.0, 47.5, 120.0] {
            let (top, bottom) = (surface.sample(t), bed.sample(t));
            assert!(bottom.velocity_m_s[1].abs() < 1e-9);
            if is_land {
                assert_eq!(top.velocity_m_s, [0.0; 3]);
                continue;
            }
            let gains = transfer.gains(at);
            let want = heights.sample_undisplaced(at[0], at[1], t).height_m - gains.weight * gains.set_up_m;
            assert!((top.linear_elevation_m - want).abs() < 1e-6, "{} {want}", top.linear_elevation_m);
            // Kinematic boundary condition: the vertical velocity is the rate of the elevation.
            let h = 0.05;
            let rate =
                (surface.sample(t + h).linear_elevation_m - surface.sample(t - h).linear_elevation_m) / (2.0 * h);
            assert!((top.velocity_m_s[1] - rate).abs() < 0.02, "{} {rate}", top.velocity_m_s[1]);
        }
    }
}

#[test]
fn another_sea_or_no_coast_changes_nothing() {
    let (plan, transfer) = sea(STATE);
    let open = Plan::new(&common::params("depth=12&hs=1.5&tp=9&dir=250&n=64"));
    for other in [open, Plan::new(&common::params(&format!("{STATE}&seed=9")))] {
        let heights = StrongestWaves::new(&other, 200);
        assert_eq!(heights.clone().with_coast(&other, &transfer), heights);
    }
    let heights = StrongestWaves::new(&plan, 200);
    assert!(heights.clone().with_coast(&plan, &transfer) != heights);
}
