//! The physics and the state, once, in f64: no wgpu, no egui, no browser.
//!
//! Everything here is a pure function of [`Params`], so that it can be tested, quoted and reused by itself.

pub mod afloat;
pub mod beaufort;
pub mod camera;
pub mod cascades;
pub mod dispersion;
pub mod energy;
pub mod fields;
pub mod foam;
pub mod heights;
pub mod look;
pub mod measured;
pub mod noise;
pub mod optics;
pub mod overlap;
pub mod panorama;
pub mod params;
#[cfg(feature = "files")]
pub mod picture;
pub mod plan;
pub mod presets;
pub mod quadrature;
pub mod query;
pub mod record;
pub mod slopes;
pub mod spectra;
pub mod spreading;
pub mod statistics;
pub mod sun;
pub mod survey;
pub mod table;
pub mod tiling;
mod transform;
mod versions;
pub mod views;
pub mod waves;

pub use heights::Heights;
pub use params::Params;
pub use plan::Plan;
