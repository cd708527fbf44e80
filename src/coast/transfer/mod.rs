//! What a coast makes of the open sea, in the form in which the GPU and [`Heights`](crate::point::heights) sum it at
//! any time.
//!
//! A transfer holds the strongest waves of the first cascade that travel towards the land. Each is a wave of the
//! cascade's lattice with the amplitude h0 (`shaders/waves/spectrum.wgsl`). In the open sea its elevation is 2 Re[h0
//! e^(i k x - i omega t)]. Over the coast it is 2 Re[h0 T(x) e^(-i omega t)] with the transfer function T, which the
//! mild-slope equation gives. The elevation near the coast is the sum of these waves, plus all other waves of the
//! open sea times `SeaAtPoint::short_gain`.
//!
//! T turns quickly in space, so it is stored against the phase of a carrier: T = envelope e^(i phase). Waves of similar
//! frequency and direction form a group, which has one carrier: a wave that has in each column of the grid the mean
//! wave number of its water and its shore. Its phase at column x and row y (m) is `column_phase_rad`(x) + `ky_rad_m` y. Between the points of the grid,
//! envelopes and phases are linear.

mod envelopes;
mod evaluate;
mod groups;
mod half_float;
mod points;
mod setup;
mod shore;
mod solver;
mod statistics;
mod swash;
#[cfg(test)]
mod tests;

use super::breaking::Losses;
use super::incident::Placement;
use super::options::Options;
use crate::waves::Plan;
pub use envelopes::sharpen;
pub use evaluate::{CoastalGains, CoastalSums, CoastalWaveAtPoint, CoastalWaves};
pub use solver::TransferSolver;
pub use statistics::{SpectrumBand, StatisticsSolver, TransferStatistics};

/// Transfer functions of a coast on a grid in its frame. Point (column i, row j) lies at x = i `cell_m` and y = j
/// `cell_m` of the frame that `placement` puts into the world.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transfer {
    /// Place of the frame of the coast in the world: x axis shoreward, y axis 90 degrees clockwise from it.
    pub placement: Placement,
    /// Number of points along x.
    pub columns: usize,
    /// Number of points along y.
    pub rows: usize,
    /// Distance of neighbouring points, m.
    pub cell_m: f64,
    /// Depth, m, from which water is open: there the envelopes are those of the solved waves, and [sharpened](sharpen).
    pub open_from_m: f64,
    /// Key of the lattice of wave vectors to which the waves belong: the first cascade's patch side (m), its noise key,
    /// and the seed of the sea. The waves mean nothing on another lattice.
    pub lattice: LatticeKey,
    /// The waves, sorted by group.
    pub waves: Vec<TransferWave>,
    /// The groups.
    pub groups: Vec<WaveGroup>,
    /// Envelopes of the transfer functions as pairs of half floats (real part in the low 16 bits):
    /// \[wave\]\[row\]\[column\].
    pub envelopes: Vec<u32>,
    /// What else is known at each point: \[row\]\[column\].
    pub points: Vec<SeaAtPoint>,
}

impl Transfer {
    /// Whether a point lies in open water.
    fn is_open(&self, point: usize) -> bool {
        f64::from(self.points[point].depth_m) >= self.open_from_m
    }

    /// Whether the waves of `plan` are those of the lattice for which the transfer was made.
    pub fn fits(&self, plan: &Plan) -> bool {
        let key = self.lattice;
        let is_same =
            |patch_m, noise_key| (key.patch_m, key.noise_key, key.seed) == (patch_m, noise_key, plan.sea.seed);
        plan.cascades.first().is_some_and(|c| is_same(c.patch_m, c.noise_key)) && self.columns > 1 && self.rows > 1
    }

    /// World coordinates (x, z), m, of the point (`x_m`, `y_m`) of the coast's frame, m.
    pub fn world_m(&self, [x_m, y_m]: [f64; 2]) -> [f64; 2] {
        self.placement.world_m([x_m, y_m])
    }

    /// The point (x, y), m, of the coast's frame at the world coordinates `at_m` (x, z), m.
    pub fn in_frame_m(&self, at_m: [f64; 2]) -> [f64; 2] {
        self.placement.in_frame_m(at_m)
    }
}

/// Limits of a transfer, and how it is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransferLimits {
    /// Largest number of waves.
    pub max_waves: usize,
    /// Largest size of the envelopes, bytes.
    pub max_bytes: usize,
    /// Largest number of groups.
    pub max_groups: usize,
    /// Number of points along the longer side.
    pub points: usize,
    /// Number of points along the longer side where there are structures: the envelopes of reflected waves turn
    /// quickly.
    pub points_with_structures: usize,
    /// Energy losses.
    pub losses: Losses,
    /// Number of threads; one where the system has no threads.
    pub threads: usize,
}

impl Default for TransferLimits {
    fn default() -> Self {
        Self {
            max_waves: 500,
            max_bytes: 64 << 20,
            max_groups: 64,
            points: 128,
            points_with_structures: 192,
            losses: Losses::default(),
            threads: Options::default().threads,
        }
    }
}

/// Identifies a lattice of wave vectors with its random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LatticeKey {
    /// Side of the patch, m: wave vectors are 2 pi / `patch_m` apart.
    pub patch_m: f64,
    /// Key of the random numbers of the cascade.
    pub noise_key: u32,
    /// Seed of the sea.
    pub seed: u32,
}

/// One wave of a [`Transfer`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransferWave {
    /// Indices (along x and z of the world) of its wave vector on the lattice, in units of 2 pi / `patch_m`.
    pub lattice_index: [i32; 2],
    /// Angular frequency, rad/s.
    pub omega_rad_s: f64,
    /// Index of its group.
    pub group: u32,
}

/// Waves of similar frequency and direction, with the carrier of their envelopes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaveGroup {
    /// Index of its first wave.
    pub first_wave: usize,
    /// Number of its waves.
    pub wave_count: usize,
    /// Wave number of the carrier along y, rad/m.
    pub ky_rad_m: f64,
    /// Phase of the carrier at each column, rad, at y = 0.
    pub column_phase_rad: Vec<f64>,
}

/// What a transfer says at a point besides the waves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeaAtPoint {
    /// Depth below the still water, m; negative on land.
    pub depth_m: f32,
    /// Factor on the amplitude of all waves that the transfer does not hold: 1 in the open sea, 0 on land.
    pub short_gain: f32,
    /// Weight of the transferred waves, 0 to 1. The same waves of the open sea have the rest: 1 within the coast,
    /// falling to 0 at the sides where the open sea goes on.
    pub weight: f32,
    /// Wave height from which the waves of this sea break here, m; infinite where none break. The fraction of waves
    /// that are higher is that of Battjes and Janssen 1978.
    pub breaking_height_m: f32,
    /// Mean level of the water above the still water by breaking waves (set-up), m.
    pub set_up_m: f32,
    /// Standard deviation of the level around its mean by the waves of the transfer, m; 0 on land that they do not reach.
    pub level_deviation_m: f32,
}

impl SeaAtPoint {
    /// Height above the still water, m, that 2 % of the waves run up a beach as they are drawn here: the formula of
    /// Stockdon et al. 2006, 1.1 (set-up + S / 2), with the swash S of four standard deviations.
    pub fn run_up_m(&self) -> f32 {
        1.1 * (self.set_up_m + 2.0 * self.level_deviation_m)
    }
}
