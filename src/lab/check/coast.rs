//! Compares the passes of a coast with the oracle, on transfer functions of waves that a slope turns and raises.

use super::{Comparison, MIN_RMS_DIVISOR, comparison, read_map, rms_difference, root_mean_square};
use crate::coast::complex::Complex as Amplitude;
use crate::coast::incident::Placement;
use crate::coast::transfer::{LatticeKey, SeaAtPoint, Transfer, TransferWave, WaveGroup, sharpen};
use crate::gpu::Gpu;
use crate::oracle::coast::{CoastPoint, CoastWaves};
use crate::oracle::{self, Complex, Texel};
use crate::sim::Simulation;
use crate::sim::coast::square::CoastSquare;
use crate::sim::resources::MapKind;
use crate::waves::Plan;
use crate::waves::statistics::lattice_indices;
use half::f16;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Largest accepted rms error of the maps of waves at a coast, divided by the rms of the oracle's. Besides the maps, the
/// sums of the groups are rounded to half floats, and samplers interpolate them with weights of 8 bits.
const COAST_MAP_TOLERANCE: f64 = 2e-3;
/// Largest accepted rms error of their derivatives, which are differences of such values.
const COAST_GRADIENT_TOLERANCE: f64 = 2.5e-3;

/// A coast of which the waves are known: over a slope along x, they become shorter and higher by the same factors.
#[derive(Clone, Copy, Debug)]
pub struct SyntheticCoast {
    /// Place of its frame.
    pub placement: Placement,
    /// Numbers of points along x and y.
    pub size: [usize; 2],
    /// Distance of two points, m.
    pub cell_m: f64,
    /// Increase of the wave number along x from the sea to the land, as a fraction.
    pub shortening: f64,
    /// Increase of the wave height from the sea to the land, as a fraction.
    pub growth: f64,
    /// Set-up at the land, m; it grows from 0 at the sea.
    pub set_up_m: f64,
    /// Height from which waves break, m.
    pub breaking_height_m: f32,
    /// Largest number of waves.
    pub waves: usize,
    /// Length of the shortest of the waves in the open sea, m.
    pub shortest_m: f64,
}

impl SyntheticCoast {
    /// The transfer functions for the strongest waves of a sea's first cascade that travel towards the land. The waves of
    /// the coast have the whole weight but for a fifth of the grid at the sides where the open sea goes on.
    pub fn transfer(&self, plan: &Plan) -> Transfer {
        let cascade = &plan.cascades[0];
        let [columns, rows] = self.size;
        let mut groups: BTreeMap<[i64; 2], Vec<([i32; 2], [f64; 2])>> = BTreeMap::new();
        for (index, k) in self.strongest(plan) {
            let turned = self.placement.turned_into_frame(k);
            let key = [(12.0 * turned[0].hypot(turned[1]).ln()) as i64, (6.0 * turned[1].atan2(turned[0])) as i64];
            groups.entry(key).or_default().push((index, turned));
        }
        let wide_m = (columns - 1) as f64 * self.cell_m;
        // Distance that a wave at the sea has to travel for the same phase.
        let path_m = |column: usize| {
            let x = column as f64 * self.cell_m;
            x + 0.5 * self.shortening * x * x / wide_m
        };
        let mut out = Transfer {
            placement: self.placement,
            columns,
            rows,
            cell_m: self.cell_m,
            open_from_m: 0.0,
            lattice: LatticeKey { patch_m: cascade.patch_m, noise_key: cascade.noise_key, seed: plan.sea.seed },
            waves: Vec::new(),
            groups: Vec::new(),
            envelopes: Vec::new(),
            points: (0..rows * columns).map(|i| self.point(i % columns, i / columns)).collect(),
        };
        let dk = cascade.dk();
        for (group, members) in groups.values().enumerate() {
            let mean = [0, 1].map(|axis| members.iter().map(|(_, k)| k[axis]).sum::<f64>() / members.len() as f64);
            out.groups.push(WaveGroup {
                first_wave: out.waves.len(),
                wave_count: members.len(),
                ky_rad_m: mean[1],
                column_phase_rad: (0..columns).map(|column| mean[0] * path_m(column)).collect(),
            });
            for ([ix, iz], k) in members {
                let wave = plan.wave_at_squared_index(cascade, (ix * ix + iz * iz) as u32);
                out.waves.push(TransferWave {
                    lattice_index: [*ix, *iz],
                    omega_rad_s: wave.omega,
                    group: group as u32,
                });
                let [east, south] = self.placement.origin_m;
                let origin = dk * (f64::from(*ix) * east + f64::from(*iz) * south);
                let envelope_at = |i: usize| {
                    let (x, y) = (path_m(i % columns), (i / columns) as f64 * self.cell_m);
                    let size = 1.0 + self.growth * (i % columns) as f64 / (columns - 1) as f64;
                    Amplitude::polar(size, origin + (k[0] - mean[0]) * x + (k[1] - mean[1]) * y)
                };
                let mut envelope: Vec<Amplitude> = (0..rows * columns).map(envelope_at).collect();
                sharpen(&mut envelope, columns, |_| true);
                out.envelopes.extend(envelope.into_iter().map(|value| {
                    let [re, im] = [value.re, value.im].map(|v| u32::from(f16::from_f64(v).to_bits()));
                    re | im << 16
                }));
            }
        }
        out
    }

