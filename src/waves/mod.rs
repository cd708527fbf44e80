//! The theory of the waves, in f64: spectra, spreading, dispersion, and the plan that divides a sea among cascades.
//!
//! Everything here is a pure function of [`crate::state::Params`].

pub mod beaufort;
pub mod cascades;
pub mod colour_scale;
pub mod dispersion;
pub mod energy;
mod fft;
pub mod foam;
pub mod map_spectrum;
pub mod noise;
pub mod overlap;
pub mod plan;
pub mod quadrature;
pub mod record;
pub mod slopes;
pub mod spectra;
pub mod spreading;
pub mod statistics;
pub mod system;
pub mod table;
pub mod tiling;

pub use plan::Plan;
