//! Wave theory in f64: spectra, directional spreading, dispersion, and the plan that divides a sea into cascades
//! (square patches of different sizes, whose sum is the sea).
//!
//! All results are pure functions of the parameters in [`crate::state::Params`] and of the time.

pub mod beaufort;
pub mod cascades;
pub mod change;
pub mod colour_scale;
pub mod crest_theory;
pub mod crests;
mod directional_spectrum;
pub mod dispersion;
pub mod energy;
pub mod fft;
pub mod foam;
pub mod lattice;
pub mod map_spectrum;
pub mod noise;
pub mod overlap;
pub mod plan;
pub mod quadrature;
pub mod record;
pub mod second_order;
pub mod slopes;
pub mod spectra;
pub mod spreading;
pub mod statistics;
pub mod system;
pub mod table;
pub mod tiling;

pub use change::SeaChange;
pub use plan::Plan;