    /// Index and wave vector, rad/m in the world's axes, of the strongest waves.
    fn strongest(&self, plan: &Plan) -> Vec<([i32; 2], [f64; 2])> {
        let cascade = &plan.cascades[0];
        let table = crate::waves::table::SpectrumTable::new(plan, cascade);
        let mut waves = Vec::new();
        for (ix, iz) in lattice_indices(plan.n) {
            let k = [ix, iz].map(|i| f64::from(i) * cascade.dk());
            let angle = k[1].atan2(k[0]) - self.placement.turn_rad;
            let variance_m2 = table.variance(ix, iz);
            if variance_m2 > 0.0 && angle.cos() > 0.5 && k[0].hypot(k[1]) * self.shortest_m <= TAU {
                waves.push((variance_m2, [ix, iz], k));
            }
        }
        waves.sort_by(|a, b| b.0.total_cmp(&a.0));
        waves.truncate(self.waves);
        waves.into_iter().map(|(_, index, k)| (index, k)).collect()
    }

    fn point(&self, column: usize, row: usize) -> SeaAtPoint {
        let [x, y] = [(column, self.size[0]), (row, self.size[1])].map(|(at, count)| at as f64 / (count - 1) as f64);
        let from_side = x.min(y).min(1.0 - y) / 0.2;
        let weight = from_side.clamp(0.0, 1.0);
        SeaAtPoint {
            depth_m: (20.0 * (1.0 - x)) as f32,
            short_gain: (1.0 - 0.5 * x) as f32,
            weight: (weight * weight * (3.0 - 2.0 * weight)) as f32,
            breaking_height_m: self.breaking_height_m,
            set_up_m: (self.set_up_m * x) as f32,
            level_deviation_m: 0.0,
        }
    }
}

