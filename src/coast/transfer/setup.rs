//! What a transfer is made of: the grid, the waves and their groups, and the sea that breaks.

use super::groups::{columns, divide, group};
use super::shore::ShoreWaves;
use super::{LatticeKey, TransferLimits, WaveGroup};
use crate::coast::bathymetry::Bathymetry;
use crate::coast::incident::{
    Incident, LatticeIncident, Placement, spectrum_bins, strongest_waves_of_cascade, wrapped,
};
use crate::coast::local_wave::LocalWave;
use crate::coast::open_sea::{Arrival, MAX_OPEN_ANGLE_RAD, Solver, foreshore_slope, reflection};
use crate::coast::options::Options;
use crate::coast::placed::PlacedCoast;
use crate::coast::runup::RunUp;
use crate::waves::Plan;
use std::f64::consts::TAU;

/// Bins of frequency and of direction that stand for the whole sea, which breaks together.
const FREQUENCY_BINS: usize = 12;
const DIRECTION_BINS: usize = 17;
/// Shortest wave in the open sea, m.
const SHORTEST_M: f64 = 25.0;
/// Shortest wave in the open sea, in texels of the map of the waves at the coast.
const SHORTEST_TEXELS: f64 = 4.0;
/// Texels of that map beyond the grid, on both sides together.
const MARGIN_TEXELS: f64 = 9.0;
/// Shortest wave in the open sea, in cells of the grid, for waves that only travel shoreward, and for those that are
/// reflected: against the carrier, these have twice the wave number.
const SHORTEST_CELLS: [f64; 2] = [2.5, 6.0];
/// Largest phase (rad) of a wave of the open sea in a step of the march. The envelopes of the waves here need no finer
/// steps; finer ones would take four times as long.
const MAX_PHASE_PER_CELL: f64 = 1.3;
/// Length of a wave at the shore, in texels.
const SHORE_WAVE_TEXELS: f64 = 3.0;
/// Largest slope of the surface of the swash, relative to that of the foreshore at the waterline: half of it, because
/// beaches are flatter higher up.
const SWASH_SLOPE: f64 = 0.5;
/// Limits of the depth, m, from which waves go on ashore by themselves.
const LEAST_DEPTH_M: [f64; 2] = [0.3, 1.5];

/// A wave of the open sea that a transfer holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    pub(super) lattice_index: [i32; 2],
    /// Angular frequency with which it turns in time, rad/s: rounded, so that the sea repeats.
    pub(super) omega_rad_s: f64,
    /// Amplitude in the open sea, m: twice that of the lattice.
    pub(super) open_amplitude_m: f64,
    /// The wave at the edge of the grid. Its phase is that of a wave of phase 0 at the world origin; its frequency is
    /// the one that has the wave number of the lattice.
    pub(super) incident: Incident,
    /// Index of its group.
    pub(super) group: u32,
}

/// All that a transfer follows from.
pub(super) struct Setup {
    pub(super) solver: Solver,
    pub(super) options: Options,
    pub(super) grid: Bathymetry,
    pub(super) placement: Placement,
    pub(super) lattice: LatticeKey,
    pub(super) waves: Vec<Wave>,
    pub(super) groups: Vec<WaveGroup>,
    /// The whole sea at the edge of the grid.
    pub(super) bins: Vec<Incident>,
    /// Reflection coefficients of the points of the grid.
    pub(super) reflection: Vec<f32>,
    /// Run-up of the sea; `None` without a shore.
    pub(super) run_up: Option<RunUp>,
    /// How the waves run over the shore.
    pub(super) shore: ShoreWaves,
}

