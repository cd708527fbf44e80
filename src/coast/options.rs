//! What the solvers of a coast can be told.

use super::breaking::Losses;

/// Settings of a solution that do not depend on the coast or the sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Acceleration of gravity, m/s^2.
    pub gravity_m_s2: f64,
    /// Energy losses by breaking and friction.
    pub losses: Losses,
    /// Smallest depth with waves, m: shallower water counts as land.
    pub min_depth_m: f64,
    /// Largest phase (rad) of a wave of the open sea in a step of the parabolic solver: a shorter wave gets finer cells.
    pub max_phase_per_cell_rad: f64,
    /// Number of threads that share the work; one where the system has no threads.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        let threads = if cfg!(target_arch = "wasm32") {
            1
        } else {
            std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
        };
        Self { gravity_m_s2: 9.81, losses: Losses::default(), min_depth_m: 0.1, max_phase_per_cell_rad: 0.8, threads }
    }
}