/// Compares the maps of the waves at a synthetic coast, and what its surf follows from, with the oracle, for the sea that `sim` has.
/// `h0` are the oracle's amplitudes of the first cascade.
///
/// # Errors
/// If reading back from the GPU fails.
pub async fn compare(
    gpu: &Gpu,
    sim: &mut Simulation,
    shaders: &crate::shaders::Shaders,
    h0: &[Complex],
    t_s: f64,
) -> Result<Vec<Comparison>, String> {
    let plan = sim.plan().clone();
    let side_m = 0.8 * plan.cascades[0].patch_m;
    let points = 49;
    let coast = SyntheticCoast {
        placement: Placement { origin_m: [-0.4 * side_m, 123.0], turn_rad: plan.downwind[1].atan2(plan.downwind[0]) },
        size: [points, points],
        cell_m: side_m / (points - 1) as f64,
        shortening: 0.2,
        growth: 0.3,
        set_up_m: 0.1,
        breaking_height_m: f32::INFINITY,
        waves: 100,
        shortest_m: 5.0 * side_m * 1.5 / f64::from(plan.n),
    };
    let mut transfer = coast.transfer(&plan);
    // Half of their own significant wave height, so that many of the waves break.
    let amplitude = |[ix, iz]: [i32; 2]| {
        let at = [iz, ix].map(|i| i.rem_euclid(plan.n as i32) as usize);
        h0[at[0] * plan.n as usize + at[1]]
    };
    let squares = transfer.waves.iter().map(|wave| amplitude(wave.lattice_index).iter().map(|x| x * x).sum::<f64>());
    let breaking_height_m = (2.0 * (2.0 * squares.sum::<f64>()).sqrt()) as f32;
    transfer.points.iter_mut().for_each(|point| point.breaking_height_m = breaking_height_m);
    let transfer = Arc::new(transfer);
    if !sim.set_coast(gpu, shaders, Some(transfer.clone())) {
        return Err("the sea does not take the waves of its own lattice".into());
    }
    let mut encoder = gpu.encoder("check");
    sim.encode(gpu, &mut encoder, t_s, [0.0; 2], 0);
    gpu.submit(encoder);
    let n = plan.n;
    let square = CoastSquare::around(&transfer, n);
    let waves = CoastWaves::new(&transfer, &plan, h0, t_s);
    let texel = |i: u32| transfer.placement.in_frame_m(square.texel_position_m([i % n, i / n], n));
    let places: Vec<[f64; 2]> = (0..n * n).map(texel).collect();
    let sums: Vec<CoastPoint> = places.iter().map(|at| waves.at(*at)).collect();
    let maps = oracle::coast::maps(&sums, square.side_m / f64::from(n));
    // Away from the edges of the grid, where a texel of the map of gains may lie half outside.
    let edge_m = 3.0 * square.side_m / f64::from(n);
    let is_inside = |at: &[f64; 2]| at.iter().all(|x| (edge_m..side_m - edge_m).contains(x));
    let inside: Vec<usize> = (0..places.len()).filter(|i| is_inside(&places[*i])).collect();
    let layer = plan.cascades.len() + 1;
    let mut lines = Vec::new();
    let kinds = [
        (MapKind::Displacement, "coast displacement", COAST_MAP_TOLERANCE),
        (MapKind::Gradients, "coast gradients", COAST_GRADIENT_TOLERANCE),
    ];
    for ((kind, what, tolerance), want) in kinds.into_iter().zip(&maps) {
        let got = read_map(gpu, &sim.resources, kind, 0).await?;
        let got = &got[layer * places.len()..][..places.len()];
        let of = |texels: &[Texel]| inside.iter().map(|i| texels[*i]).collect::<Vec<_>>();
        let (got, want) = (of(got), of(want));
        let rms = root_mean_square(want.iter().copied()).max(MIN_RMS_DIVISOR);
        lines.push(comparison(what, 0, rms_difference(got.into_iter(), want.into_iter()) / rms, tolerance));
    }
    let breakers = &read_map(gpu, &sim.resources, MapKind::Displacement, 0).await?[(layer + 1) * places.len()..];
    let mut compare = |what, channels: [usize; 2], want: &dyn Fn(&CoastPoint) -> [f64; 2]| {
        let got = inside.iter().map(|i| channels.map(|channel| breakers[*i][channel]));
        let want: Vec<[f64; 2]> = inside.iter().map(|i| want(&sums[*i])).collect();
        let rms = root_mean_square(want.iter().copied()).max(MIN_RMS_DIVISOR);
        lines.push(comparison(what, 0, rms_difference(got, want.into_iter()) / rms, COAST_MAP_TOLERANCE));
    };
    compare("coast phases", [0, 1], &|point| point.half_amplitude_m);
    compare("coast breaking", [2, 2], &|point| [oracle::coast::height_over_breaking(point); 2]);
    compare("coast depth", [3, 3], &|point| [point.depth_m; 2]);
    Ok(lines)
}