impl Setup {
    pub(super) fn new(plan: &Plan, coast: &PlacedCoast, limits: &TransferLimits) -> Self {
        let solver = Solver::of(coast);
        let gravity_m_s2 = plan.sea.gravity_m_s2;
        let options = Options {
            gravity_m_s2,
            losses: limits.losses,
            threads: limits.threads,
            max_phase_per_cell_rad: MAX_PHASE_PER_CELL,
            ..Options::default()
        };
        let placement = coast.placement();
        let foreshore = foreshore_slope(coast);
        let coast = &PlacedCoast { bathymetry: grid(coast, solver, limits), ..coast.clone() };
        let cell_m = coast.bathymetry.cell_m;
        let arrival = Arrival::new(plan, coast, solver);
        let texel_m = texel_m(coast, plan.n);
        let cells = SHORTEST_CELLS[usize::from(solver == Solver::Elliptic)];
        let shortest_m = SHORTEST_M.max(SHORTEST_TEXELS * texel_m).max(cells * cell_m);
        let points = coast.bathymetry.depth_m.len();
        let count = limits.max_waves.min(limits.max_bytes / (4 * points));
        let lattice_waves = match plan.cascades.first() {
            Some(cascade) if !plan.is_calm() => {
                strongest_waves_of_cascade(plan, cascade, placement, usize::MAX, shortest_m, MAX_OPEN_ANGLE_RAD)
            }
            _ => Vec::new(),
        };
        let arrived = |wave| arrived(plan, wave, placement, &arrival);
        let waves: Vec<Wave> = lattice_waves.iter().filter_map(arrived).take(count).collect();
        let bins = spectrum_bins(plan, placement.turn_rad, FREQUENCY_BINS, DIRECTION_BINS, MAX_OPEN_ANGLE_RAD);
        let hs_m = 4.0 * bins.iter().map(Incident::variance_m2).sum::<f64>().sqrt();
        let tp_s = TAU / plan.omega_p;
        let run_up = foreshore.map(|slope| RunUp::new(hs_m, gravity_m_s2 * tp_s * tp_s / TAU, slope));
        let least_depth_m = least_depth_m(&waves, texel_m, gravity_m_s2);
        let slowest_s_m = 1.0 / (gravity_m_s2 * least_depth_m).sqrt();
        // Waves never become shorter than in the least depth.
        let swash_s_m = match (&run_up, foreshore) {
            (Some(run_up), Some(slope)) => swash_slowness_s_m(run_up, slope, plan.omega_p).min(slowest_s_m),
            _ => slowest_s_m,
        };
        let shore = ShoreWaves {
            least_depth_m,
            // Twice the standard deviation of the swash above the mean level: half the height, and as much for rare
            // waves.
            reach_m: run_up.map_or(0.0, |run_up| run_up.set_up_m + run_up.swash_m),
            slowness_s_m: [slowest_s_m, swash_s_m],
        };
        let mut out = Self {
            solver,
            options,
            placement,
            lattice: lattice_key(plan),
            waves: Vec::new(),
            groups: Vec::new(),
            bins: bins.iter().filter_map(|bin| arrival.arriving(bin)).collect(),
            reflection: reflection(coast, plan.hs_m(), tp_s, gravity_m_s2),
            run_up,
            shore,
            grid: coast.bathymetry.clone(),
        };
        out.group(&waves, arrival.edge_depth_m, limits.max_groups);
        out
    }

    /// Sorts the waves into groups.
    fn group(&mut self, waves: &[Wave], edge_depth_m: f64, max_groups: usize) {
        let (cell_m, gravity_m_s2) = (self.grid.cell_m, self.options.gravity_m_s2);
        let columns = columns(&self.grid, self.shore);
        let weighted: Vec<(Incident, f64)> =
            waves.iter().map(|wave| (wave.incident, 0.5 * wave.open_amplitude_m.powi(2))).collect();
        for members in divide(&weighted, edge_depth_m, cell_m, gravity_m_s2, max_groups) {
            let of_group: Vec<(Incident, f64)> = members.iter().map(|w| weighted[*w]).collect();
            let first = self.waves.len();
            let index = self.groups.len() as u32;
            self.groups.push(group(&of_group, first, edge_depth_m, &columns, cell_m, gravity_m_s2));
            self.waves.extend(members.iter().map(|w| Wave { group: index, ..waves[*w] }));
        }
    }
}

fn lattice_key(plan: &Plan) -> LatticeKey {
    plan.cascades.first().map_or_else(LatticeKey::default, |cascade| LatticeKey {
        patch_m: cascade.patch_m,
        noise_key: cascade.noise_key,
        seed: plan.sea.seed,
    })
}

