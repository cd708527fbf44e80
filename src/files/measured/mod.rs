//! Measured wave spectra: reads the spectral files of a wave buoy as a frequency spectrum with directions.
//!
//! [`MeasuredSpectrum::read`] reads files, [`MeasuredSpectrum::to_state`] and [`MeasuredSpectrum::from_state`] carry a
//! spectrum in a link, and [`MaximumEntropyDistribution`] turns its directional moments into a directional
//! distribution.

mod direction;
mod formats;
mod mem;
mod spectrum;
mod state;
#[cfg(test)]
mod tests;
mod text;

pub use direction::DirectionalParameters;
pub use formats::MAX_FILES_PER_SPECTRUM;
pub use mem::MaximumEntropyDistribution;
pub use spectrum::{MAX_BANDS, MIN_BANDS, MeasuredSpectrum, SpectrumFile};
pub use state::MAX_TEXT_BYTES;
pub use text::MAX_FILE_BYTES;