/// The depths of a coast on the grid of its transfer.
fn grid(coast: &PlacedCoast, solver: Solver, limits: &TransferLimits) -> Bathymetry {
    let [wide, long] = coast.side_m();
    let points = match solver {
        Solver::Parabolic => limits.points,
        Solver::Elliptic => limits.points_with_structures,
    };
    let cell_m = wide.max(long) / (points.max(3) - 1) as f64;
    let count = |side_m: f64| (side_m / cell_m).round().max(2.0) as usize + 1;
    let mut grid = Bathymetry::from_fn(count(wide), count(long), cell_m, |x, y| coast.bathymetry.depth_at_m(x, y));
    // Interpolated depths could have gaps in a thin wall.
    coast.structures.iter().for_each(|structure| structure.build_in(&mut grid));
    grid
}

/// Length, m, of a texel of the map of the waves at a coast, a square parallel to the axes of the world, in `n` x `n`
/// texels.
fn texel_m(coast: &PlacedCoast, n: u32) -> f64 {
    let [wide, long] = coast.side_m();
    let (sin, cos) = coast.turn_rad().sin_cos();
    let side_m = (wide * cos.abs() + long * sin.abs()).max(wide * sin.abs() + long * cos.abs());
    side_m / (f64::from(n) - MARGIN_TEXELS).max(1.0)
}

/// A wave of the lattice at the edge of the grid; `None` if it does not arrive.
fn arrived(plan: &Plan, wave: &LatticeIncident, placement: Placement, arrival: &Arrival) -> Option<Wave> {
    let dk = plan.cascades.first()?.dk();
    let phase: f64 = (0..2).map(|axis| f64::from(wave.lattice_index[axis]) * dk * placement.origin_m[axis]).sum();
    let omega_rad_s = frequency_of(wave.wave.k, wave.wave.omega, arrival.open_depth_m, arrival.gravity_m_s2);
    let open = Incident { phase_rad: wrapped(phase), omega_rad_s, ..wave.incident };
    Some(Wave {
        lattice_index: wave.lattice_index,
        omega_rad_s: wave.wave.omega,
        open_amplitude_m: open.amplitude_m,
        incident: arrival.arriving(&open)?,
        group: 0,
    })
}

/// The angular frequency (rad/s) near `near_rad_s` whose wave number in water of `depth_m` is `k` (rad/m). The
/// frequencies of a sea are rounded, which would make a wave out of phase after a kilometre.
fn frequency_of(k: f64, near_rad_s: f64, depth_m: f64, gravity_m_s2: f64) -> f64 {
    let mut omega = near_rad_s;
    for _ in 0..6 {
        let wave = LocalWave::new(omega, depth_m, gravity_m_s2);
        omega += (k - wave.k) * wave.group_velocity_m_s;
    }
    omega
}

/// Depth, m, from which waves go on ashore by themselves: a wave whose frequency is a fifth above the mean is some texels long there. It is near
/// enough to the height of bores, which run as fast as long waves in water of their height.
fn least_depth_m(waves: &[Wave], texel_m: f64, gravity_m_s2: f64) -> f64 {
    let weight = |wave: &Wave| wave.open_amplitude_m.powi(2);
    let sum: f64 = waves.iter().map(weight).sum();
    if sum <= 0.0 {
        return LEAST_DEPTH_M[0];
    }
    let omega = 1.2 * waves.iter().map(|wave| weight(wave) * wave.omega_rad_s).sum::<f64>() / sum;
    let velocity_m_s = omega * SHORE_WAVE_TEXELS * texel_m / TAU;
    (velocity_m_s * velocity_m_s / gravity_m_s2).clamp(LEAST_DEPTH_M[0], LEAST_DEPTH_M[1])
}

/// Time, s, in which the waves of the swash of `run_up` run a metre of a foreshore of the slope `slope`. Swash rises
/// and falls on a beach as a whole. If its surface fell more steeply towards the sea than the beach, crests would be
/// cut off from the sea. With this time, the surface of a wave of the sea's peak frequency `omega_rad_s`, whose
/// amplitude is half the height of the swash, has at most the slope `SWASH_SLOPE` relative to that of the foreshore.
fn swash_slowness_s_m(run_up: &RunUp, slope: f64, omega_rad_s: f64) -> f64 {
    SWASH_SLOPE * slope / (omega_rad_s * 0.5 * run_up.swash_m).max(f64::MIN_POSITIVE)
}
